! SPDX-License-Identifier: BSD-3-Clause
!> What one key alone cannot tell: keys that exclude each other, defaults that depend on other
!> keys, and operating points that cannot be meant
module ehl_case_check
   use ehl_case, only: case_t, is_feature, path_length, surface_case_t
   use ehl_case_contact, only: check_contact_kind, check_extent, check_operating_point, complete_domain, &
                               complete_kinematics
   use ehl_case_feature, only: check_feature
   use ehl_case_lubricant, only: check_shear_law, complete_lubricant
   use ehl_case_radii, only: complete_radii
   use ehl_case_temperature, only: check_heat, complete_viscosity
   use ehl_files, only: absolute_path, file_exists, folder_of, is_file
   use ehl_grid, only: coarsest_most, find_levels
   use ehl_kinds, only: dp
   use ehl_refusal, only: contradict, refuse, short
   use ehl_schema, only: schema_t
   use ehl_source, only: source_t
   use ehl_status, only: status_t
   use ehl_text, only: to_text
   implicit none (type, external)
   private
   public :: check_case, complete_case

   !> Size of the tile of Table 1 of Zhang et al. 2019 [m]
   real(dp), parameter :: fractal_length = 8.29e-4_dp

contains

   !> Check a case whose keys are all good by themselves, and complete it
   subroutine check_case(schema, input, sources, status)
      type(schema_t), intent(in) :: schema
      type(case_t), intent(inout) :: input
      !> Where the values came from; the first is the case file
      type(source_t), intent(in) :: sources(:)
      type(status_t), intent(inout) :: status

      call check_contact_kind(schema, input, sources, status)
      call complete_radii(schema, input, sources, status)
      if (.not. status%failed()) call complete_viscosity(schema, input, sources, status)
      if (.not. status%failed()) call check_operating_point(schema, input, sources, status)
      if (.not. status%failed()) call complete_domain(schema, input)
      if (.not. status%failed()) call check_extent(schema, input, sources, status)
      if (.not. status%failed()) call complete_kinematics(schema, input, sources, status)
      if (.not. status%failed()) call complete_lubricant(schema, input, sources, status)
      if (.not. status%failed()) call check_shear_law(schema, input, sources, status)
      if (.not. status%failed()) call check_heat(schema, input, sources, status)
      if (.not. status%failed()) call check_points(schema, input, sources, status)
      if (.not. status%failed()) call complete_surface(schema, input, sources, status)
      if (.not. status%failed()) call check_time(schema, input, sources, status)
   end subroutine check_case

   !> Give values to keys that follow from others; check_case tells what contradicts
   subroutine complete_case(schema, input, sources)
      type(schema_t), intent(in) :: schema
      type(case_t), intent(inout) :: input
      type(source_t), intent(in) :: sources(:)
      type(status_t) :: ignored(5)

      call check_contact_kind(schema, input, sources, ignored(1))
      call complete_radii(schema, input, sources, ignored(5))
      call complete_viscosity(schema, input, sources, ignored(2))
      call complete_domain(schema, input)
      call complete_kinematics(schema, input, sources, ignored(3))
      call complete_lubricant(schema, input, sources, ignored(4))
      call complete_pattern(schema, input)
   end subroutine complete_case

   !> Halving points - 1 must end at a grid that can be the coarsest one, and points_y - 1 must halve as often
   subroutine check_points(schema, input, sources, status)
      type(schema_t), intent(in) :: schema
      type(case_t), intent(in) :: input
      type(source_t), intent(in) :: sources(:)
      type(status_t), intent(inout) :: status
      integer :: below, above, points
      character(len=:), allocatable :: why

      points = input%grid%points
      if (has_levels(points, points)) then
         call check_rows(schema, input, sources, status)
         return
      end if
      below = points
      do while (below > 17 .and. .not. has_levels(below, below))
         below = below - 1
      end do
      above = points
      do while (.not. has_levels(above, above))
         above = above + 1
      end do
      why = "too few grids can be made by halving"
      if (mod(points, 2) == 0) why = "an even number of points"
      call refuse(schema, sources, "grid", "points", "grid.points = " // to_text(points) // ": " &
         // why, "an odd number with points - 1 halved down to an even number of " // to_text(coarsest_most) // " or less; " &
         // "the nearest are " // to_text(below) // " and " // to_text(above), status)
   end subroutine check_points

   !> Rows of a grid whose number of columns is good
   subroutine check_rows(schema, input, sources, status)
      type(schema_t), intent(in) :: schema
      type(case_t), intent(in) :: input
      type(source_t), intent(in) :: sources(:)
      type(status_t), intent(inout) :: status
      integer :: levels, intervals(2), step, below

      associate (nx => input%grid%points, ny => input%grid%points_y)
         call find_levels(nx, nx, levels, intervals)
         step = 2*((nx - 1)/intervals(1))
         if (mod(ny - 1, step) == 0 .and. has_levels(nx, ny)) return
         below = max(4*step, ((ny - 1)/step)*step)
         call refuse(schema, sources, "grid", "points_y", "grid.points_y = "//to_text(ny)//" with "//to_text(nx)// &
                     " nodes along X", "points_y - 1 in multiples of "//to_text(step)//": the nearest are "// &
                     to_text(below + 1)//" and "//to_text(below + step + 1), status)
      end associate
   end subroutine check_rows

   !> Whether a grid can be coarsened far enough
   pure logical function has_levels(nx, ny)
      integer, intent(in) :: nx, ny
      integer :: levels, intervals(2)

      call find_levels(nx, ny, levels, intervals)
      has_levels = levels > 0
   end function has_levels

   !> Defaults of the surface that depend on other keys
   subroutine complete_pattern(schema, input)
      type(schema_t), intent(in) :: schema
      type(case_t), intent(inout) :: input

      associate (s => input%surface)
         if (s%kind == "fractal") then
            if (.not. s%length_x > 0.0_dp) s%length_x = fractal_length
            if (.not. s%length_y > 0.0_dp) s%length_y = fractal_length
         end if
         if (.not. schema%given("surface", "wavelength_x")) s%wavelength_x = s%wavelength
         if (.not. schema%given("surface", "wavelength_y")) s%wavelength_y = s%wavelength
         if (.not. schema%given("surface", "x_start")) s%x_start = input%grid%x_inlet
         s%amplitude_given = schema%given("surface", "amplitude")
      end associate
   end subroutine complete_pattern

   !> What the kinds of surfaces need
   subroutine complete_surface(schema, input, sources, status)
      type(schema_t), intent(in) :: schema
      type(case_t), intent(inout) :: input
      type(source_t), intent(in) :: sources(:)
      type(status_t), intent(inout) :: status

      call complete_pattern(schema, input)
      associate (s => input%surface)
         if (s%amplitude_given .and. schema%given("surface", "amplitude_over_film")) then
            call contradict(schema, sources, "surface.amplitude", "surface.amplitude_over_film", "one of the two", status)
            return
         end if
         call check_feature(schema, input, sources, status)
         if (.not. status%failed()) call check_filter(schema, input, sources, status)
         if (status%failed()) return
         if (s%kind == "map" .and. s%file == "") then
            call refuse(schema, sources, "surface", "kind", "surface.kind = 'map' without " &
               // "surface.file", "file = '...', a height map: .npy, text or a file of an instrument", status)
            return
         end if
      end associate
      call check_map_keys(schema, input%surface, sources, status)
      if (status%failed()) return
      if (input%surface%file /= "") call find_map(schema, input, sources, status)
   end subroutine complete_surface

   !> A single wave or feature has no spectrum to cut, and something must be left of others
   subroutine check_filter(schema, input, sources, status)
      type(schema_t), intent(in) :: schema
      type(case_t), intent(in) :: input
      type(source_t), intent(in) :: sources(:)
      type(status_t), intent(inout) :: status
      character(len=20), parameter :: names(2) = [character(len=20) :: "shortest_wavelength", "longest_wavelength"]
      real(dp) :: limits(2)
      integer :: k

      limits = [input%surface%shortest_wavelength, input%surface%longest_wavelength]
      do k = 1, 2
         if (.not. limits(k) > 0.0_dp) cycle
         if (is_feature(input%surface%kind)) then
            call refuse(schema, sources, "surface", trim(names(k)), "surface."//trim(names(k))//": a "// &
                        trim(input%surface%kind)//" has a closed form, there is no spectrum to cut", &
                        "0, or surface.kind = 'map' or 'fractal'", status)
            return
         end if
         if (input%surface%kind /= "harmonic") cycle
         call refuse(schema, sources, "surface", trim(names(k)), "surface."//trim(names(k))// &
                     ": a harmonic surface is a single wave, there is no spectrum to cut", &
                     "0, or surface.kind = 'map' or 'fractal'", status)
         return
      end do
      if (.not. limits(2) > 0.0_dp .or. limits(1) < limits(2)) return
      call refuse(schema, sources, "surface", "longest_wavelength", "surface.longest_wavelength = "// &
                  short(limits(2))//" m is not longer than surface.shortest_wavelength = "//short(limits(1))//" m", &
                  "a longest wavelength above the shortest one, or 0", status)
   end subroutine check_filter

   !> Keys of a map that do not go together
   subroutine check_map_keys(schema, s, sources, status)
      type(schema_t), intent(in) :: schema
      type(surface_case_t), intent(in) :: s
      type(source_t), intent(in) :: sources(:)
      type(status_t), intent(inout) :: status

      if (s%sign == 0) then
         call refuse(schema, sources, "surface", "sign", "surface.sign = 0", "1 or -1", status)
      else if (s%crop_x_max > 0.0_dp .and. s%crop_x_max <= s%crop_x_min) then
         call refuse(schema, sources, "surface", "crop_x_max", "surface.crop_x_max is not beyond crop_x_min", &
                     "a larger value [m], or 0 for the end of the map", status)
      else if (s%crop_y_max > 0.0_dp .and. s%crop_y_max <= s%crop_y_min) then
         call refuse(schema, sources, "surface", "crop_y_max", "surface.crop_y_max is not beyond crop_y_min", &
                     "a larger value [m], or 0 for the end of the map", status)
      end if
   end subroutine check_map_keys

   !> Make the name of the height map absolute; it must be there when it is used
   subroutine find_map(schema, input, sources, status)
      type(schema_t), intent(in) :: schema
      type(case_t), intent(inout) :: input
      type(source_t), intent(in) :: sources(:)
      type(status_t), intent(inout) :: status
      character(len=:), allocatable :: path

      path = trim(input%surface%file)
      ! A name in the case file starts at the folder of that file, an option at the working one
      if (path(1:1) /= "/" .and. schema%keys(schema%find("surface", "file"))%source == 1) then
         path = folder_of(sources(1)%name) // path
      end if
      path = absolute_path(path)
      if (len(path) > path_length) then
         call refuse(schema, sources, "surface", "file", "surface.file: the full name is longer " &
            // "than " // to_text(path_length) // " characters", "a shorter path", status)
      else if (input%surface%kind == "map") then
         ! the heights of a tile that pyehl has made come from it, or are kept beside the results
         if (.not. file_exists(path) .and. .not. input%surface%tile_x > 0.0_dp) then
            call refuse(schema, sources, "surface", "file", "surface.file: there is no file " // path, &
               "a height map: .npy, text or a file of an instrument", status)
         else if (file_exists(path)) then
            if (.not. is_file(path)) call refuse(schema, sources, "surface", "file", "surface.file: " // path &
               // " is a folder, a device or a pipe", "a height map: .npy, text or a file of an instrument", status)
         end if
      end if
      if (.not. status%failed()) input%surface%file = path
   end subroutine find_map

   !> A number of steps and a number of periods cannot both rule
   subroutine check_time(schema, input, sources, status)
      type(schema_t), intent(in) :: schema
      type(case_t), intent(in) :: input
      type(source_t), intent(in) :: sources(:)
      type(status_t), intent(inout) :: status

      if (input%time%steps == 0 .or. input%time%max_periods == 0) return
      call refuse(schema, sources, "time", "max_periods", "time.max_periods contradicts " &
                  // "time.steps", "one of the two, the other 0", status)
   end subroutine check_time
end module ehl_case_check

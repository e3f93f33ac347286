! SPDX-License-Identifier: BSD-3-Clause
!> What one key alone cannot tell: keys that exclude each other, defaults that depend on other
!> keys, and operating points that cannot be meant
module ehl_case_check
   use ehl_case, only: case_t, path_length
   use ehl_files, only: absolute_path, file_exists, folder_of
   use ehl_kinds, only: dp
   use ehl_moes, only: operating_from_si, operating_t
   use ehl_schema, only: schema_t
   use ehl_source, only: point_at, source_t
   use ehl_status, only: ehl_bad_input, status_t
   use ehl_text, only: to_text
   implicit none (type, external)
   private
   public :: check_case

   character(len=12), parameter :: moes_keys(2) = [character(len=12) :: "moes_m", "moes_l"]
   character(len=16), parameter :: si_keys(4) = &
      [character(len=16) :: "load", "mean_velocity", "radius", "reduced_modulus"]

contains

   !> Check a case whose keys are all good by themselves, and complete it
   subroutine check_case(schema, input, sources, status)
      type(schema_t), intent(in) :: schema
      type(case_t), intent(inout) :: input
      !> Where the values came from; the first is the case file
      type(source_t), intent(in) :: sources(:)
      type(status_t), intent(inout) :: status

      call check_contact_kind(schema, input, sources, status)
      if (.not. status%failed()) call check_operating_point(schema, input, sources, status)
      if (.not. status%failed()) call complete_lubricant(schema, input, sources, status)
      if (.not. status%failed()) call check_points(schema, input, sources, status)
      if (.not. status%failed()) call complete_surface(schema, input, sources, status)
      if (.not. status%failed()) call check_time(schema, input, sources, status)
   end subroutine check_case

   !> Refuse a case at the value of a key
   subroutine refuse(schema, sources, group, name, what, expected, status)
      type(schema_t), intent(in) :: schema
      type(source_t), intent(in) :: sources(:)
      character(len=*), intent(in) :: group, name, what, expected
      type(status_t), intent(inout) :: status

      associate (key => schema%keys(schema%find(group, name)))
         if (key%given) then
            call status%fail(ehl_bad_input, point_at(sources(key%source), key%first, key%last, &
                                                     what, expected))
         else
            call status%fail(ehl_bad_input, sources(1)%name // ": error: " // what &
                             // new_line("a") // "expected: " // expected)
         end if
      end associate
   end subroutine refuse

   !> Moes numbers or SI values, not both
   subroutine check_contact_kind(schema, input, sources, status)
      type(schema_t), intent(in) :: schema
      type(case_t), intent(inout) :: input
      type(source_t), intent(in) :: sources(:)
      type(status_t), intent(inout) :: status
      integer :: moes, si, later

      moes = first_given(schema, "contact", moes_keys)
      si = first_given(schema, "contact", si_keys)
      input%contact%si = moes == 0
      if (moes == 0 .or. si == 0) return
      later = moes
      if (is_before(schema, moes, si)) later = si
      associate (key => schema%keys(later))
         call status%fail(ehl_bad_input, point_at(sources(key%source), key%name_first, &
            key%name_last, key%full_name() // " contradicts " &
            // schema%keys(moes + si - later)%full_name(), &
            "moes_m and moes_l, or load, mean_velocity, radius and reduced_modulus"))
      end associate
   end subroutine check_contact_kind

   !> Of some keys the given one that stands first; 0 when none is given
   integer function first_given(schema, group, names)
      type(schema_t), intent(in) :: schema
      character(len=*), intent(in) :: group, names(:)
      integer :: k, position

      first_given = 0
      do k = 1, size(names)
         position = schema%find(group, names(k))
         if (.not. schema%keys(position)%given) cycle
         if (first_given == 0) first_given = position
         if (is_before(schema, position, first_given)) first_given = position
      end do
   end function first_given

   !> Whether key a stands before key b: file before options, then by place
   pure logical function is_before(schema, a, b)
      type(schema_t), intent(in) :: schema
      integer, intent(in) :: a, b

      associate (p => schema%keys(a), q => schema%keys(b))
         is_before = p%source < q%source .or. (p%source == q%source .and. p%first < q%first)
      end associate
   end function is_before

   !> SI values must make a contact that can exist; a slip of units mostly does not
   subroutine check_operating_point(schema, input, sources, status)
      type(schema_t), intent(in) :: schema
      type(case_t), intent(in) :: input
      type(source_t), intent(in) :: sources(:)
      type(status_t), intent(inout) :: status
      type(operating_t) :: point
      integer :: culprit
      character(len=:), allocatable :: what, expected

      if (.not. input%contact%si) return
      associate (c => input%contact)
         point = operating_from_si(c%load, c%mean_velocity, c%radius, c%reduced_modulus, &
                                   input%lubricant%viscosity, input%lubricant%pressure_viscosity)
      end associate
      what = ""
      expected = ""
      if (point%hertz_pressure < 1.0e5_dp .or. point%hertz_pressure > 2.0e10_dp) then
         what = "the Hertz pressure is " // short(point%hertz_pressure) // " Pa"
         expected = "values in SI units with a Hertz pressure between 1e5 and 2e10 Pa"
      else if (point%hertz_radius > input%contact%radius) then
         what = "the Hertz radius " // short(point%hertz_radius) // " m exceeds contact.radius"
         expected = "values in SI units with a contact much smaller than the ball"
      else if (point%moes_m > 1.0e5_dp .or. point%moes_m < 0.1_dp) then
         what = "the Moes parameter M is " // short(point%moes_m)
         expected = "values in SI units with M between 0.1 and 1e5"
      else if (point%moes_l > 100.0_dp) then
         what = "the Moes parameter L is " // short(point%moes_l)
         expected = "values in SI units with L of 100 at most"
      end if
      if (what == "") return
      culprit = first_given(schema, "contact", si_keys)
      if (culprit == 0) culprit = schema%find("lubricant", "viscosity")
      associate (key => schema%keys(culprit))
         call refuse(schema, sources, trim(key%group), trim(key%name), what // " with " &
                     // key%full_name() // " = " // key%value_text(), expected, status)
      end associate
   end subroutine check_operating_point

   !> Four digits of a number, for messages
   function short(x) result(text)
      real(dp), intent(in) :: x
      character(len=:), allocatable :: text
      character(len=16) :: buffer

      write (buffer, "(es10.3)") x
      text = trim(adjustl(buffer))
   end function short

   !> Roelands exponent from viscosity, alpha and p0 unless given; the PSD model's viscosity law
   subroutine complete_lubricant(schema, input, sources, status)
      type(schema_t), intent(in) :: schema
      type(case_t), intent(inout) :: input
      type(source_t), intent(in) :: sources(:)
      type(status_t), intent(inout) :: status

      associate (l => input%lubricant)
         if (.not. schema%given("lubricant", "roelands_z")) then
            l%roelands_z = l%pressure_viscosity*l%roelands_p0/(log(l%viscosity) + 9.67_dp)
            associate (key => schema%keys(schema%find("lubricant", "roelands_z")))
               if (.not. key%allows(l%roelands_z) .and. l%viscosity_law == "roelands") then
                  call refuse(schema, sources, "lubricant", "viscosity", &
                     "lubricant.roelands_z = " // short(l%roelands_z) // " follows from viscosity, " &
                     // "pressure_viscosity and roelands_p0", key%type_text(), status)
               end if
            end associate
         end if
         if (input%psd%viscosity_law == "") input%psd%viscosity_law = l%viscosity_law
      end associate
   end subroutine complete_lubricant

   !> Halving points - 1 must end at an even number of 32 or less, so that the coarsest grid
   !> is small
   subroutine check_points(schema, input, sources, status)
      type(schema_t), intent(in) :: schema
      type(case_t), intent(in) :: input
      type(source_t), intent(in) :: sources(:)
      type(status_t), intent(inout) :: status
      integer :: below, above, points
      character(len=:), allocatable :: why

      points = input%grid%points
      if (has_levels(points)) return
      below = points
      do while (below > 17 .and. .not. has_levels(below))
         below = below - 1
      end do
      above = points
      do while (.not. has_levels(above))
         above = above + 1
      end do
      why = "too few grids can be made by halving"
      if (mod(points, 2) == 0) why = "an even number of points"
      call refuse(schema, sources, "grid", "points", "grid.points = " // to_text(points) // ": " &
         // why, "an odd number with points - 1 halved down to an even number of 32 or less; " &
         // "the nearest are " // to_text(below) // " and " // to_text(above), status)
   end subroutine check_points

   !> Whether a grid can be coarsened far enough
   pure logical function has_levels(points)
      integer, intent(in) :: points
      integer :: cells

      cells = points - 1
      do while (cells > 32 .and. mod(cells, 2) == 0)
         cells = cells/2
      end do
      has_levels = cells <= 32 .and. mod(cells, 2) == 0
   end function has_levels

   !> Defaults of the surface that depend on other keys, and what its kinds need
   subroutine complete_surface(schema, input, sources, status)
      type(schema_t), intent(in) :: schema
      type(case_t), intent(inout) :: input
      type(source_t), intent(in) :: sources(:)
      type(status_t), intent(inout) :: status
      integer :: later

      associate (s => input%surface)
         if (.not. schema%given("surface", "wavelength_x")) s%wavelength_x = s%wavelength
         if (.not. schema%given("surface", "wavelength_y")) s%wavelength_y = s%wavelength
         if (.not. schema%given("surface", "x_start")) s%x_start = input%grid%x_inlet
         s%amplitude_given = schema%given("surface", "amplitude")
         if (s%amplitude_given .and. schema%given("surface", "amplitude_over_film")) then
            later = schema%find("surface", "amplitude")
            if (is_before(schema, later, schema%find("surface", "amplitude_over_film"))) then
               later = schema%find("surface", "amplitude_over_film")
            end if
            associate (key => schema%keys(later))
               call status%fail(ehl_bad_input, point_at(sources(key%source), key%name_first, &
                  key%name_last, "surface.amplitude contradicts surface.amplitude_over_film", &
                  "one of the two"))
            end associate
            return
         end if
         if (s%kind == "map" .and. s%file == "") then
            call refuse(schema, sources, "surface", "kind", "surface.kind = 'map' without " &
               // "surface.file", "file = '...', a height map in .npy or text", status)
            return
         end if
      end associate
      if (input%surface%file /= "") call find_map(schema, input, sources, status)
   end subroutine complete_surface

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
         if (.not. file_exists(path)) then
            call refuse(schema, sources, "surface", "file", "surface.file: there is no file " // path, &
               "a height map in .npy or text", status)
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

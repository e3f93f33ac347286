! SPDX-License-Identifier: BSD-3-Clause
!> The rough surfaces of a case
module ehl_plan_surface
   use, intrinsic :: iso_fortran_env, only: int32
   use ehl_case, only: case_t, has_no_height, is_feature, surface_case_t
   use ehl_feature, only: feature_t, new_feature
   use ehl_fractal, only: fractal_t, make_fractal
   use ehl_grid, only: grid_t
   use ehl_harmonic, only: endless, new_harmonic
   use ehl_height_map, only: height_map_t
   use ehl_kinds, only: dp
   use ehl_map_file, only: check_heights, read_map
   use ehl_moving_surfaces, only: moving_surfaces_t
   use ehl_scales, only: scales_t
   use ehl_status, only: ehl_bad_input, ehl_no_memory, status_t
   use ehl_surface, only: aliased_below, surface_t
   use ehl_text, only: short, to_text
   use ehl_tile_filter, only: filter_t
   implicit none (type, external)
   private
   public :: make_surfaces, check_resolved

   !> Length of the ramp at the front of a map [a]
   real(dp), parameter :: map_front = 0.5_dp

   !> Wavelength along Y [b] from which a wave on a line is transverse
   real(dp), parameter :: transverse = 1.0e6_dp

contains

   !> Make the surfaces of a case. One without height is left out if the other one has height.
   subroutine make_surfaces(input, scales, surfaces, status, heights, second_heights)
      type(case_t), intent(in) :: input
      type(scales_t), intent(in) :: scales
      type(moving_surfaces_t), intent(inout) :: surfaces
      type(status_t), intent(inout) :: status
      !> Heights of both maps [m], X first, in place of files; of size 0: none
      real(dp), intent(in), optional :: heights(:, :), second_heights(:, :)
      type(surface_case_t) :: s(2)
      logical :: none(2)

      s = [input%surface, input%second_surface]
      ! a transverse wave needs only one row of a strip
      where (s%wavelength_y >= transverse .and. input%contact%is_line()) s%wavelength_y = endless
      none = [has_no_height(input%surface), has_no_height(input%second_surface)]
      if (present(heights)) none(1) = none(1) .and. size(heights) == 0
      if (present(second_heights)) none(2) = none(2) .and. size(second_heights) == 0
      if (none(2) .or. .not. none(1)) call add_surface("surface", s(1), input%contact%rough_surface, &
                                                       input%contact%si, input%contact%is_line(), scales, surfaces, status, heights)
      if (none(1) .or. .not. none(2)) call add_surface("second_surface", s(2), 3 - input%contact%rough_surface, &
                                                       input%contact%si, input%contact%is_line(), scales, surfaces, status, &
                                                       second_heights)
   end subroutine make_surfaces

   !> Add the surface of a group unless it is smooth
   subroutine add_surface(group, s, body, si, is_line, scales, surfaces, status, heights)
      character(len=*), intent(in) :: group
      type(surface_case_t), intent(in) :: s
      integer, intent(in) :: body
      !> Whether the contact is given in SI units, and whether it is a line
      logical, intent(in) :: si, is_line
      type(scales_t), intent(in) :: scales
      type(moving_surfaces_t), intent(inout) :: surfaces
      type(status_t), intent(inout) :: status
      !> Heights of a map [m], X first, in place of a file; of size 0: none
      real(dp), intent(in), optional :: heights(:, :)
      class(surface_t), allocatable :: surface
      !> Amplitude over the smooth central film; 0: the amplitude is known already
      real(dp) :: amplitude_over_film
      real(dp), allocatable :: tile(:, :)
      logical :: has_heights

      amplitude_over_film = 0.0_dp
      has_heights = .false.
      if (present(heights)) has_heights = size(heights) > 0
      if (status%failed() .or. s%kind == "smooth") return
      if (is_feature(s%kind)) then
         call make_feature(group, s, is_line, scales, surface, amplitude_over_film, status)
      else if (s%kind == "harmonic") then
         allocate (surface, source=new_harmonic(s%amplitude, s%wavelength_x, s%wavelength_y, s%velocity_ratio, s%x_start))
         if (.not. s%amplitude_given) amplitude_over_film = s%amplitude_over_film
      else if (.not. si) then
         call status%fail(ehl_bad_input, group//".kind = '"//trim(s%kind)//"': a surface in metres needs a contact in SI "// &
                          "units"//new_line("a")//"expected: contact.load, mean_velocity, radius and reduced_modulus "// &
                          "instead of contact.moes_m and moes_l")
      else if (has_heights) then
         call make_map(group, s, scales, heights, surface, status)
      else
         call check_map(group, s, status)
         if (status%failed()) return
         if (s%kind == "map") then
            call read_map(trim(s%file), tile, status)
         else
            call generate(group, s, tile, status)
         end if
         if (.not. status%failed()) call make_map(group, s, scales, tile, surface, status)
      end if
      if (status%failed()) return
      call surfaces%add(group, surface, amplitude_over_film, body)
   end subroutine add_surface

   !> Make a single feature
   subroutine make_feature(group, s, is_line, scales, surface, amplitude_over_film, status)
      character(len=*), intent(in) :: group
      type(surface_case_t), intent(in) :: s
      logical, intent(in) :: is_line
      type(scales_t), intent(in) :: scales
      class(surface_t), allocatable, intent(out) :: surface
      real(dp), intent(out) :: amplitude_over_film
      type(status_t), intent(inout) :: status
      type(feature_t) :: feature
      real(dp) :: amplitude, size(2)

      amplitude = s%amplitude
      size = [s%width, s%length]
      if (s%width_m > 0.0_dp) size(1) = s%width_m/scales%length
      if (s%length_m > 0.0_dp) size(2) = s%length_m/scales%length
      if (s%height_m > 0.0_dp) amplitude = s%height_m/scales%film
      amplitude_over_film = merge(0.0_dp, s%amplitude_over_film, s%amplitude_given .or. s%height_m > 0.0_dp)
      feature = new_feature(s%kind == "bump" .or. s%kind == "ridge", s%kind == "ridge" .or. s%kind == "groove", amplitude, &
                            size(1), size(2), s%angle, s%y_start, s%velocity_ratio, s%x_start)
      if (.not. feature%at_rest() .and. .not. feature%reach < huge(1.0_dp)) then
         call status%fail(ehl_bad_input, group//".kind = '"//trim(s%kind)//"' without ends along the motion never leaves "// &
                          "the contact"//new_line("a")//"expected: a length, another angle, or a velocity_ratio of 0")
         return
      end if
      if (is_line) call repeat_feature(group, s, feature, status)
      if (status%failed()) return
      allocate (surface, source=feature)
   end subroutine make_feature

   !> Repeat a feature along Y on a strip
   subroutine repeat_feature(group, s, feature, status)
      character(len=*), intent(in) :: group
      type(surface_case_t), intent(in) :: s
      type(feature_t), intent(inout) :: feature
      type(status_t), intent(inout) :: status

      if (.not. feature%size_y() > 0.0_dp .and. .not. feature%is_endless_across()) then
         call status%fail(ehl_bad_input, group//".kind = '"//trim(s%kind)//"': without ends at an angle it does not repeat "// &
                          "along a line"//new_line("a")//"expected: a length, or an angle of 0, 90 or 180")
         return
      end if
      call feature%repeat_along_y(s%spacing_y)
      if (feature%period_y < feature%size_y()) call status%fail(ehl_bad_input, group//".spacing_y = "// &
         short(s%spacing_y)//": the "//trim(s%kind)//" takes up "//short(feature%size_y())//" b along the line"// &
         new_line("a")//"expected: more than that, or 0")
   end subroutine repeat_feature

   !> Refuse a map that pyehl has to prepare, or whose size is not given
   subroutine check_map(group, s, status)
      character(len=*), intent(in) :: group
      type(surface_case_t), intent(in) :: s
      type(status_t), intent(inout) :: status
      character(len=:), allocatable :: why, what

      call map_needs(group, s, why)
      what = trim(s%file)
      if (s%kind == "fractal") what = group//".kind = 'fractal'"
      if (why /= "") then
         call status%fail(ehl_bad_input, what//": error: the surface has to be prepared by pyehl: "//why//new_line("a")// &
                          "expected: 'pyehl run' in place of 'ehl'; or the tile that 'pyehl surface CASE.nml -o prepared.npy' "// &
                          "writes, with the case prepared.npy.nml beside it")
      else if (s%length_x <= 0.0_dp .or. s%length_y <= 0.0_dp) then
         call status%fail(ehl_bad_input, what//": error: the size of the map is not known"//new_line("a")// &
                          "expected: "//group//".length_x and length_y [m]")
      end if
   end subroutine check_map

   !> Why pyehl has to prepare a map, for a message; empty if the solver can read it
   subroutine map_needs(group, s, why)
      character(len=*), intent(in) :: group
      type(surface_case_t), intent(in) :: s
      character(len=:), allocatable, intent(out) :: why
      real(dp) :: cropped

      why = ""
      if (s%kind /= "map") then
         if (abs(s%track) > 0.0_dp) why = group//".track"
         return
      end if
      cropped = abs(s%crop_x_min) + abs(s%crop_x_max) + abs(s%crop_y_min) + abs(s%crop_y_max)
      if (s%detrend /= "auto" .and. s%detrend /= "none") then
         why = group//".detrend = '"//trim(s%detrend)//"'"
      else if (s%edges /= "auto" .and. s%edges /= "periodic") then
         why = group//".edges = '"//trim(s%edges)//"'"
      else if (cropped > 0.0_dp) then
         why = group//".crop_x_min, crop_x_max, crop_y_min or crop_y_max"
      else if (s%outliers > 0.0_dp) then
         why = group//".outliers"
      else if (s%align_lines /= "none") then
         why = group//".align_lines"
      else if (s%profile /= "none") then
         why = group//".profile"
      else if (abs(s%rotate) > 0.0_dp) then
         why = group//".rotate"
      else if (s%sign /= 1) then
         why = group//".sign"
      else if (s%height_unit /= "m") then
         why = group//".height_unit"
      else if (s%lateral_unit /= "same") then
         why = group//".lateral_unit"
      else if (abs(s%track) > 0.0_dp) then
         why = group//".track"
      else if (index(s%file, ".npy", back=.true.) /= len_trim(s%file) - 3) then
         why = "it is not a .npy array"
      end if
   end subroutine map_needs

   !> Make a surface from a tile of heights [m]
   subroutine make_map(group, s, scales, heights, surface, status)
      character(len=*), intent(in) :: group
      type(surface_case_t), intent(in) :: s
      type(scales_t), intent(in) :: scales
      real(dp), intent(in) :: heights(:, :)
      class(surface_t), allocatable, intent(out) :: surface
      type(status_t), intent(inout) :: status
      type(height_map_t), allocatable :: placed
      type(filter_t) :: filter
      real(dp) :: length(2)
      logical :: made

      made = s%tile_x > 0.0_dp .and. s%tile_y > 0.0_dp
      length = merge([s%tile_x, s%tile_y], [s%length_x, s%length_y], made)/scales%length
      filter = filter_t(s%shortest_wavelength/scales%length, s%longest_wavelength/scales%length, &
                        s%filter == "gaussian")
      allocate (placed)
      placed%velocity_ratio = s%velocity_ratio
      placed%x_start = s%x_start
      call placed%setup(heights, 1.0_dp/scales%film, length, made .and. s%tile_mirrored, filter, map_front, status)
      if (status%failed()) return
      if (placed%variance_whole > 0.0_dp .and. .not. placed%variance > 1.0e-24_dp*placed%variance_whole) then
         call status%fail(ehl_bad_input, group//".shortest_wavelength and longest_wavelength remove all waves of "// &
                          "the surface"//new_line("a")//"expected: wavelengths [m] with waves of the surface between them")
         return
      end if
      call move_alloc(placed, surface)
   end subroutine make_map

   !> Heights of a fractal surface [m], X first
   subroutine generate(group, s, tile, status)
      character(len=*), intent(in) :: group
      type(surface_case_t), intent(in) :: s
      real(dp), allocatable, intent(out) :: tile(:, :)
      type(status_t), intent(inout) :: status
      type(fractal_t) :: what
      real(dp), allocatable :: rows(:, :)
      integer :: stat

      call check_heights(group//".pixels = "//to_text(s%pixels), [s%pixels, s%pixels], status)
      if (status%failed()) return
      what = fractal_t(s%length_x, s%length_y, s%rms_height, s%hurst, s%rolloff_wavenumber, [int(s%seed, int32)], &
                       s%modulus == "gaussian", s%lay_ratio)
      allocate (rows(s%pixels, s%pixels), stat=stat)
      if (stat /= 0) call status%fail(ehl_no_memory, "no memory for a fractal surface")
      if (.not. status%failed()) call make_fractal(what, rows, status)
      if (.not. status%failed()) tile = transpose(rows)
   end subroutine generate

   !> Refuse surfaces of which a grid resolves nothing
   subroutine check_resolved(surfaces, grid, status)
      type(moving_surfaces_t), intent(in) :: surfaces
      type(grid_t), intent(in) :: grid
      type(status_t), intent(inout) :: status

      if (status%failed()) return
      if (surfaces%max_unresolved(grid, aliased_below) < 1.0_dp) return
      call status%fail(ehl_bad_input, "all waves of the surface are shorter than two mesh sizes of the grid of "// &
                       to_text(grid%nx)//" x "//to_text(grid%full_ny())//" nodes, in space or in the time steps: it resolves "// &
                       "none of them"//new_line("a")//"expected: a finer grid (grid.points), or longer waves")
   end subroutine check_resolved
end module ehl_plan_surface

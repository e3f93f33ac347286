! SPDX-License-Identifier: BSD-3-Clause
!> The two surfaces of a case: defaults that depend on other keys, and what each kind needs
module ehl_case_surface
   use ehl_case, only: case_t, is_feature, surface_case_t, word_length
   use ehl_case_feature, only: check_arrival, check_feature, late_start
   use ehl_files, only: file_exists, is_file
   use ehl_kinds, only: dp, pi
   use ehl_schema, only: schema_t
   use ehl_status, only: status_t
   use ehl_text, only: short
   implicit none (type, external)
   private
   public :: complete_surfaces, check_surfaces

   !> Size of the tile of Table 1 of Zhang et al. 2019 [m]
   real(dp), parameter :: fractal_length = 8.29e-4_dp

   !> Rq over Ra of normal heights
   real(dp), parameter :: rq_over_ra = sqrt(0.5_dp*pi)

   !> Typical values of a finish
   type :: finish_t
      character(len=word_length) :: name = ""
      real(dp) :: ra = 0.0_dp, hurst = 0.0_dp, rolloff = 0.0_dp, lay_ratio = 1.0_dp
   end type finish_t
   !> Ra within the ranges of ASME B46.1; spectra of ground surfaces fall with the second power of the wavenumber
   !> (Whitehouse & Archard 1970), of finer ones faster (Persson et al. 2005). Lengths and lay are assumptions.
   type(finish_t), parameter :: finishes(4) = [finish_t("ground", 0.4e-6_dp, 0.5_dp, 100.0e-6_dp, 0.1_dp), &
                                               finish_t("honed", 0.2e-6_dp, 0.7_dp, 60.0e-6_dp, 5.0_dp), &
                                               finish_t("superfinished", 0.05e-6_dp, 0.8_dp, 40.0e-6_dp, 3.0_dp), &
                                               finish_t("polished", 0.01e-6_dp, 0.8_dp, 50.0e-6_dp, 1.0_dp)]

contains

   !> Defaults of both that depend on other keys
   subroutine complete_surfaces(schema, input)
      type(schema_t), intent(in) :: schema
      type(case_t), intent(inout) :: input

      call complete_pattern(schema, "surface", input%grid%x_inlet, input%surface)
      call complete_pattern(schema, "second_surface", input%grid%x_inlet, input%second_surface)
      ! two fractal surfaces of one seed are the same surface, whose waves add up
      if (input%surface%kind == "fractal" .and. input%second_surface%kind == "fractal" &
          .and. .not. schema%given("second_surface", "seed")) then
         input%second_surface%seed = input%surface%seed + merge(1, -1, input%surface%seed < huge(1))
      end if
      if (.not. schema%given("surface", "x_start")) call late_start(input%surface, input%second_surface)
      if (.not. schema%given("second_surface", "x_start")) call late_start(input%second_surface, input%surface)
   end subroutine complete_surfaces

   !> What the kinds of both need
   subroutine check_surfaces(schema, input, status)
      type(schema_t), intent(in) :: schema
      type(case_t), intent(inout) :: input
      type(status_t), intent(inout) :: status

      associate (si => input%contact%si)
         call check_surface(schema, "surface", input%surface, si, status)
         if (.not. status%failed()) call check_surface(schema, "second_surface", input%second_surface, si, status)
      end associate
      call check_arrival(schema, "surface", input%surface, input%second_surface, status)
      call check_arrival(schema, "second_surface", input%second_surface, input%surface, status)
   end subroutine check_surfaces

   !> What a finish stands for: typical Ra [m], Hurst exponent, wavelength of the roll-off [m], ratio of the lay
   subroutine complete_finish(schema, group, s)
      type(schema_t), intent(in) :: schema
      character(len=*), intent(in) :: group
      type(surface_case_t), intent(inout) :: s
      type(finish_t) :: what

      if (s%finish /= "none") then
         what = finishes(findloc(finishes%name, s%finish, dim=1))
         if (.not. schema%given(group, "kind")) s%kind = "fractal"
         if (s%kind /= "fractal") return
         if (.not. schema%given(group, "hurst")) s%hurst = what%hurst
         if (.not. schema%given(group, "rolloff_wavenumber")) s%rolloff_wavenumber = 2.0_dp*pi/what%rolloff
         if (.not. schema%given(group, "lay_ratio")) s%lay_ratio = what%lay_ratio
         if (.not. schema%given(group, "rms_height")) s%rms_height = rq_over_ra*what%ra
      end if
      if (schema%given(group, "rms_height")) return
      if (s%ra > 0.0_dp) s%rms_height = rq_over_ra*s%ra
      if (s%rq > 0.0_dp) s%rms_height = s%rq
   end subroutine complete_finish

   !> Defaults of one that depend on other keys
   subroutine complete_pattern(schema, group, x_inlet, s)
      type(schema_t), intent(in) :: schema
      character(len=*), intent(in) :: group
      real(dp), intent(in) :: x_inlet
      type(surface_case_t), intent(inout) :: s

      call complete_finish(schema, group, s)
      if (s%kind == "fractal") then
         if (.not. s%length_x > 0.0_dp) s%length_x = fractal_length
         if (.not. s%length_y > 0.0_dp) s%length_y = fractal_length
      end if
      if (.not. schema%given(group, "wavelength_x")) s%wavelength_x = s%wavelength
      if (.not. schema%given(group, "wavelength_y")) s%wavelength_y = s%wavelength
      if (.not. schema%given(group, "x_start")) s%x_start = x_inlet
      s%amplitude_given = schema%given(group, "amplitude")
   end subroutine complete_pattern

   !> What the kinds of surfaces need
   subroutine check_surface(schema, group, s, si, status)
      type(schema_t), intent(in) :: schema
      character(len=*), intent(in) :: group
      type(surface_case_t), intent(inout) :: s
      !> Whether the contact is given in SI units
      logical, intent(in) :: si
      type(status_t), intent(inout) :: status

      if (s%amplitude_given .and. schema%given(group, "amplitude_over_film")) then
         call schema%contradict(group//".amplitude", group//".amplitude_over_film", "one of the two", status)
         return
      end if
      call check_height(schema, group, s, status)
      if (status%failed()) return
      call check_feature(schema, group, s, si, status)
      if (.not. status%failed()) call check_filter(schema, group, s, status)
      if (.not. status%failed()) call check_map(schema, group, s, status)
   end subroutine check_surface

   !> One height alone, and that of a fractal surface
   subroutine check_height(schema, group, s, status)
      type(schema_t), intent(in) :: schema
      character(len=*), intent(in) :: group
      type(surface_case_t), intent(in) :: s
      type(status_t), intent(inout) :: status
      character(len=10), parameter :: names(3) = [character(len=10) :: "rms_height", "ra", "rq"]
      logical :: has(3)
      integer :: both(2)

      has = [schema%given(group, "rms_height"), s%ra > 0.0_dp, s%rq > 0.0_dp]
      if (count(has) > 1) then
         both = [findloc(has, .true., dim=1), findloc(has, .true., dim=1, back=.true.)]
         call schema%contradict(group//"."//trim(names(both(1))), group//"."//trim(names(both(2))), "one of the two", status)
      else if (any(has(2:)) .and. s%kind /= "fractal") then
         both(1) = findloc(has, .true., dim=1)
         call schema%refuse(group//"."//trim(names(both(1))), group//"."//trim(names(both(1)))//" beside "//group//".kind = '"// &
                            trim(s%kind)//"'", group//".kind = 'fractal', or "//group//".finish", status)
      else if (s%finish /= "none" .and. s%kind /= "fractal") then
         call schema%refuse(group//".finish", group//".finish beside "//group//".kind = '"//trim(s%kind)//"'", &
                            group//".kind = 'fractal', or no kind", status)
      end if
   end subroutine check_height

   !> A single wave or feature has no spectrum to cut, and something must be left of others
   subroutine check_filter(schema, group, s, status)
      type(schema_t), intent(in) :: schema
      character(len=*), intent(in) :: group
      type(surface_case_t), intent(in) :: s
      type(status_t), intent(inout) :: status
      character(len=20), parameter :: names(2) = [character(len=20) :: "shortest_wavelength", "longest_wavelength"]
      character(len=:), allocatable :: name, why
      real(dp) :: limits(2)
      integer :: k

      limits = [s%shortest_wavelength, s%longest_wavelength]
      do k = 1, 2
         if (.not. limits(k) > 0.0_dp) cycle
         if (is_feature(s%kind)) then
            why = "a "//trim(s%kind)//" has a closed form"
         else if (s%kind == "harmonic") then
            why = "a harmonic surface is a single wave"
         else
            cycle
         end if
         name = group//"."//trim(names(k))
         call schema%refuse(name, name//": "//why//", there is no spectrum to cut", &
                            "0, or "//group//".kind = 'map' or 'fractal'", status)
         return
      end do
      if (.not. limits(2) > 0.0_dp .or. limits(1) < limits(2)) return
      call schema%refuse(group//".longest_wavelength", group//".longest_wavelength = "// &
                         short(limits(2))//" m is not longer than "//group//".shortest_wavelength = "//short(limits(1))//" m", &
                         "a longest wavelength above the shortest one, or 0", status)
   end subroutine check_filter

   !> Keys of a map that do not go together; the name of its file made absolute, which must be there when it is used
   subroutine check_map(schema, group, s, status)
      type(schema_t), intent(in) :: schema
      character(len=*), intent(in) :: group
      type(surface_case_t), intent(inout) :: s
      type(status_t), intent(inout) :: status
      character(len=*), parameter :: height_map = "a height map: .npy, text or a file of an instrument"

      if (s%kind == "map" .and. s%file%text() == "") then
         call schema%refuse(group//".kind", group//".kind = 'map' without "//group//".file", "file = '...', "//height_map, status)
      else if (s%sign == 0) then
         call schema%refuse(group//".sign", group//".sign = 0", "1 or -1", status)
      else if (s%crop_x_max > 0.0_dp .and. s%crop_x_max <= s%crop_x_min) then
         call schema%refuse(group//".crop_x_max", group//".crop_x_max is not beyond crop_x_min", &
                            "a larger value [m], or 0 for the end of the map", status)
      else if (s%crop_y_max > 0.0_dp .and. s%crop_y_max <= s%crop_y_min) then
         call schema%refuse(group//".crop_y_max", group//".crop_y_max is not beyond crop_y_min", &
                            "a larger value [m], or 0 for the end of the map", status)
      else if (s%file%text() /= "") then
         call schema%find_file(group//".file", s%file, status)
         if (status%failed() .or. s%kind /= "map") return
         if (.not. file_exists(s%file%text())) then
            ! the heights of a tile that pyehl has made come from it, or are kept beside the results
            if (.not. s%tile_x > 0.0_dp) call schema%refuse(group//".file", group//".file: there is no file "//s%file%text(), &
                                                            height_map, status)
         else if (.not. is_file(s%file%text())) then
            call schema%refuse(group//".file", group//".file: "//s%file%text()//" is a folder, a device or a pipe", height_map, &
                               status)
         end if
      end if
   end subroutine check_map
end module ehl_case_surface

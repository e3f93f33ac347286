! SPDX-License-Identifier: BSD-3-Clause
!> Checks of the surfaces of a complete case
module ehl_case_check_surface
   use ehl_case, only: case_t, contact_case_t, is_feature, surface_case_t
   use ehl_case_defaults, only: latest_start, must_wait
   use ehl_case_source, only: case_source_t
   use ehl_files, only: file_exists, is_file
   use ehl_kinds, only: dp
   use ehl_status, only: status_t
   use ehl_surface, only: x_matters
   use ehl_text, only: short
   implicit none (type, external)
   private
   public :: check_surfaces

contains

   !> Check both surfaces
   subroutine check_surfaces(source, input, status)
      type(case_source_t), intent(in) :: source
      type(case_t), intent(in) :: input
      type(status_t), intent(inout) :: status

      call check_surface(source, "surface", input%contact, input%surface, input%second_surface, status)
      call check_surface(source, "second_surface", input%contact, input%second_surface, input%surface, status)
   end subroutine check_surfaces

   !> Check a surface; `other` is the other surface
   subroutine check_surface(source, group, contact, s, other, status)
      type(case_source_t), intent(in) :: source
      character(len=*), intent(in) :: group
      type(contact_case_t), intent(in) :: contact
      type(surface_case_t), intent(in) :: s, other
      type(status_t), intent(inout) :: status
      logical :: feature

      feature = is_feature(s%kind)
      call exclude("amplitude", "amplitude_over_film", source%given(group//".amplitude"))
      if (feature) then
         call exclude("height_m", "amplitude", s%height_m > 0.0_dp)
         call exclude("height_m", "amplitude_over_film", s%height_m > 0.0_dp)
         call exclude("width_m", "width", s%width_m > 0.0_dp)
         call exclude("length_m", "length", s%length_m > 0.0_dp)
         call refuse(.not. contact%si .and. max(s%height_m, s%width_m, s%length_m) > 0.0_dp, "kind", &
                     "sizes in metres with a contact given by Moes numbers", &
                     "amplitude, width and length, or a contact in SI units")
         call refuse(s%velocity_ratio > 0.0_dp .and. s%x_start > x_matters, "x_start", &
                     "a "//trim(s%kind)//" would begin inside the contact", &
                     "at most "//short(x_matters)//", where its front end is at time 0")
      end if
      call refuse(s%spacing_y > 0.0_dp .and. .not. (feature .and. contact%is_line()), "spacing_y", &
                  "no single feature repeats along Y", "0, or a single feature on a line contact")
      call refuse((feature .or. s%kind == "harmonic") .and. s%shortest_wavelength > 0.0_dp, "shortest_wavelength", &
                  "there is no spectrum to cut", "0")
      call refuse((feature .or. s%kind == "harmonic") .and. s%longest_wavelength > 0.0_dp, "longest_wavelength", &
                  "there is no spectrum to cut", "0")
      call refuse(s%crop_x_max > 0.0_dp .and. s%crop_x_max <= s%crop_x_min, "crop_x_max", "is not beyond crop_x_min", &
                  "a larger one, or 0")
      call refuse(s%crop_y_max > 0.0_dp .and. s%crop_y_max <= s%crop_y_min, "crop_y_max", "is not beyond crop_y_min", &
                  "a larger one, or 0")
      call refuse(s%longest_wavelength > 0.0_dp .and. s%shortest_wavelength >= s%longest_wavelength, "longest_wavelength", &
                  "not longer than shortest_wavelength", "a longest wavelength above the shortest one, or 0")
      call refuse(s%kind == "map" .and. trim(s%file) == "", "kind", "'map' without file", "file = '...'")
      call refuse(s%sign == 0, "sign", "0", "1 or -1")
      ! the heights of a tile made by pyehl come from Python or from the checkpoint folder
      if (s%kind == "map" .and. trim(s%file) /= "" .and. .not. s%tile_x > 0.0_dp) call refuse(.not. is_file(trim(s%file)), &
         "file", "there is no file "//trim(s%file), "a height map: .npy, text or a file of an instrument")
      if (status%failed() .or. .not. must_wait(s, other)) return
      call refuse(s%x_start > latest_start(s, other), "x_start", "the "//trim(s%kind)//" would enter before the roughness of "// &
                  "the other surface fills the contact", "at most "//short(latest_start(s, other)))

   contains

      !> Refuse the value of a key of the group on a condition
      subroutine refuse(condition, key, what, expected)
         logical, intent(in) :: condition
         character(len=*), intent(in) :: key, what, expected
         if (condition) call source%refuse(group//"."//key, group//"."//key//": "//what, expected, status)
      end subroutine refuse

      !> Refuse two keys for the same size
      subroutine exclude(one, rival, has_one)
         character(len=*), intent(in) :: one, rival
         logical, intent(in) :: has_one
         if (has_one .and. source%given(group//"."//rival)) then
            call source%contradict(group//"."//one, group//"."//rival, "one of the two", status)
         end if
      end subroutine exclude
   end subroutine check_surface
end module ehl_case_check_surface

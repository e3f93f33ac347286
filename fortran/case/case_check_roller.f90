! SPDX-License-Identifier: BSD-3-Clause
!> Checks of the keys of a roller
module ehl_case_check_roller
   use ehl_case, only: case_t, has_no_height
   use ehl_case_source, only: case_source_t
   use ehl_kinds, only: dp
   use ehl_roller, only: body_profile_t, profile_t
   use ehl_scales, only: scales_t
   use ehl_status, only: status_t
   use ehl_text, only: short
   implicit none (type, external)
   private
   public :: check_length, check_roller

   character(len=*), parameter :: shape = "contact.shape = 'roller'"
   character(len=16), parameter :: roller_keys(18) = [character(len=16) :: "length", "profile", "crown_radius", "log_amplitude", &
      "chamfer_length", "chamfer_drop", "profile_file", "profile_y", "profile_drop", "misalignment", "profile_2", &
      "crown_radius_2", "log_amplitude_2", "chamfer_length_2", "chamfer_drop_2", "profile_file_2", "profile_y_2", &
      "profile_drop_2"]
   !> Suffixes of the keys of each body
   character(len=2), parameter :: of_body(2) = ["  ", "_2"]
   character(len=15), parameter :: other_keys(9) = [character(len=15) :: "moes_m", "moes_l", "radius_ratio", "radius_x", &
      "radius_y", "angle", "load_per_length", "moes_m_line", "moes_l_line"]
   !> Values of contact.profile, each with a required key
   character(len=14), parameter :: of_profile(2, 6) = reshape([character(len=14) :: "crown", "crown_radius", &
      "logarithmic", "log_amplitude", "chamfer", "chamfer_length", "chamfer", "chamfer_drop", &
      "file", "profile_y", "file", "profile_drop"], [2, 6])
   !> Maximum drop of a profile over the radius
   real(dp), parameter :: max_drop = 0.1_dp
   !> Minimum and maximum length of a roller over b
   real(dp), parameter :: min_length = 4.0_dp, max_length = 400.0_dp

contains

   !> Checks before the defaults are set
   subroutine check_roller(source, input, status)
      type(case_source_t), intent(in) :: source
      type(case_t), intent(in) :: input
      type(status_t), intent(inout) :: status
      character(len=:), allocatable :: key

      if (status%failed()) return
      if (.not. input%contact%is_roller()) then
         key = source%first_given("contact", roller_keys)
         if (key /= "") call source%refuse(key, key//" without "//shape, shape, status)
         return
      end if
      key = source%first_given("contact", other_keys)
      if (key /= "") call source%refuse(key, key//" with "//shape, "load, radius, length and the keys of a profile", status)
      if (.not. input%contact%length > 0.0_dp) call source%refuse("contact.length", shape//" without contact.length", &
                                                                  "the length of the roller [m]", status)
      call check_profile(source, input, status)
      call require("surface.kind", has_no_height(input%surface), "'smooth' surfaces")
      call require("second_surface.kind", has_no_height(input%second_surface), "'smooth' surfaces")
      call require("inlet.position", .not. max(input%inlet%position, input%inlet%position_hertz, input%inlet%film, &
                                                    input%inlet%film_hertz) > 0.0_dp, "a flooded inlet")
      call require("lubricant.boundary_film", .not. input%lubricant%boundary_film > 0.0_dp, "a full film")
      call require("grid.border", .not. (source%given("grid.border") .and. input%grid%border == "flooded"), &
                        "'zero': the flow around the ends beyond the border is not known; the default domain is so long "// &
                        "that P = 0 there has a small error")
      call require("grid.y_extent", .not. source%given("grid.y_extent"), "none: half the length")
      call require("solver.coarsening", input%solver%coarsening /= "alcouffe", "'auto' or 'classical'")

   contains

      subroutine require(name, fulfilled, expected)
         character(len=*), intent(in) :: name, expected
         logical, intent(in) :: fulfilled
         if (.not. fulfilled) call source%refuse(name, name//" with "//shape, expected, status)
      end subroutine require
   end subroutine check_roller

   !> The length must be that of a line contact, at least `min_length` b, and short enough for a grid, at most `max_length` b
   subroutine check_length(source, input, scales, status)
      type(case_source_t), intent(in) :: source
      type(case_t), intent(in) :: input
      type(scales_t), intent(in) :: scales
      type(status_t), intent(inout) :: status

      if (status%failed() .or. .not. input%contact%is_roller()) return
      associate (over_b => input%contact%length/scales%length)
         if (over_b >= min_length .and. over_b <= max_length) return
         call source%refuse("contact.length", "contact.length is "//short(over_b)//" b, b = "//short(scales%length)//" m", &
                            "4 to 400 b: longer ones are lines, contact.shape = 'line', except at their ends; "// &
                            "shorter ones are points", status)
      end associate
   end subroutine check_length

   !> Each body needs all keys of its profile and no others; their total drop is limited
   subroutine check_profile(source, input, status)
      type(case_source_t), intent(in) :: source
      type(case_t), intent(in) :: input
      type(status_t), intent(inout) :: status
      type(profile_t) :: profile
      real(dp) :: drop
      integer :: body

      do body = 1, 2
         call check_body(source, input%contact%profiles(body), trim(of_body(body)), input%contact%length, status)
      end do
      if (status%failed()) return
      associate (c => input%contact)
         profile = c%body_profile()
         drop = max(profile%drop(0.5_dp*c%length), profile%drop(-0.5_dp*c%length))
         do body = 1, 2
            if (profile%of(body)%kind == "file") drop = max(drop, maxval(abs(profile%of(body)%table)))
         end do
         drop = drop + 0.5_dp*abs(c%misalignment)*c%length
         if (drop > max_drop*max(c%radius, c%radius_x)) call source%refuse("contact.profile", "the profile drops by "// &
            short(drop)//" m at the end of the roller, misalignment included", "a tenth of the radius at most", status)
      end associate
   end subroutine check_profile

   !> Check the keys of one body, whose names end with `ending`
   subroutine check_body(source, one, ending, length, status)
      type(case_source_t), intent(in) :: source
      type(body_profile_t), intent(in) :: one
      character(len=*), intent(in) :: ending
      !> Length of the roller [m]
      real(dp), intent(in) :: length
      type(status_t), intent(inout) :: status
      character(len=:), allocatable :: key, profile
      logical :: has(size(of_profile, 2))
      integer :: k

      if (status%failed()) return
      profile = "contact.profile"//ending
      has = [one%crown_radius > 0.0_dp, one%log_amplitude > 0.0_dp, one%chamfer_length > 0.0_dp, one%chamfer_drop > 0.0_dp, &
             .false., .false.]
      if (allocated(one%y)) has(5) = size(one%y) > 0
      if (allocated(one%table)) has(6) = size(one%table) > 0
      do k = 1, size(has)
         key = "contact."//trim(of_profile(2, k))//ending
         if (one%kind == of_profile(1, k) .and. .not. has(k)) then
            call source%refuse(profile, profile//" = '"//trim(one%kind)//"' without "//key, key, status)
         else if (one%kind /= of_profile(1, k) .and. source%given(key)) then
            call source%refuse(key, key//" with "//profile//" = '"//trim(one%kind)//"'", &
                               profile//" = '"//trim(of_profile(1, k))//"'", status)
         end if
      end do
      if (status%failed()) return
      key = "contact.chamfer_length"//ending
      if (one%chamfer_length > 0.5_dp*length) call source%refuse(key, key//" is more than half of contact.length", &
                                                                 "at most "//short(0.5_dp*length)//" m", status)
      if (one%kind == "file") call check_table(source, one, ending, length, status)
   end subroutine check_body

   !> A table needs a drop at each position, and positions that increase and cover the roller
   subroutine check_table(source, one, ending, length, status)
      type(case_source_t), intent(in) :: source
      type(body_profile_t), intent(in) :: one
      character(len=*), intent(in) :: ending
      real(dp), intent(in) :: length
      type(status_t), intent(inout) :: status
      logical :: valid

      valid = size(one%y) >= 2 .and. size(one%y) == size(one%table)
      if (valid) valid = all(one%y(2:) > one%y(:size(one%y) - 1))
      ! rounding errors of the ends are allowed
      if (valid) valid = one%y(1) <= -0.499999_dp*length .and. one%y(size(one%y)) >= 0.499999_dp*length
      if (.not. valid) call source%refuse("contact.profile_y"//ending, "contact.profile_y"//ending// &
                                         " does not cover the roller", &
                                         "positions that increase from -length/2 to length/2 [m], with a drop each", status)
   end subroutine check_table
end module ehl_case_check_roller

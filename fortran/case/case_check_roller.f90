! SPDX-License-Identifier: BSD-3-Clause
!> Keys of a roller: which belong together, and what a roller does not have
module ehl_case_check_roller
   use ehl_case, only: case_t, has_no_height
   use ehl_case_source, only: case_source_t
   use ehl_kinds, only: dp
   use ehl_roller, only: profile_t
   use ehl_scales, only: scales_t
   use ehl_status, only: status_t
   use ehl_text, only: short
   implicit none (type, external)
   private
   public :: check_length, check_roller

   character(len=*), parameter :: shape = "contact.shape = 'roller'"
   character(len=14), parameter :: roller_keys(10) = [character(len=14) :: "length", "profile", "crown_radius", "log_amplitude", &
      "chamfer_length", "chamfer_drop", "profile_file", "profile_y", "profile_drop", "misalignment"]
   character(len=15), parameter :: other_keys(9) = [character(len=15) :: "moes_m", "moes_l", "radius_ratio", "radius_x", &
      "radius_y", "angle", "load_per_length", "moes_m_line", "moes_l_line"]
   !> Keys of the profiles, each with its word
   character(len=14), parameter :: of_profile(2, 6) = reshape([character(len=14) :: "crown", "crown_radius", &
      "logarithmic", "log_amplitude", "chamfer", "chamfer_length", "chamfer", "chamfer_drop", &
      "file", "profile_y", "file", "profile_drop"], [2, 6])
   !> Largest drop of a profile over the radius
   real(dp), parameter :: deepest = 0.1_dp
   !> Lengths of a roller over b
   real(dp), parameter :: shortest = 4.0_dp, longest = 400.0_dp

contains

   !> Before a case is complete
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
      call smooth_alone("surface.kind", has_no_height(input%surface), "'smooth' surfaces")
      call smooth_alone("second_surface.kind", has_no_height(input%second_surface), "'smooth' surfaces")
      call smooth_alone("duty.time", .not. input%duty%active(), "a contact in steady motion")
      call smooth_alone("inlet.position", .not. max(input%inlet%position, input%inlet%position_hertz, input%inlet%film, &
                                                    input%inlet%film_hertz) > 0.0_dp, "a flooded inlet")
      call smooth_alone("lubricant.boundary_film", .not. input%lubricant%boundary_film > 0.0_dp, "a full film")
      call smooth_alone("grid.border", .not. (source%given("grid.border") .and. input%grid%border == "flooded"), "'zero'")
      call smooth_alone("grid.y_extent", .not. source%given("grid.y_extent"), "none: half the length")
      call smooth_alone("solver.coarsening", input%solver%coarsening /= "alcouffe", "'auto' or 'classical'")

   contains

      subroutine smooth_alone(name, good, expected)
         character(len=*), intent(in) :: name, expected
         logical, intent(in) :: good
         if (.not. good) call source%refuse(name, name//" with "//shape, expected, status)
      end subroutine smooth_alone
   end subroutine check_roller

   !> No shorter than a line contact is, no longer than a grid of it may be
   subroutine check_length(source, input, scales, status)
      type(case_source_t), intent(in) :: source
      type(case_t), intent(in) :: input
      type(scales_t), intent(in) :: scales
      type(status_t), intent(inout) :: status

      if (status%failed() .or. .not. input%contact%is_roller()) return
      associate (over_b => input%contact%length/scales%length)
         if (over_b >= shortest .and. over_b <= longest) return
         call source%refuse("contact.length", "contact.length is "//short(over_b)//" b, b = "//short(scales%length)//" m", &
                            "4 to 400 b: longer ones are lines, contact.shape = 'line', but for their ends; shorter ones points", &
                            status)
      end associate
   end subroutine check_length

   !> The keys of the profile alone, and all of them
   subroutine check_profile(source, input, status)
      type(case_source_t), intent(in) :: source
      type(case_t), intent(in) :: input
      type(status_t), intent(inout) :: status
      type(profile_t) :: profile
      character(len=:), allocatable :: key
      real(dp) :: drop
      logical :: has(size(of_profile, 2))
      integer :: k

      if (status%failed()) return
      associate (c => input%contact)
         has = [c%crown_radius > 0.0_dp, c%log_amplitude > 0.0_dp, c%chamfer_length > 0.0_dp, c%chamfer_drop > 0.0_dp, &
                .false., .false.]
         if (allocated(c%profile_y)) has(5) = size(c%profile_y) > 0
         if (allocated(c%profile_drop)) has(6) = size(c%profile_drop) > 0
         do k = 1, size(has)
            key = "contact."//trim(of_profile(2, k))
            if (c%profile == of_profile(1, k) .and. .not. has(k)) then
               call source%refuse("contact.profile", "contact.profile = '"//trim(c%profile)//"' without "//key, key, status)
            else if (c%profile /= of_profile(1, k) .and. source%given(key)) then
               call source%refuse(key, key//" with contact.profile = '"//trim(c%profile)//"'", &
                                  "contact.profile = '"//trim(of_profile(1, k))//"'", status)
            end if
         end do
         if (status%failed()) return
         if (c%chamfer_length > 0.5_dp*c%length) call source%refuse("contact.chamfer_length", &
            "contact.chamfer_length is more than half of contact.length", "at most "//short(0.5_dp*c%length)//" m", status)
         profile = c%body_profile()
         if (c%profile == "file") call check_table(source, profile, status)
         if (status%failed()) return
         drop = max(profile%drop(0.5_dp*c%length), profile%drop(-0.5_dp*c%length))
         if (c%profile == "file") drop = maxval(abs(profile%table))
         drop = drop + 0.5_dp*abs(c%misalignment)*c%length
         if (drop > deepest*max(c%radius, c%radius_x)) call source%refuse("contact.profile", "the profile drops by "// &
            short(drop)//" m at the end of the roller, misalignment included", "a tenth of the radius at most", status)
      end associate
   end subroutine check_profile

   !> As many drops as places, which rise and cover the roller
   subroutine check_table(source, profile, status)
      type(case_source_t), intent(in) :: source
      type(profile_t), intent(in) :: profile
      type(status_t), intent(inout) :: status
      logical :: good

      good = size(profile%y) >= 2 .and. size(profile%y) == size(profile%table)
      if (good) good = all(profile%y(2:) > profile%y(:size(profile%y) - 1))
      ! a rounding of the ends is none
      if (good) good = profile%y(1) <= -0.499999_dp*profile%length .and. &
                       profile%y(size(profile%y)) >= 0.499999_dp*profile%length
      if (.not. good) call source%refuse("contact.profile_y", "contact.profile_y does not cover the roller", &
                                         "places that rise from -length/2 to length/2 [m], a drop for each", status)
   end subroutine check_table
end module ehl_case_check_roller

! SPDX-License-Identifier: BSD-3-Clause
!> Keys of a single feature that do not go together
module ehl_case_feature
   use ehl_case, only: has_no_height, is_feature, surface_case_t
   use ehl_kinds, only: dp
   use ehl_schema, only: schema_t
   use ehl_status, only: status_t
   use ehl_surface, only: x_filled, x_matters
   use ehl_text, only: short
   implicit none (type, external)
   private
   public :: check_feature, check_arrival, late_start

   !> Sizes in metres, and the keys that they take the place of
   character(len=*), parameter :: metric(4) = [character(len=8) :: "height_m", "height_m", "width_m", "length_m"]
   character(len=*), parameter :: others(4) = [character(len=19) :: "amplitude", "amplitude_over_film", "width", "length"]

   !> Time in which the film made in the inlet passes the contact [a/u]
   real(dp), parameter :: through = 2.0_dp

contains

   !> A size is given once, in metres only where the contact has a size; nothing begins inside the contact
   subroutine check_feature(schema, group, s, si, status)
      type(schema_t), intent(in) :: schema
      character(len=*), intent(in) :: group
      type(surface_case_t), intent(in) :: s
      !> Whether the contact is given in SI units
      logical, intent(in) :: si
      type(status_t), intent(inout) :: status
      real(dp) :: value(4)
      integer :: k

      if (status%failed() .or. .not. is_feature(s%kind)) return
      value = [s%height_m, s%height_m, s%width_m, s%length_m]
      do k = 1, size(metric)
         if (.not. value(k) > 0.0_dp) cycle
         associate (one => group//"."//trim(metric(k)), other => group//"."//trim(others(k)))
            if (.not. si) then
               call schema%refuse(one, one//" is in metres, and the contact is given by its Moes numbers", &
                                  other//", or a contact in SI units", status)
            else if (schema%given(group, trim(others(k)))) then
               call schema%contradict(one, other, "one of the two", status)
            end if
         end associate
         if (status%failed()) return
      end do
      if (s%velocity_ratio > 0.0_dp .and. s%x_start > x_matters) then
         call schema%refuse(group//".x_start", group//".x_start = "//short(s%x_start)//": a "//trim(s%kind)// &
                            " would begin inside the contact", "at most "//short(x_matters)//", where its front end is at time 0", &
                            status)
      end if
   end subroutine check_feature

   !> A feature comes when the roughness of the other surface has filled the contact, with the film that it made in the
   !> inlet: its x_start unless it is given
   pure subroutine late_start(s, other)
      type(surface_case_t), intent(inout) :: s
      type(surface_case_t), intent(in) :: other

      if (waits(s, other)) s%x_start = min(s%x_start, latest_start(s, other) - s%velocity_ratio*through)
   end subroutine late_start

   !> Refuse a feature that comes before the roughness of the other surface fills the contact
   subroutine check_arrival(schema, group, s, other, status)
      type(schema_t), intent(in) :: schema
      character(len=*), intent(in) :: group
      type(surface_case_t), intent(in) :: s, other
      type(status_t), intent(inout) :: status

      if (status%failed() .or. .not. waits(s, other)) return
      if (s%x_start <= latest_start(s, other)) return
      call schema%refuse(group//".x_start", group//".x_start = "//short(s%x_start)//": the "//trim(s%kind)// &
                         " would come before the roughness of the other surface fills the contact", &
                         "at most "//short(latest_start(s, other)), status)
   end subroutine check_arrival

   !> Whether one is a feature on the move and the other one roughness on the move
   pure logical function waits(s, other)
      type(surface_case_t), intent(in) :: s, other
      waits = is_feature(s%kind) .and. .not. is_feature(other%kind) .and. .not. has_no_height(other) .and. &
              s%velocity_ratio > 0.0_dp .and. other%velocity_ratio > 0.0_dp
   end function waits

   !> Where a feature begins that comes near the contact just when the front of the other surface leaves it
   pure real(dp) function latest_start(s, other)
      type(surface_case_t), intent(in) :: s, other
      latest_start = x_matters - s%velocity_ratio*(x_filled - other%x_start)/other%velocity_ratio
   end function latest_start
end module ehl_case_feature

! SPDX-License-Identifier: BSD-3-Clause
!> Keys of a single feature that do not go together
module ehl_case_feature
   use ehl_case, only: case_t, is_feature
   use ehl_kinds, only: dp
   use ehl_refusal, only: contradict, refuse, short
   use ehl_schema, only: schema_t
   use ehl_source, only: source_t
   use ehl_status, only: status_t
   use ehl_surface, only: x_matters
   implicit none (type, external)
   private
   public :: check_feature

   !> Sizes in metres, and the keys that they take the place of
   character(len=*), parameter :: metric(4) = [character(len=8) :: "height_m", "height_m", "width_m", "length_m"]
   character(len=*), parameter :: others(4) = [character(len=19) :: "amplitude", "amplitude_over_film", "width", "length"]

contains

   !> A size is given once, in metres only where the contact has a size; nothing begins inside the contact
   subroutine check_feature(schema, input, sources, status)
      type(schema_t), intent(in) :: schema
      type(case_t), intent(in) :: input
      type(source_t), intent(in) :: sources(:)
      type(status_t), intent(inout) :: status
      real(dp) :: value(4)
      integer :: k

      if (status%failed() .or. .not. is_feature(input%surface%kind)) return
      associate (s => input%surface)
         value = [s%height_m, s%height_m, s%width_m, s%length_m]
         do k = 1, size(metric)
            if (.not. value(k) > 0.0_dp) cycle
            if (.not. input%contact%si) then
               call refuse(schema, sources, "surface", trim(metric(k)), "surface."//trim(metric(k))// &
                           " is in metres, and the contact is given by its Moes numbers", "surface."//trim(others(k))// &
                           ", or a contact in SI units", status)
               return
            else if (schema%given("surface", trim(others(k)))) then
               call contradict(schema, sources, "surface."//trim(metric(k)), "surface."//trim(others(k)), "one of the two", &
                               status)
               return
            end if
         end do
         if (s%velocity_ratio > 0.0_dp .and. s%x_start > x_matters) then
            call refuse(schema, sources, "surface", "x_start", "surface.x_start = "//short(s%x_start)//": a "//trim(s%kind)// &
                        " would begin inside the contact", "at most "//short(x_matters)//", where its front end is at time 0", &
                        status)
         end if
      end associate
   end subroutine check_feature
end module ehl_case_feature

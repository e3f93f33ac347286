! SPDX-License-Identifier: BSD-3-Clause
!> What is said of a feature that passes the contact once
module ehl_report_passage
   use ehl_extremes, only: extreme_film, extreme_pressure, extremes_t
   use ehl_kinds, only: dp, not_known
   use ehl_record, only: record_t
   use ehl_scales, only: scales_t
   implicit none (type, external)
   private
   public :: report_passage

contains

   !> Extremes of pressure and film over the passage, with where and when: null unless it came to a good end
   subroutine report_passage(record, scales, extremes, good)
      type(record_t), intent(inout) :: record
      type(scales_t), intent(in) :: scales
      type(extremes_t), intent(in) :: extremes
      logical, intent(in) :: good
      !> In the order of the extremes, and of what is found of each
      character(len=*), parameter :: names(4) = [character(len=11) :: "P_max_rough", "H_min_rough", "P_rise_max", &
                                                 "H_ratio_min"], parts(4) = [character(len=2) :: "", "_T", "_X", "_Y"]
      real(dp) :: found(4, 4)
      integer :: i, k

      found = extremes%found
      if (.not. good) found = not_known
      do k = 1, size(names)
         do i = 1, size(parts)
            call record%set(trim(names(k))//trim(parts(i)), found(i, k))
         end do
      end do
      if (scales%has_size()) then
         call record%set("p_max_rough_Pa", found(1, extreme_pressure)*scales%pressure)
         call record%set("h_min_rough_m", found(1, extreme_film)*scales%film)
      end if
   end subroutine report_passage
end module ehl_report_passage

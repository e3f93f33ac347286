! SPDX-License-Identifier: BSD-3-Clause
!> What is said of a feature that passes the contact once
module ehl_report_passage
   use ehl_extremes, only: extreme_film, extreme_pressure, extreme_ratio, extreme_rise, extremes_t
   use ehl_kinds, only: dp
   use ehl_record, only: record_t
   use ehl_scales, only: scales_t
   use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
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
      real(dp) :: found(4, 4)

      found = extremes%found
      if (.not. good) found = ieee_value(found, ieee_quiet_nan)
      call record%set("P_max_rough", found(1, extreme_pressure))
      call record%set("P_max_rough_T", found(2, extreme_pressure))
      call record%set("P_max_rough_X", found(3, extreme_pressure))
      call record%set("P_max_rough_Y", found(4, extreme_pressure))
      call record%set("H_min_rough", found(1, extreme_film))
      call record%set("H_min_rough_T", found(2, extreme_film))
      call record%set("H_min_rough_X", found(3, extreme_film))
      call record%set("H_min_rough_Y", found(4, extreme_film))
      call record%set("P_rise_max", found(1, extreme_rise))
      call record%set("P_rise_max_T", found(2, extreme_rise))
      call record%set("P_rise_max_X", found(3, extreme_rise))
      call record%set("P_rise_max_Y", found(4, extreme_rise))
      call record%set("H_ratio_min", found(1, extreme_ratio))
      call record%set("H_ratio_min_T", found(2, extreme_ratio))
      call record%set("H_ratio_min_X", found(3, extreme_ratio))
      call record%set("H_ratio_min_Y", found(4, extreme_ratio))
      if (scales%has_size()) then
         call record%set("p_max_rough_Pa", found(1, extreme_pressure)*scales%pressure)
         call record%set("h_min_rough_m", found(1, extreme_film)*scales%film)
      end if
   end subroutine report_passage
end module ehl_report_passage

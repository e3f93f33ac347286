! SPDX-License-Identifier: BSD-3-Clause
!> Additional results of a roller: positions of maximum pressure and minimum film, and the pressure at its ends
module ehl_report_roller
   use ehl_contact_run, only: contact_run_t
   use ehl_kinds, only: dp, not_known
   use ehl_reason, only: reason_end
   use ehl_record, only: record_t
   implicit none (type, external)
   private
   public :: report_roller

   !> Pressure at an end [p_h] above which the end is loaded: the pressure there is infinite in theory and increases on finer grids
   real(dp), parameter :: end_pressure = 0.1_dp

contains

   !> Report null unless there is a solution. At a loaded end minimum film and maximum pressure do not converge on finer grids: they
   !> have no error.
   subroutine report_roller(record, run, solved)
      type(record_t), intent(inout) :: record
      type(contact_run_t), intent(in) :: run
      logical, intent(in) :: solved
      real(dp) :: places(4), ends
      integer :: node(2), first, last

      if (.not. run%plan%contact%is_roller()) return
      places = not_known
      ends = not_known
      call record%set_detail("finest_rows", real(run%plan%finest%full_ny(), dp))
      if (solved) then
         associate (level => run%hierarchy%levels(run%level()))
            first = level%grid%first_inner()
            last = level%grid%last_inner()
            node = maxloc(level%p)
            places(:2) = [level%grid%x(node(1)), level%grid%y(node(2))]
            node = minloc(level%h(:, first:last))
            places(3:) = [level%grid%x(node(1)), level%grid%y(node(2) + first - 1)]
            ends = maxval(level%p(:, last))
            if (.not. level%grid%mirror) ends = max(ends, maxval(level%p(:, first)))
            call record%set("cell_at_end", level%grid%hy)
         end associate
         if (ends > end_pressure) then
            call record%set("H_min_error H_min_error_grid H_min_extrapolated P_max_error", spread(not_known, 1, 4))
            call record%set_code("H_min_error_note", reason_end)
            call record%set_code("P_max_error_note", reason_end)
            if (run%plan%scales%has_size()) call record%set("h_min_error_m", not_known)
         end if
      end if
      call record%set("P_max_X P_max_Y H_min_X H_min_Y", places)
      call record%set("P_end", ends)
      call record%set("length", 2.0_dp*run%plan%contact%reach(2))
   end subroutine report_roller
end module ehl_report_roller

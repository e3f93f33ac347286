! SPDX-License-Identifier: BSD-3-Clause
!> Full multigrid for the smooth contact (Venner & Lubrecht 2000; docs/theory/coarse-grids.md)
module ehl_fmg
   use ehl_contact_results, only: contact_results_t
   use ehl_contact_run, only: contact_run_t
   use ehl_hierarchy, only: hierarchy_t
   use ehl_observer, only: observer_t
   use ehl_outcome, only: outcome_running
   use ehl_smooth_contact, only: smooth_contact_t
   use ehl_status, only: status_t
   implicit none (type, external)
   private
   public :: full_multigrid

contains

   !> Solve the levels from the coarsest on, each until its algebraic error is a fraction of its discretisation error. The observer
   !> may stop after any cycle; the next call continues there.
   subroutine full_multigrid(run, observer, leave, status)
      type(contact_run_t), intent(inout) :: run
      class(observer_t), intent(inout) :: observer
      logical, intent(out) :: leave
      type(status_t), intent(inout) :: status
      integer :: n, outcome

      leave = .false.
      levels: do
         if (.not. run%smooth%begun) call run%smooth%begin_level(run%hierarchy, status)
         if (status%failed()) return
         n = run%smooth%n
         cycles: do while (run%smooth%begun)
            call one_cycle(run%smooth, run%hierarchy, outcome, status)
            if (status%failed()) return
            if (outcome /= outcome_running) call run%smooth%end_level(run%hierarchy, outcome)
            call run%record_cycle(n, outcome, status)
            if (status%failed() .or. outcome /= outcome_running) return
            call observer%watch(run, leave)
            if (leave) return
         end do cycles
      end do levels
   end subroutine full_multigrid

   !> Make a cycle on level n of the smooth contact and test its convergence
   subroutine one_cycle(smooth, hierarchy, outcome, status)
      type(smooth_contact_t), intent(inout) :: smooth
      type(hierarchy_t), intent(inout) :: hierarchy
      !> outcome_running: another cycle is needed
      integer, intent(out) :: outcome
      type(status_t), intent(inout) :: status
      type(contact_results_t) :: before

      outcome = outcome_running
      call smooth%begin_cycle(hierarchy%levels(smooth%n), status)
      if (status%failed()) return
      before = smooth%m
      call smooth%iterate(hierarchy)
      if (smooth%failure_status() == outcome_running) then
         call smooth%estimate_errors(before)
         if (smooth%may_scale_load()) call smooth%balance(hierarchy)
      end if
      outcome = smooth%cycle_status(smooth%converged())
      call smooth%guard_cycle(hierarchy, outcome, status)
      call smooth%record()
      if (outcome == outcome_running .and. smooth%drifts()) call smooth%balance(hierarchy)
   end subroutine one_cycle
end module ehl_fmg

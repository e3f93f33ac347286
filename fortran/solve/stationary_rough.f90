! SPDX-License-Identifier: BSD-3-Clause
!> The contact with a stationary rough surface (docs/theory/coarse-grids.md#stationary-roughness)
module ehl_stationary_rough
   use ehl_clock, only: clock_t, start_clock
   use ehl_contact_results, only: contact_results_t
   use ehl_contact_run, only: contact_run_t
   use ehl_hierarchy, only: hierarchy_t
   use ehl_observer, only: observer_t
   use ehl_outcome, only: outcome_converged, outcome_cycle_limit, outcome_running
   use ehl_stationary_state, only: stationary_t
   use ehl_status, only: status_t
   implicit none (type, external)
   private
   public :: solve_stationary

contains

   !> Solve with an increasing fraction of the roughness: first 0 (the smooth contact, to the tolerance of the friction), then 1,
   !> or, if the cycles fail, half of the remaining step. The observer may stop after any cycle; the next call continues there.
   subroutine solve_stationary(run, observer, leave, status)
      type(contact_run_t), intent(inout) :: run
      class(observer_t), intent(inout) :: observer
      logical, intent(out) :: leave
      type(status_t), intent(inout) :: status
      type(clock_t) :: clock
      integer :: n, outcome

      leave = .false.
      n = run%smooth%n
      do
         clock = start_clock()
         outcome = outcome_running
         if (run%stationary%due) call run%stationary%add_roughness(run%hierarchy%levels(n), outcome)
         if (outcome == outcome_running) then
            call one_cycle(run%stationary, run%hierarchy, outcome)
            if (outcome == outcome_converged) then
               call run%stationary%accept(run%hierarchy%levels(n))
               if (run%stationary%due) outcome = outcome_running
            else if (outcome /= outcome_running) then
               call run%stationary%reject(run%hierarchy%levels(n), outcome)
            end if
         end if
         call run%record_rough_cycle(outcome, clock%seconds(), status)
         if (status%failed() .or. outcome /= outcome_running) return
         call observer%watch(run, leave)
         if (leave) return
      end do
   end subroutine solve_stationary

   !> Make a cycle at the present fraction of the roughness and test its convergence
   subroutine one_cycle(rough, hierarchy, outcome)
      type(stationary_t), intent(inout) :: rough
      type(hierarchy_t), intent(inout) :: hierarchy
      !> outcome_running: another cycle is needed
      integer, intent(out) :: outcome
      type(contact_results_t) :: before

      call rough%begin_cycle(hierarchy%levels(rough%n))
      before = rough%m
      call rough%iterate(hierarchy)
      rough%total_cycles = rough%total_cycles + 1
      if (rough%failure_status() == outcome_running) then
         call rough%estimate_error(before)
         if (rough%may_scale_load()) call rough%balance(hierarchy)
      end if
      outcome = rough%cycle_status(rough%converged())
      if (outcome /= outcome_running) return
      associate (boundary => hierarchy%levels(rough%n)%boundary)
         if (boundary%load_diverges(rough%cycles, rough%m%load_error)) outcome = outcome_cycle_limit
      end associate
   end subroutine one_cycle
end module ehl_stationary_rough

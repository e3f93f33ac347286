! SPDX-License-Identifier: BSD-3-Clause
!> The contact with a moving rough surface (docs/theory/time-steps.md, docs/theory/transient.md)
module ehl_transient
   use ehl_clock, only: clock_t, start_clock
   use ehl_contact_results, only: contact_results_t
   use ehl_contact_run, only: contact_run_t
   use ehl_hierarchy, only: hierarchy_t
   use ehl_kinds, only: dp
   use ehl_moving_surfaces, only: moving_surfaces_t
   use ehl_observer, only: observer_t
   use ehl_outcome, only: outcome_converged, outcome_cycle_limit, outcome_running
   use ehl_status, only: status_t
   use ehl_step_policy, only: step_restarts, step_ends
   use ehl_transient_state, only: transient_t
   implicit none (type, external)
   private
   public :: solve_transient

contains

   !> Make time steps until the run ends. The observer may stop after any step; the next call continues there.
   subroutine solve_transient(run, observer, leave, status)
      type(contact_run_t), intent(inout) :: run
      class(observer_t), intent(inout) :: observer
      logical, intent(out) :: leave
      type(status_t), intent(inout) :: status
      type(clock_t) :: clock
      integer :: outcome

      leave = .false.
      steps: do
         clock = start_clock()
         call time_step(run%transient, run%hierarchy, run%plan%surfaces, outcome, status)
         run%seconds = run%seconds + clock%seconds()
         if (status%failed()) return
         if (outcome == outcome_converged) then
            call run%record_step(status)
         else if (run%is_filling()) then
            call run%restart_with_front(outcome, status)
         else
            run%outcome = outcome
         end if
         if (status%failed() .or. run%outcome /= outcome_running) return
         call observer%watch(run, leave)
         if (leave) return
      end do steps
   end subroutine solve_transient

   !> Make one time step. Under a duty it is halved if it fails or its error is too large. After a failure the last accepted state
   !> is restored.
   subroutine time_step(transient, hierarchy, surfaces, outcome, status)
      type(transient_t), intent(inout) :: transient
      type(hierarchy_t), intent(inout) :: hierarchy
      class(moving_surfaces_t), intent(inout) :: surfaces
      !> outcome_converged, or the reason of the failure
      integer, intent(out) :: outcome
      type(status_t), intent(inout) :: status
      type(contact_results_t) :: first
      real(dp) :: residual_first
      logical :: accepted

      outcome = outcome_running
      if (status%failed()) return
      associate (level => hierarchy%levels(transient%n), duty => transient%duty)
         do
            if (duty%active) call transient%begin_duty(hierarchy, surfaces)
            if (transient%stays_steady()) then
               outcome = outcome_converged
               transient%cycles = 0
               call transient%count_step(level, status)
               return
            end if
            call solve_step(transient, hierarchy, surfaces, first, residual_first, outcome, status)
            if (status%failed()) return
            accepted = outcome == outcome_converged
            if (accepted .and. transient%settling) then
               call transient%settle(level)
               cycle
            end if
            if (accepted .and. duty%active) call transient%assess_duty(level, accepted)
            if (accepted) call transient%accept(level, first, residual_first, status)
            call transient%end_duty(level)
            if (accepted) return
            call transient%step_back(level, surfaces)
            if (.not. duty%active) return
            if (.not. transient%duty_steps%cut()) return
         end do
      end associate
   end subroutine time_step

   !> Solve the problem of a step: attempts of several cycles each, until one converges
   subroutine solve_step(transient, hierarchy, surfaces, first, residual_first, outcome, status)
      type(transient_t), intent(inout) :: transient
      type(hierarchy_t), intent(inout) :: hierarchy
      class(moving_surfaces_t), intent(inout) :: surfaces
      !> Results and residual after the first cycle
      type(contact_results_t), intent(out) :: first
      real(dp), intent(out) :: residual_first
      integer, intent(out) :: outcome
      type(status_t), intent(inout) :: status
      real(dp) :: before
      integer :: n, next

      outcome = outcome_running
      residual_first = 0.0_dp
      n = transient%n
      call transient%begin_step(hierarchy%levels(n), surfaces)
      attempts: do
         call transient%begin_attempt(hierarchy, status)
         if (status%failed()) return
         cycles: do
            if (.not. transient%residual < huge(1.0_dp) .and. transient%cycles > 0) exit attempts
            before = transient%residual
            call transient%begin_cycle(hierarchy%levels(n))
            call transient%iterate(hierarchy)
            if (transient%may_scale_load()) call transient%balance(hierarchy)
            outcome = transient%cycle_status(transient%converged())
            call transient%policy%after_cycle(transient%step + 1, transient%converged(), before, transient%residual, next)
            if (next == step_ends) exit attempts
            if (transient%cycles == 1) then
               first = transient%m
               residual_first = transient%residual
            end if
            if (next == step_restarts) exit cycles
         end do cycles
      end do attempts
      if (outcome == outcome_running) outcome = outcome_cycle_limit
   end subroutine solve_step
end module ehl_transient

! SPDX-License-Identifier: BSD-3-Clause
!> The one loop of multigrid cycles: it brings a state of the contact to its tolerance. What is solved (a level of the smooth
!> contact, a part of a roughness at rest, a time step) extends iteration_t: it says what changes from cycle to cycle, and when
!> the state is good enough.
module ehl_iteration
   use ehl_contact_results, only: contact_results_t, load_tolerance, measure
   use ehl_cycle, only: cycle_options_t
   use ehl_film, only: balance_load, update_residual
   use ehl_hierarchy, only: hierarchy_t
   use ehl_kinds, only: dp
   use ehl_level, only: level_t
   use ehl_outcome, only: outcome_converged, outcome_cycle_limit, outcome_diverged, outcome_negative_film, outcome_running
   use ehl_status, only: status_t
   implicit none (type, external)
   private
   public :: iteration_t, judge_state, look_at, reduction

   !> Reductions per cycle that are believed
   real(dp), parameter :: least_reduction = 0.3_dp, most_reduction = 0.95_dp

   type, abstract :: iteration_t
      !> How the present state stands
      integer :: state = outcome_running
      !> Its level, the most cycles, and how the next one is made
      integer :: n = 0, max_cycles = 0
      type(cycle_options_t) :: options
      !> Cycles made, and their sweeps on that level
      integer :: cycles = 0, sweeps = 0
      !> Results after the last cycle, residual after it and before it
      type(contact_results_t) :: m
      real(dp) :: residual = 0.0_dp, residual_before = 0.0_dp
   contains
      procedure, non_overridable :: iterate
      procedure :: unsound
      procedure :: look => look_at
      procedure :: judge => judge_state
      !> What is updated before a cycle; it may end the state without one
      procedure(before_cycle_i), deferred :: before_cycle
      !> The algebraic error after a cycle; whether the load alone may be wrong, and by so little that scaling the pressure
      !> costs no accuracy
      procedure(after_cycle_i), deferred :: after_cycle
      !> Whether the state meets its tolerance
      procedure(meets_i), deferred :: meets
   end type iteration_t

   abstract interface
      subroutine before_cycle_i(self, hierarchy, status)
         import :: iteration_t, hierarchy_t, status_t
         implicit none (type, external)
         class(iteration_t), intent(inout) :: self
         type(hierarchy_t), intent(inout) :: hierarchy
         type(status_t), intent(inout) :: status
      end subroutine before_cycle_i

      subroutine after_cycle_i(self, before, may_balance)
         import :: iteration_t, contact_results_t
         implicit none (type, external)
         class(iteration_t), intent(inout) :: self
         !> Results before the cycle
         type(contact_results_t), intent(in) :: before
         logical, intent(out) :: may_balance
      end subroutine after_cycle_i

      pure logical function meets_i(self)
         import :: iteration_t
         implicit none (type, external)
         class(iteration_t), intent(in) :: self
      end function meets_i
   end interface

contains

   !> Cycles until the state has come to an end, or so many
   subroutine iterate(self, hierarchy, most, status)
      class(iteration_t), intent(inout) :: self
      type(hierarchy_t), intent(inout) :: hierarchy
      integer, intent(in) :: most
      type(status_t), intent(inout) :: status
      type(contact_results_t) :: before
      real(dp) :: residual
      integer :: k, sweeps
      logical :: may_balance

      do k = 1, most
         call self%before_cycle(hierarchy, status)
         if (status%failed() .or. self%state /= outcome_running) return
         before = self%m
         self%residual_before = self%residual
         associate (level => hierarchy%levels(self%n))
            call hierarchy%cycle(self%n, self%options, residual, sweeps)
            self%cycles = self%cycles + 1
            self%sweeps = self%sweeps + sweeps
            call self%look(level, residual)
            call self%after_cycle(before, may_balance)
            if (may_balance .and. abs(self%m%load_error) > load_tolerance) then
               call balance_load(level, self%m%load_error)
               call update_residual(level, residual)
               call self%look(level, residual)
            end if
         end associate
         call self%judge()
         if (self%state /= outcome_running) return
      end do
   end subroutine iterate

   !> Read off the state of a level
   subroutine look_at(self, level, residual)
      class(iteration_t), intent(inout) :: self
      type(level_t), intent(in) :: level
      !> Residual (rms)
      real(dp), intent(in) :: residual

      self%m = measure(level)
      self%residual = residual
   end subroutine look_at

   !> Whether the state has come to an end, and how
   subroutine judge_state(self)
      class(iteration_t), intent(inout) :: self

      self%state = self%unsound()
      if (self%state /= outcome_running) return
      if (self%meets()) then
         self%state = outcome_converged
      else if (self%cycles >= self%max_cycles) then
         self%state = outcome_cycle_limit
      end if
   end subroutine judge_state

   !> What is wrong with a state that is no solution whatever its residual; outcome_running: nothing
   pure integer function unsound(self)
      class(iteration_t), intent(in) :: self

      unsound = outcome_running
      if (.not. self%m%finite) then
         unsound = outcome_diverged
      else if (.not. self%m%positive) then
         unsound = outcome_negative_film
      end if
   end function unsound

   !> Reduction q of the error per cycle, by the changes of two cycles: q/(1 - q) of the last change is left. Part of the change
   !> of the first cycle is the way from another problem's solution, so that its size says little of the next.
   pure real(dp) function reduction(change, change_before, cycles) result(q)
      real(dp), intent(in) :: change(:), change_before(:)
      !> Cycles made
      integer, intent(in) :: cycles

      q = least_reduction
      if (cycles > 1) q = max(least_reduction, min(maxval(change/max(change_before, tiny(1.0_dp))), most_reduction))
   end function reduction
end module ehl_iteration

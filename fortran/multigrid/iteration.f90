! SPDX-License-Identifier: BSD-3-Clause
!> A state of the contact on its way to its tolerance, cycle by cycle. What is solved (a level of the smooth contact, a share of
!> a roughness at rest, a time step) extends iteration_t: it says when the state is good enough, and updates between two cycles
!> what is to follow the state.
module ehl_iteration
   use ehl_anderson, only: anderson_t
   use ehl_contact_results, only: contact_results_t, load_tolerance, measure
   use ehl_cycle, only: cycle_options_t, finest_cycle
   use ehl_force_balance, only: balance_load
   use ehl_hierarchy, only: hierarchy_t
   use ehl_kinds, only: dp
   use ehl_level, only: level_t
   use ehl_outcome, only: outcome_converged, outcome_cycle_limit, outcome_diverged, outcome_negative_film, outcome_running
   use ehl_reynolds, only: film_residual, update_residual
   implicit none (type, external)
   private
   public :: iteration_t, reduction, most_reduction

   !> Reductions per cycle that are believed
   real(dp), parameter :: least_reduction = 0.3_dp, most_reduction = 0.95_dp

   type, abstract :: iteration_t
      !> How the state stands
      integer :: state = outcome_running
      !> Its level, the most cycles, and how the next one is made
      integer :: n = 0, max_cycles = huge(1)
      type(cycle_options_t) :: options
      !> Whether its residual is the one that concerns the film
      logical :: of_film = .false.
      !> Cycles made; results and residual after the last one
      integer :: cycles = 0
      type(contact_results_t) :: m
      real(dp) :: residual = 0.0_dp
      !> Acceleration of cycles that stall
      type(anderson_t) :: mixing
   contains
      procedure, non_overridable :: improve
      procedure, non_overridable :: unsound
      procedure, non_overridable, private :: look
      procedure(may_balance_i), deferred :: may_balance
      procedure(meets_i), deferred :: meets
   end type iteration_t

   abstract interface
      !> After a cycle: estimate the algebraic error. Whether an error of the load is so small that scaling the pressure costs
      !> no accuracy, and may be all that is left.
      logical function may_balance_i(self, before)
         import :: iteration_t, contact_results_t
         implicit none (type, external)
         class(iteration_t), intent(inout) :: self
         !> Results before the cycle
         type(contact_results_t), intent(in) :: before
      end function may_balance_i

      !> Whether the state meets its tolerance
      pure logical function meets_i(self)
         import :: iteration_t
         implicit none (type, external)
         class(iteration_t), intent(in) :: self
      end function meets_i
   end interface

contains

   !> Make a cycle, read off the state, take away what is wrong with the load alone, and judge
   subroutine improve(self, hierarchy)
      class(iteration_t), intent(inout) :: self
      type(hierarchy_t), intent(inout) :: hierarchy
      type(contact_results_t) :: before
      real(dp) :: residual
      logical :: may_balance

      before = self%m
      associate (level => hierarchy%levels(self%n))
         if (self%mixing%on) call self%mixing%remember(level)
         call finest_cycle(hierarchy, self%n, self%options, residual)
         self%cycles = self%cycles + 1
         if (self%mixing%on) call self%mixing%mix(level, residual)
         call self%look(level, residual)
         ! asked after every cycle: it also takes note of the algebraic error
         may_balance = self%may_balance(before)
         if (may_balance .and. abs(self%m%load_error) > load_tolerance) then
            call balance_load(level)
            call update_residual(level, residual)
            call self%look(level, residual)
         end if
      end associate
      self%state = self%unsound()
      if (self%state /= outcome_running) return
      if (self%meets() .and. self%m%holds) then
         self%state = outcome_converged
      else if (self%cycles >= self%max_cycles) then
         self%state = outcome_cycle_limit
      end if
   end subroutine improve

   !> Read off the state of a level
   subroutine look(self, level, residual)
      class(iteration_t), intent(inout) :: self
      type(level_t), intent(in) :: level
      !> Residual (rms)
      real(dp), intent(in) :: residual

      self%m = measure(level)
      if (.not. self%of_film) then
         self%residual = residual
      else if (self%unsound() == outcome_running) then
         self%residual = film_residual(level)
      end if
   end subroutine look

   !> What is wrong with a state that is no solution whatever its residual; outcome_running: nothing
   pure integer function unsound(self)
      class(iteration_t), intent(in) :: self

      unsound = merge(outcome_running, outcome_negative_film, self%m%positive)
      if (.not. self%m%finite) unsound = outcome_diverged
   end function unsound

   !> Reduction q of the error per cycle, by the changes of the last two: q/(1 - q) of the last change is left. The first cycle
   !> also makes up for the grid or the problem that the state comes from, so that its change says little of the next.
   pure real(dp) function reduction(change, change_before, cycles, fall) result(q)
      real(dp), intent(in) :: change(:), change_before(:)
      !> Cycles made
      integer, intent(in) :: cycles
      !> Residual over that before the last cycle, if it is to bound q: a change can be tiny by chance, and the next one is
      !> then many times as large
      real(dp), intent(in), optional :: fall

      q = least_reduction
      if (cycles <= 1) return
      q = min(maxval(change/max(change_before, tiny(1.0_dp))), most_reduction)
      if (present(fall)) q = min(q, fall)
      q = max(least_reduction, q)
   end function reduction
end module ehl_iteration

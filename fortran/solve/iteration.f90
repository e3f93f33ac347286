! SPDX-License-Identifier: BSD-3-Clause
!> One multigrid cycle and the evaluation of the state after it. The problems (a level of the smooth contact, a fraction of a
!> stationary roughness, a time step) extend iteration_t by their error estimates.
module ehl_iteration
   use ehl_anderson, only: anderson_t
   use ehl_contact_results, only: contact_results_t, load_tolerance, measure
   use ehl_cycle, only: cycle_options_t, finest_cycle
   use ehl_hierarchy, only: hierarchy_t
   use ehl_kinds, only: dp
   use ehl_level, only: level_t
   use ehl_outcome, only: outcome_converged, outcome_cycle_limit, outcome_diverged, outcome_negative_film, outcome_running
   use ehl_reynolds, only: balance_load, film_residual, update_residual
   implicit none (type, external)
   private
   public :: iteration_t, reduction

   !> Bounds of the estimated reduction per cycle
   real(dp), parameter :: min_reduction = 0.3_dp, max_reduction = 0.95_dp

   type :: iteration_t
      !> Level, maximum number of cycles, and options of the next cycle
      integer :: n = 0, max_cycles = huge(1)
      type(cycle_options_t) :: next_cycle
      !> Whether `residual` is the residual of the film (film_residual)
      logical :: of_film = .false.
      !> Number of cycles; results and residual after the last cycle
      integer :: cycles = 0
      type(contact_results_t) :: m
      real(dp) :: residual = 0.0_dp
      !> Acceleration of cycles that stall
      type(anderson_t) :: mixing
   contains
      procedure, non_overridable :: iterate
      procedure, non_overridable :: balance
      procedure, non_overridable :: failure_status
      procedure, non_overridable :: cycle_status
      procedure, non_overridable, private :: evaluate
   end type iteration_t

contains

   !> Make a cycle and evaluate the state after it
   subroutine iterate(self, hierarchy)
      class(iteration_t), intent(inout) :: self
      type(hierarchy_t), intent(inout) :: hierarchy
      real(dp) :: residual

      associate (level => hierarchy%levels(self%n))
         if (self%mixing%on) call self%mixing%remember(level)
         call finest_cycle(hierarchy, self%n, self%next_cycle, residual)
         self%cycles = self%cycles + 1
         if (self%mixing%on) call self%mixing%mix(level, residual)
         call self%evaluate(level, residual)
      end associate
   end subroutine iterate

   !> Correct an error of the load above the tolerance by scaling the pressure, and evaluate the state again
   subroutine balance(self, hierarchy)
      class(iteration_t), intent(inout) :: self
      type(hierarchy_t), intent(inout) :: hierarchy
      real(dp) :: residual

      if (.not. abs(self%m%load_error) > load_tolerance) return
      associate (level => hierarchy%levels(self%n))
         call balance_load(level)
         call update_residual(level, residual)
         call self%evaluate(level, residual)
      end associate
   end subroutine balance

   !> Results and residual of a level
   subroutine evaluate(self, level, residual)
      class(iteration_t), intent(inout) :: self
      type(level_t), intent(in) :: level
      !> Rms residual
      real(dp), intent(in) :: residual

      self%m = measure(level)
      if (.not. self%of_film) then
         self%residual = residual
      else if (self%failure_status() == outcome_running) then
         self%residual = film_residual(level)
      end if
   end subroutine evaluate

   !> Status of a state with a negative film or without finite values; outcome_running: neither
   pure integer function failure_status(self)
      class(iteration_t), intent(in) :: self

      failure_status = merge(outcome_running, outcome_negative_film, self%m%positive)
      if (.not. self%m%finite) failure_status = outcome_diverged
   end function failure_status

   !> Status after a cycle; outcome_running: another one is needed
   pure integer function cycle_status(self, converged)
      class(iteration_t), intent(in) :: self
      !> Whether it meets its tolerances
      logical, intent(in) :: converged

      cycle_status = self%failure_status()
      if (cycle_status /= outcome_running) return
      if (self%cycles >= self%max_cycles) cycle_status = outcome_cycle_limit
      if (converged) cycle_status = outcome_converged
   end function cycle_status

   !> Reduction q of the error per cycle, the ratio of the last two changes: the remaining error is q/(1 - q) times the last change.
   !> After the first cycle, before which the grid or the problem was another, q is `min_reduction`.
   pure real(dp) function reduction(change, change_before, cycles, residual_ratio, lower_bound) result(q)
      real(dp), intent(in) :: change(:), change_before(:)
      !> Cycles made
      integer, intent(in) :: cycles
      !> Ratio of the residuals after and before the last cycle, as an upper bound of q: after a change that is small by chance
      !> the ratio of changes is too large
      real(dp), intent(in), optional :: residual_ratio
      !> Lower bound of q, default `min_reduction`
      real(dp), intent(in), optional :: lower_bound
      real(dp) :: lower

      lower = min_reduction
      if (present(lower_bound)) lower = lower_bound
      q = min_reduction
      if (cycles <= 1) return
      q = min(maxval(change/max(change_before, tiny(1.0_dp))), max_reduction)
      if (present(residual_ratio)) q = min(q, residual_ratio)
      q = max(lower, q)
   end function reduction
end module ehl_iteration

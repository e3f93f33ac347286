! SPDX-License-Identifier: BSD-3-Clause
!> How the cycles of a time step are made: attempts one after another, and the kind of coarsening
module ehl_step_policy
   use ehl_cycle, only: coarsening_alcouffe, coarsening_classical, cycle_options_t
   use ehl_kinds, only: dp
   use ehl_relaxation, only: usual_log_change
   implicit none (type, external)
   private
   public :: step_policy_t
   public :: attempt_predicted, attempt_last, attempt_limited, attempt_damped
   public :: step_ends, step_goes_on, step_begins_again, damped_sweep, whole_correction

   !> Attempts at a step, in this order: from the predicted pressure; from the pressure of the last step, with
   !> limited sweeps; the same, limited further; the same, changes of sweeps and of coarse grids damped. The next one is made
   !> when the residual does not fall.
   integer, parameter :: attempt_predicted = 1, attempt_last = 2, attempt_limited = 3, attempt_damped = 4
   !> Largest change of the logarithm of a node's conductance in a sweep, by attempt
   real(dp), parameter :: max_log_change(4) = usual_log_change/[1.0_dp, 3.0_dp, 9.0_dp, 9.0_dp]
   !> Shares of the changes of a sweep and of a coarse grid that the damped attempt makes. Sweeps in which a peak
   !> jumps from node to node, and coarse grids that overshoot it, lead to cycles that repeat states.
   real(dp), parameter :: damped_sweep = 0.3_dp, damped_correction = 0.5_dp
   !> Share of a coarse grid's change in a wide contact under squeeze motion, where the finest level alone is damped
   real(dp), parameter :: whole_correction = 0.8_dp
   !> Cycles in which the residual must halve, by attempt; the last one is not ended before so many times the
   !> usual number of cycles, at which it begins at the latest
   integer, parameter :: patience(3) = [4, 8, 8], damped_cycles = 10
   !> A cycle that leaves more than this share of the residual is slow, unless another such cycle will do
   real(dp), parameter :: slow = 0.25_dp
   !> A predicted pressure with a residual of at most so many tolerances needs no sweep before the coarse grids: the
   !> prediction is smooth already
   real(dp), parameter :: close = 8.0_dp
   !> What comes after a cycle
   integer, parameter :: step_ends = 1, step_goes_on = 2, step_begins_again = 3

   type :: step_policy_t
      !> Most cycles a step
      integer :: max_cycles = 0
      !> Cycles of a step to begin with
      type(cycle_options_t) :: cycle
      !> Kind of coarsening; whether it changes for good when a cycle is slow, and the step in which it did (0: none)
      integer :: coarsening = coarsening_classical, changed_at = 0
      logical :: may_change = .false.
      !> Whether bodies touch at a boundary film: the conductance of their nodes does not bound their changes, and the
      !> coarsening stays the classical one
      logical :: touching = .false.
      !> The step under way: its largest residual (rms), whether it makes a cycle more to measure what that does, the
      !> attempt, the cycles made and how the next one is made
      real(dp) :: tolerance = 0.0_dp
      logical, private :: measured = .false.
      integer :: attempt = attempt_predicted, cycles = 0
      type(cycle_options_t) :: options
      !> Residuals after the last cycles of the attempt, the latest first
      real(dp), private :: past(0:maxval(patience)) = huge(1.0_dp)
   contains
      procedure :: set
      procedure :: begin
      procedure :: begin_attempt
      procedure :: after_cycle
   end type step_policy_t

contains

   !> For a run
   pure subroutine set(self, cycle_options, may_change, max_cycles)
      class(step_policy_t), intent(inout) :: self
      type(cycle_options_t), intent(in) :: cycle_options
      logical, intent(in) :: may_change
      integer, intent(in) :: max_cycles

      self%cycle = cycle_options
      self%coarsening = cycle_options%coarsening
      self%changed_at = 0
      self%may_change = may_change
      self%max_cycles = max_cycles
   end subroutine set

   !> A new step
   pure subroutine begin(self, tolerance, measured)
      class(step_policy_t), intent(inout) :: self
      real(dp), intent(in) :: tolerance
      logical, intent(in) :: measured

      self%tolerance = tolerance
      self%measured = measured
      self%attempt = attempt_predicted
      self%cycles = 0
   end subroutine begin

   !> An attempt whose first approximation has that residual (rms)
   pure subroutine begin_attempt(self, residual)
      class(step_policy_t), intent(inout) :: self
      real(dp), intent(in) :: residual

      self%past = huge(1.0_dp)
      self%options = self%cycle
      self%options%coarsening = self%coarsening
      self%options%enough = self%tolerance
      self%options%max_log_change = max_log_change(self%attempt)
      if (self%attempt == attempt_predicted .and. residual <= close*self%tolerance) then
         self%options%pre = 0
         self%options%post = self%cycle%pre + self%cycle%post
      end if
      if (self%attempt < attempt_damped) return
      self%options%relaxation_factor = damped_sweep
      self%options%correction_factor = merge(whole_correction, damped_correction, self%cycle%finest_only)
      self%options%finest_only = self%touching .or. self%cycle%finest_only
   end subroutine begin_attempt

   !> What comes after a cycle that has changed the residual from `before` to `residual`
   pure subroutine after_cycle(self, step, met, before, residual, next)
      class(step_policy_t), intent(inout) :: self
      !> Number of the step
      integer, intent(in) :: step
      !> Whether the step has met all its tolerances
      logical, intent(in) :: met
      real(dp), intent(in) :: before, residual
      integer, intent(out) :: next

      self%cycles = self%cycles + 1
      next = step_ends
      if (met .and. .not. (self%measured .and. self%cycles == 1)) return
      if (self%cycles >= damped_cycles*self%max_cycles) return
      self%past = [residual, self%past(:ubound(self%past, 1) - 1)]
      if (stuck(self)) then
         self%attempt = merge(attempt_damped, self%attempt + 1, self%touching .or. self%cycle%finest_only .or. &
                              self%cycles >= self%max_cycles)
         next = step_begins_again
         return
      end if
      next = step_goes_on
      if (self%options%pre < self%cycle%pre) then
         self%options%pre = self%cycle%pre
         self%options%post = self%cycle%post
         return
      end if
      if (residual <= max(slow*before, self%tolerance/slow)) return
      if (self%coarsening == coarsening_alcouffe) then
         ! one sweep more for the rest of the attempt; with classical coarsening it can make cycles slower
         self%options%pre = self%cycle%pre + 1
      else if (self%may_change .and. .not. self%touching) then
         self%coarsening = coarsening_alcouffe
         self%changed_at = step
         next = step_begins_again
      end if
   end subroutine after_cycle

   !> Whether the residual has not halved in the cycles that the attempt has for it, or the cycles are used up
   pure logical function stuck(self)
      type(step_policy_t), intent(in) :: self

      stuck = .false.
      if (self%attempt == attempt_damped) return
      ! a NaN has not halved
      stuck = self%cycles >= self%max_cycles .or. .not. self%past(0) <= 0.5_dp*self%past(patience(self%attempt))
   end function stuck
end module ehl_step_policy

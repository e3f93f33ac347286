! SPDX-License-Identifier: BSD-3-Clause
!> Options of the cycles of a time step: a sequence of attempts, and the coarsening
module ehl_step_policy
   use ehl_cycle, only: coarsening_alcouffe, coarsening_classical, cycle_options_t
   use ehl_kinds, only: dp
   use ehl_relaxation, only: usual_log_change
   implicit none (type, external)
   private
   public :: step_policy_t
   public :: attempt_predicted, attempt_last, attempt_limited, attempt_damped
   public :: step_ends, step_continues, step_restarts, damped_sweep, squeeze_correction

   !> Attempts at a step: from the predicted pressure; from the pressure of the last step, with limited relaxation; the same with a
   !> lower limit; the same with damped relaxation and coarse-grid corrections. The next attempt starts when the residual stalls:
   !> with solid contact, or where only the finest level is damped, the last one.
   integer, parameter :: attempt_predicted = 1, attempt_last = 2, attempt_limited = 3, attempt_damped = 4
   !> Maximum change of the logarithm of a node's conductance in a sweep, by attempt
   real(dp), parameter :: max_log_change(4) = usual_log_change/[1.0_dp, 3.0_dp, 9.0_dp, 9.0_dp]
   !> Factors of the changes by relaxation and coarse-grid correction in the damped attempt. Otherwise relaxation in which a peak
   !> jumps from node to node, and coarse grids that overshoot it, may lead to cycles that repeat states.
   real(dp), parameter :: damped_sweep = 0.3_dp, damped_correction = 0.5_dp
   !> Factor of the coarse-grid correction in a wide contact under squeeze motion, where only the finest level is damped
   real(dp), parameter :: squeeze_correction = 0.8_dp
   !> Cycles in which the residual must halve, by attempt. The last attempt starts at the cycle limit at the latest, and ends at
   !> `damped_cycles` times the limit.
   integer, parameter :: patience(3) = [4, 8, 8], damped_cycles = 10
   !> A cycle that leaves more than this fraction of the residual is slow, unless another such cycle would meet the tolerance
   real(dp), parameter :: slow = 0.25_dp
   !> Residual over the tolerance up to which a predicted pressure is smooth enough to need no pre-relaxation
   real(dp), parameter :: smooth_ratio = 8.0_dp
   !> Actions after a cycle
   integer, parameter :: step_ends = 1, step_continues = 2, step_restarts = 3

   type :: step_policy_t
      !> Cycle limit of a step
      integer :: max_cycles = 0
      !> Initial options of the cycles of a step
      type(cycle_options_t) :: cycle
      !> Coarsening, the step in which it changed permanently (0: none), and whether it may change after a slow cycle
      integer :: coarsening = coarsening_classical, changed_at = 0
      logical :: may_change = .false.
      !> Whether there is solid contact: the conductance then does not limit the changes of its nodes, and the coarsening remains
      !> classical
      logical :: solid_contact = .false.
      !> Present step: tolerance of the rms residual, whether it makes an additional cycle to measure the sensitivity, attempt,
      !> number of cycles, options of the next cycle
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

   !> Set up for a run
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

   !> Start a step
   pure subroutine begin(self, tolerance, measured)
      class(step_policy_t), intent(inout) :: self
      real(dp), intent(in) :: tolerance
      logical, intent(in) :: measured

      self%tolerance = tolerance
      self%measured = measured
      self%attempt = attempt_predicted
      self%cycles = 0
   end subroutine begin

   !> Start an attempt whose first approximation has the given rms residual
   pure subroutine begin_attempt(self, residual)
      class(step_policy_t), intent(inout) :: self
      real(dp), intent(in) :: residual

      self%past = huge(1.0_dp)
      self%options = self%cycle
      self%options%coarsening = self%coarsening
      self%options%enough = self%tolerance
      self%options%max_log_change = max_log_change(self%attempt)
      if (self%attempt == attempt_predicted .and. residual <= smooth_ratio*self%tolerance) then
         self%options%pre = 0
         self%options%post = self%cycle%pre + self%cycle%post
      end if
      if (self%attempt < attempt_damped) return
      self%options%relaxation_factor = damped_sweep
      self%options%correction_factor = merge(squeeze_correction, damped_correction, self%cycle%finest_only)
      self%options%finest_only = self%solid_contact .or. self%cycle%finest_only
   end subroutine begin_attempt

   !> Choose the action after a cycle that changed the residual from `before` to `residual`
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
      if (has_stalled(self)) then
         self%attempt = merge(attempt_damped, self%attempt + 1, self%solid_contact .or. self%cycle%finest_only .or. &
                              self%cycles >= self%max_cycles)
         next = step_restarts
         return
      end if
      next = step_continues
      if (self%options%pre < self%cycle%pre) then
         self%options%pre = self%cycle%pre
         self%options%post = self%cycle%post
         return
      end if
      if (residual <= max(slow*before, self%tolerance/slow)) return
      if (self%coarsening == coarsening_alcouffe) then
         ! another pre-relaxation for the rest of the attempt; with classical coarsening it can slow convergence
         self%options%pre = self%cycle%pre + 1
      else if (self%may_change .and. .not. self%solid_contact) then
         self%coarsening = coarsening_alcouffe
         self%changed_at = step
         next = step_restarts
      end if
   end subroutine after_cycle

   !> Whether the residual has not halved within the patience of the attempt, or the cycle limit is reached
   pure logical function has_stalled(self)
      type(step_policy_t), intent(in) :: self

      has_stalled = .false.
      if (self%attempt == attempt_damped) return
      ! true for NaN
      has_stalled = self%cycles >= self%max_cycles .or. .not. self%past(0) <= 0.5_dp*self%past(patience(self%attempt))
   end function has_stalled
end module ehl_step_policy

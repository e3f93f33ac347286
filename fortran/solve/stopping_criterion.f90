! SPDX-License-Identifier: BSD-3-Clause
!> Stopping criterion of a transient run
module ehl_stopping_criterion
   use ehl_friction_mean, only: friction_mean_t
   use ehl_kinds, only: dp
   use ehl_outcome, only: outcome_converged, outcome_running, outcome_unsettled
   use ehl_plan, only: plan_t
   use ehl_plan_need, only: max_periods
   use ehl_transient_state, only: transient_t
   implicit none (type, external)
   private
   public :: transient_outcome, min_periods

   !> Relative rounding of the end time of a duty
   real(dp), parameter :: end_rounding = 1.0e-9_dp

contains

   !> Status of a transient run after a converged step. A run that ends by its number of steps has converged only if the mean
   !> has settled.
   integer function transient_outcome(plan, transient) result(outcome)
      type(plan_t), intent(in) :: plan
      type(transient_t), intent(in) :: transient
      logical :: ends, settled

      if (plan%duty%active) then
         outcome = merge(outcome_running, outcome_converged, transient%time < plan%duty%end_time()*(1.0_dp - end_rounding))
         return
      end if
      associate (mean => transient%mean)
         if (plan%surfaces%pass_once()) then
            settled = mean%has_mean()
         else
            settled = mean%settled(plan%time_tolerance)
         end if
         ends = settled .or. mean%periods() >= max_periods(plan)
         if (plan%steps > 0) ends = transient%step >= plan%steps
      end associate
      outcome = outcome_running
      if (ends) outcome = merge(outcome_converged, outcome_unsettled, settled)
   end function transient_outcome

   !> Minimum number of periods of a transient run
   pure real(dp) function min_periods(plan, mean)
      type(plan_t), intent(in) :: plan
      type(friction_mean_t), intent(in) :: mean
      min_periods = merge(1.0_dp, 1.0_dp + mean%lag, plan%surfaces%pass_once())
   end function min_periods
end module ehl_stopping_criterion

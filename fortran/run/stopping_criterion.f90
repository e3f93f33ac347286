! SPDX-License-Identifier: BSD-3-Clause
!> When a transient run ends
module ehl_stopping_criterion
   use ehl_friction_mean, only: automatic_periods, friction_mean_t, periods_compared
   use ehl_kinds, only: dp
   use ehl_outcome, only: outcome_converged, outcome_running, outcome_unsettled
   use ehl_plan, only: plan_t
   use ehl_transient, only: transient_t
   implicit none (type, external)
   private
   public :: transient_outcome, least_periods, most_periods

contains

   !> How a transient run stands after a step that converged. One that ends after so many steps is converged only if it
   !> has settled by then.
   integer function transient_outcome(plan, transient) result(outcome)
      type(plan_t), intent(in) :: plan
      type(transient_t), intent(in) :: transient
      logical :: ends, settled

      associate (mean => transient%mean)
         if (plan%surfaces%pass_once()) then
            settled = mean%has_mean()
         else
            settled = mean%settled(plan%time_tolerance)
         end if
         ends = settled .or. mean%periods() >= most_periods(plan)
         if (plan%steps > 0) ends = transient%step >= plan%steps
      end associate
      outcome = outcome_running
      if (ends) outcome = merge(outcome_converged, outcome_unsettled, settled)
   end function transient_outcome

   !> Periods after which a transient run can end first
   pure real(dp) function least_periods(plan, mean)
      type(plan_t), intent(in) :: plan
      type(friction_mean_t), intent(in) :: mean
      least_periods = merge(1.0_dp, 1.0_dp + mean%lag, plan%surfaces%pass_once())
   end function least_periods

   !> Periods after which a transient run ends at the latest
   pure real(dp) function most_periods(plan)
      type(plan_t), intent(in) :: plan

      associate (most => merge(plan%max_periods, automatic_periods, plan%max_periods > 0), repeats => plan%surfaces%repeats)
         most_periods = most
         ! of several surfaces one period of all may be as long as that
         if (repeats > 1) most_periods = max(real(most, dp)/repeats, periods_compared(repeats))
      end associate
      if (plan%surfaces%pass_once()) most_periods = 1.0_dp
   end function most_periods
end module ehl_stopping_criterion

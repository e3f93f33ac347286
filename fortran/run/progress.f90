! SPDX-License-Identifier: BSD-3-Clause
!> Progress of a run: one line on the state, the work done, the time left
module ehl_progress
   use, intrinsic :: iso_fortran_env, only: int64
   use ehl_contact_run, only: contact_run_t, phase_stationary, phase_steps
   use ehl_kinds, only: dp
   use ehl_outcome, only: outcome_names
   use ehl_plan_need, only: max_periods
   use ehl_stopping_criterion, only: min_periods
   use ehl_text, only: fixed, to_text
   implicit none (type, external)
   private
   public :: end_after, progress_line, work_of

contains

   !> One line on the state, with the time left of a transient run
   function progress_line(run, outcome, done) result(text)
      class(contact_run_t), intent(in) :: run
      !> Status of the run, and whether the solver has ended
      integer, intent(in) :: outcome
      logical, intent(in) :: done
      character(len=:), allocatable :: text

      text = state_line(run, outcome)
      if (run%is_coarser) text = "for the error, on the next coarser grid: "//text
      if (run%phase == phase_steps .and. .not. done) text = text//time_left(run)
   end function progress_line

   !> The state without the time left
   function state_line(run, outcome) result(text)
      class(contact_run_t), intent(in) :: run
      integer, intent(in) :: outcome
      character(len=:), allocatable :: text, nodes
      real(dp) :: residual

      nodes = to_text(run%grid%nx)//" x "//to_text(run%grid%full_ny())
      if (run%phase == phase_steps .and. run%plan%duty%active) then
         associate (t => run%transient)
            residual = t%residual
            text = "step "//to_text(t%step)//"  t "//fixed(t%time*t%duty%time_scale, "es10.3")//" s  H_c "// &
                   fixed(t%m%film_central, "f10.6")//"  H_min "//fixed(t%m%film_minimum, "f10.6")//"  cycles "//to_text(t%cycles)
         end associate
      else if (run%phase == phase_steps) then
         associate (t => run%transient)
            residual = t%residual
            text = "step "//to_text(t%step)//"  T "//fixed(t%time, "f8.4")//"  mu_r/mu_s "// &
                   fixed(t%m%friction/t%friction_smooth, "f9.5")
            if (t%mean%has_mean()) text = text//"  mean "//fixed(t%mean%mean(0.0_dp), "f9.5")
            if (t%mean%has_change()) text = text//" +- "//fixed(t%mean%change(), "es8.1")
            text = text//"  H_min "//fixed(t%m%film_minimum, "f10.6")//"  cycles "//to_text(t%cycles)
         end associate
      else if (run%phase == phase_stationary) then
         associate (rough => run%stationary)
            residual = rough%residual
            text = nodes//"  cycle "//to_text(rough%total_cycles)//"  mu_r/mu_s "//fixed(rough%mu_ratio(), "f9.5")// &
                   "  H_c "//fixed(rough%m%film_central, "f10.6")//"  H_min "//fixed(rough%m%film_minimum, "f10.6")
         end associate
      else
         associate (result => run%smooth%results(run%level()))
            residual = result%residual
            text = nodes//"  cycle "//to_text(result%cycles)//"  H_c "//fixed(result%m%film_central, "f10.6")// &
                   "  H_min "//fixed(result%m%film_minimum, "f10.6")
         end associate
      end if
      text = text//"  residual "//fixed(residual, "es8.1")//"  "//trim(outcome_names(outcome))
      if (run%phase == phase_stationary .and. run%stationary%fraction < 1.0_dp .and. .not. run%stationary%smooth) then
         text = text//", fraction of the roughness "//fixed(run%stationary%fraction, "f7.4")
      end if
   end function state_line

   !> Work of a transient run in time steps of the finest grid, including the coarser grid: done, and at earliest and latest end.
   !> All are 0 before the first step. The coarser run comes first: before its first step it is assumed to need half the steps of
   !> the other run to its earliest end.
   pure subroutine work_of(run, done, earliest, latest)
      class(contact_run_t), intent(in) :: run
      real(dp), intent(out) :: done, earliest, latest
      real(dp) :: min_work, max_work

      done = 0.0_dp
      min_work = 0.5_dp*run%step_cost*run%other%earliest
      max_work = min_work
      if (run%phase == phase_steps .and. run%plan%duty%active) then
         ! in proportion to time, since the steps depend on the duty
         done = run%transient%step
         associate (t => run%transient, duty => run%plan%duty)
            min_work = done*max(1.0_dp, (duty%end_time() - duty%begin())/max(t%time - duty%begin(), tiny(1.0_dp)))
         end associate
         max_work = min_work
      else if (run%phase == phase_steps) then
         done = run%other%done + run%step_cost*run%transient%step
         min_work = run%other%done + run%step_cost*end_after(run, min_periods(run%plan, run%transient%mean))
         max_work = min_work
         if (.not. run%is_coarser) max_work = run%other%done + end_after(run, real(max_periods(run%plan), dp))
      end if
      earliest = run%other%earliest + min_work
      latest = run%other%latest + max_work
   end subroutine work_of

   !> Step of a transient run after a number of periods, or its last step if time.steps is set
   pure real(dp) function end_after(run, periods)
      class(contact_run_t), intent(in) :: run
      real(dp), intent(in) :: periods

      associate (mean => run%transient%mean)
         end_after = max(mean%filled, 1) + periods*mean%period/mean%time_step
      end associate
      if (run%plan%steps > 0) end_after = run%plan%steps
      end_after = max(end_after, real(run%transient%step, dp))
   end function end_after

   !> Time left, as text
   function time_left(run) result(text)
      class(contact_run_t), intent(in) :: run
      character(len=:), allocatable :: text
      real(dp) :: done, earliest, latest, seconds

      text = ""
      call work_of(run, done, earliest, latest)
      seconds = run%seconds + run%other%seconds
      if (.not. done > 0.0_dp) return
      if (earliest > done) then
         text = ", about "//to_text(nint((earliest - done)*seconds/done, int64))//" s left"
      else
         text = ", at most "//to_text(nint((latest - done)*seconds/done, int64))//" s left"
      end if
   end function time_left
end module ehl_progress

! SPDX-License-Identifier: BSD-3-Clause
!> What a run says on its way: one line about the state, how much is done, the time left
submodule (ehl_solver) ehl_solver_progress
   use, intrinsic :: iso_fortran_env, only: int64
   use ehl_outcome, only: outcome_names
   use ehl_plan_need, only: most_periods
   use ehl_stopping_criterion, only: least_periods
   use ehl_text, only: fixed, to_text
   implicit none (type, external)

contains

   module procedure progress
      if (allocated(self%coarse)) then
         text = "for the error, on the next coarser grid: "//state_line(self%coarse, self%coarse%outcome)
      else
         text = state_line(self, self%stand())
      end if
      if (self%in_steps .and. .not. self%done()) text = text//time_left(self)
   end procedure progress

   !> The state without the time left
   function state_line(run, stand) result(text)
      class(contact_run_t), intent(in) :: run
      integer, intent(in) :: stand
      character(len=:), allocatable :: text, nodes
      real(dp) :: residual

      nodes = to_text(run%grid%nx)//" x "//to_text(run%grid%full_ny())
      if (run%in_steps) then
         associate (t => run%transient)
            residual = t%residual
            text = "step "//to_text(t%step)//"  T "//fixed(t%time, "f8.4")//"  mu_r/mu_s "// &
                   fixed(t%m%friction/t%friction_smooth, "f9.5")
            if (t%mean%has_mean()) text = text//"  mean "//fixed(t%mean%mean(0.0_dp), "f9.5")
            if (t%mean%has_change()) text = text//" +- "//fixed(t%mean%change(), "es8.1")
            text = text//"  H_min "//fixed(t%m%film_minimum, "f10.6")//"  cycles "//to_text(t%cycles)
         end associate
      else if (run%resting) then
         residual = run%rest%residual
         text = nodes//"  cycle "//to_text(run%rest%total_cycles)//"  mu_r/mu_s "//fixed(run%rest%mu_ratio(), "f9.5")// &
                "  H_c "//fixed(run%rest%m%film_central, "f10.6")//"  H_min "//fixed(run%rest%m%film_minimum, "f10.6")
      else
         associate (result => run%steady%results(run%level()))
            residual = result%residual
            text = nodes//"  cycle "//to_text(result%cycles)//"  H_c "//fixed(result%m%film_central, "f10.6")// &
                   "  H_min "//fixed(result%m%film_minimum, "f10.6")
         end associate
      end if
      text = text//"  residual "//fixed(residual, "es8.1")//"  "//trim(outcome_names(stand))
      if (run%resting .and. run%rest%share < 1.0_dp .and. .not. run%rest%smooth) then
         text = text//", share of the roughness "//fixed(run%rest%share, "f7.4")
      end if
   end function state_line

   module procedure work
      real(dp) :: coarse

      done = 0.0_dp
      earliest = 0.0_dp
      latest = 0.0_dp
      if (.not. self%in_steps) return
      ! the run on the next coarser grid comes first: it has half as many steps
      coarse = self%coarse_work
      if (allocated(self%coarse)) then
         coarse = 0.5_dp*coarse_step*end_after(self, least_periods(self%plan, self%transient%mean))
         if (self%coarse%in_steps) then
            done = coarse_step*self%coarse%transient%step
            coarse = coarse_step*end_after(self%coarse, least_periods(self%coarse%plan, self%coarse%transient%mean))
         end if
      else
         done = coarse
      end if
      done = done + self%transient%step
      earliest = end_after(self, least_periods(self%plan, self%transient%mean)) + coarse
      latest = end_after(self, real(most_periods(self%plan), dp)) + coarse
   end procedure work

   !> Step that a transient run has reached after so many periods, or that it is to end after
   pure real(dp) function end_after(run, periods)
      class(contact_run_t), intent(in) :: run
      real(dp), intent(in) :: periods

      associate (mean => run%transient%mean)
         end_after = max(mean%filled, 1) + periods*mean%period/mean%time_step
      end associate
      if (run%plan%steps > 0) end_after = run%plan%steps
      end_after = max(end_after, real(run%transient%step, dp))
   end function end_after

   !> The time left in words
   function time_left(self) result(text)
      class(solver_t), intent(in) :: self
      character(len=:), allocatable :: text
      real(dp) :: done, earliest, latest, seconds

      text = ""
      call self%work(done, earliest, latest)
      seconds = self%seconds + self%coarse_seconds
      if (allocated(self%coarse)) seconds = seconds + self%coarse%seconds
      if (.not. done > 0.0_dp) return
      if (earliest > done) then
         text = ", about "//to_text(nint((earliest - done)*seconds/done, int64))//" s left"
      else
         text = ", at most "//to_text(nint((latest - done)*seconds/done, int64))//" s left"
      end if
   end function time_left
end submodule ehl_solver_progress

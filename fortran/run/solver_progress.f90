! SPDX-License-Identifier: BSD-3-Clause
!> What a run says on its way: one line about the state, how much is done, the time left
submodule (ehl_solver) ehl_solver_progress
   use, intrinsic :: iso_fortran_env, only: int64
   use ehl_stopping_criterion, only: least_periods, most_periods
   use ehl_report, only: cycle_line, step_line, rest_line
   use ehl_text, only: to_text
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
      character(len=:), allocatable :: text

      if (run%in_steps) then
         text = step_line(run%transient, stand)
      else if (run%resting) then
         text = rest_line(run%grid, run%rest, stand)
      else
         text = cycle_line(run%grid, run%steady%results(run%level()), stand)
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

! SPDX-License-Identifier: BSD-3-Clause
!> Predictions from Python for a solver; for the rules see ehl_f2py_solver
module ehl_f2py_predicted
   use, intrinsic :: iso_c_binding, only: c_double, c_int
   use ehl_handles, only: reply, run_of, run_t
   use ehl_predicted_start, only: fronts_at_start => start_fronts
   use ehl_status, only: ehl_bad_input, status_t
   implicit none (type, external)
   private
   public :: take_prediction, start_fronts, take_start

contains

   !> Set the predicted parts of mu_ratio due to truncated and to unresolved waves; NaN: no prediction
   subroutine take_prediction(handle, truncated, unresolved, stat, message)
      integer(c_int), intent(in) :: handle
      real(c_double), intent(in) :: truncated, unresolved
      integer(c_int), intent(out) :: stat
      character(len=4096), intent(out) :: message
      type(run_t), pointer :: run
      type(status_t) :: status

      call run_of(handle, run, status)
      if (.not. status%failed()) then
         run%solver%waves_predicted = .true.
         run%solver%predicted_waves = [truncated, unresolved]
      end if
      call reply(status, stat, message)
   end subroutine take_prediction

   !> Positions of the fronts of n surfaces [a] at which the predicted start needs the pressure of the roughness; n = 0: not
   !> needed
   subroutine start_fronts(handle, fronts, n, stat, message)
      integer(c_int), intent(in) :: handle
      real(c_double), intent(out) :: fronts(4, 2)
      integer(c_int), intent(out) :: n, stat
      character(len=4096), intent(out) :: message
      type(run_t), pointer :: run
      type(status_t) :: status

      n = 0
      fronts = 0.0_c_double
      call run_of(handle, run, status)
      if (.not. status%failed()) then
         associate (plan => run%solver%run%plan)
            if (plan%predicted_start) then
               n = plan%surfaces%count()
               fronts(:, :n) = fronts_at_start(plan%surfaces, plan%finest)
            end if
         end associate
      end if
      call reply(status, stat, message)
   end subroutine start_fronts

   !> Pass the pressure of the roughness [p_h] on the whole finest grid to the solver, or the reason why it is not predicted
   subroutine take_start(handle, why, nx, ny, pressure, stat, message)
      integer(c_int), intent(in) :: handle, nx, ny
      character(len=*), intent(in) :: why
      real(c_double), intent(inout) :: pressure(nx, ny, 4)
      integer(c_int), intent(out) :: stat
      character(len=4096), intent(out) :: message
      type(run_t), pointer :: run
      type(status_t) :: status

      call run_of(handle, run, status)
      if (why == "" .and. .not. status%failed()) then
         associate (grid => run%solver%run%plan%finest)
            if (nx /= grid%nx .or. ny /= grid%full_ny()) call status%fail(ehl_bad_input, &
               "the pressure does not have the shape of the finest grid")
         end associate
      end if
      if (.not. status%failed()) then
         associate (solver => run%solver)
            if (why /= "") then
               solver%run%fallback_reason = why
            else
               call solver%run%predicted%set_pressure(solver%run%plan%surfaces, solver%run%plan%finest, pressure)
            end if
         end associate
      end if
      call reply(status, stat, message)
   end subroutine take_start
end module ehl_f2py_predicted

! SPDX-License-Identifier: BSD-3-Clause
!> States of transient runs on disk, for Python; for the rules see ehl_f2py_solver
module ehl_f2py_checkpoints
   use, intrinsic :: iso_c_binding, only: c_double, c_int
   use ehl_checkpoint_folder, only: checkpoint_path, find_checkpoint
   use ehl_handles, only: run_of, run_t
   use ehl_reply, only: reply
   use ehl_status, only: status_t
   implicit none (type, external)
   private
   public :: checkpoint_case, resume, keep, save_state, end_keeping

contains

   !> Case file of the run with these results, to resume it; its folder holds surface.npy, and second_surface.npy, as well
   !> when these surfaces came from Python
   subroutine checkpoint_case(results, path, stat, message)
      character(len=*), intent(in) :: results
      character(len=4096), intent(out) :: path
      integer(c_int), intent(out) :: stat
      character(len=4096), intent(out) :: message
      real(c_double), allocatable :: heights(:, :), second(:, :)
      character(len=:), allocatable :: text
      type(status_t) :: status

      path = ""
      call find_checkpoint(results, text, heights, second, status)
      if (.not. status%failed()) path = text
      call reply(status, stat, message)
   end subroutine checkpoint_case

   !> Resume from the newest state of the run with these results; before the first advance
   subroutine resume(handle, results, note, stat, message)
      integer(c_int), intent(in) :: handle
      character(len=*), intent(in) :: results
      character(len=4096), intent(out) :: note
      integer(c_int), intent(out) :: stat
      character(len=4096), intent(out) :: message
      type(run_t), pointer :: run
      type(status_t) :: status
      character(len=:), allocatable :: text

      note = ""
      call run_of(handle, run, status)
      if (.not. status%failed()) then
         call run%solver%resume(checkpoint_path(results), text, status)
         if (.not. status%failed()) note = text
      end if
      call reply(status, stat, message)
   end subroutine resume

   !> Keep states of the run beside its results, at the interval of the case; `resumed` names the
   !> results of the run that is resumed; with has_heights and has_second on the surfaces of
   !> open_case too
   subroutine keep(handle, results, resumed, has_heights, nx, ny, heights, has_second, mx, my, second, note, stat, message)
      integer(c_int), intent(in) :: handle
      character(len=*), intent(in) :: results, resumed
      integer(c_int), intent(in) :: has_heights, nx, ny, has_second, mx, my
      real(c_double), intent(inout) :: heights(nx, ny), second(mx, my)
      character(len=4096), intent(out) :: note
      integer(c_int), intent(out) :: stat
      character(len=4096), intent(out) :: message
      type(run_t), pointer :: run
      type(status_t) :: status
      character(len=:), allocatable :: text

      note = ""
      call run_of(handle, run, status)
      if (.not. status%failed()) then
         associate (n => merge(nx, 0, has_heights /= 0), m => merge(mx, 0, has_second /= 0))
            call run%checkpoints%open(results, run%input, run%solver, resumed, heights(:n, :), second(:m, :), text, status)
         end associate
         if (.not. status%failed()) note = text
      end if
      call reply(status, stat, message)
   end subroutine keep

   !> Save the state if its time has come, or at once; has_state tells whether there is one now
   subroutine save_state(handle, at_once, has_state, stat, message)
      integer(c_int), intent(in) :: handle, at_once
      integer(c_int), intent(out) :: has_state, stat
      character(len=4096), intent(out) :: message
      type(run_t), pointer :: run
      type(status_t) :: status

      has_state = 0
      call run_of(handle, run, status)
      if (.not. status%failed()) then
         if (at_once /= 0) then
            call run%checkpoints%save(run%solver, status)
            if (run%checkpoints%has_state()) has_state = 1
         else
            call run%checkpoints%tick(run%solver, status)
         end if
      end if
      call reply(status, stat, message)
   end subroutine save_state

   !> Remove the states: the run has come to a good end
   subroutine end_keeping(handle, stat, message)
      integer(c_int), intent(in) :: handle
      integer(c_int), intent(out) :: stat
      character(len=4096), intent(out) :: message
      type(run_t), pointer :: run
      type(status_t) :: status

      call run_of(handle, run, status)
      if (.not. status%failed()) call run%checkpoints%close()
      call reply(status, stat, message)
   end subroutine end_keeping
end module ehl_f2py_checkpoints

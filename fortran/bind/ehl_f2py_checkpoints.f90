! SPDX-License-Identifier: BSD-3-Clause
!> States of transient runs on disk, for Python; for the rules see ehl_f2py_solver
module ehl_f2py_checkpoints
   use, intrinsic :: iso_c_binding, only: c_double, c_int
   use ehl_checkpoint_folder, only: find_checkpoint
   use ehl_handles, only: run_of, run_t
   use ehl_reply, only: reply
   use ehl_status, only: status_t
   implicit none (type, external)
   private
   public :: checkpoint_case, keep

contains

   !> Case file of the run with these results, to resume it; its folder holds surface.npy as well when
   !> the surface came from Python
   subroutine checkpoint_case(results, path, stat, message)
      character(len=*), intent(in) :: results
      character(len=4096), intent(out) :: path
      integer(c_int), intent(out) :: stat
      character(len=4096), intent(out) :: message
      real(c_double), allocatable :: heights(:, :)
      character(len=:), allocatable :: text
      type(status_t) :: status

      path = ""
      call find_checkpoint(results, text, heights, status)
      if (.not. status%failed()) path = text
      call reply(status, stat, message)
   end subroutine checkpoint_case

   !> Keep states of the run beside its results, at the interval of the case; `resumed` names the
   !> results of the run that is resumed; with has_heights on the surface of open_case too
   subroutine keep(handle, results, resumed, has_heights, nx, ny, heights, note, stat, message)
      integer(c_int), intent(in) :: handle
      character(len=*), intent(in) :: results, resumed
      integer(c_int), intent(in) :: has_heights, nx, ny
      real(c_double), intent(inout) :: heights(nx, ny)
      character(len=4096), intent(out) :: note
      integer(c_int), intent(out) :: stat
      character(len=4096), intent(out) :: message
      type(run_t), pointer :: run
      type(status_t) :: status
      character(len=:), allocatable :: text

      note = ""
      call run_of(handle, run, status)
      if (.not. status%failed()) then
         associate (n => merge(nx, 0, has_heights /= 0))
            call run%checkpoints%open(results, run%input, run%solver, resumed, heights(:n, :), text, status)
         end associate
         if (.not. status%failed()) note = text
      end if
      call reply(status, stat, message)
   end subroutine keep
end module ehl_f2py_checkpoints

! SPDX-License-Identifier: BSD-3-Clause
!> Folders for results, for Python; for the rules see ehl_f2py_solver
module ehl_f2py_destination
   use, intrinsic :: iso_c_binding, only: c_int
   use ehl_destination, only: destination_t
   use ehl_reply, only: reply
   use ehl_result_folder, only: result_names
   use ehl_status, only: status_t
   implicit none (type, external)
   private
   public :: place

contains

   !> A step on the way of a result to its folder: 'check', 'resume' (a check for a result that is completed), 'begin',
   !> which gives an empty folder `fresh`, or 'finish' with that. Lists have a line end behind each item.
   subroutine place(step, folder, kind, names, inputs, kept, force, made, fresh, stat, message)
      character(len=*), intent(in) :: step, folder, kind, names, inputs, kept
      integer(c_int), intent(in) :: force
      !> The folder that 'begin' gave
      character(len=*), intent(in) :: made
      character(len=4096), intent(out) :: fresh
      integer(c_int), intent(out) :: stat
      character(len=4096), intent(out) :: message
      type(destination_t) :: destination
      type(status_t) :: status
      character(len=:), allocatable :: path

      fresh = ""
      destination = destination_t(folder, kind, names, inputs, kept, force /= 0)
      ! the library knows what it writes
      if (kind == "solution") destination%names = result_names
      select case (step)
      case ("begin")
         call destination%begin(path, status)
         fresh = path
      case ("finish")
         call destination%finish(made, status)
      case default
         call destination%check(status, resumes=step == "resume")
      end select
      call reply(status, stat, message)
   end subroutine place
end module ehl_f2py_destination

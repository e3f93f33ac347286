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
   public :: check_folder, begin_folder, finish_folder

contains

   !> Refuse a folder that must not be touched, or cannot be written, for a result that takes the place of an
   !> earlier one or resumes it. Lists have a line end behind each item.
   subroutine check_folder(folder, kind, names, inputs, kept, force, resumes, stat, message)
      character(len=*), intent(in) :: folder, kind, names, inputs, kept
      integer(c_int), intent(in) :: force, resumes
      integer(c_int), intent(out) :: stat
      character(len=4096), intent(out) :: message
      type(destination_t) :: destination
      type(status_t) :: status

      destination = new_destination(folder, kind, names, inputs, kept, force)
      call destination%check(status, resumes /= 0)
      call reply(status, stat, message)
   end subroutine check_folder

   !> Check, and make an empty folder for the files of the result
   subroutine begin_folder(folder, kind, names, inputs, kept, force, fresh, stat, message)
      character(len=*), intent(in) :: folder, kind, names, inputs, kept
      integer(c_int), intent(in) :: force
      character(len=4096), intent(out) :: fresh
      integer(c_int), intent(out) :: stat
      character(len=4096), intent(out) :: message
      type(destination_t) :: destination
      type(status_t) :: status
      character(len=:), allocatable :: place

      destination = new_destination(folder, kind, names, inputs, kept, force)
      call destination%begin(place, status)
      fresh = place
      call reply(status, stat, message)
   end subroutine begin_folder

   !> Check again, and put the files in that folder in place
   subroutine finish_folder(folder, kind, names, inputs, kept, force, fresh, stat, message)
      character(len=*), intent(in) :: folder, kind, names, inputs, kept, fresh
      integer(c_int), intent(in) :: force
      integer(c_int), intent(out) :: stat
      character(len=4096), intent(out) :: message
      type(destination_t) :: destination
      type(status_t) :: status

      destination = new_destination(folder, kind, names, inputs, kept, force)
      call destination%finish(fresh, status)
      call reply(status, stat, message)
   end subroutine finish_folder

   !> A folder for a result; the library knows the names of a solution
   function new_destination(folder, kind, names, inputs, kept, force) result(destination)
      character(len=*), intent(in) :: folder, kind, names, inputs, kept
      integer(c_int), intent(in) :: force
      type(destination_t) :: destination

      destination = destination_t(folder, kind, names, inputs, kept, force /= 0)
      if (kind == "solution") destination%names = result_names
   end function new_destination
end module ehl_f2py_destination

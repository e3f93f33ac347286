! SPDX-License-Identifier: BSD-3-Clause
!> Table of solvers, which Python identifies by handles, and replies of routines to Python
module ehl_handles
   use, intrinsic :: iso_c_binding, only: c_int
   use ehl_case, only: case_t
   use ehl_checkpoint_folder, only: checkpoint_folder_t
   use ehl_lock, only: lock, lock_t, unlock
   use ehl_solver, only: solver_t
   use ehl_status, only: ehl_closed, ehl_no_memory, status_t
   use ehl_text, only: to_text
   implicit none (type, external)
   private
   public :: run_t, new_handle, drop_handle, run_of, reply, put_text, fitted

   !> A run: resolved input, solver, states on disk
   type :: run_t
      type(case_t) :: input
      type(solver_t) :: solver
      type(checkpoint_folder_t) :: checkpoints
   end type run_t

   !> An entry of the table
   type :: slot_t
      type(run_t), pointer :: run => null()
      !> Number of handles issued for this entry; no handle is used twice
      integer :: generation = 0
   end type slot_t

   integer, parameter :: places = 64
   type(slot_t) :: table(places)
   type(lock_t), target :: table_lock

contains

   !> Create a run in a free entry
   subroutine new_handle(handle, run, status)
      integer, intent(out) :: handle
      type(run_t), pointer, intent(out) :: run
      type(status_t), intent(inout) :: status
      integer :: k, stat

      handle = 0
      nullify (run)
      call lock(table_lock, status)
      if (status%failed()) return
      do k = 1, places
         if (associated(table(k)%run)) cycle
         allocate (run, stat=stat)
         if (stat /= 0) exit
         table(k)%run => run
         table(k)%generation = table(k)%generation + 1
         handle = places*table(k)%generation + k
         exit
      end do
      call unlock(table_lock, status)
      if (handle == 0) call status%fail(ehl_no_memory, "no room for another solver: close one of " &
                                        // to_text(places))
   end subroutine new_handle

   !> Run of a handle; fails if the handle is closed or was never opened
   subroutine run_of(handle, run, status)
      integer, intent(in) :: handle
      type(run_t), pointer, intent(out) :: run
      type(status_t), intent(inout) :: status

      call find(handle, .false., run, status)
      if (.not. associated(run)) call status%fail(ehl_closed, "the solver is closed")
   end subroutine run_of

   !> Free a run and its entry, unless the handle is closed already
   subroutine drop_handle(handle, status)
      integer, intent(in) :: handle
      type(status_t), intent(inout) :: status
      type(run_t), pointer :: run

      call find(handle, .true., run, status)
      if (.not. associated(run)) return
      call run%checkpoints%release()
      deallocate (run)
   end subroutine drop_handle

   !> Run of a handle, not associated if there is none. With `take` it is removed from the table, so that only one caller gets it.
   subroutine find(handle, take, run, status)
      integer, intent(in) :: handle
      logical, intent(in) :: take
      type(run_t), pointer, intent(out) :: run
      type(status_t), intent(inout) :: status
      integer :: k

      nullify (run)
      if (handle <= places) return
      k = modulo(handle - 1, places) + 1
      call lock(table_lock, status)
      if (status%failed()) return
      if (places*table(k)%generation + k == handle) then
         run => table(k)%run
         if (take) nullify (table(k)%run)
      end if
      call unlock(table_lock, status)
   end subroutine find

   !> Return the code and the text of a status to Python
   subroutine reply(status, stat, message)
      type(status_t), intent(in) :: status
      integer(c_int), intent(out) :: stat
      character(len=4096), intent(out) :: message

      stat = int(status%code, c_int)
      message = ""
      if (status%failed()) message = fitted(status%message, len(message))
   end subroutine reply

   !> Copy a text into an array of bytes, and return its length; if it does not fit the caller repeats with a larger array
   subroutine put_text(text, bytes, length)
      character(len=*), intent(in) :: text
      integer(c_int), intent(inout) :: bytes(:)
      integer(c_int), intent(out) :: length
      integer :: k

      length = int(len(text), c_int)
      do k = 1, min(size(bytes), len(text))
         bytes(k) = iachar(text(k:k))
      end do
   end subroutine put_text

   !> Fit a message into a buffer of fixed length; one that is cut ends with a mark
   pure function fitted(text, room) result(words)
      character(len=*), intent(in) :: text
      integer, intent(in) :: room
      character(len=room) :: words
      character(len=*), parameter :: cut = " ... (the rest does not fit)"

      words = text
      if (len_trim(text) > room) words(room - len(cut) + 1:) = cut
   end function fitted
end module ehl_handles

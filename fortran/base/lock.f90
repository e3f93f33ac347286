! SPDX-License-Identifier: BSD-3-Clause
!> Locks that hold between all threads of a process, OpenMP's and others, and in a build without OpenMP: POSIX mutexes
module ehl_lock
   use, intrinsic :: iso_c_binding, only: c_int, c_int64_t
   use ehl_status, only: ehl_internal, status_t
   use ehl_text, only: to_text
   implicit none (type, external)
   private
   public :: lock_t, lock, unlock

   !> A mutex, open at first: the GNU and musl libraries call one open that is all zero. More room than any of them
   !> takes (40 bytes). To be a module's variable, with the attribute target.
   type, bind(c) :: lock_t
      integer(c_int64_t) :: mutex(16) = 0
   end type lock_t

   interface
      integer(c_int) function pthread_mutex_lock(mutex) bind(c)
         import :: c_int, lock_t
         implicit none (type, external)
         type(lock_t), intent(inout) :: mutex
      end function pthread_mutex_lock

      integer(c_int) function pthread_mutex_unlock(mutex) bind(c)
         import :: c_int, lock_t
         implicit none (type, external)
         type(lock_t), intent(inout) :: mutex
      end function pthread_mutex_unlock
   end interface

contains

   !> Wait until the lock is free, and take it. After a failure, also an earlier one, the caller does not hold it.
   subroutine lock(self, status)
      type(lock_t), intent(inout) :: self
      type(status_t), intent(inout) :: status
      if (status%failed()) return
      call check(pthread_mutex_lock(self), status)
   end subroutine lock

   !> Open it
   subroutine unlock(self, status)
      type(lock_t), intent(inout) :: self
      type(status_t), intent(inout) :: status
      call check(pthread_mutex_unlock(self), status)
   end subroutine unlock

   !> A failure where the system refuses
   subroutine check(code, status)
      integer(c_int), intent(in) :: code
      type(status_t), intent(inout) :: status
      if (code /= 0) call status%fail(ehl_internal, "a lock between threads failed: error "//to_text(int(code))//" of the system")
   end subroutine check
end module ehl_lock

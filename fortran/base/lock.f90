! SPDX-License-Identifier: BSD-3-Clause
!> Locks between all threads of a process, those of OpenMP and others, also in a build without OpenMP: POSIX mutexes
module ehl_lock
   use, intrinsic :: iso_c_binding, only: c_int, c_int64_t
   use ehl_status, only: ehl_internal, status_t
   use ehl_text, only: to_text
   implicit none (type, external)
   private
   public :: lock_t, lock, unlock

   !> A mutex, initially unlocked: all zero in the GNU and musl libraries. It is larger than in any of them
   !> (at most 48 bytes). It must be a module variable with the attribute target.
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

   !> Wait until the lock is free, and acquire it. After a failure, also an earlier one, the caller does not hold it.
   subroutine lock(self, status)
      type(lock_t), intent(inout) :: self
      type(status_t), intent(inout) :: status
      if (status%failed()) return
      call check(pthread_mutex_lock(self), status)
   end subroutine lock

   !> Release the lock
   subroutine unlock(self, status)
      type(lock_t), intent(inout) :: self
      type(status_t), intent(inout) :: status
      call check(pthread_mutex_unlock(self), status)
   end subroutine unlock

   !> Fail if a system call returned an error
   subroutine check(code, status)
      integer(c_int), intent(in) :: code
      type(status_t), intent(inout) :: status
      if (code /= 0) call status%fail(ehl_internal, "locking between threads failed: system error "//to_text(int(code)))
   end subroutine check
end module ehl_lock

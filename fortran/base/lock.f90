! SPDX-License-Identifier: BSD-3-Clause
!> Locks that hold between all threads of a process, OpenMP's and others, and in a build without OpenMP: POSIX mutexes
module ehl_lock
   use, intrinsic :: iso_c_binding, only: c_int, c_int64_t
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

   !> Wait until the lock is open, and close it
   subroutine lock(self)
      type(lock_t), intent(inout) :: self
      integer(c_int) :: stat
      ! fails only for a mutex that is none
      stat = pthread_mutex_lock(self)
   end subroutine lock

   !> Open it
   subroutine unlock(self)
      type(lock_t), intent(inout) :: self
      integer(c_int) :: stat
      stat = pthread_mutex_unlock(self)
   end subroutine unlock
end module ehl_lock

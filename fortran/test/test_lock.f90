! SPDX-License-Identifier: BSD-3-Clause
!> Locks, valid and invalid
module test_lock
   use check, only: is_equal, is_true
   use ehl_lock, only: lock, lock_t, unlock
   use ehl_status, only: ehl_internal, status_t
   implicit none (type, external)
   private
   public :: run_lock

   !> A valid lock, and one that is no mutex
   type(lock_t), target :: valid, invalid

contains

   !> A system error is reported, and the lock is not held
   subroutine run_lock()
      type(status_t) :: fine, bad

      call lock(valid, fine)
      call unlock(valid, fine)
      call lock(valid, fine)
      call unlock(valid, fine)
      call is_true(.not. fine%failed(), "lock and unlock")
      invalid%mutex = -1
      call lock(invalid, bad)
      call is_equal(bad%code, ehl_internal, "lock that is no mutex")
      ! after a failure the lock is not acquired: otherwise this would wait for ever
      call lock(valid, bad)
      call lock(valid, fine)
      call unlock(valid, fine)
      call is_true(.not. fine%failed(), "lock after a failure")
   end subroutine run_lock
end module test_lock

! SPDX-License-Identifier: BSD-3-Clause
!> Files with a checksum: what is written is read again, and damage is seen
module test_sealed
   use, intrinsic :: iso_fortran_env, only: int8
   use check, only: has_text, is_close, is_true
   use ehl_files, only: process_mark, remove_file
   use ehl_kinds, only: dp
   use ehl_sealed_file, only: end_reading, end_sealed, is_sealed, open_sealed
   use ehl_status, only: status_t
   implicit none (type, external)
   private
   public :: run_sealed

contains

   subroutine run_sealed()
      type(status_t) :: status
      character(len=:), allocatable :: path
      character(len=256) :: reason
      real(dp) :: stack(40, 50, 6), again(40, 50, 6), more(40)
      integer :: lun, stat
      logical :: gone

      path = "sealed-"//process_mark()
      call random_number(stack)
      call open_sealed(path, "write", lun, status)
      write (lun, iostat=stat, iomsg=reason) stack
      call end_sealed(lun, path, stat, reason, status)
      call is_true(.not. status%failed(), "written")
      call is_true(is_sealed(path), "and sealed")
      call open_sealed(path, "read", lun, status)
      read (lun, iostat=stat, iomsg=reason) again
      call end_reading(lun, path, stat, reason, status)
      call is_true(.not. status%failed(), "read")
      call is_close(maxval(abs(again - stack)), 0.0_dp, 0.0_dp, "what was written is read")
      call open_sealed(path, "read", lun, status)
      read (lun, iostat=stat, iomsg=reason) again, more
      call end_reading(lun, path, stat, reason, status)
      call has_text(status%message, "cannot read", "more than there is")
      open (newunit=lun, file=path, access="stream", form="unformatted", status="old", action="readwrite")
      read (lun, pos=1000) stat
      write (lun, pos=1000) ieor(stat, 1)
      close (lun)
      call is_true(.not. is_sealed(path), "one other bit is seen")
      open (newunit=lun, file=path, access="stream", form="unformatted", status="replace")
      write (lun) 1_int8
      close (lun)
      call is_true(.not. is_sealed(path), "a file shorter than a checksum")
      gone = remove_file(path)
      call is_true(.not. is_sealed(path), "a file that is not there")
   end subroutine run_sealed
end module test_sealed

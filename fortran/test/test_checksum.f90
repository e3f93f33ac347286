! SPDX-License-Identifier: BSD-3-Clause
!> Files with a checksum: written values are read back, and damage is detected
module test_checksum
   use, intrinsic :: iso_fortran_env, only: int8
   use check, only: has_text, is_close, is_true
   use ehl_files, only: process_mark, remove_file
   use ehl_kinds, only: dp
   use ehl_checksummed_file, only: end_reading, end_checksummed, has_checksum, open_checksummed
   use ehl_status, only: status_t
   implicit none (type, external)
   private
   public :: run_checksum

contains

   subroutine run_checksum()
      type(status_t) :: status
      character(len=:), allocatable :: path
      character(len=256) :: reason
      real(dp) :: stack(40, 50, 6), again(40, 50, 6), more(40)
      integer :: lun, stat
      logical :: gone

      path = "checksum-"//process_mark()
      call random_number(stack)
      call open_checksummed(path, "write", lun, status)
      write (lun, iostat=stat, iomsg=reason) stack
      call end_checksummed(lun, path, stat, reason, status)
      call is_true(.not. status%failed(), "written")
      call is_true(has_checksum(path), "and its checksum is right")
      call open_checksummed(path, "read", lun, status)
      read (lun, iostat=stat, iomsg=reason) again
      call end_reading(lun, path, stat, reason, status)
      call is_true(.not. status%failed(), "read")
      call is_close(maxval(abs(again - stack)), 0.0_dp, 0.0_dp, "what was written is read")
      call open_checksummed(path, "read", lun, status)
      read (lun, iostat=stat, iomsg=reason) again, more
      call end_reading(lun, path, stat, reason, status)
      call has_text(status%message, "cannot read", "more than there is")
      open (newunit=lun, file=path, access="stream", form="unformatted", status="old", action="readwrite")
      read (lun, pos=1000) stat
      write (lun, pos=1000) ieor(stat, 1)
      close (lun)
      call is_true(.not. has_checksum(path), "one changed bit is detected")
      open (newunit=lun, file=path, access="stream", form="unformatted", status="replace")
      write (lun) 1_int8
      close (lun)
      call is_true(.not. has_checksum(path), "a file shorter than a checksum")
      gone = remove_file(path)
      call is_true(.not. has_checksum(path), "a file that is not there")
   end subroutine run_checksum
end module test_checksum

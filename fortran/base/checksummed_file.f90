! SPDX-License-Identifier: BSD-3-Clause
!> Binary files that end with a checksum of the preceding bytes
module ehl_checksummed_file
   use, intrinsic :: iso_fortran_env, only: int64, int8
   use ehl_files, only: file_bytes, flush_file
   use ehl_status, only: ehl_file, status_t
   use ehl_whole_file, only: end_writing
   implicit none (type, external)
   private
   public :: open_checksummed, end_checksummed, end_reading, has_checksum

   !> Number of bytes read at a time, and bytes of a checksum
   integer, parameter :: block = 65536, of_checksum = 8
   !> Initial value of the checksum, and number of bits by which each byte rotates it
   integer(int64), parameter :: initial_value = 1234567890123456789_int64
   integer, parameter :: rotation = 7

contains

   !> Open a file to "write" it, replacing an existing one, or to "read" it
   subroutine open_checksummed(path, action, lun, status)
      character(len=*), intent(in) :: path, action
      integer, intent(out) :: lun
      type(status_t), intent(inout) :: status
      character(len=256) :: reason
      integer :: stat

      open (newunit=lun, file=path, status=trim(merge("replace", "old    ", action == "write")), action=action, &
            access="stream", form="unformatted", iostat=stat, iomsg=reason)
      if (stat /= 0) call status%fail(ehl_file, path//": error: cannot "//action//": "//trim(reason))
   end subroutine open_checksummed

   !> Append the checksum and close a file that was written. It is flushed to the disk, so that it survives a power failure.
   subroutine end_checksummed(lun, path, stat, reason, status)
      integer, intent(in) :: lun
      character(len=*), intent(in) :: path
      !> iostat and iomsg of the last write
      integer, intent(in) :: stat
      character(len=*), intent(in) :: reason
      type(status_t), intent(inout) :: status
      character(len=256) :: why
      integer(int64) :: bytes, ours
      integer :: again, appending

      inquire (unit=lun, pos=bytes)
      bytes = bytes - 1
      call end_writing(lun, path, bytes, stat, reason, status)
      if (status%failed()) return
      ours = checksum(path, bytes)
      open (newunit=again, file=path, status="old", action="write", position="append", access="stream", &
            form="unformatted", iostat=appending, iomsg=why)
      if (appending == 0) write (again, iostat=appending, iomsg=why) ours
      call end_writing(again, path, bytes + of_checksum, appending, why, status)
      if (status%failed()) return
      if (.not. flush_file(path)) call status%fail(ehl_file, path//": cannot write: it cannot be flushed to the disk")
   end subroutine end_checksummed

   !> Close a file that was read
   subroutine end_reading(lun, path, stat, reason, status)
      integer, intent(in) :: lun
      character(len=*), intent(in) :: path
      !> iostat and iomsg of the last read
      integer, intent(in) :: stat
      character(len=*), intent(in) :: reason
      type(status_t), intent(inout) :: status

      close (lun)
      if (stat /= 0) call status%fail(ehl_file, path//": error: cannot read: "//trim(reason))
   end subroutine end_reading

   !> Whether a file is complete and unchanged
   logical function has_checksum(path)
      character(len=*), intent(in) :: path
      integer(int64) :: bytes, theirs
      integer :: lun, stat

      has_checksum = .false.
      bytes = file_bytes(path) - of_checksum
      if (bytes < 0) return
      open (newunit=lun, file=path, status="old", action="read", access="stream", form="unformatted", iostat=stat)
      if (stat /= 0) return
      read (lun, pos=bytes + 1, iostat=stat) theirs
      close (lun)
      if (stat == 0) has_checksum = theirs == checksum(path, bytes)
   end function has_checksum

   !> Checksum of the first `bytes` bytes of a file, as far as they can be read
   integer(int64) function checksum(path, bytes)
      character(len=*), intent(in) :: path
      integer(int64), intent(in) :: bytes
      integer(int8) :: piece(block)
      integer(int64) :: left
      integer :: lun, stat, n, k

      checksum = initial_value
      open (newunit=lun, file=path, status="old", action="read", access="stream", form="unformatted", iostat=stat)
      left = bytes
      if (stat /= 0) return
      do while (left > 0)
         n = int(min(left, size(piece, kind=int64)))
         read (lun, iostat=stat) piece(:n)
         if (stat /= 0) exit
         do k = 1, n
            checksum = ieor(ishftc(checksum, rotation), int(piece(k), int64))
         end do
         left = left - n
      end do
      close (lun)
   end function checksum
end module ehl_checksummed_file

! SPDX-License-Identifier: BSD-3-Clause
!> Whole files: texts in and out, binary files that end with a checksum of what stands before it, and what every file that
!> was written must pass
module ehl_whole_file
   use, intrinsic :: iso_fortran_env, only: int64, int8
   use ehl_files, only: file_bytes, file_exists, flush_file, is_file
   use ehl_status, only: ehl_file, status_t
   use ehl_text, only: to_text
   implicit none (type, external)
   private
   public :: read_text, holds_text, write_text, open_to_write, end_writing, open_sealed, end_sealed, end_reading, is_sealed

   !> Bytes that are read at a time, those of a checksum
   integer, parameter :: block = 65536, of_checksum = 8
   !> The checksum of nothing, and the bits by which it is turned for each byte
   integer(int64), parameter :: nothing = 1234567890123456789_int64
   integer, parameter :: turn = 7

contains

   !> The whole text of a file of at most `largest` bytes
   subroutine read_text(path, largest, text, status)
      character(len=*), intent(in) :: path
      integer, intent(in) :: largest
      character(len=:), allocatable, intent(out) :: text
      type(status_t), intent(inout) :: status
      character(len=256) :: reason
      integer :: lun, stat
      integer(int64) :: length

      text = ""
      if (.not. file_exists(path)) then
         call status%fail(ehl_file, path // ": error: there is no such file")
      else if (file_exists(path // "/.")) then
         call status%fail(ehl_file, path // ": error: this is a folder, not a file")
      else if (.not. is_file(path)) then
         call status%fail(ehl_file, path // ": error: this is a device or a pipe, not a file")
      end if
      if (status%failed()) return
      open (newunit=lun, file=path, status="old", action="read", access="stream", &
            form="unformatted", iostat=stat, iomsg=reason)
      if (stat /= 0) then
         call status%fail(ehl_file, path // ": error: cannot open: " // trim(reason))
         return
      end if
      inquire (unit=lun, size=length)
      if (length < 0 .or. length > largest) then
         call status%fail(ehl_file, path // ": error: not a file of at most " &
                          // to_text(largest) // " bytes")
      else
         deallocate (text)
         allocate (character(len=int(length)) :: text)
         if (length > 0) then
            read (lun, iostat=stat, iomsg=reason) text
            if (stat /= 0) call status%fail(ehl_file, path // ": error: cannot read: " // trim(reason))
         end if
      end if
      close (lun)
   end subroutine read_text

   !> Whether a file holds a word near its beginning or its end
   logical function holds_text(path, word)
      character(len=*), intent(in) :: path, word
      integer(int64), parameter :: near = 64*1024_int64
      character(len=:), allocatable :: part
      integer(int64) :: length, first
      integer :: lun, stat, k

      holds_text = .false.
      if (file_exists(path // "/.")) return
      open (newunit=lun, file=path, status="old", action="read", access="stream", form="unformatted", iostat=stat)
      if (stat /= 0) return
      inquire (unit=lun, size=length)
      allocate (character(len=int(max(0_int64, min(near, length)))) :: part)
      do k = 1, 2
         first = merge(1_int64, length - len(part) + 1, k == 1)
         if (len(part) > 0) read (lun, pos=first, iostat=stat) part
         if (stat == 0 .and. index(part, word) > 0) holds_text = .true.
      end do
      close (lun)
   end function holds_text

   !> Open a file to write it, "formatted" or "unformatted", in place of what was there
   subroutine open_to_write(path, form, lun, status)
      character(len=*), intent(in) :: path, form
      integer, intent(out) :: lun
      type(status_t), intent(inout) :: status
      character(len=256) :: reason
      integer :: stat

      open (newunit=lun, file=path, status="replace", action="write", access="stream", form=form, iostat=stat, iomsg=reason)
      if (stat /= 0) call status%fail(ehl_file, path // ": cannot write: " // trim(reason))
   end subroutine open_to_write

   !> Write a text to a file, replacing what was there
   subroutine write_text(path, text, status)
      character(len=*), intent(in) :: path, text
      type(status_t), intent(inout) :: status
      character(len=256) :: reason
      integer :: lun, stat

      call open_to_write(path, "unformatted", lun, status)
      if (status%failed()) return
      write (lun, iostat=stat, iomsg=reason) text
      call end_writing(lun, path, len(text, kind=int64), stat, reason, status)
   end subroutine write_text

   !> Close a file that was written. A failure if a write or the closing failed, or the file is not whole: a write to
   !> a full disk that takes a part is no error for the library of gfortran
   subroutine end_writing(lun, path, length, stat, reason, status)
      integer, intent(in) :: lun
      character(len=*), intent(in) :: path
      !> Bytes that were written
      integer(int64), intent(in) :: length
      !> iostat and iomsg of the last write
      integer, intent(in) :: stat
      character(len=*), intent(in) :: reason
      type(status_t), intent(inout) :: status
      character(len=256) :: why
      integer(int64) :: there
      integer :: failed, closing

      failed = stat
      if (failed == 0) then
         close (lun, iostat=failed, iomsg=why)
      else
         why = reason
         ! what could not be written must not hold its unit
         close (lun, iostat=closing)
         if (closing /= 0) failed = closing
      end if
      if (failed /= 0) then
         call status%fail(ehl_file, path // ": cannot write: " // trim(why))
         return
      end if
      inquire (file=path, size=there, iostat=failed)
      if (failed == 0 .and. there == length) return
      call status%fail(ehl_file, path // ": cannot write: the disk is full, or a limit of the size of files is reached")
   end subroutine end_writing

   !> Open a file to "write" it, in place of what was there, or to "read" it
   subroutine open_sealed(path, action, lun, status)
      character(len=*), intent(in) :: path, action
      integer, intent(out) :: lun
      type(status_t), intent(inout) :: status
      character(len=256) :: reason
      integer :: stat

      open (newunit=lun, file=path, status=trim(merge("replace", "old    ", action == "write")), action=action, &
            access="stream", form="unformatted", iostat=stat, iomsg=reason)
      if (stat /= 0) call status%fail(ehl_file, path//": error: cannot "//action//": "//trim(reason))
   end subroutine open_sealed

   !> Close a file that was written and seal it. It is on the disk itself then, lest it is lost with the power.
   subroutine end_sealed(lun, path, stat, reason, status)
      integer, intent(in) :: lun
      character(len=*), intent(in) :: path
      !> iostat and iomsg of the last write
      integer, intent(in) :: stat
      character(len=*), intent(in) :: reason
      type(status_t), intent(inout) :: status
      character(len=256) :: why
      integer(int64) :: bytes, ours
      integer :: again, sealing

      inquire (unit=lun, pos=bytes)
      bytes = bytes - 1
      call end_writing(lun, path, bytes, stat, reason, status)
      if (status%failed()) return
      ours = checksum(path, bytes)
      open (newunit=again, file=path, status="old", action="write", position="append", access="stream", &
            form="unformatted", iostat=sealing, iomsg=why)
      if (sealing == 0) write (again, iostat=sealing, iomsg=why) ours
      call end_writing(again, path, bytes + of_checksum, sealing, why, status)
      if (status%failed()) return
      if (.not. flush_file(path)) call status%fail(ehl_file, path//": cannot write: it does not get onto the disk")
   end subroutine end_sealed

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

   !> Whether all of a file is there as it was written
   logical function is_sealed(path)
      character(len=*), intent(in) :: path
      integer(int64) :: bytes, theirs
      integer :: lun, stat

      is_sealed = .false.
      bytes = file_bytes(path) - of_checksum
      if (bytes < 0) return
      open (newunit=lun, file=path, status="old", action="read", access="stream", form="unformatted", iostat=stat)
      if (stat /= 0) return
      read (lun, pos=bytes + 1, iostat=stat) theirs
      close (lun)
      if (stat == 0) is_sealed = theirs == checksum(path, bytes)
   end function is_sealed

   !> Of so many bytes of a file; of those that can be read
   integer(int64) function checksum(path, bytes)
      character(len=*), intent(in) :: path
      integer(int64), intent(in) :: bytes
      integer(int8) :: piece(block)
      integer(int64) :: left
      integer :: lun, stat, n, k

      checksum = nothing
      open (newunit=lun, file=path, status="old", action="read", access="stream", form="unformatted", iostat=stat)
      left = bytes
      if (stat /= 0) return
      do while (left > 0)
         n = int(min(left, size(piece, kind=int64)))
         read (lun, iostat=stat) piece(:n)
         if (stat /= 0) exit
         do k = 1, n
            checksum = ieor(ishftc(checksum, turn), int(piece(k), int64))
         end do
         left = left - n
      end do
      close (lun)
   end function checksum
end module ehl_whole_file

! SPDX-License-Identifier: BSD-3-Clause
!> Reading and writing of complete text files, and the check of every file that was written
module ehl_whole_file
   use, intrinsic :: iso_fortran_env, only: int64
   use ehl_files, only: file_exists, is_file
   use ehl_status, only: ehl_file, status_t
   use ehl_text, only: to_text
   implicit none (type, external)
   private
   public :: read_text, holds_text, write_text, open_to_write, end_writing

   character(len=*), parameter :: byte_order_mark = char(239)//char(187)//char(191)

contains

   !> The text of a file of at most `largest` bytes, without a byte order mark
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
      else if (len_trim(path) < len(path)) then
         ! `open` removes trailing blanks, and would open another file
         call status%fail(ehl_file, "'"//path//"': error: the name ends with a blank; files of such names are not read here")
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
            if (index(text, byte_order_mark) == 1) text = text(len(byte_order_mark) + 1:)
         end if
      end if
      close (lun)
   end subroutine read_text

   !> Whether a file contains a word near its beginning or its end
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

   !> Open a file to write it, "formatted" or "unformatted", replacing an existing one
   subroutine open_to_write(path, form, lun, status)
      character(len=*), intent(in) :: path, form
      integer, intent(out) :: lun
      type(status_t), intent(inout) :: status
      character(len=256) :: reason
      integer :: stat

      open (newunit=lun, file=path, status="replace", action="write", access="stream", form=form, iostat=stat, iomsg=reason)
      if (stat /= 0) call status%fail(ehl_file, path // ": cannot write: " // trim(reason))
   end subroutine open_to_write

   !> Write a text to a file, replacing an existing one
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

   !> Close a file that was written. Fails if a write or the closing failed, or the file is incomplete: gfortran's
   !> runtime library does not report a partial write to a full disk
   subroutine end_writing(lun, path, length, stat, reason, status)
      integer, intent(in) :: lun
      character(len=*), intent(in) :: path
      !> Number of bytes written
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
         ! close the unit also after a failure
         close (lun, iostat=closing)
         if (closing /= 0) failed = closing
      end if
      if (failed /= 0) then
         call status%fail(ehl_file, path // ": cannot write: " // trim(why))
         return
      end if
      inquire (file=path, size=there, iostat=failed)
      if (failed == 0 .and. there == length) return
      call status%fail(ehl_file, path // ": cannot write: the disk is full, or the file size limit is reached")
   end subroutine end_writing
end module ehl_whole_file

! SPDX-License-Identifier: BSD-3-Clause
!> The beginning of a file: its length and checksum, and whether what is on disk still has them
module ehl_file_extent
   use, intrinsic :: iso_fortran_env, only: int64, int8
   use ehl_checksum, only: checksum_t
   implicit none (type, external)
   private
   public :: extent_t, begins_with, file_bytes, is_sealed

   !> Bytes that are read at a time
   integer, parameter :: block = 65536

   !> The beginning of a file: how many bytes, and their checksum
   type :: extent_t
      integer(int64) :: bytes = 0
      type(checksum_t) :: checksum
   contains
      procedure :: add
   end type extent_t

contains

   !> The bytes that come next
   pure subroutine add(self, bytes)
      class(extent_t), intent(inout) :: self
      integer(int8), intent(in) :: bytes(:)

      self%bytes = self%bytes + size(bytes)
      call self%checksum%add(bytes)
   end subroutine add

   !> Whether a file ends with the checksum of what stands before it
   logical function is_sealed(path)
      character(len=*), intent(in) :: path
      type(extent_t) :: there
      integer :: lun, stat, theirs

      is_sealed = .false.
      there = beginning(path, file_bytes(path) - storage_size(theirs)/8)
      if (there%bytes <= 0) return
      open (newunit=lun, file=path, status="old", action="read", access="stream", form="unformatted", iostat=stat)
      if (stat /= 0) return
      read (lun, pos=there%bytes + 1, iostat=stat) theirs
      if (stat == 0) is_sealed = theirs == there%checksum%value()
      close (lun)
   end function is_sealed

   !> Whether a file begins as it did when this was written
   logical function begins_with(path, extent)
      character(len=*), intent(in) :: path
      type(extent_t), intent(in) :: extent
      type(extent_t) :: there

      there = beginning(path, extent%bytes)
      begins_with = there%bytes == extent%bytes .and. there%checksum%value() == extent%checksum%value()
   end function begins_with

   !> Length of a file; 0 when it is not there
   integer(int64) function file_bytes(path)
      character(len=*), intent(in) :: path

      inquire (file=path, size=file_bytes)
      file_bytes = max(file_bytes, 0_int64)
   end function file_bytes

   !> So many bytes of a file from its beginning; fewer where there are fewer or they cannot be read
   function beginning(path, bytes) result(extent)
      character(len=*), intent(in) :: path
      integer(int64), intent(in) :: bytes
      type(extent_t) :: extent
      integer(int8) :: piece(block)
      integer :: lun, stat, n

      open (newunit=lun, file=path, status="old", action="read", access="stream", form="unformatted", iostat=stat)
      if (stat /= 0) return
      do while (extent%bytes < bytes)
         n = int(min(bytes - extent%bytes, size(piece, kind=int64)))
         read (lun, iostat=stat) piece(:n)
         if (stat /= 0) exit
         call extent%add(piece(:n))
      end do
      close (lun)
   end function beginning
end module ehl_file_extent

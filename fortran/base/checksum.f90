! SPDX-License-Identifier: BSD-3-Clause
!> CRC-32 (ISO 3309, as in zip and png) of a file's bytes
module ehl_checksum
   use, intrinsic :: iso_fortran_env, only: int32, int64, int8
   implicit none (type, external)
   private
   public :: crc32

   !> Bits of the reversed generator polynomial 0xEDB88320
   integer(int32), parameter :: polynomial = -306674912_int32

contains

   !> Checksum of bytes
   pure integer(int32) function crc32(bytes)
      integer(int8), intent(in) :: bytes(:)
      integer(int32) :: table(0:255), entry
      integer :: bit
      integer(int64) :: i

      do i = 0_int64, 255_int64
         entry = int(i, int32)
         do bit = 1, 8
            if (btest(entry, 0)) then
               entry = ieor(shiftr(entry, 1), polynomial)
            else
               entry = shiftr(entry, 1)
            end if
         end do
         table(i) = entry
      end do
      crc32 = not(0_int32)
      do i = 1_int64, size(bytes, kind=int64)
         entry = iand(ieor(crc32, int(bytes(i), int32)), 255_int32)
         crc32 = ieor(shiftr(crc32, 8), table(entry))
      end do
      crc32 = not(crc32)
   end function crc32
end module ehl_checksum

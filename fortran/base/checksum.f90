! SPDX-License-Identifier: BSD-3-Clause
!> CRC-32 (ISO 3309, as in zip and png) of bytes that come piece by piece
module ehl_checksum
   use, intrinsic :: iso_fortran_env, only: int32, int64, int8
   implicit none (type, external)
   private
   public :: checksum_t

   !> Bits of the reversed generator polynomial 0xEDB88320
   integer(int32), parameter :: polynomial = -306674912_int32
   integer(int32) :: i
   !> A byte divided by the polynomial, bit by bit
   integer(int32), parameter :: &
      bits_0(0:255) = [(i, i=0_int32, 255_int32)], &
      bits_1(0:255) = merge(ieor(shiftr(bits_0, 1), polynomial), shiftr(bits_0, 1), btest(bits_0, 0)), &
      bits_2(0:255) = merge(ieor(shiftr(bits_1, 1), polynomial), shiftr(bits_1, 1), btest(bits_1, 0)), &
      bits_3(0:255) = merge(ieor(shiftr(bits_2, 1), polynomial), shiftr(bits_2, 1), btest(bits_2, 0)), &
      bits_4(0:255) = merge(ieor(shiftr(bits_3, 1), polynomial), shiftr(bits_3, 1), btest(bits_3, 0)), &
      bits_5(0:255) = merge(ieor(shiftr(bits_4, 1), polynomial), shiftr(bits_4, 1), btest(bits_4, 0)), &
      bits_6(0:255) = merge(ieor(shiftr(bits_5, 1), polynomial), shiftr(bits_5, 1), btest(bits_5, 0)), &
      bits_7(0:255) = merge(ieor(shiftr(bits_6, 1), polynomial), shiftr(bits_6, 1), btest(bits_6, 0)), &
      table(0:255) = merge(ieor(shiftr(bits_7, 1), polynomial), shiftr(bits_7, 1), btest(bits_7, 0))

   !> Of all bytes so far
   type :: checksum_t
      integer(int32) :: remainder = not(0_int32)
   contains
      procedure :: add
      procedure :: value
   end type checksum_t

contains

   !> The bytes that come next
   pure subroutine add(self, bytes)
      class(checksum_t), intent(inout) :: self
      integer(int8), intent(in) :: bytes(:)
      integer(int32) :: sum
      integer(int64) :: k

      sum = self%remainder
      do k = 1_int64, size(bytes, kind=int64)
         sum = ieor(shiftr(sum, 8), table(iand(ieor(sum, int(bytes(k), int32)), 255_int32)))
      end do
      self%remainder = sum
   end subroutine add

   !> The checksum
   pure integer(int32) function value(self)
      class(checksum_t), intent(in) :: self
      value = not(self%remainder)
   end function value
end module ehl_checksum

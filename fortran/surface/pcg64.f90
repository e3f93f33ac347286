! SPDX-License-Identifier: BSD-3-Clause
!> The random bits of numpy.random.PCG64: PCG XSL RR 128/64 (O'Neill 2014), seeded by numpy's SeedSequence, so that a
!> seed defines the same surface in every program. Unsigned integers are stored in limbs of 32 bits in int64.
module ehl_pcg64
   use, intrinsic :: iso_fortran_env, only: int32, int64
   use ehl_kinds, only: dp
   implicit none (type, external)
   private
   public :: pcg64_t

   integer, parameter :: ik = int64
   integer(ik), parameter :: mask = int(z"FFFFFFFF", ik), half_mask = int(z"FFFF", ik)
   !> Multiplier of the 128-bit state, lowest limb first
   integer(ik), parameter :: multiplier(0:3) = [int(z"9FCCF645", ik), int(z"4385DF64", ik), int(z"1FC65DA4", ik), &
                                                int(z"2360ED05", ik)]
   !> Constants of SeedSequence
   integer, parameter :: pool_size = 4
   integer(ik), parameter :: init_a = int(z"43B0D7E5", ik), mult_a = int(z"931E8875", ik), init_b = int(z"8B51F9DD", ik), &
                             mult_b = int(z"58F38DED", ik), mix_left = int(z"CA01F9DD", ik), mix_right = int(z"4973F715", ik)

   type :: pcg64_t
      private
      !> State and increment, lowest limb first
      integer(ik) :: state(0:3) = 0, increment(0:3) = 0
   contains
      procedure :: seed
      procedure :: uniform
   end type pcg64_t

contains

   !> Seed the generator with a non-negative integer, as 32-bit words, the lowest first
   pure subroutine seed(self, words)
      class(pcg64_t), intent(inout) :: self
      integer(int32), intent(in) :: words(:)
      integer(ik) :: values(0:7)

      values = seed_sequence(words)
      ! of four 64-bit words the first two are the state, the others the sequence, the high word first
      self%increment = [values(6), values(7), values(4), values(5)]
      self%increment = sum_of(self%increment, self%increment)
      self%increment(0) = ior(self%increment(0), 1_ik)
      self%state = 0
      call step(self)
      self%state = sum_of(self%state, [values(2), values(3), values(0), values(1)])
      call step(self)
   end subroutine seed

   !> A number in [0, 1), a multiple of 2^-53, from the next 64 random bits
   real(dp) function uniform(self)
      class(pcg64_t), intent(inout) :: self
      integer(ik) :: low, high

      call step(self)
      low = ior(self%state(0), ishft(self%state(1), 32))
      high = ior(self%state(2), ishft(self%state(3), 32))
      uniform = real(ishft(ishftc(ieor(low, high), -int(ishft(high, -58))), -11), dp)*2.0_dp**(-53)
   end function uniform

   !> state = state*multiplier + increment, modulo 2^128
   pure subroutine step(self)
      class(pcg64_t), intent(inout) :: self
      integer(ik) :: columns(0:4), low, high
      integer :: i, j

      columns = 0
      do i = 0, 3
         do j = 0, 3 - i
            ! products of 16 by 32 bits, whose sums do not overflow
            low = iand(self%state(i), half_mask)*multiplier(j)
            high = ishft(self%state(i), -16)*multiplier(j)
            columns(i + j) = columns(i + j) + low + ishft(iand(high, half_mask), 16)
            columns(i + j + 1) = columns(i + j + 1) + ishft(high, -16)
         end do
      end do
      columns(:3) = columns(:3) + self%increment
      do i = 0, 3
         self%state(i) = iand(columns(i), mask)
         columns(i + 1) = columns(i + 1) + ishft(columns(i), -32)
      end do
   end subroutine step

   !> a + b modulo 2^128
   pure function sum_of(a, b) result(c)
      integer(ik), intent(in) :: a(0:3), b(0:3)
      integer(ik) :: c(0:3), carry
      integer :: i

      carry = 0
      do i = 0, 3
         c(i) = a(i) + b(i) + carry
         carry = ishft(c(i), -32)
         c(i) = iand(c(i), mask)
      end do
   end function sum_of

   !> Eight 32-bit words from the words of a seed
   pure function seed_sequence(words) result(values)
      integer(int32), intent(in) :: words(:)
      integer(ik) :: values(0:7), pool(0:pool_size - 1), constant, entropy
      integer :: i, k

      constant = init_a
      do i = 0, pool_size - 1
         entropy = 0
         if (i < size(words)) entropy = iand(int(words(i + 1), ik), mask)
         call hash(entropy, constant, mult_a, pool(i))
      end do
      do k = 0, pool_size - 1
         do i = 0, pool_size - 1
            if (i == k) cycle
            call hash(pool(k), constant, mult_a, entropy)
            pool(i) = mixed(pool(i), entropy)
         end do
      end do
      do k = pool_size + 1, size(words)
         do i = 0, pool_size - 1
            call hash(iand(int(words(k), ik), mask), constant, mult_a, entropy)
            pool(i) = mixed(pool(i), entropy)
         end do
      end do
      constant = init_b
      do i = 0, 7
         call hash(pool(mod(i, pool_size)), constant, mult_b, values(i))
      end do
   end function seed_sequence

   !> Hash a word; the constant changes from call to call
   pure subroutine hash(value, constant, factor, answer)
      integer(ik), intent(in) :: value, factor
      integer(ik), intent(inout) :: constant
      integer(ik), intent(out) :: answer

      answer = ieor(value, constant)
      constant = product_of(constant, factor)
      answer = product_of(answer, constant)
      answer = ieor(answer, ishft(answer, -16))
   end subroutine hash

   !> Mix two words into one
   pure integer(ik) function mixed(x, y)
      integer(ik), intent(in) :: x, y

      mixed = iand(product_of(mix_left, x) - product_of(mix_right, y), mask)
      mixed = ieor(mixed, ishft(mixed, -16))
   end function mixed

   !> a b modulo 2^32
   pure integer(ik) function product_of(a, b)
      integer(ik), intent(in) :: a, b
      product_of = iand(iand(a, half_mask)*b + ishft(iand(ishft(a, -16)*b, half_mask), 16), mask)
   end function product_of
end module ehl_pcg64

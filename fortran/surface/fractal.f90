! SPDX-License-Identifier: BSD-3-Clause
!> Self-affine surfaces with random phases: C2D proportional to max(|q|, q_r)^(-2 - 2 Hurst) up to the Nyquist
!> wavenumbers of the tile, zero at q = 0; zero mean, exact rms height, periodic. The phases are those of the raw words
!> of PCG64, component by component (q_x slowest): a seed is the same surface in every program.
!>
!> These are the bits of numpy.random.PCG64: PCG XSL RR 128/64 (O'Neill 2014), seeded by numpy's SeedSequence. Unsigned
!> integers are kept in limbs of 32 bits in int64.
module ehl_fractal
   use, intrinsic :: iso_c_binding, only: c_double_complex
   use, intrinsic :: iso_fortran_env, only: int32, int64
   use ehl_fftw_planner, only: to_heights
   use ehl_kinds, only: dp, pi
   use ehl_status, only: ehl_no_memory, status_t
   use ehl_text, only: to_text
   implicit none (type, external)
   private
   public :: fractal_t, make_fractal

   !> What a fractal surface is
   type :: fractal_t
      !> Size of the tile along X and Y [m]
      real(dp) :: length_x = 1.0_dp, length_y = 1.0_dp
      !> Rms height [m]
      real(dp) :: rms_height = 1.0_dp
      !> Hurst exponent, and the wavenumber below which the spectrum is flat [rad/m], 0: none
      real(dp) :: hurst = 0.8_dp, rolloff_wavenumber = 0.0_dp
      !> Seed as 32-bit words, the lowest first
      integer(int32), allocatable :: seed(:)
      !> Modulus of the components: of a Gaussian random field, or exactly on the power law
      logical :: gaussian = .false.
   end type fractal_t

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

   !> Heights [m] of a surface, heights(ny, nx): Y first, as components are counted
   subroutine make_fractal(what, heights, status)
      type(fractal_t), intent(in) :: what
      real(dp), intent(out) :: heights(:, :)
      type(status_t), intent(inout) :: status
      complex(c_double_complex), allocatable :: component(:, :)
      type(pcg64_t) :: bits
      real(dp) :: sums(size(heights, 2)), mean, rms, u, qx, qy
      integer :: i, j, nx, ny, stat

      heights = 0.0_dp
      if (status%failed()) return
      ny = size(heights, 1)
      nx = size(heights, 2)
      allocate (component(ny/2 + 1, nx), stat=stat)
      if (stat /= 0) then
         call status%fail(ehl_no_memory, "no memory for a fractal surface of "//to_text(nx)//" x "//to_text(ny)//" pixels")
         return
      end if
      call bits%seed(what%seed)
      do i = 1, nx
         do j = 1, ny/2 + 1
            u = 2.0_dp*pi*bits%uniform()
            component(j, i) = cmplx(cos(u), sin(u), dp)
         end do
      end do
      if (what%gaussian) then
         do i = 1, nx
            do j = 1, ny/2 + 1
               ! exact: the number is a multiple of 2^-53
               component(j, i) = component(j, i)*sqrt(-log(1.0_dp - bits%uniform()))
            end do
         end do
      end if
      call make_hermitian(component, ny, what%gaussian)
      do i = 1, nx
         qx = 2.0_dp*pi*merge(i - 1, i - 1 - nx, 2*(i - 1) < nx)/what%length_x
         do j = 1, ny/2 + 1
            if (i == 1 .and. j == 1) cycle
            qy = 2.0_dp*pi*(j - 1)/what%length_y
            component(j, i) = component(j, i)*max(hypot(qx, qy), what%rolloff_wavenumber)**(-1.0_dp - what%hurst)
         end do
      end do
      component(1, 1) = (0.0_dp, 0.0_dp)
      call to_heights(component, heights, status)
      if (status%failed()) return
      do i = 1, nx
         sums(i) = sum(heights(:, i))
      end do
      mean = sum(sums)/(real(nx, dp)*ny)
      do i = 1, nx
         heights(:, i) = heights(:, i) - mean
         sums(i) = sum(heights(:, i)**2)
      end do
      rms = sqrt(sum(sums)/(real(nx, dp)*ny))
      do i = 1, nx
         heights(:, i) = heights(:, i)*(what%rms_height/rms)
      end do
   end subroutine make_fractal

   !> The symmetry of a real surface for the rows q_y = 0 and Nyquist of a half spectrum: component (q_x, q_y) there is
   !> the partner of (-q_x, q_y). The up to four components that are their own partner are real: a random sign at the
   !> given modulus, or, of a Gaussian field, a real normal number of the same mean square.
   subroutine make_hermitian(component, ny, gaussian)
      complex(c_double_complex), intent(inout) :: component(:, :)
      integer, intent(in) :: ny
      logical, intent(in) :: gaussian
      integer :: i, j, m, nx

      nx = size(component, 2)
      do j = 1, ny/2 + 1
         if (j > 1 .and. 2*(j - 1) /= ny) cycle
         do m = 1, (nx - 1)/2
            component(j, nx + 1 - m) = conjg(component(j, 1 + m))
         end do
         do i = 1, nx
            if (i > 1 .and. 2*(i - 1) /= nx) cycle
            if (gaussian) then
               component(j, i) = sqrt(2.0_dp)*component(j, i)%re
            else
               component(j, i) = sign(abs(component(j, i)), component(j, i)%re)
            end if
         end do
      end do
   end subroutine make_hermitian

   !> Begin with a seed: an integer that is not negative as 32-bit words, the lowest first
   pure subroutine seed(self, words)
      class(pcg64_t), intent(inout) :: self
      integer(int32), intent(in) :: words(:)
      integer(ik) :: values(0:7)

      values = seed_sequence(words)
      ! of four 64-bit words the first two are the state, the others the sequence, the high one first
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
            ! products of 16 by 32 bits: no sum of these overflows
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

   !> A word, hashed; the constant changes from call to call
   pure subroutine hash(value, constant, factor, answer)
      integer(ik), intent(in) :: value, factor
      integer(ik), intent(inout) :: constant
      integer(ik), intent(out) :: answer

      answer = ieor(value, constant)
      constant = product_of(constant, factor)
      answer = product_of(answer, constant)
      answer = ieor(answer, ishft(answer, -16))
   end subroutine hash

   !> Two words made one
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
end module ehl_fractal

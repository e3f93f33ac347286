! SPDX-License-Identifier: BSD-3-Clause
!> Transfer weights and local corrections of multilevel multi-integration
!>
!> A kernel value midway between coarse points is interpolated from the 2t nearest ones,
!>    K(d) = sum over k = 1..t of omega(k)*(K(d + 2k-1) + K(d - (2k-1))) + c(d),
!> along one axis. The remainder c falls off like the 2t-th derivative of 1/r, and is kept
!> where it matters: the largest values, until the sum of the magnitudes left out is within
!> the tolerance. What is left out is added up, for odd and even d along the axis apart, and
!> spread over the values kept: a smooth pressure then hardly feels the truncation (the
!> error for the Hertz pressure falls to a half or a seventh).
module ehl_mlmi_stencil
   use ehl_kinds, only: dp
   use ehl_kernel, only: fill_kernel
   implicit none (type, external)
   private
   public :: stencil_t, transfer_weights, reach

   !> Corrections are looked for this far from the source, in mesh sizes
   integer, parameter :: reach = 48
   !> Fewest values, those at offsets along >= 0 counted, that are kept at an offset across
   integer, parameter :: few = 3

   !> Local corrections of one halving, even in both offsets. "Along" is the axis that is
   !> halved, "across" the other one.
   type :: stencil_t
      !> Largest offset across
      integer :: width = 0
      !> For each offset across 0..width: how many pairs of odd (1, 3, ...) and of even
      !> (2, 4, ...) offsets along
      integer, allocatable :: n_odd(:), n_even(:)
      !> odd(k, across): at 2k-1 along, k >= 1; even(k, across): at 2k along, k >= 0
      real(dp), allocatable :: odd(:, :), even(:, :)
   contains
      procedure :: make
      procedure :: length
   end type stencil_t

contains

   !> Weights of 2t-point interpolation midway between two points: omega(k) belongs to the
   !> two points at distance 2k-1 half meshes
   pure function transfer_weights(t) result(omega)
      integer, intent(in) :: t
      real(dp) :: omega(t)
      integer :: k, m, node

      do k = 1, t
         omega(k) = 1.0_dp
         do m = 1 - t, t
            if (m == k) cycle
            node = 2*m - 1
            omega(k) = omega(k)*node/real(node - (2*k - 1), dp)
         end do
      end do
   end function transfer_weights

   !> Corrections for the kernel K(d) = kernel_coefficient(factor, step(1)*di, step(2)*dj, hx, hy),
   !> halved along an axis (1: X, 2: Y), on a grid where no two nodes are further apart than
   !> extent (X, Y). The tolerance is in units of K; it is not met if even all corrections
   !> within reach leave out more.
   subroutine make(self, axis, step, extent, factor, hx, hy, omega, tolerance, met)
      class(stencil_t), intent(inout) :: self
      integer, intent(in) :: axis, step(2), extent(2)
      real(dp), intent(in) :: factor, hx, hy, omega(:), tolerance
      logical, intent(out) :: met
      real(dp), allocatable :: table(:, :), turned(:, :), c(:, :), copies(:, :)
      real(dp) :: low, high, middle, spread
      integer :: a, b, k, along, across, parity, trial
      logical, allocatable :: kept(:, :)

      along = min(reach, extent(axis))
      across = min(reach, extent(3 - axis))
      allocate (table(0:along + 2*size(omega), 0:across), c(0:along, 0:across), &
                copies(0:along, 0:across), kept(0:along, 0:across))
      if (axis == 1) then
         call fill_kernel(table, factor, hx, hy, step)
      else
         allocate (turned(0:across, 0:ubound(table, 1)))
         call fill_kernel(turned, factor, hx, hy, step)
         table(:, :) = transpose(turned)
      end if
      do b = 0, across
         do a = 0, along
            copies(a, b) = merge(1.0_dp, 2.0_dp, a == 0)*merge(1.0_dp, 2.0_dp, b == 0)
            c(a, b) = table(a, b)
            do k = 1, size(omega)
               c(a, b) = c(a, b) - omega(k)*(table(a + 2*k - 1, b) + table(abs(a - 2*k + 1), b))
            end do
         end do
      end do

      ! the largest threshold that leaves out no more than the tolerance
      high = maxval(abs(c))
      low = 1.0e-20_dp*high
      do trial = 1, 20
         middle = sqrt(low*high)
         call choose(abs(c) >= middle, kept)
         if (sum(copies*abs(c), mask=.not. kept) <= tolerance) then
            low = middle
         else
            high = middle
         end if
      end do
      call choose(abs(c) >= low, kept)
      call fit(self, kept)
      met = self%width < reach .and. self%length() < reach

      do parity = 0, 1
         spread = sum(copies(parity::2, :)*c(parity::2, :), mask=.not. kept(parity::2, :)) &
                  /sum(copies(parity::2, :), mask=kept(parity::2, :))
         where (kept(parity::2, :)) c(parity::2, :) = c(parity::2, :) + spread
      end do
      do b = 0, self%width
         do k = 1, self%n_odd(b)
            self%odd(k, b) = c(2*k - 1, b)
         end do
         do k = 0, self%n_even(b)
            self%even(k, b) = c(2*k, b)
         end do
      end do
   end subroutine make

   !> The wanted values and those nearer to the axis across: for every offset across all
   !> even and all odd offsets along up to the largest wanted, as the loops want them. Few
   !> values at a large offset across are not worth the sum over two more rows.
   pure subroutine choose(wanted, kept)
      logical, intent(in) :: wanted(0:, 0:)
      logical, intent(out) :: kept(0:, 0:)
      integer :: b, width, parity

      kept = .false.
      width = findloc(count(wanted, dim=1) >= few, .true., dim=1, back=.true.) - 1
      do b = 0, width
         do parity = 0, 1
            kept(parity:parity + 2*(findloc(wanted(parity::2, b), .true., dim=1, back=.true.) &
                                    - 1):2, b) = .true.
         end do
      end do
      ! the middle of every row, and one value of each kind, to carry what is left out
      kept(0, 0:max(0, width)) = .true.
      kept(1, 0) = .true.
   end subroutine choose

   !> Room for the values kept
   subroutine fit(self, kept)
      class(stencil_t), intent(inout) :: self
      logical, intent(in) :: kept(0:, 0:)
      integer :: b

      if (allocated(self%n_odd)) deallocate (self%n_odd, self%n_even, self%odd, self%even)
      self%width = count(kept(0, :)) - 1
      allocate (self%n_odd(0:self%width), self%n_even(0:self%width))
      do b = 0, self%width
         self%n_odd(b) = count(kept(1::2, b))
         self%n_even(b) = count(kept(0::2, b)) - 1
      end do
      allocate (self%odd(maxval(self%n_odd), 0:self%width), source=0.0_dp)
      allocate (self%even(0:maxval(self%n_even), 0:self%width), source=0.0_dp)
   end subroutine fit

   !> Largest offset along the axis
   pure integer function length(self)
      class(stencil_t), intent(in) :: self
      length = max(2*maxval(self%n_odd) - 1, 2*maxval(self%n_even))
   end function length
end module ehl_mlmi_stencil

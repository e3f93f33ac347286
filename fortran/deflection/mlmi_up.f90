! SPDX-License-Identifier: BSD-3-Clause
!> Multilevel multi-integration, from coarse to fine: transfer weights, local corrections, and the interpolation and correction
!> of the deflection on finer grids
!>
!> A kernel value midway between coarse points is interpolated from the 2t nearest ones,
!>    K(d) = sum over k = 1..t of omega(k)*(K(d + 2k-1) + K(d - (2k-1))) + c(d),
!> along one axis. The correction c decays like the 2t-th derivative of 1/r. The largest values are kept (the patch), such
!> that the sum of the magnitudes of the neglected ones is within the tolerance. The sum of the neglected values,
!> for odd and even d along the axis separately, is spread over the kept values, so that the truncation hardly affects a
!> smooth pressure (the error for the Hertz pressure decreases to a half or a seventh).
! Rows are passed by their first element
! allow(assumed-size)
module ehl_mlmi_up
   use ehl_kernel, only: fill_kernel
   use ehl_kinds, only: dp
   use ehl_mlmi_down, only: rows_near, sources_near, stage_t, stored_row
   use ehl_row_loops, only: add_centred, add_pairs, add_row_pairs, add_row_pairs_to_three, add_shifted, interpolate_and_merge
   !$ use omp_lib, only: omp_get_thread_num
   implicit none (type, external)
   private
   public :: ascend, stencil_t, transfer_weights

   !> Maximum distance of a correction from its source, in mesh sizes
   integer, parameter :: reach = 48
   !> Minimum number of values at offsets along >= 0 for the largest offset across to be kept
   integer, parameter :: min_values = 3
   !> Maximum number of pairs of rows in a correction
   integer, parameter :: max_pairs = reach + 2

   !> Local corrections of one coarsening, even in both offsets. "Along" is the axis that is
   !> coarsened, "across" the other one.
   type :: stencil_t
      !> Maximum offset across
      integer :: width = 0
      !> For each offset across 0..width: number of pairs of odd (1, 3, ...) and of even
      !> (2, 4, ...) offsets along
      integer, allocatable :: n_odd(:), n_even(:)
      !> odd(k, across): at 2k-1 along, k >= 1; even(k, across): at 2k along, k >= 0
      real(dp), allocatable :: odd(:, :), even(:, :)
   contains
      procedure :: make
      procedure :: length
      procedure :: reach => correction_reach
   end type stencil_t

contains

   !> Weights of 2t-point interpolation midway between two points: omega(k) belongs to the
   !> two points at a distance of 2k-1 half mesh sizes
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
   !> coarsened along an axis (1: X, 2: Y), on a grid where no two nodes are further apart than
   !> extent (X, Y). The tolerance is in units of K; it is not met if the values to be kept extend to
   !> `reach`.
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

      ! the largest threshold for which the neglected values are within the tolerance
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

   !> Extend the wanted values to what the loops need: for every offset across all
   !> even and all odd offsets along up to the largest wanted one. A few
   !> values at a large offset across do not justify the sum over two more rows.
   pure subroutine choose(wanted, kept)
      logical, intent(in) :: wanted(0:, 0:)
      logical, intent(out) :: kept(0:, 0:)
      integer :: b, width, parity

      kept = .false.
      width = findloc(count(wanted, dim=1) >= min_values, .true., dim=1, back=.true.) - 1
      do b = 0, width
         do parity = 0, 1
            kept(parity:parity + 2*(findloc(wanted(parity::2, b), .true., dim=1, back=.true.) &
                                    - 1):2, b) = .true.
         end do
      end do
      ! the middle of every row, and one value of each parity to receive the neglected sum
      kept(0, 0:max(0, width)) = .true.
      kept(1, 0) = .true.
   end subroutine choose

   !> Allocate the kept values
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

   !> Maximum offset along the axis
   pure integer function length(self)
      class(stencil_t), intent(in) :: self
      length = max(2*maxval(self%n_odd) - 1, 2*maxval(self%n_even))
   end function length

   !> Reach of a correction: along the axis in nodes of the next grid, across it in nodes of this one
   pure integer function correction_reach(self)
      class(stencil_t), intent(in) :: self
      correction_reach = max(self%length()/2 + 1, self%width)
   end function correction_reach

   !> Deflection w of a grid from that of the next coarser one, which is overwritten
   subroutine ascend(stage, stencil, omega, threads, work, w)
      type(stage_t), intent(inout) :: stage
      type(stencil_t), intent(in) :: stencil
      real(dp), intent(in) :: omega(:)
      integer, intent(in) :: threads
      real(dp), intent(inout) :: work(:, :, :)
      real(dp), intent(out) :: w(stage%low(1):stage%high(1), stage%low(2):stage%high(2))
      integer :: j, me

      !$omp parallel num_threads(threads) default(none) private(j, me) &
      !$omp shared(stage, stencil, omega, work, w)
      me = 1
      !$ me = omp_get_thread_num() + 1
      if (stage%axis == 1) then
         !$omp do schedule(dynamic, 8)
         do j = stage%low(2), stage%high(2)
            call ascend_row_x(stage, stencil, j, omega, work(:, 1, me), work(:, 2, me), work(:, 3, me), &
                              stage%coarse(:, j), w(:, j))
         end do
         !$omp end do
      else
         ! even rows are corrected, odd rows are interpolated from them and corrected
         !$omp do schedule(dynamic, 8)
         do j = stage%coarse_low(2), stage%coarse_high(2)
            call correct_row_y(stage, stencil, 2*j, work(:, :, me), stage%coarse(:, j))
            if (2*j >= stage%low(2) .and. 2*j <= stage%high(2)) w(:, 2*j) = stage%coarse(:, j)
         end do
         !$omp end do
         !$omp do schedule(dynamic, 8)
         do j = stage%low(2) + 1 - modulo(stage%low(2), 2), stage%high(2), 2
            call interpolate_row(stage, j, omega, w(:, j))
            call correct_row_y(stage, stencil, j, work(:, :, me), w(:, j))
         end do
         !$omp end do
      end if
      !$omp end parallel
   end subroutine ascend

   !> One row of a grid coarsened along X: even columns are corrected, odd columns are interpolated from them and
   !> corrected. The buffers start at the same column as the sources.
   subroutine ascend_row_x(stage, stencil, j, omega, odd, s_even, s_odd, even, w)
      type(stage_t), intent(in) :: stage
      type(stencil_t), intent(in) :: stencil
      integer, intent(in) :: j
      real(dp), intent(in) :: omega(:)
      real(dp), intent(inout) :: odd(stage%coarse_low(1) - stage%margin:*)
      real(dp), intent(inout) :: s_even(stage%coarse_low(1) - stage%margin:*)
      real(dp), intent(inout) :: s_odd(stage%coarse_low(1) - stage%margin:*)
      real(dp), intent(inout) :: even(stage%coarse_low(1):stage%coarse_high(1))
      real(dp), intent(out) :: w(stage%low(1):stage%high(1))
      integer :: a, b, d, l, r, first, last, half, upper, lower

      odd(stage%coarse_low(1):stage%coarse_high(1)) = 0.0_dp
      call sources_near(stage, j, stencil%width, first, last)
      if (first <= last) then
         half = stencil%length()/2 + 1
         a = max(shifta(first, 1) - half, stage%coarse_low(1))
         b = min(shifta(last, 1) + half, stage%coarse_high(1))
         l = a - half
         r = b + half
         do d = 0, stencil%width
            upper = stored_row(stage, j + d)
            lower = stored_row(stage, j - d)
            if (stage%first(upper) > stage%last(upper) &
                .and. stage%first(lower) > stage%last(lower)) cycle
            if (d == 0) then
               call correct_row_x(stage, stencil, d, a, b, stage%even(:, j), stage%odd(:, j), &
                                  even(a:b), odd(a:b))
            else
               s_even(l:r) = stage%even(l:r, upper) + stage%even(l:r, lower)
               s_odd(l:r) = stage%odd(l:r, upper) + stage%odd(l:r, lower)
               call correct_row_x(stage, stencil, d, a, b, s_even, s_odd, even(a:b), odd(a:b))
            end if
         end do
      end if
      ! pairs of an even and an odd column lie in a..b; single columns may lie next to them
      a = -shifta(-stage%low(1), 1)
      b = shifta(stage%high(1) - 1, 1)
      if (2*a > stage%low(1)) then
         call add_pairs(1, size(omega), omega, even, a - stage%coarse_low(1) + 1, &
                        a - stage%coarse_low(1), odd(a - 1:a - 1))
         w(2*a - 1) = odd(a - 1)
      end if
      call interpolate_and_merge(b - a + 1, size(omega), omega, even, &
                                 a - stage%coarse_low(1) + 1, odd(a:b), w(2*a:2*b + 1))
      if (2*b + 2 <= stage%high(1)) w(2*b + 2) = even(b + 1)
   end subroutine ascend_row_x

   !> Corrections from sources at distance d across, columns a..b of the even and odd grids
   subroutine correct_row_x(stage, stencil, d, a, b, s_even, s_odd, even, odd)
      type(stage_t), intent(in) :: stage
      type(stencil_t), intent(in) :: stencil
      integer, intent(in) :: d, a, b
      real(dp), intent(in) :: s_even(*), s_odd(*)
      real(dp), intent(inout) :: even(:), odd(:)
      integer :: n, column

      n = b - a + 1
      column = a - (stage%coarse_low(1) - stage%margin) + 1
      call add_pairs(n, stencil%n_odd(d), stencil%odd(:, d), s_odd, column, column - 1, even)
      call add_pairs(n, stencil%n_odd(d), stencil%odd(:, d), s_even, column + 1, column, odd)
      call add_centred(n, stencil%n_even(d), stencil%even(:, d), s_odd, column, odd)
   end subroutine correct_row_x

   !> Interpolate odd row j from the even rows around it
   subroutine interpolate_row(stage, j, omega, w)
      type(stage_t), intent(in) :: stage
      integer, intent(in) :: j
      real(dp), intent(in) :: omega(:)
      real(dp), intent(inout) :: w(:)
      integer :: k, above, below
      integer :: upper(max_pairs), lower(max_pairs)

      do k = 1, size(omega)
         above = shifta(j, 1) + k
         below = shifta(j, 1) + 1 - k
         if (stage%mirror) below = abs(below)
         upper(k) = (above - stage%coarse_low(2))*size(w)
         lower(k) = (below - stage%coarse_low(2))*size(w)
      end do
      w = 0.0_dp
      call add_row_pairs(size(w), size(omega), omega, stage%coarse, upper, lower, w)
   end subroutine interpolate_row

   !> Corrections of row j of a grid coarsened along Y: rows at the same distance are added, then
   !> weighted and summed for each column offset, and finally shifted by that offset
   subroutine correct_row_y(stage, stencil, j, sums, w)
      type(stage_t), intent(in) :: stage
      type(stencil_t), intent(in) :: stencil
      integer, intent(in) :: j
      real(dp), intent(inout) :: sums(:, :)
      real(dp), intent(inout) :: w(stage%low(1):stage%high(1))
      integer :: a, b, k, m, n, x, x_last, count, count_even, pairs, first, last
      integer :: upper(max_pairs), lower(max_pairs), place(max_pairs)
      real(dp) :: c(max_pairs, 3)

      call sources_near(stage, j, stencil%length(), first, last)
      if (first > last) return
      m = stencil%width
      a = max(first - m, stage%low(1))
      b = min(last + m, stage%high(1))
      n = b - a + 1 + 2*m
      x = 0
      do while (x <= m)
         x_last = min(x + 2, m)
         pairs = maxval(stencil%n_odd(x:x_last))
         call rows_near(stage, j, 1, pairs, a - m, count, upper, lower, place)
         do k = x, x_last
            c(:count, k - x + 1) = stencil%odd(place(:count), k)
         end do
         if (modulo(j, 2) == 1) then
            pairs = maxval(stencil%n_even(x:x_last)) + 1
            call rows_near(stage, j, 0, pairs, a - m, count_even, upper(count + 1:), &
                           lower(count + 1:), place(count + 1:))
            do k = x, x_last
               c(count + 1:count + count_even, k - x + 1) = &
                  stencil%even(place(count + 1:count + count_even) - 1, k)
            end do
            count = count + count_even
         end if
         sums(:n, 1:3) = 0.0_dp
         if (x_last == x) then
            call add_row_pairs(n, count, c(:, 1), stage%source, upper, lower, sums(:, 1))
         else
            call add_row_pairs_to_three(n, count, c(:, 1), c(:, 2), c(:, 3), stage%source, &
                                        upper, lower, x_last == x + 2, &
                                        sums(:, 1), sums(:, 2), sums(:, 3))
         end if
         call add_shifted(b - a + 1, m, x, x_last, size(sums, 1), sums, w(a:b))
         x = x_last + 1
      end do
   end subroutine correct_row_y
end module ehl_mlmi_up

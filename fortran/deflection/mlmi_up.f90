! SPDX-License-Identifier: BSD-3-Clause
!> The way up of multilevel multi-integration: deflection from ever finer grids, with local
!> corrections where there are sources
! Rows are passed by their first element
! allow(assumed-size)
module ehl_mlmi_up
   use ehl_kinds, only: dp
   use ehl_mlmi_stencil, only: reach
   use ehl_mlmi_stage, only: stage_t, stored_row, sources_near, rows_near
   use ehl_mlmi_rows, only: add_pairs, add_centred, add_row_pairs, add_row_pairs_to_three, &
      interpolate_and_merge
   !$ use omp_lib, only: omp_get_thread_num
   implicit none (type, external)
   private
   public :: ascend

   !> Most pairs of rows that a stencil can have
   integer, parameter :: most = reach + 2

contains

   !> Deflection w of a grid from that of the next coarser one, which is used up
   subroutine ascend(stage, omega, threads, work, w)
      type(stage_t), intent(inout) :: stage
      real(dp), intent(in) :: omega(:)
      integer, intent(in) :: threads
      real(dp), intent(inout) :: work(:, :, :)
      real(dp), intent(out) :: w(stage%low(1):stage%high(1), stage%low(2):stage%high(2))
      integer :: j, me

      !$omp parallel num_threads(threads) default(none) private(j, me) &
      !$omp shared(stage, omega, work, w)
      me = 1
      !$ me = omp_get_thread_num() + 1
      if (stage%axis == 1) then
         !$omp do schedule(dynamic, 8)
         do j = stage%low(2), stage%high(2)
            call ascend_row_x(stage, j, omega, work(:, 1, me), work(:, 2, me), work(:, 3, me), &
                              stage%coarse(:, j), w(:, j))
         end do
         !$omp end do
      else
         ! even rows are corrected, odd ones interpolated from them and corrected
         !$omp do schedule(dynamic, 8)
         do j = stage%coarse_low(2), stage%coarse_high(2)
            call correct_row_y(stage, 2*j, work(:, :, me), stage%coarse(:, j))
            if (2*j >= stage%low(2) .and. 2*j <= stage%high(2)) w(:, 2*j) = stage%coarse(:, j)
         end do
         !$omp end do
         !$omp do schedule(dynamic, 8)
         do j = stage%low(2) + 1 - modulo(stage%low(2), 2), stage%high(2), 2
            call interpolate_row(stage, j, omega, w(:, j))
            call correct_row_y(stage, j, work(:, :, me), w(:, j))
         end do
         !$omp end do
      end if
      !$omp end parallel
   end subroutine ascend

   !> One row of a grid halved in X: even columns are corrected, odd ones interpolated from them and
   !> corrected. The buffers start at the same column as the sources.
   subroutine ascend_row_x(stage, j, omega, odd, s_even, s_odd, even, w)
      type(stage_t), intent(in) :: stage
      integer, intent(in) :: j
      real(dp), intent(in) :: omega(:)
      real(dp), intent(inout) :: odd(stage%coarse_low(1) - stage%margin:*)
      real(dp), intent(inout) :: s_even(stage%coarse_low(1) - stage%margin:*)
      real(dp), intent(inout) :: s_odd(stage%coarse_low(1) - stage%margin:*)
      real(dp), intent(inout) :: even(stage%coarse_low(1):stage%coarse_high(1))
      real(dp), intent(out) :: w(stage%low(1):stage%high(1))
      integer :: a, b, d, l, r, first, last, half, upper, lower

      odd(stage%coarse_low(1):stage%coarse_high(1)) = 0.0_dp
      call sources_near(stage, j, stage%stencil%width, first, last)
      if (first <= last) then
         half = stage%stencil%length()/2 + 1
         a = max(shifta(first, 1) - half, stage%coarse_low(1))
         b = min(shifta(last, 1) + half, stage%coarse_high(1))
         l = a - half
         r = b + half
         do d = 0, stage%stencil%width
            upper = stored_row(stage, j + d)
            lower = stored_row(stage, j - d)
            if (stage%first(upper) > stage%last(upper) &
                .and. stage%first(lower) > stage%last(lower)) cycle
            if (d == 0) then
               call correct_row_x(stage, d, a, b, stage%even(:, j), stage%odd(:, j), &
                                  even(a:b), odd(a:b))
            else
               s_even(l:r) = stage%even(l:r, upper) + stage%even(l:r, lower)
               s_odd(l:r) = stage%odd(l:r, upper) + stage%odd(l:r, lower)
               call correct_row_x(stage, d, a, b, s_even, s_odd, even(a:b), odd(a:b))
            end if
         end do
      end if
      ! pairs of an even and an odd column lie in a..b, single ones may lie beside them
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

   !> Corrections from sources at distance d across, columns a..b of the half grids
   subroutine correct_row_x(stage, d, a, b, s_even, s_odd, even, odd)
      type(stage_t), intent(in) :: stage
      integer, intent(in) :: d, a, b
      real(dp), intent(in) :: s_even(*), s_odd(*)
      real(dp), intent(inout) :: even(:), odd(:)
      integer :: n, column

      n = b - a + 1
      column = a - (stage%coarse_low(1) - stage%margin) + 1
      associate (stencil => stage%stencil)
         call add_pairs(n, stencil%n_odd(d), stencil%odd(:, d), s_odd, column, column - 1, even)
         call add_pairs(n, stencil%n_odd(d), stencil%odd(:, d), s_even, column + 1, column, odd)
         call add_centred(n, stencil%n_even(d), stencil%even(:, d), s_odd, column, odd)
      end associate
   end subroutine correct_row_x

   !> Odd row j from the even ones around it
   subroutine interpolate_row(stage, j, omega, w)
      type(stage_t), intent(in) :: stage
      integer, intent(in) :: j
      real(dp), intent(in) :: omega(:)
      real(dp), intent(inout) :: w(:)
      integer :: k, above, below
      integer :: upper(most), lower(most)

      do k = 1, size(omega)
         above = shifta(j, 1) + k
         below = shifta(j, 1) + 1 - k
         if (stage%mirror) below = abs(below)
         upper(k) = (above - stage%coarse_low(2))*size(w)
         lower(k) = (below - stage%coarse_low(2))*size(w)
      end do
      call add_row_pairs(size(w), size(omega), omega, stage%coarse, upper, lower, .true., w)
   end subroutine interpolate_row

   !> Corrections of row j of a grid halved in Y: rows at the same distance are added, then
   !> weighted and summed for each column offset, and shifted by that offset at last
   subroutine correct_row_y(stage, j, sums, w)
      type(stage_t), intent(in) :: stage
      integer, intent(in) :: j
      real(dp), intent(inout) :: sums(:, :)
      real(dp), intent(inout) :: w(stage%low(1):stage%high(1))
      integer :: a, b, k, m, n, x, x_last, count, count_even, pairs, first, last
      integer :: upper(most), lower(most), place(most)
      real(dp) :: c(most, 3)

      associate (stencil => stage%stencil)
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
            if (x_last == x) then
               call add_row_pairs(n, count, c(:, 1), stage%source, upper, lower, .true., &
                                  sums(:, 1))
            else
               sums(:n, 1:3) = 0.0_dp
               call add_row_pairs_to_three(n, count, c(:, 1), c(:, 2), c(:, 3), stage%source, &
                                           upper, lower, x_last == x + 2, &
                                           sums(:, 1), sums(:, 2), sums(:, 3))
            end if
            call add_shifted(b - a + 1, m, x, x_last, size(sums, 1), sums, w(a:b))
            x = x_last + 1
         end do
      end associate
   end subroutine correct_row_y

   !> w(i) = w(i) + sum over k = x..x_last of s(i+m - k, k-x+1) + s(i+m + k, k-x+1), the
   !> middle (k = 0) once; up to three at a time
   pure subroutine add_shifted(n, m, x, x_last, stride, s, w)
      integer, intent(in) :: n, m, x, x_last, stride
      real(dp), intent(in) :: s(stride, 3)
      real(dp), intent(inout) :: w(n)
      integer :: i, k

      if (x == 0 .and. x_last == 2) then
         do i = 1, n
            w(i) = w(i) + s(i + m, 1) + ((s(i + m - 1, 2) + s(i + m + 1, 2)) &
                                         + (s(i + m - 2, 3) + s(i + m + 2, 3)))
         end do
      else if (x == 0 .and. x_last == 1) then
         do i = 1, n
            w(i) = w(i) + s(i + m, 1) + (s(i + m - 1, 2) + s(i + m + 1, 2))
         end do
      else if (x == 0) then
         do i = 1, n
            w(i) = w(i) + s(i + m, 1)
         end do
      else
         do k = x, x_last
            do i = 1, n
               w(i) = w(i) + (s(i + m - k, k - x + 1) + s(i + m + k, k - x + 1))
            end do
         end do
      end if
   end subroutine add_shifted
end module ehl_mlmi_up

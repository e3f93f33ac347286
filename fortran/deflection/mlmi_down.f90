! SPDX-License-Identifier: BSD-3-Clause
!> The way down of multilevel multi-integration: sources to ever coarser grids, and the
!> deflection of the coarsest
! Rows are passed by their first element
! allow(assumed-size)
module ehl_mlmi_down
   use ehl_kinds, only: dp
   use ehl_mlmi_stage, only: stage_t, stored_row, sources_near, rows_near, put, nowhere
   use ehl_mlmi_rows, only: add_pairs, add_row_pairs, add_taps, find_sources
   !$ use omp_lib, only: omp_get_thread_num
   implicit none (type, external)
   private
   public :: take, descend, sum_directly

   !> Most pairs of rows that a transfer can have
   integer, parameter :: most = 16

contains

   !> The pressure p (nx, ny) becomes the sources of the finest grid
   subroutine take(stage, threads, p, work)
      type(stage_t), intent(inout) :: stage
      integer, intent(in) :: threads
      real(dp), intent(in) :: p(0:stage%high(1), 0:stage%high(2))
      real(dp), intent(inout) :: work(:, :, :)
      integer :: j, first, last, n, me

      n = stage%high(1) + 1
      !$omp parallel num_threads(threads) default(none) private(j, first, last, me) &
      !$omp shared(n, stage, p, work)
      me = 1
      !$ me = omp_get_thread_num() + 1
      !$omp do schedule(dynamic, 8)
      do j = 0, stage%high(2)
         call find_sources(n, p(:, j), first, last)
         if (first <= last) then
            first = first - 1
            last = last - 1
         else
            first = nowhere
            last = -nowhere
         end if
         if (stage%axis == 1 .and. mod(n, 2) == 1 .and. &
             max(last, stage%last(j)) == n - 1) then
            ! the last column has no odd one beside it
            work(1:n, 1, me) = p(:, j)
            work(n + 1, 1, me) = 0.0_dp
            call put(stage, j, first, last, 0, work(:, 1, me))
         else
            call put(stage, j, first, last, 0, p(:, j))
         end if
      end do
      !$omp end do
      !$omp end parallel
   end subroutine take

   !> Sources of the next grid
   subroutine descend(fine, coarse, omega, threads, work)
      type(stage_t), intent(in) :: fine
      type(stage_t), intent(inout) :: coarse
      real(dp), intent(in) :: omega(:)
      integer, intent(in) :: threads
      real(dp), intent(inout) :: work(:, :, :)
      integer :: j, me

      !$omp parallel num_threads(threads) default(none) private(j, me) &
      !$omp shared(fine, coarse, omega, work)
      me = 1
      !$ me = omp_get_thread_num() + 1
      !$omp do schedule(dynamic, 8)
      do j = coarse%low(2), coarse%high(2)
         if (fine%axis == 1) then
            call descend_row_x(fine, coarse, j, omega, work(:, 1, me))
         else
            call descend_row_y(fine, coarse, j, omega, work(:, 1, me))
         end if
      end do
      !$omp end do
      !$omp end parallel
   end subroutine descend

   !> One row of sources, halved in X
   subroutine descend_row_x(fine, coarse, j, omega, sums)
      type(stage_t), intent(in) :: fine
      type(stage_t), intent(inout) :: coarse
      integer, intent(in) :: j
      real(dp), intent(in) :: omega(:)
      real(dp), intent(inout) :: sums(*)
      integer :: t, first, last, a, b, column

      t = size(omega)
      first = nowhere
      last = -nowhere
      if (fine%first(j) <= fine%last(j)) then
         first = max(shifta(fine%first(j), 1) - (t - 1), fine%coarse_low(1))
         last = min(shifta(fine%last(j), 1) + t, fine%coarse_high(1))
      end if
      call columns_to_write(coarse, j, first, last, a, b)
      if (a > b) return
      column = a - (fine%coarse_low(1) - fine%margin) + 1
      sums(1:b - a + 1) = fine%even(a:b, j)
      call add_pairs(b - a + 1, t, omega, fine%odd(:, j), column, column - 1, sums)
      call put(coarse, j, first, last, a, sums)
   end subroutine descend_row_x

   !> One row of sources, halved in Y
   subroutine descend_row_y(fine, coarse, j, omega, sums)
      type(stage_t), intent(in) :: fine
      type(stage_t), intent(inout) :: coarse
      integer, intent(in) :: j
      real(dp), intent(in) :: omega(:)
      real(dp), intent(inout) :: sums(*)
      integer :: t, first, last, a, b, count
      integer :: upper(most), lower(most), place(most)
      real(dp) :: c(most)

      t = size(omega)
      call sources_near(fine, 2*j, 2*t - 1, first, last)
      call columns_to_write(coarse, j, first, last, a, b)
      if (a > b) return
      call rows_near(fine, 2*j, 1, t, a, count, upper, lower, place)
      sums(1:b - a + 1) = fine%source(a:b, stored_row(fine, 2*j))
      c(:count) = omega(place(:count))
      call add_row_pairs(b - a + 1, count, c, fine%source, upper, lower, .false., sums)
      call put(coarse, j, first, last, a, sums)
   end subroutine descend_row_y

   !> Columns of the new sources first..last and of those that row j has, from an even to an
   !> odd one; a > b if there are none
   pure subroutine columns_to_write(stage, j, first, last, a, b)
      type(stage_t), intent(in) :: stage
      integer, intent(in) :: j, first, last
      integer, intent(out) :: a, b

      a = min(first, stage%first(j))
      b = max(last, stage%last(j))
      if (a > b) return
      a = 2*shifta(a, 1)
      b = 2*shifta(b, 1) + 1
   end subroutine columns_to_write

   !> Deflection of the coarsest grid
   subroutine sum_directly(stage, threads, work, w)
      type(stage_t), intent(in) :: stage
      integer, intent(in) :: threads
      real(dp), intent(inout) :: work(:, :, :)
      real(dp), intent(out) :: w(stage%low(1):stage%high(1), stage%low(2):stage%high(2))
      integer :: j, me

      !$omp parallel num_threads(threads) default(none) private(j, me) shared(stage, work, w)
      me = 1
      !$ me = omp_get_thread_num() + 1
      !$omp do schedule(static)
      do j = stage%low(2), stage%high(2)
         call sum_row(stage, j, work(:, 1, me), work(:, 2, me), w(:, j))
      end do
      !$omp end do
      !$omp end parallel
   end subroutine sum_directly

   !> One row of it: source rows at the same distance are added first. Sums are taken for a
   !> multiple of eight columns, so that the compiler's vector loop has no remainder.
   subroutine sum_row(stage, j, s, sums, w)
      type(stage_t), intent(in) :: stage
      integer, intent(in) :: j
      real(dp), intent(inout) :: s(stage%low(1):*), sums(*)
      real(dp), intent(out) :: w(:)
      integer :: d, i, n, a, b, upper, lower, start

      n = 8*((size(w) + 7)/8)
      sums(:n) = 0.0_dp
      start = lbound(stage%coarse, 1)
      do d = 0, ubound(stage%coarse, 2)
         upper = stored_row(stage, j + d)
         lower = stored_row(stage, j - d)
         a = min(stage%first(upper), stage%first(lower))
         b = max(stage%last(upper), stage%last(lower))
         if (a > b) cycle
         if (d == 0) then
            s(a:b) = stage%source(a:b, j)
         else
            s(a:b) = stage%source(a:b, upper) + stage%source(a:b, lower)
         end if
         s(b + 1:b + 7) = 0.0_dp
         do i = a, b, 8
            call add_taps(n, s(i:i + 7), stage%coarse(:, d), stage%low(1) - i - start + 1, sums)
         end do
      end do
      w = sums(:size(w))
   end subroutine sum_row
end module ehl_mlmi_down

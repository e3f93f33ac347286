! SPDX-License-Identifier: BSD-3-Clause
!> Multilevel multi-integration, the coarsest grid: its deflection by the sum as it stands
! Rows are passed by their first element
! allow(assumed-size)
module ehl_mlmi_coarsest
   use ehl_kernel, only: kernel_coefficient
   use ehl_kinds, only: dp
   use ehl_mlmi_down, only: no_memory, stage_t, stored_row
   use ehl_status, only: ehl_no_memory, status_t
   !$ use omp_lib, only: omp_get_thread_num
   implicit none (type, external)
   private
   public :: set_coarsest, sum_directly

contains

   !> Make this the coarsest grid low:high, of every step-th node
   subroutine set_coarsest(stage, low, high, mirror, step, factor, hx, hy, status)
      type(stage_t), intent(inout) :: stage
      integer, intent(in) :: low(2), high(2), step(2)
      logical, intent(in) :: mirror
      real(dp), intent(in) :: factor, hx, hy
      type(status_t), intent(inout) :: status
      integer :: i, j, width, height, stat

      stage%mirror = mirror
      stage%low = low
      stage%high = high
      stage%margin = 8
      width = high(1) - low(1) + stage%margin
      height = merge(2*high(2), high(2) - low(2), mirror)
      call stage%reserve_sources(stat)
      if (stat == 0) allocate (stage%coarse(-width:width, 0:height), stat=stat)
      if (stat /= 0) then
         call status%fail(ehl_no_memory, no_memory)
         return
      end if
      do j = 0, height
         do i = 0, width
            stage%coarse(i, j) = kernel_coefficient(factor, step(1)*i, step(2)*j, hx, hy)
            stage%coarse(-i, j) = stage%coarse(i, j)
         end do
      end do
   end subroutine set_coarsest

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

   !> y(i) = y(i) + sum over k = 1..8 of c(k)*a(start + i-1 - (k-1))
   pure subroutine add_taps(n, c, a, start, y)
      integer, intent(in) :: n, start
      real(dp), intent(in) :: c(8), a(*)
      real(dp), intent(inout) :: y(n)
      integer :: i, s

      s = start - 1
      do i = 1, n
         y(i) = y(i) + ((c(1)*a(s + i) + c(2)*a(s + i - 1)) &
                        + (c(3)*a(s + i - 2) + c(4)*a(s + i - 3))) &
                + ((c(5)*a(s + i - 4) + c(6)*a(s + i - 5)) &
                   + (c(7)*a(s + i - 6) + c(8)*a(s + i - 7)))
      end do
   end subroutine add_taps
end module ehl_mlmi_coarsest

! SPDX-License-Identifier: BSD-3-Clause
!> The multigrid cycle: full approximation scheme (Brandt 1977; Venner & Lubrecht 2000)
module ehl_cycle
   use ehl_coarsest, only: coarsest_t
   use ehl_film, only: pressure_sum, reynolds_operator, update_coefficients, update_film, update_residual
   use ehl_kinds, only: dp
   use ehl_level, only: level_t
   use ehl_relaxation, only: relax
   implicit none (type, external)
   private
   public :: cycle_options_t, fas_cycle, refresh, prolong_solution

   !> Residual reduction wanted on the coarsest level, and the most Newton steps to get it
   real(dp), parameter :: coarsest_reduction = 0.05_dp
   integer, parameter :: coarsest_steps = 12

   !> How a cycle is made
   type :: cycle_options_t
      !> Coarse cycles per cycle: 1 = V, 2 = W; an F cycle follows its first coarse F cycle by a V cycle
      integer :: gamma = 2
      logical :: full = .false.
      !> Sweeps before and after the coarse-grid correction
      integer :: pre = 2, post = 1
   end type cycle_options_t

contains

   !> Bring film and coefficients up to date with the pressure
   subroutine refresh(level)
      type(level_t), intent(inout) :: level
      call update_film(level)
      call update_coefficients(level)
   end subroutine refresh

   !> One cycle on level n. Film and coefficients are up to date before and after.
   recursive subroutine fas_cycle(levels, n, coarsest, options)
      !> Coarsest level first
      type(level_t), intent(inout) :: levels(:)
      integer, intent(in) :: n
      type(coarsest_t), intent(inout) :: coarsest
      type(cycle_options_t), intent(in) :: options
      type(cycle_options_t) :: v
      real(dp) :: rms
      integer :: k

      if (n == 1) then
         call coarsest%solve(levels(1), coarsest_reduction, coarsest_steps)
         return
      end if
      do k = 1, options%pre
         call relax(levels(n))
         call refresh(levels(n))
      end do
      call update_residual(levels(n), rms)
      call restrict_problem(levels(n), levels(n - 1))
      do k = 1, options%gamma
         call fas_cycle(levels, n - 1, coarsest, options)
         if (n == 2) exit
      end do
      if (options%full .and. n > 2) then
         v = options
         v%full = .false.
         call fas_cycle(levels, n - 1, coarsest, v)
      end if
      call correct(levels(n), levels(n - 1))
      call refresh(levels(n))
      do k = 1, options%post
         call relax(levels(n))
         call refresh(levels(n))
      end do
   end subroutine fas_cycle

   !> Coarse problem whose solution corrects the fine one
   subroutine restrict_problem(fine, coarse)
      type(level_t), intent(inout) :: fine, coarse
      real(dp) :: operator_row(coarse%grid%nx)
      real(dp) :: weight(-1:1, -1:1)
      integer :: i, j, ii, jj, k, l, nx, ny, row

      weight = reshape([1, 2, 1, 2, 4, 2, 1, 2, 1], [3, 3])/16.0_dp
      nx = coarse%grid%nx
      ny = coarse%grid%ny
      coarse%p = 0.0_dp
      do j = merge(1, 2, coarse%grid%mirror), ny - 1
         jj = 2*j - 1
         do i = 2, nx - 1
            ii = 2*i - 1
            if (fine%p(ii, jj) <= 0.0_dp) cycle
            do l = -1, 1
               row = merge(2, jj + l, jj + l < 1)
               do k = -1, 1
                  coarse%p(i, j) = coarse%p(i, j) + weight(k, l)*fine%p(ii + k, row)
               end do
            end do
         end do
      end do
      coarse%p_start = coarse%p
      coarse%h00 = fine%h00
      call coarse%engine%apply(coarse%p, coarse%w)
      do j = 1, ny
         jj = 2*j - 1
         do i = 1, nx
            ii = 2*i - 1
            if (i == 1 .or. i == nx .or. j == ny .or. (j == 1 .and. .not. coarse%grid%mirror)) then
               coarse%h(i, j) = fine%h(ii, jj)
               cycle
            end if
            coarse%h(i, j) = 0.0_dp
            do l = -1, 1
               row = merge(2, jj + l, jj + l < 1)
               do k = -1, 1
                  coarse%h(i, j) = coarse%h(i, j) + weight(k, l)*fine%h(ii + k, row)
               end do
            end do
         end do
      end do
      coarse%geometry = coarse%h - coarse%h00 - coarse%w
      call update_coefficients(coarse)
      coarse%rhs = 0.0_dp
      do j = merge(1, 2, coarse%grid%mirror), ny - 1
         jj = 2*j - 1
         call reynolds_operator(coarse, j, operator_row)
         do i = 2, nx - 1
            ii = 2*i - 1
            do l = -1, 1
               row = merge(2, jj + l, jj + l < 1)
               do k = -1, 1
                  coarse%rhs(i, j) = coarse%rhs(i, j) + weight(k, l)*fine%residual(ii + k, row)
               end do
            end do
            coarse%rhs(i, j) = coarse%rhs(i, j) + operator_row(i)
            ! keep the slack of cavitated regions
            if (coarse%p(i, j) <= 0.0_dp) coarse%rhs(i, j) = max(coarse%rhs(i, j), fine%rhs(ii, jj))
         end do
      end do
      coarse%load = fine%load - pressure_sum(fine, fine%p) + pressure_sum(coarse, coarse%p)
   end subroutine restrict_problem

   !> Add the coarse change, bilinearly interpolated, where the fine pressure is positive
   subroutine correct(fine, coarse)
      type(level_t), intent(inout) :: fine, coarse
      real(dp) :: change(coarse%grid%nx, coarse%grid%ny)
      real(dp) :: upper(coarse%grid%nx), lower(coarse%grid%nx), c
      integer :: i, j, l

      change = coarse%p - coarse%p_start
      fine%h00 = coarse%h00
      do j = merge(1, 2, fine%grid%mirror), fine%grid%ny - 1
         l = (j + 1)/2
         lower = change(:, l)
         upper = change(:, min(l + mod(j + 1, 2), coarse%grid%ny))
         do i = 2, fine%grid%nx - 1
            if (fine%p(i, j) <= 0.0_dp) cycle
            if (mod(i, 2) == 1) then
               c = 0.5_dp*(lower((i + 1)/2) + upper((i + 1)/2))
            else
               c = 0.25_dp*(lower(i/2) + upper(i/2) + lower(i/2 + 1) + upper(i/2 + 1))
            end if
            fine%p(i, j) = max(0.0_dp, fine%p(i, j) + c)
         end do
      end do
   end subroutine correct

   !> First approximation on a finer level: cubic interpolation of the coarse pressure
   subroutine prolong_solution(coarse, fine)
      type(level_t), intent(inout) :: coarse, fine
      real(dp) :: tmp(fine%grid%nx, coarse%grid%ny)
      integer :: j, l, n

      do l = 1, coarse%grid%ny
         call refine_line(coarse%p(:, l), tmp(:, l), .false.)
      end do
      n = coarse%grid%ny
      do j = 1, fine%grid%nx
         call refine_line(tmp(j, :), fine%p(j, :), coarse%grid%mirror)
      end do
      fine%p = max(fine%p, 0.0_dp)
      fine%h00 = coarse%h00
   end subroutine prolong_solution

   pure subroutine refine_line(a, b, mirror)
      real(dp), intent(in) :: a(:)
      real(dp), intent(out) :: b(:)
      logical, intent(in) :: mirror
      integer :: i, n
      real(dp) :: left

      n = size(a)
      b(1::2) = a
      do i = 1, n - 1
         if (i == 1 .and. mirror) then
            left = a(2)
         else
            left = a(max(i - 1, 1))
         end if
         b(2*i) = (-left + 9.0_dp*a(i) + 9.0_dp*a(i + 1) - a(min(i + 2, n)))/16.0_dp
      end do
   end subroutine refine_line
end module ehl_cycle

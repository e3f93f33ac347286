! SPDX-License-Identifier: BSD-3-Clause
!> Transfer of the problem to the next coarser level, and of the correction back (full approximation scheme)
module ehl_coarse_problem
   use ehl_alcouffe, only: transfer_t
   use ehl_film, only: pressure_sum, reynolds_operator, update_coefficients
   use ehl_galerkin, only: galerkin_product
   use ehl_kinds, only: dp
   use ehl_level, only: level_t
   implicit none (type, external)
   private
   public :: restrict_problem, correct, coarsening_classical, coarsening_alcouffe

   !> Bilinear transfers and rediscretised coarse operators, or operator-dependent transfers and
   !> Galerkin operators for the Poiseuille term
   integer, parameter :: coarsening_classical = 1, coarsening_alcouffe = 2
   !> The operator decides on the transfer where conductance/mesh-size^2 is above this
   real(dp), public :: dependent_from = 0.1_dp
   !> Slack of a coarse node that neither asks for pressure nor refuses it (the wedge term is of order 1)
   real(dp), parameter :: least_slack = 1.0e-8_dp
   !> Right-hand side of nodes that are to stay cavitated on a coarse level: they never ask for pressure
   real(dp), parameter :: never = 1.0e30_dp

contains

   !> Coarse problem whose solution corrects the fine one
   subroutine restrict_problem(fine, coarse, transfer, coarsening)
      type(level_t), intent(inout) :: fine, coarse
      type(transfer_t), intent(inout) :: transfer
      integer, intent(in) :: coarsening
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
      coarse%galerkin = .false.
      call update_coefficients(coarse)
      if (coarsening == coarsening_alcouffe) then
         call build_galerkin(fine, coarse, transfer)
         call restrict_residual_alcouffe(fine, coarse, transfer)
      else
         call restrict_residual(fine, coarse, weight)
      end if
      coarse%load = fine%load - pressure_sum(fine, fine%p) + pressure_sum(coarse, coarse%p)
   end subroutine restrict_problem

   !> Right-hand side of the coarse level by full weighting of the residual
   subroutine restrict_residual(fine, coarse, weight)
      type(level_t), intent(in) :: fine
      type(level_t), intent(inout) :: coarse
      real(dp), intent(in) :: weight(-1:1, -1:1)
      real(dp) :: operator_row(coarse%grid%nx)
      integer :: i, j, ii, jj, k, l, row

      coarse%rhs = 0.0_dp
      do j = merge(1, 2, coarse%grid%mirror), coarse%grid%ny - 1
         jj = 2*j - 1
         call reynolds_operator(coarse, j, operator_row)
         do i = 2, coarse%grid%nx - 1
            ii = 2*i - 1
            do l = -1, 1
               row = merge(2, jj + l, jj + l < 1)
               do k = -1, 1
                  coarse%rhs(i, j) = coarse%rhs(i, j) + weight(k, l)*fine%residual(ii + k, row)
               end do
            end do
            coarse%rhs(i, j) = coarse%rhs(i, j) + operator_row(i)
            ! keep the slack of cavitated regions, and where there is none make a little, lest rounding
            ! decides which nodes stay cavitated
            if (coarse%p(i, j) <= 0.0_dp) coarse%rhs(i, j) = max(coarse%rhs(i, j), fine%rhs(ii, jj)) + least_slack
         end do
      end do
   end subroutine restrict_residual

   !> Right-hand side of the coarse level by the transpose of interpolation
   subroutine restrict_residual_alcouffe(fine, coarse, transfer)
      type(level_t), intent(inout) :: fine, coarse
      type(transfer_t), intent(in) :: transfer
      real(dp) :: operator_row(coarse%grid%nx), residual(coarse%grid%nx)
      integer :: i, j

      coarse%rhs = 0.0_dp
      ! row 1 of a folded grid consists of half cells
      if (fine%grid%mirror) fine%residual(:, 1) = 0.5_dp*fine%residual(:, 1)
      do j = merge(1, 2, coarse%grid%mirror), coarse%grid%ny - 1
         call reynolds_operator(coarse, j, operator_row)
         call transfer%restrict_row(fine%residual, j, residual)
         do i = 2, coarse%grid%nx - 1
            if (coarse%p(i, j) > 0.0_dp) then
               coarse%rhs(i, j) = operator_row(i) + residual(i)*fine%cell(2)/coarse%cell(j)
            else
               coarse%rhs(i, j) = never
            end if
         end do
      end do
   end subroutine restrict_residual_alcouffe

   !> Transfer from the fine operator, and the Poiseuille operator of the coarse level
   subroutine build_galerkin(fine, coarse, transfer)
      type(level_t), intent(inout) :: fine, coarse
      type(transfer_t), intent(inout) :: transfer
      real(dp) :: limit, whole, t
      integer :: i, j, below

      call fine_operator(fine, transfer)
      limit = dependent_from*min(fine%grid%hx, fine%grid%hy)**2
      transfer%fine_free = 0.0_dp
      transfer%dependent = 0.0_dp
      do j = merge(1, 2, fine%grid%mirror), fine%grid%ny - 1
         below = merge(2, j - 1, j == 1)
         do i = 2, fine%grid%nx - 1
            if (fine%p(i, j) > 0.0_dp) transfer%fine_free(i, j) = 1.0_dp
            if (max(fine%eps(i, j), fine%eps(i - 1, j), fine%eps(i + 1, j), fine%eps(i, j + 1), &
                    fine%eps(i, below)) >= limit) transfer%dependent(i, j) = 1.0_dp
         end do
      end do
      call transfer%find_weights(transfer%a, transfer%fine_free, transfer%dependent)
      call galerkin_product(transfer%a, transfer, coarse%poiseuille)
      coarse%galerkin = .true.
      ! nodal conductances that the diagonal stands for
      associate (a => coarse%poiseuille, grid => coarse%grid)
         whole = 2.0_dp*(grid%hx/grid%hy + grid%hy/grid%hx)
         do j = merge(1, 2, grid%mirror), grid%ny - 1
            do i = 2, grid%nx - 1
               if (transfer%free(i, j) <= 0.0_dp) cycle
               t = a%diagonal(i, j)/whole
               if (grid%mirror .and. j == 1) t = 2.0_dp*t
               coarse%scale(i, j) = t/coarse%eps(i, j)
               coarse%eps(i, j) = t
            end do
         end do
         do j = merge(1, 2, grid%mirror), grid%ny - 1
            do i = 1, grid%nx - 1
               if (abs(a%east(i, j)) > 0.0_dp) a%east(i, j) = a%east(i, j)/(coarse%eps(i, j) + coarse%eps(i + 1, j))
               if (abs(a%north(i, j)) > 0.0_dp) a%north(i, j) = a%north(i, j)/(coarse%eps(i, j) + coarse%eps(i, j + 1))
               if (abs(a%north_east(i, j)) > 0.0_dp) a%north_east(i, j) = a%north_east(i, j) &
                  /(coarse%eps(i, j) + coarse%eps(i + 1, j + 1))
               if (i > 1) then
               if (abs(a%north_west(i, j)) > 0.0_dp) a%north_west(i, j) = a%north_west(i, j) &
                  /(coarse%eps(i, j) + coarse%eps(i - 1, j + 1))
               end if
               if (abs(a%excess(i, j)) > 0.0_dp) a%excess(i, j) = a%excess(i, j)/coarse%eps(i, j)
            end do
         end do
      end associate
   end subroutine build_galerkin

   !> Poiseuille operator of a level, integrated over the cells, as it is now
   subroutine fine_operator(fine, transfer)
      type(level_t), intent(in) :: fine
      type(transfer_t), intent(inout) :: transfer
      real(dp) :: rx, ry, half
      integer :: i, j

      transfer%a%five = .not. fine%galerkin
      rx = 0.5_dp*fine%grid%hy/fine%grid%hx
      ry = 0.5_dp*fine%grid%hx/fine%grid%hy
      associate (a => transfer%a, o => fine%poiseuille, e => fine%eps)
         do j = 1, fine%grid%ny - 1
            if (fine%galerkin) then
               do i = 1, fine%grid%nx - 1
                  a%east(i, j) = o%east(i, j)*(e(i, j) + e(i + 1, j))
                  a%north(i, j) = o%north(i, j)*(e(i, j) + e(i, j + 1))
                  a%north_east(i, j) = o%north_east(i, j)*(e(i, j) + e(i + 1, j + 1))
                  a%north_west(i + 1, j) = o%north_west(i + 1, j)*(e(i + 1, j) + e(i, j + 1))
                  a%excess(i, j) = o%excess(i, j)*e(i, j)
               end do
            else
               half = merge(0.5_dp, 1.0_dp, j == 1 .and. fine%grid%mirror)
               do i = 1, fine%grid%nx - 1
                  a%east(i, j) = half*rx*(e(i, j) + e(i + 1, j))
                  a%north(i, j) = ry*(e(i, j) + e(i, j + 1))
               end do
            end if
         end do
      end associate
   end subroutine fine_operator

   !> Add the coarse change, bilinearly interpolated, where the fine pressure is positive
   subroutine correct(fine, coarse, transfer, coarsening)
      type(level_t), intent(inout) :: fine, coarse
      type(transfer_t), intent(in) :: transfer
      integer, intent(in) :: coarsening
      real(dp) :: change(coarse%grid%nx, coarse%grid%ny)
      real(dp) :: upper(coarse%grid%nx), lower(coarse%grid%nx), row(fine%grid%nx), c
      integer :: i, j, l

      change = coarse%p - coarse%p_start
      fine%h00 = coarse%h00
      if (coarsening == coarsening_alcouffe) then
         do j = merge(1, 2, fine%grid%mirror), fine%grid%ny - 1
            call transfer%prolong_row(change, j, row)
            do i = 2, fine%grid%nx - 1
               if (fine%p(i, j) > 0.0_dp) fine%p(i, j) = max(0.0_dp, fine%p(i, j) + row(i))
            end do
         end do
         return
      end if
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
end module ehl_coarse_problem

! SPDX-License-Identifier: BSD-3-Clause
!> The force balance of a level,
!>
!>    iint P dX dY = load,   discrete: sum over the nodes of P hx hy = load
!>
!> (twice for nodes that have a mirror image). On the finest grid the load is that of the contact, 2 pi/3 for a ball on a
!> flat, less what is sustained beyond the border (far_field.f90). On a coarser one it is the finer one's error on top of what
!> the restricted pressure sustains. It is solved for with H00 on the coarsest grid (multigrid/coarsest.f90).
module ehl_force_balance
   use ehl_film, only: refresh
   use ehl_kinds, only: dp
   use ehl_level, only: level_t
   implicit none (type, external)
   private
   public :: balance_load, load_excess, missing_load, pass_load_on

contains

   !> Load that the pressure of a level lacks
   real(dp) function missing_load(level)
      type(level_t), intent(in) :: level
      missing_load = level%load - pressure_sum(level)
   end function missing_load

   !> Relative error of the force balance; positive: the pressure is too large
   real(dp) function load_excess(level)
      type(level_t), intent(in) :: level
      load_excess = pressure_sum(level)/level%load - 1.0_dp
   end function load_excess

   !> Load of a coarse level: what the fine pressure lacks, and what the restricted pressure sustains
   subroutine pass_load_on(fine, coarse)
      type(level_t), intent(in) :: fine
      type(level_t), intent(inout) :: coarse
      coarse%load = missing_load(fine) + pressure_sum(coarse)
   end subroutine pass_load_on

   !> Take a small relative error of the force balance away by scaling the pressure within the border, but where nodes yield; H00
   !> keeps the mean film under it. Film and coefficients are up to date before and after.
   subroutine balance_load(level)
      type(level_t), intent(inout) :: level
      real(dp) :: factor, deflection(level%grid%ny), after(level%grid%nx)
      integer :: j, nx

      nx = level%grid%nx
      factor = 1.0_dp/(1.0_dp + load_excess(level)/(1.0_dp - fixed_load(level)/level%load))
      !$omp parallel do default(none) shared(level, factor, deflection, nx) private(after) &
      !$omp num_threads(level%threads) if(level%parallel) schedule(static)
      do j = 1, level%grid%ny
         deflection(j) = sum(level%p(:, j)*(level%h(:, j) - level%h00 - level%film_rhs(:, j)))*level%grid%weight(j)
         if (level%grid%is_border(j)) cycle
         after(2:nx - 1) = factor*level%p(2:nx - 1, j)
         call level%boundary%limit_pressure(level%p(2:nx - 1, j), 2, j, after(2:nx - 1))
         level%p(2:nx - 1, j) = after(2:nx - 1)
      end do
      !$omp end parallel do
      level%h00 = level%h00 + (factor - factor**2)*sum(deflection)/level%load
      call refresh(level)
   end subroutine balance_load

   !> What of the load the pressure at the border and where nodes yield sustains
   pure real(dp) function fixed_load(level)
      type(level_t), intent(in) :: level
      integer :: j

      fixed_load = 0.0_dp
      do j = 1, level%grid%ny
         if (level%grid%is_border(j)) then
            fixed_load = fixed_load + sum(level%p(:, j))*level%grid%weight(j)
         else
            fixed_load = fixed_load + (level%p(1, j) + level%p(level%grid%nx, j))*level%grid%weight(j)
            fixed_load = fixed_load + sum(level%p(:, j), mask=level%boundary%yielding(level%grid%nx, j))*level%grid%weight(j)
         end if
      end do
   end function fixed_load

   !> hx hy sum P over the whole contact
   real(dp) function pressure_sum(level)
      type(level_t), intent(in) :: level
      real(dp) :: sums(level%grid%ny)
      integer :: j

      !$omp parallel do default(none) shared(level, sums) &
      !$omp num_threads(level%threads) if(level%parallel) schedule(static)
      do j = 1, level%grid%ny
         sums(j) = sum(level%p(:, j))*level%grid%weight(j)
      end do
      !$omp end parallel do
      pressure_sum = sum(sums)
   end function pressure_sum
end module ehl_force_balance

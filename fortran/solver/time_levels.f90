! SPDX-License-Identifier: BSD-3-Clause
!> What a time step takes from the ones before it, and leaves to the next
module ehl_time_levels
   use ehl_kinds, only: dp
   use ehl_level, only: level_t
   implicit none (type, external)
   private
   public :: set_geometry, set_history, keep

contains

   !> X^2/2 + Y^2/2 - RR
   subroutine set_geometry(level, rr)
      type(level_t), intent(inout) :: level
      real(dp), intent(in) :: rr(:, :)
      integer :: i, j

      !$omp parallel do default(none) shared(level, rr) private(i) &
      !$omp num_threads(level%threads) if(level%parallel) schedule(static)
      do j = 1, level%grid%ny
         do i = 1, level%grid%nx
            level%geometry(i, j) = 0.5_dp*(level%grid%x(i)**2 + level%grid%y(j)**2) - rr(i, j)
         end do
      end do
      !$omp end parallel do
   end subroutine set_geometry

   !> Explicit part of wedge and squeeze terms. Narrow: (-2 (rho H)_(i-1,k-1) + 0.5 (rho H)_(i-2,k-2))/dT, of
   !> first order in the first interior column; else (-2 (rho H)_(i,k-1) + 0.5 (rho H)_(i,k-2))/dT.
   subroutine set_history(level, mass, time_step, narrow)
      type(level_t), intent(inout) :: level
      !> rho H of the last two steps, the latest first, (nx, ny, 2)
      real(dp), intent(in) :: mass(:, :, :)
      real(dp), intent(in) :: time_step
      logical, intent(in) :: narrow
      real(dp) :: r
      integer :: i, j, nx, shift

      r = 1.0_dp/time_step
      nx = level%grid%nx
      shift = merge(1, 0, narrow)
      !$omp parallel do default(none) shared(level, mass, r, nx, shift, narrow) private(i) &
      !$omp num_threads(level%threads) if(level%parallel) schedule(static)
      do j = 1, level%grid%ny
         do i = 3, nx - 1
            level%rhs(i, j) = r*(-2.0_dp*mass(i - shift, j, 1) + 0.5_dp*mass(i - 2*shift, j, 2))
         end do
         if (narrow) then
            level%rhs(2, j) = -r*mass(1, j, 1)
         else
            level%rhs(2, j) = r*(-2.0_dp*mass(2, j, 1) + 0.5_dp*mass(2, j, 2))
         end if
      end do
      !$omp end parallel do
   end subroutine set_history

   !> The present fields become the last ones
   subroutine keep(level, mass, p_before)
      type(level_t), intent(in) :: level
      !> rho H of the last two steps and pressure of the last three, the latest first
      real(dp), intent(inout) :: mass(:, :, :), p_before(:, :, :)
      integer :: i, j

      !$omp parallel do default(none) shared(level, mass, p_before) private(i) &
      !$omp num_threads(level%threads) if(level%parallel) schedule(static)
      do j = 1, level%grid%ny
         do i = 1, level%grid%nx
            mass(i, j, 2) = mass(i, j, 1)
            mass(i, j, 1) = level%rho(i, j)*level%h(i, j)
            p_before(i, j, 3) = p_before(i, j, 2)
            p_before(i, j, 2) = p_before(i, j, 1)
            p_before(i, j, 1) = level%p(i, j)
         end do
      end do
      !$omp end parallel do
   end subroutine keep
end module ehl_time_levels

! SPDX-License-Identifier: BSD-3-Clause
!> Deflection by direct summation, the reference for the engines: O(n^2) in the number n of nodes
module direct
   use ehl_grid, only: grid_t
   use ehl_kernel, only: kernel_coefficient
   use ehl_kinds, only: dp
   implicit none (type, external)
   private
   public :: sum_directly

contains

   !> W = K P on a grid, which may be folded, with the factor of the contact
   subroutine sum_directly(grid, factor, p, w)
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: factor, p(:, :)
      real(dp), intent(out) :: w(:, :)
      !> Kernel k(di, dj)
      real(dp) :: k(1 - grid%nx:grid%nx - 1, 0:grid%full_ny() - 1)
      integer :: i, j, source

      do j = 0, grid%full_ny() - 1
         do i = 0, grid%nx - 1
            k(i, j) = kernel_coefficient(factor, i, j, grid%hx, grid%hy)
            k(-i, j) = k(i, j)
         end do
      end do
      w = 0.0_dp
      do j = 1, grid%ny
         do source = 1, grid%ny
            do i = 1, grid%nx
               w(:, j) = w(:, j) + p(i, source)*k(1 - i:grid%nx - i, abs(j - source))
               if (grid%mirror .and. source > 1) w(:, j) = w(:, j) + p(i, source)*k(1 - i:grid%nx - i, j + source - 2)
            end do
         end do
      end do
   end subroutine sum_directly
end module direct

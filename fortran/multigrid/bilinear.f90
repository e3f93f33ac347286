! SPDX-License-Identifier: BSD-3-Clause
!> Transfers between a grid and one that is coarser along X, along Y or along both: full weighting and bilinear interpolation
!> (Venner & Lubrecht 2000, ch. 2), row by row
module ehl_bilinear
   use ehl_grid, only: grid_t
   use ehl_kinds, only: dp
   implicit none (type, external)
   private
   public :: interpolate_row, mesh_ratio, weight_row

contains

   !> Mesh sizes of a coarse grid over those of a fine one
   pure function mesh_ratio(fine, coarse) result(step)
      type(grid_t), intent(in) :: fine, coarse
      integer :: step(2)
      step = fine%intervals()/coarse%intervals()
   end function mesh_ratio

   !> Coarse row j by full weighting along the axes that are halved, on the border by injection
   pure subroutine weight_row(coarse, step, fine, j, values)
      type(grid_t), intent(in) :: coarse
      integer, intent(in) :: step(2)
      !> Shape of the fine grid
      real(dp), intent(in) :: fine(:, :)
      integer, intent(in) :: j
      !> Shape (nx) of the coarse grid
      real(dp), intent(out) :: values(:)
      real(dp) :: mean_y(size(fine, 1))
      integer :: i, l, below, nx

      nx = coarse%nx
      l = step(2)*(j - 1) + 1
      values = fine(::step(1), l)
      if (coarse%is_border(j)) return
      if (step(2) == 1) then
         mean_y = fine(:, l)
      else
         below = coarse%south(l)
         if (coarse%periodic .and. l == 1) below = size(fine, 2)
         mean_y = 0.25_dp*(fine(:, below) + fine(:, l + 1)) + 0.5_dp*fine(:, l)
      end if
      if (step(1) == 1) then
         values(2:nx - 1) = mean_y(2:nx - 1)
         return
      end if
      do i = 2, nx - 1
         values(i) = 0.25_dp*(mean_y(2*i - 2) + mean_y(2*i)) + 0.5_dp*mean_y(2*i - 1)
      end do
   end subroutine weight_row

   !> Row j of the fine grid by bilinear interpolation
   pure subroutine interpolate_row(coarse, step, values, j, row)
      type(grid_t), intent(in) :: coarse
      integer, intent(in) :: step(2)
      !> Shape of the coarse grid
      real(dp), intent(in) :: values(:, :)
      integer, intent(in) :: j
      !> Shape (nx) of the fine grid
      real(dp), intent(out) :: row(:)
      real(dp) :: middle(coarse%nx)
      integer :: i, l, next

      if (step(2) == 1) then
         middle = values(:, j)
      else
         l = (j + 1)/2
         next = min(l + mod(j + 1, 2), coarse%ny)
         if (coarse%periodic .and. mod(j, 2) == 0) next = coarse%north(l)
         middle = 0.5_dp*(values(:, l) + values(:, next))
      end if
      row(::step(1)) = middle
      if (step(1) == 1) return
      do i = 1, coarse%nx - 1
         row(2*i) = 0.5_dp*(middle(i) + middle(i + 1))
      end do
   end subroutine interpolate_row
end module ehl_bilinear

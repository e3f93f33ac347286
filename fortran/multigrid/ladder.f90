! SPDX-License-Identifier: BSD-3-Clause
!> The grids of a multigrid solution: those that full multigrid solves one after the other, each half as fine along both
!> axes as the next, and those that each of them is corrected on.
!>
!> A sweep reduces what changes from cell to cell along an axis only where the cells are not much longer along it than across
!> it (docs/theory/relaxation.md). So a grid of long cells is coarsened along their short side alone until they are nearly
!> square, and from there on along both axes. The grid at the end is solved directly: it is coarsened along Y alone for as
!> long as it has many unknowns.
module ehl_ladder
   use ehl_grid, only: grid_t
   use ehl_kinds, only: dp
   implicit none (type, external)
   private
   public :: find_ladder

   !> Cells that are longer than that along Y, or along X, are coarsened along their short side alone
   real(dp), parameter :: long_y = 3.0_dp, long_x = 1.6_dp
   !> Most unknowns of a grid that is solved directly, and fewest intervals along Y
   integer, parameter :: max_unknowns = 250, fewest_rows = 8

contains

   !> The first n grids are those of full multigrid, coarsest first. below(k) is the grid that grid k is corrected on, 0 where
   !> it is solved directly.
   pure subroutine find_ladder(coarsest, n, grids, below)
      type(grid_t), intent(in) :: coarsest
      integer, intent(in) :: n
      type(grid_t), allocatable, intent(out) :: grids(:)
      integer, allocatable, intent(out) :: below(:)
      type(grid_t) :: grid
      integer :: k, step(2), same, fewest

      allocate (grids(n), below(n))
      grids(1) = coarsest
      do k = 2, n
         grids(k) = grids(k - 1)%finer()
      end do
      below = 0
      fewest = coarsest%nx - 1
      k = 0
      ! the list grows while it is walked through
      do while (k < size(grids))
         k = k + 1
         step = next_step(grids(k), fewest)
         if (all(step == 1)) cycle
         grid = grids(k)%coarsened(step)
         same = findloc(grids%nx == grid%nx .and. grids%ny == grid%ny, .true., dim=1)
         if (same == 0) then
            grids = [grids, grid]
            below = [below, 0]
            same = size(grids)
         end if
         below(k) = same
      end do
   end subroutine find_ladder

   !> What the mesh sizes are multiplied by on the next coarser grid; 1 and 1 where there is none
   pure function next_step(grid, fewest_columns) result(step)
      type(grid_t), intent(in) :: grid
      !> Fewest intervals along X
      integer, intent(in) :: fewest_columns
      integer :: step(2), intervals(2)
      logical :: possible(2)
      real(dp) :: ratio

      intervals = grid%intervals()
      possible = mod(intervals, 4) == 0 .and. intervals/2 >= [fewest_columns, fewest_rows]
      ratio = grid%hy/grid%hx
      step = 1
      if (possible(1) .and. (ratio > long_y .or. grid%is_row())) then
         step(1) = 2
      else if (ratio < 1.0_dp/long_x .and. possible(2)) then
         step(2) = 2
      else if (all(possible)) then
         step = 2
      else if (possible(2) .and. (grid%nx - 2)*(grid%ny - 1) > max_unknowns) then
         step(2) = 2
      end if
   end function next_step
end module ehl_ladder

! SPDX-License-Identifier: BSD-3-Clause
!> Symmetric nine-point operators on a grid
module ehl_nine_point
   use, intrinsic :: iso_fortran_env, only: int64
   use ehl_grid, only: grid_t
   use ehl_kinds, only: dp
   use ehl_status, only: ehl_no_memory, status_t
   implicit none (type, external)
   private
   public :: nine_point_t

   !> Operator sum_k o_k (u_k - u) - excess u, integrated over the cell of a node. Each coupling is
   !> stored once, at the node of the lower row, or of the lower column within a row; arrays of shape
   !> (0:nx, ny) with a column of zeros on the left.
   !>
   !> On a folded grid the cells of row 1 are half cells: only their part Y >= 0 counts, so that
   !> the operator is symmetric, and no coupling leaves the grid. On a strip the row above the last one is row 1.
   type :: nine_point_t
      !> Couplings of node (i, j) to (i+1, j), (i, j+1), (i+1, j+1) and (i-1, j+1)
      real(dp), allocatable :: east(:, :), north(:, :), north_east(:, :), north_west(:, :)
      !> Diagonal minus the sum of all couplings
      real(dp), allocatable :: excess(:, :)
      !> Whether the operator has five points: no diagonal couplings and no excess
      logical :: five = .false.
      type(grid_t) :: grid
   contains
      procedure :: setup
      procedure :: apply_row
      procedure :: has_below
      procedure :: diagonal
      procedure :: bytes
   end type nine_point_t

contains

   !> Allocate for a grid, all zero
   subroutine setup(self, grid, status)
      class(nine_point_t), intent(inout) :: self
      type(grid_t), intent(in) :: grid
      type(status_t), intent(inout) :: status
      integer :: stat

      if (status%failed()) return
      self%grid = grid
      associate (nx => grid%nx, ny => grid%ny)
         allocate (self%east(0:nx, ny), self%north(0:nx, ny), self%north_east(0:nx, ny), &
                   self%north_west(0:nx, ny), self%excess(0:nx, ny), source=0.0_dp, stat=stat)
      end associate
      if (stat /= 0) call status%fail(ehl_no_memory, "no memory for a nine-point operator")
   end subroutine setup

   !> Row j of the operator applied to u, in columns 2 to nx-1; j is not a border row
   pure subroutine apply_row(self, u, j, values)
      class(nine_point_t), intent(in) :: self
      !> Shape (nx, ny)
      real(dp), intent(in) :: u(:, :)
      integer, intent(in) :: j
      !> Shape (nx)
      real(dp), intent(inout) :: values(:)
      integer :: i, below, above

      above = self%grid%north(j)
      do i = 2, size(u, 1) - 1
         values(i) = self%east(i, j)*(u(i + 1, j) - u(i, j)) + self%east(i - 1, j)*(u(i - 1, j) - u(i, j)) &
                     + self%north(i, j)*(u(i, above) - u(i, j)) &
                     + self%north_east(i, j)*(u(i + 1, above) - u(i, j)) &
                     + self%north_west(i, j)*(u(i - 1, above) - u(i, j)) - self%excess(i, j)*u(i, j)
      end do
      if (.not. self%has_below(j)) return
      below = self%grid%south(j)
      do i = 2, size(u, 1) - 1
         values(i) = values(i) + self%north(i, below)*(u(i, below) - u(i, j)) &
                     + self%north_east(i - 1, below)*(u(i - 1, below) - u(i, j)) &
                     + self%north_west(i + 1, below)*(u(i + 1, below) - u(i, j))
      end do
   end subroutine apply_row

   !> Whether row j has couplings stored in a row below: row 1 of a folded grid, with its half cells, has none
   elemental logical function has_below(self, j)
      class(nine_point_t), intent(in) :: self
      integer, intent(in) :: j
      has_below = j > 1 .or. (self%grid%periodic .and. .not. self%grid%mirror)
   end function has_below

   !> Sum of all couplings of node (i, j), and its excess; 1 < i < nx
   pure real(dp) function diagonal(self, i, j)
      class(nine_point_t), intent(in) :: self
      integer, intent(in) :: i, j
      integer :: below

      diagonal = self%east(i, j) + self%east(i - 1, j) + self%north(i, j) + self%north_east(i, j) &
                 + self%north_west(i, j) + self%excess(i, j)
      if (.not. self%has_below(j)) return
      below = self%grid%south(j)
      diagonal = diagonal + self%north(i, below) + self%north_east(i - 1, below) + self%north_west(i + 1, below)
   end function diagonal

   !> Allocated bytes
   pure integer(int64) function bytes(self)
      class(nine_point_t), intent(in) :: self
      bytes = 0
      if (allocated(self%east)) bytes = 40*size(self%east, kind=int64)
   end function bytes
end module ehl_nine_point

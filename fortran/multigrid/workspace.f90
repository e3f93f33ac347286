! SPDX-License-Identifier: BSD-3-Clause
!> Work space of a level for the relaxation and the coarse problem
module ehl_workspace
   use, intrinsic :: iso_fortran_env, only: int64
   use ehl_grid, only: grid_t
   use ehl_kernel, only: coefficient
   use ehl_kinds, only: dp, pi
   use ehl_status, only: ehl_no_memory, status_t
   implicit none (type, external)
   private
   public :: workspace_t, line_work_t, near_reach, line_fields, line_width, row_reach, row_below, row_above

   !> The line systems include the deflection kernel up to this distance along X
   integer, parameter :: near_reach = 2
   !> The equations of a grid of one row include it up to `row_reach`, and couple row_below nodes upstream and row_above downstream
   integer, parameter :: row_reach = 15, row_below = row_reach + 2, row_above = row_reach + 1
   !> Numbers per node from which the line systems are assembled
   integer, parameter :: line_fields = 10
   !> Number of lines relaxed simultaneously
   integer, parameter :: line_width = 8

   !> Cells with a larger hy/hx are long
   real(dp), parameter :: long = 1.6_dp

   !> Work space of one thread's line systems: their input (line, number, node), nodes from
   !> -1; upper diagonals (line, diagonal, node) and changes (line, node), nodes from -3
   type :: line_work_t
      real(dp), allocatable :: fields(:, :, :), upper(:, :, :), change(:, :)
      !> 1 where a node touches at a boundary film (line, node)
      real(dp), allocatable :: touching(:, :)
   end type line_work_t

   !> Arrays of shape (nx, ny) unless stated otherwise
   type :: workspace_t
      !> 1 where a node changes distributively in the present sweep, else 0; changes of pressure at these nodes
      real(dp), allocatable :: dipole(:, :), change(:, :)
      !> For time steps only: the weight with which the smooth part of a node's change is removed, the weighted
      !> changes of a sweep, and their mean along X
      real(dp), allocatable :: smoothing_weight(:, :), raw_change(:, :), mean_change(:, :)
      !> A distributive change lowers the pressure of the adjacent nodes along X and along Y by these fractions of it.
      !> On cells that are longer along Y the neighbours along Y receive less: with a quarter each the deflection would
      !> decay slowly along X. On long cells the weights are proportional to 1/h^2, so that the second moments along X and
      !> Y are equal as on square cells (docs/theory/relaxation.md); on nearly square cells, where either works, to 1/h.
      !> Measured for hy/hx of 1/4, 1.41, 2, 2.8 and 4.
      real(dp) :: dipole_weights(2) = 0.25_dp
      !> Kernel near the source: of a point change, and of a distributive (dipole) change
      real(dp) :: near(-near_reach:near_reach) = 0.0_dp, near_dipole(-near_reach:near_reach) = 0.0_dp
      !> For a grid of one row, which has no line systems: its equations (-row_below:row_above, nx), and the kernel
      real(dp), allocatable :: band(:, :)
      real(dp) :: near_row(-row_reach:row_reach) = 0.0_dp
      !> Work space of line systems, one per thread
      type(line_work_t), allocatable :: lines(:)
      !> For coarse problems only: restricted pressure and film, and their changes by the coarse solution
      real(dp), allocatable, dimension(:, :) :: p_start, h_start, p_change, h_change
   contains
      procedure :: setup
      procedure :: prepare_coarse
      procedure :: prepare_steps
      procedure :: bytes
   end type workspace_t

contains

   !> Allocate; factor: k_b of the deflection
   subroutine setup(self, grid, factor, threads, status)
      class(workspace_t), intent(inout) :: self
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: factor
      integer, intent(in) :: threads
      type(status_t), intent(inout) :: status
      integer :: d, stat

      if (status%failed()) return
      associate (nx => grid%nx, ny => grid%ny)
         allocate (self%dipole(nx, ny), self%change(nx, ny), source=0.0_dp, stat=stat)
         if (grid%is_row()) then
            if (stat == 0) allocate (self%band(-row_below:row_above, nx), source=0.0_dp, stat=stat)
            self%near_row = kernel_of_row(grid, factor)
            if (stat /= 0) call status%fail(ehl_no_memory, "no memory for the relaxation of a grid level")
            return
         end if
         if (stat == 0) allocate (self%lines(threads), stat=stat)
         do d = 1, threads
            if (stat == 0) allocate (self%lines(d)%fields(line_width, line_fields, -1:nx + 2), &
                                     self%lines(d)%upper(line_width, 2, -3:nx), &
                                     self%lines(d)%change(line_width, -3:nx + 1), &
                                     self%lines(d)%touching(line_width, nx), source=0.0_dp, stat=stat)
         end do
      end associate
      if (stat /= 0) then
         call status%fail(ehl_no_memory, "no memory for the relaxation of a grid level")
         return
      end if
      associate (hx => grid%hx, hy => grid%hy)
         self%dipole_weights = 0.5_dp*([max(hx, hy), hx]/(hx + max(hx, hy)))
         if (hy > long*hx) self%dipole_weights = 0.5_dp*([hy, hx]**2/(hx**2 + hy**2))
         do d = -near_reach, near_reach
            self%near(d) = coefficient(grid, factor, d, 0)
            self%near_dipole(d) = self%near(d) - (self%dipole_weights(1)*(coefficient(grid, factor, d - 1, 0) &
                                                                          + coefficient(grid, factor, d + 1, 0)) &
                                                  + self%dipole_weights(2)*2.0_dp*coefficient(grid, factor, d, 1))
         end do
      end associate
   end subroutine setup

   !> The kernel near the source for the equations of one row. Its value one node beyond the reach is subtracted, because a constant
   !> is part of H00 and a truncated logarithm would have a step there. A fraction of the deflection by the whole contact is
   !> added: without it smooth changes overshoot so much on fine grids that cycles diverge. With this fraction and width 2 cycles
   !> per level suffice from M = 0.5 to 500 on 65 to 4097 nodes.
   pure function kernel_of_row(grid, factor) result(near)
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: factor
      real(dp) :: near(-row_reach:row_reach)
      real(dp), parameter :: fraction = 0.3_dp, width = row_reach/3.0_dp
      integer :: d

      near = [(coefficient(grid, factor, d, 0), d=-row_reach, row_reach)] - coefficient(grid, factor, row_reach + 1, 0)
      ! 4 k_b: sum over the contact of the kernel minus its value at the edge; 4 k_b times the reach: sum of the part above
      near = near + fraction*4.0_dp*factor*max(0.0_dp, 1.0_dp - (row_reach + 1)*grid%hx) &
             *[(exp(-(d/width)**2), d=-row_reach, row_reach)]/(width*sqrt(pi))
   end function kernel_of_row

   !> Allocate what the level needs for the coarse problem of a finer one
   subroutine prepare_coarse(self, status)
      class(workspace_t), intent(inout) :: self
      type(status_t), intent(inout) :: status
      integer :: stat

      if (status%failed() .or. allocated(self%p_start)) return
      allocate (self%p_start, self%h_start, self%p_change, self%h_change, mold=self%change, stat=stat)
      if (stat /= 0) call status%fail(ehl_no_memory, "no memory for the coarse problem of a grid level")
   end subroutine prepare_coarse

   !> Allocate what time steps need unless it is allocated
   subroutine prepare_steps(self, status)
      class(workspace_t), intent(inout) :: self
      type(status_t), intent(inout) :: status
      integer :: stat

      if (status%failed() .or. allocated(self%raw_change)) return
      allocate (self%smoothing_weight, self%raw_change, self%mean_change, mold=self%change, stat=stat)
      if (stat /= 0) then
         call status%fail(ehl_no_memory, "no memory for the time steps of a grid level")
         return
      end if
      self%smoothing_weight = 0.0_dp
      self%raw_change = 0.0_dp
      self%mean_change = 0.0_dp
   end subroutine prepare_steps

   !> Allocated bytes
   pure integer(int64) function bytes(self)
      class(workspace_t), intent(in) :: self
      integer(int64) :: numbers
      integer :: k

      numbers = 0
      if (allocated(self%dipole)) numbers = 2*size(self%dipole, kind=int64)
      if (allocated(self%band)) numbers = numbers + size(self%band, kind=int64)
      if (allocated(self%p_start)) numbers = numbers + 4*size(self%p_start, kind=int64)
      if (allocated(self%raw_change)) numbers = numbers + 3*size(self%raw_change, kind=int64)
      if (allocated(self%lines)) then
         do k = 1, size(self%lines)
            numbers = numbers + size(self%lines(k)%fields) + size(self%lines(k)%upper) + size(self%lines(k)%change) &
                      + size(self%lines(k)%touching)
         end do
      end if
      bytes = 8*numbers
   end function bytes
end module ehl_workspace

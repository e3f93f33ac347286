! SPDX-License-Identifier: BSD-3-Clause
!> The Poiseuille term d/dX (eps_x dP/dX) + d/dY (eps_y dP/dY) on one grid, in two forms: the five-point difference with
!> arithmetic means of the conductances between nodes (Zhang et al. 2019, eqs. 7 and 8; reynolds.f90), and the nine-point
!> Galerkin product of a finer grid's term, frozen while P and H change. No other module contains the five-point difference.
module ehl_poiseuille
   use ehl_flow, only: dir_x, flow_t
   use ehl_grid, only: grid_t
   use ehl_kinds, only: dp
   use ehl_nine_point, only: nine_point_t
   use ehl_status, only: status_t
   implicit none (type, external)
   private
   public :: poiseuille_t, line_terms_t, max_neighbours, block_size

   !> Maximum number of neighbours of a node in either form
   integer, parameter :: max_neighbours = 8
   !> Maximum number of nodes of a row that line systems assemble at a time
   integer, parameter :: block_size = 32

   !> Pressures have the shape (nx, ny). Values are per area unless stated otherwise.
   type :: poiseuille_t
      type(grid_t), private :: grid
      !> Whether the term is `product` over the cell area, in place of the five-point difference
      logical :: frozen = .false.
      !> Galerkin product; allocated by prepare_product
      type(nine_point_t) :: product
   contains
      procedure :: setup
      procedure :: prepare_product
      procedure :: apply_row
      procedure :: line_row
      procedure :: couplings
      procedure :: integrate
      procedure :: flow_row
      procedure :: flow_rate
      procedure :: through_east
      procedure :: across
   end type poiseuille_t

   !> Coefficients of a line system along X for a block of a row; nodes are numbered from 1. Not set at border nodes, which have no
   !> equation, except for the coupling of the first node to the east.
   type :: line_terms_t
      !> Right-hand side minus the term
      real(dp) :: rest(block_size) = 0.0_dp
      !> Minus the sum of the couplings to other rows and the excess (nine_point.f90); derivative of the flow from these rows with
      !> respect to the node's conductance
      real(dp) :: other(block_size) = 0.0_dp, other_rate(block_size) = 0.0_dp
      !> Coupling to the next node of the row, starting with the node before the block; its derivative with respect to the
      !> conductance of either node
      real(dp) :: east(0:block_size) = 0.0_dp, east_rate(0:block_size) = 0.0_dp
   end type line_terms_t

contains

   !> Set the grid; the term is the five-point difference
   subroutine setup(self, grid)
      class(poiseuille_t), intent(inout) :: self
      type(grid_t), intent(in) :: grid

      self%grid = grid
      self%frozen = .false.
   end subroutine setup

   !> Allocate the Galerkin product unless it is allocated
   subroutine prepare_product(self, status)
      class(poiseuille_t), intent(inout) :: self
      type(status_t), intent(inout) :: status

      if (.not. allocated(self%product%east)) call self%product%setup(self%grid, status)
   end subroutine prepare_product

   !> Row j of the term at pressure p, in columns 2 to nx-1; j is not a border row
   pure subroutine apply_row(self, p, flow, j, values)
      class(poiseuille_t), intent(in) :: self
      real(dp), contiguous, intent(in) :: p(:, :)
      class(flow_t), intent(in) :: flow
      integer, intent(in) :: j
      !> Shape (nx)
      real(dp), intent(inout) :: values(:)
      real(dp) :: rx, ry
      integer :: i, south, north, nx

      nx = self%grid%nx
      if (self%frozen) then
         call self%product%apply_row(p, j, values)
         values(2:nx - 1) = values(2:nx - 1)/self%grid%cell(j)
         return
      end if
      south = self%grid%south(j)
      north = self%grid%north(j)
      rx = 0.5_dp/self%grid%hx**2
      ry = 0.5_dp/self%grid%hy**2
      if (self%grid%is_row()) ry = 0.0_dp
      associate (ex => flow%eps(:, :, dir_x), ey => flow%eps(:, :, flow%dir_y))
         do i = 2, nx - 1
            values(i) = rx*((ex(i + 1, j) + ex(i, j))*(p(i + 1, j) - p(i, j)) &
                            + (ex(i - 1, j) + ex(i, j))*(p(i - 1, j) - p(i, j))) &
                        + ry*((ey(i, north) + ey(i, j))*(p(i, north) - p(i, j)) &
                              + (ey(i, south) + ey(i, j))*(p(i, south) - p(i, j)))
         end do
      end associate
   end subroutine apply_row

   !> Coefficients of a line system for row j, in columns `first` to `last`: nodes are numbered from 1 at `first`. Border
   !> nodes have a coupling to the east only.
   pure subroutine line_row(self, p, flow, rhs, j, first, last, terms)
      class(poiseuille_t), intent(in) :: self
      real(dp), contiguous, intent(in) :: p(:, :)
      class(flow_t), intent(in) :: flow
      !> Shape (nx)
      real(dp), contiguous, intent(in) :: rhs(:)
      integer, intent(in) :: j, first, last
      type(line_terms_t), intent(inout) :: terms
      real(dp) :: rx, ry, north, south, pn, ps
      integer :: i, k, below, above

      if (self%frozen) then
         call frozen_line_row(self, p, rhs, j, first, last, terms)
         return
      end if
      below = self%grid%south(j)
      above = self%grid%north(j)
      rx = 0.5_dp/self%grid%hx**2
      ry = 0.5_dp/self%grid%hy**2
      if (self%grid%is_row()) ry = 0.0_dp
      associate (ex => flow%eps(:, :, dir_x), ey => flow%eps(:, :, flow%dir_y))
         do i = max(first - 1, 1), min(last, self%grid%nx - 1)
            k = i - first + 1
            terms%east(k) = rx*(ex(i + 1, j) + ex(i, j))
            terms%east_rate(k) = rx
         end do
         do i = max(first, 2), min(last, self%grid%nx - 1)
            k = i - first + 1
            north = ry*(ey(i, above) + ey(i, j))
            south = ry*(ey(i, below) + ey(i, j))
            pn = p(i, above) - p(i, j)
            ps = p(i, below) - p(i, j)
            terms%rest(k) = rhs(i) - north*pn - south*ps - terms%east(k)*(p(i + 1, j) - p(i, j)) &
                            - terms%east(k - 1)*(p(i - 1, j) - p(i, j))
            terms%other(k) = -(north + south)
            terms%other_rate(k) = ry*(pn + ps)
         end do
      end associate
      if (flow%depends_on_gradient) call line_of_tangents(self, flow, j, first, last, terms)
   end subroutine line_row

   !> Coefficients of a line system where the conductances depend on the pressure gradient: the tangents replace them in the
   !> couplings, and `other` includes the effect of P on the conductances along Y, since other_rate is for those along X
   pure subroutine line_of_tangents(self, flow, j, first, last, terms)
      type(poiseuille_t), intent(in) :: self
      class(flow_t), intent(in) :: flow
      integer, intent(in) :: j, first, last
      type(line_terms_t), intent(inout) :: terms
      integer :: i, k, below, above
      real(dp) :: ry

      below = self%grid%south(j)
      above = self%grid%north(j)
      ry = 0.5_dp/self%grid%hy**2
      if (self%grid%is_row()) ry = 0.0_dp
      associate (tx => flow%tangent(:, :, dir_x), ty => flow%tangent(:, :, flow%dir_y), &
                 ey => flow%eps(:, :, flow%dir_y), slope => flow%dlneps_dp(:, :, flow%dir_y))
         do i = max(first - 1, 1), min(last, self%grid%nx - 1)
            terms%east(i - first + 1) = 0.5_dp/self%grid%hx**2*(tx(i + 1, j) + tx(i, j))
         end do
         do i = max(first, 2), min(last, self%grid%nx - 1)
            k = i - first + 1
            terms%other(k) = terms%other_rate(k)*ey(i, j)*slope(i, j) &
                             - ry*(ty(i, above) + 2.0_dp*ty(i, j) + ty(i, below))
            terms%other_rate(k) = 0.0_dp
         end do
      end associate
   end subroutine line_of_tangents

   !> Coefficients of a line system for a Galerkin product: its couplings, with zero derivatives
   pure subroutine frozen_line_row(self, p, rhs, j, first, last, terms)
      type(poiseuille_t), intent(in) :: self
      real(dp), contiguous, intent(in) :: p(:, :), rhs(:)
      integer, intent(in) :: j, first, last
      type(line_terms_t), intent(inout) :: terms
      real(dp) :: cell, q, term
      integer :: i, k, below, above

      cell = self%grid%cell(j)
      below = self%grid%south(j)
      above = self%grid%north(j)
      associate (a => self%product)
         do i = max(first - 1, 1), min(last, self%grid%nx - 1)
            k = i - first + 1
            terms%east(k) = a%east(i, j)/cell
            terms%east_rate(k) = 0.0_dp
         end do
         do i = max(first, 2), min(last, self%grid%nx - 1)
            k = i - first + 1
            q = a%excess(i, j) + a%north_west(i, j) + a%north(i, j) + a%north_east(i, j)
            term = a%north_west(i, j)*p(i - 1, above) + a%north(i, j)*p(i, above) + a%north_east(i, j)*p(i + 1, above)
            if (a%has_below(j)) then
               q = q + a%north_east(i - 1, below) + a%north(i, below) + a%north_west(i + 1, below)
               term = term + a%north_east(i - 1, below)*p(i - 1, below) + a%north(i, below)*p(i, below) &
                      + a%north_west(i + 1, below)*p(i + 1, below)
            end if
            terms%rest(k) = rhs(i) - (term - q*p(i, j))/cell - terms%east(k)*(p(i + 1, j) - p(i, j)) &
                            - terms%east(k - 1)*(p(i - 1, j) - p(i, j))
            terms%other(k) = -q/cell
            terms%other_rate(k) = 0.0_dp
         end do
      end associate
   end subroutine frozen_line_row

   !> The linearised term at node (i, j): its neighbours, the couplings to them, the direction of their conductances, their
   !> derivatives with respect to the conductance of either node, and the excess of the diagonal over the sum of the couplings
   pure subroutine couplings(self, flow, i, j, n, neighbour, direction, coupling, rate, excess)
      class(poiseuille_t), intent(in) :: self
      class(flow_t), intent(in) :: flow
      integer, intent(in) :: i, j
      integer, intent(out) :: n, neighbour(2, max_neighbours), direction(max_neighbours)
      real(dp), intent(out) :: coupling(max_neighbours), rate(max_neighbours), excess
      real(dp) :: sum_eps
      integer :: m, below, above

      below = self%grid%south(j)
      above = self%grid%north(j)
      coupling = 0.0_dp
      rate = 0.0_dp
      excess = 0.0_dp
      direction = dir_x
      neighbour(:, 1:4) = reshape([i + 1, j, i - 1, j, i, above, i, below], [2, 4])
      neighbour(:, 5:8) = reshape([i - 1, above, i + 1, above, i - 1, below, i + 1, below], [2, 4])
      if (.not. self%frozen) then
         n = merge(2, 4, self%grid%is_row())
         direction(1:4) = [dir_x, dir_x, flow%dir_y, flow%dir_y]
         coupling(1:4) = 0.5_dp/[self%grid%hx**2, self%grid%hx**2, self%grid%hy**2, self%grid%hy**2]
         coupling(n + 1:) = 0.0_dp
         do m = 1, n
            sum_eps = flow%eps(i, j, direction(m)) + flow%eps(neighbour(1, m), neighbour(2, m), direction(m))
            coupling(m) = coupling(m)*sum_eps
            rate(m) = coupling(m)/sum_eps
            if (flow%depends_on_gradient) coupling(m) = rate(m)*(flow%tangent(i, j, direction(m)) &
                                                                + flow%tangent(neighbour(1, m), neighbour(2, m), direction(m)))
         end do
         return
      end if
      associate (a => self%product)
         n = merge(8, 6, a%has_below(j))
         coupling(1:3) = [a%east(i, j), a%east(i - 1, j), a%north(i, j)]
         coupling(5:6) = [a%north_west(i, j), a%north_east(i, j)]
         if (n == 8) then
            coupling(4) = a%north(i, below)
            coupling(7:8) = [a%north_east(i - 1, below), a%north_west(i + 1, below)]
         end if
         coupling = coupling/self%grid%cell(j)
         excess = a%excess(i, j)/self%grid%cell(j)
      end associate
   end subroutine couplings

   !> The five-point difference, linearised, as an operator integrated over the cells; rows from `first` to `last`
   pure subroutine integrate(self, flow, first, last, a)
      class(poiseuille_t), intent(in) :: self
      class(flow_t), intent(in) :: flow
      integer, intent(in) :: first, last
      type(nine_point_t), intent(inout) :: a
      real(dp) :: rx, ry
      integer :: i, j, above

      do j = first, last
         above = self%grid%north(j)
         rx = 0.5_dp*self%grid%cell(j)/self%grid%hx**2
         ry = 0.5_dp*self%grid%hx/self%grid%hy
         ! the cells of the last row of a folded strip are half cells: their only coupling along Y is stored in the row below
         if (self%grid%mirror .and. above < j) ry = 0.0_dp
         if (flow%depends_on_gradient) then
            do i = 1, self%grid%nx - 1
               a%east(i, j) = rx*(flow%tangent(i, j, dir_x) + flow%tangent(i + 1, j, dir_x))
               a%north(i, j) = ry*(flow%tangent(i, j, flow%dir_y) + flow%tangent(i, above, flow%dir_y))
            end do
            cycle
         end if
         do i = 1, self%grid%nx - 1
            a%east(i, j) = rx*(flow%eps(i, j, dir_x) + flow%eps(i + 1, j, dir_x))
            a%north(i, j) = ry*(flow%eps(i, j, flow%dir_y) + flow%eps(i, above, flow%dir_y))
         end do
      end do
   end subroutine integrate

   !> Minus the change of the term along X by a change of the pressure in row j, with the conductance of the node itself
   pure subroutine flow_row(self, flow, j, change, values)
      class(poiseuille_t), intent(in) :: self
      class(flow_t), intent(in) :: flow
      integer, intent(in) :: j
      !> Shape (nx)
      real(dp), intent(in) :: change(:)
      !> Shape (nx); zero on the borders
      real(dp), intent(out) :: values(:)
      real(dp) :: r
      integer :: i

      r = 1.0_dp/self%grid%hx**2
      values(1) = 0.0_dp
      values(size(values)) = 0.0_dp
      do i = 2, size(values) - 1
         values(i) = r*flow%eps(i, j, dir_x)*(2.0_dp*change(i) - change(i - 1) - change(i + 1))
      end do
   end subroutine flow_row

   !> Poiseuille flow per width through the east face of node (i, j), as discretised in the term
   pure real(dp) function through_east(self, p, flow, i, j)
      class(poiseuille_t), intent(in) :: self
      real(dp), contiguous, intent(in) :: p(:, :)
      class(flow_t), intent(in) :: flow
      integer, intent(in) :: i, j
      through_east = 0.5_dp*(flow%eps(i, j, dir_x) + flow%eps(i + 1, j, dir_x))*(p(i, j) - p(i + 1, j))/self%grid%hx
   end function through_east

   !> Total Poiseuille flow from row j to the adjacent row `to`, in columns 3 to nx-1
   pure real(dp) function across(self, p, flow, j, to)
      class(poiseuille_t), intent(in) :: self
      real(dp), contiguous, intent(in) :: p(:, :)
      class(flow_t), intent(in) :: flow
      integer, intent(in) :: j, to
      integer :: n

      n = self%grid%nx - 1
      associate (eps => flow%eps(:, :, flow%dir_y))
         across = sum(0.5_dp*(eps(3:n, j) + eps(3:n, to))*(p(3:n, j) - p(3:n, to)))*self%grid%hx/self%grid%hy
      end associate
   end function across

   !> Outflow of a node per unit of its pressure, for equal conductances around it; to be multiplied by eps along X
   pure real(dp) function flow_rate(self)
      class(poiseuille_t), intent(in) :: self
      flow_rate = 2.0_dp/self%grid%hx**2
      if (.not. self%grid%is_row()) flow_rate = flow_rate + 2.0_dp/self%grid%hy**2
   end function flow_rate
end module ehl_poiseuille

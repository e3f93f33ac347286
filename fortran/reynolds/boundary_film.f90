! SPDX-License-Identifier: BSD-3-Clause
!> Contact at a boundary film: a layer of lubricant on the surfaces that pressure does not squeeze out. With N(P) the
!> left-hand side of the Reynolds equation (reynolds.f90) and H_b the film of the layer at P = 0,
!>
!>    P >= 0,   N <= 0,   rho H >= H_b,   one of the three an equality at every node:
!>
!> cavitated (P = 0), flowing (N = 0) or touching (rho H = H_b). What N lacks at touching nodes is lubricant that the layer
!> gives. The layer is an amount of lubricant: it yields to pressure as the lubricant does, and passes a zone of touching nodes
!> without gaining or losing any. With H >= H_b instead it would be squeezed out of the first half of a contact and lift the
!> second half by rho(P_max).
!>
!> A touching node has the equation
!>
!>    rate (H_b - rho H) = 0
!>
!> with the rate of the wedge term, so that its residual is one of the Reynolds equation where the conductance is nothing. Of
!> two residuals, rhs - N and rate (rho H - H_b), that one holds which asks for more pressure, each with what answers it: the
!> deflection alone, or the deflection and the Poiseuille term.
!>
!> Solids with a hardness carry no more than the limit P_Y. A node yields where P = P_Y and it asks for more pressure: the elastic
!> film H is below the layer, or below what the lubricant needs. The solids give way by what is missing, D >= 0, so that
!> rho (H + D) is that of the layer, or more where N = 0 then. Such a node keeps its pressure until D would be negative.
module ehl_boundary_film
   use, intrinsic :: iso_fortran_env, only: int64
   use ehl_grid, only: grid_t
   use ehl_kinds, only: dp
   use ehl_node_state, only: cavity_pressure
   use ehl_status, only: ehl_no_memory, status_t
   implicit none (type, external)
   private
   public :: boundary_film_t

   !> A touching node lifts off where it would by more than a share of the layer: behind a zone of touching nodes the lubricant
   !> has the film of the layer, too, and rounding would decide on their states. What flows on to such a node and not on from it
   !> is lost, so the share is small. Of a steady problem that has not converged the residuals would decide; it is larger there.
   real(dp), parameter :: least_hold = 1.0e-4_dp, greatest_hold = 1.0e-2_dp
   !> The same over the residual (rms) of a steady problem
   real(dp), parameter :: hold_of_residual = 3.0_dp

   !> Arrays of shape (nx, ny)
   type :: boundary_film_t
      !> H_b [a^2/R]
      real(dp) :: thickness = 0.0_dp
      !> Greatest pressure [p_h]; 0: there is no limit
      real(dp) :: limit = 0.0_dp
      !> Factor of the equation of touching nodes
      real(dp) :: rate = 0.0_dp
      !> Share of the layer that a touching node may be lifted by, by the present residual
      real(dp) :: hold = least_hold
      !> Whether the states of the nodes stay, on a coarse level
      logical :: frozen = .false.
      !> 1 where a node is touching, else 0
      real(dp), allocatable :: touching(:, :)
      !> rho (H + D) where a node yields, else 0; of size 0 where there is no limit
      real(dp), allocatable :: kept(:, :)
      !> Film that the lubricant flows through: that of an iterate may be below the layer
      real(dp), allocatable :: film(:, :)
   contains
      procedure :: setup
      procedure :: find_film
      procedure :: find_row
      procedure :: find_yielding
      procedure :: bound
      procedure :: forget
      procedure :: take_row
      procedure :: residual_row
      procedure :: hold_by
      procedure :: greatest_flowing
      procedure :: last_asking
      procedure :: bytes
   end type boundary_film_t

contains

   !> Allocate; thickness: H_b, limit: greatest pressure, or 0
   subroutine setup(self, grid, thickness, limit, status)
      class(boundary_film_t), intent(inout) :: self
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: thickness, limit
      type(status_t), intent(inout) :: status
      integer :: stat, yielding

      self%thickness = thickness
      self%limit = limit
      yielding = merge(1, 0, limit > 0.0_dp)
      self%frozen = .false.
      allocate (self%touching(grid%nx, grid%ny), self%film(grid%nx, grid%ny), &
                self%kept(yielding*grid%nx, yielding*grid%ny), source=0.0_dp, stat=stat)
      if (stat /= 0) call status%fail(ehl_no_memory, "no memory for the boundary film of a grid level")
   end subroutine setup

   !> Row j of the film that the lubricant flows through, by film and density
   pure subroutine find_film(self, h, rho, j)
      class(boundary_film_t), intent(inout) :: self
      !> Shape (nx)
      real(dp), contiguous, intent(in) :: h(:), rho(:)
      integer, intent(in) :: j
      integer :: i

      do i = 1, size(h)
         ! a NaN stays one
         self%film(i, j) = merge(self%thickness/rho(i), h(i), h(i)*rho(i) < self%thickness)
      end do
      ! by the last update
      if (self%limit > 0.0_dp) self%film(:, j) = merge(self%kept(:, j)/rho, self%film(:, j), self%kept(:, j) > 0.0_dp)
   end subroutine find_film

   !> States of the nodes of row j, by the residual of the Reynolds equation; the border does not touch
   pure subroutine find_row(self, mass_content, residual, share, j)
      class(boundary_film_t), intent(inout) :: self
      !> rho H, rhs - N, and the share that the deflection has in what answers the latter; shape (nx)
      real(dp), contiguous, intent(in) :: mass_content(:), residual(:), share(:)
      integer, intent(in) :: j
      real(dp) :: held
      integer :: i

      held = self%hold*self%rate*self%thickness
      self%touching(1, j) = 0.0_dp
      self%touching(size(residual), j) = 0.0_dp
      do i = 2, size(residual) - 1
         self%touching(i, j) = merge(1.0_dp, 0.0_dp, self%rate*(mass_content(i) - self%thickness) &
                                                     < share(i)*residual(i) + held*self%touching(i, j))
      end do
      ! not coupled to its line
      if (self%limit > 0.0_dp) self%touching(:, j) = merge(1.0_dp, self%touching(:, j), self%kept(:, j) > 0.0_dp)
   end subroutine find_row

   !> Nodes of row j that yield, with their mass content: that at which N = 0, but no less than that of the layer
   pure subroutine find_yielding(self, p, weights, j, residual, mass_content)
      class(boundary_film_t), intent(inout) :: self
      !> Pressure, and the wedge term's factors of rho H at a node and at those upstream of it, shape (nx), (0:..., nx)
      real(dp), contiguous, intent(in) :: p(:), weights(0:, :)
      integer, intent(in) :: j
      !> rhs - N, and rho H, of the elastic bodies; shape (nx)
      real(dp), contiguous, intent(inout) :: residual(:), mass_content(:)
      real(dp) :: added(size(p))
      integer :: i, k

      added = 0.0_dp
      do i = 2, size(p) - 1
         do k = 1, min(ubound(weights, 1), i - 1)
            residual(i) = residual(i) + weights(k, i)*added(i - k)
         end do
         self%kept(i, j) = max(self%thickness, mass_content(i) - residual(i)/weights(0, i))
         if (p(i) >= self%limit .and. self%kept(i, j) > mass_content(i)) then
            added(i) = self%kept(i, j) - mass_content(i)
            residual(i) = residual(i) + weights(0, i)*added(i)
            mass_content(i) = self%kept(i, j)
         else
            self%kept(i, j) = 0.0_dp
         end if
      end do
   end subroutine find_yielding

   !> Pressures to come of row j from column `first` on: within the limit, and nodes that yield keep theirs. The pressure of a
   !> coarse node is a mean, which the limit is not for.
   pure subroutine bound(self, before, first, j, after)
      class(boundary_film_t), intent(in) :: self
      real(dp), intent(in) :: before(:)
      integer, intent(in) :: first, j
      real(dp), contiguous, intent(inout) :: after(:)
      integer :: i

      if (self%frozen) return
      do i = 1, size(after)
         after(i) = merge(before(i), after(i), self%kept(first + i - 1, j) > 0.0_dp)
         ! a NaN stays one
         after(i) = merge(self%limit, after(i), after(i) > self%limit)
      end do
   end subroutine bound

   !> No node touches
   pure subroutine forget(self)
      class(boundary_film_t), intent(inout) :: self

      self%touching = 0.0_dp
      self%kept = 0.0_dp
   end subroutine forget

   !> Put the term of touching nodes into row j of the operator
   pure subroutine take_row(self, mass_content, j, values)
      class(boundary_film_t), intent(in) :: self
      !> Shape (nx)
      real(dp), contiguous, intent(in) :: mass_content(:)
      integer, intent(in) :: j
      real(dp), contiguous, intent(inout) :: values(:)
      integer :: i

      do i = 2, size(values) - 1
         values(i) = merge(-self%rate*mass_content(i), values(i), self%touching(i, j) > 0.0_dp)
      end do
   end subroutine take_row

   !> Put the residuals of touching nodes into row j; those that yield have none
   pure subroutine residual_row(self, rhs, mass_content, j, values)
      class(boundary_film_t), intent(in) :: self
      !> Right-hand side, that of touching nodes too where states are frozen; shape (nx)
      real(dp), contiguous, intent(in) :: rhs(:), mass_content(:)
      integer, intent(in) :: j
      real(dp), contiguous, intent(inout) :: values(:)
      real(dp) :: right
      integer :: i

      do i = 2, size(values) - 1
         right = merge(rhs(i), -self%rate*self%thickness, self%frozen)
         values(i) = merge(right + self%rate*mass_content(i), values(i), self%touching(i, j) > 0.0_dp)
      end do
      if (self%limit > 0.0_dp) values = merge(0.0_dp, values, self%kept(:, j) > 0.0_dp)
   end subroutine residual_row

   !> What a touching node may be lifted by: `residual` is that of a steady problem (rms), or 0
   pure subroutine hold_by(self, residual)
      class(boundary_film_t), intent(inout) :: self
      real(dp), intent(in) :: residual

      if (self%frozen) return
      self%hold = min(greatest_hold, max(least_hold, hold_of_residual*residual/(self%rate*self%thickness)))
   end subroutine hold_by

   !> Of each node of row j and its four neighbours, in columns 2 to nx-1: the largest conductance of those that flow
   pure subroutine greatest_flowing(self, p, eps, j, south, values)
      class(boundary_film_t), intent(in) :: self
      !> Pressure and conductance across, shape (nx, ny)
      real(dp), contiguous, intent(in) :: p(:, :), eps(:, :)
      integer, intent(in) :: j, south
      !> Shape (nx)
      real(dp), contiguous, intent(inout) :: values(:)
      integer :: i

      do i = 2, size(values) - 1
         values(i) = max(of(i, j), of(i - 1, j), of(i + 1, j), of(i, j + 1), of(i, south))
      end do

   contains

      !> Conductance of a node if it flows, else 0
      pure real(dp) function of(k, l)
         integer, intent(in) :: k, l
         of = merge(eps(k, l)*(1.0_dp - self%touching(k, l)), 0.0_dp, p(k, l) > cavity_pressure)
      end function of
   end subroutine greatest_flowing

   !> Last touching node of row j whose film is below the layer; 2 if there is none
   pure integer function last_asking(self, mass_content, j) result(i)
      class(boundary_film_t), intent(in) :: self
      !> Shape (nx)
      real(dp), contiguous, intent(in) :: mass_content(:)
      integer, intent(in) :: j

      do i = size(mass_content) - 1, 3, -1
         if (self%touching(i, j) > 0.0_dp .and. mass_content(i) < self%thickness) return
      end do
      i = 2
   end function last_asking

   !> Allocated bytes
   pure integer(int64) function bytes(self)
      class(boundary_film_t), intent(in) :: self
      bytes = 0
      if (allocated(self%film)) bytes = 16*size(self%film, kind=int64) + 8*size(self%kept, kind=int64)
   end function bytes
end module ehl_boundary_film

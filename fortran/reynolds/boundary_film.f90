! SPDX-License-Identifier: BSD-3-Clause
!> Contact at a boundary film: lubricant on the surfaces that pressure does not squeeze out. With N(P) the
!> left-hand side of the Reynolds equation (reynolds.f90) and H_b the boundary film at P = 0,
!>
!>    P >= 0,   N <= 0,   rho H >= H_b,   one of the three an equality at every node:
!>
!> cavitated (P = 0), flowing (N = 0) or touching (rho H = H_b). What N lacks at touching nodes is lubricant that the boundary film
!> gives. It is an amount of lubricant: it yields to pressure as the lubricant does, and passes a zone of touching nodes
!> without gaining or losing any. With H >= H_b instead it would be squeezed out of the first half of a contact and lift the
!> second half by rho(P_max).
!>
!> A touching node has the equation
!>
!>    rate (H_b - rho H) = 0
!>
!> with the rate of the wedge term, so that its residual is one of the Reynolds equation where the conductance is nothing. Of
!> two residuals, rhs - N and rate (rho H - H_b), that one holds which requires more pressure, each with what answers it: the
!> deflection alone, or the deflection and the Poiseuille term.
!>
!> Solids with a hardness sustain no more than the maximum pressure P_Y. A node yields where P = P_Y and it requires more: the
!> elastic film H is below the boundary film or what the lubricant needs. The solids yield by what is missing, D >= 0, so that
!> rho (H + D) is that of the boundary film, or more where N = 0 then. Such a node keeps its pressure until D would be negative.
!>
!> Every level has one. Without setup, or with H_b = 0, it is inactive: no node touches, and its procedures change nothing.
module ehl_boundary_film
   use, intrinsic :: iso_fortran_env, only: int64
   use ehl_grid, only: grid_t
   use ehl_kinds, only: dp
   use ehl_status, only: ehl_no_memory, status_t
   implicit none (type, external)
   private
   public :: boundary_film_t

   !> A touching node lifts off by more than a share of the boundary film: behind a zone of touching nodes the lubricant
   !> has the boundary film, too, and rounding would decide on their states. What flows on to such a node and not on from it
   !> is lost, so the share is small. Of a steady problem that has not converged the residuals would decide; it is larger there.
   real(dp), parameter :: min_lift = 1.0e-4_dp, max_lift = 1.0e-2_dp
   !> The same over the residual (rms) of a steady problem
   real(dp), parameter :: lift_of_residual = 3.0_dp

   !> Arrays of shape (nx, ny)
   type :: boundary_film_t
      !> Whether bodies may touch; whether nodes may yield
      logical :: active = .false.
      logical :: yields = .false.
      !> H_b [a^2/R]
      real(dp) :: thickness = 0.0_dp
      !> Maximum pressure [p_h] of nodes, if they may yield
      real(dp) :: max_pressure = 0.0_dp
      !> Factor of the equation of touching nodes
      real(dp) :: rate = 0.0_dp
      !> Share of the boundary film that a touching node may be lifted by, by the present residual
      real(dp), private :: lift = min_lift
      !> Whether the states of the nodes stay, on a coarse level
      logical :: frozen = .false.
      !> 1 where a node is touching, else 0
      real(dp), allocatable :: touching(:, :)
      !> rho (H + D) where a node yields, else 0; of size 0 where none may
      real(dp), allocatable :: yield_mass(:, :)
      !> Film that the lubricant flows through: that of an iterate may be below the boundary film
      real(dp), allocatable :: film(:, :)
      !> Residuals of touching nodes, else 0, from which those of the coarse level are made
      real(dp), allocatable :: touching_residual(:, :)
   contains
      procedure :: setup
      procedure :: find_film
      procedure :: film_row
      procedure :: film_at
      procedure :: follows_state
      procedure :: find_row
      procedure :: find_yielding
      procedure :: limit_pressure
      procedure :: add_depth
      procedure :: yielding
      procedure :: forget
      procedure :: touches
      procedure :: operator_row
      procedure :: residual_row
      procedure :: without_touching
      procedure :: set_lift
      procedure :: holds
      procedure :: bytes
   end type boundary_film_t

contains

   !> Allocate, if there is a boundary film; thickness: H_b, max_pressure: that of the solids, or 0
   subroutine setup(self, grid, thickness, max_pressure, status)
      class(boundary_film_t), intent(inout) :: self
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: thickness, max_pressure
      type(status_t), intent(inout) :: status
      integer :: stat, yielding

      self%active = thickness > 0.0_dp
      if (status%failed() .or. .not. self%active) return
      self%thickness = thickness
      self%max_pressure = max_pressure
      self%yields = max_pressure > 0.0_dp
      yielding = merge(1, 0, self%yields)
      allocate (self%touching(grid%nx, grid%ny), self%film(grid%nx, grid%ny), self%touching_residual(grid%nx, grid%ny), &
                self%yield_mass(yielding*grid%nx, yielding*grid%ny), source=0.0_dp, stat=stat)
      if (stat /= 0) call status%fail(ehl_no_memory, "no memory for the boundary film of a grid level")
   end subroutine setup

   !> Row j of the film that the lubricant flows through, by film and density
   pure subroutine find_film(self, h, rho, j)
      class(boundary_film_t), intent(inout) :: self
      !> Shape (nx)
      real(dp), contiguous, intent(in) :: h(:), rho(:)
      integer, intent(in) :: j
      integer :: i

      if (.not. self%active) return
      do i = 1, size(h)
         ! a NaN stays one
         self%film(i, j) = merge(self%thickness/rho(i), h(i), h(i)*rho(i) < self%thickness)
      end do
      ! by the last update
      if (self%yields) self%film(:, j) = merge(self%yield_mass(:, j)/rho, self%film(:, j), self%yield_mass(:, j) > 0.0_dp)
   end subroutine find_film

   !> Row j of the film that the lubricant flows through
   pure function film_row(self, h, j) result(film)
      class(boundary_film_t), intent(in) :: self
      !> Shape (nx)
      real(dp), contiguous, intent(in) :: h(:)
      integer, intent(in) :: j
      real(dp) :: film(size(h))

      film = h
      if (self%active) film = self%film(:, j)
   end function film_row

   !> Node (i, j) of it
   pure real(dp) function film_at(self, h, i, j)
      class(boundary_film_t), intent(in) :: self
      !> Shape (nx, ny)
      real(dp), contiguous, intent(in) :: h(:, :)
      integer, intent(in) :: i, j

      film_at = h(i, j)
      if (self%active) film_at = self%film(i, j)
   end function film_at

   !> Whether the states of nodes follow from pressure and film
   pure logical function follows_state(self)
      class(boundary_film_t), intent(in) :: self
      follows_state = self%active .and. .not. self%frozen
   end function follows_state

   !> States of the nodes of row j, by the residual of the Reynolds equation; the border does not touch
   pure subroutine find_row(self, mass_content, residual, share, j)
      class(boundary_film_t), intent(inout) :: self
      !> rho H, rhs - N, and the share that the deflection has in what answers the latter; shape (nx)
      real(dp), contiguous, intent(in) :: mass_content(:), residual(:), share(:)
      integer, intent(in) :: j
      real(dp) :: held
      integer :: i

      held = self%lift*self%rate*self%thickness
      self%touching(1, j) = 0.0_dp
      self%touching(size(residual), j) = 0.0_dp
      do i = 2, size(residual) - 1
         self%touching(i, j) = merge(1.0_dp, 0.0_dp, self%rate*(mass_content(i) - self%thickness) &
                                                     < share(i)*residual(i) + held*self%touching(i, j))
      end do
      ! not coupled to its line
      if (self%yields) self%touching(:, j) = merge(1.0_dp, self%touching(:, j), self%yield_mass(:, j) > 0.0_dp)
   end subroutine find_row

   !> Nodes of row j that yield, with their mass content: that at which N = 0, but no less than that of the boundary film
   pure subroutine find_yielding(self, p, weights, j, residual, mass_content)
      class(boundary_film_t), intent(inout) :: self
      !> Pressure, and the wedge term's factors of rho H at a node and at those upstream of it, shape (nx), (0:..., nx)
      real(dp), contiguous, intent(in) :: p(:), weights(0:, :)
      integer, intent(in) :: j
      !> rhs - N, and rho H, of the elastic bodies; shape (nx)
      real(dp), contiguous, intent(inout) :: residual(:), mass_content(:)
      real(dp) :: added(size(p))
      integer :: i, k

      if (.not. self%yields) return
      added = 0.0_dp
      do i = 2, size(p) - 1
         do k = 1, min(ubound(weights, 1), i - 1)
            residual(i) = residual(i) + weights(k, i)*added(i - k)
         end do
         self%yield_mass(i, j) = max(self%thickness, mass_content(i) - residual(i)/weights(0, i))
         if (p(i) >= self%max_pressure .and. self%yield_mass(i, j) > mass_content(i)) then
            added(i) = self%yield_mass(i, j) - mass_content(i)
            residual(i) = residual(i) + weights(0, i)*added(i)
            mass_content(i) = self%yield_mass(i, j)
         else
            self%yield_mass(i, j) = 0.0_dp
         end if
      end do
   end subroutine find_yielding

   !> Pressures to come of row j from column `first` on: not above the maximum, and nodes that yield keep
   !> theirs. The pressure of a coarse node is a mean, which the maximum is not for.
   pure subroutine limit_pressure(self, before, first, j, after)
      class(boundary_film_t), intent(in) :: self
      real(dp), intent(in) :: before(:)
      integer, intent(in) :: first, j
      real(dp), contiguous, intent(inout) :: after(:)
      integer :: i

      if (self%frozen .or. .not. self%yields) return
      do i = 1, size(after)
         after(i) = merge(before(i), after(i), self%yield_mass(first + i - 1, j) > 0.0_dp)
         ! a NaN stays one
         after(i) = merge(self%max_pressure, after(i), after(i) > self%max_pressure)
      end do
   end subroutine limit_pressure

   !> Add to row j of the film the depth by which the solids yield
   pure subroutine add_depth(self, rho, j, film)
      class(boundary_film_t), intent(in) :: self
      !> Shape (nx)
      real(dp), contiguous, intent(in) :: rho(:)
      integer, intent(in) :: j
      real(dp), contiguous, intent(inout) :: film(:)
      if (self%yields) film = merge(self%yield_mass(:, j)/rho, film, self%yield_mass(:, j) > 0.0_dp)
   end subroutine add_depth

   !> Which of the n nodes of row j yield
   pure function yielding(self, n, j)
      class(boundary_film_t), intent(in) :: self
      integer, intent(in) :: n, j
      logical :: yielding(n)

      yielding = .false.
      if (self%yields) yielding = self%yield_mass(:, j) > 0.0_dp
   end function yielding

   !> No node touches
   pure subroutine forget(self)
      class(boundary_film_t), intent(inout) :: self

      if (.not. self%active) return
      self%touching = 0.0_dp
      self%yield_mass = 0.0_dp
   end subroutine forget

   !> Whether node (i, j) touches; without a node: whether any does
   pure logical function touches(self, i, j)
      class(boundary_film_t), intent(in) :: self
      integer, intent(in), optional :: i, j

      touches = self%active
      if (.not. touches) return
      if (present(i)) then
         touches = self%touching(i, j) > 0.0_dp
      else
         touches = any(self%touching > 0.0_dp)
      end if
   end function touches

   !> Put the term of touching nodes into row j of the operator
   pure subroutine operator_row(self, mass_content, j, values)
      class(boundary_film_t), intent(in) :: self
      !> Shape (nx)
      real(dp), contiguous, intent(in) :: mass_content(:)
      integer, intent(in) :: j
      real(dp), contiguous, intent(inout) :: values(:)
      integer :: i

      if (.not. self%active) return
      do i = 2, size(values) - 1
         values(i) = merge(-self%rate*mass_content(i), values(i), self%touching(i, j) > 0.0_dp)
      end do
   end subroutine operator_row

   !> Put the residuals of touching nodes into row j; those that yield have none
   pure subroutine residual_row(self, rhs, mass_content, j, values)
      class(boundary_film_t), intent(in) :: self
      !> Right-hand side, that of touching nodes too where states are frozen; shape (nx)
      real(dp), contiguous, intent(in) :: rhs(:), mass_content(:)
      integer, intent(in) :: j
      real(dp), contiguous, intent(inout) :: values(:)
      real(dp) :: right
      integer :: i

      if (.not. self%active) return
      do i = 2, size(values) - 1
         right = merge(rhs(i), -self%rate*self%thickness, self%frozen)
         values(i) = merge(right + self%rate*mass_content(i), values(i), self%touching(i, j) > 0.0_dp)
      end do
      if (self%yields) values = merge(0.0_dp, values, self%yield_mass(:, j) > 0.0_dp)
   end subroutine residual_row

   !> Set values of row j, from column `first` on, to 0 where a node touches: its equation has no conductance
   pure subroutine without_touching(self, first, j, values)
      class(boundary_film_t), intent(in) :: self
      integer, intent(in) :: first, j
      real(dp), contiguous, intent(inout) :: values(:)
      if (self%active) values = values*(1.0_dp - self%touching(first:first + size(values) - 1, j))
   end subroutine without_touching

   !> What a touching node may be lifted by: `residual` is that of a steady problem (rms), or 0
   pure subroutine set_lift(self, residual)
      class(boundary_film_t), intent(inout) :: self
      real(dp), intent(in) :: residual

      if (.not. self%follows_state()) return
      self%lift = min(max_lift, max(min_lift, lift_of_residual*residual/(self%rate*self%thickness)))
   end subroutine set_lift

   !> Whether no film of a solution is thinner than the boundary film by more than a share of it
   pure logical function holds(self, mass_content, tolerance)
      class(boundary_film_t), intent(in) :: self
      !> Shape (nx, ny)
      real(dp), contiguous, intent(in) :: mass_content(:, :)
      real(dp), intent(in) :: tolerance

      holds = .true.
      if (self%active) holds = minval(mass_content) >= (1.0_dp - tolerance)*self%thickness
   end function holds

   !> Allocated bytes
   pure integer(int64) function bytes(self)
      class(boundary_film_t), intent(in) :: self
      bytes = 0
      if (self%active) bytes = 8*(3*size(self%film, kind=int64) + size(self%yield_mass, kind=int64))
   end function bytes
end module ehl_boundary_film

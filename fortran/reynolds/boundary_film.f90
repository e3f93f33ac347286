! SPDX-License-Identifier: BSD-3-Clause
!> Solid contact at a boundary film: lubricant on the surfaces that pressure does not squeeze out. With N(P) the
!> left-hand side of the Reynolds equation (reynolds.f90) and H_b the boundary film at P = 0,
!>
!>    P >= 0,   N <= 0,   rho H >= H_b,   one of the three an equality at every node:
!>
!> cavitated (P = 0), flowing (N = 0) or touching (rho H = H_b). At touching nodes the boundary film
!> supplies the mass defect of N. H_b is a mass per area: the boundary film is as compressible as the lubricant, and its mass
!> does not change along a zone of touching nodes. With H >= H_b instead, mass would leave the first half of a contact and lift
!> the second half by a factor of rho(P_max).
!>
!> A touching node has the equation
!>
!>    rate (H_b - rho H) = 0
!>
!> with the factor of the wedge term, so that its residual is that of a Reynolds equation with zero conductance. Of
!> the two residuals rhs - N and rate (rho H - H_b) the one that requires more pressure applies: the first changes with the
!> deflection and the Poiseuille term, the second with the deflection alone.
!>
!> Every level has a boundary film, with the solids that may yield (yielding.f90). Without setup, or with H_b = 0, it is
!> inactive: no node touches. Procedures for sweeps and coarse problems: multigrid/touching_nodes.f90.
module ehl_boundary_film
   use, intrinsic :: iso_fortran_env, only: int64
   use ehl_grid, only: grid_t
   use ehl_kinds, only: dp
   use ehl_status, only: ehl_no_memory, status_t
   use ehl_yielding, only: yielding_t
   implicit none (type, external)
   private
   public :: boundary_film_t, same_film

   !> A touching node becomes a flowing one if its film exceeds H_b by more than this fraction: downstream of touching nodes the
   !> lubricant has the film H_b, too, and rounding would decide on their states. Mass that such a node receives and does not pass
   !> on is lost, so the fraction is small; it is larger in a steady problem whose residuals have not converged.
   real(dp), parameter :: min_lift = 1.0e-4_dp, max_lift = 1.0e-2_dp
   !> That fraction over the residual (rms) of a steady problem
   real(dp), parameter :: lift_of_residual = 3.0_dp

   !> Solid contact also where the film differs from the boundary film by less than this fraction: downstream of a touching node
   !> the lubricant may flow with the film H_b
   real(dp), parameter :: same_film = 1.0e-2_dp

   !> Arrays of shape (nx, ny)
   type :: boundary_film_t
      !> Whether bodies may touch
      logical :: active = .false.
      !> H_b [a^2/R]
      real(dp), private :: thickness = 0.0_dp
      type(yielding_t) :: yielding
      !> Factor of the equation of touching nodes
      real(dp) :: rate = 0.0_dp
      !> Fraction of H_b by which a touching node may be lifted, at the present residual
      real(dp), private :: lift = min_lift
      !> Whether the states of the nodes are fixed, on a coarse level
      logical, private :: frozen = .false.
      !> 1 where a node is touching, else 0
      real(dp), allocatable, private :: touching(:, :)
      !> Film for the conductance, at least the boundary film; the film H of an iterate may be thinner
      real(dp), allocatable, private :: film(:, :)
      !> Residuals of touching nodes, else 0, for restriction to the coarse level
      real(dp), allocatable, private :: touching_residual(:, :)
   contains
      procedure :: setup
      procedure :: find_film
      procedure :: film_row
      procedure :: film_at
      procedure :: follows_state
      procedure :: find_row
      procedure :: forget
      procedure :: touches
      procedure :: states
      procedure :: supports
      procedure :: stress_row
      procedure :: has_film
      procedure :: cycle_limit
      procedure :: load_diverges
      procedure :: operator_row
      procedure :: residual_row
      procedure :: zero_touching
      procedure :: set_lift
      procedure :: holds
      procedure :: bytes
      procedure :: max_flowing_conductance
      procedure :: max_conductance_of_rows
      procedure :: mark_dipoles
      procedure :: last_touching
      procedure :: line_residuals
      procedure :: begin_coarse
      procedure :: end_coarse
      procedure :: separate_residual
      procedure :: restrict_residual
   end type boundary_film_t

   ! in multigrid/touching_nodes.f90
   interface
      !> Maximum conductance of the flowing nodes among each node of row j and its four neighbours, in columns 2 to nx-1
      pure module subroutine max_flowing_conductance(self, p, eps, j, south, north, values)
         class(boundary_film_t), intent(in) :: self
         !> Pressure and conductance along Y, shape (nx, ny)
         real(dp), contiguous, intent(in) :: p(:, :), eps(:, :)
         integer, intent(in) :: j, south, north
         !> Shape (nx)
         real(dp), contiguous, intent(inout) :: values(:)
      end subroutine max_flowing_conductance

      !> Maximum conductance of each column in the rows south, j and north, with zero conductance at touching nodes
      pure module subroutine max_conductance_of_rows(self, eps, j, south, north, values)
         class(boundary_film_t), intent(in) :: self
         !> Shape (nx, ny)
         real(dp), contiguous, intent(in) :: eps(:, :)
         integer, intent(in) :: j, south, north
         !> Shape (nx)
         real(dp), contiguous, intent(inout) :: values(:)
      end subroutine max_conductance_of_rows

      !> Mark touching nodes of row j for distributive changes, also beside cavitated nodes
      pure module subroutine mark_dipoles(self, p, j, dipole)
         class(boundary_film_t), intent(in) :: self
         !> Pressure; 1 where a node changes distributively, else 0; shape (nx)
         real(dp), contiguous, intent(in) :: p(:)
         integer, intent(in) :: j
         real(dp), contiguous, intent(inout) :: dipole(:)
      end subroutine mark_dipoles

      !> Last touching node of row j whose film is below the boundary film; 2 if there is none
      pure module function last_touching(self, mass_content, j) result(i)
         class(boundary_film_t), intent(in) :: self
         !> Shape (nx)
         real(dp), contiguous, intent(in) :: mass_content(:)
         integer, intent(in) :: j
         integer :: i
      end function last_touching

      !> For line systems of several rows: which nodes touch, and their residuals, from node 2 to `last`
      pure module subroutine line_residuals(self, rows, last, rhs, mass_content, residual, touching, any_touches)
         class(boundary_film_t), intent(in) :: self
         integer, intent(in) :: rows(:), last
         !> Shape (nx, ny)
         real(dp), contiguous, intent(in) :: rhs(:, :), mass_content(:, :)
         !> Shape (lines, last) and (lines, nx); `touching` is not set without a boundary film
         real(dp), intent(inout) :: residual(:, :), touching(:, :)
         logical, intent(out) :: any_touches
      end subroutine line_residuals

      !> Fix the states of the nodes of a coarse level: a node with pressure touches if the full weighting of touching fine nodes
      !> exceeds one half. No coarse node yields: yielding nodes could not sustain a missing load.
      module subroutine begin_coarse(self, fine, coarse, step, p)
         class(boundary_film_t), intent(inout) :: self
         !> Boundary film of the fine level; coarse grid, and its mesh sizes over those of the fine one
         type(boundary_film_t), intent(in) :: fine
         type(grid_t), intent(in) :: coarse
         integer, intent(in) :: step(2)
         !> Restricted pressure, shape (nx, ny)
         real(dp), contiguous, intent(in) :: p(:, :)
      end subroutine begin_coarse

      !> End the coarse problem: the level may be the finest level of another cycle
      pure module subroutine end_coarse(self)
         class(boundary_film_t), intent(inout) :: self
      end subroutine end_coarse

      !> Separate the residuals of touching nodes from those of flowing nodes: they are restricted to touching coarse nodes alone.
      !> In the equation of a flowing node they would be a source that the motion convects through the contact.
      pure module subroutine separate_residual(self, residual)
         class(boundary_film_t), intent(inout) :: self
         !> Shape (nx, ny)
         real(dp), contiguous, intent(inout) :: residual(:, :)
      end subroutine separate_residual

      !> Put the restricted residuals of touching nodes into row j of a coarse grid
      pure module subroutine restrict_residual(self, fine, coarse, step, j, residual)
         class(boundary_film_t), intent(in) :: self
         !> See begin_coarse
         type(boundary_film_t), intent(in) :: fine
         type(grid_t), intent(in) :: coarse
         integer, intent(in) :: step(2), j
         !> Shape (nx)
         real(dp), contiguous, intent(inout) :: residual(:)
      end subroutine restrict_residual

      !> Cycle limit of a stationary roughness: larger with a boundary film, since lubricant trapped between touching nodes moves
      !> slowly
      pure module integer function cycle_limit(self, usual, nodes)
         class(boundary_film_t), intent(in) :: self
         !> Limit without a boundary film; nodes along X
         integer, intent(in) :: usual, nodes
      end function cycle_limit

      !> Whether the load error of a stationary roughness is too large for further cycles to converge; never without a boundary film
      pure module logical function load_diverges(self, cycles, load_error)
         class(boundary_film_t), intent(in) :: self
         !> Cycles made
         integer, intent(in) :: cycles
         !> Relative error of the load
         real(dp), intent(in) :: load_error
      end function load_diverges
   end interface

contains

   !> Allocate if there is a boundary film; thickness: H_b; max_pressure: that of the solids, or 0
   subroutine setup(self, grid, thickness, max_pressure, status)
      class(boundary_film_t), intent(inout) :: self
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: thickness, max_pressure
      type(status_t), intent(inout) :: status
      integer :: stat

      self%active = thickness > 0.0_dp
      if (status%failed() .or. .not. self%active) return
      self%thickness = thickness
      allocate (self%touching(grid%nx, grid%ny), self%film(grid%nx, grid%ny), self%touching_residual(grid%nx, grid%ny), &
                source=0.0_dp, stat=stat)
      if (stat /= 0) call status%fail(ehl_no_memory, "no memory for the boundary film of a grid level")
      call self%yielding%setup(grid, max_pressure, status)
   end subroutine setup

   !> Compute row j of the film for the conductance
   pure subroutine find_film(self, h, rho, j)
      class(boundary_film_t), intent(inout) :: self
      !> Shape (nx)
      real(dp), contiguous, intent(in) :: h(:), rho(:)
      integer, intent(in) :: j
      integer :: i

      if (.not. self%active) return
      do i = 1, size(h)
         ! NaN stays NaN
         self%film(i, j) = merge(self%thickness/rho(i), h(i), h(i)*rho(i) < self%thickness)
      end do
      ! with the depth of the last update
      call self%yielding%add_depth(rho, j, self%film(:, j))
   end subroutine find_film

   !> Row j of the film for the conductance
   pure function film_row(self, h, j) result(film)
      class(boundary_film_t), intent(in) :: self
      !> Shape (nx)
      real(dp), contiguous, intent(in) :: h(:)
      integer, intent(in) :: j
      real(dp) :: film(size(h))

      film = h
      if (self%active) film = self%film(:, j)
   end function film_row

   !> Film for the conductance at node (i, j)
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
   pure subroutine find_row(self, p, weights, elastic, fraction, j, residual, mass_content)
      class(boundary_film_t), intent(inout) :: self
      !> Pressure, and the wedge term's factors of rho H at a node and at those upstream of it, shape (nx), (0:..., nx)
      real(dp), contiguous, intent(in) :: p(:), weights(0:, :)
      !> rho H of the elastic bodies; diagonal term of the deflection over that of deflection and Poiseuille term; shape (nx)
      real(dp), contiguous, intent(in) :: elastic(:), fraction(:)
      integer, intent(in) :: j
      !> rhs - N, and rho H: in of the elastic bodies, out with the depth by which nodes yield; shape (nx)
      real(dp), contiguous, intent(inout) :: residual(:), mass_content(:)
      real(dp) :: held
      integer :: i

      call self%yielding%find_row(self%thickness, p, weights, j, residual, mass_content)
      held = self%lift*self%rate*self%thickness
      self%touching(1, j) = 0.0_dp
      self%touching(size(residual), j) = 0.0_dp
      do i = 2, size(residual) - 1
         self%touching(i, j) = merge(1.0_dp, 0.0_dp, self%rate*(elastic(i) - self%thickness) &
                                                     < fraction(i)*residual(i) + held*self%touching(i, j))
      end do
      ! yielding nodes count as touching: they are not coupled to their line
      call self%yielding%set(j, 1.0_dp, self%touching(:, j))
   end subroutine find_row

   !> Set all nodes to not touching
   pure subroutine forget(self)
      class(boundary_film_t), intent(inout) :: self

      if (.not. self%active) return
      self%touching = 0.0_dp
      call self%yielding%forget()
   end subroutine forget

   !> Whether node (i, j) touches; without a node: whether any node touches
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

   !> Which of the n nodes of row j have the equation of a touching node
   pure function states(self, n, j)
      class(boundary_film_t), intent(in) :: self
      integer, intent(in) :: n, j
      logical :: states(n)

      states = .false.
      if (self%active) states = self%touching(:, j) > 0.0_dp
   end function states

   !> Where the bodies are in solid contact in a solution
   pure function supports(self, p, mass_content)
      class(boundary_film_t), intent(in) :: self
      !> Of a row, shape (nx)
      real(dp), contiguous, intent(in) :: p(:), mass_content(:)
      logical :: supports(size(p))

      supports = .false.
      if (self%active) supports = p > 0.0_dp .and. mass_content <= (1.0_dp + same_film)*self%thickness
   end function supports

   !> Set the shear stress of a row to that of the boundary film where the bodies touch, and the Newtonian stress to 0
   pure subroutine stress_row(self, p, mass_content, friction, newtonian, stress)
      class(boundary_film_t), intent(in) :: self
      !> Of the row, shape (nx)
      real(dp), contiguous, intent(in) :: p(:), mass_content(:)
      !> Boundary friction: stress over pressure
      real(dp), intent(in) :: friction
      !> See stress_row of ehl_flow
      real(dp), contiguous, intent(inout) :: newtonian(:), stress(:)

      if (.not. self%active) return
      where (self%supports(p, mass_content))
         newtonian = 0.0_dp
         stress = friction*p
      end where
   end subroutine stress_row

   !> Whether the film is positive; with a boundary film it always is
   pure logical function has_film(self, positive)
      class(boundary_film_t), intent(in) :: self
      !> Whether the film of the elastic bodies is positive
      logical, intent(in) :: positive
      has_film = self%active .or. positive
   end function has_film

   !> Set row j of the operator to the equation of touching nodes where nodes touch
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

   !> Set the residuals of touching nodes in row j; yielding nodes have none
   pure subroutine residual_row(self, rhs, mass_content, j, values)
      class(boundary_film_t), intent(in) :: self
      !> Right-hand side, which applies to touching nodes too if the states are frozen; shape (nx)
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
      call self%yielding%set(j, 0.0_dp, values)
   end subroutine residual_row

   !> Set values of row j, from column `first` on, to 0 where a node touches: its equation has no conductance
   pure subroutine zero_touching(self, first, j, values)
      class(boundary_film_t), intent(in) :: self
      integer, intent(in) :: first, j
      real(dp), contiguous, intent(inout) :: values(:)
      if (self%active) values = values*(1.0_dp - self%touching(first:first + size(values) - 1, j))
   end subroutine zero_touching

   !> Set the maximum lift of a touching node; residual: that of a steady problem (rms), or 0
   pure subroutine set_lift(self, residual)
      class(boundary_film_t), intent(inout) :: self
      real(dp), intent(in) :: residual

      if (.not. self%follows_state()) return
      self%lift = min(max_lift, max(min_lift, lift_of_residual*residual/(self%rate*self%thickness)))
   end subroutine set_lift

   !> Whether no film of a solution is thinner than the boundary film by more than the relative tolerance
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
      if (self%active) bytes = 8*3*size(self%film, kind=int64) + self%yielding%bytes()
   end function bytes
end module ehl_boundary_film

! SPDX-License-Identifier: BSD-3-Clause
!> Starved inlet: the surfaces supply a layer of oil that is thinner than the gap. Where it does not fill the gap P = 0, and
!> the surfaces transport the oil along X. With the flow C <= G through the east face of a node, where G is that of a filled
!> gap (docs/theory/starvation.md):
!>
!>    P >= 0,   C <= G,   P (G - C) = 0,   C(i)/hx = C(i-1)/hx + (Poiseuille term at i)
!>
!> which is the fill fraction C/G of Elrod and Adams as a complementarity problem. The missing flow (G - C)/hx is the mass
!> defect of the Reynolds operator N at a node with P = 0, so that it follows from the operator along a row:
!>
!>    N(i) <- N(i) - missing(i-1),     missing(i) = -N(i) where P(i) = 0 and N(i) < 0, else 0
!>
!> In a time step the oil at a node also changes. With the mean velocity U, the factor s of the squeeze term and the deficit
!> d(i) of rho H, the mass defect of a node is
!>
!>    rhs(i) - N(i) = s d(i) + missing(i),     rhs: of earlier times,     missing(i) = (U/hx) f(i)
!>
!> where U (G - f) flows through the east face, with the deficit f = (3 d(i) - d(i-1))/2 there, of second order upstream like G.
!> So the condition of a node is d >= 0 in place of C <= G, and the film begins at a face between two nodes, not at a node. The
!> difference is of second order in the mesh size; time steps start from the steady contact in their own discretisation
!> (solve/transient_duty.f90).
!>
!> The scheme conserves oil. Every level has a supply; without setup it is inactive.
module ehl_supply
   use ehl_kinds, only: dp
   implicit none (type, external)
   private
   public :: supply_t

   type :: supply_t
      logical :: active = .false.
      !> Whether the states of the nodes are fixed, on a coarse level
      logical :: frozen = .false.
      !> Mesh size along X, mean velocity over that of the case
      real(dp), private :: hx = 0.0_dp, speed = 1.0_dp
      !> Factor of the squeeze term; 0: steady
      real(dp), private :: squeeze = 0.0_dp
      !> Approximate fraction of the deficit of a node's equation that it passes downstream; 1 in steady motion
      real(dp) :: passed_fraction = 1.0_dp
      !> rho H of the layer, by row
      real(dp), allocatable :: layer(:)
      !> Of a line contact: the fixed last node upstream of the film (solve/meniscus.f90), and the mass defect downstream of it;
      !> 0: the node follows from the pressure
      integer :: held = 0
      real(dp) :: short = 0.0_dp
   contains
      procedure :: setup
      procedure :: set_step
      procedure :: transport_row
   end type supply_t

contains

   !> Set the layer rho H, the same in all rows
   pure subroutine setup(self, hx, rows, layer)
      class(supply_t), intent(inout) :: self
      real(dp), intent(in) :: hx, layer
      integer, intent(in) :: rows

      self%active = layer > 0.0_dp
      if (.not. self%active) return
      self%hx = hx
      self%speed = 1.0_dp
      self%passed_fraction = 1.0_dp
      self%squeeze = 0.0_dp
      self%held = 0
      self%frozen = .false.
      self%layer = spread(layer, 1, rows)
   end subroutine setup

   !> Prepare a time step
   pure subroutine set_step(self, layer, speed, squeeze)
      class(supply_t), intent(inout) :: self
      !> Layer; mean velocity over that of the case, at least 0; factor of the squeeze term
      real(dp), intent(in) :: layer, speed, squeeze

      if (.not. self%active) return
      self%held = 0
      self%layer = layer
      self%speed = speed
      self%squeeze = squeeze
      self%passed_fraction = speed/self%hx/(squeeze/1.5_dp + speed/self%hx)
   end subroutine set_step

   !> Subtract the upstream deficit from row j of the operator, which is that of filled nodes
   pure subroutine transport_row(self, cavitated, mass_content, rhs, j, values, passing, missing, short)
      class(supply_t), intent(in) :: self
      !> Which nodes have P = 0, rho H, and the right-hand side; shape (nx)
      logical, contiguous, intent(in) :: cavitated(:)
      real(dp), contiguous, intent(in) :: mass_content(:), rhs(:)
      integer, intent(in) :: j
      !> Shape (nx), in columns 2 to nx-1
      real(dp), contiguous, intent(inout) :: values(:)
      !> Whether a node passes on all oil that it receives, so that nothing flows back from the next one; shape (nx)
      logical, contiguous, intent(out), optional :: passing(:)
      !> Deficit of the flow through the east face of a node, over hx, and of the mass content of the node; shape (nx)
      real(dp), contiguous, intent(out), optional :: missing(:), short(:)
      real(dp) :: defect, flow, deficit, before, u
      logical :: unfilled, steps
      integer :: i

      if (present(passing)) passing = .false.
      if (present(missing)) missing = 0.0_dp
      if (present(short)) short = 0.0_dp
      if (self%held > 0) then
         values(2:self%held) = 0.0_dp
         values(self%held + 1) = values(self%held + 1) - self%short
         return
      end if
      ! corrects the first-order equation of the first interior column to the flow of the others; 0 where the border is filled
      flow = self%speed*max(0.0_dp, 0.5_dp*(mass_content(1) + mass_content(2)) - self%layer(j))/self%hx
      if (present(passing)) passing(1) = flow > 0.0_dp
      steps = self%squeeze > 0.0_dp .and. .not. self%frozen
      u = self%speed/self%hx
      deficit = merge(max(0.0_dp, mass_content(1) - self%layer(j)), 0.0_dp, flow > 0.0_dp)
      do i = 2, size(values) - 1
         values(i) = values(i) - flow
         if (steps) values(i) = values(i) - 0.5_dp*u*deficit
         ! a coarse level transports the change of the defect alone
         defect = merge(-values(i), rhs(i) - values(i), self%frozen)
         unfilled = cavitated(i) .and. (self%frozen .or. defect > 0.0_dp)
         defect = merge(defect, 0.0_dp, unfilled)
         if (self%frozen) then
            flow = self%passed_fraction*defect
         else if (steps) then
            before = deficit
            deficit = defect/(self%squeeze + 1.5_dp*u)
            flow = u*(1.5_dp*deficit - 0.5_dp*before)
         else
            ! the film begins at a node: the last deficit covers half a cell more
            if (present(short) .and. .not. unfilled .and. i > 2) short(i - 1) = 1.5_dp*short(i - 1)
            deficit = merge((defect/u + 0.5_dp*deficit)/1.5_dp, 0.0_dp, unfilled)
            flow = defect
         end if
         if (present(short)) short(i) = deficit
         if (present(passing)) passing(i) = unfilled
         if (present(missing)) missing(i) = flow
      end do
   end subroutine transport_row
end module ehl_supply

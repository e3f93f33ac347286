! SPDX-License-Identifier: BSD-3-Clause
!> An inlet with little oil: a layer arrives on the surfaces that is thinner than the gap. Where it does not fill the gap P = 0, and
!> the oil is transported along X; what flows there from filled nodes is carried along. With the flow C <= G through the east face
!> of a node, G that of a filled gap (docs/theory/starvation.md):
!>
!>    P >= 0,   C <= G,   P (G - C) = 0,   C(i)/hx = C(i-1)/hx + (Poiseuille term at i)
!>
!> which is Elrod's and Adams' fill fraction C/G as a complementarity. The flow that is missing, (G - C)/hx, is what the Reynolds
!> operator N lacks at a node with P = 0, so that it follows from the operator along a row:
!>
!>    N(i) <- N(i) - missing(i-1),     missing(i) = -N(i) where P(i) = 0 and N(i) < 0, else 0
!>
!> No oil is gained or lost. Every level has one; without setup it is inactive and changes nothing.
module ehl_supply
   use, intrinsic :: iso_fortran_env, only: int64
   use ehl_kinds, only: dp
   implicit none (type, external)
   private
   public :: supply_t

   type :: supply_t
      logical :: active = .false.
      !> Whether the states of the nodes stay, on a coarse level
      logical :: frozen = .false.
      !> Mesh size along X
      real(dp), private :: hx = 0.0_dp
      !> rho H that arrives, by row
      real(dp), allocatable :: layer(:)
      !> Of a line: last node upstream of the film where it is fixed (solve/meniscus.f90), and the mass defect downstream of it;
      !> 0: the node follows from the pressure
      integer :: held = 0
      real(dp) :: short = 0.0_dp
   contains
      procedure :: setup
      procedure :: transport_row
      procedure :: bytes
   end type supply_t

contains

   !> A layer of rho H, the same in all rows
   pure subroutine setup(self, hx, rows, layer)
      class(supply_t), intent(inout) :: self
      real(dp), intent(in) :: hx, layer
      integer, intent(in) :: rows

      self%active = layer > 0.0_dp
      if (.not. self%active) return
      self%hx = hx
      self%held = 0
      self%frozen = .false.
      self%layer = spread(layer, 1, rows)
   end subroutine setup

   !> Take from row j of the operator of filled nodes what is missing upstream
   pure subroutine transport_row(self, cavitated, mass_content, j, values, passing)
      class(supply_t), intent(in) :: self
      !> Which nodes have P = 0, and rho H; shape (nx)
      logical, contiguous, intent(in) :: cavitated(:)
      real(dp), contiguous, intent(in) :: mass_content(:)
      integer, intent(in) :: j
      !> Shape (nx), in columns 2 to nx-1
      real(dp), contiguous, intent(inout) :: values(:)
      !> Whether a node passes on all that it receives, so that nothing flows back from the next one; shape (nx)
      logical, contiguous, intent(out), optional :: passing(:)
      real(dp) :: missing
      logical :: short
      integer :: i

      if (present(passing)) passing = .false.
      if (self%held > 0) then
         values(2:self%held) = 0.0_dp
         values(self%held + 1) = values(self%held + 1) - self%short
         return
      end if
      ! with it the equation of the first interior column, of first order, has the flow of the others; not where the border is full
      missing = max(0.0_dp, 0.5_dp*(mass_content(1) + mass_content(2)) - self%layer(j))/self%hx
      if (present(passing)) passing(1) = missing > 0.0_dp
      do i = 2, size(values) - 1
         values(i) = values(i) - missing
         short = cavitated(i) .and. (self%frozen .or. values(i) < 0.0_dp)
         missing = merge(-values(i), 0.0_dp, short)
         if (present(passing)) passing(i) = short
      end do
   end subroutine transport_row

   !> Allocated bytes
   pure integer(int64) function bytes(self)
      class(supply_t), intent(in) :: self
      bytes = 0
      if (self%active) bytes = 8*size(self%layer, kind=int64)
   end function bytes
end module ehl_supply

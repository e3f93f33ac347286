! SPDX-License-Identifier: BSD-3-Clause
!> One grid of the hierarchy: its fields and coefficients, and the states of its nodes.
!>
!> The state of a node follows from the pressure: it is cavitated where P <= 0, elsewhere the lubricant fills the gap and flows
!> (solid contact: boundary_film.f90). A cavitated node is inactive, and does not change, unless its residual requires
!> pressure (residual < 0). A NaN is neither: it fails every comparison, and remains a NaN. Procedures take
!> rows, because a call per node would prevent vectorisation of the loops of other modules.
module ehl_level
   use, intrinsic :: iso_fortran_env, only: int64
   use ehl_boundary_film, only: boundary_film_t
   use ehl_deflection, only: deflection_t
   use ehl_flow, only: flow_t
   use ehl_grid, only: grid_t
   use ehl_kinds, only: dp
   use ehl_lubricant, only: lubricant_t
   use ehl_poiseuille, only: poiseuille_t
   use ehl_status, only: ehl_no_memory, status_t
   use ehl_supply, only: supply_t
   use ehl_wedge, only: wedge_t
   implicit none (type, external)
   private
   public :: cavitate, cavity_pressure, change_flowing, flowing_around, gap, gap_row, last_flowing, level_t, stay_cavitated, &
             zero_inactive_residual

   !> Pressure in a cavity, over p_h
   real(dp), parameter :: cavity_pressure = 0.0_dp
   !> Number of nodes that a search tests at a time
   integer, parameter :: stride = 8

   !> ln(eta/eta0) at the Hertz pressure, and lambda_bar (that of M = 640), below which a contact counts as soft
   real(dp), parameter :: isoviscous_below = 8.0_dp, thin_below = 2.0e-3_dp

   !> Fields of one level, arrays of shape (nx, ny). Dimensionless: P by p_h, lengths by a,
   !> films by a^2/R. The equations are in reynolds.f90.
   type :: level_t
      type(grid_t) :: grid
      type(lubricant_t) :: lubricant
      class(deflection_t), allocatable :: engine
      !> Factor k_b of the deflection
      real(dp) :: kernel_factor = 0.0_dp
      !> Conductances, and the terms of the Reynolds equation
      class(flow_t), allocatable :: flow
      type(poiseuille_t) :: poiseuille
      type(wedge_t) :: wedge
      !> Contact at a boundary film; inactive where there is none
      type(boundary_film_t) :: boundary
      !> Oil supply of a starved inlet; inactive where the inlet is flooded
      type(supply_t) :: supply
      !> Rigid separation H00
      real(dp) :: h00 = 0.0_dp
      !> Required value of the pressure sum (reynolds.f90)
      real(dp) :: load = 0.0_dp
      !> Pressure, film, and the right-hand side of the film equation: the film minus H00 and deflection
      real(dp), allocatable :: p(:, :), h(:, :), film_rhs(:, :)
      !> Right-hand side of the Reynolds equation, and the residual
      real(dp), allocatable :: rhs(:, :), residual(:, :)
      !> Density, and H d rho/dP
      real(dp), allocatable :: rho(:, :), h_drho_dp(:, :)
      !> Mass content rho H
      real(dp), allocatable :: mass_content(:, :)
      !> Whether the contact is soft: a thin film, and a small increase of viscosity with pressure
      logical :: soft = .false.
      !> Number of threads, and whether it is more than one
      integer :: threads = 1
      logical :: parallel = .false.
   contains
      procedure :: setup
      procedure :: bytes
   end type level_t

contains

   !> Allocate the fields; grid, lubricant, flow and threads are known
   subroutine setup(self, status)
      class(level_t), intent(inout) :: self
      type(status_t), intent(inout) :: status
      real(dp) :: log_viscosity(1), slope(1)
      integer :: stat

      if (status%failed()) return
      call self%lubricant%log_viscosity([1.0_dp], log_viscosity, slope)
      self%soft = log_viscosity(1) < isoviscous_below .and. self%flow%inverse_speed > 1.0_dp/thin_below
      associate (nx => self%grid%nx, ny => self%grid%ny)
         allocate (self%p(nx, ny), self%h(nx, ny), self%film_rhs(nx, ny), &
                   self%rhs(nx, ny), self%residual(nx, ny), self%rho(nx, ny), self%h_drho_dp(nx, ny), &
                   self%mass_content(nx, ny), source=0.0_dp, stat=stat)
      end associate
      if (stat /= 0) then
         call status%fail(ehl_no_memory, "no memory for a grid level")
         return
      end if
      call self%flow%setup(self%grid, status)
      call self%poiseuille%setup(self%grid)
      call self%wedge%set_steady(self%grid%hx)
      call self%boundary%setup(self%grid, self%lubricant%boundary_film, self%lubricant%boundary_limit, status)
      self%parallel = self%threads > 1
   end subroutine setup

   !> Film with the depth by which the solids yield
   pure function gap(level)
      type(level_t), intent(in) :: level
      real(dp) :: gap(level%grid%nx, level%grid%ny)
      integer :: j

      do j = 1, level%grid%ny
         gap(:, j) = gap_row(level, j)
      end do
   end function gap

   !> Row j of `gap`
   pure function gap_row(level, j)
      type(level_t), intent(in) :: level
      integer, intent(in) :: j
      real(dp) :: gap_row(level%grid%nx)

      gap_row = level%h(:, j)
      call level%boundary%yielding%add_depth(level%rho(:, j), j, gap_row)
   end function gap_row

   !> Allocated bytes without those of the engine
   pure integer(int64) function bytes(self)
      class(level_t), intent(in) :: self

      bytes = self%poiseuille%product%bytes() + self%boundary%bytes()
      if (allocated(self%p)) bytes = bytes + self%flow%bytes() + 8*8*size(self%p, kind=int64)
   end function bytes

   !> Last node of a row that is not cavitated, or the first one
   pure integer function last_flowing(p) result(last)
      real(dp), contiguous, intent(in) :: p(:)

      last = size(p)
      ! several nodes at a time first
      do while (last > stride)
         if (count(p(last - stride + 1:last) <= cavity_pressure) < stride) exit
         last = last - stride
      end do
      do while (last > 1 .and. p(last) <= cavity_pressure)
         last = last - 1
      end do
   end function last_flowing

   !> 1 where the lubricant flows at a node of a row and at its four neighbours, else 0; in columns 2 to nx-1
   pure subroutine flowing_around(south, p, north, values)
      !> Pressure of the row and of those beside it, shape (nx)
      real(dp), contiguous, intent(in) :: south(:), p(:), north(:)
      real(dp), contiguous, intent(inout) :: values(:)
      integer :: i

      do i = 2, size(p) - 1
         values(i) = merge(1.0_dp, 0.0_dp, min(p(i), p(i - 1), p(i + 1), north(i), south(i)) > cavity_pressure)
      end do
   end subroutine flowing_around

   !> Cavitate nodes with a negative pressure
   pure subroutine cavitate(p)
      real(dp), contiguous, intent(inout) :: p(:)
      integer :: i

      do i = 1, size(p)
         ! a NaN remains a NaN; max(0, NaN) could be 0
         p(i) = merge(p(i), cavity_pressure, .not. p(i) <= cavity_pressure)
      end do
   end subroutine cavitate

   !> Keep cavitated nodes cavitated
   pure subroutine stay_cavitated(before, p)
      !> Pressure before the change
      real(dp), intent(in) :: before(:)
      real(dp), contiguous, intent(inout) :: p(:)
      integer :: i

      do i = 1, size(p)
         p(i) = merge(cavity_pressure, p(i), before(i) <= cavity_pressure)
      end do
   end subroutine stay_cavitated

   !> Change the pressure of flowing nodes; nodes with a negative pressure cavitate
   pure subroutine change_flowing(after, p)
      real(dp), contiguous, intent(in) :: after(:)
      real(dp), contiguous, intent(inout) :: p(:)
      real(dp) :: new
      integer :: i

      do i = 1, size(p)
         new = merge(after(i), cavity_pressure, .not. after(i) <= cavity_pressure)
         p(i) = merge(new, p(i), p(i) > cavity_pressure)
      end do
   end subroutine change_flowing

   !> Set the residual of inactive nodes to 0
   pure subroutine zero_inactive_residual(p, residual)
      real(dp), contiguous, intent(in) :: p(:)
      real(dp), contiguous, intent(inout) :: residual(:)
      integer :: i

      do i = 1, size(p)
         residual(i) = merge(0.0_dp, residual(i), p(i) <= cavity_pressure .and. residual(i) > 0.0_dp)
      end do
   end subroutine zero_inactive_residual
end module ehl_level

! SPDX-License-Identifier: BSD-3-Clause
!> Flow of the lubricant between the surfaces under a pressure gradient: the conductances of the Reynolds equation,
!>
!>    q_x = -eps_x dP/dX,   q_y = -eps_y dP/dY
!>
!> with q the Poiseuille part of the mass flow, and their derivatives. The kinds of flow are in
!> newtonian_flow.f90 and shear_thinning_flow.f90; flow_factory.f90 selects one.
module ehl_flow
   use, intrinsic :: iso_fortran_env, only: int64
   use ehl_grid, only: grid_t
   use ehl_cached_factors, only: cached_factors_t
   use ehl_kinds, only: dp
   use ehl_lubricant, only: lubricant_t
   use ehl_status, only: ehl_no_memory, status_t
   implicit none (type, external)
   private
   public :: flow_t, dir_x

   !> Index of the flow along X in the arrays of a flow; that of the flow along Y is its component `dir_y`
   integer, parameter :: dir_x = 1

   !> Arrays of shape (nx, ny, dir_y)
   type, abstract :: flow_t
      !> 1 if the conductances along X and Y are equal, so that one array serves for both; else 2, and the conductance
      !> along X, the direction of motion, is the larger one.
      integer :: dir_y = dir_x
      !> 1/lambda_bar: the conductance of unit film, density and viscosity
      real(dp) :: inverse_speed = 0.0_dp
      !> Conductance, and d ln(eps)/dP at constant film
      real(dp), allocatable :: eps(:, :, :), dlneps_dp(:, :, :)
      !> Whether the conductance depends on the pressure gradient; in this case -dq/d(grad P) for linear systems, otherwise
      !> not allocated
      logical :: depends_on_gradient = .false.
      real(dp), allocatable :: tangent(:, :, :)
      !> Flow factors of the nodes of a shear-thinning lubricant
      type(cached_factors_t) :: cached
      type(grid_t) :: grid
   contains
      procedure :: setup
      procedure :: rescale
      procedure :: soften
      procedure(find_row), deferred :: find_row
      procedure(film_exponent), deferred :: film_exponent
      procedure(stress_row), deferred :: stress_row
      procedure :: max_neighbour_conductance
      procedure :: bytes
   end type flow_t

   abstract interface
      !> Conductances of row j and their derivatives with respect to P; downstream of node `last` the whole row is cavitated
      pure subroutine find_row(self, lubricant, p, h, rho, drho_dp, j, last)
         import :: dp, flow_t, lubricant_t
         implicit none (type, external)
         class(flow_t), intent(inout) :: self
         type(lubricant_t), intent(in) :: lubricant
         !> Pressure, shape (nx, ny)
         real(dp), contiguous, intent(in) :: p(:, :)
         !> Film, density and its derivative with respect to P in row j, shape (nx)
         real(dp), contiguous, intent(in) :: h(:), rho(:), drho_dp(:)
         integer, intent(in) :: j, last
      end subroutine find_row

      !> d ln(eps)/d ln(H) at node (i, j), along X or Y
      pure real(dp) function film_exponent(self, i, j, direction)
         import :: dp, flow_t
         implicit none (type, external)
         class(flow_t), intent(in) :: self
         integer, intent(in) :: i, j, direction
      end function film_exponent

      !> Shear stress by sliding in row j, over that of a Newtonian lubricant with eta = eta0 and H = 1: the Newtonian stress
      !> at the local viscosity, eta/(eta0 H), and the stress by the shear law
      pure subroutine stress_row(self, lubricant, p, h, rho, j, newtonian, stress)
         import :: dp, flow_t, lubricant_t
         implicit none (type, external)
         class(flow_t), intent(in) :: self
         type(lubricant_t), intent(in) :: lubricant
         !> Pressure, shape (nx, ny)
         real(dp), contiguous, intent(in) :: p(:, :)
         !> Film and density of the row, shape (nx)
         real(dp), contiguous, intent(in) :: h(:), rho(:)
         integer, intent(in) :: j
         real(dp), contiguous, intent(out) :: newtonian(:), stress(:)
      end subroutine stress_row
   end interface

contains

   !> Allocate the arrays of a grid
   subroutine setup(self, grid, status)
      class(flow_t), intent(inout) :: self
      type(grid_t), intent(in) :: grid
      type(status_t), intent(inout) :: status
      integer :: stat

      if (status%failed()) return
      self%grid = grid
      allocate (self%eps(grid%nx, grid%ny, self%dir_y), self%dlneps_dp(grid%nx, grid%ny, self%dir_y), source=0.0_dp, &
                stat=stat)
      if (stat == 0 .and. self%depends_on_gradient) allocate (self%tangent, source=self%eps, stat=stat)
      if (stat == 0 .and. self%depends_on_gradient) call self%cached%setup(grid%nx, grid%ny, stat)
      if (stat /= 0) call status%fail(ehl_no_memory, "no memory for the conductances of a grid level")
   end subroutine setup

   !> Change the viscosity and the sliding speed
   pure subroutine rescale(self, inverse_speed, stress)
      class(flow_t), intent(inout) :: self
      real(dp), intent(in) :: inverse_speed
      !> Newtonian stress of the sliding of eta = eta0 and H = 1 over the stress of the law
      real(dp), intent(in) :: stress

      associate (unused => stress)
      end associate
      self%inverse_speed = inverse_speed
   end subroutine rescale

   !> Weaken shear thinning as if the stress of the law were 1/fraction times as large; no effect on a Newtonian lubricant
   subroutine soften(self, fraction)
      class(flow_t), intent(inout) :: self
      real(dp), intent(in) :: fraction

      associate (unused => self, too => fraction)
      end associate
   end subroutine soften

   !> Maximum conductance along Y of each node of row j and its four neighbours, in columns 2 to nx-1
   pure subroutine max_neighbour_conductance(self, j, south, north, values)
      class(flow_t), intent(in) :: self
      !> The row, and those below and above it
      integer, intent(in) :: j, south, north
      !> Shape (nx)
      real(dp), contiguous, intent(inout) :: values(:)
      integer :: i

      do i = 2, size(values) - 1
         values(i) = max(self%eps(i, j, self%dir_y), self%eps(i - 1, j, self%dir_y), self%eps(i + 1, j, self%dir_y), &
                         self%eps(i, north, self%dir_y), self%eps(i, south, self%dir_y))
      end do
   end subroutine max_neighbour_conductance

   !> Allocated bytes
   pure integer(int64) function bytes(self)
      class(flow_t), intent(in) :: self
      bytes = 0
      if (allocated(self%eps)) bytes = 16*size(self%eps, kind=int64)
      if (allocated(self%tangent)) bytes = bytes + 8*size(self%tangent, kind=int64) + self%cached%bytes()
   end function bytes
end module ehl_flow

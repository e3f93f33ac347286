! SPDX-License-Identifier: BSD-3-Clause
!> One grid of the hierarchy with everything that lives on it
module ehl_level
   use, intrinsic :: iso_fortran_env, only: int64
   use ehl_deflection, only: deflection_t
   use ehl_grid, only: grid_t
   use ehl_kernel, only: kernel_coefficient
   use ehl_kinds, only: dp
   use ehl_lubricant, only: lubricant_t
   use ehl_poiseuille, only: poiseuille_t
   use ehl_status, only: ehl_no_memory, status_t
   use ehl_wedge, only: wedge_t
   implicit none (type, external)
   private
   public :: level_t, line_work_t, near_reach, line_fields, line_width

   !> The line systems know the deflection kernel up to this distance along X
   integer, parameter :: near_reach = 2
   !> Numbers per node that the line systems are made from
   integer, parameter :: line_fields = 10
   !> Lines relaxed side by side
   integer, parameter :: line_width = 8
   !> Grids with fewer nodes are worked on by one thread
   integer, parameter :: parallel_from = 1024

   !> Work space of one thread's line systems: what they are made from (line, number, node), nodes from
   !> -1; upper diagonals (line, diagonal, node) and changes (line, node), nodes from -3
   type :: line_work_t
      real(dp), allocatable :: fields(:, :, :), upper(:, :, :), change(:, :)
   end type line_work_t

   !> Fields of one level, arrays of shape (nx, ny). Dimensionless: P by p_h, lengths by a,
   !> films by a^2/R.
   !>
   !> The discrete Reynolds equation reads, for every node with P > 0,
   !>
   !>    div(eps grad P) - wedge(rho H) = rhs
   !>
   !> where the first term is that of `poiseuille`, the second one the implicit part of `wedge`, and rhs holds
   !> the part of earlier times and the multigrid right-hand side; where P = 0 the left-hand side may be smaller.
   type :: level_t
      type(grid_t) :: grid
      type(lubricant_t) :: lubricant
      class(deflection_t), allocatable :: engine
      !> 1/lambda_bar
      real(dp) :: inverse_speed = 0.0_dp
      !> The terms of the Reynolds equation
      type(poiseuille_t) :: poiseuille
      type(wedge_t) :: wedge
      !> Rigid separation H00
      real(dp) :: h00 = 0.0_dp
      !> Value that the pressure sum must take (2 pi/3 on the finest grid)
      real(dp) :: load = 0.0_dp
      !> Pressure, film, deflection, and the film less H00 and deflection
      real(dp), allocatable :: p(:, :), h(:, :), w(:, :), geometry(:, :)
      !> Right-hand side of the Reynolds equation, and the residual
      real(dp), allocatable :: rhs(:, :), residual(:, :)
      !> Conductance eps = rho H^3/(eta lambda_bar), d ln(eps)/dP at constant film, density, and H d rho/dP
      real(dp), allocatable :: eps(:, :), dlneps_dp(:, :), rho(:, :), h_drho_dp(:, :)
      !> Mass content rho H, and 1 where a node changes distributively in the present sweep, else 0
      real(dp), allocatable :: mass_content(:, :), dipole(:, :)
      !> Pressure as restricted from the next finer level
      real(dp), allocatable :: p_start(:, :)
      !> Change of pressure in the distributive points of a sweep
      real(dp), allocatable :: change(:, :)
      !> For time steps only: the share of a node's change that is to be free of its smooth part, these
      !> changes in a sweep, and their smooth part after its first pass
      real(dp), allocatable :: share(:, :), rough(:, :), smooth(:, :)
      !> Kernel near the source: itself, and for the distributive (dipole) change
      real(dp) :: near(-near_reach:near_reach) = 0.0_dp
      real(dp) :: near_dipole(-near_reach:near_reach) = 0.0_dp
      !> Line systems, one a thread
      type(line_work_t), allocatable :: work(:)
      integer :: threads = 1
      !> Whether the grid is large enough for more than one thread
      logical :: parallel = .false.
   contains
      procedure :: setup
      procedure :: set_transient
      procedure :: bytes
   end type level_t

contains

   !> Allocate the fields and tabulate the near kernel; grid, lubricant, speed parameter and
   !> threads are known
   subroutine setup(self, status)
      class(level_t), intent(inout) :: self
      type(status_t), intent(inout) :: status
      integer :: d, stat

      if (status%failed()) return
      associate (nx => self%grid%nx, ny => self%grid%ny)
         allocate (self%p(nx, ny), self%h(nx, ny), self%w(nx, ny), self%geometry(nx, ny), &
                   self%rhs(nx, ny), self%residual(nx, ny), self%eps(nx, ny), self%dlneps_dp(nx, ny), &
                   self%rho(nx, ny), self%h_drho_dp(nx, ny), self%p_start(nx, ny), &
                   self%change(nx, ny), self%mass_content(nx, ny), self%dipole(nx, ny), source=0.0_dp, stat=stat)
      end associate
      if (stat /= 0) then
         call status%fail(ehl_no_memory, "no memory for a grid level")
         return
      end if
      call self%poiseuille%setup(self%grid)
      call self%wedge%set_steady(self%grid%hx)
      self%parallel = self%threads > 1 .and. self%grid%nx*self%grid%ny >= parallel_from
      allocate (self%work(self%threads))
      do d = 1, self%threads
         allocate (self%work(d)%fields(line_width, line_fields, -1:self%grid%nx + 2), &
                   self%work(d)%upper(line_width, 2, -3:self%grid%nx), &
                   self%work(d)%change(line_width, -3:self%grid%nx + 1), source=0.0_dp, stat=stat)
         if (stat /= 0) then
            call status%fail(ehl_no_memory, "no memory for the line systems")
            return
         end if
      end do
      associate (hx => self%grid%hx, hy => self%grid%hy)
         do d = -near_reach, near_reach
            self%near(d) = kernel_coefficient(d, 0, hx, hy)
            self%near_dipole(d) = self%near(d) - 0.25_dp*(kernel_coefficient(d - 1, 0, hx, hy) &
                                                          + kernel_coefficient(d + 1, 0, hx, hy) &
                                                          + 2.0_dp*kernel_coefficient(d, 1, hx, hy))
         end do
      end associate
   end subroutine setup

   !> Make it a level of time steps
   subroutine set_transient(self, scheme, time_step, status)
      class(level_t), intent(inout) :: self
      !> wedge_narrow or wedge_separate, of ehl_wedge
      integer, intent(in) :: scheme
      real(dp), intent(in) :: time_step
      type(status_t), intent(inout) :: status
      integer :: stat

      if (status%failed()) return
      stat = 0
      associate (nx => self%grid%nx, ny => self%grid%ny)
         if (.not. allocated(self%rough)) allocate (self%share(nx, ny), self%rough(nx, ny), self%smooth(nx, ny), &
                                                    source=0.0_dp, stat=stat)
      end associate
      if (stat /= 0) then
         call status%fail(ehl_no_memory, "no memory for the time steps of a grid level")
         return
      end if
      call self%wedge%set_step(scheme, self%grid%hx, time_step)
   end subroutine set_transient

   !> Allocated bytes, the engine's apart
   pure integer(int64) function bytes(self)
      class(level_t), intent(in) :: self
      integer(int64) :: numbers
      integer :: k

      numbers = 0
      if (allocated(self%p)) numbers = 14*size(self%p, kind=int64)
      if (allocated(self%rough)) numbers = numbers + 3*size(self%rough, kind=int64)
      numbers = numbers + self%poiseuille%bytes()/8
      if (allocated(self%work)) then
         do k = 1, size(self%work)
            numbers = numbers + size(self%work(k)%fields) + size(self%work(k)%upper) + size(self%work(k)%change)
         end do
      end if
      bytes = 8*numbers
   end function bytes
end module ehl_level

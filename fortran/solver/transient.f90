! SPDX-License-Identifier: BSD-3-Clause
!> The march of a rough surface through the contact, one time step at a time
module ehl_transient
   use ehl_cycle, only: refresh
   use ehl_film, only: update_residual
   use ehl_hierarchy, only: hierarchy_t
   use ehl_kinds, only: dp
   use ehl_level, only: level_t
   use ehl_measures, only: measure, measures_t
   use ehl_status, only: ehl_no_memory, status_t
   use ehl_surface, only: surface_t
   implicit none (type, external)
   private
   public :: transient_t, scheme_narrow, scheme_paper

   integer, public :: guess_kind = 1
   integer, parameter :: scheme_narrow = 1, scheme_paper = 2

   type :: transient_t
      integer :: scheme = scheme_narrow
      !> Steps made, the present time, the time step
      integer :: step = 0
      real(dp) :: time = 0.0_dp, time_step = 0.0_dp
      !> Largest residual (rms) of a step, most cycles a step
      real(dp) :: tolerance = 2.0e-5_dp
      integer :: max_cycles = 30
      !> Friction of the smooth contact on the same grid
      real(dp) :: friction_smooth = 1.0_dp
      !> State after the last step
      type(measures_t) :: m
      real(dp) :: residual = 0.0_dp
      integer :: cycles = 0
      !> rho H of the last two steps, pressures of the last two steps, the roughness
      real(dp), allocatable :: mass(:, :, :), p_before(:, :, :), rr(:, :), p_smooth(:, :)
   contains
      procedure :: start
      procedure :: advance
   end type transient_t

contains

   !> Begin from the smooth solution of a level, the roughness riding on it
   subroutine start(self, level, surface, scheme, time_start, friction_smooth, status)
      class(transient_t), intent(inout) :: self
      type(level_t), intent(inout) :: level
      class(surface_t), intent(inout) :: surface
      integer, intent(in) :: scheme
      real(dp), intent(in) :: time_start, friction_smooth
      type(status_t), intent(inout) :: status
      integer :: k, stat

      self%scheme = scheme
      self%step = 0
      self%time = time_start
      self%time_step = level%grid%hx
      self%friction_smooth = friction_smooth
      associate (nx => level%grid%nx, ny => level%grid%ny)
         allocate (self%mass(nx, ny, 2), self%p_before(nx, ny, 2), self%rr(nx, ny), stat=stat)
      end associate
      if (stat /= 0) then
         call status%fail(ehl_no_memory, "no memory for the time levels")
         return
      end if
      self%p_smooth = level%p
      do k = 1, 2
         call surface%height(level%grid, time_start - (k - 1)*self%time_step, self%rr)
         self%mass(:, :, k) = level%rho*(level%h - self%rr)
         self%p_before(:, :, k) = level%p
      end do
   end subroutine start

   !> One time step, cycle by cycle to convergence
   subroutine advance(self, hierarchy, n, surface)
      class(transient_t), intent(inout) :: self
      type(hierarchy_t), intent(inout) :: hierarchy
      integer, intent(in) :: n
      class(surface_t), intent(inout) :: surface

      self%step = self%step + 1
      self%time = self%time + self%time_step
      associate (level => hierarchy%levels(n))
         call surface%height(level%grid, self%time, self%rr)
         call set_geometry(level, self%rr)
         call set_history(self, level)
         call guess(self, level)
         call refresh(level)
         self%cycles = 0
         do
            call hierarchy%cycle(n)
            self%cycles = self%cycles + 1
            call update_residual(level, self%residual)
            if (self%cycles >= self%max_cycles .or. .not. self%residual > self%tolerance) exit
         end do
         self%m = measure(level)
         self%mass(:, :, 2) = self%mass(:, :, 1)
         self%mass(:, :, 1) = level%rho*level%h
         self%p_before(:, :, 2) = self%p_before(:, :, 1)
         self%p_before(:, :, 1) = level%p
      end associate
   end subroutine advance

   !> X^2/2 + Y^2/2 - RR
   subroutine set_geometry(level, rr)
      type(level_t), intent(inout) :: level
      real(dp), intent(in) :: rr(:, :)
      integer :: i, j

      do j = 1, level%grid%ny
         do i = 1, level%grid%nx
            level%geometry(i, j) = 0.5_dp*(level%grid%x(i)**2 + level%grid%y(j)**2) - rr(i, j)
         end do
      end do
   end subroutine set_geometry

   !> Explicit part of wedge and squeeze terms
   subroutine set_history(self, level)
      class(transient_t), intent(in) :: self
      type(level_t), intent(inout) :: level
      real(dp) :: r
      integer :: j, nx

      r = 1.0_dp/self%time_step
      nx = level%grid%nx
      associate (last => self%mass(:, :, 1), former => self%mass(:, :, 2))
         do j = 1, level%grid%ny
            if (self%scheme == scheme_narrow) then
               level%rhs(2, j) = -r*last(1, j)
               level%rhs(3:nx - 1, j) = r*(-2.0_dp*last(2:nx - 2, j) + 0.5_dp*former(1:nx - 3, j))
            else
               level%rhs(2:nx - 1, j) = r*(-2.0_dp*last(2:nx - 1, j) + 0.5_dp*former(2:nx - 1, j))
            end if
         end do
      end associate
   end subroutine set_history

   !> First approximation: extrapolation in time
   subroutine guess(self, level)
      class(transient_t), intent(in) :: self
      type(level_t), intent(inout) :: level
      integer :: j, nx

      nx = level%grid%nx
      do j = 1, level%grid%ny
         associate (last => self%p_before(:, j, 1), former => self%p_before(:, j, 2), smooth => self%p_smooth(:, j))
            select case (guess_kind)
            case (0)
               level%p(:, j) = last
            case (1)
               level%p(:, j) = 2.0_dp*last - former
            case (2)
               level%p(2:nx - 1, j) = smooth(2:nx - 1) + last(1:nx - 2) - smooth(1:nx - 2)
            case (3)
               level%p(3:nx - 1, j) = smooth(3:nx - 1) + 2.0_dp*(last(2:nx - 2) - smooth(2:nx - 2)) &
                                      - (former(1:nx - 3) - smooth(1:nx - 3))
            end select
         end associate
         where (self%p_before(:, j, 1) <= 0.0_dp) level%p(:, j) = 0.0_dp
         level%p(:, j) = max(level%p(:, j), 0.0_dp)
      end do
   end subroutine guess
end module ehl_transient

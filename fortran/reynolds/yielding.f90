! SPDX-License-Identifier: BSD-3-Clause
!> Solids with a hardness: they sustain at most the pressure P_Y. A node yields where P = P_Y and its equation
!> requires more: the elastic film H is below the boundary film H_b (boundary_film.f90) or below the film at which N = 0. The
!> solids yield by the difference D >= 0, so that rho (H + D) is the larger of H_b and the mass content at which N = 0. Such a
!> node keeps its pressure until D would be negative.
!>
!> Without a maximum pressure no node yields.
module ehl_yielding
   use, intrinsic :: iso_fortran_env, only: int64
   use ehl_grid, only: grid_t
   use ehl_kinds, only: dp
   use ehl_status, only: ehl_no_memory, status_t
   implicit none (type, external)
   private
   public :: yielding_t

   type :: yielding_t
      !> Whether nodes may yield
      logical :: active = .false.
      !> Whether the level is a coarse one: the maximum does not apply to restricted pressures
      logical :: coarse = .false.
      !> P_Y [p_h]
      real(dp), private :: max_pressure = 0.0_dp
      !> rho (H + D) where a node yields, else 0, shape (nx, ny); not allocated if none may
      real(dp), allocatable, private :: mass(:, :)
   contains
      procedure :: setup
      procedure :: find_row
      procedure :: limit_pressure
      procedure :: add_depth
      procedure :: set
      procedure :: nodes
      procedure :: forget
      procedure :: bytes
   end type yielding_t

contains

   !> Allocate; max_pressure: that of the solids, or 0
   subroutine setup(self, grid, max_pressure, status)
      class(yielding_t), intent(inout) :: self
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: max_pressure
      type(status_t), intent(inout) :: status
      integer :: stat

      self%active = max_pressure > 0.0_dp
      if (status%failed() .or. .not. self%active) return
      self%max_pressure = max_pressure
      allocate (self%mass(grid%nx, grid%ny), source=0.0_dp, stat=stat)
      if (stat /= 0) call status%fail(ehl_no_memory, "no memory for the solids that yield on a grid level")
   end subroutine setup

   !> Find the yielding nodes of row j and their mass content: that at which N = 0, but at least that of the boundary film
   pure subroutine find_row(self, min_mass, p, weights, j, residual, mass_content)
      class(yielding_t), intent(inout) :: self
      !> H_b; pressure, and the wedge term's factors of rho H at a node and at those upstream of it, shape (nx), (0:..., nx)
      real(dp), intent(in) :: min_mass
      real(dp), contiguous, intent(in) :: p(:), weights(0:, :)
      integer, intent(in) :: j
      !> rhs - N, and rho H, of the elastic bodies; shape (nx)
      real(dp), contiguous, intent(inout) :: residual(:), mass_content(:)
      real(dp) :: added(size(p))
      integer :: i, k

      if (.not. self%active) return
      added = 0.0_dp
      do i = 2, size(p) - 1
         do k = 1, min(ubound(weights, 1), i - 1)
            residual(i) = residual(i) + weights(k, i)*added(i - k)
         end do
         self%mass(i, j) = max(min_mass, mass_content(i) - residual(i)/weights(0, i))
         if (p(i) >= self%max_pressure .and. self%mass(i, j) > mass_content(i)) then
            added(i) = self%mass(i, j) - mass_content(i)
            residual(i) = residual(i) + weights(0, i)*added(i)
            mass_content(i) = self%mass(i, j)
         else
            self%mass(i, j) = 0.0_dp
         end if
      end do
   end subroutine find_row

   !> Limit the new pressures of row j from column `first` on to the maximum; yielding nodes keep theirs
   pure subroutine limit_pressure(self, before, first, j, after)
      class(yielding_t), intent(in) :: self
      real(dp), intent(in) :: before(:)
      integer, intent(in) :: first, j
      real(dp), contiguous, intent(inout) :: after(:)
      integer :: i

      if (self%coarse .or. .not. self%active) return
      do i = 1, size(after)
         after(i) = merge(before(i), after(i), self%mass(first + i - 1, j) > 0.0_dp)
         ! NaN stays NaN
         after(i) = merge(self%max_pressure, after(i), after(i) > self%max_pressure)
      end do
   end subroutine limit_pressure

   !> Add to row j of the film the depth by which the solids yield
   pure subroutine add_depth(self, rho, j, film)
      class(yielding_t), intent(in) :: self
      !> Shape (nx)
      real(dp), contiguous, intent(in) :: rho(:)
      integer, intent(in) :: j
      real(dp), contiguous, intent(inout) :: film(:)
      if (self%active) film = merge(self%mass(:, j)/rho, film, self%mass(:, j) > 0.0_dp)
   end subroutine add_depth

   !> Set values of row j to `value` where nodes yield
   pure subroutine set(self, j, value, values)
      class(yielding_t), intent(in) :: self
      integer, intent(in) :: j
      real(dp), intent(in) :: value
      !> Shape (nx)
      real(dp), contiguous, intent(inout) :: values(:)
      if (self%active) values = merge(value, values, self%mass(:, j) > 0.0_dp)
   end subroutine set

   !> Which of the n nodes of row j yield
   pure function nodes(self, n, j)
      class(yielding_t), intent(in) :: self
      integer, intent(in) :: n, j
      logical :: nodes(n)

      nodes = .false.
      if (self%active) nodes = self%mass(:, j) > 0.0_dp
   end function nodes

   !> Set all nodes to not yielding
   pure subroutine forget(self)
      class(yielding_t), intent(inout) :: self
      if (self%active) self%mass = 0.0_dp
   end subroutine forget

   !> Allocated bytes
   pure integer(int64) function bytes(self)
      class(yielding_t), intent(in) :: self
      bytes = 0
      if (self%active) bytes = 8*size(self%mass, kind=int64)
   end function bytes
end module ehl_yielding

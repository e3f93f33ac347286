! SPDX-License-Identifier: BSD-3-Clause
!> Anderson acceleration of multigrid cycles that stall or alternate between states (Anderson 1965; Walker & Ni 2011; for
!> nonlinear multigrid Brune, Knepley, Smith & Tu 2015): with the state u = (P, H00) before a cycle, G(u) after it
!> and the change f of P in the cycle, the next state is
!>
!>    G(u_k) - sum over j of g_j (G(u_j+1) - G(u_j)),   g = argmin |f_k - sum over j of g_j (f_j+1 - f_j)|,
!>
!> where j runs over the last few cycles. A mixed state with a larger residual than G(u_k) is rejected, and the history begins
!> again with this cycle.
module ehl_anderson
   use ehl_dense_lu, only: back_substitute, factor
   use ehl_kinds, only: dp
   use ehl_level, only: cavitate, level_t
   use ehl_reynolds, only: refresh, update_residual
   use ehl_status, only: ehl_no_memory, status_t
   implicit none (type, external)
   private
   public :: anderson_t

   !> Number of stored differences
   integer, parameter :: depth = 4
   !> Relative increase of the diagonal that keeps the normal equations regular
   real(dp), parameter :: regularisation = 1.0e-12_dp

   type :: anderson_t
      !> Whether cycles are mixed
      logical :: on = .false.
      !> Number of cycles since the history began; the last depth + 1 are used
      integer, private :: cycles = 0
      !> State before the cycle, f and G(u) of the last cycle, and their differences, (nx, ny, :) and (:)
      real(dp), allocatable, private :: before(:, :), f(:, :), g(:, :), df(:, :, :), dg(:, :, :)
      real(dp), private :: h00_before = 0.0_dp, h00_g = 0.0_dp, h00_dg(depth) = 0.0_dp
   contains
      procedure :: begin
      procedure :: remember
      procedure :: mix
      procedure :: finish
   end type anderson_t

contains

   !> Start mixing with the next cycle
   subroutine begin(self, level, status)
      class(anderson_t), intent(inout) :: self
      type(level_t), intent(in) :: level
      type(status_t), intent(inout) :: status
      integer :: stat

      if (self%on .or. status%failed()) return
      associate (nx => level%grid%nx, ny => level%grid%ny)
         allocate (self%before(nx, ny), self%f(nx, ny), self%g(nx, ny), self%df(nx, ny, depth), self%dg(nx, ny, depth), stat=stat)
      end associate
      if (stat /= 0) then
         call status%fail(ehl_no_memory, "no memory for the acceleration of the cycles")
         return
      end if
      self%on = .true.
      self%cycles = 0
   end subroutine begin

   !> Stop mixing
   subroutine finish(self)
      class(anderson_t), intent(inout) :: self

      if (self%on) deallocate (self%before, self%f, self%g, self%df, self%dg)
      self%on = .false.
   end subroutine finish

   !> Store the state before a cycle
   subroutine remember(self, level)
      class(anderson_t), intent(inout) :: self
      type(level_t), intent(in) :: level

      self%before = level%p
      self%h00_before = level%h00
   end subroutine remember

   !> Mix the state after a cycle with earlier ones. Film, coefficients and residual are up to date before and after.
   subroutine mix(self, level, residual)
      class(anderson_t), intent(inout) :: self
      type(level_t), intent(inout) :: level
      !> Residual (rms) of the state
      real(dp), intent(inout) :: residual
      real(dp) :: weights(depth), mixed
      real(dp) :: h00
      integer :: columns, j, k, at

      if (.not. residual < huge(residual)) then
         self%cycles = 0
         return
      end if
      if (self%cycles > 0) then
         at = 1 + mod(self%cycles - 1, depth)
         self%df(:, :, at) = (level%p - self%before) - self%f
         self%dg(:, :, at) = level%p - self%g
         self%h00_dg(at) = level%h00 - self%h00_g
      end if
      self%f = level%p - self%before
      self%g = level%p
      self%h00_g = level%h00
      columns = min(self%cycles, depth)
      self%cycles = self%cycles + 1
      if (columns == 0) return
      weights(:columns) = least_squares(self, columns)
      h00 = level%h00
      do k = 1, columns
         level%p = level%p - weights(k)*self%dg(:, :, k)
         h00 = h00 - weights(k)*self%h00_dg(k)
      end do
      do j = level%grid%first_inner(), level%grid%last_inner()
         call cavitate(level%p(2:level%grid%nx - 1, j))
      end do
      level%h00 = h00
      call refresh(level)
      call update_residual(level, mixed)
      if (mixed <= residual) then
         residual = mixed
         return
      end if
      level%p = self%g
      level%h00 = self%h00_g
      self%cycles = 1
      call refresh(level)
      call update_residual(level, residual)
   end subroutine mix

   !> The weights g
   pure function least_squares(self, columns) result(weights)
      type(anderson_t), intent(in) :: self
      integer, intent(in) :: columns
      real(dp) :: weights(columns), a(columns, columns)
      integer :: j, k, pivot(columns)

      do k = 1, columns
         do j = 1, k
            a(j, k) = sum(self%df(:, :, j)*self%df(:, :, k))
            a(k, j) = a(j, k)
         end do
         weights(k) = sum(self%df(:, :, k)*self%f)
      end do
      do k = 1, columns
         a(k, k) = a(k, k)*(1.0_dp + regularisation) + tiny(1.0_dp)
      end do
      call factor(a, pivot)
      call back_substitute(a, pivot, weights)
   end function least_squares
end module ehl_anderson

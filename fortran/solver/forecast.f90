! SPDX-License-Identifier: BSD-3-Clause
!> First approximation of the pressure of a time step, of second order in time: the changes of the last two steps
!> are continued, at the node (things that stand) or at the nodes they come from with the surface (things that are
!> carried along); each node goes by the one that was right in the step before, judged by what its error does in the
!> equation: where the lubricant flows, a small rough error is a large residual.
module ehl_forecast
   use ehl_kinds, only: dp
   use ehl_level, only: level_t
   use ehl_status, only: ehl_no_memory, status_t
   implicit none (type, external)
   private
   public :: forecast_t

   !> Errors are compared over squares of (2 reach + 1)^2 nodes
   integer, parameter :: reach = 2

   type :: forecast_t
      !> Weight of what is carried along, 0 to 1; (nx, ny)
      real(dp), allocatable :: carried(:, :)
      !> Errors of the last step by their weight in the equation, without and with the motion; (nx, ny)
      real(dp), allocatable, private :: standing_error(:, :), carried_error(:, :)
      !> Nodes that the surface moves in a step
      real(dp) :: shift = 1.0_dp
   contains
      procedure :: setup
      procedure :: predict
      procedure :: learn
      procedure, private :: compare
   end type forecast_t

contains

   !> Allocate; shift: nodes that the surface moves in a step
   subroutine setup(self, nx, ny, shift, status)
      class(forecast_t), intent(inout) :: self
      integer, intent(in) :: nx, ny
      real(dp), intent(in) :: shift
      type(status_t), intent(inout) :: status
      integer :: stat

      if (status%failed()) return
      self%shift = shift
      if (allocated(self%carried)) deallocate (self%carried, self%standing_error, self%carried_error)
      allocate (self%carried(nx, ny), self%standing_error(nx, ny), self%carried_error(nx, ny), source=0.0_dp, stat=stat)
      if (stat /= 0) call status%fail(ehl_no_memory, "no memory for the forecast of a time step")
   end subroutine setup

   !> Pressure expected from that of the last three steps; nodes that were cavitated stay so
   subroutine predict(self, before, level)
      class(forecast_t), intent(in) :: self
      !> Pressures of the last three steps, the latest first, (nx, ny, 3)
      real(dp), intent(in) :: before(:, :, :)
      type(level_t), intent(inout) :: level
      real(dp), dimension(level%grid%nx) :: standing, carried
      integer :: j

      !$omp parallel do default(none) shared(self, before, level) private(standing, carried) &
      !$omp num_threads(level%threads) if(level%parallel) schedule(static)
      do j = 1, level%grid%ny
         call candidates(self, before, j, standing, carried)
         standing = standing + self%carried(:, j)*(carried - standing)
         ! a NaN stays one
         level%p(:, j) = merge(standing, 0.0_dp, .not. standing <= 0.0_dp .and. before(:, j, 1) > 0.0_dp)
      end do
      !$omp end parallel do
   end subroutine predict

   !> See which forecast was right, now that the step is solved
   subroutine learn(self, before, level)
      class(forecast_t), intent(inout) :: self
      !> Pressures of the three steps before that of the level
      real(dp), intent(in) :: before(:, :, :)
      type(level_t), intent(in) :: level
      real(dp), dimension(level%grid%nx) :: standing, carried
      integer :: j

      !$omp parallel do default(none) shared(self, before, level) private(standing, carried) &
      !$omp num_threads(level%threads) if(level%parallel) schedule(static)
      do j = 1, level%grid%ny
         call candidates(self, before, j, standing, carried)
         self%standing_error(:, j) = weighty(level, j, level%p(:, j) - standing)
         self%carried_error(:, j) = weighty(level, j, level%p(:, j) - carried)
      end do
      !$omp end parallel do
      !$omp parallel do default(none) shared(self, level) &
      !$omp num_threads(level%threads) if(level%parallel) schedule(static)
      do j = 1, level%grid%ny
         call self%compare(level, j)
      end do
      !$omp end parallel do
   end subroutine learn

   !> The two forecasts of row j: the changes of the last two steps continued, at the node and carried along
   pure subroutine candidates(self, before, j, standing, carried)
      type(forecast_t), intent(in) :: self
      !> Pressures of the last three steps, the latest first, (nx, ny, 3)
      real(dp), intent(in) :: before(:, :, :)
      integer, intent(in) :: j
      !> Shape (nx)
      real(dp), intent(out) :: standing(:), carried(:)
      !> Changes of the last step and of the one before
      real(dp), dimension(size(before, 1)) :: last, former
      real(dp) :: t, t2
      integer :: i, n, n2

      last = before(:, j, 1) - before(:, j, 2)
      former = before(:, j, 2) - before(:, j, 3)
      standing = before(:, j, 1) + 2.0_dp*last - former
      ! from one step and from two steps up the surface's way, linear between nodes
      n = int(self%shift)
      t = self%shift - n
      n2 = int(2.0_dp*self%shift)
      t2 = 2.0_dp*self%shift - n2
      carried = before(:, j, 1)
      do i = n2 + 2, size(carried)
         carried(i) = carried(i) + 2.0_dp*((1.0_dp - t)*last(i - n) + t*last(i - n - 1)) &
                      - ((1.0_dp - t2)*former(i - n2) + t2*former(i - n2 - 1))
      end do
   end subroutine candidates

   !> What errors of row j weigh: squared, by the deflection they cause (of the order of the error, in the squeeze term)
   !> and by the flow along X they cause
   pure function weighty(level, j, error) result(weight)
      type(level_t), intent(in) :: level
      integer, intent(in) :: j
      !> Shape (nx)
      real(dp), intent(in) :: error(:)
      real(dp) :: weight(size(error)), flow(size(error))

      call level%poiseuille%flow_row(level%eps(:, j), error, flow)
      weight = error**2
      weight = weight + flow**2
   end function weighty

   !> Weights of row j
   subroutine compare(self, level, j)
      class(forecast_t), intent(inout) :: self
      type(level_t), intent(in) :: level
      integer, intent(in) :: j
      real(dp), dimension(level%grid%nx) :: standing, carried
      real(dp) :: e, c
      integer :: i, k, row, nx

      nx = level%grid%nx
      standing = 0.0_dp
      carried = 0.0_dp
      do k = j - reach, min(j + reach, level%grid%ny)
         row = k
         if (row < 1 .and. level%grid%mirror) row = 2 - row
         if (row < 1) cycle
         standing = standing + self%standing_error(:, row)
         carried = carried + self%carried_error(:, row)
      end do
      do i = 1 + reach, nx - reach
         e = sum(standing(i - reach:i + reach))
         c = sum(carried(i - reach:i + reach))
         self%carried(i, j) = e/(e + c + tiny(1.0_dp))
      end do
   end subroutine compare
end module ehl_forecast

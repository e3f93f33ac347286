! SPDX-License-Identifier: BSD-3-Clause
!> First approximation of the pressure of a time step. It changes by what it changed in the last step, at the
!> node (things that stand) or at the node it comes from with the surface (things that are carried
!> along); each node goes by the one that was right in the step before.
module ehl_forecast
   use ehl_kinds, only: dp
   use ehl_level, only: level_t
   use ehl_status, only: ehl_no_memory, status_t
   implicit none (type, external)
   private
   public :: forecast_t

   !> Nothing is carried where the lubricant flows: conductance/mesh-size^2 at which the weight is halved
   real(dp), parameter :: flows = 0.3_dp
   !> Errors are compared over squares of (2 reach + 1)^2 nodes
   integer, parameter :: reach = 2

   type :: forecast_t
      !> Weight of what is carried along, 0 to 1; (nx, ny)
      real(dp), allocatable :: carried(:, :)
      !> Squared errors in the last step, without and with the motion; (nx, ny)
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

   !> Pressure expected from that of the last two steps; nodes that were cavitated stay so
   subroutine predict(self, before, level)
      class(forecast_t), intent(in) :: self
      !> Pressures of the last step and of the one before, (nx, ny, 2)
      real(dp), intent(in) :: before(:, :, :)
      type(level_t), intent(inout) :: level
      real(dp), dimension(level%grid%nx) :: standing, carried
      integer :: j

      !$omp parallel do default(none) shared(self, before, level) private(standing, carried) &
      !$omp num_threads(level%threads) if(level%parallel) schedule(static)
      do j = 1, level%grid%ny
         call candidates(self, before, j, standing, carried)
         level%p(:, j) = merge(max(0.0_dp, standing + self%carried(:, j)*(carried - standing)), &
                               0.0_dp, before(:, j, 1) > 0.0_dp)
      end do
      !$omp end parallel do
   end subroutine predict

   !> See which forecast was right, now that the step is solved
   subroutine learn(self, before, level)
      class(forecast_t), intent(inout) :: self
      !> Pressures of the two steps before that of the level
      real(dp), intent(in) :: before(:, :, :)
      type(level_t), intent(in) :: level
      real(dp), dimension(level%grid%nx) :: standing, carried
      integer :: j

      !$omp parallel do default(none) shared(self, before, level) private(standing, carried) &
      !$omp num_threads(level%threads) if(level%parallel) schedule(static)
      do j = 1, level%grid%ny
         call candidates(self, before, j, standing, carried)
         self%standing_error(:, j) = (level%p(:, j) - standing)**2
         self%carried_error(:, j) = (level%p(:, j) - carried)**2
      end do
      !$omp end parallel do
      !$omp parallel do default(none) shared(self, level) &
      !$omp num_threads(level%threads) if(level%parallel) schedule(static)
      do j = 1, level%grid%ny
         call self%compare(level, j)
      end do
      !$omp end parallel do
   end subroutine learn

   !> The two forecasts of row j: the change of the last step once more, at the node and carried along
   pure subroutine candidates(self, before, j, standing, carried)
      type(forecast_t), intent(in) :: self
      !> Pressures of the last step and of the one before, (nx, ny, 2)
      real(dp), intent(in) :: before(:, :, :)
      integer, intent(in) :: j
      !> Shape (nx)
      real(dp), intent(out) :: standing(:), carried(:)
      real(dp) :: t
      integer :: i, n

      n = int(self%shift)
      t = self%shift - n
      associate (now => before(:, j, 1), last => before(:, j, 2))
         standing = now + (now - last)
         carried(:min(n + 1, size(now))) = now(:min(n + 1, size(now)))
         ! linear between nodes
         do i = n + 2, size(now)
            carried(i) = now(i) + (1.0_dp - t)*(now(i - n) - last(i - n)) + t*(now(i - n - 1) - last(i - n - 1))
         end do
      end associate
   end subroutine candidates

   !> Weights of row j
   subroutine compare(self, level, j)
      class(forecast_t), intent(inout) :: self
      type(level_t), intent(in) :: level
      integer, intent(in) :: j
      real(dp), dimension(level%grid%nx) :: standing, carried
      real(dp) :: e, c, limit
      integer :: i, k, row, nx

      nx = level%grid%nx
      limit = flows*min(level%grid%hx, level%grid%hy)**2
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
         self%carried(i, j) = e/(e + c + tiny(1.0_dp)) &
                              /(1.0_dp + maxval(level%eps(i - 2:i + 1, j))/limit)
      end do
   end subroutine compare
end module ehl_forecast

! SPDX-License-Identifier: BSD-3-Clause
!> First approximation of the pressure of a time step: a weighted mean of several extrapolations in time. Each node
!> weighs them by how right they were around it in the step before, judged by what their errors do in the equation:
!> where the lubricant flows, a small rough error is a large residual. That of first order is for nodes where what a
!> step has left unsolved is larger than what changes from step to step: of it the second order makes twice as much.
!> The weights must not change steeply from node to node: between candidates that differ they would make a rough
!> pressure.
module ehl_predictor
   use ehl_kinds, only: dp
   use ehl_level, only: level_t
   use ehl_node_state, only: cavitate, stay_cavitated
   use ehl_status, only: ehl_no_memory, status_t
   implicit none (type, external)
   private
   public :: predictor_t

   !> Errors are compared over squares of (2 reach + 1)^2 nodes
   integer, parameter :: reach = 2
   !> Extrapolations: of second order at the node (what stands), and at the nodes where things were that the surface
   !> carries along; of first order at the node
   integer, parameter :: candidates = 3
   !> Errors that are nothing
   real(dp), parameter :: least_error = 1.0e-60_dp

   type :: predictor_t
      !> Weights of the candidates but the first, which has the rest; (nx, ny, candidates - 1)
      real(dp), allocatable :: weights(:, :, :)
      !> Errors of the candidates in the last step by their weight in the equation; (nx, ny, candidates)
      real(dp), allocatable, private :: error(:, :, :)
      !> Nodes that the surface moves in a step
      real(dp) :: shift = 1.0_dp
   contains
      procedure :: setup
      procedure :: allocate_weights
      procedure :: predict
      procedure :: learn
      procedure, private :: compare
   end type predictor_t

contains

   !> Allocate; shift: nodes that the surface moves in a step
   subroutine setup(self, nx, ny, shift, status)
      class(predictor_t), intent(inout) :: self
      integer, intent(in) :: nx, ny
      real(dp), intent(in) :: shift
      type(status_t), intent(inout) :: status
      integer :: stat

      if (status%failed()) return
      self%shift = shift
      if (allocated(self%error)) deallocate (self%error)
      call self%allocate_weights(nx, ny, status)
      if (status%failed()) return
      allocate (self%error(nx, ny, candidates), source=0.0_dp, stat=stat)
      if (stat /= 0) call status%fail(ehl_no_memory, "no memory for the predictor of a time step")
   end subroutine setup

   !> Weights, all zero: the first candidate alone
   subroutine allocate_weights(self, nx, ny, status)
      class(predictor_t), intent(inout) :: self
      integer, intent(in) :: nx, ny
      type(status_t), intent(inout) :: status
      integer :: stat

      if (allocated(self%weights)) deallocate (self%weights)
      allocate (self%weights(nx, ny, candidates - 1), source=0.0_dp, stat=stat)
      if (stat /= 0) call status%fail(ehl_no_memory, "no memory for the predictor of a time step")
   end subroutine allocate_weights

   !> Pressure expected from that of the last three steps; nodes that were cavitated stay so
   subroutine predict(self, before, level)
      class(predictor_t), intent(in) :: self
      !> Pressures of the last three steps, the latest first, (nx, ny, 3)
      real(dp), intent(in) :: before(:, :, :)
      type(level_t), intent(inout) :: level
      real(dp) :: c(level%grid%nx, candidates), p(level%grid%nx)
      integer :: j, k

      !$omp parallel do default(none) shared(self, before, level) private(c, p, k) &
      !$omp num_threads(level%threads) if(level%parallel) schedule(static)
      do j = 1, level%grid%ny
         call extrapolate(self%shift, before(:, j, :), c)
         p = c(:, 1)
         do k = 2, candidates
            p = p + self%weights(:, j, k - 1)*(c(:, k) - c(:, 1))
         end do
         level%p(:, j) = p
         call cavitate(level%p(:, j))
         call stay_cavitated(before(:, j, 1), level%p(:, j))
      end do
      !$omp end parallel do
   end subroutine predict

   !> See which candidate was right, now that the step is solved
   subroutine learn(self, before, level)
      class(predictor_t), intent(inout) :: self
      !> Pressures of the three steps before that of the level
      real(dp), intent(in) :: before(:, :, :)
      type(level_t), intent(in) :: level
      real(dp) :: c(level%grid%nx, candidates)
      integer :: j, k

      !$omp parallel do default(none) shared(self, before, level) private(c, k) &
      !$omp num_threads(level%threads) if(level%parallel) schedule(static)
      do j = 1, level%grid%ny
         call extrapolate(self%shift, before(:, j, :), c)
         do k = 1, candidates
            call weigh(level, j, level%p(:, j) - c(:, k), self%error(:, j, k))
         end do
      end do
      !$omp end parallel do
      !$omp parallel do default(none) shared(self, level) &
      !$omp num_threads(level%threads) if(level%parallel) schedule(static)
      do j = 1, level%grid%ny
         call self%compare(level, j)
      end do
      !$omp end parallel do
   end subroutine learn

   !> The candidates of a row
   pure subroutine extrapolate(shift, before, c)
      real(dp), intent(in) :: shift
      !> Pressures of the row in the last three steps, the latest first, (nx, 3)
      real(dp), intent(in) :: before(:, :)
      !> Shape (nx, candidates)
      real(dp), intent(out) :: c(:, :)
      !> Changes of the last step and of the one before
      real(dp), dimension(size(before, 1)) :: last, former
      real(dp) :: t, t2
      integer :: i, n, n2

      last = before(:, 1) - before(:, 2)
      former = before(:, 2) - before(:, 3)
      c(:, 1) = before(:, 1) + 2.0_dp*last - former
      c(:, 2) = before(:, 1)
      c(:, 3) = before(:, 1) + last
      ! from one step and from two steps up the surface's way, linear between nodes
      n = int(shift)
      t = shift - n
      n2 = int(2.0_dp*shift)
      t2 = 2.0_dp*shift - n2
      do i = n2 + 2, size(last)
         c(i, 2) = c(i, 2) + 2.0_dp*((1.0_dp - t)*last(i - n) + t*last(i - n - 1)) &
                   - ((1.0_dp - t2)*former(i - n2) + t2*former(i - n2 - 1))
      end do
   end subroutine extrapolate

   !> What errors of row j weigh: squared, by the deflection they cause (of the order of the error, in the squeeze term)
   !> and by the flow along X they cause
   pure subroutine weigh(level, j, error, weight)
      type(level_t), intent(in) :: level
      integer, intent(in) :: j
      !> Shape (nx)
      real(dp), intent(in) :: error(:)
      real(dp), intent(out) :: weight(:)
      real(dp) :: flow(size(error))

      call level%poiseuille%flow_row(level%flow, j, error, flow)
      weight = error**2
      weight = weight + flow**2
   end subroutine weigh

   !> Weights of row j: the inverse squared errors around
   subroutine compare(self, level, j)
      class(predictor_t), intent(inout) :: self
      type(level_t), intent(in) :: level
      integer, intent(in) :: j
      real(dp) :: across(level%grid%nx), q(level%grid%nx, candidates)
      integer :: first, last, i, k, row

      first = 1 + reach
      last = level%grid%nx - reach
      do k = 1, candidates
         across = 0.0_dp
         do i = j - reach, min(j + reach, level%grid%ny)
            row = i
            if (row < 1 .and. level%grid%mirror) row = 2 - row
            if (row >= 1) across = across + self%error(:, row, k)
         end do
         do i = first, last
            q(i, k) = 1.0_dp/(across(i - 2) + across(i - 1) + across(i) + across(i + 1) + across(i + 2) + least_error)
         end do
      end do
      do i = first, last
         across(i) = 1.0_dp/(q(i, 1) + q(i, 2) + q(i, 3))
      end do
      do k = 2, candidates
         self%weights(first:last, j, k - 1) = q(first:last, k)*across(first:last)
      end do
   end subroutine compare
end module ehl_predictor

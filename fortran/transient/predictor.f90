! SPDX-License-Identifier: BSD-3-Clause
!> First approximation of the pressure of a time step: a weighted mean of several extrapolations in time. The weights at a node
!> depend on their errors around it in the previous step, measured by their effect in the Reynolds equation: where the conductance
!> is high, a small rough error gives a large residual. First-order extrapolation is for nodes where the algebraic error of a step
!> exceeds the change per step: second order would double this error. The weights vary smoothly, since steep changes between
!> different candidates would roughen the pressure.
module ehl_predictor
   use ehl_kinds, only: dp
   use ehl_level, only: cavitate, level_t, stay_cavitated
   use ehl_status, only: ehl_no_memory, status_t
   implicit none (type, external)
   private
   public :: predictor_t

   !> Errors are summed over (2 reach + 1)^2 nodes
   integer, parameter :: reach = 2
   !> Negligible error, which avoids a division by zero
   real(dp), parameter :: min_error = 1.0e-60_dp

   type :: predictor_t
      !> Number of extrapolations: of second order at the node, for stationary fields; of second order at the nodes upstream, for
      !> fields that move with each surface; of first order at the node
      integer, private :: candidates = 3
      !> Weights from the second candidate on, shape (nx, ny, candidates - 1); the first candidate has the rest
      real(dp), allocatable :: weights(:, :, :)
      !> Squared errors of the candidates in the last step, weighted by their effect, shape (nx, ny, candidates)
      real(dp), allocatable, private :: error(:, :, :)
      !> Displacements of the surfaces in a step [nodes]
      real(dp), allocatable :: shifts(:)
   contains
      procedure :: setup
      procedure :: predict
      procedure :: learn
      procedure, private :: compare
   end type predictor_t

contains

   !> Allocate, with all weight on the first candidate
   subroutine setup(self, nx, ny, shifts, status)
      class(predictor_t), intent(inout) :: self
      integer, intent(in) :: nx, ny
      !> Displacements of the surfaces in a step [nodes]
      real(dp), intent(in) :: shifts(:)
      type(status_t), intent(inout) :: status
      integer :: stat

      if (status%failed()) return
      self%shifts = shifts
      self%candidates = size(shifts) + 2
      if (allocated(self%error)) deallocate (self%error, self%weights)
      associate (n => self%candidates)
         allocate (self%weights(nx, ny, n - 1), self%error(nx, ny, n), source=0.0_dp, stat=stat)
      end associate
      if (stat /= 0) call status%fail(ehl_no_memory, "no memory for the predictor of a time step")
   end subroutine setup

   !> Extrapolate the pressure from the last three steps; cavitated nodes stay cavitated
   subroutine predict(self, before, level)
      class(predictor_t), intent(in) :: self
      !> Pressures of the last three steps, the latest first, shape (nx, ny, 3)
      real(dp), contiguous, intent(in) :: before(:, :, :)
      type(level_t), intent(inout) :: level
      real(dp) :: c(level%grid%nx, self%candidates), p(level%grid%nx)
      integer :: j, k

      !$omp parallel do default(none) shared(self, before, level) private(c, p, k) &
      !$omp num_threads(level%threads) if(level%parallel) schedule(static)
      do j = 1, level%grid%ny
         call extrapolate(self%shifts, before(:, j, 1), before(:, j, 2), before(:, j, 3), c)
         p = c(:, 1)
         do k = 2, self%candidates
            p = p + self%weights(:, j, k - 1)*(c(:, k) - c(:, 1))
         end do
         level%p(:, j) = p
         call cavitate(level%p(:, j))
         call stay_cavitated(before(:, j, 1), level%p(:, j))
      end do
      !$omp end parallel do
   end subroutine predict

   !> Update the weights of the candidates from their errors in the solved step
   subroutine learn(self, before, level)
      class(predictor_t), intent(inout) :: self
      !> Pressures of the three steps before that of the level
      real(dp), contiguous, intent(in) :: before(:, :, :)
      type(level_t), intent(in) :: level
      real(dp) :: c(level%grid%nx, self%candidates), error(level%grid%nx)
      integer :: j, k

      !$omp parallel do default(none) shared(self, before, level) private(c, error, k) &
      !$omp num_threads(level%threads) if(level%parallel) schedule(static)
      do j = 1, level%grid%ny
         call extrapolate(self%shifts, before(:, j, 1), before(:, j, 2), before(:, j, 3), c)
         do k = 1, self%candidates
            error = level%p(:, j) - c(:, k)
            call weigh(level, j, error, self%error(:, j, k))
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

   !> Candidates in a row
   pure subroutine extrapolate(shifts, p1, p2, p3, c)
      real(dp), intent(in) :: shifts(:)
      !> Pressures of the row in the last three steps, the latest first, shape (nx)
      real(dp), contiguous, intent(in) :: p1(:), p2(:), p3(:)
      !> Shape (nx, candidates)
      real(dp), contiguous, intent(out) :: c(:, :)
      !> Changes of the last step and of the one before
      real(dp), dimension(size(p1)) :: last, former
      real(dp) :: t, t2
      integer :: i, k, n, n2

      last = p1 - p2
      former = p2 - p3
      c(:, 1) = p1 + 2.0_dp*last - former
      c(:, size(shifts) + 2) = p1 + last
      ! from one and from two steps upstream along the path of a surface, linear between nodes
      do k = 1, size(shifts)
         c(:, k + 1) = p1
         n = int(shifts(k))
         t = shifts(k) - n
         n2 = int(2.0_dp*shifts(k))
         t2 = 2.0_dp*shifts(k) - n2
         do i = n2 + 2, size(last)
            c(i, k + 1) = c(i, k + 1) + 2.0_dp*((1.0_dp - t)*last(i - n) + t*last(i - n - 1)) &
                          - ((1.0_dp - t2)*former(i - n2) + t2*former(i - n2 - 1))
         end do
      end do
   end subroutine extrapolate

   !> Squared effect of the errors of row j in the Reynolds equation: in the squeeze term by the deflection, which is of the order
   !> of the error, and in the Poiseuille term along X
   pure subroutine weigh(level, j, error, effect)
      type(level_t), intent(in) :: level
      integer, intent(in) :: j
      !> Shape (nx)
      real(dp), contiguous, intent(in) :: error(:)
      real(dp), contiguous, intent(out) :: effect(:)
      real(dp) :: term(size(error))

      call level%poiseuille%flow_row(level%flow, j, error, term)
      effect = error**2
      effect = effect + term**2
   end subroutine weigh

   !> Weights of row j: the inverse squared errors in the neighbourhood
   subroutine compare(self, level, j)
      class(predictor_t), intent(inout) :: self
      type(level_t), intent(in) :: level
      integer, intent(in) :: j
      real(dp) :: sums(level%grid%nx), q(level%grid%nx, self%candidates)
      integer :: first, last, i, k, row

      first = 1 + reach
      last = level%grid%nx - reach
      do k = 1, self%candidates
         sums = 0.0_dp
         do i = j - reach, merge(j + reach, min(j + reach, level%grid%ny), level%grid%periodic)
            row = level%grid%stored_row(i)
            if (row >= 1) sums = sums + self%error(:, row, k)
         end do
         do i = first, last
            q(i, k) = 1.0_dp/(sums(i - 2) + sums(i - 1) + sums(i) + sums(i + 1) + sums(i + 2) + min_error)
         end do
      end do
      sums(first:last) = q(first:last, 1)
      do k = 2, self%candidates
         sums(first:last) = sums(first:last) + q(first:last, k)
      end do
      sums(first:last) = 1.0_dp/sums(first:last)
      do k = 2, self%candidates
         self%weights(first:last, j, k - 1) = q(first:last, k)*sums(first:last)
      end do
   end subroutine compare
end module ehl_predictor

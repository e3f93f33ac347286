! SPDX-License-Identifier: BSD-3-Clause
!> What a time step takes from the ones before it, and leaves to the next; and the first approximation of its pressure.
!>
!> That is a weighted mean of several extrapolations in time. Each node weighs them by how right they were around it in the
!> step before, judged by what their errors do in the equation: where the lubricant flows, a small rough error is a large
!> residual. That of first order is for nodes where what a step has left unsolved is larger than what changes from step to
!> step: of it the second order makes twice as much. The weights must not change steeply from node to node: between candidates
!> that differ they would make a rough pressure.
module ehl_time_levels
   use ehl_contact, only: contact_t
   use ehl_flow, only: along
   use ehl_kernel, only: kernel_coefficient
   use ehl_kinds, only: dp
   use ehl_level, only: level_t
   use ehl_node_state, only: cavitate, stay_cavitated
   use ehl_status, only: ehl_no_memory, status_t
   implicit none (type, external)
   private
   public :: set_geometry, set_history, keep, predictor_t

   !> A residual is answered partly by the squeeze of the film, partly by the Poiseuille flow. Half of it is passed on to
   !> the next step where the flow is so many times the squeeze.
   real(dp), parameter :: flows_away = 1.0e4_dp

   !> Errors are compared over squares of (2 reach + 1)^2 nodes
   integer, parameter :: reach = 2
   !> Errors that are nothing
   real(dp), parameter :: least_error = 1.0e-60_dp

   type :: predictor_t
      !> Extrapolations: of second order at the node (what stands), and at the nodes where things were that a surface
      !> carries along, one for each surface that moves; of first order at the node
      integer, private :: candidates = 3
      !> Weights of the candidates but the first, which has the rest; (nx, ny, candidates - 1)
      real(dp), allocatable :: weights(:, :, :)
      !> Errors of the candidates in the last step by their weight in the equation; (nx, ny, candidates)
      real(dp), allocatable, private :: error(:, :, :)
      !> Nodes that the surfaces move in a step
      real(dp), allocatable :: shifts(:)
   contains
      procedure :: setup
      procedure :: predict
      procedure :: learn
      procedure, private :: compare
   end type predictor_t

contains

   !> Gap of the undeformed bodies, less the roughness
   subroutine set_geometry(level, contact, rr)
      type(level_t), intent(inout) :: level
      class(contact_t), intent(in) :: contact
      real(dp), intent(in) :: rr(:, :)
      real(dp) :: x(level%grid%nx)
      integer :: j

      x = level%grid%columns()
      !$omp parallel do default(none) shared(level, contact, rr, x) &
      !$omp num_threads(level%threads) if(level%parallel) schedule(static)
      do j = 1, level%grid%ny
         call contact%gap_row(x, level%grid%y(j), level%geometry(:, j))
         level%geometry(:, j) = level%geometry(:, j) - rr(:, j)
      end do
      !$omp end parallel do
   end subroutine set_geometry

   !> The part of earlier times in the right-hand side
   subroutine set_history(level, mass_content)
      type(level_t), intent(inout) :: level
      !> Mass content at the earlier times, the latest first, (nx, ny, old_times); see keep
      real(dp), intent(in) :: mass_content(:, :, :)
      integer :: j

      !$omp parallel do default(none) shared(level, mass_content) &
      !$omp num_threads(level%threads) if(level%parallel) schedule(static)
      do j = 1, level%grid%ny
         call level%wedge%history_row(mass_content(:, j, :), level%rhs(:, j))
      end do
      !$omp end parallel do
   end subroutine set_history

   !> The present fields become the last ones. The mass content kept is not rho H but the one that what flowed in and out
   !> leaves: the two differ by the residual of the step, which the next step makes up for, so that what steps leave
   !> unsolved does not add up as it is carried through the contact. In the inlet nothing adds up: flow evens it out within
   !> the step, and what sweeps leave there from line to line would only be noise in the next steps.
   subroutine keep(level, mass_content, p_before)
      type(level_t), intent(in) :: level
      !> Mass content of the last two steps and pressure of the last three, the latest first
      real(dp), intent(inout) :: mass_content(:, :, :), p_before(:, :, :)
      real(dp) :: time, stored, flow
      integer :: i, j

      time = 1.0_dp/level%wedge%squeeze
      ! by a change of pressure at one node, with rho = 1; of it flows away, with eps = 1
      stored = level%wedge%squeeze*kernel_coefficient(level%kernel_factor, 0, 0, level%grid%hx, level%grid%hy)
      flow = level%poiseuille%flow_rate()
      !$omp parallel do default(none) shared(level, mass_content, p_before, time, stored, flow) private(i) &
      !$omp num_threads(level%threads) if(level%parallel) schedule(static)
      do j = 1, level%grid%ny
         do i = 1, level%grid%nx
            mass_content(i, j, 2) = mass_content(i, j, 1)
            mass_content(i, j, 1) = level%mass_content(i, j) &
                                    - time*level%residual(i, j)*stored &
                                    /(stored + level%flow%eps(i, j, along)*flow/flows_away)
            p_before(i, j, 3) = p_before(i, j, 2)
            p_before(i, j, 2) = p_before(i, j, 1)
            p_before(i, j, 1) = level%p(i, j)
         end do
      end do
      !$omp end parallel do
   end subroutine keep

   !> Allocate, with all weight on the first candidate
   subroutine setup(self, nx, ny, shifts, status)
      class(predictor_t), intent(inout) :: self
      integer, intent(in) :: nx, ny
      !> Nodes that the surfaces move in a step
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

   !> Pressure expected from that of the last three steps; nodes that were cavitated stay so
   subroutine predict(self, before, level)
      class(predictor_t), intent(in) :: self
      !> Pressures of the last three steps, the latest first, (nx, ny, 3)
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

   !> See which candidate was right, now that the step is solved
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

   !> The candidates of a row
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
      ! from one step and from two steps up a surface's way, linear between nodes
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

   !> What errors of row j weigh: squared, by the deflection they cause (of the order of the error, in the squeeze term)
   !> and by the flow along X they cause
   pure subroutine weigh(level, j, error, weight)
      type(level_t), intent(in) :: level
      integer, intent(in) :: j
      !> Shape (nx)
      real(dp), contiguous, intent(in) :: error(:)
      real(dp), contiguous, intent(out) :: weight(:)
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
      real(dp) :: across(level%grid%nx), q(level%grid%nx, self%candidates)
      integer :: first, last, i, k, row

      first = 1 + reach
      last = level%grid%nx - reach
      do k = 1, self%candidates
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
      across(first:last) = q(first:last, 1)
      do k = 2, self%candidates
         across(first:last) = across(first:last) + q(first:last, k)
      end do
      across(first:last) = 1.0_dp/across(first:last)
      do k = 2, self%candidates
         self%weights(first:last, j, k - 1) = q(first:last, k)*across(first:last)
      end do
   end subroutine compare
end module ehl_time_levels

! SPDX-License-Identifier: BSD-3-Clause
!> Deflection by multilevel multi-integration (Brandt & Lubrecht 1990, J. Comput. Phys. 90;
!> Venner & Lubrecht 2000, Multi-level methods in lubrication, chapter 5)
!>
!> Where the kernel is smooth, a sum over many small cells can be replaced by one over fewer, larger cells:
!> anterpolation transfers the sources to the grid of every second node along one axis, then along the
!> other (mlmi_down.f90), until at most 17 nodes per side are left, where the sum is evaluated directly (sum_directly). The
!> deflection is interpolated back to the finer grids and corrected on a patch around each node, where the kernel is not
!> smooth (mlmi_up.f90). Transfers use 2t points, and grids extend beyond the domain so that transfers keep their order
!> at the border.
!>
!> Transfer order and patch size follow from the accuracy required, relative to the maximum of W, for max W about max P as in a
!> contact of the Hertz radius. Neglected corrections add up, in magnitude, to 2.5 times the accuracy on the finest grid, and
!> their effect to 2^(-1/2) times that on each next coarser grid, where corrections cost less; their signs differ.
!> Measurements: docs/evidence/deflection.
! Rows are passed by their first element
! allow(assumed-size)
module ehl_mlmi
   use, intrinsic :: iso_fortran_env, only: int64
   use ehl_kinds, only: dp
   use ehl_grid, only: grid_t
   use ehl_status, only: status_t, ehl_bad_input, ehl_no_memory
   use ehl_text, only: fixed
   use ehl_deflection, only: deflection_t
   use ehl_kernel, only: kernel_coefficient
   use ehl_mlmi_down, only: descend, no_memory, stage_t, stored_row, take
   use ehl_mlmi_up, only: ascend, stencil_t, transfer_weights
   !$ use omp_lib, only: omp_get_thread_num
   implicit none (type, external)
   private
   public :: mlmi_deflection_t

   !> Grids are halved until they have no more nodes per side than this
   integer, parameter :: max_coarsest = 17
   !> Grids with fewer nodes use one thread
   integer, parameter :: small = 1024
   !> Approximate number of operations per node; on the coarsest grid it is the number of nodes
   integer, parameter :: operations = 16
   !> Upper limit of the number of coarsenings of any grid that fits into memory
   integer, parameter :: max_stages = 64
   !> Range of accuracies in which the estimate of the error holds
   real(dp), parameter :: coarse_limit = 2.0e-4_dp, fine_limit = 1.0e-10_dp
   !> Accuracy above which the tolerance of neglected corrections increases in proportion to it: that of mesh sizes above a/4,
   !> which only thick films have. Without the increase a patch would be wider than `reach` there.
   real(dp), parameter :: loose = 2.4e-3_dp
   !> Neglected corrections on the finest grid, in units of the accuracy, and their ratio from
   !> one grid to the next, with the kernel and the sources of each grid
   real(dp), parameter :: truncation = 2.5_dp, ratio = 0.5_dp**1.5_dp

   !> Multilevel multi-integration
   type, extends(deflection_t) :: mlmi_deflection_t
      private
      integer :: threads = 1
      !> Weights of the transfers
      real(dp), allocatable :: omega(:)
      !> The grids, finest first
      type(stage_t), allocatable :: stages(:)
      !> Local corrections of all grids but the coarsest
      type(stencil_t), allocatable :: stencils(:)
      !> Row buffers of the threads: (elements, buffers, threads)
      real(dp), allocatable :: work(:, :, :)
   contains
      procedure :: setup
      procedure :: apply
      procedure :: bytes
   end type mlmi_deflection_t

contains

   !> Prepare for a grid; the accuracy must be at least 1e-10, and above 2e-4 the transfers do not change
   subroutine setup(self, grid, factor, accuracy, threads, status)
      class(mlmi_deflection_t), intent(inout) :: self
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: factor, accuracy
      integer, intent(in) :: threads
      type(status_t), intent(inout) :: status
      real(dp) :: goal, tolerance
      integer :: s, n, axis, step(2), extent(2), low(2), high(2), longest, stat
      logical :: met

      self%threads = max(1, threads)
      goal = min(accuracy, coarse_limit)
      tolerance = truncation*goal*max(1.0_dp, accuracy/loose)
      self%omega = transfer_weights(half_points(goal))
      n = count_halvings(grid)
      if (allocated(self%stages)) deallocate (self%stages, self%stencils)
      if (allocated(self%work)) deallocate (self%work)
      allocate (self%stages(n + 1), self%stencils(n), stat=stat)
      if (stat /= 0) then
         call status%fail(ehl_no_memory, no_memory)
         return
      end if
      step = 1
      low = 0
      high = [grid%nx - 1, grid%ny - 1]
      longest = grid%nx + 1
      do s = 1, n
         associate (stage => self%stages(s), stencil => self%stencils(s))
            axis = next_axis(grid, step)
            extent = high - low + 2*size(self%omega)
            if (grid%mirror) extent(2) = extent(2) + high(2)
            call stencil%make(axis, step, extent, factor, grid%hx, grid%hy, self%omega, tolerance*ratio**(s - 1), met)
            if (goal < fine_limit .or. .not. met) then
               call refuse(accuracy, status)
               return
            end if
            call stage%halve(low, high, axis, grid%mirror, size(self%omega), stencil%reach(), status)
            if (status%failed()) return
            step(axis) = 2*step(axis)
            low = stage%coarse_low
            high = stage%coarse_high
            longest = max(longest, high(1) - low(1) + 1 + 2*stage%margin)
         end associate
      end do
      call set_coarsest(self%stages(n + 1), low, high, grid%mirror, step, factor, grid%hx, grid%hy, status)
      if (status%failed()) return
      longest = max(longest, high(1) - low(1) + 1 + 2*self%stages(n + 1)%margin)
      allocate (self%work(longest, 3, self%threads), stat=stat)
      if (stat /= 0) then
         call status%fail(ehl_no_memory, no_memory)
         return
      end if
      self%work = 0.0_dp
   end subroutine setup

   !> Half the number of points of the transfers that reach an accuracy in the least time
   pure integer function half_points(accuracy)
      real(dp), intent(in) :: accuracy
      real(dp), parameter :: limit(*) = [1.0e-4_dp, 1.0e-6_dp, 1.0e-7_dp, 1.0e-8_dp, 1.0e-9_dp]

      half_points = 3 + count(accuracy < 0.999_dp*limit)
   end function half_points

   !> Number of coarsenings down to the coarsest grid
   pure integer function count_halvings(grid)
      type(grid_t), intent(in) :: grid
      integer :: step(2), axis

      count_halvings = 0
      step = 1
      do
         axis = next_axis(grid, step)
         if (axis == 0) return
         step(axis) = 2*step(axis)
         count_halvings = count_halvings + 1
      end do
   end function count_halvings

   !> Axis to coarsen next on the grid of every step-th node: of the axes with more than `max_coarsest` nodes the one
   !> with the finer mesh; 0 if neither has more
   pure integer function next_axis(grid, step)
      type(grid_t), intent(in) :: grid
      integer, intent(in) :: step(2)
      logical :: many(2)

      many = ([grid%nx, grid%full_ny()] - 1)/step + 1 > max_coarsest
      if (all(many)) then
         next_axis = merge(1, 2, step(1)*grid%hx <= 1.001_dp*step(2)*grid%hy)
      else
         next_axis = findloc(many, .true., dim=1)
      end if
   end function next_axis

   !> Report that the accuracy cannot be reached
   subroutine refuse(accuracy, status)
      real(dp), intent(in) :: accuracy
      type(status_t), intent(inout) :: status

      call status%fail(ehl_bad_input, "deflection by 'mlmi' to a relative accuracy of " &
                       //fixed(accuracy, "es9.2")//" was requested, at least " &
                       //fixed(fine_limit, "es9.2")//" was expected; 'fft' is exact to rounding")
   end subroutine refuse

   !> W = K P
   subroutine apply(self, p, w)
      class(mlmi_deflection_t), intent(inout) :: self
      real(dp), intent(in) :: p(:, :)
      real(dp), intent(out) :: w(:, :)
      integer :: s, n, nodes(max_stages), threads(max_stages)

      n = size(self%stages)
      do s = 1, n
         nodes(s) = product(self%stages(s)%high - self%stages(s)%low + 1)
      end do
      threads = merge(self%threads, 1, nodes >= small)
      threads(n) = merge(self%threads, 1, nodes(n)**2 >= operations*small)
      call take(self%stages(1), threads(1), p, self%work)
      do s = 1, n - 1
         call descend(self%stages(s), self%stages(s + 1), self%omega, threads(s), self%work)
      end do
      if (n == 1) then
         call sum_directly(self%stages(n), threads(n), self%work, w)
         return
      end if
      call sum_directly(self%stages(n), threads(n), self%work, self%stages(n - 1)%coarse)
      do s = n - 1, 2, -1
         call ascend(self%stages(s), self%stencils(s), self%omega, threads(s), self%work, &
                     self%stages(s - 1)%coarse)
      end do
      call ascend(self%stages(1), self%stencils(1), self%omega, threads(1), self%work, w)
   end subroutine apply

   !> Allocated bytes without the small tables of weights and corrections
   pure integer(int64) function bytes(self)
      class(mlmi_deflection_t), intent(in) :: self
      integer :: s

      bytes = 0
      if (allocated(self%work)) bytes = bytes + 8*size(self%work, kind=int64)
      if (.not. allocated(self%stages)) return
      do s = 1, size(self%stages)
         bytes = bytes + self%stages(s)%bytes()
      end do
   end function bytes

   !> Set up the coarsest grid low:high, of every step-th node
   subroutine set_coarsest(stage, low, high, mirror, step, factor, hx, hy, status)
      type(stage_t), intent(inout) :: stage
      integer, intent(in) :: low(2), high(2), step(2)
      logical, intent(in) :: mirror
      real(dp), intent(in) :: factor, hx, hy
      type(status_t), intent(inout) :: status
      integer :: i, j, width, height, stat

      stage%mirror = mirror
      stage%low = low
      stage%high = high
      stage%margin = 8
      width = high(1) - low(1) + stage%margin
      height = merge(2*high(2), high(2) - low(2), mirror)
      call stage%reserve_sources(stat)
      if (stat == 0) allocate (stage%coarse(-width:width, 0:height), stat=stat)
      if (stat /= 0) then
         call status%fail(ehl_no_memory, no_memory)
         return
      end if
      do j = 0, height
         do i = 0, width
            stage%coarse(i, j) = kernel_coefficient(factor, step(1)*i, step(2)*j, hx, hy)
            stage%coarse(-i, j) = stage%coarse(i, j)
         end do
      end do
   end subroutine set_coarsest

   !> Deflection of the coarsest grid
   subroutine sum_directly(stage, threads, work, w)
      type(stage_t), intent(in) :: stage
      integer, intent(in) :: threads
      real(dp), intent(inout) :: work(:, :, :)
      real(dp), intent(out) :: w(stage%low(1):stage%high(1), stage%low(2):stage%high(2))
      integer :: j, me

      !$omp parallel num_threads(threads) default(none) private(j, me) shared(stage, work, w)
      me = 1
      !$ me = omp_get_thread_num() + 1
      !$omp do schedule(static)
      do j = stage%low(2), stage%high(2)
         call sum_row(stage, j, work(:, 1, me), work(:, 2, me), w(:, j))
      end do
      !$omp end do
      !$omp end parallel
   end subroutine sum_directly

   !> Row j of the deflection of the coarsest grid: source rows at the same distance are added first. Sums are taken for a
   !> multiple of eight columns, so that the compiler's vector loop has no remainder.
   subroutine sum_row(stage, j, s, sums, w)
      type(stage_t), intent(in) :: stage
      integer, intent(in) :: j
      real(dp), intent(inout) :: s(stage%low(1):*), sums(*)
      real(dp), intent(out) :: w(:)
      integer :: d, i, n, a, b, upper, lower, start

      n = 8*((size(w) + 7)/8)
      sums(:n) = 0.0_dp
      start = lbound(stage%coarse, 1)
      do d = 0, ubound(stage%coarse, 2)
         upper = stored_row(stage, j + d)
         lower = stored_row(stage, j - d)
         a = min(stage%first(upper), stage%first(lower))
         b = max(stage%last(upper), stage%last(lower))
         if (a > b) cycle
         if (d == 0) then
            s(a:b) = stage%source(a:b, j)
         else
            s(a:b) = stage%source(a:b, upper) + stage%source(a:b, lower)
         end if
         s(b + 1:b + 7) = 0.0_dp
         do i = a, b, 8
            call add_taps(n, s(i:i + 7), stage%coarse(:, d), stage%low(1) - i - start + 1, sums)
         end do
      end do
      w = sums(:size(w))
   end subroutine sum_row

   !> y(i) = y(i) + sum over k = 1..8 of c(k)*a(start + i-1 - (k-1))
   pure subroutine add_taps(n, c, a, start, y)
      integer, intent(in) :: n, start
      real(dp), intent(in) :: c(8), a(*)
      real(dp), intent(inout) :: y(n)
      integer :: i, s

      s = start - 1
      do i = 1, n
         y(i) = y(i) + ((c(1)*a(s + i) + c(2)*a(s + i - 1)) &
                        + (c(3)*a(s + i - 2) + c(4)*a(s + i - 3))) &
                + ((c(5)*a(s + i - 4) + c(6)*a(s + i - 5)) &
                   + (c(7)*a(s + i - 6) + c(8)*a(s + i - 7)))
      end do
   end subroutine add_taps
end module ehl_mlmi

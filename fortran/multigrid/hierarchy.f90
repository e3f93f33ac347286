! SPDX-License-Identifier: BSD-3-Clause
!> The grids of a multigrid solution: first those that full multigrid solves one after the other, coarsest first, each with
!> twice the mesh size of the next along both axes; then the coarse grids of their correction cycles.
!>
!> A sweep reduces errors that oscillate along an axis only where the cells are not much longer along it than across
!> it (docs/theory/relaxation.md). So a grid of long cells is coarsened along their short side alone until they are nearly
!> square, and then along both axes. The coarsest grid is solved directly: it is coarsened along Y alone as long as it has
!> too many unknowns.
module ehl_hierarchy
   use, intrinsic :: iso_fortran_env, only: int64
   use ehl_coarsest, only: coarsest_t
   use ehl_deflection_factory, only: new_deflection
   use ehl_flow_factory, only: new_flow
   use ehl_galerkin, only: coarsening_t
   use ehl_grid, only: grid_t, long_x
   use ehl_kinds, only: dp
   use ehl_level, only: level_t
   use ehl_lubricant, only: lubricant_t
   use ehl_status, only: ehl_no_memory, status_t
   use ehl_workspace, only: workspace_t
   implicit none (type, external)
   private
   public :: hierarchy_t

   !> Number of nodes of a grid from which on several threads are faster, measured on two shared cores
   integer, parameter :: parallel_from = 60000
   !> Grids with hy/hx above this are coarsened along X alone if possible
   real(dp), parameter :: long_y = 3.0_dp
   !> Number of unknowns above which the coarsest grid is coarsened along Y if possible, and minimum number of intervals along Y
   integer, parameter :: max_unknowns = 250, min_rows = 8

   type :: hierarchy_t
      type(level_t), allocatable :: levels(:)
      type(workspace_t), allocatable :: workspaces(:)
      !> Operator-dependent coarsening from each level to the next coarser one; set up when first used
      type(coarsening_t), allocatable :: coarsenings(:)
      !> The coarse level that corrects each level; 0: the level is solved directly
      integer, allocatable :: below(:)
      !> Direct solvers of these levels
      type(coarsest_t), allocatable :: coarsest(:)
      !> Levels of full multigrid that have been set up
      integer :: ready = 0
      character(len=:), allocatable :: engine
      !> Maximum number of threads
      integer :: threads = 1
   contains
      procedure :: setup
      procedure :: grow
      procedure, private :: set_up
      procedure :: supply
      procedure :: prepare_steps
      procedure :: prepare_coarsening
      procedure :: soften
      procedure :: forget
      procedure :: bytes
   end type hierarchy_t

contains

   !> Define all levels; only the arrays of the coarsest one of full multigrid and of its coarse grids are allocated yet
   subroutine setup(self, coarsest, n, lubricant, speed_parameter, kernel_factor, engine, threads, status)
      class(hierarchy_t), intent(inout) :: self
      !> Coarsest grid, and maximum number of levels
      type(grid_t), intent(in) :: coarsest
      integer, intent(in) :: n
      type(lubricant_t), intent(in) :: lubricant
      !> lambda_bar; factor k_b of the deflection
      real(dp), intent(in) :: speed_parameter, kernel_factor
      !> Deflection engine
      character(len=*), intent(in) :: engine
      integer, intent(in) :: threads
      type(status_t), intent(inout) :: status
      type(grid_t), allocatable :: grids(:)
      integer :: k, stat

      if (status%failed()) return
      self%ready = 0
      self%engine = engine
      self%threads = threads
      call find_coarse_grids(coarsest, n, grids, self%below)
      if (allocated(self%levels)) deallocate (self%levels, self%workspaces, self%coarsenings, self%coarsest)
      associate (all => size(grids))
         allocate (self%levels(all), self%workspaces(all), self%coarsenings(all), self%coarsest(all), stat=stat)
      end associate
      if (stat /= 0) then
         call status%fail(ehl_no_memory, "no memory for the grid levels")
         return
      end if
      do k = 1, size(grids)
         self%levels(k)%grid = grids(k)
         self%levels(k)%lubricant = lubricant
         self%levels(k)%kernel_factor = kernel_factor
         call new_flow(lubricant, speed_parameter, self%levels(k)%flow)
      end do
      call self%grow(1, status)
   end subroutine setup

   !> Set up the levels of full multigrid up to level n, and the coarse grids that correct them
   subroutine grow(self, n, status)
      class(hierarchy_t), intent(inout) :: self
      integer, intent(in) :: n
      type(status_t), intent(inout) :: status
      integer :: k

      do k = self%ready + 1, n
         call self%set_up(k, status)
         if (status%failed()) return
         self%ready = k
      end do
   end subroutine grow

   !> Set up a level and those below it unless they are set up
   recursive subroutine set_up(self, k, status)
      class(hierarchy_t), intent(inout) :: self
      integer, intent(in) :: k
      type(status_t), intent(inout) :: status

      associate (level => self%levels(k), below => self%below(k))
         if (status%failed() .or. allocated(level%p)) return
         if (below > 0) then
            call self%set_up(below, status)
            call self%workspaces(below)%prepare_coarse(status)
         else
            call self%coarsest(k)%setup(level%grid, level%kernel_factor, status)
         end if
         level%threads = useful_threads(level%grid, self%threads)
         call level%setup(status)
         call self%workspaces(k)%setup(level%grid, level%kernel_factor, level%threads, status)
         call new_deflection(self%engine, level%engine, status, level%grid)
         if (status%failed()) return
         call level%engine%setup(level%grid, level%kernel_factor, deflection_accuracy(level%grid), level%threads, status)
      end associate
   end subroutine set_up

   !> Set the oil layer rho H at the inlet; 0: flooded inlet
   subroutine supply(self, layer)
      class(hierarchy_t), intent(inout) :: self
      real(dp), intent(in) :: layer
      integer :: k

      do k = 1, size(self%levels)
         if (allocated(self%levels(k)%p)) call self%levels(k)%supply%setup(self%levels(k)%grid%hx, self%levels(k)%grid%ny, layer)
      end do
   end subroutine supply

   !> Allocate what time steps need, and discretise wedge and squeeze terms for them
   subroutine prepare_steps(self, scheme, time_step, status)
      class(hierarchy_t), intent(inout) :: self
      !> wedge_narrow or wedge_separate, of ehl_wedge
      integer, intent(in) :: scheme
      real(dp), intent(in) :: time_step
      type(status_t), intent(inout) :: status
      integer :: k

      do k = 1, size(self%levels)
         if (.not. allocated(self%levels(k)%p)) cycle
         call self%workspaces(k)%prepare_steps(status)
         if (status%failed()) return
         call self%levels(k)%wedge%set_step(scheme, self%levels(k)%grid%hx, time_step)
      end do
   end subroutine prepare_steps

   !> Allocate what Alcouffe coarsening needs, on grids that are coarsened along both axes, unless it is allocated
   subroutine prepare_coarsening(self, status)
      class(hierarchy_t), intent(inout) :: self
      type(status_t), intent(inout) :: status
      integer :: k

      do k = 1, size(self%levels)
         if (status%failed()) return
         if (self%below(k) == 0 .or. .not. allocated(self%levels(k)%p) .or. self%coarsenings(k)%transfer%nx > 0) cycle
         associate (fine => self%levels(k), coarse => self%levels(self%below(k)))
            if (any(fine%grid%intervals() == coarse%grid%intervals())) cycle
            call coarse%poiseuille%prepare_product(status)
            call self%coarsenings(k)%setup(fine%grid, coarse%grid, fine%threads, fine%parallel, status)
         end associate
      end do
   end subroutine prepare_coarsening

   !> Number of threads on a grid: all, or one where synchronisation costs more than parallel loops save
   pure integer function useful_threads(grid, threads)
      type(grid_t), intent(in) :: grid
      integer, intent(in) :: threads
      useful_threads = merge(threads, 1, grid%nx*grid%ny >= parallel_from)
   end function useful_threads

   !> Error of the deflection, relative to its maximum, that stays below a tenth of the
   !> discretisation error of a piecewise-constant Hertz pressure (2.2e-4 at h = 1/128)
   pure real(dp) function deflection_accuracy(grid)
      type(grid_t), intent(in) :: grid
      deflection_accuracy = 2.2e-5_dp*(128.0_dp*max(grid%hx, grid%hy))**1.35_dp
   end function deflection_accuracy

   !> Weaken shear thinning on all grids, as if the stress of the law were 1/fraction times as large
   subroutine soften(self, fraction)
      class(hierarchy_t), intent(inout) :: self
      real(dp), intent(in) :: fraction
      integer :: k

      do k = 1, size(self%levels)
         if (allocated(self%levels(k)%p)) call self%levels(k)%flow%soften(fraction)
      end do
   end subroutine soften

   !> Reset the data, other than the fields of the finest level, that a cycle passes to the next one
   subroutine forget(self)
      class(hierarchy_t), intent(inout) :: self
      integer :: k

      self%coarsest%factored = .false.
      do k = 1, size(self%levels)
         call self%levels(k)%flow%cached%forget()
      end do
   end subroutine forget

   !> Allocated bytes
   pure integer(int64) function bytes(self)
      class(hierarchy_t), intent(in) :: self
      integer :: k

      bytes = 0
      do k = 1, size(self%levels)
         if (.not. allocated(self%levels(k)%p)) cycle
         bytes = bytes + self%levels(k)%bytes() + self%levels(k)%engine%bytes() + self%workspaces(k)%bytes() &
                 + self%coarsenings(k)%bytes() + self%coarsest(k)%bytes()
      end do
   end function bytes

   !> The first n grids are those of full multigrid, coarsest first. Grid below(k) corrects grid k; 0: grid k is solved directly.
   pure subroutine find_coarse_grids(coarsest, n, grids, below)
      type(grid_t), intent(in) :: coarsest
      integer, intent(in) :: n
      type(grid_t), allocatable, intent(out) :: grids(:)
      integer, allocatable, intent(out) :: below(:)
      type(grid_t) :: grid
      integer :: k, step(2), same, min_columns

      allocate (grids(n), below(n))
      grids(1) = coarsest
      do k = 2, n
         grids(k) = grids(k - 1)%finer()
      end do
      below = 0
      min_columns = coarsest%nx - 1
      k = 0
      ! the loop itself extends the list
      do while (k < size(grids))
         k = k + 1
         step = next_step(grids(k), min_columns)
         if (all(step == 1)) cycle
         grid = grids(k)%coarsened(step)
         same = findloc(grids%nx == grid%nx .and. grids%ny == grid%ny, .true., dim=1)
         if (same == 0) then
            grids = [grids, grid]
            below = [below, 0]
            same = size(grids)
         end if
         below(k) = same
      end do
   end subroutine find_coarse_grids

   !> Ratio of the mesh sizes of the next coarser grid to those of this one; 1 and 1 where there is none
   pure function next_step(grid, min_columns) result(step)
      type(grid_t), intent(in) :: grid
      !> Minimum number of intervals along X
      integer, intent(in) :: min_columns
      integer :: step(2), intervals(2)
      logical :: possible(2)
      real(dp) :: ratio

      intervals = grid%intervals()
      possible = mod(intervals, 4) == 0 .and. intervals/2 >= [min_columns, min_rows]
      ratio = grid%hy/grid%hx
      step = 1
      if (possible(1) .and. (ratio > long_y .or. grid%is_row())) then
         step(1) = 2
      else if (ratio < 1.0_dp/long_x .and. possible(2)) then
         step(2) = 2
      else if (all(possible)) then
         step = 2
      else if (possible(2) .and. (grid%nx - 2)*(grid%ny - 1) > max_unknowns) then
         step(2) = 2
      end if
   end function next_step
end module ehl_hierarchy

! SPDX-License-Identifier: BSD-3-Clause
!> First approximation of a contact whose dry pressure has no formula: that pressure on a grid, by conjugate gradients on the
!> nodes that touch (Polonsky & Keer 1999, Wear 231, 206), with the load as a constraint and an active set
module ehl_dry_start
   use ehl_cycle, only: refine
   use ehl_grid, only: grid_t
   use ehl_kinds, only: dp
   use ehl_level, only: level_t
   use ehl_reynolds, only: refresh
   implicit none (type, external)
   private
   public :: dry_start_t

   !> The dry pressure of the last level, shape (nx, ny)
   type :: dry_start_t
      private
      real(dp), allocatable :: p(:, :)
   contains
      procedure :: begin
      procedure :: mend_ends
   end type dry_start_t

   !> Relative change of the pressure that ends the iteration, and most iterations
   real(dp), parameter :: tolerance = 1.0e-5_dp
   integer, parameter :: max_iterations = 300
   !> Rows at an end of the bodies that take the pressure of a finer dry contact
   integer, parameter :: end_rows = 6

contains

   !> On the first level: pressure and H00 are those of the dry contact
   subroutine begin(self, level)
      class(dry_start_t), intent(inout) :: self
      type(level_t), intent(inout) :: level

      call solve_dry(level)
      self%p = level%p
   end subroutine begin

   !> On a finer level: where the bodies end the pressure of a coarser grid falls off over its wider cells, and the film below
   !> it is negative. Rows there take what the dry pressure changes with the grid.
   subroutine mend_ends(self, coarse, level)
      class(dry_start_t), intent(inout) :: self
      type(grid_t), intent(in) :: coarse
      !> Its first approximation by the coarser level
      type(level_t), intent(inout) :: level
      real(dp), dimension(level%grid%nx, level%grid%ny) :: p, before
      real(dp) :: h00
      integer :: j

      call refine(self%p, coarse, before)
      if (.not. presses_at_ends(level%grid, before)) then
         self%p = max(0.0_dp, before)
         return
      end if
      p = level%p
      h00 = level%h00
      level%p = max(0.0_dp, before)
      call solve_dry(level)
      self%p = level%p
      do j = level%grid%first_inner(), level%grid%last_inner()
         if (within(level%grid, j, end_rows)) p(:, j) = max(0.0_dp, p(:, j) + self%p(:, j) - before(:, j))
      end do
      level%p = p
      level%h00 = h00
      call refresh(level)
   end subroutine mend_ends

   !> Whether a pressure reaches the ends, or the rows next to those that would take it
   pure logical function presses_at_ends(grid, p)
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: p(:, :)
      integer :: j

      presses_at_ends = .false.
      do j = grid%first_inner(), grid%last_inner()
         if (within(grid, j, 2*end_rows)) presses_at_ends = presses_at_ends .or. any(p(:, j) > 0.0_dp)
      end do
   end function presses_at_ends

   !> Whether row j is one of the last few before an end of the bodies
   pure logical function within(grid, j, rows)
      type(grid_t), intent(in) :: grid
      integer, intent(in) :: j, rows
      within = grid%ny - j <= rows .or. (.not. grid%mirror .and. j <= rows)
   end function within

   !> Pressure of the dry contact, and H00; load and gap (film_rhs) of the level are known
   subroutine solve_dry(level)
      type(level_t), intent(inout) :: level
      real(dp), dimension(level%grid%nx, level%grid%ny) :: r, t, k_t, before
      logical, dimension(level%grid%nx, level%grid%ny) :: touches
      real(dp) :: weight(level%grid%ny), square, square_before, keep, step
      integer :: n, j

      weight = [(level%grid%weight(j), j=1, level%grid%ny)]
      associate (p => level%p, nx => level%grid%nx, first => level%grid%first_inner(), last => level%grid%last_inner())
         p(1, :) = 0.0_dp
         p(nx, :) = 0.0_dp
         if (first > 1) p(:, 1) = 0.0_dp
         p(:, last + 1:) = 0.0_dp
         p = p*level%load/total(p)
         t = 0.0_dp
         keep = 0.0_dp
         square_before = 1.0_dp
         do n = 1, max_iterations
            before = p
            touches = p > 0.0_dp
            call level%engine%apply(p, r)
            r = r + level%film_rhs
            r = r - mean(r)
            square = total(merge(r**2, 0.0_dp, touches))
            t = merge(r + keep*square/square_before*t, 0.0_dp, touches)
            square_before = square
            call level%engine%apply(t, k_t)
            k_t = k_t - mean(k_t)
            step = total(r*t)/total(k_t*t)
            p = merge(max(0.0_dp, p - step*t), 0.0_dp, touches)
            ! nodes that overlap though they have no pressure
            touches = .not. p > 0.0_dp .and. r < 0.0_dp
            touches([1, nx], :) = .false.
            touches(:, :first - 1) = .false.
            touches(:, last + 1:) = .false.
            keep = merge(0.0_dp, 1.0_dp, any(touches))
            p = merge(-step*r, p, touches)
            p = p*level%load/total(p)
            if (total(abs(p - before)) <= tolerance*level%load) exit
         end do
         touches = p > 0.0_dp
         call level%engine%apply(p, r)
         r = r + level%film_rhs
         level%h00 = -mean(r)
      end associate

   contains

      !> Sum over the whole contact
      real(dp) function total(values)
         real(dp), intent(in) :: values(:, :)
         total = sum(sum(values, dim=1)*weight)
      end function total

      !> Mean over the nodes that touch
      real(dp) function mean(values)
         real(dp), intent(in) :: values(:, :)
         mean = total(merge(values, 0.0_dp, touches))/total(merge(1.0_dp, 0.0_dp, touches))
      end function mean
   end subroutine solve_dry
end module ehl_dry_start

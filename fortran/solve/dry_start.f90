! SPDX-License-Identifier: BSD-3-Clause
!> First approximation of a contact whose dry pressure has no formula: conjugate gradients on the nodes in contact, an active
!> set, with the load as a constraint (Polonsky & Keer 1999, Wear 231, 206)
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
      procedure :: correct_ends
   end type dry_start_t

   !> Relative change of the pressure that ends the iteration; maximum number of iterations
   real(dp), parameter :: tolerance = 1.0e-5_dp
   integer, parameter :: max_iterations = 300
   !> Rows at an end of the bodies whose pressure is corrected by the dry contact on the finer grid
   integer, parameter :: end_rows = 6

contains

   !> Set pressure and H00 of the first level to those of the dry contact
   subroutine begin(self, level)
      class(dry_start_t), intent(inout) :: self
      type(level_t), intent(inout) :: level

      call solve_dry(level)
      self%p = level%p
   end subroutine begin

   !> Correct the pressure at the ends of the bodies on a finer level: the coarse pressure decreases over wider cells, which would
   !> give a negative film. Add the difference of the dry pressures of both grids there, unless the ends are unloaded.
   subroutine correct_ends(self, coarse, level)
      class(dry_start_t), intent(inout) :: self
      type(grid_t), intent(in) :: coarse
      !> Holds the prolongation from the coarser level
      type(level_t), intent(inout) :: level
      real(dp), dimension(level%grid%nx, level%grid%ny) :: p, before
      real(dp) :: h00
      integer :: j

      call refine(self%p, coarse, before)
      if (.not. loads_ends(level%grid, before)) then
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
   end subroutine correct_ends

   !> Whether the pressure is positive within twice the corrected rows of an end
   pure logical function loads_ends(grid, p)
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: p(:, :)
      integer :: j

      loads_ends = .false.
      do j = grid%first_inner(), grid%last_inner()
         if (within(grid, j, 2*end_rows)) loads_ends = loads_ends .or. any(p(:, j) > 0.0_dp)
      end do
   end function loads_ends

   !> Whether row j is at most `rows` from an end of the bodies
   pure logical function within(grid, j, rows)
      type(grid_t), intent(in) :: grid
      integer, intent(in) :: j, rows
      within = grid%ny - j <= rows .or. (.not. grid%mirror .and. j <= rows)
   end function within

   !> Pressure and H00 of the dry contact for the load and the gap (film_rhs) of the level
   subroutine solve_dry(level)
      type(level_t), intent(inout) :: level
      real(dp), dimension(level%grid%nx, level%grid%ny) :: r, t, k_t, before
      logical, dimension(level%grid%nx, level%grid%ny) :: in_contact
      real(dp) :: weight(level%grid%ny), square, square_before, conjugate, step
      integer :: n, j

      weight = [(level%grid%weight(j), j=1, level%grid%ny)]
      associate (p => level%p, nx => level%grid%nx, first => level%grid%first_inner(), last => level%grid%last_inner())
         p(1, :) = 0.0_dp
         p(nx, :) = 0.0_dp
         if (first > 1) p(:, 1) = 0.0_dp
         p(:, last + 1:) = 0.0_dp
         p = p*level%load/total(p)
         t = 0.0_dp
         conjugate = 0.0_dp
         square_before = 1.0_dp
         do n = 1, max_iterations
            before = p
            in_contact = p > 0.0_dp
            call level%engine%apply(p, r)
            r = r + level%film_rhs
            r = r - mean(r)
            square = total(merge(r**2, 0.0_dp, in_contact))
            t = merge(r + conjugate*square/square_before*t, 0.0_dp, in_contact)
            square_before = square
            call level%engine%apply(t, k_t)
            k_t = k_t - mean(k_t)
            step = total(r*t)/total(k_t*t)
            p = merge(max(0.0_dp, p - step*t), 0.0_dp, in_contact)
            ! unloaded nodes where the surfaces overlap
            in_contact = .not. p > 0.0_dp .and. r < 0.0_dp
            in_contact([1, nx], :) = .false.
            in_contact(:, :first - 1) = .false.
            in_contact(:, last + 1:) = .false.
            conjugate = merge(0.0_dp, 1.0_dp, any(in_contact))
            p = merge(-step*r, p, in_contact)
            p = p*level%load/total(p)
            if (total(abs(p - before)) <= tolerance*level%load) exit
         end do
         in_contact = p > 0.0_dp
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

      !> Mean over the nodes in contact
      real(dp) function mean(values)
         real(dp), intent(in) :: values(:, :)
         mean = total(merge(values, 0.0_dp, in_contact))/total(merge(1.0_dp, 0.0_dp, in_contact))
      end function mean
   end subroutine solve_dry
end module ehl_dry_start

! SPDX-License-Identifier: BSD-3-Clause
!> A uniform grid over the contact: whole, folded at the symmetry line Y = 0, or a strip that is periodic along Y, whole or folded
!> at Y = 0 and at half its width. A single row is a strip without variation along Y.
module ehl_grid
   use ehl_kinds, only: dp
   implicit none (type, external)
   private
   public :: grid_t, new_grid, new_strip, find_levels, max_coarsest, long_x

   !> Numbers of intervals of the shorter side of the coarsest grid: the minimum that halving leaves, and the maximum
   integer, parameter :: min_coarsest = 16, max_coarsest = 32

   !> Grids with hx/hy above this are coarsened along Y alone if possible (ehl_hierarchy)
   real(dp), parameter :: long_x = 1.6_dp

   !> Uniform node-centred grid; fields on it are real(dp) arrays of shape (nx, ny), X first.
   !> Lengths are dimensionless, scaled by the Hertz radius a.
   type :: grid_t
      !> Stored nodes in X and in Y
      integer :: nx = 0, ny = 0
      !> Coordinates of node (1, 1)
      real(dp) :: x0 = 0.0_dp, y0 = 0.0_dp
      !> Mesh sizes
      real(dp) :: hx = 0.0_dp, hy = 0.0_dp
      !> Folded: only Y >= 0 is stored, row 1 lies on Y = 0, and Y < 0 is the mirror image
      logical :: mirror = .false.
      !> Strip, periodic along Y: row ny is followed by row 1, or on a folded strip by row ny - 1; integrals are means over Y
      logical :: periodic = .false.
      !> The bodies (of a roller) end at the border rows, where there is no film
      logical :: ends = .false.
   contains
      procedure :: x => x_of
      procedure :: y => y_of
      procedure :: columns
      procedure :: coarser
      procedure :: coarsened
      procedure :: intervals
      procedure :: finer
      procedure :: weight
      procedure :: cell
      procedure :: south
      procedure :: north
      procedure :: first_inner
      procedure :: last_inner
      procedure :: inner_rows
      procedure :: is_row
      procedure :: images
      procedure :: is_border
      procedure :: full_ny
      procedure :: rows_below
      procedure :: stored_row
      procedure :: unfold
   end type grid_t

contains

   !> Grid of nx x ny nodes over [x_inlet, x_outlet] x [-y_extent, y_extent];
   !> with mirror only the (ny+1)/2 rows with Y >= 0 are stored
   pure function new_grid(nx, ny, x_inlet, x_outlet, y_extent, mirror) result(grid)
      integer, intent(in) :: nx, ny
      real(dp), intent(in) :: x_inlet, x_outlet, y_extent
      logical, intent(in) :: mirror
      type(grid_t) :: grid

      grid%nx = nx
      grid%hx = (x_outlet - x_inlet)/(nx - 1)
      grid%hy = 2.0_dp*y_extent/(ny - 1)
      grid%x0 = x_inlet
      grid%mirror = mirror
      if (mirror) then
         grid%ny = (ny + 1)/2
         grid%y0 = 0.0_dp
      else
         grid%ny = ny
         grid%y0 = -y_extent
      end if
   end function new_grid

   !> Grid of nx x ny nodes over a strip of this width, periodic along Y, with a row at Y = 0; one row has square cells. With
   !> mirror ny is even, and only the ny/2 + 1 rows from Y = 0 to half the width are stored.
   pure function new_strip(nx, ny, x_inlet, x_outlet, width, mirror) result(grid)
      integer, intent(in) :: nx, ny
      real(dp), intent(in) :: x_inlet, x_outlet, width
      logical, intent(in), optional :: mirror
      type(grid_t) :: grid

      grid%nx = nx
      grid%ny = ny
      grid%x0 = x_inlet
      grid%hx = (x_outlet - x_inlet)/(nx - 1)
      grid%hy = grid%hx
      if (ny > 1) grid%hy = width/ny
      grid%y0 = -(ny/2)*grid%hy
      grid%periodic = .true.
      if (present(mirror)) grid%mirror = mirror .and. ny > 1
      if (.not. grid%mirror) return
      grid%ny = ny/2 + 1
      grid%y0 = 0.0_dp
   end function new_strip

   !> Number of levels of a grid of nx x ny nodes, and intervals of the sides of the coarsest one; 0 levels if a side has fewer than
   !> 3 nodes, or if halving the intervals does not lead to even numbers of which the smaller is at most `max_coarsest`
   pure subroutine find_levels(nx, ny, levels, intervals)
      integer, intent(in) :: nx, ny
      integer, intent(out) :: levels, intervals(2)

      intervals = [nx, ny] - 1
      levels = 1
      do while (all(mod(intervals, 4) == 0) .and. minval(intervals) >= 2*min_coarsest)
         intervals = intervals/2
         levels = levels + 1
      end do
      if (minval(intervals) > max_coarsest .or. any(mod(intervals, 2) /= 0) .or. min(nx, ny) < 3) levels = 0
   end subroutine find_levels

   !> X of column i
   elemental real(dp) function x_of(self, i)
      class(grid_t), intent(in) :: self
      integer, intent(in) :: i
      x_of = self%x0 + (i - 1)*self%hx
   end function x_of

   !> Y of row j
   elemental real(dp) function y_of(self, j)
      class(grid_t), intent(in) :: self
      integer, intent(in) :: j
      y_of = self%y0 + (j - 1)*self%hy
   end function y_of

   !> X of all columns
   pure function columns(self) result(x)
      class(grid_t), intent(in) :: self
      real(dp) :: x(self%nx)
      integer :: i
      x = self%x([(i, i=1, self%nx)])
   end function columns

   !> The grid of every second node
   pure function coarser(self) result(grid)
      class(grid_t), intent(in) :: self
      type(grid_t) :: grid

      grid = self%coarsened([2, 2])
   end function coarser

   !> The grid of every step-th node along X and along Y, steps of 1 or 2
   pure function coarsened(self, step) result(grid)
      class(grid_t), intent(in) :: self
      integer, intent(in) :: step(2)
      type(grid_t) :: grid

      if (self%periodic) then
         grid = strip_like(self, (self%nx - 1)/step(1) + 1, max(1, self%full_ny()/step(2)), step(1)*self%hx)
         return
      end if
      grid = grid_t((self%nx - 1)/step(1) + 1, (self%ny - 1)/step(2) + 1, self%x0, self%y0, step(1)*self%hx, step(2)*self%hy, &
                    self%mirror, ends=self%ends)
   end function coarsened

   !> A strip over the domain of another one; ny: rows of the whole strip
   pure function strip_like(other, nx, ny, hx) result(grid)
      class(grid_t), intent(in) :: other
      integer, intent(in) :: nx, ny
      real(dp), intent(in) :: hx
      type(grid_t) :: grid

      grid = grid_t(nx, ny, other%x0, other%y0, hx, other%hy*other%full_ny()/ny, other%mirror, periodic=.true.)
      if (other%mirror) grid%ny = ny/2 + 1
      if (ny == 1) grid%hy = hx
   end function strip_like

   !> Intervals along X and along Y of the whole domain
   pure function intervals(self)
      class(grid_t), intent(in) :: self
      integer :: intervals(2)
      intervals = [self%nx - 1, self%full_ny() - merge(0, 1, self%periodic)]
   end function intervals

   !> The grid of half the mesh size
   pure function finer(self) result(grid)
      class(grid_t), intent(in) :: self
      type(grid_t) :: grid

      if (self%periodic) then
         grid = strip_like(self, 2*self%nx - 1, merge(1, 2*self%full_ny(), self%ny == 1), 0.5_dp*self%hx)
         return
      end if
      grid = grid_t(2*self%nx - 1, 2*self%ny - 1, self%x0, self%y0, 0.5_dp*self%hx, 0.5_dp*self%hy, self%mirror, &
                    ends=self%ends)
   end function finer

   !> Area weight of a node of row j in a sum over the whole contact:
   !> hx*hy, twice that for rows that have a mirror image; on a strip for a mean over Y
   elemental real(dp) function weight(self, j)
      class(grid_t), intent(in) :: self
      integer, intent(in) :: j
      weight = self%hx*self%hy
      if (self%periodic) weight = self%hx/self%full_ny()
      weight = self%images(j)*weight
   end function weight

   !> Area of a node's cell in row j; half of it in the rows where a grid is folded
   elemental real(dp) function cell(self, j)
      class(grid_t), intent(in) :: self
      integer, intent(in) :: j
      cell = self%hx*self%hy
      if (self%mirror .and. self%images(j) == 1) cell = 0.5_dp*cell
   end function cell

   !> The row below row j: row 0 is row 2 of a folded grid, and the last row of a whole strip
   elemental integer function south(self, j)
      class(grid_t), intent(in) :: self
      integer, intent(in) :: j
      south = merge(merge(self%ny, 2, self%periodic .and. .not. self%mirror), j - 1, j == 1)
   end function south

   !> The row above row j: row ny + 1 is row 1 of a whole strip, row ny - 1 of a folded one
   elemental integer function north(self, j)
      class(grid_t), intent(in) :: self
      integer, intent(in) :: j
      north = merge(merge(self%ny - 1, 1, self%mirror), j + 1, self%periodic .and. j == self%ny)
   end function north

   !> Number of rows of the whole domain that row j represents
   elemental integer function images(self, j)
      class(grid_t), intent(in) :: self
      integer, intent(in) :: j
      images = merge(2, 1, self%mirror .and. j > 1 .and. .not. (self%periodic .and. j == self%ny))
   end function images

   !> First row that is not a border row
   pure integer function first_inner(self)
      class(grid_t), intent(in) :: self
      first_inner = merge(1, 2, self%mirror .or. self%periodic)
   end function first_inner

   !> Last row that is not a border row
   pure integer function last_inner(self)
      class(grid_t), intent(in) :: self
      last_inner = merge(self%ny, self%ny - 1, self%periodic)
   end function last_inner

   !> Whether the grid is a single row
   pure logical function is_row(self)
      class(grid_t), intent(in) :: self
      is_row = self%ny == 1
   end function is_row

   !> Number of rows of the whole domain that are not border rows
   pure integer function inner_rows(self)
      class(grid_t), intent(in) :: self
      inner_rows = self%full_ny() - merge(0, 2, self%periodic)
   end function inner_rows

   !> Whether row j is a border row, where P is given
   elemental logical function is_border(self, j)
      class(grid_t), intent(in) :: self
      integer, intent(in) :: j
      is_border = j < self%first_inner() .or. j > self%last_inner()
   end function is_border

   !> Rows of the unfolded grid
   pure integer function full_ny(self)
      class(grid_t), intent(in) :: self
      full_ny = merge(2*self%ny - merge(2, 1, self%periodic), self%ny, self%mirror)
   end function full_ny

   !> Rows of the unfolded grid below the first stored one
   pure integer function rows_below(self)
      class(grid_t), intent(in) :: self
      rows_below = merge(self%ny - 1, 0, self%mirror)
   end function rows_below

   !> Index of the stored row for row j, which may be outside the grid; j itself if there is none
   elemental integer function stored_row(self, j)
      class(grid_t), intent(in) :: self
      integer, intent(in) :: j
      stored_row = j
      if (self%periodic) then
         stored_row = modulo(j - 1, self%full_ny())
         if (self%mirror) stored_row = min(stored_row, self%full_ny() - stored_row)
         stored_row = stored_row + 1
      else if (self%mirror .and. j < 1) then
         stored_row = 2 - j
      end if
   end function stored_row

   !> Expand a stored field to the whole domain, values(nx, full_ny)
   pure subroutine unfold(self, stored, values)
      class(grid_t), intent(in) :: self
      real(dp), intent(in) :: stored(:, :)
      real(dp), intent(out) :: values(:, :)
      integer :: j, row

      do j = 1, self%full_ny()
         row = self%stored_row(j - self%rows_below())
         values(:, j) = stored(:, row)
      end do
   end subroutine unfold
end module ehl_grid

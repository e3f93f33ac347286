! SPDX-License-Identifier: BSD-3-Clause
!> Operator-dependent transfer between a grid and the next coarser one (Alcouffe, Brandt, Dendy &
!> Painter 1981; in the black-box form of Dendy 1982): a correction is interpolated so that the
!> flux, not the slope, is continuous. Restriction is the transpose of interpolation.
module ehl_alcouffe
   use, intrinsic :: iso_fortran_env, only: int64
   use ehl_grid, only: grid_t
   use ehl_kinds, only: dp
   use ehl_nine_point, only: nine_point_t
   use ehl_status, only: ehl_no_memory, status_t
   implicit none (type, external)
   private
   public :: transfer_t

   !> Weights of interpolation. A fine node between two coarse nodes is interpolated from these two, a fine node at the
   !> centre of a coarse cell from its four corners. Nodes that are not free are excluded.
   type :: transfer_t
      !> Coarse columns and rows, and rows of fine nodes between coarse rows: ny - 1, but ny on a whole strip, whose last coarse
      !> row is followed by the first one
      integer :: nx = 0, ny = 0, between = 0
      !> Weights of the left and the right coarse node for the node between coarse (i, j) and (i+1, j)
      real(dp), allocatable :: along_x(:, :, :)
      !> Weights of the lower and the upper coarse node for the node between coarse (i, j) and (i, j+1)
      real(dp), allocatable :: along_y(:, :, :)
      !> Weights of the south-west, south-east, north-west and north-east coarse node for the node at the centre of the coarse
      !> cell between (i, j) and (i+1, j+1)
      real(dp), allocatable :: centre(:, :, :)
      !> 1 where a coarse node is free, else 0
      real(dp), allocatable :: free(:, :)
      integer :: threads = 1
      logical :: parallel = .false.
   contains
      procedure :: setup
      procedure :: find_weights
      procedure :: restrict_row
      procedure :: prolong_row
      procedure :: north
      procedure :: south
      procedure :: bytes
   end type transfer_t

contains

   !> Allocate the weights; threads: number of OpenMP threads, used if `parallel`
   subroutine setup(self, coarse, threads, parallel, status)
      class(transfer_t), intent(inout) :: self
      type(grid_t), intent(in) :: coarse
      integer, intent(in) :: threads
      logical, intent(in) :: parallel
      type(status_t), intent(inout) :: status
      integer :: stat

      if (status%failed()) return
      self%nx = coarse%nx
      self%ny = coarse%ny
      self%between = merge(coarse%ny, coarse%ny - 1, coarse%periodic .and. .not. coarse%mirror)
      self%threads = threads
      self%parallel = parallel
      associate (nx => coarse%nx, ny => coarse%ny)
         allocate (self%along_x(2, nx - 1, ny), self%along_y(2, nx, self%between), self%centre(4, nx - 1, self%between), &
                   self%free(nx, ny), source=0.0_dp, stat=stat)
      end associate
      if (stat /= 0) call status%fail(ehl_no_memory, "no memory for the grid transfer")
   end subroutine setup

   !> The row above a coarse row j
   elemental integer function north(self, j)
      class(transfer_t), intent(in) :: self
      integer, intent(in) :: j
      north = modulo(j, max(self%ny, 1)) + 1
   end function north

   !> The row below a coarse row j; 0 below the first row unless the grid is a whole strip
   elemental integer function south(self, j)
      class(transfer_t), intent(in) :: self
      integer, intent(in) :: j
      south = merge(self%ny, j - 1, j == 1 .and. self%between == self%ny)
   end function south

   !> Weights for the operator of the fine grid: each coupling over the sum of all couplings and the excess; couplings to nodes
   !> that are not free count in the sum only. Between two coarse nodes the correction is taken as constant across their edge, so
   !> that couplings across it count only to nodes that are not free. No differences are formed: where one coupling is much
   !> larger than the others, rounding errors would spoil the weights.
   subroutine find_weights(self, a, free, dependent)
      class(transfer_t), intent(inout) :: self
      type(nine_point_t), intent(in) :: a
      !> Fine nodes that may change: 1, else 0. Border nodes are not free.
      real(dp), intent(in) :: free(:, :)
      !> 1 at fine nodes with operator-dependent interpolation, 0 where interpolation is bilinear
      real(dp), intent(in) :: dependent(:, :)
      integer :: i, j

      !$omp parallel do default(none) shared(self, a, free, dependent) private(i) &
      !$omp num_threads(self%threads) if(self%parallel) schedule(static)
      do j = 1, self%ny
         do i = 1, self%nx
            self%free(i, j) = free(2*i - 1, 2*j - 1)
         end do
         do i = 1, self%nx - 1
            self%along_x(:, i, j) = weights_x(2*i, 2*j - 1)
         end do
         if (j > self%between) cycle
         do i = 1, self%nx
            self%along_y(:, i, j) = weights_y(2*i - 1, 2*j)
         end do
      end do
      !$omp end parallel do
      !$omp parallel do default(none) shared(self, a, free, dependent) private(i) &
      !$omp num_threads(self%threads) if(self%parallel) schedule(static)
      do j = 1, self%between
         do i = 1, self%nx - 1
            self%centre(:, i, j) = weights_centre(i, j)
         end do
      end do
      !$omp end parallel do

   contains

      !> A fine node between two coarse ones in X: the correction is taken as constant in Y
      pure function weights_x(i, j) result(w)
         integer, intent(in) :: i, j
         real(dp) :: w(2), rest
         integer :: below

         w = 0.0_dp
         if (free(i, j) <= 0.0_dp) return
         if (dependent(i, j) > 0.0_dp) then
            w = [a%east(i - 1, j) + a%north_west(i, j), a%east(i, j) + a%north_east(i, j)]
            rest = a%excess(i, j) + a%north(i, j)*(1.0_dp - free(i, a%grid%north(j)))
            if (a%has_below(j)) then
               below = a%grid%south(j)
               w = w + [a%north_east(i - 1, below), a%north_west(i + 1, below)]
               rest = rest + a%north(i, below)*(1.0_dp - free(i, below))
            end if
            w = w/(w(1) + w(2) + rest)
         else
            w = 0.5_dp
         end if
         w = w*[free(i - 1, j), free(i + 1, j)]
      end function weights_x

      !> A fine node between two coarse ones in Y: the correction is taken as constant in X
      pure function weights_y(i, j) result(w)
         integer, intent(in) :: i, j
         real(dp) :: w(2), rest

         w = 0.0_dp
         if (free(i, j) <= 0.0_dp) return
         if (dependent(i, j) > 0.0_dp) then
            w = [a%north(i, j - 1) + a%north_east(i - 1, j - 1) + a%north_west(i + 1, j - 1), &
                 a%north(i, j) + a%north_east(i, j) + a%north_west(i, j)]
            rest = a%excess(i, j) + a%east(i, j)*(1.0_dp - free(i + 1, j)) + a%east(i - 1, j)*(1.0_dp - free(i - 1, j))
            w = w/(w(1) + w(2) + rest)
         else
            w = 0.5_dp
         end if
         w = w*[free(i, j - 1), free(i, a%grid%north(j))]
      end function weights_y

      !> A fine node at the centre of a coarse cell, from its own equation
      pure function weights_centre(ic, jc) result(w)
         integer, intent(in) :: ic, jc
         real(dp) :: w(4)
         integer :: i, j, above, next

         w = 0.0_dp
         i = 2*ic
         j = 2*jc
         above = a%grid%north(j)
         next = self%north(jc)
         if (free(i, j) <= 0.0_dp) return
         if (dependent(i, j) > 0.0_dp) then
            w = [a%north_east(i - 1, j - 1), a%north_west(i + 1, j - 1), a%north_west(i, j), a%north_east(i, j)] &
                *[free(i - 1, j - 1), free(i + 1, j - 1), free(i - 1, above), free(i + 1, above)]
            w(1:2) = w(1:2) + a%north(i, j - 1)*self%along_x(:, ic, jc)
            w(3:4) = w(3:4) + a%north(i, j)*self%along_x(:, ic, next)
            w([1, 3]) = w([1, 3]) + a%east(i - 1, j)*self%along_y(:, ic, jc)
            w([2, 4]) = w([2, 4]) + a%east(i, j)*self%along_y(:, ic + 1, jc)
            w = w/a%diagonal(i, j)
         else
            w = 0.25_dp*[free(i - 1, j - 1), free(i + 1, j - 1), free(i - 1, above), free(i + 1, above)]
         end if
      end function weights_centre
   end subroutine find_weights

   !> Row j of the transpose of interpolation applied to fine values, in coarse columns 2 to nx-1;
   !> j is not a border row
   pure subroutine restrict_row(self, fine, j, values, half_cells)
      class(transfer_t), intent(in) :: self
      !> Shape of the fine grid
      real(dp), intent(in) :: fine(:, :)
      integer, intent(in) :: j
      !> Shape (nx)
      real(dp), intent(inout) :: values(:)
      !> Factor of the values of the first and the last fine row of a folded grid, which have half cells; absent: the values
      !> include it
      real(dp), intent(in), optional :: half_cells
      real(dp) :: own
      integer :: i, k, l, below, south

      l = 2*j - 1
      south = self%south(j)
      below = 2*south
      own = 1.0_dp
      if (present(half_cells) .and. (l == 1 .or. l == size(fine, 2))) own = half_cells
      do i = 2, self%nx - 1
         k = 2*i - 1
         values(i) = self%free(i, j)*(own*fine(k, l)) &
                     + self%along_x(1, i, j)*(own*fine(k + 1, l)) + self%along_x(2, i - 1, j)*(own*fine(k - 1, l))
         if (j <= self%between) values(i) = values(i) + self%along_y(1, i, j)*fine(k, l + 1) &
                                            + self%centre(1, i, j)*fine(k + 1, l + 1) &
                                            + self%centre(2, i - 1, j)*fine(k - 1, l + 1)
         if (south > 0) values(i) = values(i) + self%along_y(2, i, south)*fine(k, below) &
                                    + self%centre(3, i, south)*fine(k + 1, below) &
                                    + self%centre(4, i - 1, south)*fine(k - 1, below)
      end do
   end subroutine restrict_row

   !> Fine row j of a coarse correction
   pure subroutine prolong_row(self, coarse, j, values)
      class(transfer_t), intent(in) :: self
      !> Shape (nx, ny), zero where nodes are not free
      real(dp), intent(in) :: coarse(:, :)
      integer, intent(in) :: j
      !> Shape (2 nx - 1)
      real(dp), intent(out) :: values(:)
      integer :: i, l, next

      l = (j + 1)/2
      next = self%north(l)
      if (mod(j, 2) == 1) then
         values(1) = self%free(1, l)*coarse(1, l)
         do i = 1, self%nx - 1
            values(2*i) = self%along_x(1, i, l)*coarse(i, l) + self%along_x(2, i, l)*coarse(i + 1, l)
            values(2*i + 1) = self%free(i + 1, l)*coarse(i + 1, l)
         end do
      else
         values(1) = self%along_y(1, 1, l)*coarse(1, l) + self%along_y(2, 1, l)*coarse(1, next)
         do i = 1, self%nx - 1
            values(2*i) = self%centre(1, i, l)*coarse(i, l) + self%centre(2, i, l)*coarse(i + 1, l) &
                          + self%centre(3, i, l)*coarse(i, next) + self%centre(4, i, l)*coarse(i + 1, next)
            values(2*i + 1) = self%along_y(1, i + 1, l)*coarse(i + 1, l) + self%along_y(2, i + 1, l)*coarse(i + 1, next)
         end do
      end if
   end subroutine prolong_row

   !> Allocated bytes
   pure integer(int64) function bytes(self)
      class(transfer_t), intent(in) :: self
      bytes = 0
      if (allocated(self%free)) bytes = 8*(size(self%along_x, kind=int64) + size(self%along_y, kind=int64) &
                                           + size(self%centre, kind=int64) + size(self%free, kind=int64))
   end function bytes
end module ehl_alcouffe

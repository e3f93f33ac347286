! SPDX-License-Identifier: BSD-3-Clause
!> Multilevel multi-integration, from fine to coarse: the grids, and the anterpolation of sources to the next coarser grid.
!>
!> Nodes are numbered from 0. Grids extend beyond the domain by the number of nodes that transfers
!> need to keep their order at the border. On a folded grid row -j is row j. A stage that
!> is coarsened along X stores even and odd columns of its sources separately, so that loops are contiguous.
! Rows are passed by their first element
! allow(assumed-size)
module ehl_mlmi_down
   use, intrinsic :: iso_fortran_env, only: int64
   use ehl_kinds, only: dp
   use ehl_status, only: status_t, ehl_no_memory
   use ehl_row_loops, only: add_pairs, add_row_pairs
   !$ use omp_lib, only: omp_get_thread_num
   implicit none (type, external)
   private
   public :: descend, no_memory, rows_near, sources_near, stage_t, stored_row, take

   !> Message if an allocation fails
   character(len=*), parameter :: no_memory = "no memory for the mlmi deflection"
   !> Maximum number of pairs of rows in a transfer
   integer, parameter :: max_pairs = 16
   !> Larger than any node number: marks the first and the last source of a row without sources
   integer, parameter :: nowhere = 2**29

   !> One grid and, unless it is the coarsest, the coarsening to the next
   type :: stage_t
      !> Axis that is coarsened next: 1 X, 2 Y, 0 on the coarsest grid
      integer :: axis = 0
      logical :: mirror = .false.
      !> Node ranges (X, Y) of this grid and of the next, nodes beyond the domain included
      integer :: low(2) = 0, high(2) = 0, coarse_low(2) = 0, coarse_high(2) = 0
      !> Number of zero columns at both ends of a row of sources
      integer :: margin = 0
      !> Sources: columns low(1)-margin:high(1)+margin, or even and odd columns separately,
      !> coarse_low(1)-margin:coarse_high(1)+margin, column 2i in even(i) and 2i+1 in odd(i).
      !> Row high(2)+1 is zero and represents all rows outside.
      real(dp), allocatable :: source(:, :), even(:, :), odd(:, :)
      !> Columns of the first and the last source in each row
      integer, allocatable :: first(:), last(:)
      !> Deflection on the next grid; on the coarsest grid its kernel (offset X, offset Y)
      real(dp), allocatable :: coarse(:, :)
   contains
      procedure :: halve
      procedure :: reserve_sources
      procedure :: bytes
   end type stage_t

contains

   !> Set up the grid low:high, coarsened along an axis with 2t-point transfers;
   !> correction_reach: maximum distance at which a source corrects the deflection of a node, along the axis in nodes of the next
   !> grid, across it in nodes of this one
   subroutine halve(self, low, high, axis, mirror, t, correction_reach, status)
      class(stage_t), intent(inout) :: self
      integer, intent(in) :: low(2), high(2), axis, t, correction_reach
      logical, intent(in) :: mirror
      type(status_t), intent(inout) :: status
      integer :: stat

      self%axis = axis
      self%mirror = mirror
      self%low = low
      self%high = high
      self%coarse_low = low
      self%coarse_high = high
      ! the outermost odd nodes are interpolated from 2t nodes of the next grid
      self%coarse_low(axis) = min(-shifta(-low(axis), 1), &
                                  (low(axis) + 1 - modulo(low(axis), 2) - (2*t - 1))/2)
      self%coarse_high(axis) = max(shifta(high(axis), 1), &
                                   (high(axis) - 1 + modulo(high(axis), 2) + 2*t - 1)/2)
      if (axis == 2 .and. mirror) self%coarse_low(2) = 0
      self%margin = max(t, correction_reach) + 2
      call reserve_sources(self, stat)
      if (stat == 0) allocate (self%coarse(self%coarse_low(1):self%coarse_high(1), &
                                           self%coarse_low(2):self%coarse_high(2)), stat=stat)
      if (stat /= 0) call status%fail(ehl_no_memory, no_memory)
   end subroutine halve

   !> Allocate the sources, all zero
   subroutine reserve_sources(self, stat)
      class(stage_t), intent(inout) :: self
      integer, intent(out) :: stat
      integer :: left, right, below, above

      below = self%low(2)
      above = self%high(2) + 1
      if (self%axis == 1) then
         left = self%coarse_low(1) - self%margin
         right = self%coarse_high(1) + self%margin
         allocate (self%even(left:right, below:above), stat=stat)
         if (stat == 0) allocate (self%odd(left:right, below:above), stat=stat)
         if (stat /= 0) return
         self%even = 0.0_dp
         self%odd = 0.0_dp
      else
         left = self%low(1) - self%margin
         right = self%high(1) + self%margin
         allocate (self%source(left:right, below:above), stat=stat)
         if (stat /= 0) return
         self%source = 0.0_dp
      end if
      allocate (self%first(below:above), stat=stat)
      if (stat == 0) allocate (self%last(below:above), stat=stat)
      if (stat /= 0) return
      self%first = nowhere
      self%last = -nowhere
   end subroutine reserve_sources

   !> Allocated bytes
   pure integer(int64) function bytes(self)
      class(stage_t), intent(in) :: self

      bytes = 0
      if (allocated(self%source)) bytes = bytes + 8*size(self%source, kind=int64)
      if (allocated(self%even)) bytes = bytes + 16*size(self%even, kind=int64)
      if (allocated(self%coarse)) bytes = bytes + 8*size(self%coarse, kind=int64)
      if (allocated(self%first)) bytes = bytes + 8*size(self%first, kind=int64)
   end function bytes

   !> Set the sources of the finest grid to the pressure p (nx, ny)
   subroutine take(stage, threads, p, work)
      type(stage_t), intent(inout) :: stage
      integer, intent(in) :: threads
      real(dp), intent(in) :: p(0:stage%high(1), 0:stage%high(2))
      real(dp), intent(inout) :: work(:, :, :)
      integer :: j, first, last, n, me

      n = stage%high(1) + 1
      !$omp parallel num_threads(threads) default(none) private(j, first, last, me) &
      !$omp shared(n, stage, p, work)
      me = 1
      !$ me = omp_get_thread_num() + 1
      !$omp do schedule(dynamic, 8)
      do j = 0, stage%high(2)
         call find_sources(p(:, j), first, last)
         if (stage%axis == 1 .and. mod(n, 2) == 1 .and. &
             max(last, stage%last(j)) == n - 1) then
            ! the last, even column has no odd neighbour
            work(1:n, 1, me) = p(:, j)
            work(n + 1, 1, me) = 0.0_dp
            call put(stage, j, first, last, 0, work(:, 1, me))
         else
            call put(stage, j, first, last, 0, p(:, j))
         end if
      end do
      !$omp end do
      !$omp end parallel
   end subroutine take

   !> First and last element that is not zero (a NaN counts as nonzero); `nowhere` if there is none
   pure subroutine find_sources(a, first, last)
      real(dp), contiguous, intent(in) :: a(0:)
      integer, intent(out) :: first, last

      do first = 0, size(a) - 1
         if (.not. abs(a(first)) <= 0.0_dp) exit
      end do
      do last = size(a) - 1, first, -1
         if (.not. abs(a(last)) <= 0.0_dp) return
      end do
      first = nowhere
      last = -nowhere
   end subroutine find_sources

   !> Compute the sources of the next coarser grid
   subroutine descend(fine, coarse, omega, threads, work)
      type(stage_t), intent(in) :: fine
      type(stage_t), intent(inout) :: coarse
      real(dp), intent(in) :: omega(:)
      integer, intent(in) :: threads
      real(dp), intent(inout) :: work(:, :, :)
      integer :: j, me

      !$omp parallel num_threads(threads) default(none) private(j, me) &
      !$omp shared(fine, coarse, omega, work)
      me = 1
      !$ me = omp_get_thread_num() + 1
      !$omp do schedule(dynamic, 8)
      do j = coarse%low(2), coarse%high(2)
         if (fine%axis == 1) then
            call descend_row_x(fine, coarse, j, omega, work(:, 1, me))
         else
            call descend_row_y(fine, coarse, j, omega, work(:, 1, me))
         end if
      end do
      !$omp end do
      !$omp end parallel
   end subroutine descend

   !> Anterpolate one row of sources along X
   subroutine descend_row_x(fine, coarse, j, omega, sums)
      type(stage_t), intent(in) :: fine
      type(stage_t), intent(inout) :: coarse
      integer, intent(in) :: j
      real(dp), intent(in) :: omega(:)
      real(dp), intent(inout) :: sums(*)
      integer :: t, first, last, a, b, column

      t = size(omega)
      first = nowhere
      last = -nowhere
      if (fine%first(j) <= fine%last(j)) then
         first = max(shifta(fine%first(j), 1) - (t - 1), fine%coarse_low(1))
         last = min(shifta(fine%last(j), 1) + t, fine%coarse_high(1))
      end if
      call columns_to_write(coarse, j, first, last, a, b)
      if (a > b) return
      column = a - (fine%coarse_low(1) - fine%margin) + 1
      sums(1:b - a + 1) = fine%even(a:b, j)
      call add_pairs(b - a + 1, t, omega, fine%odd(:, j), column, column - 1, sums)
      call put(coarse, j, first, last, a, sums)
   end subroutine descend_row_x

   !> Anterpolate to one row of sources along Y
   subroutine descend_row_y(fine, coarse, j, omega, sums)
      type(stage_t), intent(in) :: fine
      type(stage_t), intent(inout) :: coarse
      integer, intent(in) :: j
      real(dp), intent(in) :: omega(:)
      real(dp), intent(inout) :: sums(*)
      integer :: t, first, last, a, b, count
      integer :: upper(max_pairs), lower(max_pairs), place(max_pairs)
      real(dp) :: c(max_pairs)

      t = size(omega)
      call sources_near(fine, 2*j, 2*t - 1, first, last)
      call columns_to_write(coarse, j, first, last, a, b)
      if (a > b) return
      call rows_near(fine, 2*j, 1, t, a, count, upper, lower, place)
      sums(1:b - a + 1) = fine%source(a:b, stored_row(fine, 2*j))
      c(:count) = omega(place(:count))
      call add_row_pairs(b - a + 1, count, c, fine%source, upper, lower, sums)
      call put(coarse, j, first, last, a, sums)
   end subroutine descend_row_y

   !> Range a..b, from an even to an odd column, of the new sources first..last and the old sources of row j; a > b if there
   !> are none
   pure subroutine columns_to_write(stage, j, first, last, a, b)
      type(stage_t), intent(in) :: stage
      integer, intent(in) :: j, first, last
      integer, intent(out) :: a, b

      a = min(first, stage%first(j))
      b = max(last, stage%last(j))
      if (a > b) return
      a = 2*shifta(a, 1)
      b = 2*shifta(b, 1) + 1
   end subroutine columns_to_write

   !> Index at which row j is stored
   pure integer function stored_row(stage, j)
      type(stage_t), intent(in) :: stage
      integer, intent(in) :: j

      stored_row = j
      if (stage%mirror) stored_row = abs(j)
      if (stored_row < stage%low(2)) stored_row = stage%high(2) + 1
      stored_row = min(stored_row, stage%high(2) + 1)
   end function stored_row

   !> Columns of the first and the last source in rows j - reach .. j + reach
   pure subroutine sources_near(stage, j, reach, first, last)
      type(stage_t), intent(in) :: stage
      integer, intent(in) :: j, reach
      integer, intent(out) :: first, last
      integer :: k

      first = nowhere
      last = -nowhere
      ! rows outside have no sources; mirror images have those of the rows j + 1 .. j + reach
      do k = max(j - reach, stage%low(2)), min(j + reach, stage%high(2))
         first = min(first, stage%first(k))
         last = max(last, stage%last(k))
      end do
   end subroutine sources_near

   !> Pairs of rows at distances start, start + 2, ... from row j, as offsets of column a - 1
   !> in the array of sources. Pairs without sources are omitted; `place` contains the indices of the
   !> others. Row j itself is paired with the zero row.
   pure subroutine rows_near(stage, j, start, pairs, a, count, upper, lower, place)
      type(stage_t), intent(in) :: stage
      integer, intent(in) :: j, start, pairs, a
      integer, intent(out) :: count
      integer, intent(inout) :: upper(:), lower(:), place(:)
      integer :: k, width, column, above, below

      width = size(stage%source, 1)
      column = a - (stage%low(1) - stage%margin)
      count = 0
      do k = 1, pairs
         above = stored_row(stage, j + start + 2*(k - 1))
         below = stored_row(stage, j - start - 2*(k - 1))
         if (start == 0 .and. k == 1) below = stage%high(2) + 1
         if (stage%first(above) > stage%last(above) &
             .and. stage%first(below) > stage%last(below)) cycle
         count = count + 1
         upper(count) = (above - stage%low(2))*width + column
         lower(count) = (below - stage%low(2))*width + column
         place(count) = k
      end do
   end subroutine rows_near

   !> Store row j of the sources, which are zero outside first..last; row(k) belongs
   !> to column start - 1 + k. The old sources are overwritten, so `row` must include
   !> their columns too, from an even to an odd one.
   subroutine put(stage, j, first, last, start, row)
      type(stage_t), intent(inout) :: stage
      integer, intent(in) :: j, first, last, start
      real(dp), intent(in) :: row(*)
      integer :: a, b, i

      a = min(first, stage%first(j))
      b = max(last, stage%last(j))
      stage%first(j) = first
      stage%last(j) = last
      if (a > b) return
      if (stage%axis == 1) then
         a = shifta(a, 1)
         b = shifta(b, 1)
         do i = a, b
            stage%even(i, j) = row(2*i - start + 1)
            stage%odd(i, j) = row(2*i - start + 2)
         end do
      else
         stage%source(a:b, j) = row(a - start + 1:b - start + 1)
      end if
   end subroutine put
end module ehl_mlmi_down

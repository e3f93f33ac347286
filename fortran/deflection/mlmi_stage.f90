! SPDX-License-Identifier: BSD-3-Clause
!> One grid of multilevel multi-integration and the step to the next coarser one
!>
!> Nodes are numbered from 0. Grids reach beyond the domain by as many nodes as the transfers
!> need to keep their order at the border. On a folded grid row -j is row j. A stage that
!> halves X keeps its sources split into even and odd columns, so that loops are contiguous.
! Rows are passed by their first element
! allow(assumed-size)
module ehl_mlmi_stage
   use, intrinsic :: iso_fortran_env, only: int64
   use ehl_kinds, only: dp
   use ehl_status, only: status_t, ehl_no_memory
   use ehl_kernel, only: kernel_coefficient
   use ehl_mlmi_stencil, only: stencil_t
   use ehl_mlmi_rows, only: split
   implicit none (type, external)
   private
   public :: stage_t, stored_row, sources_near, rows_near, put, nowhere

   !> No grid has a node this far out: first and last of a row without sources
   integer, parameter :: nowhere = 2**29

   !> One grid and, unless it is the coarsest, the step to the next
   type :: stage_t
      !> Axis that is halved next: 1 X, 2 Y, 0 on the coarsest grid
      integer :: axis = 0
      logical :: mirror = .false.
      !> Node ranges (X, Y) of this grid and of the next, nodes beyond the domain included
      integer :: low(2) = 0, high(2) = 0, coarse_low(2) = 0, coarse_high(2) = 0
      !> Zero columns kept at both ends of a row of sources
      integer :: margin = 0
      !> Local corrections of the halving
      type(stencil_t) :: stencil
      !> Sources: columns low(1)-margin:high(1)+margin, or even and odd columns for themselves,
      !> coarse_low(1)-margin:coarse_high(1)+margin, column 2i in even(i) and 2i+1 in odd(i).
      !> Row high(2)+1 is empty and stands for all rows outside.
      real(dp), allocatable :: source(:, :), even(:, :), odd(:, :)
      !> Columns of the first and the last source in each row
      integer, allocatable :: first(:), last(:)
      !> Deflection on the next grid; on the coarsest grid its kernel (offset X, offset Y)
      real(dp), allocatable :: coarse(:, :)
   contains
      procedure :: halve
      procedure :: finish
      procedure :: bytes
   end type stage_t

contains

   !> Make this the grid low:high, halved along an axis with 2t-point transfers and the
   !> stencil that has been made; sources beyond the grid need not be foreseen
   subroutine halve(self, low, high, axis, mirror, t, status)
      class(stage_t), intent(inout) :: self
      integer, intent(in) :: low(2), high(2), axis, t
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
      self%margin = max(t, self%stencil%length()/2 + 1, self%stencil%width) + 2
      call reserve_sources(self, stat)
      if (stat == 0) allocate (self%coarse(self%coarse_low(1):self%coarse_high(1), &
                                           self%coarse_low(2):self%coarse_high(2)), stat=stat)
      if (stat /= 0) call status%fail(ehl_no_memory, "no memory for the mlmi deflection")
   end subroutine halve

   !> Make this the coarsest grid low:high, of every step-th node
   subroutine finish(self, low, high, mirror, step, factor, hx, hy, status)
      class(stage_t), intent(inout) :: self
      integer, intent(in) :: low(2), high(2), step(2)
      logical, intent(in) :: mirror
      real(dp), intent(in) :: factor, hx, hy
      type(status_t), intent(inout) :: status
      integer :: i, j, width, height, stat

      self%axis = 0
      self%mirror = mirror
      self%low = low
      self%high = high
      self%margin = 8
      width = high(1) - low(1) + self%margin
      height = merge(2*high(2), high(2) - low(2), mirror)
      call reserve_sources(self, stat)
      if (stat == 0) allocate (self%coarse(-width:width, 0:height), stat=stat)
      if (stat /= 0) then
         call status%fail(ehl_no_memory, "no memory for the mlmi deflection")
         return
      end if
      do j = 0, height
         do i = 0, width
            self%coarse(i, j) = kernel_coefficient(factor, step(1)*i, step(2)*j, hx, hy)
            self%coarse(-i, j) = self%coarse(i, j)
         end do
      end do
   end subroutine finish

   !> Sources, all zero
   subroutine reserve_sources(self, stat)
      type(stage_t), intent(inout) :: self
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

   !> Where row j is stored
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
      ! rows outside have no sources, mirror images the same as the rows j + 1 .. j + reach
      do k = max(j - reach, stage%low(2)), min(j + reach, stage%high(2))
         first = min(first, stage%first(k))
         last = max(last, stage%last(k))
      end do
   end subroutine sources_near

   !> Pairs of rows at distances start, start + 2, ... from row j, as offsets of column a - 1
   !> in the array of sources. Pairs without sources are left out; place says which of the
   !> pairs are there. Row j has no partner.
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

   !> Store row j of the sources, of which those outside first..last are zero; row(k) belongs
   !> to column start - 1 + k. What the row held before is overwritten, so row must hold the
   !> columns of the old sources too, from an even to an odd one.
   subroutine put(stage, j, first, last, start, row)
      type(stage_t), intent(inout) :: stage
      integer, intent(in) :: j, first, last, start
      real(dp), intent(in) :: row(*)
      integer :: a, b

      a = min(first, stage%first(j))
      b = max(last, stage%last(j))
      stage%first(j) = first
      stage%last(j) = last
      if (a > b) return
      if (stage%axis == 1) then
         a = shifta(a, 1)
         b = shifta(b, 1)
         call split(b - a + 1, row(2*a - start + 1), stage%even(a, j), stage%odd(a, j))
      else
         stage%source(a:b, j) = row(a - start + 1:b - start + 1)
      end if
   end subroutine put
end module ehl_mlmi_stage

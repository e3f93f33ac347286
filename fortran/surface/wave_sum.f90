! SPDX-License-Identifier: BSD-3-Clause
!> Film and pressure waves of a rough tile at the points of a contact: the inner loop of the prediction.
!>
!> Driven waves move with the tile; free waves are interpolated in a finer table, at positions that follow from the
!> slip, the same for all lines or per line. The first dimension of a tile and of a sum: loss of film and pressure increase.
module ehl_wave_sum
   use, intrinsic :: iso_fortran_env, only: int32, real32, real64
   implicit none (type, external)
   private
   public :: add_driven, add_between, add_free, add_polynomials, moved_film

contains

   !> Add the sum over s of weight(s, i) tile(:, columns(j), rows(i) - shift, s) to total(:, j, i); rows are periodic, rows and
   !> columns start at 0
   subroutine add_driven(tile, rows, columns, weight, shift, total)
      real(real32), intent(in), contiguous :: tile(:, 0:, 0:, :), weight(:, :)
      integer(int32), intent(in), contiguous :: rows(:), columns(:)
      integer(int32), intent(in) :: shift
      real(real32), intent(inout), contiguous :: total(:, :, :)
      integer :: i, j, s, row

      do i = 1, size(rows)
         row = modulo(rows(i) - shift, size(tile, 3))
         do s = 1, size(weight, 1)
            if (.not. abs(weight(s, i)) > 0.0) cycle
            do j = 1, size(columns)
               total(1:2, j, i) = total(1:2, j, i) + weight(s, i)*tile(1:2, columns(j), row, s)
            end do
         end do
      end do
   end subroutine add_driven

   !> Add tiles interpolated between rows low(i) and low(i) + 1; between: fraction of the distance
   subroutine add_between(tile, low, columns, between, weight, total)
      real(real32), intent(in), contiguous :: tile(:, 0:, 0:, :), between(:), weight(:, :)
      integer(int32), intent(in), contiguous :: low(:), columns(:)
      real(real32), intent(inout), contiguous :: total(:, :, :)
      real(real32) :: here, there
      integer :: i, j, s, row, next

      do i = 1, size(low)
         row = modulo(low(i), size(tile, 3))
         next = modulo(row + 1, size(tile, 3))
         do s = 1, size(weight, 1)
            if (.not. abs(weight(s, i)) > 0.0) cycle
            there = weight(s, i)*between(i)
            here = weight(s, i) - there
            do j = 1, size(columns)
               total(1:2, j, i) = total(1:2, j, i) + here*tile(1:2, columns(j), row, s) + there*tile(1:2, columns(j), next, s)
            end do
         end do
      end do
   end subroutine add_between

   !> Add tiles interpolated between row low(j, i) - shift and the next; a first dimension of 1 of low and between: the
   !> same for all lines. beside(:, j, :) is added to the sum over the stations, and the result is multiplied by `expansion`
   subroutine add_free(tile, beside, low, columns, between, weight, expansion, shift, total)
      real(real32), intent(in), contiguous :: tile(:, 0:, 0:, :), beside(:, :, 0:)
      real(real32), intent(in), contiguous :: between(:, :), weight(:, :), expansion(:, :)
      integer(int32), intent(in), contiguous :: low(:, :), columns(:)
      integer(int32), intent(in) :: shift
      real(real32), intent(inout), contiguous :: total(:, :, :)
      integer :: i, j, k, at, row, next, start, first, last
      real(real32) :: here(2), there(2)

      start = modulo(shift, size(tile, 3))
      do i = 1, size(low, 2)
         ! a position has nonzero weights only of the adjacent stations
         first = findloc(abs(weight(:, i)) > 0.0, .true., 1)
         last = findloc(abs(weight(:, i)) > 0.0, .true., 1, back=.true.)
         do j = 1, size(columns)
            at = merge(j, 1, size(low, 1) > 1)
            row = wrapped(low(at, i) - start, size(tile, 3))
            next = merge(0, row + 1, row + 1 == size(tile, 3))
            here = beside(1:2, j, row)
            there = beside(1:2, j, next)
            do k = max(1, first), last
               here = here + weight(k, i)*tile(1:2, columns(j), row, k)
               there = there + weight(k, i)*tile(1:2, columns(j), next, k)
            end do
            total(1:2, j, i) = total(1:2, j, i) + expansion(j, i)*(here + between(at, i)*(there - here))
         end do
      end do
   end subroutine add_free

   !> Row modulo the number of rows; without a division for a row from -count to count - 1
   pure integer function wrapped(row, count)
      integer, intent(in) :: row, count

      wrapped = row
      if (wrapped < 0) wrapped = wrapped + count
      if (wrapped < 0 .or. wrapped >= count) wrapped = modulo(wrapped, count)
   end function wrapped

   !> Add sum over k of coefficients(k) polynomials(i, k) to total(2, place(i)); places start at 0
   subroutine add_polynomials(polynomials, coefficients, place, total)
      real(real32), intent(in), contiguous :: polynomials(:, :), coefficients(:)
      integer(int32), intent(in), contiguous :: place(:)
      real(real32), intent(inout), contiguous :: total(:, 0:)
      ! number of points per block, whose sums stay in the cache
      integer, parameter :: block = 1024
      real(real32) :: found(block)
      integer :: first, n, i, k

      do first = 0, size(place) - 1, block
         n = min(block, size(place) - first)
         found(:n) = 0.0
         do k = 1, size(coefficients)
            found(:n) = found(:n) + coefficients(k)*polynomials(first + 1:first + n, k)
         end do
         do i = 1, n
            total(2, place(first + i)) = total(2, place(first + i)) + found(i)
         end do
      end do
   end subroutine add_polynomials

   !> Film of the smooth contact, smooth(y, x) at the nodes, with its edge moved outwards: film(place(p)), counted from 0, is the
   !> smooth film at the point x(p), y(p) after a displacement towards the centre by the fraction weight(1, p) moved(edge(p)) +
   !> weight(2, p) moved(edge(p) + 1) of its distance from it. Coordinates are in nodes from the first one; `moved` is periodic.
   subroutine moved_film(smooth, centre, x, y, edge, weight, moved, place, film)
      real(real64), intent(in), contiguous :: smooth(0:, 0:), centre(:), x(:), y(:), weight(:, :), moved(0:)
      integer(int32), intent(in), contiguous :: edge(:), place(:)
      real(real64), intent(inout), contiguous :: film(0:)
      real(real64) :: factor, u, v
      integer :: p, i, j

      do p = 1, size(place)
         factor = 1.0_real64 - (weight(1, p)*moved(edge(p)) + weight(2, p)*moved(modulo(edge(p) + 1, size(moved))))
         u = centre(1) + factor*(x(p) - centre(1))
         v = centre(2) + factor*(y(p) - centre(2))
         i = max(0, min(int(u), size(smooth, 2) - 2))
         j = max(0, min(int(v), size(smooth, 1) - 2))
         u = max(0.0_real64, min(u - i, 1.0_real64))
         v = max(0.0_real64, min(v - j, 1.0_real64))
         film(place(p)) = (1.0_real64 - v)*((1.0_real64 - u)*smooth(j, i) + u*smooth(j, i + 1)) &
                          + v*((1.0_real64 - u)*smooth(j + 1, i) + u*smooth(j + 1, i + 1))
      end do
   end subroutine moved_film
end module ehl_wave_sum

! SPDX-License-Identifier: BSD-3-Clause
!> Film and pressure waves of a rough tile at the points of a contact: the inner loop of the prediction.
!>
!> Driven waves move with the tile; free waves are interpolated in a finer table, at positions that follow from the
!> slip, the same for all lines or per line. The first dimension of a tile and of a sum: loss of film and pressure increase.
module ehl_wave_sum
   use, intrinsic :: iso_fortran_env, only: int32, real32, real64
   implicit none (type, external)
   private
   public :: add_driven, add_between, add_free, add_at_places, add_second_order, sum_polynomials, moved_film, film_and_pressure
   public :: keep_loads, to_tile

contains

   !> Add the sum over s of weight(s, i) tile(:, columns(j), rows(i) - shift, s) to total(:, j, i), for j from span(1, i) to
   !> span(2, i), as below; rows are periodic, rows and columns start at 0
   subroutine add_driven(tile, rows, columns, span, weight, shift, total)
      real(real32), intent(in), contiguous :: tile(:, 0:, 0:, :), weight(:, :)
      integer(int32), intent(in), contiguous :: rows(:), columns(:), span(:, :)
      integer(int32), intent(in) :: shift
      real(real32), intent(inout), contiguous :: total(:, :, :)
      integer :: i, s, row, first, last

      do i = 1, size(rows)
         row = modulo(rows(i) - shift, size(tile, 3))
         do s = 1, size(weight, 1)
            if (.not. abs(weight(s, i)) > 0.0) cycle
            last = span(1, i) - 1
            do while (last < span(2, i))
               first = last + 1
               last = successive(columns(:span(2, i)), first)
               call add_times(2*(last - first + 1), weight(s, i), tile(:, columns(first):columns(last), row, s), &
                              total(:, first:last, i))
            end do
         end do
      end do
   end subroutine add_driven

   !> Last of the columns that follow one another without a gap, from the `first` one
   pure integer function successive(columns, first)
      integer(int32), intent(in), contiguous :: columns(:)
      integer, intent(in) :: first

      do successive = first, size(columns) - 1
         if (columns(successive + 1) /= columns(successive) + 1) return
      end do
      successive = size(columns)
   end function successive

   !> Add a factor times n values to as many sums
   pure subroutine add_times(n, factor, values, total)
      integer, intent(in) :: n
      real(real32), intent(in) :: factor, values(n)
      real(real32), intent(inout) :: total(n)

      total = total + factor*values
   end subroutine add_times

   !> Add factors times n values of each of two rows to as many sums
   pure subroutine add_both(n, factor, values, next_factor, next_values, total)
      integer, intent(in) :: n
      real(real32), intent(in) :: factor, values(n), next_factor, next_values(n)
      real(real32), intent(inout) :: total(n)

      total = total + factor*values + next_factor*next_values
   end subroutine add_both

   !> Add tiles interpolated between rows low(i) and low(i) + 1; between: fraction of the distance
   subroutine add_between(tile, low, columns, span, between, weight, total)
      real(real32), intent(in), contiguous :: tile(:, 0:, 0:, :), between(:), weight(:, :)
      integer(int32), intent(in), contiguous :: low(:), columns(:), span(:, :)
      real(real32), intent(inout), contiguous :: total(:, :, :)
      real(real32) :: here, there
      integer :: i, s, row, next, first, last

      do i = 1, size(low)
         row = modulo(low(i), size(tile, 3))
         next = modulo(row + 1, size(tile, 3))
         do s = 1, size(weight, 1)
            if (.not. abs(weight(s, i)) > 0.0) cycle
            there = weight(s, i)*between(i)
            here = weight(s, i) - there
            last = span(1, i) - 1
            do while (last < span(2, i))
               first = last + 1
               last = successive(columns(:span(2, i)), first)
               call add_both(2*(last - first + 1), here, tile(:, columns(first):columns(last), row, s), &
                             there, tile(:, columns(first):columns(last), next, s), total(:, first:last, i))
            end do
         end do
      end do
   end subroutine add_between

   !> Add tiles interpolated between row low(j, i) - shift and the next; a first dimension of 1 of low and between: the
   !> same for all lines. beside(:, j, :) is added to the sum over the stations, and the result is multiplied by `expansion`
   subroutine add_free(tile, beside, low, columns, span, between, weight, expansion, shift, total)
      real(real32), intent(in), contiguous :: tile(:, 0:, 0:, :), beside(:, :, 0:)
      real(real32), intent(in), contiguous :: between(:, :), weight(:, :), expansion(:, :)
      integer(int32), intent(in), contiguous :: low(:, :), columns(:), span(:, :)
      integer(int32), intent(in) :: shift
      real(real32), intent(inout), contiguous :: total(:, :, :)
      integer :: i, j, k, row, next, start, first, last, from, to
      real(real32) :: here(2), there(2)

      start = modulo(shift, size(tile, 3))
      do i = 1, size(low, 2)
         ! a position has nonzero weights only of the adjacent stations
         first = max(1, findloc(abs(weight(:, i)) > 0.0, .true., 1))
         last = findloc(abs(weight(:, i)) > 0.0, .true., 1, back=.true.)
         from = span(1, i)
         to = span(2, i)
         if (size(low, 1) == 1) then
            row = wrapped(low(1, i) - start, size(tile, 3))
            next = merge(0, row + 1, row + 1 == size(tile, 3))
            call add_row(tile, beside(:, from:to, row), beside(:, from:to, next), row, next, first, last, columns(from:to), &
                         between(1, i), weight(:, i), expansion(from:to, i), total(:, from:to, i))
            cycle
         end if
         do j = from, to
            row = wrapped(low(j, i) - start, size(tile, 3))
            next = merge(0, row + 1, row + 1 == size(tile, 3))
            here = beside(1:2, j, row)
            there = beside(1:2, j, next)
            do k = first, last
               here = here + weight(k, i)*tile(1:2, columns(j), row, k)
               there = there + weight(k, i)*tile(1:2, columns(j), next, k)
            end do
            total(1:2, j, i) = total(1:2, j, i) + expansion(j, i)*(here + between(j, i)*(there - here))
         end do
      end do
   end subroutine add_free

   !> add_free for points on the same two rows of the tile, with the stations from `first` to `last`
   pure subroutine add_row(tile, beside_row, beside_next, row, next, first, last, columns, between, weight, expansion, total)
      real(real32), intent(in), contiguous :: tile(:, 0:, 0:, :), beside_row(:, :), beside_next(:, :)
      integer, intent(in) :: row, next, first, last
      integer(int32), intent(in), contiguous :: columns(:)
      real(real32), intent(in) :: between
      real(real32), intent(in), contiguous :: weight(:), expansion(:)
      real(real32), intent(inout), contiguous :: total(:, :)
      real(real32) :: here(2, size(columns)), there(2, size(columns))
      integer :: j, k, from, to

      here = beside_row
      there = beside_next
      do k = first, last
         to = 0
         do while (to < size(columns))
            from = to + 1
            to = successive(columns, from)
            call add_times(2*(to - from + 1), weight(k), tile(:, columns(from):columns(to), row, k), here(:, from:to))
            call add_times(2*(to - from + 1), weight(k), tile(:, columns(from):columns(to), next, k), there(:, from:to))
         end do
      end do
      do j = 1, size(columns)
         total(1:2, j) = total(1:2, j) + expansion(j)*(here(1:2, j) + between*(there(1:2, j) - here(1:2, j)))
      end do
   end subroutine add_row

   !> Copy waves(row, :, column), loss of film and pressure increase, to tile(:, column, row)
   subroutine to_tile(waves, tile)
      real(real32), intent(in), contiguous :: waves(:, :, :)
      real(real32), intent(out), contiguous :: tile(:, :, :)
      ! number of rows per block, which fill the lines of the cache
      integer, parameter :: block = 16
      integer :: i, j, first

      do first = 1, size(tile, 3), block
         do j = 1, size(tile, 2)
            do i = first, min(first + block - 1, size(tile, 3))
               tile(1, j, i) = waves(i, 1, j)
               tile(2, j, i) = waves(i, 2, j)
            end do
         end do
      end do
   end subroutine to_tile

   !> Row modulo the number of rows; without a division for a row from -count to count - 1
   pure integer function wrapped(row, count)
      integer, intent(in) :: row, count

      wrapped = row
      if (wrapped < 0) wrapped = wrapped + count
      if (wrapped < 0 .or. wrapped >= count) wrapped = modulo(wrapped, count)
   end function wrapped

   !> Sums over k of coefficients(k, n) polynomials(i, k): sums(i, n). Each polynomial is read once for all n.
   subroutine sum_polynomials(polynomials, coefficients, sums)
      real(real32), intent(in), contiguous :: polynomials(:, :), coefficients(:, :)
      real(real32), intent(out), contiguous :: sums(:, :)
      ! number of points per block, whose polynomials stay in the cache
      integer, parameter :: block = 1024
      integer :: first, last, k, n

      do first = 1, size(sums, 1), block
         last = min(first + block - 1, size(sums, 1))
         do n = 1, size(sums, 2)
            sums(first:last, n) = 0.0
            do k = 1, size(coefficients, 1)
               sums(first:last, n) = sums(first:last, n) + coefficients(k, n)*polynomials(first:last, k)
            end do
         end do
      end do
   end subroutine sum_polynomials

   !> Add values(i) to total(2, place(i)); places start at 0
   subroutine add_at_places(values, place, total)
      real(real32), intent(in), contiguous :: values(:)
      integer(int32), intent(in), contiguous :: place(:)
      real(real32), intent(inout), contiguous :: total(:, 0:)
      integer :: i

      do i = 1, size(place)
         total(2, place(i)) = total(2, place(i)) + values(i)
      end do
   end subroutine add_at_places

   !> Add gain(i) (p^2 - variance(i)) to the pressure increase p = total(2, j, i). Products are stored before they are added, so
   !> that each is rounded on every processor.
   subroutine add_second_order(gain, variance, span, total)
      real(real64), intent(in), contiguous :: gain(:), variance(:)
      integer(int32), intent(in), contiguous :: span(:, :)
      real(real32), intent(inout), contiguous :: total(:, :, :)
      real(real32) :: square(size(total, 2))
      real(real64) :: more(size(total, 2))
      integer :: i, j

      do i = 1, size(gain)
         do j = span(1, i), span(2, i)
            square(j) = total(2, j, i)*total(2, j, i)
         end do
         do j = span(1, i), span(2, i)
            more(j) = gain(i)*(square(j) - variance(i))
         end do
         do j = span(1, i), span(2, i)
            total(2, j, i) = real(total(2, j, i) + more(j), real32)
         end do
      end do
   end subroutine add_second_order

   !> Film and pressure at the points place(p), counted from 0, from change(1, :), the loss of film, and change(2, :), the
   !> increase of pressure. With the loss r over the smooth film the film is 1 - r + factor r^2 times the smooth one,
   !> for r > limit with r = limit; a negative limit: the smooth film minus the loss.
   !>
   !> counts: numbers of points with r > limit, with a loss that is not below `ends` smooth films, and with a pressure
   !> that is not positive. `increase`: change(2, :) at the points.
   subroutine film_and_pressure(change, place, smooth, smooth_pressure, limit, factor, ends, film, pressure, increase, counts)
      real(real32), intent(in), contiguous :: change(:, 0:)
      integer(int32), intent(in), contiguous :: place(:)
      real(real64), intent(in), contiguous :: smooth(:), smooth_pressure(:)
      real(real64), intent(in) :: limit, factor, ends
      real(real64), intent(out), contiguous :: film(:), pressure(:)
      real(real32), intent(out), contiguous :: increase(:)
      integer(int32), intent(out) :: counts(:)
      ! number of points per block
      integer, parameter :: block = 512
      ! a product is stored before it is added, as in add_second_order
      real(real64) :: loss(block), near(block), regained(block)
      integer :: first, n, i, p, beyond, ended, tensile

      beyond = 0
      ended = 0
      tensile = 0
      do first = 0, size(place) - 1, block
         n = min(block, size(place) - first)
         do i = 1, n
            p = first + i
            loss(i) = real(change(1, place(p)), real64)
            increase(p) = change(2, place(p))
         end do
         do i = 1, n
            p = first + i
            pressure(p) = smooth_pressure(p) + real(increase(p), real64)
            tensile = tensile + merge(1, 0, pressure(p) <= 0.0_real64)
            ended = ended + merge(1, 0, .not. loss(i) < ends*smooth(p))
         end do
         if (limit < 0.0_real64) then
            film(first + 1:first + n) = smooth(first + 1:first + n) - loss(:n)
            cycle
         end if
         do i = 1, n
            p = first + i
            loss(i) = loss(i)/smooth(p)
            near(i) = merge(limit, loss(i), loss(i) > limit)
            beyond = beyond + merge(1, 0, loss(i) > limit)
            regained(i) = factor*(near(i)*near(i))
         end do
         do i = 1, n
            p = first + i
            film(p) = smooth(p)*(1.0_real64 - near(i) + regained(i))
         end do
      end do
      counts = [beyond, ended, tensile]
   end subroutine film_and_pressure

   !> Set pressures that are not positive to zero, and reduce the others of each ring(p), counted from 0, so that its load, the
   !> sum over its points, is kept; lost: not possible, nothing is changed
   subroutine keep_loads(ring, pressure, lost)
      integer(int32), intent(in), contiguous :: ring(:)
      real(real64), intent(inout), contiguous :: pressure(:)
      logical, intent(out) :: lost
      real(real64), allocatable :: load(:), tension(:), share(:)
      logical, allocatable :: pulls(:)
      integer :: p

      allocate (load(0:maxval(ring)), source=0.0_real64)
      allocate (tension, share, source=load)
      allocate (pulls(0:ubound(load, 1)), source=.false.)
      do p = 1, size(ring)
         if (pressure(p) <= 0.0_real64) pulls(ring(p)) = .true.
      end do
      do p = 1, size(ring)
         if (.not. pulls(ring(p))) cycle
         load(ring(p)) = load(ring(p)) + pressure(p)
         if (pressure(p) <= 0.0_real64) tension(ring(p)) = tension(ring(p)) + pressure(p)
      end do
      lost = any(load < 0.0_real64)
      if (lost) return
      ! compression in the rest of a ring carries its load
      share = 1.0_real64
      where (load - tension > 0.0_real64) share = load/(load - tension)
      do p = 1, size(ring)
         if (pulls(ring(p))) pressure(p) = merge(0.0_real64, pressure(p)*share(ring(p)), pressure(p) <= 0.0_real64)
      end do
   end subroutine keep_loads

   !> Film of the smooth contact, smooth(y, x) at the nodes, with its edge moved outwards: film(place(p)), counted from 0, is the
   !> smooth film at the point x(p), y(p) after a displacement towards the centre by the fraction weight(1, p) moved(edge(p)) +
   !> weight(2, p) moved(edge(p) + 1) of its distance from it. Coordinates are in nodes from the first one; `moved` is periodic.
   subroutine moved_film(smooth, centre, x, y, edge, weight, moved, place, film)
      real(real64), intent(in), contiguous :: smooth(0:, 0:), centre(:), x(:), y(:), weight(:, :), moved(0:)
      integer(int32), intent(in), contiguous :: edge(:), place(:)
      real(real64), intent(inout), contiguous :: film(0:)
      real(real64) :: periodic(0:size(moved)), factor, u, v
      integer :: p, i, j

      periodic(0:size(moved) - 1) = moved
      periodic(size(moved)) = moved(0)
      do p = 1, size(place)
         factor = 1.0_real64 - (weight(1, p)*periodic(edge(p)) + weight(2, p)*periodic(edge(p) + 1))
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

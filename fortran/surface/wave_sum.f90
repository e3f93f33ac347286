! SPDX-License-Identifier: BSD-3-Clause
!> Film and pressure waves of a rough tile at the points of a contact: the inner loop of the prediction.
!>
!> Driven waves move with the tile; free waves are read between the points of a finer table, at places that
!> slip gives, along lines or line by line. A complex value is a pair: loss of film and gain of pressure.
module ehl_wave_sum
   use, intrinsic :: iso_fortran_env, only: int32, real32, real64
   implicit none (type, external)
   private
   public :: add_driven, add_free, add_beside, add_polynomials, moved_film

contains

   !> Add weight(s, i) tile(col(j), row(i) - shift, s) to total(j, i); rows wrap, columns are from 0
   subroutine add_driven(tile, rows, columns, weight, shift, total)
      complex(real32), intent(in), contiguous :: tile(0:, 0:, :)
      real(real32), intent(in) :: weight(:, :)
      integer(int32), intent(in), contiguous :: rows(:), columns(:)
      integer(int32), intent(in) :: shift
      complex(real32), intent(inout), contiguous :: total(:, :)
      integer :: i, j, s, r

      do i = 1, size(rows)
         r = modulo(rows(i) - shift, size(tile, 2))
         do s = 1, size(weight, 1)
            if (.not. abs(weight(s, i)) > 0.0) cycle
            do j = 1, size(columns)
               total(j, i) = total(j, i) + weight(s, i)*tile(columns(j), r, s)
            end do
         end do
      end do
   end subroutine add_driven

   !> The same between the rows low(j, i) - shift and the next, `between` of the way; a first dimension of 1
   !> of low and between: the same for all lines
   subroutine add_free(tile, low, columns, between, weight, shift, total)
      complex(real32), intent(in), contiguous :: tile(0:, 0:, :)
      real(real32), intent(in), contiguous :: between(:, :), weight(:, :)
      integer(int32), intent(in), contiguous :: low(:, :), columns(:)
      integer(int32), intent(in) :: shift
      complex(real32), intent(inout), contiguous :: total(:, :)
      integer :: i, j, s, r, above, lines
      complex(real32) :: below

      lines = size(low, 1)
      do i = 1, size(low, 2)
         do s = 1, size(weight, 1)
            if (.not. abs(weight(s, i)) > 0.0) cycle
            r = modulo(low(1, i) - shift, size(tile, 2))
            above = modulo(r + 1, size(tile, 2))
            do j = 1, size(columns)
               if (lines > 1) then
                  r = modulo(low(j, i) - shift, size(tile, 2))
                  above = modulo(r + 1, size(tile, 2))
               end if
               below = tile(columns(j), r, s)
               total(j, i) = total(j, i) + weight(s, i)* &
                             (below + between(merge(j, 1, lines > 1), i)*(tile(columns(j), above, s) - below))
            end do
         end do
      end do
   end subroutine add_free

   !> The same for tiles on lines beside the centre line, tile(:, :, l): column j takes part(:, j) of the tiles
   !> line(j) and line(j) + 1, from 0
   subroutine add_beside(tile, low, columns, between, line, part, shift, total)
      complex(real32), intent(in), contiguous :: tile(0:, 0:, 0:)
      real(real32), intent(in), contiguous :: between(:, :), part(:, :)
      integer(int32), intent(in), contiguous :: low(:, :), columns(:), line(:)
      integer(int32), intent(in) :: shift
      complex(real32), intent(inout), contiguous :: total(:, :)
      integer :: i, j, l, at, r, above, lines
      complex(real32) :: below

      lines = size(low, 1)
      do i = 1, size(low, 2)
         r = modulo(low(1, i) - shift, size(tile, 2))
         above = modulo(r + 1, size(tile, 2))
         do j = 1, size(columns)
            at = merge(j, 1, lines > 1)
            if (lines > 1) then
               r = modulo(low(at, i) - shift, size(tile, 2))
               above = modulo(r + 1, size(tile, 2))
            end if
            do l = 1, 2
               if (.not. abs(part(l, j)) > 0.0) cycle
               below = tile(columns(j), r, line(j) + l - 1)
               total(j, i) = total(j, i) + part(l, j)*(below + between(at, i)*(tile(columns(j), above, line(j) + l - 1) - below))
            end do
         end do
      end do
   end subroutine add_beside

   !> Sums over k of coefficients(k) polynomials(i, k) are added to the second one of the pair total(place(i)), from 0
   subroutine add_polynomials(polynomials, coefficients, place, total)
      real(real32), intent(in), contiguous :: polynomials(:, :), coefficients(:)
      integer(int32), intent(in), contiguous :: place(:)
      complex(real32), intent(inout), contiguous :: total(0:)
      ! points at a time: their sum stays in the cache
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
            total(place(first + i)) = total(place(first + i)) + cmplx(0.0, found(i), real32)
         end do
      end do
   end subroutine add_polynomials

   !> Film of the smooth contact, on nodes smooth(y, x), with its edge moved outwards: film(place(p)), from 0, is that at
   !> a point x(p), y(p) brought nearer to the centre, all in nodes from the first one. By the share of its distance
   !> share(1, p) moved(rim(p)) + share(2, p) moved(rim(p) + 1); `moved` is periodic
   subroutine moved_film(smooth, centre, x, y, rim, share, moved, place, film)
      real(real64), intent(in), contiguous :: smooth(0:, 0:), centre(:), x(:), y(:), share(:, :), moved(0:)
      integer(int32), intent(in), contiguous :: rim(:), place(:)
      real(real64), intent(inout), contiguous :: film(0:)
      real(real64) :: left, u, v
      integer :: p, i, j

      do p = 1, size(place)
         left = 1.0_real64 - (share(1, p)*moved(rim(p)) + share(2, p)*moved(modulo(rim(p) + 1, size(moved))))
         u = centre(1) + left*(x(p) - centre(1))
         v = centre(2) + left*(y(p) - centre(2))
         i = max(0, min(int(u), size(smooth, 2) - 2))
         j = max(0, min(int(v), size(smooth, 1) - 2))
         u = max(0.0_real64, min(u - i, 1.0_real64))
         v = max(0.0_real64, min(v - j, 1.0_real64))
         film(place(p)) = (1.0_real64 - v)*((1.0_real64 - u)*smooth(j, i) + u*smooth(j, i + 1)) &
                          + v*((1.0_real64 - u)*smooth(j + 1, i) + u*smooth(j + 1, i + 1))
      end do
   end subroutine moved_film
end module ehl_wave_sum

! SPDX-License-Identifier: BSD-3-Clause
!> Film and pressure waves of a rough tile at the points of a contact: the inner loop of the prediction.
!>
!> Driven waves move with the tile; free waves are read between the points of a finer table, at places that
!> slip gives, along lines or line by line. A complex value is a pair: loss of film and gain of pressure.
module ehl_wave_sum
   use, intrinsic :: iso_fortran_env, only: int32, real32
   implicit none (type, external)
   private
   public :: add_driven, add_free

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
   !> of low and between: the same for all lines. Line j has part(j) of it
   subroutine add_free(tile, low, columns, between, weight, part, shift, total)
      complex(real32), intent(in), contiguous :: tile(0:, 0:, :)
      real(real32), intent(in), contiguous :: between(:, :), weight(:, :), part(:)
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
               total(j, i) = total(j, i) + (weight(s, i)*part(j))* &
                             (below + between(merge(j, 1, lines > 1), i)*(tile(columns(j), above, s) - below))
            end do
         end do
      end do
   end subroutine add_free
end module ehl_wave_sum

! SPDX-License-Identifier: BSD-3-Clause
!> Dense systems of equations by LU factors with partial pivoting
module ehl_dense_lu
   use ehl_kinds, only: dp
   implicit none (type, external)
   private
   public :: factor, back_substitute

contains

   !> Factors of a matrix, in its place, and the row exchanges
   pure subroutine factor(a, pivot)
      real(dp), contiguous, intent(inout) :: a(:, :)
      integer, intent(out) :: pivot(:)
      real(dp) :: row(size(a, 2))
      integer :: i, j, k, n

      n = size(a, 1)
      do k = 1, n
         pivot(k) = k - 1 + maxloc(abs(a(k:n, k)), dim=1)
         if (pivot(k) /= k) then
            row = a(k, :)
            a(k, :) = a(pivot(k), :)
            a(pivot(k), :) = row
         end if
         a(k + 1:n, k) = a(k + 1:n, k)/a(k, k)
         do j = k + 1, n
            do i = k + 1, n
               a(i, j) = a(i, j) - a(i, k)*a(k, j)
            end do
         end do
      end do
   end subroutine factor

   !> Solve with the factors, in place
   pure subroutine back_substitute(a, pivot, b)
      real(dp), contiguous, intent(in) :: a(:, :)
      integer, intent(in) :: pivot(:)
      real(dp), intent(inout) :: b(:)
      real(dp) :: t
      integer :: k, n

      n = size(b)
      do k = 1, n
         t = b(pivot(k))
         b(pivot(k)) = b(k)
         b(k) = t
      end do
      do k = 1, n
         b(k + 1:) = b(k + 1:) - b(k)*a(k + 1:, k)
      end do
      do k = n, 1, -1
         b(k) = b(k)/a(k, k)
         b(:k - 1) = b(:k - 1) - b(k)*a(:k - 1, k)
      end do
   end subroutine back_substitute
end module ehl_dense_lu

! SPDX-License-Identifier: BSD-3-Clause
!> Dense linear systems by LU factorisation with partial pivoting
module ehl_dense_lu
   use ehl_kinds, only: dp
   implicit none (type, external)
   private
   public :: factor, back_substitute

contains

   !> Factor a matrix in place, and return the row exchanges. Column by column; each column is updated by the previous ones, four
   !> at a time.
   pure subroutine factor(a, pivot)
      real(dp), contiguous, intent(inout) :: a(:, :)
      integer, intent(out) :: pivot(:)
      real(dp) :: row(size(a, 2)), t
      integer :: i, j, k, m, n

      n = size(a, 1)
      do j = 1, n
         do k = 1, j - 1
            t = a(pivot(k), j)
            a(pivot(k), j) = a(k, j)
            a(k, j) = t
         end do
         do k = 1, j - 4, 4
            do m = k + 1, k + 3
               a(m, j) = a(m, j) - dot_product(a(m, k:m - 1), a(k:m - 1, j))
            end do
            do i = k + 4, n
               a(i, j) = a(i, j) - (a(i, k)*a(k, j) + a(i, k + 1)*a(k + 1, j) &
                                    + a(i, k + 2)*a(k + 2, j) + a(i, k + 3)*a(k + 3, j))
            end do
         end do
         do m = k, j - 1
            a(m + 1:n, j) = a(m + 1:n, j) - a(m + 1:n, m)*a(m, j)
         end do
         pivot(j) = j - 1 + maxloc(abs(a(j:n, j)), dim=1)
         if (pivot(j) /= j) then
            row(:j) = a(j, :j)
            a(j, :j) = a(pivot(j), :j)
            a(pivot(j), :j) = row(:j)
         end if
         a(j + 1:n, j) = a(j + 1:n, j)/a(j, j)
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

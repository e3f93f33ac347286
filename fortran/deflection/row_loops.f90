! SPDX-License-Identifier: BSD-3-Clause
!> Weighted sums of rows, the inner loops of multilevel multi-integration: they add several terms in one pass over a row, so that
!> sums stay in registers and memory access is contiguous.
! Rows are passed by their first element
! allow(assumed-size)
module ehl_row_loops
   use ehl_kinds, only: dp
   implicit none (type, external)
   private
   public :: add_centred, add_pairs, add_row_pairs, add_row_pairs_to_three, add_shifted, interpolate_and_merge

contains

   !> y(i) = y(i) + sum over k = 1..m of c(k)*(a(right+i-1 + k-1) + a(left+i-1 - (k-1))):
   !> pairs within one row at increasing distance
   pure subroutine add_pairs(n, m, c, a, right, left, y)
      integer, intent(in) :: n, m, right, left
      real(dp), intent(in) :: c(*), a(*)
      real(dp), intent(inout) :: y(n)
      integer :: i, k, r, l

      do k = 1, m - 3, 4
         r = right + k - 2
         l = left - k
         do i = 1, n
            y(i) = y(i) &
                   + (c(k)*(a(r + i) + a(l + i)) + c(k + 1)*(a(r + i + 1) + a(l + i - 1))) &
                   + (c(k + 2)*(a(r + i + 2) + a(l + i - 2)) + c(k + 3)*(a(r + i + 3) + a(l + i - 3)))
         end do
      end do
      k = 4*(m/4) + 1
      r = right + k - 2
      l = left - k
      select case (m - k)
      case (2)
         do i = 1, n
            y(i) = y(i) &
                   + (c(k)*(a(r + i) + a(l + i)) + c(k + 1)*(a(r + i + 1) + a(l + i - 1))) &
                   + c(k + 2)*(a(r + i + 2) + a(l + i - 2))
         end do
      case (1)
         do i = 1, n
            y(i) = y(i) + (c(k)*(a(r + i) + a(l + i)) + c(k + 1)*(a(r + i + 1) + a(l + i - 1)))
         end do
      case (0)
         do i = 1, n
            y(i) = y(i) + c(k)*(a(r + i) + a(l + i))
         end do
      case default
         continue
      end select
   end subroutine add_pairs

   !> y(i) = y(i) + sum over k = 1..m of c(k)*(u(upper(k)+i) + u(lower(k)+i)), where u contains many rows
   pure subroutine add_row_pairs(n, m, c, u, upper, lower, y)
      integer, intent(in) :: n, m, upper(m), lower(m)
      real(dp), intent(in) :: c(m), u(*)
      real(dp), intent(inout) :: y(n)
      integer :: i, k

      do k = 1, m - 3, 4
         associate (r => upper(k:k + 3), l => lower(k:k + 3))
            do i = 1, n
               y(i) = y(i) &
                      + (c(k)*(u(r(1) + i) + u(l(1) + i)) + c(k + 1)*(u(r(2) + i) + u(l(2) + i))) &
                      + (c(k + 2)*(u(r(3) + i) + u(l(3) + i)) + c(k + 3)*(u(r(4) + i) + u(l(4) + i)))
            end do
         end associate
      end do
      k = 4*(m/4) + 1
      if (k < m) then
         do i = 1, n
            y(i) = y(i) + (c(k)*(u(upper(k) + i) + u(lower(k) + i)) + c(k + 1)*(u(upper(k + 1) + i) + u(lower(k + 1) + i)))
         end do
         k = k + 2
      end if
      if (k == m) then
         do i = 1, n
            y(i) = y(i) + c(k)*(u(upper(k) + i) + u(lower(k) + i))
         end do
      end if
   end subroutine add_row_pairs

   !> The same sum for three rows y with weights c1, c2 and c3; for the first two
   !> only unless `three`
   pure subroutine add_row_pairs_to_three(n, m, c1, c2, c3, u, upper, lower, three, y1, y2, y3)
      integer, intent(in) :: n, m, upper(m), lower(m)
      real(dp), intent(in) :: c1(m), c2(m), c3(m), u(*)
      logical, intent(in) :: three
      real(dp), intent(inout) :: y1(n), y2(n), y3(n)
      real(dp) :: s, t
      integer :: i, k, r1, r2, l1, l2

      do k = 1, m - 1, 2
         r1 = upper(k)
         r2 = upper(k + 1)
         l1 = lower(k)
         l2 = lower(k + 1)
         if (three) then
            do i = 1, n
               s = u(r1 + i) + u(l1 + i)
               t = u(r2 + i) + u(l2 + i)
               y1(i) = y1(i) + (c1(k)*s + c1(k + 1)*t)
               y2(i) = y2(i) + (c2(k)*s + c2(k + 1)*t)
               y3(i) = y3(i) + (c3(k)*s + c3(k + 1)*t)
            end do
         else
            do i = 1, n
               s = u(r1 + i) + u(l1 + i)
               t = u(r2 + i) + u(l2 + i)
               y1(i) = y1(i) + (c1(k)*s + c1(k + 1)*t)
               y2(i) = y2(i) + (c2(k)*s + c2(k + 1)*t)
            end do
         end if
      end do
      if (mod(m, 2) == 0) return
      r1 = upper(m)
      l1 = lower(m)
      do i = 1, n
         s = u(r1 + i) + u(l1 + i)
         y1(i) = y1(i) + c1(m)*s
         y2(i) = y2(i) + c2(m)*s
      end do
      if (.not. three) return
      do i = 1, n
         y3(i) = y3(i) + c3(m)*(u(r1 + i) + u(l1 + i))
      end do
   end subroutine add_row_pairs_to_three

   !> Sum around a middle column: y(i) = y(i) + c(0)*a(middle+i-1)
   !> + sum over k = 1..m of c(k)*(a(middle+i-1 + k) + a(middle+i-1 - k))
   pure subroutine add_centred(n, m, c, a, middle, y)
      integer, intent(in) :: n, m, middle
      real(dp), intent(in) :: c(0:*), a(*)
      real(dp), intent(inout) :: y(n)
      integer :: i, s

      s = middle - 1
      select case (m)
      case (0)
         do i = 1, n
            y(i) = y(i) + c(0)*a(s + i)
         end do
      case (1)
         do i = 1, n
            y(i) = y(i) + (c(0)*a(s + i) + c(1)*(a(s + i + 1) + a(s + i - 1)))
         end do
      case (2)
         do i = 1, n
            y(i) = y(i) + (c(0)*a(s + i) + c(1)*(a(s + i + 1) + a(s + i - 1))) &
                   + c(2)*(a(s + i + 2) + a(s + i - 2))
         end do
      case default
         do i = 1, n
            y(i) = y(i) + (c(0)*a(s + i) + c(1)*(a(s + i + 1) + a(s + i - 1))) &
                   + (c(2)*(a(s + i + 2) + a(s + i - 2)) + c(3)*(a(s + i + 3) + a(s + i - 3)))
         end do
         if (m > 3) call add_pairs(n, m - 3, c(4), a, middle + 4, middle - 4, y)
      end select
   end subroutine add_centred

   !> w(i) = w(i) + sum over k = x..x_last of s(i+m - k, k-x+1) + s(i+m + k, k-x+1), with the
   !> middle (k = 0) counted once; at most three values of k
   pure subroutine add_shifted(n, m, x, x_last, stride, s, w)
      integer, intent(in) :: n, m, x, x_last, stride
      real(dp), intent(in) :: s(stride, 3)
      real(dp), intent(inout) :: w(n)
      integer :: i, k

      if (x == 0 .and. x_last == 2) then
         do i = 1, n
            w(i) = w(i) + s(i + m, 1) + ((s(i + m - 1, 2) + s(i + m + 1, 2)) &
                                         + (s(i + m - 2, 3) + s(i + m + 2, 3)))
         end do
      else if (x == 0 .and. x_last == 1) then
         do i = 1, n
            w(i) = w(i) + s(i + m, 1) + (s(i + m - 1, 2) + s(i + m + 1, 2))
         end do
      else if (x == 0) then
         do i = 1, n
            w(i) = w(i) + s(i + m, 1)
         end do
      else
         do k = x, x_last
            do i = 1, n
               w(i) = w(i) + (s(i + m - k, k - x + 1) + s(i + m + k, k - x + 1))
            end do
         end do
      end if
   end subroutine add_shifted

   !> row = even(start), odd(1), even(start + 1), odd(2), ... with the interpolation
   !> sum over k of c(k)*(even(start+i-1 + k) + even(start+i-1 - (k-1))) added to odd(i)
   pure subroutine interpolate_and_merge(n, m, c, even, start, odd, row)
      integer, intent(in) :: n, m, start
      real(dp), intent(in) :: c(m), even(*)
      real(dp), intent(inout) :: odd(n)
      real(dp), intent(out) :: row(2*n)
      integer :: i, s

      s = start - 1
      if (m < 4) then
         call add_pairs(n, m, c, even, start + 1, start, odd)
         do i = 1, n
            row(2*i - 1) = even(s + i)
            row(2*i) = odd(i)
         end do
      else
         if (m > 4) call add_pairs(n, m - 4, c(5), even, start + 5, start - 4, odd)
         do i = 1, n
            row(2*i - 1) = even(s + i)
            row(2*i) = odd(i) + (c(1)*(even(s + i + 1) + even(s + i)) &
                                 + c(2)*(even(s + i + 2) + even(s + i - 1))) &
                       + (c(3)*(even(s + i + 3) + even(s + i - 2)) &
                          + c(4)*(even(s + i + 4) + even(s + i - 3)))
         end do
      end if
   end subroutine interpolate_and_merge
end module ehl_row_loops

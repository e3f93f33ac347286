! SPDX-License-Identifier: BSD-3-Clause
!> Inner loops of multilevel multi-integration: symmetric weighted sums over rows
!>
!> All of the arithmetic of a deflection passes through here. Several terms are taken in one
!> sweep over a row, so that sums stay in registers; every loop runs over contiguous memory
!> and is vectorised by the compiler (except the ones that look for zeros).
! Rows are passed by their first element
! allow(assumed-size)
module ehl_mlmi_rows
   use ehl_kinds, only: dp
   implicit none (type, external)
   private
   public :: add_pairs, add_centred, add_row_pairs, add_row_pairs_to_three, add_taps
   public :: split, interpolate_and_merge, find_sources

contains

   !> y(i) = y(i) + sum over k = 1..m of c(k)*(a(right+i-1 + k-1) + a(left+i-1 - (k-1))):
   !> pairs within one row, ever further apart
   pure subroutine add_pairs(n, m, c, a, right, left, y)
      integer, intent(in) :: n, m, right, left
      real(dp), intent(in) :: c(*), a(*)
      real(dp), intent(inout) :: y(n)
      integer :: i, k, r, l

      k = 1
      r = right - 1
      l = left - 1
      do while (m - k >= 3)
         do i = 1, n
            y(i) = y(i) &
                   + (c(k)*(a(r + i) + a(l + i)) + c(k + 1)*(a(r + i + 1) + a(l + i - 1))) &
                   + (c(k + 2)*(a(r + i + 2) + a(l + i - 2)) &
                      + c(k + 3)*(a(r + i + 3) + a(l + i - 3)))
         end do
         k = k + 4
         r = r + 4
         l = l - 4
      end do
      select case (m - k)
      case (2)
         do i = 1, n
            y(i) = y(i) &
                   + (c(k)*(a(r + i) + a(l + i)) + c(k + 1)*(a(r + i + 1) + a(l + i - 1))) &
                   + c(k + 2)*(a(r + i + 2) + a(l + i - 2))
         end do
      case (1)
         do i = 1, n
            y(i) = y(i) &
                   + (c(k)*(a(r + i) + a(l + i)) + c(k + 1)*(a(r + i + 1) + a(l + i - 1)))
         end do
      case (0)
         do i = 1, n
            y(i) = y(i) + c(k)*(a(r + i) + a(l + i))
         end do
      case default
         continue
      end select
   end subroutine add_pairs

   !> The same around a middle: y(i) = y(i) + c(0)*a(middle+i-1)
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

   !> y(i) = sum over k = 1..m of c(k)*(u(upper(k)+i) + u(lower(k)+i)), u being many rows,
   !> added to y unless fresh
   pure subroutine add_row_pairs(n, m, c, u, upper, lower, fresh, y)
      integer, intent(in) :: n, m, upper(m), lower(m)
      real(dp), intent(in) :: c(m), u(*)
      logical, intent(in) :: fresh
      real(dp), intent(inout) :: y(n)
      integer :: i, k, r1, r2, r3, r4, l1, l2, l3, l4

      if (fresh .and. m < 4) y = 0.0_dp
      k = 1
      do while (m - k >= 3)
         r1 = upper(k)
         r2 = upper(k + 1)
         r3 = upper(k + 2)
         r4 = upper(k + 3)
         l1 = lower(k)
         l2 = lower(k + 1)
         l3 = lower(k + 2)
         l4 = lower(k + 3)
         if (fresh .and. k == 1) then
            do i = 1, n
               y(i) = (c(1)*(u(r1 + i) + u(l1 + i)) + c(2)*(u(r2 + i) + u(l2 + i))) &
                      + (c(3)*(u(r3 + i) + u(l3 + i)) + c(4)*(u(r4 + i) + u(l4 + i)))
            end do
         else
            do i = 1, n
               y(i) = y(i) &
                      + (c(k)*(u(r1 + i) + u(l1 + i)) + c(k + 1)*(u(r2 + i) + u(l2 + i))) &
                      + (c(k + 2)*(u(r3 + i) + u(l3 + i)) + c(k + 3)*(u(r4 + i) + u(l4 + i)))
            end do
         end if
         k = k + 4
      end do
      do while (k <= m)
         r1 = upper(k)
         l1 = lower(k)
         if (k < m) then
            r2 = upper(k + 1)
            l2 = lower(k + 1)
            do i = 1, n
               y(i) = y(i) &
                      + (c(k)*(u(r1 + i) + u(l1 + i)) + c(k + 1)*(u(r2 + i) + u(l2 + i)))
            end do
         else
            do i = 1, n
               y(i) = y(i) + c(k)*(u(r1 + i) + u(l1 + i))
            end do
         end if
         k = k + 2
      end do
   end subroutine add_row_pairs

   !> The same row pairs added to three rows y with weights c1, c2 and c3; to the first two
   !> only if not three
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

   !> y(i) = y(i) + sum over k = 1..8 of c(k)*a(start + i-1 - (k-1))
   pure subroutine add_taps(n, c, a, start, y)
      integer, intent(in) :: n, start
      real(dp), intent(in) :: c(8), a(*)
      real(dp), intent(inout) :: y(n)
      integer :: i, s

      s = start - 1
      do i = 1, n
         y(i) = y(i) + ((c(1)*a(s + i) + c(2)*a(s + i - 1)) &
                        + (c(3)*a(s + i - 2) + c(4)*a(s + i - 3))) &
                + ((c(5)*a(s + i - 4) + c(6)*a(s + i - 5)) &
                   + (c(7)*a(s + i - 6) + c(8)*a(s + i - 7)))
      end do
   end subroutine add_taps

   !> Every second element of a row to even, the others to odd
   pure subroutine split(n, row, even, odd)
      integer, intent(in) :: n
      real(dp), intent(in) :: row(2*n)
      real(dp), intent(out) :: even(n), odd(n)
      integer :: i

      do i = 1, n
         even(i) = row(2*i - 1)
         odd(i) = row(2*i)
      end do
   end subroutine split

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

   !> First and last element that is not zero (a NaN is not); first > last if there is none
   pure subroutine find_sources(n, a, first, last)
      integer, intent(in) :: n
      real(dp), intent(in) :: a(n)
      integer, intent(out) :: first, last
      integer, parameter :: step = 32
      integer :: i, found

      ! whole blocks without a branch, then the elements of the block that is not zero
      first = 1
      do while (first + step - 1 <= n)
         found = 0
         do i = first, first + step - 1
            found = found + merge(0, 1, abs(a(i)) <= 0.0_dp)
         end do
         if (found > 0) exit
         first = first + step
      end do
      do while (first <= n)
         if (.not. abs(a(first)) <= 0.0_dp) exit
         first = first + 1
      end do
      last = n
      do while (last - step + 1 > first)
         found = 0
         do i = last - step + 1, last
            found = found + merge(0, 1, abs(a(i)) <= 0.0_dp)
         end do
         if (found > 0) exit
         last = last - step
      end do
      do while (last > first)
         if (.not. abs(a(last)) <= 0.0_dp) exit
         last = last - 1
      end do
   end subroutine find_sources
end module ehl_mlmi_rows

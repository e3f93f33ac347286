! SPDX-License-Identifier: BSD-3-Clause
!> Influence coefficients of the elastic half-space: the deflection at a node caused by a unit
!> pressure on one cell of hx x hy (Love 1929; Venner & Lubrecht 2000, eq. 5.4). The factor k_b in front of the integral of
!> 1/r is that of the contact, whose size the lengths are scaled by.
module ehl_kernel
   use ehl_kinds, only: dp
   implicit none (type, external)
   private
   public :: kernel_coefficient, fill_kernel

   !> Cells further away than this many mesh sizes are integrated by Gauss points: the exact
   !> formula is a second difference and loses (r/h)^2 in accuracy there, the quadrature
   !> is off by less than 4e-4 (h/r)^6 = 4e-13
   real(dp), parameter :: far = 32.0_dp
   !> Three-point Gauss-Legendre rule on [-1/2, 1/2]
   real(dp), parameter :: node = 0.387298334620741688517926539978239961_dp
   real(dp), parameter :: outer = 5.0_dp/18.0_dp, inner = 8.0_dp/18.0_dp

contains

   !> The factor times the integral of 1/r over a cell of hx x hy whose centre is at
   !> (di*hx, dj*hy) from the node; even in di and in dj
   elemental real(dp) function kernel_coefficient(factor, di, dj, hx, hy)
      integer, intent(in) :: di, dj
      real(dp), intent(in) :: factor, hx, hy
      real(dp) :: x, y

      x = abs(di)*hx
      y = abs(dj)*hy
      if (is_far(x, y, hx, hy)) then
         kernel_coefficient = by_gauss(factor, x, y, hx, hy)
      else
         kernel_coefficient = by_corners(factor, x, y, hx, hy)
      end if
   end function kernel_coefficient

   !> Table of coefficients: k(1 + di, 1 + dj) belongs to the offset (di*step(1), dj*step(2)), for all that the array has
   !> room for
   pure subroutine fill_kernel(k, factor, hx, hy, step)
      real(dp), contiguous, intent(out) :: k(:, :)
      real(dp), intent(in) :: factor, hx, hy
      integer, intent(in) :: step(2)
      real(dp) :: x, y
      integer :: i, j, first_far

      do j = 1, size(k, 2)
         y = (j - 1)*step(2)*hy
         do first_far = 1, size(k, 1)
            x = (first_far - 1)*step(1)*hx
            if (is_far(x, y, hx, hy)) exit
            k(first_far, j) = by_corners(factor, x, y, hx, hy)
         end do
         ! a loop of its own, which the compiler vectorises
         do i = first_far, size(k, 1)
            x = (i - 1)*step(1)*hx
            k(i, j) = by_gauss(factor, x, y, hx, hy)
         end do
      end do
   end subroutine fill_kernel

   !> Whether a cell of hx x hy at (x, y) is integrated by Gauss points
   elemental logical function is_far(x, y, hx, hy)
      real(dp), intent(in) :: x, y, hx, hy
      is_far = x*x + y*y > (far*max(hx, hy))**2
   end function is_far

   !> The coefficient of a cell at (x, y) exactly, as the second difference of its corners
   elemental real(dp) function by_corners(factor, x, y, hx, hy)
      real(dp), intent(in) :: factor, x, y, hx, hy
      by_corners = factor*( &
                   corner(x + 0.5_dp*hx, y + 0.5_dp*hy) - corner(x - 0.5_dp*hx, y + 0.5_dp*hy) &
                   - corner(x + 0.5_dp*hx, y - 0.5_dp*hy) + corner(x - 0.5_dp*hx, y - 0.5_dp*hy))
   end function by_corners

   !> The coefficient of a cell at (x, y) by 3 x 3 Gauss points
   elemental real(dp) function by_gauss(factor, x, y, hx, hy)
      real(dp), intent(in) :: factor, x, y, hx, hy
      by_gauss = factor*hx*hy*gauss(x, y, node*hx, node*hy)
   end function by_gauss

   !> Twofold antiderivative of 1/r, odd in x and in y; x and y are never zero at a corner
   elemental real(dp) function corner(x, y)
      real(dp), intent(in) :: x, y
      corner = x*asinh(y/abs(x)) + y*asinh(x/abs(y))
   end function corner

   !> Mean of 1/r over a cell at (x, y) by 3 x 3 Gauss points at distances (gx, gy)
   elemental real(dp) function gauss(x, y, gx, gy)
      real(dp), intent(in) :: x, y, gx, gy

      gauss = inner*line(x, y, gx) + outer*(line(x, y - gy, gx) + line(x, y + gy, gx))
   end function gauss

   !> Mean of 1/r over three Gauss points on a line in x
   elemental real(dp) function line(x, y, gx)
      real(dp), intent(in) :: x, y, gx

      line = inner/sqrt(x*x + y*y) &
             + outer*(1.0_dp/sqrt((x - gx)**2 + y*y) + 1.0_dp/sqrt((x + gx)**2 + y*y))
   end function line
end module ehl_kernel

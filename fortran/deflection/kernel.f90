! SPDX-License-Identifier: BSD-3-Clause
!> Influence coefficients of the elastic half-space: the deflection at a node caused by a unit
!> pressure on one cell of hx x hy (Love 1929; Venner & Lubrecht 2000, eq. 5.4). The contact sets the factor k_b of the
!> integral of 1/r, because its size scales the lengths.
module ehl_kernel
   use ehl_grid, only: grid_t
   use ehl_kinds, only: dp
   implicit none (type, external)
   private
   public :: coefficient, fill_grid_kernel, fill_kernel, kernel_coefficient

   !> Cells further away than this many mesh sizes are integrated by Gauss quadrature: the exact
   !> formula is a second difference, whose rounding error increases as (r/h)^2, and the error of the
   !> quadrature is less than 4e-4 (h/r)^6 = 4e-13
   real(dp), parameter :: far = 32.0_dp
   !> Three-point Gauss-Legendre rule on [-1/2, 1/2]
   real(dp), parameter :: node = 0.387298334620741688517926539978239961_dp
   real(dp), parameter :: outer = 5.0_dp/18.0_dp, inner = 8.0_dp/18.0_dp

contains

   !> Deflection at a node by a unit pressure on the cell di columns and dj rows away; on a strip by that cell and its
   !> periodic images
   pure real(dp) function coefficient(grid, factor, di, dj)
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: factor
      integer, intent(in) :: di, dj

      if (grid%is_row()) then
         coefficient = row_coefficient(grid, factor, di)
      else if (grid%periodic) then
         coefficient = strip_coefficient(grid, factor, di, dj)
      else
         coefficient = kernel_coefficient(factor, di, dj, grid%hx, grid%hy)
      end if
   end function coefficient

   !> Fill the array k(1 + di, 1 + dj) with these coefficients
   pure subroutine fill_grid_kernel(grid, factor, k)
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: factor
      real(dp), contiguous, intent(out) :: k(:, :)
      real(dp) :: around(0:grid%full_ny() - 1)
      integer :: i, j

      if (grid%is_row()) then
         k = spread([(row_coefficient(grid, factor, i - 1), i=1, size(k, 1))], 2, size(k, 2))
      else if (grid%periodic) then
         do i = 1, size(k, 1)
            around = strip_column(grid, factor, i - 1)
            do j = 1, size(k, 2)
               k(i, j) = around(modulo(j - 1, grid%full_ny()))
            end do
         end do
      else
         call fill_kernel(k, factor, grid%hx, grid%hy, [1, 1])
      end if
   end subroutine fill_grid_kernel

   !> Coefficient of a strip with one row: -2 k_b int ln|X - X'| dX' over a cell; by the antiderivative for cells near the node, by
   !> three Gauss points for those far from it, where the rounding error of the antiderivative would increase as x/h
   elemental real(dp) function row_coefficient(grid, factor, di)
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: factor
      integer, intent(in) :: di
      real(dp) :: x

      associate (h => grid%hx)
         x = abs(di)*h
         if (x > far*h) then
            row_coefficient = h*(inner*log(x) + outer*(log(x - node*h) + log(x + node*h)))
         else
            row_coefficient = log_integral(x + 0.5_dp*h) - log_integral(x - 0.5_dp*h)
         end if
      end associate
      row_coefficient = -2.0_dp*factor*row_coefficient
   end function row_coefficient

   !> Coefficient of a strip with several rows
   pure real(dp) function strip_coefficient(grid, factor, di, dj)
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: factor
      integer, intent(in) :: di, dj
      real(dp) :: around(0:grid%full_ny() - 1)

      around = strip_column(grid, factor, di)
      strip_coefficient = around(modulo(dj, grid%full_ny()))
   end function strip_coefficient

   !> Coefficients of all rows of a strip by their distance: each is the sum over a cell and its periodic images; the sum of all
   !> rows is row_coefficient, which fixes their mean. Far images are summed by the Euler-Maclaurin formula in its midpoint form:
   !> sum f(m) = int f dm + f'/24, where the integral and f' begin midway between two images. Terms that are constant over the rows
   !> are omitted.
   pure function strip_column(grid, factor, di) result(around)
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: factor
      integer, intent(in) :: di
      real(dp) :: around(0:grid%full_ny() - 1)
      !> Number of images on each side that are summed one by one
      integer, parameter :: images = 4
      real(dp) :: x, y, u, width, tail
      integer :: j, m, near, side

      associate (hx => grid%hx, hy => grid%hy, rows => grid%full_ny())
         width = rows*hy
         x = abs(di)*hx
         do j = 0, rows - 1
            ! the nearest image, so that both sides are equal to the bit
            near = min(j, rows - j)
            y = near*hy
            around(j) = 0.0_dp
            do m = -images, images
               around(j) = around(j) + kernel_coefficient(factor, di, near + m*rows, hx, hy)
            end do
            tail = 0.0_dp
            do side = -1, 1, 2
               u = (images + 0.5_dp)*width + side*y
               tail = tail - log(u + hypot(x, u))/width - width*u/(24.0_dp*hypot(x, u)**3)
            end do
            around(j) = around(j) + factor*hx*hy*tail
         end do
         around = around + (row_coefficient(grid, factor, di) - sum(around))/rows
      end associate
   end function strip_column

   !> Antiderivative of ln|x|, odd in x
   elemental real(dp) function log_integral(x)
      real(dp), intent(in) :: x
      log_integral = x*(log(abs(x)) - 1.0_dp)
   end function log_integral

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

   !> Fill the array k with coefficients: k(1 + di, 1 + dj) belongs to the offset (di*step(1), dj*step(2))
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
         ! a separate loop, which the compiler vectorises
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

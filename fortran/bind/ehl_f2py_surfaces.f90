! SPDX-License-Identifier: BSD-3-Clause
!> Surfaces for Python; for the rules see ehl_f2py_solver. And the inner loop of the prediction, which Python alone asks for: film
!> and pressure waves of a rough tile at the points of a contact, in single precision.
!>
!> Driven waves move with the tile; free waves are read between the points of a finer table, at places that slip gives, along
!> lines or line by line. A complex value is a pair: loss of film and gain of pressure.
module ehl_f2py_surfaces
   use, intrinsic :: iso_c_binding, only: c_double, c_float, c_float_complex, c_int
   use ehl_fractal, only: fractal_t, make_fractal
   use ehl_handles, only: reply
   use ehl_plan_need, only: making_need
   use ehl_status, only: status_t
   use ehl_tile_filter, only: filter_heights, filter_t
   implicit none (type, external)
   private
   public :: making, fractal, filter_tile, driven_waves, free_waves

contains

   !> What it takes to make a fractal surface of so many pixels per side; empty where that is little
   subroutine making(pixels, text)
      integer(c_int), intent(in) :: pixels
      character(len=256), intent(out) :: text

      text = making_need(pixels)
   end subroutine making

   !> Heights [m] of a fractal surface, heights(ny, nx); words: the seed, 32 bits each, the lowest first
   subroutine fractal(nx, ny, heights, length_x, length_y, rms_height, hurst, rolloff_wavenumber, n, words, gaussian, &
                      stat, message)
      integer(c_int), intent(in) :: nx, ny
      real(c_double), intent(inout) :: heights(ny, nx)
      real(c_double), intent(in) :: length_x, length_y, rms_height, hurst, rolloff_wavenumber
      integer(c_int), intent(in) :: n
      integer(c_int), intent(in) :: words(n)
      integer(c_int), intent(in) :: gaussian
      integer(c_int), intent(out) :: stat
      character(len=4096), intent(out) :: message
      !f2py threadsafe
      type(status_t) :: status

      call make_fractal(fractal_t(length_x, length_y, rms_height, hurst, rolloff_wavenumber, words, gaussian /= 0), &
                        heights, status)
      call reply(status, stat, message)
   end subroutine fractal

   !> Cut the spectrum of the heights of a periodic tile, heights(nx, ny), at a shortest and a longest
   !> wavelength; 0: not
   subroutine filter_tile(nx, ny, heights, length_x, length_y, shortest, longest, gaussian, stat, message)
      integer(c_int), intent(in) :: nx, ny
      real(c_double), intent(inout) :: heights(nx, ny)
      real(c_double), intent(in) :: length_x, length_y, shortest, longest
      integer(c_int), intent(in) :: gaussian
      integer(c_int), intent(out) :: stat
      character(len=4096), intent(out) :: message
      !f2py threadsafe
      type(status_t) :: status

      call filter_heights(filter_t(shortest, longest, gaussian /= 0), heights, length_x, length_y, status)
      call reply(status, stat, message)
   end subroutine filter_tile

   !> Add weight(s, i) tile(col(j), row(i) - shift, s) to total(j, i); rows wrap, rows and columns are from 0
   subroutine driven_waves(columns_all, points, stations, m, n, tile, rows, columns, weight, shift, total)
      integer(c_int), intent(in) :: columns_all, points, stations, m, n
      complex(c_float_complex), intent(inout) :: tile(columns_all, points, stations), total(n, m)
      real(c_float), intent(inout) :: weight(stations, m)
      integer(c_int), intent(inout) :: rows(m), columns(n)
      integer(c_int), intent(in) :: shift
      integer :: i, j, s, r
      !f2py threadsafe

      do i = 1, m
         r = modulo(rows(i) - shift, points) + 1
         do s = 1, stations
            if (.not. abs(weight(s, i)) > 0.0_c_float) cycle
            do j = 1, n
               total(j, i) = total(j, i) + weight(s, i)*tile(columns(j) + 1, r, s)
            end do
         end do
      end do
   end subroutine driven_waves

   !> The same between the rows low(j, i) - shift and the next, `between` of the way; a first dimension of 1 of low and between:
   !> the same for all lines. Line j has part(j) of it
   subroutine free_waves(columns_all, points, stations, m, n, lines, tile, low, columns, between, weight, part, shift, total)
      integer(c_int), intent(in) :: columns_all, points, stations, m, n, lines
      complex(c_float_complex), intent(inout) :: tile(columns_all, points, stations), total(n, m)
      real(c_float), intent(inout) :: weight(stations, m)
      integer(c_int), intent(inout) :: low(lines, m), columns(n)
      real(c_float), intent(inout) :: between(lines, m), part(n)
      integer(c_int), intent(in) :: shift
      integer :: i, j, s, r, above
      complex(c_float_complex) :: below
      !f2py threadsafe

      do i = 1, m
         do s = 1, stations
            if (.not. abs(weight(s, i)) > 0.0_c_float) cycle
            r = modulo(low(1, i) - shift, points)
            above = modulo(r + 1, points) + 1
            do j = 1, n
               if (lines > 1) then
                  r = modulo(low(j, i) - shift, points)
                  above = modulo(r + 1, points) + 1
               end if
               below = tile(columns(j) + 1, r + 1, s)
               total(j, i) = total(j, i) + (weight(s, i)*part(j))* &
                             (below + between(merge(j, 1, lines > 1), i)*(tile(columns(j) + 1, above, s) - below))
            end do
         end do
      end do
   end subroutine free_waves
end module ehl_f2py_surfaces

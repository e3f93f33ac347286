! SPDX-License-Identifier: BSD-3-Clause
!> Surfaces for Python; for the rules see ehl_f2py_solver
module ehl_f2py_surfaces
   use, intrinsic :: iso_c_binding, only: c_double, c_int
   use ehl_fractal, only: fractal_t, make_fractal
   use ehl_handles, only: reply
   use ehl_plan_need, only: making_need
   use ehl_status, only: status_t
   use ehl_tile_filter, only: filter_heights, filter_t
   implicit none (type, external)
   private
   public :: making, fractal, filter_tile

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
end module ehl_f2py_surfaces

! SPDX-License-Identifier: BSD-3-Clause
!> Surfaces and predicted waves for Python; for the rules see ehl_f2py_solver. Single precision is sufficient for the waves.
module ehl_f2py_surfaces
   use, intrinsic :: iso_c_binding, only: c_double, c_float, c_int
   use ehl_fractal, only: fractal_t, make_fractal
   use ehl_handles, only: reply
   use ehl_status, only: status_t
   use ehl_tile_filter, only: filter_heights, filter_t
   use ehl_wave_sum, only: add_between, add_driven, add_free, add_polynomials, moved_film
   implicit none (type, external)
   private
   public :: fractal, filter_tile, driven_waves, waves_between, free_waves, polynomials, film_moved

contains

   !> Heights [m] of a fractal surface, heights(ny, nx); words: the seed, 32 bits each, the lowest first
   subroutine fractal(nx, ny, heights, length_x, length_y, rms_height, hurst, rolloff_wavenumber, lay_ratio, n, words, &
                      gaussian, stat, message)
      integer(c_int), intent(in) :: nx, ny
      real(c_double), intent(inout) :: heights(ny, nx)
      real(c_double), intent(in) :: length_x, length_y, rms_height, hurst, rolloff_wavenumber, lay_ratio
      integer(c_int), intent(in) :: n
      integer(c_int), intent(in) :: words(n)
      integer(c_int), intent(in) :: gaussian
      integer(c_int), intent(out) :: stat
      character(len=4096), intent(out) :: message
      !f2py threadsafe
      type(status_t) :: status

      call make_fractal(fractal_t(length_x, length_y, rms_height, hurst, rolloff_wavenumber, words, gaussian /= 0, &
                                  lay_ratio), heights, status)
      call reply(status, stat, message)
   end subroutine fractal

   !> Filter the heights of a periodic tile, heights(nx, ny), at a shortest and a longest wavelength; 0: no limit
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

   !> Driven waves: see add_driven
   subroutine driven_waves(columns_all, points, stations, m, n, tile, rows, columns, weight, shift, total)
      integer(c_int), intent(in) :: points, columns_all, stations, m, n
      real(c_float), intent(inout) :: tile(2, columns_all, points, stations), total(2, n, m)
      real(c_float), intent(inout) :: weight(stations, m)
      integer(c_int), intent(inout) :: rows(m), columns(n)
      integer(c_int), intent(in) :: shift
      !f2py threadsafe

      call add_driven(tile, rows, columns, weight, shift, total)
   end subroutine driven_waves

   !> Driven waves between rows: see add_between
   subroutine waves_between(columns_all, points, stations, m, n, tile, low, columns, between, weight, total)
      integer(c_int), intent(in) :: points, columns_all, stations, m, n
      real(c_float), intent(inout) :: tile(2, columns_all, points, stations), total(2, n, m)
      real(c_float), intent(inout) :: between(m), weight(stations, m)
      integer(c_int), intent(inout) :: low(m), columns(n)
      !f2py threadsafe

      call add_between(tile, low, columns, between, weight, total)
   end subroutine waves_between

   !> Free waves: see add_free
   subroutine free_waves(columns_all, points, stations, m, n, lines, tile, beside, low, columns, between, weight, expansion, &
                         shift, total)
      integer(c_int), intent(in) :: points, columns_all, stations, m, n, lines
      real(c_float), intent(inout) :: tile(2, columns_all, points, stations), total(2, n, m)
      real(c_float), intent(inout) :: beside(2, n, points)
      integer(c_int), intent(inout) :: low(lines, m), columns(n)
      real(c_float), intent(inout) :: between(lines, m), weight(stations, m), expansion(n, m)
      integer(c_int), intent(in) :: shift
      !f2py threadsafe

      call add_free(tile, beside, low, columns, between, weight, expansion, shift, total)
   end subroutine free_waves

   !> Polynomials of the edge: see add_polynomials
   subroutine polynomials(points, count, all, values, coefficients, place, total)
      integer(c_int), intent(in) :: points, count, all
      real(c_float), intent(inout) :: values(points, count), coefficients(count)
      integer(c_int), intent(inout) :: place(points)
      real(c_float), intent(inout) :: total(2, all)
      !f2py threadsafe

      call add_polynomials(values, coefficients, place, total)
   end subroutine polynomials

   !> Film with a moved edge: see moved_film
   subroutine film_moved(nx, ny, points, count, all, smooth, centre, x, y, edge, share, moved, place, film)
      integer(c_int), intent(in) :: nx, ny, points, count, all
      real(c_double), intent(inout) :: smooth(ny, nx), centre(2), x(points), y(points), share(2, points), moved(count)
      integer(c_int), intent(inout) :: edge(points), place(points)
      real(c_double), intent(inout) :: film(all)
      !f2py threadsafe

      call moved_film(smooth, centre, x, y, edge, share, moved, place, film)
   end subroutine film_moved
end module ehl_f2py_surfaces

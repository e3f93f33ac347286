! SPDX-License-Identifier: BSD-3-Clause
!> Surfaces and predicted waves for Python; for the rules see ehl_f2py_solver. Single precision is sufficient for the waves.
module ehl_f2py_surfaces
   use, intrinsic :: iso_c_binding, only: c_double, c_float, c_int
   use ehl_fractal, only: fractal_t, make_fractal
   use ehl_handles, only: reply
   use ehl_status, only: status_t
   use ehl_tile_filter, only: filter_heights, filter_t
   use ehl_wave_sum, only: add_at_places, add_between, add_driven, add_free, add_second_order, film_and_pressure, keep_loads, &
                           moved_film, sum_polynomials, to_tile
   implicit none (type, external)
   private
   public :: fractal, filter_tile, driven_waves, waves_between, free_waves, polynomials, second_order, film_moved
   public :: film_pressure, ring_loads, at_places, wave_tile

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

   !> Waves as a tile: see to_tile
   subroutine wave_tile(points, columns, waves, tile)
      integer(c_int), intent(in) :: points, columns
      real(c_float), intent(inout) :: waves(points, 2, columns), tile(2, columns, points)
      !f2py threadsafe

      call to_tile(waves, tile)
   end subroutine wave_tile

   !> Driven waves: see add_driven
   subroutine driven_waves(columns_all, points, stations, m, n, tile, rows, columns, span, weight, shift, total)
      integer(c_int), intent(in) :: points, columns_all, stations, m, n
      real(c_float), intent(inout) :: tile(2, columns_all, points, stations), total(2, n, m)
      real(c_float), intent(inout) :: weight(stations, m)
      integer(c_int), intent(inout) :: rows(m), columns(n), span(2, m)
      integer(c_int), intent(in) :: shift
      !f2py threadsafe

      call add_driven(tile, rows, columns, span, weight, shift, total)
   end subroutine driven_waves

   !> Driven waves between rows: see add_between
   subroutine waves_between(columns_all, points, stations, m, n, tile, low, columns, span, between, weight, total)
      integer(c_int), intent(in) :: points, columns_all, stations, m, n
      real(c_float), intent(inout) :: tile(2, columns_all, points, stations), total(2, n, m)
      real(c_float), intent(inout) :: between(m), weight(stations, m)
      integer(c_int), intent(inout) :: low(m), columns(n), span(2, m)
      !f2py threadsafe

      call add_between(tile, low, columns, span, between, weight, total)
   end subroutine waves_between

   !> Free waves: see add_free
   subroutine free_waves(columns_all, points, stations, m, n, lines, tile, beside, low, columns, span, between, weight, &
                         expansion, shift, total)
      integer(c_int), intent(in) :: points, columns_all, stations, m, n, lines
      real(c_float), intent(inout) :: tile(2, columns_all, points, stations), total(2, n, m)
      real(c_float), intent(inout) :: beside(2, n, points)
      integer(c_int), intent(inout) :: low(lines, m), columns(n), span(2, m)
      real(c_float), intent(inout) :: between(lines, m), weight(stations, m), expansion(n, m)
      integer(c_int), intent(in) :: shift
      !f2py threadsafe

      call add_free(tile, beside, low, columns, span, between, weight, expansion, shift, total)
   end subroutine free_waves

   !> Polynomials of the edge: see sum_polynomials
   subroutine polynomials(points, count, n, values, coefficients, sums)
      integer(c_int), intent(in) :: points, count, n
      real(c_float), intent(inout) :: values(points, count), coefficients(count, n), sums(points, n)
      !f2py threadsafe

      call sum_polynomials(values, coefficients, sums)
   end subroutine polynomials

   !> Pressure increase at the points: see add_at_places
   subroutine at_places(points, all, values, place, total)
      integer(c_int), intent(in) :: points, all
      real(c_float), intent(inout) :: values(points), total(2, all)
      integer(c_int), intent(inout) :: place(points)
      !f2py threadsafe

      call add_at_places(values, place, total)
   end subroutine at_places

   !> Pressure of second order: see add_second_order
   subroutine second_order(m, n, gain, variance, span, total)
      integer(c_int), intent(in) :: m, n
      real(c_double), intent(inout) :: gain(m), variance(m)
      integer(c_int), intent(inout) :: span(2, m)
      real(c_float), intent(inout) :: total(2, n, m)
      !f2py threadsafe

      call add_second_order(gain, variance, span, total)
   end subroutine second_order

   !> Film and pressure at the points: see film_and_pressure
   subroutine film_pressure(points, all, change, place, smooth, smooth_pressure, limit, factor, ends, film, pressure, &
                            increase, counts)
      integer(c_int), intent(in) :: points, all
      real(c_float), intent(inout) :: change(2, all), increase(points)
      integer(c_int), intent(inout) :: place(points), counts(3)
      real(c_double), intent(inout) :: smooth(points), smooth_pressure(points), film(points), pressure(points)
      real(c_double), intent(in) :: limit, factor, ends
      !f2py threadsafe

      call film_and_pressure(change, place, smooth, smooth_pressure, limit, factor, ends, film, pressure, increase, counts)
   end subroutine film_pressure

   !> Pressures without tension: see keep_loads; returns 1 if loads are lost
   subroutine ring_loads(points, ring, pressure, lost)
      integer(c_int), intent(in) :: points
      integer(c_int), intent(inout) :: ring(points)
      real(c_double), intent(inout) :: pressure(points)
      integer(c_int), intent(out) :: lost
      !f2py threadsafe
      logical :: is_lost

      call keep_loads(ring, pressure, is_lost)
      lost = merge(1, 0, is_lost)
   end subroutine ring_loads

   !> Film with a moved edge: see moved_film
   subroutine film_moved(nx, ny, points, count, all, smooth, centre, x, y, edge, weight, moved, place, film)
      integer(c_int), intent(in) :: nx, ny, points, count, all
      real(c_double), intent(inout) :: smooth(ny, nx), centre(2), x(points), y(points), weight(2, points), moved(count)
      integer(c_int), intent(inout) :: edge(points), place(points)
      real(c_double), intent(inout) :: film(all)
      !f2py threadsafe

      call moved_film(smooth, centre, x, y, edge, weight, moved, place, film)
   end subroutine film_moved
end module ehl_f2py_surfaces

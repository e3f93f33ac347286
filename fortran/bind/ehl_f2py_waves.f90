! SPDX-License-Identifier: BSD-3-Clause
!> Waves of the prediction for Python; for the rules see ehl_f2py_solver. Single precision is enough for them.
module ehl_f2py_waves
   use, intrinsic :: iso_c_binding, only: c_float, c_float_complex, c_int
   use ehl_wave_sum, only: add_driven, add_free
   implicit none (type, external)
   private
   public :: driven_waves, free_waves

contains

   !> Driven waves: see add_driven
   subroutine driven_waves(columns_all, points, stations, m, n, tile, rows, columns, weight, shift, total)
      integer(c_int), intent(in) :: columns_all, points, stations, m, n
      complex(c_float_complex), intent(inout) :: tile(columns_all, points, stations), total(n, m)
      real(c_float), intent(inout) :: weight(stations, m)
      integer(c_int), intent(inout) :: rows(m), columns(n)
      integer(c_int), intent(in) :: shift
      !f2py threadsafe

      call add_driven(tile, rows, columns, weight, shift, total)
   end subroutine driven_waves

   !> Free waves: see add_free
   subroutine free_waves(columns_all, points, stations, m, n, lines, tile, low, columns, between, weight, part, shift, total)
      integer(c_int), intent(in) :: columns_all, points, stations, m, n, lines
      complex(c_float_complex), intent(inout) :: tile(columns_all, points, stations), total(n, m)
      real(c_float), intent(inout) :: weight(stations, m)
      integer(c_int), intent(inout) :: low(lines, m), columns(n)
      real(c_float), intent(inout) :: between(lines, m), part(n)
      integer(c_int), intent(in) :: shift
      !f2py threadsafe

      call add_free(tile, low, columns, between, weight, part, shift, total)
   end subroutine free_waves
end module ehl_f2py_waves

! SPDX-License-Identifier: BSD-3-Clause
!> Extremes of pressure and film while something passes the contact, with where and when
module ehl_extremes
   use ehl_kinds, only: dp
   use ehl_level, only: level_t
   implicit none (type, external)
   private
   public :: extremes_t, extreme_pressure, extreme_film, extreme_rise, extreme_ratio

   !> Largest pressure; least film; largest pressure above that of the smooth contact at the same place; least film
   !> over that of the smooth contact there
   integer, parameter :: extreme_pressure = 1, extreme_film = 2, extreme_rise = 3, extreme_ratio = 4

   type :: extremes_t
      !> Value [p_h or a^2/R or -], T [a/u], X, Y [a] of each
      real(dp) :: found(4, 4) = spread([-huge(1.0_dp), huge(1.0_dp), -huge(1.0_dp), huge(1.0_dp)], 1, 4)
   contains
      procedure :: see
      procedure, private :: note
   end type extremes_t

contains

   !> Look at the state after a time step; the first of equal values counts
   subroutine see(self, level, p_smooth, h_smooth, time)
      class(extremes_t), intent(inout) :: self
      type(level_t), intent(in) :: level
      !> Pressure and film of the smooth contact, (nx, ny)
      real(dp), intent(in) :: p_smooth(:, :), h_smooth(:, :)
      real(dp), intent(in) :: time
      !> Largest values of each row; of films with the sign changed
      real(dp) :: rows(level%grid%ny, 4)
      integer :: j

      do j = 1, level%grid%ny
         rows(j, extreme_pressure) = maxval(level%p(:, j))
         rows(j, extreme_film) = -minval(level%h(:, j))
         rows(j, extreme_rise) = maxval(level%p(:, j) - p_smooth(:, j))
         rows(j, extreme_ratio) = -minval(level%h(:, j)/h_smooth(:, j))
      end do
      call self%note(level, extreme_pressure, 1.0_dp, rows, level%p, time)
      call self%note(level, extreme_film, -1.0_dp, rows, level%h, time)
      call self%note(level, extreme_rise, 1.0_dp, rows, level%p - p_smooth, time)
      call self%note(level, extreme_ratio, -1.0_dp, rows, level%h/h_smooth, time)
   end subroutine see

   !> Keep a value, with its place, when it is beyond the one kept
   subroutine note(self, level, which, sign, rows, values, time)
      class(extremes_t), intent(inout) :: self
      type(level_t), intent(in) :: level
      integer, intent(in) :: which
      real(dp), intent(in) :: sign, rows(:, :), values(:, :), time
      integer :: i, j

      if (.not. maxval(rows(:, which)) > sign*self%found(1, which)) return
      j = maxloc(rows(:, which), dim=1)
      i = maxloc(sign*values(:, j), dim=1)
      self%found(:, which) = [values(i, j), time, level%grid%x(i), level%grid%y(j)]
   end subroutine note
end module ehl_extremes

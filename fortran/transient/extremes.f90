! SPDX-License-Identifier: BSD-3-Clause
!> Extremes of pressure and film during a passage, with position and time
module ehl_extremes
   use ehl_kinds, only: dp
   use ehl_level, only: gap, level_t
   implicit none (type, external)
   private
   public :: extremes_t, extreme_pressure, extreme_film

   !> Maximum pressure; minimum film; maximum pressure increase over the smooth contact at the same position; minimum ratio of the
   !> film to that of the smooth contact there
   integer, parameter :: extreme_pressure = 1, extreme_film = 2, extreme_increase = 3, extreme_ratio = 4

   type :: extremes_t
      !> Value [p_h or a^2/R or -], T [a/u], X, Y [a] of each
      real(dp) :: found(4, 4) = spread([-huge(1.0_dp), huge(1.0_dp), -huge(1.0_dp), huge(1.0_dp)], 1, 4)
   contains
      procedure :: update
      procedure, private :: update_one
   end type extremes_t

contains

   !> Update the extremes after a time step; of equal values the first one is kept
   subroutine update(self, level, p_smooth, h_smooth, time)
      class(extremes_t), intent(inout) :: self
      type(level_t), intent(in) :: level
      !> Pressure and film of the smooth contact, (nx, ny)
      real(dp), intent(in) :: p_smooth(:, :), h_smooth(:, :)
      real(dp), intent(in) :: time

      call self%update_one(level, extreme_pressure, 1.0_dp, level%p, time)
      call self%update_one(level, extreme_film, -1.0_dp, gap(level), time)
      call self%update_one(level, extreme_increase, 1.0_dp, level%p - p_smooth, time)
      call self%update_one(level, extreme_ratio, -1.0_dp, gap(level)/h_smooth, time)
   end subroutine update

   !> Replace an extreme by the maximum (sign 1) or minimum (-1) of a field, with time and position, if that exceeds it
   subroutine update_one(self, level, which, sign, values, time)
      class(extremes_t), intent(inout) :: self
      type(level_t), intent(in) :: level
      integer, intent(in) :: which
      real(dp), intent(in) :: sign, time
      real(dp), contiguous, intent(in) :: values(:, :)
      integer :: place(2)

      if (.not. maxval(sign*values) > sign*self%found(1, which)) return
      place = maxloc(sign*values)
      self%found(:, which) = [values(place(1), place(2)), time, level%grid%x(place(1)), level%grid%y(place(2))]
   end subroutine update_one
end module ehl_extremes

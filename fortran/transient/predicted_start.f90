! SPDX-License-Identifier: BSD-3-Clause
!> Predicted start: the time steps begin with the contact filled with roughness and a predicted pressure increase. The error of the
!> predicted film leaves the contact with the mean velocity.
module ehl_predicted_start
   use ehl_friction_mean, only: periods_compared
   use ehl_grid, only: grid_t
   use ehl_kinds, only: dp
   use ehl_moving_surfaces, only: moving_surfaces_t
   implicit none (type, external)
   private
   public :: predicted_start_t, steps_needed, start_fronts, first_mean, start_lag, transit

   !> Times [steps before the start]: the last three of this run and of the run on the next coarser grid
   integer, parameter :: steps_ago(4) = [0, 1, 2, 4]
   !> Times [a/u]: after which the friction counts in the mean, as the initial film has moved from X = -1 to 0.5, beyond which
   !> there is little friction; between means that are compared; after which the initial film has left the contact
   real(dp), parameter :: first_mean = 1.5_dp, start_lag = 0.125_dp, transit = 2.0_dp

   type :: predicted_start_t
      !> Time of the start
      real(dp) :: time = 0.0_dp
      !> Predicted pressure increase by the roughness at the times of `steps_ago` [p_h], shape (nx, ny, 4); on the next coarser grid
      !> at the last three times there, shape (nx, ny, 3)
      real(dp), allocatable :: pressure(:, :, :)
   contains
      procedure :: set_pressure
      procedure :: coarser
   end type predicted_start_t

contains

   !> Number of time steps until the mean friction over a period can be compared with an earlier one, or the passage ends
   real(dp) function steps_needed(surfaces, time_step, skip, filled, periods)
      class(moving_surfaces_t), intent(in) :: surfaces
      real(dp), intent(in) :: time_step
      !> Whether the steps before the roughness approaches the contact are skipped; whether it fills the contact at the start
      logical, intent(in) :: skip, filled
      !> Periods after which the run ends if its mean has not settled; if present, the steps until then
      real(dp), intent(in), optional :: periods
      real(dp) :: from, time

      if (filled) then
         time = start_lag + surfaces%period
         if (present(periods)) time = max(time, periods*surfaces%period)
         steps_needed = (first_mean + time)/time_step
         return
      end if
      from = merge(surfaces%begin(), 0.0_dp, skip)
      time = merge(1.0_dp, periods_compared(surfaces%repeats), surfaces%pass_once())*surfaces%period
      if (present(periods)) time = max(time, periods*surfaces%period)
      steps_needed = (max(0.0_dp, surfaces%time_to_mean(from)) + time)/time_step
   end function steps_needed

   !> Start time at which the roughness fills the domain, also at the earlier times of `steps_ago`; a whole number of steps of the
   !> next coarser grid
   pure real(dp) function start_time(surfaces, grid)
      class(moving_surfaces_t), intent(in) :: surfaces
      type(grid_t), intent(in) :: grid
      real(dp) :: step

      step = 2.0_dp*grid%hx
      start_time = step*(ceiling(max(0.0_dp, surfaces%time_filled(grid%x(grid%nx)))/step) + maxval(steps_ago)/2)
   end function start_time

   !> Positions of the front of each surface at the times of `steps_ago` [a], shape (4, surfaces)
   pure function start_fronts(surfaces, grid) result(fronts)
      class(moving_surfaces_t), intent(in) :: surfaces
      type(grid_t), intent(in) :: grid
      real(dp) :: fronts(size(steps_ago), surfaces%count())
      integer :: k

      do k = 1, surfaces%count()
         fronts(:, k) = surfaces%of(k)%surface%front_position(start_time(surfaces, grid) - steps_ago*grid%hx)
      end do
   end function start_fronts

   !> Set the pressure at the times of `steps_ago`
   subroutine set_pressure(self, surfaces, grid, pressure)
      class(predicted_start_t), intent(inout) :: self
      class(moving_surfaces_t), intent(in) :: surfaces
      type(grid_t), intent(in) :: grid
      !> On the whole grid [p_h], shape (nx, full_ny, 4)
      real(dp), intent(in) :: pressure(:, :, :)
      integer :: j

      self%time = start_time(surfaces, grid)
      self%pressure = pressure(:, [(modulo(grid%rows_below() + j - 1, grid%full_ny()) + 1, j=1, grid%ny)], :)
   end subroutine set_pressure

   !> The same start on the next coarser grid
   pure function coarser(self) result(start)
      class(predicted_start_t), intent(in) :: self
      type(predicted_start_t) :: start

      start%time = self%time
      if (allocated(self%pressure)) start%pressure = self%pressure(::2, ::2, [1, 3, 4])
   end function coarser
end module ehl_predicted_start

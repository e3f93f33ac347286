! SPDX-License-Identifier: BSD-3-Clause
!> Several rough surfaces: sums of heights, periods, times, and the fraction that a grid resolves
module test_surfaces
   use check, only: is_close, is_equal, is_true
   use ehl_feature, only: new_feature
   use ehl_grid, only: grid_t, new_grid
   use ehl_harmonic, only: new_harmonic
   use ehl_kinds, only: dp
   use ehl_moving_surfaces, only: moving_surfaces_t
   use ehl_status, only: status_t
   use ehl_surface, only: aliased_below, resolved_from, surface_t, x_filled, x_matters
   implicit none (type, external)
   private
   public :: run_surfaces

   !> Amplitude, and X of the front at time 0
   real(dp), parameter :: amplitude = 0.01_dp, x_start = -2.5_dp

contains

   subroutine run_surfaces()
      call heights_add()
      call periods_that_meet()
      call periods_that_nearly_meet()
      call passages()
      call fractions_of_the_variance()
   end subroutine run_surfaces

   !> Add a wave
   subroutine add_wave(surfaces, wavelength, velocity_ratio, height)
      type(moving_surfaces_t), intent(inout) :: surfaces
      real(dp), intent(in) :: wavelength, velocity_ratio, height
      class(surface_t), allocatable :: surface

      allocate (surface, source=new_harmonic(height, wavelength, wavelength, velocity_ratio, x_start))
      call surfaces%add("surface", surface, 0.0_dp, 1)
   end subroutine add_wave

   !> Add a dent of width a/2
   subroutine add_dent(surfaces, velocity_ratio, x_front)
      type(moving_surfaces_t), intent(inout) :: surfaces
      real(dp), intent(in) :: velocity_ratio, x_front
      class(surface_t), allocatable :: surface

      allocate (surface, source=new_feature(.false., .false., amplitude, 0.5_dp, 0.5_dp, 0.0_dp, 0.0_dp, velocity_ratio, x_front))
      call surfaces%add("second_surface", surface, 0.0_dp, 2)
   end subroutine add_dent

   !> Sum of all heights, of moving and of stationary surfaces; rms height and slope as the root of the sum of squares
   subroutine heights_add()
      type(moving_surfaces_t) :: all, moving, fixed
      type(grid_t) :: grid
      type(status_t) :: status
      real(dp), dimension(33, 33) :: rr, part, sum_of_both

      grid = new_grid(33, 33, -2.0_dp, 2.0_dp, 2.0_dp, .false.)
      call is_true(.not. (all%rough() .or. all%move() .or. all%all_stationary()), "none: the contact is smooth")
      call add_wave(moving, 1.0_dp, 2.0_dp, amplitude)
      call add_wave(fixed, 0.8_dp, 0.0_dp, 2.0_dp*amplitude)
      call add_wave(all, 1.0_dp, 2.0_dp, amplitude)
      call add_wave(all, 0.8_dp, 0.0_dp, 2.0_dp*amplitude)
      call is_true(moving%move() .and. .not. moving%all_stationary() .and. .not. moving%some_stationary(), "one that moves")
      call is_true(fixed%all_stationary() .and. .not. fixed%move() .and. .not. fixed%some_stationary(), "one at rest")
      call is_true(all%move() .and. all%some_stationary() .and. .not. all%all_stationary(), "one of each")
      call is_equal(size(all%velocities()), 1, "stationary surfaces have no velocity for the predictor")
      call all%prepare(grid, status)
      call moving%roughness(grid, 1.5_dp, rr)
      call fixed%roughness(grid, 1.5_dp, part)
      sum_of_both = rr + part
      call is_true(maxval(abs(part)) > amplitude, "the stationary wave is everywhere")
      call all%roughness(grid, 1.5_dp, rr, moving=.false.)
      call is_close(maxval(abs(rr - part)), 0.0_dp, 0.0_dp, "stationary surfaces")
      call all%roughness(grid, 1.5_dp, rr, moving=.true.)
      call is_close(maxval(abs(rr - (sum_of_both - part))), 0.0_dp, 1.0e-17_dp, "what moves")
      call all%roughness(grid, 1.5_dp, rr)
      call is_close(maxval(abs(rr - sum_of_both)), 0.0_dp, 0.0_dp, "heights add up")
      call is_close(all%rms_height(), hypot(moving%rms_height(), fixed%rms_height()), 1.0e-15_dp, "composite rms height")
      call is_close(all%rms_slope(), hypot(moving%rms_slope(), fixed%rms_slope()), 1.0e-15_dp, "composite rms slope")
      call is_true(.not. status%failed(), "surfaces")
   end subroutine heights_add

   !> The smallest common period of both surfaces; surfaces with the same velocity need one shift of the predictor
   subroutine periods_that_meet()
      type(moving_surfaces_t) :: one, both, equal

      call add_wave(one, 0.5_dp, 1.01_dp, amplitude)
      call one%find_period(36)
      call is_close(one%period, 0.5_dp/1.01_dp, 0.0_dp, "one surface: its own period")
      call is_equal(one%repeats, 1, "once")
      ! periods of 0.8 and 16/15, with the common multiple 3.2
      call add_wave(both, 1.0_dp, 1.25_dp, amplitude)
      call add_wave(both, 0.8_dp, 0.75_dp, amplitude)
      call both%find_period(36)
      call is_close(both%period, 3.2_dp, 1.0e-14_dp, "common period")
      call is_equal(both%repeats, 3, "periods of the slower one in it")
      call is_true(.not. both%mismatch > 0.0_dp .and. both%enough_positions, "no mismatch")
      call is_equal(both%slowest(), 2, "the slower one")
      call is_close(maxval(abs(both%velocities() - [0.75_dp, 1.25_dp])), 0.0_dp, 0.0_dp, "velocities in order")
      call is_close(both%time_to_mean(0.0_dp), (x_filled - x_start)/0.75_dp, 1.0e-14_dp, "when the slower one fills the contact")
      call is_close(both%begin(), (x_matters - 0.5_dp - x_start)/1.25_dp, 1.0e-14_dp, "when the faster one approaches")
      call add_wave(equal, 1.0_dp, 1.0_dp, amplitude)
      call add_wave(equal, 0.5_dp, 1.0_dp, amplitude)
      call equal%find_period(36)
      call is_close(equal%period, 1.0_dp, 0.0_dp, "two periods in one")
      call is_equal(size(equal%velocities()), 1, "one velocity")
   end subroutine periods_that_meet

   !> Without a common period: an approximate one with several relative positions, or none
   subroutine periods_that_nearly_meet()
      type(moving_surfaces_t) :: golden, alike
      real(dp), parameter :: ratio = 0.5_dp*(1.0_dp + sqrt(5.0_dp))

      ! periods of 1 and the golden ratio: nearest at Fibonacci numbers
      call add_wave(golden, 1.0_dp, 1.0_dp, amplitude)
      call add_wave(golden, ratio, 1.0_dp, amplitude)
      call golden%find_period(36)
      call is_equal(golden%repeats, 34, "34 golden ratios are nearly 55")
      call is_close(golden%mismatch, abs(34*ratio - 55), 1.0e-12_dp, "mismatch")
      call is_true(golden%enough_positions .and. golden%mismatch <= 0.02_dp, "enough relative positions")
      call golden%find_period(4)
      call is_equal(golden%repeats, 3, "3 golden ratios are roughly 5")
      ! 1.01 and 0.99: 99 periods to 101
      call add_wave(alike, 0.5_dp, 1.01_dp, amplitude)
      call add_wave(alike, 0.5_dp, 0.99_dp, amplitude)
      call alike%find_period(36)
      call is_true(.not. alike%enough_positions, "hardly any relative motion")
      call is_equal(alike%whole, 99, "sufficient number of periods")
      call alike%find_period(99)
      call is_true(alike%enough_positions .and. .not. alike%mismatch > 0.0_dp, "enough relative positions in 99 periods")
      call is_close(alike%period, 50.0_dp, 1.0e-12_dp, "100 wavelengths")
   end subroutine periods_that_nearly_meet

   !> A dent alone, over roughness, with another one
   subroutine passages()
      type(moving_surfaces_t) :: alone, over, two
      real(dp) :: once

      call add_dent(alone, 0.8_dp, -3.0_dp)
      call alone%find_period(36)
      call is_true(alone%pass_once(), "a dent passes once")
      once = alone%period
      call is_close(alone%time_to_mean(0.0_dp), (x_matters + 3.0_dp)/0.8_dp, 1.0e-14_dp, "from when it approaches")
      call add_wave(over, 0.7_dp, 1.2_dp, amplitude)
      call add_dent(over, 0.8_dp, -3.0_dp)
      call over%find_period(36)
      call is_true(over%pass_once() .and. over%period >= once, "no shorter over roughness")
      call is_close(modulo(over%period/(0.7_dp/1.2_dp) + 0.5_dp, 1.0_dp), 0.5_dp, 1.0e-12_dp, "whole periods of it")
      call is_true(over%period - once < 0.7_dp/1.2_dp, "and no more than it takes")
      call is_close(over%time_to_mean(0.0_dp), alone%time_to_mean(0.0_dp), 0.0_dp, "the dent determines the mean")
      call add_dent(two, 0.8_dp, -3.0_dp)
      call add_dent(two, 1.2_dp, -3.0_dp)
      call two%find_period(36)
      call is_close(two%time_to_mean(0.0_dp), (x_matters + 3.0_dp)/1.2_dp, 1.0e-14_dp, "from when the first approaches")
      call is_close(two%end_of_passage(), alone%end_of_passage(), 1.0e-13_dp, "until the last has left")
   end subroutine passages

   !> Unresolved fractions of the variance, of both surfaces and of the worse one
   subroutine fractions_of_the_variance()
      type(moving_surfaces_t) :: both
      type(grid_t) :: grid

      ! 16 and 4 nodes per period
      grid = new_grid(33, 33, -2.0_dp, 2.0_dp, 2.0_dp, .false.)
      call add_wave(both, 2.0_dp, 1.0_dp, 3.0_dp*amplitude)
      call add_wave(both, 0.5_dp, 1.0_dp, amplitude)
      call both%update_resolution(grid)
      call is_close(both%unresolved, 0.1_dp, 1.0e-15_dp, "a tenth of the variance is in the short wave")
      call is_close(both%left_out, 0.0_dp, 0.0_dp, "no wave is omitted")
      call is_close(both%max_unresolved(grid, resolved_from), 1.0_dp, 0.0_dp, "nothing of the short one is resolved")
      call is_close(both%max_unresolved(grid%coarser(), aliased_below), 1.0_dp, 0.0_dp, "the coarser grid omits it")
   end subroutine fractions_of_the_variance
end module test_surfaces

! SPDX-License-Identifier: BSD-3-Clause
!> The mean of the friction ratio over whole periods
module test_mean
   use check, only: is_close, is_true
   use ehl_friction_mean, only: friction_mean_t
   use ehl_kinds, only: dp
   use ehl_status, only: status_t
   implicit none (type, external)
   private
   public :: run_mean

   real(dp), parameter :: pi = acos(-1.0_dp), tolerance = 1.0e-3_dp
   type(status_t) :: status
   !> A wave of length 0.25 that moves by 1.01/128 per step: a period is no whole number of steps
   real(dp), parameter :: time_step = 1.0_dp/128.0_dp, period = 0.25_dp/1.01_dp

contains

   subroutine run_mean()
      call smooth_signal_settles_at_once()
      call peaks_between_steps_take_several_periods()
      call values_before_the_window_have_no_part()
      call two_periods_that_do_not_meet()
   end subroutine run_mean

   !> A product of two waves, with 1 - 0.2 or 1 + 0.2 beats in the window, at twelve phases: the stated error
   !> covers the error of the mean, which counts as settled within it
   subroutine two_periods_that_do_not_meet()
      type(friction_mean_t) :: mean
      real(dp), parameter :: mismatch = 0.2_dp
      real(dp) :: beats, worst, stated
      integer :: k, j, side

      do side = -1, 1, 2
         beats = 1.0_dp + side*mismatch
         worst = 0.0_dp
         stated = huge(1.0_dp)
         do j = 0, 11
            call mean%start(period, 5, mismatch, time_step, 0.0_dp)
            do k = 1, ceiling(1.2_dp*period/time_step)
               call mean%append(1.0_dp + 0.1_dp*cos(2.0_dp*pi*(beats*k*time_step/period + j/12.0_dp)), 0.0_dp, 0.0_dp, status)
            end do
            worst = max(worst, abs(mean%mean(0.0_dp) - 1.0_dp))
            stated = min(stated, mean%window_error())
            call is_true(mean%settled(1.0e-12_dp), "settled within the error of its window")
         end do
         call is_true(worst > 0.01_dp .and. worst <= stated .and. stated < 4.0_dp*worst, "the error is stated")
      end do
   end subroutine two_periods_that_do_not_meet

   !> A peak before the window does not change the mean, even if it exceeds the mean by more than 1/epsilon
   subroutine values_before_the_window_have_no_part()
      type(friction_mean_t) :: mean
      integer :: k

      call mean%start(period, 1, 0.0_dp, time_step, 0.0_dp)
      call mean%append(1.0e24_dp, 0.0_dp, 0.0_dp, status)
      do k = 1, nint(1.6_dp*period/time_step)
         call mean%append(1.0_dp, 0.0_dp, 0.0_dp, status)
      end do
      call is_close(mean%mean(0.0_dp), 1.0_dp, 1.0e-12_dp, "mean of a constant after a peak")
      call is_true(mean%settled(1.0e-12_dp), "and it has settled")
   end subroutine values_before_the_window_have_no_part

   !> The mean of a signal that steps resolve is known after one and a half periods, from one period
   subroutine smooth_signal_settles_at_once()
      type(friction_mean_t) :: mean

      call run(0.0_dp, mean)
      call is_close(mean%periods(), 1.5_dp, time_step/period, "first assessment")
      call is_close(mean%mean(0.0_dp), 1.0_dp, tolerance, "mean of a smooth signal")
   end subroutine smooth_signal_settles_at_once

   !> Peaks a fifth of a step wide: every period samples them differently, and only a mean over several is correct
   subroutine peaks_between_steps_take_several_periods()
      type(friction_mean_t) :: mean
      real(dp), parameter :: height = 50.0_dp
      integer, parameter :: fine = 20000
      real(dp) :: exact, worst, range(2)
      integer :: k

      exact = sum([(signal(real(k, dp)/fine, height), k=1, fine)])/fine
      call run(height, mean)
      call is_true(mean%periods() >= 20.0_dp .and. mean%periods() < 36.0_dp, "it takes twenty periods or more")
      call is_close(mean%mean(0.0_dp), exact, 0.01_dp*exact, "mean of a signal with peaks")
      call is_true(mean%change() <= 0.01_dp*exact, "and it no longer changes much")
      range = mean%extremes()
      call is_true(range(2) > 0.9_dp*height, "largest value of all these periods")
      ! a single period would not suffice
      mean%n = mean%filled + nint(2.0_dp*period/time_step)
      worst = 0.0_dp
      do k = 0, 31
         mean%n = mean%n + 1
         worst = max(worst, abs(mean%mean(0.0_dp) - exact))
      end do
      call is_true(worst > 0.1_dp*exact, "means of one period are wrong")
   end subroutine peaks_between_steps_take_several_periods

   !> Run until the mean has settled, at most 40 periods
   subroutine run(height, mean)
      real(dp), intent(in) :: height
      type(friction_mean_t), intent(out) :: mean
      integer :: k

      call mean%start(period, 1, 0.0_dp, time_step, 0.0_dp)
      do k = 1, nint(40.0_dp*period/time_step)
         call mean%append(signal(k*time_step/period, height), 0.0_dp, 0.0_dp, status)
         if (mean%settled(tolerance)) return
      end do
   end subroutine run

   !> Friction at a phase of the period: a wave, and peaks
   pure real(dp) function signal(phase, height)
      real(dp), intent(in) :: phase, height
      real(dp), parameter :: places(*) = [0.1_dp, 0.36_dp, 0.37_dp, 0.81_dp], width = 0.2_dp*time_step/period
      integer :: k

      signal = 1.0_dp + 0.3_dp*cos(2.0_dp*pi*phase)
      do k = 1, size(places)
         signal = signal + height*exp((cos(2.0_dp*pi*(phase - places(k))) - 1.0_dp)/(2.0_dp*pi*width)**2)
      end do
   end function signal
end module test_mean

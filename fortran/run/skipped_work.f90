! SPDX-License-Identifier: BSD-3-Clause
!> What a run did not have to do, and the seconds that saved
module ehl_skipped_work
   use, intrinsic :: iso_fortran_env, only: int64
   use ehl_clock, only: clock_t, start_clock
   use ehl_friction_mean, only: start_up
   use ehl_kinds, only: dp
   use ehl_level, only: level_t
   use ehl_plan, only: plan_t
   use ehl_record, only: record_t
   use ehl_text, only: fixed, newline, to_text
   use ehl_transient, only: transient_t
   implicit none (type, external)
   private
   public :: skip_t, find_skips, skip_lines, report_skips, seconds_saved_by_zeros

   !> Periods that a transient run of a fixed length needs: until the start has died out, and one to take the mean of
   integer, parameter :: fixed_periods = start_up + 1

   !> Something not done, and the seconds that saved
   type :: skip_t
      character(len=128) :: what = ""
      real(dp) :: seconds = 0.0_dp
   end type skip_t

contains

   !> What a transient run that has ended did not have to do. The seconds of steps are those of the mean step made,
   !> those of nodes in proportion to their number, those of zeros for every deflection on the finest grid.
   subroutine find_skips(plan, transient, good, seconds_steps, seconds_smooth, seconds_zeros, skips)
      type(plan_t), intent(in) :: plan
      type(transient_t), intent(in) :: transient
      !> Whether the transient run ended because the mean has settled
      logical, intent(in) :: good
      !> Seconds spent on the steps, and on the smooth contact
      real(dp), intent(in) :: seconds_steps, seconds_smooth
      !> Seconds saved in a deflection where P = 0, see seconds_saved_by_zeros
      real(dp), intent(in) :: seconds_zeros
      type(skip_t), allocatable, intent(out) :: skips(:)
      real(dp) :: step
      integer(int64) :: left
      integer :: periods, deflections

      step = seconds_steps/max(transient%step, 1)
      allocate (skips(0))
      if (plan%finest%mirror) then
         skips = [skips, skip_t(to_text(plan%finest%nx*(plan%finest%full_ny() - plan%finest%ny))//" of "// &
                                to_text(plan%finest%nx*plan%finest%full_ny())//" nodes: the scene is symmetric in Y", &
                                (seconds_steps + seconds_smooth)*(real(plan%finest%full_ny(), dp)/plan%finest%ny - 1.0_dp))]
      end if
      if (transient%skipped > 0) then
         skips = [skips, skip_t(to_text(transient%skipped)//" steps before the roughness came near the contact", &
                                transient%skipped*step)]
      end if
      periods = merge(plan%max_periods, fixed_periods, plan%max_periods > 0)
      ! beyond the largest integer with many periods of a slow surface
      left = ceiling(max(transient%mean%filled, 0) + periods*transient%mean%period/transient%time_step, int64) - transient%step
      if (good .and. plan%steps == 0 .and. left > 0 .and. .not. plan%surface%passes_once) then
         skips = [skips, skip_t(to_text(left)//" steps up to the end of period "//to_text(periods)// &
                                ": the mean of mu_r/mu_s had settled", left*step)]
      end if
      skips = [skips, skip_t("a second solve of the smooth contact: one gave the start of the transient run and mu_s", &
                             seconds_smooth)]
      ! one after the prediction, after every sweep, and after the coarse grids
      deflections = transient%step + transient%total_cycles + transient%total_sweeps
      skips = [skips, skip_t("corrections of the deflection where P = 0", deflections*seconds_zeros)]
   end subroutine find_skips

   !> What was not done, one line each, with the seconds that saved
   function skip_lines(skips) result(text)
      type(skip_t), intent(in) :: skips(:)
      character(len=:), allocatable :: text
      integer :: k

      text = ""
      do k = 1, size(skips)
         if (k > 1) text = text//newline
         text = text//"not done: "//trim(skips(k)%what)//" (about "//fixed(skips(k)%seconds, "f16.1")//" s)"
      end do
   end function skip_lines

   !> The same by name, the seconds in a list of their own
   subroutine report_skips(record, skips)
      type(record_t), intent(inout) :: record
      type(skip_t), intent(in) :: skips(:)

      call record%set("skips", skips%what)
      call record%set("skips_seconds", skips%seconds)
   end subroutine report_skips

   !> Seconds that a deflection on a level would take more if every node had pressure: one of each kind is timed.
   real(dp) function seconds_saved_by_zeros(level)
      type(level_t), intent(inout) :: level
      !> Best of so many
      integer, parameter :: trials = 3
      type(clock_t) :: clock
      real(dp) :: seconds(2)
      real(dp), allocatable :: pressure(:, :), deflection(:, :)
      integer :: stat
      integer :: k

      seconds_saved_by_zeros = 0.0_dp
      allocate (deflection, pressure, mold=level%p, stat=stat)
      ! a message less
      if (stat /= 0) return
      pressure(:, :) = max(level%p, tiny(1.0_dp)/epsilon(1.0_dp))
      seconds = huge(1.0_dp)
      do k = 1, trials
         clock = start_clock()
         call level%engine%apply(level%p, deflection)
         seconds(1) = min(seconds(1), clock%seconds())
         clock = start_clock()
         call level%engine%apply(pressure, deflection)
         seconds(2) = min(seconds(2), clock%seconds())
      end do
      seconds_saved_by_zeros = max(0.0_dp, seconds(2) - seconds(1))
   end function seconds_saved_by_zeros
end module ehl_skipped_work

! SPDX-License-Identifier: BSD-3-Clause
!> Memory and time that a plan needs, estimated before the run
module ehl_plan_need
   use ehl_friction_mean, only: automatic_periods, periods_compared
   use ehl_kinds, only: dp
   use ehl_memory, only: check_memory
   use ehl_plan, only: plan_t
   use ehl_status, only: status_t
   use ehl_text, only: to_text
   use ehl_predicted_start, only: steps_needed
   implicit none (type, external)
   private
   public :: bytes_needed, check_need, frames_kept, max_periods, seconds_needed

   !> Bytes per stored node of the finest grid including the coarser ones, measured on 513 x 513 nodes: of the smooth contact; added
   !> by the rough one; added in time steps, which may change to Alcouffe coarsening
   real(dp), parameter :: smooth_bytes = 190.0_dp, rough_bytes = 150.0_dp, alcouffe_bytes = 120.0_dp
   !> Added by the temperatures of film and walls
   real(dp), parameter :: heat_bytes = 32.0_dp
   !> Added by a shear-thinning flow
   real(dp), parameter :: thinning_bytes = 165.0_dp
   !> Bytes per node of the whole finest grid for writing a field: the field, a copy and its source
   real(dp), parameter :: written_bytes = 24.0_dp
   !> Bytes per node along X and thread
   real(dp), parameter :: line_bytes = 2000.0_dp
   !> Memory and time of the run on the next coarser grid, with half the steps, over those on the finest
   real(dp), parameter :: coarser_bytes = 0.25_dp, coarser_seconds = 0.125_dp
   !> Seconds per stored node of a smooth contact and of a time step or cycle, on one thread of a processor of 2020
   real(dp), parameter :: smooth_seconds = 8.0e-7_dp, step_seconds = 3.0e-7_dp
   !> Seconds per cube of the number of unknowns on the coarsest grid, for about ten direct solutions in a smooth contact; they take
   !> half of the time on a wide grid (0.5 of 1.1 s at kappa = 10 on 257 nodes)
   real(dp), parameter :: direct_seconds = 1.0e-9_dp
   !> Cycles of a stationary rough contact
   real(dp), parameter :: stationary_cycles = 20.0_dp

contains

   !> Refuse a plan whose arrays do not fit
   subroutine check_need(plan, status)
      type(plan_t), intent(in) :: plan
      type(status_t), intent(inout) :: status
      character(len=:), allocatable :: what
      real(dp) :: needed

      if (status%failed()) return
      what = "grid.points = "
      if (plan%target_error > 0.0_dp) what = "grid.max_points, with grid.target_error up to "
      what = what//to_text(plan%finest%nx)
      if (frames(plan, max_steps(plan)) > 0.0_dp) what = what//" with output.frame_interval = "//to_text(plan%frame_interval)
      needed = bytes_needed(plan, plan%threads)
      ! the surfaces are allocated already
      needed = needed - plan%surfaces%bytes()
      call check_memory(what, needed, status)
   end subroutine check_need

   !> Minimum and maximum number of frames
   subroutine frames_kept(plan, frames_min, frames_max)
      type(plan_t), intent(in) :: plan
      real(dp), intent(out) :: frames_min, frames_max

      frames_min = frames(plan, steps(plan))
      frames_max = frames(plan, max_steps(plan))
   end subroutine frames_kept

   !> Minimum number of time steps
   real(dp) function steps(plan)
      type(plan_t), intent(in) :: plan

      steps = 0.0_dp
      if (plan%duty%active) steps = plan%duty%steps_expected(plan%finest%hx)
      if (plan%duty%active .or. .not. plan%surfaces%move()) return
      steps = plan%steps
      if (plan%steps == 0) steps = steps_needed(plan%surfaces, plan%finest%hx, plan%skip_start, plan%predicted_start)
   end function steps

   !> Maximum number of time steps, if the mean does not settle
   real(dp) function max_steps(plan)
      type(plan_t), intent(in) :: plan

      max_steps = 0.0_dp
      if (plan%duty%active) max_steps = plan%duty%steps_expected(plan%finest%hx)
      if (plan%duty%active .or. .not. plan%surfaces%move()) return
      max_steps = plan%steps
      if (plan%steps == 0) max_steps = steps_needed(plan%surfaces, plan%finest%hx, plan%skip_start, plan%predicted_start, &
                                                     max_periods(plan))
   end function max_steps

   !> Maximum number of common periods of a transient run
   pure real(dp) function max_periods(plan)
      type(plan_t), intent(in) :: plan

      associate (limit => merge(plan%max_periods, automatic_periods, plan%max_periods > 0), repeats => plan%surfaces%repeats)
         max_periods = limit
         ! the limit counts periods of the slowest surface, of which a common period contains `repeats`; at least those until means
         ! can be compared
         if (repeats > 1) max_periods = max(real(limit, dp)/repeats, periods_compared(repeats))
      end associate
      if (plan%surfaces%pass_once()) max_periods = 1.0_dp
   end function max_periods

   !> Number of frames in a number of steps
   pure real(dp) function frames(plan, steps)
      type(plan_t), intent(in) :: plan
      real(dp), intent(in) :: steps

      frames = 0.0_dp
      if (plan%frame_interval > 0.0_dp) frames = aint(steps*min(1.0_dp, plan%finest%hx/plan%frame_interval))
   end function frames

   !> Number of stored nodes of the finest grid
   pure real(dp) function nodes(plan)
      type(plan_t), intent(in) :: plan
      nodes = real(plan%finest%nx, dp)*plan%finest%ny
   end function nodes

   !> Bytes of all grids, of the surfaces and of the frames
   real(dp) function bytes_needed(plan, threads) result(bytes)
      type(plan_t), intent(in) :: plan
      integer, intent(in) :: threads

      bytes = smooth_bytes
      if (plan%has_next_phase()) bytes = bytes + rough_bytes
      if (plan%has_steps()) bytes = bytes + alcouffe_bytes
      if (plan%heat%active) bytes = bytes + heat_bytes
      if (plan%lubricant%shear%thins_flow()) bytes = bytes + thinning_bytes
      bytes = bytes*nodes(plan) + line_bytes*plan%finest%nx*threads
      bytes = bytes + plan%surfaces%bytes_on(plan%finest)
      if (plan%coarse_run) bytes = bytes*(1.0_dp + coarser_bytes)
      bytes = bytes + (written_bytes + 16.0_dp*frames(plan, max_steps(plan)))*plan%finest%nx*plan%finest%full_ny()
   end function bytes_needed

   !> Seconds on one thread until the run can end
   real(dp) function seconds_needed(plan) result(seconds)
      type(plan_t), intent(in) :: plan
      real(dp) :: cycles

      cycles = steps(plan)
      if (plan%surfaces%all_stationary()) cycles = stationary_cycles
      if (plan%coarse_run) cycles = cycles*(1.0_dp + coarser_seconds)
      seconds = nodes(plan)*(smooth_seconds + cycles*step_seconds) + direct_seconds*(real(plan%coarsest%nx, dp)*plan%coarsest%ny)**3
   end function seconds_needed
end module ehl_plan_need

! SPDX-License-Identifier: BSD-3-Clause
!> Results of a run
submodule (ehl_solver) ehl_solver_results
   use ehl_domain, only: ratio_cost, too_small
   use ehl_friction_results, only: find_friction, friction_results_t
   use ehl_assessment, only: judge
   use ehl_kinds, only: not_known
   use ehl_level_result, only: film_errors, spike_grows
   use ehl_no_result, only: why_no_result
   use ehl_outcome, only: outcome_names, outcome_target_missed
   use ehl_ratio_error, only: ratio_error_t
   use ehl_report, only: report_friction, report_passage, report_stationary, report_scene, report_transient, report_waves
   use ehl_report_smooth, only: report_smooth
   use ehl_report_touching, only: report_touching, why_no_friction
   use ehl_surface_text, only: window_words
   use ehl_text, only: newline
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   implicit none (type, external)

   !> Shares of a variance below this one are rounding
   real(dp), parameter :: rounding = 1.0e-14_dp
   !> Largest change of mu_ratio from grid to grid, over mu_ratio, that tells of a limit; and largest rise with a single
   !> wave or feature, which is the same on both grids: what rises more are peaks of pressure that no grid yet resolves
   real(dp), parameter :: max_change = 0.5_dp, max_rise = 0.05_dp

   !> Of the names, units and meanings of results, with `VERSION` of pyehl/schema.py: another one where one of them changes
   integer, parameter :: schema_version = 2

contains

   module procedure summary
      logical :: good, converged, known, rough
      real(dp) :: ratio, stop_error
      character(len=:), allocatable :: assessment, why, why_none
      type(friction_results_t) :: friction
      integer :: worth

      converged = self%converged()
      why_none = why_no_friction(self%run, converged)
      known = why_none == ""
      rough = self%run%is_rough()
      call record%set("kind", "solution")
      call record%set("schema_version", schema_version)
      call record%set("status", trim(outcome_names(self%outcome())))
      if (allocated(self%coarse)) then
         why = why_no_result(self%run, self%coarse)
      else
         why = why_no_result(self%run)
      end if
      if (why /= "") call record%set("message", why)
      call record%set("converged", converged)
      ! the smooth results are good as soon as the rough contact has begun
      good = rough .or. self%run%smooth%solved .or. self%run%outcome == outcome_target_missed
      call report_scene(record, self%run)
      call report_smooth(record, self%run%plan, self%run%smooth, self%run%level(), good)
      ratio = not_known
      stop_error = not_known
      if (self%run%phase == phase_steps) then
         call report_transient(record, self%run, converged, known, ratio, stop_error)
         call report_start(self, record)
         if (self%run%plan%surfaces%pass_once()) then
            call report_passage(record, self%run%plan%scales, self%run%transient%extremes, converged)
         end if
      end if
      if (rough) call report_waves(record, self%run)
      if (self%run%phase == phase_stationary) call report_stationary(record, self%run, converged, known, ratio, stop_error)
      if (self%run%plan%surfaces%rough()) call report_ratio(self, record, ratio, stop_error, why_none)
      call report_touching(record, self%run, good, converged, why_no_grid_error(self))
      call find_friction(self%run, good, converged, why_none, friction)
      call report_friction(record, self%run%plan, friction)
      call record%set("bytes", real(self%run%hierarchy%bytes(), dp) + self%run%plan%surfaces%bytes())
      call judge(record, assessment, worth)
      call record%set("assessment", assessment)
   end procedure summary

   !> What the time steps began with
   subroutine report_start(self, record)
      type(solver_t), intent(in) :: self
      type(record_t), intent(inout) :: record

      if (self%run%plan%predicted_start .and. .not. allocated(self%run%fallback_reason)) then
         call record%set("start", "prediction")
      else
         call record%set("start", "front")
         if (allocated(self%run%fallback_reason)) call record%set("start_note", "no prediction: "//self%run%fallback_reason)
      end if
   end subroutine report_start

   !> The friction ratio, that in the limit of fine grids, and its error with the parts of it
   subroutine report_ratio(self, record, ratio, stop_error, why_none)
      type(solver_t), intent(in) :: self
      type(record_t), intent(inout) :: record
      !> NaN where they are not known
      real(dp), intent(in) :: ratio, stop_error
      !> Why friction is not known where the bodies touch; empty where it is
      character(len=*), intent(in) :: why_none
      type(ratio_error_t) :: error
      type(waves_t) :: waves
      real(dp) :: limit, grid, domain
      character(len=:), allocatable :: why

      limit = not_known
      grid = not_known
      if (self%run%coarser%outcome == outcome_converged .and. ieee_is_finite(ratio)) then
         ! order 2 (Richardson), if both grids resolve the surface
         if (self%run%plan%extrapolates) limit = ratio + (ratio - self%run%coarser%ratio)/3.0_dp
         if (has_limit(self, ratio)) grid = grid_error(self, ratio)
      end if
      waves = waves_of(self)
      why = why_no_grid_error(self)
      if (why == "" .and. .not. ieee_is_finite(grid)) why = "pressures change so much from grid to grid that no limit is in sight"
      if (.not. ieee_is_finite(ratio)) then
         why = "there is no mu_ratio"
         if (why_none /= "") why = why_none
         waves = waves_t(.true., not_known, not_known, why)
      end if
      call record%set("mu_ratio", ratio)
      call record%set("mu_ratio_extrapolated", limit)
      call record%set("mu_ratio_unresolved", waves%unresolved)
      call error%add(record, "mu_ratio_error_grid", grid, why)
      call error%add(record, "mu_ratio_error_stop", stop_error, why)
      associate (surfaces => self%run%plan%surfaces, mean => self%run%transient%mean)
         if (surfaces%mismatch > 0.0_dp .and. ieee_is_finite(ratio)) call error%add(record, "mu_ratio_error_window", &
            merge(mean%window_error(), not_known, surfaces%meets), window_words(surfaces))
      end associate
      call error%add(record, "mu_ratio_error_left_out", waves%left_out, waves%why)
      domain = not_known
      if (self%run%plan%domain_cost(1) < 1.0_dp) then
         domain = ratio_cost(self%run%plan%domain_cost(1), ratio)
      else if (ieee_is_finite(ratio)) then
         why = too_small
      end if
      call error%add(record, "mu_ratio_error_domain", domain, why)
      call error%report(record)
   end subroutine report_ratio

   !> Whether two grids tell of a limit of the friction ratio, and three of one of the smooth contact
   logical function has_limit(self, ratio)
      type(solver_t), intent(in) :: self
      real(dp), intent(in) :: ratio
      real(dp) :: change

      change = (ratio - self%run%coarser%ratio)/ratio
      has_limit = abs(change) <= max_change .and. .not. spike_grows(self%run%smooth%results, self%run%smooth%n)
      if (self%run%plan%surfaces%same_on_grids()) has_limit = has_limit .and. change <= max_rise
   end function has_limit

   !> Error of the friction ratio by its grid: two grids do not show that they have reached order 2, so that of order 1
   !> (Roache 1994: three times that of order 2); and no less than the error of the smooth film makes of it
   real(dp) function grid_error(self, ratio)
      type(solver_t), intent(in) :: self
      real(dp), intent(in) :: ratio
      real(dp) :: error(2)

      grid_error = abs(ratio - self%run%coarser%ratio)
      associate (results => self%run%smooth%results, n => self%run%smooth%n)
         if (n == 1) return
         if (.not. results(n - 1)%solved) return
         error = film_errors(results(n)%m, results(n - 1)%m, results(n)%mesh, self%run%plan%inlet)/results(n)%m%films()
      end associate
      grid_error = max(grid_error, ratio_cost(error(1), ratio))
   end function grid_error

   !> What is known of the waves that the grid does not resolve. Only tiles have waves that are left out: what there is
   !> of a single wave or a feature is on the grid.
   function waves_of(self) result(waves)
      type(solver_t), intent(in) :: self
      type(waves_t) :: waves

      waves = self%waves
      if (.not. waves%known) then
         if (self%run%plan%surfaces%unresolved > rounding) waves%unresolved = not_known
         waves%left_out = waves%unresolved
         waves%why = "the contribution of the omitted waves is not predicted (pyehl run does)"
         if (self%run%plan%surfaces%rest()) waves%why = &
            "the contribution of the omitted waves is not predicted (for surfaces on the move alone)"
      end if
      if (.not. (self%run%plan%surfaces%left_out > rounding .and. self%run%plan%surfaces%has_spectrum())) waves%left_out = 0.0_dp
   end function waves_of

   !> Why two grids give no error; empty where they do
   function why_no_grid_error(self) result(why)
      type(solver_t), intent(in) :: self
      character(len=:), allocatable :: why
      character(len=*), parameter :: alone = "there is no run on the next coarser grid"

      why = ""
      select case (self%run%coarser%outcome)
      case (outcome_converged)
         return
      case (outcome_running)
         if (.not. self%input%time%estimate_error) then
            why = alone//": time.estimate_error is false"
         else if (self%run%plan%surfaces%move() .and. self%run%plan%steps > 0) then
            why = alone//", because of time.steps"
         else if (self%run%plan%coarse_run) then
            why = alone//" yet"
         else if (self%run%plan%levels > 2) then
            why = alone//": it carries nothing of the surface"
         else
            why = alone//": grid.points is too small for one"
         end if
      case default
         why = "the run on the next coarser grid ended with the status '"//trim(outcome_names(self%run%coarser%outcome))//"'"
         if (allocated(self%run%coarser%message)) why = why//" ("//one_line(self%run%coarser%message)//")"
      end select
   end function why_no_grid_error

   !> A message in one line
   pure function one_line(message) result(text)
      character(len=*), intent(in) :: message
      character(len=:), allocatable :: text
      integer :: i

      text = message
      do i = 1, len(text)
         if (text(i:i) == newline) text(i:i) = " "
      end do
   end function one_line
end submodule ehl_solver_results

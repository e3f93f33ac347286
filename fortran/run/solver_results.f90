! SPDX-License-Identifier: BSD-3-Clause
!> Results of a run
submodule (ehl_solver) ehl_solver_results
   use ehl_domain, only: ratio_error
   use ehl_friction_results, only: find_friction, friction_results_t
   use ehl_kinds, only: not_known
   use ehl_level_result, only: film_errors, unresolved_spike
   use ehl_outcome, only: outcome_names, outcome_target_missed
   use ehl_reason, only: reason_coarser_status, reason_few_positions, reason_stationary_waves, reason_no_ratio, reason_none, &
                         reason_not_predicted, reason_not_requested, reason_not_yet, reason_none_resolved, reason_prediction, &
                         reason_pressures, reason_small_domain, reason_small_grid, reason_steps
   use ehl_report, only: report_friction, report_passage, report_stationary, report_problem, report_transient, report_waves
   use ehl_report_duty, only: report_duty
   use ehl_report_end, only: report_end
   use ehl_report_roller, only: report_roller
   use ehl_report_smooth, only: report_smooth
   use ehl_report_touching, only: report_touching, why_no_friction
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   implicit none (type, external)

   !> Fractions of a variance below this are rounding errors
   real(dp), parameter :: rounding = 1.0e-14_dp
   !> Maximum relative change of mu_ratio between two grids that converge; and its maximum increase with a single wave or feature,
   !> which is the same on both grids: a larger increase is due to unresolved pressure peaks
   real(dp), parameter :: max_change = 0.5_dp, max_increase = 0.05_dp

   !> Version of the names, units and meanings of results, equal to `VERSION` of pyehl/schema.py
   integer, parameter :: schema_version = 3

contains

   module procedure results
      logical :: solved, converged, rough
      real(dp) :: ratio, stop_error
      integer :: why_none
      type(friction_results_t) :: friction

      converged = self%converged()
      why_none = why_no_friction(self%run, converged)
      rough = self%run%is_rough()
      call record%set("kind", "solution")
      call record%set("schema_version", schema_version)
      call record%set("status", trim(outcome_names(self%outcome())))
      if (allocated(self%coarse)) then
         call report_end(record, self%run, self%coarse)
      else
         call report_end(record, self%run)
      end if
      call record%set("converged", converged)
      ! the smooth results are final once the rough contact has started
      solved = rough .or. self%run%smooth%solved .or. self%run%outcome == outcome_target_missed
      call report_problem(record, self%run)
      call report_smooth(record, self%run%plan, self%run%smooth, self%run%level(), solved)
      call report_roller(record, self%run, solved)
      ratio = not_known
      stop_error = not_known
      if (self%run%phase == phase_steps .and. self%run%plan%duty%active) then
         call report_duty(record, self%run, converged)
      else if (self%run%phase == phase_steps) then
         call report_transient(record, self%run, converged, why_none == reason_none, ratio, stop_error)
         call report_start(self, record)
         if (self%run%plan%surfaces%pass_once()) then
            call report_passage(record, self%run%plan%scales, self%run%transient%extremes, converged)
         end if
      end if
      if (self%run%plan%surfaces%rough() .and. rough) call report_waves(record, self%run)
      if (self%run%phase == phase_stationary) call report_stationary(record, self%run, converged, why_none == reason_none, ratio, &
                                                                     stop_error)
      if (self%run%plan%surfaces%rough() .and. .not. self%run%plan%duty%active) then
         call report_ratio(self, record, ratio, stop_error, why_none)
      end if
      call report_touching(record, self%run, solved, converged, why_no_grid_error(self))
      call find_friction(self%run, solved, converged, why_none, friction)
      call report_friction(record, self%run%plan, friction)
      call record%set("bytes", real(self%run%hierarchy%bytes(), dp) + self%run%plan%surfaces%bytes())
   end procedure results

   !> Start of the time steps
   subroutine report_start(self, record)
      type(solver_t), intent(in) :: self
      type(record_t), intent(inout) :: record

      if (self%run%plan%predicted_start .and. .not. allocated(self%run%fallback_reason)) then
         call record%set("start", "prediction")
      else
         call record%set("start", "front")
         if (allocated(self%run%fallback_reason)) call record%set_note("start_note", self%run%fallback_reason)
      end if
   end subroutine report_start

   !> Report the friction ratio, its extrapolated value, and its error, the sum of several parts that is known only if all parts are
   subroutine report_ratio(self, record, ratio, stop_error, why_none)
      type(solver_t), intent(in) :: self
      type(record_t), intent(inout) :: record
      !> NaN if not known
      real(dp), intent(in) :: ratio, stop_error
      !> Why friction is not known with solid contact
      integer, intent(in) :: why_none
      character(len=*), parameter :: names(5) = [character(len=8) :: "grid", "stop", "window", "left_out", "domain"]
      real(dp) :: limit, waves(2), parts(5)
      integer :: why(5), why_no_waves, k

      limit = not_known
      parts = [not_known, stop_error, 0.0_dp, not_known, not_known]
      if (self%run%coarser%outcome == outcome_converged .and. ieee_is_finite(ratio)) then
         ! order 2 (Richardson), if both grids resolve the surface
         if (self%run%plan%extrapolates) limit = ratio + (ratio - self%run%coarser%ratio)/3.0_dp
         if (has_limit(self, ratio)) parts(1) = grid_error(self, ratio)
      end if
      call waves_of(self, waves, why_no_waves)
      why = why_no_grid_error(self)
      if (why(1) == reason_none .and. .not. ieee_is_finite(parts(1))) why = reason_pressures
      why(4) = why_no_waves
      if (.not. ieee_is_finite(ratio)) then
         why = merge(reason_no_ratio, why_none, why_none == reason_none)
         waves = not_known
      end if
      call record%set("mu_ratio", ratio)
      call record%set("mu_ratio_extrapolated", limit)
      call record%set("mu_ratio_unresolved", waves(2))
      parts(4) = waves(1)
      associate (surfaces => self%run%plan%surfaces, mean => self%run%transient%mean, domain_error => self%run%plan%domain_error(1))
         if (surfaces%mismatch > 0.0_dp .and. ieee_is_finite(ratio)) then
            parts(3) = merge(mean%window_error(), not_known, surfaces%enough_positions)
            why(3) = reason_few_positions
            call record%set_detail("repeats", real(surfaces%repeats, dp))
            call record%set_detail("whole_periods", real(surfaces%whole, dp))
         end if
         if (domain_error < 1.0_dp) then
            parts(5) = ratio_error(domain_error, ratio)
         else if (ieee_is_finite(ratio)) then
            why(5) = reason_small_domain
         end if
         do k = 1, size(names)
            if (k == 3 .and. .not. (surfaces%mismatch > 0.0_dp .and. ieee_is_finite(ratio))) cycle
            call record%set("mu_ratio_error_"//trim(names(k)), abs(parts(k)))
            if (.not. ieee_is_finite(parts(k))) call record%set_detail("why_"//trim(names(k)), real(why(k), dp))
         end do
      end associate
      call record%set("mu_ratio_error", sum(abs(parts)))
      if (why_no_grid_error(self) /= reason_coarser_status) return
      call record%set_note("coarser_status", trim(outcome_names(self%run%coarser%outcome)))
      if (allocated(self%run%coarser%message)) call record%set_note("coarser_message", self%run%coarser%message)
   end subroutine report_ratio

   !> Whether the friction ratio converges on two grids, and the smooth contact on three
   logical function has_limit(self, ratio)
      type(solver_t), intent(in) :: self
      real(dp), intent(in) :: ratio
      real(dp) :: change

      change = (ratio - self%run%coarser%ratio)/ratio
      has_limit = abs(change) <= max_change .and. .not. unresolved_spike(self%run%smooth%results, self%run%smooth%n)
      if (self%run%plan%surfaces%same_on_grids()) has_limit = has_limit .and. change <= max_increase
   end function has_limit

   !> Grid error of the friction ratio for order 1, since two grids do not show that order 2 is reached (Roache 1994: three times
   !> that for order 2); at least the effect of the error of the smooth film
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
      grid_error = max(grid_error, ratio_error(error(1), ratio))
   end function grid_error

   !> Parts of mu_ratio due to truncated and to unresolved waves, or why they are not known. Only tiles have truncated waves: a
   !> single wave or a feature is entirely on the grid.
   subroutine waves_of(self, waves, why)
      type(solver_t), intent(in) :: self
      real(dp), intent(out) :: waves(2)
      integer, intent(out) :: why

      associate (surfaces => self%run%plan%surfaces)
         why = reason_prediction
         waves = self%predicted_waves
         if (.not. self%waves_predicted) then
            why = merge(reason_stationary_waves, reason_not_predicted, surfaces%all_stationary())
            waves = merge(not_known, 0.0_dp, surfaces%unresolved > rounding)
         end if
         if (.not. (surfaces%left_out > rounding .and. surfaces%has_spectrum())) waves(1) = 0.0_dp
      end associate
   end subroutine waves_of

   !> Why two grids give no grid error; reason_none if they do
   pure integer function why_no_grid_error(self) result(why)
      type(solver_t), intent(in) :: self

      why = reason_none
      select case (self%run%coarser%outcome)
      case (outcome_converged)
         return
      case (outcome_running)
         if (.not. self%input%time%estimate_error) then
            why = reason_not_requested
         else if (self%run%plan%surfaces%move() .and. self%run%plan%steps > 0) then
            why = reason_steps
         else if (self%run%plan%coarse_run) then
            why = reason_not_yet
         else
            why = merge(reason_none_resolved, reason_small_grid, self%run%plan%levels > 2)
         end if
      case default
         why = reason_coarser_status
      end select
   end function why_no_grid_error
end submodule ehl_solver_results

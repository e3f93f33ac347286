! SPDX-License-Identifier: BSD-3-Clause
!> Named results of a run: problem, waves of the surfaces, transient and stationary rough contact, passage of a feature, friction
module ehl_report
   use ehl_contact_run, only: contact_run_t
   use ehl_extremes, only: extreme_film, extreme_pressure, extremes_t
   use ehl_friction_results, only: friction_results_t
   use ehl_kinds, only: dp, not_known, pi
   use ehl_moving_surfaces, only: moving_surfaces_t
   use ehl_plan, only: plan_t
   use ehl_record, only: record_t
   use ehl_scales, only: scales_t
   use ehl_wedge, only: wedge_narrow
   implicit none (type, external)
   private
   public :: report_friction, report_passage, report_stationary, report_problem, report_transient, report_waves

contains

   !> Operating point, grid and computing options
   subroutine report_problem(record, run)
      type(record_t), intent(inout) :: record
      type(contact_run_t), intent(in) :: run

      associate (plan => run%plan, point => run%plan%point, scales => run%plan%scales, grid => run%grid)
         call record%set(trim(merge("moes_m_line moes_l_line", "moes_m moes_l          ", &
                                    plan%contact%is_line() .or. plan%contact%is_roller()))// &
                         " alpha_bar speed_parameter hertz_pressure_Pa", &
                         [point%moes_m, point%moes_l, point%alpha_bar, point%speed_parameter, scales%pressure])
         if (scales%has_size()) call record%set("hertz_radius_m film_scale_m", [scales%length, scales%film])
         if (plan%contact%is_line()) then
            call record%set("shape", "line")
            if (.not. grid%is_row()) call record%set("points_y", grid%full_ny())
         else if (plan%contact%is_roller()) then
            call record%set("shape", "roller")
            call record%set("points_y", grid%full_ny())
         else if (.not. plan%contact%is_round()) then
            call record%set("radius_ratio angle_deg ellipticity", &
                            [plan%contact%radius_ratio, plan%contact%angle*180.0_dp/pi, plan%contact%ellipticity])
            if (scales%has_size()) call record%set("semi_axis_y_m", plan%contact%ellipticity*scales%length)
            call record%set("points_y", grid%full_ny())
         end if
         call record%set("points", grid%nx)
         call record%set("x_mesh y_mesh", [grid%hx, grid%hy])
         call record%set("half_domain", grid%mirror)
         call record%set("deflection", plan%engine)
         call record%set("threads", plan%threads)
      end associate
   end subroutine report_problem

   !> Results of a transient run, null unless it converged
   subroutine report_transient(record, run, converged, known, mean, stop_error)
      type(record_t), intent(inout) :: record
      type(contact_run_t), intent(in) :: run
      !> Whether the run converged, and whether friction is known
      logical, intent(in) :: converged, known
      !> Mean friction ratio, and its error at the end of the run
      real(dp), intent(out) :: mean, stop_error
      real(dp), allocatable :: films(:), pressures(:)
      real(dp) :: range(2), ratio, extremes(2)

      mean = not_known
      range = not_known
      stop_error = not_known
      ratio = not_known
      extremes = not_known
      associate (t => run%transient, surfaces => run%plan%surfaces)
         if (converged) then
            films = run%history%column("H_min")
            pressures = run%history%column("P_max")
            extremes = [minval(films(t%mean%first_of_mean():)), maxval(pressures(t%mean%first_of_mean():))]
            if (known) then
               mean = t%mean%mean(0.0_dp)
               range = t%mean%extremes()
            end if
            if (surfaces%pass_once()) then
               ! a passage ends by itself, and has no amplitude ratio
               stop_error = 0.0_dp
            else
               ratio = t%mean%amplitude_ratio()
               if (t%mean%has_change()) stop_error = t%mean%uncertainty()
            end if
         else if (known) then
            if (t%mean%has_mean()) call record%set("last_mu_ratio_mean", t%mean%mean(0.0_dp))
            if (t%mean%n > 0) call record%set("last_mu_ratio", t%mean%values(t%mean%n))
         end if
         call record%set("mu_ratio_min mu_ratio_max", range)
         if (.not. surfaces%pass_once()) call report_rough_extremes(record, run%plan, extremes)
         call record%set("amplitude_ratio", ratio)
         call report_amplitude(record, surfaces)
         call record%set("scheme", trim(merge("narrow", "paper ", run%plan%scheme == wedge_narrow)))
         call record%set("T T_period", [t%time, t%mean%period])
         if (surfaces%count() > 1) call record%set("T_mismatch", merge(surfaces%mismatch, not_known, surfaces%enough_positions))
         call record%set("T_mean", merge(t%mean%window(), 0.0_dp, t%mean%has_mean()))
         call record%set("steps", t%step)
         call record%set("steps_skipped", t%skipped)
         call record%set("cycles_per_step", real(t%total_cycles, dp)/max(t%step, 1))
         call record%set("coarsening_changed_at", t%policy%changed_at)
         call record%set("seconds_per_step step_residual_allowed", [run%seconds/max(t%step, 1), t%accuracy%largest])
      end associate
   end subroutine report_transient

   !> Extremes of pressure and film over a passage, with position and time; null unless the run converged
   subroutine report_passage(record, scales, extremes, converged)
      type(record_t), intent(inout) :: record
      type(scales_t), intent(in) :: scales
      type(extremes_t), intent(in) :: extremes
      logical, intent(in) :: converged
      !> Names of the extremes and suffixes of their values, in the order of extremes_t
      character(len=*), parameter :: names(4) = [character(len=11) :: "P_max_rough", "H_min_rough", "P_rise_max", &
                                                 "H_ratio_min"], parts(4) = [character(len=2) :: "", "_T", "_X", "_Y"]
      real(dp) :: found(4, 4)
      integer :: i, k

      found = extremes%found
      if (.not. converged) found = not_known
      do k = 1, size(names)
         do i = 1, size(parts)
            call record%set(trim(names(k))//trim(parts(i)), found(i, k))
         end do
      end do
      if (scales%has_size()) call record%set("p_max_rough_Pa h_min_rough_m", &
                                             [found(1, extreme_pressure)*scales%pressure, found(1, extreme_film)*scales%film])
   end subroutine report_passage

   !> Amplitudes of waves, heights or depths of features
   subroutine report_amplitude(record, surfaces)
      type(record_t), intent(inout) :: record
      type(moving_surfaces_t), intent(in) :: surfaces
      integer :: k

      do k = 1, surfaces%count()
         associate (amplitude => surfaces%of(k)%surface%amplitude)
            if (amplitude >= 0.0_dp) call record%set(named(surfaces, k, "amplitude"), amplitude)
         end associate
      end do
   end subroutine report_amplitude

   !> Name of a quantity of surface k, with 'second_' in front for the second one
   function named(surfaces, k, name)
      type(moving_surfaces_t), intent(in) :: surfaces
      integer, intent(in) :: k
      character(len=*), intent(in) :: name
      character(len=:), allocatable :: named

      named = name
      if (surfaces%of(k)%group == "second_surface") named = "second_"//name
   end function named

   !> Minimum film and maximum pressure of the rough contact
   subroutine report_rough_extremes(record, plan, values)
      type(record_t), intent(inout) :: record
      type(plan_t), intent(in) :: plan
      real(dp), intent(in) :: values(2)

      call record%set("H_min_rough P_max_rough", values)
      if (plan%scales%has_size()) call record%set("h_min_rough_m p_max_rough_Pa", values*[plan%scales%film, plan%scales%pressure])
   end subroutine report_rough_extremes

   !> Roughness, lambda ratio, and the fractions of the variance cut off, unresolved and truncated
   subroutine report_waves(record, run)
      type(record_t), intent(inout) :: record
      type(contact_run_t), intent(in) :: run
      real(dp) :: sigma, variance(2)
      integer :: k

      associate (surfaces => run%plan%surfaces, scales => run%plan%scales, smooth => run%smooth%results(run%level())%m)
         sigma = surfaces%rms_height()
         if (sigma > 0.0_dp) then
            if (scales%has_size()) call record%set("surface_rms_m surface_slope", &
                                                   [sigma*scales%film, surfaces%rms_slope()*scales%film/scales%length])
            call record%set("lambda_ratio lambda_ratio_central", [smooth%film_minimum, smooth%film_central]/sigma)
         end if
         if (surfaces%move_together()) call record%set("surface_correlation", surfaces%correlation(1))
         variance = 0.0_dp
         do k = 1, surfaces%count()
            variance = variance + [surfaces%of(k)%surface%variance, surfaces%of(k)%surface%variance_whole]
         end do
         if (variance(1) > 0.0_dp) call record%set("variance_cut", max(0.0_dp, 1.0_dp - variance(1)/variance(2)))
         call record%set("variance_unresolved variance_left_out", [surfaces%unresolved, surfaces%left_out])
      end associate
   end subroutine report_waves

   !> Results of the contact with a stationary rough surface, null unless it converged
   subroutine report_stationary(record, run, converged, known, ratio, algebraic)
      type(record_t), intent(inout) :: record
      type(contact_run_t), intent(in) :: run
      !> Whether the run converged, and whether friction is known
      logical, intent(in) :: converged, known
      !> Friction ratio, and its algebraic error
      real(dp), intent(out) :: ratio, algebraic
      integer :: k

      associate (rough => run%stationary, surfaces => run%plan%surfaces)
         ratio = merge(rough%mu_ratio(), not_known, converged .and. known)
         algebraic = merge(2.0_dp*rough%algebraic*rough%mu_ratio(), not_known, converged .and. known)
         if (known .and. .not. converged) call record%set("last_mu_ratio", rough%mu_ratio())
         call record%set("H_c_rough", merge(rough%m%film_central, not_known, converged))
         call report_rough_extremes(record, run%plan, merge([rough%m%film_minimum, rough%m%pressure_maximum], not_known, converged))
         do k = 1, surfaces%count()
            call record%set(named(surfaces, k, "x_start"), surfaces%of(k)%surface%x_start)
         end do
         call report_amplitude(record, surfaces)
         call record%set("rough_cycles", rough%total_cycles)
         call record%set("rough_parts", rough%parts)
         call record%set("rough_residual", rough%residual)
      end associate
   end subroutine report_stationary

   !> Coefficients of friction, the shear of the smooth contact, temperatures
   subroutine report_friction(record, plan, friction)
      type(record_t), intent(inout) :: record
      type(plan_t), intent(in) :: plan
      type(friction_results_t), intent(in) :: friction

      associate (scales => plan%scales, s => plan%sliding, f => friction)
         call record%set("rolling_moment", f%rolling_moment)
         if (scales%has_size()) call record%set(trim(merge("rolling_moment_N  ", "rolling_moment_N_m", plan%contact%is_line())), &
                                                f%rolling_moment*scales%pressure*scales%length**(1 + plan%contact%dimensions))
         call record%set("shear_law", trim(s%law))
         call record%set("slide_to_roll mu mu_smooth mu_isothermal mu_smooth_isothermal", &
                         [s%slide_to_roll, f%mu, f%mu_isothermal])
         if (plan%heat%active) call record%set("temperature_rise_max_K temperature_rise_wall_1_max_K "// &
                                               "temperature_rise_wall_2_max_K", f%rises)
         call record%set("shear_rate_mean_per_s shear_stress_max_Pa flash_temperature_K", &
                         [f%shear_rate, f%shear_stress, f%flash])
         call record%set_code("mu_note", f%reason)
         call record%set_detail("heat_estimate_K", plan%heat%estimate)
         call record%set_detail("beyond_measured", merge(1.0_dp, 0.0_dp, f%beyond_measured))
         if (s%loading > 0.0_dp) call record%set("thermal_loading thermal_reduction inlet_viscosity_Pa_s", &
                                                 [s%loading, s%reduction, s%inlet_viscosity])
      end associate
   end subroutine report_friction
end module ehl_report

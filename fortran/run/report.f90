! SPDX-License-Identifier: BSD-3-Clause
!> What a run says: lines of progress, and its results by name
module ehl_report
   use ehl_grid, only: grid_t
   use ehl_kinds, only: dp, pi
   use ehl_contact_results, only: contact_results_t
   use ehl_moving_surfaces, only: moving_surfaces_t
   use ehl_outcome, only: outcome_names
   use ehl_plan, only: plan_t
   use ehl_record, only: record_t
   use ehl_stationary_roughness, only: stationary_roughness_t
   use ehl_level_result, only: level_result_t
   use ehl_text, only: fixed, to_text
   use ehl_transient, only: transient_t
   use ehl_wedge, only: wedge_narrow
   use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
   implicit none (type, external)
   private
   public :: cycle_line, step_line, rest_line, report_scene, report_transient, report_rest, report_waves

contains

   !> Line about a cycle of the smooth contact
   function cycle_line(grid, result, stand) result(text)
      type(grid_t), intent(in) :: grid
      type(level_result_t), intent(in) :: result
      integer, intent(in) :: stand
      character(len=:), allocatable :: text

      text = to_text(grid%nx)//" x "//to_text(grid%full_ny())//"  cycle "//to_text(result%cycles)// &
             "  H_c "//fixed(result%m%film_central, "f10.6")//"  H_min "//fixed(result%m%film_minimum, "f10.6")// &
             ending(result%residual, stand)
   end function cycle_line

   !> Line about a time step
   function step_line(transient, stand) result(text)
      type(transient_t), intent(in) :: transient
      integer, intent(in) :: stand
      character(len=:), allocatable :: text

      text = "step "//to_text(transient%step)//"  T "//fixed(transient%time, "f8.4")//"  mu_r/mu_s "// &
             fixed(transient%m%friction/transient%friction_smooth, "f9.5")
      if (transient%mean%has_mean()) text = text//"  mean "//fixed(transient%mean%mean(0.0_dp), "f9.5")
      if (transient%mean%has_change()) text = text//" +- "//fixed(transient%mean%change(), "es8.1")
      text = text//"  H_min "//fixed(transient%m%film_minimum, "f10.6")//"  cycles "//to_text(transient%cycles)// &
             ending(transient%residual, stand)
   end function step_line

   !> Line about a cycle of the contact with a rough surface at rest
   function rest_line(grid, rest, stand) result(text)
      type(grid_t), intent(in) :: grid
      type(stationary_roughness_t), intent(in) :: rest
      integer, intent(in) :: stand
      character(len=:), allocatable :: text

      text = to_text(grid%nx)//" x "//to_text(grid%full_ny())//"  cycle "//to_text(rest%total_cycles)// &
             "  mu_r/mu_s "//fixed(rest%mu_ratio(), "f9.5")//"  H_c "//fixed(rest%m%film_central, "f10.6")// &
             "  H_min "//fixed(rest%m%film_minimum, "f10.6")//ending(rest%residual, stand)
      if (rest%share < 1.0_dp .and. .not. rest%smooth) text = text//", share of the roughness "//fixed(rest%share, "f7.4")
   end function rest_line

   !> What such a line ends with
   function ending(residual, stand) result(text)
      real(dp), intent(in) :: residual
      integer, intent(in) :: stand
      character(len=:), allocatable :: text
      text = "  residual "//fixed(residual, "es8.1")//"  "//trim(outcome_names(stand))
   end function ending

   !> Operating point, grid and means
   subroutine report_scene(record, plan, grid)
      type(record_t), intent(inout) :: record
      type(plan_t), intent(in) :: plan
      type(grid_t), intent(in) :: grid

      call record%set("moes_m", plan%point%moes_m)
      call record%set("moes_l", plan%point%moes_l)
      call record%set("alpha_bar", plan%point%alpha_bar)
      call record%set("speed_parameter", plan%point%speed_parameter)
      call record%set("hertz_pressure_Pa", plan%scales%pressure)
      if (plan%alpha_note /= "") call record%set("pressure_viscosity_note", plan%alpha_note)
      if (allocated(plan%lubricant_note)) call record%set("lubricant_note", plan%lubricant_note)
      if (plan%scales%has_size()) then
         call record%set("hertz_radius_m", plan%scales%length)
         call record%set("film_scale_m", plan%scales%film)
      end if
      if (.not. plan%contact%is_round()) then
         call record%set("radius_ratio", plan%contact%radius_ratio)
         call record%set("angle_deg", plan%contact%angle*180.0_dp/pi)
         call record%set("ellipticity", plan%contact%ellipticity)
         if (plan%scales%has_size()) call record%set("semi_axis_y_m", plan%contact%ellipticity*plan%scales%length)
         call record%set("points_y", grid%full_ny())
      end if
      call record%set("points", grid%nx)
      call record%set("x_mesh", grid%hx)
      call record%set("y_mesh", grid%hy)
      call record%set("half_domain", grid%mirror)
      call record%set("deflection", plan%engine)
      call record%set("threads", plan%threads)
   end subroutine report_scene

   !> The transient run: results null unless it came to a good end
   subroutine report_transient(record, plan, transient, good, known, seconds, films, pressures, mean, change)
      type(record_t), intent(inout) :: record
      type(plan_t), intent(in) :: plan
      type(transient_t), intent(in) :: transient
      logical, intent(in) :: good
      !> Whether friction is known where the bodies touch
      logical, intent(in) :: known
      real(dp), intent(in) :: seconds
      !> Least film and greatest pressure after each step
      real(dp), intent(in) :: films(:), pressures(:)
      !> Mean friction ratio, and its change at the end
      real(dp), intent(out) :: mean, change
      real(dp) :: range(2), ratio, least, greatest

      mean = ieee_value(mean, ieee_quiet_nan)
      range = mean
      change = mean
      ratio = mean
      least = mean
      greatest = mean
      if (good) then
         mean = transient%mean%mean(0.0_dp)
         range = transient%mean%extremes()
         least = minval(films(transient%mean%first_of_mean():))
         greatest = maxval(pressures(transient%mean%first_of_mean():))
         ratio = transient%mean%amplitude_ratio()
         if (transient%mean%has_change()) change = transient%mean%uncertainty()
         if (plan%surfaces%pass_once()) then
            ! a passage has an end, and no wave to compare amplitudes of
            change = 0.0_dp
            ratio = ieee_value(ratio, ieee_quiet_nan)
         end if
         if (.not. known) then
            mean = ieee_value(mean, ieee_quiet_nan)
            range = mean
         end if
      else if (known) then
         if (transient%mean%has_mean()) call record%set("last_mu_ratio_mean", transient%mean%mean(0.0_dp))
         if (transient%mean%n > 0) call record%set("last_mu_ratio", transient%mean%values(transient%mean%n))
      end if
      call record%set("mu_ratio_min", range(1))
      call record%set("mu_ratio_max", range(2))
      if (.not. plan%surfaces%pass_once()) call report_rough_extremes(record, plan, least, greatest)
      call record%set("amplitude_ratio", ratio)
      call report_amplitude(record, plan%surfaces)
      call record%set("scheme", trim(merge("narrow", "paper ", plan%scheme == wedge_narrow)))
      call record%set("T", transient%time)
      call record%set("T_period", transient%mean%period)
      if (plan%surfaces%count() > 1) call record%set("T_mismatch", merge(plan%surfaces%mismatch, &
         ieee_value(mean, ieee_quiet_nan), plan%surfaces%meets))
      call record%set("T_mean", merge(transient%mean%window(), 0.0_dp, transient%mean%has_mean()))
      call record%set("steps", transient%step)
      call record%set("steps_skipped", transient%skipped)
      call record%set("cycles_per_step", real(transient%total_cycles, dp)/max(transient%step, 1))
      call record%set("coarsening_changed_at", transient%policy%changed_at)
      call record%set("seconds_per_step", seconds/max(transient%step, 1))
      call record%set("step_residual_allowed", transient%accuracy%largest)
   end subroutine report_transient

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

   !> Name of a quantity of a surface: 'second_' before that of the second one
   function named(surfaces, k, name)
      type(moving_surfaces_t), intent(in) :: surfaces
      integer, intent(in) :: k
      character(len=*), intent(in) :: name
      character(len=:), allocatable :: named

      named = name
      if (surfaces%of(k)%group == "second_surface") named = "second_"//name
   end function named

   !> Least film and greatest pressure of the rough contact
   subroutine report_rough_extremes(record, plan, film, pressure)
      type(record_t), intent(inout) :: record
      type(plan_t), intent(in) :: plan
      real(dp), intent(in) :: film, pressure

      call record%set("H_min_rough", film)
      call record%set("P_max_rough", pressure)
      if (.not. plan%scales%has_size()) return
      call record%set("h_min_rough_m", film*plan%scales%film)
      call record%set("p_max_rough_Pa", pressure*plan%scales%pressure)
   end subroutine report_rough_extremes

   !> The roughness, smooth film over it, and what of it the grid carries
   subroutine report_waves(record, plan, m)
      type(record_t), intent(inout) :: record
      type(plan_t), intent(in) :: plan
      !> The smooth contact
      type(contact_results_t), intent(in) :: m
      real(dp) :: sigma, variance(2)
      integer :: k

      sigma = plan%surfaces%rms_height()
      if (sigma > 0.0_dp) then
         if (plan%scales%has_size()) then
            call record%set("surface_rms_m", sigma*plan%scales%film)
            call record%set("surface_slope", plan%surfaces%rms_slope()*plan%scales%film/plan%scales%length)
         end if
         call record%set("lambda_ratio", m%film_minimum/sigma)
         call record%set("lambda_ratio_central", m%film_central/sigma)
      end if
      variance = 0.0_dp
      do k = 1, plan%surfaces%count()
         variance = variance + [plan%surfaces%of(k)%surface%variance, plan%surfaces%of(k)%surface%variance_whole]
      end do
      if (variance(1) > 0.0_dp) call record%set("variance_cut", max(0.0_dp, 1.0_dp - variance(1)/variance(2)))
      call record%set("variance_unresolved", plan%surfaces%unresolved)
      call record%set("variance_left_out", plan%surfaces%left_out)
   end subroutine report_waves

   !> The contact with a rough surface at rest: results null unless there are any
   subroutine report_rest(record, plan, rest, good, known, ratio, algebraic)
      type(record_t), intent(inout) :: record
      type(plan_t), intent(in) :: plan
      type(stationary_roughness_t), intent(in) :: rest
      !> Whether they are, and whether friction is known where the bodies touch
      logical, intent(in) :: good, known
      !> Friction ratio, and its algebraic error
      real(dp), intent(out) :: ratio, algebraic
      real(dp) :: nothing
      integer :: k

      nothing = ieee_value(nothing, ieee_quiet_nan)
      ratio = merge(rest%mu_ratio(), nothing, good .and. known)
      algebraic = merge(2.0_dp*rest%algebraic*rest%mu_ratio(), nothing, good .and. known)
      if (known .and. .not. good) call record%set("last_mu_ratio", rest%mu_ratio())
      call record%set("H_c_rough", merge(rest%m%film_central, nothing, good))
      call report_rough_extremes(record, plan, merge(rest%m%film_minimum, nothing, good), &
                                 merge(rest%m%pressure_maximum, nothing, good))
      do k = 1, plan%surfaces%count()
         call record%set(named(plan%surfaces, k, "x_start"), plan%surfaces%of(k)%surface%x_start)
      end do
      call report_amplitude(record, plan%surfaces)
      call record%set("rough_cycles", rest%total_cycles)
      call record%set("rough_parts", rest%parts)
      call record%set("rough_residual", rest%residual)
   end subroutine report_rest
end module ehl_report

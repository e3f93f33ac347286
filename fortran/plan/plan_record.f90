! SPDX-License-Identifier: BSD-3-Clause
!> Named numbers of a plan, for the text written by pyehl
module ehl_plan_record
   use ehl_cycle, only: coarsening_alcouffe
   use ehl_feature, only: feature_t
   use ehl_kinds, only: dp, not_known
   use ehl_moving_surfaces, only: moving_surfaces_t
   use ehl_plan, only: plan_t
   use ehl_plan_need, only: bytes_needed, frames_kept, seconds_needed
   use ehl_record, only: record_t
   use ehl_resolution, only: points_for_inlet, points_for_solution
   use ehl_steady_options, only: max_error
   use ehl_text, only: to_text
   use ehl_wedge, only: wedge_narrow
   implicit none (type, external)
   private
   public :: plan_record

contains

   !> Record of operating point, lubricant, surfaces, grid, cycles, memory and time
   function plan_record(plan) result(record)
      type(plan_t), intent(in) :: plan
      type(record_t) :: record
      real(dp) :: frames_min, frames_max

      associate (point => plan%point, scales => plan%scales, contact => plan%contact, s => plan%sliding, l => plan%lubricant)
         call record%set("moes_m moes_l alpha_bar speed_parameter length film pressure", &
                         [point%moes_m, point%moes_l, point%alpha_bar, point%speed_parameter, scales%length, scales%film, &
                          scales%pressure])
         call record%set("has_size", scales%has_size())
         call record%set("round", contact%is_round())
         call record%set("line", contact%is_line())
         call record%set("roller", contact%is_roller())
         call record%set("round_m", point%round_m)
         call record%set("ellipticity radius_ratio", [contact%ellipticity, contact%radius_ratio])
         call record%set("slide_to_roll mean_velocity heat_estimate_K thermal_loading thermal_reduction inlet_viscosity", &
                         [s%slide_to_roll, s%mean_velocity, plan%heat%estimate, s%loading, s%reduction, s%inlet_viscosity])
         call record%set_code("heat", plan%heat%reason)
         call record%set("thins_flow", l%shear%thins_flow())
         call record%set("boundary_film hardness boundary_friction", [l%boundary_film, l%boundary_limit, &
                                                                      l%boundary_stress*l%shear%scale/scales%pressure])
         call record%set("inlet_in_doubt", plan%inlet%may_be_artefact(plan%finest%hx))
         call record%set("points_for_inlet", merge(points_for_inlet(plan%inlet, plan%finest), 0, l%boundary_film > 0.0_dp))
         call record%set("points_for_solution", points_for_solution(contact, point, plan%finest))
      end associate
      call surfaces_record(record, plan%surfaces)
      associate (g => plan%coarsest, finest => plan%finest)
         call record%set("starved", plan%starved)
         call record%set("layer", plan%layer)
         call record%set("x_inlet x_outlet y_extent domain_error", [g%x0, g%x(g%nx), g%y(g%ny), plan%domain_error(1)])
         call record%set("flooded", plan%flooded)
         call record%set("mirror", g%mirror)
         call record%set("mesh_x mesh_y", [finest%hx, finest%hy])
         call record%set("points", finest%nx)
         call record%set("points_y", finest%full_ny())
         call record%set("stored_rows", finest%ny)
         call record%set("coarsest_points", g%nx)
         call record%set("coarsest_rows", g%ny)
         call record%set("strip_width", merge(g%full_ny()*g%hy, 0.0_dp, g%periodic .and. .not. g%is_row()))
      end associate
      call record%set("levels", plan%levels)
      call record%set("start_level", plan%start)
      call record%set("deflection", plan%engine)
      call record%set("threads", plan%threads)
      call record%set("target_error accuracy max_error time_tolerance frame_interval", &
                      [plan%target_error, plan%accuracy, max_error, plan%time_tolerance, plan%frame_interval])
      call record%set("narrow_scheme", plan%scheme == wedge_narrow)
      call record%set("coarse_run", plan%coarse_run)
      call record%set("predicted_start", plan%predicted_start)
      if (allocated(plan%fallback_reason)) call record%set("fallback_reason", plan%fallback_reason)
      call record%set("steps", plan%steps)
      call record%set("duty", plan%duty%active)
      if (plan%duty%active) call record%set("duty_steps duty_begin duty_end", &
         [plan%duty%steps_expected(plan%finest%hx), [plan%duty%begin(), plan%duty%end_time()]*plan%duty%time_scale])
      call record%set("cycle", plan%cycle_letter)
      call record%set("pre", plan%cycle%pre)
      call record%set("post", plan%cycle%post)
      call record%set("second_is_v", plan%cycle%full .and. .not. plan%second_cycle%full)
      call record%set("second_pre", plan%second_cycle%pre)
      call record%set("second_post", plan%second_cycle%post)
      call record%set("step_cycle", plan%step_cycle_letter)
      call record%set("step_pre", plan%step_cycle%pre)
      call record%set("step_post", plan%step_cycle%post)
      call record%set("alcouffe", plan%step_cycle%coarsening == coarsening_alcouffe)
      call record%set("coarsening_may_change", plan%coarsening_may_change)
      call frames_kept(plan, frames_min, frames_max)
      call record%set("bytes seconds frames_min frames_max", [bytes_needed(plan, 1), seconds_needed(plan), frames_min, frames_max])
   end function plan_record

   !> Record of the rough surfaces, heights in a^2/R, lengths in a
   subroutine surfaces_record(record, surfaces)
      type(record_t), intent(inout) :: record
      type(moving_surfaces_t), intent(in) :: surfaces
      integer :: k

      call record%set("surfaces", surfaces%count())
      if (.not. surfaces%rough()) return
      call record%set("move", surfaces%move())
      call record%set("some_stationary", surfaces%some_stationary())
      call record%set("pass_once", surfaces%pass_once())
      call record%set("enough_positions", surfaces%enough_positions)
      call record%set("has_spectrum", surfaces%has_spectrum())
      call record%set("repeats", surfaces%repeats)
      call record%set("whole_periods", surfaces%whole)
      call record%set("period mismatch unresolved left_out rms_height rms_slope correlation end_of_passage", &
                      [surfaces%period, surfaces%mismatch, surfaces%unresolved, surfaces%left_out, surfaces%rms_height(), &
                       surfaces%rms_slope(), not_known, not_known])
      if (surfaces%move_together()) call record%set("correlation", surfaces%correlation(1))
      if (surfaces%move() .and. surfaces%pass_once()) call record%set("end_of_passage", surfaces%end_of_passage())
      do k = 1, surfaces%count()
         associate (member => surfaces%of(k), name => "surface_"//to_text(k)//"_")
            call record%set(name//"group", member%group)
            call record%set(name//"at_rest", member%surface%at_rest())
            associate (s => member%surface)
               call record%set(name//"velocity_ratio", s%velocity_ratio)
               call record%set(name//"x_start", s%x_start)
               call record%set(name//"period", s%period)
               call record%set(name//"amplitude", s%amplitude)
               call record%set(name//"rms_height", s%rms_height())
               call record%set(name//"variance", s%variance)
               call record%set(name//"variance_whole", s%variance_whole)
            end associate
            select type (feature => member%surface)
            type is (feature_t)
               call record%set(name//"width", feature%width)
               call record%set(name//"length", feature%length)
               call record%set(name//"y_start", feature%y_start)
               call record%set(name//"spacing_y", feature%period_y)
               call record%set(name//"reach", feature%reach)
            end select
         end associate
      end do
   end subroutine surfaces_record
end module ehl_plan_record

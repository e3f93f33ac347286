! SPDX-License-Identifier: BSD-3-Clause
!> The plan of a run: what a case needs, decided once.
module ehl_plan
   use ehl_case, only: case_t
   use ehl_case_defaults, only: is_short_of_oil
   use ehl_case_grid, only: blunt_spike, high_spike
   use ehl_case_point, only: find_contact, operating_point
   use ehl_contact, only: contact_t
   use ehl_cycle, only: coarsening_alcouffe, coarsening_classical, cycle_options_t
   use ehl_domain, only: domain_cost, domain_t, layer_that_floods
   use ehl_duty, only: duty_t
   use ehl_friction_mean, only: automatic_periods
   use ehl_film_formula, only: starved_film
   use ehl_grid_error, only: relative_errors
   use ehl_grid, only: coarsest_most, find_levels, grid_t, new_grid
   use ehl_inlet, only: inlet_t
   use ehl_kinds, only: dp
   use ehl_lubricant, only: lubricant_t
   use ehl_moes, only: operating_t
   use ehl_moving_surfaces, only: moving_surfaces_t
   use ehl_plan_duty, only: plan_duty
   use ehl_plan_friction, only: sliding_t
   use ehl_plan_heat, only: heat_plan_t, may_touch, plan_contact, plan_heat
   use ehl_plan_surface, only: check_carried, make_surfaces
   use ehl_resolution, only: has_solution
   use ehl_scales, only: scales_t
   use ehl_status, only: ehl_bad_input, status_t
   use ehl_steady_options, only: steady_options_t
   use ehl_surface, only: aliased_below, resolved_from
   use ehl_predicted_start, only: steps_needed
   use ehl_step_policy, only: damped_sweep, whole_correction
   use ehl_strip_grid, only: make_strip
   use ehl_text, only: fixed, to_text
   use ehl_wedge, only: wedge_narrow, wedge_separate
   implicit none (type, external)
   private
   public :: plan_t, make_plan

   !> Nested iteration starts on a grid of at least that many nodes a side that has a solution
   integer, parameter :: start_fewest = 33
   !> Intervals of the coarsest grid of a line
   integer, parameter :: coarsest_of_line = 64
   !> Lengths of thick films, (2 H_c)^(1/2) [a], and largest mesh of the coarsest grid in terms of them
   real(dp), parameter :: thick_film = 0.8_dp, coarsest_mesh = 0.9_dp
   !> A-priori error of H_c of grids that resolve the inlet: a smooth contact that fails there is restarted with damped cycles
   real(dp), parameter :: resolved_error = 0.1_dp
   !> Most time steps until the friction of a rough surface can be known, and where their number is asked for
   integer, parameter :: max_steps = 100000, max_steps_asked_for = 1000000000

   !> Extent of the dry contact across the motion over that along it from which on it does so on any grid: cycles go to and
   !> fro between two states there
   real(dp), parameter :: wide = 2.0_dp
   !> What makes coarse grids leave a spike to the sweeps: an extent across the motion over that along it from which on the
   !> trailing edge moves from column to column in a few rows
   real(dp), parameter :: oblique = 4.0_dp
   !> Extent from which on all steps under a duty take their changes in parts: 7 cycles a step in place of 80
   real(dp), parameter :: long = 4.0_dp

   !> What the smooth contact needs, and all else
   type, extends(steady_options_t) :: plan_t
      class(contact_t), allocatable :: contact
      type(scales_t) :: scales
      type(operating_t) :: point
      type(lubricant_t) :: lubricant
      !> Whether the inlet is meant to be short of oil
      logical :: starved = .false.
      !> Central film of a flooded one, by formula
      real(dp) :: film_flooded = 0.0_dp
      !> The same with the layer that arrives
      real(dp) :: film_starved = 0.0_dp
      !> Whether the smooth contact may touch at the boundary film
      logical :: touches = .false.
      !> What absolute friction needs to know
      type(sliding_t) :: sliding
      !> The heat of it
      type(heat_plan_t) :: heat
      !> Coarsest and finest grid
      type(grid_t) :: coarsest, finest
      !> Shares of H_c and H_min of the flooded contact that the domain changes
      real(dp) :: domain_cost(2) = 0.0_dp
      character(len=:), allocatable :: engine
      !> Cycles of a time step
      type(cycle_options_t) :: step_cycle
      !> Whether time steps may go over from classical to Alcouffe coarsening
      logical :: coarsening_may_change = .false.
      !> The cycles in letters
      character(len=1) :: cycle_letter = "F", step_cycle_letter = "V"
      integer :: threads = 1
      !> The rough surfaces, and what changes with time
      type(moving_surfaces_t) :: surfaces
      type(duty_t) :: duty
      !> Whether the next coarser grid resolves the surfaces too, so that the friction of both can be extrapolated
      logical :: extrapolates = .false.
      !> Scheme of the wedge and squeeze terms in time steps
      integer :: scheme = wedge_narrow
      !> Begin the transient run when the roughness comes near the contact
      logical :: skip_start = .true.
      !> Begin it with the contact full of roughness, from a prediction
      logical :: predicted_start = .false.
      !> Why it does not, where that was asked for
      character(len=:), allocatable :: fallback_reason
      !> Repeat the run on the next coarser grid, for the grid error of the friction ratio
      logical :: coarse_run = .false.
      !> Relative change of the mean friction ratio at which to stop, most periods, exact steps
      real(dp) :: time_tolerance = 1.0e-3_dp
      integer :: max_periods = 0, steps = 0
      !> Time between the frames that are kept; 0: none
      real(dp) :: frame_interval = 0.0_dp
   contains
      procedure :: update_resolved_fraction
      procedure :: goes_on
      procedure :: has_steps
   end type plan_t

   !> Share of the variance that the coarser of two grids may leave unresolved where friction is extrapolated
   real(dp), parameter :: unresolved_most = 1.0e-6_dp

contains

   !> Decide how a case is solved
   subroutine make_plan(input, surfaces, plan, status, heights, second_heights)
      type(case_t), intent(in) :: input
      !> The surfaces, if they have been made already; the plan takes them over
      type(moving_surfaces_t), intent(inout) :: surfaces
      type(plan_t), intent(out) :: plan
      type(status_t), intent(inout) :: status
      !> Heights of the maps of both surfaces [m], X first, in place of files; of size 0: none
      real(dp), intent(in), optional :: heights(:, :), second_heights(:, :)
      real(dp) :: rho, film

      call plan_contact(input, plan%contact, plan%scales, plan%point, plan%sliding, plan%lubricant, rho, film, status)
      if (status%failed()) return
      plan%flooded = input%grid%border == "flooded"
      plan%layer = input%inlet%film_hertz
      plan%passages = input%inlet%passages
      plan%replenishment = input%inlet%replenishment
      plan%starved = is_short_of_oil(input)
      plan%heat = plan_heat(input, plan%contact, plan%scales, plan%sliding, plan%lubricant, film)
      film = plan%lubricant%shear%thinned_film(film, plan%point%speed_parameter)
      plan%touches = may_touch(plan%lubricant, film)
      if (plan%lubricant%boundary_film > 0.0_dp) plan%inlet = inlet_t(film, plan%lubricant%boundary_film/rho, &
                                                                         plan%lubricant%boundary_stress)
      plan%film_flooded = film
      plan%film_starved = merge(min(film, plan%layer/rho), starved_film(film, plan%layer/rho), plan%contact%is_line())
      plan%film_expected = film
      if (plan%layer > 0.0_dp) plan%film_expected = plan%film_starved
      ! a film that is thicker than the gap where the oil begins carries nothing
      if (plan%starved) plan%film_expected = min(plan%film_expected, input%grid%x_inlet**2)
      plan%film_expected = max(plan%film_expected, plan%lubricant%boundary_film)
      plan%engine = trim(input%solver%deflection)
      plan%accuracy = input%solver%accuracy
      plan%max_cycles = input%solver%max_cycles
      plan%line = plan%contact%is_line()
      plan%newtonian_circle = plan%contact%is_round() .and. .not. plan%lubricant%shear%thins_flow()
      plan%guarded = .not. plan%contact%is_round()
      plan%threads = input%solver%threads
      plan%target_error = input%grid%target_error
      plan%scheme = merge(wedge_narrow, wedge_separate, input%time%scheme == "narrow")
      plan%skip_start = input%time%skip_start
      plan%time_tolerance = input%time%tolerance
      plan%max_periods = input%time%max_periods
      plan%steps = input%time%steps
      plan%frame_interval = input%output%frame_interval
      plan%duty = plan_duty(input, plan%scales, plan%sliding%inlet_viscosity)
      if (plan%duty%active) plan%scheme = wedge_separate
      if (surfaces%rough()) then
         call move_alloc(surfaces%of, plan%surfaces%of)
      else
         call make_surfaces(input, plan%scales, plan%surfaces, status, heights, second_heights)
      end if
      plan%duty%rough = plan%surfaces%rough()
      if (input%time%start == "prediction" .and. plan%surfaces%move() .and. .not. plan%duty%active) call pick_start(plan)
      call pick_cycle(input, plan)
      call pick_grids(input, plan, status)
      ! where the flow thins cycles that spare spikes diverge on coarse grids (kappa = 12, L = 28, Eyring)
      if (plan%lubricant%shear%thins_flow()) plan%spares_from = plan%levels
      if (plan%touches .or. plan%contact%reach(2) <= oblique*plan%contact%reach(1)) plan%spares_from = huge(plan%spares_from)
      if (status%failed() .or. .not. plan%surfaces%rough()) return
      call plan%surfaces%use_threads(plan%threads)
      call plan%surfaces%find_period(merge(plan%max_periods, automatic_periods, plan%max_periods > 0))
      plan%coarse_run = input%time%estimate_error .and. plan%levels > 2 .and. (plan%surfaces%rest() .or. plan%steps == 0) &
                        .and. .not. plan%duty%active
      call plan%update_resolved_fraction(plan%finest)
      call check_carried(plan%surfaces, plan%finest, status)
      if (.not. status%failed()) call check_steps(plan, status)
   end subroutine make_plan

   !> Begin with the contact full of roughness where that can be predicted
   subroutine pick_start(plan)
      type(plan_t), intent(inout) :: plan

      if (plan%surfaces%pass_once()) then
         plan%fallback_reason = "a single feature passes once"
      else if (plan%surfaces%some_rest()) then
         plan%fallback_reason = "one of the surfaces is at rest"
      else if (plan%target_error > 0.0_dp) then
         plan%fallback_reason = "the grid of grid.target_error is not known before"
      end if
      plan%predicted_start = .not. allocated(plan%fallback_reason)
   end subroutine pick_start

   !> Whether something follows the smooth contact
   pure logical function goes_on(self)
      class(plan_t), intent(in) :: self
      goes_on = self%surfaces%rough() .or. self%duty%active
   end function goes_on

   !> Whether there are time steps
   pure logical function has_steps(self)
      class(plan_t), intent(in) :: self
      has_steps = self%surfaces%move() .or. self%duty%active
   end function has_steps

   !> What of the surfaces a grid resolves
   subroutine update_resolved_fraction(self, grid)
      class(plan_t), intent(inout) :: self
      type(grid_t), intent(in) :: grid

      call self%surfaces%see(grid)
      if (.not. self%coarse_run) return
      ! nothing would be left of a surface on the next coarser grid
      self%coarse_run = self%surfaces%max_unresolved(grid%coarser(), aliased_below) < 1.0_dp
      self%extrapolates = self%coarse_run .and. .not. self%surfaces%pass_once() .and. &
                          self%surfaces%max_unresolved(grid%coarser(), resolved_from) <= unresolved_most
   end subroutine update_resolved_fraction

   !> Refuse a surface so slow that the friction cannot be known within a sensible number of steps
   subroutine check_steps(plan, status)
      type(plan_t), intent(in) :: plan
      type(status_t), intent(inout) :: status
      real(dp) :: steps
      integer :: most
      character(len=:), allocatable :: what

      if (.not. plan%surfaces%move() .or. plan%duty%active) return
      associate (slowest => plan%surfaces%of(plan%surfaces%slowest()))
         most = merge(max_steps_asked_for, max_steps, plan%steps > 0)
         steps = steps_needed(plan%surfaces, plan%finest%hx, plan%skip_start, plan%predicted_start)
         if (steps <= most) then
            ! steps that are skipped are counted, too
            most = max_steps_asked_for
            steps = steps_needed(plan%surfaces, plan%finest%hx, .false., plan%predicted_start)
            if (steps <= most) return
         end if
         what = trim(slowest%group)//".velocity_ratio = "//to_text(slowest%surface%velocity_ratio)//": so slow a surface needs "
         if (plan%surfaces%repeats > 1) what = what//"by "//to_text(plan%surfaces%repeats)//" periods "
         ! rounded up: what is named will do
         call status%fail(ehl_bad_input, what//fixed(steps, "es12.2e3")//" time steps until its friction is known, more than "// &
                          to_text(most)//new_line("a")//"expected: a velocity ratio of at least "// &
                          fixed(1.005_dp*steps*slowest%surface%velocity_ratio/most, "es12.2e3")// &
                          " on this grid, or 0: a rough surface at rest is a steady contact")
      end associate
   end subroutine check_steps

   !> Kind of cycle, for the smooth contact and for time steps
   subroutine pick_cycle(input, plan)
      type(case_t), intent(in) :: input
      type(plan_t), intent(inout) :: plan
      logical :: row

      if (input%solver%cycle /= "auto") then
         plan%cycle_letter = input%solver%cycle(1:1)
         plan%step_cycle_letter = plan%cycle_letter
      end if
      ! sweeps of one row are all but Newton steps
      row = plan%contact%is_line() .and. .not. plan%surfaces%width() > 0.0_dp
      if (row .and. input%solver%cycle == "auto") plan%cycle_letter = "V"
      plan%cycle = cycle_of(plan%cycle_letter)
      if (row) plan%cycle%pre = 1
      plan%cycle%spare_spikes = has_sharp_spike(plan)
      plan%second_cycle = plan%cycle
      if (plan%cycle%full .and. input%solver%cycle == "auto" .and. .not. (plan%surfaces%rough() .or. plan%touches)) then
         ! The first leaves so little that is smooth that one visit to the coarser levels will do. Not before rough runs:
         ! the error of the smooth friction is one of the ratio.
         plan%second_cycle = cycle_of("V")
         plan%second_cycle%spare_spikes = plan%cycle%spare_spikes
      end if
      ! A time step begins close to its solution, so that the cheapest cycle wins; with two sweeps after the coarse
      ! grids rather than before, more steps take a single one
      plan%step_cycle = cycle_of(plan%step_cycle_letter)
      plan%step_cycle%pre = 1
      plan%step_cycle%post = 2
      plan%step_cycle%finest_only = plan%duty%active .and. plan%contact%reach(2) > wide*plan%contact%reach(1)
      if (plan%duty%active .and. plan%contact%reach(2) > long*plan%contact%reach(1)) then
         plan%step_cycle%relaxation_factor = damped_sweep
         plan%step_cycle%correction_factor = whole_correction
      end if
      plan%coarsening_may_change = input%solver%coarsening == "auto" .and. .not. (row .or. input%contact%is_roller())
      plan%step_cycle%coarsening = merge(coarsening_alcouffe, coarsening_classical, &
                                         input%solver%coarsening == "alcouffe")
   end subroutine pick_cycle

   !> Whether the pressure spike of a smooth contact is a few nodes wide along an edge that is oblique to the rows
   pure logical function has_sharp_spike(plan)
      type(plan_t), intent(in) :: plan

      has_sharp_spike = plan%contact%reach(2) > oblique*plan%contact%reach(1) .and. plan%point%moes_l > high_spike .and. &
                        plan%point%alpha_bar > blunt_spike(plan%point%moes_l) .and. &
                        .not. (plan%surfaces%rough() .or. plan%touches)
   end function has_sharp_spike

   !> Options of a kind of cycle
   pure function cycle_of(letter) result(options)
      character(len=1), intent(in) :: letter
      type(cycle_options_t) :: options

      options%gamma = merge(2, 1, letter == "W")
      options%full = letter == "F"
   end function cycle_of

   !> Half or whole domain, levels, start of the nested iteration
   subroutine pick_grids(input, plan, status)
      type(case_t), intent(in) :: input
      type(plan_t), intent(inout) :: plan
      type(status_t), intent(inout) :: status
      type(grid_t) :: grid
      logical :: mirror
      integer :: intervals(2), level
      real(dp) :: film, width

      if (status%failed()) return
      mirror = input%solver%symmetry == "auto" .and. plan%contact%is_even() .and. plan%surfaces%even_in_y()
      call find_levels(input%grid%points, merge(input%grid%points, input%grid%points_y, plan%contact%is_line()), plan%levels, &
                       intervals)
      if (plan%contact%is_line()) then
         ! one row of nodes is solved directly on a finer grid for next to nothing
         do while (intervals(1) < merge(coarsest_most, coarsest_of_line, plan%surfaces%width() > 0.0_dp) .and. plan%levels > 1)
            intervals = 2*intervals
            plan%levels = plan%levels - 1
         end do
      end if
      ! a coarsest grid that does not resolve a thick film corrects it at random
      film = sqrt(2.0_dp*plan%film_expected)
      if (plan%levels > 1 .and. 2*minval(intervals) <= coarsest_most .and. film > thick_film .and. &
          input%grid%x_outlet - input%grid%x_inlet > coarsest_mesh*film*intervals(1)) then
         intervals = 2*intervals
         plan%levels = plan%levels - 1
      end if
      if (plan%levels == 0) then
         call status%fail(ehl_bad_input, "grid of "//to_text(input%grid%points)//" points cannot be coarsened far enough")
         return
      end if
      if (plan%target_error > 0.0_dp) then
         plan%levels = 1
         do while (intervals(1)*2**plan%levels + 1 <= input%grid%max_points)
            plan%levels = plan%levels + 1
         end do
      end if
      associate (g => input%grid)
         if (plan%contact%is_line()) then
            width = plan%surfaces%width()
            call make_strip(width, intervals(1), plan%levels, g%x_inlet, g%x_outlet, mirror, plan%surfaces%rough() .and. &
                            input%solver%coarsening == "alcouffe", plan%coarsest, status)
            if (status%failed()) return
         else
            plan%coarsest = new_grid(intervals(1) + 1, intervals(2) + 1, g%x_inlet, g%x_outlet, g%y_extent, mirror)
            plan%coarsest%ends = plan%contact%is_roller()
         end if
         plan%domain_cost = domain_cost(plan%contact, plan%point, domain_t(g%x_inlet, g%x_outlet, g%y_extent), plan%flooded, &
                                        plan%starved .and. plan%layer <= layer_that_floods(plan%contact, plan%point, g%x_inlet))
      end associate
      grid = plan%coarsest
      plan%start = 0
      do level = 1, plan%levels
         if (level > 1) grid = grid%finer()
         if (plan%start == 0 .and. grid%nx >= start_fewest .and. &
             (plan%touches .or. has_solution(plan%contact, plan%point, grid))) plan%start = level
      end do
      if (plan%start == 0) plan%start = plan%levels
      plan%finest = grid
      associate (errors => relative_errors(plan%contact, plan%point, grid%hx))
         plan%may_restart = errors(1) <= resolved_error .or. plan%touches .or. &
                            plan%contact%reach(2) > wide*plan%contact%reach(1)
      end associate
   end subroutine pick_grids
end module ehl_plan

! SPDX-License-Identifier: BSD-3-Clause
!> Plan of a run: all decisions on how a case is solved
module ehl_plan
   use ehl_case, only: case_t
   use ehl_case_defaults, only: is_starved
   use ehl_contact, only: contact_t
   use ehl_cycle, only: cycle_options_t
   use ehl_domain, only: domain_error
   use ehl_duty, only: duty_t
   use ehl_friction_mean, only: automatic_periods
   use ehl_film_formula, only: starved_film
   use ehl_grid, only: grid_t
   use ehl_inlet, only: inlet_t
   use ehl_kinds, only: dp
   use ehl_lubricant, only: lubricant_t
   use ehl_moes, only: operating_t
   use ehl_moving_surfaces, only: moving_surfaces_t
   use ehl_plan_duty, only: plan_duty
   use ehl_plan_friction, only: sliding_t
   use ehl_plan_heat, only: heat_plan_t, may_have_solid_contact, plan_contact, plan_heat
   use ehl_plan_surface, only: check_resolved, make_surfaces
   use ehl_scales, only: scales_t
   use ehl_status, only: ehl_bad_input, status_t
   use ehl_steady_options, only: steady_options_t
   use ehl_surface, only: aliased_below, resolved_from
   use ehl_predicted_start, only: steps_needed
   use ehl_text, only: fixed, to_text
   use ehl_wedge, only: wedge_narrow, wedge_separate
   implicit none (type, external)
   private
   public :: plan_t, make_plan

   !> Maximum number of time steps of a rough surface: by default, and if the case sets time.steps
   integer, parameter :: max_steps = 100000, max_steps_given = 1000000000

   !> Aspect ratio Y/X of the dry contact above which a restart is allowed on any grid, since cycles may alternate between two
   !> states; under a duty the damping of a step then applies to the finest grid alone
   real(dp), parameter :: wide = 2.0_dp
   !> Aspect ratio Y/X above which coarse grids leave a sharp spike to relaxation, since the trailing edge moves from column to
   !> column within a few rows
   real(dp), parameter :: oblique = 4.0_dp

   !> Plan of the smooth contact and of the later phases
   type, extends(steady_options_t) :: plan_t
      class(contact_t), allocatable :: contact
      type(scales_t) :: scales
      type(operating_t) :: point
      type(lubricant_t) :: lubricant
      !> Whether the inlet is starved
      logical :: starved = .false.
      !> Central film of the flooded contact, by formula [a^2/R]
      real(dp) :: film_flooded = 0.0_dp
      !> Central film with the given oil layer, by formula [a^2/R]
      real(dp) :: film_starved = 0.0_dp
      !> Whether the smooth contact may have solid contact at the boundary film
      logical :: solid_contact = .false.
      !> Data for absolute friction
      type(sliding_t) :: sliding
      !> Data for frictional heating
      type(heat_plan_t) :: heat
      !> Coarsest and finest grid
      type(grid_t) :: coarsest, finest
      !> Relative domain errors of H_c and H_min
      real(dp) :: domain_error(2) = 0.0_dp
      character(len=:), allocatable :: engine
      !> Options of the cycles of a time step
      type(cycle_options_t) :: step_cycle
      !> Whether time steps may change from classical to Alcouffe coarsening
      logical :: coarsening_may_change = .false.
      !> Letters of the cycles: V, F or W
      character(len=1) :: cycle_letter = "F", step_cycle_letter = "V"
      integer :: threads = 1
      !> The rough surfaces, and the duty
      type(moving_surfaces_t) :: surfaces
      type(duty_t) :: duty
      !> Whether the next coarser grid resolves the surfaces too, so that the friction ratio can be extrapolated
      logical :: extrapolates = .false.
      !> Scheme of the wedge and squeeze terms in time steps
      integer :: scheme = wedge_narrow
      !> Whether the time steps begin when the roughness approaches the contact
      logical :: skip_start = .true.
      !> Whether the time steps begin with the contact filled with roughness, from a prediction
      logical :: predicted_start = .false.
      !> Why a requested prediction is not used
      character(len=:), allocatable :: fallback_reason
      !> Whether to repeat the run on the next coarser grid, for the grid error of the friction ratio
      logical :: coarse_run = .false.
      !> Relative change of the mean friction ratio at which to stop; maximum number of periods; exact number of steps
      real(dp) :: time_tolerance = 1.0e-3_dp
      integer :: max_periods = 0, steps = 0
      !> Time between frames; 0: no frames
      real(dp) :: frame_interval = 0.0_dp
   contains
      procedure :: update_resolved_fraction
      procedure :: has_next_phase
      procedure :: has_steps
   end type plan_t

   !> Maximum unresolved fraction of the variance on the coarser of two grids from which the friction ratio is extrapolated
   real(dp), parameter :: max_unresolved_fraction = 1.0e-6_dp

   ! in plan_cycles.f90
   interface
      !> Choose the cycles of the smooth contact and of the time steps
      module subroutine pick_cycle(input, plan)
         type(case_t), intent(in) :: input
         type(plan_t), intent(inout) :: plan
      end subroutine pick_cycle
   end interface

   ! in plan_grids.f90
   interface
      !> Choose half or whole domain, levels, and first level of nested iteration
      module subroutine pick_grids(input, plan, status)
         type(case_t), intent(in) :: input
         type(plan_t), intent(inout) :: plan
         type(status_t), intent(inout) :: status
      end subroutine pick_grids
   end interface

contains

   !> Decide how a case is solved
   subroutine make_plan(input, surfaces, plan, status, heights, second_heights)
      type(case_t), intent(in) :: input
      !> Surfaces that exist already; the plan takes them over
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
      plan%starved = is_starved(input)
      plan%heat = plan_heat(input, plan%contact, plan%scales, plan%sliding, plan%lubricant, film)
      film = plan%lubricant%shear%thinned_film(film, plan%point%speed_parameter)
      plan%solid_contact = may_have_solid_contact(plan%lubricant, film)
      if (plan%lubricant%boundary_film > 0.0_dp) plan%inlet = inlet_t(film, plan%lubricant%boundary_film/rho, &
                                                                         plan%lubricant%boundary_stress)
      plan%film_flooded = film
      plan%film_starved = merge(min(film, plan%layer/rho), starved_film(film, plan%layer/rho), plan%contact%is_line())
      plan%film_expected = film
      if (plan%layer > 0.0_dp) plan%film_expected = plan%film_starved
      ! a film thicker than the gap at the meniscus supports no load
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
      ! with shear thinning cycles that leave spikes to relaxation diverge on coarse grids (kappa = 12, L = 28, Eyring)
      if (plan%lubricant%shear%thins_flow()) plan%spare_spikes_from = plan%levels
      if (plan%solid_contact .or. plan%contact%reach(2) <= oblique*plan%contact%reach(1)) then
         plan%spare_spikes_from = huge(plan%spare_spikes_from)
      end if
      if (status%failed() .or. .not. plan%surfaces%rough()) return
      call plan%surfaces%use_threads(plan%threads)
      call plan%surfaces%find_period(merge(plan%max_periods, automatic_periods, plan%max_periods > 0))
      plan%coarse_run = input%time%estimate_error .and. plan%levels > 2 .and. &
                        (plan%surfaces%all_stationary() .or. plan%steps == 0) .and. .not. plan%duty%active
      call plan%update_resolved_fraction(plan%finest)
      call check_resolved(plan%surfaces, plan%finest, status)
      if (.not. status%failed()) call check_steps(plan, status)
   end subroutine make_plan

   !> Choose the predicted start if possible
   subroutine pick_start(plan)
      type(plan_t), intent(inout) :: plan

      if (plan%surfaces%pass_once()) then
         plan%fallback_reason = "a single feature passes once"
      else if (plan%surfaces%some_stationary()) then
         plan%fallback_reason = "one of the surfaces is at rest"
      else if (plan%target_error > 0.0_dp) then
         plan%fallback_reason = "the grid of grid.target_error is not known yet"
      end if
      plan%predicted_start = .not. allocated(plan%fallback_reason)
   end subroutine pick_start

   !> Whether another phase follows the smooth contact
   pure logical function has_next_phase(self)
      class(plan_t), intent(in) :: self
      has_next_phase = self%surfaces%rough() .or. self%duty%active
   end function has_next_phase

   !> Whether the run has time steps
   pure logical function has_steps(self)
      class(plan_t), intent(in) :: self
      has_steps = self%surfaces%move() .or. self%duty%active
   end function has_steps

   !> Set the resolved fraction of the surfaces on a grid, and whether the coarser run is possible
   subroutine update_resolved_fraction(self, grid)
      class(plan_t), intent(inout) :: self
      type(grid_t), intent(in) :: grid

      call self%surfaces%update_resolution(grid)
      if (.not. self%coarse_run) return
      ! no coarser run if the next coarser grid resolves nothing of a surface
      self%coarse_run = self%surfaces%max_unresolved(grid%coarser(), aliased_below) < 1.0_dp
      self%extrapolates = self%coarse_run .and. .not. self%surfaces%pass_once() .and. &
                          self%surfaces%max_unresolved(grid%coarser(), resolved_from) <= max_unresolved_fraction
   end subroutine update_resolved_fraction

   !> Refuse a surface so slow that its friction would need too many steps
   subroutine check_steps(plan, status)
      type(plan_t), intent(in) :: plan
      type(status_t), intent(inout) :: status
      real(dp) :: steps
      integer :: limit
      character(len=:), allocatable :: what

      if (.not. plan%surfaces%move() .or. plan%duty%active) return
      associate (slowest => plan%surfaces%of(plan%surfaces%slowest()))
         limit = merge(max_steps_given, max_steps, plan%steps > 0)
         steps = steps_needed(plan%surfaces, plan%finest%hx, plan%skip_start, plan%predicted_start)
         if (steps <= limit) then
            ! skipped steps are counted too
            limit = max_steps_given
            steps = steps_needed(plan%surfaces, plan%finest%hx, .false., plan%predicted_start)
            if (steps <= limit) return
         end if
         what = trim(slowest%group)//".velocity_ratio = "//to_text(slowest%surface%velocity_ratio)//": this slow surface needs "
         if (plan%surfaces%repeats > 1) what = what//"in "//to_text(plan%surfaces%repeats)//" periods "
         ! rounded up, so that the suggested ratio is accepted
         call status%fail(ehl_bad_input, what//fixed(steps, "es12.2e3")//" time steps to average its friction, more than "// &
                          to_text(limit)//new_line("a")//"expected: a velocity ratio of at least "// &
                          fixed(1.005_dp*steps*slowest%surface%velocity_ratio/limit, "es12.2e3")// &
                          " on this grid, or 0: a rough surface at rest is a steady contact")
      end associate
   end subroutine check_steps
end module ehl_plan

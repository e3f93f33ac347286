! SPDX-License-Identifier: BSD-3-Clause
!> State of a transient contact after a time step, and the start, end and rejection of a step (the loops: ehl_transient)
module ehl_transient_state
   use ehl_contact, only: contact_t
   use ehl_cycle, only: coarsening_alcouffe, coarsening_classical
   use ehl_duty, only: duty_state_t, duty_t
   use ehl_duty_error, only: duty_error_t
   use ehl_duty_steps, only: duty_steps_t
   use ehl_extremes, only: extremes_t
   use ehl_friction_mean, only: friction_mean_t
   use ehl_hierarchy, only: hierarchy_t
   use ehl_iteration, only: iteration_t
   use ehl_kinds, only: dp
   use ehl_level, only: level_t
   use ehl_contact_results, only: central_value, load_tolerance, measure, contact_results_t
   use ehl_oil_flow, only: flow_tolerance
   use ehl_moving_surfaces, only: moving_surfaces_t
   use ehl_predicted_start, only: predicted_start_t
   use ehl_predictor, only: predictor_t
   use ehl_reynolds, only: refresh, update_residual
   use ehl_status, only: status_t
   use ehl_step_accuracy, only: step_accuracy_t
   use ehl_step_policy, only: attempt_predicted, step_policy_t
   use ehl_time_levels, only: keep, mirror, set_geometry, set_history
   implicit none (type, external)
   private
   public :: transient_t

   !> Maximum relative errors of the force balance that scaling the pressure may correct: in general, and in lines. The larger one
   !> would remove the second order of small increases of friction on circles (tests/cases/test_two_surfaces.py), and bias the
   !> film under a duty.
   real(dp), parameter :: small_load_error = 1.0e-5_dp, small_line_error = 1.0e-4_dp

   !> Iteration of a time step
   type, extends(iteration_t) :: transient_t
      class(contact_t), allocatable, private :: contact
      !> Steps made, steps skipped at the start, present time, time step
      integer :: step = 0, skipped = 0
      real(dp) :: time = 0.0_dp, time_step = 0.0_dp
      !> Options of the cycles of a step, and its tolerance
      type(step_policy_t) :: policy
      type(step_accuracy_t) :: accuracy
      !> Friction of the smooth contact on the same grid
      real(dp) :: friction_smooth = 1.0_dp
      integer :: total_cycles = 0
      type(friction_mean_t) :: mean
      !> Extremes during the passage of a single feature
      type(extremes_t) :: extremes
      !> Mass content of the last two steps (ehl_time_levels), pressure and H00 of the last three, present roughness
      real(dp), allocatable :: mass_content(:, :, :), p_before(:, :, :), rr(:, :)
      real(dp) :: h00_before(3) = 0.0_dp
      !> Sum of 1/H after the last step: a checksum of the film
      real(dp) :: film_checksum = 0.0_dp
      type(predictor_t) :: predictor
      !> The duty, the lengths and the errors of its steps
      type(duty_t) :: duty
      type(duty_steps_t) :: duty_steps
      type(duty_error_t) :: duty_error
      !> Relative time-step errors of H_c and H_min
      real(dp) :: film_errors(2) = 0.0_dp
      !> Conditions at the end of the present step
      type(duty_state_t) :: now
      !> 1/lambda_bar of the case
      real(dp), private :: inverse_speed = 0.0_dp
      !> Whether the flow is reversed in the present step, which is then solved as its mirror image
      logical, private :: reversed = .false.
      !> Of a starved contact: whether the present step is the first one, at constant conditions; whether that one has been made
      !> (true if the contact is flooded)
      logical :: settling = .false.
      logical, private :: settled = .false.
   contains
      procedure :: begin_duty
      procedure :: end_duty
      procedure :: stays_steady
      procedure :: assess_duty
      procedure :: growth
      procedure, private :: accept_duty
      procedure :: settle
      procedure :: start
      procedure :: fill
      procedure :: begin_step
      procedure :: begin_attempt
      procedure :: begin_cycle
      procedure :: may_scale_load
      procedure :: converged
      procedure :: accept
      procedure :: count_step
      procedure :: step_back
      procedure :: restore
   end type transient_t

   ! in transient_start.f90
   interface
      !> Start from the steady solution of level n; the moving roughness is subtracted from its film. In a thick film roughness has
      !> no effect: with `skip` the steps begin when the front, with half its length, reaches x_matters.
      module subroutine start(self, level, n, contact, surfaces, duty, skip, friction_smooth, status)
         class(transient_t), intent(inout) :: self
         type(level_t), intent(inout) :: level
         integer, intent(in) :: n
         class(contact_t), intent(in) :: contact
         class(moving_surfaces_t), intent(inout) :: surfaces
         type(duty_t), intent(in) :: duty
         !> Whether to begin when the roughness approaches the contact, instead of when it enters the domain
         logical, intent(in) :: skip
         real(dp), intent(in) :: friction_smooth
         type(status_t), intent(inout) :: status
      end subroutine start

      !> Start from the contact filled with roughness and its predicted pressure. If the film would not be positive the state
      !> remains unchanged.
      module subroutine fill(self, level, surfaces, from, done, status)
         class(transient_t), intent(inout) :: self
         type(level_t), intent(inout) :: level
         class(moving_surfaces_t), intent(inout) :: surfaces
         type(predicted_start_t), intent(in) :: from
         logical, intent(out) :: done
         type(status_t), intent(inout) :: status
      end subroutine fill

      !> Heights of the rough surfaces at their present positions
      module subroutine heights_of(surfaces, level, state, rr)
         class(moving_surfaces_t), intent(inout) :: surfaces
         type(level_t), intent(in) :: level
         type(duty_state_t), intent(in) :: state
         real(dp), intent(out) :: rr(:, :)
      end subroutine heights_of
   end interface

   ! in transient_duty.f90
   interface
      !> Start a step under a duty: its length, and the conditions at its end
      module subroutine begin_duty(self, hierarchy, surfaces)
         class(transient_t), intent(inout) :: self
         type(hierarchy_t), intent(inout) :: hierarchy
         class(moving_surfaces_t), intent(in) :: surfaces
      end subroutine begin_duty

      !> End a step under a duty: restore the orientation of mirrored fields
      module subroutine end_duty(self, level)
         class(transient_t), intent(inout) :: self
         type(level_t), intent(inout) :: level
      end subroutine end_duty

      !> Whether the conditions are those of the case until the end of the step, so that the contact remains steady
      pure module function stays_steady(self)
         class(transient_t), intent(in) :: self
         logical :: stays_steady
      end function stays_steady

      !> Ratio of the present half width of the dry contact along X to that of the case
      pure module function growth(self)
         class(transient_t), intent(in) :: self
         real(dp) :: growth
      end function growth

      !> Whether the film of a step under a duty has the required accuracy
      module subroutine assess_duty(self, level, accepted)
         class(transient_t), intent(inout) :: self
         type(level_t), intent(in) :: level
         logical, intent(out) :: accepted
      end subroutine assess_duty

      !> Keep the steady contact in the discretisation of the steps as their initial state
      module subroutine settle(self, level)
         class(transient_t), intent(inout) :: self
         type(level_t), intent(in) :: level
      end subroutine settle

      !> Update the time-step errors of the films after an accepted step
      module subroutine accept_duty(self, level)
         class(transient_t), intent(inout) :: self
         type(level_t), intent(in) :: level
      end subroutine accept_duty
   end interface

contains

   !> Set up the problem of the next time step: roughness, mass content of the last steps, tolerance of the residual
   subroutine begin_step(self, level, surfaces)
      class(transient_t), intent(inout) :: self
      type(level_t), intent(inout) :: level
      class(moving_surfaces_t), intent(inout) :: surfaces
      real(dp) :: tolerance

      if (self%duty%active) then
         call heights_of(surfaces, level, self%now, self%rr)
         call set_geometry(level, self%contact, self%rr, self%now%curvatures)
         if (self%reversed) call mirror(level%film_rhs)
      else
         call surfaces%roughness(level%grid, self%time + self%time_step, self%rr)
         call set_geometry(level, self%contact, self%rr)
      end if
      call set_history(level, self%mass_content)
      tolerance = self%accuracy%tolerance(self%mean%n >= self%mean%filled)
      ! the same residual has less effect in a shorter step
      if (self%duty%active) tolerance = tolerance*max(1.0_dp, level%grid%hx/self%time_step)
      call self%policy%begin(tolerance, self%accuracy%measures(self%step + 1))
      self%cycles = 0
   end subroutine begin_step

   !> Set the first approximation of an attempt at a step, and prepare its cycles
   subroutine begin_attempt(self, hierarchy, status)
      class(transient_t), intent(inout) :: self
      type(hierarchy_t), intent(inout) :: hierarchy
      type(status_t), intent(inout) :: status

      ! only the fields of this type pass from step to step, so that a run can be resumed
      call hierarchy%forget()
      associate (level => hierarchy%levels(self%n))
         if (self%policy%attempt == attempt_predicted) then
            call self%predictor%predict(self%p_before, level)
            level%h00 = sum([3.0_dp, -3.0_dp, 1.0_dp]*self%h00_before)
         else
            level%p = self%p_before(:, :, 1)
            level%h00 = self%h00_before(1)
         end if
         call level%boundary%forget()
         call refresh(level)
         call update_residual(level, self%residual)
      end associate
      call self%policy%begin_attempt(self%residual)
      if (self%policy%options%coarsening == coarsening_alcouffe) call hierarchy%prepare_coarsening(status)
   end subroutine begin_attempt

   !> Choose the options of the next cycle
   subroutine begin_cycle(self, level)
      class(transient_t), intent(inout) :: self
      type(level_t), intent(in) :: level

      self%next_cycle = self%policy%options
      self%policy%solid_contact = level%boundary%touches()
      if (self%policy%solid_contact) self%next_cycle%coarsening = coarsening_classical
   end subroutine begin_cycle

   !> Whether only a small load error remains
   pure logical function may_scale_load(self)
      class(transient_t), intent(in) :: self
      may_scale_load = self%residual <= self%policy%tolerance .and. abs(self%m%load_error) <= &
                       merge(small_line_error, small_load_error, self%contact%is_line() .and. .not. self%duty%active)
   end function may_scale_load

   !> Whether the step meets its tolerance
   pure logical function converged(self)
      class(transient_t), intent(in) :: self
      converged = self%residual <= self%policy%tolerance .and. abs(self%m%load_error) <= load_tolerance .and. self%m%holds &
                  .and. abs(self%m%oil%imbalance) <= flow_tolerance
   end function converged

   !> Accept a solved step
   subroutine accept(self, level, first, residual_first, status)
      class(transient_t), intent(inout) :: self
      type(level_t), intent(in) :: level
      !> Results and residual after the first cycle
      type(contact_results_t), intent(in) :: first
      real(dp), intent(in) :: residual_first
      type(status_t), intent(inout) :: status

      if (self%cycles > 1) call self%accuracy%learn(first%friction_newtonian, residual_first, self%m%friction_newtonian, &
                                                    self%residual)
      call self%accuracy%follow(self%m%friction_newtonian)
      self%total_cycles = self%total_cycles + self%cycles
      if (self%duty%active) call self%accept_duty(level)
      call self%count_step(level, status)
      self%h00_before = [level%h00, self%h00_before(1:2)]
      call self%predictor%learn(self%p_before, level)
      call keep(level, self%mass_content, self%p_before)
   end subroutine accept

   !> Advance the time to the end of a solved step, and record its values for the mean
   subroutine count_step(self, level, status)
      class(transient_t), intent(inout) :: self
      type(level_t), intent(in) :: level
      type(status_t), intent(inout) :: status

      self%step = self%step + 1
      if (self%duty%active) then
         self%time = self%time + self%time_step
      else
         self%time = (self%skipped + self%step)*self%time_step
      end if
      call self%mean%append(self%m%friction/self%friction_smooth, self%m%film_central, central_value(level%grid, self%rr), &
                            status)
      self%film_checksum = sum(1.0_dp/level%h)
   end subroutine count_step

   !> Resume from a state that was read. `same`: whether its film follows from its pressure, which fails if the surface or the
   !> program differs.
   subroutine restore(self, level, surfaces, same)
      class(transient_t), intent(inout) :: self
      type(level_t), intent(inout) :: level
      class(moving_surfaces_t), intent(inout) :: surfaces
      logical, intent(out) :: same
      !> Rounding differences of another processor or compiler are allowed
      real(dp), parameter :: rounding = 1.0e-9_dp

      call self%step_back(level, surfaces)
      self%m = measure(level)
      same = abs(sum(1.0_dp/level%h) - self%film_checksum) <= rounding*self%film_checksum
   end subroutine restore

   !> Restore the last accepted state
   subroutine step_back(self, level, surfaces)
      class(transient_t), intent(inout) :: self
      type(level_t), intent(inout) :: level
      class(moving_surfaces_t), intent(inout) :: surfaces

      if (self%duty%active) then
         self%now = self%duty%at(self%time)
         self%reversed = .false.
         level%load = self%contact%load*self%now%load
         call heights_of(surfaces, level, self%now, self%rr)
         call set_geometry(level, self%contact, self%rr, self%now%curvatures)
      else
         call surfaces%roughness(level%grid, self%time, self%rr)
         call set_geometry(level, self%contact, self%rr)
      end if
      level%p = self%p_before(:, :, 1)
      level%h00 = self%h00_before(1)
      call refresh(level)
   end subroutine step_back
end module ehl_transient_state

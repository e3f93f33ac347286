! SPDX-License-Identifier: BSD-3-Clause
!> The smooth, steady contact: state of nested iteration, and the convergence of each level (the loop: ehl_fmg)
module ehl_smooth_contact
   use ehl_contact, only: contact_t
   use ehl_contact_results, only: contact_results_t, load_tolerance, measure
   use ehl_cycle, only: prolong_solution
   use ehl_dry_start, only: dry_start_t
   use ehl_far_field, only: far_field_t
   use ehl_reynolds, only: refresh
   use ehl_hierarchy, only: hierarchy_t
   use ehl_iteration, only: iteration_t, reduction
   use ehl_kinds, only: dp
   use ehl_level_result, only: level_result_t
   use ehl_level_tolerance, only: accurate, has_coarser, has_target, is_end, residual_tolerance, allowed_errors, &
                                  share_counts
   use ehl_outcome, only: outcome_converged, outcome_cycle_limit, outcome_running, outcome_target_missed
   use ehl_level, only: level_t
   use ehl_meniscus, only: meniscus_t
   use ehl_oil_flow, only: flow_tolerance
   use ehl_status, only: status_t
   use ehl_steady_options, only: end_rule_t, rule_of_circles, rule_of_ellipses, rule_of_others, rule_of_rollers, steady_options_t
   implicit none (type, external)
   private
   public :: smooth_contact_t

   !> Largest reduction per cycle in the error estimate of the load share: near the boundary film the edge of the solid contact
   !> needs several cycles to move by one node
   real(dp), parameter :: max_share_reduction = 0.99_dp
   !> Change of the film per relative error of the load: the deflection by the Hertz pressure differs from its mean weighted by
   !> that pressure by 1/5 at the centre and by 3/10 at the edge [a^2/R]
   real(dp), parameter :: film_per_load = 0.3_dp
   !> Residual above which a cycle before the first accepted one is rejected, and a guarded level at its cycle limit is not solved
   real(dp), parameter :: max_residual = 2.0_dp
   !> Residual above which coarse grids also correct sharp pressure spikes: relaxation alone does not move a distant spike
   !> (kappa = 11, L = 26)
   real(dp), parameter :: near_solution = 0.05_dp
   !> Cycles after which the load of a roller may drift; largest relative load error treated as drift. In an ellipse with a sharp
   !> spike the load error may stall at 2e-4 while the films hardly change (kappa = 10, L = 26); scaling is allowed only where it
   !> changes the films by a quarter of their allowed errors.
   integer, parameter :: drifts_after = 6
   real(dp), parameter :: small_drift = 1.0e-3_dp, small_ellipse_drift = 1.0e-4_dp
   !> Cycles of a wide contact on a grid after which its algebraic error may be this share of the discretisation error instead of
   !> the usual one, unless a smaller one is required; the stated errors contain it.
   !> At a sharp spike the films vary by a tenth of that error from cycle to cycle (kappa = 10, L = 26).
   integer, parameter :: lenient_after = 8
   real(dp), parameter :: lenient_accuracy = 0.5_dp, usual_accuracy = 0.1_dp

   !> Record of the cycles of a level, used to reject failed ones
   type :: guard_t
      !> Degree of damping of the next cycle (0: none), degree after the last rejection, and minimum for the rest of the level
      integer :: damping = 0, last_damping = 0, min_damping = 0
      !> That of the first accepted cycle, with which the next finer grid begins in an ellipse
      integer :: first = 0
      !> Cycles since the degree or the fraction below was changed
      integer :: cycles_since = 0
      !> State before the last cycle
      real(dp), allocatable :: p_before(:, :)
      real(dp) :: h00_before = 0.0_dp
      !> Fraction of the sliding and of the pressure gradient in the shear-thinning law, and before its last increase; whether it
      !> was ever less than 1
      real(dp) :: shear_fraction = 1.0_dp, shear_fraction_before = 1.0_dp
      logical :: softened = .false.
      !> Residual after the last accepted cycle, and some cycles earlier
      real(dp) :: residual_kept = 0.0_dp, residual_earlier = huge(1.0_dp)
   end type guard_t

   !> Iteration on level n
   type, extends(iteration_t) :: smooth_contact_t
      class(contact_t), allocatable, private :: contact
      !> Dry pressure of a roller
      type(dry_start_t), private :: dry
      type(steady_options_t), private :: options
      !> Convergence rule of a level
      type(end_rule_t), private :: rule = rule_of_circles
      !> Pressure at a flooded border
      type(far_field_t), private :: far_field
      !> Whether level n has its first approximation, and whether the last level is solved
      logical :: begun = .false., solved = .false.
      !> Whether the levels are being solved again with damped cycles
      logical, private :: damped = .false.
      !> Whether failed cycles are rejected and stalling ones accelerated
      logical, private :: guarded = .false.
      !> Whether coarse grids leave spikes to relaxation on all levels: the last attempt at a wide contact
      logical, private :: spares_spikes = .false.
      type(guard_t), private :: guard
      !> Whether a line is solved with a flooded inlet. It has no side flow and is first solved as flooded; the layer limits the
      !> flow only if the flooded contact needs more.
      logical, private :: flooded_inlet = .false.
      !> Meniscus of a starved line, fixed if cycles with a free one have failed
      type(meniscus_t), private :: meniscus
      !> Present passage, passage of the last cycle, and its layer at Y = 0
      integer :: passage = 1, cycle_passage = 1
      real(dp) :: layer_central = 0.0_dp
      !> Central film of the previous passage
      real(dp), private :: film_before = 0.0_dp
      !> Number of restarts
      integer :: restarts = 0
      type(level_result_t), allocatable :: results(:)
      !> Changes of H_c and H_min in the last cycle, and the residual after it
      real(dp), private :: change(2) = 0.0_dp, residual_before = 0.0_dp
      !> Ratio of the residuals after and before the last cycle
      real(dp), private :: stall = 0.0_dp
      !> Change of the load share of a boundary film in the last cycle
      real(dp), private :: share_change = 0.0_dp
   contains
      procedure :: start
      procedure :: begin_level
      procedure :: begin_cycle
      procedure :: estimate_errors
      procedure :: may_scale_load
      procedure :: drifts
      procedure :: converged
      procedure :: is_ellipse
      procedure :: guard_cycle
      procedure :: record
      procedure :: end_level
   end type smooth_contact_t

   ! in cycle_guard.f90
   interface
      !> Start the record of a level
      module subroutine begin_guard(self)
         class(smooth_contact_t), intent(inout) :: self
      end subroutine begin_guard

      !> Keep the state before a cycle
      module subroutine keep_state(self, level, status)
         class(smooth_contact_t), intent(inout) :: self
         type(level_t), intent(in) :: level
         type(status_t), intent(inout) :: status
      end subroutine keep_state

      !> Reject a failed cycle and damp the next ones; accelerate stalling cycles
      module subroutine guard_cycle(self, hierarchy, outcome, status)
         class(smooth_contact_t), intent(inout) :: self
         type(hierarchy_t), intent(inout) :: hierarchy
         !> Status of the cycle
         integer, intent(inout) :: outcome
         type(status_t), intent(inout) :: status
      end subroutine guard_cycle
   end interface

   ! in next_cycle.f90
   interface
      !> Prepare a cycle on level n: the pressure at a flooded border, the options of the cycle, the state to restore
      module subroutine begin_cycle(self, level, status)
         class(smooth_contact_t), intent(inout) :: self
         type(level_t), intent(inout) :: level
         type(status_t), intent(inout) :: status
      end subroutine begin_cycle
   end interface

   ! in smooth_restart.f90
   interface
      !> Start the next passage with the layer that leaves the contact, replenished, unless the film is steady. Relative errors are
      !> those of the first passage: the results of coarser grids are scaled.
      module subroutine next_passage(self, level, outcome)
         class(smooth_contact_t), intent(inout) :: self
         type(level_t), intent(inout) :: level
         integer, intent(inout) :: outcome
      end subroutine next_passage

      !> Restart after a failed level: on the next finer one, where the discrete problem is better posed; after a failure on the
      !> finest one from the first level, once with damped cycles (if allowed), with guarded cycles, with spikes left to relaxation
      !> and with the meniscus of a starved line fixed, as far as these apply. If a level with a reduced shear-thinning law failed,
      !> damped cycles from the first level are tried before finer levels.
      module subroutine restart(self, finest, outcome)
         class(smooth_contact_t), intent(inout) :: self
         logical, intent(in) :: finest
         integer, intent(inout) :: outcome
      end subroutine restart
   end interface

contains

   !> Prepare the first level
   subroutine start(self, contact, options)
      class(smooth_contact_t), intent(out) :: self
      class(contact_t), intent(in) :: contact
      type(steady_options_t), intent(in) :: options

      self%contact = contact
      self%options = options
      self%rule = merge(rule_of_circles, rule_of_others, options%newtonian_circle)
      if (options%guarded .and. .not. options%line) self%rule = rule_of_ellipses
      if (contact%is_roller()) self%rule = rule_of_rollers
      if (options%flooded) call self%far_field%setup(contact)
      self%flooded_inlet = options%line
      self%max_cycles = options%max_cycles
      self%of_film = .true.
      self%guarded = options%guarded
      self%n = options%start
      self%results = spread(level_result_t(), 1, options%levels)
   end subroutine start

   !> First approximation on level n: from the solution on the next coarser one, or from the Hertz pressure
   subroutine begin_level(self, hierarchy, status)
      class(smooth_contact_t), intent(inout) :: self
      type(hierarchy_t), intent(inout) :: hierarchy
      type(status_t), intent(inout) :: status
      integer :: j

      call hierarchy%grow(self%n, status)
      if (status%failed()) return
      if (self%damped) call hierarchy%forget()
      call hierarchy%soften(1.0_dp)
      call hierarchy%supply(merge(huge(1.0_dp), self%options%layer, self%options%layer > 0.0_dp .and. self%flooded_inlet))
      associate (level => hierarchy%levels(self%n), grid => hierarchy%levels(self%n)%grid)
         do j = 1, grid%ny
            call self%contact%gap_row(grid%columns(), grid%y(j), level%film_rhs(:, j))
         end do
         level%rhs = 0.0_dp
         level%load = self%contact%load
         if (has_coarser(self%results, self%n)) then
            call prolong_solution(hierarchy%levels(self%n - 1), level)
            if (self%contact%is_roller()) call self%dry%correct_ends(hierarchy%levels(self%n - 1)%grid, level)
            self%m = self%results(self%n - 1)%m
         else
            do j = 1, grid%ny
               call self%contact%pressure_row(grid%columns(), grid%y(j), level%p(:, j))
            end do
            level%h00 = self%contact%dry_separation
            if (self%contact%is_roller()) call self%dry%begin(level)
            level%h00 = self%options%film_expected + level%h00
            call refresh(level)
            self%m = measure(level)
         end if
      end associate
      if (self%meniscus%active) then
         hierarchy%levels%supply%held = 1
         hierarchy%levels%supply%short = 0.0_dp
         associate (level => hierarchy%levels(self%n))
            call self%meniscus%begin(has_coarser(self%results, self%n))
            call self%meniscus%hold(level)
            call refresh(level)
            self%m = measure(level)
         end associate
      end if
      self%results(self%n)%mesh = hierarchy%levels(self%n)%grid%hx
      self%cycles = 0
      self%residual = 0.0_dp
      self%begun = .true.
      call begin_guard(self)
   end subroutine begin_level

   !> Estimate the algebraic errors from the changes in the last cycle
   subroutine estimate_errors(self, before)
      class(smooth_contact_t), intent(inout) :: self
      !> Results before the cycle
      type(contact_results_t), intent(in) :: before
      real(dp) :: change(2), q, residual_ratio

      change = abs(self%m%films() - before%films())
      residual_ratio = huge(residual_ratio)
      if (self%rule%bounded .and. self%cycles > 1) residual_ratio = self%residual/max(self%residual_before, tiny(1.0_dp))
      q = reduction(change, self%change, self%cycles, residual_ratio, self%rule%min_reduction)
      self%results(self%n)%algebraic = change*q/(1.0_dp - q)
      self%change = change
      self%stall = self%residual/max(self%residual_before, tiny(1.0_dp))
      call estimate_share_error(self, abs(self%m%touching%load_share - before%touching%load_share))
      self%residual_before = self%residual
      if (.not. (self%rule%bounded .and. is_end(self%options, self%n))) return
      self%results(self%n)%algebraic = self%results(self%n)%algebraic + film_per_load*abs(self%m%load_error)
   end subroutine estimate_errors

   !> Whether only a load error remains, small enough for scaling of the pressure
   pure logical function may_scale_load(self)
      class(smooth_contact_t), intent(in) :: self
      type(steady_options_t) :: options
      real(dp) :: error, limit

      error = abs(self%m%load_error)
      limit = self%rule%small_load_error
      if (self%is_ellipse() .and. self%cycles >= drifts_after) then
         limit = merge(small_drift, small_ellipse_drift, self%contact%is_wide())
      end if
      may_scale_load = is_end(self%options, self%n) .and. error <= limit
      if (.not. may_scale_load) return
      options = stopping_options(self)
      may_scale_load = accurate(options, self%results, self%n, self%m, self%residual, self%cycles < self%max_cycles)
      if (may_scale_load) may_scale_load = film_per_load*error <= self%rule%load_fraction* &
                                           minval(allowed_errors(options, self%results, self%n, self%m))
   end function may_scale_load

   !> Options of the test of convergence: the algebraic error of a wide contact without solid contact may be larger later
   pure function stopping_options(self) result(options)
      class(smooth_contact_t), intent(in) :: self
      type(steady_options_t) :: options

      options = self%options
      if (.not. (self%contact%is_wide() .and. self%cycles >= lenient_after) .or. share_counts(options, self%m)) return
      if (options%accuracy >= usual_accuracy) options%accuracy = max(options%accuracy, lenient_accuracy)
   end function stopping_options

   !> Whether only the load of a roller drifts, as coarse grids change its ends and relaxation reverses that. The load is then
   !> corrected before the next cycle.
   pure logical function drifts(self)
      class(smooth_contact_t), intent(in) :: self

      drifts = self%contact%is_roller() .and. is_end(self%options, self%n) .and. self%cycles >= drifts_after .and. &
               self%residual <= residual_tolerance .and. abs(self%m%load_error) <= small_drift
   end function drifts

   !> Estimate the algebraic error of the load share from its change in the last cycle, as for the films
   pure subroutine estimate_share_error(self, change)
      class(smooth_contact_t), intent(inout) :: self
      real(dp), intent(in) :: change
      real(dp) :: q

      q = max_share_reduction
      if (self%cycles > 1) q = max(reduction([change], [self%share_change], self%cycles), &
                                   min(max_share_reduction, change/max(self%share_change, tiny(1.0_dp))))
      self%results(self%n)%share_algebraic = change*q/(1.0_dp - q)
      self%share_change = change
   end subroutine estimate_share_error

   !> Whether the level is solved; where the solution may end this includes the load and the oil flow
   pure logical function converged(self)
      class(smooth_contact_t), intent(in) :: self
      converged = self%failure_status() == outcome_running .and. self%m%holds .and. .not. self%guard%shear_fraction < 1.0_dp .and. &
                  (max(abs(self%m%load_error)/load_tolerance, abs(self%m%oil%imbalance)/flow_tolerance) <= 1.0_dp &
                   .or. .not. is_end(self%options, self%n))
      if (converged) converged = accurate(stopping_options(self), self%results, self%n, self%m, self%residual, &
                                          self%cycles < self%max_cycles)
   end function converged

   !> Whether the contact is an ellipse: neither a circle nor a cylinder
   pure logical function is_ellipse(self)
      class(smooth_contact_t), intent(in) :: self

      is_ellipse = self%options%guarded .and. .not. (self%options%line .or. self%contact%is_roller())
   end function is_ellipse

   !> Record the results of level n
   subroutine record(self)
      class(smooth_contact_t), intent(inout) :: self
      integer :: k

      associate (result => self%results(self%n))
         if (self%passage > 1 .and. self%n > 1) then
            do k = 1, self%n - 1
               call self%results(k)%m%scale(result%m, self%m)
            end do
         end if
         result%m = self%m
         result%cycles = self%cycles
         result%residual = self%residual
      end associate
   end subroutine record

   !> After the last cycle of a level: continue on the next one, restart, or end. A coarse level at its cycle limit still gives
   !> a first approximation on the next one.
   subroutine end_level(self, hierarchy, outcome)
      class(smooth_contact_t), intent(inout) :: self
      type(hierarchy_t), intent(inout) :: hierarchy
      !> On entry the status of the level; on return that of the smooth contact: outcome_running if another level follows
      integer, intent(inout) :: outcome
      logical :: finest, met

      finest = self%n == self%options%levels
      associate (result => self%results(self%n))
         result%solved = outcome == outcome_converged .or. (outcome == outcome_cycle_limit .and. .not. finest)
         if (self%guarded .and. outcome == outcome_cycle_limit) then
            result%solved = result%solved .and. self%residual <= max_residual .and. .not. self%guard%shear_fraction < 1.0_dp
         end if
         if (.not. result%solved) then
            call restart(self, finest, outcome)
            return
         end if
      end associate
      if (self%flooded_inlet .and. self%m%oil%enters > self%options%layer .and. self%options%layer > 0.0_dp) then
         self%flooded_inlet = .false.
         self%begun = .false.
         self%results(self%n)%solved = .false.
         outcome = outcome_running
         return
      end if
      met = .false.
      if (outcome == outcome_converged) met = has_target(self%options, self%results, self%n, self%m)
      if (met .or. finest) then
         outcome = merge(outcome_target_missed, outcome_converged, self%options%target_error > 0.0_dp .and. .not. met)
         self%solved = outcome == outcome_converged
         if (self%solved .and. self%passage < self%options%passages) call next_passage(self, hierarchy%levels(self%n), outcome)
      else
         outcome = outcome_running
         self%n = self%n + 1
         self%begun = .false.
      end if
   end subroutine end_level

end module ehl_smooth_contact

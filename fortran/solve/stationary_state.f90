! SPDX-License-Identifier: BSD-3-Clause
!> The steady contact with a stationary rough surface: a fraction of the roughness in the film equation, increased to 1, and the
!> convergence at each fraction (the loop: ehl_stationary_rough)
module ehl_stationary_state
   use ehl_contact, only: contact_t
   use ehl_contact_results, only: contact_results_t, load_tolerance, measure
   use ehl_cycle, only: cycle_options_t, damped_cycle
   use ehl_reynolds, only: refresh
   use ehl_hierarchy, only: hierarchy_t
   use ehl_iteration, only: iteration_t, reduction
   use ehl_kinds, only: dp
   use ehl_level, only: level_t
   use ehl_moving_surfaces, only: moving_surfaces_t
   use ehl_outcome, only: outcome_negative_film, outcome_running
   use ehl_status, only: ehl_no_memory, status_t
   use ehl_level_tolerance, only: residual_tolerance
   use ehl_steady_options, only: steady_options_t
   use ehl_time_levels, only: set_geometry
   implicit none (type, external)
   private
   public :: stationary_t

   !> Maximum algebraic error by `estimate_error`: with all of the roughness, over the required accuracy; at an intermediate
   !> fraction of the roughness, independent of it
   real(dp), parameter :: friction_tolerance = 1.0e-3_dp, fraction_tolerance = 3.0e-2_dp
   !> Maximum relative error of the force balance that scaling the pressure may correct at a boundary film
   real(dp), parameter :: small_load_error = 1.0e-5_dp
   !> Minimum step of the fraction
   real(dp), parameter :: min_step = 1.0_dp/64.0_dp

   !> Iteration at the present fraction of the roughness
   type, extends(iteration_t) :: stationary_t
      class(contact_t), allocatable, private :: contact
      !> Whether the smooth contact is still being solved to the accuracy required of the friction
      logical :: smooth = .true.
      !> Whether to increase the fraction before the next cycle
      logical :: due = .false.
      !> Fraction of the roughness in the film, the last fraction that was solved, and the next step
      real(dp) :: fraction = 0.0_dp, fraction_done = 0.0_dp, fraction_step = 1.0_dp
      !> Number of fractions started; total cycles
      integer :: parts = 0, total_cycles = 0
      !> Estimated relative algebraic error of the friction integral, and its last relative change
      real(dp) :: algebraic = 0.0_dp, change = 0.0_dp
      !> Friction integral of the smooth contact
      real(dp) :: friction_smooth = 1.0_dp
      real(dp), private :: tolerance = 1.0e-4_dp
      !> Options of cycles without solid contact
      type(cycle_options_t), private :: cycle
      !> Whether the convergence with solid contact is tested by the load share instead of the friction
      logical, private :: by_load_share = .false.
      !> The roughness [a^2/R], and the pressure at the last fraction that was solved, shape (nx, ny)
      real(dp), allocatable :: rr(:, :), p_done(:, :)
      real(dp) :: h00_done = 0.0_dp
   contains
      procedure :: start
      procedure :: begin_cycle
      procedure :: estimate_error
      procedure :: may_scale_load
      procedure :: converged
      procedure :: accept
      procedure :: reject
      procedure :: add_roughness
      procedure :: mu_ratio
   end type stationary_t

contains

   !> Start from the smooth solution of level n
   subroutine start(self, level, n, contact, surfaces, options, status)
      class(stationary_t), intent(inout) :: self
      type(level_t), intent(inout) :: level
      integer, intent(in) :: n
      class(contact_t), intent(in) :: contact
      class(moving_surfaces_t), intent(inout) :: surfaces
      !> As for the smooth contact; the cycle limit applies to each fraction of the roughness
      type(steady_options_t), intent(in) :: options
      type(status_t), intent(inout) :: status
      integer :: stat

      if (status%failed()) return
      self%contact = contact
      self%n = n
      self%cycle = options%cycle
      self%max_cycles = level%boundary%cycle_limit(options%max_cycles, level%grid%nx)
      self%tolerance = friction_tolerance*options%accuracy
      if (allocated(self%rr)) deallocate (self%rr, self%p_done)
      allocate (self%rr(level%grid%nx, level%grid%ny), self%p_done(level%grid%nx, level%grid%ny), stat=stat)
      if (stat /= 0) then
         call status%fail(ehl_no_memory, "no memory for the stationary roughness")
         return
      end if
      call surfaces%roughness(level%grid, 0.0_dp, self%rr, moving=.false.)
      self%m = measure(level)
      self%friction_smooth = self%m%friction
      self%by_load_share = .not. level%lubricant%boundary_stress > 0.0_dp
   end subroutine start

   !> Choose the options of the next cycle
   subroutine begin_cycle(self, level)
      class(stationary_t), intent(inout) :: self
      type(level_t), intent(in) :: level

      self%next_cycle = self%cycle
      if (level%boundary%touches()) self%next_cycle = damped_cycle(self%cycle)
   end subroutine begin_cycle

   !> Estimate the algebraic error from the change of the friction, relative to it, or of the load share, in the last cycle
   subroutine estimate_error(self, before)
      class(stationary_t), intent(inout) :: self
      !> Results before the cycle
      type(contact_results_t), intent(in) :: before
      real(dp) :: change, q

      change = abs(self%m%friction - before%friction)/self%m%friction
      ! without boundary friction the friction nearly vanishes
      if (self%by_load_share .and. self%m%touching%load_share > 0.0_dp) then
         change = abs(self%m%touching%load_share - before%touching%load_share)
      end if
      q = reduction([change], [self%change], self%cycles)
      self%algebraic = change*q/(1.0_dp - q)
      self%change = change
   end subroutine estimate_error

   !> Whether scaling the pressure may correct a small load error, which remains where nodes enter and leave solid contact from
   !> cycle to cycle. Without solid contact the cycles correct the load.
   pure logical function may_scale_load(self)
      class(stationary_t), intent(in) :: self
      may_scale_load = self%m%touching%load_share > 0.0_dp .and. self%residual <= residual_tolerance .and. &
                       abs(self%m%load_error) <= small_load_error
   end function may_scale_load

   !> Whether the present fraction is solved; one cycle is too few for the error estimate
   pure logical function converged(self)
      class(stationary_t), intent(in) :: self
      real(dp) :: tolerance

      converged = self%failure_status() == outcome_running
      if (.not. converged) return
      tolerance = merge(fraction_tolerance, self%tolerance, .not. self%smooth .and. self%fraction < 1.0_dp)
      converged = self%algebraic <= tolerance .and. abs(self%m%load_error) <= load_tolerance &
                  .and. self%residual <= residual_tolerance .and. self%cycles > 1 .and. self%m%holds
   end function converged

   !> Keep the solution at the present fraction
   subroutine accept(self, level)
      class(stationary_t), intent(inout) :: self
      type(level_t), intent(in) :: level

      if (self%smooth) self%friction_smooth = self%m%friction
      self%smooth = .false.
      self%fraction_done = self%fraction
      self%p_done = level%p
      self%h00_done = level%h00
      self%due = self%fraction < 1.0_dp
   end subroutine accept

   !> The cycles failed at the present fraction: halve the step and start again from the last solution
   subroutine reject(self, level, outcome)
      class(stationary_t), intent(inout) :: self
      type(level_t), intent(inout) :: level
      !> Reason of the failure; outcome_running once a smaller fraction is started
      integer, intent(inout) :: outcome

      self%fraction_step = 0.5_dp*min(self%fraction_step, self%fraction - self%fraction_done)
      if (.not. (self%smooth .or. self%fraction_step < min_step)) call self%add_roughness(level, outcome)
   end subroutine reject

   !> Increase the fraction, halving the step until the film under the last pressure is positive
   subroutine add_roughness(self, level, outcome)
      class(stationary_t), intent(inout) :: self
      type(level_t), intent(inout) :: level
      integer, intent(out) :: outcome

      self%due = .false.
      do
         self%fraction = min(1.0_dp, self%fraction_done + self%fraction_step)
         level%p = self%p_done
         level%h00 = self%h00_done
         call set_geometry(level, self%contact, self%fraction*self%rr)
         call refresh(level)
         if (level%boundary%has_film(minval(level%h) > 0.0_dp)) exit
         self%fraction_step = 0.5_dp*self%fraction_step
         if (self%fraction_step < min_step) then
            self%m = measure(level)
            outcome = outcome_negative_film
            return
         end if
      end do
      outcome = outcome_running
      self%parts = self%parts + 1
      self%cycles = 0
      self%m = measure(level)
   end subroutine add_roughness

   !> Friction ratio rough/smooth
   pure real(dp) function mu_ratio(self)
      class(stationary_t), intent(in) :: self
      mu_ratio = self%m%friction/self%friction_smooth
   end function mu_ratio
end module ehl_stationary_state

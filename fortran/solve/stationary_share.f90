! SPDX-License-Identifier: BSD-3-Clause
!> A stationary rough surface: the steady contact with a share of the roughness at its place in the film equation, and when it is
!> solved (the loop: ehl_stationary_rough)
module ehl_stationary_share
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

   !> Relative algebraic error of a friction integral, as a share of the required accuracy; that of an intermediate share of
   !> the roughness
   real(dp), parameter :: friction_tolerance = 1.0e-3_dp, share_tolerance = 3.0e-2_dp
   !> Relative errors of the force balance that scaling of the pressure may correct, at a boundary film
   real(dp), parameter :: small_load_error = 1.0e-5_dp
   !> At a boundary film lubricant that is left between touching nodes goes on by some three nodes a cycle, through half of
   !> the nodes along X at most: so many cycles for each of these, at least, are a share's
   real(dp), parameter :: cycles_a_node = 0.5_dp
   !> Error of the load after some cycles from which no share of the roughness there converges
   real(dp), parameter :: lost_load = 1.0_dp
   integer, parameter :: lost_after = 10
   !> Smallest part of the roughness that is tried
   real(dp), parameter :: min_step = 1.0_dp/64.0_dp

   !> The state of the iteration is that with the present share of the roughness
   type, extends(iteration_t) :: stationary_t
      class(contact_t), allocatable, private :: contact
      !> Whether the smooth contact is still being solved, to the accuracy of the friction
      logical :: smooth = .true.
      !> Whether the next share of the roughness is to be added before the next cycle
      logical :: due = .false.
      !> Share of the roughness in the film now, the last share that was solved, and the next step
      real(dp) :: share = 0.0_dp, share_done = 0.0_dp, share_step = 1.0_dp
      !> Shares begun, cycles in all
      integer :: parts = 0, total_cycles = 0
      !> Relative algebraic error of the friction integral, as estimated, and the last change of it
      real(dp) :: algebraic = 0.0_dp, change = 0.0_dp
      !> Friction integral of the smooth contact
      real(dp) :: friction_smooth = 1.0_dp
      real(dp), private :: tolerance = 1.0e-4_dp
      !> Its cycles, unless bodies touch
      type(cycle_options_t), private :: cycle
      !> Whether the error of a contact that touches at a boundary film is that of its load share, and not of the friction
      logical, private :: by_load_share = .false.
      !> The roughness [a^2/R], pressure of the smooth contact and of the last share solved, (nx, ny)
      real(dp), allocatable :: rr(:, :), p_done(:, :)
      real(dp) :: h00_done = 0.0_dp
   contains
      procedure :: start
      procedure :: begin_cycle
      procedure :: estimate_error
      procedure :: may_scale_load
      procedure :: converged
      procedure :: lost
      procedure :: accept
      procedure :: reject
      procedure :: add_share
      procedure :: mu_ratio
   end type stationary_t

contains

   !> Begin from the smooth solution of level n
   subroutine start(self, level, n, contact, surfaces, options, status)
      class(stationary_t), intent(inout) :: self
      type(level_t), intent(inout) :: level
      integer, intent(in) :: n
      class(contact_t), intent(in) :: contact
      class(moving_surfaces_t), intent(inout) :: surfaces
      !> As the smooth contact; the most cycles are those for a share of the roughness
      type(steady_options_t), intent(in) :: options
      type(status_t), intent(inout) :: status
      integer :: stat

      if (status%failed()) return
      self%contact = contact
      self%n = n
      self%cycle = options%cycle
      self%max_cycles = options%max_cycles
      if (level%boundary%active) self%max_cycles = max(options%max_cycles, int(cycles_a_node*level%grid%nx))
      self%tolerance = friction_tolerance*options%accuracy
      if (allocated(self%rr)) deallocate (self%rr, self%p_done)
      allocate (self%rr(level%grid%nx, level%grid%ny), self%p_done(level%grid%nx, level%grid%ny), stat=stat)
      if (stat /= 0) then
         call status%fail(ehl_no_memory, "no memory for the roughness at rest")
         return
      end if
      call surfaces%roughness(level%grid, 0.0_dp, self%rr, moving=.false.)
      self%m = measure(level)
      self%friction_smooth = self%m%friction
      self%by_load_share = .not. level%lubricant%boundary_stress > 0.0_dp
   end subroutine start

   !> The kind of cycle
   subroutine begin_cycle(self, level)
      class(stationary_t), intent(inout) :: self
      type(level_t), intent(in) :: level

      self%next_cycle = self%cycle
      if (level%boundary%touches()) self%next_cycle = damped_cycle(self%cycle)
   end subroutine begin_cycle

   !> Algebraic error by the change of the friction or of the load share in a cycle
   subroutine estimate_error(self, before)
      class(stationary_t), intent(inout) :: self
      !> Results before the cycle
      type(contact_results_t), intent(in) :: before
      real(dp) :: change, q

      change = abs(self%m%friction - before%friction)/self%m%friction
      ! without the friction of the boundary film hardly any friction is left
      if (self%by_load_share .and. self%m%touching%load_share > 0.0_dp) then
         change = abs(self%m%touching%load_share - before%touching%load_share)
      end if
      q = reduction([change], [self%change], self%cycles)
      self%algebraic = change*q/(1.0_dp - q)
      self%change = change
   end subroutine estimate_error

   !> Whether a small error of the load may be corrected: nodes that lift off and touch again from cycle to cycle leave one.
   !> Without a boundary film the load is left to the cycles.
   pure logical function may_scale_load(self)
      class(stationary_t), intent(in) :: self
      may_scale_load = self%m%touching%load_share > 0.0_dp .and. self%residual <= residual_tolerance .and. &
                       abs(self%m%load_error) <= small_load_error
   end function may_scale_load

   !> Whether the present share is solved; the first cycle does not show it
   pure logical function converged(self)
      class(stationary_t), intent(in) :: self
      real(dp) :: wanted

      converged = self%failure_status() == outcome_running
      if (.not. converged) return
      wanted = merge(share_tolerance, self%tolerance, .not. self%smooth .and. self%share < 1.0_dp)
      converged = self%algebraic <= wanted .and. abs(self%m%load_error) <= load_tolerance &
                  .and. self%residual <= residual_tolerance .and. self%cycles > 1 .and. self%m%holds
   end function converged

   !> Whether the load at a boundary film is so wrong that no share of the roughness converges from it
   pure logical function lost(self, level)
      class(stationary_t), intent(in) :: self
      type(level_t), intent(in) :: level
      lost = level%boundary%active .and. self%cycles > lost_after .and. abs(self%m%load_error) > lost_load
   end function lost

   !> The present share is solved
   subroutine accept(self, level)
      class(stationary_t), intent(inout) :: self
      type(level_t), intent(in) :: level

      if (self%smooth) self%friction_smooth = self%m%friction
      self%smooth = .false.
      self%share_done = self%share
      self%p_done = level%p
      self%h00_done = level%h00
      self%due = self%share < 1.0_dp
   end subroutine accept

   !> The present share was too large: start a smaller one, if there is one
   subroutine reject(self, level, outcome)
      class(stationary_t), intent(inout) :: self
      type(level_t), intent(inout) :: level
      !> Why it failed; outcome_running: a smaller one is started
      integer, intent(inout) :: outcome

      self%share_step = 0.5_dp*min(self%share_step, self%share - self%share_done)
      if (.not. (self%smooth .or. self%share_step < min_step)) call self%add_share(level, outcome)
   end subroutine reject

   !> The next share of the roughness, whose film must be positive under the pressure of the last one: halve the step until it is
   subroutine add_share(self, level, outcome)
      class(stationary_t), intent(inout) :: self
      type(level_t), intent(inout) :: level
      integer, intent(out) :: outcome

      self%due = .false.
      do
         self%share = min(1.0_dp, self%share_done + self%share_step)
         level%p = self%p_done
         level%h00 = self%h00_done
         call set_geometry(level, self%contact, self%share*self%rr)
         call refresh(level)
         if (level%boundary%has_film(minval(level%h) > 0.0_dp)) exit
         self%share_step = 0.5_dp*self%share_step
         if (self%share_step < min_step) then
            self%m = measure(level)
            outcome = outcome_negative_film
            return
         end if
      end do
      outcome = outcome_running
      self%parts = self%parts + 1
      self%cycles = 0
      self%m = measure(level)
   end subroutine add_share

   !> Friction over that of the smooth contact
   pure real(dp) function mu_ratio(self)
      class(stationary_t), intent(in) :: self
      mu_ratio = self%m%friction/self%friction_smooth
   end function mu_ratio
end module ehl_stationary_share

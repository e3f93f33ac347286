! SPDX-License-Identifier: BSD-3-Clause
!> A rough surface at rest: the steady contact with the roughness at its place in the film equation. It begins from
!> the smooth solution on the same grid. Where the film would be negative then, the roughness grows in steps.
module ehl_stationary_roughness
   use ehl_contact, only: contact_t
   use ehl_contact_results, only: contact_results_t, load_tolerance, measure
   use ehl_cycle, only: cycle_options_t, damped_cycle
   use ehl_film, only: refresh
   use ehl_hierarchy, only: hierarchy_t
   use ehl_iteration, only: iteration_t, reduction
   use ehl_kinds, only: dp
   use ehl_level, only: level_t
   use ehl_moving_surfaces, only: moving_surfaces_t
   use ehl_outcome, only: outcome_converged, outcome_cycle_limit, outcome_negative_film, outcome_running
   use ehl_status, only: ehl_no_memory, status_t
   use ehl_steady, only: residual_tolerance
   use ehl_steady_options, only: steady_options_t
   use ehl_time_levels, only: set_geometry
   implicit none (type, external)
   private
   public :: stationary_roughness_t

   !> Relative algebraic error of a friction integral, as a share of the accuracy asked for; of a part of the roughness
   !> that is only on the way to the whole of it
   real(dp), parameter :: friction_tolerance = 1.0e-3_dp, part_tolerance = 3.0e-2_dp
   !> Relative errors of the force balance that may be taken away by scaling the pressure, at a boundary film
   real(dp), parameter :: small_load_error = 1.0e-5_dp
   !> At a boundary film lubricant that is left between touching nodes goes on by some three nodes a cycle, through half of
   !> the nodes along X at most: so many cycles for each of these, at least, are a share's
   real(dp), parameter :: cycles_a_node = 0.5_dp
   !> Error of the load after some cycles that no share of the roughness there comes back from
   real(dp), parameter :: lost_load = 1.0_dp
   integer, parameter :: lost_after = 10
   !> Smallest part of the roughness that is tried
   real(dp), parameter :: least_part = 1.0_dp/64.0_dp

   !> The state of the iteration is that with the present share of the roughness
   type, extends(iteration_t) :: stationary_roughness_t
      class(contact_t), allocatable, private :: contact
      !> How all of it stands
      integer :: outcome = outcome_running
      !> Whether the smooth contact is still being solved, to the accuracy of the friction
      logical :: smooth = .true.
      !> Whether the next cycle begins with the next share of the roughness
      logical, private :: due = .false.
      !> Share of the roughness in the film now, the last share that was solved, and the next step
      real(dp) :: share = 0.0_dp, share_done = 0.0_dp, share_step = 1.0_dp
      !> Shares solved, cycles in all
      integer :: parts = 0, total_cycles = 0
      !> Relative algebraic error of the friction integral, as estimated, and the last change of it
      real(dp) :: algebraic = 0.0_dp, change = 0.0_dp
      !> Friction integral of the smooth contact
      real(dp) :: friction_smooth = 1.0_dp
      real(dp), private :: tolerance = 1.0e-4_dp
      !> Its cycles, unless they are to be careful
      type(cycle_options_t), private :: cycle
      !> Whether the error of a contact that touches at a boundary film is that of its load share, and not of the friction
      logical, private :: by_load_share = .false.
      !> The roughness [a^2/R], pressure of the smooth contact and of the last share solved, (nx, ny)
      real(dp), allocatable :: rr(:, :), p_done(:, :)
      real(dp) :: h00_done = 0.0_dp
   contains
      procedure :: start
      procedure :: advance
      procedure :: mu_ratio
      procedure :: may_balance
      procedure :: meets
   end type stationary_roughness_t

contains

   !> Begin from the smooth solution of level n
   subroutine start(self, level, n, contact, surfaces, how, status)
      class(stationary_roughness_t), intent(inout) :: self
      type(level_t), intent(inout) :: level
      integer, intent(in) :: n
      class(contact_t), intent(in) :: contact
      class(moving_surfaces_t), intent(inout) :: surfaces
      !> As the smooth contact; the most cycles are those for a share of the roughness
      type(steady_options_t), intent(in) :: how
      type(status_t), intent(inout) :: status
      integer :: stat

      if (status%failed()) return
      self%contact = contact
      self%n = n
      self%cycle = how%cycle
      self%max_cycles = how%max_cycles
      if (level%boundary%active) self%max_cycles = max(how%max_cycles, int(cycles_a_node*level%grid%nx))
      self%tolerance = friction_tolerance*how%accuracy
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

   !> One cycle. All of it is
   !>
   !>    solve the smooth contact to the accuracy of the friction
   !>    do until all of the roughness is in
   !>       add the next share of it; halve the share where the film would be negative, or a solution is not found
   !>       solve the contact
   !>    end do
   subroutine advance(self, hierarchy)
      class(stationary_roughness_t), intent(inout) :: self
      type(hierarchy_t), intent(inout) :: hierarchy

      if (self%outcome /= outcome_running) return
      associate (level => hierarchy%levels(self%n))
         if (self%due) call grow(self, level)
         if (self%outcome /= outcome_running) return
         self%options = self%cycle
         if (level%boundary%touches()) self%options = damped_cycle(self%cycle)
         call self%improve(hierarchy)
         self%total_cycles = self%total_cycles + 1
         if (self%state == outcome_running .and. level%boundary%active .and. self%cycles > lost_after) then
            if (abs(self%m%load_error) > lost_load) self%state = outcome_cycle_limit
         end if
         if (self%state == outcome_running) return
         if (self%state /= outcome_converged) then
            call step_back(self, level)
            return
         end if
         if (self%smooth) self%friction_smooth = self%m%friction
         self%smooth = .false.
         self%share_done = self%share
         self%p_done = level%p
         self%h00_done = level%h00
         self%due = self%share < 1.0_dp
         if (.not. self%due) self%outcome = outcome_converged
      end associate
   end subroutine advance

   !> Algebraic error by the change of the friction or of the load share; the load is left to the cycles but at a boundary film
   logical function may_balance(self, before)
      class(stationary_roughness_t), intent(inout) :: self
      type(contact_results_t), intent(in) :: before
      real(dp) :: change, q

      may_balance = .false.
      if (self%unsound() /= outcome_running) return
      change = abs(self%m%friction - before%friction)/self%m%friction
      ! without that of the boundary film it is the friction of next to nothing
      if (self%by_load_share .and. self%m%touching%load_share > 0.0_dp) then
         change = abs(self%m%touching%load_share - before%touching%load_share)
      end if
      q = reduction([change], [self%change], self%cycles)
      self%algebraic = change*q/(1.0_dp - q)
      self%change = change
      ! nodes that lift off and touch again from cycle to cycle leave such an error
      may_balance = self%m%touching%load_share > 0.0_dp .and. self%residual <= residual_tolerance .and. &
                    abs(self%m%load_error) <= small_load_error
   end function may_balance

   !> Whether the present share is solved; the first cycle cannot tell
   pure logical function meets(self)
      class(stationary_roughness_t), intent(in) :: self
      real(dp) :: wanted

      wanted = merge(part_tolerance, self%tolerance, .not. self%smooth .and. self%share < 1.0_dp)
      meets = self%algebraic <= wanted .and. abs(self%m%load_error) <= load_tolerance &
              .and. self%residual <= residual_tolerance .and. self%cycles > 1
   end function meets

   !> The next share of the roughness, whose film must be positive under the pressure of the last one
   subroutine grow(self, level)
      class(stationary_roughness_t), intent(inout) :: self
      type(level_t), intent(inout) :: level

      self%due = .false.
      do
         self%share = min(1.0_dp, self%share_done + self%share_step)
         level%p = self%p_done
         level%h00 = self%h00_done
         call set_geometry(level, self%contact, self%share*self%rr)
         call refresh(level)
         if (level%boundary%active) exit
         if (minval(level%h) > 0.0_dp) exit
         self%share_step = 0.5_dp*self%share_step
         if (self%share_step < least_part) then
            self%m = measure(level)
            self%state = outcome_negative_film
            self%outcome = self%state
            return
         end if
      end do
      self%state = outcome_running
      self%parts = self%parts + 1
      self%cycles = 0
      self%m = measure(level)
   end subroutine grow

   !> This share was too much: a smaller one, or the end of the run
   subroutine step_back(self, level)
      class(stationary_roughness_t), intent(inout) :: self
      type(level_t), intent(inout) :: level

      self%share_step = 0.5_dp*min(self%share_step, self%share - self%share_done)
      if (self%smooth .or. self%share_step < least_part) then
         self%outcome = self%state
      else
         call grow(self, level)
      end if
   end subroutine step_back

   !> Friction over that of the smooth contact
   pure real(dp) function mu_ratio(self)
      class(stationary_roughness_t), intent(in) :: self
      mu_ratio = self%m%friction/self%friction_smooth
   end function mu_ratio
end module ehl_stationary_roughness

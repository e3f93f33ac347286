! SPDX-License-Identifier: BSD-3-Clause
!> A rough surface at rest: the steady contact with the roughness at its place in the film equation. It begins from
!> the smooth solution on the same grid. Where the film would be negative then, the roughness grows in steps.
module ehl_stationary_roughness
   use ehl_contact, only: contact_t
   use ehl_cycle, only: cycle_options_t
   use ehl_film, only: refresh
   use ehl_hierarchy, only: hierarchy_t
   use ehl_kinds, only: dp
   use ehl_level, only: level_t
   use ehl_moving_surfaces, only: moving_surfaces_t
   use ehl_contact_results, only: load_tolerance, measure, contact_results_t
   use ehl_outcome, only: outcome_converged, outcome_cycle_limit, outcome_diverged, outcome_negative_film, outcome_running
   use ehl_status, only: ehl_no_memory, status_t
   use ehl_steady, only: least_reduction, residual_tolerance
   use ehl_time_levels, only: set_geometry
   implicit none (type, external)
   private
   public :: stationary_roughness_t

   !> Relative algebraic error of a friction integral, as a share of the accuracy asked for; of a part of the roughness
   !> that is only on the way to the whole of it
   real(dp), parameter :: friction_tolerance = 1.0e-3_dp, part_tolerance = 3.0e-2_dp
   !> Smallest part of the roughness that is tried
   real(dp), parameter :: least_part = 1.0_dp/64.0_dp

   type :: stationary_roughness_t
      class(contact_t), allocatable, private :: contact
      integer :: outcome = outcome_running
      !> Whether the smooth contact is still being solved, to the accuracy of the friction
      logical :: smooth = .true.
      !> Whether the next cycle begins with the next share of the roughness
      logical, private :: due = .false.
      !> Share of the roughness in the film now, the last share that was solved, and the next step
      real(dp) :: share = 0.0_dp, share_done = 0.0_dp, share_step = 1.0_dp
      !> Shares solved
      integer :: parts = 0
      !> Cycles in all, and with the present share
      integer :: total_cycles = 0, cycles = 0
      real(dp) :: residual = 0.0_dp
      type(contact_results_t) :: m
      !> Relative algebraic error of the friction integral, as estimated, and the last change of it
      real(dp) :: algebraic = 0.0_dp, change = 0.0_dp
      !> Friction integral of the smooth contact
      real(dp) :: friction_smooth = 1.0_dp
      integer :: max_cycles = 0
      real(dp) :: tolerance = 1.0e-4_dp
      !> The roughness [a^2/R], pressure of the smooth contact and of the last share solved, (nx, ny)
      real(dp), allocatable :: rr(:, :), p_done(:, :)
      real(dp) :: h00_done = 0.0_dp
   contains
      procedure :: start
      procedure :: advance
      procedure :: mu_ratio
      procedure, private :: grow
      procedure, private :: step_back
   end type stationary_roughness_t

contains

   !> Begin from the smooth solution of a level
   subroutine start(self, level, contact, surfaces, max_cycles, accuracy, status)
      class(stationary_roughness_t), intent(inout) :: self
      type(level_t), intent(inout) :: level
      class(contact_t), intent(in) :: contact
      class(moving_surfaces_t), intent(inout) :: surfaces
      !> Most cycles for a share of the roughness
      integer, intent(in) :: max_cycles
      !> Algebraic error as a share of the discretisation error
      real(dp), intent(in) :: accuracy
      type(status_t), intent(inout) :: status
      integer :: stat

      if (status%failed()) return
      self%contact = contact
      self%max_cycles = max_cycles
      self%tolerance = friction_tolerance*accuracy
      if (allocated(self%rr)) deallocate (self%rr, self%p_done)
      allocate (self%rr(level%grid%nx, level%grid%ny), self%p_done(level%grid%nx, level%grid%ny), stat=stat)
      if (stat /= 0) then
         call status%fail(ehl_no_memory, "no memory for the roughness at rest")
         return
      end if
      call surfaces%roughness(level%grid, 0.0_dp, self%rr, moving=.false.)
      self%m = measure(level)
      self%friction_smooth = self%m%friction
   end subroutine start

   !> One cycle
   subroutine advance(self, hierarchy, n, options)
      class(stationary_roughness_t), intent(inout) :: self
      type(hierarchy_t), intent(inout) :: hierarchy
      integer, intent(in) :: n
      type(cycle_options_t), intent(in) :: options
      real(dp) :: before, change, q, wanted
      logical :: met

      if (self%outcome /= outcome_running) return
      associate (level => hierarchy%levels(n))
         if (self%due) call self%grow(level)
         if (self%outcome /= outcome_running) return
         before = self%m%friction
         call hierarchy%cycle(n, options, self%residual)
         self%cycles = self%cycles + 1
         self%total_cycles = self%total_cycles + 1
         self%m = measure(level)
         if (.not. self%m%finite .or. .not. self%m%positive) then
            call self%step_back(level, merge(outcome_negative_film, outcome_diverged, self%m%finite))
            return
         end if
         change = abs(self%m%friction - before)/self%m%friction
         q = least_reduction
         if (self%cycles > 1) q = max(least_reduction, min(change/max(self%change, tiny(1.0_dp)), 0.95_dp))
         self%algebraic = change*q/(1.0_dp - q)
         self%change = change
         wanted = merge(part_tolerance, self%tolerance, .not. self%smooth .and. self%share < 1.0_dp)
         met = self%algebraic <= wanted .and. abs(self%m%load_error) <= load_tolerance &
               .and. self%residual <= residual_tolerance .and. self%cycles > 1
         if (met) then
            if (self%smooth) self%friction_smooth = self%m%friction
            self%smooth = .false.
            if (self%share >= 1.0_dp) then
               self%outcome = outcome_converged
            else
               self%share_done = self%share
               self%p_done = level%p
               self%h00_done = level%h00
               self%due = .true.
            end if
         else if (self%cycles >= self%max_cycles) then
            call self%step_back(level, outcome_cycle_limit)
         end if
      end associate
   end subroutine advance

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
         if (minval(level%h) > 0.0_dp) exit
         self%share_step = 0.5_dp*self%share_step
         if (self%share_step < least_part) then
            self%m = measure(level)
            self%outcome = outcome_negative_film
            return
         end if
      end do
      self%outcome = outcome_running
      self%parts = self%parts + 1
      self%cycles = 0
      self%m = measure(level)
   end subroutine grow

   !> This share was too much: a smaller one, or the end of the run
   subroutine step_back(self, level, outcome)
      class(stationary_roughness_t), intent(inout) :: self
      type(level_t), intent(inout) :: level
      integer, intent(in) :: outcome

      self%outcome = outcome
      self%share_step = 0.5_dp*min(self%share_step, self%share - self%share_done)
      if (self%smooth .or. self%share_step < least_part) return
      call self%grow(level)
   end subroutine step_back

   !> Friction over that of the smooth contact
   pure real(dp) function mu_ratio(self)
      class(stationary_roughness_t), intent(in) :: self
      mu_ratio = self%m%friction/self%friction_smooth
   end function mu_ratio
end module ehl_stationary_roughness

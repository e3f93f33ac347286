! SPDX-License-Identifier: BSD-3-Clause
!> Rejection, damping and acceleration of cycles (docs/theory/coarse-grids.md)
submodule (ehl_smooth_contact) ehl_cycle_guard
   use ehl_cycle, only: max_damping
   use ehl_outcome, only: outcome_diverged, outcome_negative_film
   use ehl_reynolds, only: update_coefficients
   use ehl_status, only: ehl_no_memory
   implicit none (type, external)

   !> Cycles after which the damping is reduced, and cycles within which the residual must halve
   integer, parameter :: undamped_after = 3, patience = 8
   !> Cycles stall if one leaves more than this fraction of the residual; number of cycles on a level before acceleration may begin
   real(dp), parameter :: stalled = 0.6_dp
   integer, parameter :: stalls_after = 5
   !> A cycle is rejected if the residual exceeds that of a solution and increases by this factor. Of five difficult contacts
   !> with L from 17 to 37 all converge with 1.05 and 1.2; with 2 and 4 one ends at the cycle limit (tests/cases/test_machines.py)
   real(dp), parameter :: max_growth = 1.2_dp
   !> First fraction of the sliding and of the pressure gradient in the shear-thinning law, and the factor by which it increases
   !> when the residual is near that of a solution
   real(dp), parameter :: min_shear_fraction = 0.1_dp, fraction_growth = 3.0_dp

contains

   module procedure begin_guard
      integer :: degree

      degree = 0
      if (self%is_ellipse() .and. has_coarser(self%results, self%n) .and. .not. self%damped) degree = self%guard%first
      self%guard = guard_t(damping=degree, last_damping=degree, first=degree)
      call self%mixing%finish()
   end procedure begin_guard

   module procedure keep_state
      integer :: stat

      if (.not. allocated(self%guard%p_before)) then
         allocate (self%guard%p_before(level%grid%nx, level%grid%ny), stat=stat)
         if (stat /= 0) then
            call status%fail(ehl_no_memory, "no memory for the state before a cycle")
            return
         end if
      end if
      self%guard%p_before = level%p
      self%guard%h00_before = level%h00
   end procedure keep_state

   module procedure guard_cycle
      real(dp) :: limit
      logical :: rejected

      if (status%failed() .or. .not. self%guarded) return
      associate (guard => self%guard)
         guard%cycles_since = guard%cycles_since + 1
         rejected = any(outcome == [outcome_diverged, outcome_negative_film])
         limit = max_residual
         if (guard%residual_kept > 0.0_dp) limit = max(residual_tolerance, max_growth*guard%residual_kept)
         if (outcome == outcome_running) rejected = self%residual > limit
         if (.not. (rejected .or. guard%softened .or. guard%residual_kept > 0.0_dp)) guard%first = guard%damping
         if (.not. rejected) guard%residual_kept = self%residual
         if (rejected) then
            if (self%cycles >= self%max_cycles) return
            if (may_soften(self, hierarchy, outcome)) then
               guard%softened = .true.
               guard%shear_fraction = min_shear_fraction
               guard%shear_fraction_before = min_shear_fraction
               call hierarchy%soften(min_shear_fraction)
               call restore_state(self, hierarchy)
               outcome = outcome_running
               return
            end if
            if (guard%shear_fraction > 1.05_dp*guard%shear_fraction_before .and. guard%cycles_since <= 2) then
               guard%shear_fraction = sqrt(guard%shear_fraction*guard%shear_fraction_before)
               call hierarchy%soften(guard%shear_fraction)
               call restore_state(self, hierarchy)
               outcome = outcome_running
               guard%cycles_since = 0
               return
            end if
            if (guard%damping == max_damping) return
            ! otherwise the same damping would be tried repeatedly
            if (guard%cycles_since == 1 .and. guard%last_damping > 0) guard%min_damping = guard%last_damping
            guard%damping = max(guard%damping + 1, guard%min_damping)
            guard%last_damping = guard%damping
            guard%cycles_since = 0
            call restore_state(self, hierarchy)
            outcome = outcome_running
         else if (guard%shear_fraction < 1.0_dp .and. self%residual < near_solution) then
            guard%shear_fraction_before = guard%shear_fraction
            guard%shear_fraction = min(1.0_dp, fraction_growth*guard%shear_fraction)
            guard%cycles_since = 0
            call hierarchy%soften(guard%shear_fraction)
            call update_coefficients(hierarchy%levels(self%n))
            guard%residual_kept = 0.0_dp
         else if (guard%damping > guard%min_damping .and. guard%cycles_since >= undamped_after) then
            guard%damping = guard%damping - 1
            guard%cycles_since = 0
         else if (outcome == outcome_running .and. mod(self%cycles, patience) == 0) then
            if (self%residual > 0.5_dp*guard%residual_earlier .and. guard%damping < max_damping) then
               guard%damping = guard%damping + 1
               guard%min_damping = guard%damping
               guard%cycles_since = 0
               call self%mixing%finish()
            end if
            guard%residual_earlier = self%residual
         end if
      end associate
      if (outcome /= outcome_running .or. self%cycles < stalls_after) return
      if (self%stall > stalled) call self%mixing%begin(hierarchy%levels(self%n), status)
   end procedure guard_cycle

   !> Whether to start with a reduced shear-thinning law: a cycle from the Hertz pressure diverged, since the flow factors increase
   !> exponentially with the pressure gradient at its edge
   pure logical function may_soften(self, hierarchy, outcome)
      class(smooth_contact_t), intent(in) :: self
      type(hierarchy_t), intent(in) :: hierarchy
      integer, intent(in) :: outcome

      may_soften = outcome == outcome_diverged .and. hierarchy%levels(self%n)%flow%depends_on_gradient .and. &
                   .not. (self%guard%softened .or. has_coarser(self%results, self%n))
   end function may_soften

   !> Restore the state before the last cycle
   subroutine restore_state(self, hierarchy)
      class(smooth_contact_t), intent(inout) :: self
      type(hierarchy_t), intent(inout) :: hierarchy

      call hierarchy%forget()
      associate (level => hierarchy%levels(self%n))
         level%p = self%guard%p_before
         level%h00 = self%guard%h00_before
         call refresh(level)
         self%m = measure(level)
      end associate
      self%residual = self%guard%residual_kept
      call self%mixing%finish()
   end subroutine restore_state
end submodule ehl_cycle_guard

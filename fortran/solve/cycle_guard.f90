! SPDX-License-Identifier: BSD-3-Clause
!> Cycles that are taken back, damped and accelerated (docs/theory/coarse-grids.md)
submodule (ehl_smooth_contact) ehl_cycle_guard
   implicit none (type, external)

   !> Cycles after which the changes of a cycle are made larger again, and those in which the residual must halve
   integer, parameter :: undamped_after = 3, patience = 8
   !> Cycles of a level that leave more than this share of the residual stall, after so many
   real(dp), parameter :: stalled = 0.6_dp
   integer, parameter :: stalls_after = 5
   !> Residual over that before a cycle from which on it is taken back, above the residual of a solution. Of five hard contacts
   !> with L from 17 to 37 all converge with 1.05 and 1.2; with 2 and 4 one ends at the cycle limit (tests/cases/test_machines.py)
   real(dp), parameter :: max_growth = 1.2_dp

contains

   module procedure begin_guard
      self%guard = guard_t()
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
      logical :: lost

      if (status%failed() .or. .not. self%guarded) return
      associate (guard => self%guard)
         guard%since = guard%since + 1
         lost = any(outcome == [outcome_diverged, outcome_negative_film])
         limit = max_residual
         if (guard%residual_kept > 0.0_dp) limit = max(residual_tolerance, max_growth*guard%residual_kept)
         if (outcome == outcome_running) lost = self%residual > limit
         if (.not. lost) guard%residual_kept = self%residual
         if (lost) then
            if (guard%damping == max_damping .or. self%cycles >= self%max_cycles) return
            ! the same amount again would be tried again and again
            if (guard%since == 1 .and. guard%was_damped > 0) guard%lasting = guard%was_damped
            guard%damping = max(guard%damping + 1, guard%lasting)
            guard%was_damped = guard%damping
            guard%since = 0
            call hierarchy%forget()
            associate (level => hierarchy%levels(self%n))
               level%p = guard%p_before
               level%h00 = guard%h00_before
               call refresh(level)
               self%m = measure(level)
            end associate
            self%residual = guard%residual_kept
            outcome = outcome_running
            call self%mixing%finish()
         else if (guard%damping > guard%lasting .and. guard%since >= undamped_after) then
            guard%damping = guard%damping - 1
            guard%since = 0
         else if (outcome == outcome_running .and. mod(self%cycles, patience) == 0) then
            if (self%residual > 0.5_dp*guard%residual_then .and. guard%damping < max_damping) then
               guard%damping = guard%damping + 1
               guard%lasting = guard%damping
               guard%since = 0
               call self%mixing%finish()
            end if
            guard%residual_then = self%residual
         end if
      end associate
      if (outcome /= outcome_running .or. self%cycles < stalls_after) return
      if (self%stall > stalled) call self%mixing%begin(hierarchy%levels(self%n), status)
   end procedure guard_cycle
end submodule ehl_cycle_guard

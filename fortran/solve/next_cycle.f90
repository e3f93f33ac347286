! SPDX-License-Identifier: BSD-3-Clause
!> The next cycle of a smooth contact: its options, the cycle limit, and the meniscus of a starved line
submodule (ehl_smooth_contact) ehl_next_cycle
   use ehl_cycle, only: cycle_options_t, damped_cycle
   use ehl_level_tolerance, only: share_counts
   implicit none (type, external)

   !> Factors of the cycle limit. With solid contact: the edge of the solid contact needs several cycles to move by one node
   integer, parameter :: solid_contact_cycles = 3
   !> Rollers: relaxation slowly removes the errors that coarse grids leave at the ends (47 to 89 cycles)
   integer, parameter :: roller_cycles = 4
   !> Starved contacts: the flow back from the contact and around it balances slowly
   integer, parameter :: starved_cycles = 3
   !> Lines with a fixed meniscus: each position needs several cycles
   integer, parameter :: meniscus_cycles = 10
   !> Cycle limit of a level with a reduced shear-thinning law
   integer, parameter :: softened_cycles = 20
   !> Minimum relative algebraic error that a reduced cycle reaches; a smaller one would cost another cycle
   real(dp), parameter :: reduced_error = 3.0e-4_dp
   !> The value of `near_solution` in the last attempt at a wide contact
   real(dp), parameter :: near_solution_wide = 0.5_dp
   !> Maximum numbers that count as few cycles: of a level that started from a coarser one, and from the Hertz pressure
   integer, parameter :: max_from_coarser = 2, max_from_hertz = 3

contains

   module procedure begin_cycle
      if (self%options%flooded) call self%far_field%set_border(level, self%contact%load)
      if (self%meniscus%active) call follow_meniscus(self, level)
      self%cycle_passage = self%passage
      if (level%supply%active) self%layer_central = level%supply%layer(1 + nint(-level%grid%y0/level%grid%hy))
      self%next_cycle = cycle_options(self)
      if (self%residual > near_solution .or. self%n < self%options%spare_spikes_from) self%next_cycle%spare_spikes = .false.
      if (self%spares_spikes .and. self%residual > 0.0_dp) self%next_cycle%spare_spikes = self%residual < near_solution_wide
      self%max_cycles = self%options%max_cycles
      if (self%contact%is_roller()) self%max_cycles = roller_cycles*self%max_cycles
      if (is_end(self%options, self%n) .and. share_counts(self%options, self%m)) then
         self%max_cycles = solid_contact_cycles*self%max_cycles
      end if
      if (self%guard%shear_fraction < 1.0_dp) self%max_cycles = min(self%max_cycles, softened_cycles)
      if (self%options%layer > 0.0_dp) self%max_cycles = starved_cycles*self%options%max_cycles
      if (self%meniscus%active) self%max_cycles = meniscus_cycles*self%options%max_cycles
      if (self%guarded) call keep_state(self, level, status)
   end procedure begin_cycle

   !> Move the meniscus of a line if its flow has converged and differs from that of its layer
   subroutine follow_meniscus(self, level)
      class(smooth_contact_t), intent(inout) :: self
      type(level_t), intent(inout) :: level
      logical :: moved

      if (self%cycles == 0) return
      call self%meniscus%follow(level, self%m%oil%leaves, moved)
      if (.not. moved) return
      call refresh(level)
      self%m = measure(level)
      self%guard%residual_kept = 0.0_dp
      call self%mixing%finish()
   end subroutine follow_meniscus

   !> Options of the next cycle. On a level that started from a coarser one the second cycle is reduced if the allowed error
   !> permits, with one pre-relaxation less if the coarser level was solved in few cycles.
   pure function cycle_options(self) result(options)
      class(smooth_contact_t), intent(in) :: self
      type(cycle_options_t) :: options
      logical :: first

      options = self%options%cycle
      if (self%damped) options = damped_cycle(options)
      if (self%guard%damping > 0) options = damped_cycle(self%options%cycle, self%guard%damping)
      if (self%damped .or. self%guard%damping > 0) return
      if (self%options%second_cycle%full .eqv. self%options%cycle%full) return
      if (.not. has_coarser(self%results, self%n) .or. self%cycles /= 1) return
      if (any(allowed_errors(self%options, self%results, self%n, self%m) < reduced_error*self%m%films())) return
      options = self%options%second_cycle
      first = self%n == 2
      if (.not. first) first = .not. self%results(self%n - 2)%solved
      if (self%results(self%n - 1)%cycles <= merge(max_from_hertz, max_from_coarser, first)) options%pre = options%pre - 1
   end function cycle_options
end submodule ehl_next_cycle

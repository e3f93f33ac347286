! SPDX-License-Identifier: BSD-3-Clause
!> The next cycle of a smooth contact: its kind, the largest number of cycles, and the meniscus of a starved line
submodule (ehl_smooth_contact) ehl_next_cycle
   use ehl_cycle, only: cycle_options_t, damped_cycle
   use ehl_level_tolerance, only: counts_share
   implicit none (type, external)

   !> Largest number of cycles of a contact with solid contact, over that of others: the edge of a touching zone moves by a node
   !> in several cycles
   integer, parameter :: touching_cycles = 3
   !> The same of a roller: sweeps remove the errors of coarse grids at its ends slowly (47 to 89 cycles)
   integer, parameter :: roller_cycles = 4
   !> The same of a starved contact: the flow back from the contact and around it balances slowly
   integer, parameter :: starved_cycles = 3
   !> The same of a line with a fixed meniscus: several cycles for each of its positions
   integer, parameter :: held_cycles = 10
   !> Largest number of cycles of a level within which a softened flow must become that of the law
   integer, parameter :: softened_cycles = 20
   !> Smallest relative algebraic error that a light cycle reaches: for a smaller one it would cost one more cycle
   real(dp), parameter :: light_error = 3.0e-4_dp
   !> near_solution of the last attempt at a wide contact
   real(dp), parameter :: near_spared = 0.5_dp
   !> Few cycles: on a level that began from a coarser one, and from the Hertz pressure
   integer, parameter :: min_cycles = 2, cycles_from_guess = 3

contains

   module procedure begin_cycle
      if (self%options%flooded) call self%far_field%set_border(level, self%contact%load)
      if (self%meniscus%active) call follow_meniscus(self, level)
      self%cycle_passage = self%passage
      if (level%supply%active) self%layer_central = level%supply%layer(1 + nint(-level%grid%y0/level%grid%hy))
      self%next_cycle = cycle_to_make(self)
      if (self%residual > near_solution .or. self%n < self%options%spares_from) self%next_cycle%spare_spikes = .false.
      if (self%spares .and. self%residual > 0.0_dp) self%next_cycle%spare_spikes = self%residual < near_spared
      self%max_cycles = self%options%max_cycles
      if (self%contact%is_roller()) self%max_cycles = roller_cycles*self%max_cycles
      if (is_end(self%options, self%n) .and. counts_share(self%options, self%m)) then
         self%max_cycles = touching_cycles*self%max_cycles
      end if
      if (self%guard%share < 1.0_dp) self%max_cycles = min(self%max_cycles, softened_cycles)
      if (self%options%layer > 0.0_dp) self%max_cycles = starved_cycles*self%options%max_cycles
      if (self%meniscus%active) self%max_cycles = held_cycles*self%options%max_cycles
      if (self%guarded) call keep_state(self, level, status)
   end procedure begin_cycle

   !> Move the meniscus of a line if its flow is known and differs from that of its layer
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

   !> Options of the next cycle. On a level that began from a coarser one the second cycle is a light one if its error is
   !> small enough, with one sweep less before the coarse grids where the coarser level was solved in few cycles
   pure function cycle_to_make(self) result(options)
      class(smooth_contact_t), intent(in) :: self
      type(cycle_options_t) :: options
      logical :: first

      options = self%options%cycle
      if (self%damped) options = damped_cycle(options)
      if (self%guard%damping > 0) options = damped_cycle(self%options%cycle, self%guard%damping)
      if (self%damped .or. self%guard%damping > 0) return
      if (self%options%second_cycle%full .eqv. self%options%cycle%full) return
      if (.not. has_coarser(self%results, self%n) .or. self%cycles /= 1) return
      if (any(allowed_errors(self%options, self%results, self%n, self%m) < light_error*self%m%films())) return
      options = self%options%second_cycle
      first = self%n == 2
      if (.not. first) first = .not. self%results(self%n - 2)%solved
      if (self%results(self%n - 1)%cycles <= merge(cycles_from_guess, min_cycles, first)) options%pre = options%pre - 1
   end function cycle_to_make
end submodule ehl_next_cycle

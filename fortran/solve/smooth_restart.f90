! SPDX-License-Identifier: BSD-3-Clause
!> Restarts of the smooth contact: for the next passage of a starved one, and after a failed level
submodule (ehl_smooth_contact) ehl_smooth_restart
   use ehl_oil_flow, only: leaving
   implicit none (type, external)

   !> Relative change of the central film between passages below which the film is steady
   real(dp), parameter :: steady_film = 1.0e-4_dp

contains

   module procedure next_passage
      if (self%passage > 1) then
         if (abs(self%m%film_central - self%film_before) <= steady_film*self%m%film_central) return
      end if
      self%film_before = self%m%film_central
      self%passage = self%passage + 1
      self%solved = .false.
      outcome = outcome_running
      self%cycles = 0
      level%supply%layer = self%options%replenishment*self%options%layer + (1.0_dp - self%options%replenishment)*leaving(level)
      call begin_guard(self)
   end procedure next_passage

   module procedure restart
      logical :: again

      again = finest
      if (finest) then
         if (.not. self%damped .and. self%options%may_restart) then
            self%damped = .true.
         else if (.not. self%guarded) then
            self%guarded = .true.
            self%damped = .false.
         else if (may_spare_spikes(self)) then
            self%spares_spikes = .true.
         else if (self%options%line .and. self%options%layer > 0.0_dp .and. .not. self%meniscus%active) then
            self%meniscus%active = .true.
            self%flooded_inlet = .false.
         else
            return
         end if
      else if (self%guard%softened .and. .not. self%damped .and. self%options%may_restart) then
         self%damped = .true.
         again = .true.
      end if
      outcome = outcome_running
      self%results%solved = .false.
      self%restarts = self%restarts + 1
      self%begun = .false.
      self%n = merge(self%options%start, self%n + 1, again)
   end procedure restart

   !> Whether a contact with sharp spikes may be solved again with the spikes left to relaxation
   pure logical function may_spare_spikes(self)
      class(smooth_contact_t), intent(in) :: self

      may_spare_spikes = self%options%guarded .and. .not. self%spares_spikes .and. self%options%spare_spikes_from < huge(1)
   end function may_spare_spikes
end submodule ehl_smooth_restart

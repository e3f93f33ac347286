! SPDX-License-Identifier: BSD-3-Clause
!> A time step under a duty: its length, the conditions at its end, the direction of the flow, and its error
submodule (ehl_transient_state) ehl_transient_duty
   use ehl_contact_results, only: central_row
   use ehl_level, only: gap
   use ehl_wedge, only: wedge_separate
   implicit none (type, external)

   !> Length of the first step of a starved contact, at constant conditions, whose end is steady [a/u]
   real(dp), parameter :: steady_time = 16.0_dp

contains

   module procedure begin_duty
      real(dp) :: stress, ratio
      integer :: k

      associate (level => hierarchy%levels(self%n))
         self%time_step = self%duty_steps%next(self%duty, self%time, level%grid%hx, surfaces%rough())
         ! while the conditions are those of the case no step is solved: it extends to the next row of the table
         associate (row => self%duty%next_knot(self%time))
            if (self%duty%is_constant(row(1))) self%time_step = row(1) - self%time
         end associate
         self%now = self%duty%at(self%time + self%time_step)
         ratio = self%duty_steps%ratio(self%time_step)
         self%settling = .not. (self%settled .or. self%duty_steps%steps(1) > 0.0_dp .or. &
                                self%duty%is_constant(self%time + self%time_step))
         if (self%settling) then
            self%time_step = steady_time*0.5_dp**self%duty_steps%cuts
            self%now = self%duty%at(self%time)
            ratio = 1.0_dp
         end if
         level%load = self%contact%load*self%now%load
         self%predictor%shifts = surfaces%velocities()*abs(self%now%mean_velocity())*self%time_step/level%grid%hx
      end associate
      stress = self%duty%stress*abs(self%now%speeds(1) - self%now%speeds(2))*self%now%viscosity
      do k = 1, size(hierarchy%levels)
         associate (level => hierarchy%levels(k))
            if (.not. allocated(level%p)) cycle
            call level%wedge%set_step(wedge_separate, level%grid%hx, self%time_step, abs(self%now%mean_velocity()), &
                                      ratio)
            call level%supply%set_step(self%duty%layer*self%now%layer, abs(self%now%mean_velocity()), level%wedge%squeeze)
            level%lubricant%shear%scale = stress
            call level%flow%rescale(self%inverse_speed/self%now%viscosity, stress/max(level%lubricant%shear%stress, tiny(1.0_dp)))
         end associate
      end do
      self%reversed = self%now%mean_velocity() < 0.0_dp
      call mirror_fields(self)
   end procedure begin_duty

   module procedure settle
      self%settling = .false.
      self%settled = .true.
      self%duty_steps%cuts = 0
      self%total_cycles = self%total_cycles + self%cycles
      call keep(level, self%mass_content, self%p_before)
      self%mass_content(:, :, 2) = self%mass_content(:, :, 1)
      self%p_before(:, :, 2) = level%p
      self%p_before(:, :, 3) = level%p
      self%h00_before = level%h00
      call self%duty_error%settle(level%h)
   end procedure settle

   module procedure stays_steady
      stays_steady = self%duty%active .and. .not. self%settling
      if (stays_steady) stays_steady = self%duty%is_constant(self%time + self%time_step)
   end procedure stays_steady

   module procedure assess_duty
      integer :: j

      j = central_row(level%grid)
      call self%duty_steps%assess(self%duty, self%time_step, self%now%mean_velocity(), &
                                  self%duty_error%max_added(level%grid%columns(), level%h(:, j), &
                                                            self%duty_steps%before(self%time_step), half_width(self), j), accepted)
   end procedure assess_duty

   module procedure growth
      growth = self%contact%growth(self%now%load, self%now%curvatures(1))
   end procedure growth

   !> Present half width of the dry contact along X [a]
   pure real(dp) function half_width(self)
      class(transient_t), intent(in) :: self
      half_width = self%contact%reach(1)*self%growth()
   end function half_width

   module procedure accept_duty
      integer :: at(2)

      call self%duty_error%add(level%grid%columns(), level%h, self%duty_steps%before(self%time_step), &
                               abs(self%now%mean_velocity())*self%time_step, half_width(self))
      call self%duty_steps%keep(self%time_step)
      associate (grid => level%grid)
         self%film_errors(1) = self%duty_error%upstream(1 + ceiling(-grid%x0/grid%hx), central_row(grid))/self%m%film_central
         at = minloc(gap(level))
         self%film_errors(2) = self%duty_error%upstream(at(1), at(2))/self%m%film_minimum
      end associate
   end procedure accept_duty

   module procedure end_duty
      if (.not. self%reversed) return
      call mirror_fields(self)
      self%reversed = .false.
      call mirror(level%p)
      call mirror(level%film_rhs)
      call refresh(level)
   end procedure end_duty

   !> Mirror the fields of the last steps if the flow is reversed
   subroutine mirror_fields(self)
      class(transient_t), intent(inout) :: self
      integer :: k

      if (.not. self%reversed) return
      do k = 1, size(self%mass_content, 3)
         call mirror(self%mass_content(:, :, k))
      end do
      do k = 1, size(self%p_before, 3)
         call mirror(self%p_before(:, :, k))
      end do
      do k = 1, size(self%predictor%weights, 3)
         call mirror(self%predictor%weights(:, :, k))
      end do
      do k = 1, size(self%duty_error%films, 3)
         call mirror(self%duty_error%films(:, :, k))
      end do
      call mirror(self%duty_error%error)
   end subroutine mirror_fields
end submodule ehl_transient_duty

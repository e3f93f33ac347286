! SPDX-License-Identifier: BSD-3-Clause
!> Row of the history of a contact under a duty, with the errors of the time steps (docs/evidence/duty)
submodule (ehl_contact_run) ehl_contact_duty
   use ehl_duty, only: duty_state_t
   use ehl_heat, only: flash_temperature
   use ehl_inlet, only: inlet_t, share_by_film
   use ehl_kinds, only: not_known
   use ehl_level, only: level_t
   use ehl_wall_heat, only: heat_source
   implicit none (type, external)

   !> Error of a quantity over its second divided difference times the square of the step, and decay of the error per step
   !> (docs/evidence/duty)
   real(dp), parameter :: difference_factor = 2.0_dp, error_decay = 0.8_dp
   !> Relative error of the friction over that of the pressure (docs/evidence/duty, random duties)
   real(dp), parameter :: pressure_factor = 2.0_dp
   !> Exponent of the speed in the central film (Hamrock & Dowson 1977)
   real(dp), parameter :: speed_exponent = 0.67_dp

contains

   module procedure duty_names
      names = [character(len=16) :: "step", "T", "t_s", "speed", "slide", "load", "radius_x", "radius_y", "viscosity", &
               "H_c", "H_min", "X_min", "Y_min", "P_max", "h_c_m", "h_min_m", "p_max_Pa", "mu", "power_W", "flash_K", &
               "load_error", "cycles", "residual", "c_step_error", "min_step_error", "p_step_error", &
               "mu_step_error"]
      if (self%plan%lubricant%boundary_film > 0.0_dp) names = [character(len=16) :: names, "load_share_error"]
   end procedure duty_names

   module procedure duty_row
      real(dp) :: place(2), mu, power, flash, p_error, share_error

      associate (t => self%transient, m => self%transient%m, scales => self%plan%scales)
         p_error = pressure_error(self, m%pressure_maximum*scales%pressure)
         share_error = 0.0_dp
         if (self%plan%lubricant%boundary_film > 0.0_dp) share_error = load_share_error(self)
         call find_minimum(level, place)
         call find_friction(self, level, mu, power, flash)
         row = [real(dp) :: t%step, t%time, t%time*t%duty%time_scale, t%now%mean_velocity(), &
                t%now%speeds(1) - t%now%speeds(2), t%now%load, 1.0_dp/t%now%curvatures, t%now%viscosity, m%films(), &
                place, m%pressure_maximum, m%films()*scales%film, m%pressure_maximum*scales%pressure, mu, power, flash, &
                m%load_error, t%cycles, t%residual, t%film_errors, &
                p_error, friction_error(self, mu, p_error, share_error)]
         if (self%plan%lubricant%boundary_film > 0.0_dp) row = [row, share_error]
      end associate
   end procedure duty_row

   !> Error of the load share: from the film error of the inlet (the film decreases with the speed) and of the time steps, or from
   !> BDF2 where the load share changes abruptly
   real(dp) function load_share_error(self) result(error)
      class(contact_run_t), intent(in) :: self
      type(inlet_t) :: inlet

      associate (t => self%transient, share => self%transient%m%touching%load_share)
         inlet = self%plan%inlet
         inlet%film = inlet%film*abs(t%now%mean_velocity())**speed_exponent
         error = max(inlet%share_error(t%m, self%grid%hx) + share*min(1.0_dp, share_by_film*maxval(t%film_errors)), &
                     remaining(self, "load_share_error"), squeeze_error(self, "load_share", share))
      end associate
   end function load_share_error

   !> Relative time-step error of the maximum pressure: that of the films, or of the squeeze of a thick film
   real(dp) function pressure_error(self, pressure)
      class(contact_run_t), intent(in) :: self
      real(dp), intent(in) :: pressure

      pressure_error = max(maxval(self%transient%film_errors), remaining(self, "p_step_error"), &
                           squeeze_error(self, "p_max_Pa", pressure)/pressure)
   end function pressure_error

   !> Time-step error of the coefficient of friction: from the errors of the pressure (through the viscosity) and of the load share,
   !> or from BDF2 in an abrupt squeeze
   real(dp) function friction_error(self, mu, pressure, share)
      class(contact_run_t), intent(in) :: self
      real(dp), intent(in) :: mu
      !> Relative error of the maximum pressure (not below that of the films), and error of the load share
      real(dp), intent(in) :: pressure, share

      friction_error = abs(mu)*pressure_factor*pressure
      associate (stress => self%plan%lubricant%boundary_stress, m => self%transient%m)
         if (stress > 0.0_dp) friction_error = friction_error + share*abs(mu)*stress*m%load/m%friction
      end associate
      friction_error = max(friction_error, remaining(self, "mu_step_error"), squeeze_error(self, "mu", mu))
   end function friction_error

   !> Error in the previous row, decayed by one step
   real(dp) function remaining(self, column)
      class(contact_run_t), intent(in) :: self
      character(len=*), intent(in) :: column

      remaining = 0.0_dp
      associate (n => self%history%n_rows())
         if (n > 1) remaining = error_decay*self%history%entry_of(column, n)
      end associate
   end function remaining

   !> Error of BDF2 where the squeeze changes a quantity abruptly: from its second divided difference
   real(dp) function squeeze_error(self, column, now) result(error)
      class(contact_run_t), intent(in) :: self
      character(len=*), intent(in) :: column
      real(dp), intent(in) :: now
      !> Times and values of the last two rows, and the present time
      real(dp) :: t(2), x(2), time
      integer :: k, n

      error = 0.0_dp
      n = self%history%n_rows()
      if (n < 2) return
      time = self%transient%time*self%transient%duty%time_scale
      do k = 1, 2
         t(k) = self%history%entry_of("t_s", n - 2 + k)
         x(k) = self%history%entry_of(column, n - 2 + k)
      end do
      associate (slope => (now - x(2))/(time - t(2)), slope_before => (x(2) - x(1))/(t(2) - t(1)))
         error = difference_factor*(time - t(2))**2*abs(slope - slope_before)/(time - t(1))
      end associate
   end function squeeze_error

   !> Position of the minimum film [a]
   subroutine find_minimum(level, place)
      type(level_t), intent(in) :: level
      real(dp), intent(out) :: place(2)
      integer :: at(2)

      at = minloc(gap(level))
      place = [level%grid%x(at(1)), level%grid%y(at(2))]
   end subroutine find_minimum

   !> Coefficient of friction, frictional power, and flash temperature of walls in a steady state. Not known where the Newtonian
   !> stress exceeds the limit up to which oils are Newtonian, or bodies touch and their friction is not given.
   subroutine find_friction(self, level, mu, power, flash)
      class(contact_run_t), intent(in) :: self
      type(level_t), intent(in) :: level
      real(dp), intent(out) :: mu, power, flash
      real(dp) :: stress, force, load, speed, size, source(2), newtonian(level%grid%nx), real_stress(level%grid%nx), speeds(2)
      integer :: j

      mu = not_known
      power = not_known
      flash = not_known
      associate (t => self%transient, plan => self%plan, s => self%plan%sliding, shear => level%lubricant%shear)
         stress = 0.0_dp
         if (.not. shear%thins()) then
            do j = 1, level%grid%ny
               call level%flow%stress_row(level%lubricant, level%p, level%boundary%film_row(level%h(:, j), j), level%rho(:, j), j, &
                                          newtonian, real_stress)
               stress = max(stress, shear%scale*maxval(newtonian))
            end do
         end if
         if (stress > s%newtonian_limit .or. t%m%touching%load_share > 0.0_dp .and. .not. &
             plan%lubricant%boundary_stress > 0.0_dp) return
         load = s%load*t%now%load
         force = t%m%friction*shear%scale*plan%scales%length**plan%contact%dimensions
         mu = force/load
         speed = abs(t%now%speeds(1) - t%now%speeds(2))*s%mean_velocity
         power = force*speed
         ! present size of the dry contact
         size = plan%scales%length*t%growth()
         source = heat_source(plan%contact)
         speeds = abs(t%now%speeds)*s%mean_velocity
         flash = flash_temperature(power/plan%contact%flash_area(size), source(1)*size, source(2), speeds, s%conductivity, &
                                   s%diffusivity)
      end associate
   end subroutine find_friction
end submodule ehl_contact_duty

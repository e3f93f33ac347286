! SPDX-License-Identifier: BSD-3-Clause
!> A row of the history of a contact under a duty
submodule (ehl_contact_run) ehl_contact_duty
   use ehl_duty, only: duty_state_t
   use ehl_heat, only: flash_temperature
   use ehl_kinds, only: not_known
   use ehl_level, only: level_t
   use ehl_wall_heat, only: heat_source
   implicit none (type, external)

   !> Error of p_max by its second difference, and its decay per step (docs/evidence/duty)
   real(dp), parameter :: by_difference = 2.0_dp, left = 0.8_dp

contains

   module procedure duty_names
      names = [character(len=16) :: "step", "T", "t_s", "speed", "slide", "load", "radius_x", "radius_y", "viscosity", &
               "H_c", "H_min", "X_min", "Y_min", "P_max", "h_c_m", "h_min_m", "p_max_Pa", "mu", "power_W", "flash_K", &
               "load_error", "cycles", "residual", "c_step_error", "min_step_error", "p_step_error"]
   end procedure duty_names

   module procedure duty_row
      real(dp) :: place(2), mu, power, flash

      associate (t => self%transient, m => self%transient%m, scales => self%plan%scales)
         call find_minimum(level, place)
         call find_friction(self, level, mu, power, flash)
         row = [real(dp) :: t%step, t%time, t%time*t%duty%time_scale, t%now%mean_velocity(), &
                t%now%speeds(1) - t%now%speeds(2), t%now%load, 1.0_dp/t%now%curvatures, t%now%viscosity, m%films(), &
                place, m%pressure_maximum, m%films()*scales%film, m%pressure_maximum*scales%pressure, mu, power, flash, &
                m%load_error, t%cycles, t%residual, t%film_errors, &
                pressure_error(self, t%time*t%duty%time_scale, m%pressure_maximum*scales%pressure)]
      end associate
   end procedure duty_row

   !> Relative error of the maximum pressure by time steps: that of the films, or the error of BDF2 in the squeeze of a thick film,
   !> whose pressure follows at once: by the second difference of p_max, which decays in later steps
   real(dp) function pressure_error(self, time, pressure) result(error)
      class(contact_run_t), intent(in) :: self
      real(dp), intent(in) :: time, pressure
      !> Times and maximum pressures of the last two rows
      real(dp) :: t(2), p(2)
      integer :: k, n

      error = maxval(self%transient%film_errors)
      n = self%history%n_rows()
      if (n < 2) return
      do k = 1, 2
         t(k) = self%history%entry_of("t_s", n - 2 + k)
         p(k) = self%history%entry_of("p_max_Pa", n - 2 + k)
      end do
      associate (slope => (pressure - p(2))/(time - t(2)), slope_before => (p(2) - p(1))/(t(2) - t(1)))
         error = max(error, left*self%history%entry_of("p_step_error", n), &
                     by_difference*(time - t(2))**2*abs(slope - slope_before)/(time - t(1))/pressure)
      end associate
   end function pressure_error

   !> Place of the minimum film [a]
   subroutine find_minimum(level, place)
      type(level_t), intent(in) :: level
      real(dp), intent(out) :: place(2)
      integer :: at(2)

      at = minloc(gap(level))
      place = [level%grid%x(at(1)), level%grid%y(at(2))]
   end subroutine find_minimum

   !> Coefficient of friction, its power, and the flash temperature of walls that have come to a steady state. Not known where the
   !> Newtonian stress exceeds that at which oils are Newtonian.
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
         ! the size of the dry contact now
         size = plan%scales%length*t%growth()
         source = heat_source(plan%contact)
         speeds = abs(t%now%speeds)*s%mean_velocity
         flash = flash_temperature(power/plan%contact%flash_area(size), source(1)*size, source(2), speeds, s%conductivity, &
                                   s%diffusivity)
      end associate
   end subroutine find_friction
end submodule ehl_contact_duty

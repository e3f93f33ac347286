! SPDX-License-Identifier: BSD-3-Clause
!> Absolute friction of a run, where it means something, and the heat of it
module ehl_report_friction
   use ehl_contact, only: contact_t
   use ehl_contact_run, only: contact_run_t
   use ehl_grid, only: grid_t
   use ehl_heat, only: flash_temperature
   use ehl_kinds, only: dp, not_known, pi
   use ehl_level, only: gap
   use ehl_plan, only: plan_t
   use ehl_record, only: record_t
   use ehl_text, only: fixed, to_text
   use ehl_touching, only: same_film
   use ehl_wall_heat, only: heat_source
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   implicit none (type, external)
   private
   public :: report_friction

contains

   !> Coefficients, shear rate and stress of the smooth contact, flash temperature; null where they are not known or
   !> mean nothing
   subroutine report_friction(record, run, good, converged, why_none)
      type(record_t), intent(inout) :: record
      type(contact_run_t), intent(in) :: run
      !> Whether the smooth contact is converged, and the run
      logical, intent(in) :: good, converged
      !> Why friction is not known where the bodies touch; empty where it is
      character(len=*), intent(in) :: why_none
      !> Friction integral of the smooth contact, the friction over it, and that of the rough contact with heat over it without
      real(dp) :: friction, ratio, heat_ratio
      real(dp) :: mu_smooth, mu, rate, stress, moment, rise, rises(3), speed, isothermal(2), source(2)
      logical :: rough, known
      character(len=:), allocatable :: note

      rough = run%is_rough()
      known = why_none == ""
      friction = merge(run%smooth%results(run%level())%m%friction, not_known, good .and. known)
      ratio = merge(not_known, 1.0_dp, run%plan%surfaces%rough())
      heat_ratio = not_known
      if (rough .and. converged .and. known) then
         ratio = run%mu_ratio()
         if (run%plan%heat%counts) heat_ratio = run%heat_ratio()
      end if
      mu_smooth = not_known
      rate = not_known
      stress = not_known
      moment = not_known
      rise = not_known
      associate (plan => run%plan, s => run%plan%sliding, shear => run%plan%lubricant%shear)
         speed = abs(s%slide_to_roll)*s%mean_velocity
         if (ieee_is_finite(friction)) then
            if (rough) then
               call read_off(run%grid, run%p_smooth, run%h_smooth)
            else
               associate (level => run%hierarchy%levels(run%level()))
                  call read_off(level%grid, level%p, gap(level))
               end associate
            end if
         end if
         if (.not. s%mean_velocity > 0.0_dp) then
            note = "a ratio alone: moes_m and moes_l give no sliding speed in m/s"
         else if (.not. speed > 0.0_dp) then
            note = "a ratio alone, that of vanishing sliding: there is no sliding, and rolling_moment_N_m resists the rolling"
         else if (.not. known) then
            note = why_none
         else if (.not. ieee_is_finite(friction)) then
            note = "the smooth contact is not converged"
         else if (shear%thins() .or. stress <= s%newtonian_limit) then
            mu_smooth = friction*shear%scale*plan%scales%length**2/s%load
            note = plan%heat%note
         else
            note = "a ratio alone: the Newtonian shear stress reaches "//fixed(stress, "es8.1e2")// &
                   " Pa, and oils shear thin above some "//to_text(s%newtonian_limit)// &
                   " Pa (lubricant.eyring_stress): give a lubricant.shear_law"
         end if
         mu = ratio*mu_smooth
         isothermal = [mu, mu_smooth]
         if (plan%heat%counts) then
            mu_smooth = mu_smooth*run%smooth_heat%ratio()
            mu = mu*merge(heat_ratio, run%smooth_heat%ratio(), plan%surfaces%rough())
            if (ieee_is_finite(isothermal(2)) .and. .not. ieee_is_finite(mu_smooth)) note = "the temperature is not converged"
         end if
         if (ieee_is_finite(mu)) then
            source = heat_source(plan%contact)
            rise = flash_temperature(mu*s%load*speed/(pi*plan%scales%length**2*plan%contact%ellipticity), &
                                     source(1)*plan%scales%length, source(2), s%speeds(), s%conductivity, s%diffusivity)
         end if
         call record%set("rolling_moment", moment)
         if (plan%scales%has_size()) call record%set("rolling_moment_N_m", moment*plan%scales%pressure*plan%scales%length**3)
         call record%set("shear_law", trim(s%law))
         call record%set("slide_to_roll", s%slide_to_roll)
         call record%set("mu", mu)
         call record%set("mu_smooth", mu_smooth)
         call record%set("mu_isothermal", isothermal(1))
         call record%set("mu_smooth_isothermal", isothermal(2))
         if (plan%heat%counts) then
            rises = not_known
            if (ieee_is_finite(mu)) rises = run%smooth_heat%greatest
            if (ieee_is_finite(mu) .and. plan%surfaces%rough()) rises = run%rough_heat%greatest
            if (ieee_is_finite(rises(1))) then
               if (rises(1) > max(0.0_dp, plan%heat%measured_rise)) then
                  note = note//"; the film is hotter than the temperatures at which the viscosity was measured"
               end if
            end if
            call record%set("temperature_rise_max_K", rises(1))
            call record%set("temperature_rise_wall_1_max_K", rises(2))
            call record%set("temperature_rise_wall_2_max_K", rises(3))
         end if
         call record%set("shear_rate_mean_per_s", rate)
         call record%set("shear_stress_max_Pa", stress)
         call record%set("flash_temperature_K", rise)
         call record%set("mu_note", note)
         if (s%loading > 0.0_dp) then
            call record%set("thermal_loading", s%loading)
            call record%set("thermal_reduction", s%reduction)
            call record%set("inlet_viscosity_Pa_s", s%inlet_viscosity)
         end if
      end associate

   contains

      !> Rolling moment, mean shear rate and greatest stress of the smooth contact with pressure p and film h
      subroutine read_off(grid, p, h)
         type(grid_t), intent(in) :: grid
         real(dp), intent(in) :: p(:, :), h(:, :)

         moment = rolling_moment(grid, p, h)
         if (.not. speed > 0.0_dp) return
         rate = speed/run%plan%scales%film*mean_inverse(run%plan%contact, grid, h)
         stress = greatest_stress(run%plan, p, h)
      end subroutine read_off
   end subroutine report_friction

   !> iint H/2 dP/dX, the moment of the pressure flow on each surface, which resists the rolling [p_h a^3]; a long inlet
   !> has a good part of it (Biboulet & Houpert 2010)
   pure real(dp) function rolling_moment(grid, p, h)
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: p(:, :), h(:, :)
      integer :: j, n

      rolling_moment = 0.0_dp
      n = grid%nx
      do j = 1, grid%ny
         rolling_moment = rolling_moment + 0.25_dp*grid%weight(j)/grid%hx*sum((h(:n - 1, j) + h(2:, j))*(p(2:, j) - p(:n - 1, j)))
      end do
   end function rolling_moment

   !> Mean of 1/H over the dry contact
   pure real(dp) function mean_inverse(contact, grid, h)
      class(contact_t), intent(in) :: contact
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: h(:, :)
      real(dp) :: area, x(grid%nx), pressure(grid%nx)
      integer :: i, j

      mean_inverse = 0.0_dp
      area = 0.0_dp
      x = grid%x([(i, i=1, grid%nx)])
      do j = 1, grid%ny
         call contact%pressure_row(x, grid%y(j), pressure)
         area = area + grid%weight(j)*count(pressure > 0.0_dp)
         mean_inverse = mean_inverse + grid%weight(j)*sum(1.0_dp/h(:, j), mask=pressure > 0.0_dp)
      end do
      mean_inverse = mean_inverse/area
   end function mean_inverse

   !> Greatest shear stress of the lubricant [Pa]; where the bodies touch it has none
   pure real(dp) function greatest_stress(plan, p, h)
      type(plan_t), intent(in) :: plan
      real(dp), intent(in) :: p(:, :), h(:, :)
      real(dp), dimension(size(p, 1)) :: log_eta, slope, stress, rho
      integer :: j

      greatest_stress = 0.0_dp
      do j = 1, size(p, 2)
         call plan%lubricant%log_viscosity(p(:, j), log_eta, slope)
         stress = exp(log_eta)/h(:, j)
         if (plan%lubricant%shear%thins()) call plan%lubricant%shear%reduce(p(:, j), stress)
         if (plan%lubricant%boundary_film > 0.0_dp) then
            call plan%lubricant%density(p(:, j), rho, slope)
            where (rho*h(:, j) <= (1.0_dp + same_film)*plan%lubricant%boundary_film) stress = 0.0_dp
         end if
         greatest_stress = max(greatest_stress, plan%lubricant%shear%scale*maxval(stress))
      end do
   end function greatest_stress
end module ehl_report_friction

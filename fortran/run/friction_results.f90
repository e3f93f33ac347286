! SPDX-License-Identifier: BSD-3-Clause
!> Absolute friction of a run, if it is defined, and its frictional heating
module ehl_friction_results
   use ehl_boundary_film, only: same_film
   use ehl_contact, only: contact_t
   use ehl_contact_run, only: contact_run_t
   use ehl_grid, only: grid_t
   use ehl_heat, only: flash_temperature
   use ehl_kinds, only: dp, not_known
   use ehl_level, only: gap
   use ehl_plan, only: plan_t
   use ehl_reason, only: friction_above_limit, friction_no_size, friction_no_smooth, friction_not_converged, friction_of_rough, &
                         friction_rolling, friction_rolling_line, friction_with_heat, reason_none
   use ehl_wall_heat, only: heat_source
   use ehl_wide_inlet, only: inlet_moment
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   implicit none (type, external)
   private
   public :: friction_results_t, find_friction

   !> Friction and temperatures; NaN if not known or not defined
   type :: friction_results_t
      !> Coefficients of friction of the contact and of the smooth contact; the same without frictional heating
      real(dp) :: mu(2) = not_known, mu_isothermal(2) = not_known
      !> Kind of the coefficients, or why they are unknown; whether the film is hotter than the measured range of its viscosity
      integer :: reason = reason_none
      logical :: beyond_measured = .false.
      !> Of the smooth contact: rolling moment [p_h a^3] (of a line per unit length [p_h a^2]), mean shear rate [1/s], maximum shear
      !> stress [Pa]
      real(dp) :: rolling_moment = not_known, shear_rate = not_known, shear_stress = not_known
      !> Flash temperature [K]; maximum temperature rises of film and walls by frictional heating [K]
      real(dp) :: flash = not_known, rises(3) = not_known
   end type friction_results_t

contains

   !> Friction and frictional heating of a run
   subroutine find_friction(run, solved, converged, why_none, found)
      type(contact_run_t), intent(in) :: run
      !> Whether the smooth contact and the run have converged
      logical, intent(in) :: solved, converged
      !> Why friction is not known with solid contact
      integer, intent(in) :: why_none
      type(friction_results_t), intent(out) :: found
      !> Friction integral of the smooth contact; ratio of the friction to it; ratio of thermal to isothermal friction
      real(dp) :: friction, ratio, heat_ratio
      real(dp) :: speed, source(2)
      logical :: known, rough

      known = why_none == reason_none
      rough = run%plan%surfaces%rough()
      friction = merge(run%smooth%results(run%level())%m%friction, not_known, solved .and. known)
      ratio = merge(not_known, 1.0_dp, rough)
      heat_ratio = not_known
      if (run%plan%heat%active .and. .not. rough) heat_ratio = run%smooth_heat%ratio()
      if (run%is_rough() .and. converged .and. known .and. .not. run%plan%duty%active) then
         ratio = run%mu_ratio()
         if (run%plan%heat%active) heat_ratio = run%heat_ratio()
      end if
      associate (plan => run%plan, s => run%plan%sliding, shear => run%plan%lubricant%shear)
         speed = abs(s%slide_to_roll)*s%mean_velocity
         if (ieee_is_finite(friction)) then
            if (run%is_rough()) then
               call smooth_shear(run, run%grid, run%p_smooth, run%h_smooth, speed, found)
            else
               associate (level => run%hierarchy%levels(run%level()))
                  call smooth_shear(run, level%grid, level%p, gap(level), speed, found)
               end associate
            end if
         end if
         if (.not. s%mean_velocity > 0.0_dp) then
            found%reason = friction_no_size
         else if (.not. speed > 0.0_dp) then
            found%reason = merge(friction_rolling_line, friction_rolling, plan%contact%is_line())
         else if (.not. known) then
            found%reason = why_none
         else if (.not. ieee_is_finite(friction)) then
            found%reason = friction_no_smooth
         else if (shear%thins() .or. found%shear_stress <= s%newtonian_limit) then
            found%mu_isothermal(2) = friction*shear%scale*plan%scales%length**plan%contact%dimensions/s%load
            found%reason = plan%heat%reason
         else
            found%reason = friction_above_limit
         end if
         found%mu_isothermal(1) = ratio*found%mu_isothermal(2)
         found%mu = found%mu_isothermal
         if (plan%heat%active) then
            found%mu = found%mu*[heat_ratio, run%smooth_heat%ratio()]
            if (ieee_is_finite(found%mu_isothermal(2)) .and. .not. ieee_is_finite(found%mu(2))) then
               found%reason = friction_not_converged
            end if
            ! mu_r/mu_s is isothermal, and both contacts have different temperatures: mu is not mu_r/mu_s times mu_smooth
            if (rough .and. found%reason == friction_with_heat .and. ieee_is_finite(found%mu(1))) then
               found%mu(2) = not_known
               found%reason = friction_of_rough
            end if
         end if
         if (.not. ieee_is_finite(found%mu(1))) return
         source = heat_source(plan%contact)
         found%flash = flash_temperature(found%mu(1)*s%load*speed/plan%contact%flash_area(plan%scales%length), &
                                         source(1)*plan%scales%length, source(2), s%speeds(), s%conductivity, s%diffusivity)
         if (.not. plan%heat%active) return
         found%rises = run%smooth_heat%max_rise
         if (rough) found%rises = run%rough_heat%max_rise
         if (.not. ieee_is_finite(found%rises(1))) return
         found%beyond_measured = found%rises(1) > max(0.0_dp, plan%heat%measured_rise)
      end associate
   end subroutine find_friction

   !> Rolling moment, mean shear rate and maximum shear stress of the smooth contact with pressure p and film h
   subroutine smooth_shear(run, grid, p, h, speed, found)
      type(contact_run_t), intent(in) :: run
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: p(:, :), h(:, :)
      !> Sliding speed [m/s]
      real(dp), intent(in) :: speed
      type(friction_results_t), intent(inout) :: found

      found%rolling_moment = rolling_moment(grid, p, h)
      if (run%plan%flooded .and. run%plan%contact%is_wide()) then
         found%rolling_moment = found%rolling_moment + moment_beyond(run%plan, grid, p, h)
      end if
      if (.not. speed > 0.0_dp) return
      found%shear_rate = speed/run%plan%scales%film*mean_inverse(run%plan%contact, grid, h)
      found%shear_stress = max_stress(run%plan, p, h)
   end subroutine smooth_shear

   !> iint H/2 dP/dX, the moment of the Poiseuille flow on each surface, which resists rolling [p_h a^3]; a long inlet contributes
   !> much (Biboulet & Houpert 2010). On a strip the mean over Y of int H/2 dP/dX [p_h a^2].
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

   !> The same integral beyond the inlet border of a flooded wide contact, in the rows within the width of the dry contact
   pure real(dp) function moment_beyond(plan, grid, p, h)
      class(plan_t), intent(in) :: plan
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: p(:, :), h(:, :)
      real(dp) :: width, alpha
      integer :: i, j

      alpha = plan%lubricant%initial_slope()
      moment_beyond = 0.0_dp
      i = 1 + nint(-grid%x0/grid%hx)
      do j = 1, grid%ny
         width = 1.0_dp - (grid%y(j)/plan%contact%reach(2))**2
         if (.not. (width > 0.0_dp .and. p(1, j) > 0.0_dp .and. grid%x0**2 > width)) cycle
         moment_beyond = moment_beyond + 0.5_dp*grid%weight(j)/grid%hx* &
                         inlet_moment(abs(grid%x0), h(1, j), h(i, j), width, p(1, j), alpha)
      end do
   end function moment_beyond

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

   !> Maximum shear stress of the lubricant outside the solid contact [Pa]
   pure real(dp) function max_stress(plan, p, h)
      type(plan_t), intent(in) :: plan
      real(dp), intent(in) :: p(:, :), h(:, :)
      real(dp), dimension(size(p, 1)) :: log_eta, slope, stress, rho
      integer :: j

      max_stress = 0.0_dp
      do j = 1, size(p, 2)
         call plan%lubricant%log_viscosity(p(:, j), log_eta, slope)
         stress = exp(log_eta)/h(:, j)
         if (plan%lubricant%shear%thins()) call plan%lubricant%shear%reduce(p(:, j), stress)
         call plan%lubricant%density(p(:, j), rho, slope)
         where (rho*h(:, j) <= (1.0_dp + same_film)*plan%lubricant%boundary_film) stress = 0.0_dp
         max_stress = max(max_stress, plan%lubricant%shear%scale*maxval(stress))
      end do
   end function max_stress
end module ehl_friction_results

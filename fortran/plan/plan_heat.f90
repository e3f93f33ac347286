! SPDX-License-Identifier: BSD-3-Clause
!> Whether frictional heating is significant for the friction of a case, and the data to compute it
module ehl_plan_heat
   use ehl_case, only: case_t
   use ehl_case_point, only: find_contact, operating_point
   use ehl_contact, only: contact_t
   use ehl_heat, only: flash_temperature
   use ehl_heated_friction, only: film_heat_t
   use ehl_kinds, only: dp
   use ehl_lubricant, only: lubricant_t
   use ehl_moes, only: operating_t
   use ehl_plan_friction, only: plan_sliding, sliding_t
   use ehl_plan_lubricant, only: plan_lubricant
   use ehl_reason, only: friction_never, friction_newtonian, friction_no_slope, friction_no_sliding, friction_small, &
                         friction_wall_at_rest, friction_with_heat, reason_none
   use ehl_scales, only: scales_t
   use ehl_status, only: status_t
   use ehl_wall_heat, only: heat_source, speed_of_rest, wall_strength
   implicit none (type, external)
   private
   public :: heat_plan_t, may_have_solid_contact, plan_contact, plan_heat, plan_known_film

   !> Relative change of the stress at the Hertz pressure below which frictional heating is neglected
   real(dp), parameter :: min_change = 1.0e-3_dp

   !> Boundary film over the central film by formula above which a smooth contact may have solid contact
   real(dp), parameter :: min_boundary_ratio = 0.5_dp

   !> Frictional heating of a contact
   type :: heat_plan_t
      !> Whether it is computed
      logical :: active = .false.
      type(film_heat_t) :: film
      !> Temperature rise up to which the viscosity was measured [K]; huge: not known
      real(dp) :: measured_rise = huge(1.0_dp)
      !> Why the coefficient of friction includes it or not (ehl_reason); estimated temperature rise [K]
      integer :: reason = reason_none
      real(dp) :: estimate = 0.0_dp
   end type heat_plan_t

contains

   !> Decide from the temperature rise at the Hertz pressure in the central film by formula, or in the boundary film if solid
   !> contact is possible: flash temperature (Tian & Kennedy) plus the mean rise across the film
   function plan_heat(input, contact, scales, sliding, lubricant, film) result(plan)
      type(case_t), intent(in) :: input
      class(contact_t), intent(in) :: contact
      type(scales_t), intent(in) :: scales
      type(sliding_t), intent(in) :: sliding
      type(lubricant_t), intent(in) :: lubricant
      !> Central film by formula [a^2/R]
      real(dp), intent(in) :: film
      type(heat_plan_t) :: plan
      real(dp) :: stress, max_stress, heated, rise, rest_speed, source(2)

      associate (l => input%lubricant, heat => plan%film)
         heat%speed = abs(sliding%slide_to_roll)*sliding%mean_velocity
         if (l%thermal_friction == "never") then
            plan%reason = friction_never
            return
         else if (.not. knows_temperature(input)) then
            plan%reason = friction_no_slope
            return
         else if (contact%is_line() .and. .not. minval(abs(sliding%speeds())) > 0.0_dp) then
            plan%reason = friction_wall_at_rest
            return
         else if (.not. heat%speed > 0.0_dp) then
            plan%reason = friction_no_sliding
            return
         end if
         heat%conductivity = l%thermal_conductivity
         heat%length = scales%length
         heat%film = scales%film
         if (l%range_temperature_max > l%range_temperature_min) plan%measured_rise = l%range_temperature_max - l%temperature
         rest_speed = speed_of_rest(contact)
         source = heat_source(contact)
         heat%strengths = [wall(1), wall(2)]
         stress = stress_at(0.0_dp)
         if (.not. lubricant%shear%thins() .and. stress > sliding%newtonian_limit) then
            plan%reason = friction_newtonian
            return
         end if
         max_stress = stress
         if (may_have_solid_contact(lubricant, film)) max_stress = max(stress, lubricant%boundary_stress*lubricant%shear%scale)
         rise = flash_temperature(max_stress*heat%speed, source(1)*scales%length, source(2), sliding%speeds(), &
                                  sliding%conductivity, sliding%diffusivity) &
                + max_stress*heat%speed*film*scales%film/(12.0_dp*heat%conductivity)
         heated = stress_at(rise)
         plan%active = l%thermal_friction == "always" .or. .not. stress - heated < min_change*stress
         plan%estimate = rise
         plan%reason = merge(friction_with_heat, friction_small, plan%active)
      end associate

   contains

      !> `wall_strength` of body k
      pure real(dp) function wall(k)
         integer, intent(in) :: k
         real(dp) :: speeds(2)

         speeds = sliding%speeds()
         wall = wall_strength(speeds(k), sliding%conductivity(k), sliding%diffusivity(k), rest_speed, scales%length, source(2))
      end function wall

      !> Shear stress [Pa] under the Hertz pressure at a temperature rise [K]
      real(dp) function stress_at(rise)
         real(dp), intent(in) :: rise
         real(dp) :: values(1)

         call lubricant%log_viscosity_at([1.0_dp], [rise], values)
         values = exp(values)/film
         if (lubricant%shear%thins()) call lubricant%shear%reduce([1.0_dp], values)
         stress_at = lubricant%shear%scale*values(1)
      end function stress_at
   end function plan_heat

   !> Whether the smooth contact may have solid contact, from its central film by formula [a^2/R]
   pure logical function may_have_solid_contact(lubricant, film)
      type(lubricant_t), intent(in) :: lubricant
      real(dp), intent(in) :: film
      may_have_solid_contact = lubricant%boundary_film > min_boundary_ratio*film
   end function may_have_solid_contact

   !> Heating and lubricant of a case whose pressure and film are known
   subroutine plan_known_film(input, plan, lubricant, status)
      type(case_t), intent(in) :: input
      type(heat_plan_t), intent(out) :: plan
      type(lubricant_t), intent(out) :: lubricant
      type(status_t), intent(inout) :: status
      class(contact_t), allocatable :: contact
      type(scales_t) :: scales
      type(operating_t) :: point
      type(sliding_t) :: sliding
      real(dp) :: rho, film

      call plan_contact(input, contact, scales, point, sliding, lubricant, rho, film, status)
      if (.not. status%failed()) plan = plan_heat(input, contact, scales, sliding, lubricant, film)
   end subroutine plan_known_film

   !> Contact, operating point, motion and lubricant of a case
   subroutine plan_contact(input, contact, scales, point, sliding, lubricant, rho, film, status)
      type(case_t), intent(in) :: input
      class(contact_t), allocatable, intent(out) :: contact
      type(scales_t), intent(out) :: scales
      type(operating_t), intent(out) :: point
      type(sliding_t), intent(out) :: sliding
      type(lubricant_t), intent(out) :: lubricant
      !> Density at the Hertz pressure; central film by formula [a^2/R]
      real(dp), intent(out) :: rho, film
      type(status_t), intent(inout) :: status
      real(dp) :: density(1), slope(1)

      rho = 0.0_dp
      film = 0.0_dp
      call find_contact(input, contact, scales, point)
      sliding = plan_sliding(input, contact, scales)
      if (input%contact%si) point = operating_point(input, contact, scales, sliding%inlet_viscosity)
      call plan_lubricant(input, point, scales, lubricant, status)
      if (status%failed()) return
      call lubricant%density([1.0_dp], density, slope)
      rho = density(1)
      film = contact%film_formula(point%moes_m, point%moes_l)/rho
   end subroutine plan_contact

   !> Whether the case gives the temperature dependence of the viscosity
   pure logical function knows_temperature(input)
      type(case_t), intent(in) :: input
      knows_temperature = input%contact%si .and. input%lubricant%temperature_viscosity > 0.0_dp
   end function knows_temperature
end module ehl_plan_heat

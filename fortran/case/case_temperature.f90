! SPDX-License-Identifier: BSD-3-Clause
!> Temperature of the lubricant: its viscosity from a data sheet, and shear heating of the inlet
module ehl_case_temperature
   use ehl_case, only: case_t
   use ehl_case_contact, only: hertz_pressure
   use ehl_case_law, only: knows_temperature, own_law
   use ehl_heat, only: dynamic_viscosity, temperature_viscosity, thermal_loading, thermal_reduction
   use ehl_kinds, only: dp
   use ehl_schema, only: schema_t
   use ehl_status, only: status_t
   use ehl_text, only: short, to_text
   implicit none (type, external)
   private
   public :: complete_viscosity, complete_alpha, check_heat

   !> Keys that mean nothing without the kinematic viscosities
   character(len=17), parameter :: sheet_keys(3) = &
      [character(len=17) :: "temperature", "density_15", "thermal_expansion"]
   !> Exponent z of Roelands 1966 of a mineral oil
   real(dp), parameter :: mineral_z = 0.6_dp
   !> Relative difference of viscosities that is none
   real(dp), parameter :: rounding = 1.0e-6_dp

contains

   !> Viscosity, and how it falls with temperature, from the kinematic viscosities of a data sheet
   subroutine complete_viscosity(schema, input, status)
      type(schema_t), intent(in) :: schema
      type(case_t), intent(inout) :: input
      type(status_t), intent(inout) :: status
      real(dp) :: sheet(2), follows
      character(len=:), allocatable :: at
      integer :: k

      sheet = [input%lubricant%kinematic_viscosity_40, input%lubricant%kinematic_viscosity_100]
      if (all(sheet <= 0.0_dp)) then
         do k = 1, size(sheet_keys)
            if (.not. schema%given("lubricant", trim(sheet_keys(k)))) cycle
            ! temperature and expansion serve the laws of viscosity and density under temperature as well
            if (knows_temperature(input%lubricant)) cycle
            if (sheet_keys(k) /= "density_15" .and. input%lubricant%temperature_viscosity > 0.0_dp) cycle
            at = "lubricant." // trim(sheet_keys(k))
            call schema%refuse(at, at // " without the viscosities of the data sheet", "kinematic_viscosity_40 and " &
                               // "kinematic_viscosity_100 beside it, temperature_viscosity, or viscosity at the inlet " &
                               // "temperature alone", status)
            return
         end do
         return
      else if (any(sheet <= 0.0_dp) .or. sheet(2) >= sheet(1)) then
         at = "lubricant.kinematic_viscosity_100"
         if (.not. schema%given("lubricant", "kinematic_viscosity_100")) at = "lubricant.kinematic_viscosity_40"
         call schema%refuse(at, "lubricant.kinematic_viscosity_40 = " // to_text(sheet(1)) // " and kinematic_viscosity_100 = " &
                            // to_text(sheet(2)), "both, that at 100 degC the smaller one", status)
         return
      end if
      associate (l => input%lubricant)
         follows = dynamic_viscosity(l%temperature, sheet, l%density_15, l%thermal_expansion)
         if (.not. schema%given("lubricant", "temperature_viscosity")) then
            l%temperature_viscosity = temperature_viscosity(l%temperature, sheet, l%density_15, l%thermal_expansion)
         end if
         if (.not. schema%given("lubricant", "viscosity")) then
            l%viscosity = follows
            call schema%check_range("lubricant.viscosity", follows, "lubricant.temperature", &
                                    "the data sheet at " // to_text(l%temperature) // " degC", status)
         else if (abs(l%viscosity - follows) > rounding*follows) then
            at = "lubricant.kinematic_viscosity_40"
            if (.not. schema%given("lubricant", "kinematic_viscosity_40")) at = "lubricant.name"
            call schema%contradict("lubricant.viscosity", at, "viscosity, or what tells it", status, "lubricant.viscosity = " &
                                   // to_text(l%viscosity) // ", and the data sheet gives " // short(follows) // " Pa s at " &
                                   // to_text(l%temperature) // " degC")
         end if
      end associate
   end subroutine complete_viscosity

   !> Pressure-viscosity coefficient beside the viscosities of a data sheet, which has none: of Roelands' law with a z that
   !> does not change with temperature, the given one or that of a mineral oil
   subroutine complete_alpha(schema, input, status)
      type(schema_t), intent(in) :: schema
      type(case_t), intent(inout) :: input
      type(status_t), intent(inout) :: status

      associate (l => input%lubricant)
         if (own_law(l) /= "" .or. schema%given("lubricant", "pressure_viscosity")) return
         if (.not. l%kinematic_viscosity_40 > 0.0_dp) then
            if (input%contact%si .and. schema%given("lubricant", "viscosity")) l%alpha_origin = "default"
            return
         end if
         if (.not. schema%given("lubricant", "roelands_z")) l%alpha_origin = "estimated"
         l%pressure_viscosity = merge(mineral_z, l%roelands_z, l%alpha_origin == "estimated")* &
                                (log(l%viscosity) + 9.67_dp)/l%roelands_p0
         call schema%check_range("lubricant.pressure_viscosity", l%pressure_viscosity, "lubricant.kinematic_viscosity_40", &
                                 "the data sheet at "//to_text(l%temperature)//" degC", status)
      end associate
   end subroutine complete_alpha

   !> What the heat of sliding in the friction and shear heating of the inlet need, and where the formula of the latter ends
   subroutine check_heat(schema, input, status)
      type(schema_t), intent(in) :: schema
      type(case_t), intent(in) :: input
      type(status_t), intent(inout) :: status
      real(dp) :: loading, reduction

      associate (l => input%lubricant, c => input%contact)
         if (l%thermal_friction == "always") then
            call need("lubricant.thermal_friction", " = 'always'", "sliding speed", "'auto'", "'auto'")
         end if
         if (.not. l%thermal_reduction) return
         call need("lubricant.thermal_reduction", "", "velocity", ".false.", "name")
         if (status%failed()) return
         loading = thermal_loading(l%temperature_viscosity, l%viscosity, c%mean_velocity, l%thermal_conductivity)
         reduction = thermal_reduction(loading, hertz_pressure(input)/c%reduced_modulus, c%slide_to_roll)
         if (reduction > 0.0_dp) return
         call schema%refuse("lubricant.thermal_reduction", "lubricant.thermal_reduction: the formula gives a film of " &
                            // short(reduction) // " times the isothermal one at a thermal loading of " // short(loading), &
                            "a slower contact, or .false.", status)
      end associate

   contains

      !> A velocity in m/s, and how the viscosity falls with temperature, or what is named
      subroutine need(key, value, velocity, or, or_else)
         character(len=*), intent(in) :: key, value, velocity, or, or_else

         if (.not. input%contact%si) then
            call schema%refuse(key, key // value // " with a contact given by moes_m and moes_l, which has no " // velocity &
                               // " in m/s", "load, mean_velocity, radius and reduced_modulus, or " // or, status)
         else if (.not. input%lubricant%temperature_viscosity > 0.0_dp) then
            call schema%refuse(key, key // value // ", and nothing tells how the viscosity falls with temperature", &
                               "temperature_viscosity, or kinematic_viscosity_40 and kinematic_viscosity_100, or " // or_else, &
                               status)
         end if
      end subroutine need
   end subroutine check_heat
end module ehl_case_temperature

! SPDX-License-Identifier: BSD-3-Clause
!> Temperature of the lubricant: its viscosity from a data sheet, and shear heating of the inlet
module ehl_case_temperature
   use ehl_case, only: case_t
   use ehl_case_contact, only: find_contact
   use ehl_case_law, only: knows_temperature, own_law
   use ehl_contact, only: contact_t
   use ehl_heat, only: dynamic_viscosity, temperature_viscosity, thermal_loading, thermal_reduction
   use ehl_kinds, only: dp
   use ehl_moes, only: operating_t
   use ehl_refusal, only: contradict, refuse, short
   use ehl_scales, only: scales_t
   use ehl_schema, only: schema_t
   use ehl_source, only: source_t
   use ehl_status, only: status_t
   use ehl_text, only: to_text
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
   subroutine complete_viscosity(schema, input, sources, status)
      type(schema_t), intent(in) :: schema
      type(case_t), intent(inout) :: input
      type(source_t), intent(in) :: sources(:)
      type(status_t), intent(inout) :: status
      real(dp) :: sheet(2), follows
      character(len=23) :: at, by
      integer :: k

      sheet = [input%lubricant%kinematic_viscosity_40, input%lubricant%kinematic_viscosity_100]
      if (all(sheet <= 0.0_dp)) then
         do k = 1, size(sheet_keys)
            if (.not. schema%given("lubricant", trim(sheet_keys(k)))) cycle
            ! temperature and expansion serve the laws of viscosity and density under temperature as well
            if (knows_temperature(input%lubricant)) cycle
            if (sheet_keys(k) /= "density_15" .and. input%lubricant%temperature_viscosity > 0.0_dp) cycle
            call refuse(schema, sources, "lubricant", trim(sheet_keys(k)), "lubricant." // trim(sheet_keys(k)) &
                        // " without the viscosities of the data sheet", "kinematic_viscosity_40 and " &
                        // "kinematic_viscosity_100 beside it, temperature_viscosity, or viscosity at the inlet temperature " &
                        // "alone", status)
            return
         end do
         return
      else if (any(sheet <= 0.0_dp) .or. sheet(2) >= sheet(1)) then
         at = "kinematic_viscosity_100"
         if (.not. schema%given("lubricant", trim(at))) at = "kinematic_viscosity_40"
         call refuse(schema, sources, "lubricant", trim(at), "lubricant.kinematic_viscosity_40 = " &
                     // to_text(sheet(1)) // " and kinematic_viscosity_100 = " // to_text(sheet(2)), &
                     "both, that at 100 degC the smaller one", status)
         return
      end if
      associate (l => input%lubricant)
         follows = dynamic_viscosity(l%temperature, sheet, l%density_15, l%thermal_expansion)
         if (.not. schema%given("lubricant", "temperature_viscosity")) then
            l%temperature_viscosity = temperature_viscosity(l%temperature, sheet, l%density_15, l%thermal_expansion)
         end if
         if (.not. schema%given("lubricant", "viscosity")) then
            l%viscosity = follows
            associate (key => schema%keys(schema%find("lubricant", "viscosity")))
               if (.not. key%allows(follows)) then
                  call refuse(schema, sources, "lubricant", "temperature", "lubricant.viscosity = " // short(follows) &
                              // " follows from the data sheet at " // to_text(l%temperature) // " degC", &
                              key%type_text(), status)
               end if
            end associate
         else if (abs(l%viscosity - follows) > rounding*follows) then
            by = "kinematic_viscosity_40"
            if (.not. schema%given("lubricant", trim(by))) by = "name"
            call contradict(schema, sources, "lubricant.viscosity", "lubricant."//trim(by), &
               "viscosity, or what tells it", status, "lubricant.viscosity = " // to_text(l%viscosity) &
               // ", and the data sheet gives " // short(follows) // " Pa s at " // to_text(l%temperature) // " degC")
         end if
      end associate
   end subroutine complete_viscosity

   !> Pressure-viscosity coefficient beside the viscosities of a data sheet, which has none: of Roelands' law with a z that
   !> does not change with temperature, the given one or that of a mineral oil
   subroutine complete_alpha(schema, input, sources, status)
      type(schema_t), intent(in) :: schema
      type(case_t), intent(inout) :: input
      type(source_t), intent(in) :: sources(:)
      type(status_t), intent(inout) :: status

      associate (l => input%lubricant)
         if (own_law(l) /= "" .or. schema%given("lubricant", "pressure_viscosity")) return
         if (.not. l%kinematic_viscosity_40 > 0.0_dp) then
            l%alpha_default = input%contact%si .and. schema%given("lubricant", "viscosity")
            return
         end if
         l%alpha_estimated = .not. schema%given("lubricant", "roelands_z")
         l%pressure_viscosity = merge(mineral_z, l%roelands_z, l%alpha_estimated)*(log(l%viscosity) + 9.67_dp)/l%roelands_p0
         associate (key => schema%keys(schema%find("lubricant", "pressure_viscosity")))
            if (.not. key%allows(l%pressure_viscosity)) call refuse(schema, sources, "lubricant", "kinematic_viscosity_40", &
               "lubricant.pressure_viscosity = "//short(l%pressure_viscosity)//" follows from the data sheet at "// &
               to_text(l%temperature)//" degC", key%type_text(), status)
         end associate
      end associate
   end subroutine complete_alpha

   !> What shear heating of the inlet needs, and where its formula ends
   subroutine check_heat(schema, input, sources, status)
      type(schema_t), intent(in) :: schema
      type(case_t), intent(in) :: input
      type(source_t), intent(in) :: sources(:)
      type(status_t), intent(inout) :: status
      class(contact_t), allocatable :: contact
      type(scales_t) :: scales
      type(operating_t) :: point
      real(dp) :: loading, reduction

      associate (l => input%lubricant, c => input%contact)
         if (l%thermal_friction == "always") call check_friction(schema, input, sources, status)
         if (status%failed() .or. .not. l%thermal_reduction) return
         if (.not. c%si) then
            call refuse(schema, sources, "lubricant", "thermal_reduction", "lubricant.thermal_reduction with a contact " &
                        // "given by moes_m and moes_l, which has no velocity in m/s", &
                        "load, mean_velocity, radius and reduced_modulus, or .false.", status)
            return
         else if (.not. l%temperature_viscosity > 0.0_dp) then
            call refuse(schema, sources, "lubricant", "thermal_reduction", "lubricant.thermal_reduction, and nothing " &
                        // "tells how the viscosity falls with temperature", &
                        "temperature_viscosity, or kinematic_viscosity_40 and kinematic_viscosity_100, or name", status)
            return
         end if
         call find_contact(input, contact, scales, point)
         loading = thermal_loading(l%temperature_viscosity, l%viscosity, c%mean_velocity, l%thermal_conductivity)
         reduction = thermal_reduction(loading, scales%pressure/c%reduced_modulus, c%slide_to_roll)
         if (reduction > 0.0_dp) return
         call refuse(schema, sources, "lubricant", "thermal_reduction", "lubricant.thermal_reduction: the formula gives " &
                     // "a film of " // short(reduction) // " times the isothermal one at a thermal loading of " &
                     // short(loading), "a slower contact, or .false.", status)
      end associate
   end subroutine check_heat

   !> What the temperature of the film needs that friction is always to be computed with
   subroutine check_friction(schema, input, sources, status)
      type(schema_t), intent(in) :: schema
      type(case_t), intent(in) :: input
      type(source_t), intent(in) :: sources(:)
      type(status_t), intent(inout) :: status

      if (.not. input%contact%si) then
         call refuse(schema, sources, "lubricant", "thermal_friction", "lubricant.thermal_friction = 'always' with a contact " &
                     // "given by moes_m and moes_l, which has no sliding speed in m/s", &
                     "load, mean_velocity, radius and reduced_modulus, or 'auto'", status)
      else if (.not. input%lubricant%temperature_viscosity > 0.0_dp) then
         call refuse(schema, sources, "lubricant", "thermal_friction", "lubricant.thermal_friction = 'always', and nothing " &
                     // "tells how the viscosity falls with temperature", &
                     "temperature_viscosity, or kinematic_viscosity_40 and kinematic_viscosity_100, or 'auto'", status)
      end if
   end subroutine check_friction
end module ehl_case_temperature

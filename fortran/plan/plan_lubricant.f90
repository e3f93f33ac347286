! SPDX-License-Identifier: BSD-3-Clause
!> The lubricant of a case in Hertz units
module ehl_plan_lubricant
   use ehl_case, only: case_t
   use ehl_heat, only: freezing
   use ehl_kinds, only: dp
   use ehl_lubricant, only: density_constant, density_dowson_higginson, lubricant_t, new_lubricant, &
                            viscosity_barus, viscosity_roelands
   use ehl_moes, only: operating_t
   use ehl_scales, only: scales_t
   use ehl_shear, only: shear_carreau, shear_eyring, shear_law_t, shear_limiting
   implicit none (type, external)
   private
   public :: plan_lubricant

contains

   !> Viscosity, density and shear law of a case at its operating point
   function plan_lubricant(input, point, scales) result(lubricant)
      type(case_t), intent(in) :: input
      type(operating_t), intent(in) :: point
      type(scales_t), intent(in) :: scales
      type(lubricant_t) :: lubricant

      lubricant = new_lubricant( &
                  merge(viscosity_barus, viscosity_roelands, input%lubricant%viscosity_law == "barus"), &
                  merge(density_constant, density_dowson_higginson, input%lubricant%density_law == "incompressible"), &
                  point%alpha_bar, scales%pressure, input%lubricant%roelands_z, input%lubricant%roelands_p0, &
                  input%lubricant%temperature_viscosity, input%lubricant%thermal_expansion, &
                  input%lubricant%temperature + freezing)
      lubricant%shear = shear_of(input, scales)
   end function plan_lubricant

   !> Shear law; a contact given by its Moes numbers has no sliding speed and stays Newtonian
   pure function shear_of(input, scales) result(shear)
      type(case_t), intent(in) :: input
      type(scales_t), intent(in) :: scales
      type(shear_law_t) :: shear

      if (.not. input%contact%si) return
      associate (l => input%lubricant, c => input%contact)
         shear%hertz_pressure = scales%pressure
         shear%in_flow = l%flow == "consistent"
         shear%gradient_scale = scales%pressure*scales%film/scales%length
         shear%scale = l%viscosity*abs(c%slide_to_roll)*c%mean_velocity/scales%film
         select case (l%shear_law)
         case ("eyring")
            shear%law = shear_eyring
            shear%stress = l%eyring_stress
         case ("limiting")
            shear%law = shear_limiting
            shear%stress = l%limiting_stress
            shear%coefficient = l%limiting_coefficient
         case ("carreau")
            shear%law = shear_carreau
            shear%stress = l%carreau_stress
            shear%exponent = l%carreau_exponent
         case default
            continue
         end select
      end associate
   end function shear_of
end module ehl_plan_lubricant

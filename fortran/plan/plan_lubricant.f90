! SPDX-License-Identifier: BSD-3-Clause
!> The lubricant of a case in Hertz units
module ehl_plan_lubricant
   use ehl_case, only: case_t
   use ehl_kinds, only: dp
   use ehl_case_law, only: make_lubricant
   use ehl_lubricant, only: lubricant_t
   use ehl_moes, only: operating_t
   use ehl_scales, only: scales_t
   use ehl_shear, only: shear_carreau, shear_eyring, shear_law_t, shear_limiting
   use ehl_status, only: status_t
   implicit none (type, external)
   private
   public :: plan_lubricant

contains

   !> Viscosity, density and shear law of a case at its operating point
   subroutine plan_lubricant(input, point, scales, lubricant, status)
      type(case_t), intent(in) :: input
      type(operating_t), intent(in) :: point
      type(scales_t), intent(in) :: scales
      type(lubricant_t), intent(out) :: lubricant
      type(status_t), intent(inout) :: status

      call make_lubricant(input%lubricant, point%alpha_bar, scales%pressure, lubricant, status)
      lubricant%shear = shear_of(input, scales)
      if (.not. input%contact%si) return
      lubricant%boundary_film = input%lubricant%boundary_film/scales%film
      lubricant%boundary_limit = input%contact%hardness/scales%pressure
      if (lubricant%shear%scale > 0.0_dp) then
         lubricant%boundary_stress = input%lubricant%boundary_friction*scales%pressure/lubricant%shear%scale
      end if
   end subroutine plan_lubricant

   !> Shear law; a contact given by its Moes numbers has no sliding speed and is Newtonian
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

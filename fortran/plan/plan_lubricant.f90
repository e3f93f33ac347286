! SPDX-License-Identifier: BSD-3-Clause
!> The lubricant of a case in Hertz units
module ehl_plan_lubricant
   use ehl_case, only: case_t
   use ehl_kinds, only: dp
   use ehl_case_law, only: make_lubricant, own_law
   use ehl_lubricant, only: lubricant_t
   use ehl_moes, only: operating_t
   use ehl_scales, only: scales_t
   use ehl_shear, only: shear_carreau, shear_eyring, shear_law_t, shear_limiting
   use ehl_status, only: status_t
   use ehl_text, only: fixed, to_text
   implicit none (type, external)
   private
   public :: plan_lubricant, law_note, alpha_note

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

   !> A law with constants of an oil in words, and whether they were measured at the temperature of the inlet and the Hertz
   !> pressure; not allocated for other laws
   subroutine law_note(input, scales, note)
      type(case_t), intent(in) :: input
      type(scales_t), intent(in) :: scales
      character(len=:), allocatable, intent(out) :: note
      character(len=:), allocatable :: from
      logical :: temperatures

      associate (l => input%lubricant)
         if (own_law(l) == "") return
         from = trim(l%viscosity_law)//" viscosity"
         if (l%name /= "") from = trim(l%name)//", "//from
         note = from//" at "//to_text(l%temperature)//" degC: "//trim(fixed(l%viscosity, "es9.3"))//" Pa s, alpha = "// &
                trim(fixed(l%pressure_viscosity, "es9.3"))//" 1/Pa; "
         temperatures = abs(l%range_temperature_min) + abs(l%range_temperature_max) > 0.0_dp
         if (.not. temperatures .and. .not. l%range_pressure_max > 0.0_dp) then
            note = note//"the range of the measurements behind it is not known"
            return
         end if
         note = note//"measured"
         if (temperatures) then
            note = note//" from "//to_text(l%range_temperature_min)//" to "//to_text(l%range_temperature_max)//" degC"
            if (l%range_pressure_max > 0.0_dp) note = note//" and"
         end if
         if (l%range_pressure_max > 0.0_dp) note = note//" up to "//fixed(l%range_pressure_max, "es9.3")//" Pa"
         if (temperatures .and. (l%temperature < l%range_temperature_min .or. l%temperature > l%range_temperature_max)) then
            note = note//", BEYOND in temperature"
         end if
         if (l%viscosity_law == own_law(l) .and. l%range_pressure_max > 0.0_dp .and. scales%pressure > l%range_pressure_max) then
            note = note//", BEYOND in pressure: p_h = "//fixed(scales%pressure, "es9.3")//" Pa"
         end if
      end associate
   end subroutine law_note

   !> Where a pressure-viscosity coefficient is from that was not given; empty where it was
   subroutine alpha_note(input, note)
      type(case_t), intent(in) :: input
      character(len=:), allocatable, intent(out) :: note
      !> Least and largest z of the oils that are known by name, at 40 and 100 degC, see tests/model/test_lubricants.py
      character(len=*), parameter :: known = "0.42 to 0.74"

      note = ""
      associate (l => input%lubricant)
         if (l%alpha_origin == "estimated") note = "alpha = "//fixed(l%pressure_viscosity, "es9.3")//" 1/Pa at "// &
            to_text(l%temperature)//" degC is an estimate by the z of a mineral oil (Roelands): for z = "//known// &
            " the film is 17 % thinner to 12 % thicker; give lubricant.pressure_viscosity"
         if (l%alpha_origin == "default") note = "alpha = "//fixed(l%pressure_viscosity, "es9.3")// &
            " 1/Pa is the default, that of another oil; give lubricant.pressure_viscosity"
      end associate
   end subroutine alpha_note

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

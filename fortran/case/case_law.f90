! SPDX-License-Identifier: BSD-3-Clause
!> Laws of viscosity and density of a case with constants of the oil or a table of measured values
module ehl_case_law
   use ehl_ambient_viscosity, only: ambient_viscosity_t, new_ambient_viscosity
   use ehl_case, only: lubricant_case_t
   use ehl_dicke, only: new_dicke
   use ehl_doolittle, only: new_doolittle
   use ehl_heat, only: density_temperature, zero_celsius
   use ehl_kinds, only: dp
   use ehl_lubricant, only: density_constant, density_dowson_higginson, lubricant_t, new_lubricant, viscosity_barus, &
                            viscosity_roelands
   use ehl_murnaghan, only: new_murnaghan
   use ehl_status, only: ehl_bad_input, status_t
   use ehl_tait, only: new_tait, tait_t
   use ehl_text, only: newline, to_text
   use ehl_viscosity_law, only: viscosity_law_t
   use ehl_viscosity_table, only: isotherm_t, new_viscosity_table, viscosity_table_t
   use ehl_yasutomi, only: new_yasutomi
   implicit none (type, external)
   private
   public :: knows_temperature, make_lubricant, make_viscosity, own_law, uses_law

contains

   !> Law that gives viscosity and pressure-viscosity coefficient at the inlet; '' if these are given
   pure function own_law(l) result(law)
      type(lubricant_case_t), intent(in) :: l
      character(len=len(l%viscosity_law)) :: law

      law = l%inlet_law
      if (law == "" .and. l%viscosity_law /= "roelands" .and. l%viscosity_law /= "barus") law = l%viscosity_law
   end function own_law

   !> Whether a law gives the viscosity at the inlet or its pressure dependence
   pure logical function uses_law(l, name)
      type(lubricant_case_t), intent(in) :: l
      character(len=*), intent(in) :: name
      uses_law = own_law(l) == name .or. l%viscosity_law == name
   end function uses_law

   !> Whether a law of viscosity or density includes the temperature
   pure logical function knows_temperature(l)
      type(lubricant_case_t), intent(in) :: l
      knows_temperature = own_law(l) /= "" .or. l%density_law == "murnaghan" .or. l%density_law == "tait"
   end function knows_temperature

   !> Viscosity and density of a case in Hertz units, with a Newtonian shear law
   subroutine make_lubricant(l, alpha_bar, hertz_pressure, lubricant, status)
      type(lubricant_case_t), intent(in) :: l
      !> alpha p_h; p_h [Pa], 0: constant viscosity and density
      real(dp), intent(in) :: alpha_bar, hertz_pressure
      type(lubricant_t), intent(out) :: lubricant
      type(status_t), intent(inout) :: status
      class(viscosity_law_t), allocatable :: law
      real(dp) :: expansion

      ! relative to the density at the inlet
      expansion = l%thermal_expansion/(1.0_dp - l%thermal_expansion*(l%temperature - density_temperature))
      lubricant = new_lubricant(merge(viscosity_barus, viscosity_roelands, l%viscosity_law == "barus"), &
                                merge(density_constant, density_dowson_higginson, l%density_law == "incompressible"), &
                                alpha_bar, hertz_pressure, l%roelands_z, l%roelands_p0, l%temperature_viscosity, expansion, &
                                l%temperature + zero_celsius)
      if (.not. hertz_pressure > 0.0_dp) return
      if (l%viscosity_law /= "barus" .and. l%viscosity_law /= "roelands") then
         call make_viscosity(l, trim(l%viscosity_law), hertz_pressure, law, status)
         call move_alloc(law, lubricant%viscosity)
      end if
      select case (l%density_law)
      case ("murnaghan")
         deallocate (lubricant%compression)
         allocate (lubricant%compression, source=new_murnaghan(l%murnaghan_modulus, l%murnaghan_rate, l%murnaghan_softening, &
                                                               expansion, hertz_pressure, l%temperature + zero_celsius))
      case ("tait")
         deallocate (lubricant%compression)
         allocate (lubricant%compression, source=tait_of(l, hertz_pressure))
      case default
         continue
      end select
   end subroutine make_lubricant

   !> Make a viscosity law with constants of the oil, by name
   subroutine make_viscosity(l, name, hertz_pressure, law, status)
      type(lubricant_case_t), intent(in) :: l
      character(len=*), intent(in) :: name
      !> Hertz pressure [Pa]
      real(dp), intent(in) :: hertz_pressure
      class(viscosity_law_t), allocatable, intent(out) :: law
      type(status_t), intent(inout) :: status
      type(viscosity_table_t) :: table

      select case (name)
      case ("dicke")
         allocate (law, source=new_dicke(ambient_of(l), [l%dicke_a1, l%dicke_a2], [l%dicke_b1, l%dicke_b2], hertz_pressure, &
                                         l%temperature))
      case ("yasutomi")
         allocate (law, source=new_yasutomi(l%yasutomi_tg0, l%yasutomi_a1, l%yasutomi_a2, l%yasutomi_b1, l%yasutomi_b2, &
                                            l%yasutomi_c1, l%yasutomi_c2, l%yasutomi_viscosity, hertz_pressure, &
                                            l%temperature))
      case ("doolittle")
         allocate (law, source=new_doolittle(l%doolittle_viscosity, l%doolittle_b, l%doolittle_r0, l%doolittle_expansion, &
                                             l%doolittle_temperature + zero_celsius, tait_of(l, hertz_pressure), &
                                             l%temperature + zero_celsius))
      case default
         if (.not. allocated(l%isotherms)) then
            call status%fail(ehl_bad_input, "the law 'table' without table_temperature, table_pressure and table_viscosity")
            return
         end if
         if (size(l%isotherms) == 1) call check_single(l, l%isotherms(1), status)
         table = new_viscosity_table(l%isotherms, hertz_pressure, l%temperature + zero_celsius, l%temperature_viscosity)
         allocate (law, source=table)
      end select
   end subroutine make_viscosity

   !> Tait equation of state
   pure function tait_of(l, hertz_pressure) result(state)
      type(lubricant_case_t), intent(in) :: l
      !> Hertz pressure [Pa]
      real(dp), intent(in) :: hertz_pressure
      type(tait_t) :: state

      state = new_tait(l%tait_modulus, l%tait_rate, l%tait_softening, l%tait_expansion, l%tait_temperature + zero_celsius, &
                       hertz_pressure, l%temperature + zero_celsius)
   end function tait_of

   !> Viscosity at ambient pressure
   pure function ambient_of(l) result(ambient)
      type(lubricant_case_t), intent(in) :: l
      type(ambient_viscosity_t) :: ambient

      ambient = new_ambient_viscosity([l%vogel_viscosity, l%vogel_b, l%vogel_c], &
                                      [l%kinematic_viscosity_40, l%kinematic_viscosity_100], l%density_15, l%thermal_expansion)
   end function ambient_of

   !> Refuse a table with a single temperature at another temperature
   subroutine check_single(l, isotherm, status)
      type(lubricant_case_t), intent(in) :: l
      type(isotherm_t), intent(in) :: isotherm
      type(status_t), intent(inout) :: status
      character(len=:), allocatable :: place

      if (abs(isotherm%temperature - l%temperature - zero_celsius) <= 0.01_dp) return
      place = trim(l%table)
      if (place == "") place = "lubricant.table_temperature"
      call status%fail(ehl_bad_input, place//": error: the table has the single temperature "// &
                       to_text(isotherm%temperature - zero_celsius)//" degC, and lubricant.temperature = "// &
                       to_text(l%temperature)//newline//"expected: that temperature, or a table of two or more")
   end subroutine check_single
end module ehl_case_law

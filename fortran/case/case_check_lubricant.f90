! SPDX-License-Identifier: BSD-3-Clause
!> Checks of the lubricant laws: required constants before the defaults are set; in a complete case the pressure range, and the
!> contacts to which they apply
module ehl_case_check_lubricant
   use ehl_case, only: case_t, word_length
   use ehl_case_defaults, only: inlet
   use ehl_case_law, only: knows_temperature, make_lubricant, own_law, uses_law
   use ehl_case_source, only: case_source_t
   use ehl_heat, only: dynamic_viscosity, thermal_loading, thermal_reduction
   use ehl_kinds, only: dp
   use ehl_lubricant, only: lubricant_t
   use ehl_moes, only: operating_t
   use ehl_scales, only: scales_t
   use ehl_status, only: status_t
   use ehl_text, only: short, to_text
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   implicit none (type, external)
   private
   public :: check_constants, check_lubricant

   !> Relative difference below which values are equal
   real(dp), parameter :: rounding = 1.0e-6_dp
   !> Maximum pressure at which a law must be valid, over the Hertz pressure
   real(dp), parameter :: beyond_hertz = 1.5_dp
   !> Range of Roelands exponents of liquids: water has 0.04, mineral oils 0.6
   real(dp), parameter :: min_z = 1.0e-3_dp, max_z = 2.0_dp
   character(len=*), parameter :: si_units = "load, mean_velocity, radius and reduced_modulus"

contains

   !> Refuse a law without its constants
   subroutine check_constants(source, input, status)
      type(case_source_t), intent(in) :: source
      type(case_t), intent(in) :: input
      type(status_t), intent(inout) :: status
      logical :: has_table

      associate (l => input%lubricant)
         call need("dicke", l%kinematic_viscosity_40 > 0.0_dp .or. &
                   (l%vogel_viscosity > 0.0_dp .and. l%temperature + l%vogel_c > 0.0_dp), "vogel_viscosity, vogel_b and vogel_c")
         call need("dicke", l%dicke_a1 + l%dicke_a2*l%temperature > 0.0_dp, "dicke_a1 and dicke_a2 with a1 + a2 theta above 0")
         call need("yasutomi", l%yasutomi_a1*l%yasutomi_a2*l%yasutomi_c1*l%yasutomi_c2 > 0.0_dp, "all of yasutomi_...")
         call need("doolittle", l%doolittle_viscosity*l%doolittle_b*l%doolittle_r0 > 0.0_dp, "all of doolittle_...")
         call need("doolittle", l%tait_modulus*l%tait_rate > 0.0_dp, "tait_modulus, tait_rate and the other constants of Tait")
         has_table = allocated(l%table_viscosity)
         if (has_table) has_table = size(l%table_viscosity) > 0
         call need("table", has_table, "table_temperature, table_pressure and table_viscosity, as "// &
                   "'pyehl check --resolved' writes them")
         call need_density("murnaghan", l%murnaghan_modulus*l%murnaghan_rate)
         call need_density("tait", l%tait_modulus*l%tait_rate)
      end associate

   contains

      subroutine need(law, given, constants)
         character(len=*), intent(in) :: law, constants
         logical, intent(in) :: given
         if (given .or. .not. uses_law(input%lubricant, law)) return
         call source%refuse("lubricant.viscosity_law", "the law '"//law//"' without its constants", constants, status)
      end subroutine need

      subroutine need_density(law, constants)
         character(len=*), intent(in) :: law
         real(dp), intent(in) :: constants
         if (constants > 0.0_dp .or. input%lubricant%density_law /= law) return
         call source%refuse("lubricant.density_law", "the law '"//law//"' without its constants", law//"_modulus, "//law// &
                            "_rate and the others of "//law, status)
      end subroutine need_density
   end subroutine check_constants

   !> Refuse contradictory keys of a lubricant
   subroutine check_lubricant(source, input, scales, point, status)
      type(case_source_t), intent(in) :: source
      type(case_t), intent(in) :: input
      type(scales_t), intent(in) :: scales
      type(operating_t), intent(in) :: point
      type(status_t), intent(inout) :: status
      character(len=*), parameter :: unknown = "the viscosity by temperature is not known", &
         by_law = "temperature_viscosity, or viscosity at the inlet temperature alone"
      logical :: knows

      call check_inlet(source, input, status)
      call check_rise(source, input, scales, point, status)
      associate (l => input%lubricant, c => input%contact)
         knows = knows_temperature(l) .or. l%temperature_viscosity > 0.0_dp
         call refuse(source%given("lubricant.temperature") .and. .not. knows, "lubricant.temperature", unknown, by_law)
         call refuse(source%given("lubricant.thermal_expansion") .and. .not. knows, "lubricant.thermal_expansion", unknown, by_law)
         call refuse(source%given("lubricant.density_15") .and. .not. (knows_temperature(l) .or. &
                     l%kinematic_viscosity_40 > 0.0_dp), "lubricant.density_15", unknown, by_law)
         call refuse(source%given("lubricant.thermal_expansion") .and. l%density_law == "tait" .and. &
                     .not. l%kinematic_viscosity_40 > 0.0_dp, "lubricant.thermal_expansion", &
                     "beside density_law = 'tait', which has its own", "tait_expansion alone")
         call refuse(l%range_temperature_max < l%range_temperature_min, "lubricant.range_temperature_max", &
                     "below range_temperature_min", "a range of temperatures, or both 0")
         call refuse(all(input%psd%viscosity_law /= [character(len=word_length) :: "roelands", "barus", l%viscosity_law]), &
                     "psd.viscosity_law", "'"//trim(input%psd%viscosity_law)//"' with lubricant.viscosity_law = '"// &
                     trim(l%viscosity_law)//"'", "'roelands', 'barus' or that of the lubricant")
         call refuse((l%viscosity_law == "roelands" .or. input%psd%viscosity_law == "roelands") .and. &
                     l%pressure_viscosity > 0.0_dp .and. (l%roelands_z < min_z .or. l%roelands_z > max_z), &
                     "lubricant.roelands_z", short(l%roelands_z)//", of viscosity, pressure_viscosity and roelands_p0", &
                     "a number in [0.001, 2] under Roelands' law; or viscosity_law = 'barus', which has no roelands_z")
         call refuse(l%limiting_stress > 0.0_dp .and. source%given("lubricant.limiting_coefficient"), &
                     "lubricant.limiting_coefficient", "beside limiting_stress", "one of the two, or limiting_stress = 0.0")
         call refuse(l%shear_law /= "newtonian" .and. .not. c%si, "lubricant.shear_law", "with a contact given by Moes numbers", &
                     "'newtonian', or "//si_units)
         call refuse(l%shear_law == "carreau" .and. .not. (l%carreau_stress > 0.0_dp .and. l%carreau_exponent > 0.0_dp), &
                     "lubricant.shear_law", "'carreau' without carreau_stress and carreau_exponent", "both, as measured")
         call refuse(l%boundary_friction > 0.0_dp .and. .not. l%boundary_film > 0.0_dp, "lubricant.boundary_friction", &
                     "without lubricant.boundary_film: no solid contact", "a boundary_film in m, or boundary_friction = 0.0")
         call refuse(c%hardness > 0.0_dp .and. .not. l%boundary_film > 0.0_dp, "contact.hardness", &
                     "without lubricant.boundary_film: no solid contact", "a boundary_film in m, or hardness = 0.0")
         call refuse(l%boundary_film > 0.0_dp .and. .not. c%si, "lubricant.boundary_film", "with a contact given by Moes numbers", &
                     "0.0, or "//si_units)
         call refuse(c%hardness > 0.0_dp .and. .not. c%hardness > scales%pressure, "contact.hardness", &
                     "not above the Hertz pressure of "//short(scales%pressure)//" Pa: smooth bodies would yield", &
                     "more than the Hertz pressure, a lower load, or 0.0 for elastic solids")
         call refuse(l%boundary_film > 0.0_dp .and. input%solver%coarsening == "alcouffe", "solver.coarsening", &
                     "'alcouffe' does not converge with solid contact (lubricant.boundary_film)", "'auto' or 'classical'")
         if (l%thermal_friction == "always") call check_heat("lubricant.thermal_friction", "'auto'")
         if (l%thermal_reduction) call check_heat("lubricant.thermal_reduction", ".false.")
         if (status%failed() .or. .not. l%thermal_reduction) return
         call refuse(.not. thermal_reduction(thermal_loading(l%temperature_viscosity, l%viscosity, c%mean_velocity, &
                     l%thermal_conductivity), scales%pressure/c%reduced_modulus, c%slide_to_roll) > 0.0_dp, &
                     "lubricant.thermal_reduction", "its formula gives no film at this velocity", "a slower contact, or .false.")
      end associate

   contains

      !> Refuse the value of a key on a condition
      subroutine refuse(condition, key, what, expected)
         logical, intent(in) :: condition
         character(len=*), intent(in) :: key, what, expected
         if (condition) call source%refuse(key, key//": "//what, expected, status)
      end subroutine refuse

      !> Heating needs a velocity in m/s and the temperature dependence of the viscosity
      subroutine check_heat(key, or)
         character(len=*), intent(in) :: key, or
         call refuse(.not. input%contact%si, key, "with a contact given by Moes numbers", si_units//", or "//or)
         call refuse(.not. input%lubricant%temperature_viscosity > 0.0_dp, key, unknown, "temperature_viscosity, or "//or)
      end subroutine check_heat
   end subroutine check_lubricant

   !> Viscosity and pressure-viscosity coefficient must be those of the law or the data sheet
   subroutine check_inlet(source, input, status)
      type(case_source_t), intent(in) :: source
      type(case_t), intent(in) :: input
      type(status_t), intent(inout) :: status
      real(dp) :: viscosity, alpha, slope, sheet(2)

      associate (l => input%lubricant)
         sheet = [l%kinematic_viscosity_40, l%kinematic_viscosity_100]
         if (any(sheet > 0.0_dp)) then
            if (any(sheet <= 0.0_dp) .or. sheet(2) >= sheet(1)) then
               call source%refuse("lubricant.kinematic_viscosity_100", "kinematic_viscosity_40 = "//to_text(sheet(1))// &
                                  " and kinematic_viscosity_100 = "//to_text(sheet(2)), "both, that at 100 degC the smaller one", &
                                  status)
               return
            end if
            call agree("viscosity", l%viscosity, dynamic_viscosity(l%temperature, sheet, l%density_15, l%thermal_expansion))
         end if
         if (own_law(l) == "") return
         call inlet(l, viscosity, alpha, slope, status)
         if (status%failed()) return
         if (.not. ieee_is_finite(viscosity)) call source%refuse("lubricant.viscosity_law", "the law '"//trim(own_law(l))// &
            "' has no viscosity at "//to_text(l%temperature)//" degC", "a temperature and constants at which the oil is liquid", &
            status)
         call agree("viscosity", l%viscosity, viscosity)
         call agree("pressure_viscosity", l%pressure_viscosity, alpha)
      end associate

   contains

      subroutine agree(key, value, derived)
         character(len=*), intent(in) :: key
         real(dp), intent(in) :: value, derived
         character(len=*), parameter :: group = "lubricant."

         if (abs(value - derived) > rounding*derived) call source%refuse(group//key, group//key//" = "//to_text(value)// &
            ", and the law or the data sheet gives "//short(derived), key//", or the values that it follows from", status)
         call source%check_range(group//key, value, group//key, "the law", status)
      end subroutine agree
   end subroutine check_inlet

   !> Viscosity and density by laws with constants of the oil, or by a table, must increase up to `beyond_hertz` times the Hertz
   !> pressure
   subroutine check_rise(source, input, scales, point, status)
      type(case_source_t), intent(in) :: source
      type(case_t), intent(in) :: input
      type(scales_t), intent(in) :: scales
      type(operating_t), intent(in) :: point
      type(status_t), intent(inout) :: status
      type(lubricant_t) :: lubricant
      integer, parameter :: n = 300
      real(dp), dimension(0:n) :: p, values, slope
      logical :: simple(2)
      integer :: k

      associate (l => input%lubricant)
         simple = [any(l%viscosity_law == [character(len=8) :: "roelands", "barus"]), &
                   any(l%density_law == [character(len=16) :: "dowson-higginson", "incompressible"])]
         if (all(simple) .or. .not. scales%pressure > 0.0_dp .or. status%failed()) return
         call make_lubricant(l, point%alpha_bar, scales%pressure, lubricant, status)
         if (status%failed()) return
         p = beyond_hertz*[(real(k, dp), k=0, n)]/n
         call lubricant%density(p, values, slope)
         if (.not. simple(2)) call check("lubricant.density_law", "density")
         call lubricant%log_viscosity(p, values, slope)
         if (.not. simple(1)) call check("lubricant.viscosity_law", "viscosity")
      end associate

   contains

      subroutine check(key, what)
         character(len=*), intent(in) :: key, what

         do k = 1, n
            if (ieee_is_finite(values(k))) then
               if (values(k) > values(k - 1)) cycle
            end if
            call source%refuse(key, "the law gives no "//what//" that increases with pressure at "//short(p(k)*scales%pressure)// &
               " Pa and "//to_text(input%lubricant%temperature)//" degC, and the Hertz pressure is "//short(scales%pressure)// &
               " Pa", "a law that holds for the "//what//" up to 1.5 times the Hertz pressure, or a lower load", status)
            return
         end do
      end subroutine check
   end subroutine check_rise
end module ehl_case_check_lubricant

! SPDX-License-Identifier: BSD-3-Clause
!> Oils by name, and laws with constants of an oil: what follows from them, and what contradicts
module ehl_case_oil
   use ehl_case, only: case_t
   use ehl_case_contact, only: find_contact
   use ehl_case_law, only: make_lubricant, make_viscosity, own_law, uses_law
   use ehl_contact, only: contact_t
   use ehl_heat, only: freezing
   use ehl_kinds, only: dp
   use ehl_lubricant, only: lubricant_t
   use ehl_moes, only: operating_t
   use ehl_oils, only: oil_named, oil_t
   use ehl_scales, only: scales_t
   use ehl_schema, only: schema_t
   use ehl_status, only: status_t
   use ehl_text, only: short, to_text
   use ehl_viscosity_file, only: read_isotherms
   use ehl_viscosity_law, only: viscosity_law_t
   use ehl_viscosity_table, only: isotherm_t
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   implicit none (type, external)
   private
   public :: complete_oil, complete_law, check_law

   !> Relative difference of values that is none
   real(dp), parameter :: rounding = 1.0e-6_dp
   !> Greatest pressure at which a law must tell a viscosity, over the Hertz pressure
   real(dp), parameter :: beyond_hertz = 1.5_dp
   !> Laws without constants of an oil, which rise up to any pressure
   character(len=*), parameter :: simple_viscosity(2) = [character(len=8) :: "roelands", "barus"], &
                                  simple_density(2) = [character(len=16) :: "dowson-higginson", "incompressible"]

contains

   !> Constants of an oil where their keys are not given; the name of the table made absolute
   subroutine complete_oil(schema, input, status)
      type(schema_t), intent(in) :: schema
      type(case_t), intent(inout) :: input
      type(status_t), intent(inout) :: status
      type(oil_t) :: oil
      real(dp), pointer :: value
      integer :: k, place
      logical :: vogel

      oil = oil_named(trim(input%lubricant%name))
      vogel = any(schema%keys%given .and. schema%keys%group == "lubricant" .and. index(schema%keys%name, "vogel_") == 1)
      do k = 1, size(oil%constants)
         ! the data sheet would rule over what was given
         if (vogel .and. index(oil%constants(k)%key, "kinematic_") == 1) cycle
         place = schema%find("lubricant", trim(oil%constants(k)%key))
         value => schema%keys(place)%real_value
         if (.not. schema%keys(place)%given) value = oil%constants(k)%value
      end do
      if (.not. schema%given("lubricant", "viscosity_law") .and. own_law(input%lubricant) /= "") then
         input%lubricant%viscosity_law = own_law(input%lubricant)
      end if
      ! its constants hold with that volume
      if (.not. schema%given("lubricant", "density_law") .and. own_law(input%lubricant) == "doolittle") then
         input%lubricant%density_law = "tait"
      end if
      if (input%lubricant%table%text() == "") then
         if (input%lubricant%viscosity_law == "table") call schema%refuse("lubricant.viscosity_law", &
            "lubricant.viscosity_law = 'table' without lubricant.table", "table = '...', a CSV of measured viscosities", status)
         return
      end if
      call schema%find_file("lubricant.table", input%lubricant%table, status)
   end subroutine complete_oil

   !> Viscosity, pressure-viscosity coefficient and fall with temperature at the inlet, from the law that tells them
   subroutine complete_law(schema, input, status)
      type(schema_t), intent(in) :: schema
      type(case_t), intent(inout) :: input
      type(status_t), intent(inout) :: status
      class(viscosity_law_t), allocatable :: law
      real(dp) :: alpha(1), level(1), at(2)
      !> [K] the error of the difference is its square over some hundred K^2
      real(dp), parameter :: step = 0.01_dp

      if (own_law(input%lubricant) == "") return
      call check_constants(schema, input, status)
      if (status%failed()) return
      associate (l => input%lubricant)
         if (own_law(l) == "table" .and. .not. allocated(l%isotherms)) call read_isotherms(l%table%text(), l%isotherms, status)
         if (status%failed()) return
         ! a pressure of 1 Pa
         call make_viscosity(l, own_law(l), 1.0_dp, law, status)
         if (status%failed()) return
         if (.not. ieee_is_finite(law%ambient_viscosity)) then
            call schema%refuse(law_key(schema), "the law '"//trim(own_law(l))//"' has no viscosity at "// &
                               to_text(l%temperature)//" degC", "a temperature and constants at which the oil is liquid", status)
            return
         end if
         call law%log_viscosity([0.0_dp], level, alpha)
         call law%log_viscosity_at([0.0_dp, 0.0_dp], [-step, step], at)
         if (own_law(l) == "table") call take_range(l%isotherms)
         call follow("viscosity", l%viscosity, law%ambient_viscosity)
         call follow("pressure_viscosity", l%pressure_viscosity, alpha(1))
         ! an own value is another slope of the temperature in the laws of Roelands and Barus, and that of a table of a single
         ! temperature
         if (.not. schema%given("lubricant", "temperature_viscosity")) l%temperature_viscosity = (at(1) - at(2))/(2.0_dp*step)
      end associate

   contains

      !> The range of a table where its keys are not given
      subroutine take_range(isotherms)
         type(isotherm_t), intent(in) :: isotherms(:)
         integer :: k

         associate (l => input%lubricant, n => size(isotherms))
            if (.not. schema%given("lubricant", "range_temperature_min")) then
               l%range_temperature_min = isotherms(1)%temperature - freezing
            end if
            if (.not. schema%given("lubricant", "range_temperature_max")) then
               l%range_temperature_max = isotherms(n)%temperature - freezing
            end if
            if (schema%given("lubricant", "range_pressure_max")) return
            l%range_pressure_max = minval([(isotherms(k)%p(size(isotherms(k)%p)), k=1, n)])
         end associate
      end subroutine take_range

      !> A value that follows: taken where its key is not given, else it must be the given one
      subroutine follow(name, value, follows)
         character(len=*), intent(in) :: name
         real(dp), intent(inout) :: value
         real(dp), intent(in) :: follows
         character(len=:), allocatable :: by

         by = law_key(schema)
         associate (temperature => to_text(input%lubricant%temperature)//" degC")
            if (.not. schema%given("lubricant", name)) then
               value = follows
               call schema%check_range("lubricant."//name, value, by, by//" at "//temperature, status)
            else if (abs(value - follows) > rounding*follows) then
               call schema%contradict("lubricant."//name, by, name//", or the law that tells it", status, "lubricant."//name// &
                                      " = "//to_text(value)//", and the law gives "//short(follows)//" at "//temperature)
            end if
         end associate
      end subroutine follow
   end subroutine complete_law

   !> The key that asks for the law
   function law_key(schema) result(name)
      type(schema_t), intent(in) :: schema
      character(len=:), allocatable :: name

      name = "lubricant.viscosity_law"
      if (schema%given("lubricant", "name")) name = "lubricant.name"
      if (schema%given("lubricant", "table")) name = "lubricant.table"
   end function law_key

   !> The constants that the laws in use need
   subroutine check_constants(schema, input, status)
      type(schema_t), intent(in) :: schema
      type(case_t), intent(in) :: input
      type(status_t), intent(inout) :: status

      associate (l => input%lubricant)
         call need("dicke", l%kinematic_viscosity_40 > 0.0_dp .or. &
                   (l%vogel_viscosity > 0.0_dp .and. l%temperature + l%vogel_c > 0.0_dp), "the viscosity at ambient pressure", &
                   "vogel_viscosity, vogel_b and vogel_c, or kinematic_viscosity_40 and kinematic_viscosity_100")
         call need("dicke", l%dicke_a1 + l%dicke_a2*l%temperature > 0.0_dp, "a positive a1 + a2 theta", &
                   "dicke_a1, dicke_a2, dicke_b1 and dicke_b2 with a1 + a2 theta above 0")
         call need("yasutomi", l%yasutomi_a1*l%yasutomi_a2*l%yasutomi_c1*l%yasutomi_c2 > 0.0_dp, "all of its constants", &
                   "yasutomi_tg0, yasutomi_a1, yasutomi_a2, yasutomi_b1, yasutomi_b2, yasutomi_c1 and yasutomi_c2")
         call need("doolittle", l%doolittle_viscosity*l%doolittle_b*l%doolittle_r0 > 0.0_dp, "all of its constants", &
                   "doolittle_viscosity, doolittle_temperature, doolittle_b, doolittle_r0 and doolittle_expansion")
         call need("doolittle", l%tait_modulus*l%tait_rate > 0.0_dp, "the volume under pressure", &
                   "tait_modulus, tait_rate, tait_softening, tait_expansion and tait_temperature")
      end associate

   contains

      subroutine need(law, there, missing, expected)
         character(len=*), intent(in) :: law, missing, expected
         logical, intent(in) :: there

         if (there .or. .not. uses_law(input%lubricant, law)) return
         call schema%refuse(law_key(schema), "lubricant.viscosity_law = '"//law//"' without "//missing, expected, status)
      end subroutine need
   end subroutine check_constants

   !> The laws must tell viscosity and density over all pressures of the contact
   subroutine check_law(schema, input, status)
      type(schema_t), intent(in) :: schema
      type(case_t), intent(in) :: input
      type(status_t), intent(inout) :: status
      type(lubricant_t) :: lubricant
      class(contact_t), allocatable :: contact
      type(scales_t) :: scales
      type(operating_t) :: point
      integer, parameter :: n = 300
      real(dp), dimension(0:n) :: p, values, slope
      integer :: k

      associate (l => input%lubricant)
         call check_density(schema, input, status)
         if (l%range_temperature_max < l%range_temperature_min) then
            call schema%refuse("lubricant.range_temperature_max", "lubricant.range_temperature_max = "// &
               to_text(l%range_temperature_max)//" below range_temperature_min = "//to_text(l%range_temperature_min), &
               "a range of temperatures, or both 0", status)
         end if
         if (status%failed()) return
         if (any(l%viscosity_law == simple_viscosity) .and. any(l%density_law == simple_density)) return
         call find_contact(input, contact, scales, point)
         if (.not. scales%pressure > 0.0_dp) return
         call make_lubricant(l, point%alpha_bar, scales%pressure, lubricant, status)
         if (status%failed()) return
         p = beyond_hertz*[(real(k, dp), k=0, n)]/n
         call lubricant%density(p, values, slope)
         if (.not. any(l%density_law == simple_density)) call check_rise("lubricant.density_law", trim(l%density_law), "density")
         call lubricant%log_viscosity(p, values, slope)
         if (.not. any(l%viscosity_law == simple_viscosity)) call check_rise(law_key(schema), trim(l%viscosity_law), "viscosity")
      end associate

   contains

      !> The values of a law must rise with pressure
      subroutine check_rise(key, law, what)
         character(len=*), intent(in) :: key, law, what

         do k = 1, n
            if (ieee_is_finite(values(k))) then
               if (values(k) > values(k - 1)) cycle
            end if
            call schema%refuse(key, "the law '"//law//"' has no "//what//" that rises with pressure at "// &
               short(p(k)*scales%pressure)//" Pa and "//to_text(input%lubricant%temperature)// &
               " degC, and the Hertz pressure is "//short(scales%pressure)//" Pa", &
               "a law that tells the "//what//" up to 1.5 times the Hertz pressure, or a lower load", status)
            return
         end do
      end subroutine check_rise
   end subroutine check_law

   !> The constants of the density, and a thermal expansion beside a law that has its own
   subroutine check_density(schema, input, status)
      type(schema_t), intent(in) :: schema
      type(case_t), intent(in) :: input
      type(status_t), intent(inout) :: status

      associate (l => input%lubricant)
         if (l%density_law == "murnaghan" .and. .not. l%murnaghan_modulus*l%murnaghan_rate > 0.0_dp) then
            call schema%refuse("lubricant.density_law", "lubricant.density_law = 'murnaghan' without its constants", &
                               "murnaghan_modulus, murnaghan_rate and murnaghan_softening", status)
         else if (l%density_law == "tait" .and. .not. l%tait_modulus*l%tait_rate > 0.0_dp) then
            call schema%refuse("lubricant.density_law", "lubricant.density_law = 'tait' without its constants", &
                               "tait_modulus, tait_rate, tait_softening, tait_expansion and tait_temperature", status)
         else if (l%density_law == "tait" .and. schema%given("lubricant", "thermal_expansion") .and. &
                  .not. l%kinematic_viscosity_40 > 0.0_dp) then
            call schema%refuse("lubricant.thermal_expansion", "lubricant.thermal_expansion with "// &
                               "lubricant.density_law = 'tait', which has its own", "tait_expansion alone", status)
         end if
      end associate
   end subroutine check_density
end module ehl_case_oil

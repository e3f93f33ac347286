! SPDX-License-Identifier: BSD-3-Clause
!> Defaults of a case that follow from other keys. pyehl completes values that need tables or data sheets.
module ehl_case_defaults
   use ehl_case, only: case_t, has_no_height, is_feature, lubricant_case_t, surface_case_t
   use ehl_case_grid, only: duty_widening, fill_grid, grid_keys
   use ehl_case_law, only: make_viscosity, own_law
   use ehl_case_point, only: find_contact
   use ehl_case_source, only: case_source_t
   use ehl_contact, only: contact_t
   use ehl_heat, only: zero_celsius
   use ehl_kinds, only: dp
   use ehl_moes, only: operating_t
   use ehl_scales, only: scales_t
   use ehl_status, only: status_t
   use ehl_surface, only: x_filled, x_matters
   use ehl_viscosity_law, only: viscosity_law_t
   use ehl_viscosity_table, only: isotherm_t, new_isotherm
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   implicit none (type, external)
   private
   public :: complete, inlet, is_starved, latest_start, line_keys, make_isotherms, moes_keys, point_keys, si_keys, &
             must_wait, sliding, velocity_ratio

   character(len=16), parameter :: moes_keys(5) = [character(len=16) :: "moes_m", "moes_l", "radius_ratio", "moes_m_line", &
                                                   "moes_l_line"], &
      si_keys(7) = [character(len=16) :: "load", "load_per_length", "mean_velocity", "radius", "reduced_modulus", "radius_x", &
                    "radius_y"], &
      !> Keys of a line, and those of a point
      line_keys(3) = [character(len=16) :: "moes_m_line", "moes_l_line", "load_per_length"], &
      point_keys(7) = [character(len=16) :: "moes_m", "moes_l", "load", "radius_ratio", "radius_x", "radius_y", "angle"]
   !> Size of the tile of Table 1 of Zhang et al. 2019 [m]
   real(dp), parameter :: fractal_length = 8.29e-4_dp
   !> Time in which a film from the inlet passes through the contact [a/u]
   real(dp), parameter :: transit = 2.0_dp

contains

   !> Set all keys that were not given
   subroutine complete(source, input, status)
      type(case_source_t), intent(in) :: source
      type(case_t), intent(inout) :: input
      type(status_t), intent(inout) :: status
      class(contact_t), allocatable :: contact
      type(scales_t) :: scales
      type(operating_t) :: point
      logical :: given(size(grid_keys))
      integer :: k

      call complete_contact(source, input)
      call complete_lubricant(source, input, status)
      if (status%failed()) return
      call find_contact(input, contact, scales, point)
      call complete_inlet(source, scales, input)
      given = [(source%given("grid."//grid_keys(k)), k=1, size(grid_keys))]
      ! the pressure at a flooded border contains no squeeze term
      if (input%duty%active() .and. .not. given(1)) input%grid%border = "zero"
      if (is_starved(input) .and. .not. given(1)) input%grid%border = "zero"
      given(2) = given(2) .or. input%inlet%position_hertz > 0.0_dp
      call fill_grid(contact, point, input%surface%kind == "smooth" .and. input%second_surface%kind == "smooth", &
                     input%lubricant%shear_law /= "newtonian" .and. input%lubricant%flow == "consistent", &
                     [given(1) .or. input%duty%active() .or. is_starved(input), given(2:)], input%grid, &
                     duty_widening(input), input%duty%reverses(), &
                     .not. (input%duty%active() .or. is_starved(input) .or. input%lubricant%boundary_film > 0.0_dp))
      if (input%contact%is_line() .and. .not. source%given("solver.deflection")) input%solver%deflection = "fft"
      call complete_motion(source, input)
      call complete_surface(source, "surface", input%grid%x_inlet, input%surface)
      call complete_surface(source, "second_surface", input%grid%x_inlet, input%second_surface)
      ! two fractal surfaces of one seed are the same surface, whose waves add up
      if (input%surface%kind == "fractal" .and. input%second_surface%kind == "fractal" &
          .and. .not. source%given("second_surface.seed")) then
         input%second_surface%seed = input%surface%seed + merge(1, -1, input%surface%seed < huge(1))
      end if
      if (.not. source%given("surface.x_start")) call delay_start(input%surface, input%second_surface)
      if (.not. source%given("second_surface.x_start")) call delay_start(input%second_surface, input%surface)
   end subroutine complete

   !> Whether the inlet is starved
   pure logical function is_starved(input)
      type(case_t), intent(in) :: input
      is_starved = max(input%inlet%position_hertz, input%inlet%film_hertz) > 0.0_dp
   end function is_starved

   !> Set the inlet in Hertz units; the border of the domain is at the meniscus
   subroutine complete_inlet(source, scales, input)
      type(case_source_t), intent(in) :: source
      type(scales_t), intent(in) :: scales
      type(case_t), intent(inout) :: input

      associate (of => input%inlet)
         if (input%contact%si) then
            if (.not. source%given("inlet.position_hertz")) of%position_hertz = of%position/scales%length
            if (.not. source%given("inlet.film_hertz")) of%film_hertz = of%film/scales%film
         end if
         if (of%position_hertz > 0.0_dp .and. .not. source%given("grid.x_inlet")) input%grid%x_inlet = -of%position_hertz
      end associate
   end subroutine complete_inlet

   !> Set whether the bodies are given, whether the contact is in SI units, and then both radii and their ratio
   subroutine complete_contact(source, input)
      type(case_source_t), intent(in) :: source
      type(case_t), intent(inout) :: input

      input%bodies%given = any(source%pieces%group == "bodies")
      associate (c => input%contact)
         c%si = source%first_given("contact", moes_keys) == ""
         if (.not. c%si) return
         c%round = .not. (c%radius_x > 0.0_dp .or. c%radius_y > 0.0_dp)
         if (c%round) then
            c%radius_x = c%radius
            c%radius_y = c%radius
         end if
         if (c%radius_y > 0.0_dp) c%radius_ratio = c%radius_x/c%radius_y
      end associate
   end subroutine complete_contact

   !> Set density law, isotherms and range of a table, viscosity, pressure-viscosity coefficient and temperature dependence at the
   !> inlet from a law, Roelands' exponent, and the law of &psd
   subroutine complete_lubricant(source, input, status)
      type(case_source_t), intent(in) :: source
      type(case_t), intent(inout) :: input
      type(status_t), intent(inout) :: status
      real(dp) :: viscosity, alpha, slope
      character(len=:), allocatable :: why

      associate (l => input%lubricant)
         ! the constants of Doolittle's law refer to Tait's equation
         if (.not. source%given("lubricant.density_law") .and. l%viscosity_law == "doolittle") l%density_law = "tait"
         call make_isotherms(l, why)
         if (why /= "") call source%refuse("lubricant.table_viscosity", "a table of viscosities "//why, &
                                           "what 'pyehl check --resolved' writes of a table", status)
         if (status%failed()) return
         if (allocated(l%isotherms)) call set_range(source, l)
         if (own_law(l) /= "" .and. .not. (source%given("lubricant.viscosity") .and. source%given("lubricant.pressure_viscosity") &
                                           .and. source%given("lubricant.temperature_viscosity"))) then
            call inlet(l, viscosity, alpha, slope, status)
            if (status%failed()) return
            if (.not. source%given("lubricant.viscosity")) l%viscosity = viscosity
            if (.not. source%given("lubricant.pressure_viscosity")) l%pressure_viscosity = alpha
            if (.not. source%given("lubricant.temperature_viscosity")) l%temperature_viscosity = slope
         end if
         if (own_law(l) == "" .and. input%contact%si .and. source%given("lubricant.viscosity") .and. .not. &
             source%given("lubricant.pressure_viscosity") .and. l%alpha_origin == "given") l%alpha_origin = "default"
         if (.not. source%given("lubricant.roelands_z")) then
            l%roelands_z = roelands_exponent(l%viscosity, l%pressure_viscosity, l%roelands_p0)
         end if
         if (input%psd%viscosity_law == "") input%psd%viscosity_law = l%viscosity_law
      end associate
   end subroutine complete_lubricant

   !> z of Roelands' law from viscosity [Pa s], pressure-viscosity coefficient [1/Pa] and reference pressure [Pa]
   pure real(dp) function roelands_exponent(viscosity, alpha, p0)
      real(dp), intent(in) :: viscosity, alpha, p0
      roelands_exponent = alpha*p0/(log(viscosity) + 9.67_dp)
   end function roelands_exponent

   !> Viscosity [Pa s], pressure-viscosity coefficient [1/Pa] and -(d eta/dT)/eta [1/K] at the inlet from a law
   subroutine inlet(l, viscosity, alpha, slope, status)
      type(lubricant_case_t), intent(in) :: l
      real(dp), intent(out) :: viscosity, alpha, slope
      type(status_t), intent(inout) :: status
      class(viscosity_law_t), allocatable :: law
      real(dp) :: rise(1), level(1), at(2)
      !> Temperature step [K]; the relative error of the difference is about its square over 1e4 K^2
      real(dp), parameter :: step = 0.01_dp

      viscosity = 0.0_dp
      alpha = 0.0_dp
      slope = 0.0_dp
      ! a pressure of 1 Pa in place of the Hertz pressure
      call make_viscosity(l, trim(own_law(l)), 1.0_dp, law, status)
      if (status%failed()) return
      viscosity = law%ambient_viscosity
      if (.not. ieee_is_finite(viscosity)) return
      call law%log_viscosity([0.0_dp], level, rise)
      call law%log_viscosity_at([0.0_dp, 0.0_dp], [-step, step], at)
      alpha = rise(1)
      slope = (at(1) - at(2))/(2.0_dp*step)
   end subroutine inlet

   !> Set the range of the measurements from a table if it is not given
   subroutine set_range(source, l)
      type(case_source_t), intent(in) :: source
      type(lubricant_case_t), intent(inout) :: l
      integer :: k

      associate (isotherms => l%isotherms)
         if (.not. source%given("lubricant.range_temperature_min")) then
            l%range_temperature_min = isotherms(1)%temperature - zero_celsius
         end if
         if (.not. source%given("lubricant.range_temperature_max")) then
           l%range_temperature_max = isotherms(size(isotherms))%temperature - zero_celsius
         end if
         if (.not. source%given("lubricant.range_pressure_max")) then
           l%range_pressure_max = minval([(isotherms(k)%p(size(isotherms(k)%p)), k=1, size(isotherms))])
         end if
      end associate
   end subroutine set_range

   !> Split the table of measured viscosities into isotherms; `why`: the reason of a failure
   subroutine make_isotherms(l, why)
      type(lubricant_case_t), intent(inout) :: l
      character(len=:), allocatable, intent(out) :: why
      integer :: first, last, n

      why = ""
      if (.not. allocated(l%table_viscosity)) return
      n = size(l%table_viscosity)
      if (n == 0) return
      if (size(l%table_temperature) /= n .or. size(l%table_pressure) /= n) then
         why = "without a temperature and a pressure for each viscosity"
         return
      end if
      allocate (l%isotherms(0))
      first = 1
      do while (first <= n)
         last = first
         do while (last < n)
            if (abs(l%table_temperature(last + 1) - l%table_temperature(first)) > 0.0_dp) exit
            last = last + 1
         end do
         associate (p => l%table_pressure(first:last), eta => l%table_viscosity(first:last))
            if (first == last .or. any(p(2:) <= p(:last - first)) .or. any([eta(2:) - eta(:last - first), eta(1)] <= 0.0_dp)) then
               why = "without two or more increasing pressures, with increasing viscosities, at each temperature"
               return
            end if
            l%isotherms = [l%isotherms, new_isotherm(l%table_temperature(first) + zero_celsius, p, eta)]
         end associate
         first = last + 1
      end do
      if (any(l%isotherms(2:)%temperature <= l%isotherms(:size(l%isotherms) - 1)%temperature)) then
         why = "that is not sorted by increasing temperature"
      end if
   end subroutine make_isotherms

   !> Set slide-to-roll ratio and velocities of the surfaces from the one that is given
   subroutine complete_motion(source, input)
      type(case_source_t), intent(in) :: source
      type(case_t), intent(inout) :: input

      associate (body => input%contact%rough_surface, srr => input%contact%slide_to_roll, &
                 first => input%surface%velocity_ratio, second => input%second_surface%velocity_ratio)
         if (.not. source%given("contact.slide_to_roll")) then
            if (source%given("surface.velocity_ratio")) then
               srr = sliding(body, first)
            else if (source%given("second_surface.velocity_ratio")) then
               srr = sliding(3 - body, second)
            end if
         end if
         if (.not. source%given("surface.velocity_ratio")) first = velocity_ratio(body, srr)
         if (.not. source%given("second_surface.velocity_ratio")) second = velocity_ratio(3 - body, srr)
      end associate
   end subroutine complete_motion

   !> Velocity of body 1 or 2 over the mean velocity
   pure real(dp) function velocity_ratio(body, srr)
      integer, intent(in) :: body
      real(dp), intent(in) :: srr
      velocity_ratio = 1.0_dp + 0.5_dp*merge(1.0_dp, -1.0_dp, body == 1)*srr
   end function velocity_ratio

   !> Slide-to-roll ratio from the velocity ratio of a body, without the rounding of the difference: 0.02 for 1.01
   pure real(dp) function sliding(body, ratio)
      integer, intent(in) :: body
      real(dp), intent(in) :: ratio
      sliding = anint(merge(1.0_dp, -1.0_dp, body == 1)*(ratio - 1.0_dp)*2.0e12_dp)/1.0e12_dp
   end function sliding

   !> Set the defaults of a surface that depend on other keys
   subroutine complete_surface(source, group, x_inlet, s)
      type(case_source_t), intent(in) :: source
      character(len=*), intent(in) :: group
      real(dp), intent(in) :: x_inlet
      type(surface_case_t), intent(inout) :: s

      if (s%kind == "fractal") then
         if (.not. s%length_x > 0.0_dp) s%length_x = fractal_length
         if (.not. s%length_y > 0.0_dp) s%length_y = fractal_length
      end if
      if (.not. source%given(group//".wavelength_x")) s%wavelength_x = s%wavelength
      if (.not. source%given(group//".wavelength_y")) s%wavelength_y = s%wavelength
      if (.not. source%given(group//".x_start")) s%x_start = x_inlet
      s%amplitude_given = source%given(group//".amplitude")
   end subroutine complete_surface

   !> Set the default x_start of a feature: it approaches the contact a time `transit` after the roughness of the other surface has
   !> filled it
   pure subroutine delay_start(s, other)
      type(surface_case_t), intent(inout) :: s
      type(surface_case_t), intent(in) :: other

      if (must_wait(s, other)) s%x_start = min(s%x_start, latest_start(s, other) - s%velocity_ratio*transit)
   end subroutine delay_start

   !> Whether `s` is a moving feature, and the other surface has moving roughness
   pure logical function must_wait(s, other)
      type(surface_case_t), intent(in) :: s, other
      must_wait = is_feature(s%kind) .and. .not. is_feature(other%kind) .and. .not. has_no_height(other) .and. &
                  s%velocity_ratio > 0.0_dp .and. other%velocity_ratio > 0.0_dp
   end function must_wait

   !> Maximum x_start of a feature [a]: its front is at x_matters when the front of the other surface is at x_filled
   pure real(dp) function latest_start(s, other)
      type(surface_case_t), intent(in) :: s, other
      latest_start = x_matters - s%velocity_ratio*(x_filled - other%x_start)/other%velocity_ratio
   end function latest_start
end module ehl_case_defaults

! SPDX-License-Identifier: BSD-3-Clause
!> Friction integrals of uniform films, shear laws, and frictional heating
module test_friction
   use check, only: is_close, is_true
   use ehl_contact, only: contact_t
   use ehl_contact_factory, only: new_contact
   use ehl_reynolds, only: update_coefficients
   use ehl_flow_factory, only: new_flow
   use ehl_grid, only: new_grid
   use ehl_heat, only: dynamic_viscosity, flash_temperature, kinematic_viscosity, temperature_viscosity, thermal_reduction
   use ehl_heated_friction, only: film_heat_t, heat_film, heated_t
   use ehl_kinds, only: dp, pi
   use ehl_level, only: level_t
   use ehl_lubricant, only: density_dowson_higginson, new_lubricant, viscosity_barus
   use ehl_contact_results, only: measure, contact_results_t
   use ehl_shear, only: shear_carreau, shear_eyring, shear_law_t, shear_limiting, shear_newtonian, shear_stress
   use ehl_status, only: status_t
   use ehl_text, only: to_text
   use ehl_wall_heat, only: heat_source, heat_response_t, speed_of_rest, wall_heat_t, wall_strength
   implicit none (type, external)
   private
   public :: run_friction

   !> Uniform pressure over p_h, film over a^2/R; alpha p_h, p_h [Pa], Newtonian stress of eta0 and H = 1 [Pa]
   real(dp), parameter :: p = 0.4_dp, h = 0.02_dp, alpha_bar = 10.0_dp, hertz_pressure = 1.0e9_dp, scale = 1.0e4_dp
   real(dp), parameter :: area = 33.0_dp**2*0.125_dp**2, newtonian = scale*exp(alpha_bar*p)/h

contains

   subroutine run_friction()
      call uniform_films()
      call limits()
      call data_sheet()
      call flash()
      call flash_of_rows()
      call walls_behind()
      call strip()
      call speed_at_rest()
      call heat_in_proportion()
      call heated_film()
   end subroutine run_friction

   !> Friction integral of the uniform film with a shear law
   real(dp) function friction_of(law, stress, coefficient, exponent, factor)
      integer, intent(in) :: law
      real(dp), intent(in) :: stress, coefficient, exponent, factor
      type(level_t) :: level
      type(contact_results_t) :: m
      type(status_t) :: status

      level%grid = new_grid(33, 33, -2.0_dp, 2.0_dp, 2.0_dp, .false.)
      level%lubricant = new_lubricant(viscosity_barus, density_dowson_higginson, alpha_bar, hertz_pressure, 0.6_dp, 1.96e8_dp)
      level%lubricant%shear = shear_law_t(law, stress, coefficient, exponent, factor*scale, hertz_pressure)
      level%load = 1.0_dp
      call new_flow(level%lubricant, 1.0_dp/700.0_dp, level%flow)
      call level%setup(status)
      level%p = p
      level%h = h
      call update_coefficients(level)
      m = measure(level)
      friction_of = m%friction
   end function friction_of

   subroutine uniform_films()
      real(dp) :: tau

      call is_close(friction_of(shear_newtonian, 0.0_dp, 0.0_dp, 1.0_dp, 1.0_dp)/area, exp(alpha_bar*p)/h, 1.0e-9_dp, &
                    "a uniform Newtonian film")
      tau = 5.0e6_dp*log(newtonian/5.0e6_dp + sqrt((newtonian/5.0e6_dp)**2 + 1.0_dp))
      call is_close(friction_of(shear_eyring, 5.0e6_dp, 0.0_dp, 1.0_dp, 1.0_dp)*scale/area/tau, 1.0_dp, 1.0e-13_dp, &
                    "a uniform film, Eyring")
      tau = 2.0e7_dp*(1.0_dp - exp(-newtonian/2.0e7_dp))
      call is_close(friction_of(shear_limiting, 0.0_dp, 0.05_dp, 1.0_dp, 1.0_dp)*scale/area/tau, 1.0_dp, 1.0e-13_dp, &
                    "a uniform film, limit in proportion to pressure")
      call is_close(friction_of(shear_limiting, 2.0e7_dp, 0.3_dp, 1.0_dp, 1.0_dp)*scale/area/tau, 1.0_dp, 1.0e-13_dp, &
                    "a uniform film, constant limit")
      tau = newtonian/sqrt(1.0_dp + (newtonian/1.0e6_dp)**2)**0.5_dp
      call is_close(friction_of(shear_carreau, 1.0e6_dp, 0.0_dp, 0.5_dp, 1.0_dp)*scale/area/tau, 1.0_dp, 1.0e-13_dp, &
                    "a uniform film, Carreau")
   end subroutine uniform_films

   !> Limits of the shear laws: Newtonian for slow sliding, the limiting stress for fast sliding
   subroutine limits()
      real(dp), parameter :: slow = 1.0e-12_dp, fast = 1.0e9_dp
      real(dp) :: stress(2)

      call is_close(friction_of(shear_eyring, 5.0e6_dp, 0.0_dp, 1.0_dp, slow)*h*exp(-alpha_bar*p)/area, 1.0_dp, 1.0e-13_dp, &
                    "Eyring when slow")
      call is_close(friction_of(shear_limiting, 0.0_dp, 0.05_dp, 1.0_dp, slow)*h*exp(-alpha_bar*p)/area, 1.0_dp, 1.0e-10_dp, &
                    "limiting stress when slow")
      call is_close(friction_of(shear_carreau, 1.0e6_dp, 0.0_dp, 0.5_dp, slow)*h*exp(-alpha_bar*p)/area, 1.0_dp, 1.0e-13_dp, &
                    "Carreau when slow")
      call is_close(friction_of(shear_eyring, 5.0e6_dp, 0.0_dp, 1.0_dp, 0.0_dp)*h*exp(-alpha_bar*p)/area, 1.0_dp, 1.0e-13_dp, &
                    "without sliding every law is Newtonian")
      call is_close(friction_of(shear_limiting, 0.0_dp, 0.05_dp, 1.0_dp, fast)*fast*scale/area, 2.0e7_dp, 1.0e-6_dp, &
                    "limiting stress when fast")
      call shear_stress(shear_law_t(shear_limiting, coefficient=0.05_dp), [1.0e6_dp, 0.0_dp], [0.0_dp, 1.0e9_dp], stress)
      call is_close(maxval(abs(stress)), 0.0_dp, 0.0_dp, "no pressure or no shear, no limited stress")
   end subroutine limits

   subroutine data_sheet()
      real(dp), parameter :: sheet(2) = [68.0_dp, 8.7_dp], thin(2) = [1.5_dp, 0.7_dp]
      real(dp) :: slope

      call is_close(kinematic_viscosity(40.0_dp, sheet), 68.0_dp, 1.0e-10_dp, "viscosity of the sheet at 40 degC")
      call is_close(kinematic_viscosity(100.0_dp, sheet), 8.7_dp, 1.0e-10_dp, "viscosity of the sheet at 100 degC")
      ! the inverse of Z in the standard is a fit
      call is_close(kinematic_viscosity(40.0_dp, thin), 1.5_dp, 1.0e-2_dp, "a thin oil at 40 degC")
      call is_close(kinematic_viscosity(100.0_dp, thin), 0.7_dp, 1.0e-2_dp, "a thin oil at 100 degC")
      ! Walther's line by hand: log10(log10(nu + 0.7)) against log10 T
      call is_close(log10(log10(kinematic_viscosity(60.0_dp, sheet) + 0.7_dp)), &
                    log10(log10(68.7_dp)) + (log10(log10(9.4_dp)) - log10(log10(68.7_dp))) &
                    *log10(333.15_dp/313.15_dp)/log10(373.15_dp/313.15_dp), 1.0e-12_dp, "Walther's line at 60 degC")
      call is_close(dynamic_viscosity(40.0_dp, sheet, 870.0_dp, 6.5e-4_dp), 68.0e-6_dp*870.0_dp*(1.0_dp - 25.0_dp*6.5e-4_dp), &
                    1.0e-14_dp, "viscosity in Pa s")
      slope = -log(kinematic_viscosity(60.5_dp, sheet)/kinematic_viscosity(59.5_dp, sheet))
      call is_close(temperature_viscosity(60.0_dp, sheet, 870.0_dp, 0.0_dp), slope, 1.0e-5_dp, "slope over a kelvin")
      call is_close(thermal_reduction(0.0_dp, 0.01_dp, 0.5_dp), 1.0_dp, 0.0_dp, "no loading, no reduction")
      call is_close(thermal_reduction(1.0_dp, 0.01_dp, 0.0_dp), (1.0_dp - 0.132_dp)/1.213_dp, 1.0e-14_dp, "pure rolling")
      call is_true(thermal_reduction(1.0_dp, 0.01_dp, -1.0_dp) < thermal_reduction(1.0_dp, 0.01_dp, 0.1_dp), &
                   "sliding of either sense heats the inlet")
   end subroutine data_sheet

   !> Exact limits of a semi-ellipsoidal heat source on a circle
   subroutine flash()
      real(dp), parameter :: flux = 1.0e8_dp, a = 2.0e-4_dp, k = 46.0_dp, kappa = 1.25e-5_dp, fast = 1.0e6_dp
      !> Maximum over s of the integral of sqrt(1 - x^2)/sqrt(s - x) over x from -1 to s, by quadrature
      real(dp), parameter :: integral = 2.18830_dp, both(2) = 1.0_dp, rest(2) = 0.0_dp

      call is_close(rise(rest, k*both)/(0.5_dp*flux*a/k), 1.5_dp*pi/4.0_dp, 2.0e-3_dp, "two surfaces at rest under the same heat")
      call is_close(rise(fast*both, k*both)/(0.75_dp*flux/k*sqrt(kappa*a/(pi*fast))*integral), 1.0_dp, 2.0e-3_dp, &
                    "two fast surfaces")
      call is_close(rise(fast*both, [k, 4.0_dp*k]), 0.4_dp*rise(fast*both, k*both), 1.0e-12_dp, "two materials")
      ! heat partition with equal maxima: 1/T is the sum of 1/T of each surface under all the heat
      call is_close(1.0_dp/rise([0.0_dp, fast], k*both), 0.5_dp/rise(rest, k*both) + 0.5_dp/rise(fast*both, k*both), 1.0e-10_dp, &
                    "heat partition")

   contains

      real(dp) function rise(speeds, conductivity)
         real(dp), intent(in) :: speeds(2), conductivity(2)
         rise = flash_temperature(flux, a, 1.0_dp, speeds, conductivity, kappa*both)
      end function rise
   end subroutine flash

   !> The maximum temperature of a row through the centre of an elliptical heat source is that of the formula, at any speed
   subroutine flash_of_rows()
      integer, parameter :: n = 2001
      real(dp), parameter :: a = 2.0e-4_dp, k = 46.0_dp, kappa = 1.25e-5_dp, flux = 1.0e8_dp, none = 1.0e-30_dp
      real(dp), parameter :: ratios(4) = [20.0_dp, 2.0_dp, 1.0_dp, 0.05_dp], turned(2) = [0.0_dp, 0.6_dp], &
                             speeds(3) = [0.0_dp, 0.5_dp, 50.0_dp]
      class(contact_t), allocatable :: contact
      type(wall_heat_t) :: walls
      real(dp) :: x(n), heat(n), source(2), strength, hottest, reach
      integer :: i, m, t, u

      do m = 1, size(ratios)
         do t = 1, merge(1, 2, m == 3)
            call new_contact(ratios(m), turned(t), contact)
            source = heat_source(contact)
            reach = 1.5_dp*source(1)
            x = [(reach*(2.0_dp*(i - 1)/(n - 1) - 1.0_dp), i=1, n)]
            call contact%pressure_row(x, 0.0_dp, heat)
            heat = 1.5_dp*flux*heat
            do u = 1, size(speeds)
               strength = wall_strength(speeds(u), k, kappa, speed_of_rest(contact), a, source(2))
               call walls%start(n, (x(2) - x(1))*a, [strength, strength])
               hottest = 0.0_dp
               do i = 2, n
                  hottest = max(hottest, walls%history(1, heat, 1, i - 1, i) + walls%own(1)*heat(i))
               end do
               call is_close(flash_temperature(flux, source(1)*a, source(2), [speeds(u), 0.0_dp], [k, none], [kappa, kappa]) &
                             /hottest, 1.0_dp, 1.5e-3_dp, "row and formula, R_x/R_y = "//to_text(ratios(m)))
            end do
         end do
      end do
   end subroutine flash_of_rows

   !> Downstream of the heat source two different walls tend to the same temperature, and the film has their mean
   subroutine walls_behind()
      integer, parameter :: n = 129
      type(level_t) :: level
      type(heated_t) :: found
      real(dp) :: pressure(n, 3), films(n, 3), apart(n)
      integer :: i

      level%grid = new_grid(n, 3, -1.0_dp, 3.0_dp, 1.0_dp, .false.)
      level%lubricant = new_lubricant(viscosity_barus, density_dowson_higginson, alpha_bar, hertz_pressure, 0.6_dp, 1.96e8_dp)
      level%lubricant%shear = shear_law_t(shear_limiting, 0.0_dp, 0.05_dp, 1.0_dp, scale, hertz_pressure)
      pressure = 0.0_dp
      pressure(9:40, :) = p
      films = h
      call heat_film(film_heat_t(2.0_dp, 0.14_dp, [1.0e-6_dp, 4.0e-6_dp], 1.0e-3_dp, 1.0e-5_dp), level%grid, level%lubricant, &
                     pressure, films, .true., 1, found)
      apart = found%rise(:, 2, 3) - found%rise(:, 2, 2)
      call is_true(apart(40) > 1.0_dp, "the wall that conducts less is hotter under the heat")
      call is_true(all(apart(60:) < apart(59:n - 1)) .and. apart(n) > 0.0_dp, "the difference of the walls decreases")
      do i = 45, n
         call is_close(found%rise(i, 2, 1)/(0.5_dp*sum(found%rise(i, 2, 2:))), 1.0_dp, 1.0e-12_dp, "film downstream of the heat")
      end do
   end subroutine walls_behind

   !> Uniform heat on a strip: 2 A q sqrt(x - x_1) downstream of its beginning, minus the same for its end
   subroutine strip()
      integer, parameter :: n = 65, first = 9, last = 40
      real(dp), parameter :: step = 1.0e-6_dp, strengths(2) = [2.0e-6_dp, 5.0e-6_dp], q = 3.0e8_dp
      type(wall_heat_t) :: walls
      real(dp) :: heat(n), expected, from_front, from_end
      integer :: i

      call walls%start(n, step, strengths)
      heat = 0.0_dp
      heat(first:last) = q
      do i = first + 1, n
         from_front = step*(i - first + 0.5_dp)
         from_end = step*(i - last - 0.5_dp)
         expected = 2.0_dp*strengths(2)*q*(sqrt(from_front) - sqrt(max(0.0_dp, from_end)))
         call is_close((walls%history(2, heat, first, min(i - 1, last), i) + walls%own(2)*merge(q, 0.0_dp, i <= last))/expected, &
                       1.0_dp, 1.0e-12_dp, "uniform heat on a strip, node "//to_text(i))
      end do
   end subroutine strip

   !> Equivalent speed of a wall at rest: on a circle that of Tian & Kennedy, lower in a wide contact, and proportional to the
   !> length along the motion for a potential at the centre
   subroutine speed_at_rest()
      class(contact_t), allocatable :: contact
      real(dp) :: wide

      call new_contact(1.0_dp, 0.0_dp, contact)
      call is_close(speed_of_rest(contact), 2.0_dp*1.234_dp, 2.0e-3_dp*2.468_dp, "a wall at rest, circle")
      call new_contact(0.05_dp, 0.0_dp, contact)
      wide = speed_of_rest(contact)
      call is_true(wide < 2.0_dp, "less conduction across the motion under a wide contact")
      call new_contact(0.05_dp, 0.5_dp*pi, contact)
      call is_close(speed_of_rest(contact)/contact%ellipticity, wide, 1.0e-9_dp*wide, "the same contact, turned")
   end subroutine speed_at_rest

   !> Heat into a wall: half of the heat between equal walls, more into the better conductor; T_2 - T_1 and the mean across
   !> the film by hand
   subroutine heat_in_proportion()
      type(wall_heat_t) :: walls
      type(heat_response_t) :: response
      real(dp), parameter :: film = 2.0e-7_dp, k = 0.14_dp, q = 2.0e8_dp, before(2) = [3.0_dp, 8.0_dp]
      real(dp) :: into(2), rise(2)

      call walls%start(9, 1.0e-6_dp, [3.0e-6_dp, 3.0e-6_dp])
      response = walls%response([7.0_dp, 7.0_dp], film, k)
      call is_close(response%difference(1) + response%difference(2)*q, 0.0_dp, 1.0e-6_dp, "equal walls receive the same heat")
      call is_close(response%film(1), 7.0_dp, 1.0e-12_dp, "the film between warm walls")
      call walls%start(9, 1.0e-6_dp, [1.0e-6_dp, 9.0e-6_dp])
      response = walls%response(before, film, k)
      into = 0.5_dp*(q + [1.0_dp, -1.0_dp]*(response%difference(1) + response%difference(2)*q))
      rise = before + walls%own*into
      call is_close((into(1) - 0.5_dp*q)/(k*(rise(2) - rise(1))/film), 1.0_dp, 1.0e-12_dp, "heat through the film")
      call is_close((response%film(1) + response%film(2)*q)/(0.5_dp*sum(rise) + q*film/(12.0_dp*k)), 1.0_dp, 1.0e-12_dp, &
                    "mean across the film")
      call is_true(into(1) > into(2), "the better conductor receives more")
   end subroutine heat_in_proportion

   !> A row of uniform pressure and film between walls of constant temperature: every node has the temperature of its own film,
   !> tau = tau_N exp(-beta q h/(12 k_f)) for a Newtonian lubricant of Barus, tau_N at the temperature of the inlet, q = tau u
   subroutine heated_film()
      real(dp), parameter :: beta = 0.04_dp, speed = 2.0_dp, conductivity = 0.14_dp, film = 1.0e-4_dp
      type(level_t) :: level
      type(heated_t) :: found
      real(dp) :: q, q0, w, pressure(33, 33), films(33, 33)
      integer :: k

      level%grid = new_grid(33, 33, -2.0_dp, 2.0_dp, 2.0_dp, .false.)
      level%lubricant = new_lubricant(viscosity_barus, density_dowson_higginson, alpha_bar, hertz_pressure, 0.6_dp, 1.96e8_dp, &
                                      beta)
      level%lubricant%shear = shear_law_t(shear_newtonian, 0.0_dp, 0.0_dp, 1.0_dp, scale, hertz_pressure)
      pressure = p
      films = h
      call heat_film(film_heat_t(speed, conductivity, [1.0e-20_dp, 1.0e-20_dp], 1.0e-3_dp, film), level%grid, level%lubricant, &
                     pressure, films, .true., 1, found)
      ! q exp(q w) = q0 by Newton's method
      q0 = newtonian*speed
      w = beta*h*film/(12.0_dp*conductivity)
      q = 0.0_dp
      do k = 1, 60
         q = q - (q - q0*exp(-w*q))/(1.0_dp + w*q0*exp(-w*q))
      end do
      call is_true(found%solved, "a film with frictional heating")
      call is_true(w*q > 0.5_dp, "the heating is significant")
      call is_close(found%ratio()*q0/q, 1.0_dp, 1.0e-7_dp, "friction of a film with frictional heating")
      call is_close(maxval(found%rise(:, :, 1))*beta/(w*q), 1.0_dp, 1.0e-7_dp, "its temperature")
      call is_close(found%max_rise(1)*beta/(w*q), 1.0_dp, 1.0e-7_dp, "its maximum temperature")
      level%lubricant = new_lubricant(viscosity_barus, density_dowson_higginson, alpha_bar, hertz_pressure, 0.6_dp, 1.96e8_dp)
      level%lubricant%shear = shear_law_t(shear_limiting, 0.0_dp, 0.05_dp, 1.0_dp, scale, hertz_pressure)
      pressure(20:24, :) = 0.0_dp
      call heat_film(film_heat_t(speed, conductivity, [1.0e-6_dp, 2.0e-6_dp], 1.0e-3_dp, film), level%grid, level%lubricant, &
                     pressure, films, .false., 2, found)
      call is_close(found%ratio(), 1.0_dp, 1.0e-7_dp, "a viscosity that does not depend on temperature")
      call is_true(found%max_rise(3) > found%max_rise(2) .and. .not. allocated(found%rise), "the wall that conducts less is hotter")
   end subroutine heated_film
end module test_friction

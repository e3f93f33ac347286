! SPDX-License-Identifier: BSD-3-Clause
!> Thermal effects: viscosity of an oil from its data sheet, shear heating of the inlet, flash temperature of the surfaces
module ehl_heat
   use ehl_kinds, only: dp, pi
   implicit none (type, external)
   private
   public :: kinematic_viscosity, dynamic_viscosity, temperature_viscosity, thermal_loading, thermal_reduction, &
             flash_temperature, raised_speed, zero_celsius, density_temperature, walther_t, new_walther

   !> 0 degC in kelvin; temperatures of the viscosities and of the density of data sheets [degC]
   real(dp), parameter :: zero_celsius = 273.15_dp, sheet(2) = [40.0_dp, 100.0_dp], density_temperature = 15.0_dp
   !> Power of the potential of a narrow contact in raised_speed, fitted to integrals over moving sources: error of the
   !> maximum rise 6 % for semi-axes across the motion of 1/15 to 30 times that along it, 1 % for a circle
   real(dp), parameter :: narrow = 0.38_dp

   !> Viscosity of a data sheet as a function of temperature: constants of the Walther line
   type :: walther_t
      private
      !> log T [ln K] and log log Z at the temperatures of the sheet
      real(dp) :: log_t(2) = 0.0_dp, double_log(2) = 0.0_dp
   contains
      procedure :: viscosity => viscosity_of_line
      procedure :: dynamic => dynamic_of_line
   end type walther_t

contains

   !> The line through kinematic viscosities at 40 and 100 degC [mm^2/s]: log log Z = A - B log T with Z(nu) of ASTM D341
   !> (Walther 1931: nu + 0.7), valid above 0.21 mm^2/s
   pure function new_walther(points) result(line)
      real(dp), intent(in) :: points(2)
      type(walther_t) :: line
      real(dp) :: z
      integer :: k

      do k = 1, 2
         line%log_t(k) = log(sheet(k) + zero_celsius)
         z = points(k) + 0.7_dp + exp(-1.47_dp - 1.84_dp*points(k) - 0.51_dp*points(k)**2)
         line%double_log(k) = log(log(z))
      end do
   end function new_walther

   !> Kinematic viscosity [mm^2/s] of a line at a temperature [degC]
   pure real(dp) function viscosity_of_line(line, temperature) result(viscosity)
      class(walther_t), intent(in) :: line
      real(dp), intent(in) :: temperature
      real(dp) :: z

      associate (log_t => line%log_t, double_log => line%double_log)
         z = exp(exp(double_log(1) + (double_log(2) - double_log(1))*(log(temperature + zero_celsius) - log_t(1)) &
                     /(log_t(2) - log_t(1)))) - 0.7_dp
      end associate
      viscosity = z - exp(-0.7487_dp - 3.295_dp*z + 0.6119_dp*z**2 - 0.3193_dp*z**3)
   end function viscosity_of_line

   !> Kinematic viscosity [mm^2/s] at a temperature [degC] from those at 40 and 100 degC
   pure real(dp) function kinematic_viscosity(temperature, points) result(viscosity)
      real(dp), intent(in) :: temperature, points(2)
      type(walther_t) :: line

      line = new_walther(points)
      viscosity = line%viscosity(temperature)
   end function kinematic_viscosity

   !> Viscosity [Pa s] at a temperature [degC]; density at 15 degC [kg/m^3], its relative decrease per kelvin
   pure real(dp) function dynamic_viscosity(temperature, points, density, expansion)
      real(dp), intent(in) :: temperature, points(2), density, expansion
      type(walther_t) :: line

      line = new_walther(points)
      dynamic_viscosity = line%dynamic(temperature, density, expansion)
   end function dynamic_viscosity

   !> Viscosity [Pa s] of a line; 0 where the linear density is not positive, at more than about 1000 degC, which only rough
   !> estimates of the heat reach
   pure real(dp) function dynamic_of_line(line, temperature, density, expansion) result(viscosity)
      class(walther_t), intent(in) :: line
      real(dp), intent(in) :: temperature, density, expansion

      viscosity = 1.0e-6_dp*line%viscosity(temperature)*density*max(0.0_dp, 1.0_dp - expansion*(temperature - density_temperature))
   end function dynamic_of_line

   !> Temperature-viscosity coefficient -(d eta/dT)/eta [1/K] of the same oil
   pure real(dp) function temperature_viscosity(temperature, points, density, expansion)
      real(dp), intent(in) :: temperature, points(2), density, expansion
      !> [K]; the relative error of the difference is about its square over 1e4 K^2
      real(dp), parameter :: step = 0.01_dp

      temperature_viscosity = log(dynamic_viscosity(temperature - step, points, density, expansion) &
                                  /dynamic_viscosity(temperature + step, points, density, expansion))/(2.0_dp*step)
   end function temperature_viscosity

   !> Thermal loading beta eta0 u^2/k [-]
   pure real(dp) function thermal_loading(coefficient, viscosity, velocity, conductivity)
      !> beta [1/K], eta0 [Pa s], mean velocity [m/s], conductivity of the oil [W/(m K)]
      real(dp), intent(in) :: coefficient, viscosity, velocity, conductivity
      thermal_loading = coefficient*viscosity*velocity**2/conductivity
   end function thermal_loading

   !> Film with shear heating of the inlet over the isothermal film: Gupta, Cheng, Zhu, Forster & Schrand 1992,
   !> Tribol. Trans. 35, 269. Not positive far outside its range.
   pure real(dp) function thermal_reduction(loading, pressure, slide_to_roll)
      !> Thermal loading [-], p_h/E' [-], slide-to-roll ratio [-]
      real(dp), intent(in) :: loading, pressure, slide_to_roll

      thermal_reduction = (1.0_dp - 13.2_dp*pressure*loading**0.42_dp) &
                          /(1.0_dp + 0.213_dp*(1.0_dp + 2.23_dp*abs(slide_to_roll)**0.83_dp)*loading**0.64_dp)
   end function thermal_reduction

   !> Maximum temperature rise [K] of two surfaces that move at `speeds` [m/s] through the semi-ellipsoidal heat source of a
   !> Hertz contact: Tian & Kennedy 1994, J. Tribol. 116, 167, for one surface and a circle; the heat partition equates both
   !> maxima (Blok 1937). On an ellipse the rise of a fast surface is that on a circle of the same
   !> length along the motion, and the rise of a surface at rest follows from the potential of the ellipse.
   pure real(dp) function flash_temperature(flux, half, potential, speeds, conductivity, diffusivity)
      !> Mean heat flux [W/m^2]; half the length of the contact along the motion, through its centre [m]; iint P/r at the
      !> centre over that of a circle of this radius [-], 1 for a circle; of the solids: conductivity [W/(m K)],
      !> diffusivity [m^2/s]
      real(dp), intent(in) :: flux, half, potential, speeds(2), conductivity(2), diffusivity(2)
      real(dp) :: peclet(2)

      peclet = abs(speeds)*half/(2.0_dp*diffusivity)
      ! on a circle each surface alone would have 2.32 flux half/(k sqrt(pi (1.234 + Pe)))
      flash_temperature = 2.32_dp*flux*half/sum(conductivity*sqrt(pi*raised_speed(peclet, 1.234_dp/potential**2, potential)))
   end function flash_temperature

   !> Speed at which heat conduction normal to the surface alone has the maximum temperature rise of conduction in all
   !> directions: from the speed of the surface and the equivalent one of a surface at rest. On a circle
   !> and a wide contact the two add up; in a narrow contact conduction across the motion matters at speeds at which conduction
   !> along it does not.
   elemental real(dp) function raised_speed(speed, rest, potential)
      !> Both speeds in any unit; iint P/r at the centre over that of a circle of the same length along the motion [-]
      real(dp), intent(in) :: speed, rest, potential
      real(dp) :: power

      power = min(1.0_dp, potential**narrow)
      raised_speed = rest + speed
      if (power < 1.0_dp) raised_speed = (rest**power + speed**power)**(1.0_dp/power)
   end function raised_speed
end module ehl_heat

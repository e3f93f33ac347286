! SPDX-License-Identifier: BSD-3-Clause
!> Laws of viscosity and density as functions of pressure and temperature
module test_lubricant
   use check, only: is_close, is_true
   use ehl_ambient_viscosity, only: ambient_viscosity_t, new_ambient_viscosity
   use ehl_density_law, only: density_law_t
   use ehl_dicke, only: new_dicke
   use ehl_doolittle, only: new_doolittle
   use ehl_kinds, only: dp
   use ehl_murnaghan, only: murnaghan_t, new_murnaghan
   use ehl_tait, only: new_tait, tait_t
   use ehl_viscosity_law, only: viscosity_law_t
   use ehl_viscosity_table, only: isotherm_t, new_isotherm, new_viscosity_table, viscosity_table_t
   use ehl_yasutomi, only: new_yasutomi
   use ehl_lubricant, only: density_dowson_higginson, lubricant_t, new_lubricant, viscosity_barus, viscosity_roelands
   implicit none (type, external)
   private
   public :: run_lubricant

contains

   subroutine run_lubricant()
      call classical_laws_under_temperature()
      call reference_oil()
      call glass()
      call bulk_modulus()
      call free_volume()
      call measured_values()
   end subroutine run_lubricant

   !> Properties of every law: correct slopes, eta0 at ambient pressure, the same bits for a zero temperature rise
   subroutine check_law(law, name)
      class(viscosity_law_t), intent(in) :: law
      character(len=*), intent(in) :: name
      real(dp), parameter :: small = 1.0e-5_dp, p(4) = [0.0_dp, 0.2_dp, 0.6_dp, 1.0_dp]
      real(dp), dimension(4) :: values, slope, below, above, at, unused

      call law%log_viscosity(p, values, slope)
      call law%log_viscosity(p - small, below, unused)
      call law%log_viscosity(p + small, above, unused)
      call law%log_viscosity_at(p, 0.0_dp*p, at)
      call is_close(values(1), 0.0_dp, 0.0_dp, name//": eta0 at ambient pressure")
      call is_close(maxval(abs((above - below)/(2.0_dp*small)/slope - 1.0_dp)), 0.0_dp, 1.0e-7_dp, name//": slope")
      call is_close(maxval(abs(at - values)), 0.0_dp, 0.0_dp, name//": no rise, no other viscosity")
   end subroutine check_law

   !> A pole between two pressures: finite below it, infinite above, also for a zero temperature rise
   subroutine check_solid(law, below, above, name)
      class(viscosity_law_t), intent(in) :: law
      real(dp), intent(in) :: below, above
      character(len=*), intent(in) :: name
      real(dp), dimension(3) :: values, slope, at

      call law%log_viscosity([below, above, 3.0_dp*above], values, slope)
      call law%log_viscosity_at([below, above, 3.0_dp*above], [0.0_dp, 0.0_dp, 0.0_dp], at)
      call is_true(values(1) > 20.0_dp .and. values(1) < huge(1.0_dp), name//" below its pole")
      call is_true(all(values(2:) > huge(1.0_dp)) .and. all(at(2:) > huge(1.0_dp)), name//" above its pole")
      call is_true(all(abs(slope(2:)) <= 0.0_dp), name//" does not change there")
   end subroutine check_solid

   !> FVA 3 with Table A1 of Wingertszahn et al. 2023, by hand at 40 and 60 degC and 1 GPa
   subroutine reference_oil()
      real(dp), parameter :: a(2) = [327.7918e5_dp, 2.9862e5_dp], b(2) = [4.419e-3_dp, 3.0115e-4_dp]
      type(ambient_viscosity_t) :: ambient
      real(dp) :: values(2)

      ambient = new_ambient_viscosity([0.062e-3_dp, 1021.7_dp, 101.5517_dp], [0.0_dp, 0.0_dp], 870.0_dp, 6.5e-4_dp)
      associate (law => new_dicke(ambient, a, b, 1.0e9_dp, 40.0_dp))
         call check_law(law, "dicke")
         call is_close(law%ambient_viscosity, 0.0845_dp, 1.0e-4_dp, "FVA 3 at 40 degC [Pa s]")
         call law%log_viscosity_at([1.0_dp, 1.0_dp], [0.0_dp, 20.0_dp], values)
         ! 1e9/(447.2398e5 + 0.016465e9) = 16.342, 1e9/(506.9638e5 + 0.022488e9) + 1021.7 (1/161.5517 - 1/141.5517) = 12.770
         call is_close(values(1), 16.3430_dp, 1.0e-3_dp, "FVA 3 at 1 GPa and 40 degC")
         call is_close(values(2), 12.7706_dp, 1.0e-3_dp, "FVA 3 at 1 GPa and 60 degC")
      end associate
      ! a data sheet in place of Vogel's constants
      ambient = new_ambient_viscosity([0.0_dp, 0.0_dp, 0.0_dp], [94.1_dp, 14.0_dp], 840.0_dp, 6.5e-4_dp)
      associate (law => new_dicke(ambient, a, b, 1.0e9_dp, 40.0_dp))
         call check_law(law, "dicke with a data sheet")
         call is_close(law%ambient_viscosity, 94.1e-6_dp*840.0_dp*(1.0_dp - 25.0_dp*6.5e-4_dp), 1.0e-12_dp, "data sheet")
      end associate
      ! a pole at 447.2398e5/0.02 Pa
      associate (law => new_dicke(ambient, a, [-0.02_dp, 0.0_dp], 1.0e9_dp, 40.0_dp))
         call check_law(law, "dicke with a pole")
         call check_solid(law, 2.23_dp, 2.24_dp, "dicke")
      end associate
   end subroutine reference_oil

   !> At the glass transition temperature the viscosity is that of the glass at any pressure
   subroutine glass()
      real(dp) :: values(1)

      associate (law => new_yasutomi(-83.2_dp, 188.86_dp, 0.719e-9_dp, 8.2e-9_dp, -0.5278_dp, 16.09_dp, 17.38_dp, 1.0e12_dp, &
                                     1.0e9_dp, 40.0_dp))
         call check_law(law, "yasutomi")
         call law%log_viscosity_at([1.0_dp], [-83.2_dp + 188.86_dp*log(1.719_dp) - 40.0_dp], values)
         call is_close(law%ambient_viscosity*exp(values(1)), 1.0e12_dp, 1.0e3_dp, "viscosity of the glass")
         call check_solid(law, 2.0_dp, 4.0_dp, "yasutomi")
      end associate
   end subroutine glass

   !> dp/d(ln rho) at ambient pressure is the bulk modulus, and increases by K0' with pressure
   subroutine bulk_modulus()
      real(dp), parameter :: hertz = 1.0e9_dp, k0 = 9.234e9_dp*exp(-6.09e-3_dp*313.15_dp), step = 1.0e-6_dp
      type(murnaghan_t) :: law
      type(tait_t) :: volume
      real(dp), dimension(3) :: rho, slope, at, modulus

      law = new_murnaghan(9.234e9_dp, 10.545_dp, 6.09e-3_dp, 7.0e-4_dp, hertz, 313.15_dp)
      call law%density([0.0_dp, 0.5_dp, 1.0_dp], rho, slope)
      modulus = rho/slope*hertz
      call is_close(rho(1), 1.0_dp, 0.0_dp, "Murnaghan at ambient pressure")
      call is_close(maxval(abs(modulus - k0 - 10.545_dp*[0.0_dp, 0.5_dp, 1.0_dp]*hertz)/k0), 0.0_dp, 1.0e-13_dp, &
                    "bulk modulus under pressure")
      call check_density(law, "Murnaghan")
      ! for Tait it is [K0 + (1 + K0') p] times the volume, so that its slope is K0' at ambient pressure
      volume = new_tait(9.234e9_dp, 10.545_dp, 6.09e-3_dp, 8.0e-4_dp, 298.15_dp, hertz, 313.15_dp)
      call volume%density([0.0_dp, step, 1.0_dp], rho, slope)
      modulus = rho/slope*hertz
      call is_close(modulus(1)/k0, 1.0_dp, 1.0e-13_dp, "bulk modulus of Tait's liquid at ambient pressure")
      call is_close((modulus(2) - modulus(1))/(step*hertz), 10.545_dp, 1.0e-3_dp, "its rate with pressure")
      call is_close(rho(3), 1.0_dp/(1.0_dp - log(1.0_dp + 11.545_dp*hertz/k0)/11.545_dp), 1.0e-13_dp, "Tait at 1 GPa")
      call volume%density_at([0.0_dp, 0.0_dp, 0.0_dp], [-15.0_dp, 0.0_dp, 60.0_dp], at)
      call is_close(maxval(abs(1.0_dp/at - [1.0_dp, 1.012_dp, 1.06_dp]/1.012_dp)), 0.0_dp, 1.0e-14_dp, "volume by temperature")
      call check_density(volume, "Tait")
   end subroutine bulk_modulus

   !> Properties of every density law: correct slope, rho0 at ambient pressure, the same bits for a zero temperature rise
   subroutine check_density(law, name)
      class(density_law_t), intent(in) :: law
      character(len=*), intent(in) :: name
      real(dp), parameter :: step = 1.0e-6_dp
      real(dp), dimension(3) :: rho, slope, at, unused

      call law%density([0.0_dp, 0.5_dp, 1.0_dp], rho, slope)
      call is_close(rho(1), 1.0_dp, 0.0_dp, name//": rho0 at ambient pressure")
      call law%density([0.5_dp - step, 0.5_dp, 0.5_dp + step], at, unused)
      call is_close((at(3) - at(1))/(2.0_dp*step)/slope(2), 1.0_dp, 1.0e-8_dp, name//": slope of the density")
      call law%density_at([0.0_dp, 0.5_dp, 1.0_dp], [0.0_dp, 0.0_dp, 0.0_dp], at)
      call is_close(maxval(abs(at - rho)), 0.0_dp, 0.0_dp, name//": no rise, no other density")
   end subroutine check_density

   !> Doolittle: Vogel's law at ambient pressure with a constant occupied volume, the pole where the free volume vanishes
   subroutine free_volume()
      real(dp), parameter :: eta = 0.02_dp, b = 4.5_dp, r0 = 0.66_dp, expansion = 8.0e-4_dp, reference = 313.15_dp, &
                             inlet = 333.15_dp, rise(3) = [-40.0_dp, 10.0_dp, 80.0_dp], zero(3) = 0.0_dp
      real(dp) :: values(3), vogel(3), solid
      type(tait_t) :: state

      state = new_tait(9.0e9_dp, 11.0_dp, 6.0e-3_dp, expansion, reference, 1.0e9_dp, inlet)
      associate (law => new_doolittle(eta, b, r0, 0.0_dp, reference, state, inlet))
         call check_law(law, "doolittle")
         vogel = b*r0/expansion/(inlet + rise - reference + (1.0_dp - r0)/expansion) - b*r0/(1.0_dp - r0)
         call law%log_viscosity_at(zero, rise, values)
         call is_close(maxval(abs(log(law%ambient_viscosity/eta) + values - vogel)), 0.0_dp, 1.0e-12_dp, "Doolittle as Vogel")
      end associate
      associate (law => new_doolittle(eta, b, r0, -7.5e-4_dp, reference, state, inlet))
         call check_law(law, "doolittle with an occupied volume that changes")
         ! V/V_R = 1.016 (1 - ln[1 + 12 p/K0]/12) is the occupied 0.66 (1 - 0.015) there
         solid = 9.0_dp*exp(-6.0e-3_dp*inlet)/12.0_dp*(exp(12.0_dp*(1.0_dp - 0.6501_dp/1.016_dp)) - 1.0_dp)
         call check_solid(law, solid*(1.0_dp - 1.0e-9_dp), solid*(1.0_dp + 1.0e-9_dp), "doolittle")
      end associate
      ! the volume with another reference temperature is the same liquid
      state = new_tait(9.0e9_dp, 11.0_dp, 6.0e-3_dp, expansion/(1.0_dp - 20.0_dp*expansion), reference - 20.0_dp, 1.0e9_dp, inlet)
      associate (law => new_doolittle(eta, b, r0, 0.0_dp, reference, state, inlet))
         call law%log_viscosity_at(zero, rise, values)
         call is_close(maxval(abs(log(law%ambient_viscosity/eta) + values - vogel)), 0.0_dp, 1.0e-12_dp, &
                       "Doolittle by another reference of the volume")
      end associate
   end subroutine free_volume

   !> A table of values: exact at its pressures, monotonic between them, linear beyond them
   subroutine measured_values()
      real(dp), parameter :: p(4) = [0.0_dp, 1.0e8_dp, 4.0e8_dp, 5.0e8_dp], eta(4) = [0.1_dp, 0.9_dp, 1.0_dp, 80.0_dp]
      type(isotherm_t) :: isotherms(2)
      type(viscosity_table_t) :: law
      real(dp) :: values(200), at(4), slope(200), rise(4)
      integer :: k

      isotherms = [new_isotherm(313.15_dp, p, eta), new_isotherm(373.15_dp, p, 0.1_dp*eta)]
      law = new_viscosity_table(isotherms, 1.0e9_dp, 313.15_dp, 0.0_dp)
      call law%log_viscosity_at(p/1.0e9_dp, 0.0_dp*p, at)
      call is_close(maxval(abs(at - log(eta/0.1_dp))), 0.0_dp, 1.0e-12_dp, "a table at its pressures")
      call law%log_viscosity([(0.6_dp*k/200, k=1, 200)], values, slope)
      call is_true(maxval(values(2:) - values(:199)) < 0.2_dp, "a table has no jumps")
      call is_true(minval(values(2:) - values(:199)) > 0.0_dp, "a table increases with pressure")
      call is_close(values(200) - values(199), slope(200)*0.003_dp, 1.0e-12_dp, "linear beyond the table")
      rise = 60.0_dp
      call law%log_viscosity_at(p/1.0e9_dp, rise, at)
      call is_close(maxval(abs(at - log(eta))), 0.0_dp, 1.0e-12_dp, "a table at its other temperature")
      rise = 1.0_dp/(0.5_dp/313.15_dp + 0.5_dp/373.15_dp) - 313.15_dp
      call law%log_viscosity_at(p/1.0e9_dp, rise, at)
      call is_close(maxval(abs(at - log(eta/0.1_dp) + 0.5_dp*log(10.0_dp))), 0.0_dp, 1.0e-12_dp, &
                    "linear in 1/T between temperatures")
   end subroutine measured_values

   !> Roelands' viscosity compared with his original form, ln eta + 9.67; slopes; the same bits for a zero temperature rise
   subroutine classical_laws_under_temperature()
      real(dp), parameter :: eta0 = 0.04_dp, alpha = 2.2e-8_dp, beta = 0.04_dp, inlet = 313.15_dp, p0 = 1.96e8_dp
      real(dp), parameter :: hertz = 1.66e9_dp, warm = 60.0_dp, small = 1.0e-4_dp
      real(dp), parameter :: p(3) = [0.0_dp, 0.37_dp, 1.1_dp]
      real(dp), dimension(3) :: at, slope, rho, rho_at
      real(dp) :: z, s0
      type(lubricant_t) :: oil
      integer :: law

      z = alpha*p0/(log(eta0) + 9.67_dp)
      s0 = beta*(inlet - 138.0_dp)/(log(eta0) + 9.67_dp)
      do law = viscosity_barus, viscosity_roelands
         oil = new_lubricant(law, density_dowson_higginson, alpha*hertz, hertz, z, p0, beta, 6.5e-4_dp, inlet)
         call check_law(oil%viscosity, merge("barus   ", "roelands", law == viscosity_barus))
         call oil%log_viscosity_at([0.0_dp, 0.0_dp, 0.0_dp], [-small, small, 0.0_dp], at)
         call is_close((at(1) - at(2))/(2.0_dp*small), beta, 1.0e-8_dp, "beta at ambient pressure")
         call check_density(oil%compression, "Dowson & Higginson")
         call oil%density(p, rho, slope)
         call is_close(maxval(abs(rho - (5.9e8_dp + 1.34_dp*p*hertz)/(5.9e8_dp + p*hertz))), 0.0_dp, 1.0e-15_dp, "density")
         call oil%density_at(p, [warm, warm, warm], rho_at)
         call is_close(maxval(abs(rho_at/rho - (1.0_dp - 6.5e-4_dp*warm))), 0.0_dp, 1.0e-15_dp, "expansion")
      end do
      call oil%log_viscosity_at(p, [warm, warm, warm], at)
      call is_close(maxval(abs(at + log(eta0) + 9.67_dp - (log(eta0) + 9.67_dp)*(1.0_dp + p*hertz/p0)**z &
                               *((inlet + warm - 138.0_dp)/(inlet - 138.0_dp))**(-s0))), 0.0_dp, 1.0e-12_dp, &
                    "Roelands' original form")
   end subroutine classical_laws_under_temperature
end module test_lubricant

! SPDX-License-Identifier: BSD-3-Clause
!> Laws of viscosity and density under pressure and temperature
module test_lubricant
   use check, only: is_close
   use ehl_kinds, only: dp
   use ehl_lubricant, only: density_dowson_higginson, lubricant_t, new_lubricant, viscosity_barus, viscosity_roelands
   implicit none (type, external)
   private
   public :: run_lubricant

contains

   subroutine run_lubricant()
      call classical_laws_under_temperature()
   end subroutine run_lubricant

   !> Roelands' viscosity against his own form, ln eta + 9.67; slopes; the same bits without a rise of temperature
   subroutine classical_laws_under_temperature()
      real(dp), parameter :: eta0 = 0.04_dp, alpha = 2.2e-8_dp, beta = 0.04_dp, inlet = 313.15_dp, p0 = 1.96e8_dp
      real(dp), parameter :: hertz = 1.66e9_dp, warm = 60.0_dp, small = 1.0e-4_dp
      real(dp), parameter :: p(3) = [0.0_dp, 0.37_dp, 1.1_dp]
      real(dp), dimension(3) :: cold, at, slope, rho, rho_at
      real(dp) :: z, s0
      type(lubricant_t) :: oil
      integer :: law

      z = alpha*p0/(log(eta0) + 9.67_dp)
      s0 = beta*(inlet - 138.0_dp)/(log(eta0) + 9.67_dp)
      do law = viscosity_barus, viscosity_roelands
         oil = new_lubricant(law, density_dowson_higginson, alpha*hertz, hertz, z, p0, beta, 6.5e-4_dp, inlet)
         call oil%log_viscosity(p, cold, slope)
         call oil%log_viscosity_at(p, [0.0_dp, 0.0_dp, 0.0_dp], at)
         call is_close(maxval(abs(at - cold)), 0.0_dp, 0.0_dp, "no rise, no other viscosity")
         call oil%log_viscosity_at([0.0_dp, 0.0_dp, 0.0_dp], [-small, small, 0.0_dp], at)
         call is_close((at(1) - at(2))/(2.0_dp*small), beta, 1.0e-8_dp, "beta at ambient pressure")
         call oil%density(p, rho, slope)
         call oil%density_at(p, [0.0_dp, 0.0_dp, 0.0_dp], rho_at)
         call is_close(maxval(abs(rho_at - rho)), 0.0_dp, 0.0_dp, "no rise, no other density")
         call oil%density_at(p, [warm, warm, warm], rho_at)
         call is_close(maxval(abs(rho_at/rho - (1.0_dp - 6.5e-4_dp*warm))), 0.0_dp, 1.0e-15_dp, "expansion")
      end do
      call oil%log_viscosity_at(p, [warm, warm, warm], at)
      call is_close(maxval(abs(at + log(eta0) + 9.67_dp - (log(eta0) + 9.67_dp)*(1.0_dp + p*hertz/p0)**z &
                               *((inlet + warm - 138.0_dp)/(inlet - 138.0_dp))**(-s0))), 0.0_dp, 1.0e-12_dp, &
                    "Roelands' original form")
   end subroutine classical_laws_under_temperature
end module test_lubricant

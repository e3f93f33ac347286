! SPDX-License-Identifier: BSD-3-Clause
!> Density by the equation of state of Tait, as Bair 2007 writes it for lubricants:
!>
!>    V/V_R = [1 + a_V (T - T_R)] {1 - ln[1 + (1 + K0') p/K0]/(1 + K0')},   K0 = K00 exp(-beta_K T) with T in K
!>
!> V_R is the volume at T_R and ambient pressure.
module ehl_tait
   use ehl_density_law, only: density_law_t
   use ehl_kinds, only: dp
   implicit none (type, external)
   private
   public :: tait_t, new_tait

   type, extends(density_law_t) :: tait_t
      private
      !> 1 + K0' (K0': derivative of the bulk modulus with respect to pressure), and K0/p_h at the temperature of the inlet
      real(dp) :: rate = 1.0_dp, modulus = 1.0_dp
      !> beta_K and a_V [1/K]
      real(dp) :: softening = 0.0_dp, expansion = 0.0_dp
      !> T - T_R [K] and V/V_R at ambient pressure and the temperature of the inlet
      real(dp) :: above = 0.0_dp, ambient = 1.0_dp
   contains
      procedure :: density
      procedure :: density_at
      procedure :: volume
      procedure :: volume_slope
   end type tait_t

contains

   !> The law from K00 [Pa], K0', beta_K [1/K], a_V [1/K], T_R [K], the Hertz pressure [Pa] and the temperature of the inlet [K]
   pure function new_tait(modulus, rate, softening, expansion, reference, hertz_pressure, temperature) result(law)
      real(dp), intent(in) :: modulus, rate, softening, expansion, reference, hertz_pressure, temperature
      type(tait_t) :: law

      law%rate = 1.0_dp + rate
      law%softening = softening
      law%expansion = expansion
      law%modulus = modulus*exp(-softening*temperature)/hertz_pressure
      law%above = temperature - reference
      law%ambient = 1.0_dp + expansion*law%above
   end function new_tait

   !> V/V_R at a pressure over the Hertz pressure and a temperature rise above the inlet [K]
   elemental real(dp) function volume(self, p, rise)
      class(tait_t), intent(in) :: self
      real(dp), intent(in) :: p, rise

      volume = (1.0_dp + self%expansion*(self%above + rise)) &
               *(1.0_dp - log(1.0_dp + self%rate*p/(self%modulus*exp(-self%softening*rise)))/self%rate)
   end function volume

   !> Derivative of V/V_R with respect to the pressure at the temperature of the inlet
   elemental real(dp) function volume_slope(self, p)
      class(tait_t), intent(in) :: self
      real(dp), intent(in) :: p

      volume_slope = -self%ambient/(self%modulus + self%rate*p)
   end function volume_slope

   !> rho/rho0 at the temperature of the inlet, and its derivative with respect to p
   pure subroutine density(self, p, rho, slope)
      class(tait_t), intent(in) :: self
      real(dp), intent(in) :: p(:)
      real(dp), intent(out) :: rho(:), slope(:)
      integer :: i

      do i = 1, size(p)
         rho(i) = self%ambient/self%volume(p(i), 0.0_dp)
         slope(i) = -rho(i)*rho(i)*self%volume_slope(p(i))/self%ambient
      end do
   end subroutine density

   !> rho/rho0 at temperature rises above the inlet [K]
   pure subroutine density_at(self, p, rise, rho)
      class(tait_t), intent(in) :: self
      real(dp), intent(in) :: p(:), rise(:)
      real(dp), intent(out) :: rho(:)

      rho = self%ambient/self%volume(p, rise)
   end subroutine density_at
end module ehl_tait

! SPDX-License-Identifier: BSD-3-Clause
!> Viscosity by Roelands 1966:
!>
!>    ln(eta/eta0) = A {(1 + p/p0)^z [(T - 138 K)/(T0 - 138 K)]^(-S0) - 1},   A = alpha p0/z,   S0 = beta (T0 - 138 K)/A
!>
!> If z follows from alpha, A is ln(eta0/Pa s) + 9.67.
module ehl_roelands
   use ehl_kinds, only: dp
   use ehl_viscosity_law, only: viscosity_law_t
   implicit none (type, external)
   private
   public :: roelands_t, new_roelands

   !> Temperature origin of the law [K]
   real(dp), parameter :: temperature_origin = 138.0_dp

   !> In Hertz units: z, p0/p_h, A and alpha p_h; S0 and T0 - 138 K
   type, extends(viscosity_law_t) :: roelands_t
      private
      real(dp) :: z = 1.0_dp, p0 = 1.0_dp, prefactor = 0.0_dp, alpha_bar = 0.0_dp
      real(dp) :: s0 = 0.0_dp, reference = 1.0_dp
   contains
      procedure :: log_viscosity
      procedure :: log_viscosity_at
   end type roelands_t

contains

   !> The law from alpha p_h, p0/p_h and z; beta = -(d eta/dT)/eta [1/K] at ambient pressure and the temperature of the inlet
   !> T0 [K]
   pure function new_roelands(alpha_bar, p0, z, beta, temperature) result(law)
      real(dp), intent(in) :: alpha_bar, p0, z, beta, temperature
      type(roelands_t) :: law

      law%alpha_bar = alpha_bar
      law%z = z
      law%p0 = p0
      law%prefactor = alpha_bar*law%p0/z
      law%reference = temperature - temperature_origin
      if (law%prefactor > 0.0_dp) law%s0 = beta*law%reference/law%prefactor
   end function new_roelands

   !> ln(eta/eta0) at the temperature of the inlet, and its derivative with respect to p
   pure subroutine log_viscosity(self, p, values, slope)
      class(roelands_t), intent(in) :: self
      real(dp), intent(in) :: p(:)
      real(dp), intent(out) :: values(:), slope(:)
      real(dp) :: scale, power
      integer :: i

      scale = 1.0_dp/self%p0
      do i = 1, size(p)
         power = exp(self%z*log(1.0_dp + p(i)*scale))
         values(i) = self%prefactor*(power - 1.0_dp)
         slope(i) = self%alpha_bar*power/(1.0_dp + p(i)*scale)
      end do
   end subroutine log_viscosity

   !> ln(eta/eta0) at temperature rises above the inlet [K]
   pure subroutine log_viscosity_at(self, p, rise, values)
      class(roelands_t), intent(in) :: self
      real(dp), intent(in) :: p(:), rise(:)
      real(dp), intent(out) :: values(:)
      real(dp) :: scale, power
      integer :: i

      scale = 1.0_dp/self%p0
      do i = 1, size(p)
         power = exp(self%z*log(1.0_dp + p(i)*scale))
         values(i) = self%prefactor*(power*exp(-self%s0*log(1.0_dp + rise(i)/self%reference)) - 1.0_dp)
      end do
   end subroutine log_viscosity_at
end module ehl_roelands

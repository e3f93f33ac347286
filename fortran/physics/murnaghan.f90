! SPDX-License-Identifier: BSD-3-Clause
!> Density by Murnaghan 1944:
!>
!>    rho/rho(T) = (1 + K0' p/K0)^(1/K0'),   K0 = K00 exp(-beta_K T) with T in K
!>
!> with a density rho(T) at ambient pressure that is linear in temperature
module ehl_murnaghan
   use ehl_density_law, only: density_law_t
   use ehl_kinds, only: dp
   implicit none (type, external)
   private
   public :: murnaghan_t, new_murnaghan

   type, extends(density_law_t) :: murnaghan_t
      private
      !> K0', the derivative of the bulk modulus with respect to pressure, and K0/p_h at the temperature of the inlet
      real(dp) :: rate = 1.0_dp, modulus = 1.0_dp
      !> beta_K and relative decrease of the density with temperature [1/K]
      real(dp) :: softening = 0.0_dp, expansion = 0.0_dp
   contains
      procedure :: density
      procedure :: density_at
   end type murnaghan_t

contains

   !> The law from K00 [Pa], K0', beta_K [1/K], the thermal expansion [1/K], the Hertz pressure [Pa] and the temperature of the
   !> inlet [K]
   pure function new_murnaghan(modulus, rate, softening, expansion, hertz_pressure, temperature) result(law)
      real(dp), intent(in) :: modulus, rate, softening, expansion, hertz_pressure, temperature
      type(murnaghan_t) :: law

      law%rate = rate
      law%softening = softening
      law%expansion = expansion
      law%modulus = modulus*exp(-softening*temperature)/hertz_pressure
   end function new_murnaghan

   !> rho/rho0 at the temperature of the inlet, and its derivative with respect to p
   pure subroutine density(self, p, rho, slope)
      class(murnaghan_t), intent(in) :: self
      real(dp), intent(in) :: p(:)
      real(dp), intent(out) :: rho(:), slope(:)
      real(dp) :: stiffening
      integer :: i

      do i = 1, size(p)
         stiffening = 1.0_dp + self%rate*p(i)/self%modulus
         rho(i) = exp(log(stiffening)/self%rate)
         slope(i) = rho(i)/(stiffening*self%modulus)
      end do
   end subroutine density

   !> rho/rho0 at temperature rises above the inlet [K]
   pure subroutine density_at(self, p, rise, rho)
      class(murnaghan_t), intent(in) :: self
      real(dp), intent(in) :: p(:), rise(:)
      real(dp), intent(out) :: rho(:)
      integer :: i

      do i = 1, size(p)
         rho(i) = exp(log(1.0_dp + self%rate*p(i)/(self%modulus*exp(-self%softening*rise(i))))/self%rate) &
                  *(1.0_dp - self%expansion*rise(i))
      end do
   end subroutine density_at
end module ehl_murnaghan

! SPDX-License-Identifier: BSD-3-Clause
!> Viscosity and density of the lubricant as functions of pressure, row by row so that the
!> choice of law is made once per row and the loops vectorise
module ehl_lubricant
   use ehl_kinds, only: dp
   use ehl_shear, only: shear_law_t
   implicit none (type, external)
   private
   public :: lubricant_t, new_lubricant
   public :: viscosity_barus, viscosity_roelands, density_constant, density_dowson_higginson

   integer, parameter :: viscosity_barus = 1, viscosity_roelands = 2
   integer, parameter :: density_constant = 1, density_dowson_higginson = 2

   !> Pressure [Pa] and stiffening of the Dowson-Higginson density
   real(dp), parameter :: dowson_pressure = 5.9e8_dp, dowson_limit = 1.34_dp

   !> Lubricant in Hertz units: pressures are scaled by p_h, viscosity by eta0, density by rho0
   type :: lubricant_t
      integer :: viscosity_law = viscosity_roelands
      integer :: density_law = density_dowson_higginson
      !> alpha p_h
      real(dp) :: alpha_bar = 0.0_dp
      !> Roelands exponent z, reference pressure p0/p_h and prefactor alpha p0/z
      real(dp) :: z = 0.0_dp, p0 = 1.0_dp, prefactor = 0.0_dp
      !> Dowson-Higginson pressure 5.9e8 Pa/p_h
      real(dp) :: d0 = 1.0_dp
      !> Shear stress, for friction alone
      type(shear_law_t) :: shear
   contains
      procedure :: log_viscosity
      procedure :: density
   end type lubricant_t

contains

   !> Lubricant for a contact
   pure function new_lubricant(viscosity_law, density_law, alpha_bar, hertz_pressure, z, &
                               roelands_p0) result(lubricant)
      integer, intent(in) :: viscosity_law, density_law
      real(dp), intent(in) :: alpha_bar
      !> Hertz pressure and Roelands reference pressure [Pa]; a Hertz pressure of 0 (L = 0)
      !> means a lubricant of constant viscosity and density
      real(dp), intent(in) :: hertz_pressure, roelands_p0
      real(dp), intent(in) :: z
      type(lubricant_t) :: lubricant

      lubricant%alpha_bar = alpha_bar
      lubricant%z = z
      if (hertz_pressure <= 0.0_dp) then
         lubricant%viscosity_law = viscosity_barus
         lubricant%density_law = density_constant
         return
      end if
      lubricant%viscosity_law = viscosity_law
      lubricant%density_law = density_law
      lubricant%p0 = roelands_p0/hertz_pressure
      lubricant%prefactor = alpha_bar*lubricant%p0/z
      lubricant%d0 = dowson_pressure/hertz_pressure
   end function new_lubricant

   !> ln(eta/eta0) at pressures p, and its slope in P.
   !> Roelands: (alpha p0/z) (-1 + (1 + p/p0)^z); Barus: alpha p
   pure subroutine log_viscosity(self, p, values, slope)
      class(lubricant_t), intent(in) :: self
      real(dp), intent(in) :: p(:)
      real(dp), intent(out) :: values(:), slope(:)
      real(dp) :: scale, power
      integer :: i

      if (self%viscosity_law == viscosity_barus) then
         values = self%alpha_bar*p
         slope = self%alpha_bar
      else
         scale = 1.0_dp/self%p0
         do i = 1, size(p)
            power = exp(self%z*log(1.0_dp + p(i)*scale))
            values(i) = self%prefactor*(power - 1.0_dp)
            slope(i) = self%alpha_bar*power/(1.0_dp + p(i)*scale)
         end do
      end if
   end subroutine log_viscosity

   !> Density rho/rho0 = (5.9e8 + 1.34 p)/(5.9e8 + p) at pressures p, and its slope in P
   pure subroutine density(self, p, rho, slope)
      class(lubricant_t), intent(in) :: self
      real(dp), intent(in) :: p(:)
      real(dp), intent(out) :: rho(:), slope(:)
      real(dp) :: inverse
      integer :: i

      if (self%density_law == density_constant) then
         rho = 1.0_dp
         slope = 0.0_dp
      else
         do i = 1, size(p)
            inverse = 1.0_dp/(self%d0 + p(i))
            rho(i) = (self%d0 + dowson_limit*p(i))*inverse
            slope(i) = (dowson_limit - 1.0_dp)*self%d0*inverse*inverse
         end do
      end if
   end subroutine density
end module ehl_lubricant

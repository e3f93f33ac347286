! SPDX-License-Identifier: BSD-3-Clause
!> The lubricant: viscosity and density as functions of pressure and temperature, and shear stress
module ehl_lubricant
   use ehl_barus, only: barus_t
   use ehl_density_law, only: density_law_t
   use ehl_kinds, only: dp
   use ehl_roelands, only: new_roelands
   use ehl_shear, only: shear_law_t
   use ehl_simple_density, only: incompressible_t, new_dowson_higginson
   use ehl_viscosity_law, only: viscosity_law_t
   implicit none (type, external)
   private
   public :: lubricant_t, new_lubricant
   public :: viscosity_barus, viscosity_roelands, density_constant, density_dowson_higginson

   integer, parameter :: viscosity_barus = 1, viscosity_roelands = 2
   integer, parameter :: density_constant = 1, density_dowson_higginson = 2

   !> Lubricant in Hertz units: pressures are scaled by p_h, viscosity by eta0, density by rho0
   type :: lubricant_t
      class(viscosity_law_t), allocatable :: viscosity
      class(density_law_t), allocatable :: compression
      !> Shear stress
      type(shear_law_t) :: shear
      !> Boundary film H_b at P = 0 [a^2/R]; 0: none
      real(dp) :: boundary_film = 0.0_dp
      !> Its shear stress at P = 1 over the Newtonian stress of eta = eta0 and H = 1; 0: not given, or no sliding
      real(dp) :: boundary_stress = 0.0_dp
      !> Hardness of the solids, the maximum pressure between them; 0: no limit
      real(dp) :: boundary_limit = 0.0_dp
   contains
      procedure :: log_viscosity
      procedure :: initial_slope
      procedure :: log_viscosity_at
      procedure :: density
      procedure :: density_at
   end type lubricant_t

contains

   !> Lubricant with the viscosity of Barus or Roelands, and constant density or that of Dowson & Higginson
   function new_lubricant(viscosity_law, density_law, alpha_bar, hertz_pressure, z, roelands_p0, beta, expansion, &
                          temperature) result(lubricant)
      integer, intent(in) :: viscosity_law, density_law
      !> alpha p_h
      real(dp), intent(in) :: alpha_bar
      !> Hertz pressure, 0 if alpha p_h is 0 and the size of the contact is not known, and Roelands reference pressure [Pa];
      !> without a Hertz pressure the density, and with alpha p_h = 0 the viscosity, does not depend on pressure
      real(dp), intent(in) :: hertz_pressure, roelands_p0
      real(dp), intent(in) :: z
      !> beta = -(d eta/dT)/eta and thermal expansion [1/K], absent: 0; temperature of the inlet [K], absent: 313.15
      real(dp), intent(in), optional :: beta, expansion, temperature
      type(lubricant_t) :: lubricant
      real(dp) :: with_beta, with_expansion, inlet

      with_beta = 0.0_dp
      with_expansion = 0.0_dp
      inlet = 313.15_dp
      if (present(beta)) with_beta = beta
      if (present(expansion)) with_expansion = expansion
      if (present(temperature)) inlet = temperature
      if (alpha_bar > 0.0_dp .and. hertz_pressure > 0.0_dp .and. viscosity_law == viscosity_roelands) then
         allocate (lubricant%viscosity, source=new_roelands(alpha_bar, roelands_p0/hertz_pressure, z, with_beta, inlet))
      else
         allocate (lubricant%viscosity, source=barus_t(alpha_bar=alpha_bar, beta=with_beta))
      end if
      if (hertz_pressure > 0.0_dp .and. density_law == density_dowson_higginson) then
         allocate (lubricant%compression, source=new_dowson_higginson(hertz_pressure, with_expansion))
      else
         allocate (lubricant%compression, source=incompressible_t(with_expansion))
      end if
   end function new_lubricant

   !> ln(eta/eta0) at pressures p and the temperature of the inlet, and its derivative with respect to p
   pure subroutine log_viscosity(self, p, values, slope)
      class(lubricant_t), intent(in) :: self
      real(dp), intent(in) :: p(:)
      real(dp), intent(out) :: values(:), slope(:)
      call self%viscosity%log_viscosity(p, values, slope)
   end subroutine log_viscosity

   !> d ln(eta/eta0)/dP at P = 0 and the temperature of the inlet [1/p_h]
   pure real(dp) function initial_slope(self)
      class(lubricant_t), intent(in) :: self
      real(dp) :: log_viscosity(1), slope(1)

      call self%log_viscosity([0.0_dp], log_viscosity, slope)
      initial_slope = slope(1)
   end function initial_slope

   !> ln(eta/eta0) at pressures p and temperature rises above the inlet [K]
   pure subroutine log_viscosity_at(self, p, rise, values)
      class(lubricant_t), intent(in) :: self
      real(dp), intent(in) :: p(:), rise(:)
      real(dp), intent(out) :: values(:)
      call self%viscosity%log_viscosity_at(p, rise, values)
   end subroutine log_viscosity_at

   !> Density rho/rho0 at pressures p and the temperature of the inlet, and its derivative with respect to p
   pure subroutine density(self, p, rho, slope)
      class(lubricant_t), intent(in) :: self
      real(dp), intent(in) :: p(:)
      real(dp), intent(out) :: rho(:), slope(:)
      call self%compression%density(p, rho, slope)
   end subroutine density

   !> Density rho/rho0 at pressures p and temperature rises above the inlet [K]
   pure subroutine density_at(self, p, rise, rho)
      class(lubricant_t), intent(in) :: self
      real(dp), intent(in) :: p(:), rise(:)
      real(dp), intent(out) :: rho(:)
      call self%compression%density_at(p, rise, rho)
   end subroutine density_at
end module ehl_lubricant

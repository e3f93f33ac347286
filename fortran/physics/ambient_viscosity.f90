! SPDX-License-Identifier: BSD-3-Clause
!> Viscosity at ambient pressure as a function of temperature: from two kinematic viscosities of a data sheet, or by Vogel 1921,
!> eta = K exp(B/(theta + C))
module ehl_ambient_viscosity
   use ehl_heat, only: new_walther, walther_t
   use ehl_kinds, only: dp
   implicit none (type, external)
   private
   public :: ambient_viscosity_t, new_ambient_viscosity

   type :: ambient_viscosity_t
      private
      logical :: by_sheet = .false.
      !> Constants of Vogel: K [Pa s], B [K], C [degC]
      real(dp) :: vogel(3) = 0.0_dp
      !> Data sheet: Walther's equation for the kinematic viscosity, density at 15 degC [kg/m^3], thermal expansion [1/K]
      type(walther_t) :: line
      real(dp) :: density = 0.0_dp, expansion = 0.0_dp
   contains
      procedure :: log_viscosity
   end type ambient_viscosity_t

contains

   !> The law from the constants of Vogel (K [Pa s], B [K], C [degC]), or from a data sheet, which takes precedence:
   !> [mm^2/s] at 40 and 100 degC, density at 15 degC [kg/m^3], thermal expansion [1/K]
   pure function new_ambient_viscosity(vogel, sheet, density, expansion) result(law)
      real(dp), intent(in) :: vogel(3), sheet(2), density, expansion
      type(ambient_viscosity_t) :: law

      law%by_sheet = sheet(1) > 0.0_dp
      law%vogel = vogel
      if (law%by_sheet) law%line = new_walther(sheet)
      law%density = density
      law%expansion = expansion
   end function new_ambient_viscosity

   !> ln(eta/Pa s) at a temperature [degC]; where the viscosity is not positive, the logarithm of the smallest positive number
   pure real(dp) function log_viscosity(self, temperature)
      class(ambient_viscosity_t), intent(in) :: self
      real(dp), intent(in) :: temperature

      if (self%by_sheet) then
         log_viscosity = log(max(tiny(1.0_dp), self%line%dynamic(temperature, self%density, self%expansion)))
      else
         log_viscosity = log(self%vogel(1)) + self%vogel(2)/(temperature + self%vogel(3))
      end if
   end function log_viscosity
end module ehl_ambient_viscosity

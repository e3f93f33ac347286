! SPDX-License-Identifier: BSD-3-Clause
!> Interface of the laws of viscosity as a function of pressure and temperature, row by row: one dispatch per row, so that
!> the loops of the laws vectorise
module ehl_viscosity_law
   use, intrinsic :: ieee_arithmetic, only: ieee_positive_inf, ieee_value
   use ehl_kinds, only: dp
   implicit none (type, external)
   private
   public :: viscosity_law_t, solid

   !> Viscosity over eta0, that at ambient pressure and the temperature of the inlet
   type, abstract :: viscosity_law_t
      !> [Pa s] eta0, of laws that determine it; 0 of the others
      real(dp) :: ambient_viscosity = 0.0_dp
   contains
      procedure(log_viscosity), deferred :: log_viscosity
      procedure(log_viscosity_at), deferred :: log_viscosity_at
   end type viscosity_law_t

   abstract interface
      !> ln(eta/eta0) at pressures p over the Hertz pressure and the temperature of the inlet, and its derivative with respect to p
      pure subroutine log_viscosity(self, p, values, slope)
         import :: dp, viscosity_law_t
         implicit none (type, external)
         class(viscosity_law_t), intent(in) :: self
         real(dp), intent(in) :: p(:)
         real(dp), intent(out) :: values(:), slope(:)
      end subroutine log_viscosity

      !> ln(eta/eta0) at pressures p over the Hertz pressure and temperature rises above the inlet [K]; for a zero
      !> rise equal to `log_viscosity` to the bit
      pure subroutine log_viscosity_at(self, p, rise, values)
         import :: dp, viscosity_law_t
         implicit none (type, external)
         class(viscosity_law_t), intent(in) :: self
         real(dp), intent(in) :: p(:), rise(:)
         real(dp), intent(out) :: values(:)
      end subroutine log_viscosity_at
   end interface

contains

   !> ln(eta/eta0) beyond the pole of a law, where the oil is solid
   pure real(dp) function solid()
      solid = ieee_value(0.0_dp, ieee_positive_inf)
   end function solid
end module ehl_viscosity_law

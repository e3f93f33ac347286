! SPDX-License-Identifier: BSD-3-Clause
!> Interface of the laws of density as a function of pressure and temperature, row by row
module ehl_density_law
   use ehl_kinds, only: dp
   implicit none (type, external)
   private
   public :: density_law_t

   !> Density over rho0, that at ambient pressure and the temperature of the inlet
   type, abstract :: density_law_t
   contains
      procedure(density), deferred :: density
      procedure(density_at), deferred :: density_at
   end type density_law_t

   abstract interface
      !> rho/rho0 at pressures p over the Hertz pressure and the temperature of the inlet, and its derivative with respect to p
      pure subroutine density(self, p, rho, slope)
         import :: density_law_t, dp
         implicit none (type, external)
         class(density_law_t), intent(in) :: self
         real(dp), intent(in) :: p(:)
         real(dp), intent(out) :: rho(:), slope(:)
      end subroutine density

      !> rho/rho0 at pressures p over the Hertz pressure and temperature rises above the inlet [K]; for a zero
      !> rise equal to `density` to the bit
      pure subroutine density_at(self, p, rise, rho)
         import :: density_law_t, dp
         implicit none (type, external)
         class(density_law_t), intent(in) :: self
         real(dp), intent(in) :: p(:), rise(:)
         real(dp), intent(out) :: rho(:)
      end subroutine density_at
   end interface
end module ehl_density_law

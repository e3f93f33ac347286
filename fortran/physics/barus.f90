! SPDX-License-Identifier: BSD-3-Clause
!> Viscosity by Barus 1893: ln(eta/eta0) = alpha p - beta (T - T0), with the temperature of the inlet T0
module ehl_barus
   use ehl_kinds, only: dp
   use ehl_viscosity_law, only: viscosity_law_t
   implicit none (type, external)
   private
   public :: barus_t

   type, extends(viscosity_law_t) :: barus_t
      !> alpha p_h, and beta = -(d eta/dT)/eta [1/K]
      real(dp) :: alpha_bar = 0.0_dp, beta = 0.0_dp
   contains
      procedure :: log_viscosity
      procedure :: log_viscosity_at
   end type barus_t

contains

   !> ln(eta/eta0) at the temperature of the inlet, and its derivative with respect to p
   pure subroutine log_viscosity(self, p, values, slope)
      class(barus_t), intent(in) :: self
      real(dp), intent(in) :: p(:)
      real(dp), intent(out) :: values(:), slope(:)

      values = self%alpha_bar*p
      slope = self%alpha_bar
   end subroutine log_viscosity

   !> ln(eta/eta0) at temperature rises above the inlet [K]
   pure subroutine log_viscosity_at(self, p, rise, values)
      class(barus_t), intent(in) :: self
      real(dp), intent(in) :: p(:), rise(:)
      real(dp), intent(out) :: values(:)

      values = self%alpha_bar*p - self%beta*rise
   end subroutine log_viscosity_at
end module ehl_barus

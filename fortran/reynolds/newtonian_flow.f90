! SPDX-License-Identifier: BSD-3-Clause
!> Flow of a Newtonian lubricant, the same along X and Y:
!>
!>    eps = rho H^3/(eta lambda_bar),   d ln(eps)/dP = d ln(rho)/dP - d ln(eta)/dP,   d ln(eps)/d ln(H) = 3
!>
!> The viscosity is not stored: only the friction needs it, and computes it from the conductance.
module ehl_newtonian_flow
   use ehl_flow, only: dir_x, flow_t
   use ehl_kinds, only: dp
   use ehl_lubricant, only: lubricant_t
   implicit none (type, external)
   private
   public :: newtonian_flow_t

   type, extends(flow_t) :: newtonian_flow_t
   contains
      procedure :: find_row
      procedure :: film_exponent
      procedure :: stress_row
   end type newtonian_flow_t

contains

   !> Conductances of row j and their derivatives with respect to P. Downstream of `last` the lubricant
   !> has its properties at P = 0.
   pure subroutine find_row(self, lubricant, p, h, rho, drho_dp, j, last)
      class(newtonian_flow_t), intent(inout) :: self
      type(lubricant_t), intent(in) :: lubricant
      !> Pressure, shape (nx, ny)
      real(dp), contiguous, intent(in) :: p(:, :)
      !> Film, density and its derivative with respect to P in row j, shape (nx)
      real(dp), contiguous, intent(in) :: h(:), rho(:), drho_dp(:)
      integer, intent(in) :: j, last
      real(dp) :: ambient_log(1), ambient_slope(1)
      integer :: i

      ! eps contains ln(eta/eta0) until the loop below
      call lubricant%log_viscosity(p(:last, j), self%eps(:last, j, dir_x), self%dlneps_dp(:last, j, dir_x))
      do i = 1, last
         self%eps(i, j, dir_x) = rho(i)*h(i)**3*exp(-self%eps(i, j, dir_x))*self%inverse_speed
      end do
      if (last < size(p, 1)) then
         call lubricant%log_viscosity([0.0_dp], ambient_log, ambient_slope)
         self%dlneps_dp(last + 1:, j, dir_x) = ambient_slope(1)
         self%eps(last + 1:, j, dir_x) = rho(last + 1)*exp(-ambient_log(1))*self%inverse_speed*h(last + 1:)**3
      end if
      self%dlneps_dp(:, j, dir_x) = drho_dp/rho - self%dlneps_dp(:, j, dir_x)
   end subroutine find_row

   !> d ln(eps)/d ln(H)
   pure real(dp) function film_exponent(self, i, j, direction)
      class(newtonian_flow_t), intent(in) :: self
      integer, intent(in) :: i, j, direction
      associate (unused => [i, j, direction, self%dir_y])
      end associate
      film_exponent = 3.0_dp
   end function film_exponent

   !> Shear stress of row j; the viscosity follows from the conductance
   pure subroutine stress_row(self, lubricant, p, h, rho, j, newtonian, stress)
      class(newtonian_flow_t), intent(in) :: self
      type(lubricant_t), intent(in) :: lubricant
      !> Pressure, shape (nx, ny)
      real(dp), contiguous, intent(in) :: p(:, :)
      !> Film and density of the row, shape (nx)
      real(dp), contiguous, intent(in) :: h(:), rho(:)
      integer, intent(in) :: j
      real(dp), contiguous, intent(out) :: newtonian(:), stress(:)

      newtonian = self%inverse_speed*rho*h**2/self%eps(:, j, dir_x)
      stress = newtonian
      if (lubricant%shear%thins()) call lubricant%shear%reduce(p(:, j), stress)
   end subroutine stress_row
end module ehl_newtonian_flow

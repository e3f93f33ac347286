! SPDX-License-Identifier: BSD-3-Clause
!> The flooded inlet of a line contact beyond the border of its domain. There the viscosity increases as exp(alpha_bar P), the
!> density is constant, and the flow q is that of the whole contact, so that the film determines the reduced pressure I:
!>
!>    dI/dX = lambda_bar (H - q)/H^3,   H(X) = H_1 + (X^2 - X_1^2)/2 - (1/2) ln(X/X_1),   P = -ln(1 - alpha_bar I)/alpha_bar
!>
!> with the border at X_1; the last term of H is the deflection caused by the load, taken as a line load. With u = X_1/X the
!> pressure at the border and the load beyond it are integrals over 0 < u < 1 of smooth functions.
module ehl_line_inlet
   use ehl_flow, only: dir_x
   use ehl_kinds, only: dp
   use ehl_level, only: level_t
   use ehl_wide_inlet, only: reduced_to_real
   implicit none (type, external)
   private
   public :: set_line_border, row_flow

   !> Quadrature points
   integer, parameter :: points = 64

contains

   !> Set the pressure of a flooded contact on the border, and the load of the nodes: the total load minus that beyond the border
   subroutine set_line_border(level, load)
      type(level_t), intent(inout) :: level
      !> Load of the contact, int P dX
      real(dp), intent(in) :: load
      real(dp) :: x, u, film, increment, pressure, beyond, flow
      integer :: k

      associate (grid => level%grid)
         flow = row_flow(level, 1)
         x = abs(grid%x0)
         pressure = 0.0_dp
         beyond = 0.0_dp
         do k = 1, points
            u = (k - 0.5_dp)/points
            film = level%h(1, 1) + 0.5_dp*x**2*(1.0_dp/u**2 - 1.0_dp) + 0.5_dp*log(u)
            increment = (film - flow)/film**3*x/(u**2*level%flow%inverse_speed*points)
            pressure = pressure + increment
            beyond = beyond + increment*x*(1.0_dp/u - 1.0_dp)
         end do
         pressure = reduced_to_real(pressure, level%lubricant%initial_slope())
         level%p(1, :) = pressure
         level%p(grid%nx, :) = 0.0_dp
         ! half of the cell at the border lies beyond it
         level%load = load - beyond + 0.5_dp*grid%hx*pressure
      end associate
   end subroutine set_line_border

   !> Flow of row j through X = 0, m - eps dP/dX, scaled as rho H
   pure real(dp) function row_flow(level, j)
      type(level_t), intent(in) :: level
      integer, intent(in) :: j
      integer :: i

      i = 1 + nint(-level%grid%x0/level%grid%hx)
      row_flow = level%mass_content(i, j) - level%flow%eps(i, j, dir_x)*(level%p(i + 1, j) - level%p(i - 1, j)) &
                 /(2.0_dp*level%grid%hx)
   end function row_flow
end module ehl_line_inlet

! SPDX-License-Identifier: BSD-3-Clause
!> The domain that a line contact needs, and the error of the film due to a finite domain; data: docs/theory/line.md
module ehl_line_domain
   use ehl_contact, only: contact_t
   use ehl_kinds, only: dp
   use ehl_moes, only: operating_t
   implicit none (type, external)
   private
   public :: line_ends, line_domain_error

   !> Inlet and outlet in half widths, or in length scales s = (2 H_c)^(1/2) of the film, whichever are larger. X = 0 is a node of
   !> every grid of 4 n + 1 nodes.
   real(dp), parameter :: inlet = -4.5_dp, outlet = 1.5_dp
   !> Coefficients of the error of H_c due to P = 0 at the inlet: due to the pressure missing there, which is
   !> 4 lambda_bar/(3 |X|^3) far from the contact and larger near it; due to the load beyond the inlet; and with a flooded border
   real(dp), parameter :: by_pressure = 1.5_dp, by_load = 0.9_dp, by_flooded = 0.07_dp

contains

   !> X of inlet and outlet
   pure function line_ends(contact, point) result(ends)
      class(contact_t), intent(in) :: contact
      type(operating_t), intent(in) :: point
      real(dp) :: ends(2)

      ends = [inlet, outlet]*max(1.0_dp, sqrt(2.0_dp*contact%film_formula(point%moes_m, point%moes_l)))
   end function line_ends

   !> Upper estimate of the relative error of the film due to an inlet at x, relative to the flooded contact
   pure real(dp) function line_domain_error(contact, point, x, flooded) result(error)
      class(contact_t), intent(in) :: contact
      type(operating_t), intent(in) :: point
      real(dp), intent(in) :: x
      logical, intent(in) :: flooded
      real(dp) :: sensitivity
      real(dp), parameter :: step = 1.05_dp

      associate (lambda_bar => point%speed_parameter, m => point%moes_m, l => point%moes_l)
         if (flooded) then
            error = by_flooded*lambda_bar*(1.0_dp + point%alpha_bar)/x**4
            ! where the reduced pressure at the border exceeds its limit 1/alpha_bar the film is not determined
            if (point%alpha_bar*4.0_dp*lambda_bar >= 3.0_dp*(x**2 - 1.0_dp)**1.5_dp) error = 1.0_dp
         else
            ! -d ln h/d ln w at constant speed: H is h over b^2/R, which is proportional to the load
            sensitivity = -log(contact%film_formula(m*step, l)/contact%film_formula(m/step, l))/(2.0_dp*log(step)) - 1.0_dp
            error = lambda_bar*(by_pressure*(2.0_dp + point%alpha_bar)/(x**2 - 1.0_dp)**1.5_dp &
                               + by_load*max(0.0_dp, sensitivity)/x**2)
         end if
      end associate
   end function line_domain_error
end module ehl_line_domain

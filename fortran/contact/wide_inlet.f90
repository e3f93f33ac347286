! SPDX-License-Identifier: BSD-3-Clause
!> The inlet of a flooded wide contact beyond the border of its domain. In each row it is that of a line contact, with the
!> reduced pressure I and the gap G of the dry contact, whose half width w in the row is a sqrt(1 - Y^2/(kappa a)^2):
!>
!>    dI/dX = -lambda_bar (H - q)/H^3,   H(X) = H_1 + G(X) - G(X_1),
!>    G = (X sqrt(X^2 - w^2) - w^2 arcosh(X/w))/2,   P = -ln(1 - alpha_bar I)/alpha_bar
!>
!> with X > 0 against the motion, the border at X_1 and the film H_1 there. The flow q is that of the row at X = 0.
module ehl_wide_inlet
   use ehl_contact, only: contact_t
   use ehl_kinds, only: dp
   use ehl_moes, only: operating_t
   implicit none (type, external)
   private
   public :: dry_gap, inlet_integral, inlet_moment, reduced_to_real, wide_inlet_error

   !> Gauss-Legendre rule on [0, 1], six points; relative error below 2e-4 for X_1 > 1.4 w
   integer, parameter :: points = 6
   real(dp), parameter :: offset(3) = 0.5_dp*[0.9324695142031521_dp, 0.6612093864662645_dp, 0.2386191860831969_dp], &
                          share(3) = 0.5_dp*[0.1713244923791704_dp, 0.3607615730481386_dp, 0.4679139345726910_dp], &
                          node(points) = 0.5_dp + [-offset, offset], weight(points) = [share, share]
   !> Error of H_c over D s, due to flow across the motion, and over s^2.5, with s the reduced pressure at the border over its limit
   !> 1/alpha_bar. The sum covers 81 of 86 differences in docs/evidence/machines/inlets.csv; one of the others is 0.03 %, the rest
   !> have stated errors above 2.9 %.
   real(dp), parameter :: by_side_flow = 0.3_dp, by_inlet_pressure = 0.06_dp

contains

   !> Integral of (H - q)/H^3 beyond the border
   pure real(dp) function inlet_integral(x, film, flow, width) result(total)
      !> X_1; H_1; q; w^2
      real(dp), intent(in) :: x, film, flow, width
      real(dp) :: at, h, gap
      integer :: k

      gap = dry_gap(x, width)
      total = 0.0_dp
      do k = 1, points
         at = x/node(k)
         h = film + (dry_gap(at, width) - gap)
         total = total + weight(k)*(h - flow)/h**3*at/node(k)
      end do
   end function inlet_integral

   !> Integral of H dP/dX along the motion beyond the border, from the pressure at the border, which sets the scale of I. q may be
   !> the film at X = 0: compared with H beyond the border it is small.
   pure real(dp) function inlet_moment(x, film, flow, width, pressure, alpha) result(total)
      !> As in inlet_integral; P at the border, alpha_bar
      real(dp), intent(in) :: x, film, flow, width, pressure, alpha
      real(dp) :: at, h, gap, scale
      integer :: k

      gap = dry_gap(x, width)
      scale = pressure
      if (alpha > 0.0_dp) scale = (1.0_dp - exp(-alpha*pressure))/alpha
      scale = scale/inlet_integral(x, film, flow, width)
      total = 0.0_dp
      do k = 1, points
         at = x/node(k)
         h = film + (dry_gap(at, width) - gap)
         total = total + weight(k)*scale*(h - flow)/h**2*at/node(k)/(1.0_dp - alpha*scale*inlet_integral(at, h, flow, width))
      end do
   end function inlet_moment

   !> G at a distance x > w from the centre; width: w^2 > 0
   elemental real(dp) function dry_gap(x, width)
      real(dp), intent(in) :: x, width
      real(dp) :: root

      root = sqrt(x**2 - width)
      dry_gap = 0.5_dp*(x*root - width*log((x + root)/sqrt(width)))
   end function dry_gap

   !> P of a reduced pressure at a viscosity that increases as exp(alpha_bar P). The reduced pressure itself where it is not below
   !> 1/alpha_bar: the domain is then far too small (wide_inlet_error; line_domain_error in contact/line_domain.f90).
   elemental real(dp) function reduced_to_real(reduced, alpha) result(p)
      real(dp), intent(in) :: reduced
      !> alpha_bar
      real(dp), intent(in) :: alpha

      p = reduced
      if (alpha*reduced > 0.0_dp .and. alpha*reduced < 1.0_dp) p = -log(1.0_dp - alpha*reduced)/alpha
   end function reduced_to_real

   !> Relative error of H_c due to the approximate pressure at the inlet border of a wide contact; 1: unknown
   pure real(dp) function wide_inlet_error(contact, point, x, film) result(error)
      class(contact_t), intent(in) :: contact
      type(operating_t), intent(in) :: point
      !> Distance of the inlet from the centre; H_c
      real(dp), intent(in) :: x, film
      real(dp) :: s

      error = 1.0_dp
      if (.not. x > 1.0_dp) return
      s = point%speed_parameter*(1.0_dp + point%alpha_bar)*inlet_integral(x, film + dry_gap(x, 1.0_dp), film, 1.0_dp)
      if (s < 1.0_dp) error = by_side_flow*contact%radius_ratio*s + by_inlet_pressure*s**2.5_dp
   end function wide_inlet_error
end module ehl_wide_inlet

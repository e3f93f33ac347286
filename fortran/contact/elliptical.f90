! SPDX-License-Identifier: BSD-3-Clause
!> The elliptical contact of bodies with two radii (Hertz 1881; Johnson 1985, section 4.2)
!>
!> Lengths are scaled by the semi-axis a, which lies along the motion or at an angle to it; the other semi-axis is kappa a. The
!> potential of the Hertz pressure on this ellipse is iint P/r = l - c_x X^2 - c_y Y^2 inside it, with
!>
!>    c_x = pi kappa/3 R_D(0, kappa^2, 1),  c_y = pi kappa/3 R_D(0, 1, kappa^2),  l = pi kappa R_F(0, 1, kappa^2),
!>
!> so that the deflection closes the gap X^2/2 + D Y^2/2 if k_b = 1/(2 c_x) and D = R_x/R_y = c_y/c_x.
module ehl_elliptical
   use ehl_contact, only: contact_t
   use ehl_elliptic, only: complete_rd, complete_rf
   use ehl_kinds, only: dp, pi
   use ehl_scales, only: circle_factor
   implicit none (type, external)
   private
   public :: new_elliptical

   type, extends(contact_t) :: elliptical_t
      private
      !> Cosine and sine of the angle of the axis of R_x
      real(dp) :: along = 1.0_dp, across = 0.0_dp
   contains
      procedure :: gap_row
      procedure :: pressure_row
   end type elliptical_t

contains

   !> The contact from the ratio of its radii
   pure function new_elliptical(radius_ratio, angle) result(contact)
      !> D = R_x/R_y; angle of the plane of R_x against that of the motion [rad], counter-clockwise
      real(dp), intent(in) :: radius_ratio, angle
      type(elliptical_t) :: contact

      contact%radius_ratio = radius_ratio
      contact%ellipticity = ellipticity_of(radius_ratio)
      associate (k => contact%ellipticity)
         contact%load = 2.0_dp*pi/3.0_dp*k
         contact%kernel_factor = 0.5_dp/(pi*k/3.0_dp*complete_rd(k**2, 1.0_dp))
         contact%dry_separation = -contact%kernel_factor*pi*k*complete_rf(1.0_dp, k**2)
         contact%angle = angle
         contact%along = cos(angle)
         contact%across = sin(angle)
         contact%reach = sqrt([contact%along**2 + (k*contact%across)**2, contact%across**2 + (k*contact%along)**2])
      end associate
      contact%radius = 1.0_dp/(contact%along**2 + radius_ratio*contact%across**2)
      contact%ratio = (contact%across**2 + radius_ratio*contact%along**2)*contact%radius
      associate (k => ellipticity_of(contact%ratio))
         contact%kernel_ratio = 1.5_dp/(pi*complete_rd(k**2, 1.0_dp))/circle_factor
      end associate
   end function new_elliptical

   !> kappa from D = R_D(0, 1, kappa^2)/R_D(0, kappa^2, 1), which decreases with kappa: bisection in ln(kappa)
   pure real(dp) function ellipticity_of(radius_ratio)
      real(dp), intent(in) :: radius_ratio
      real(dp) :: low, high, middle
      integer :: k

      ! kappa is D^(-2/3) within a factor of 4 for all D allowed in a case
      middle = -2.0_dp/3.0_dp*log(radius_ratio)
      low = middle - log(4.0_dp)
      high = middle + log(4.0_dp)
      do k = 1, 60
         middle = 0.5_dp*(low + high)
         associate (square => exp(2.0_dp*middle))
            if (complete_rd(1.0_dp, square) > radius_ratio*complete_rd(square, 1.0_dp)) then
               low = middle
            else
               high = middle
            end if
         end associate
      end do
      ellipticity_of = exp(0.5_dp*(low + high))
   end function ellipticity_of

   !> X^2/2 + D Y^2/2 along the principal axes
   pure subroutine gap_row(self, x, y, values)
      class(elliptical_t), intent(in) :: self
      real(dp), intent(in) :: x(:), y
      real(dp), intent(out) :: values(:)

      values = 0.5_dp*((self%along*x + self%across*y)**2 + self%radius_ratio*(self%along*y - self%across*x)**2)
   end subroutine gap_row

   !> sqrt(1 - X^2 - (Y/kappa)^2) along the principal axes, zero outside
   pure subroutine pressure_row(self, x, y, values)
      class(elliptical_t), intent(in) :: self
      real(dp), intent(in) :: x(:), y
      real(dp), intent(out) :: values(:)

      values = sqrt(max(0.0_dp, 1.0_dp - (self%along*x + self%across*y)**2 &
                        - ((self%along*y - self%across*x)/self%ellipticity)**2))
   end subroutine pressure_row
end module ehl_elliptical

! SPDX-License-Identifier: BSD-3-Clause
!> Lubricants that thin by shear: the shear rate is
!>
!>    rate = tau F(|tau|)/eta
!>
!> with the stress tau in units of a stress of the law and eta the viscosity at low shear:
!>
!>    Eyring    F = sinh|tau|/|tau|                        (Eyring stress; Johnson & Tevaarwerk 1977)
!>    Carreau   F = (1 + tau^2)^((1 - n)/(2 n))            (stress G; Bair 2007, single Newtonian plateau, in stress form)
!>
!> In a film that only slides, B = eta |u1 - u2|/(h stress) = tau F(tau).
module ehl_thinning
   use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
   use ehl_kinds, only: dp
   implicit none (type, external)
   private
   public :: thinning_t, eyring, carreau

   integer, parameter :: eyring = 1, carreau = 2
   !> Below this stress the Eyring law is summed as a series
   real(dp), parameter :: series_below = 0.5_dp
   !> Steps of a Newton iteration, and the error at which it ends
   integer, parameter :: most_steps = 50
   real(dp), parameter :: enough = 1.0e-10_dp

   !> A law with its parameter
   type :: thinning_t
      integer :: law = eyring
      !> [-] power-law exponent n of Carreau
      real(dp) :: exponent = 1.0_dp
   contains
      procedure :: thinness
      procedure :: sliding_stress
      procedure :: curvature
   end type thinning_t

contains

   !> F at the square of a stress, and its slope (dF/d|tau|)/|tau|
   pure subroutine thinness(self, square, f, slope)
      class(thinning_t), intent(in) :: self
      real(dp), intent(in) :: square
      real(dp), intent(out) :: f, slope
      real(dp) :: t, e, m

      if (self%law == carreau) then
         m = 0.5_dp*(1.0_dp - self%exponent)/self%exponent
         f = (1.0_dp + square)**m
         slope = 2.0_dp*m*f/(1.0_dp + square)
      else if (square < series_below**2) then
         f = 1.0_dp + square/6.0_dp*(1.0_dp + square/20.0_dp*(1.0_dp + square/42.0_dp*(1.0_dp + square/72.0_dp &
             *(1.0_dp + square/110.0_dp))))
         slope = (1.0_dp + square/10.0_dp*(1.0_dp + square/28.0_dp*(1.0_dp + square/54.0_dp*(1.0_dp + square/88.0_dp))))/3.0_dp
      else
         t = sqrt(square)
         e = exp(t)
         f = 0.5_dp*(e - 1.0_dp/e)/t
         slope = (0.5_dp*(e + 1.0_dp/e) - f)/square
      end if
   end subroutine thinness

   !> Of F at small stresses: F = 1 + curvature tau^2
   pure real(dp) function curvature(self)
      class(thinning_t), intent(in) :: self
      curvature = 1.0_dp/6.0_dp
      if (self%law == carreau) curvature = 0.5_dp*(1.0_dp - self%exponent)/self%exponent
   end function curvature

   !> Stress of a film that only slides; a NaN where it is not found
   elemental real(dp) function sliding_stress(self, b) result(t)
      class(thinning_t), intent(in) :: self
      real(dp), intent(in) :: b
      real(dp) :: m, u, f
      integer :: k

      if (self%law == eyring) then
         t = asinh(b)
         return
      end if
      t = b
      if (.not. abs(b) > tiny(1.0_dp)) return
      ! u = ln|tau|: ln|B| is between a line of slope 1 and one of slope 1/n, so that the iteration cannot go astray
      m = 0.5_dp*(1.0_dp - self%exponent)/self%exponent
      u = log(abs(b))
      if (u > 0.0_dp) u = self%exponent*u
      do k = 1, most_steps
         t = exp(2.0_dp*u)
         f = u + m*log(1.0_dp + t) - log(abs(b))
         u = u - f/(1.0_dp + 2.0_dp*m*t/(1.0_dp + t))
         if (abs(f) < enough) then
            t = sign(exp(u), b)
            return
         end if
      end do
      t = ieee_value(t, ieee_quiet_nan)
   end function sliding_stress
end module ehl_thinning

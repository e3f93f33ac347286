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
   public :: thinning_t, eyring, carreau, slopes

   integer, parameter :: eyring = 1, carreau = 2
   !> Below this stress the Eyring law is summed as a series
   real(dp), parameter :: series_below = 0.5_dp
   !> Steps of an iteration, and the error before the last one at which it ends: the last leaves its cube
   integer, parameter :: most_steps = 50
   real(dp), parameter :: enough = 1.0e-4_dp
   !> Slopes of F in the square of the stress
   integer, parameter :: slopes = 3

   !> A law with its parameter
   type :: thinning_t
      integer :: law = eyring
      !> [-] power-law exponent n of Carreau
      real(dp) :: exponent = 1.0_dp
   contains
      procedure :: thinness
      procedure :: all_slopes
      procedure :: error_of_second_order
      procedure :: sliding_stress
      procedure :: curvature
   end type thinning_t

contains

   !> F at the square of a stress, and its slope (dF/d|tau|)/|tau|
   elemental subroutine thinness(self, square, f, slope)
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

   !> F and its slopes in the square of the stress, d^k F/d(tau^2)^k
   pure function all_slopes(self, square) result(f)
      class(thinning_t), intent(in) :: self
      real(dp), intent(in) :: square
      !> 1/3, 1/(3 5), 1/(3 5 7): the slopes of Eyring at 0, times 2^k
      real(dp), parameter :: at_zero(slopes) = [1.0_dp/3.0_dp, 1.0_dp/15.0_dp, 1.0_dp/105.0_dp]
      real(dp) :: f(0:slopes), m
      integer :: k

      if (self%law == carreau) then
         m = 0.5_dp*(1.0_dp - self%exponent)/self%exponent
         f(0) = (1.0_dp + square)**m
         do k = 1, slopes
            f(k) = f(k - 1)*(m - (k - 1))/(1.0_dp + square)
         end do
      else
         call self%thinness(square, f(0), f(1))
         if (square < series_below**2) then
            do k = 2, slopes
               f(k) = at_zero(k)*(1.0_dp + 0.5_dp*square/(2*k + 3)*(1.0_dp + 0.25_dp*square/(2*k + 5)))
            end do
         else
            f(2) = (f(0) - 3.0_dp*f(1))/square
            f(3) = (f(1) - 5.0_dp*f(2))/square
         end if
         f(1:) = f(1:)*[0.5_dp, 0.25_dp, 0.125_dp]
      end if
   end function all_slopes

   !> Relative error that factors of second order in the gradient S have at the stress of the sliding alone, at the most
   !> (measured)
   pure real(dp) function error_of_second_order(self, stress, s) result(error)
      class(thinning_t), intent(in) :: self
      real(dp), intent(in) :: stress, s(2)
      real(dp) :: m

      if (self%law == eyring) then
         error = 1.8e-3_dp*dot_product(s, s)**2
      else
         m = self%curvature()
         error = (0.04_dp*m + 0.17_dp*m**3)*(dot_product(s, s)/(1.0_dp + stress**2))**2
      end if
   end function error_of_second_order

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
      real(dp) :: m, u, f, slope, wanted
      integer :: k

      if (self%law == eyring) then
         t = asinh(b)
         return
      end if
      t = b
      if (.not. abs(b) > tiny(1.0_dp)) return
      ! u = ln|tau|: ln|B| is between a line of slope 1 and one of slope 1/n, so that the iteration (Halley) cannot go astray
      m = 0.5_dp*(1.0_dp - self%exponent)/self%exponent
      wanted = log(abs(b))
      u = wanted
      if (u > 0.0_dp) u = self%exponent*u
      if (abs(wanted) < 10.0_dp) u = wanted + 0.5_dp*(self%exponent - 1.0_dp)*log(1.0_dp + b**2)
      do k = 1, most_steps
         t = exp(2.0_dp*u)
         f = u + m*log(1.0_dp + t) - wanted
         t = t/(1.0_dp + t)
         slope = 1.0_dp + 2.0_dp*m*t
         u = u - f*slope/(slope**2 - 2.0_dp*f*m*t*(1.0_dp - t))
         if (abs(f) < enough) then
            t = sign(exp(u), b)
            return
         end if
      end do
      t = ieee_value(t, ieee_quiet_nan)
   end function sliding_stress
end module ehl_thinning

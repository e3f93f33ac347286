! SPDX-License-Identifier: BSD-3-Clause
!> Flow factors of a shear-thinning lubricant by integrals through the film: its flow under a pressure gradient along X, the
!> direction of sliding, and along Y, over that of a Newtonian lubricant with its low-shear viscosity.
!>
!> With xi = z/h from -1/2 to 1/2 and stresses over that of the law, the stress is tau(xi) = tau_m + xi S, where
!> S = (h/stress) grad p. With F of the law (thinning.f90) the mean stress tau_m follows from the sliding,
!>
!>    int F(|tau|) tau_x dxi = B,   int F(|tau|) tau_y dxi = 0,   B = eta |u1 - u2|/(h stress),
!>
!> and the factors from the flow Q = int xi F(|tau|) tau dxi:  phi_x = 12 Q_x/S_x,  phi_y = 12 Q_y/S_y.
!>
!> With J0 = int F, J2 = int xi^2 F, int xi F = K tau_m.S and the second of the two equations this is
!>
!>    phi_x = 12 [J2 + tau_mx^2 K J0/(J0 + S_y^2 K)],   phi_y = 12 [J2 - J0 (S_x tau_mx K/(J0 + S_y^2 K))^2],
!>
!> which holds for S_x = 0 and S_y = 0 too; K is a sum of divided differences of F. Limits: S -> 0 (sliding alone)
!> phi_x = dB/dtau, phi_y = B/tau; B = 0, one direction, Eyring: 3 (s cosh s - sinh s)/s^3, s = S/2 (Conry 1981).
!>
!> Derivatives: with A, C, D = int (1, xi, xi^2) d(F tau)/dtau dxi (2 x 2) and M = D - C A^-1 C,
!> dtau_m = A^-1 [(dB, 0) - C dS],   dQ = C A^-1 (dB, 0) + M dS.
module ehl_flow_factors
   use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
   use ehl_kinds, only: dp
   use ehl_thinning, only: eyring, thinning_t
   implicit none (type, external)
   private
   public :: factors_t, exact_factors
   public :: half, upper, weight, min_gradient

   !> Gauss points through the film, those of one half before their mirror images, and weights
   integer, parameter :: half = 3, points = 2*half
   real(dp), parameter :: upper(half) = 0.5_dp*[0.238619186083196909_dp, 0.661209386466264514_dp, 0.932469514203152028_dp]
   real(dp), parameter :: weight(half) = 0.5_dp*[0.467913934572691047_dp, 0.360761573048138608_dp, 0.171324492379170345_dp]
   real(dp), parameter :: z(points) = [upper, -upper], w(points) = [weight, weight]
   !> Maximum number of Newton steps for the mean stress; relative error of B below which one last step follows, which reduces
   !> the error to its square
   integer, parameter :: max_steps = 200
   real(dp), parameter :: tolerance = 1.0e-7_dp
   !> A step is halved if the derivative along it has the opposite sign at its end, and more than this fraction of the magnitude
   !> at its start
   real(dp), parameter :: overshoot = 0.5_dp
   !> Maximum step, or the stress itself if that is larger
   real(dp), parameter :: max_step = 4.0_dp
   !> The divided difference of F between two stresses closer than this, absolutely or relative to their sum, is replaced by
   !> the mean derivative
   real(dp), parameter :: close = 1.0e-4_dp
   !> Minimum component of S, so that derivatives are not 0/0; it changes the factors by its square only
   real(dp), parameter :: min_gradient = 1.0e-4_dp

   !> Stress along X and along Y at the points of a film, its square, F and (dF/d|tau|)/|tau| (thinning.f90)
   type :: film_t
      real(dp), dimension(points) :: tau_x, tau_y, square, f, slope
   end type film_t

   type :: factors_t
      !> phi_x, phi_y
      real(dp) :: phi(2) = 1.0_dp
      !> d ln(phi)/d ln(B); d ln(phi)/d ln(S) at a fixed direction of S
      real(dp) :: by_sliding(2) = 0.0_dp, by_gradient(2) = 0.0_dp
      !> d(phi_x S_x)/dS_x, d(phi_y S_y)/dS_y
      real(dp) :: tangent(2) = 1.0_dp
      !> Mean stress along X, and its derivatives with respect to B, S_x and S_y
      real(dp) :: stress = 0.0_dp, stress_by_sliding = 1.0_dp, stress_by_gradient(2) = 0.0_dp
   end type factors_t

contains

   !> Factors by integrals through the film for B >= 0 and a gradient S. If the mean stress does not converge, phi and stress are
   !> NaN, and the derivatives those of a Newtonian lubricant.
   pure function exact_factors(law, b, gradient) result(r)
      type(thinning_t), intent(in) :: law
      real(dp), intent(in) :: b, gradient(2)
      type(factors_t) :: r
      type(film_t) :: film
      !> A, C and D as xx, xy, yy
      real(dp) :: a(3), c(3), d(3), j0, j2, k, s(2), mean(2), off(2), change(2), slope, reduced
      integer :: step

      s = sign(max(abs(gradient), min_gradient), gradient)
      mean = [first_guess(law, b, s), 0.0_dp]
      change = 0.0_dp
      slope = 0.0_dp
      do step = 1, max_steps
         call through_film(law, mean, s, film)
         call balance(film, j0, k, a)
         ! without sliding the mean stress is 0, by symmetry
         if (.not. b > 0.0_dp) exit
         off = [b, 0.0_dp] - mean*j0 - s*k*dot_product(mean, s)
         if (all(abs(off) <= tolerance*b)) then
            ! the last, small step
            mean = mean + solve(a, off)
            exit
         end if
         ! the equations are the gradient of a convex function: if it increases steeply along the change the step was too long
         if (dot_product(off, change) < -overshoot*slope) then
            change = 0.5_dp*change
            slope = 0.5_dp*slope
            mean = mean - change
            cycle
         end if
         change = solve(a, off)
         change = change*min(1.0_dp, max(max_step, norm2(mean))/norm2(change))
         slope = dot_product(off, change)
         mean = mean + change
      end do
      if (step > max_steps) then
         r%phi = ieee_value(b, ieee_quiet_nan)
         r%stress = r%phi(1)
         return
      end if
      r%stress = mean(1)
      call moments(film, j2, c, d)
      reduced = mean(1)*k/(j0 + s(2)**2*k)
      r%phi(1) = 12.0_dp*(j2 + mean(1)*reduced*j0)
      r%phi(2) = 12.0_dp*(j2 - j0*(s(1)*reduced)**2)
      call changes(b, s, a, c, d, r)
   end function exact_factors

   !> Estimate of the mean stress along X
   pure real(dp) function first_guess(law, b, s)
      type(thinning_t), intent(in) :: law
      real(dp), intent(in) :: b, s(2)
      real(dp) :: ends(2), f(1), slope(1)

      ends = 0.5_dp*abs(s)
      if (law%law == eyring) then
         ! exact for S_y = 0: int sinh(t + xi S) dxi = sinh(t) sinh(S/2)/(S/2)
         call law%thinness([ends(1)**2], f, slope)
         first_guess = law%sliding_stress(b/f(1))
         if (ends(2) < first_guess) then
            first_guess = sqrt(first_guess**2 - ends(2)**2/3.0_dp)
         else
            call law%thinness([ends(2)**2], f, slope)
            first_guess = first_guess/f(1)
         end if
      else
         call law%thinness([dot_product(ends, ends)/3.0_dp], f, slope)
         first_guess = law%sliding_stress(b/f(1))
      end if
   end function first_guess

   !> Stress and F at the points of the film for a given mean stress
   pure subroutine through_film(law, mean, s, film)
      type(thinning_t), intent(in) :: law
      real(dp), intent(in) :: mean(2), s(2)
      type(film_t), intent(out) :: film

      film%tau_x = mean(1) + z*s(1)
      film%tau_y = mean(2) + z*s(2)
      film%square = film%tau_x**2 + film%tau_y**2
      call law%thinness(film%square, film%f, film%slope)
   end subroutine through_film

   !> J0, K and A
   pure subroutine balance(film, j0, k, a)
      type(film_t), intent(in) :: film
      real(dp), intent(out) :: j0, k, a(3)
      real(dp) :: t(points), apart(half), difference(half)
      logical :: far(half)

      j0 = sum(w*film%f)
      t = sqrt(film%square)
      associate (up => film%f(:half), down => film%f(half + 1:))
         apart = t(:half) - t(half + 1:)
         far = abs(apart) > close*max(1.0_dp, t(:half) + t(half + 1:))
         ! divided difference of F in tau^2 between two points
         difference = merge(up - down, 0.25_dp*(film%slope(:half) + film%slope(half + 1:)), far) &
                      /merge(apart*(t(:half) + t(half + 1:)), 1.0_dp, far)
      end associate
      k = sum(4.0_dp*w(:half)*z(:half)**2*difference)
      a = [j0 + sum(w*film%slope*film%tau_x**2), sum(w*film%slope*film%tau_x*film%tau_y), j0 + sum(w*film%slope*film%tau_y**2)]
   end subroutine balance

   !> J2, C and D
   pure subroutine moments(film, j2, c, d)
      type(film_t), intent(in) :: film
      real(dp), intent(out) :: j2, c(3), d(3)
      real(dp) :: xx(points), xy(points), yy(points)

      xx = w*z*(film%f + film%slope*film%tau_x**2)
      xy = w*z*film%slope*film%tau_x*film%tau_y
      yy = w*z*(film%f + film%slope*film%tau_y**2)
      j2 = sum(w*z**2*film%f)
      c = [sum(xx), sum(xy), sum(yy)]
      d = [sum(z*xx), sum(z*xy), sum(z*yy)]
   end subroutine moments

   !> A^-1 v
   pure function solve(a, v) result(x)
      real(dp), intent(in) :: a(3), v(2)
      real(dp) :: x(2), q

      ! by elimination, because the determinant of A may overflow
      q = a(2)/a(1)
      x(2) = (v(2) - q*v(1))/(a(3) - q*a(2))
      x(1) = (v(1) - a(2)*x(2))/a(1)
   end function solve

   !> Derivatives of the factors
   pure subroutine changes(b, s, a, c, d, r)
      real(dp), intent(in) :: b, s(2), a(3), c(3), d(3)
      type(factors_t), intent(inout) :: r
      !> A^-1 e_x, A^-1 C, M
      real(dp) :: by_b(2), ac(2, 2), m(3), part
      integer :: i

      by_b = solve(a, [1.0_dp, 0.0_dp])
      ac(:, 1) = solve(a, c(1:2))
      ac(:, 2) = solve(a, c(2:3))
      m = d - [c(1)*ac(1, 1) + c(2)*ac(2, 1), c(1)*ac(1, 2) + c(2)*ac(2, 2), c(2)*ac(1, 2) + c(3)*ac(2, 2)]
      r%stress_by_sliding = by_b(1)
      r%stress_by_gradient = -ac(1, :)
      r%tangent = 12.0_dp*m([1, 3])
      do i = 1, 2
         part = c(i)*by_b(1) + c(i + 1)*by_b(2)
         r%by_sliding(i) = 12.0_dp*b*part/(r%phi(i)*s(i))
         r%by_gradient(i) = (r%tangent(i) + 12.0_dp*m(2)*s(3 - i)/s(i))/r%phi(i) - 1.0_dp
      end do
   end subroutine changes
end module ehl_flow_factors

! SPDX-License-Identifier: BSD-3-Clause
!> Shear-thinning lubricants: the shear rate is
!>
!>    rate = tau F(|tau|)/eta
!>
!> with the stress tau over that of the law and the low-shear viscosity eta:
!>
!>    Eyring    F = sinh|tau|/|tau|                        (Eyring stress; Johnson & Tevaarwerk 1977)
!>    Carreau   F = (1 + tau^2)^((1 - n)/(2 n))            (stress G; Bair 2007, single Newtonian plateau, in stress form)
!>
!> In sliding without a pressure gradient B = eta |u1 - u2|/(h stress) = tau F(tau).
module ehl_thinning
   use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
   use ehl_kinds, only: dp
   implicit none (type, external)
   private
   public :: thinning_t, eyring, carreau, slopes, max_nodes

   integer, parameter :: eyring = 1, carreau = 2
   !> Below this stress the Eyring law is evaluated as a series
   real(dp), parameter :: series_below = 0.5_dp
   !> Maximum number of steps of an iteration; error below which one last step follows, which reduces the error to its cube
   integer, parameter :: max_steps = 50
   real(dp), parameter :: enough = 1.0e-4_dp
   !> Maximum number of nodes evaluated at once
   integer, parameter :: max_nodes = 64
   !> Number of derivatives of F with respect to the square of the stress
   integer, parameter :: slopes = 3

   !> A law with its parameter
   type :: thinning_t
      integer :: law = eyring
      !> [-] power-law exponent n of Carreau
      real(dp) :: exponent = 1.0_dp
   contains
      procedure :: thinness
      procedure :: slide
      procedure :: second_order_error
      procedure :: sliding_stress
      procedure :: curvature
   end type thinning_t

contains

   !> F for up to `max_nodes` squared stresses, and (dF/d|tau|)/|tau|
   pure subroutine thinness(self, square, f, slope)
      class(thinning_t), intent(in) :: self
      real(dp), contiguous, intent(in) :: square(:)
      real(dp), contiguous, intent(out) :: f(:), slope(:)
      real(dp) :: near(max_nodes), t, e, m, x, far, far_slope
      integer :: i

      if (self%law == carreau) then
         m = 0.5_dp*(1.0_dp - self%exponent)/self%exponent
         do i = 1, size(square)
            x = 1.0_dp + square(i)
            f(i) = exp(m*log(x))
            slope(i) = 2.0_dp*m*f(i)/x
         end do
      else
         ! here and below: sums with weights of 0 and 1, because compilers would branch at a `merge` of the formulas
         near(:size(square)) = merge(1.0_dp, 0.0_dp, square < series_below**2)
         do i = 1, size(square)
            x = max(square(i), series_below**2)
            t = sqrt(x)
            e = exp(t)
            far = 0.5_dp*(e - 1.0_dp/e)/t
            far_slope = (0.5_dp*(e + 1.0_dp/e) - far)/x
            x = min(square(i), series_below**2)
            f(i) = near(i)*(1.0_dp + x/6.0_dp*(1.0_dp + x/20.0_dp*(1.0_dp + x/42.0_dp*(1.0_dp + x/72.0_dp &
                            *(1.0_dp + x/110.0_dp))))) + (1.0_dp - near(i))*far
            slope(i) = near(i)*(1.0_dp + x/10.0_dp*(1.0_dp + x/28.0_dp*(1.0_dp + x/54.0_dp*(1.0_dp + x/88.0_dp))))/3.0_dp &
                       + (1.0_dp - near(i))*far_slope
         end do
      end if
   end subroutine thinness

   !> Stress in sliding without a pressure gradient, and F with its derivatives d^k F/d(tau^2)^k there
   pure subroutine slide(self, b, t, f)
      class(thinning_t), intent(in) :: self
      !> B >= 0 of at most `max_nodes` nodes
      real(dp), contiguous, intent(in) :: b(:)
      !> Shapes (nodes), (nodes or more, 0:slopes)
      real(dp), contiguous, intent(out) :: t(:), f(:, 0:)

      if (self%law == carreau) then
         call slide_carreau(self, b, t, f)
      else
         call slide_eyring(b, t, f)
      end if
   end subroutine slide

   pure subroutine slide_eyring(b, t, f)
      real(dp), contiguous, intent(in) :: b(:)
      real(dp), contiguous, intent(out) :: t(:), f(:, 0:)
      !> 1/3, 1/(3 5), 1/(3 5 7): the derivatives of Eyring at 0, times 2^k
      real(dp), parameter :: at_zero(slopes) = [1.0_dp/3.0_dp, 1.0_dp/15.0_dp, 1.0_dp/105.0_dp]
      !> Above `large`, cosh(tau) = sqrt(1 + B^2) equals B; below `small` the logarithm loses digits
      real(dp), parameter :: large = 1.0e9_dp, small = 1.0e-2_dp
      real(dp), dimension(max_nodes) :: cosh_t, short, near
      real(dp) :: x, y, far(0:slopes)
      integer :: i, n

      n = size(b)
      cosh_t(:n) = sqrt(1.0_dp + min(b, large)**2)
      cosh_t(:n) = merge(cosh_t(:n), b, b < large)
      short(:n) = merge(1.0_dp, 0.0_dp, b < small)
      do i = 1, size(b)
         y = min(b(i), small)**2
         x = b(i)*(1.0_dp - y/6.0_dp*(1.0_dp - 9.0_dp*y/20.0_dp*(1.0_dp - 25.0_dp*y/42.0_dp)))
         t(i) = short(i)*x + (1.0_dp - short(i))*log(b(i) + cosh_t(i))
      end do
      near(:n) = merge(1.0_dp, 0.0_dp, t < series_below)
      do i = 1, size(b)
         x = max(t(i), series_below)
         far(0) = b(i)/x
         far(1) = (cosh_t(i) - far(0))/x**2
         far(2) = (far(0) - 3.0_dp*far(1))/x**2
         far(3) = (far(1) - 5.0_dp*far(2))/x**2
         x = min(t(i), series_below)**2
         y = 1.0_dp - near(i)
         f(i, 0) = near(i)*(1.0_dp + x/6.0_dp*(1.0_dp + x/20.0_dp*(1.0_dp + x/42.0_dp*(1.0_dp + x/72.0_dp &
                            *(1.0_dp + x/110.0_dp))))) + y*far(0)
         f(i, 1) = 0.5_dp*(near(i)*(1.0_dp + x/10.0_dp*(1.0_dp + x/28.0_dp*(1.0_dp + x/54.0_dp*(1.0_dp + x/88.0_dp)))) &
                           *at_zero(1) + y*far(1))
         f(i, 2) = 0.25_dp*(near(i)*at_zero(2)*(1.0_dp + 0.5_dp*x/7.0_dp*(1.0_dp + 0.25_dp*x/9.0_dp)) + y*far(2))
         f(i, 3) = 0.125_dp*(near(i)*at_zero(3)*(1.0_dp + 0.5_dp*x/9.0_dp*(1.0_dp + 0.25_dp*x/11.0_dp)) + y*far(3))
      end do
   end subroutine slide_eyring

   pure subroutine slide_carreau(self, b, t, f)
      class(thinning_t), intent(in) :: self
      real(dp), contiguous, intent(in) :: b(:)
      real(dp), contiguous, intent(out) :: t(:), f(:, 0:)
      !> Smaller B count as no sliding; the square of `large` does not overflow
      real(dp), parameter :: none = 1.0e-100_dp, large = 1.0e100_dp
      !> Number of steps that suffices for all but extreme exponents
      integer, parameter :: usual_steps = 3
      real(dp), dimension(max_nodes) :: wanted, u, error
      real(dp) :: m, x, slope
      integer :: i, k

      m = 0.5_dp*(1.0_dp - self%exponent)/self%exponent
      do i = 1, size(b)
         x = max(b(i), none)
         wanted(i) = log(x)
         x = min(x, large)
         u(i) = wanted(i) + 0.5_dp*(self%exponent - 1.0_dp)*log(1.0_dp + x**2)
      end do
      ! as in sliding_stress
      do k = 1, usual_steps
         do i = 1, size(b)
            x = exp(2.0_dp*u(i))
            error(i) = u(i) + m*log(1.0_dp + x) - wanted(i)
            x = x/(1.0_dp + x)
            slope = 1.0_dp + 2.0_dp*m*x
            u(i) = u(i) - error(i)*slope/(slope**2 - 2.0_dp*error(i)*m*x*(1.0_dp - x))
         end do
         if (all(abs(error(:size(b))) < enough)) exit
      end do
      t = exp(u(:size(b)))
      do i = 1, size(b)
         if (.not. abs(error(i)) < enough) t(i) = self%sliding_stress(max(b(i), none))
      end do
      do i = 1, size(b)
         f(i, 0) = max(b(i), none)/t(i)
         x = 1.0_dp/(1.0_dp + t(i)**2)
         f(i, 1) = f(i, 0)*m*x
         f(i, 2) = f(i, 1)*(m - 1.0_dp)*x
         f(i, 3) = f(i, 2)*(m - 2.0_dp)*x
      end do
   end subroutine slide_carreau

   !> Maximum relative error of second-order factors in the gradient S, over (S^2/(1 + stress^2))^2 (Carreau) or S^4 (Eyring),
   !> with the stress in sliding alone; measured, and verified by test/test_flow.f90
   pure real(dp) function second_order_error(self) result(error)
      class(thinning_t), intent(in) :: self
      real(dp) :: m

      m = self%curvature()
      error = 1.8e-3_dp
      if (self%law == carreau) error = 0.04_dp*m + 0.17_dp*m**3
   end function second_order_error

   !> Curvature of F at small stresses: F = 1 + curvature tau^2
   pure real(dp) function curvature(self)
      class(thinning_t), intent(in) :: self
      curvature = 1.0_dp/6.0_dp
      if (self%law == carreau) curvature = 0.5_dp*(1.0_dp - self%exponent)/self%exponent
   end function curvature

   !> Stress in sliding without a pressure gradient; NaN if the iteration does not converge
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
      ! u = ln|tau|: ln|B| is between a line of slope 1 and one of slope 1/n, so that the iteration (Halley) converges
      m = 0.5_dp*(1.0_dp - self%exponent)/self%exponent
      wanted = log(abs(b))
      u = wanted
      if (u > 0.0_dp) u = self%exponent*u
      if (abs(wanted) < 10.0_dp) u = wanted + 0.5_dp*(self%exponent - 1.0_dp)*log(1.0_dp + b**2)
      do k = 1, max_steps
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

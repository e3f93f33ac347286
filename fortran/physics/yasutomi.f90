! SPDX-License-Identifier: BSD-3-Clause
!> Viscosity by the improved Yasutomi correlation (Bair, Mary, Bouscharain & Vergne 2013):
!>
!>    eta = eta_g exp{-ln(10) C1 (T - T_g) F/[C2 + (T - T_g) F]},
!>    T_g = T_g0 + A1 ln(1 + A2 p),   F = (1 + b1 p)^b2
!>
!> Where C2 + (T - T_g) F is not positive the oil is solid and its viscosity infinite.
module ehl_yasutomi
   use ehl_kinds, only: dp
   use ehl_viscosity_law, only: solid, viscosity_law_t
   implicit none (type, external)
   private
   public :: yasutomi_t, new_yasutomi

   type, extends(viscosity_law_t) :: yasutomi_t
      private
      !> A1 [K], A2 p_h, b1 p_h, b2, C1, C2 [K]
      real(dp) :: a1 = 0.0_dp, a2 = 0.0_dp, b1 = 0.0_dp, b2 = 0.0_dp, c1 = 0.0_dp, c2 = 1.0_dp
      !> Temperature of the inlet minus T_g at ambient pressure [K], ln(eta_0/eta_g)
      real(dp) :: above = 0.0_dp, level = 0.0_dp
   contains
      procedure :: log_viscosity
      procedure :: log_viscosity_at
      procedure, private :: below_glass
   end type yasutomi_t

contains

   !> The law from T_g0 [degC], A1 [K], A2 [1/Pa], b1 [1/Pa], b2, C1, C2 [K], eta_g [Pa s], the Hertz pressure [Pa] and the
   !> temperature of the inlet [degC]
   pure function new_yasutomi(tg0, a1, a2, b1, b2, c1, c2, glass, hertz_pressure, temperature) result(law)
      real(dp), intent(in) :: tg0, a1, a2, b1, b2, c1, c2, glass, hertz_pressure, temperature
      type(yasutomi_t) :: law

      law%a1 = a1
      law%a2 = a2*hertz_pressure
      law%b1 = b1*hertz_pressure
      law%b2 = b2
      law%c1 = c1
      law%c2 = c2
      law%above = temperature - tg0
      law%level = law%below_glass(0.0_dp, 0.0_dp)
      law%ambient_viscosity = glass*exp(law%level)
   end function new_yasutomi

   !> ln(eta/eta_g) at a pressure and a temperature rise [K]
   elemental real(dp) function below_glass(self, p, rise)
      class(yasutomi_t), intent(in) :: self
      real(dp), intent(in) :: p, rise
      real(dp) :: d

      d = (self%above + rise - self%a1*log(1.0_dp + self%a2*p))*exp(self%b2*log(1.0_dp + self%b1*p))
      below_glass = solid()
      if (self%c2 + d > 0.0_dp) below_glass = -log(10.0_dp)*self%c1*d/(self%c2 + d)
   end function below_glass

   !> ln(eta/eta0) at the temperature of the inlet, and its derivative with respect to p
   pure subroutine log_viscosity(self, p, values, slope)
      class(yasutomi_t), intent(in) :: self
      real(dp), intent(in) :: p(:)
      real(dp), intent(out) :: values(:), slope(:)
      real(dp) :: f, d, by_p
      integer :: i

      do i = 1, size(p)
         values(i) = self%below_glass(p(i), 0.0_dp) - self%level
         f = exp(self%b2*log(1.0_dp + self%b1*p(i)))
         d = (self%above - self%a1*log(1.0_dp + self%a2*p(i)))*f
         by_p = -self%a1*self%a2/(1.0_dp + self%a2*p(i))*f + d*self%b2*self%b1/(1.0_dp + self%b1*p(i))
         slope(i) = 0.0_dp
         if (self%c2 + d > 0.0_dp) slope(i) = -log(10.0_dp)*self%c1*self%c2*by_p/(self%c2 + d)**2
      end do
   end subroutine log_viscosity

   !> ln(eta/eta0) at temperature rises above the inlet [K]
   pure subroutine log_viscosity_at(self, p, rise, values)
      class(yasutomi_t), intent(in) :: self
      real(dp), intent(in) :: p(:), rise(:)
      real(dp), intent(out) :: values(:)
      integer :: i

      do i = 1, size(p)
         values(i) = self%below_glass(p(i), rise(i)) - self%level
      end do
   end subroutine log_viscosity_at
end module ehl_yasutomi

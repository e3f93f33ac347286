! SPDX-License-Identifier: BSD-3-Clause
!> Viscosity by Dicke, the modulus equation (Peeken, Dicke & Welsch 1992):
!>
!>    eta = eta(theta) exp{p/[a1 + a2 theta + (b1 + b2 theta) p]},   theta in degC
!>
!> Where the bracket is not positive the oil is solid and its viscosity infinite. At the temperature of the inlet, where
!> a1 + a2 theta > 0, this requires b1 + b2 theta < 0.
module ehl_dicke
   use ehl_ambient_viscosity, only: ambient_viscosity_t
   use ehl_kinds, only: dp
   use ehl_viscosity_law, only: solid, viscosity_law_t
   implicit none (type, external)
   private
   public :: dicke_t, new_dicke

   type, extends(viscosity_law_t) :: dicke_t
      private
      type(ambient_viscosity_t) :: ambient
      !> a1 and a2 over the Hertz pressure, b1, b2 [1/K]
      real(dp) :: a(2) = 0.0_dp, b(2) = 0.0_dp
      !> Temperature of the inlet [degC], ln of the viscosity there
      real(dp) :: inlet = 0.0_dp, level = 0.0_dp
   contains
      procedure :: log_viscosity
      procedure :: log_viscosity_at
   end type dicke_t

contains

   !> The law from a1 [Pa], a2 [Pa/K], b1, b2 [1/K], the Hertz pressure [Pa] and the temperature of the inlet [degC]
   pure function new_dicke(ambient, a, b, hertz_pressure, temperature) result(law)
      type(ambient_viscosity_t), intent(in) :: ambient
      real(dp), intent(in) :: a(2), b(2), hertz_pressure, temperature
      type(dicke_t) :: law

      law%ambient = ambient
      law%a = a/hertz_pressure
      law%b = b
      law%inlet = temperature
      law%level = ambient%log_viscosity(temperature)
      law%ambient_viscosity = exp(law%level)
   end function new_dicke

   !> ln(eta/eta0) at the temperature of the inlet, and its derivative with respect to p
   pure subroutine log_viscosity(self, p, values, slope)
      class(dicke_t), intent(in) :: self
      real(dp), intent(in) :: p(:)
      real(dp), intent(out) :: values(:), slope(:)
      real(dp) :: a, b, inverse
      integer :: i

      a = self%a(1) + self%a(2)*self%inlet
      b = self%b(1) + self%b(2)*self%inlet
      do i = 1, size(p)
         inverse = 1.0_dp/(a + b*p(i))
         values(i) = p(i)*inverse
         slope(i) = a*inverse*inverse
      end do
      if (b >= 0.0_dp) return
      do i = 1, size(p)
         if (a + b*p(i) > 0.0_dp) cycle
         values(i) = solid()
         slope(i) = 0.0_dp
      end do
   end subroutine log_viscosity

   !> ln(eta/eta0) at temperature rises above the inlet [K]
   pure subroutine log_viscosity_at(self, p, rise, values)
      class(dicke_t), intent(in) :: self
      real(dp), intent(in) :: p(:), rise(:)
      real(dp), intent(out) :: values(:)
      real(dp) :: a, b, theta, inverse
      integer :: i

      do i = 1, size(p)
         theta = self%inlet + rise(i)
         a = self%a(1) + self%a(2)*theta
         b = self%b(1) + self%b(2)*theta
         inverse = 1.0_dp/(a + b*p(i))
         values(i) = p(i)*inverse + (self%ambient%log_viscosity(theta) - self%level)
         if (.not. a + b*p(i) > 0.0_dp) values(i) = solid()
      end do
   end subroutine log_viscosity_at
end module ehl_dicke

! SPDX-License-Identifier: BSD-3-Clause
!> Density laws with the thermal expansion as their only oil constant: incompressible, and Dowson & Higginson 1966,
!> rho/rho0 = (5.9e8 Pa + 1.34 p)/(5.9e8 Pa + p); both decrease linearly with temperature
module ehl_simple_density
   use ehl_density_law, only: density_law_t
   use ehl_kinds, only: dp
   implicit none (type, external)
   private
   public :: incompressible_t, dowson_higginson_t, new_dowson_higginson

   !> Constants of Dowson & Higginson: pressure [Pa] and limit of rho/rho0
   real(dp), parameter :: dowson_pressure = 5.9e8_dp, dowson_limit = 1.34_dp

   type, extends(density_law_t) :: incompressible_t
      !> Relative decrease of the density with temperature [1/K]
      real(dp) :: expansion = 0.0_dp
   contains
      procedure :: density => density_incompressible
      procedure :: density_at => density_at_incompressible
   end type incompressible_t

   type, extends(density_law_t) :: dowson_higginson_t
      private
      !> 5.9e8 Pa/p_h
      real(dp) :: d0 = 1.0_dp
      !> Relative decrease of the density with temperature [1/K]
      real(dp) :: expansion = 0.0_dp
   contains
      procedure :: density
      procedure :: density_at
   end type dowson_higginson_t

contains

   !> The law from the Hertz pressure [Pa] and the thermal expansion [1/K]
   pure function new_dowson_higginson(hertz_pressure, expansion) result(law)
      real(dp), intent(in) :: hertz_pressure, expansion
      type(dowson_higginson_t) :: law

      law%d0 = dowson_pressure/hertz_pressure
      law%expansion = expansion
   end function new_dowson_higginson

   !> rho/rho0 at the temperature of the inlet, and its derivative with respect to p
   pure subroutine density(self, p, rho, slope)
      class(dowson_higginson_t), intent(in) :: self
      real(dp), intent(in) :: p(:)
      real(dp), intent(out) :: rho(:), slope(:)
      real(dp) :: inverse
      integer :: i

      do i = 1, size(p)
         inverse = 1.0_dp/(self%d0 + p(i))
         rho(i) = (self%d0 + dowson_limit*p(i))*inverse
         slope(i) = (dowson_limit - 1.0_dp)*self%d0*inverse*inverse
      end do
   end subroutine density

   !> rho/rho0 at temperature rises above the inlet [K]
   pure subroutine density_at(self, p, rise, rho)
      class(dowson_higginson_t), intent(in) :: self
      real(dp), intent(in) :: p(:), rise(:)
      real(dp), intent(out) :: rho(:)
      real(dp) :: slope(size(p))

      call self%density(p, rho, slope)
      rho = rho*(1.0_dp - self%expansion*rise)
   end subroutine density_at

   !> rho/rho0 at the temperature of the inlet, 1, and its derivative with respect to p, 0
   pure subroutine density_incompressible(self, p, rho, slope)
      class(incompressible_t), intent(in) :: self
      real(dp), intent(in) :: p(:)
      real(dp), intent(out) :: rho(:), slope(:)

      associate (unused => [self%expansion, p])
      end associate
      rho = 1.0_dp
      slope = 0.0_dp
   end subroutine density_incompressible

   !> rho/rho0 at temperature rises above the inlet [K]
   pure subroutine density_at_incompressible(self, p, rise, rho)
      class(incompressible_t), intent(in) :: self
      real(dp), intent(in) :: p(:), rise(:)
      real(dp), intent(out) :: rho(:)

      associate (unused => p)
      end associate
      rho = 1.0_dp - self%expansion*rise
   end subroutine density_at_incompressible
end module ehl_simple_density

! SPDX-License-Identifier: BSD-3-Clause
!> Shear stress of the lubricant in the contact, for friction; whether the Reynolds equation obeys the same law
module ehl_shear
   use, intrinsic :: iso_c_binding, only: c_double
   use ehl_kinds, only: dp
   use ehl_thinning, only: carreau, eyring, thinning_t
   implicit none (type, external)
   private
   public :: shear_law_t, shear_stress
   public :: shear_newtonian, shear_eyring, shear_limiting, shear_carreau

   integer, parameter :: shear_newtonian = 1, shear_eyring = 2, shear_limiting = 3, shear_carreau = 4

   !> A shear law with its parameters
   type :: shear_law_t
      integer :: law = shear_newtonian
      !> [Pa] Eyring stress, limiting stress (0: `coefficient` times pressure) or Carreau stress
      real(dp) :: stress = 0.0_dp
      !> [-] limiting shear stress over pressure
      real(dp) :: coefficient = 0.0_dp
      !> [-] power-law exponent n of Carreau
      real(dp) :: exponent = 1.0_dp
      !> [Pa] Newtonian stress eta0 |u1 - u2|/(a^2/R) of eta = eta0 and H = 1; 0: not given, or no sliding
      real(dp) :: scale = 0.0_dp
      !> [Pa] Hertz pressure
      real(dp) :: hertz_pressure = 0.0_dp
      !> Whether the flow obeys the law (Eyring and Carreau), and [Pa] p_h a/R: the stress due to dP/dX = 1 across H = 1
      logical :: in_flow = .false.
      real(dp) :: gradient_scale = 0.0_dp
   contains
      procedure :: thins
      procedure :: thins_flow
      procedure :: thinning
      procedure :: reduce
      procedure :: thinned_film
   end type shear_law_t

   interface
      !> exp(x) - 1, accurate for small x
      pure real(c_double) function expm1(x) bind(c, name="expm1")
         import :: c_double
         implicit none (type, external)
         real(c_double), intent(in), value :: x
      end function expm1
   end interface

contains

   !> Shear stress [Pa] from the Newtonian stress tau_N = eta |u1 - u2|/h [Pa] and the pressure p [Pa].
   !>
   !>    Eyring    tau_0 asinh(tau_N/tau_0)                    (Johnson & Tevaarwerk 1977)
   !>    limiting  tau_L (1 - exp(-tau_N/tau_L))               (Bair & Winer 1979), tau_L constant or coefficient times p
   !>    Carreau   tau_N (1 + (tau_N/G)^2)^((n - 1)/2)         (Bair 2007; single Newtonian plateau)
   !>    Carreau in the flow: tau (1 + (tau/G)^2)^((1 - n)/(2 n)) = tau_N, its stress form (thinning.f90)
   pure subroutine shear_stress(self, newtonian, pressure, stress)
      type(shear_law_t), intent(in) :: self
      real(dp), intent(in) :: newtonian(:), pressure(:)
      real(dp), intent(out) :: stress(:)
      type(thinning_t) :: thinning
      real(dp) :: limit
      integer :: i

      select case (self%law)
      case (shear_eyring)
         do i = 1, size(stress)
            stress(i) = self%stress*asinh(newtonian(i)/self%stress)
         end do
      case (shear_limiting)
         do i = 1, size(stress)
            limit = self%stress
            if (limit <= 0.0_dp) limit = self%coefficient*pressure(i)
            stress(i) = 0.0_dp
            if (limit > 0.0_dp) stress(i) = -limit*expm1(-newtonian(i)/limit)
         end do
      case (shear_carreau)
         if (self%in_flow) then
            thinning = self%thinning()
            stress = self%stress*thinning%sliding_stress(newtonian/self%stress)
            return
         end if
         do i = 1, size(stress)
            stress(i) = newtonian(i)*(1.0_dp + (newtonian(i)/self%stress)**2)**(0.5_dp*(self%exponent - 1.0_dp))
         end do
      case default
         stress = newtonian
      end select
   end subroutine shear_stress

   !> Whether the stress differs from the Newtonian one. Without sliding it does not: friction is the limit of vanishing
   !> sliding, in which every law is Newtonian.
   pure logical function thins(self)
      class(shear_law_t), intent(in) :: self
      thins = self%law /= shear_newtonian .and. self%scale > 0.0_dp
   end function thins

   !> Whether the flow is shear-thinning; without sliding the pressure gradient alone thins it
   pure logical function thins_flow(self)
      class(shear_law_t), intent(in) :: self
      thins_flow = self%in_flow .and. (self%law == shear_eyring .or. (self%law == shear_carreau .and. self%exponent < 1.0_dp))
   end function thins_flow

   !> Initial estimate of the central film of a shear-thinning lubricant, from that of a Newtonian one: h is proportional to
   !> eta^(2/3), with the viscosity of the inlet, where alpha p = 1, at the shear rate (u + |u1 - u2|)/h. The estimate is
   !> deliberately low, because the solver should not start with a film that is much too thick.
   pure real(dp) function thinned_film(self, newtonian, speed_parameter) result(film)
      class(shear_law_t), intent(in) :: self
      !> Newtonian film [a^2/R]; lambda_bar = 12 eta0 u/(a^2/R) over gradient_scale
      real(dp), intent(in) :: newtonian, speed_parameter
      !> Number of fixed-point steps; each changes the film by less than 0.7 of the change before
      integer, parameter :: steps = 30
      real(dp), parameter :: inlet_viscosity = exp(1.0_dp)
      type(thinning_t) :: thinning
      real(dp) :: b
      integer :: k

      film = newtonian
      if (.not. self%thins_flow()) return
      thinning = self%thinning()
      do k = 1, steps
         b = inlet_viscosity*(speed_parameter*self%gradient_scale/12.0_dp + self%scale)/(self%stress*film)
         film = newtonian*(thinning%sliding_stress(b)/b)**(2.0_dp/3.0_dp)
      end do
   end function thinned_film

   !> The shear-thinning law
   pure type(thinning_t) function thinning(self)
      class(shear_law_t), intent(in) :: self
      thinning = thinning_t(merge(carreau, eyring, self%law == shear_carreau), self%exponent)
   end function thinning

   !> Convert eta/(eta0 H) to the shear stress over `scale`, at pressures scaled by the Hertz pressure
   pure subroutine reduce(self, p, values)
      class(shear_law_t), intent(in) :: self
      real(dp), intent(in) :: p(:)
      real(dp), intent(inout) :: values(:)
      real(dp) :: newtonian(size(p)), pressure(size(p))

      newtonian = self%scale*values
      pressure = self%hertz_pressure*p
      call shear_stress(self, newtonian, pressure, values)
      values = values/self%scale
   end subroutine reduce
end module ehl_shear

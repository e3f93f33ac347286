! SPDX-License-Identifier: BSD-3-Clause
!> Flow of a lubricant that thins by shear:
!>
!>    eps_x = phi_x eps,   eps_y = phi_y eps,   eps = rho H^3/(eta lambda_bar)
!>
!> with the flow factors of physics/flow_factors.f90 at
!>
!>    B = (eta/eta0) b0/H,   b0 = eta0 |u1 - u2|/(a^2/R) over the stress of the law,
!>    S = s0 H grad P,       s0 = p_h a/R over the stress of the law,
!>
!> grad P by central differences. Node by node what is needed: no factors where they are 1 but for `negligible`, those of
!> second order in the gradient where they are right to `tolerance`, else those through the film.
module ehl_thinning_flow
   use ehl_flow, only: flow_t
   use ehl_flow_factors, only: exact_factors, factors_t, sliding_factors
   use ehl_kinds, only: dp
   use ehl_lubricant, only: lubricant_t
   use ehl_thinning, only: thinning_t
   implicit none (type, external)
   private
   public :: thinning_flow_t, new_thinning_flow

   !> Place of what concerns the flow along Y
   integer, parameter :: sideways = 2
   !> Factors that differ less from 1 than this are 1
   real(dp), parameter :: negligible = 1.0e-6_dp
   !> Relative error of factors of second order
   real(dp), parameter :: tolerance = 1.0e-4_dp

   type, extends(flow_t) :: thinning_flow_t
      private
      type(thinning_t) :: law
      !> b0, s0
      real(dp) :: sliding = 0.0_dp, gradient = 0.0_dp
   contains
      procedure :: find_row
      procedure :: film_power
      procedure :: stress_row
      procedure, private :: factors_at
      procedure, private :: gradients
   end type thinning_flow_t

contains

   !> A flow by its law; b0 and s0 as above
   pure function new_thinning_flow(law, sliding, gradient) result(flow)
      type(thinning_t), intent(in) :: law
      real(dp), intent(in) :: sliding, gradient
      type(thinning_flow_t) :: flow

      flow%law = law
      flow%sliding = sliding
      flow%gradient = gradient
      flow%across = sideways
      flow%bends = .true.
   end function new_thinning_flow

   !> Conductances of row j and their changes
   pure subroutine find_row(self, lubricant, p, h, rho, drho_dp, j, last)
      class(thinning_flow_t), intent(inout) :: self
      type(lubricant_t), intent(in) :: lubricant
      !> Pressure and film, shape (nx, ny)
      real(dp), contiguous, intent(in) :: p(:, :), h(:, :)
      !> Density of the row and its change with P, shape (nx)
      real(dp), contiguous, intent(in) :: rho(:), drho_dp(:)
      integer, intent(in) :: j, last
      type(factors_t) :: factors
      real(dp), dimension(size(p, 1)) :: log_eta, slope
      real(dp) :: s(2, size(p, 1)), eta, newtonian
      integer :: i

      call lubricant%log_viscosity(p(:last, j), log_eta(:last), slope(:last))
      if (last < size(p, 1)) then
         call lubricant%log_viscosity([0.0_dp], log_eta(last + 1:last + 1), slope(last + 1:last + 1))
         log_eta(last + 2:) = log_eta(last + 1)
         slope(last + 2:) = slope(last + 1)
      end if
      call self%gradients(p, h, j, s)
      do i = 1, size(p, 1)
         eta = exp(log_eta(i))
         newtonian = rho(i)*h(i, j)**3/eta*self%inverse_speed
         factors = self%factors_at(eta/h(i, j), s(:, i))
         self%eps(i, j, :) = factors%phi*newtonian
         self%tangent(i, j, :) = factors%tangent*newtonian
         self%powers(i, j, :) = 3.0_dp - factors%by_sliding + factors%by_gradient
         self%dlneps_dp(i, j, :) = drho_dp(i)/rho(i) - slope(i)*(1.0_dp - factors%by_sliding)
         if (self%sliding > 0.0_dp) then
            self%stress(i, j) = factors%stress/self%sliding
         else
            ! in the limit of vanishing sliding
            self%stress(i, j) = eta/h(i, j)*factors%stress_by_sliding
         end if
      end do
   end subroutine find_row

   !> Factors of a node by its eta/(eta0 H) and S, with what it needs
   pure function factors_at(self, newtonian, s) result(factors)
      class(thinning_flow_t), intent(in) :: self
      real(dp), intent(in) :: newtonian, s(2)
      type(factors_t) :: factors
      real(dp) :: b

      b = abs(self%sliding*newtonian)
      if (self%law%curvature()*(3.0_dp*b**2 + 0.15_dp*dot_product(s, s)) < negligible) then
         factors%stress = b
      else
         factors = sliding_factors(self%law, b, s)
         if (factors%error > tolerance) factors = exact_factors(self%law, b, s)
      end if
   end function factors_at

   !> S at the nodes of row j; at the border along Y without its part along Y
   pure subroutine gradients(self, p, h, j, s)
      class(thinning_flow_t), intent(in) :: self
      !> Shape (nx, ny)
      real(dp), contiguous, intent(in) :: p(:, :), h(:, :)
      integer, intent(in) :: j
      !> Shape (2, nx)
      real(dp), intent(out) :: s(:, :)
      integer :: i, north, south, nx

      nx = size(p, 1)
      south = self%grid%south(j)
      north = j + 1
      if (j == size(p, 2)) north = south
      s(1, 1) = (p(2, j) - p(1, j))/self%grid%hx
      s(1, nx) = (p(nx, j) - p(nx - 1, j))/self%grid%hx
      do i = 2, nx - 1
         s(1, i) = (p(i + 1, j) - p(i - 1, j))/(2.0_dp*self%grid%hx)
      end do
      do i = 1, nx
         s(2, i) = (p(i, north) - p(i, south))/(2.0_dp*self%grid%hy)
         s(:, i) = s(:, i)*self%gradient*h(i, j)
      end do
   end subroutine gradients

   !> d ln(eps)/d ln(H)
   pure real(dp) function film_power(self, i, j, direction)
      class(thinning_flow_t), intent(in) :: self
      integer, intent(in) :: i, j, direction
      film_power = self%powers(i, j, direction)
   end function film_power

   !> Newtonian and real shear stress of row j, the latter as find_row left it
   pure subroutine stress_row(self, lubricant, p, h, rho, j, newtonian, stress)
      class(thinning_flow_t), intent(in) :: self
      type(lubricant_t), intent(in) :: lubricant
      !> Pressure and film, shape (nx, ny)
      real(dp), contiguous, intent(in) :: p(:, :), h(:, :)
      !> Density of the row, shape (nx)
      real(dp), contiguous, intent(in) :: rho(:)
      integer, intent(in) :: j
      real(dp), contiguous, intent(out) :: newtonian(:), stress(:)
      real(dp), dimension(size(p, 1)) :: log_eta, slope

      associate (unused => rho)
      end associate
      call lubricant%log_viscosity(p(:, j), log_eta, slope)
      newtonian = exp(log_eta)/h(:, j)
      stress = self%stress(:, j)
   end subroutine stress_row
end module ehl_thinning_flow

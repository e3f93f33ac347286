! SPDX-License-Identifier: BSD-3-Clause
!> Flow of a shear-thinning lubricant:
!>
!>    eps_x = phi_x eps,   eps_y = phi_y eps,   eps = (rho/rho0) H^3/[(eta/eta0) lambda_bar]
!>
!> with the flow factors of physics/flow_factors.f90 at
!>
!>    B = (eta/eta0) b0/H,   b0 = eta0 |u1 - u2|/(a^2/R) over the stress of the law,
!>    S = s0 H grad P,       s0 = p_h a/R over the stress of the law,
!>
!> grad P by central differences; factors by physics/factor_rows.f90, or from the cache (physics/cached_factors.f90).
module ehl_shear_thinning_flow
   use ehl_flow, only: dir_x, flow_t
   use ehl_factor_rows, only: factor_rows_t
   use ehl_kinds, only: dp
   use ehl_lubricant, only: lubricant_t
   use ehl_thinning, only: max_nodes, thinning_t
   implicit none (type, external)
   private
   public :: shear_thinning_flow_t, new_shear_thinning_flow

   !> Index of the flow along Y
   integer, parameter :: dir_y = 2

   type, extends(flow_t) :: shear_thinning_flow_t
      private
      !> b0, s0
      real(dp) :: sliding = 0.0_dp, gradient = 0.0_dp
      !> Factor of both, see `soften`
      real(dp) :: fraction = 1.0_dp
   contains
      procedure :: rescale
      procedure :: soften
      procedure :: find_row
      procedure :: film_exponent
      procedure :: stress_row
      procedure, private :: gradients
   end type shear_thinning_flow_t

contains

   !> Create a flow from its law; b0 and s0 as above
   pure function new_shear_thinning_flow(law, sliding, gradient) result(flow)
      type(thinning_t), intent(in) :: law
      real(dp), intent(in) :: sliding, gradient
      type(shear_thinning_flow_t) :: flow

      flow%cached%law = law
      flow%sliding = sliding
      call extrapolate_if_sliding(flow)
      flow%gradient = gradient
      flow%dir_y = dir_y
      flow%depends_on_gradient = .true.
   end function new_shear_thinning_flow

   !> Change the viscosity and the sliding speed
   pure subroutine rescale(self, inverse_speed, stress)
      class(shear_thinning_flow_t), intent(inout) :: self
      real(dp), intent(in) :: inverse_speed
      !> b0
      real(dp), intent(in) :: stress

      self%inverse_speed = inverse_speed
      self%sliding = stress
      call extrapolate_if_sliding(self)
   end subroutine rescale

   !> Extrapolate cached factors only while the surfaces slide: the change of the stress over the sliding with the gradient, in the
   !> limit of vanishing sliding, is not known
   pure subroutine extrapolate_if_sliding(flow)
      class(shear_thinning_flow_t), intent(inout) :: flow
      call flow%cached%extrapolate(flow%sliding > 0.0_dp)
   end subroutine extrapolate_if_sliding

   !> Weaken shear thinning as if the stress of the law were 1/fraction times as large
   subroutine soften(self, fraction)
      class(shear_thinning_flow_t), intent(inout) :: self
      real(dp), intent(in) :: fraction

      if (.not. abs(fraction - self%fraction) > 0.0_dp) return
      self%fraction = fraction
      call self%cached%forget()
   end subroutine soften

   !> Conductances of row j and their derivatives
   pure subroutine find_row(self, lubricant, p, h, rho, drho_dp, j, last)
      class(shear_thinning_flow_t), intent(inout) :: self
      type(lubricant_t), intent(in) :: lubricant
      !> Pressure, shape (nx, ny)
      real(dp), contiguous, intent(in) :: p(:, :)
      !> Film, density and its derivative with respect to P in row j, shape (nx)
      real(dp), contiguous, intent(in) :: h(:), rho(:), drho_dp(:)
      integer, intent(in) :: j, last
      type(factor_rows_t) :: factors
      real(dp), dimension(max_nodes) :: b, newtonian, by_density
      real(dp) :: log_eta(size(p, 1)), slope(size(p, 1)), s(max_nodes, 2)
      integer :: segment, first, n, i, k
      logical :: is_newtonian

      call lubricant%log_viscosity(p(:last, j), log_eta(:last), slope(:last))
      if (last < size(p, 1)) then
         call lubricant%log_viscosity([0.0_dp], log_eta(last + 1:last + 1), slope(last + 1:last + 1))
         log_eta(last + 2:) = log_eta(last + 1)
         slope(last + 2:) = slope(last + 1)
      end if
      do segment = 1, (size(p, 1) - 1)/self%cached%width + 1
         first = (segment - 1)*self%cached%width + 1
         n = min(self%cached%width, size(p, 1) - first + 1)
         call self%gradients(p, h, j, first, n, s)
         do k = 1, n
            i = first + k - 1
            newtonian(k) = exp(log_eta(i))
            b(k) = abs(self%fraction*self%sliding*newtonian(k)/h(i))
            newtonian(k) = rho(i)*h(i)**3/newtonian(k)*self%inverse_speed
            by_density(k) = drho_dp(i)/rho(i)
         end do
         call self%cached%find(b(:n), s, segment, j, factors, is_newtonian)
         do k = dir_x, dir_y
            if (is_newtonian) then
               do i = first, first + n - 1
                  self%eps(i, j, k) = newtonian(i - first + 1)
                  self%tangent(i, j, k) = newtonian(i - first + 1)
                  self%dlneps_dp(i, j, k) = by_density(i - first + 1) - slope(i)
               end do
            else
               do i = first, first + n - 1
                  associate (m => i - first + 1)
                     self%eps(i, j, k) = factors%phi(m, k)*newtonian(m)
                     self%tangent(i, j, k) = factors%tangent(m, k)*newtonian(m)
                     self%dlneps_dp(i, j, k) = by_density(m) - slope(i)*(1.0_dp - factors%by_sliding(m, k))
                  end associate
               end do
            end if
         end do
      end do
   end subroutine find_row

   !> S at n nodes of row j from column `first` on; its component along Y is 0 at the border along Y
   pure subroutine gradients(self, p, h, j, first, n, s)
      class(shear_thinning_flow_t), intent(in) :: self
      !> Pressure, shape (nx, ny); film of the row
      real(dp), contiguous, intent(in) :: p(:, :), h(:)
      integer, intent(in) :: j, first, n
      !> Along X and along Y, shape (n or more, 2)
      real(dp), contiguous, intent(inout) :: s(:, :)
      real(dp) :: rx, ry
      integer :: i, k, north, south, last

      rx = 0.5_dp*self%fraction*self%gradient/self%grid%hx
      ry = 0.5_dp*self%fraction*self%gradient/self%grid%hy
      last = first + n - 1
      south = self%grid%south(j)
      north = self%grid%north(j)
      if (north > size(p, 2)) north = south
      if (first == 1) s(1, 1) = 2.0_dp*rx*h(1)*(p(2, j) - p(1, j))
      if (last == size(p, 1)) s(n, 1) = 2.0_dp*rx*h(last)*(p(last, j) - p(last - 1, j))
      do i = max(first, 2), min(last, size(p, 1) - 1)
         s(i - first + 1, 1) = rx*h(i)*(p(i + 1, j) - p(i - 1, j))
      end do
      do k = 1, n
         i = first + k - 1
         s(k, 2) = ry*h(i)*(p(i, north) - p(i, south))
      end do
   end subroutine gradients

   !> d ln(eps)/d ln(H)
   pure real(dp) function film_exponent(self, i, j, direction)
      class(shear_thinning_flow_t), intent(in) :: self
      integer, intent(in) :: i, j, direction
      film_exponent = self%cached%film_exponent(i, j, direction)
   end function film_exponent

   !> Shear stress of row j, with the factors that find_row has stored
   pure subroutine stress_row(self, lubricant, p, h, rho, j, newtonian, stress)
      class(shear_thinning_flow_t), intent(in) :: self
      type(lubricant_t), intent(in) :: lubricant
      !> Pressure, shape (nx, ny)
      real(dp), contiguous, intent(in) :: p(:, :)
      !> Film and density of the row, shape (nx)
      real(dp), contiguous, intent(in) :: h(:), rho(:)
      integer, intent(in) :: j
      real(dp), contiguous, intent(out) :: newtonian(:), stress(:)
      real(dp), dimension(size(p, 1)) :: log_eta, slope
      real(dp) :: b(max_nodes), s(max_nodes, 2), by_sliding(max_nodes)
      integer :: segment, first, last

      associate (unused => rho)
      end associate
      call lubricant%log_viscosity(p(:, j), log_eta, slope)
      newtonian = exp(log_eta)/h
      do segment = 1, (size(p, 1) - 1)/self%cached%width + 1
         first = (segment - 1)*self%cached%width + 1
         last = min(first + self%cached%width - 1, size(p, 1))
         associate (n => last - first + 1)
            call self%gradients(p, h, j, first, n, s)
            b(:n) = abs(self%fraction*self%sliding*newtonian(first:last))
            call self%cached%stress(b(:n), s, segment, j, stress(first:last), by_sliding(:n))
            if (self%sliding > 0.0_dp) then
               stress(first:last) = stress(first:last)/(self%fraction*self%sliding)
            else
               ! in the limit of vanishing sliding
               stress(first:last) = newtonian(first:last)*by_sliding(:n)
            end if
         end associate
      end do
   end subroutine stress_row
end module ehl_shear_thinning_flow

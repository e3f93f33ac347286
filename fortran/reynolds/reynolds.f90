! SPDX-License-Identifier: BSD-3-Clause
!> The three equations on one level: Reynolds equation, film and force balance.
!>
!> Reynolds equation: where the lubricant fills the gap (P > 0)
!>
!>    d/dX (eps_x dP/dX) + d/dY (eps_y dP/dY) - d(rho H)/dX - d(rho H)/dT = 0
!>
!> and P = 0 elsewhere, where the left-hand side is not positive: nothing flows out of a cavitated node, or, with a starved
!> inlet, all oil that it receives (supply.f90). P on the border is 0, or that of a flooded contact (far_field.f90). eps_x and
!> eps_y are the conductances (flow.f90), for a Newtonian lubricant both rho H^3/(eta lambda_bar); rho and eta depend on P
!> (physics/lubricant.f90), H on the whole pressure field.
!>
!> Discrete, at node (i, j), with m = rho H:
!>
!>    [e_x(i+1/2) (P(i+1) - P(i)) - e_x(i-1/2) (P(i) - P(i-1))]/hx^2
!>    + [e_y(j+1/2) (P(j+1) - P(j)) - e_y(j-1/2) (P(j) - P(j-1))]/hy^2        poiseuille.f90
!>    - [c0 m(i) + c1 m(i-1) + c2 m(i-2)]                                     wedge.f90, implicit part
!>    = rhs
!>
!> where e(i+1/2) = (eps(i) + eps(i+1))/2. By scheme, with ' and " for one and two time steps ago:
!>
!>    steady     c = (3/2, -2, 1/2)/hx                         rhs = 0
!>    narrow     c = (3/2, 0, 0)/dT                            rhs = [-2 m'(i-1) + m"(i-2)/2]/dT
!>    separate   c = (3/2, -2, 1/2)/hx + (3/2, 0, 0)/dT        rhs = [-2 m'(i) + m"(i)/2]/dT
!>
!> (narrow: both terms along the characteristic, dT = hx; separate: at constant speed and step, otherwise see wedge.f90). On the
!> levels below the finest rhs is that of the full approximation scheme (multigrid/coarse_problem.f90), and the first two lines may
!> be a Galerkin product.
!>
!> Zhang et al. 2019, eqs. 1, 7 and 8; the narrow scheme: Venner & Lubrecht 2000.
!>
!> Film, with the rigid separation H00, the gap G of the undeformed bodies minus the roughness, whose peaks are positive
!> (X^2/2 + D Y^2/2 - RR with the ratio of radii D; on a coarse level what multigrid/coarse_problem.f90 sets), and the elastic
!> deflection K P = k_b iint P dX' dY'/r of the level's engine:
!>
!>    H(X, Y) = H00 + G(X, Y) + (K P)(X, Y)
!>
!> Force balance, which determines H00 on the coarsest grid (multigrid/coarsest.f90):
!>
!>    iint P dX dY = load,   discrete: sum over the nodes of P hx hy = load
!>
!> (twice for nodes that have a mirror image). On the finest grid the load is that of the contact, 2 pi/3 for a ball on a
!> flat, minus the load beyond the border (far_field.f90). On a coarser grid it is the sum of the restricted pressure
!> plus the missing load of the finer grid.
module ehl_reynolds
   use ehl_flow, only: dir_x
   use ehl_kernel, only: coefficient
   use ehl_grid, only: grid_t
   use ehl_kinds, only: dp
   use ehl_level, only: cavity_pressure, last_flowing, level_t, zero_inactive_residual
   use ehl_wedge, only: wedge_reach
   implicit none (type, external)
   private
   public :: balance_load, film_residual, flow_operator, load_excess, missing_load, restrict_load, refresh, reynolds_operator, &
             update_coefficients, update_residual

contains

   !> Row j of the Reynolds operator (the left-hand side above; at touching nodes that of boundary_film.f90), zero at the
   !> borders
   pure subroutine reynolds_operator(level, j, values)
      type(level_t), intent(in) :: level
      integer, intent(in) :: j
      !> Shape (nx)
      real(dp), contiguous, intent(out) :: values(:)

      call flow_operator(level, j, values)
      call level%boundary%operator_row(level%mass_content(:, j), j, values)
   end subroutine reynolds_operator

   !> Row j of the Reynolds operator without touching nodes
   pure subroutine flow_operator(level, j, values, passing, missing, short)
      type(level_t), intent(in) :: level
      integer, intent(in) :: j
      !> Shape (nx)
      real(dp), contiguous, intent(out) :: values(:)
      !> Which nodes pass on all oil that they receive (supply.f90)
      logical, contiguous, intent(out), optional :: passing(:)
      !> Deficit of the flow, over hx, and of the mass content of nodes (supply.f90)
      real(dp), contiguous, intent(out), optional :: missing(:), short(:)
      integer :: nx

      nx = level%grid%nx
      values(1) = 0.0_dp
      values(nx) = 0.0_dp
      if (level%grid%is_border(j)) then
         if (present(passing)) passing = .false.
         if (present(missing)) missing = 0.0_dp
         if (present(short)) short = 0.0_dp
         values(2:nx - 1) = 0.0_dp
         return
      end if
      call level%poiseuille%apply_row(level%p, level%flow, j, values)
      call level%wedge%subtract_row(level%mass_content(:, j), values)
      if (present(passing)) passing = .false.
      if (present(missing)) missing = 0.0_dp
      if (present(short)) short = 0.0_dp
      if (level%supply%active) call level%supply%transport_row(level%p(:, j) <= cavity_pressure, level%mass_content(:, j), &
                                                               level%rhs(:, j), j, values, passing, missing, short)
   end subroutine flow_operator

   !> Find the nodes that touch for the present pressure, film and coefficients
   subroutine find_touching(level)
      type(level_t), intent(inout) :: level
      real(dp), dimension(level%grid%nx) :: row, fraction, elastic
      real(dp) :: weights(0:wedge_reach, level%grid%nx)
      real(dp) :: stored, flow
      integer :: i, j

      level%boundary%rate = level%wedge%rate()
      stored = level%boundary%rate*coefficient(level%grid, level%kernel_factor, 0, 0)
      flow = level%poiseuille%flow_rate()
      do i = 1, level%grid%nx
         weights(:, i) = level%wedge%weights(i)
      end do
      !$omp parallel do default(none) shared(level, stored, flow, weights) private(i, row, fraction, elastic) &
      !$omp num_threads(level%threads) if(level%parallel) schedule(static)
      do j = level%grid%first_inner(), level%grid%last_inner()
         call flow_operator(level, j, row)
         do i = 1, level%grid%nx
            row(i) = level%rhs(i, j) - row(i)
            fraction(i) = stored/(stored + flow*level%flow%eps(i, j, dir_x))
         end do
         elastic = level%rho(:, j)*level%h(:, j)
         call level%boundary%find_row(level%p(:, j), weights, elastic, fraction, j, row, level%mass_content(:, j))
      end do
      !$omp end parallel do
   end subroutine find_touching

   !> residual = rhs - operator where P > 0; where P = 0 only the part that requires pressure
   !> (residual < 0). Returns the rms over the grid.
   subroutine update_residual(level, rms)
      type(level_t), intent(inout) :: level
      real(dp), intent(out) :: rms
      real(dp) :: sums(level%grid%ny), row(level%grid%nx)
      integer :: i, j

      !$omp parallel do default(none) shared(level, sums) private(i, row) &
      !$omp num_threads(level%threads) if(level%parallel) schedule(static)
      do j = 1, level%grid%ny
         call reynolds_operator(level, j, row)
         level%residual(1, j) = 0.0_dp
         level%residual(level%grid%nx, j) = 0.0_dp
         do i = 2, level%grid%nx - 1
            level%residual(i, j) = level%rhs(i, j) - row(i)
         end do
         call level%boundary%residual_row(level%rhs(:, j), level%mass_content(:, j), j, level%residual(:, j))
         call zero_inactive_residual(level%p(:, j), level%residual(:, j))
         if (level%grid%is_border(j)) level%residual(:, j) = 0.0_dp
         sums(j) = sum(level%residual(:, j)**2)*level%grid%images(j)
      end do
      !$omp end parallel do
      rms = sqrt(sum(sums)/(real(level%grid%nx, dp)*level%grid%full_ny()))
      call level%boundary%set_lift(merge(0.0_dp, rms, level%wedge%squeeze > 0.0_dp))
   end subroutine update_residual

   !> Residual (rms) weighted by its effect on the film: the weight of a node is the fraction of the diagonal that is due to
   !> the deflection; the rest is the Poiseuille term. In the far inlet, where eps/h^2 is 1e8, a residual of 1
   !> corresponds to a pressure error of 1e-9. Needs the residual of the present state.
   real(dp) function film_residual(level)
      type(level_t), intent(in) :: level
      real(dp) :: sums(level%grid%ny), eps(level%grid%nx), wedge, poiseuille
      integer :: j

      associate (grid => level%grid)
         wedge = coefficient(grid, level%kernel_factor, 0, 0)/grid%hx
         poiseuille = level%poiseuille%flow_rate()
         !$omp parallel do default(none) shared(level, sums, wedge, poiseuille) private(eps) &
         !$omp num_threads(level%threads) if(level%parallel) schedule(static)
         do j = 1, grid%ny
            eps = level%flow%eps(:, j, dir_x)
            call level%boundary%zero_touching(1, j, eps)
            sums(j) = sum((level%residual(:, j)*wedge/(wedge + poiseuille*eps))**2) &
                      *level%grid%images(j)
         end do
         !$omp end parallel do
         film_residual = sqrt(sum(sums)/(real(grid%nx, dp)*grid%full_ny()))
      end associate
   end function film_residual

   !> Update film and coefficients for the present pressure
   subroutine refresh(level)
      type(level_t), intent(inout) :: level
      call update_film(level)
      call update_coefficients(level)
   end subroutine refresh

   !> Deflection and film for the present pressure
   subroutine update_film(level)
      type(level_t), intent(inout) :: level
      integer :: j

      call level%engine%apply(level%p, level%h)
      !$omp parallel do default(none) shared(level) num_threads(level%threads) if(level%parallel) schedule(static)
      do j = 1, level%grid%ny
         level%h(:, j) = level%h00 + level%film_rhs(:, j) + level%h(:, j)
      end do
      !$omp end parallel do
   end subroutine update_film

   !> Density, mass content and conductances for the present pressure and film; a level whose Poiseuille term is frozen
   !> keeps its conductances. Downstream of the last node of a row with pressure the lubricant is that at P = 0.
   subroutine update_coefficients(level)
      type(level_t), intent(inout) :: level
      real(dp) :: rest_rho(1), rest_slope(1)
      integer :: j, last

      call level%lubricant%density([0.0_dp], rest_rho, rest_slope)
      !$omp parallel do default(none) shared(level, rest_rho, rest_slope) private(last) &
      !$omp num_threads(level%threads) if(level%parallel) schedule(static, 8)
      do j = 1, level%grid%ny
         last = last_flowing(level%p(:, j))
         call level%lubricant%density(level%p(:last, j), level%rho(:last, j), level%h_drho_dp(:last, j))
         level%rho(last + 1:, j) = rest_rho(1)
         level%h_drho_dp(last + 1:, j) = rest_slope(1)
         call level%boundary%find_film(level%h(:, j), level%rho(:, j), j)
         if (.not. level%poiseuille%frozen) call level%flow%find_row( &
            level%lubricant, level%p, level%boundary%film_row(level%h(:, j), j), level%rho(:, j), level%h_drho_dp(:, j), j, last)
         level%mass_content(:, j) = level%rho(:, j)*level%h(:, j)
         level%h_drho_dp(:, j) = level%h_drho_dp(:, j)*level%h(:, j)
      end do
      !$omp end parallel do
      if (.not. level%poiseuille%frozen) then
         do j = 1, size(level%flow%eps, 3)
            call end_with_body(level%grid, level%flow%eps(:, :, j))
         end do
      end if
      if (level%boundary%follows_state()) call find_touching(level)
   end subroutine update_coefficients

   !> At border rows where the bodies end there is no film: oil flows out with the conductance of the adjacent inner rows
   pure subroutine end_with_body(grid, values)
      type(grid_t), intent(in) :: grid
      !> Shape (nx, ny)
      real(dp), contiguous, intent(inout) :: values(:, :)

      if (.not. grid%ends) return
      values(:, grid%ny) = values(:, grid%ny - 1)
      if (.not. grid%mirror) values(:, 1) = values(:, 2)
   end subroutine end_with_body

   !> Required load minus the sum of the pressure
   real(dp) function missing_load(level)
      type(level_t), intent(in) :: level
      missing_load = level%load - pressure_sum(level)
   end function missing_load

   !> Relative error of the force balance; positive: the pressure is too large
   real(dp) function load_excess(level)
      type(level_t), intent(in) :: level
      load_excess = pressure_sum(level)/level%load - 1.0_dp
   end function load_excess

   !> Load of a coarse level: the missing load of the fine level, plus the load of the restricted pressure
   subroutine restrict_load(fine, coarse)
      type(level_t), intent(in) :: fine
      type(level_t), intent(inout) :: coarse
      coarse%load = missing_load(fine) + pressure_sum(coarse)
   end subroutine restrict_load

   !> Correct a small relative error of the force balance by scaling the pressure inside the border (in line contacts the part
   !> above the border pressure) except at yielding nodes; H00 is adapted to keep the mean film under the pressure. Film
   !> and coefficients are up to date before and after.
   subroutine balance_load(level)
      type(level_t), intent(inout) :: level
      real(dp) :: factor, border, deflection(level%grid%ny), after(level%grid%nx)
      integer :: j, nx

      nx = level%grid%nx
      border = 0.0_dp
      if (level%grid%periodic) border = max(maxval(level%p(1, :)), maxval(level%p(nx, :)))
      factor = 1.0_dp/(1.0_dp + load_excess(level)/(1.0_dp - fixed_load(level, border)/level%load))
      !$omp parallel do default(none) shared(level, factor, border, deflection, nx) private(after) &
      !$omp num_threads(level%threads) if(level%parallel) schedule(static)
      do j = 1, level%grid%ny
         deflection(j) = sum(level%p(:, j)*(level%h(:, j) - level%h00 - level%film_rhs(:, j)))*level%grid%weight(j)
         if (level%grid%is_border(j)) cycle
         ! a pressure step beside the border, where the conductance is highest, would cause a large residual
         after(2:nx - 1) = factor*level%p(2:nx - 1, j) - (factor - 1.0_dp)*min(level%p(2:nx - 1, j), border)
         call level%boundary%yielding%limit_pressure(level%p(2:nx - 1, j), 2, j, after(2:nx - 1))
         level%p(2:nx - 1, j) = after(2:nx - 1)
      end do
      !$omp end parallel do
      level%h00 = level%h00 + (factor - factor**2)*sum(deflection)/level%load
      call refresh(level)
   end subroutine balance_load

   !> Part of the load that is not scaled: at the border, at yielding nodes, and in line contacts up to the border pressure
   pure real(dp) function fixed_load(level, border)
      type(level_t), intent(in) :: level
      !> Pressure that is not scaled
      real(dp), intent(in) :: border
      integer :: j

      fixed_load = 0.0_dp
      do j = 1, level%grid%ny
         if (level%grid%is_border(j)) then
            fixed_load = fixed_load + sum(level%p(:, j))*level%grid%weight(j)
         else
            if (level%grid%periodic) then
               fixed_load = fixed_load + sum(min(level%p(:, j), border))*level%grid%weight(j)
            else
               fixed_load = fixed_load + (level%p(1, j) + level%p(level%grid%nx, j))*level%grid%weight(j)
            end if
            fixed_load = fixed_load + sum(level%p(:, j) - min(level%p(:, j), border), &
                                          mask=level%boundary%yielding%nodes(level%grid%nx, j))*level%grid%weight(j)
         end if
      end do
   end function fixed_load

   !> hx hy sum P over the whole contact
   real(dp) function pressure_sum(level)
      type(level_t), intent(in) :: level
      real(dp) :: sums(level%grid%ny)
      integer :: j

      !$omp parallel do default(none) shared(level, sums) &
      !$omp num_threads(level%threads) if(level%parallel) schedule(static)
      do j = 1, level%grid%ny
         sums(j) = sum(level%p(:, j))*level%grid%weight(j)
      end do
      !$omp end parallel do
      pressure_sum = sum(sums)
   end function pressure_sum
end module ehl_reynolds

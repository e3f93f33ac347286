! SPDX-License-Identifier: BSD-3-Clause
!> The Reynolds equation on one level. Where the lubricant fills the gap (P > 0)
!>
!>    d/dX (eps_x dP/dX) + d/dY (eps_y dP/dY) - d(rho H)/dX - d(rho H)/dT = 0
!>
!> and P = 0 elsewhere, where the left-hand side is not positive: P >= 0 and nothing flows out of a cavity, or what does is what
!> arrives there (supply.f90). P is given on the border: 0, or that of a flooded contact (far_field.f90). eps_x and eps_y are the conductances (flow.f90), for a Newtonian
!> lubricant both rho H^3/(eta lambda_bar); rho and eta depend on P (physics/lubricant.f90), H on all of P (film.f90), and its
!> constant H00 on the force balance (force_balance.f90).
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
!> (narrow: both terms along the characteristic, dT = hx). On the levels below the finest rhs is that of the full
!> approximation scheme (multigrid/coarse_problem.f90), and the first two lines may be a Galerkin product.
!>
!> Zhang et al. 2019, eqs. 1, 7 and 8; the narrow scheme: Venner & Lubrecht 2000.
module ehl_reynolds
   use ehl_flow, only: dir_x
   use ehl_kernel, only: coefficient
   use ehl_kinds, only: dp
   use ehl_level, only: level_t
   use ehl_node_state, only: zero_inactive_residual
   use ehl_wedge, only: wedge_reach
   implicit none (type, external)
   private
   public :: film_residual, find_touching, flow_operator, reynolds_operator, update_residual

contains

   !> Row j of the Reynolds operator (the left-hand side above; where nodes touch that of boundary_film.f90), zero at the
   !> borders
   pure subroutine reynolds_operator(level, j, values)
      type(level_t), intent(in) :: level
      integer, intent(in) :: j
      !> Shape (nx)
      real(dp), contiguous, intent(out) :: values(:)

      call flow_operator(level, j, values)
      call level%boundary%operator_row(level%mass_content(:, j), j, values)
   end subroutine reynolds_operator

   !> The same as if no node touched
   pure subroutine flow_operator(level, j, values, passing)
      type(level_t), intent(in) :: level
      integer, intent(in) :: j
      !> Shape (nx)
      real(dp), contiguous, intent(out) :: values(:)
      !> Which nodes pass on all oil that they receive (supply.f90)
      logical, contiguous, intent(out), optional :: passing(:)
      integer :: nx

      nx = level%grid%nx
      values(1) = 0.0_dp
      values(nx) = 0.0_dp
      if (level%grid%is_border(j)) then
         if (present(passing)) passing = .false.
         values(2:nx - 1) = 0.0_dp
         return
      end if
      call level%poiseuille%apply_row(level%p, level%flow, j, values)
      call level%wedge%subtract_row(level%mass_content(:, j), values)
      call level%supply%transport_row(level%p(:, j), level%mass_content(:, j), j, values, passing)
   end subroutine flow_operator

   !> Which nodes touch, for the present pressure, film and coefficients
   subroutine find_touching(level)
      type(level_t), intent(inout) :: level
      real(dp), dimension(level%grid%nx) :: row, share, elastic
      real(dp) :: weights(0:wedge_reach, level%grid%nx)
      real(dp) :: stored, flow
      integer :: i, j

      level%boundary%rate = level%wedge%rate()
      stored = level%boundary%rate*coefficient(level%grid, level%kernel_factor, 0, 0)
      flow = level%poiseuille%flow_rate()
      do i = 1, level%grid%nx
         weights(:, i) = level%wedge%weights(i)
      end do
      !$omp parallel do default(none) shared(level, stored, flow, weights) private(i, row, share, elastic) &
      !$omp num_threads(level%threads) if(level%parallel) schedule(static)
      do j = level%grid%first_inner(), level%grid%last_inner()
         call flow_operator(level, j, row)
         do i = 1, level%grid%nx
            row(i) = level%rhs(i, j) - row(i)
            share(i) = stored/(stored + flow*level%flow%eps(i, j, dir_x))
         end do
         elastic = level%rho(:, j)*level%h(:, j)
         call level%boundary%find_yielding(level%p(:, j), weights, j, row, level%mass_content(:, j))
         call level%boundary%find_row(elastic, row, share, j)
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

   !> Residual (rms) as far as it concerns the film: each with the share that the deflection by the node's own pressure
   !> has in what answers it, the rest being the Poiseuille term. In the far inlet, where eps/h^2 is 1e8, a residual of 1
   !> is a pressure of 1e-9. Needs the residual of the present state.
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
            call level%boundary%without_touching(1, j, eps)
            sums(j) = sum((level%residual(:, j)*wedge/(wedge + poiseuille*eps))**2) &
                      *level%grid%images(j)
         end do
         !$omp end parallel do
         film_residual = sqrt(sum(sums)/(real(grid%nx, dp)*grid%full_ny()))
      end associate
   end function film_residual
end module ehl_reynolds

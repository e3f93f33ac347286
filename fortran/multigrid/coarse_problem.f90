! SPDX-License-Identifier: BSD-3-Clause
!> The full approximation scheme (Brandt 1977; Venner & Lubrecht 2000, ch. 2 and 6): the problem of the next coarser level, and
!> its correction. With I full weighting, N the Reynolds operator, K the deflection, and what begins with a bar restricted:
!>
!>    start         bar P = I P,   bar H = I H                                   p_start, h_start
!>    film          H - H00 - K P = bar H - H00 - K bar P                        film_rhs
!>    Reynolds      N(P, H) = N(bar P, bar H) + I (rhs - N)                      rhs
!>    load          sum P = sum bar P + (load - sum P of the fine level)         force_balance.f90
!>    correction    P <- P + interpolated (P - bar P) of the coarse level        p_change, h_change
!>
!> The right-hand sides of the first two are those of the coarse level while it is solved; the fine level's are left as they are.
module ehl_coarse_problem
   use ehl_alcouffe, only: transfer_t
   use ehl_bilinear, only: interpolate_row, mesh_ratio, weight_row
   use ehl_film, only: update_coefficients
   use ehl_force_balance, only: pass_load_on
   use ehl_galerkin, only: coarsening_t, galerkin_product
   use ehl_kinds, only: dp
   use ehl_level, only: level_t
   use ehl_nine_point, only: nine_point_t
   use ehl_node_state, only: cavity_pressure, change_flowing, stay_cavitated
   use ehl_reynolds, only: reynolds_operator
   use ehl_touching_nodes, only: begin_coarse, keep_film, restrict_touching, separate_touching
   use ehl_workspace, only: workspace_t
   implicit none (type, external)
   private
   public :: restrict_problem, correct, coarsening_classical, coarsening_alcouffe

   !> Bilinear transfers and rediscretised coarse operators, or operator-dependent transfers and
   !> Galerkin operators for the Poiseuille term
   integer, parameter :: coarsening_classical = 1, coarsening_alcouffe = 2
   !> Interpolation follows the operator where conductance/mesh-size^2 in the neighbourhood is above this;
   !> elsewhere the deflection matters, which is not in the operator, and interpolation is bilinear
   real(dp), parameter :: dependent_from = 10.0_dp
   !> Slack of a coarse node that neither requires pressure nor refuses it (the wedge term is of order 1)
   real(dp), parameter :: min_slack = 1.0e-8_dp
   !> Right-hand side of nodes that are to stay cavitated on a coarse level: they never require pressure
   real(dp), parameter :: never = 1.0e30_dp

contains

   !> Coarse problem whose solution corrects the fine one. Needs the residual of the fine level.
   subroutine restrict_problem(fine, coarse, space, coarsening, kind_of_coarsening)
      type(level_t), intent(inout) :: fine, coarse
      !> Of the coarse level
      type(workspace_t), intent(inout) :: space
      type(coarsening_t), intent(inout) :: coarsening
      integer, intent(in) :: kind_of_coarsening
      integer :: step(2)

      step = mesh_ratio(fine%grid, coarse%grid)
      call restrict_state(fine, coarse, space, step)
      call set_film_rhs(coarse)
      coarse%poiseuille%frozen = .false.
      coarse%flow%kept%correcting = .true.
      call update_coefficients(coarse)
      if (kind_of_coarsening == coarsening_alcouffe .and. all(step == 2)) call build_galerkin(fine, coarse, coarsening)
      call set_reynolds_rhs(fine, coarse, step, coarsening%transfer)
      call pass_load_on(fine, coarse)
   end subroutine restrict_problem

   !> What the coarse level starts from: pressure, film, and which nodes are cavitated or touch
   subroutine restrict_state(fine, coarse, space, step)
      type(level_t), intent(in) :: fine
      type(level_t), intent(inout) :: coarse
      type(workspace_t), intent(inout) :: space
      integer, intent(in) :: step(2)
      integer :: j

      !$omp parallel do default(none) shared(fine, coarse, space, step) &
      !$omp num_threads(coarse%threads) if(coarse%parallel) schedule(static)
      do j = 1, coarse%grid%ny
         call weight_row(coarse%grid, step, fine%p, j, coarse%p(:, j))
         ! a cavitated node stays so
         call stay_cavitated(fine%p(::step(1), step(2)*(j - 1) + 1), coarse%p(:, j))
         space%p_start(:, j) = coarse%p(:, j)
         call weight_row(coarse%grid, step, fine%h, j, coarse%h(:, j))
         space%h_start(:, j) = coarse%h(:, j)
      end do
      !$omp end parallel do
      coarse%h00 = fine%h00
      coarse%supply%frozen = coarse%supply%active
      call begin_coarse(coarse%boundary, fine%boundary, coarse%grid, step, coarse%p)
   end subroutine restrict_state

   !> Right-hand side of the film equation of the coarse level: the restricted film solves it
   subroutine set_film_rhs(coarse)
      type(level_t), intent(inout) :: coarse
      integer :: j

      call coarse%engine%apply(coarse%p, coarse%film_rhs)
      !$omp parallel do default(none) shared(coarse) &
      !$omp num_threads(coarse%threads) if(coarse%parallel) schedule(static)
      do j = 1, coarse%grid%ny
         coarse%film_rhs(:, j) = coarse%h(:, j) - coarse%h00 - coarse%film_rhs(:, j)
      end do
      !$omp end parallel do
   end subroutine set_film_rhs

   !> Right-hand side of the Reynolds equation of the coarse level: its operator on what it starts from, and the residual, by
   !> full weighting or, if the coarse level has a Galerkin operator, by the transpose of interpolation
   subroutine set_reynolds_rhs(fine, coarse, step, transfer)
      type(level_t), intent(inout) :: fine, coarse
      integer, intent(in) :: step(2)
      type(transfer_t), intent(in) :: transfer
      real(dp) :: operator_row(coarse%grid%nx), residual(coarse%grid%nx)
      integer :: i, j

      call separate_touching(fine%boundary, fine%residual)
      !$omp parallel do default(none) shared(fine, coarse, step, transfer) private(i, operator_row, residual) &
      !$omp num_threads(coarse%threads) if(coarse%parallel) schedule(static)
      do j = coarse%grid%first_inner(), coarse%grid%last_inner()
         call reynolds_operator(coarse, j, operator_row)
         if (coarse%poiseuille%frozen) then
            ! integrated over the cells: row 1 of a folded grid consists of half cells
            call transfer%restrict_row(fine%residual, j, residual, first_row=fine%grid%cell(1)/fine%grid%cell(2))
            residual(2:coarse%grid%nx - 1) = residual(2:coarse%grid%nx - 1)*fine%grid%cell(2)/coarse%grid%cell(j)
         else
            call weight_row(coarse%grid, step, fine%residual, j, residual)
         end if
         call restrict_touching(coarse%boundary, fine%boundary, coarse%grid, step, j, residual)
         do i = 2, coarse%grid%nx - 1
            coarse%rhs(i, j) = operator_row(i) + residual(i)
            if (coarse%p(i, j) > cavity_pressure) cycle
            if (coarse%poiseuille%frozen .or. coarse%supply%active) then
               coarse%rhs(i, j) = never
            else
               ! keep the slack of cavitated regions, and where there is none make a little, lest rounding
               ! decides which nodes stay cavitated
               coarse%rhs(i, j) = max(coarse%rhs(i, j), fine%rhs(step(1)*(i - 1) + 1, step(2)*(j - 1) + 1)) &
                                 + min_slack
            end if
         end do
      end do
      !$omp end parallel do
   end subroutine set_reynolds_rhs

   !> Transfer from the fine operator, and the Poiseuille operator of the coarse level. It stays as it is
   !> while the coarse level is solved: made to follow P and H of that level, it diverges in the contact.
   subroutine build_galerkin(fine, coarse, coarsening)
      type(level_t), intent(in) :: fine
      type(level_t), intent(inout) :: coarse
      type(coarsening_t), intent(inout) :: coarsening
      real(dp) :: limit, largest(fine%grid%nx)
      integer :: i, j, first, last

      first = fine%grid%first_inner()
      last = fine%grid%last_inner()
      limit = dependent_from*min(fine%grid%hx, fine%grid%hy)**2
      coarsening%free = 0.0_dp
      coarsening%dependent = 0.0_dp
      !$omp parallel do default(none) shared(fine, coarsening, first, last, limit) private(i, largest) &
      !$omp num_threads(fine%threads) if(fine%parallel) schedule(static)
      do j = first, last
         call fine%flow%max_neighbour_conductance(j, fine%grid%south(j), fine%grid%north(j), largest)
         do i = 2, fine%grid%nx - 1
            if (fine%p(i, j) > cavity_pressure) coarsening%free(i, j) = 1.0_dp
            if (largest(i) >= limit) coarsening%dependent(i, j) = 1.0_dp
         end do
      end do
      !$omp end parallel do
      if (fine%poiseuille%frozen) then
         call coarsen(fine%poiseuille%product)
      else
         call five_point(fine, coarsening%a)
         call coarsen(coarsening%a)
      end if
      coarse%poiseuille%frozen = .true.

   contains

      !> Transfer and coarse operator of a fine operator
      subroutine coarsen(a)
         type(nine_point_t), intent(in) :: a

         call coarsening%transfer%find_weights(a, coarsening%free, coarsening%dependent)
         call galerkin_product(a, coarsening%transfer, coarsening%work, coarse%poiseuille%product)
      end subroutine coarsen
   end subroutine build_galerkin

   !> The five-point Poiseuille operator of a level, integrated over the cells
   subroutine five_point(level, a)
      type(level_t), intent(in) :: level
      type(nine_point_t), intent(inout) :: a
      integer :: j

      a%five = .true.
      !$omp parallel do default(none) shared(level, a) &
      !$omp num_threads(level%threads) if(level%parallel) schedule(static)
      do j = 1, level%grid%last_inner()
         call level%poiseuille%integrate(level%flow, j, j, a)
      end do
      !$omp end parallel do
   end subroutine five_point

   !> Add the coarse change of the pressure where the fine one is positive, interpolated bilinearly or as the transfer
   !> has it. The coarse change of the film, interpolated bilinearly, serves the sweeps that follow. This ends the coarse
   !> problem: the coarse level may be a finest one next.
   subroutine correct(fine, coarse, space, transfer, coarsening, relaxation_factor)
      type(level_t), intent(inout) :: fine, coarse
      !> Of the coarse level
      type(workspace_t), intent(inout) :: space
      type(transfer_t), intent(in) :: transfer
      integer, intent(in) :: coarsening
      !> Share of the change that is made
      real(dp), intent(in) :: relaxation_factor
      real(dp) :: row(fine%grid%nx)
      integer :: j, nx, step(2)
      logical :: dependent

      step = mesh_ratio(fine%grid, coarse%grid)
      dependent = coarsening == coarsening_alcouffe .and. all(step == 2)
      !$omp parallel do default(none) shared(coarse, space, relaxation_factor) &
      !$omp num_threads(coarse%threads) if(coarse%parallel) schedule(static)
      do j = 1, coarse%grid%ny
         space%p_change(:, j) = relaxation_factor*(coarse%p(:, j) - space%p_start(:, j))
         space%h_change(:, j) = relaxation_factor*(coarse%h(:, j) - space%h_start(:, j))
      end do
      !$omp end parallel do
      if (relaxation_factor < 1.0_dp) then
         fine%h00 = fine%h00 + relaxation_factor*(coarse%h00 - fine%h00)
      else
         fine%h00 = coarse%h00
      end if
      coarse%poiseuille%frozen = .false.
      coarse%flow%kept%correcting = .false.
      coarse%boundary%frozen = .false.
      coarse%supply%frozen = .false.
      nx = fine%grid%nx
      !$omp parallel do default(none) shared(fine, coarse, space, transfer, dependent, step, nx) private(row) &
      !$omp num_threads(fine%threads) if(fine%parallel) schedule(static)
      do j = 1, fine%grid%ny
         call interpolate_row(coarse%grid, step, space%h_change, j, row)
         call keep_film(fine%boundary, j, row)
         fine%h(:, j) = fine%h(:, j) + row
         if (fine%grid%is_border(j)) cycle
         if (dependent) then
            call transfer%prolong_row(space%p_change, j, row)
         else
            call interpolate_row(coarse%grid, step, space%p_change, j, row)
         end if
         row = fine%p(:, j) + row
         call fine%boundary%limit_pressure(fine%p(:, j), 1, j, row)
         call change_flowing(row(2:nx - 1), fine%p(2:nx - 1, j))
      end do
      !$omp end parallel do
   end subroutine correct
end module ehl_coarse_problem

! SPDX-License-Identifier: BSD-3-Clause
!> Transfer of the problem to the next coarser level, and of the correction back (full approximation scheme)
module ehl_coarse_problem
   use ehl_alcouffe, only: transfer_t
   use ehl_film, only: update_coefficients
   use ehl_force_balance, only: pass_load_on
   use ehl_galerkin, only: coarsening_t, galerkin_product
   use ehl_grid, only: grid_t
   use ehl_kinds, only: dp
   use ehl_level, only: level_t, yields
   use ehl_nine_point, only: nine_point_t
   use ehl_node_state, only: cavity_pressure, change_flowing, stay_cavitated
   use ehl_reynolds, only: reynolds_operator
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
   !> Slack of a coarse node that neither asks for pressure nor refuses it (the wedge term is of order 1)
   real(dp), parameter :: least_slack = 1.0e-8_dp
   !> Right-hand side of nodes that are to stay cavitated on a coarse level: they never ask for pressure
   real(dp), parameter :: never = 1.0e30_dp

contains

   !> Coarse problem whose solution corrects the fine one. Needs the residual of the fine level, and
   !> changes its first row on folded grids.
   subroutine restrict_problem(fine, coarse, space, coarsening, kind_of_coarsening)
      type(level_t), intent(inout) :: fine, coarse
      !> Of the coarse level
      type(workspace_t), intent(inout) :: space
      type(coarsening_t), intent(inout) :: coarsening
      integer, intent(in) :: kind_of_coarsening
      integer :: j, step(2)

      step = step_between(fine%grid, coarse%grid)
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
      call coarse%engine%apply(coarse%p, coarse%geometry)
      !$omp parallel do default(none) shared(coarse) &
      !$omp num_threads(coarse%threads) if(coarse%parallel) schedule(static)
      do j = 1, coarse%grid%ny
         coarse%geometry(:, j) = coarse%h(:, j) - coarse%h00 - coarse%geometry(:, j)
      end do
      !$omp end parallel do
      coarse%poiseuille%frozen = .false.
      coarse%flow%kept%correcting = .true.
      if (allocated(fine%boundary)) call freeze_states(fine, coarse)
      call update_coefficients(coarse)
      if (kind_of_coarsening == coarsening_alcouffe .and. all(step == 2)) call build_galerkin(fine, coarse, coarsening)
      call restrict_residual(fine, coarse, step, coarsening%transfer)
      call pass_load_on(fine, coarse)
   end subroutine restrict_problem

   !> States of the coarse nodes while their level is solved: those touch that have pressure and around which more than half
   !> touches. None yields: where half of a coarse grid did, nothing would be left to carry a missing load.
   subroutine freeze_states(fine, coarse)
      type(level_t), intent(in) :: fine
      type(level_t), intent(inout) :: coarse
      logical :: touches(coarse%grid%nx)
      integer :: j

      associate (boundary => coarse%boundary)
         boundary%frozen = .true.
         boundary%kept = 0.0_dp
         boundary%rate = fine%boundary%rate
         do j = 1, coarse%grid%ny
            call weight_row(coarse%grid, step_between(fine%grid, coarse%grid), fine%boundary%touching, j, boundary%touching(:, j))
            touches = boundary%touching(:, j) > 0.5_dp .and. coarse%p(:, j) > cavity_pressure
            boundary%touching(:, j) = merge(1.0_dp, 0.0_dp, touches)
         end do
      end associate
   end subroutine freeze_states

   !> Mesh sizes of a coarse grid over those of a fine one
   pure function step_between(fine, coarse) result(step)
      type(grid_t), intent(in) :: fine, coarse
      integer :: step(2)
      step = fine%intervals()/coarse%intervals()
   end function step_between

   !> Coarse row j by full weighting along the axes that are halved, on the border by injection
   pure subroutine weight_row(coarse, step, fine, j, values)
      type(grid_t), intent(in) :: coarse
      integer, intent(in) :: step(2)
      !> Shape of the fine grid
      real(dp), intent(in) :: fine(:, :)
      integer, intent(in) :: j
      !> Shape (nx) of the coarse grid
      real(dp), intent(out) :: values(:)
      real(dp) :: across(size(fine, 1))
      integer :: i, l, nx

      nx = coarse%nx
      l = step(2)*(j - 1) + 1
      values = fine(::step(1), l)
      if (coarse%is_border(j)) return
      if (step(2) == 1) then
         across = fine(:, l)
      else
         across = 0.25_dp*(fine(:, coarse%south(l)) + fine(:, l + 1)) + 0.5_dp*fine(:, l)
      end if
      if (step(1) == 1) then
         values(2:nx - 1) = across(2:nx - 1)
         return
      end if
      do i = 2, nx - 1
         values(i) = 0.25_dp*(across(2*i - 2) + across(2*i)) + 0.5_dp*across(2*i - 1)
      end do
   end subroutine weight_row

   !> Right-hand side of the coarse level: its operator on what it starts from, and the residual, by full
   !> weighting or, if the coarse level has a Galerkin operator, by the transpose of interpolation
   subroutine restrict_residual(fine, coarse, step, transfer)
      type(level_t), intent(inout) :: fine, coarse
      integer, intent(in) :: step(2)
      type(transfer_t), intent(in) :: transfer
      real(dp) :: operator_row(coarse%grid%nx), residual(coarse%grid%nx)
      integer :: i, j

      if (allocated(coarse%boundary)) call restrict_touching(fine, coarse, step)
      ! row 1 of a folded grid consists of half cells
      if (coarse%poiseuille%frozen .and. fine%grid%mirror) fine%residual(:, 1) = 0.5_dp*fine%residual(:, 1)
      !$omp parallel do default(none) shared(fine, coarse, step, transfer) private(i, operator_row, residual) &
      !$omp num_threads(coarse%threads) if(coarse%parallel) schedule(static)
      do j = coarse%grid%first_inner(), coarse%grid%ny - 1
         call reynolds_operator(coarse, j, operator_row)
         if (coarse%poiseuille%frozen) then
            call transfer%restrict_row(fine%residual, j, residual)
            residual(2:coarse%grid%nx - 1) = residual(2:coarse%grid%nx - 1)*fine%grid%cell(2)/coarse%grid%cell(j)
         else
            call weight_row(coarse%grid, step, fine%residual, j, residual)
         end if
         if (allocated(coarse%boundary)) residual = merge(coarse%residual(:, j), residual, coarse%boundary%touching(:, j) > 0.0_dp)
         do i = 2, coarse%grid%nx - 1
            coarse%rhs(i, j) = operator_row(i) + residual(i)
            if (coarse%p(i, j) > cavity_pressure) cycle
            if (coarse%poiseuille%frozen) then
               coarse%rhs(i, j) = never
            else
               ! keep the slack of cavitated regions, and where there is none make a little, lest rounding
               ! decides which nodes stay cavitated
               coarse%rhs(i, j) = max(coarse%rhs(i, j), fine%rhs(step(1)*(i - 1) + 1, step(2)*(j - 1) + 1)) &
                                 + least_slack
            end if
         end do
      end do
      !$omp end parallel do
   end subroutine restrict_residual

   !> Residuals of touching nodes to those of the coarse level, and to these alone: in the equation of a flowing node they would
   !> be a source that the motion carries through the contact. Those of flowing nodes are left. The film of the flow, which is
   !> found anew after the coarse problem, lends its place.
   subroutine restrict_touching(fine, coarse, step)
      type(level_t), intent(inout) :: fine, coarse
      integer, intent(in) :: step(2)
      integer :: j

      do j = 1, fine%grid%ny
         fine%boundary%film(:, j) = fine%residual(:, j)*fine%boundary%touching(:, j)
         fine%residual(:, j) = fine%residual(:, j) - fine%boundary%film(:, j)
      end do
      do j = coarse%grid%first_inner(), coarse%grid%ny - 1
         call weight_row(coarse%grid, step, fine%boundary%film, j, coarse%residual(:, j))
      end do
   end subroutine restrict_touching

   !> Transfer from the fine operator, and the Poiseuille operator of the coarse level. It stays as it is
   !> while the coarse level is solved: made to follow P and H of that level, it diverges in the contact.
   subroutine build_galerkin(fine, coarse, coarsening)
      type(level_t), intent(in) :: fine
      type(level_t), intent(inout) :: coarse
      type(coarsening_t), intent(inout) :: coarsening
      real(dp) :: limit, greatest(fine%grid%nx)
      integer :: i, j, first, last

      first = fine%grid%first_inner()
      last = fine%grid%ny - 1
      limit = dependent_from*min(fine%grid%hx, fine%grid%hy)**2
      coarsening%free = 0.0_dp
      coarsening%dependent = 0.0_dp
      !$omp parallel do default(none) shared(fine, coarsening, first, last, limit) private(i, greatest) &
      !$omp num_threads(fine%threads) if(fine%parallel) schedule(static)
      do j = first, last
         call fine%flow%greatest_around(j, fine%grid%south(j), greatest)
         do i = 2, fine%grid%nx - 1
            if (fine%p(i, j) > cavity_pressure) coarsening%free(i, j) = 1.0_dp
            if (greatest(i) >= limit) coarsening%dependent(i, j) = 1.0_dp
         end do
      end do
      !$omp end parallel do
      if (fine%poiseuille%frozen) then
         call coarsening%transfer%find_weights(fine%poiseuille%product, coarsening%free, coarsening%dependent)
         call galerkin_product(fine%poiseuille%product, coarsening%transfer, coarsening%work, &
                               coarse%poiseuille%product)
      else
         call five_point(fine, coarsening%a)
         call coarsening%transfer%find_weights(coarsening%a, coarsening%free, coarsening%dependent)
         call galerkin_product(coarsening%a, coarsening%transfer, coarsening%work, &
                               coarse%poiseuille%product)
      end if
      coarse%poiseuille%frozen = .true.
   end subroutine build_galerkin

   !> The five-point Poiseuille operator of a level, integrated over the cells
   subroutine five_point(level, a)
      type(level_t), intent(in) :: level
      type(nine_point_t), intent(inout) :: a
      integer :: j

      a%five = .true.
      !$omp parallel do default(none) shared(level, a) &
      !$omp num_threads(level%threads) if(level%parallel) schedule(static)
      do j = 1, level%grid%ny - 1
         call level%poiseuille%integrate(level%flow, j, j, a)
      end do
      !$omp end parallel do
   end subroutine five_point

   !> Add the coarse change of the pressure where the fine one is positive, interpolated bilinearly or as the transfer
   !> has it. The coarse change of the film, interpolated bilinearly, serves the sweeps that follow. This ends the coarse
   !> problem: the coarse level may be a finest one next, and p_start and h_start hold the changes then.
   subroutine correct(fine, coarse, space, transfer, coarsening, part)
      type(level_t), intent(inout) :: fine, coarse
      !> Of the coarse level
      type(workspace_t), intent(inout) :: space
      type(transfer_t), intent(in) :: transfer
      integer, intent(in) :: coarsening
      !> Share of the change that is taken over
      real(dp), intent(in) :: part
      real(dp) :: row(fine%grid%nx)
      integer :: j, nx, step(2)
      logical :: dependent

      step = step_between(fine%grid, coarse%grid)
      dependent = coarsening == coarsening_alcouffe .and. all(step == 2)
      !$omp parallel do default(none) shared(coarse, space, part) &
      !$omp num_threads(coarse%threads) if(coarse%parallel) schedule(static)
      do j = 1, coarse%grid%ny
         space%p_start(:, j) = part*(coarse%p(:, j) - space%p_start(:, j))
         space%h_start(:, j) = part*(coarse%h(:, j) - space%h_start(:, j))
      end do
      !$omp end parallel do
      if (part < 1.0_dp) then
         fine%h00 = fine%h00 + part*(coarse%h00 - fine%h00)
      else
         fine%h00 = coarse%h00
      end if
      coarse%poiseuille%frozen = .false.
      coarse%flow%kept%correcting = .false.
      if (allocated(coarse%boundary)) coarse%boundary%frozen = .false.
      nx = fine%grid%nx
      !$omp parallel do default(none) shared(fine, coarse, space, transfer, dependent, step, nx) private(row) &
      !$omp num_threads(fine%threads) if(fine%parallel) schedule(static)
      do j = 1, fine%grid%ny
         call interpolate_row(coarse%grid, step, space%h_start, j, row)
         ! a film that comes of pressures which nodes do not take on says nothing about whether they yield
         if (yields(fine)) row = merge(0.0_dp, row, fine%boundary%kept(:, j) > 0.0_dp)
         fine%h(:, j) = fine%h(:, j) + row
         if (j < fine%grid%first_inner() .or. j == fine%grid%ny) cycle
         if (dependent) then
            call transfer%prolong_row(space%p_start, j, row)
         else
            call interpolate_row(coarse%grid, step, space%p_start, j, row)
         end if
         row = fine%p(:, j) + row
         if (yields(fine)) call fine%boundary%bound(fine%p(:, j), 1, j, row)
         call change_flowing(row(2:nx - 1), fine%p(2:nx - 1, j))
      end do
      !$omp end parallel do
   end subroutine correct

   !> Row j of the fine grid by bilinear interpolation
   pure subroutine interpolate_row(coarse, step, values, j, row)
      type(grid_t), intent(in) :: coarse
      integer, intent(in) :: step(2)
      !> Shape of the coarse grid
      real(dp), intent(in) :: values(:, :)
      integer, intent(in) :: j
      !> Shape (nx) of the fine grid
      real(dp), intent(out) :: row(:)
      real(dp) :: middle(coarse%nx)
      integer :: i, l

      if (step(2) == 1) then
         middle = values(:, j)
      else
         l = (j + 1)/2
         middle = 0.5_dp*(values(:, l) + values(:, min(l + mod(j + 1, 2), coarse%ny)))
      end if
      row(::step(1)) = middle
      if (step(1) == 1) return
      do i = 1, coarse%nx - 1
         row(2*i) = 0.5_dp*(middle(i) + middle(i + 1))
      end do
   end subroutine interpolate_row
end module ehl_coarse_problem

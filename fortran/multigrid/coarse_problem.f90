! SPDX-License-Identifier: BSD-3-Clause
!> The full approximation scheme (Brandt 1977; Venner & Lubrecht 2000, ch. 2 and 6): the problem of the next coarser level, and
!> its correction. With I full weighting, N the Reynolds operator, K the deflection, and bar for restricted fields:
!>
!>    start         bar P = I P,   bar H = I H                                   p_start, h_start
!>    film          H - H00 - K P = bar H - H00 - K bar P                        film_rhs
!>    Reynolds      N(P, H) = N(bar P, bar H) + I (rhs - N)                      rhs
!>    load          sum P = sum bar P + (load - sum P of the fine level)         restrict_load
!>    correction    P <- P + interpolated (P - bar P) of the coarse level        p_change, h_change
!>
!> The coarse level stores the right-hand sides of film and Reynolds equation; the fine level's do not change.
!> Grids may be coarser along X, along Y or along both. Without a boundary film the procedures of nodes in contact do nothing.
module ehl_coarse_problem
   use ehl_alcouffe, only: transfer_t
   use ehl_flow, only: dir_x
   use ehl_galerkin, only: build_galerkin, coarsening_t
   use ehl_grid, only: grid_t
   use ehl_kinds, only: dp
   use ehl_level, only: cavity_pressure, change_flowing, level_t, stay_cavitated
   use ehl_reynolds, only: restrict_load, reynolds_operator, update_coefficients
   use ehl_workspace, only: workspace_t
   implicit none (type, external)
   private
   public :: restrict_problem, correct, coarsening_classical, coarsening_alcouffe, weight_row

   !> Bilinear transfers and rediscretised coarse operators, or operator-dependent transfers and
   !> Galerkin operators for the Poiseuille term
   integer, parameter :: coarsening_classical = 1, coarsening_alcouffe = 2
   !> Slack added at cavitated coarse nodes (the wedge term is of order 1)
   real(dp), parameter :: min_slack = 1.0e-8_dp
   !> Right-hand side of nodes that stay cavitated on a coarse level: they never require pressure
   real(dp), parameter :: never = 1.0e30_dp
   !> Second difference of the logarithm of the conductance at which the correction is halved, at a spike along X and at the end of
   !> a roller along Y. Of 1, 3 and 10, the values 1 and 3 give the fewest cycles in contacts with L from 17 to 27.
   real(dp), parameter :: sharp = 3.0_dp
   !> A coarse grid has diverged if its maximum pressure exceeds this multiple of its start value: in rollers, whose ends coarse
   !> grids do not resolve, and in damped cycles. Of 26 contacts with M above 9e4 (R_x) the limit 3 makes ten 1.4 to 9.6
   !> times faster and none slower (docs/evidence/machines).
   real(dp), parameter :: max_growth_roller = 1.5_dp, max_growth_damped = 3.0_dp

contains

   !> Set up the coarse problem whose solution corrects the fine level. Needs the residual of the fine level.
   subroutine restrict_problem(fine, coarse, space, coarsening, kind_of_coarsening)
      type(level_t), intent(inout) :: fine, coarse
      !> Work space of the coarse level
      type(workspace_t), intent(inout) :: space
      type(coarsening_t), intent(inout) :: coarsening
      integer, intent(in) :: kind_of_coarsening
      integer :: step(2)

      step = mesh_ratio(fine%grid, coarse%grid)
      call restrict_state(fine, coarse, space, step)
      call set_film_rhs(coarse)
      coarse%poiseuille%frozen = .false.
      coarse%flow%cached%correcting = .true.
      call update_coefficients(coarse)
      if (kind_of_coarsening == coarsening_alcouffe .and. all(step == 2)) call build_galerkin(fine, coarse, coarsening)
      call set_reynolds_rhs(fine, coarse, step, coarsening%transfer)
      call restrict_load(fine, coarse)
   end subroutine restrict_problem

   !> Restrict the state of the fine level: pressure, film, and which nodes are cavitated or touch
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
         ! a cavitated node stays cavitated
         call stay_cavitated(fine%p(::step(1), step(2)*(j - 1) + 1), coarse%p(:, j))
         space%p_start(:, j) = coarse%p(:, j)
         call weight_row(coarse%grid, step, fine%h, j, coarse%h(:, j))
         space%h_start(:, j) = coarse%h(:, j)
      end do
      !$omp end parallel do
      coarse%h00 = fine%h00
      coarse%supply%frozen = coarse%supply%active
      call coarse%boundary%begin_coarse(fine%boundary, coarse%grid, step, coarse%p)
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

   !> Right-hand side of the Reynolds equation of the coarse level: its operator applied to the restricted state plus the residual,
   !> restricted by full weighting or, if the coarse level has a Galerkin operator, by the transpose of interpolation
   subroutine set_reynolds_rhs(fine, coarse, step, transfer)
      type(level_t), intent(inout) :: fine, coarse
      integer, intent(in) :: step(2)
      type(transfer_t), intent(in) :: transfer
      real(dp) :: operator_row(coarse%grid%nx), residual(coarse%grid%nx)
      integer :: i, j

      call fine%boundary%separate_residual(fine%residual)
      !$omp parallel do default(none) shared(fine, coarse, step, transfer) private(i, operator_row, residual) &
      !$omp num_threads(coarse%threads) if(coarse%parallel) schedule(static)
      do j = coarse%grid%first_inner(), coarse%grid%last_inner()
         call reynolds_operator(coarse, j, operator_row)
         if (coarse%poiseuille%frozen) then
            ! integrated over the cells; the border rows of a folded grid have half cells
            call transfer%restrict_row(fine%residual, j, residual, half_cells=fine%grid%cell(1)/fine%grid%cell(2))
            residual(2:coarse%grid%nx - 1) = residual(2:coarse%grid%nx - 1)*fine%grid%cell(2)/coarse%grid%cell(j)
         else
            call weight_row(coarse%grid, step, fine%residual, j, residual)
         end if
         call coarse%boundary%restrict_residual(fine%boundary, coarse%grid, step, j, residual)
         do i = 2, coarse%grid%nx - 1
            coarse%rhs(i, j) = operator_row(i) + residual(i)
            if (coarse%p(i, j) > cavity_pressure) cycle
            if (coarse%poiseuille%frozen .or. coarse%supply%active) then
               coarse%rhs(i, j) = never
            else
               ! keep the slack of cavitated regions, and where there is none set a small one: otherwise rounding
               ! would decide which nodes stay cavitated
               coarse%rhs(i, j) = max(coarse%rhs(i, j), fine%rhs(step(1)*(i - 1) + 1, step(2)*(j - 1) + 1)) &
                                 + min_slack
            end if
         end do
      end do
      !$omp end parallel do
   end subroutine set_reynolds_rhs

   !> Add the interpolated coarse change of the pressure where the fine pressure is positive; interpolation is bilinear or that of
   !> the transfer. The coarse change of the film, interpolated bilinearly, updates the film for the next sweeps. The coarse level
   !> is then free to be the finest level of another cycle.
   subroutine correct(fine, coarse, space, transfer, coarsening, relaxation_factor, spare_spikes, &
                      reject_diverged)
      type(level_t), intent(inout) :: fine, coarse
      !> Work space of the coarse level
      type(workspace_t), intent(inout) :: space
      type(transfer_t), intent(in) :: transfer
      integer, intent(in) :: coarsening
      !> Factor of the coarse-grid correction
      real(dp), intent(in) :: relaxation_factor
      !> Whether the correction is reduced at sharp pressure spikes, which sweeps resolve
      logical, intent(in) :: spare_spikes
      !> Whether a diverged coarse grid gives no correction; in rollers it never does
      logical, intent(in) :: reject_diverged
      real(dp) :: row(fine%grid%nx)
      integer :: j, nx, step(2)
      logical :: dependent

      step = mesh_ratio(fine%grid, coarse%grid)
      dependent = coarsening == coarsening_alcouffe .and. all(step == 2)
      if (coarse%grid%ends .or. reject_diverged) then
         if (has_diverged(coarse, maxval(space%p_start))) then
            coarse%p = space%p_start
            coarse%h = space%h_start
            coarse%h00 = fine%h00
         end if
      end if
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
      coarse%flow%cached%correcting = .false.
      call coarse%boundary%end_coarse()
      coarse%supply%frozen = .false.
      nx = fine%grid%nx
      !$omp parallel do default(none) shared(fine, coarse, space, transfer, dependent, step, nx, spare_spikes) &
      !$omp private(row) &
      !$omp num_threads(fine%threads) if(fine%parallel) schedule(static)
      do j = 1, fine%grid%ny
         call interpolate_row(coarse%grid, step, space%h_change, j, row)
         ! yielding nodes keep their pressure: the film change of the coarse pressure does not apply there
         call fine%boundary%yielding%set(j, 0.0_dp, row)
         fine%h(:, j) = fine%h(:, j) + row
         if (fine%grid%is_border(j)) cycle
         if (dependent) then
            call transfer%prolong_row(space%p_change, j, row)
         else
            call interpolate_row(coarse%grid, step, space%p_change, j, row)
         end if
         if (spare_spikes) call weaken_at_spikes(fine%p(:, j), fine%flow%eps(:, j, dir_x), row)
         if (fine%grid%ends) call weaken_at_ends(fine, j, row)
         row = fine%p(:, j) + row
         call fine%boundary%yielding%limit_pressure(fine%p(:, j), 1, j, row)
         call change_flowing(row(2:nx - 1), fine%p(2:nx - 1, j))
      end do
      !$omp end parallel do
   end subroutine correct

   !> Whether the pressure of a coarse grid has diverged
   pure logical function has_diverged(coarse, start)
      type(level_t), intent(in) :: coarse
      !> Maximum pressure at the start
      real(dp), intent(in) :: start

      has_diverged = .not. maxval(coarse%p) <= merge(max_growth_roller, max_growth_damped, coarse%grid%ends)*start
      ! the maximum may skip values that are not numbers
      if (.not. has_diverged) has_diverged = .not. abs(sum(coarse%p) + coarse%h00) <= huge(1.0_dp)
   end function has_diverged

   !> Reduce the change of a row at a pressure spike that the coarse grid does not resolve: downstream of the inlet, by half where
   !> the second difference of the logarithm of the conductance equals `sharp`. A coarse grid has that spike at another position.
   pure subroutine weaken_at_spikes(p, eps, change)
      real(dp), contiguous, intent(in) :: p(:), eps(:)
      real(dp), contiguous, intent(inout) :: change(:)
      real(dp) :: bend(size(p))
      integer :: i

      bend = 0.0_dp
      do i = 2, size(p) - 1
         ! where the pressure increases along X it is the inlet, which needs the correction by coarse grids
         if (p(i + 1) < p(i) .and. min(p(i - 1), p(i + 1)) > cavity_pressure) then
            bend(i) = abs(log(max(eps(i - 1), tiny(1.0_dp))) - 2.0_dp*log(max(eps(i), tiny(1.0_dp))) &
                          + log(max(eps(i + 1), tiny(1.0_dp))))
         end if
      end do
      do i = 2, size(p) - 1
         change(i) = change(i)/(1.0_dp + (maxval(bend(i - 1:i + 1))/sharp)**2)
      end do
   end subroutine weaken_at_spikes

   !> Reduce the change of a row where a roller's contact ends along Y within a cell or two of a coarse grid: by half where the
   !> second difference of the logarithm of the conductance along Y equals `sharp`
   pure subroutine weaken_at_ends(fine, j, change)
      type(level_t), intent(in) :: fine
      integer, intent(in) :: j
      real(dp), contiguous, intent(inout) :: change(:)
      real(dp) :: bend
      integer :: i

      associate (eps => fine%flow%eps(:, :, fine%flow%dir_y), below => fine%grid%south(j), above => fine%grid%north(j))
         do i = 2, size(change) - 1
            if (fine%p(i, j) <= cavity_pressure) cycle
            bend = log(max(eps(i, below), tiny(1.0_dp))) - 2.0_dp*log(max(eps(i, j), tiny(1.0_dp))) &
                   + log(max(eps(i, above), tiny(1.0_dp)))
            change(i) = change(i)/(1.0_dp + (max(0.0_dp, bend)/sharp)**2)
         end do
      end associate
   end subroutine weaken_at_ends

   !> Mesh sizes of a coarse grid over those of a fine one
   pure function mesh_ratio(fine, coarse) result(step)
      type(grid_t), intent(in) :: fine, coarse
      integer :: step(2)
      step = fine%intervals()/coarse%intervals()
   end function mesh_ratio

   !> Coarse row j by full weighting along the axes that are coarsened, on the border by injection
   pure subroutine weight_row(coarse, step, fine, j, values)
      type(grid_t), intent(in) :: coarse
      integer, intent(in) :: step(2)
      !> Shape of the fine grid
      real(dp), intent(in) :: fine(:, :)
      integer, intent(in) :: j
      !> Shape (nx) of the coarse grid
      real(dp), intent(out) :: values(:)
      real(dp) :: mean_y(size(fine, 1))
      integer :: i, l, below, above, nx

      nx = coarse%nx
      l = step(2)*(j - 1) + 1
      values = fine(::step(1), l)
      if (coarse%is_border(j)) return
      if (step(2) == 1) then
         mean_y = fine(:, l)
      else
         below = l - 1
         if (l == 1) below = merge(2, size(fine, 2), coarse%mirror)
         above = l + 1
         if (l == size(fine, 2)) above = l - 1
         mean_y = 0.25_dp*(fine(:, below) + fine(:, above)) + 0.5_dp*fine(:, l)
      end if
      if (step(1) == 1) then
         values(2:nx - 1) = mean_y(2:nx - 1)
         return
      end if
      do i = 2, nx - 1
         values(i) = 0.25_dp*(mean_y(2*i - 2) + mean_y(2*i)) + 0.5_dp*mean_y(2*i - 1)
      end do
   end subroutine weight_row

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
      integer :: i, l, next

      if (step(2) == 1) then
         middle = values(:, j)
      else
         l = (j + 1)/2
         next = min(l + mod(j + 1, 2), coarse%ny)
         if (coarse%periodic .and. mod(j, 2) == 0) next = coarse%north(l)
         middle = 0.5_dp*(values(:, l) + values(:, next))
      end if
      row(::step(1)) = middle
      if (step(1) == 1) return
      do i = 1, coarse%nx - 1
         row(2*i) = 0.5_dp*(middle(i) + middle(i + 1))
      end do
   end subroutine interpolate_row
end module ehl_coarse_problem

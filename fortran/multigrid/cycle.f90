! SPDX-License-Identifier: BSD-3-Clause
!> The multigrid cycle: full approximation scheme (Brandt 1977; Venner & Lubrecht 2000)
module ehl_cycle
   use ehl_coarse_problem, only: coarsening_alcouffe, coarsening_classical, correct, restrict_problem
   use ehl_grid, only: grid_t
   use ehl_hierarchy, only: hierarchy_t
   use ehl_kinds, only: dp
   use ehl_level, only: cavitate, level_t
   use ehl_relaxation, only: usual_log_change, relax
   use ehl_reynolds, only: refresh, update_coefficients, update_residual
   use ehl_row_relaxation, only: relax_row
   implicit none (type, external)
   private
   public :: cycle_options_t, damped_cycle, finest_cycle, max_damping, prolong_solution, refine
   public :: coarsening_classical, coarsening_alcouffe

   !> Degrees of damping: maximum change of the logarithm of a node's conductance, relaxation factors of a sweep and of the
   !> coarse-grid correction. The first degree applies the full correction, which sets the mean film and the load.
   !> Where the pressure spike is a few nodes wide (L = 25 on 513 x 513 nodes) F cycles make it oscillate.
   integer, parameter :: max_damping = 4, usual_damping = 2
   real(dp), parameter :: damped_log_change(max_damping) = usual_log_change/[1.0_dp, 3.0_dp, 3.0_dp, 9.0_dp], &
                          damped_sweep(max_damping) = [0.6_dp, 0.6_dp, 0.3_dp, 0.15_dp], &
                          damped_correction(max_damping) = [1.0_dp, 0.6_dp, 0.5_dp, 0.25_dp]

   !> Options of a cycle
   type :: cycle_options_t
      !> Coarse cycles per cycle: 1 = V, 2 = W; full: F cycle, which is a coarse F cycle followed by a coarse V cycle
      integer :: gamma = 2
      logical :: full = .false.
      !> Sweeps before and after the coarse-grid correction
      integer :: pre = 2, post = 1
      !> Residual (rms) of the finest level below which the remaining sweeps after the correction are skipped
      real(dp) :: enough = 0.0_dp
      !> Maximum change of the logarithm of a node's conductance in a sweep; on grids of several rows only in time steps and damped
      !> cycles
      real(dp) :: max_log_change = usual_log_change
      !> Relaxation factors of a sweep and of the coarse-grid correction
      real(dp) :: relaxation_factor = 1.0_dp, correction_factor = 1.0_dp
      !> Whether these apply to the finest level alone. A factor on every level would multiply: hardly any of the change of mean
      !> film and load, which the coarsest grid determines, would reach the finest grid.
      logical :: finest_only = .false.
      !> Whether the coarse-grid correction is reduced at sharp pressure spikes
      logical :: spare_spikes = .false.
      !> Whether a diverged coarse grid gives no correction
      logical :: reject_diverged = .false.
      !> Kind of transfers and coarse operators
      integer :: coarsening = coarsening_classical
   end type cycle_options_t

contains

   !> A W cycle with the given degree of damping, for states on which another cycle failed
   pure function damped_cycle(options, degree) result(damped)
      type(cycle_options_t), intent(in) :: options
      integer, intent(in), optional :: degree
      type(cycle_options_t) :: damped
      integer :: d

      d = usual_damping
      if (present(degree)) d = degree
      damped = options
      damped%gamma = 2
      damped%full = .false.
      damped%max_log_change = damped_log_change(d)
      damped%relaxation_factor = damped_sweep(d)
      damped%correction_factor = damped_correction(d)
      ! with sharp spikes a coarse grid has the spike at another position (see correct): there its growth is no divergence
      damped%reject_diverged = .not. options%spare_spikes
   end function damped_cycle

   !> One cycle with level n as the finest. Film and coefficients are up to date before and after.
   subroutine finest_cycle(grids, n, options, residual)
      type(hierarchy_t), intent(inout) :: grids
      integer, intent(in) :: n
      type(cycle_options_t), intent(in) :: options
      !> Residual after the cycle (rms)
      real(dp), intent(out) :: residual
      integer :: k

      associate (level => grids%levels(n))
         if (grids%below(n) == 0) then
            call grids%coarsest(n)%solve(level)
         else
            call visit_coarser(grids, n, options)
            do k = 1, options%post
               call sweep(grids, n, 1, options)
               call update_residual(level, residual)
               if (residual <= options%enough) return
            end do
            if (options%post > 0) return
         end if
         call update_residual(level, residual)
      end associate
   end subroutine finest_cycle

   !> One cycle on level n
   recursive subroutine fas_cycle(grids, n, options)
      type(hierarchy_t), intent(inout) :: grids
      integer, intent(in) :: n
      type(cycle_options_t), intent(in) :: options

      if (grids%below(n) == 0) then
         call grids%coarsest(n)%solve(grids%levels(n))
      else
         call visit_coarser(grids, n, options)
         call sweep(grids, n, options%post, options)
      end if
   end subroutine fas_cycle

   !> Relax level n, solve its problem on the coarser ones and add their correction
   recursive subroutine visit_coarser(grids, n, options)
      type(hierarchy_t), intent(inout) :: grids
      integer, intent(in) :: n
      type(cycle_options_t), intent(in) :: options
      type(cycle_options_t) :: coarser
      real(dp) :: rms
      integer :: k, m

      m = grids%below(n)
      coarser = options
      if (options%finest_only) then
         coarser%relaxation_factor = 1.0_dp
         coarser%correction_factor = 1.0_dp
      end if
      call sweep(grids, n, options%pre, options)
      call update_residual(grids%levels(n), rms)
      call restrict_problem(grids%levels(n), grids%levels(m), grids%workspaces(m), grids%coarsenings(n), options%coarsening)
      do k = 1, merge(1, options%gamma, grids%below(m) == 0)
         call fas_cycle(grids, m, coarser)
      end do
      if (options%full .and. grids%below(m) > 0) then
         coarser%full = .false.
         call fas_cycle(grids, m, coarser)
      end if
      call correct(grids%levels(n), grids%levels(m), grids%workspaces(m), grids%coarsenings(n)%transfer, options%coarsening, &
                   options%correction_factor, options%spare_spikes, options%reject_diverged)
      call update_coefficients(grids%levels(n))
   end subroutine visit_coarser

   !> Relax level n `times` times
   subroutine sweep(grids, n, times, options)
      type(hierarchy_t), intent(inout) :: grids
      integer, intent(in) :: n, times
      type(cycle_options_t), intent(in) :: options
      integer :: k

      do k = 1, times
         if (grids%levels(n)%grid%is_row()) then
            call relax_row(grids%levels(n), grids%workspaces(n), options%max_log_change, options%relaxation_factor)
         else
            call relax(grids%levels(n), grids%workspaces(n), options%max_log_change, options%relaxation_factor)
         end if
         call refresh(grids%levels(n))
      end do
   end subroutine sweep

   !> First approximation on a finer level: cubic interpolation of the coarse pressure and its deflection
   subroutine prolong_solution(coarse, fine)
      type(level_t), intent(in) :: coarse
      type(level_t), intent(inout) :: fine
      integer :: j

      call refine(coarse%p, coarse%grid, fine%p)
      call refine(coarse%h - coarse%h00 - coarse%film_rhs, coarse%grid, fine%h)
      fine%h00 = coarse%h00
      do j = 1, fine%grid%ny
         call cavitate(fine%p(:, j))
         fine%h(:, j) = fine%h00 + fine%film_rhs(:, j) + fine%h(:, j)
      end do
      call update_coefficients(fine)
   end subroutine prolong_solution

   !> Cubic interpolation of a field along X and along Y
   pure subroutine refine(values, grid, fine)
      real(dp), intent(in) :: values(:, :)
      !> The coarse grid
      type(grid_t), intent(in) :: grid
      !> The field on the fine grid
      real(dp), intent(out) :: fine(:, :)
      integer :: l, n, below, above

      n = size(values, 2)
      do l = 1, n
         call refine_line(values(:, l), fine(:, 2*l - 1))
      end do
      if (grid%periodic .and. .not. grid%mirror) then
         do l = 2, size(fine, 2), 2
            associate (row => modulo([l - 4, l - 2, l, l + 2], size(fine, 2)) + 1)
               fine(:, l) = (9.0_dp*(fine(:, row(2)) + fine(:, row(3))) - fine(:, row(1)) - fine(:, row(4)))/16.0_dp
            end associate
         end do
         return
      end if
      do l = 1, n - 1
         below = 2*l - 3
         if (l == 1) below = merge(3, 1, grid%mirror)
         above = 2*l + 3
         if (l == n - 1) above = size(fine, 2) - merge(2, 0, grid%periodic)
         fine(:, 2*l) = (9.0_dp*(fine(:, 2*l - 1) + fine(:, 2*l + 1)) - fine(:, below) - fine(:, above))/16.0_dp
      end do
   end subroutine refine

   !> Cubic interpolation of a row; beyond its ends it is constant
   pure subroutine refine_line(a, b)
      real(dp), intent(in) :: a(:)
      real(dp), intent(out) :: b(:)
      integer :: i, n

      n = size(a)
      b(1::2) = a
      do i = 1, n - 1
         b(2*i) = (9.0_dp*(a(i) + a(i + 1)) - a(max(i - 1, 1)) - a(min(i + 2, n)))/16.0_dp
      end do
   end subroutine refine_line
end module ehl_cycle

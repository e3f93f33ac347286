! SPDX-License-Identifier: BSD-3-Clause
!> Hybrid line relaxation along X (Venner & Lubrecht 2000, ch. 6): lines of alternating colour
!> are solved for changes of pressure. Where the Poiseuille term matters, a change applies to its
!> own node alone (Gauss-Seidel). Where it is negligible, a change is a dipole: its four neighbours
!> together change by the opposite (each by -1/4 of it on square cells, workspace.f90), so that its
!> deflection is local (distributive Jacobi).
!>
!> Sources of the constants: docs/design.md.
module ehl_relaxation
   use ehl_kinds, only: dp
   use ehl_flow, only: dir_x
   use ehl_level, only: cavitate, change_flowing, flowing_around, level_t
   use ehl_line_system, only: last_active, solve_lines
   use ehl_smooth_change, only: filter_smooth_change, find_smoothing_weights
   use ehl_workspace, only: line_width, workspace_t
   !$ use omp_lib, only: omp_get_thread_num
   implicit none (type, external)
   private
   public :: relax, usual_log_change

   !> Maximum conductance/hy^2 in the neighbourhood of a distributive node, for a Newtonian and a shear-thinning lubricant.
   !> The conductance along Y counts: lines include the coupling along X, and only the coupling to other lines limits a change
   !> that is smooth along Y.
   real(dp), parameter :: switch = 0.1_dp, switch_thinning = 0.25_dp
   !> Relaxation factors of distributive changes, and of Gauss-Seidel changes where the wedge and the Poiseuille term are of
   !> similar size; the latter tends to 1 where conductance/mesh-size^2 (the smaller mesh size) is well above `strong`
   real(dp), parameter :: omega_dipole = 0.7_dp, omega_line = 0.5_dp, strong = 10.0_dp
   !> The latter of soft contacts: where the viscosity hardly increases the two terms are similar in all of the contact, not only
   !> at its edge, and smooth changes overshoot (L = 0.5, M = 2000: 4 cycles, not converged in 30 with 0.5)
   real(dp), parameter :: omega_soft = 0.25_dp
   !> Both in time steps, where the smooth part of changes is removed
   real(dp), parameter :: omega_step = 0.8_dp
   !> Default limit of the change of the logarithm of a node's conductance in a sweep, of time steps and on grids of one row: the
   !> linearised system does not hold for larger changes
   real(dp), parameter :: usual_log_change = 3.0_dp

contains

   !> One sweep. Needs film and coefficients of the present pressure; leaves them out of date.
   subroutine relax(level, space, max_log_change, relaxation_factor)
      type(level_t), intent(inout) :: level
      type(workspace_t), intent(inout) :: space
      !> Maximum change of the logarithm of a node's conductance; applied in time steps, or if it is below `usual_log_change`
      real(dp), intent(in) :: max_log_change
      !> Factor of all changes, in addition to the relaxation factors above
      real(dp), intent(in) :: relaxation_factor
      integer :: colour, block, blocks, first, last, start, me

      first = level%grid%first_inner()
      last = level%grid%last_inner()
      call mark_dipoles(level, space, first, last)
      if (level%wedge%squeeze > 0.0_dp) call find_smoothing_weights(level, space, first, last)
      do colour = 0, 1
         ! the line Y = 0 has the first colour on half and on whole domains
         start = first + colour
         if (.not. level%grid%mirror .and. mod((level%grid%ny + 1)/2, 2) == 1) start = first + 1 - colour
         if (start > last) cycle
         blocks = ((last - start)/2 + line_width)/line_width
         !$omp parallel do default(none) shared(level, space, max_log_change, relaxation_factor, last, start, blocks) private(me) &
         !$omp num_threads(level%threads) if(level%parallel) schedule(static, 1)
         do block = 1, blocks
            me = 1
            !$ me = omp_get_thread_num() + 1
            call relax_lines(level, space, start + 2*line_width*(block - 1), last, max_log_change, relaxation_factor, me)
         end do
         !$omp end parallel do
      end do
      call apply_dipoles(level, space, first, last)
      if (level%wedge%squeeze > 0.0_dp) call filter_smooth_change(level, space, first, last)
   end subroutine relax

   !> 1 where a node changes distributively, else 0
   subroutine mark_dipoles(level, space, first, last)
      type(level_t), intent(in) :: level
      type(workspace_t), intent(inout) :: space
      integer, intent(in) :: first, last
      real(dp) :: limit, largest(level%grid%nx)
      integer :: i, j, below, above

      limit = merge(switch_thinning, switch, level%flow%depends_on_gradient)*level%grid%hy**2
      !$omp parallel do default(none) shared(level, space, first, last, limit) private(i, below, above, largest) &
      !$omp num_threads(level%threads) if(level%parallel) schedule(static)
      do j = first, last
         below = level%grid%south(j)
         above = level%grid%north(j)
         call level%flow%max_neighbour_conductance(j, below, above, largest)
         call level%boundary%max_flowing_conductance(level%p, level%flow%eps(:, :, level%flow%dir_y), j, below, above, largest)
         call flowing_around(level%p(:, below), level%p(:, j), level%p(:, above), space%dipole(:, j))
         call level%boundary%mark_dipoles(level%p(:, j), j, space%dipole(:, j))
         do i = 2, level%grid%nx - 1
            space%dipole(i, j) = merge(space%dipole(i, j), 0.0_dp, largest(i) < limit)
         end do
      end do
      !$omp end parallel do
   end subroutine mark_dipoles

   !> Solve the lines j0, j0+2, ... (at most `line_width`, up to row `last`): Gauss-Seidel changes are
   !> applied at once, distributive ones at the end of the sweep
   subroutine relax_lines(level, space, j0, last, max_log_change, relaxation_factor, thread)
      type(level_t), intent(inout) :: level
      type(workspace_t), intent(inout) :: space
      integer, intent(in) :: j0, last, thread
      real(dp), intent(in) :: max_log_change, relaxation_factor
      real(dp) :: scale, omega, omega_far
      real(dp), dimension(level%grid%nx) :: t, slope, change, after
      integer :: across
      logical :: time_step, limited
      integer :: rows(line_width), lines, furthest, i, j, l

      lines = min(line_width, (last - j0)/2 + 1)
      rows = [(j0 + 2*min(l - 1, lines - 1), l=1, line_width)]
      scale = 1.0_dp/(strong*min(level%grid%hx, level%grid%hy)**2)
      time_step = level%wedge%squeeze > 0.0_dp
      ! a Galerkin operator does not change with the pressure
      limited = (time_step .or. max_log_change < usual_log_change) .and. .not. level%poiseuille%frozen
      ! the conductance along Y changes most with pressure
      across = level%flow%dir_y
      omega = merge(omega_step, merge(omega_soft, omega_line, level%soft), time_step)
      omega_far = merge(omega_step, omega_dipole, time_step)
      associate (work => space%lines(thread))
         furthest = 2
         do l = 1, lines
            furthest = max(furthest, last_active(level, rows(l)))
         end do
         call solve_lines(level, space%dipole, space%dipole_weights, space%near, space%near_dipole, rows, furthest, work)
         do l = 1, lines
            j = rows(l)
            space%change(furthest + 1:, j) = 0.0_dp
            if (time_step) space%raw_change(furthest + 1:, j) = 0.0_dp
            t(2:furthest) = level%flow%eps(2:furthest, j, dir_x)*scale
            change(2:furthest) = relaxation_factor*work%change(l, 2:furthest)
            if (limited) then
               slope(2:furthest) = level%flow%dlneps_dp(2:furthest, j, across)
               if (time_step) call level%boundary%zero_touching(2, j, slope(2:furthest))
               call limit_changes(slope(2:furthest), max_log_change, change(2:furthest))
            end if
            do i = 2, furthest
               space%change(i, j) = omega_far*space%dipole(i, j)*change(i)
               after(i) = level%p(i, j) + (1.0_dp - space%dipole(i, j))*(omega + t(i))/(1.0_dp + t(i))*change(i)
            end do
            call cavitate(after(2:furthest))
            call level%boundary%yielding%limit_pressure(level%p(2:furthest, j), 2, j, after(2:furthest))
            if (time_step) then
               do i = 2, furthest
                  space%raw_change(i, j) = (after(i) - level%p(i, j))*space%smoothing_weight(i, j)
               end do
            end if
            level%p(2:furthest, j) = after(2:furthest)
         end do
      end associate
   end subroutine relax_lines

   !> Limit changes of pressure where the logarithm of the conductance would change by more than `max_log_change`
   pure subroutine limit_changes(slope, max_log_change, change)
      !> Derivative of that logarithm with respect to P, same shape as the changes
      real(dp), contiguous, intent(in) :: slope(:)
      real(dp), intent(in) :: max_log_change
      real(dp), contiguous, intent(inout) :: change(:)
      integer :: i

      do i = 1, size(change)
         change(i) = change(i)/max(1.0_dp, abs(slope(i)*change(i))/max_log_change)
      end do
   end subroutine limit_changes

   !> Add the dipoles to the pressure
   subroutine apply_dipoles(level, space, first, last)
      type(level_t), intent(inout) :: level
      type(workspace_t), intent(in) :: space
      integer, intent(in) :: first, last
      real(dp) :: after(level%grid%nx)
      integer :: j, nx

      nx = level%grid%nx
      !$omp parallel do default(none) shared(level, space, first, last, nx) private(after) &
      !$omp num_threads(level%threads) if(level%parallel) schedule(static)
      do j = first, last
         call apply_row(space%dipole_weights, space%change(:, level%grid%south(j)), space%change(:, j), &
                        space%change(:, level%grid%north(j)), level%p(:, j), after)
         call level%boundary%yielding%limit_pressure(level%p(2:nx - 1, j), 2, j, after(2:nx - 1))
         call change_flowing(after(2:nx - 1), level%p(2:nx - 1, j))
      end do
      !$omp end parallel do
   end subroutine apply_dipoles

   !> Pressure of a row with the distributive changes of the row and its neighbours
   pure subroutine apply_row(weights, south, change, north, p, after)
      real(dp), intent(in) :: weights(2)
      real(dp), contiguous, intent(in) :: south(:), change(:), north(:), p(:)
      real(dp), contiguous, intent(inout) :: after(:)
      integer :: i

      do i = 2, size(p) - 1
         after(i) = p(i) + change(i) - (weights(1)*(change(i - 1) + change(i + 1)) + weights(2)*south(i) + weights(2)*north(i))
      end do
   end subroutine apply_row
end module ehl_relaxation

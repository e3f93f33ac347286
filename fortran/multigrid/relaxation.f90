! SPDX-License-Identifier: BSD-3-Clause
!> Hybrid line relaxation along X (Venner & Lubrecht 2000, ch. 6): lines of alternating colour
!> are solved for changes of pressure. Where the Poiseuille term matters, a change concerns its
!> own node (Gauss-Seidel). Where it is negligible, a change is a dipole: -1/4 of it goes to each
!> of the four neighbours, so that the deflection it causes stays local (distributive Jacobi).
!>
!> Departures from the school, measured. Steady (residual reduction of a W(2,1) cycle at 513 x 513
!> from 0.3-0.5 to 0.13-0.25 for 20 <= M <= 2000, 5 <= L <= 15):
!> a node is distributive only if the conductance is small at its neighbours too, for the dipole
!> reaches them; and the lines know how the conductance varies with pressure (Newton instead
!> of Picard), which is what holds at the pressure spike. Where a node or a neighbour is cavitated
!> there are no dipoles, lest they lift a boundary that the lines push back, for ever.
!>
!> In a time step the squeeze term multiplies the deflection by 1.5/dT, dT = h, and smooth changes of
!> Gauss-Seidel nodes with a small conductance, whose deflection the lines do not see, overshoot (the more the
!> finer the grid and the lower L). Coarse grids are there for smooth changes: what is smooth in the
!> changes of these nodes is taken back at the end of a sweep. From 4.4 to 2 cycles a step at
!> M = 1000, L = 10, from 12 to 3 at (500, 5), and (1000, 5) converges.
module ehl_relaxation
   use ehl_kinds, only: dp
   use ehl_level, only: level_t, line_width
   use ehl_line_system, only: last_awake, solve_lines
   !$ use omp_lib, only: omp_get_thread_num
   implicit none (type, external)
   private
   public :: relax

   !> Largest conductance/mesh-size^2 of a distributive node's neighbourhood
   real(dp), parameter :: switch = 0.1_dp
   !> Under-relaxation of distributive changes, and of Gauss-Seidel changes where the wedge and
   !> the Poiseuille term compete; the latter tends to 1 where conductance/mesh-size^2 passes `strong`
   real(dp), parameter :: omega_dipole = 0.7_dp, omega_line = 0.5_dp, strong = 10.0_dp
   !> The same in time steps, where smooth changes are taken back
   real(dp), parameter :: omega_step = 0.8_dp
   !> Conductance/mesh-size^2, as a share of the squeeze term's factor, at which half of the change counts
   !> as one to be freed of its smooth part: there a change smooth over 0.25 a makes as much of a
   !> residual by its deflection as by the conductance
   real(dp), parameter :: weak = 0.03_dp
   !> Weights of the mean that is the smooth part, along X and along Y
   real(dp), parameter :: binomial(-2:2) = [1.0_dp, 4.0_dp, 6.0_dp, 4.0_dp, 1.0_dp]/16.0_dp

contains

   !> One sweep. Needs film and coefficients of the present pressure; leaves them out of date.
   subroutine relax(level)
      type(level_t), intent(inout) :: level
      integer :: colour, block, blocks, first, last, start, me

      first = merge(1, 2, level%grid%mirror)
      last = level%grid%ny - 1
      call mark_dipoles(level, first, last)
      do colour = 0, 1
         ! the line Y = 0 belongs to the first colour, on half and on whole domains alike
         start = first + colour
         if (.not. level%grid%mirror .and. mod((level%grid%ny + 1)/2, 2) == 1) start = first + 1 - colour
         if (start > last) cycle
         blocks = ((last - start)/2 + line_width)/line_width
         !$omp parallel do default(none) shared(level, last, start, blocks) private(me) &
         !$omp num_threads(level%threads) if(level%parallel) schedule(static)
         do block = 1, blocks
            me = 1
            !$ me = omp_get_thread_num() + 1
            call relax_lines(level, start + 2*line_width*(block - 1), last, me)
         end do
         !$omp end parallel do
      end do
      call apply_dipoles(level, first, last)
      if (level%squeeze > 0.0_dp) call take_back_smooth(level, first, last)
   end subroutine relax

   !> 1 where a node changes distributively, else 0
   subroutine mark_dipoles(level, first, last)
      type(level_t), intent(inout) :: level
      integer, intent(in) :: first, last
      real(dp) :: limit
      integer :: i, j, below

      limit = switch*min(level%grid%hx, level%grid%hy)**2
      !$omp parallel do default(none) shared(level, first, last, limit) private(i, below) &
      !$omp num_threads(level%threads) if(level%parallel) schedule(static)
      do j = first, last
         below = merge(2, j - 1, j == 1)
         do i = 2, level%grid%nx - 1
            level%dipole(i, j) = merge(1.0_dp, 0.0_dp, &
                                       max(level%eps(i, j), level%eps(i - 1, j), level%eps(i + 1, j), &
                                           level%eps(i, j + 1), level%eps(i, below)) < limit .and. &
                                       min(level%p(i, j), level%p(i - 1, j), level%p(i + 1, j), &
                                           level%p(i, j + 1), level%p(i, below)) > 0.0_dp)
         end do
      end do
      !$omp end parallel do
   end subroutine mark_dipoles

   !> Solve the lines j0, j0+2, ... (at most `line_width`, up to row `last`): Gauss-Seidel changes are
   !> applied at once, distributive ones are kept for the end of the sweep
   subroutine relax_lines(level, j0, last, thread)
      type(level_t), intent(inout) :: level
      integer, intent(in) :: j0, last, thread
      real(dp) :: scale, t, weak_scale, omega, omega_far, before
      logical :: time_step
      integer :: rows(line_width), lines, furthest, i, j, l

      lines = min(line_width, (last - j0)/2 + 1)
      rows = [(j0 + 2*min(l - 1, lines - 1), l=1, line_width)]
      scale = 1.0_dp/(strong*min(level%grid%hx, level%grid%hy)**2)
      time_step = level%squeeze > 0.0_dp
      omega = merge(omega_step, omega_line, time_step)
      omega_far = merge(omega_step, omega_dipole, time_step)
      weak_scale = 0.0_dp
      if (time_step) weak_scale = weakness(level)
      associate (work => level%work(thread))
         furthest = 2
         do l = 1, lines
            furthest = max(furthest, last_awake(level, rows(l)))
         end do
         call solve_lines(level, rows, furthest, work)
         do l = 1, lines
            j = rows(l)
            level%change(furthest + 1:, j) = 0.0_dp
            if (time_step) level%rough(furthest + 1:, j) = 0.0_dp
            do i = 2, furthest
               t = level%eps(i, j)*scale
               before = level%p(i, j)
               level%change(i, j) = omega_far*level%dipole(i, j)*work%change(l, i)
               level%p(i, j) = max(0.0_dp, level%p(i, j) + (1.0_dp - level%dipole(i, j))*(omega + t) &
                                   /(1.0_dp + t)*work%change(l, i))
               if (time_step) level%rough(i, j) = (level%p(i, j) - before)*(1.0_dp - level%dipole(i, j)) &
                                                  /(1.0_dp + (weak_scale*level%eps(i, j))**2)
            end do
         end do
      end associate
   end subroutine relax_lines

   !> The share of a Gauss-Seidel node's change that is to be free of its smooth part is 1/(1 + (this*eps)^2);
   !> in time steps
   pure real(dp) function weakness(level)
      type(level_t), intent(in) :: level
      weakness = 1.0_dp/(weak*level%squeeze*min(level%grid%hx, level%grid%hy)**2)
   end function weakness

   !> Take the smooth part of the changes of nodes with a weak conductance back
   subroutine take_back_smooth(level, first, last)
      type(level_t), intent(inout) :: level
      integer, intent(in) :: first, last
      real(dp) :: smooth(level%grid%nx), scale
      integer :: i, j, k, row, nx

      nx = level%grid%nx
      scale = weakness(level)
      !$omp parallel do default(none) shared(level, first, last, nx) private(i) &
      !$omp num_threads(level%threads) if(level%parallel) schedule(static)
      do j = first, last
         do i = 3, nx - 2
            level%smooth(i, j) = binomial(0)*level%rough(i, j) &
                                 + binomial(1)*(level%rough(i - 1, j) + level%rough(i + 1, j)) &
                                 + binomial(2)*(level%rough(i - 2, j) + level%rough(i + 2, j))
         end do
      end do
      !$omp end parallel do
      !$omp parallel do default(none) shared(level, first, last, nx, scale) private(i, k, row, smooth) &
      !$omp num_threads(level%threads) if(level%parallel) schedule(static)
      do j = first, last
         smooth = 0.0_dp
         do k = -2, 2
            row = j + k
            if (row < 1 .and. level%grid%mirror) row = 2 - row
            if (row < first .or. row > last) cycle
            smooth = smooth + binomial(k)*level%smooth(:, row)
         end do
         do i = 2, nx - 1
            if (level%p(i, j) > 0.0_dp) level%p(i, j) = &
               max(0.0_dp, level%p(i, j) - (1.0_dp - level%dipole(i, j))/(1.0_dp + (scale*level%eps(i, j))**2)*smooth(i))
         end do
      end do
      !$omp end parallel do
   end subroutine take_back_smooth

   !> Add the dipoles to the pressure
   subroutine apply_dipoles(level, first, last)
      type(level_t), intent(inout) :: level
      integer, intent(in) :: first, last
      integer :: i, j, below, nx

      nx = level%grid%nx
      !$omp parallel do default(none) shared(level, first, last, nx) private(i, below) &
      !$omp num_threads(level%threads) if(level%parallel) schedule(static)
      do j = first, last
         below = merge(2, j - 1, j == 1)
         do i = 2, nx - 1
            level%p(i, j) = max(0.0_dp, level%p(i, j) + level%change(i, j) - 0.25_dp*( &
                                level%change(i - 1, j) + level%change(i + 1, j) &
                                + level%change(i, below) + level%change(i, j + 1)))
         end do
      end do
      !$omp end parallel do
   end subroutine apply_dipoles
end module ehl_relaxation

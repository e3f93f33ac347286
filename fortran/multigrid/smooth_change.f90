! SPDX-License-Identifier: BSD-3-Clause
!> Relaxation in time steps: the smooth part of changes at nodes with a small conductance is removed at the end of a sweep,
!> because the line systems neglect its deflection. Sources of the constants: docs/design.md.
module ehl_smooth_change
   use ehl_kinds, only: dp
   use ehl_level, only: change_flowing, level_t
   use ehl_workspace, only: workspace_t
   implicit none (type, external)
   private
   public :: filter_smooth_change, find_smoothing_weights

   !> Conductance/mesh-size^2 (the smaller one) over the squeeze term's factor at which the smoothing weight is 1/2. The deflection
   !> of a change that is smooth over a length l changes the residual by about squeeze*l*2/pi^2; the change overshoots where the
   !> line system includes less than half of that. The maximum conductance around the node counts, because in a valley narrower
   !> than the mean below no change is smooth.
   real(dp), parameter :: weak = 0.6_dp
   !> Neighbourhood of a node: this many columns, and one row, on each side
   integer, parameter :: around = 2
   !> Smaller weights count as 0
   real(dp), parameter :: min_weight = 0.01_dp
   !> Weights of the mean, along X and along Y, that defines the smooth part. A narrower mean would remove
   !> the short waves that sweeps have to correct.
   integer, parameter :: reach = 4
   real(dp), parameter :: binomial(-reach:reach) = [1.0_dp, 8.0_dp, 28.0_dp, 56.0_dp, 70.0_dp, 56.0_dp, 28.0_dp, &
                                                    8.0_dp, 1.0_dp]/256.0_dp

contains

   !> Weight, in time steps, with which the smooth part of a node's change is removed: 1 where the conductance
   !> around the node is small compared with the squeeze term, 0 where it is large
   subroutine find_smoothing_weights(level, space, first, last)
      type(level_t), intent(in) :: level
      type(workspace_t), intent(inout) :: space
      integer, intent(in) :: first, last
      real(dp) :: scale, weight, conductance, largest(level%grid%nx)
      integer :: i, j, k, below, above, nx, across

      nx = level%grid%nx
      across = level%flow%dir_y
      scale = 1.0_dp/(weak*level%wedge%squeeze*min(level%grid%hx, level%grid%hy)**2)
      !$omp parallel do default(none) shared(level, space, first, last, scale, nx, across) &
      !$omp private(i, k, below, above, weight, conductance, largest) &
      !$omp num_threads(level%threads) if(level%parallel) schedule(static)
      do j = first, last
         below = level%grid%south(j)
         above = level%grid%north(j)
         largest = max(level%flow%eps(:, below, across), level%flow%eps(:, j, across), level%flow%eps(:, above, across))
         call level%boundary%max_conductance_of_rows(level%flow%eps(:, :, across), j, below, above, largest)
         do i = 1 + around, nx - around
            conductance = largest(i)
            do k = 1, around
               conductance = max(conductance, largest(i - k), largest(i + k))
            end do
            weight = 1.0_dp/(1.0_dp + (scale*conductance)**2)
            space%smoothing_weight(i, j) = merge(weight, 0.0_dp, weight > min_weight)
         end do
      end do
      !$omp end parallel do
   end subroutine find_smoothing_weights

   !> Remove the smooth part of the changes of nodes with a weak conductance
   subroutine filter_smooth_change(level, space, first, last)
      type(level_t), intent(inout) :: level
      type(workspace_t), intent(inout) :: space
      integer, intent(in) :: first, last
      real(dp) :: smooth(level%grid%nx)
      integer :: from(last), to(last)
      integer :: i, j, k, row

      !$omp parallel do default(none) shared(level, space, first, last, from, to) private(i, k) &
      !$omp num_threads(level%threads) if(level%parallel) schedule(static, 8)
      do j = first, last
         from(j) = findloc(space%smoothing_weight(:, j) > 0.0_dp, .true., dim=1)
         to(j) = findloc(space%smoothing_weight(:, j) > 0.0_dp, .true., dim=1, back=.true.)
         space%mean_change(:, j) = 0.0_dp
         if (from(j) == 0) cycle
         do k = -reach, reach
            ! over the full width that the changes of this row reach: adjacent rows may have weights further out
            do i = max(from(j) - reach, 1 + reach), min(to(j) + reach, level%grid%nx - reach)
               space%mean_change(i, j) = space%mean_change(i, j) + binomial(k)*space%raw_change(i + k, j)
            end do
         end do
      end do
      !$omp end parallel do
      !$omp parallel do default(none) shared(level, space, first, last, from, to) private(i, k, row, smooth) &
      !$omp num_threads(level%threads) if(level%parallel) schedule(static, 8)
      do j = first, last
         if (from(j) == 0) cycle
         smooth(from(j):to(j)) = 0.0_dp
         do k = -reach, reach
            row = level%grid%stored_row(j + k)
            if (row < first .or. row > last) cycle
            do i = from(j), to(j)
               smooth(i) = smooth(i) + binomial(k)*space%mean_change(i, row)
            end do
         end do
         do i = from(j), to(j)
            smooth(i) = level%p(i, j) - space%smoothing_weight(i, j)*smooth(i)
         end do
         call level%boundary%yielding%limit_pressure(level%p(from(j):to(j), j), from(j), j, smooth(from(j):to(j)))
         call change_flowing(smooth(from(j):to(j)), level%p(from(j):to(j), j))
      end do
      !$omp end parallel do
   end subroutine filter_smooth_change
end module ehl_smooth_change

! SPDX-License-Identifier: BSD-3-Clause
!> Geometry of a time step, and the fields passed from step to step
module ehl_time_levels
   use ehl_contact, only: contact_t
   use ehl_flow, only: dir_x
   use ehl_kernel, only: coefficient
   use ehl_kinds, only: dp
   use ehl_level, only: level_t
   use ehl_oil_flow, only: content_row
   implicit none (type, external)
   private
   public :: set_geometry, set_history, keep, mirror

   !> A residual changes the squeeze of the film and the Poiseuille flow. Ratio of flow to squeeze at which half of the residual is
   !> passed to the next step.
   real(dp), parameter :: flow_to_squeeze = 1.0e4_dp

contains

   !> Gap of the undeformed bodies minus the roughness
   subroutine set_geometry(level, contact, rr, curvatures)
      type(level_t), intent(inout) :: level
      class(contact_t), intent(in) :: contact
      real(dp), intent(in) :: rr(:, :)
      !> Curvatures along X and Y over those of the contact
      real(dp), intent(in), optional :: curvatures(2)
      real(dp) :: x(level%grid%nx), along_y
      integer :: j

      x = level%grid%columns()
      along_y = 1.0_dp
      if (present(curvatures)) then
         x = x*sqrt(curvatures(1))
         along_y = sqrt(curvatures(2))
      end if
      !$omp parallel do default(none) shared(level, contact, rr, x, along_y) &
      !$omp num_threads(level%threads) if(level%parallel) schedule(static)
      do j = 1, level%grid%ny
         call contact%gap_row(x, along_y*level%grid%y(j), level%film_rhs(:, j))
         level%film_rhs(:, j) = level%film_rhs(:, j) - rr(:, j)
      end do
      !$omp end parallel do
   end subroutine set_geometry

   !> Mirror a field along X, for reversed flow
   subroutine mirror(values)
      real(dp), contiguous, intent(inout) :: values(:, :)
      integer :: j

      do j = 1, size(values, 2)
         values(:, j) = values(size(values, 1):1:-1, j)
      end do
   end subroutine mirror

   !> Contribution of earlier times to the right-hand side
   subroutine set_history(level, mass_content)
      type(level_t), intent(inout) :: level
      !> Mass content at the earlier times, the latest first, (nx, ny, old_times); see keep
      real(dp), intent(in) :: mass_content(:, :, :)
      integer :: j

      !$omp parallel do default(none) shared(level, mass_content) &
      !$omp num_threads(level%threads) if(level%parallel) schedule(static)
      do j = 1, level%grid%ny
         call level%wedge%history_row(mass_content(:, j, :), level%rhs(:, j))
      end do
      !$omp end parallel do
   end subroutine set_history

   !> Store the present fields. The stored mass content is not rho H but that of the flow balance, which differs by the residual of
   !> the step: the next step corrects it, so that residuals do not accumulate while they are convected through the contact. In the
   !> inlet the Poiseuille flow removes them within the step, and stored ones would only add noise. In a partially filled gap the
   !> oil content is stored.
   subroutine keep(level, mass_content, p_before)
      type(level_t), intent(in) :: level
      !> Mass content of the last two steps and pressure of the last three, the latest first
      real(dp), intent(inout) :: mass_content(:, :, :), p_before(:, :, :)
      real(dp) :: time, stored, flow, content(level%grid%nx)
      integer :: i, j

      time = 1.0_dp/level%wedge%squeeze
      ! squeeze per change of pressure at one node, with rho = 1; flow per change, with eps = 1
      stored = level%wedge%squeeze*coefficient(level%grid, level%kernel_factor, 0, 0)
      flow = level%poiseuille%flow_rate()
      !$omp parallel do default(none) shared(level, mass_content, p_before, time, stored, flow) private(i, content) &
      !$omp num_threads(level%threads) if(level%parallel) schedule(static)
      do j = 1, level%grid%ny
         call content_row(level, j, content)
         do i = 1, level%grid%nx
            mass_content(i, j, 2) = mass_content(i, j, 1)
            mass_content(i, j, 1) = content(i) &
                                    - time*level%residual(i, j)*stored &
                                    /(stored + level%flow%eps(i, j, dir_x)*flow/flow_to_squeeze)
            p_before(i, j, 3) = p_before(i, j, 2)
            p_before(i, j, 2) = p_before(i, j, 1)
            p_before(i, j, 1) = level%p(i, j)
         end do
      end do
      !$omp end parallel do
   end subroutine keep
end module ehl_time_levels

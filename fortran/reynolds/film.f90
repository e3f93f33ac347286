! SPDX-License-Identifier: BSD-3-Clause
!> Film thickness, conductance and the residual of the Reynolds equation on one level
module ehl_film
   use ehl_kernel, only: kernel_coefficient
   use ehl_kinds, only: dp
   use ehl_level, only: level_t
   implicit none (type, external)
   private
   public :: balance_load, film_residual, pressure_sum, refresh, reynolds_operator, update_coefficients, update_residual

contains

   !> Bring film and coefficients up to date with the pressure
   subroutine refresh(level)
      type(level_t), intent(inout) :: level
      call update_film(level)
      call update_coefficients(level)
   end subroutine refresh

   !> Deflection and film for the present pressure: H = H00 + geometry + K P
   subroutine update_film(level)
      type(level_t), intent(inout) :: level
      integer :: j

      call level%engine%apply(level%p, level%h)
      !$omp parallel do default(none) shared(level) num_threads(level%threads) if(level%parallel) schedule(static)
      do j = 1, level%grid%ny
         level%h(:, j) = level%h00 + level%geometry(:, j) + level%h(:, j)
      end do
      !$omp end parallel do
   end subroutine update_film

   !> Take a small relative error of the force balance away by scaling the pressure within the border; H00 keeps the mean
   !> film under it. Film and coefficients are up to date before and after.
   subroutine balance_load(level, load_error)
      type(level_t), intent(inout) :: level
      real(dp), intent(in) :: load_error
      real(dp) :: factor, deflection(level%grid%ny)
      integer :: j, nx

      nx = level%grid%nx
      factor = 1.0_dp/(1.0_dp + load_error/(1.0_dp - border_load(level)/level%load))
      !$omp parallel do default(none) shared(level, factor, deflection, nx) &
      !$omp num_threads(level%threads) if(level%parallel) schedule(static)
      do j = 1, level%grid%ny
         deflection(j) = sum(level%p(:, j)*(level%h(:, j) - level%h00 - level%geometry(:, j)))*level%grid%weight(j)
         if (.not. level%grid%is_border(j)) level%p(2:nx - 1, j) = factor*level%p(2:nx - 1, j)
      end do
      !$omp end parallel do
      level%h00 = level%h00 + (factor - factor**2)*sum(deflection)/level%load
      call refresh(level)
   end subroutine balance_load

   !> Density and conductance eps = rho H^3/(eta lambda_bar) for the present pressure and film; a level whose
   !> Poiseuille term is frozen keeps its conductance. Behind the last node of a row with pressure the lubricant is that at
   !> P = 0.
   subroutine update_coefficients(level)
      type(level_t), intent(inout) :: level
      real(dp) :: log_eta(level%grid%nx), zero(1), rest_log(1), rest_dlneta(1), rest_rho(1), rest_slope(1)
      integer :: i, j, last

      zero = 0.0_dp
      call level%lubricant%log_viscosity(zero, rest_log, rest_dlneta)
      call level%lubricant%density(zero, rest_rho, rest_slope)
      !$omp parallel do default(none) shared(level, rest_log, rest_dlneta, rest_rho, rest_slope) &
      !$omp private(i, last, log_eta) num_threads(level%threads) if(level%parallel) schedule(static, 8)
      do j = 1, level%grid%ny
         last = level%grid%nx
         do while (last > 1 .and. level%p(last, j) <= 0.0_dp)
            last = last - 1
         end do
         call level%lubricant%density(level%p(:last, j), level%rho(:last, j), level%h_drho_dp(:last, j))
         level%rho(last + 1:, j) = rest_rho(1)
         level%h_drho_dp(last + 1:, j) = rest_slope(1)
         if (.not. level%poiseuille%frozen) then
            call level%lubricant%log_viscosity(level%p(:last, j), log_eta(:last), level%dlneps_dp(:last, j))
            do i = 1, last
               level%eps(i, j) = level%rho(i, j)*level%h(i, j)**3*exp(-log_eta(i))*level%inverse_speed
            end do
            level%dlneps_dp(last + 1:, j) = rest_dlneta(1)
            level%eps(last + 1:, j) = rest_rho(1)*exp(-rest_log(1))*level%inverse_speed*level%h(last + 1:, j)**3
            level%dlneps_dp(:, j) = level%h_drho_dp(:, j)/level%rho(:, j) - level%dlneps_dp(:, j)
         end if
         level%mass_content(:, j) = level%rho(:, j)*level%h(:, j)
         level%h_drho_dp(:, j) = level%h_drho_dp(:, j)*level%h(:, j)
      end do
      !$omp end parallel do
   end subroutine update_coefficients

   !> Row j of the Reynolds operator div(eps grad P) - wedge (rho H), zero at the borders
   pure subroutine reynolds_operator(level, j, values)
      type(level_t), intent(in) :: level
      integer, intent(in) :: j
      !> Shape (nx)
      real(dp), intent(out) :: values(:)
      integer :: nx

      nx = level%grid%nx
      values(1) = 0.0_dp
      values(nx) = 0.0_dp
      if (level%grid%is_border(j)) then
         values(2:nx - 1) = 0.0_dp
         return
      end if
      call level%poiseuille%apply_row(level%p, level%eps, j, values)
      call level%wedge%subtract_row(level%mass_content(:, j), values)
   end subroutine reynolds_operator

   !> residual = rhs - operator where P > 0; where P = 0 only the part that asks for pressure
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
            if (level%p(i, j) <= 0.0_dp .and. level%residual(i, j) > 0.0_dp) level%residual(i, j) = 0.0_dp
         end do
         if (level%grid%is_border(j)) level%residual(:, j) = 0.0_dp
         sums(j) = sum(level%residual(:, j)**2)*level%grid%weight(j)/(level%grid%hx*level%grid%hy)
      end do
      !$omp end parallel do
      rms = sqrt(sum(sums)/(real(level%grid%nx, dp)*level%grid%full_ny()))
   end subroutine update_residual

   !> Residual (rms) as far as it concerns the film: each with the share that the deflection by the node's own pressure
   !> has in what answers it, the rest being the Poiseuille term. In the far inlet, where eps/h^2 is 1e8, a residual of 1
   !> is a pressure of 1e-9. Needs the residual of the present state.
   real(dp) function film_residual(level)
      type(level_t), intent(in) :: level
      real(dp) :: sums(level%grid%ny), wedge, poiseuille
      integer :: j

      associate (grid => level%grid)
         wedge = kernel_coefficient(level%kernel_factor, 0, 0, grid%hx, grid%hy)/grid%hx
         poiseuille = level%poiseuille%flow_rate()
         !$omp parallel do default(none) shared(level, sums, wedge, poiseuille) &
         !$omp num_threads(level%threads) if(level%parallel) schedule(static)
         do j = 1, grid%ny
            sums(j) = sum((level%residual(:, j)*wedge/(wedge + poiseuille*level%eps(:, j)))**2) &
                      *level%grid%weight(j)/(level%grid%hx*level%grid%hy)
         end do
         !$omp end parallel do
         film_residual = sqrt(sum(sums)/(real(grid%nx, dp)*grid%full_ny()))
      end associate
   end function film_residual

   !> What of the load the pressure at the border carries
   pure real(dp) function border_load(level)
      type(level_t), intent(in) :: level
      integer :: j

      border_load = 0.0_dp
      do j = 1, level%grid%ny
         if (level%grid%is_border(j)) then
            border_load = border_load + sum(level%p(:, j))*level%grid%weight(j)
         else
            border_load = border_load + (level%p(1, j) + level%p(level%grid%nx, j))*level%grid%weight(j)
         end if
      end do
   end function border_load

   !> hx hy sum P over the whole contact
   real(dp) function pressure_sum(level, p)
      type(level_t), intent(in) :: level
      real(dp), intent(in) :: p(:, :)
      real(dp) :: sums(size(p, 2))
      integer :: j

      !$omp parallel do default(none) shared(level, sums, p) &
      !$omp num_threads(level%threads) if(level%parallel) schedule(static)
      do j = 1, size(p, 2)
         sums(j) = sum(p(:, j))*level%grid%weight(j)
      end do
      !$omp end parallel do
      pressure_sum = sum(sums)
   end function pressure_sum
end module ehl_film

! SPDX-License-Identifier: BSD-3-Clause
!> Film thickness, conductance and the residual of the Reynolds equation on one level
module ehl_film
   use ehl_kinds, only: dp
   use ehl_level, only: level_t
   implicit none (type, external)
   private
   public :: update_film, update_coefficients, reynolds_operator, update_residual, pressure_sum

contains

   !> Deflection and film for the present pressure: H = H00 + geometry + K P
   subroutine update_film(level)
      type(level_t), intent(inout) :: level
      integer :: j

      call level%engine%apply(level%p, level%w)
      !$omp parallel do default(none) shared(level) num_threads(level%threads) if(level%parallel) schedule(static)
      do j = 1, level%grid%ny
         level%h(:, j) = level%h00 + level%geometry(:, j) + level%w(:, j)
      end do
      !$omp end parallel do
   end subroutine update_film

   !> Density and conductance eps = rho H^3/(eta lambda_bar) for the present pressure and film; a level with a
   !> Galerkin operator keeps its conductance. Behind the last node of a row with pressure the lubricant is that at
   !> P = 0.
   subroutine update_coefficients(level)
      type(level_t), intent(inout) :: level
      real(dp) :: log_eta(level%grid%nx), zero(1), rest_log(1), rest_gain(1), rest_rho(1), rest_slope(1)
      integer :: i, j, last

      zero = 0.0_dp
      call level%lubricant%log_viscosity(zero, rest_log, rest_gain)
      call level%lubricant%density(zero, rest_rho, rest_slope)
      !$omp parallel do default(none) shared(level, rest_log, rest_gain, rest_rho, rest_slope) &
      !$omp private(i, last, log_eta) num_threads(level%threads) if(level%parallel) schedule(static, 8)
      do j = 1, level%grid%ny
         last = level%grid%nx
         do while (last > 1 .and. level%p(last, j) <= 0.0_dp)
            last = last - 1
         end do
         call level%lubricant%density(level%p(:last, j), level%rho(:last, j), level%stiffness(:last, j))
         level%rho(last + 1:, j) = rest_rho(1)
         level%stiffness(last + 1:, j) = rest_slope(1)
         if (.not. level%galerkin) then
            call level%lubricant%log_viscosity(level%p(:last, j), log_eta(:last), level%gain(:last, j))
            do i = 1, last
               level%eps(i, j) = level%rho(i, j)*level%h(i, j)**3*exp(-log_eta(i))*level%inverse_speed
            end do
            level%gain(last + 1:, j) = rest_gain(1)
            level%eps(last + 1:, j) = rest_rho(1)*exp(-rest_log(1))*level%inverse_speed*level%h(last + 1:, j)**3
            level%gain(:, j) = level%stiffness(:, j)/level%rho(:, j) - level%gain(:, j)
         end if
         level%mass(:, j) = level%rho(:, j)*level%h(:, j)
         level%stiffness(:, j) = level%stiffness(:, j)*level%h(:, j)
      end do
      !$omp end parallel do
   end subroutine update_coefficients

   !> Row j of the Reynolds operator div(eps grad P) - wedge (rho H), zero at the borders
   pure subroutine reynolds_operator(level, j, values)
      type(level_t), intent(in) :: level
      integer, intent(in) :: j
      !> Shape (nx)
      real(dp), intent(out) :: values(:)
      real(dp) :: rx, ry
      integer :: i, below, nx

      nx = level%grid%nx
      values(1) = 0.0_dp
      values(nx) = 0.0_dp
      if (j == level%grid%ny .or. (j == 1 .and. .not. level%grid%mirror)) then
         values(2:nx - 1) = 0.0_dp
         return
      end if
      if (level%galerkin) then
         call level%poiseuille%apply_row(level%p, j, values)
         values(2:nx - 1) = values(2:nx - 1)/level%cell(j)
         call subtract_wedge(level, j, values)
         return
      end if
      below = merge(2, j - 1, j == 1)
      rx = 0.5_dp/level%grid%hx**2
      ry = 0.5_dp/level%grid%hy**2
      associate (p => level%p, e => level%eps)
         do i = 2, nx - 1
            values(i) = rx*((e(i + 1, j) + e(i, j))*(p(i + 1, j) - p(i, j)) &
                            + (e(i - 1, j) + e(i, j))*(p(i - 1, j) - p(i, j))) &
                        + ry*((e(i, j + 1) + e(i, j))*(p(i, j + 1) - p(i, j)) &
                              + (e(i, below) + e(i, j))*(p(i, below) - p(i, j)))
         end do
      end associate
      call subtract_wedge(level, j, values)
   end subroutine reynolds_operator

   !> Row j of the wedge (and squeeze) term
   pure subroutine subtract_wedge(level, j, values)
      type(level_t), intent(in) :: level
      integer, intent(in) :: j
      real(dp), intent(inout) :: values(:)
      integer :: i

      associate (mass => level%mass, c => level%wedge, f => level%wedge_first)
         values(2) = values(2) - f(0)*mass(2, j) - f(1)*mass(1, j)
         do i = 3, level%grid%nx - 1
            values(i) = values(i) - c(0)*mass(i, j) - c(1)*mass(i - 1, j) - c(2)*mass(i - 2, j)
         end do
      end associate
   end subroutine subtract_wedge

   !> residual = rhs - operator where P > 0; where P = 0 only the part that asks for pressure
   !> (residual < 0). Returns the rms over the grid.
   subroutine update_residual(level, rms)
      type(level_t), intent(inout) :: level
      real(dp), intent(out) :: rms
      real(dp) :: sums(level%grid%ny)
      integer :: i, j

      !$omp parallel do default(none) shared(level, sums) private(i) &
      !$omp num_threads(level%threads) if(level%parallel) schedule(static)
      do j = 1, level%grid%ny
         call reynolds_operator(level, j, level%residual(:, j))
         sums(j) = 0.0_dp
         do i = 2, level%grid%nx - 1
            level%residual(i, j) = level%rhs(i, j) - level%residual(i, j)
            if (level%p(i, j) <= 0.0_dp .and. level%residual(i, j) > 0.0_dp) level%residual(i, j) = 0.0_dp
         end do
         if (j == level%grid%ny .or. (j == 1 .and. .not. level%grid%mirror)) level%residual(:, j) = 0.0_dp
         sums(j) = sum(level%residual(:, j)**2)*level%grid%weight(j)/(level%grid%hx*level%grid%hy)
      end do
      !$omp end parallel do
      rms = sqrt(sum(sums)/(real(level%grid%nx, dp)*level%grid%full_ny()))
   end subroutine update_residual

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

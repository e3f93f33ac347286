! SPDX-License-Identifier: BSD-3-Clause
!> The film and what follows from it and the pressure, on one level:
!>
!>    H(X, Y) = H00 + G(X, Y) + (K P)(X, Y)
!>
!> with H00 the rigid separation, G the gap of the undeformed bodies less the roughness (X^2/2 + D Y^2/2 - RR with the ratio
!> of radii D, 1 for a ball on a flat; on a coarse level what multigrid/coarse_problem.f90 sets), and K P the elastic deflection
!> k_b iint P dX' dY'/r of the level's engine, k_b = 2/pi^2 in a round contact. Peaks of the roughness are positive and thin
!> the film.
module ehl_film
   use ehl_kinds, only: dp
   use ehl_level, only: level_t
   use ehl_node_state, only: last_flowing
   use ehl_reynolds, only: find_touching
   implicit none (type, external)
   private
   public :: refresh, update_coefficients

contains

   !> Bring film and coefficients up to date with the pressure
   subroutine refresh(level)
      type(level_t), intent(inout) :: level
      call update_film(level)
      call update_coefficients(level)
   end subroutine refresh

   !> Deflection and film for the present pressure
   subroutine update_film(level)
      type(level_t), intent(inout) :: level
      integer :: j

      call level%engine%apply(level%p, level%h)
      !$omp parallel do default(none) shared(level) num_threads(level%threads) if(level%parallel) schedule(static)
      do j = 1, level%grid%ny
         level%h(:, j) = level%h00 + level%film_rhs(:, j) + level%h(:, j)
      end do
      !$omp end parallel do
   end subroutine update_film

   !> Density, mass content and conductances for the present pressure and film; a level whose Poiseuille term is frozen
   !> keeps its conductances. Behind the last node of a row with pressure the lubricant is that at P = 0.
   subroutine update_coefficients(level)
      type(level_t), intent(inout) :: level
      real(dp) :: rest_rho(1), rest_slope(1)
      integer :: j, last

      call level%lubricant%density([0.0_dp], rest_rho, rest_slope)
      !$omp parallel do default(none) shared(level, rest_rho, rest_slope) private(last) &
      !$omp num_threads(level%threads) if(level%parallel) schedule(static, 8)
      do j = 1, level%grid%ny
         last = last_flowing(level%p(:, j))
         call level%lubricant%density(level%p(:last, j), level%rho(:last, j), level%h_drho_dp(:last, j))
         level%rho(last + 1:, j) = rest_rho(1)
         level%h_drho_dp(last + 1:, j) = rest_slope(1)
         call level%boundary%find_film(level%h(:, j), level%rho(:, j), j)
         if (.not. level%poiseuille%frozen) call level%flow%find_row( &
            level%lubricant, level%p, level%boundary%film_row(level%h(:, j), j), level%rho(:, j), level%h_drho_dp(:, j), j, last)
         level%mass_content(:, j) = level%rho(:, j)*level%h(:, j)
         level%h_drho_dp(:, j) = level%h_drho_dp(:, j)*level%h(:, j)
      end do
      !$omp end parallel do
      if (level%boundary%follows_state()) call find_touching(level)
   end subroutine update_coefficients
end module ehl_film

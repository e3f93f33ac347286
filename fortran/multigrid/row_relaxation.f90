! SPDX-License-Identifier: BSD-3-Clause
!> Relaxation of a grid of one row: a Newton step of the Reynolds equation (reynolds.f90) for all nodes, with the deflection
!> up to `row_reach` nodes away. Coarser grids correct smooth errors, whose deflection reaches further.
!>
!> With d the changes of the pressure, r the residual, K(l) the deflection l nodes away, and per node i
!>
!>    dH(i) = sum K(i-k) d(k), |i-k| <= row_reach,    d(rho H)(i) = rho(i) dH(i) + [H d rho/dP](i) d(i)
!>
!>    sum over the neighbours m = i-1, i+1 of  e(m) (d(m) - d(i)) + (P(m) - P(i)) d e(m)  -  sum c(l) d(rho H)(i-l)  =  r(i)
!>
!> where d e(m) is the change of the coupling with P and H of either node. K: kernel_of_row of workspace.f90. An inactive node
!> (level.f90) has d(i) = 0; a touching one (boundary_film.f90) rate d(rho H)(i) = -r(i).
module ehl_row_relaxation
   use ehl_flow, only: dir_x
   use ehl_kinds, only: dp
   use ehl_level, only: cavitate, cavity_pressure, level_t
   use ehl_line_system, only: last_active
   use ehl_poiseuille, only: block_size, line_terms_t
   use ehl_reynolds, only: flow_operator
   use ehl_wedge, only: wedge_reach
   use ehl_workspace, only: row_above, row_below, row_reach, workspace_t
   implicit none (type, external)
   private
   public :: relax_row

   !> Relaxation factor
   real(dp), parameter :: omega = 0.8_dp

contains

   !> One sweep. Needs film and coefficients of the present pressure; leaves them out of date.
   subroutine relax_row(level, space, max_log_change, relaxation_factor)
      type(level_t), intent(inout) :: level
      type(workspace_t), intent(inout) :: space
      !> Maximum change of the logarithm of a node's conductance
      real(dp), intent(in) :: max_log_change
      !> Factor of all changes in addition to `omega`
      real(dp), intent(in) :: relaxation_factor
      real(dp) :: change(level%grid%nx), after(level%grid%nx)
      logical :: passing(level%grid%nx)
      integer :: i, last

      last = last_active(level, 1)
      call find_residual(level, last, change, passing)
      call assemble(level, space%near_row, last, passing, change, space%band)
      call solve(space%band, last, change)
      do i = 2, last
         change(i) = change(i)/max(1.0_dp, abs(level%flow%dlneps_dp(i, 1, dir_x)*change(i))/max_log_change)
         after(i) = level%p(i, 1) + omega*relaxation_factor*change(i)
      end do
      call cavitate(after(2:last))
      call level%boundary%yielding%limit_pressure(level%p(2:last, 1), 2, 1, after(2:last))
      level%p(2:last, 1) = after(2:last)
   end subroutine relax_row

   !> Right-hand side minus operator at nodes 2 to `last`
   pure subroutine find_residual(level, last, residual, passing)
      type(level_t), intent(in) :: level
      integer, intent(in) :: last
      !> Shape (nx)
      real(dp), contiguous, intent(out) :: residual(:)
      !> Whether nodes pass on all oil (supply.f90)
      logical, contiguous, intent(out) :: passing(:)

      call flow_operator(level, 1, residual, passing)
      residual(2:last) = level%rhs(2:last, 1) - residual(2:last)
      call level%boundary%residual_row(level%rhs(:, 1), level%mass_content(:, 1), 1, residual)
   end subroutine find_residual

   !> Equations of nodes 2 to `last`: band(l, i) is the coefficient of the change at i + l in the equation of node i
   subroutine assemble(level, near, last, passing, residual, band)
      type(level_t), intent(in) :: level
      real(dp), intent(in) :: near(-row_reach:row_reach)
      integer, intent(in) :: last
      !> Whether nodes pass on all oil (supply.f90)
      logical, contiguous, intent(in) :: passing(:)
      real(dp), contiguous, intent(inout) :: residual(:)
      real(dp), intent(inout) :: band(-row_below:row_above, level%grid%nx)
      !> Factors of the changes of film and pressure at i + l
      real(dp) :: film(-wedge_reach:1), local(-wedge_reach:1), c(0:wedge_reach)
      !> The kernel, padded with zeros
      real(dp) :: kernel(-row_below - 1:row_above + wedge_reach)
      !> Per node: d ln eps/d ln H, and the film of the conductance
      real(dp), dimension(level%grid%nx) :: exponent, thickness
      type(line_terms_t) :: terms
      !> Fraction of the flow to the upstream node that does not return from there
      real(dp) :: fraction
      integer :: first, i, k, l, m

      kernel = 0.0_dp
      kernel(-row_reach:row_reach) = near
      do i = 1, last + 1
         exponent(i) = level%flow%film_exponent(i, 1, dir_x)
         thickness(i) = level%boundary%film_at(level%h, i, 1)
      end do
      do first = 2, last, block_size
         call level%poiseuille%line_row(level%p, level%flow, level%rhs(:, 1), 1, first, min(first + block_size - 1, last), terms)
         do i = first, min(first + block_size - 1, last)
            k = i - first + 1
            if (level%p(i, 1) <= cavity_pressure .and. residual(i) >= 0.0_dp) then
               band(:, i) = 0.0_dp
               band(0, i) = 1.0_dp
               residual(i) = 0.0_dp
               cycle
            end if
            film = 0.0_dp
            local = 0.0_dp
            if (level%boundary%touches(i, 1)) then
               film(0) = -level%boundary%rate*level%rho(i, 1)
               local(0) = -level%boundary%rate*level%h_drho_dp(i, 1)
            else
               c = level%wedge%weights(i, passing(i - 1), level%supply%passed_fraction)
               do l = 0, min(wedge_reach, i - 1)
                  film(-l) = -c(l)*level%rho(i - l, 1)
                  local(-l) = -c(l)*level%h_drho_dp(i - l, 1)
               end do
               call add_neighbour(i, 1, terms%east(k), terms%east_rate(k))
               fraction = merge(1.0_dp - level%supply%passed_fraction, 1.0_dp, passing(i - 1))
               if (fraction > 0.0_dp) call add_neighbour(i, -1, fraction*terms%east(k - 1), fraction*terms%east_rate(k - 1))
            end if
            ! all elements by the kernel, then again those that have a local term
            do l = -row_below, row_above
               band(l, i) = film(-1)*kernel(l + 1) + film(-2)*kernel(l + 2) + film(0)*kernel(l) + film(1)*kernel(l - 1)
            end do
            do l = -wedge_reach, 1
               band(l, i) = 0.0_dp
               do m = -wedge_reach, 1
                  if (m == l) band(l, i) = band(l, i) + local(l)
                  band(l, i) = band(l, i) + film(m)*kernel(l - m)
               end do
            end do
         end do
      end do

   contains

      !> Add the coupling of node i to node i + m, linearised
      subroutine add_neighbour(i, m, coupling, rate)
         integer, intent(in) :: i, m
         real(dp), intent(in) :: coupling, rate
         real(dp) :: part
         integer :: n

         local(m) = local(m) + coupling
         local(0) = local(0) - coupling
         part = rate*(level%p(i + m, 1) - level%p(i, 1))
         do n = min(m, 0), max(m, 0)
            associate (eps => level%flow%eps(i + n, 1, dir_x))
               film(n) = film(n) + part*exponent(i + n)*eps/thickness(i + n)
               local(n) = local(n) + part*eps*level%flow%dlneps_dp(i + n, 1, dir_x)
            end associate
         end do
      end subroutine add_neighbour
   end subroutine assemble

   !> Solve the equations of nodes 2 to `last` in place, without pivoting: the diagonal dominates. Each finished equation is
   !> subtracted from all later ones: the other order would read an equation right after it was written, at an offset, which
   !> stalls the processor.
   pure subroutine solve(band, last, x)
      real(dp), contiguous, intent(inout) :: band(-row_below:, :), x(:)
      integer, intent(in) :: last
      real(dp) :: t
      integer :: i, k, l

      do k = 2, last
         t = 1.0_dp/band(0, k)
         band(1:row_above, k) = band(1:row_above, k)*t
         x(k) = x(k)*t
         do i = k + 1, min(k + row_below, last)
            t = band(k - i, i)
            if (.not. abs(t) > 0.0_dp) cycle
            !$omp simd
            do l = 1, row_above
               band(k - i + l, i) = band(k - i + l, i) - t*band(l, k)
            end do
            x(i) = x(i) - t*x(k)
         end do
      end do
      do i = last, 2, -1
         do k = 1, min(row_above, last - i)
            x(i) = x(i) - band(k, i)*x(i + k)
         end do
      end do
   end subroutine solve
end module ehl_row_relaxation

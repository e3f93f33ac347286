! SPDX-License-Identifier: BSD-3-Clause
!> Line systems of the Reynolds equation (reynolds.f90) along X: the changes d(i) of the pressure of a row that solve its
!> linearised equation with the other rows fixed. A node with D(i) = 1 changes distributively: each neighbour along X changes
!> by -q d(i), each neighbour along Y by -b d(i) (workspace.f90; 1/4 on square cells); otherwise D(i) = 0. With r(i) the
!> residual,
!>
!>    em4 d(i-4) + em3 d(i-3) + em2 d(i-2) + em1 d(i-1) + e0 d(i) + e1 d(i+1) + e2 d(i+2) = r(i)
!>
!>    em4 = - c2 s(i-2, -2)
!>    em3 = - c1 s(i-1, -2) - c2 s(i-2, -1)
!>    em2 = - w q D(i-2) - c0 s(i, -2) - c1 s(i-1, -1) - c2 s(i-2, 0)
!>    em1 = w (1 + D(i-1) a) + w' g(i-1) (P(i-1) - P(i)) - c0 s(i, -1) - c1 s(i-1, 0) - c2 s(i-2, 1)
!>    e0  = o - e - w + D(i) [b o - q (e + w)] + g(i) [e' (P(i+1) - P(i)) + w' (P(i-1) - P(i)) + o']
!>          - c0 s(i, 0) - c1 s(i-1, 1) - c2 s(i-2, 2)
!>    e1  = e (1 + D(i+1) a) + e' g(i+1) (P(i+1) - P(i)) - c0 s(i, 1) - c1 s(i-1, 2)
!>    e2  = - e q D(i+2) - c0 s(i, 2)
!>
!>    s(i, l) = d(rho H)(i)/d d(i+l) = rho(i) K(l) + [H d rho/dP](i) (1 if l = 0, -q D(i+l) if |l| = 1, else 0)
!>    g(i)    = (1 - D(i)) d eps(i)/dP
!>
!> e, w: couplings to the east and to the west, o: minus the sum of those to other rows, e', w': their change with the
!> conductance, o': that of the flow from other rows (poiseuille.f90, line_terms_t); a: the mean of all four over the mean
!> of e and w, 1 where the conductances along X and Y are equal; c: wedge.f90; K(l): deflection at a distance of l nodes by
!> a unit change, neglected beyond |l| = 2. An inactive node (level.f90) has d(i) = 0. A touching node (boundary_film.f90)
!> is not coupled to its line: rate s(i, 0) d(i) = -r(i).
!>
!> The systems are assembled and eliminated in one pass along X for `line_width` lines side by side.
module ehl_line_system
   use ehl_kinds, only: dp
   use ehl_flow, only: dir_x
   use ehl_level, only: cavity_pressure, last_flowing, level_t
   use ehl_poiseuille, only: block_size, line_terms_t
   use ehl_reynolds, only: flow_operator
   use ehl_wedge, only: line_reach
   use ehl_workspace, only: line_fields, line_width, line_work_t, near_reach
   implicit none (type, external)
   private
   public :: last_active, solve_lines

   integer, parameter :: nr = near_reach
   !> Smaller pivots count as zero; those of nodes that may change are of the order of the wedge term's factor
   real(dp), parameter :: min_pivot = 1.0e-100_dp
   !> Data of a node: pressure, density, H d rho/dP, the derivative of the conductance with respect to P (0 if distributive), 1 if
   !> distributive, the residual; and of the Poiseuille term, see line_terms_t
   integer, parameter :: f_p = 1, f_rho = 2, f_h_drho_dp = 3, f_gain = 4, f_dipole = 5, f_residual = 6, &
                         f_other = 7, f_other_rate = 8, f_east = 9, f_east_rate = 10

contains

   !> Changes of pressure on the lines rows(1), rows(2), ...: work%change(line, node) solves the
   !> linearised equation along X
   subroutine solve_lines(level, dipole, weights, near, near_dipole, rows, last, work)
      type(level_t), intent(in) :: level
      !> 1 where a node changes distributively, else 0, shape (nx, ny)
      real(dp), contiguous, intent(in) :: dipole(:, :)
      !> Weights of a distributive change for the adjacent nodes along X and along Y; kernel near the source: of a point change, and
      !> of a distributive change
      real(dp), intent(in) :: weights(2), near(-nr:nr), near_dipole(-nr:nr)
      !> Rows of the grid; unused elements repeat a row
      integer, intent(in) :: rows(line_width)
      !> Last node that may change, see last_active; changes of the nodes downstream of it are not set
      integer, intent(in) :: last
      type(line_work_t), intent(inout) :: work
      logical :: any_touches

      call gather(level, dipole, rows, min(last + near_reach, level%grid%nx), work%fields)
      if (level%supply%active) call apply_supply(level, rows, last, work%fields)
      call level%boundary%line_residuals(rows, last, level%rhs, level%mass_content, work%fields(:, f_residual, 1:last), &
                                         work%touching, any_touches)
      call eliminate(level, weights, near, near_dipole - near, last, work%fields, work%touching, any_touches, work%upper, &
                     work%change)
      call substitute(last, work%upper, work%change)
   end subroutine solve_lines

   !> Last node of row j that has pressure, has a neighbour with pressure, or requires pressure; the nodes downstream of it do
   !> not change
   pure integer function last_active(level, j) result(i)
      type(level_t), intent(in) :: level
      integer, intent(in) :: j

      associate (p => level%p)
         i = max(last_flowing(p(:, level%grid%south(j))), last_flowing(p(:, j)), last_flowing(p(:, level%grid%north(j))))
      end associate
      ! 2 where there is no such node
      i = min(i + 1, level%grid%nx - 1)
      i = level%wedge%last_active(level%mass_content(:, j), level%rhs(:, j), i)
      i = max(i, level%boundary%last_touching(level%mass_content(:, j), j))
   end function last_active

   !> Gather the lines side by side, a block at a time so that it stays in the cache
   subroutine gather(level, dipole, rows, furthest, g)
      type(level_t), intent(in) :: level
      real(dp), contiguous, intent(in) :: dipole(:, :)
      integer, intent(in) :: rows(line_width)
      !> Last node that is gathered
      integer, intent(in) :: furthest
      real(dp), intent(inout) :: g(line_width, line_fields, -1:level%grid%nx + 2)
      type(line_terms_t) :: terms
      integer :: first, last, i, j, k, l

      do first = 1, furthest, block_size
         last = min(first + block_size - 1, furthest)
         do l = 1, line_width
            j = rows(l)
            call level%poiseuille%line_row(level%p, level%flow, level%rhs(:, j), j, first, last, terms)
            call level%wedge%line_row(level%mass_content(:, j), first, last, terms%rest)
            ! scatter stores of vector instructions are slower than scalar stores
            !GCC$ novector
            do i = first, last
               k = i - first + 1
               g(l, f_p, i) = level%p(i, j)
               g(l, f_rho, i) = level%rho(i, j)
               g(l, f_h_drho_dp, i) = level%h_drho_dp(i, j)
               g(l, f_gain, i) = (1.0_dp - dipole(i, j))*level%flow%eps(i, j, dir_x)*level%flow%dlneps_dp(i, j, dir_x)
               g(l, f_dipole, i) = dipole(i, j)
               g(l, f_residual, i) = terms%rest(k)
               g(l, f_other, i) = terms%other(k)
               g(l, f_other_rate, i) = terms%other_rate(k)
               g(l, f_east, i) = terms%east(k)
               g(l, f_east_rate, i) = terms%east_rate(k)
            end do
         end do
      end do
   end subroutine gather

   !> Starved inlet (supply.f90): residuals with the transported oil, and no flow back to nodes that pass on all oil. The wedge
   !> term's factors stay those of a flooded inlet: the Poiseuille term is much larger there.
   pure subroutine apply_supply(level, rows, last, g)
      type(level_t), intent(in) :: level
      integer, intent(in) :: rows(line_width)
      !> Last node that may change
      integer, intent(in) :: last
      real(dp), intent(inout) :: g(line_width, line_fields, -1:level%grid%nx + 2)
      real(dp) :: row(level%grid%nx)
      logical :: passing(level%grid%nx)
      integer :: i, l

      do l = 1, line_width
         call flow_operator(level, rows(l), row, passing)
         g(l, f_residual, 2:last) = level%rhs(2:last, rows(l)) - row(2:last)
         do i = 1, last - 1
            if (.not. passing(i)) cycle
            g(l, f_east, i) = (1.0_dp - level%supply%passed_fraction)*g(l, f_east, i)
            g(l, f_east_rate, i) = (1.0_dp - level%supply%passed_fraction)*g(l, f_east_rate, i)
         end do
      end do
   end subroutine apply_supply

   !> Row i of a line couples the changes at nodes i-4 ... i+2; it is eliminated with the rows before
   !> it as soon as it is assembled, so that only the upper two diagonals are stored. Coefficients: see above.
   pure subroutine eliminate(level, weights, near, delta, furthest, g, touching, any_touches, upper, change)
      type(level_t), intent(in) :: level
      !> Weights of a distributive change; kernel near the source, and the addition to it by a distributive change
      real(dp), intent(in) :: weights(2), near(-nr:nr), delta(-nr:nr)
      !> Last node
      integer, intent(in) :: furthest
      real(dp), intent(in) :: g(line_width, line_fields, -1:level%grid%nx + 2)
      !> 1 where a node touches (line, node), if any does
      real(dp), intent(in) :: touching(line_width, level%grid%nx)
      logical, intent(in) :: any_touches
      !> upper(line, diagonal, node), change(line, node), nodes from -3
      real(dp), intent(inout) :: upper(line_width, 2, -3:level%grid%nx), change(line_width, -3:level%grid%nx + 1)
      !> Response of rho H at nodes i, i-1, i-2 to unit changes at their columns -2..2
      real(dp) :: s(line_width, -nr:nr, 0:2)
      real(dp) :: c(0:line_reach), c_first(0:line_reach), c_interior(0:line_reach)
      real(dp) :: pivot(line_width), a(line_width), changes(line_width), required(line_width), apart(2)
      real(dp) :: east, west, re, rw, pe, pw, t, d, active, em4, em3, em2, em1, e0, e1, e2
      integer :: i, l, now, last, former
      logical :: uneven

      uneven = level%flow%dir_y > dir_x
      ! zero where cells are square
      apart = weights - 0.25_dp
      call level%wedge%line_weights(c_first, c_interior)
      upper(:, :, -3:1) = 0.0_dp
      change(:, -3:1) = 0.0_dp
      s = 0.0_dp
      a = 1.0_dp
      now = 0
      last = 1
      former = 2
      do i = 1, furthest
         !$omp simd private(t)
         do l = 1, line_width
            t = weights(1)*g(l, f_h_drho_dp, i)
            s(l, -2, now) = g(l, f_rho, i)*(near(-2) + g(l, f_dipole, i - 2)*delta(-2))
            s(l, -1, now) = g(l, f_rho, i)*(near(-1) + g(l, f_dipole, i - 1)*delta(-1)) - g(l, f_dipole, i - 1)*t
            s(l, 0, now) = g(l, f_rho, i)*(near(0) + g(l, f_dipole, i)*delta(0)) + g(l, f_h_drho_dp, i)
            s(l, 1, now) = g(l, f_rho, i)*(near(1) + g(l, f_dipole, i + 1)*delta(1)) - g(l, f_dipole, i + 1)*t
            s(l, 2, now) = g(l, f_rho, i)*(near(2) + g(l, f_dipole, i + 2)*delta(2))
         end do
         if (i > 1) then
            c = merge(c_first, c_interior, i == 2)
            if (uneven) then
               ! nodes that pass oil on are not coupled along X
               where (g(:, f_east, i) + g(:, f_east, i - 1) > 0.0_dp)
                  a = 0.5_dp - 0.5_dp*g(:, f_other, i)/(g(:, f_east, i) + g(:, f_east, i - 1) + tiny(1.0_dp))
               else where
                  a = 1.0_dp
               end where
            end if
            ! inactive nodes do not change; a condition in the loop below would prevent its vectorisation
            changes = merge(0.0_dp, 1.0_dp, g(:, f_p, i) <= cavity_pressure)
            changes = merge(changes, 1.0_dp, g(:, f_residual, i) >= 0.0_dp)
            required = changes*g(:, f_residual, i)
            if (any_touches) then
               where (touching(:, i) > 0.0_dp .and. changes > 0.0_dp)
                  required = -g(:, f_residual, i)/(level%boundary%rate*s(:, 0, now))
                  changes = 0.0_dp
               end where
            end if
            !$omp simd private(east, west, re, rw, pe, pw, t, d, active, em4, em3, em2, em1, e0, e1, e2)
            do l = 1, line_width
               re = g(l, f_east_rate, i)
               rw = g(l, f_east_rate, i - 1)
               east = g(l, f_east, i)
               west = g(l, f_east, i - 1)
               pe = g(l, f_p, i + 1) - g(l, f_p, i)
               pw = g(l, f_p, i - 1) - g(l, f_p, i)
               active = changes(l)
               d = required(l)
               em4 = -active*c(2)*s(l, -2, former)
               em3 = -active*(c(1)*s(l, -2, last) + c(2)*s(l, -1, former))
               em2 = -active*(weights(1)*west*g(l, f_dipole, i - 2) + c(0)*s(l, -2, now) + c(1)*s(l, -1, last) &
                              + c(2)*s(l, 0, former))
               em1 = active*(west*(1.0_dp + a(l)*g(l, f_dipole, i - 1)) + rw*g(l, f_gain, i - 1)*pw &
                             - c(0)*s(l, -1, now) - c(1)*s(l, 0, last) - c(2)*s(l, 1, former))
               e0 = active*((g(l, f_other, i) - east - west)*(1.0_dp + 0.25_dp*g(l, f_dipole, i)) &
                            + g(l, f_gain, i)*(re*pe + rw*pw + g(l, f_other_rate, i)) &
                            - c(0)*s(l, 0, now) - c(1)*s(l, 1, last) - c(2)*s(l, 2, former)) &
                      + ((1.0_dp - active) + active*g(l, f_dipole, i)*(apart(2)*g(l, f_other, i) - apart(1)*(east + west)))
               e1 = active*(east*(1.0_dp + a(l)*g(l, f_dipole, i + 1)) + re*g(l, f_gain, i + 1)*pe &
                            - c(0)*s(l, 1, now) - c(1)*s(l, 2, last))
               e2 = -active*(weights(1)*east*g(l, f_dipole, i + 2) + c(0)*s(l, 2, now))
               em3 = em3 - em4*upper(l, 1, i - 4)
               em2 = em2 - em4*upper(l, 2, i - 4) - em3*upper(l, 1, i - 3)
               em1 = em1 - em3*upper(l, 2, i - 3) - em2*upper(l, 1, i - 2)
               e0 = e0 - em2*upper(l, 2, i - 2) - em1*upper(l, 1, i - 1)
               t = 1.0_dp/e0
               pivot(l) = e0
               upper(l, 1, i) = (e1 - em1*upper(l, 2, i - 1))*t
               upper(l, 2, i) = e2*t
               change(l, i) = (d - em4*change(l, i - 4) - em3*change(l, i - 3) - em2*change(l, i - 2) &
                               - em1*change(l, i - 1))*t
            end do
            ! without a pivot the node keeps its pressure in this sweep
            if (minval(abs(pivot)) < min_pivot) then
               where (abs(pivot) < min_pivot) change(:, i) = 0.0_dp
               where (spread(abs(pivot) < min_pivot, 2, 2)) upper(:, :, i) = 0.0_dp
            end if
         end if
         l = former
         former = last
         last = now
         now = l
      end do
   end subroutine eliminate

   !> Back substitution
   pure subroutine substitute(furthest, upper, change)
      !> Last node
      integer, intent(in) :: furthest
      real(dp), intent(in) :: upper(line_width, 2, -3:furthest)
      real(dp), intent(inout) :: change(line_width, -3:furthest + 2)
      integer :: i

      change(:, furthest + 1:furthest + 2) = 0.0_dp
      do i = furthest, 2, -1
         change(:, i) = change(:, i) - upper(:, 1, i)*change(:, i + 1) - upper(:, 2, i)*change(:, i + 2)
      end do
   end subroutine substitute
end module ehl_line_system

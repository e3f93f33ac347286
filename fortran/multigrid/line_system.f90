! SPDX-License-Identifier: BSD-3-Clause
!> Line systems of the Reynolds equation along X, assembled and eliminated in one pass along X
!> for `line_width` lines side by side
module ehl_line_system
   use ehl_kinds, only: dp
   use ehl_level, only: level_t, line_fields, line_width, line_work_t, near_reach
   implicit none (type, external)
   private
   public :: last_awake, solve_lines

   integer, parameter :: nr = near_reach
   !> Nodes that are brought side by side at a time
   integer, parameter :: stretch = 32
   !> What is known of a node: conductance, pressure, density, H d rho/dP, rho H, the change of the
   !> conductance with pressure, 1 if distributive, the right-hand side less the Poiseuille term of other
   !> rows, minus the sum of the couplings to these, the change of their term with the conductance, and the
   !> coupling to the east per conductance
   integer, parameter :: f_eps = 1, f_p = 2, f_rho = 3, f_stiffness = 4, f_mass = 5, f_gain = 6, f_dipole = 7, &
                         f_rhs = 8, f_other = 9, f_slope = 10, f_east = 11

contains

   !> Changes of pressure on the lines rows(1), rows(2), ...: work%change(line, node) solves the
   !> linearised equation along X
   subroutine solve_lines(level, rows, last, work)
      type(level_t), intent(in) :: level
      !> Rows of the grid; unused places repeat a row
      integer, intent(in) :: rows(line_width)
      !> Last node that may change, see last_awake; changes of the nodes behind it are not set
      integer, intent(in) :: last
      type(line_work_t), intent(inout) :: work

      call gather(level, rows, min(last + near_reach, level%grid%nx), work%fields)
      call eliminate(level, last, work%fields, work%upper, work%change)
      call substitute(last, work%upper, work%change)
   end subroutine solve_lines

   !> Last node of row j that has pressure, or beside it a node that has, or asks for it; those behind it stay as
   !> they are
   pure integer function last_awake(level, j) result(i)
      type(level_t), intent(in) :: level
      integer, intent(in) :: j
      integer :: below

      below = merge(2, j - 1, j == 1)
      associate (p => level%p, c => level%wedge)
         do i = level%grid%nx - 1, 3, -1
            if (level%rhs(i, j) + c(0)*level%mass(i, j) + c(1)*level%mass(i - 1, j) + c(2)*level%mass(i - 2, j) &
                < 0.0_dp) return
            if (max(p(i - 1, j), p(i, j), p(i + 1, j)) > 0.0_dp) return
            if (max(p(i - 1, below), p(i, below), p(i + 1, below)) > 0.0_dp) return
            if (max(p(i - 1, j + 1), p(i, j + 1), p(i + 1, j + 1)) > 0.0_dp) return
         end do
      end associate
      i = 2
   end function last_awake

   !> Bring the lines side by side, a stretch at a time so that it stays in the cache
   subroutine gather(level, rows, furthest, g)
      type(level_t), intent(in) :: level
      integer, intent(in) :: rows(line_width)
      !> Last node that is brought
      integer, intent(in) :: furthest
      real(dp), intent(inout) :: g(line_width, line_fields, -1:level%grid%nx + 2)
      real(dp) :: ry, pn, ps, north, south, q, other
      integer :: first, last, i, j, l, below

      ry = 0.5_dp/level%grid%hy**2
      g(:, f_east, :) = 0.5_dp/level%grid%hx**2
      do first = 1, furthest, stretch
         last = min(first + stretch - 1, furthest)
         do l = 1, line_width
            j = rows(l)
            below = merge(2, j - 1, j == 1)
            associate (p => level%p, e => level%eps)
               ! stores scattered by vector instructions are slower than single ones
               !GCC$ novector
               do i = first, last
                  g(l, f_eps, i) = e(i, j)
                  g(l, f_p, i) = p(i, j)
                  g(l, f_rho, i) = level%rho(i, j)
                  g(l, f_stiffness, i) = level%stiffness(i, j)
                  g(l, f_mass, i) = level%mass(i, j)
                  g(l, f_gain, i) = (1.0_dp - level%dipole(i, j))*e(i, j)*level%gain(i, j)
                  g(l, f_dipole, i) = level%dipole(i, j)
               end do
               if (level%galerkin) then
                  do i = max(first, 2), min(last, level%grid%nx - 1)
                     call other_rows(level, i, j, q, other)
                     g(l, f_rhs, i) = level%rhs(i, j) - other
                     g(l, f_other, i) = q
                  end do
                  ! the couplings as they are, and no change of them
                  do i = first, last
                     g(l, f_east, i) = level%poiseuille%east(i, j)/level%cell(j)
                     g(l, f_eps, i) = 0.5_dp
                     g(l, f_gain, i) = 0.0_dp
                     g(l, f_slope, i) = 0.0_dp
                  end do
               else
                  !GCC$ novector
                  do i = first, last
                     north = ry*(e(i, j + 1) + e(i, j))
                     south = ry*(e(i, below) + e(i, j))
                     pn = p(i, j + 1) - p(i, j)
                     ps = p(i, below) - p(i, j)
                     g(l, f_rhs, i) = level%rhs(i, j) - north*pn - south*ps
                     g(l, f_other, i) = -(north + south)
                     g(l, f_slope, i) = ry*(pn + ps)
                  end do
               end if
            end associate
         end do
      end do
   end subroutine gather

   !> Galerkin operator at node (i, j), the couplings to its own row apart: the sum of the couplings and the
   !> excess, with a minus; and the term itself
   pure subroutine other_rows(level, i, j, q, term)
      type(level_t), intent(in) :: level
      integer, intent(in) :: i, j
      real(dp), intent(out) :: q, term

      associate (a => level%poiseuille, p => level%p)
         q = a%excess(i, j) + a%north_west(i, j) + a%north(i, j) + a%north_east(i, j)
         term = a%north_west(i, j)*p(i - 1, j + 1) + a%north(i, j)*p(i, j + 1) + a%north_east(i, j)*p(i + 1, j + 1)
         if (j > 1) then
            q = q + a%north_east(i - 1, j - 1) + a%north(i, j - 1) + a%north_west(i + 1, j - 1)
            term = term + a%north_east(i - 1, j - 1)*p(i - 1, j - 1) + a%north(i, j - 1)*p(i, j - 1) &
                   + a%north_west(i + 1, j - 1)*p(i + 1, j - 1)
         end if
         term = (term - q*p(i, j))/level%cell(j)
         q = -q/level%cell(j)
      end associate
   end subroutine other_rows

   !> Row i of a line couples the changes at nodes i-4 ... i+2; it is eliminated with the rows before
   !> it as soon as it is made, so that only the upper two diagonals are kept
   pure subroutine eliminate(level, furthest, g, upper, change)
      type(level_t), intent(in) :: level
      !> Last node
      integer, intent(in) :: furthest
      real(dp), intent(in) :: g(line_width, line_fields, -1:level%grid%nx + 2)
      !> upper(line, diagonal, node), change(line, node), nodes from -3
      real(dp), intent(inout) :: upper(line_width, 2, -3:level%grid%nx), change(line_width, -3:level%grid%nx + 1)
      !> Response of rho H at nodes i, i-1, i-2 to unit changes at their columns -2..2
      real(dp) :: s(line_width, -nr:nr, 0:2)
      real(dp) :: near(-nr:nr), delta(-nr:nr), c(0:2)
      real(dp) :: east, west, re, rw, pe, pw, r, t, d, active, em4, em3, em2, em1, e0, e1, e2
      integer :: i, l, now, last, former

      near = level%near
      delta = level%near_dipole - level%near
      upper(:, :, -3:1) = 0.0_dp
      change(:, -3:1) = 0.0_dp
      s = 0.0_dp
      now = 0
      last = 1
      former = 2
      do i = 1, furthest
         !$omp simd private(t)
         do l = 1, line_width
            t = 0.25_dp*g(l, f_stiffness, i)
            s(l, -2, now) = g(l, f_rho, i)*(near(-2) + g(l, f_dipole, i - 2)*delta(-2))
            s(l, -1, now) = g(l, f_rho, i)*(near(-1) + g(l, f_dipole, i - 1)*delta(-1)) - g(l, f_dipole, i - 1)*t
            s(l, 0, now) = g(l, f_rho, i)*(near(0) + g(l, f_dipole, i)*delta(0)) + g(l, f_stiffness, i)
            s(l, 1, now) = g(l, f_rho, i)*(near(1) + g(l, f_dipole, i + 1)*delta(1)) - g(l, f_dipole, i + 1)*t
            s(l, 2, now) = g(l, f_rho, i)*(near(2) + g(l, f_dipole, i + 2)*delta(2))
         end do
         if (i > 1) then
            c = merge(level%wedge_first, level%wedge, i == 2)
            !$omp simd private(east, west, re, rw, pe, pw, r, t, d, active, em4, em3, em2, em1, e0, e1, e2)
            do l = 1, line_width
               re = g(l, f_east, i)
               rw = g(l, f_east, i - 1)
               east = re*(g(l, f_eps, i + 1) + g(l, f_eps, i))
               west = rw*(g(l, f_eps, i - 1) + g(l, f_eps, i))
               pe = g(l, f_p, i + 1) - g(l, f_p, i)
               pw = g(l, f_p, i - 1) - g(l, f_p, i)
               r = g(l, f_rhs, i) - east*pe - west*pw &
                   + c(0)*g(l, f_mass, i) + c(1)*g(l, f_mass, i - 1) + c(2)*g(l, f_mass, i - 2)
               ! cavitated nodes that are content to stay so do not change
               active = merge(0.0_dp, 1.0_dp, g(l, f_p, i) <= 0.0_dp .and. r >= 0.0_dp)
               d = active*r
               em4 = -active*c(2)*s(l, -2, former)
               em3 = -active*(c(1)*s(l, -2, last) + c(2)*s(l, -1, former))
               em2 = -active*(0.25_dp*west*g(l, f_dipole, i - 2) + c(0)*s(l, -2, now) + c(1)*s(l, -1, last) &
                              + c(2)*s(l, 0, former))
               em1 = active*(west*(1.0_dp + g(l, f_dipole, i - 1)) + rw*g(l, f_gain, i - 1)*pw &
                             - c(0)*s(l, -1, now) - c(1)*s(l, 0, last) - c(2)*s(l, 1, former))
               e0 = active*((g(l, f_other, i) - east - west)*(1.0_dp + 0.25_dp*g(l, f_dipole, i)) &
                            + g(l, f_gain, i)*(re*pe + rw*pw + g(l, f_slope, i)) &
                            - c(0)*s(l, 0, now) - c(1)*s(l, 1, last) - c(2)*s(l, 2, former)) + (1.0_dp - active)
               e1 = active*(east*(1.0_dp + g(l, f_dipole, i + 1)) + re*g(l, f_gain, i + 1)*pe &
                            - c(0)*s(l, 1, now) - c(1)*s(l, 2, last))
               e2 = -active*(0.25_dp*east*g(l, f_dipole, i + 2) + c(0)*s(l, 2, now))
               em3 = em3 - em4*upper(l, 1, i - 4)
               em2 = em2 - em4*upper(l, 2, i - 4) - em3*upper(l, 1, i - 3)
               em1 = em1 - em3*upper(l, 2, i - 3) - em2*upper(l, 1, i - 2)
               e0 = e0 - em2*upper(l, 2, i - 2) - em1*upper(l, 1, i - 1)
               t = 1.0_dp/e0
               upper(l, 1, i) = (e1 - em1*upper(l, 2, i - 1))*t
               upper(l, 2, i) = e2*t
               change(l, i) = (d - em4*change(l, i - 4) - em3*change(l, i - 3) - em2*change(l, i - 2) &
                               - em1*change(l, i - 1))*t
            end do
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

! SPDX-License-Identifier: BSD-3-Clause
!> Hybrid line relaxation along X (Venner & Lubrecht 2000, ch. 6): lines of alternating colour
!> are solved for changes of pressure. Where the Poiseuille term matters, a change concerns its
!> own node (Gauss-Seidel). Where it is negligible, a change is a dipole: -1/4 of it goes to each
!> of the four neighbours, so that the deflection it causes stays local (distributive Jacobi).
!>
!> Two departures from the school, both measured (residual reduction of a W(2,1) cycle at 513 x 513
!> from 0.3-0.5 to 0.13-0.25 for 20 <= M <= 2000, 5 <= L <= 15):
!> a node is distributive only if the conductance is small at its neighbours too, for the dipole
!> reaches them; and the lines know how the conductance varies with pressure (Newton instead
!> of Picard), which is what holds at the pressure spike.
module ehl_relaxation
   use ehl_kinds, only: dp
   use ehl_level, only: band_lower, band_upper, level_t, line_width, near_reach
   !$ use omp_lib, only: omp_get_thread_num
   implicit none (type, external)
   private
   public :: relax

   integer, parameter :: nr = near_reach
   !> Largest conductance/mesh-size^2 of a distributive node's neighbourhood
   real(dp), parameter :: switch = 0.1_dp
   !> Under-relaxation of distributive changes, and of Gauss-Seidel changes where the wedge and
   !> the Poiseuille term compete; the latter tends to 1 where conductance/mesh-size^2 passes `strong`
   real(dp), parameter :: omega_dipole = 0.7_dp, omega_line = 0.5_dp, strong = 10.0_dp

contains

   !> One sweep. Needs film and coefficients of the present pressure; leaves them out of date.
   subroutine relax(level)
      type(level_t), intent(inout) :: level
      integer :: colour, block, first, last, blocks, me

      first = merge(1, 2, level%grid%mirror)
      last = level%grid%ny - 1
      do colour = 0, 1
         if (first + colour > last) cycle
         blocks = ((last - first - colour)/2 + line_width)/line_width
         !$omp parallel do default(none) shared(level, first, last, colour, blocks) private(me) &
         !$omp num_threads(level%threads) if(level%parallel) schedule(static)
         do block = 1, blocks
            me = 1
            !$ me = omp_get_thread_num() + 1
            call relax_lines(level, first + colour + 2*line_width*(block - 1), last, me)
         end do
         !$omp end parallel do
      end do
      call apply_dipoles(level, first, last)
   end subroutine relax

   !> Solve the lines j0, j0+2, ... (at most `line_width`, up to row `last`) side by side, so that
   !> the recursion along X vectorises across them
   subroutine relax_lines(level, j0, last, thread)
      type(level_t), intent(inout) :: level
      integer, intent(in) :: j0, last, thread
      integer :: lines

      lines = min(line_width, (last - j0)/2 + 1)
      associate (work => level%work(thread))
         call mark_dipoles(level, j0, lines, work%dipole)
         call assemble(level, j0, lines, work%dipole, work%a, work%d)
         call solve_bands(work%a, work%d, level%grid%nx)
         call change_pressure(level, j0, lines, work%dipole, work%d)
      end associate
   end subroutine relax_lines

   !> 1 where a node changes distributively, else 0
   pure subroutine mark_dipoles(level, j0, lines, dipole)
      type(level_t), intent(in) :: level
      integer, intent(in) :: j0, lines
      real(dp), intent(inout) :: dipole(:, 0:)
      real(dp) :: limit
      integer :: i, j, l, below

      limit = switch*min(level%grid%hx, level%grid%hy)**2
      do l = 1, lines
         j = j0 + 2*(l - 1)
         below = merge(2, j - 1, j == 1)
         do i = 2, level%grid%nx - 1
            dipole(l, i) = merge(1.0_dp, 0.0_dp, max(level%eps(i, j), level%eps(i - 1, j), level%eps(i + 1, j), &
                                                     level%eps(i, j + 1), level%eps(i, below)) < limit)
         end do
      end do
   end subroutine mark_dipoles

   !> Band matrices and right-hand sides; a(l, m, i) couples node i of line l to the change at node i + m
   subroutine assemble(level, j0, lines, dipole, a, d)
      type(level_t), intent(in) :: level
      integer, intent(in) :: j0, lines
      real(dp), intent(in) :: dipole(:, 0:)
      real(dp), intent(inout) :: a(:, -band_lower:, :), d(:, :)
      !> Response of rho H at nodes i, i-1, i-2 to a unit change at their columns -nr..nr
      real(dp) :: s(-nr:nr, 0:2)
      real(dp) :: east, west, north, south, rx, ry, c(0:2), r, pe, pw, pn, ps, q, row(-band_lower:band_upper)
      !> East and west couplings per eps, change of the Poiseuille term with eps, the term of other rows
      real(dp) :: re, rw, slope, other
      integer :: i, j, l, m, nx, below

      nx = level%grid%nx
      rx = 0.5_dp/level%grid%hx**2
      ry = 0.5_dp/level%grid%hy**2
      re = rx
      rw = rx
      do l = 1, lines
         j = j0 + 2*(l - 1)
         below = merge(2, j - 1, j == 1)
         s = 0.0_dp
         call respond(1)
         do i = 2, nx - 1
            s(:, 2) = s(:, 1)
            s(:, 1) = s(:, 0)
            call respond(i)
            c = merge(level%wedge_first, level%wedge, i == 2)
            associate (p => level%p, h => level%h, e => level%eps, rho => level%rho, gain => level%gain)
               pe = p(i + 1, j) - p(i, j)
               pw = p(i - 1, j) - p(i, j)
               if (level%galerkin) then
                  call other_rows(level, i, j, q, slope, other)
                  re = level%poiseuille%east(i, j)/level%cell(j)
                  rw = level%poiseuille%east(i - 1, j)/level%cell(j)
                  east = re*(e(i + 1, j) + e(i, j))
                  west = rw*(e(i - 1, j) + e(i, j))
                  q = q - (east + west)
                  slope = e(i, j)*gain(i, j)*(re*pe + rw*pw + slope)
                  r = level%rhs(i, j) - east*pe - west*pw - other &
                      + c(0)*rho(i, j)*h(i, j) + c(1)*rho(i - 1, j)*h(i - 1, j)
               else
                  east = rx*(e(i + 1, j) + e(i, j))
                  west = rx*(e(i - 1, j) + e(i, j))
                  north = ry*(e(i, j + 1) + e(i, j))
                  south = ry*(e(i, below) + e(i, j))
                  pn = p(i, j + 1) - p(i, j)
                  ps = p(i, below) - p(i, j)
                  q = -(east + west + north + south)
                  slope = e(i, j)*gain(i, j)*(rx*(pe + pw) + ry*(pn + ps))
                  r = level%rhs(i, j) - east*pe - west*pw - north*pn - south*ps &
                      + c(0)*rho(i, j)*h(i, j) + c(1)*rho(i - 1, j)*h(i - 1, j)
               end if
               if (i > 2) r = r + c(2)*rho(i - 2, j)*h(i - 2, j)
               if (p(i, j) <= 0.0_dp .and. r >= 0.0_dp) then
                  ! cavitated, and content to stay so
                  a(l, :, i) = 0.0_dp
                  a(l, 0, i) = 1.0_dp
                  d(l, i) = 0.0_dp
                  cycle
               end if
               row = 0.0_dp
               row(0) = q*(1.0_dp + 0.25_dp*dipole(l, i)) + (1.0_dp - dipole(l, i))*slope
               row(1) = east*(1.0_dp + dipole(l, i + 1)) &
                        + (1.0_dp - dipole(l, i + 1))*re*e(i + 1, j)*gain(i + 1, j)*pe
               row(-1) = west*(1.0_dp + dipole(l, i - 1)) &
                         + (1.0_dp - dipole(l, i - 1))*rw*e(i - 1, j)*gain(i - 1, j)*pw
               row(2) = -0.25_dp*east*dipole(l, i + 2)
               row(-2) = -0.25_dp*west*dipole(l, i - 2)
            end associate
            do m = -nr, nr
               row(m) = row(m) - c(0)*s(m, 0)
               row(m - 1) = row(m - 1) - c(1)*s(m, 1)
               row(m - 2) = row(m - 2) - c(2)*s(m, 2)
            end do
            a(l, :, i) = row
            d(l, i) = r
         end do
      end do

   contains

      !> s(:, 0) = response of rho H at node ii
      subroutine respond(ii)
         integer, intent(in) :: ii
         real(dp) :: t
         integer :: k

         do k = -nr, nr
            t = dipole(l, max(ii + k, 0))
            s(k, 0) = level%rho(ii, j)*(level%near(k) + t*(level%near_dipole(k) - level%near(k)))
         end do
         s(0, 0) = s(0, 0) + level%stiffness(ii, j)
         s(-1, 0) = s(-1, 0) - 0.25_dp*dipole(l, ii - 1)*level%stiffness(ii, j)
         s(1, 0) = s(1, 0) - 0.25_dp*dipole(l, ii + 1)*level%stiffness(ii, j)
      end subroutine respond
   end subroutine assemble

   !> Galerkin operator at node (i, j), the couplings to its own row apart: the sum of the couplings and the
   !> excess, with a minus; the change of the term with eps at the node; the term itself
   subroutine other_rows(level, i, j, q, slope, term)
      type(level_t), intent(in) :: level
      integer, intent(in) :: i, j
      real(dp), intent(out) :: q, slope, term
      real(dp) :: inverse

      inverse = 1.0_dp/level%cell(j)
      q = -level%poiseuille%excess(i, j)*level%eps(i, j)*inverse
      slope = -level%poiseuille%excess(i, j)*level%p(i, j)*inverse
      term = q*level%p(i, j)
      associate (a => level%poiseuille)
         call add(a%north_west(i, j), i - 1, j + 1)
         call add(a%north(i, j), i, j + 1)
         call add(a%north_east(i, j), i + 1, j + 1)
         if (j == 1) return
         call add(a%north_east(i - 1, j - 1), i - 1, j - 1)
         call add(a%north(i, j - 1), i, j - 1)
         call add(a%north_west(i + 1, j - 1), i + 1, j - 1)
      end associate

   contains

      subroutine add(o, ii, jj)
         real(dp), intent(in) :: o
         integer, intent(in) :: ii, jj
         real(dp) :: t

         t = inverse*o*(level%eps(ii, jj) + level%eps(i, j))
         q = q - t
         slope = slope + inverse*o*(level%p(ii, jj) - level%p(i, j))
         term = term + t*(level%p(ii, jj) - level%p(i, j))
      end subroutine add
   end subroutine other_rows

   !> Band elimination without pivoting and back substitution, all lines side by side; the
   !> solution replaces d
   pure subroutine solve_bands(a, d, nx)
      integer, intent(in) :: nx
      real(dp), intent(inout) :: a(line_width, -band_lower:band_upper, nx + band_lower), d(line_width, nx + band_lower)
      real(dp) :: t(line_width)
      integer :: i, k

      do i = 2, nx - 1
         do k = 1, min(band_lower, nx - 1 - i)
            t = a(:, -k, i + k)/a(:, 0, i)
            a(:, 1 - k, i + k) = a(:, 1 - k, i + k) - t*a(:, 1, i)
            a(:, 2 - k, i + k) = a(:, 2 - k, i + k) - t*a(:, 2, i)
            d(:, i + k) = d(:, i + k) - t*d(:, i)
         end do
      end do
      d(:, nx:nx + 1) = 0.0_dp
      do i = nx - 1, 2, -1
         d(:, i) = (d(:, i) - a(:, 1, i)*d(:, i + 1) - a(:, 2, i)*d(:, i + 2))/a(:, 0, i)
      end do
   end subroutine solve_bands

   !> Apply Gauss-Seidel changes at once, keep distributive ones for the end of the sweep
   pure subroutine change_pressure(level, j0, lines, dipole, d)
      type(level_t), intent(inout) :: level
      integer, intent(in) :: j0, lines
      real(dp), intent(in) :: dipole(:, 0:), d(:, :)
      real(dp) :: t, scale
      integer :: i, j, l

      scale = 1.0_dp/(strong*min(level%grid%hx, level%grid%hy)**2)
      do l = 1, lines
         j = j0 + 2*(l - 1)
         do i = 2, level%grid%nx - 1
            t = level%eps(i, j)*scale
            level%change(i, j) = omega_dipole*dipole(l, i)*d(l, i)
            level%p(i, j) = max(0.0_dp, level%p(i, j) + (1.0_dp - dipole(l, i))*(omega_line + t)/(1.0_dp + t)*d(l, i))
         end do
      end do
   end subroutine change_pressure

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

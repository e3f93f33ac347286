! SPDX-License-Identifier: BSD-3-Clause
!> Flow factors (flow_factors.f90) of several nodes at once by the cheapest sufficient formula: 1 if those of all nodes differ
!> from 1 by less than `negligible`, else for each node second order in the gradient if its error is below `tolerance`, or
!> integrals through the film. The latter start from the mean stress of second order; Newton steps correct it, and a first-order
!> correction of the factors for the remaining residual leaves an error of the square of that residual. If the error is too large,
!> flow_factors.f90 iterates.
module ehl_factor_rows
   use ehl_flow_factors, only: exact_factors, factors_t, half, min_gradient, upper, weight
   use ehl_kinds, only: dp
   use ehl_thinning, only: eyring, max_nodes, slopes, thinning_t
   implicit none (type, external)
   private
   public :: factor_rows_t, find_factors, flows_newtonian, second_order

   !> If all factors differ from 1 by less than this they are set to 1; maximum relative error of second-order factors
   real(dp), parameter :: negligible = 1.0e-6_dp, tolerance = 1.0e-4_dp
   !> Number of evaluations of the integrals before the iteration; relative error of B whose square is negligible
   integer, parameter :: passes = 3
   real(dp), parameter :: enough = 1.0e-3_dp
   !> The divided difference of F between two squared stresses closer than this is replaced by the mean of its derivatives
   real(dp), parameter :: close = 1.0e-4_dp

   !> factors_t (flow_factors.f90) by node
   type :: factor_rows_t
      real(dp), dimension(max_nodes, 2) :: phi, by_sliding, by_gradient, tangent, stress_by_gradient
      real(dp), dimension(max_nodes) :: stress, stress_by_sliding
      !> Relative error of second-order factors, and an estimate of the mean stress through the film
      real(dp) :: error(max_nodes), near(max_nodes, 2)
   end type factor_rows_t

   !> Integrals through the film for a mean stress: J0, J2, K, A, C and D as xx, xy, yy, and the residual of B
   type :: film_t
      real(dp), dimension(max_nodes) :: j0, j2, k
      real(dp), dimension(max_nodes, 3) :: a, c, d
      real(dp) :: off(max_nodes, 2)
   end type film_t

contains

   !> Factors of size(b) nodes
   pure subroutine find_factors(law, b, s, rows)
      type(thinning_t), intent(in) :: law
      !> B >= 0, and S along X and along Y of as many nodes, or more, shape (nodes, 2)
      real(dp), contiguous, intent(in) :: b(:), s(:, :)
      type(factor_rows_t), intent(inout) :: rows
      integer :: list(max_nodes), count, i

      if (flows_newtonian(law, b, s)) then
         rows%phi = 1.0_dp
         rows%tangent = 1.0_dp
         rows%by_sliding = 0.0_dp
         rows%by_gradient = 0.0_dp
         rows%stress(:size(b)) = b
         rows%stress_by_sliding = 1.0_dp
         rows%stress_by_gradient = 0.0_dp
         return
      end if
      call second_order(law, b, s, rows)
      count = 0
      do i = 1, size(b)
         if (rows%error(i) > tolerance) then
            count = count + 1
            list(count) = i
         end if
      end do
      if (count > 0) call through_film(law, b, s, list(:count), rows)
   end subroutine find_factors

   !> Whether the factors of size(b) nodes all differ from 1 by less than `negligible`
   pure logical function flows_newtonian(law, b, s)
      type(thinning_t), intent(in) :: law
      !> As in `find_factors`
      real(dp), contiguous, intent(in) :: b(:), s(:, :)
      real(dp) :: coefficient

      coefficient = 0.15_dp*law%curvature()
      flows_newtonian = .not. any(coefficient*(20.0_dp*b**2 + s(:size(b), 1)**2 + s(:size(b), 2)**2) >= negligible)
   end function flows_newtonian

   !> Factors at a small gradient: to second order in S, their derivative with respect to the sliding to zeroth order
   pure subroutine second_order(law, b, s, rows)
      type(thinning_t), intent(in) :: law
      real(dp), contiguous, intent(in) :: b(:), s(:, :)
      type(factor_rows_t), intent(inout) :: rows
      !> Stress t in sliding alone; F and its derivatives with respect to tau^2 there
      real(dp) :: t(max_nodes), f(max_nodes, 0:slopes)
      !> t^2, S^2; 3 f1 + 2 f2 t^2; tau_mx/t - 1, and phi minus its value by sliding alone, each over the squares of S
      real(dp) :: q, sx, sy, g, less_x, less_y, xx, xy, yx, yy, phi_x, phi_y, error, is_eyring
      integer :: i

      call law%slide(b, t(:size(b)), f)
      error = law%second_order_error()
      is_eyring = merge(1.0_dp, 0.0_dp, law%law == eyring)
      do i = 1, size(b)
         q = t(i)**2
         sx = s(i, 1)**2
         sy = s(i, 2)**2
         g = 3.0_dp*f(i, 1) + 2.0_dp*f(i, 2)*q
         rows%error(i) = error*((sx + sy)/(1.0_dp + (1.0_dp - is_eyring)*q))**2
         phi_x = f(i, 0) + 2.0_dp*f(i, 1)*q
         phi_y = f(i, 0)
         rows%stress_by_sliding(i) = 1.0_dp/phi_x
         rows%by_sliding(i, 1) = 2.0_dp*q*g*phi_y/phi_x**2
         rows%by_sliding(i, 2) = 2.0_dp*q*f(i, 1)/phi_x
         less_x = -g/(12.0_dp*phi_x)
         less_y = -f(i, 1)/(12.0_dp*phi_x)
         xx = 2.0_dp*q*less_x*g + 0.15_dp*(f(i, 1) + 2.0_dp*f(i, 2)*q) + q*(0.3_dp*f(i, 2) + 0.2_dp*f(i, 3)*q)
         xy = 2.0_dp*q*less_y*g + 0.15_dp*f(i, 1) + q*(0.3_dp*f(i, 2) - f(i, 1)**2/(3.0_dp*phi_y))
         yx = 2.0_dp*q*less_x*f(i, 1) + 0.15_dp*(f(i, 1) + 2.0_dp*f(i, 2)*q) - f(i, 1)**2*q/(3.0_dp*phi_y)
         yy = 2.0_dp*q*less_y*f(i, 1) + 0.15_dp*f(i, 1)
         rows%stress(i) = t(i)*(1.0_dp + (less_x*sx + less_y*sy))
         rows%stress_by_gradient(i, 1) = 2.0_dp*t(i)*less_x*s(i, 1)
         rows%stress_by_gradient(i, 2) = 2.0_dp*t(i)*less_y*s(i, 2)
         ! positive for any S
         rows%near(i, 1) = t(i)/(1.0_dp - (less_x*sx + less_y*sy))
         rows%near(i, 2) = -s(i, 2)*f(i, 1)/(6.0_dp*phi_y)*rows%near(i, 1)*s(i, 1)
         rows%tangent(i, 1) = phi_x + 3.0_dp*xx*sx + xy*sy
         rows%tangent(i, 2) = phi_y + yx*sx + 3.0_dp*yy*sy
         rows%phi(i, 1) = phi_x + (xx*sx + xy*sy)
         rows%phi(i, 2) = phi_y + (yx*sx + yy*sy)
         rows%by_gradient(i, 1) = 2.0_dp*(xx*sx + xy*sy)/rows%phi(i, 1)
         rows%by_gradient(i, 2) = 2.0_dp*(yx*sx + yy*sy)/rows%phi(i, 2)
      end do
   end subroutine second_order

   !> Factors of the nodes of a list, by integrals through the film
   pure subroutine through_film(law, b, s, list, rows)
      type(thinning_t), intent(in) :: law
      real(dp), contiguous, intent(in) :: b(:), s(:, :)
      integer, contiguous, intent(in) :: list(:)
      type(factor_rows_t), intent(inout) :: rows
      type(film_t) :: film
      type(factor_rows_t) :: new
      !> B, S and mean stress of the nodes that have not converged
      real(dp) :: bb(max_nodes), ss(max_nodes, 2), mean(max_nodes, 2)
      integer :: nodes(max_nodes), pass, n, i, k

      n = size(list)
      nodes(:n) = list
      bb(:n) = b(list)
      ss(:n, :) = sign(max(abs(s(list, :)), min_gradient), s(list, :))
      mean(:n, :) = rows%near(list, :)
      do pass = 1, passes
         call integrate(law, bb(:n), ss, mean, film)
         call evaluate(bb(:n), ss, mean, film, new)
         k = 0
         do i = 1, n
            if (all(abs(film%off(i, :)) <= enough*bb(i))) then
               call take(rows, nodes(i), new, i)
            else
               k = k + 1
               nodes(k) = nodes(i)
               bb(k) = bb(i)
               ss(k, :) = ss(i, :)
               mean(k, :) = new%near(i, :)
            end if
         end do
         n = k
         if (n == 0) return
      end do
      do i = 1, n
         call put(rows, nodes(i), exact_factors(law, b(nodes(i)), s(nodes(i), :)))
      end do
   end subroutine through_film

   !> Copy the factors of another node to node `to`
   pure subroutine take(rows, to, new, from)
      type(factor_rows_t), intent(inout) :: rows
      type(factor_rows_t), intent(in) :: new
      integer, intent(in) :: to, from

      rows%phi(to, :) = new%phi(from, :)
      rows%by_sliding(to, :) = new%by_sliding(from, :)
      rows%by_gradient(to, :) = new%by_gradient(from, :)
      rows%tangent(to, :) = new%tangent(from, :)
      rows%stress(to) = new%stress(from)
      rows%stress_by_sliding(to) = new%stress_by_sliding(from)
      rows%stress_by_gradient(to, :) = new%stress_by_gradient(from, :)
   end subroutine take

   !> Set the factors of node i
   pure subroutine put(rows, i, factors)
      type(factor_rows_t), intent(inout) :: rows
      integer, intent(in) :: i
      type(factors_t), intent(in) :: factors

      rows%phi(i, :) = factors%phi
      rows%by_sliding(i, :) = factors%by_sliding
      rows%by_gradient(i, :) = factors%by_gradient
      rows%tangent(i, :) = factors%tangent
      rows%stress(i) = factors%stress
      rows%stress_by_sliding(i) = factors%stress_by_sliding
      rows%stress_by_gradient(i, :) = factors%stress_by_gradient
   end subroutine put

   !> Integrals through the film
   pure subroutine integrate(law, b, s, mean, film)
      type(thinning_t), intent(in) :: law
      real(dp), contiguous, intent(in) :: b(:), s(:, :), mean(:, :)
      type(film_t), intent(inout) :: film
      real(dp), dimension(max_nodes) :: up, down, flat, f_up, f_down, slope_up, slope_down
      real(dp) :: w, z, along, both, tx, ty, difference, wu, wd, middle
      integer :: i, k, n

      n = size(b)
      film%j0 = 0.0_dp
      film%j2 = 0.0_dp
      film%k = 0.0_dp
      film%a = 0.0_dp
      film%c = 0.0_dp
      film%d = 0.0_dp
      do k = 1, half
         w = weight(k)
         z = upper(k)
         do i = 1, size(b)
            up(i) = (mean(i, 1) + z*s(i, 1))**2 + (mean(i, 2) + z*s(i, 2))**2
            down(i) = (mean(i, 1) - z*s(i, 1))**2 + (mean(i, 2) - z*s(i, 2))**2
         end do
         flat(:n) = merge(1.0_dp, 0.0_dp, abs(up(:n) - down(:n)) <= close*(up(:n) + down(:n)))
         call law%thinness(up(:n), f_up(:n), slope_up(:n))
         call law%thinness(down(:n), f_down(:n), slope_down(:n))
         do i = 1, size(b)
            both = w*(f_up(i) + f_down(i))
            ! divided difference of F in tau^2 between the two points
            along = 4.0_dp*z*(mean(i, 1)*s(i, 1) + mean(i, 2)*s(i, 2))
            middle = 0.25_dp*(slope_up(i) + slope_down(i))
            difference = (flat(i)*middle + (1.0_dp - flat(i))*(f_up(i) - f_down(i)))/(flat(i) + (1.0_dp - flat(i))*along)
            film%j0(i) = film%j0(i) + both
            film%j2(i) = film%j2(i) + z**2*both
            film%k(i) = film%k(i) + 4.0_dp*w*z**2*difference
            wu = w*slope_up(i)
            wd = w*slope_down(i)
            tx = mean(i, 1) + z*s(i, 1)
            ty = mean(i, 2) + z*s(i, 2)
            film%a(i, 1) = film%a(i, 1) + wu*tx**2
            film%a(i, 2) = film%a(i, 2) + wu*tx*ty
            film%a(i, 3) = film%a(i, 3) + wu*ty**2
            film%c(i, 1) = film%c(i, 1) + z*(wu*tx**2 + w*(f_up(i) - f_down(i)))
            film%c(i, 2) = film%c(i, 2) + z*wu*tx*ty
            film%c(i, 3) = film%c(i, 3) + z*(wu*ty**2 + w*(f_up(i) - f_down(i)))
            film%d(i, 1) = film%d(i, 1) + z**2*wu*tx**2
            film%d(i, 2) = film%d(i, 2) + z**2*wu*tx*ty
            film%d(i, 3) = film%d(i, 3) + z**2*wu*ty**2
            tx = mean(i, 1) - z*s(i, 1)
            ty = mean(i, 2) - z*s(i, 2)
            film%a(i, 1) = film%a(i, 1) + wd*tx**2
            film%a(i, 2) = film%a(i, 2) + wd*tx*ty
            film%a(i, 3) = film%a(i, 3) + wd*ty**2
            film%c(i, 1) = film%c(i, 1) - z*wd*tx**2
            film%c(i, 2) = film%c(i, 2) - z*wd*tx*ty
            film%c(i, 3) = film%c(i, 3) - z*wd*ty**2
            film%d(i, 1) = film%d(i, 1) + z**2*wd*tx**2
            film%d(i, 2) = film%d(i, 2) + z**2*wd*tx*ty
            film%d(i, 3) = film%d(i, 3) + z**2*wd*ty**2
         end do
      end do
      do i = 1, size(b)
         film%a(i, 1) = film%a(i, 1) + film%j0(i)
         film%a(i, 3) = film%a(i, 3) + film%j0(i)
         film%d(i, 1) = film%d(i, 1) + film%j2(i)
         film%d(i, 3) = film%d(i, 3) + film%j2(i)
         along = film%k(i)*(mean(i, 1)*s(i, 1) + mean(i, 2)*s(i, 2))
         film%off(i, 1) = b(i) - mean(i, 1)*film%j0(i) - s(i, 1)*along
         film%off(i, 2) = -mean(i, 2)*film%j0(i) - s(i, 2)*along
      end do
   end subroutine integrate

   !> Factors and their derivatives, corrected to first order for the residual of B
   pure subroutine evaluate(b, s, mean, film, rows)
      real(dp), contiguous, intent(in) :: b(:), s(:, :), mean(:, :)
      type(film_t), intent(in) :: film
      type(factor_rows_t), intent(inout) :: rows
      !> Change of the mean stress (dx, dy); its derivative with respect to B (bx, by); A^-1 C (xx to yy)
      real(dp) :: q, pivot, dx, dy, bx, by, xx, xy, yx, yy, moment, m1, m2, m3
      integer :: i

      do i = 1, size(b)
         ! by elimination, because the determinant of A may overflow
         q = film%a(i, 2)/film%a(i, 1)
         pivot = 1.0_dp/(film%a(i, 3) - q*film%a(i, 2))
         dy = (film%off(i, 2) - q*film%off(i, 1))*pivot
         dx = (film%off(i, 1) - film%a(i, 2)*dy)/film%a(i, 1)
         by = -q*pivot
         bx = (1.0_dp - film%a(i, 2)*by)/film%a(i, 1)
         yx = (film%c(i, 2) - q*film%c(i, 1))*pivot
         xx = (film%c(i, 1) - film%a(i, 2)*yx)/film%a(i, 1)
         yy = (film%c(i, 3) - q*film%c(i, 2))*pivot
         xy = (film%c(i, 2) - film%a(i, 2)*yy)/film%a(i, 1)
         m1 = film%d(i, 1) - film%c(i, 1)*xx - film%c(i, 2)*yx
         m2 = film%d(i, 2) - film%c(i, 1)*xy - film%c(i, 2)*yy
         m3 = film%d(i, 3) - film%c(i, 2)*xy - film%c(i, 3)*yy
         moment = film%k(i)*(mean(i, 1)*s(i, 1) + mean(i, 2)*s(i, 2))
         rows%phi(i, 1) = 12.0_dp*(film%j2(i) + (mean(i, 1)*moment + film%c(i, 1)*dx + film%c(i, 2)*dy)/s(i, 1))
         rows%phi(i, 2) = 12.0_dp*(film%j2(i) + (mean(i, 2)*moment + film%c(i, 2)*dx + film%c(i, 3)*dy)/s(i, 2))
         rows%stress(i) = mean(i, 1) + dx
         rows%near(i, 1) = mean(i, 1) + dx
         rows%near(i, 2) = mean(i, 2) + dy
         rows%stress_by_sliding(i) = bx
         rows%stress_by_gradient(i, 1) = -xx
         rows%stress_by_gradient(i, 2) = -xy
         rows%tangent(i, 1) = 12.0_dp*m1
         rows%tangent(i, 2) = 12.0_dp*m3
         rows%by_sliding(i, 1) = 12.0_dp*b(i)*(film%c(i, 1)*bx + film%c(i, 2)*by)/(rows%phi(i, 1)*s(i, 1))
         rows%by_sliding(i, 2) = 12.0_dp*b(i)*(film%c(i, 2)*bx + film%c(i, 3)*by)/(rows%phi(i, 2)*s(i, 2))
         rows%by_gradient(i, 1) = 12.0_dp*(m1 + m2*s(i, 2)/s(i, 1))/rows%phi(i, 1) - 1.0_dp
         rows%by_gradient(i, 2) = 12.0_dp*(m3 + m2*s(i, 1)/s(i, 2))/rows%phi(i, 2) - 1.0_dp
      end do
   end subroutine evaluate
end module ehl_factor_rows

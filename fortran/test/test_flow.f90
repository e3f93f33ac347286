! SPDX-License-Identifier: BSD-3-Clause
!> Flow factors of shear-thinning lubricants: values by quadrature (docs/theory/thinning.md), closed forms, limits, and
!> derivatives compared with differences
module test_flow
   use check, only: is_close, is_true
   use ehl_factor_rows, only: factor_rows_t, find_factors, second_order
   use ehl_flow_factors, only: exact_factors, factors_t
   use ehl_cached_factors, only: cached_factors_t
   use ehl_grid, only: grid_t
   use ehl_kinds, only: dp
   use ehl_lubricant, only: density_constant, lubricant_t, new_lubricant, viscosity_barus
   use ehl_shear_thinning_flow, only: new_shear_thinning_flow, shear_thinning_flow_t
   use ehl_status, only: status_t
   use ehl_thinning, only: carreau, eyring, max_nodes, thinning_t
   implicit none (type, external)
   private
   public :: run_flow

   type(thinning_t), parameter :: by_eyring = thinning_t(eyring, 1.0_dp), by_carreau = thinning_t(carreau, 0.5_dp)

contains

   subroutine run_flow()
      call values()
      call closed_forms()
      call limits()
      call of_second_order()
      call side_by_side()
      call cached()
      call sliding_to_zero()
      call changes_against_differences()
   end subroutine run_flow

   !> phi_x, phi_y and the mean stress by quadrature (tests/model/test_thinning.py)
   subroutine values()
      call agree(by_eyring, 0.0_dp, [5.0_dp, 3.0_dp], [2.15284_dp, 2.15284_dp, 0.0_dp])
      call agree(by_eyring, 1.0_dp, [2.0_dp, 2.0_dp], [1.53059_dp, 1.31352_dp, 0.743382_dp])
      call agree(by_eyring, 100.0_dp, [1.0_dp, 1.0_dp], [97.7339_dp, 18.3347_dp, 5.25087_dp])
      call agree(by_eyring, 1.0e5_dp, [3.0_dp, 1.0_dp], [87420.0_dp, 5744.4_dp, 11.8536_dp])
      call agree(by_carreau, 2.0_dp, [5.0_dp, 5.0_dp], [3.06463_dp, 2.8926_dp, 0.712669_dp])
      call agree(by_carreau, 50.0_dp, [3.0_dp, 1.0_dp], [13.9482_dp, 6.96058_dp, 6.97932_dp])
   end subroutine values

   !> Second-order factors of one node, and their maximum relative error
   function sliding_factors(law, b, s, error) result(r)
      type(thinning_t), intent(in) :: law
      real(dp), intent(in) :: b, s(2)
      real(dp), intent(out), optional :: error
      type(factors_t) :: r
      type(factor_rows_t) :: rows

      call second_order(law, [b], reshape(s, [1, 2]), rows)
      r = of_node(rows, 1)
      if (present(error)) error = rows%error(1)
   end function sliding_factors

   pure function of_node(rows, i) result(r)
      type(factor_rows_t), intent(in) :: rows
      integer, intent(in) :: i
      type(factors_t) :: r

      r = factors_t(rows%phi(i, :), rows%by_sliding(i, :), rows%by_gradient(i, :), rows%tangent(i, :), rows%stress(i), &
                    rows%stress_by_sliding(i), rows%stress_by_gradient(i, :))
   end function of_node

   !> The factors of several nodes at once, each by the formula that suffices, agree with integrals through the film
   subroutine side_by_side()
      type(thinning_t), parameter :: laws(5) = [thinning_t(eyring, 1.0_dp), thinning_t(carreau, 0.1_dp), &
                                                thinning_t(carreau, 0.3_dp), thinning_t(carreau, 0.5_dp), &
                                                thinning_t(carreau, 0.8_dp)]
      type(factor_rows_t) :: rows
      type(factors_t) :: exact, fast
      real(dp) :: b(max_nodes), s(max_nodes, 2), phase, worst(3)
      integer :: i, k, l

      do l = 1, size(laws)
         worst = 0.0_dp
         do k = 1, 40
            do i = 1, max_nodes
               phase = real(i + max_nodes*k, dp)
               b(i) = 10.0_dp**(4.0_dp + 8.0_dp*sin(1.7_dp*phase))
               if (mod(i, 7) == 0) b(i) = 0.0_dp
               s(i, :) = 10.0_dp**(2.0_dp*sin(2.3_dp*phase))*[cos(phase), sin(phase)]
            end do
            call find_factors(laws(l), b(:max_nodes - k), s, rows)
            do i = 1, max_nodes - k
               exact = exact_factors(laws(l), b(i), s(i, :))
               fast = of_node(rows, i)
               worst(1) = max(worst(1), maxval(abs(fast%phi/exact%phi - 1.0_dp)))
               worst(2) = max(worst(2), abs(fast%stress - exact%stress)/max(exact%stress, 1.0e-6_dp))
               worst(3) = max(worst(3), maxval(abs(fast%tangent/exact%tangent - 1.0_dp)), &
                              maxval(abs(fast%by_sliding - exact%by_sliding)), maxval(abs(fast%by_gradient - exact%by_gradient)))
            end do
         end do
         call is_close(worst(1), 0.0_dp, 1.0e-4_dp, "flow factors side by side")
         call is_close(worst(2), 0.0_dp, 1.0e-4_dp, "mean stress side by side")
         call is_close(worst(3), 0.0_dp, 3.0e-2_dp, "changes side by side")
      end do
   end subroutine side_by_side

   !> Cached factors are extrapolated for small changes; for larger changes, and after `forget`, they are computed again
   subroutine cached()
      type(thinning_t), parameter :: laws(4) = [thinning_t(eyring, 1.0_dp), thinning_t(carreau, 0.3_dp), &
                                                thinning_t(carreau, 0.5_dp), thinning_t(carreau, 0.8_dp)]
      integer, parameter :: nodes = 2*max_nodes + 1
      type(cached_factors_t) :: store
      type(factor_rows_t) :: rows, anew
      type(factors_t) :: exact
      real(dp) :: b(nodes), s(nodes, 2), stress(nodes), by_sliding(nodes), phase, share, reach, worst(4)
      integer :: i, k, l, stat
      logical :: newtonian

      do l = 1, size(laws)
         worst = 0.0_dp
         store = cached_factors_t(laws(l))
         call store%setup(nodes, 1, stat)
         call is_true(stat == 0 .and. store%width == 43, "blocks of equal width")
         share = merge(0.0_dp, 1.0_dp, laws(l)%law == eyring)
         reach = 0.00999_dp/max(1.0_dp, store%law%curvature()/0.15_dp)
         do k = 1, 40
            do i = 1, store%width
               phase = real(i + max_nodes*k, dp)
               b(i) = 10.0_dp**(4.0_dp + 8.0_dp*sin(1.7_dp*phase))
               s(i, :) = 10.0_dp**(1.5_dp*sin(2.3_dp*phase))*[cos(phase), sin(phase)]
            end do
            associate (n => store%width)
               call store%find(b(:n), s, 2, 1, rows, newtonian)
               call find_factors(laws(l), b(:n), s, anew)
               call is_close(maxval(abs(rows%phi(:n, :)/anew%phi(:n, :) - 1.0_dp)), 0.0_dp, 0.0_dp, "beyond reach: computed again")
               do i = 1, n
                  phase = real(i*k, dp)
                  b(i) = b(i)*(1.0_dp + reach*sign(1.0_dp, sin(phase)))
                  s(i, :) = s(i, :) + reach*sign(1.0_dp + share*sum(abs(s(i, :))), [sin(2.0_dp*phase), sin(3.0_dp*phase)])
               end do
               call store%find(b(:n), s, 2, 1, rows, newtonian)
               call store%stress(b(:n), s, 2, 1, stress, by_sliding)
               do i = 1, n
                  exact = exact_factors(laws(l), b(i), s(i, :))
                  worst(1) = max(worst(1), maxval(abs(rows%phi(i, :)/exact%phi - 1.0_dp)))
                  worst(2) = max(worst(2), abs(stress(i) - exact%stress)/max(exact%stress, 1.0e-2_dp))
               end do
               call find_factors(laws(l), b(:n), s, anew)
               worst(3) = max(worst(3), maxval(abs(rows%phi(:n, :)/anew%phi(:n, :) - 1.0_dp)))
               store%correcting = .true.
               do i = 1, n
                  phase = real(i*k, dp)
                  b(i) = b(i)*(1.0_dp + 3.9_dp*reach*sign(1.0_dp, sin(phase)))
                  s(i, :) = s(i, :) + 3.9_dp*reach*sign(1.0_dp + share*sum(abs(s(i, :))), [sin(2.0_dp*phase), sin(3.0_dp*phase)])
               end do
               call store%find(b(:n), s, 2, 1, rows, newtonian)
               store%correcting = .false.
               call find_factors(laws(l), b(:n), s, anew)
               worst(4) = max(worst(4), maxval(abs(rows%phi(:n, :)/anew%phi(:n, :) - 1.0_dp)))
               if (modulo(k, 2) == 0) cycle
               call store%forget()
               call store%find(b(:n), s, 2, 1, rows, newtonian)
               call is_close(maxval(abs(rows%phi(:n, :)/anew%phi(:n, :) - 1.0_dp)), 0.0_dp, 0.0_dp, "forgotten: computed again")
            end associate
         end do
         call is_close(worst(1), 0.0_dp, 2.0e-4_dp, "extrapolated factors")
         call is_close(worst(2), 0.0_dp, 2.0e-4_dp, "extrapolated stress")
         call is_true(worst(3) > 1.0e-6_dp, "they are not computed again")
         call is_close(worst(4), 0.0_dp, 5.0e-3_dp, "factors of a correction")
         call is_true(worst(4) > worst(3), "they are extrapolated for larger changes")
      end do
   end subroutine cached

   !> The flow of a duty whose sliding becomes zero and returns is that of a contact with this sliding
   subroutine sliding_to_zero()
      real(dp), parameter :: sliding(5) = [1.0e-3_dp, 0.0_dp, 0.0_dp, 1.0e-4_dp, 0.0_dp]
      integer, parameter :: nx = 17, ny = 5
      type(shear_thinning_flow_t) :: flow, anew
      type(lubricant_t) :: lubricant
      type(grid_t) :: grid
      type(status_t) :: status
      real(dp), dimension(nx) :: h, rho, drho_dp, newtonian, stress, wanted
      real(dp) :: p(nx, ny), conductance(nx, 2)
      integer :: i, j, k

      grid = grid_t(nx=nx, ny=ny, x0=0.0_dp, y0=0.0_dp, hx=0.1_dp, hy=0.1_dp)
      lubricant = new_lubricant(viscosity_barus, density_constant, 0.0_dp, 0.0_dp, 0.0_dp, 1.0_dp)
      h = 1.0_dp
      rho = 1.0_dp
      drho_dp = 0.0_dp
      flow = new_shear_thinning_flow(by_eyring, sliding(1), 1.0_dp)
      call flow%setup(grid, status)
      do k = 1, size(sliding)
         ! S changes by less than the reach of the extrapolation
         do i = 1, nx
            do j = 1, ny
               p(i, j) = (4.0_dp + 2.0e-3_dp*k)*grid%x(i) + grid%y(j)
            end do
         end do
         anew = new_shear_thinning_flow(by_eyring, sliding(k), 1.0_dp)
         call anew%setup(grid, status)
         anew%inverse_speed = 1.0_dp
         call flow%rescale(1.0_dp, sliding(k))
         call flow%find_row(lubricant, p, h, rho, drho_dp, 3, nx)
         conductance = flow%eps(:, 3, :)
         call flow%stress_row(lubricant, p, h, rho, 3, newtonian, stress)
         call anew%find_row(lubricant, p, h, rho, drho_dp, 3, nx)
         call anew%stress_row(lubricant, p, h, rho, 3, newtonian, wanted)
         call is_close(maxval(abs(conductance/anew%eps(:, 3, :) - 1.0_dp)), 0.0_dp, 0.0_dp, "conductance after a change of sliding")
         call is_close(maxval(abs(stress/wanted - 1.0_dp)), 0.0_dp, 0.0_dp, "stress after a change of sliding")
      end do
   end subroutine sliding_to_zero

   subroutine agree(law, b, s, wanted)
      type(thinning_t), intent(in) :: law
      real(dp), intent(in) :: b, s(2), wanted(3)
      type(factors_t) :: r

      r = exact_factors(law, b, s)
      call is_close(r%phi(1)/wanted(1), 1.0_dp, 1.0e-5_dp, "phi_x by quadrature")
      call is_close(r%phi(2)/wanted(2), 1.0_dp, 1.0e-5_dp, "phi_y by quadrature")
      call is_close(r%stress, wanted(3), 1.0e-5_dp*max(1.0_dp, wanted(3)), "mean stress by quadrature")
   end subroutine agree

   !> One direction, Eyring: int sinh(t + xi S) dxi and int xi sinh(t + xi S) dxi by hand
   subroutine closed_forms()
      real(dp), parameter :: b(4) = [0.0_dp, 1.0_dp, 1.0e3_dp, 1.0e12_dp], s(3) = [0.2_dp, 2.0_dp, 5.0_dp]
      type(factors_t) :: r
      real(dp) :: h, stress, phi
      integer :: i, k

      do k = 1, size(s)
         h = 0.5_dp*s(k)
         do i = 1, size(b)
            stress = asinh(b(i)*h/sinh(h))
            ! six points: the error increases with S
            phi = 3.0_dp*(h*cosh(h) - sinh(h))/h**3*cosh(stress)
            r = exact_factors(by_eyring, b(i), [s(k), 0.0_dp])
            call is_close(r%stress, stress, 1.0e-7_dp, "mean stress, Eyring, one direction")
            call is_close(r%phi(1)/phi, 1.0_dp, 3.0e-7_dp, "flow factor, Eyring, one direction")
         end do
      end do
      ! Newtonian: n = 1
      r = exact_factors(thinning_t(carreau, 1.0_dp), 7.0_dp, [3.0_dp, 4.0_dp])
      call is_close(maxval(abs(r%phi - 1.0_dp)), 0.0_dp, 1.0e-12_dp, "n = 1 is Newtonian")
      call is_close(maxval(abs([r%by_sliding, r%by_gradient, r%tangent - 1.0_dp])), 0.0_dp, 1.0e-10_dp, "and does not change")
      call is_close(r%stress, 7.0_dp, 1.0e-10_dp, "nor is its stress less")
   end subroutine closed_forms

   !> At a small gradient the factors are those of sliding alone; nothing overflows for any input, and factors are at least 1
   subroutine limits()
      real(dp), parameter :: b(6) = [0.0_dp, 1.0e-6_dp, 0.3_dp, 20.0_dp, 1.0e6_dp, 1.0e12_dp]
      real(dp), parameter :: s(5) = [0.0_dp, 1.0e-9_dp, 1.0_dp, 30.0_dp, 300.0_dp]
      type(thinning_t) :: law
      type(factors_t) :: exact, sliding
      integer :: i, k, l, m

      do l = 1, 2
         law = merge(by_eyring, by_carreau, l == 1)
         do i = 1, size(b)
            sliding = sliding_factors(law, b(i), [0.0_dp, 0.0_dp])
            call is_close(sliding%stress_by_sliding*sliding%phi(1), 1.0_dp, 1.0e-12_dp, "phi_x is dB/dtau")
            if (b(i) > 0.0_dp) call is_close(sliding%stress*sliding%phi(2)/b(i), 1.0_dp, 1.0e-9_dp, "phi_y is B/tau")
            exact = exact_factors(law, b(i), [1.0e-3_dp, 1.0e-3_dp])
            call is_close(maxval(abs(exact%phi/sliding%phi - 1.0_dp)), 0.0_dp, 1.0e-6_dp, "a small gradient")
            call is_close(maxval(abs(exact%by_sliding - sliding%by_sliding)), 0.0_dp, 2.0e-6_dp, "its change with the sliding")
            call is_close(maxval(abs(exact%tangent/sliding%phi - 1.0_dp)), 0.0_dp, 2.0e-6_dp, "its change with the gradient")
            do k = 1, size(s)
               do m = 1, size(s)
                  exact = exact_factors(law, b(i), [s(k), s(m)])
                  call is_true(all(exact%phi > 1.0_dp - 1.0e-12_dp) .and. maxval(exact%phi) < 1.0e95_dp, "shear thinning")
                  call is_true(exact%phi(1) > exact%phi(2)*(1.0_dp - 1.0e-9_dp), "it flows most easily along the sliding")
                  call is_true(all(exact%tangent > 0.0_dp), "more gradient, more flow")
               end do
            end do
         end do
      end do
   end subroutine limits

   !> Second-order factors in the gradient have at most the stated error
   subroutine of_second_order()
      type(thinning_t), parameter :: laws(4) = [thinning_t(eyring, 1.0_dp), thinning_t(carreau, 0.2_dp), &
                                                thinning_t(carreau, 0.5_dp), thinning_t(carreau, 0.9_dp)]
      type(thinning_t) :: law
      type(factors_t) :: exact, sliding
      real(dp) :: error, worst(2)
      integer :: i, k, l, m

      do l = 1, size(laws)
         law = laws(l)
         worst = 0.0_dp
         do i = -2, 8
            do k = -4, 6
               do m = 0, 4
                  associate (s => 2.0_dp**k*[cos(0.4_dp*m), sin(0.4_dp*m)])
                     sliding = sliding_factors(law, 10.0_dp**i, s, error)
                     if (error > 1.0e-3_dp) cycle
                     exact = exact_factors(law, 10.0_dp**i, s)
                     worst(1) = max(worst(1), maxval(abs(sliding%phi/exact%phi - 1.0_dp)) - error)
                     worst(2) = max(worst(2), abs(sliding%stress/exact%stress - 1.0_dp) - error, &
                                    maxval(abs(sliding%tangent/exact%tangent - 1.0_dp)) - 5.0_dp*error)
                  end associate
               end do
            end do
         end do
         call is_close(worst(1), 0.0_dp, 1.0e-6_dp, "flow factors of second order")
         call is_close(worst(2), 0.0_dp, 1.0e-6_dp, "mean stress and change of the flow of second order")
      end do
   end subroutine of_second_order

   !> Derivatives of ln(phi), of the flow and of the stress
   subroutine changes_against_differences()
      real(dp), parameter :: b(3) = [0.4_dp, 5.0_dp, 1.0e4_dp], step = 1.0e-4_dp
      real(dp), parameter :: s(2, 4) = reshape([1.0_dp, 2.0_dp, -3.0_dp, 0.5_dp, 4.0_dp, 0.0_dp, 0.0_dp, 3.0_dp], [2, 4])
      type(thinning_t) :: law
      type(factors_t) :: r, up, down
      real(dp) :: change(2)
      integer :: i, k, l

      do l = 1, 2
         law = merge(by_eyring, by_carreau, l == 1)
         do i = 1, size(b)
            up = sliding_factors(law, b(i)*exp(step), [0.0_dp, 0.0_dp])
            down = sliding_factors(law, b(i)*exp(-step), [0.0_dp, 0.0_dp])
            r = sliding_factors(law, b(i), [0.0_dp, 0.0_dp])
            call is_close(maxval(abs(log(up%phi/down%phi)/(2.0_dp*step) - r%by_sliding)), 0.0_dp, 1.0e-6_dp, &
                          "change with the sliding alone")
            do k = 1, size(s, 2)
               r = exact_factors(law, b(i), s(:, k))
               up = exact_factors(law, b(i)*exp(step), s(:, k))
               down = exact_factors(law, b(i)*exp(-step), s(:, k))
               call is_close(maxval(abs(log(up%phi/down%phi)/(2.0_dp*step) - r%by_sliding)), 0.0_dp, 1.0e-6_dp, &
                             "change with the sliding")
               call is_close((up%stress - down%stress)/(2.0_dp*step)/(b(i)*r%stress_by_sliding), 1.0_dp, 1.0e-6_dp, &
                             "change of the stress")
               up = exact_factors(law, b(i), s(:, k)*exp(step))
               down = exact_factors(law, b(i), s(:, k)*exp(-step))
               call is_close(maxval(abs(log(up%phi/down%phi)/(2.0_dp*step) - r%by_gradient)), 0.0_dp, 1.0e-6_dp, &
                             "change with the gradient")
               up = exact_factors(law, b(i), s(:, k) + [step, 0.0_dp])
               down = exact_factors(law, b(i), s(:, k) - [step, 0.0_dp])
               change(1) = (up%phi(1)*(s(1, k) + step) - down%phi(1)*(s(1, k) - step))/(2.0_dp*step)
               up = exact_factors(law, b(i), s(:, k) + [0.0_dp, step])
               down = exact_factors(law, b(i), s(:, k) - [0.0_dp, step])
               change(2) = (up%phi(2)*(s(2, k) + step) - down%phi(2)*(s(2, k) - step))/(2.0_dp*step)
               call is_close(maxval(abs(change/r%tangent - 1.0_dp)), 0.0_dp, 1.0e-6_dp, "change of the flow")
            end do
         end do
      end do
   end subroutine changes_against_differences
end module test_flow

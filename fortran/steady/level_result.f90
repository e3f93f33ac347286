! SPDX-License-Identifier: BSD-3-Clause
!> Results of the smooth contact on the levels of a nested iteration, and the error by two of them
module ehl_level_result
   use ehl_contact_results, only: contact_results_t
   use ehl_inlet, only: inlet_t
   use ehl_kinds, only: dp
   implicit none (type, external)
   private
   public :: level_result_t, discretisation_error, film_errors, stated_errors, share_error, &
             extrapolated, friction_error, limit_error, spike_grows

   !> Results of one level
   type :: level_result_t
      logical :: solved = .false.
      type(contact_results_t) :: m
      !> Mesh size along X [a]
      real(dp) :: mesh = 0.0_dp
      !> Algebraic errors of H_c and H_min, as estimated
      real(dp) :: algebraic(2) = 0.0_dp
      !> That of the load share of a boundary film
      real(dp) :: share_algebraic = 0.0_dp
      !> Cycles made, residual (rms) at the end
      integer :: cycles = 0
      real(dp) :: residual = 0.0_dp
   end type level_result_t

   !> Largest discretisation error over the film that is taken to be of order 2, which two grids cannot show (Roache 1994,
   !> whose factor for order 1 is 3 times that of order 2). At errors of 8 and 15 % on 513 nodes the true errors
   !> of contacts were 1.1 times those by order 2 (kappa = 1, M = 5233, L = 4.4; kappa = 6.6, M by R_x = 76543, L = 5.4)
   real(dp), parameter :: leading = 0.05_dp
   !> Safety factors of the errors of H_c (Roache 1994) and of H_min, which is the least of the nodes and converges less evenly:
   !> 1.25 covers 95 % of lines, 1.5 covers 97 % (docs/evidence/machines)
   real(dp), parameter :: safety(2) = [1.25_dp, 1.5_dp]

contains

   !> Discretisation errors of H_c and H_min by the results on two grids, order 2
   pure function discretisation_error(fine, coarse) result(error)
      type(contact_results_t), intent(in) :: fine, coarse
      real(dp) :: error(2)

      error = abs(fine%films() - coarse%films())/3.0_dp
   end function discretisation_error

   !> Discretisation errors of H_c and H_min on level n as they are stated: by the order from 1 to 2 that three grids show, or
   !> that an error above `leading` leaves to two, times a safety factor. The difference of H_min, whose node changes, may be
   !> small by chance: no less than what the one before becomes by order 2. Where the bodies touch the third grid counts if it
   !> resolves the inlet, and the errors are no less than that of the fine grid in the inlet.
   pure function stated_errors(fine, results, n, inlet) result(errors)
      !> Results on level n, and what is known of the coarser ones
      type(contact_results_t), intent(in) :: fine
      type(level_result_t), intent(in) :: results(:)
      integer, intent(in) :: n
      type(inlet_t), intent(in) :: inlet
      real(dp) :: errors(2), last(2), before(2), order(2)

      last = max(discretisation_error(fine, results(n - 1)%m), tiny(last))
      order = 2.0_dp - min(1.0_dp, max(0.0_dp, last/fine%films()/leading - 1.0_dp))
      before = 0.0_dp
      if (n > 2) then
         if (results(n - 2)%solved .and. inlet%resolves(results(n - 2)%m, results(n - 2)%mesh)) then
            before = discretisation_error(results(n - 1)%m, results(n - 2)%m)
            order = min(order, log(max(2.0_dp*last, min(4.0_dp*last, before))/last)/log(2.0_dp))
         end if
      end if
      ! films of a line that lets all oil through are the same on all grids, but for the place of the least one
      errors = max(film_errors(fine, results(n - 1)%m, results(n)%mesh, inlet), [0.0_dp, safety(2)*fine%oil%between], &
                   safety*max([0.0_dp, 0.25_dp*before(2)], 3.0_dp*last/(2.0_dp**order - 1.0_dp)))
   end function stated_errors

   !> Discretisation errors of H_c and H_min by the results on two grids, order 2; where the bodies touch on either no less
   !> than the error of the fine one in the inlet
   pure function film_errors(fine, coarse, mesh, inlet) result(errors)
      type(contact_results_t), intent(in) :: fine, coarse
      !> Mesh size of the fine grid
      real(dp), intent(in) :: mesh
      type(inlet_t), intent(in) :: inlet
      real(dp) :: errors(2)

      errors = discretisation_error(fine, coarse)
      if (max(fine%touching%load_share, coarse%touching%load_share) > 0.0_dp) then
         errors = max(errors, inlet%film_errors(fine, mesh))
      end if
   end function film_errors

   !> Discretisation error of the load share of a boundary film on level n > 1: the difference to the next coarser one, of
   !> order 1 as the edge of a touching zone lies between two nodes, if that resolves the inlet; no less than what the film
   !> makes of it
   pure real(dp) function share_error(results, n, inlet)
      type(level_result_t), intent(in) :: results(:)
      integer, intent(in) :: n
      type(inlet_t), intent(in) :: inlet

      associate (fine => results(n), coarse => results(n - 1))
         share_error = inlet%share_error(fine%m, fine%mesh)
         if (inlet%resolves(coarse%m, coarse%mesh)) then
            share_error = max(share_error, abs(fine%m%touching%load_share - coarse%m%touching%load_share))
         end if
      end associate
   end function share_error

   !> Discretisation error of a quantity without a known order, by its values on three grids, coarsest first: what the
   !> series of differences has left, if they fall by a fifth at least; negative where they do not
   pure real(dp) function limit_error(values)
      real(dp), intent(in) :: values(3)
      real(dp) :: last, before

      last = abs(values(3) - values(2))
      before = abs(values(2) - values(1))
      limit_error = -1.0_dp
      ! no faster than order 2
      if (last <= 0.8_dp*before) limit_error = max(last/3.0_dp, last**2/(before - last))
   end function limit_error

   !> Relative discretisation error of the Newtonian friction integral on level n, as that of H_c
   pure real(dp) function friction_error(results, n, otherwise)
      type(level_result_t), intent(in) :: results(:)
      integer, intent(in) :: n
      !> Its value where no coarser level has a solution
      real(dp), intent(in) :: otherwise

      friction_error = otherwise
      if (n == 1) return
      associate (fine => results(n), coarse => results(n - 1))
         if (coarse%solved) friction_error = abs(fine%m%friction_newtonian - coarse%m%friction_newtonian) &
                                             /(3.0_dp*fine%m%friction_newtonian)
      end associate
   end function friction_error

   !> Whether maximum pressure or friction integral on level n and the two coarser ones show no limit: there is a spike of
   !> pressure that these grids do not resolve
   pure logical function spike_grows(results, n)
      type(level_result_t), intent(in) :: results(:)
      integer, intent(in) :: n

      spike_grows = .false.
      if (n < 3) return
      associate (r => results(n - 2:n))
         if (all(r%solved)) spike_grows = limit_error(r%m%pressure_maximum) < 0.0_dp .or. limit_error(r%m%friction) < 0.0_dp
      end associate
   end function spike_grows

   !> H_c and H_min extrapolated from levels n and n-1, order 2
   pure function extrapolated(results, n) result(values)
      type(level_result_t), intent(in) :: results(:)
      integer, intent(in) :: n
      real(dp) :: values(2)

      values = (4.0_dp*results(n)%m%films() - results(n - 1)%m%films())/3.0_dp
   end function extrapolated
end module ehl_level_result

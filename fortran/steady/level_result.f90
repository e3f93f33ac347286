! SPDX-License-Identifier: BSD-3-Clause
!> Results of the smooth contact on the levels of nested iteration, and their discretisation errors
module ehl_level_result
   use ehl_contact_results, only: contact_results_t
   use ehl_inlet, only: inlet_t
   use ehl_kinds, only: dp
   implicit none (type, external)
   private
   public :: level_result_t, discretisation_error, film_errors, stated_errors, share_error, &
             extrapolated, friction_error, limit_error, unresolved_spike

   !> Results of one level
   type :: level_result_t
      logical :: solved = .false.
      type(contact_results_t) :: m
      !> Mesh size along X [a]
      real(dp) :: mesh = 0.0_dp
      !> Estimated algebraic errors of H_c and H_min
      real(dp) :: algebraic(2) = 0.0_dp
      !> Estimated algebraic error of the load share
      real(dp) :: share_algebraic = 0.0_dp
      !> Number of cycles, final rms residual
      integer :: cycles = 0
      real(dp) :: residual = 0.0_dp
   end type level_result_t

   !> Maximum relative discretisation error assumed to be of order 2, which two grids cannot show (Roache 1994; the factor for
   !> order 1 is 3 times that for order 2). At errors of 8 and 15 % on 513 nodes the true errors were 1.1 times those for order 2
   !> (kappa = 1, M = 5233, L = 4.4; kappa = 6.6, M by R_x = 76543, L = 5.4)
   real(dp), parameter :: max_second_order = 0.05_dp
   !> Safety factors of the errors of H_c (Roache 1994) and of H_min, a nodal minimum that converges less evenly: 1.25 covers
   !> 95 % of lines, 1.5 covers 97 % (docs/evidence/machines)
   real(dp), parameter :: safety(2) = [1.25_dp, 1.5_dp]

contains

   !> Discretisation errors of H_c and H_min from two grids, order 2
   pure function discretisation_error(fine, coarse) result(error)
      type(contact_results_t), intent(in) :: fine, coarse
      real(dp) :: error(2)

      error = abs(fine%films() - coarse%films())/3.0_dp
   end function discretisation_error

   !> Stated discretisation errors of H_c and H_min on level n, with safety factors. The order, from 1 to 2, is the smaller of that
   !> from three grids and that from two, reduced for errors above `max_second_order`. The difference of H_min, whose node changes,
   !> may be small by chance: its error is at least a quarter of that of the coarser pair, as for order 2. With solid contact the
   !> third grid counts only if it resolves the inlet, and the errors are at least that of the fine grid in the inlet.
   pure function stated_errors(fine, results, n, inlet) result(errors)
      !> Results on level n, and on the coarser levels
      type(contact_results_t), intent(in) :: fine
      type(level_result_t), intent(in) :: results(:)
      integer, intent(in) :: n
      type(inlet_t), intent(in) :: inlet
      real(dp) :: errors(2), last(2), before(2), order(2)

      last = max(discretisation_error(fine, results(n - 1)%m), tiny(last))
      order = 2.0_dp - min(1.0_dp, max(0.0_dp, last/fine%films()/max_second_order - 1.0_dp))
      before = 0.0_dp
      if (n > 2) then
         if (results(n - 2)%solved .and. inlet%resolves(results(n - 2)%m, results(n - 2)%mesh)) then
            before = discretisation_error(results(n - 1)%m, results(n - 2)%m)
            order = min(order, log(max(2.0_dp*last, min(4.0_dp*last, before))/last)/log(2.0_dp))
         end if
      end if
      ! the film of a line that passes all of its oil is the same on all grids, except for the position of the minimum
      errors = max(film_errors(fine, results(n - 1)%m, results(n)%mesh, inlet), [0.0_dp, safety(2)*fine%oil%between], &
                   safety*max([0.0_dp, 0.25_dp*before(2)], 3.0_dp*last/(2.0_dp**order - 1.0_dp)))
   end function stated_errors

   !> Discretisation errors of H_c and H_min from two grids, order 2; with solid contact on either at least the error of the fine
   !> grid in the inlet
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

   !> Discretisation error of the load share on level n > 1: the difference from the next coarser level if that resolves the inlet
   !> (order 1, since the edge of the solid contact lies between two nodes), at least the error from that of the film
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

   !> Discretisation error of a quantity of unknown order from its values on three grids, coarsest first: the remainder of the
   !> geometric series of the differences if they decrease by at least a fifth, otherwise negative
   pure real(dp) function limit_error(values)
      real(dp), intent(in) :: values(3)
      real(dp) :: last, before

      last = abs(values(3) - values(2))
      before = abs(values(2) - values(1))
      limit_error = -1.0_dp
      ! order 2 at most
      if (last <= 0.8_dp*before) limit_error = max(last/3.0_dp, last**2/(before - last))
   end function limit_error

   !> Relative discretisation error of the Newtonian friction integral on level n, order 2
   pure real(dp) function friction_error(results, n, otherwise)
      type(level_result_t), intent(in) :: results(:)
      integer, intent(in) :: n
      !> Value without a solution on the coarser level
      real(dp), intent(in) :: otherwise

      friction_error = otherwise
      if (n == 1) return
      associate (fine => results(n), coarse => results(n - 1))
         if (coarse%solved) friction_error = abs(fine%m%friction_newtonian - coarse%m%friction_newtonian) &
                                             /(3.0_dp*fine%m%friction_newtonian)
      end associate
   end function friction_error

   !> Whether maximum pressure or friction integral do not converge over levels n - 2 to n, because of an unresolved pressure spike
   pure logical function unresolved_spike(results, n)
      type(level_result_t), intent(in) :: results(:)
      integer, intent(in) :: n

      unresolved_spike = .false.
      if (n < 3) return
      associate (r => results(n - 2:n))
         if (all(r%solved)) unresolved_spike = limit_error(r%m%pressure_maximum) < 0.0_dp .or. limit_error(r%m%friction) < 0.0_dp
      end associate
   end function unresolved_spike

   !> H_c and H_min extrapolated from levels n and n-1, order 2
   pure function extrapolated(results, n) result(values)
      type(level_result_t), intent(in) :: results(:)
      integer, intent(in) :: n
      real(dp) :: values(2)

      values = (4.0_dp*results(n)%m%films() - results(n - 1)%m%films())/3.0_dp
   end function extrapolated
end module ehl_level_result

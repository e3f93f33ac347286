! SPDX-License-Identifier: BSD-3-Clause
!> Tolerances of a level of the smooth contact: shares of its discretisation error. The present results of level n are m; those of
!> the coarser levels are in `results`.
module ehl_level_tolerance
   use ehl_contact_results, only: contact_results_t
   use ehl_kinds, only: dp
   use ehl_level_result, only: film_errors, level_result_t, stated_errors
   use ehl_steady_options, only: max_error, steady_options_t
   use ehl_touching, only: mostly_touching, much_mass_defect
   implicit none (type, external)
   private
   public :: accurate, counts_share, has_coarser, has_target, is_end, residual_tolerance, allowed_errors

   !> Relative discretisation errors below this are not trusted, as two levels may agree by chance
   real(dp), parameter :: min_error = 2.0e-5_dp
   !> Algebraic error of the load share of a boundary film at which a level ends once the films have converged
   real(dp), parameter :: share_tolerance = 1.0e-3_dp
   !> Error of it by the residual (share_left), over the allowed algebraic error: mostly less than a fifth of that is left
   !> (docs/evidence/inlet)
   real(dp), parameter :: cover = 5.0_dp
   !> Largest residual (rms, as far as it concerns the film; the wedge term is of order 1 in the inlet) of a converged
   !> solution
   real(dp), parameter :: residual_tolerance = 2.0e-3_dp
   !> Allowed relative algebraic error on the first grid, where no discretisation error is known yet; and where two finer grids
   !> follow: the first one then gives a guess, and enters no result
   real(dp), parameter :: start_tolerance = 1.0e-3_dp, guess_tolerance = 3.0e-2_dp

contains

   !> Whether the error of H_c is the required one
   pure logical function has_target(options, results, n, m)
      type(steady_options_t), intent(in) :: options
      type(level_result_t), intent(in) :: results(:)
      integer, intent(in) :: n
      type(contact_results_t), intent(in) :: m
      real(dp) :: errors(2)

      has_target = .false.
      if (.not. (options%target_error > 0.0_dp .and. has_coarser(results, n))) return
      errors = stated_errors(m, results, n, options%inlet) + results(n)%algebraic
      has_target = errors(1) <= options%target_error*m%film_central .and. &
                   options%inlet%resolves(m, results(n)%mesh)
   end function has_target

   !> Whether the solution may end on the present level
   pure logical function is_end(options, n)
      type(steady_options_t), intent(in) :: options
      integer, intent(in) :: n
      is_end = n == options%levels .or. options%target_error > 0.0_dp
   end function is_end

   !> Whether the algebraic errors are small enough for the grid, and on a level where the solution may end the residual, too
   pure logical function accurate(options, results, n, m, residual, more)
      type(steady_options_t), intent(in) :: options
      type(level_result_t), intent(in) :: results(:)
      integer, intent(in) :: n
      type(contact_results_t), intent(in) :: m
      real(dp), intent(in) :: residual
      !> Whether another cycle may be made: after the last one the error of a load share by the residual does not count, as it is in
      !> the stated error
      logical, intent(in) :: more
      real(dp) :: left

      accurate = all(results(n)%algebraic <= allowed_errors(options, results, n, m)) .and. &
                 (residual <= residual_tolerance .or. .not. is_end(options, n))
      if (.not. (accurate .and. counts_share(options, m))) return
      left = 0.0_dp
      if (is_end(options, n) .and. more) left = options%inlet%share_left(m, residual)/cover
      accurate = max(left, results(n)%share_algebraic) <= &
                 max(share_tolerance, options%accuracy*options%inlet%share_error(m, results(n)%mesh))
   end function accurate

   !> Whether the load share of a boundary film is a result, and the contact with it well posed
   pure logical function counts_share(options, m)
      type(steady_options_t), intent(in) :: options
      type(contact_results_t), intent(in) :: m
      counts_share = rests_on_boundary_film(m) .or. (options%inlet%film > 0.0_dp .and. m%touching%load_share > 0.0_dp .and. &
                                                m%touching%supply <= much_mass_defect)
   end function counts_share

   !> Whether a boundary film supports most of the load; the contact is not well posed where the film would have to supply much oil
   pure logical function rests_on_boundary_film(m)
      type(contact_results_t), intent(in) :: m
      rests_on_boundary_film = m%touching%load_share > mostly_touching .and. m%touching%supply <= much_mass_defect
   end function rests_on_boundary_film

   !> Algebraic errors of H_c and H_min that are small enough for the present level
   pure function allowed_errors(options, results, n, m)
      type(steady_options_t), intent(in) :: options
      type(level_result_t), intent(in) :: results(:)
      integer, intent(in) :: n
      type(contact_results_t), intent(in) :: m
      real(dp) :: allowed_errors(2), values(2), least

      least = merge(start_tolerance, min_error, rests_on_boundary_film(m))
      values = m%films()
      if (has_coarser(results, n)) then
         allowed_errors = options%accuracy*max(film_errors(m, results(n - 1)%m, results(n)%mesh, options%inlet), least*values)
      else
         allowed_errors = start_tolerance*values
         if (n == options%levels) allowed_errors = options%accuracy*allowed_errors
         if (n < options%levels - 1 .and. .not. is_end(options, n)) allowed_errors = guess_tolerance*values
      end if
      if (is_end(options, n)) allowed_errors = min(allowed_errors, max_error*values)
   end function allowed_errors

   !> Whether the level begins from a coarser one
   pure logical function has_coarser(results, n)
      type(level_result_t), intent(in) :: results(:)
      integer, intent(in) :: n
      has_coarser = .false.
      if (n > 1) has_coarser = results(n - 1)%solved
   end function has_coarser
end module ehl_level_tolerance

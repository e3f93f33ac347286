! SPDX-License-Identifier: BSD-3-Clause
!> Tolerances of a level of the smooth contact, as fractions of its discretisation error. The present results of level n are m;
!> those of the coarser levels are in `results`.
module ehl_level_tolerance
   use ehl_contact_results, only: contact_results_t
   use ehl_kinds, only: dp
   use ehl_level_result, only: film_errors, level_result_t, stated_errors
   use ehl_steady_options, only: max_error, steady_options_t
   use ehl_touching, only: mostly_touching, much_mass_defect
   implicit none (type, external)
   private
   public :: accurate, share_counts, has_coarser, has_target, is_end, residual_tolerance, allowed_errors

   !> Minimum relative discretisation error assumed, since two levels may agree by chance
   real(dp), parameter :: min_error = 2.0e-5_dp
   !> Algebraic error of the load share at which a level ends once the films have converged
   real(dp), parameter :: share_tolerance = 1.0e-3_dp
   !> Margin of the error bound residual_share_error over the true error of the load share, which is mostly below a fifth of it
   !> (docs/evidence/inlet)
   real(dp), parameter :: share_margin = 5.0_dp
   !> Maximum residual of the film (rms; the wedge term is of order 1 in the inlet) of a converged solution
   real(dp), parameter :: residual_tolerance = 2.0e-3_dp
   !> Allowed relative algebraic error on the first grid, where no discretisation error is known yet; and if at least two finer
   !> grids follow, so that it only gives a first approximation
   real(dp), parameter :: start_tolerance = 1.0e-3_dp, guess_tolerance = 3.0e-2_dp

contains

   !> Whether the stated error of H_c meets the target
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

   !> Whether the algebraic errors are small enough for the grid, and, where the solution may end, the residual too
   pure logical function accurate(options, results, n, m, residual, more)
      type(steady_options_t), intent(in) :: options
      type(level_result_t), intent(in) :: results(:)
      integer, intent(in) :: n
      type(contact_results_t), intent(in) :: m
      real(dp), intent(in) :: residual
      !> Whether another cycle may be made: after the last one the error of the load share from the residual is not tested, as the
      !> stated error includes it
      logical, intent(in) :: more
      real(dp) :: remaining

      accurate = all(results(n)%algebraic <= allowed_errors(options, results, n, m)) .and. &
                 (residual <= residual_tolerance .or. .not. is_end(options, n))
      if (.not. (accurate .and. share_counts(options, m))) return
      remaining = 0.0_dp
      if (is_end(options, n) .and. more) remaining = options%inlet%residual_share_error(m, residual)/share_margin
      accurate = max(remaining, results(n)%share_algebraic) <= &
                 max(share_tolerance, options%accuracy*options%inlet%share_error(m, results(n)%mesh))
   end function accurate

   !> Whether the load share is a result and the contact is well posed
   pure logical function share_counts(options, m)
      type(steady_options_t), intent(in) :: options
      type(contact_results_t), intent(in) :: m
      share_counts = mostly_solid_contact(m) .or. (options%inlet%film > 0.0_dp .and. m%touching%load_share > 0.0_dp .and. &
                                                          m%touching%mass_defect <= much_mass_defect)
   end function share_counts

   !> Whether the boundary film supports most of the load, with a mass defect small enough for a well-posed contact
   pure logical function mostly_solid_contact(m)
      type(contact_results_t), intent(in) :: m
      mostly_solid_contact = m%touching%load_share > mostly_touching .and. m%touching%mass_defect <= much_mass_defect
   end function mostly_solid_contact

   !> Allowed algebraic errors of H_c and H_min on the present level
   pure function allowed_errors(options, results, n, m)
      type(steady_options_t), intent(in) :: options
      type(level_result_t), intent(in) :: results(:)
      integer, intent(in) :: n
      type(contact_results_t), intent(in) :: m
      real(dp) :: allowed_errors(2), values(2), smallest

      smallest = merge(start_tolerance, min_error, mostly_solid_contact(m))
      values = m%films()
      if (has_coarser(results, n)) then
         allowed_errors = options%accuracy*max(film_errors(m, results(n - 1)%m, results(n)%mesh, options%inlet), smallest*values)
      else
         allowed_errors = start_tolerance*values
         if (n == options%levels) allowed_errors = options%accuracy*allowed_errors
         if (n < options%levels - 1 .and. .not. is_end(options, n)) allowed_errors = guess_tolerance*values
      end if
      if (is_end(options, n)) allowed_errors = min(allowed_errors, max_error*values)
   end function allowed_errors

   !> Whether the level starts from a coarser one
   pure logical function has_coarser(results, n)
      type(level_result_t), intent(in) :: results(:)
      integer, intent(in) :: n
      has_coarser = .false.
      if (n > 1) has_coarser = results(n - 1)%solved
   end function has_coarser
end module ehl_level_tolerance

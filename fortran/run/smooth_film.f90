! SPDX-License-Identifier: BSD-3-Clause
!> Extrapolated central film of the smooth contact, the reference of surface.amplitude_over_film
module ehl_smooth_film
   use ehl_case, only: case_t
   use ehl_contact_run, only: contact_run_t
   use ehl_fmg, only: full_multigrid
   use ehl_kinds, only: dp
   use ehl_level_result, only: discretisation_error, extrapolated
   use ehl_moving_surfaces, only: moving_surfaces_t
   use ehl_observer, only: observer_t
   use ehl_outcome, only: outcome_converged
   use ehl_plan, only: make_plan
   use ehl_plan_need, only: check_need
   use ehl_status, only: ehl_bad_input, status_t
   use ehl_smooth_contact, only: smooth_contact_t
   use ehl_text, only: to_text
   implicit none (type, external)
   private
   public :: known_film, film_by_finer_grids

   !> Maximum relative grid error for the extrapolation
   real(dp), parameter :: film_error = 0.02_dp

contains

   !> Film extrapolated from the grids of a solution [a^2/R]; 0 if its grid error is too large or not known
   pure real(dp) function known_film(smooth)
      type(smooth_contact_t), intent(in) :: smooth
      real(dp) :: error(2), limit(2)

      known_film = 0.0_dp
      associate (n => smooth%n, results => smooth%results)
         if (n == 1) return
         if (.not. results(n - 1)%solved) return
         error = discretisation_error(results(n)%m, results(n - 1)%m)
         limit = extrapolated(results, n)
         if (error(1) <= film_error*limit(1)) known_film = limit(1)
      end associate
   end function known_film

   !> Film from a run of the smooth contact on as fine a grid as needed [a^2/R]
   real(dp) function film_by_finer_grids(rough, surfaces, status) result(film)
      type(case_t), intent(in) :: rough
      !> The rough surfaces, one of which has amplitude_over_film
      type(moving_surfaces_t), intent(in) :: surfaces
      type(status_t), intent(inout) :: status
      type(contact_run_t), allocatable :: run
      type(moving_surfaces_t) :: no_surfaces
      type(case_t) :: input
      type(observer_t) :: unobserved
      logical :: leave
      integer :: k

      film = 0.0_dp
      input = rough
      input%surface%kind = "smooth"
      input%second_surface%kind = "smooth"
      ! the extrapolated film is more accurate than the grid
      input%grid%target_error = 0.9_dp*film_error
      allocate (run)
      call make_plan(input, no_surfaces, run%plan, status)
      call check_need(run%plan, status)
      call run%begin(status)
      if (.not. status%failed()) call full_multigrid(run, unobserved, leave, status)
      if (status%failed()) return
      if (run%outcome == outcome_converged) film = known_film(run%smooth)
      if (film > 0.0_dp) return
      k = findloc(surfaces%of%amplitude_over_film > 0.0_dp, .true., dim=1)
      associate (member => surfaces%of(k))
         call status%fail(ehl_bad_input, trim(member%group)//".amplitude_over_film = "//to_text(member%amplitude_over_film)// &
                          ": the error of the smooth film exceeds "//to_text(100.0_dp*film_error)// &
                          " % on grids of up to "//to_text(input%grid%max_points)//" points"//new_line("a")// &
                          "expected: amplitude, or a larger grid.max_points")
      end associate
   end function film_by_finer_grids
end module ehl_smooth_film

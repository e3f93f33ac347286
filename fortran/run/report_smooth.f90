! SPDX-License-Identifier: BSD-3-Clause
!> Results of the smooth contact by name, each with the error that its grids and its domain leave; and of contact at a boundary
!> film, over a run too: what of the load it carries, where, and what the layer gives
module ehl_report_smooth
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ehl_contact_results, only: contact_results_t
   use ehl_contact_run, only: contact_run_t
   use ehl_domain, only: better_grid, has_solution, relative_errors, too_small
   use ehl_friction_mean, only: friction_mean_t
   use ehl_kinds, only: dp, not_known, pi
   use ehl_level_result, only: discretisation_error, extrapolated, limit_error
   use ehl_outcome, only: outcome_converged
   use ehl_plan, only: plan_t
   use ehl_record, only: record_t
   use ehl_steady, only: steady_t
   use ehl_touching, only: at_depth, known_names, mostly_touching, much_supplied, touching_names
   implicit none (type, external)
   private
   public :: report_smooth, report_touching, knows_friction, load_share_of, no_boundary_friction

   !> What a domain of twice the size would add to F, int 2/r^2 dA = 4 pi ln 2 over a gap of r^2/2 and the viscosity of
   !> the inlet. It counts for lubricants whose viscosity hardly rises with pressure.
   real(dp), parameter :: friction_beyond = 4.0_dp*pi*log(2.0_dp)

   !> Layer over the central film by formula from which on that film hardly matters
   real(dp), parameter :: dry_from = 2.0_dp
   !> Why there is no friction
   character(len=*), parameter :: no_boundary_friction = "the bodies touch, and the friction there is not known: "// &
                                                         "lubricant.boundary_friction and sliding are needed"

contains

   !> The smooth contact: results and errors, null unless they are good
   subroutine report_smooth(record, plan, steady, n, good)
      type(record_t), intent(inout) :: record
      type(plan_t), intent(in) :: plan
      type(steady_t), intent(in) :: steady
      !> Level of the results
      integer, intent(in) :: n
      logical, intent(in) :: good
      character(len=5), parameter :: of_contact(4) = [character(len=5) :: "H_c", "H_min", "P_max", "F"]
      type(contact_results_t) :: m
      real(dp) :: values(4), error(2), limit(2), domain(2)
      logical :: coarser
      integer :: k
      character(len=:), allocatable :: why

      m = steady%results(n)%m
      values = [m%films(), m%pressure_maximum, m%friction]
      if (.not. good) then
         do k = 1, size(values)
            call record%set("last_"//trim(of_contact(k)), values(k))
         end do
         values = not_known
      end if
      if (.not. knows_smooth(plan, m)) values(4) = not_known
      error = not_known
      limit = not_known
      coarser = .false.
      if (good .and. n > 1) coarser = steady%results(n - 1)%solved
      if (coarser) then
         error = discretisation_error(m, steady%results(n - 1)%m) + steady%results(n)%algebraic
         limit = extrapolated(steady%results, n)
      else if (good) then
         ! one grid alone: what such grids have been found to miss
         error = relative_errors(plan%contact, plan%point, plan%finest)*m%films()
      end if
      domain = not_known
      where (plan%domain_cost < 1.0_dp) domain = values(:2)*plan%domain_cost/(1.0_dp - plan%domain_cost)
      do k = 1, size(values)
         call record%set(trim(of_contact(k)), values(k))
      end do
      do k = 1, 2
         call record%set(trim(of_contact(k))//"_extrapolated", limit(k))
         call record%set(trim(of_contact(k))//"_error", error(k) + domain(k))
         call record%set(trim(of_contact(k))//"_error_grid", error(k))
         call record%set(trim(of_contact(k))//"_error_domain", domain(k))
         if (good .and. .not. plan%domain_cost(k) < 1.0_dp) call record%set(trim(of_contact(k))//"_error_note", too_small)
      end do
      why = better_grid(plan%contact, plan%point, plan%finest)
      if (.not. good .and. why /= "") call record%set("H_c_error_note", why)
      call record%set("error_estimate", trim(merge("two grids", "a priori ", coarser)))
      call report_limits(record, plan, steady, n, good)
      call record%set("H_c_algebraic_error", steady%results(n)%algebraic(1))
      call record%set("H_min_algebraic_error", steady%results(n)%algebraic(2))
      call record%set("load_beyond", 1.0_dp - m%load/plan%contact%load)
      call record%set("load_error", m%load_error)
      if (plan%scales%has_size()) then
         call record%set("h_c_m", values(1)*plan%scales%film)
         call record%set("h_c_error_m", (error(1) + domain(1))*plan%scales%film)
         call record%set("h_min_m", values(2)*plan%scales%film)
         call record%set("h_min_error_m", (error(2) + domain(2))*plan%scales%film)
         call record%set("p_max_Pa", values(3)*plan%scales%pressure)
      end if
      call record%set("cycles", steady%results(n)%cycles)
      call record%set("total_cycles", sum(steady%results%cycles))
      call record%set("residual", steady%results(n)%residual)
      call record%set("restarts", steady%restarts)
   end subroutine report_smooth

   !> Errors of P_max and F, which need three grids: where a pressure spike is not resolved neither has a limit that the
   !> grids could tell, for the viscosity in it carries the friction
   subroutine report_limits(record, plan, steady, n, good)
      type(record_t), intent(inout) :: record
      type(plan_t), intent(in) :: plan
      type(steady_t), intent(in) :: steady
      integer, intent(in) :: n
      logical, intent(in) :: good
      character(len=len(too_small)) :: note
      real(dp) :: error(2)
      logical :: known(2)

      error = 0.0_dp
      note = "there is no solution"
      if (good) note = "two coarser grids with a solution are needed"
      known = .false.
      if (good .and. n > 2) then
         associate (r => steady%results(n - 2:n))
            known = all(r%solved)
            if (known(1)) error = [limit_error(r%m%pressure_maximum), limit_error(r%m%friction)]
         end associate
         if (known(1)) then
            known = [error(1) >= 0.0_dp, all(error >= 0.0_dp)]
            note = "the change from grid to grid does not fall: no limit is in sight"
         end if
      end if
      if (.not. plan%domain_cost(1) < 1.0_dp) then
         known = .false.
         if (good) note = too_small
      end if
      known(2) = known(2) .and. knows_smooth(plan, steady%results(n)%m)
      associate (m => steady%results(n)%m)
         error = error + [m%pressure_maximum, m%friction]*plan%domain_cost(1) + [0.0_dp, friction_beyond]
      end associate
      where (.not. known) error = not_known
      call record%set("P_max_error", error(1))
      if (.not. known(1)) call record%set("P_max_error_note", trim(note))
      call record%set("F_error", error(2))
      if (.not. known(2)) call record%set("F_error_note", trim(note))
   end subroutine report_limits

   !> Whether friction is known: of the boundary film, too, where the bodies touch
   pure logical function knows_smooth(plan, m)
      type(plan_t), intent(in) :: plan
      type(contact_results_t), intent(in) :: m
      knows_smooth = .not. m%touching%load_share > 0.0_dp .or. plan%lubricant%boundary_stress > 0.0_dp
   end function knows_smooth

   !> That of the rough surfaces where there are any, null unless it is good; nothing where there is no boundary film
   subroutine report_touching(record, run, good, converged, why_no_grid_error)
      type(record_t), intent(inout) :: record
      class(contact_run_t), intent(in) :: run
      !> Whether the smooth contact is converged, and the run
      logical, intent(in) :: good, converged
      !> Why the run on the next coarser grid tells no error of a rough contact
      character(len=*), intent(in) :: why_no_grid_error
      !> As touching.f90 has them; the load share on the next coarser grid; its errors by the grid and by the end of the run
      real(dp) :: numbers(size(touching_names)), coarser, error, stop_error
      character(len=:), allocatable :: note, why
      integer :: n

      if (.not. run%plan%lubricant%boundary_film > 0.0_dp) return
      numbers = not_known
      coarser = not_known
      stop_error = not_known
      why = "there is no solution on the next coarser grid"
      if (run%plan%surfaces%rough()) then
         if (converged) then
            numbers = touching_of(run)
            stop_error = share_stop_error(run)
         end if
         if (run%coarse_outcome == outcome_converged) coarser = run%coarse_load_share
         why = why_no_grid_error
      else if (good) then
         numbers = touching_of(run)
         stop_error = 0.0_dp
         n = run%level()
         if (n > 1) then
            if (run%steady%results(n - 1)%solved) coarser = run%steady%results(n - 1)%m%touching%load_share
         end if
      end if
      ! of order 1, as the edge of a touching zone lies between two nodes
      error = abs(numbers(1) - coarser)
      note = ""
      associate (plan => run%plan)
         if (.not. ieee_is_finite(numbers(1))) then
            note = "there is no solution"
         else if (.not. ieee_is_finite(coarser)) then
            note = why
         else if (.not. (is_dry(plan) .or. has_solution(plan%contact, plan%point, run%grid%coarser()))) then
            note = "the next coarser grid does not resolve the inlet, and bodies touch on it for that"
            error = not_known
         else if (.not. is_dry(plan) .and. numbers(1) > mostly_touching .and. numbers(3) > much_supplied) then
            note = "most of the load is at a layer that would have to give much of the flow: the share may change on any grid"
            error = not_known
         end if
         call record%set("boundary_film", plan%lubricant%boundary_film)
         call record%set("contact_load_share", numbers(1))
         call record%set("contact_load_share_error", error + stop_error)
         call record%set("contact_load_share_error_grid", error)
         call record%set("contact_load_share_error_stop", stop_error)
         call record%set("contact_load_share_error_note", note)
         call record%set("contact_area_share", numbers(2)/(pi*plan%contact%ellipticity))
         call record%set("layer_supply", numbers(3))
         if (.not. plan%lubricant%boundary_limit > 0.0_dp) return
         call record%set("load_share_at_hardness", numbers(4))
         call record%set("area_share_at_hardness", numbers(5)/(pi*plan%contact%ellipticity))
         call record%set("plastic_depth_max_m", numbers(6)*plan%scales%film)
         call record%set("flowing_load_share_at_hardness", numbers(7))
      end associate
   end subroutine report_touching

   !> Whether the film that the inlet makes is nothing beside the layer
   logical function is_dry(plan)
      type(plan_t), intent(in) :: plan

      associate (point => plan%point)
         is_dry = plan%lubricant%boundary_film > dry_from*plan%contact%film_formula(point%moes_m, point%moes_l)
      end associate
   end function is_dry

   !> Whether friction is known: everywhere in the film, or of the boundary film, too
   logical function knows_friction(run, converged)
      class(contact_run_t), intent(in) :: run
      logical, intent(in) :: converged
      real(dp) :: share

      knows_friction = .not. run%plan%lubricant%boundary_film > 0.0_dp .or. run%plan%lubricant%boundary_stress > 0.0_dp
      if (knows_friction) return
      share = 0.0_dp
      if (run%resting) share = run%rest%m%touching%load_share
      if (run%in_steps) share = run%transient%m%touching%load_share
      if (run%in_steps .and. converged) share = load_share_of(run)
      knows_friction = .not. (share > 0.0_dp .or. run%steady%results(run%level())%m%touching%load_share > 0.0_dp)
   end function knows_friction

   !> What reynolds/touching.f90 reads off the contact of a run that has converged; in time steps means over the time of the mean
   !> friction ratio, and the greatest depth
   function touching_of(run) result(numbers)
      class(contact_run_t), intent(in) :: run
      real(dp) :: numbers(size(touching_names))
      integer :: k, first

      if (run%in_steps) then
         first = run%transient%mean%first_of_mean()
         numbers = 0.0_dp
         do k = 1, known_names(run%plan%lubricant)
            associate (values => run%history%column(touching_names(k)))
               numbers(k) = sum(values(first:))/max(1, size(values) - first + 1)
               if (k == at_depth) numbers(k) = maxval(values(first:))
            end associate
         end do
      else if (run%resting) then
         numbers = run%rest%m%touching%numbers()
      else
         numbers = run%steady%results(run%level())%m%touching%numbers()
      end if
   end function touching_of

   !> The load share alone
   real(dp) function load_share_of(run)
      class(contact_run_t), intent(in) :: run
      real(dp) :: numbers(size(touching_names))

      numbers = touching_of(run)
      load_share_of = numbers(1)
   end function load_share_of

   !> Error of the load share by the end of the run: that of a mean over time, as of the friction ratio; else 0
   real(dp) function share_stop_error(run)
      class(contact_run_t), intent(in) :: run
      type(friction_mean_t) :: mean

      share_stop_error = 0.0_dp
      if (.not. run%in_steps) return
      mean = run%transient%mean
      mean%values = run%history%column(touching_names(1))
      share_stop_error = mean%uncertainty()
   end function share_stop_error
end module ehl_report_smooth

! SPDX-License-Identifier: BSD-3-Clause
!> Named results of the smooth contact, with their grid and domain errors
module ehl_report_smooth
   use ehl_contact_results, only: contact_results_t
   use ehl_film_formula, only: starved_ratio
   use ehl_grid_error, only: single_grid_errors
   use ehl_kinds, only: dp, not_known, pi
   use ehl_level_result, only: extrapolated, limit_error, share_error, stated_errors
   use ehl_plan, only: plan_t
   use ehl_record, only: record_t
   use ehl_reason, only: reason_inlet, reason_no_limit, reason_no_solution, reason_none, reason_small_domain, reason_two_grids
   use ehl_resolution, only: points_for_inlet, points_for_solution, why_no_solution
   use ehl_smooth_contact, only: smooth_contact_t
   implicit none (type, external)
   private
   public :: report_smooth, unresolved_solid_contact

   !> Increase of F with a domain of twice the size: int 2/r^2 dA = 4 pi ln 2 with the gap r^2/2 and the inlet viscosity. It matters
   !> for lubricants whose viscosity hardly increases with pressure.
   real(dp), parameter :: friction_beyond = 4.0_dp*pi*log(2.0_dp)
   !> The same for a line with the inlet at X = -2.5 and the outlet at 1.5: int 2/X^2 dX over the added length on both sides
   real(dp), parameter :: line_friction_beyond = 1.0_dp/2.5_dp + 1.0_dp/1.5_dp

contains

   !> Results and errors of the smooth contact, null unless it is solved
   subroutine report_smooth(record, plan, smooth, n, solved)
      type(record_t), intent(inout) :: record
      type(plan_t), intent(in) :: plan
      type(smooth_contact_t), intent(in) :: smooth
      !> Level of the results
      integer, intent(in) :: n
      logical, intent(in) :: solved
      character(len=5), parameter :: films(2) = [character(len=5) :: "H_c", "H_min"]
      type(contact_results_t) :: m
      real(dp) :: values(4), error(2), limit(2), domain(2)
      logical :: coarser
      integer :: k
      integer :: why
      character(len=:), allocatable :: name

      m = smooth%results(n)%m
      values = [m%films(), m%pressure_maximum, m%friction]
      if (.not. solved) then
         call record%set("last_H_c last_H_min last_P_max last_F", values)
         values = not_known
      end if
      if (.not. knows_friction(plan, smooth, n)) values(4) = not_known
      error = not_known
      limit = not_known
      coarser = .false.
      if (solved .and. n > 1) coarser = smooth%results(n - 1)%solved
      if (coarser) then
         error = stated_errors(m, smooth%results, n, plan%inlet) + smooth%results(n)%algebraic
         limit = extrapolated(smooth%results, n)
      else if (solved) then
         ! a single grid: a-priori errors
         error = single_grid_errors(plan%contact, plan%point, plan%finest%hx, m%films())
         if (m%touching%load_share > 0.0_dp) error = max(error, plan%inlet%film_errors(m, smooth%results(n)%mesh))
      end if
      domain = not_known
      where (plan%domain_error < 1.0_dp) domain = values(:2)*plan%domain_error/(1.0_dp - plan%domain_error)
      call record%set("H_c H_min P_max F", values)
      do k = 1, 2
         name = trim(films(k))
         call record%set(name//"_extrapolated "//name//"_error "//name//"_error_grid "//name//"_error_domain", &
                         [limit(k), error(k) + domain(k), error(k), domain(k)])
         why = reason_none
         if (solved .and. .not. plan%domain_error(k) < 1.0_dp) why = reason_small_domain
         if (solved .and. unresolved_solid_contact(plan, smooth, n)) why = reason_inlet
         if (k == 1 .and. .not. solved) why = why_no_solution(plan%contact, plan%point, plan%finest)
         call record%set_code(name//"_error_note", why)
      end do
      call record%set_detail("finest_points", real(plan%finest%nx, dp))
      call record%set_detail("finest_width", plan%finest%hx*(plan%finest%nx - 1))
      call record%set_detail("points_for_solution", real(points_for_solution(plan%contact, plan%point, plan%finest), dp))
      call record%set_detail("points_for_inlet", real(merge(points_for_inlet(plan%inlet, plan%finest), 0, &
                                                            plan%lubricant%boundary_film > 0.0_dp), dp))
      call record%set("error_estimate", trim(merge("coarser grids", "a priori     ", coarser)))
      call report_limits(record, plan, smooth, n, solved)
      call record%set("H_c_algebraic_error H_min_algebraic_error", smooth%results(n)%algebraic)
      call record%set("load_beyond load_error", [1.0_dp - m%load/plan%contact%load, m%load_error])
      if (plan%scales%has_size()) call record%set("h_c_m h_c_error_m h_min_m h_min_error_m p_max_Pa", &
         [values(1), error(1) + domain(1), values(2), error(2) + domain(2), values(3)]* &
         [spread(plan%scales%film, 1, 4), plan%scales%pressure])
      if (plan%starved) call record%set("H_c_flooded starvation", [plan%film_flooded, values(1)/plan%film_flooded])
      if (plan%starved .and. .not. plan%layer > 0.0_dp) then
         call record%set("inlet_position", -plan%finest%x0)
         if (.not. plan%contact%is_line()) call record%set("starvation_by_formula", &
                                                           starved_ratio(plan%film_flooded, -plan%finest%x0))
      else if (plan%layer > 0.0_dp .and. plan%passages == 1) then
         call record%set("starvation_by_formula", plan%film_starved/plan%film_flooded)
      end if
      if (plan%layer > 0.0_dp) call record%set("oil_layer oil_in oil_out oil_at_sides oil_imbalance", &
         [plan%layer, merge([m%oil%enters, m%oil%leaves, m%oil%sides, m%oil%imbalance], spread(not_known, 1, 4), solved)])
      if (plan%passages > 1) call record%set("passages", smooth%passage)
      call record%set("cycles", smooth%results(n)%cycles)
      call record%set("total_cycles", sum(smooth%results%cycles))
      call record%set("residual", smooth%results(n)%residual)
      call record%set("restarts", smooth%restarts)
   end subroutine report_smooth

   !> Errors of P_max and F from three grids. With an unresolved pressure spike neither converges, since the viscosity in the spike
   !> determines the friction.
   subroutine report_limits(record, plan, smooth, n, solved)
      type(record_t), intent(inout) :: record
      type(plan_t), intent(in) :: plan
      type(smooth_contact_t), intent(in) :: smooth
      integer, intent(in) :: n
      logical, intent(in) :: solved
      integer :: note
      real(dp) :: error(2)
      logical :: known(2)

      error = 0.0_dp
      note = merge(reason_two_grids, reason_no_solution, solved)
      known = .false.
      if (solved .and. n > 2) then
         associate (r => smooth%results(n - 2:n))
            known = all(r%solved)
            if (known(1)) error = [limit_error(r%m%pressure_maximum), limit_error(r%m%friction)]
         end associate
         if (known(1)) then
            known = [error(1) >= 0.0_dp, all(error >= 0.0_dp)]
            note = reason_no_limit
         end if
      end if
      if (.not. plan%domain_error(1) < 1.0_dp) then
         known = .false.
         if (solved) note = reason_small_domain
      end if
      known(2) = known(2) .and. knows_friction(plan, smooth, n)
      associate (m => smooth%results(n)%m)
         error = error + [m%pressure_maximum, m%friction]*plan%domain_error(1) &
                 + [0.0_dp, merge(line_friction_beyond, friction_beyond, plan%contact%is_line())]
         ! error of the load share
         if (n > 1) error(2) = error(2) + plan%lubricant%boundary_stress*m%load*share_error(smooth%results, n, plan%inlet)
      end associate
      where (.not. known) error = not_known
      call record%set("P_max_error", error(1))
      call record%set_code("P_max_error_note", merge(reason_none, note, known(1)))
      call record%set("F_error", error(2))
      if (solved .and. unresolved_solid_contact(plan, smooth, n)) note = reason_inlet
      call record%set_code("F_error_note", merge(reason_none, note, known(2)))
   end subroutine report_limits

   !> Whether friction is known: with solid contact this needs the boundary friction, and a grid that resolves the inlet
   pure logical function knows_friction(plan, smooth, n)
      type(plan_t), intent(in) :: plan
      type(smooth_contact_t), intent(in) :: smooth
      integer, intent(in) :: n

      knows_friction = .not. smooth%results(n)%m%touching%load_share > 0.0_dp .or. plan%lubricant%boundary_stress > 0.0_dp
      if (unresolved_solid_contact(plan, smooth, n)) knows_friction = .false.
   end function knows_friction

   !> Whether the solid contact may be a grid error, as the grid does not resolve the inlet
   pure logical function unresolved_solid_contact(plan, smooth, n)
      type(plan_t), intent(in) :: plan
      type(smooth_contact_t), intent(in) :: smooth
      integer, intent(in) :: n
      unresolved_solid_contact = .not. plan%inlet%resolves(smooth%results(n)%m, smooth%results(n)%mesh)
   end function unresolved_solid_contact
end module ehl_report_smooth

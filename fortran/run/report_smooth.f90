! SPDX-License-Identifier: BSD-3-Clause
!> Results of the smooth contact by name, each with the error that its grids and its domain leave
module ehl_report_smooth
   use ehl_contact_results, only: contact_results_t
   use ehl_domain, only: too_small
   use ehl_grid_error, only: lone_grid_errors
   use ehl_kinds, only: dp, not_known, pi
   use ehl_level_result, only: extrapolated, limit_error, share_error, stated_errors
   use ehl_plan, only: plan_t
   use ehl_record, only: record_t
   use ehl_resolution, only: better_grid, unresolved_inlet
   use ehl_smooth_contact, only: smooth_contact_t
   implicit none (type, external)
   private
   public :: report_smooth, touches_for_grid

   !> What a domain of twice the size would add to F, int 2/r^2 dA = 4 pi ln 2 over a gap of r^2/2 and the viscosity of
   !> the inlet. It counts for lubricants whose viscosity hardly rises with pressure.
   real(dp), parameter :: friction_beyond = 4.0_dp*pi*log(2.0_dp)

contains

   !> The smooth contact: results and errors, null unless they are good
   subroutine report_smooth(record, plan, smooth, n, good)
      type(record_t), intent(inout) :: record
      type(plan_t), intent(in) :: plan
      type(smooth_contact_t), intent(in) :: smooth
      !> Level of the results
      integer, intent(in) :: n
      logical, intent(in) :: good
      character(len=5), parameter :: films(2) = [character(len=5) :: "H_c", "H_min"]
      type(contact_results_t) :: m
      real(dp) :: values(4), error(2), limit(2), domain(2)
      logical :: coarser
      integer :: k
      character(len=:), allocatable :: name, why

      m = smooth%results(n)%m
      values = [m%films(), m%pressure_maximum, m%friction]
      if (.not. good) then
         call record%set("last_H_c last_H_min last_P_max last_F", values)
         values = not_known
      end if
      if (.not. knows_friction(plan, smooth, n)) values(4) = not_known
      error = not_known
      limit = not_known
      coarser = .false.
      if (good .and. n > 1) coarser = smooth%results(n - 1)%solved
      if (coarser) then
         error = stated_errors(m, smooth%results(n - 1)%m, smooth%results(n)%mesh, plan%inlet) + smooth%results(n)%algebraic
         limit = extrapolated(smooth%results, n)
      else if (good) then
         ! one grid alone: what such grids have been found to miss
         error = lone_grid_errors(plan%contact, plan%point, plan%finest%hx, m%films())
         if (m%touching%load_share > 0.0_dp) error = max(error, plan%inlet%film_errors(m, smooth%results(n)%mesh))
      end if
      domain = not_known
      where (plan%domain_cost < 1.0_dp) domain = values(:2)*plan%domain_cost/(1.0_dp - plan%domain_cost)
      call record%set("H_c H_min P_max F", values)
      do k = 1, 2
         name = trim(films(k))
         call record%set(name//"_extrapolated "//name//"_error "//name//"_error_grid "//name//"_error_domain", &
                         [limit(k), error(k) + domain(k), error(k), domain(k)])
         if (good .and. .not. plan%domain_cost(k) < 1.0_dp) call record%set(name//"_error_note", too_small)
      end do
      if (good .and. touches_for_grid(plan, smooth, n)) then
         do k = 1, 2
            call record%set(trim(films(k))//"_error_note", unresolved_inlet(plan%inlet, plan%finest))
         end do
      end if
      why = better_grid(plan%contact, plan%point, plan%finest)
      if (.not. good .and. why /= "") call record%set("H_c_error_note", why)
      call record%set("error_estimate", trim(merge("two grids", "a priori ", coarser)))
      call report_limits(record, plan, smooth, n, good)
      call record%set("H_c_algebraic_error H_min_algebraic_error", smooth%results(n)%algebraic)
      call record%set("load_beyond load_error", [1.0_dp - m%load/plan%contact%load, m%load_error])
      if (plan%scales%has_size()) call record%set("h_c_m h_c_error_m h_min_m h_min_error_m p_max_Pa", &
         [values(1), error(1) + domain(1), values(2), error(2) + domain(2), values(3)]* &
         [spread(plan%scales%film, 1, 4), plan%scales%pressure])
      call record%set("cycles", smooth%results(n)%cycles)
      call record%set("total_cycles", sum(smooth%results%cycles))
      call record%set("residual", smooth%results(n)%residual)
      call record%set("restarts", smooth%restarts)
   end subroutine report_smooth

   !> Errors of P_max and F, which need three grids: where a pressure spike is not resolved neither has a limit that the
   !> grids could tell, for the viscosity in it carries the friction
   subroutine report_limits(record, plan, smooth, n, good)
      type(record_t), intent(inout) :: record
      type(plan_t), intent(in) :: plan
      type(smooth_contact_t), intent(in) :: smooth
      integer, intent(in) :: n
      logical, intent(in) :: good
      character(len=:), allocatable :: note
      real(dp) :: error(2)
      logical :: known(2)

      error = 0.0_dp
      note = "there is no solution"
      if (good) note = "two coarser grids with a solution are needed"
      known = .false.
      if (good .and. n > 2) then
         associate (r => smooth%results(n - 2:n))
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
      known(2) = known(2) .and. knows_friction(plan, smooth, n)
      associate (m => smooth%results(n)%m)
         error = error + [m%pressure_maximum, m%friction]*plan%domain_cost(1) + [0.0_dp, friction_beyond]
         ! the load that may or may not be at the boundary film
         if (n > 1) error(2) = error(2) + plan%lubricant%boundary_stress*m%load*share_error(smooth%results, n, plan%inlet)
      end associate
      where (.not. known) error = not_known
      call record%set("P_max_error", error(1))
      if (.not. known(1)) call record%set("P_max_error_note", note)
      call record%set("F_error", error(2))
      if (good .and. touches_for_grid(plan, smooth, n)) note = unresolved_inlet(plan%inlet, plan%finest)
      if (.not. known(2)) call record%set("F_error_note", note)
   end subroutine report_limits

   !> Whether friction is known: of the boundary film, too, where the bodies touch, and that they do so on any grid
   pure logical function knows_friction(plan, smooth, n)
      type(plan_t), intent(in) :: plan
      type(smooth_contact_t), intent(in) :: smooth
      integer, intent(in) :: n

      knows_friction = .not. smooth%results(n)%m%touching%load_share > 0.0_dp .or. plan%lubricant%boundary_stress > 0.0_dp
      if (touches_for_grid(plan, smooth, n)) knows_friction = .false.
   end function knows_friction

   !> Whether the bodies touch on a grid that does not resolve the inlet, and may do so for that
   pure logical function touches_for_grid(plan, smooth, n)
      type(plan_t), intent(in) :: plan
      type(smooth_contact_t), intent(in) :: smooth
      integer, intent(in) :: n
      touches_for_grid = .not. plan%inlet%resolves(smooth%results(n)%m, smooth%results(n)%mesh)
   end function touches_for_grid
end module ehl_report_smooth

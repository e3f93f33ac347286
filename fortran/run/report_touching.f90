! SPDX-License-Identifier: BSD-3-Clause
!> Named results of the solid contact at a boundary film: load share with its errors, area, and mass defect
module ehl_report_touching
   use ehl_contact_run, only: contact_run_t, phase_stationary, phase_steps
   use ehl_friction_mean, only: friction_mean_t
   use ehl_kinds, only: dp, not_known, pi
   use ehl_level_result, only: share_error
   use ehl_outcome, only: outcome_converged
   use ehl_plan, only: plan_t
   use ehl_record, only: record_t
   use ehl_report_duty, only: duty_mean
   use ehl_reason, only: reason_boundary_friction, reason_coarser_inlet, reason_coarser_none, reason_inlet, &
                         reason_much_mass_defect, reason_no_solution, reason_none
   use ehl_report_smooth, only: unresolved_solid_contact
   use ehl_resolution, only: has_solution
   use ehl_touching, only: at_depth, known_names, mostly_touching, much_mass_defect, touching_names
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   implicit none (type, external)
   private
   public :: report_touching, why_no_friction, load_share_of

contains

   !> Results of the solid contact, rough if there is roughness; null unless valid, and absent without a boundary film
   subroutine report_touching(record, run, solved, converged, why_no_grid_error)
      type(record_t), intent(inout) :: record
      type(contact_run_t), intent(in) :: run
      !> Whether the smooth contact and the run have converged
      logical, intent(in) :: solved, converged
      !> Why the run on the next coarser grid gives no grid error of a rough contact
      integer, intent(in) :: why_no_grid_error
      !> Numbers as in touching.f90; load share on the next coarser grid; its grid error and its error at the end of the run
      real(dp) :: numbers(size(touching_names)), coarser, error, stop_error
      integer :: note, why
      logical :: dry
      integer :: n

      if (.not. run%plan%lubricant%boundary_film > 0.0_dp) return
      numbers = not_known
      coarser = not_known
      stop_error = not_known
      error = not_known
      n = run%level()
      note = reason_none
      why = reason_coarser_none
      if (run%plan%surfaces%rough()) then
         if (converged) then
            numbers = touching_of(run)
            stop_error = share_stop_error(run)
         end if
         if (run%coarser%outcome == outcome_converged) coarser = run%coarser%load_share
         ! order 1, since the edge of the solid contact lies between two nodes
         error = abs(numbers(1) - coarser)
         why = why_no_grid_error
      else if (solved .and. (converged .or. run%phase /= phase_steps)) then
         numbers = touching_of(run)
         associate (results => run%smooth%results)
            stop_error = max(results(n)%share_algebraic, run%plan%inlet%residual_share_error(results(n)%m, results(n)%residual))
            if (n > 1) then
               if (results(n - 1)%solved) coarser = results(n - 1)%m%touching%load_share
               error = share_error(results, n, run%plan%inlet)
               if (run%phase == phase_steps) error = max(error, duty_mean(run, "load_share_error"))
            end if
         end associate
      end if
      associate (plan => run%plan)
         dry = plan%inlet%is_dry()
         if (.not. ieee_is_finite(numbers(1))) then
            note = reason_no_solution
         else if (.not. plan%surfaces%rough() .and. unresolved_solid_contact(run%plan, run%smooth, run%level())) then
            note = reason_inlet
            numbers = not_known
            error = not_known
         else if (.not. ieee_is_finite(coarser)) then
            note = why
            error = not_known
         else if (plan%surfaces%rough() .and. .not. (dry .or. has_solution(plan%contact, plan%point, run%grid%coarser()))) then
            note = reason_coarser_inlet
            error = not_known
         else if (.not. dry .and. numbers(1) > mostly_touching .and. numbers(3) > much_mass_defect) then
            note = reason_much_mass_defect
            error = not_known
         end if
         numbers([2, 5]) = numbers([2, 5])/plan%contact%area()
         call record%set("boundary_film contact_load_share contact_load_share_error contact_load_share_error_grid "// &
                         "contact_load_share_error_stop", &
                         [plan%lubricant%boundary_film, numbers(1), error + stop_error, error, stop_error])
         call record%set_code("contact_load_share_error_note", note)
         call record%set("contact_area_share mass_defect", numbers(2:3))
         if (.not. plan%lubricant%boundary_limit > 0.0_dp) return
         call record%set("load_share_at_hardness area_share_at_hardness plastic_depth_max_m flowing_load_share_at_hardness", &
                         [numbers(4:5), numbers(6)*plan%scales%film, numbers(7)])
      end associate
   end subroutine report_touching

   !> Why friction is not known; reason_none without solid contact, or if the grid resolves the inlet and the boundary friction is
   !> known
   integer function why_no_friction(run, converged) result(why)
      type(contact_run_t), intent(in) :: run
      logical, intent(in) :: converged
      real(dp) :: share

      why = reason_none
      if (unresolved_solid_contact(run%plan, run%smooth, run%level())) why = reason_inlet
      if (.not. run%plan%lubricant%boundary_film > 0.0_dp .or. run%plan%lubricant%boundary_stress > 0.0_dp) return
      share = 0.0_dp
      if (run%phase == phase_stationary) share = run%stationary%m%touching%load_share
      if (run%phase == phase_steps) share = run%transient%m%touching%load_share
      if (run%phase == phase_steps .and. converged) share = load_share_of(run)
      if (max(share, run%smooth%results(run%level())%m%touching%load_share) > 0.0_dp) why = reason_boundary_friction
   end function why_no_friction

   !> Numbers of reynolds/touching.f90 for a converged run; in time steps their means over the window of the mean friction ratio, or
   !> those of a duty (report_duty.f90), and the maximum depth
   function touching_of(run) result(numbers)
      type(contact_run_t), intent(in) :: run
      real(dp) :: numbers(size(touching_names))
      integer :: k, first

      if (run%phase == phase_steps .and. run%plan%duty%active) then
         numbers = 0.0_dp
         do k = 1, known_names(run%plan%lubricant)
            numbers(k) = duty_mean(run, trim(touching_names(k)))
            if (k == at_depth) numbers(k) = maxval(run%history%column(touching_names(k)))
         end do
      else if (run%phase == phase_steps) then
         first = run%transient%mean%first_of_mean()
         numbers = 0.0_dp
         do k = 1, known_names(run%plan%lubricant)
            associate (values => run%history%column(touching_names(k)))
               numbers(k) = sum(values(first:))/max(1, size(values) - first + 1)
               if (k == at_depth) numbers(k) = maxval(values(first:))
            end associate
         end do
      else if (run%phase == phase_stationary) then
         numbers = run%stationary%m%touching%numbers()
      else
         numbers = run%smooth%results(run%level())%m%touching%numbers()
      end if
   end function touching_of

   !> Load share
   real(dp) function load_share_of(run)
      type(contact_run_t), intent(in) :: run
      real(dp) :: numbers(size(touching_names))

      numbers = touching_of(run)
      load_share_of = numbers(1)
   end function load_share_of

   !> Error of the load share at the end of a transient run, as that of the mean friction ratio; otherwise 0
   real(dp) function share_stop_error(run)
      type(contact_run_t), intent(in) :: run
      type(friction_mean_t) :: mean

      share_stop_error = 0.0_dp
      if (.not. run%phase == phase_steps) return
      mean = run%transient%mean
      mean%values = run%history%column(touching_names(1))
      share_stop_error = mean%uncertainty()
   end function share_stop_error
end module ehl_report_touching

! SPDX-License-Identifier: BSD-3-Clause
!> Position at which a run without a result ended, and numbers for the suggestions of pyehl
module ehl_report_end
   use ehl_contact_run, only: contact_run_t, phase_stationary, phase_steps
   use ehl_kinds, only: dp
   use ehl_outcome, only: outcome_converged, outcome_negative_film, outcome_running
   use ehl_reason, only: reason_small_domain
   use ehl_record, only: record_t
   use ehl_resolution, only: why_no_solution
   implicit none (type, external)
   private
   public :: report_end

   !> Nodes per wavelength needed by waves as high as the film (docs/limits.md); maximum fraction of the variance in shorter waves
   integer, parameter :: enough_nodes = 32
   real(dp), parameter :: max_short_waves = 0.01_dp

contains

   !> Report the end of a run without a result; no entries for other runs
   subroutine report_end(record, run, coarse)
      type(record_t), intent(inout) :: record
      type(contact_run_t), intent(in) :: run
      !> The unfinished run on the coarser grid
      type(contact_run_t), intent(in), optional :: coarse
      real(dp), allocatable :: films(:)

      if (any(run%outcome == [outcome_running, outcome_converged])) return
      call report_place(record, run, "end_")
      if (present(coarse)) call report_place(record, coarse, "coarser_end_")
      associate (plan => run%plan)
         call record%set_code("end_help", merge(why_no_solution(plan%contact, plan%point, plan%finest), reason_small_domain, &
                                                plan%domain_error(1) < 1.0_dp))
         call record%set_detail("surfaces_repeat", merge(1.0_dp, 0.0_dp, &
                                                         plan%surfaces%move() .and. .not. plan%surfaces%pass_once()))
         call record%set_detail("boundary_film_given", merge(1.0_dp, 0.0_dp, plan%lubricant%boundary_film > 0.0_dp))
      end associate
      if (run%phase == phase_steps) then
         if (run%transient%mean%has_change()) call record%set_detail("end_change", run%transient%mean%change())
      end if
      if (run%outcome /= outcome_negative_film .or. .not. run%is_rough()) return
      films = run%history%column("H_min")
      if (size(films) > 0) call record%set_detail("end_film_before", films(size(films)))
      call record%set_detail("end_wave_nodes", real(nodes_of_waves(run), dp))
      call record%set_detail("enough_wave_nodes", real(enough_nodes, dp))
   end subroutine report_end

   !> Position of a run: phase, time of the step or fraction of the roughness, grid, rms residual and cycles
   subroutine report_place(record, run, prefix)
      type(record_t), intent(inout) :: record
      type(contact_run_t), intent(in) :: run
      character(len=*), intent(in) :: prefix
      real(dp) :: numbers(4)

      numbers(1) = run%phase
      numbers(2) = 0.0_dp
      associate (level => run%smooth%results(run%level()))
         numbers(3:) = [level%residual, real(level%cycles, dp)]
      end associate
      if (run%phase == phase_stationary) then
         numbers(2:) = [run%stationary%fraction, run%stationary%residual, real(run%stationary%cycles, dp)]
      else if (run%phase == phase_steps) then
         associate (t => run%transient)
            numbers(2:) = [t%time + t%time_step, t%residual, real(t%cycles, dp)]
            call record%set_detail(prefix//"time", t%time)
         end associate
      end if
      call record%set_detail(prefix//"phase", numbers(1))
      call record%set_detail(prefix//"at", numbers(2))
      call record%set_detail(prefix//"residual", numbers(3))
      call record%set_detail(prefix//"cycles", numbers(4))
      call record%set_detail(prefix//"points", real(run%grid%nx, dp))
      call record%set_detail(prefix//"points_y", real(run%grid%full_ny(), dp))
   end subroutine report_place

   !> Nodes per wavelength of the shortest waves except for a small fraction of the variance; at most `enough_nodes`
   integer function nodes_of_waves(run) result(nodes)
      type(contact_run_t), intent(in) :: run
      integer :: middle, over

      nodes = 1
      over = enough_nodes + 1
      do while (over - nodes > 1)
         middle = (nodes + over)/2
         if (run%plan%surfaces%max_unresolved(run%grid, real(middle, dp)) > max_short_waves) then
            over = middle
         else
            nodes = middle
         end if
      end do
   end function nodes_of_waves
end module ehl_report_end

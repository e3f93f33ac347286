! SPDX-License-Identifier: BSD-3-Clause
!> Where a run without a result ended, and data for suggestions: numbers for a sentence of pyehl
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

   !> Waves as high as the film need so many nodes a wavelength (docs/limits.md); what may be in shorter ones
   integer, parameter :: enough_nodes = 32
   real(dp), parameter :: little = 0.01_dp

contains

   !> No entries for a run that has a result, or has not ended
   subroutine report_end(record, run, coarse)
      type(record_t), intent(inout) :: record
      type(contact_run_t), intent(in) :: run
      !> The run for the grid error, while it runs
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

   !> Position of a run: its phase, time of the step or share of the roughness, grid, residual (rms) and cycles
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
         numbers(2:) = [run%stationary%share, run%stationary%residual, real(run%stationary%cycles, dp)]
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

   !> Nodes per wavelength of the shortest waves, a small share of the variance excepted; at most the number that is enough
   integer function nodes_of_waves(run) result(nodes)
      type(contact_run_t), intent(in) :: run
      integer :: middle, over

      nodes = 1
      over = enough_nodes + 1
      do while (over - nodes > 1)
         middle = (nodes + over)/2
         if (run%plan%surfaces%max_unresolved(run%grid, real(middle, dp)) > little) then
            over = middle
         else
            nodes = middle
         end if
      end do
   end function nodes_of_waves
end module ehl_report_end

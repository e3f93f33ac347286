! SPDX-License-Identifier: BSD-3-Clause
!> The run on the next coarser grid, for the grid error of the friction ratio
submodule (ehl_solver) ehl_coarser_run
   use ehl_outcome, only: outcome_failed
   use ehl_plan_need, only: max_periods
   use ehl_progress, only: end_after
   use ehl_report_touching, only: load_share_of
   use ehl_stopping_criterion, only: min_periods
   implicit none (type, external)

   !> Cost of a step on the next coarser grid over that on the finest: a quarter of the nodes
   real(dp), parameter :: coarse_step = 0.25_dp

contains

   module procedure begin_coarse
      type(status_t) :: status
      type(case_t) :: input
      type(moving_surfaces_t) :: surfaces

      input = self%input
      input%output%frame_interval = 0.0_dp
      input%grid%points = (self%run%grid%nx + 1)/2
      input%grid%points_y = (self%run%grid%full_ny() + 1)/2
      input%grid%target_error = 0.0_dp
      input%time%estimate_error = .false.
      allocate (self%coarse)
      associate (run => self%run, coarse => self%coarse)
         ! the same surfaces, since amplitude_over_film would refer to the film of the coarser grid
         call run%plan%surfaces%transfer(surfaces)
         call make_plan(input, surfaces, coarse%plan, status)
         ! a failed plan may not have taken the surfaces
         call run%plan%surfaces%reclaim(surfaces)
         coarse%plan%heat%active = .false.
         call coarse%begin(status)
         coarse%checkpoint = self%coarse_checkpoint
         if (allocated(run%state_text)) coarse%state_text = run%state_text
         coarse%state_prefix = coarser
         coarse%is_coarser = .true.
         coarse%step_cost = coarse_step
         if (run%phase == phase_steps) then
            coarse%other%earliest = end_after(run, min_periods(run%plan, run%transient%mean))
            coarse%other%latest = end_after(run, real(max_periods(run%plan), dp))
         end if
         coarse%predicted = run%predicted%coarser()
         if (allocated(run%fallback_reason)) coarse%fallback_reason = run%fallback_reason
      end associate
      if (status%failed()) call end_coarse(self, status)
   end procedure begin_coarse

   module procedure solve_coarse
      type(status_t) :: status

      do
         call solve_phase(self%coarse, observer, leave, status)
         if (leave) return
         if (self%coarse%outcome == outcome_running .and. .not. status%failed()) call self%coarse%next_phase(status)
         if (self%coarse%outcome /= outcome_running .or. status%failed()) exit
         call observer%watch(self%coarse, leave)
         if (leave) return
      end do
      call end_coarse(self, status)
   end procedure solve_coarse

   !> Keep the status of the coarser run, and its friction ratio and load share if it converged
   subroutine end_coarse(self, status)
      class(solver_t), intent(inout) :: self
      type(status_t), intent(in) :: status

      associate (coarse => self%coarse, result => self%run%coarser)
         result%outcome = coarse%outcome
         if (status%failed()) then
            result%outcome = outcome_failed
            result%message = status%message
         end if
         if (result%outcome == outcome_converged) then
            result%ratio = coarse%mu_ratio()
            if (self%run%plan%lubricant%boundary_film > 0.0_dp) result%load_share = load_share_of(coarse)
         end if
         self%run%other%done = coarse_step*coarse%transient%step
         self%run%other%seconds = coarse%seconds
         ! report_end needs the waves of a failed run
         call self%run%plan%surfaces%reclaim(coarse%plan%surfaces)
      end associate
      deallocate (self%coarse)
   end subroutine end_coarse
end submodule ehl_coarser_run

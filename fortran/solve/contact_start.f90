! SPDX-License-Identifier: BSD-3-Clause
!> Start of the time steps: from the steady contact ahead of the front of the roughness, from a prediction or from a saved state
submodule (ehl_contact_run) ehl_contact_start
   use ehl_grid_error, only: relative_errors
   use ehl_level_result, only: friction_error
   use ehl_outcome, only: outcome_names
   use ehl_reynolds, only: refresh
   use ehl_status, only: ehl_bad_input
   use ehl_time_levels, only: set_geometry
   implicit none (type, external)

contains

   module procedure begin_steps
      real(dp) :: errors(2)

      ! friction is nearly inverse to the film, and has its relative error: 20 and 19 % (line, M = 100, L = 10, 257 nodes)
      errors = 0.0_dp
      if (self%plan%line) errors = relative_errors(self%plan%contact, self%plan%point, self%grid%hx)
      associate (plan => self%plan, transient => self%transient, n => self%smooth%n, m => self%smooth%results(self%smooth%n)%m)
         ! if a feature passes once, the maximum pressure and the minimum film are results besides the mean friction
         call transient%accuracy%set(self%grid%hx, plan%accuracy, m%friction_newtonian, &
                                     merge(0.0_dp, friction_error(self%smooth%results, n, errors(1)), &
                                           plan%surfaces%pass_once() .or. plan%duty%active))
         call transient%policy%set(plan%step_cycle, plan%coarsening_may_change, plan%max_cycles)
         call transient%start(self%hierarchy%levels(n), n, plan%contact, plan%surfaces, plan%duty, plan%skip_start, &
                              m%friction, status)
         transient%residual = self%smooth%results(n)%residual
         if (status%failed()) return
         if (plan%predicted_start) call begin_predicted(self, n, status)
         if (status%failed()) return
         call self%hierarchy%prepare_steps(plan%scheme, transient%time_step, status)
      end associate
      if (status%failed()) return
      self%phase = phase_steps
      call self%frames%start()
      if (self%checkpoint%found()) call take_state(self, status)
   end procedure begin_steps

   !> Start from the prediction, unless a reason for the fallback is known
   subroutine begin_predicted(self, n, status)
      class(contact_run_t), intent(inout) :: self
      integer, intent(in) :: n
      type(status_t), intent(inout) :: status
      logical :: done

      if (allocated(self%fallback_reason)) return
      if (.not. allocated(self%predicted%pressure)) then
         call status%fail(ehl_bad_input, "time.start = 'prediction': ehl makes no predictions"//new_line("a")// &
                          "expected: time.start = 'front', or 'pyehl run'")
         return
      end if
      call self%transient%fill(self%hierarchy%levels(n), self%plan%surfaces, self%predicted, done, status)
      if (status%failed()) return
      if (.not. done) self%fallback_reason = "the film would be negative"
   end subroutine begin_predicted

   module procedure restart_with_front
      call self%checkpoint%forget()
      self%fallback_reason = "the first steps from it ended with '"//trim(outcome_names(outcome))//"'"
      associate (level => self%hierarchy%levels(self%smooth%n))
         self%transient%rr = 0.0_dp
         call set_geometry(level, self%plan%contact, self%transient%rr)
         level%p = self%p_smooth
         level%h00 = self%h00_smooth
         call refresh(level)
      end associate
      call self%begin_history()
      call begin_steps(self, status)
      self%outcome = outcome_running
   end procedure restart_with_front

   !> Resume the time steps from the saved state
   subroutine take_state(self, status)
      class(contact_run_t), intent(inout) :: self
      type(status_t), intent(inout) :: status
      logical :: same

      call self%checkpoint%read(self%transient, self%history, self%frames, self%grid, self%seconds, self%coarser, &
                                self%fallback_reason, status)
      if (status%failed()) return
      call self%transient%restore(self%hierarchy%levels(self%smooth%n), self%plan%surfaces, same)
      if (.not. same) then
         call status%fail(ehl_bad_input, self%checkpoint%path//": error: the film of this state does not follow from "// &
                          "its pressure"//new_line("a")//"expected: the surface and the program version that wrote it")
         return
      end if
      call self%checkpoint%end_resuming()
      self%outcome = transient_outcome(self%plan, self%transient)
   end subroutine take_state
end submodule ehl_contact_start

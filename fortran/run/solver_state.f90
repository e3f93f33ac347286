! SPDX-License-Identifier: BSD-3-Clause
!> How a transient run is kept on disk and taken up again
submodule (ehl_solver) ehl_solver_state
   use ehl_case_writer, only: case_text
   use ehl_checkpoint, only: coarser
   use ehl_stopping_criterion, only: transient_outcome
   use ehl_status, only: ehl_bad_input
   implicit none (type, external)

contains

   module subroutine save_state(self, folder, status)
      class(solver_t), intent(inout) :: self
      character(len=*), intent(in) :: folder
      type(status_t), intent(inout) :: status
      character(len=:), allocatable :: text

      text = step_text(self%input)
      if (associated(self%coarse)) call save_as(self%coarse, folder//coarser, text, status)
      call save_as(self, folder, text, status)
   end subroutine save_state

   !> Write the state of one run under names that begin with a prefix
   subroutine save_as(self, prefix, text, status)
      type(solver_t), intent(inout) :: self
      character(len=*), intent(in) :: prefix, text
      type(status_t), intent(inout) :: status

      if (self%steps_made() == 0) return
      call self%checkpoint%write(prefix, text, self%transient, self%history, self%frames, &
                                 [self%step_seconds, self%coarse_mean, real(self%coarse_outcome, dp)], status)
   end subroutine save_as

   !> The case as text, with the defaults of all keys that change no step: when to stop, threads, what to
   !> write. A run may go on with others of them.
   function step_text(input) result(text)
      type(case_t), intent(in) :: input
      character(len=:), allocatable :: text
      type(case_t) :: plain, default

      plain = input
      plain%solver%threads = default%solver%threads
      plain%solver%max_cycles = default%solver%max_cycles
      plain%time%tolerance = default%time%tolerance
      plain%time%max_periods = default%time%max_periods
      plain%time%steps = default%time%steps
      plain%time%estimate_error = default%time%estimate_error
      plain%psd = default%psd
      plain%output = default%output
      plain%output%frame_interval = input%output%frame_interval
      if (allocated(plain%given)) deallocate (plain%given)
      text = case_text(plain)
   end function step_text

   module subroutine resume(self, folder, note, status)
      class(solver_t), intent(inout) :: self
      character(len=*), intent(in) :: folder
      character(len=:), allocatable, intent(out) :: note
      type(status_t), intent(inout) :: status
      character(len=:), allocatable :: text

      text = step_text(self%input)
      call self%checkpoint%find(folder, text, note, status)
      if (status%failed() .or. self%checkpoint%found()) return
      call self%coarse_checkpoint%find(folder//coarser, text, note, status)
   end subroutine resume

   module subroutine take_state(self, status)
      type(solver_t), intent(inout) :: self
      type(status_t), intent(inout) :: status
      real(dp) :: numbers(3)
      logical :: same

      call self%checkpoint%read(self%transient, self%history, self%frames, self%grid, numbers, status)
      if (status%failed()) return
      self%step_seconds = numbers(1)
      self%coarse_mean = numbers(2)
      self%coarse_outcome = nint(numbers(3))
      call self%transient%restore(self%hierarchy%levels(self%steady%n), self%plan%surfaces, same)
      if (.not. same) then
         call status%fail(ehl_bad_input, self%checkpoint%path//": error: the film of this state does not follow from "// &
                          "its pressure"//new_line("a")//"expected: the surface and the program that it was made with")
         return
      end if
      self%outcome = transient_outcome(self%plan, self%transient)
   end subroutine take_state
end submodule ehl_solver_state

! SPDX-License-Identifier: BSD-3-Clause
!> Observer of `ehl`: stops on a signal, saves states, prints progress lines
module ehl_terminal
   use, intrinsic :: iso_fortran_env, only: error_unit
   use ehl_checkpoint_folder, only: checkpoint_folder_t
   use ehl_clock, only: clock_t, start_clock
   use ehl_contact_run, only: contact_run_t
   use ehl_kinds, only: dp
   use ehl_observer, only: observer_t
   use ehl_progress, only: progress_line
   use ehl_signals, only: stop_requested
   use ehl_status, only: status_t
   use ehl_streams, only: put_line
   implicit none (type, external)
   private
   public :: terminal_t

   !> Seconds between progress lines
   real(dp), parameter :: progress_interval = 2.0_dp

   type, extends(observer_t) :: terminal_t
      type(checkpoint_folder_t) :: checkpoints
      !> Whether to print nothing; whether writing to standard output failed: the run then continues and ends with a failure
      logical :: quiet = .false., failed = .false.
      type(clock_t) :: since_line
   contains
      procedure :: watch
      procedure :: say
   end type terminal_t

contains

   !> Save the state and print a line when due, and stop on a signal
   subroutine watch(self, run, leave)
      class(terminal_t), intent(inout) :: self
      type(contact_run_t), intent(inout) :: run
      logical, intent(out) :: leave
      type(status_t) :: saving

      if (self%checkpoints%is_due()) call self%checkpoints%save(run, saving)
      ! a run continues if saving fails
      if (saving%failed()) write (error_unit, "(a)") saving%message
      if (self%since_line%seconds() > progress_interval) then
         call self%say(progress_line(run, run%outcome, .false.))
         self%since_line = start_clock()
      end if
      leave = stop_requested()
   end subroutine watch

   !> Print a line, unless --quiet was given
   subroutine say(self, text)
      class(terminal_t), intent(inout) :: self
      character(len=*), intent(in) :: text

      if (self%quiet .or. self%failed) return
      self%failed = .not. put_line(text)
      if (self%failed) write (error_unit, "(a)") "standard output: error: cannot be written"
   end subroutine say
end module ehl_terminal

! SPDX-License-Identifier: BSD-3-Clause
!> ehl CASE.nml -o DIR: solve a case and write the result folder
program ehl
   use, intrinsic :: iso_fortran_env, only: error_unit
   use ehl_arguments, only: arguments_t, get_arguments, help_text
   use ehl_case, only: case_t, surface_case_t
   use ehl_read_case, only: read_case_file
   use ehl_clock, only: clock_t, start_clock
   use ehl_checkpoint_folder, only: checkpoint_path, find_checkpoint, checkpoint_folder_t
   use ehl_conclusion, only: conclusion, resumption
   use ehl_destination, only: destination_t
   use ehl_kinds, only: dp
   use ehl_plan_need, only: making_need
   use ehl_plan_text, only: plan_text
   use ehl_record, only: record_t
   use ehl_result_folder, only: result_names, write_results
   use ehl_signals, only: stop_wanted, watch_signals
   use ehl_solver, only: solver_t
   use ehl_status, only: ehl_bad_input, status_t
   use ehl_streams, only: guard_streams, put_line
   use ehl_text, only: newline
   use ehl_version, only: build_text, version
   implicit none (type, external)

   integer, parameter :: exit_ok = 0, exit_failed = 1, exit_usage = 2, exit_interrupted = 130
   !> Seconds between progress lines
   real(dp), parameter :: progress_interval = 2.0_dp
   type(arguments_t) :: arguments
   type(case_t) :: input
   type(solver_t) :: solver
   type(checkpoint_folder_t) :: checkpoints
   type(destination_t) :: destination
   type(status_t) :: status
   type(clock_t) :: clock
   type(record_t) :: summary
   character(len=:), allocatable :: note, case_file, fresh, hint
   real(dp), allocatable :: heights(:, :), second_heights(:, :)
   !> Whether standard output could not be written: a run goes on then, and ends with a failure
   logical :: output_failed = .false.

   call guard_streams(status)
   call end_if_failed()
   call get_arguments(arguments, status)
   call end_if_failed()
   if (arguments%help .or. arguments%version) then
      arguments%quiet = .false.
      if (arguments%help) call say(without_end(help_text()))
      if (arguments%version) call say("ehl " // version // newline // build_text())
      call end_if_mute()
      stop exit_ok, quiet=.true.
   end if

   clock = start_clock()
   if (arguments%resume /= "") then
      call find_checkpoint(arguments%resume, case_file, heights, second_heights, status)
      call end_if_failed()
      if (arguments%case_file == "") arguments%case_file = case_file
   end if
   call read_case_file(arguments%case_file, arguments%options, input, status)
   call end_if_failed()
   destination%folder = arguments%folder
   destination%kind = "solution"
   destination%names = result_names
   destination%inputs = arguments%case_file // newline // trim(input%surface%file) // newline // &
                        trim(input%second_surface%file) // newline // trim(input%lubricant%table) // newline
   destination%kept = ""
   destination%force = arguments%force
   call destination%check(status)
   call end_if_failed()
   call watch_signals()
   if (.not. allocated(heights)) allocate (heights(0, 0), second_heights(0, 0))
   call say_making(input%surface)
   call say_making(input%second_surface)
   call solver%start(input, status, heights, second_heights)
   if (status%code == ehl_bad_input) status%message = arguments%case_file//": "//status%message
   call end_if_failed()
   call say(plan_text(solver%plan))
   call end_if_mute()
   if (arguments%resume /= "") then
      call solver%resume(checkpoint_path(arguments%resume), note, status)
      call end_if_failed()
      if (note == "") note = "there is no state yet: the run begins at its beginning"
      call say("resume: " // note)
   end if
   call checkpoints%open(arguments%folder, input, solver, arguments%resume, heights, second_heights, note, status)
   call end_if_failed()
   deallocate (heights, second_heights)
   if (note /= "") call say("note: " // note)
   call advance_to_the_end()
   if (.not. solver%converged()) call keep_state(at_once=.true.)
   call destination%begin(fresh, status)
   call end_if_failed()
   call write_results(fresh, input, solver, clock%seconds(), status)
   call end_if_failed()
   call destination%finish(fresh, status)
   call end_if_failed()
   call say("results: " // arguments%folder)
   if (solver%converged()) call checkpoints%close()
   call checkpoints%release()
   if (solver%converged()) stop merge(exit_failed, exit_ok, output_failed), quiet=.true.
   summary = solver%summary()
   hint = resumption(summary%text("status"), "ehl")
   if (checkpoints%has_state() .and. hint /= "") call say("state: " // checkpoint_path(arguments%folder) // newline &
                                                     // hint // arguments%folder)
   if (stop_wanted()) stop exit_interrupted, quiet=.true.
   stop exit_failed, quiet=.true.

contains

   !> Cycle by cycle or step by step to the end
   subroutine advance_to_the_end()
      type(clock_t) :: since_line

      since_line = start_clock()
      do while (.not. solver%done())
         if (stop_wanted()) then
            call solver%interrupt()
         else
            call solver%advance(status)
            call end_if_failed()
            call keep_state(at_once=.false.)
         end if
         if (since_line%seconds() > progress_interval) then
            call say(solver%progress())
            since_line = start_clock()
         end if
      end do
      call say(solver%progress())
      call say(conclusion(solver%summary()))
   end subroutine advance_to_the_end

   !> Save the state, now or if its time has come. A run does not end because that fails.
   subroutine keep_state(at_once)
      logical, intent(in) :: at_once
      type(status_t) :: saving

      if (at_once) then
         call checkpoints%save(solver, saving)
      else
         call checkpoints%tick(solver, saving)
      end if
      if (saving%failed()) write (error_unit, "(a)") saving%message
   end subroutine keep_state

   !> What it takes to make a fractal surface
   subroutine say_making(s)
      type(surface_case_t), intent(in) :: s

      if (s%kind /= "fractal") return
      if (making_need(s%pixels) /= "") call say(making_need(s%pixels))
   end subroutine say_making

   !> A text without the line end at its end
   pure function without_end(text) result(answer)
      character(len=*), intent(in) :: text
      character(len=:), allocatable :: answer
      answer = text(:len(text) - 1)
   end function without_end

   !> A line to the terminal, unless it shall be quiet
   subroutine say(text)
      character(len=*), intent(in) :: text

      if (arguments%quiet .or. output_failed) return
      output_failed = .not. put_line(text)
      if (output_failed) write (error_unit, "(a)") "standard output: error: cannot be written"
   end subroutine say

   !> End where the first lines have found no way out
   subroutine end_if_mute()
      if (output_failed) stop exit_failed, quiet=.true.
   end subroutine end_if_mute

   !> Report a failure and end the program
   subroutine end_if_failed()
      if (.not. status%failed()) return
      write (error_unit, "(a)") status%message
      call checkpoints%release()
      if (status%code == ehl_bad_input) stop exit_usage, quiet=.true.
      stop exit_failed, quiet=.true.
   end subroutine end_if_failed
end program ehl

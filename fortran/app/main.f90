! SPDX-License-Identifier: BSD-3-Clause
!> ehl CASE.nml -o DIR: solve a case and write the result folder
program ehl
   use, intrinsic :: iso_fortran_env, only: error_unit
   use ehl_arguments, only: arguments_t, get_arguments, help_text
   use ehl_case, only: case_t
   use ehl_read_case, only: read_case_file
   use ehl_clock, only: clock_t, start_clock
   use ehl_checkpoint_folder, only: checkpoint_path, find_checkpoint
   use ehl_destination, only: destination_t
   use ehl_kinds, only: dp
   use ehl_memory, only: amount
   use ehl_outcome, only: outcome_cycle_limit, outcome_failed, outcome_interrupted, outcome_unsettled
   use ehl_plan_need, only: bytes_needed
   use ehl_result_folder, only: result_names, write_results
   use ehl_signals, only: stop_requested, watch_signals
   use ehl_solver, only: solver_t
   use ehl_status, only: ehl_bad_input, status_t
   use ehl_streams, only: guard_streams
   use ehl_terminal, only: terminal_t
   use ehl_text, only: newline, to_text
   use ehl_version, only: build_text, version
   implicit none (type, external)

   integer, parameter :: exit_ok = 0, exit_failed = 1, exit_usage = 2, exit_interrupted = 130
   type(arguments_t) :: arguments
   type(case_t) :: input
   type(solver_t) :: solver
   type(terminal_t) :: terminal
   type(destination_t) :: destination
   type(status_t) :: status, saving
   type(clock_t) :: clock
   character(len=:), allocatable :: note, case_file, fresh
   real(dp), allocatable :: heights(:, :), second_heights(:, :)

   call guard_streams(status)
   call end_if_failed()
   call get_arguments(arguments, status)
   call end_if_failed()
   terminal%quiet = arguments%quiet .and. .not. (arguments%help .or. arguments%version)
   if (arguments%help .or. arguments%version) then
      if (arguments%help) call terminal%say(without_end(help_text()))
      if (arguments%version) call terminal%say("ehl " // version // newline // build_text())
      call end_if_unprinted()
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
                        trim(input%second_surface%file) // newline // trim(input%lubricant%table) // newline // &
                        trim(input%duty%file) // newline
   destination%kept = ""
   destination%force = arguments%force
   call destination%check(status)
   call end_if_failed()
   call watch_signals()
   if (.not. allocated(heights)) allocate (heights(0, 0), second_heights(0, 0))
   call solver%start(input, status, heights, second_heights)
   if (status%code == ehl_bad_input) status%message = arguments%case_file//": "//status%message
   call end_if_failed()
   associate (plan => solver%run%plan)
      call terminal%say(to_text(plan%finest%nx)//" x "//to_text(plan%finest%full_ny())//" nodes, "//to_text(plan%levels)// &
                        " levels, about "//amount(bytes_needed(plan, plan%threads))//" of memory")
   end associate
   call end_if_unprinted()
   if (arguments%resume /= "") then
      call solver%resume(checkpoint_path(arguments%resume), note, status)
      call end_if_failed()
      if (note == "") note = "there is no state yet: the run starts from the beginning"
      call terminal%say("resume: " // note)
   end if
   call terminal%checkpoints%open(arguments%folder, input, solver, arguments%resume, heights, second_heights, note, status)
   call end_if_failed()
   deallocate (heights, second_heights)
   if (note /= "") call terminal%say("note: " // note)
   terminal%since_line = start_clock()
   call solver%solve(terminal, status)
   call end_if_failed()
   call solver%interrupt()
   call terminal%say(solver%progress())
   if (.not. solver%converged()) call terminal%checkpoints%save(solver, saving)
   if (saving%failed()) write (error_unit, "(a)") saving%message
   call destination%begin(fresh, status)
   call end_if_failed()
   call write_results(fresh, input, solver, status, clock%seconds())
   call end_if_failed()
   call destination%finish(fresh, status)
   call end_if_failed()
   call terminal%say("results: " // arguments%folder)
   if (solver%converged()) call terminal%checkpoints%close()
   call terminal%checkpoints%release()
   if (solver%converged()) stop merge(exit_failed, exit_ok, terminal%failed), quiet=.true.
   ! suggest resuming unless the run would end in the same way
   if (terminal%checkpoints%has_state() .and. any(solver%outcome() == [outcome_interrupted, outcome_failed, outcome_unsettled, &
                                                                       outcome_cycle_limit])) then
      note = "to resume"
      if (solver%outcome() == outcome_unsettled) note = "to continue with a larger time.max_periods or time.steps (--set)"
      if (solver%outcome() == outcome_cycle_limit) note = "to continue with a larger solver.max_cycles (--set)"
      call terminal%say("state: " // checkpoint_path(arguments%folder) // newline // note // ": ehl --resume " // arguments%folder)
   end if
   if (stop_requested()) stop exit_interrupted, quiet=.true.
   stop exit_failed, quiet=.true.

contains

   !> A text without its last newline
   pure function without_end(text) result(answer)
      character(len=*), intent(in) :: text
      character(len=:), allocatable :: answer
      answer = text(:len(text) - 1)
   end function without_end

   !> End the program if its first lines could not be printed
   subroutine end_if_unprinted()
      if (terminal%failed) stop exit_failed, quiet=.true.
   end subroutine end_if_unprinted

   !> Report a failure and end the program
   subroutine end_if_failed()
      if (.not. status%failed()) return
      write (error_unit, "(a)") status%message
      call terminal%checkpoints%release()
      if (status%code == ehl_bad_input) stop exit_usage, quiet=.true.
      stop exit_failed, quiet=.true.
   end subroutine end_if_failed
end program ehl

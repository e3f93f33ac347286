! SPDX-License-Identifier: BSD-3-Clause
!> tester SUITE: run one suite of unit tests
program tester
   use, intrinsic :: iso_fortran_env, only: error_unit, output_unit
   use check, only: n_checks, n_failures
   use test_alcouffe, only: run_alcouffe
   use test_checksum, only: run_checksum
   use test_case, only: run_case
   use test_deflection, only: run_deflection
   use test_flow, only: run_flow
   use test_friction, only: run_friction
   use test_lubricant, only: run_lubricant
   use test_mean, only: run_mean
   use test_policy, only: run_policy
   use test_predictor, only: run_predictor
   use test_record, only: run_record
   use test_lock, only: run_lock
   use test_reynolds, only: run_reynolds
   use test_solver, only: run_solver
   use test_surfaces, only: run_surfaces
   use test_text, only: run_text
   use test_transient, only: run_transient
   implicit none (type, external)
   character(len=32) :: suite

   call get_command_argument(1, suite)
   select case (suite)
   case ("text")
      call run_text()
   case ("checksum")
      call run_checksum()
   case ("record")
      call run_record()
   case ("reynolds")
      call run_reynolds()
   case ("lock")
      call run_lock()
   case ("case")
      call run_case()
   case ("deflection")
      call run_deflection()
   case ("alcouffe")
      call run_alcouffe()
   case ("mean")
      call run_mean()
   case ("surfaces")
      call run_surfaces()
   case ("flow")
      call run_flow()
   case ("friction")
      call run_friction()
   case ("lubricant")
      call run_lubricant()
   case ("policy")
      call run_policy()
   case ("predictor")
      call run_predictor()
   case ("transient")
      call run_transient()
   case ("solver")
      call run_solver()
   case default
      write (error_unit, "(3a)") "tester: no suite '", trim(suite), "'"
      stop 2, quiet=.true.
   end select
   write (output_unit, "(2a, i0, a, i0, a)") trim(suite), ": ", n_checks, " checks, ", n_failures, " failed"
   if (n_failures > 0 .or. n_checks == 0) stop 1, quiet=.true.
end program tester

! SPDX-License-Identifier: BSD-3-Clause
!> Example of a program that uses the library: solve a case, get a field and the results
program example
   use, intrinsic :: iso_fortran_env, only: error_unit, output_unit
   use ehl_case, only: case_t
   use ehl_read_case, only: read_case
   use ehl_grid, only: grid_t
   use ehl_kinds, only: dp
   use ehl_record, only: record_t
   use ehl_solver, only: solver_t
   use ehl_status, only: status_t
   implicit none (type, external)

   character(len=*), parameter :: text = "&contact moes_m = 200.0 moes_l = 10.0 /" // new_line("a") // &
                                         "&grid points = 65 /"
   type(case_t) :: input
   type(solver_t) :: solver
   type(status_t) :: status
   type(grid_t) :: grid
   type(record_t) :: results
   real(dp), allocatable :: pressure(:, :)

   ! namelist text, a name for messages, options group.key=value, one per line
   call read_case(text, "example", "solver.threads=1", input, status)
   call end_if_failed()
   call solver%start(input, status)
   call end_if_failed()
   do while (.not. solver%done())
      ! one multigrid cycle, or one time step
      call solver%advance(status)
      call end_if_failed()
   end do

   grid = solver%finest()
   allocate (pressure(grid%nx, grid%full_ny()))
   call solver%field("P", pressure, status)
   call end_if_failed()
   results = solver%results()
   write (output_unit, "(a)") solver%progress(), results%to_json()
   if (.not. solver%converged() .or. maxval(pressure) < 1.0_dp) error stop 1

contains

   !> Errors are values: the calling program decides
   subroutine end_if_failed()
      if (.not. status%failed()) return
      write (error_unit, "(a)") status%message
      error stop 2
   end subroutine end_if_failed
end program example

! SPDX-License-Identifier: BSD-3-Clause
!> Solvers for Python, by number.
!>
!> The modules for Python are in the small part of Fortran that f2py reads. No arithmetic in them:
!> every routine hands its arguments on, and ends in a status and a message. Only the long
!> routines release Python's lock (threadsafe): gfortran keeps the lengths of text that functions
!> return in static memory, so that routines that make text must not run side by side.
module ehl_f2py_solver
   use, intrinsic :: iso_c_binding, only: c_double, c_int
   use ehl_case, only: case_t
   use ehl_case_reader, only: read_case
   use ehl_grid, only: grid_t
   use ehl_handles, only: drop_handle, new_handle, run_of, run_t
   use ehl_result_folder, only: write_results
   use ehl_ratio_error, only: waves_t
   use ehl_record, only: record_t
   use ehl_reply, only: reply
   use ehl_status, only: ehl_bad_input, status_t
   implicit none (type, external)
   private
   public :: open_case, close_case, advance, interrupt, describe, work, take_prediction
   public :: grid_shape, axes, field, write_output

contains

   !> Start a solver on the text of a case; with has_heights and has_second on the surfaces heights(nx, ny) and
   !> second(mx, my) [m] in place of files
   subroutine open_case(text, origin, has_heights, nx, ny, heights, has_second, mx, my, second, handle, stat, message)
      character(len=*), intent(in) :: text, origin
      integer(c_int), intent(in) :: has_heights, nx, ny, has_second, mx, my
      real(c_double), intent(inout) :: heights(nx, ny), second(mx, my)
      integer(c_int), intent(out) :: handle, stat
      character(len=4096), intent(out) :: message
      type(case_t), target :: input
      type(run_t), pointer :: run
      type(status_t) :: status, closing

      handle = 0
      call read_case(text, origin, "", input, status)
      if (.not. status%failed()) call new_handle(handle, run, status)
      if (.not. status%failed()) then
         run%input = input
         associate (n => merge(nx, 0, has_heights /= 0), m => merge(mx, 0, has_second /= 0))
            call run%solver%start(input, status, heights(:n, :), second(:m, :))
         end associate
         if (status%failed()) call drop_handle(handle, closing)
      end if
      call reply(status, stat, message)
   end subroutine open_case

   !> Free a solver
   subroutine close_case(handle, stat, message)
      integer(c_int), intent(in) :: handle
      integer(c_int), intent(out) :: stat
      character(len=4096), intent(out) :: message
      type(status_t) :: status

      call drop_handle(handle, status)
      call reply(status, stat, message)
   end subroutine close_case

   !> One cycle or step; done is 1 when there is nothing left to do
   subroutine advance(handle, done, converged, stat, message)
      integer(c_int), intent(in) :: handle
      integer(c_int), intent(out) :: done, converged, stat
      character(len=4096), intent(out) :: message
      !f2py threadsafe
      type(run_t), pointer :: run
      type(status_t) :: status

      done = 0
      converged = 0
      call run_of(handle, run, status)
      if (.not. status%failed()) then
         if (.not. run%solver%done()) call run%solver%advance(status)
         if (run%solver%done()) done = 1
         if (run%solver%converged()) converged = 1
      end if
      call reply(status, stat, message)
   end subroutine advance

   !> Stop: what there is stays readable
   subroutine interrupt(handle, stat, message)
      integer(c_int), intent(in) :: handle
      integer(c_int), intent(out) :: stat
      character(len=4096), intent(out) :: message
      type(run_t), pointer :: run
      type(status_t) :: status

      call run_of(handle, run, status)
      if (.not. status%failed()) call run%solver%interrupt()
      call reply(status, stat, message)
   end subroutine interrupt

   !> The "plan" in a few lines, one line of "progress", the "conclusion" of a run that has ended, or the "summary" as JSON
   subroutine describe(handle, what, text, stat, message)
      integer(c_int), intent(in) :: handle
      character(len=*), intent(in) :: what
      character(len=32768), intent(out) :: text
      integer(c_int), intent(out) :: stat
      character(len=4096), intent(out) :: message
      type(run_t), pointer :: run
      type(record_t) :: record
      type(status_t) :: status

      text = ""
      call run_of(handle, run, status)
      if (.not. status%failed()) then
         select case (what)
         case ("plan")
            text = run%solver%describe()
         case ("progress")
            text = run%solver%progress()
         case ("conclusion")
            text = run%solver%conclusion()
         case default
            record = run%solver%summary()
            text = record%to_json()
         end select
      end if
      call reply(status, stat, message)
   end subroutine describe

   !> How much of a transient run is done, and how much there is until its earliest and its latest end, in time
   !> steps; both are 0 where it is not known
   subroutine work(handle, done, earliest, latest, stat, message)
      integer(c_int), intent(in) :: handle
      real(c_double), intent(out) :: done, earliest, latest
      integer(c_int), intent(out) :: stat
      character(len=4096), intent(out) :: message
      type(run_t), pointer :: run
      type(status_t) :: status

      done = 0.0_c_double
      earliest = 0.0_c_double
      latest = 0.0_c_double
      call run_of(handle, run, status)
      if (.not. status%failed()) call run%solver%work(done, earliest, latest)
      call reply(status, stat, message)
   end subroutine work

   !> Hand over what is predicted of mu_ratio: its parts in waves that the grid leaves out, and in those that it does not
   !> resolve; NaN where there is no prediction, and why
   subroutine take_prediction(handle, left_out, unresolved, why, stat, message)
      integer(c_int), intent(in) :: handle
      real(c_double), intent(in) :: left_out, unresolved
      character(len=*), intent(in) :: why
      integer(c_int), intent(out) :: stat
      character(len=4096), intent(out) :: message
      type(run_t), pointer :: run
      type(status_t) :: status

      call run_of(handle, run, status)
      if (.not. status%failed()) run%solver%waves = waves_t(.true., left_out, unresolved, why)
      call reply(status, stat, message)
   end subroutine take_prediction

   !> Nodes of the whole (unfolded) finest grid
   subroutine grid_shape(handle, nx, ny, stat, message)
      integer(c_int), intent(in) :: handle
      integer(c_int), intent(out) :: nx, ny, stat
      character(len=4096), intent(out) :: message
      type(run_t), pointer :: run
      type(status_t) :: status
      type(grid_t) :: grid

      nx = 0
      ny = 0
      call run_of(handle, run, status)
      if (.not. status%failed()) then
         grid = run%solver%finest()
         nx = grid%nx
         ny = grid%full_ny()
      end if
      call reply(status, stat, message)
   end subroutine grid_shape

   !> Coordinates of the nodes in Hertz radii
   subroutine axes(handle, nx, ny, x, y, stat, message)
      integer(c_int), intent(in) :: handle
      integer(c_int), intent(in) :: nx, ny
      real(c_double), intent(inout) :: x(nx), y(ny)
      integer(c_int), intent(out) :: stat
      character(len=4096), intent(out) :: message
      type(run_t), pointer :: run
      type(status_t) :: status
      type(grid_t) :: grid
      integer :: i

      call run_of(handle, run, status)
      if (.not. status%failed()) call check_shape(run, nx, ny, status)
      if (.not. status%failed()) then
         grid = run%solver%finest()
         x = grid%x([(i, i=1, nx)])
         y = grid%y([(i, i=1, ny)] - (ny - grid%ny))
      end if
      call reply(status, stat, message)
   end subroutine axes

   !> Field 'P' or 'H' on the whole finest grid
   subroutine field(handle, name, nx, ny, values, stat, message)
      integer(c_int), intent(in) :: handle
      character(len=*), intent(in) :: name
      integer(c_int), intent(in) :: nx, ny
      real(c_double), intent(inout) :: values(nx, ny)
      integer(c_int), intent(out) :: stat
      character(len=4096), intent(out) :: message
      type(run_t), pointer :: run
      type(status_t) :: status

      call run_of(handle, run, status)
      if (.not. status%failed()) call check_shape(run, nx, ny, status)
      if (.not. status%failed()) call run%solver%field(name, values, status)
      call reply(status, stat, message)
   end subroutine field

   !> Write the files of the result into an empty folder
   subroutine write_output(handle, folder, stat, message)
      integer(c_int), intent(in) :: handle
      character(len=*), intent(in) :: folder
      integer(c_int), intent(out) :: stat
      character(len=4096), intent(out) :: message
      type(run_t), pointer :: run
      type(status_t) :: status

      call run_of(handle, run, status)
      if (.not. status%failed()) call write_results(folder, run%input, run%solver, run%clock%seconds(), status)
      call reply(status, stat, message)
   end subroutine write_output

   !> Arrays must have the shape of the grid
   subroutine check_shape(run, nx, ny, status)
      type(run_t), intent(in) :: run
      integer(c_int), intent(in) :: nx, ny
      type(status_t), intent(inout) :: status
      type(grid_t) :: grid

      grid = run%solver%finest()
      if (nx == grid%nx .and. ny == grid%full_ny()) return
      call status%fail(ehl_bad_input, "the arrays do not have the shape of the grid")
   end subroutine check_shape
end module ehl_f2py_solver

! SPDX-License-Identifier: BSD-3-Clause
!> Interface to the solvers for Python, which identifies them by handles.
!>
!> The modules for Python use the subset of Fortran that f2py reads. Their routines pass their arguments on, and return a status and
!> a message if they can fail. Only long routines release Python's lock (threadsafe). These must not call functions that return an
!> allocatable text, whose length gfortran keeps in static memory.
module ehl_f2py_solver
   use, intrinsic :: iso_c_binding, only: c_double, c_int
   use ehl_case, only: case_t
   use ehl_read_case, only: read_case
   use ehl_checkpoint_folder, only: checkpoint_path
   use ehl_grid, only: grid_t
   use ehl_handles, only: drop_handle, new_handle, put_text, fitted, reply, run_of, run_t
   use ehl_plan_record, only: plan_record
   use ehl_result_folder, only: write_results
   use ehl_record, only: record_t
   use ehl_status, only: ehl_bad_input, status_t
   implicit none (type, external)
   private
   public :: open_case, close_case, advance, interrupt, write_files, resume, keep_states, save_state, clear_states
   public :: results, progress, work
   public :: grid_shape, axes, field

contains

   !> Start a solver with the text of a case; if has_heights or has_second is set, heights(nx, ny) or second(mx, my) [m] replace the
   !> files of the surfaces
   subroutine open_case(text, origin, has_heights, nx, ny, heights, has_second, mx, my, second, handle, stat, message)
      character(len=*), intent(in) :: text, origin
      integer(c_int), intent(in) :: has_heights, nx, ny, has_second, mx, my
      real(c_double), intent(inout) :: heights(nx, ny), second(mx, my)
      integer(c_int), intent(out) :: handle, stat
      character(len=4096), intent(out) :: message
      type(case_t) :: input
      type(run_t), pointer :: run
      type(status_t) :: status, closing

      handle = 0
      call read_case(text, origin, "", input, status)
      if (.not. status%failed()) call new_handle(handle, run, status)
      if (.not. status%failed()) then
         run%input = input
         run%input%text = text
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

   !> Make one cycle or time step; done is 1 at the end of the run
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

   !> Interrupt a run; its results remain readable
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

   !> Write the files of a result except its summary into an empty folder
   subroutine write_files(handle, folder, stat, message)
      integer(c_int), intent(in) :: handle
      character(len=*), intent(in) :: folder
      integer(c_int), intent(out) :: stat
      character(len=4096), intent(out) :: message
      type(run_t), pointer :: run
      type(status_t) :: status

      call run_of(handle, run, status)
      if (.not. status%failed()) call write_results(folder, run%input, run%solver, status)
      call reply(status, stat, message)
   end subroutine write_files

   !> Resume from the newest state of the run with these results, before the first advance, and return a note
   subroutine resume(handle, results, note, stat, message)
      integer(c_int), intent(in) :: handle
      character(len=*), intent(in) :: results
      character(len=4096), intent(out) :: note
      integer(c_int), intent(out) :: stat
      character(len=4096), intent(out) :: message
      type(run_t), pointer :: run
      type(status_t) :: status
      character(len=:), allocatable :: text

      text = ""
      call run_of(handle, run, status)
      if (.not. status%failed()) call run%solver%resume(checkpoint_path(results), text, status)
      note = fitted(text, len(note))
      call reply(status, stat, message)
   end subroutine resume

   !> Save the state of a run, at once or if due; if at once, return whether a state exists
   subroutine save_state(handle, at_once, has_state, stat, message)
      integer(c_int), intent(in) :: handle, at_once
      integer(c_int), intent(out) :: has_state, stat
      character(len=4096), intent(out) :: message
      type(run_t), pointer :: run
      type(status_t) :: status
      logical :: due

      has_state = 0
      call run_of(handle, run, status)
      if (.not. status%failed()) then
         due = run%checkpoints%is_due()
         if (at_once /= 0 .or. due) call run%checkpoints%save(run%solver, status)
         if (at_once /= 0) has_state = merge(1, 0, run%checkpoints%has_state())
      end if
      call reply(status, stat, message)
   end subroutine save_state

   !> Remove the states of a run that has converged
   subroutine clear_states(handle, stat, message)
      integer(c_int), intent(in) :: handle
      integer(c_int), intent(out) :: stat
      character(len=4096), intent(out) :: message
      type(run_t), pointer :: run
      type(status_t) :: status

      call run_of(handle, run, status)
      if (.not. status%failed()) call run%checkpoints%close()
      call reply(status, stat, message)
   end subroutine clear_states

   !> Start to save states of the run beside its results, at the interval of the case; `resumed`: results of the resumed run; the
   !> surfaces as in open_case
   subroutine keep_states(handle, results, resumed, has_heights, nx, ny, heights, has_second, mx, my, second, note, stat, message)
      integer(c_int), intent(in) :: handle
      character(len=*), intent(in) :: results, resumed
      integer(c_int), intent(in) :: has_heights, nx, ny, has_second, mx, my
      real(c_double), intent(inout) :: heights(nx, ny), second(mx, my)
      character(len=4096), intent(out) :: note
      integer(c_int), intent(out) :: stat
      character(len=4096), intent(out) :: message
      type(run_t), pointer :: run
      type(status_t) :: status
      character(len=:), allocatable :: text

      note = ""
      call run_of(handle, run, status)
      if (.not. status%failed()) then
         associate (n => merge(nx, 0, has_heights /= 0), m => merge(mx, 0, has_second /= 0))
            call run%checkpoints%open(results, run%input, run%solver, resumed, heights(:n, :), second(:m, :), text, status)
         end associate
         if (.not. status%failed()) note = fitted(text, len(note))
      end if
      call reply(status, stat, message)
   end subroutine keep_states

   !> Current results, or the plan of the run: one name per line, with a text after a tab; kinds as in ehl_record; values
   subroutine results(handle, of_plan, n, bytes, m, kinds, values, length, found, stat, message)
      integer(c_int), intent(in) :: handle, of_plan
      integer(c_int), intent(in) :: n, m
      integer(c_int), intent(inout) :: bytes(n), kinds(m)
      real(c_double), intent(inout) :: values(m)
      !> Length of the names, and their number; if they do not fit the caller repeats with larger arrays
      integer(c_int), intent(out) :: length, found
      integer(c_int), intent(out) :: stat
      character(len=4096), intent(out) :: message
      type(run_t), pointer :: run
      type(record_t) :: record
      type(status_t) :: status
      character(len=:), allocatable :: names
      integer, allocatable :: all_kinds(:)
      real(c_double), allocatable :: all_values(:)

      length = 0
      found = 0
      call run_of(handle, run, status)
      if (.not. status%failed()) then
         if (of_plan /= 0) then
            record = plan_record(run%solver%run%plan)
         else
            record = run%solver%results()
         end if
         call record%list(names, all_kinds, all_values)
         call put_text(names, bytes, length)
         found = size(all_kinds)
         kinds(:min(m, found)) = all_kinds(:min(m, found))
         values(:min(m, found)) = all_values(:min(m, found))
      end if
      call reply(status, stat, message)
   end subroutine results

   !> One line on the state of a run
   subroutine progress(handle, line, stat, message)
      integer(c_int), intent(in) :: handle
      character(len=512), intent(out) :: line
      integer(c_int), intent(out) :: stat
      character(len=4096), intent(out) :: message
      type(run_t), pointer :: run
      type(status_t) :: status

      line = ""
      call run_of(handle, run, status)
      if (.not. status%failed()) line = fitted(run%solver%progress(), len(line))
      call reply(status, stat, message)
   end subroutine progress

   !> Work of a transient run in time steps: done, and at the earliest and the latest end; 0 if not known
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
         y = grid%y([(i, i=1, ny)] - grid%rows_below())
      end if
      call reply(status, stat, message)
   end subroutine axes

   !> A field by its name on the whole finest grid
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

   !> Refuse arrays without the shape of the grid
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

! SPDX-License-Identifier: BSD-3-Clause
!> All that Python can see, in the small part of Fortran that f2py reads. No arithmetic here:
!> every routine hands its arguments on, and ends in a status and a message. Only the long
!> routines release Python's lock (threadsafe): gfortran keeps the lengths of text that functions
!> return in static memory, so that routines that make text must not run side by side.
module ehl_f2py
   use, intrinsic :: iso_c_binding, only: c_double, c_int
   use ehl_case, only: case_t
   use ehl_case_reader, only: read_case, read_case_file
   use ehl_case_writer, only: case_text, options_text
   use ehl_clock, only: clock_t, start_clock
   use ehl_deflection, only: deflection_t
   use ehl_deflection_factory, only: new_deflection
   use ehl_grid, only: grid_t
   use ehl_handles, only: drop_handle, new_handle, run_of, run_t
   use ehl_keeper, only: checkpoint_folder, find_checkpoint
   use ehl_lubricant, only: density_constant, density_dowson_higginson, new_lubricant, &
                            solver_lubricant_t => lubricant_t, viscosity_barus, viscosity_roelands
   use ehl_outputs, only: check_folder, write_results
   use ehl_record, only: record_t
   use ehl_status, only: ehl_bad_input, status_t
   use ehl_version, only: build_text, version
   implicit none (type, external)
   private
   public :: resolve, open_case, close_case, advance, interrupt, describe, progress, summary
   public :: grid_shape, axes, field, check_output, write_output, keys, about
   public :: skipped, checkpoint_case, keep, save_state, end_keeping, resume
   public :: deflection, viscosity, density

contains

   !> Resolved namelist text of a case: of the text, or of the file `origin`
   subroutine resolve(text, origin, options, from_file, resolved, stat, message)
      character(len=*), intent(in) :: text, origin, options
      integer(c_int), intent(in) :: from_file
      character(len=32768), intent(out) :: resolved
      integer(c_int), intent(out) :: stat
      character(len=4096), intent(out) :: message
      type(case_t), target :: input
      type(status_t) :: status

      resolved = ""
      if (from_file /= 0) then
         call read_case_file(origin, options, input, status)
      else
         call read_case(text, origin, options, input, status)
      end if
      if (.not. status%failed()) resolved = case_text(input)
      call report(status, stat, message)
   end subroutine resolve

   !> Start a solver on the text of a case; with has_heights on the surface heights(nx, ny) [m]
   !> in place of a file
   subroutine open_case(text, origin, has_heights, nx, ny, heights, handle, stat, message)
      character(len=*), intent(in) :: text, origin
      integer(c_int), intent(in) :: has_heights, nx, ny
      real(c_double), intent(inout) :: heights(nx, ny)
      integer(c_int), intent(out) :: handle
      integer(c_int), intent(out) :: stat
      character(len=4096), intent(out) :: message
      type(case_t), target :: input
      type(run_t), pointer :: run
      type(status_t) :: status

      handle = 0
      call read_case(text, origin, "", input, status)
      if (.not. status%failed()) call new_handle(handle, run, status)
      if (.not. status%failed()) then
         run%input = input
         if (has_heights /= 0) call run%solver%give_surface(heights)
         call run%solver%start(input, status)
         if (status%failed()) call drop_handle(handle)
      end if
      call report(status, stat, message)
   end subroutine open_case

   !> Free a solver
   subroutine close_case(handle)
      integer(c_int), intent(in) :: handle

      call drop_handle(handle)
   end subroutine close_case

   !> One cycle or step; done is 1 when there is nothing left to do
   subroutine advance(handle, done, converged, stat, message)
      integer(c_int), intent(in) :: handle
      integer(c_int), intent(out) :: done, converged
      integer(c_int), intent(out) :: stat
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
      call report(status, stat, message)
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
      call report(status, stat, message)
   end subroutine interrupt

   !> The plan in a few lines
   subroutine describe(handle, text, stat, message)
      integer(c_int), intent(in) :: handle
      character(len=32768), intent(out) :: text
      integer(c_int), intent(out) :: stat
      character(len=4096), intent(out) :: message
      type(run_t), pointer :: run
      type(status_t) :: status

      text = ""
      call run_of(handle, run, status)
      if (.not. status%failed()) text = run%solver%describe()
      call report(status, stat, message)
   end subroutine describe

   !> One line about the state
   subroutine progress(handle, text, stat, message)
      integer(c_int), intent(in) :: handle
      character(len=4096), intent(out) :: text
      integer(c_int), intent(out) :: stat
      character(len=4096), intent(out) :: message
      type(run_t), pointer :: run
      type(status_t) :: status

      text = ""
      call run_of(handle, run, status)
      if (.not. status%failed()) text = run%solver%progress()
      call report(status, stat, message)
   end subroutine progress

   !> What a march that has ended did not have to do; empty for every other run
   subroutine skipped(handle, text, stat, message)
      integer(c_int), intent(in) :: handle
      character(len=4096), intent(out) :: text
      integer(c_int), intent(out) :: stat
      character(len=4096), intent(out) :: message
      type(run_t), pointer :: run
      type(status_t) :: status

      text = ""
      call run_of(handle, run, status)
      if (.not. status%failed()) text = run%solver%skipped()
      call report(status, stat, message)
   end subroutine skipped

   !> The scalar results as JSON
   subroutine summary(handle, text, stat, message)
      integer(c_int), intent(in) :: handle
      character(len=32768), intent(out) :: text
      integer(c_int), intent(out) :: stat
      character(len=4096), intent(out) :: message
      type(run_t), pointer :: run
      type(record_t) :: record
      type(status_t) :: status

      text = ""
      call run_of(handle, run, status)
      if (.not. status%failed()) then
         record = run%solver%summary()
         text = record%to_json()
      end if
      call report(status, stat, message)
   end subroutine summary

   !> Nodes of the whole (unfolded) finest grid
   subroutine grid_shape(handle, nx, ny, stat, message)
      integer(c_int), intent(in) :: handle
      integer(c_int), intent(out) :: nx, ny
      integer(c_int), intent(out) :: stat
      character(len=4096), intent(out) :: message
      type(run_t), pointer :: run
      type(status_t) :: status

      nx = 0
      ny = 0
      call run_of(handle, run, status)
      if (.not. status%failed()) then
         nx = run%solver%grid%nx
         ny = run%solver%grid%full_ny()
      end if
      call report(status, stat, message)
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
      integer :: i

      call run_of(handle, run, status)
      if (.not. status%failed()) call check_shape(run, nx, ny, status)
      if (.not. status%failed()) then
         x = run%solver%grid%x([(i, i=1, nx)])
         y = run%solver%grid%y([(i, i=1, ny)] - (ny - run%solver%grid%ny))
      end if
      call report(status, stat, message)
   end subroutine axes

   !> Field 'P' or 'H' on the whole grid
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
      call report(status, stat, message)
   end subroutine field

   !> Whether results could be written into a folder
   subroutine check_output(folder, stat, message)
      character(len=*), intent(in) :: folder
      integer(c_int), intent(out) :: stat
      character(len=4096), intent(out) :: message
      type(status_t) :: status

      call check_folder(folder, status)
      call report(status, stat, message)
   end subroutine check_output

   !> Write the result folder; the note is mostly empty
   subroutine write_output(handle, folder, note, stat, message)
      integer(c_int), intent(in) :: handle
      character(len=*), intent(in) :: folder
      character(len=4096), intent(out) :: note
      integer(c_int), intent(out) :: stat
      character(len=4096), intent(out) :: message
      type(run_t), pointer :: run
      type(status_t) :: status
      character(len=:), allocatable :: text

      note = ""
      call run_of(handle, run, status)
      if (.not. status%failed()) then
         call write_results(folder, run%input, run%solver, run%clock%seconds(), text, status)
         if (.not. status%failed()) note = text
      end if
      call report(status, stat, message)
   end subroutine write_output

   !> Case file of the run with these results, to go on with; its folder holds surface.npy as well when
   !> the surface came from Python
   subroutine checkpoint_case(results, path, stat, message)
      character(len=*), intent(in) :: results
      character(len=4096), intent(out) :: path
      integer(c_int), intent(out) :: stat
      character(len=4096), intent(out) :: message
      real(c_double), allocatable :: heights(:, :)
      character(len=:), allocatable :: text
      type(status_t) :: status

      path = ""
      call find_checkpoint(results, text, heights, status)
      if (.not. status%failed()) path = text
      call report(status, stat, message)
   end subroutine checkpoint_case

   !> Go on with the newest state of the run with these results; before the first advance
   subroutine resume(handle, results, note, stat, message)
      integer(c_int), intent(in) :: handle
      character(len=*), intent(in) :: results
      character(len=4096), intent(out) :: note
      integer(c_int), intent(out) :: stat
      character(len=4096), intent(out) :: message
      type(run_t), pointer :: run
      type(status_t) :: status
      character(len=:), allocatable :: text

      note = ""
      call run_of(handle, run, status)
      if (.not. status%failed()) then
         call run%solver%resume(checkpoint_folder(results), text, status)
         if (.not. status%failed()) note = text
      end if
      call report(status, stat, message)
   end subroutine resume

   !> Keep states of the run beside its results, at the interval of the case; `resumed` names the
   !> results of the run that is gone on with
   subroutine keep(handle, results, resumed, note, stat, message)
      integer(c_int), intent(in) :: handle
      character(len=*), intent(in) :: results, resumed
      character(len=4096), intent(out) :: note
      integer(c_int), intent(out) :: stat
      character(len=4096), intent(out) :: message
      type(run_t), pointer :: run
      type(status_t) :: status
      character(len=:), allocatable :: text

      note = ""
      call run_of(handle, run, status)
      if (.not. status%failed()) then
         call run%keeper%open(results, run%input, run%solver, resumed, text, status)
         if (.not. status%failed()) note = text
      end if
      call report(status, stat, message)
   end subroutine keep

   !> Save the state if its time has come, or at once; has_state tells whether there is one now
   subroutine save_state(handle, at_once, has_state, stat, message)
      integer(c_int), intent(in) :: handle, at_once
      integer(c_int), intent(out) :: has_state
      integer(c_int), intent(out) :: stat
      character(len=4096), intent(out) :: message
      type(run_t), pointer :: run
      type(status_t) :: status

      has_state = 0
      call run_of(handle, run, status)
      if (.not. status%failed()) then
         if (at_once /= 0) then
            call run%keeper%save(run%solver, status)
            if (run%keeper%has_state()) has_state = 1
         else
            call run%keeper%tick(run%solver, status)
         end if
      end if
      call report(status, stat, message)
   end subroutine save_state

   !> Remove the states: the run has come to a good end
   subroutine end_keeping(handle, stat, message)
      integer(c_int), intent(in) :: handle
      integer(c_int), intent(out) :: stat
      character(len=4096), intent(out) :: message
      type(run_t), pointer :: run
      type(status_t) :: status

      call run_of(handle, run, status)
      if (.not. status%failed()) call run%keeper%close()
      call report(status, stat, message)
   end subroutine end_keeping

   !> All keys of a case file, one a line: key, unit, default, allowed values, meaning
   subroutine keys(text)
      character(len=32768), intent(out) :: text

      text = options_text()
   end subroutine keys

   !> Version of the package; compiler and its options
   subroutine about(version_text, compiler_text)
      character(len=64), intent(out) :: version_text
      character(len=4096), intent(out) :: compiler_text

      version_text = version
      compiler_text = build_text()
   end subroutine about

   !> Elastic deflection w of the pressure p by one engine, and the mean seconds of an application
   subroutine deflection(engine, nx, ny, p, w, hx, hy, mirror, accuracy, threads, repeats, &
                         seconds, bytes, stat, message)
      character(len=*), intent(in) :: engine
      integer(c_int), intent(in) :: nx, ny
      real(c_double), intent(inout) :: p(nx, ny), w(nx, ny)
      real(c_double), intent(in) :: hx, hy, accuracy
      integer(c_int), intent(in) :: mirror, threads, repeats
      real(c_double), intent(out) :: seconds, bytes
      integer(c_int), intent(out) :: stat
      character(len=4096), intent(out) :: message
      !f2py threadsafe
      class(deflection_t), allocatable :: solver
      type(grid_t) :: grid
      type(clock_t) :: clock
      type(status_t) :: status
      integer :: k

      seconds = 0.0_c_double
      bytes = 0.0_c_double
      grid = grid_t(nx=nx, ny=ny, hx=hx, hy=hy, mirror=mirror /= 0)
      call new_deflection(engine, solver, status)
      if (.not. status%failed()) call solver%setup(grid, accuracy, threads, status)
      if (.not. status%failed()) then
         clock = start_clock()
         do k = 1, repeats
            call solver%apply(p, w)
         end do
         seconds = clock%seconds()/repeats
         bytes = real(solver%bytes(), c_double)
      end if
      call report(status, stat, message)
   end subroutine deflection

   !> ln(eta/eta0) and its slope at pressures p, scaled by the Hertz pressure [Pa]
   subroutine viscosity(law, n, p, values, slopes, alpha_bar, hertz_pressure, z, p0, stat, message)
      character(len=*), intent(in) :: law
      integer(c_int), intent(in) :: n
      real(c_double), intent(inout) :: p(n), values(n), slopes(n)
      real(c_double), intent(in) :: alpha_bar, hertz_pressure, z, p0
      integer(c_int), intent(out) :: stat
      character(len=4096), intent(out) :: message
      type(solver_lubricant_t) :: lubricant
      type(status_t) :: status
      integer :: number

      number = 0
      if (law == "barus") number = viscosity_barus
      if (law == "roelands") number = viscosity_roelands
      if (number == 0) then
         call status%fail(ehl_bad_input, "unknown viscosity law '" // law // "'")
      else
         lubricant = new_lubricant(number, density_constant, alpha_bar, hertz_pressure, z, p0)
         call lubricant%log_viscosity(p, values, slopes)
      end if
      call report(status, stat, message)
   end subroutine viscosity

   !> Dowson-Higginson density rho/rho0 at pressures p, scaled by the Hertz pressure [Pa]
   subroutine density(n, p, values, slopes, hertz_pressure)
      integer(c_int), intent(in) :: n
      real(c_double), intent(inout) :: p(n), values(n), slopes(n)
      real(c_double), intent(in) :: hertz_pressure
      type(solver_lubricant_t) :: lubricant

      lubricant = new_lubricant(viscosity_barus, density_dowson_higginson, 1.0_c_double, &
                                hertz_pressure, 1.0_c_double, 1.0_c_double)
      call lubricant%density(p, values, slopes)
   end subroutine density

   !> Arrays must have the shape of the grid
   subroutine check_shape(run, nx, ny, status)
      type(run_t), intent(in) :: run
      integer(c_int), intent(in) :: nx, ny
      type(status_t), intent(inout) :: status

      if (nx == run%solver%grid%nx .and. ny == run%solver%grid%full_ny()) return
      call status%fail(ehl_bad_input, "the arrays do not have the shape of the grid")
   end subroutine check_shape

   !> Code and text of a status for Python
   subroutine report(status, stat, message)
      type(status_t), intent(in) :: status
      integer(c_int), intent(out) :: stat
      character(len=*), intent(out) :: message

      stat = int(status%code, c_int)
      message = ""
      if (status%failed()) message = status%message
   end subroutine report
end module ehl_f2py

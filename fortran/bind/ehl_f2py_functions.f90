! SPDX-License-Identifier: BSD-3-Clause
!> Functions for Python that need no solver; for the rules see ehl_f2py_solver
module ehl_f2py_functions
   use, intrinsic :: iso_c_binding, only: c_double, c_int
   use ehl_case, only: case_t
   use ehl_checkpoint_folder, only: find_checkpoint
   use ehl_clock, only: clock_t, start_clock
   use ehl_conclusion, only: conclusion
   use ehl_deflection, only: deflection_t
   use ehl_deflection_factory, only: new_deflection
   use ehl_destination, only: destination_t
   use ehl_grid, only: grid_t
   use ehl_handles, only: put_text, fitted, reply
   use ehl_heated_friction, only: heat_film, heated_t
   use ehl_assessment, only: judge
   use ehl_kinds, only: pi
   use ehl_lubricant, only: lubricant_t
   use ehl_memory, only: check_memory, free_bytes
   use ehl_plan_heat, only: heat_plan_t, plan_given
   use ehl_read_case, only: read_case
   use ehl_record, only: record_t
   use ehl_result_folder, only: result_names
   use ehl_status, only: status_t
   use ehl_version, only: build_text, version
   implicit none (type, external)
   private
   public :: checkpoint_case, place, needs_memory, memory_left, about, conclude, deflection, heated

contains

   !> Case file of the run with these results, to resume it; its folder holds surface.npy, and second_surface.npy, as well
   !> when these surfaces came from Python
   subroutine checkpoint_case(results, path, stat, message)
      character(len=*), intent(in) :: results
      character(len=4096), intent(out) :: path
      integer(c_int), intent(out) :: stat
      character(len=4096), intent(out) :: message
      real(c_double), allocatable :: heights(:, :), second(:, :)
      character(len=:), allocatable :: text
      type(status_t) :: status

      path = ""
      call find_checkpoint(results, text, heights, second, status)
      if (.not. status%failed()) path = text
      call reply(status, stat, message)
   end subroutine checkpoint_case

   !> A step on the way of a result to its folder: 'check', 'resume' (a check for a result that is completed), 'begin',
   !> which gives an empty folder `fresh`, or 'finish' with that. Lists have a line end behind each item.
   subroutine place(step, folder, kind, names, inputs, kept, force, made, fresh, stat, message)
      character(len=*), intent(in) :: step, folder, kind, names, inputs, kept
      integer(c_int), intent(in) :: force
      !> The folder that 'begin' gave
      character(len=*), intent(in) :: made
      character(len=4096), intent(out) :: fresh
      integer(c_int), intent(out) :: stat
      character(len=4096), intent(out) :: message
      type(destination_t) :: destination
      type(status_t) :: status
      character(len=:), allocatable :: path

      fresh = ""
      destination = destination_t(folder, kind, names, inputs, kept, force /= 0)
      ! the library knows what it writes
      if (kind == "solution") destination%names = result_names
      select case (step)
      case ("begin")
         call destination%begin(path, status)
         fresh = path
      case ("finish")
         call destination%finish(made, status)
      case default
         call destination%check(status, resumes=step == "resume")
      end select
      call reply(status, stat, message)
   end subroutine place

   !> Refuse what would not fit into the memory
   subroutine needs_memory(what, bytes, stat, message)
      character(len=*), intent(in) :: what
      real(c_double), intent(in) :: bytes
      integer(c_int), intent(out) :: stat
      character(len=4096), intent(out) :: message
      type(status_t) :: status

      call check_memory(what, bytes, status)
      call reply(status, stat, message)
   end subroutine needs_memory

   !> Bytes of memory that are free; root: folder of /proc and /sys
   subroutine memory_left(root, bytes)
      character(len=*), intent(in) :: root
      real(c_double), intent(out) :: bytes

      bytes = free_bytes(root)
   end subroutine memory_left

   !> Version of the package; compiler and its options
   subroutine about(version_text, compiler_text)
      character(len=64), intent(out) :: version_text
      character(len=4096), intent(out) :: compiler_text

      version_text = version
      compiler_text = build_text()
   end subroutine about

   !> The last lines of a result from its summary (JSON, one value a line), the assessment, and what it is worth: see
   !> ehl_assessment; the assessment begins behind so many bytes
   subroutine conclude(summary, n, bytes, behind, length, worth)
      character(len=*), intent(in) :: summary
      integer(c_int), intent(in) :: n
      integer(c_int), intent(inout) :: bytes(n)
      integer(c_int), intent(out) :: behind, length, worth
      type(record_t) :: record
      character(len=:), allocatable :: text, line

      call record%take_json(summary)
      text = conclusion(record)
      behind = int(len(text), c_int)
      call judge(record, line, worth)
      call put_text(text//line, bytes, length)
   end subroutine conclude

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
      if (.not. status%failed()) call solver%setup(grid, 2.0_c_double/pi**2, accuracy, threads, status)
      if (.not. status%failed()) then
         clock = start_clock()
         do k = 1, repeats
            call solver%apply(p, w)
         end do
         seconds = clock%seconds()/repeats
         bytes = real(solver%bytes(), c_double)
      end if
      call reply(status, stat, message)
   end subroutine deflection

   !> Friction with heat over that without it (NaN: not known), and the maximum increases of temperature of film and walls [K],
   !> of the contact of a case with the pressure and the film p, h(nx, ny), the first node at (x0, y0); mirror: the rows are
   !> those of Y >= 0; touching: 1 where the bodies touch at the boundary film. Whether the heat counts, and what a coefficient of
   !> friction is then.
   subroutine heated(text, nx, ny, p, h, touching, x0, y0, hx, hy, mirror, counts, ratio, rises, note, stat, message)
      character(len=*), intent(in) :: text
      integer(c_int), intent(in) :: nx, ny
      real(c_double), intent(inout) :: p(nx, ny), h(nx, ny)
      integer(c_int), intent(inout) :: touching(nx, ny)
      real(c_double), intent(in) :: x0, y0, hx, hy
      integer(c_int), intent(in) :: mirror
      integer(c_int), intent(out) :: counts, stat
      real(c_double), intent(out) :: ratio, rises(3)
      character(len=256), intent(out) :: note
      character(len=4096), intent(out) :: message
      type(case_t) :: input
      type(heat_plan_t) :: plan
      type(lubricant_t) :: lubricant
      type(heated_t) :: found
      type(status_t) :: status

      counts = 0
      ratio = 1.0_c_double
      rises = 0.0_c_double
      note = ""
      call read_case(text, "the contact of a prediction", "", input, status)
      if (.not. status%failed()) call plan_given(input, plan, lubricant, status)
      if (.not. status%failed()) then
         note = fitted(plan%note, len(note))
         if (plan%counts) then
            counts = 1
            call heat_film(plan%film, grid_t(nx=nx, ny=ny, x0=x0, y0=y0, hx=hx, hy=hy, mirror=mirror /= 0), lubricant, p, h, &
                           .false., 1, found, touching=touching > 0)
            ratio = found%ratio()
            rises = found%greatest
         end if
      end if
      call reply(status, stat, message)
   end subroutine heated
end module ehl_f2py_functions

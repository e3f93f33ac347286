! SPDX-License-Identifier: BSD-3-Clause
!> Functions for Python that need no solver; for the rules see ehl_f2py_solver
module ehl_f2py_functions
   use, intrinsic :: iso_c_binding, only: c_double, c_int
   use ehl_case, only: case_t
   use ehl_checkpoint_folder, only: find_checkpoint
   use ehl_clock, only: clock_t, start_clock
   use ehl_deflection, only: deflection_t
   use ehl_deflection_factory, only: new_deflection
   use ehl_destination, only: destination_t
   use ehl_grid, only: grid_t
   use ehl_handles, only: reply
   use ehl_heated_friction, only: heat_film, heated_t
   use ehl_kinds, only: pi
   use ehl_lubricant, only: lubricant_t
   use ehl_memory, only: check_memory, free_bytes
   use ehl_plan_heat, only: heat_plan_t, plan_known_film
   use ehl_read_case, only: read_case
   use ehl_result_folder, only: result_names
   use ehl_status, only: status_t
   use ehl_version, only: build_text, version
   implicit none (type, external)
   private
   public :: checkpoint_case, check_folder, begin_folder, finish_folder, needs_memory, memory_left, about, deflection, &
             frictional_heat

contains

   !> Case file from which the run with these results resumes; its folder also holds surface.npy and second_surface.npy if these
   !> surfaces came from Python
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

   !> Refuse a result folder that must not be changed or cannot be written; `completes`: an earlier result is completed. Each item
   !> of a list ends with a newline.
   subroutine check_folder(folder, kind, names, inputs, kept, force, completes, stat, message)
      character(len=*), intent(in) :: folder, kind, names, inputs, kept
      integer(c_int), intent(in) :: force, completes
      integer(c_int), intent(out) :: stat
      character(len=4096), intent(out) :: message
      type(destination_t) :: destination
      type(status_t) :: status

      destination = destination_of(folder, kind, names, inputs, kept, force)
      call destination%check(status, resumes=completes /= 0)
      call reply(status, stat, message)
   end subroutine check_folder

   !> Make an empty folder `fresh` for a result that will be moved to `folder`
   subroutine begin_folder(folder, kind, names, inputs, kept, force, fresh, stat, message)
      character(len=*), intent(in) :: folder, kind, names, inputs, kept
      integer(c_int), intent(in) :: force
      character(len=4096), intent(out) :: fresh
      integer(c_int), intent(out) :: stat
      character(len=4096), intent(out) :: message
      type(destination_t) :: destination
      type(status_t) :: status
      character(len=:), allocatable :: path

      path = ""
      destination = destination_of(folder, kind, names, inputs, kept, force)
      call destination%begin(path, status)
      fresh = path
      call reply(status, stat, message)
   end subroutine begin_folder

   !> Move the folder `fresh` to `folder`
   subroutine finish_folder(folder, kind, names, inputs, kept, force, fresh, stat, message)
      character(len=*), intent(in) :: folder, kind, names, inputs, kept
      integer(c_int), intent(in) :: force
      character(len=*), intent(in) :: fresh
      integer(c_int), intent(out) :: stat
      character(len=4096), intent(out) :: message
      type(destination_t) :: destination
      type(status_t) :: status

      destination = destination_of(folder, kind, names, inputs, kept, force)
      call destination%finish(fresh, status)
      call reply(status, stat, message)
   end subroutine finish_folder

   function destination_of(folder, kind, names, inputs, kept, force) result(destination)
      character(len=*), intent(in) :: folder, kind, names, inputs, kept
      integer(c_int), intent(in) :: force
      type(destination_t) :: destination

      destination = destination_t(folder, kind, names, inputs, kept, force /= 0)
      ! the library has the list of the files that it writes
      if (kind == "solution") destination%names = result_names
   end function destination_of

   !> Refuse a request that exceeds the free memory
   subroutine needs_memory(what, bytes, stat, message)
      character(len=*), intent(in) :: what
      real(c_double), intent(in) :: bytes
      integer(c_int), intent(out) :: stat
      character(len=4096), intent(out) :: message
      type(status_t) :: status

      call check_memory(what, bytes, status)
      call reply(status, stat, message)
   end subroutine needs_memory

   !> Bytes of free memory; root: folder of /proc and /sys
   subroutine memory_left(root, bytes)
      character(len=*), intent(in) :: root
      real(c_double), intent(out) :: bytes

      bytes = free_bytes(root)
   end subroutine memory_left

   !> Version of the package; compiler with its options
   subroutine about(version_text, compiler_text)
      character(len=64), intent(out) :: version_text
      character(len=4096), intent(out) :: compiler_text

      version_text = version
      compiler_text = build_text()
   end subroutine about

   !> Elastic deflection w of a round contact under the pressure p with an engine, mean seconds per application, and bytes of its
   !> arrays
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

   !> Thermal over isothermal friction (NaN: not known; 1 without heating), and maximum temperature rises of film and walls [K],
   !> for the contact of a case with pressure and film p, h(nx, ny), the first node at (x0, y0); mirror: rows with Y >= 0 only;
   !> touching: 1 at solid contact. Also whether heating is computed (counts), the kind of the coefficient of friction (ehl_reason),
   !> and the estimated temperature rise [K].
   subroutine frictional_heat(text, nx, ny, p, h, touching, x0, y0, hx, hy, mirror, counts, ratio, rises, reason, estimate, &
                              stat, message)
      character(len=*), intent(in) :: text
      integer(c_int), intent(in) :: nx, ny
      real(c_double), intent(inout) :: p(nx, ny), h(nx, ny)
      integer(c_int), intent(inout) :: touching(nx, ny)
      real(c_double), intent(in) :: x0, y0, hx, hy
      integer(c_int), intent(in) :: mirror
      integer(c_int), intent(out) :: counts, stat
      real(c_double), intent(out) :: ratio, rises(3), estimate
      integer(c_int), intent(out) :: reason
      character(len=4096), intent(out) :: message
      type(case_t) :: input
      type(heat_plan_t) :: plan
      type(lubricant_t) :: lubricant
      type(heated_t) :: found
      type(status_t) :: status

      counts = 0
      ratio = 1.0_c_double
      rises = 0.0_c_double
      reason = 0
      estimate = 0.0_c_double
      call read_case(text, "the contact of a prediction", "", input, status)
      if (.not. status%failed()) call plan_known_film(input, plan, lubricant, status)
      if (.not. status%failed()) then
         reason = plan%reason
         estimate = plan%estimate
         if (plan%active) then
            counts = 1
            call heat_film(plan%film, grid_t(nx=nx, ny=ny, x0=x0, y0=y0, hx=hx, hy=hy, mirror=mirror /= 0, &
                                             periodic=input%contact%is_line()), &
                           lubricant, p, h, .false., 1, found, touching=touching > 0)
            ratio = found%ratio()
            rises = found%max_rise
         end if
      end if
      call reply(status, stat, message)
   end subroutine frictional_heat
end module ehl_f2py_functions

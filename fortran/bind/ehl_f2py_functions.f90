! SPDX-License-Identifier: BSD-3-Clause
!> Functions for Python that need no solver; for the rules see ehl_f2py_solver
module ehl_f2py_functions
   use, intrinsic :: iso_c_binding, only: c_double, c_int
   use ehl_case, only: case_t
   use ehl_case_reader, only: read_case, read_case_file
   use ehl_case_writer, only: case_text, options_text
   use ehl_clock, only: clock_t, start_clock
   use ehl_deflection, only: deflection_t
   use ehl_deflection_factory, only: new_deflection
   use ehl_grid, only: grid_t
   use ehl_kinds, only: pi
   use ehl_memory, only: check_memory, free_bytes
   use ehl_reply, only: reply
   use ehl_status, only: status_t
   use ehl_version, only: build_text, version
   implicit none (type, external)
   private
   public :: resolve, needs_memory, memory_left, keys, about, deflection

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
      call reply(status, stat, message)
   end subroutine resolve

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
end module ehl_f2py_functions

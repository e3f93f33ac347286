! SPDX-License-Identifier: BSD-3-Clause
!> Complete solutions on small grids, smooth and transient, which a build with run-time checks and traps executes too
module test_solver
   use, intrinsic :: ieee_arithmetic, only: ieee_get_halting_mode, ieee_invalid, ieee_is_nan, ieee_quiet_nan, &
                                            ieee_set_halting_mode, ieee_value
   use check, only: is_close, is_equal, is_true
   use ehl_case, only: case_t
   use ehl_read_case, only: read_case
   use ehl_contact, only: contact_t
   use ehl_contact_factory, only: new_contact
   use ehl_contact_run, only: contact_run_t
   use ehl_deflection, only: deflection_t
   use ehl_deflection_factory, only: new_deflection
   use ehl_reynolds, only: update_coefficients
   use ehl_flow_factory, only: new_flow
   use ehl_grid, only: grid_t, new_grid
   use ehl_kinds, only: dp, pi
   use ehl_level, only: level_t
   use ehl_line_system, only: last_active, solve_lines
   use ehl_lubricant, only: density_dowson_higginson, new_lubricant, viscosity_roelands
   use ehl_moes, only: operating_t
   use ehl_relaxation, only: usual_log_change, relax
   use ehl_solver, only: solver_t
   use ehl_scales, only: scales_t
   use ehl_status, only: ehl_no_memory, status_t
   use ehl_step_accuracy, only: max_tolerance_ratio, step_tolerance
   use ehl_wedge, only: wedge_narrow, wedge_steady
   use ehl_workspace, only: line_width, workspace_t
   implicit none (type, external)
   private
   public :: run_solver

   character(len=*), parameter :: moderate = "&contact moes_m = 20, moes_l = 10 / &lubricant roelands_z = 0.68 / "// &
                                  "&grid points = 129, x_inlet = -4.5, x_outlet = 1.5, y_extent = 3, border = 'zero' / "
   character(len=*), parameter :: wavy = "&surface kind = 'harmonic', amplitude = 0.05, wavelength = 1, x_start = 0 / "// &
                                  "&time steps = 6"

contains

   subroutine run_solver()
      call operating_point_of_table_1()
      call shapes_are_consistent(1.0_dp, 0.0_dp)
      call shapes_are_consistent(0.35177164_dp, 0.0_dp)
      call shapes_are_consistent(36.536094_dp, 0.0_dp)
      call shapes_are_consistent(0.004_dp, 0.0_dp)
      call shapes_are_consistent(0.35177164_dp, 0.6_dp)
      call smooth_against_reference()
      call half_is_whole("", 1.0e-10_dp)
      call half_is_whole(wavy//" / ", 1.0e-9_dp)
      call steps_converge("narrow")
      call steps_converge("paper")
      call threads_change_nothing()
      call inactive_nodes_do_not_change()
      call nan_is_no_cavitation()
      call step_without_memory()
   end subroutine run_solver

   !> A time step without memory for the frictional heating fails
   subroutine step_without_memory()
      type(contact_run_t) :: run
      type(status_t) :: status

      run%plan%heat%active = .true.
      run%smooth%n = 1
      allocate (run%hierarchy%levels(1))
      ! more nodes than any address space holds
      run%hierarchy%levels(1)%grid = grid_t(nx=huge(1), ny=huge(1))
      run%transient%friction_smooth = 1.0_dp
      run%transient%mean%period = 1.0_dp
      run%transient%mean%time_step = 1.0_dp
      call run%history%init([character(len=16) :: "step", "T", "mu_ratio", "H_c", "H_min", "P_max", "load_error", "cycles", &
                             "residual", "heat_ratio"])
      call run%record_step(status)
      call is_equal(status%code, ehl_no_memory, "no memory for the heating of a step")
   end subroutine step_without_memory

   !> Zhang et al. 2019, Table 1: a = 0.41540 mm, p_h = 1.6602 GPa, M = 1000.0, L = 10.024
   subroutine operating_point_of_table_1()
      type(operating_t) :: point
      class(contact_t), allocatable :: contact
      type(scales_t) :: scales
      real(dp) :: speed

      call new_contact(1.0_dp, 0.0_dp, contact)
      scales = contact%scales(600.0_dp, 0.018_dp, 2.26e11_dp)
      speed = 0.04_dp*0.84_dp/(2.26e11_dp*0.018_dp)
      point = contact%operating(contact%moes_load(600.0_dp, 0.018_dp, 2.26e11_dp, speed), &
                                2.2e-8_dp*2.26e11_dp*(2.0_dp*speed)**0.25_dp)
      call is_close(scales%length, 4.1540e-4_dp, 1.0e-8_dp, "Hertz radius")
      call is_close(scales%pressure, 1.6602e9_dp, 1.0e5_dp, "Hertz pressure")
      call is_close(point%moes_m, 1000.0_dp, 0.05_dp, "M")
      call is_close(point%moes_l, 10.024_dp, 0.001_dp, "L")
      call is_close(point%speed_parameter, 1.0978e-3_dp, 1.0e-7_dp, "speed parameter")
   end subroutine operating_point_of_table_1

   !> The pressure of the dry contact balances its load, and its deflection closes the gap
   subroutine shapes_are_consistent(radius_ratio, angle)
      real(dp), intent(in) :: radius_ratio, angle
      class(contact_t), allocatable :: contact
      class(deflection_t), allocatable :: engine
      type(grid_t) :: grid
      type(status_t) :: status
      real(dp), allocatable :: gap(:, :), p(:, :), w(:, :)
      integer :: j

      call new_contact(radius_ratio, angle, contact)
      grid = new_grid(129, 129, -1.5_dp*contact%reach(1), 1.5_dp*contact%reach(1), 1.5_dp*contact%reach(2), .false.)
      allocate (gap(129, 129), p(129, 129), w(129, 129))
      do j = 1, grid%ny
         call contact%gap_row(grid%columns(), grid%y(j), gap(:, j))
         call contact%pressure_row(grid%columns(), grid%y(j), p(:, j))
      end do
      call is_close(sum(p)*grid%hx*grid%hy/contact%load, 1.0_dp, 1.0e-3_dp, "load of the dry contact")
      call new_deflection("fft", engine, status)
      call engine%setup(grid, contact%kernel_factor, 1.0e-8_dp, 1, status)
      call engine%apply(p, w)
      w = gap + w + contact%dry_separation
      call is_close(maxval(abs(w), mask=p > 0.0_dp), 0.0_dp, 2.0e-3_dp, "no gap in the dry contact")
      call is_true(minval(w) > -2.0e-3_dp, "bodies do not overlap")
   end subroutine shapes_are_consistent

   !> M = 20, L = 10 on 129 x 129 nodes: H_c = 0.42872, H_min = 0.29094, from two independent solvers that agree
   !> within 0.2 %
   subroutine smooth_against_reference()
      type(solver_t) :: mlmi, fft
      real(dp), allocatable :: h(:, :), h_fft(:, :)

      call solve(moderate, mlmi)
      call is_true(mlmi%converged(), "M = 20, L = 10 converges")
      call get(mlmi, "H", h)
      call is_close(h(1 + nint(4.5_dp/mlmi%run%grid%hx), 65), 0.42872_dp, 0.002_dp*0.42872_dp, "H_c")
      call is_close(minval(h), 0.29094_dp, 0.002_dp*0.29094_dp, "H_min")
      call solve(moderate//"&solver deflection = 'fft' / ", fft)
      call get(fft, "H", h_fft)
      ! the required accuracy of mlmi on this grid is 2.5e-4 of the largest deflection
      call is_close(maxval(abs(h_fft - h)), 0.0_dp, 1.0e-4_dp, "mlmi against fft")
   end subroutine smooth_against_reference

   !> A problem that is symmetric in Y has the same solution on half and on the whole domain
   subroutine half_is_whole(more, tolerance)
      character(len=*), intent(in) :: more
      real(dp), intent(in) :: tolerance
      type(solver_t) :: half, whole
      real(dp), allocatable :: p(:, :), p_whole(:, :)

      call solve(moderate//more, half)
      call solve(moderate//more//"&solver symmetry = 'full' / ", whole)
      call is_true(half%run%grid%mirror .and. .not. whole%run%grid%mirror, "half and whole domain")
      call get(half, "P", p)
      call get(whole, "P", p_whole)
      call is_close(maxval(abs(p - p_whole)), 0.0_dp, tolerance, "half against whole domain")
   end subroutine half_is_whole

   !> Every step of a short transient run converges and balances the load
   subroutine steps_converge(scheme)
      character(len=*), intent(in) :: scheme
      type(solver_t) :: solver
      real(dp), allocatable :: h(:, :), h_smooth(:, :), rr(:, :)

      call solve(moderate//wavy//", scheme = '"//scheme//"' / ", solver)
      call is_equal(solver%run%history%n_rows(), 6, "steps, scheme "//scheme)
      call is_close(maxval(abs(solver%run%history%column("load_error"))), 0.0_dp, 1.0e-6_dp, "load at every step, "//scheme)
      call is_true(maxval(solver%run%history%column("residual")) <= &
                   max_tolerance_ratio*step_tolerance(solver%run%grid%hx, 0.1_dp), "residual of every step, "//scheme)
      call get(solver, "H", h)
      call get(solver, "H_smooth", h_smooth)
      call get(solver, "RR", rr)
      ! where the pressure is low the bodies do not deform, so that roughness peaks reduce the film
      call is_close(maxval(abs(h(2:20, :) - h_smooth(2:20, :) + rr(2:20, :))), 0.0_dp, 0.01_dp, "undeformed roughness, "//scheme)
   end subroutine steps_converge

   !> One thread and three have the same result, to the bit
   subroutine threads_change_nothing()
      type(solver_t) :: one, three
      ! enough nodes for all threads
      character(len=*), parameter :: whole = "&contact moes_m = 200, moes_l = 10 / &grid points = 257 / "// &
         "&surface kind = 'harmonic', amplitude = 0.02, wavelength = 1, x_start = 0 / &time steps = 1 / "
      real(dp), allocatable :: p(:, :), p_three(:, :)

      call solve(whole//"&solver symmetry = 'full' / ", one)
      call solve(whole//"&solver symmetry = 'full', threads = 3 / ", three)
      call get(one, "P", p)
      call get(three, "P", p_three)
      call is_true(.not. any(abs(p - p_three) > 0.0_dp), "threads change no bit")
   end subroutine threads_change_nothing

   !> Lines solved up to last_active and to their end have the same changes, to the bit, and no change downstream of it
   subroutine inactive_nodes_do_not_change()
      type(level_t) :: level
      type(workspace_t) :: space
      type(status_t) :: status
      real(dp), allocatable :: short(:, :), long(:, :)
      integer :: rows(line_width), i, j, k, l, furthest, inactive

      call some_level(65, level, space, status)
      do j = 2, level%grid%ny - 1
         do i = 2, level%grid%nx - 1
            associate (r => level%grid%x(i)**2 + level%grid%y(j)**2)
               level%p(i, j) = sqrt(max(0.0_dp, 1.0_dp - r))
               level%h(i, j) = 0.1_dp + max(0.0_dp, 0.4_dp*(r - 1.0_dp))
            end associate
         end do
      end do
      call update_coefficients(level)
      inactive = 0
      do k = 2, level%grid%ny - line_width, line_width
         rows = [(k + l - 1, l=1, line_width)]
         furthest = maxval([(last_active(level, rows(l)), l=1, line_width)])
         inactive = inactive + level%grid%nx - 1 - furthest
         call solve_lines(level, space%dipole, space%dipole_weights, space%near, space%near_dipole, rows, furthest, space%lines(1))
         short = space%lines(1)%change
         call solve_lines(level, space%dipole, space%dipole_weights, space%near, space%near_dipole, rows, level%grid%nx - 1, &
                          space%lines(1))
         long = space%lines(1)%change
         call is_true(.not. any(abs(long(:, 2:furthest) - short(:, 2:furthest)) > 0.0_dp), "active nodes")
         call is_true(.not. any(abs(long(:, furthest + 1:level%grid%nx - 1)) > 0.0_dp), "inactive nodes do not change")
      end do
      call is_true(inactive > 0, "some nodes are inactive")
   end subroutine inactive_nodes_do_not_change

   !> A NaN remains a NaN in a sweep: it must not become a cavitated node
   subroutine nan_is_no_cavitation()
      type(level_t) :: level
      type(workspace_t) :: space
      type(status_t) :: status
      logical :: halting
      integer :: k

      call ieee_get_halting_mode(ieee_invalid, halting)
      call ieee_set_halting_mode(ieee_invalid, .false.)
      call some_level(33, level, space, status)
      call space%prepare_steps(status)
      do k = wedge_steady, wedge_narrow
         if (k == wedge_narrow) call level%wedge%set_step(k, level%grid%hx, level%grid%hx)
         level%p(10:20, 10:20) = 0.5_dp
         level%h = 0.1_dp
         level%rhs = 0.0_dp
         level%rhs(15, 15) = ieee_value(1.0_dp, ieee_quiet_nan)
         call update_coefficients(level)
         call relax(level, space, usual_log_change, 1.0_dp)
         call is_true(ieee_is_nan(level%p(15, 15)), "a NaN remains a NaN")
      end do
      call ieee_set_halting_mode(ieee_invalid, halting)
   end subroutine nan_is_no_cavitation

   !> A level with `points` nodes per side, and its workspace
   subroutine some_level(points, level, space, status)
      integer, intent(in) :: points
      type(level_t), intent(inout) :: level
      type(workspace_t), intent(inout) :: space
      type(status_t), intent(inout) :: status

      level%grid = new_grid(points, points, -2.5_dp, 1.5_dp, 2.0_dp, .false.)
      level%lubricant = new_lubricant(viscosity_roelands, density_dowson_higginson, 36.5_dp, 1.66e9_dp, 0.668_dp, 1.96e8_dp)
      level%kernel_factor = 2.0_dp/pi**2
      call new_flow(level%lubricant, 1.0e-3_dp, level%flow)
      call level%setup(status)
      call space%setup(level%grid, level%kernel_factor, 1, status)
   end subroutine some_level

   !> Read a case and run it to its end
   subroutine solve(text, solver)
      character(len=*), intent(in) :: text
      type(solver_t), intent(inout) :: solver
      type(case_t), target :: input
      type(status_t) :: status

      call read_case(text, "test", "", input, status)
      if (.not. status%failed()) call solver%start(input, status)
      do while (.not. (status%failed() .or. solver%done()))
         call solver%advance(status)
      end do
      call is_true(.not. status%failed(), "solve")
   end subroutine solve

   !> Get a field of a solver
   subroutine get(solver, name, values)
      type(solver_t), intent(in) :: solver
      character(len=*), intent(in) :: name
      real(dp), allocatable, intent(out) :: values(:, :)
      type(status_t) :: status

      allocate (values(solver%run%grid%nx, solver%run%grid%full_ny()))
      call solver%field(name, values, status)
      call is_true(.not. status%failed(), "field "//name)
   end subroutine get
end module test_solver

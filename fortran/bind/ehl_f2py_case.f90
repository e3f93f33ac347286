! SPDX-License-Identifier: BSD-3-Clause
!> Functions that complete a case in Python; for the rules see ehl_f2py_solver
module ehl_f2py_case
   use, intrinsic :: iso_c_binding, only: c_double, c_int
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use ehl_case, only: case_t, contact_case_t, lubricant_case_t
   use ehl_case_defaults, only: inlet_of => inlet
   use ehl_case_grid, only: fill_grid
   use ehl_case_point, only: find_contact
   use ehl_contact, only: contact_t
   use ehl_handles, only: put_text, reply
   use ehl_heat, only: dynamic_viscosity, temperature_viscosity
   use ehl_moes, only: operating_t
   use ehl_read_case, only: read_lubricant
   use ehl_roller, only: body_profile_t
   use ehl_scales, only: scales_t
   use ehl_status, only: status_t
   use ehl_write_case, only: defaults_text
   implicit none (type, external)
   private
   public :: operating, grid_defaults, inlet, sheet, defaults

contains

   !> Hertz pressure [Pa] and radius [m], Moes numbers, M of the round contact, half lengths of the contact [a], whether
   !> it is symmetric in Y
   subroutine operating(line, roller, n_roller, si, radius_ratio, angle, load, mean_velocity, radius_x, reduced_modulus, &
                        viscosity, alpha, moes_m, moes_l, hertz_pressure, hertz_radius, m, l, round_m, reach, even)
      integer(c_int), intent(in) :: line, si, n_roller
      real(c_double), intent(in) :: roller(n_roller)
      real(c_double), intent(in) :: radius_ratio, angle, load, mean_velocity, radius_x, reduced_modulus, viscosity, alpha, &
                                    moes_m, moes_l
      real(c_double), intent(out) :: hertz_pressure, hertz_radius, m, l, round_m, reach(2)
      integer(c_int), intent(out) :: even
      type(case_t) :: input
      class(contact_t), allocatable :: contact
      type(scales_t) :: scales
      type(operating_t) :: point

      call set_case(input, line, roller, si, radius_ratio, angle, load, mean_velocity, radius_x, reduced_modulus, viscosity, &
                    alpha, moes_m, moes_l)
      call find_contact(input, contact, scales, point)
      hertz_pressure = scales%pressure
      hertz_radius = scales%length
      m = point%moes_m
      l = point%moes_l
      round_m = point%round_m
      reach = contact%reach
      even = merge(1_c_int, 0_c_int, contact%is_even())
   end subroutine operating

   !> Border (0: find, 1: zero, 2: flooded), domain (NaN: find) and nodes (0: find)
   subroutine grid_defaults(line, roller, n_roller, si, radius_ratio, angle, load, mean_velocity, radius_x, reduced_modulus, &
                            viscosity, alpha, moes_m, moes_l, border, smooth, thins, domain, points, points_y, widening, reverses, &
                            may_reduce, border_out, domain_out, points_out, points_y_out)
      integer(c_int), intent(in) :: line, si, n_roller
      real(c_double), intent(in) :: roller(n_roller)
      real(c_double), intent(in) :: radius_ratio, angle, load, mean_velocity, radius_x, reduced_modulus, viscosity, alpha, &
                                    moes_m, moes_l
      integer(c_int), intent(in) :: border, smooth, thins, points, points_y, reverses, may_reduce
      !> Domain; maximum half lengths of the contact under a duty over those of the case
      real(c_double), intent(in) :: domain(3), widening(2)
      integer(c_int), intent(out) :: border_out, points_out, points_y_out
      real(c_double), intent(out) :: domain_out(3)
      type(case_t) :: input
      class(contact_t), allocatable :: contact
      type(scales_t) :: scales
      type(operating_t) :: point

      call set_case(input, line, roller, si, radius_ratio, angle, load, mean_velocity, radius_x, reduced_modulus, viscosity, &
                    alpha, moes_m, moes_l)
      call find_contact(input, contact, scales, point)
      associate (grid => input%grid)
         grid%border = merge("flooded", "zero   ", border == 2)
         grid%x_inlet = domain(1)
         grid%x_outlet = domain(2)
         grid%y_extent = domain(3)
         if (points > 0) grid%points = points
         grid%points_y = points_y
         call fill_grid(contact, point, smooth /= 0, thins /= 0, [border > 0, .not. ieee_is_nan(domain), points > 0], grid, &
                        widening, reverses /= 0, may_reduce /= 0)
         border_out = merge(2_c_int, 1_c_int, grid%border == "flooded")
         domain_out = [grid%x_inlet, grid%x_outlet, grid%y_extent]
         points_out = grid%points
         points_y_out = grid%points_y
      end associate
   end subroutine grid_defaults

   !> Set a contact from its code: 0 a point; 1 a line, with the load per length and its M and L; 2 a roller, with its own numbers
   pure subroutine set_case(input, line, roller, si, radius_ratio, angle, load, mean_velocity, radius_x, reduced_modulus, &
                            viscosity, alpha, moes_m, moes_l)
      type(case_t), intent(inout) :: input
      integer(c_int), intent(in) :: line, si
      real(c_double), intent(in) :: roller(:)
      real(c_double), intent(in) :: radius_ratio, angle, load, mean_velocity, radius_x, reduced_modulus, viscosity, alpha, &
                                    moes_m, moes_l

      input%contact%si = si /= 0
      if (line == 1) input%contact%shape = "line"
      if (line == 2) call set_roller(input%contact, roller)
      input%contact%load_per_length = load
      input%contact%moes_m_line = moes_m
      input%contact%moes_l_line = moes_l
      input%contact%radius_ratio = radius_ratio
      input%contact%angle = angle
      input%contact%load = load
      input%contact%mean_velocity = mean_velocity
      input%contact%radius_x = radius_x
      input%contact%reduced_modulus = reduced_modulus
      input%contact%moes_m = moes_m
      input%contact%moes_l = moes_l
      input%lubricant%viscosity = viscosity
      input%lubricant%pressure_viscosity = alpha
   end subroutine set_case

   !> Set a roller from its numbers: length and misalignment; for each body the index of its kind of profile, four parameters, the
   !> number of positions in its table, the positions and the drops
   pure subroutine set_roller(contact, numbers)
      type(contact_case_t), intent(inout) :: contact
      real(c_double), intent(in) :: numbers(:)
      character(len=11), parameter :: kinds(5) = [character(len=11) :: "none", "crown", "logarithmic", "chamfer", "file"]
      integer :: body, at, n

      contact%shape = "roller"
      contact%length = numbers(1)
      contact%misalignment = numbers(2)
      at = 2
      do body = 1, 2
         n = nint(numbers(at + 6))
         contact%profiles(body) = body_profile_t(kinds(nint(numbers(at + 1))), numbers(at + 2), numbers(at + 3), numbers(at + 4), &
                                                 numbers(at + 5), numbers(at + 7:at + 6 + n), numbers(at + 7 + n:at + 6 + 2*n))
         at = at + 6 + 2*n
      end do
   end subroutine set_roller

   !> Viscosity [Pa s], alpha [1/Pa] and -(d eta/dT)/eta [1/K] at the inlet from the law of &lubricant
   subroutine inlet(group, viscosity, alpha, slope, stat, key, message)
      character(len=*), intent(in) :: group
      real(c_double), intent(out) :: viscosity, alpha, slope
      integer(c_int), intent(out) :: stat
      character(len=64), intent(out) :: key
      character(len=4096), intent(out) :: message
      type(lubricant_case_t) :: lubricant
      type(status_t) :: status

      viscosity = 0.0_c_double
      alpha = 0.0_c_double
      slope = 0.0_c_double
      call read_lubricant(group, lubricant, status)
      if (.not. status%failed()) call inlet_of(lubricant, viscosity, alpha, slope, status)
      key = ""
      if (allocated(status%key)) key = status%key
      call reply(status, stat, message)
   end subroutine inlet

   !> Viscosity [Pa s] and -(d eta/dT)/eta [1/K] at a temperature [degC] from the kinematic viscosities at 40 and 100 degC
   subroutine sheet(temperature, viscosities, density_15, expansion, viscosity, slope)
      real(c_double), intent(in) :: temperature, viscosities(2), density_15, expansion
      real(c_double), intent(out) :: viscosity, slope

      viscosity = dynamic_viscosity(temperature, viscosities, density_15, expansion)
      slope = temperature_viscosity(temperature, viscosities, density_15, expansion)
   end subroutine sheet

   !> All keys with default and range, one per line, separated by tabs
   subroutine defaults(n, bytes, length)
      integer(c_int), intent(in) :: n
      integer(c_int), intent(inout) :: bytes(n)
      integer(c_int), intent(out) :: length
      character(len=:), allocatable :: text

      call defaults_text(text)
      call put_text(text, bytes, length)
   end subroutine defaults
end module ehl_f2py_case

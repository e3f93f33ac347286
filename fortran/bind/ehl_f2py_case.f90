! SPDX-License-Identifier: BSD-3-Clause
!> What the completion of a case in Python takes from the solver; for the rules see ehl_f2py_solver
module ehl_f2py_case
   use, intrinsic :: iso_c_binding, only: c_double, c_int
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use ehl_case, only: case_t
   use ehl_case_contact, only: complete_domain, find_contact
   use ehl_case_law, only: make_viscosity
   use ehl_contact, only: contact_t
   use ehl_group_reader, only: read_groups
   use ehl_handles, only: reply
   use ehl_heat, only: dynamic_viscosity, temperature_viscosity
   use ehl_keys, only: bind_keys
   use ehl_moes, only: operating_t
   use ehl_scales, only: scales_t
   use ehl_schema, only: schema_t
   use ehl_source, only: source_t
   use ehl_status, only: status_t
   use ehl_viscosity_law, only: viscosity_law_t
   implicit none (type, external)
   private
   public :: operating, grid_defaults, inlet, sheet

contains

   !> Hertz pressure [Pa] and radius [m], Moes numbers, M of the round contact, half lengths of the contact [a]
   subroutine operating(si, radius_ratio, angle, load, mean_velocity, radius_x, reduced_modulus, viscosity, alpha, moes_m, &
                        moes_l, hertz_pressure, hertz_radius, m, l, round_m, reach, even)
      integer(c_int), intent(in) :: si
      real(c_double), intent(in) :: radius_ratio, angle, load, mean_velocity, radius_x, reduced_modulus, viscosity, alpha, &
                                    moes_m, moes_l
      real(c_double), intent(out) :: hertz_pressure, hertz_radius, m, l, round_m, reach(2)
      integer(c_int), intent(out) :: even
      type(case_t) :: input
      class(contact_t), allocatable :: contact
      type(scales_t) :: scales
      type(operating_t) :: point

      call take(input, si, radius_ratio, angle, load, mean_velocity, radius_x, reduced_modulus, viscosity, alpha, moes_m, moes_l)
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
   subroutine grid_defaults(si, radius_ratio, angle, load, mean_velocity, radius_x, reduced_modulus, viscosity, alpha, moes_m, &
                            moes_l, border, smooth, domain, points, points_y, border_out, domain_out, points_out, points_y_out)
      integer(c_int), intent(in) :: si
      real(c_double), intent(in) :: radius_ratio, angle, load, mean_velocity, radius_x, reduced_modulus, viscosity, alpha, &
                                    moes_m, moes_l
      integer(c_int), intent(in) :: border, smooth, points, points_y
      real(c_double), intent(in) :: domain(3)
      integer(c_int), intent(out) :: border_out, points_out, points_y_out
      real(c_double), intent(out) :: domain_out(3)
      type(case_t), target :: input
      type(schema_t) :: schema
      integer :: k
      character(len=8), parameter :: ends(3) = [character(len=8) :: "x_inlet", "x_outlet", "y_extent"]

      call bind_keys(schema, input)
      call take(input, si, radius_ratio, angle, load, mean_velocity, radius_x, reduced_modulus, viscosity, alpha, moes_m, moes_l)
      if (smooth == 0) input%surface%kind = "harmonic"
      do k = 1, 3
         if (ieee_is_nan(domain(k))) cycle
         schema%keys(schema%find("grid", ends(k)))%given = .true.
         schema%keys(schema%find("grid", ends(k)))%real_value = domain(k)
      end do
      if (border > 0) then
         schema%keys(schema%find("grid", "border"))%given = .true.
         input%grid%border = merge("flooded", "zero   ", border == 2)
      end if
      if (points > 0) then
         schema%keys(schema%find("grid", "points"))%given = .true.
         input%grid%points = points
      end if
      input%grid%points_y = points_y
      call complete_domain(schema, input)
      border_out = merge(2_c_int, 1_c_int, input%grid%border == "flooded")
      domain_out = [input%grid%x_inlet, input%grid%x_outlet, input%grid%y_extent]
      points_out = input%grid%points
      points_y_out = input%grid%points_y
   end subroutine grid_defaults

   pure subroutine take(input, si, radius_ratio, angle, load, mean_velocity, radius_x, reduced_modulus, viscosity, alpha, &
                        moes_m, moes_l)
      type(case_t), intent(inout) :: input
      integer(c_int), intent(in) :: si
      real(c_double), intent(in) :: radius_ratio, angle, load, mean_velocity, radius_x, reduced_modulus, viscosity, alpha, &
                                    moes_m, moes_l

      input%contact%si = si /= 0
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
   end subroutine take

   !> Viscosity [Pa s], alpha [1/Pa] and -(d eta/dT)/eta [1/K] at the inlet, by the law of &lubricant
   subroutine inlet(group, viscosity, alpha, slope, stat, key, message)
      character(len=*), intent(in) :: group
      real(c_double), intent(out) :: viscosity, alpha, slope
      integer(c_int), intent(out) :: stat
      character(len=64), intent(out) :: key
      character(len=4096), intent(out) :: message
      type(case_t), target :: input
      type(schema_t) :: schema
      type(status_t) :: status
      class(viscosity_law_t), allocatable :: law
      real(c_double) :: slopes(1), level(1), at(2)
      !> [K] the error of the difference is its square over some hundred K^2
      real(c_double), parameter :: step = 0.01_c_double

      viscosity = 0.0_c_double
      alpha = 0.0_c_double
      slope = 0.0_c_double
      key = ""
      call bind_keys(schema, input)
      call read_groups(source_t("the lubricant", group//new_line("a")), schema, status)
      ! a pressure of 1 Pa
      if (.not. status%failed()) call make_viscosity(input%lubricant, trim(input%lubricant%viscosity_law), 1.0_c_double, law, &
                                                     status)
      if (.not. status%failed()) then
         viscosity = law%ambient_viscosity
         call law%log_viscosity([0.0_c_double], level, slopes)
         call law%log_viscosity_at([0.0_c_double, 0.0_c_double], [-step, step], at)
         alpha = slopes(1)
         slope = (at(1) - at(2))/(2.0_c_double*step)
      end if
      call reply(status, stat, message)
   end subroutine inlet

   !> Viscosity [Pa s] and -(d eta/dT)/eta [1/K] at a temperature [degC], of kinematic viscosities at 40 and 100 degC
   subroutine sheet(temperature, viscosities, density_15, expansion, viscosity, slope)
      real(c_double), intent(in) :: temperature, viscosities(2), density_15, expansion
      real(c_double), intent(out) :: viscosity, slope

      viscosity = dynamic_viscosity(temperature, viscosities, density_15, expansion)
      slope = temperature_viscosity(temperature, viscosities, density_15, expansion)
   end subroutine sheet
end module ehl_f2py_case

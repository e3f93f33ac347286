! SPDX-License-Identifier: BSD-3-Clause
!> The contact of a case: Moes numbers or SI values, an operating point that can be meant, and the motion of the surfaces
module ehl_case_contact
   use ehl_case, only: case_t
   use ehl_contact, only: contact_t
   use ehl_contact_factory, only: hertz_scales, new_contact
   use ehl_domain, only: domain_t, flooded_by_default, needed_domain
   use ehl_grid, only: find_levels
   use ehl_grid_error, only: relative_errors
   use ehl_kinds, only: dp, pi
   use ehl_moes, only: operating_from_moes, operating_from_si, operating_t
   use ehl_keys, only: bind_keys
   use ehl_scales, only: scales_t
   use ehl_schema, only: schema_t
   use ehl_status, only: status_t
   use ehl_text, only: short, to_text
   implicit none (type, external)
   private
   public :: check_contact_kind, check_operating_point, check_extent, complete_domain, complete_kinematics, &
             find_contact, hertz_pressure, operating_point

   character(len=12), parameter :: moes_keys(3) = [character(len=12) :: "moes_m", "moes_l", "radius_ratio"]
   character(len=16), parameter :: si_keys(6) = &
      [character(len=16) :: "load", "mean_velocity", "radius", "reduced_modulus", "radius_x", "radius_y"]
   !> Least distance of the sides of the domain, in terms of the contact
   real(dp), parameter :: beyond_contact = 1.05_dp
   !> Fewest and most intervals along Y of a coarsest grid
   integer, parameter :: fewest_rows = 8, few_rows = 32
   !> Least and largest ratio of the sides of a cell
   real(dp), parameter :: least_ratio = 0.25_dp, largest_ratio = 1.41_dp
   !> Largest M of a round contact with the same equations
   real(dp), parameter :: most_m = 1.0e5_dp
   character(len=*), parameter :: too_large_m = "the Moes parameter M of the round contact with the same equations is "
   !> Largest a-priori error of H_c that the usual grid of a smooth contact may have
   real(dp), parameter :: most_missed = 0.05_dp
   !> Least p_h/E' of a contact that can be meant: 0.1 MPa between steel bodies
   real(dp), parameter :: least_strain = 4.0e-7_dp
   !> Difference of velocity ratios that is none
   real(dp), parameter :: rounding = 1.0e-9_dp

contains

   !> Moes numbers or SI values, not both
   subroutine check_contact_kind(schema, input, status)
      type(schema_t), intent(in) :: schema
      type(case_t), intent(inout) :: input
      type(status_t), intent(inout) :: status
      integer :: moes, si

      moes = schema%first_given("contact", moes_keys)
      si = schema%first_given("contact", si_keys)
      input%contact%si = moes == 0
      if (moes > 0 .and. si > 0) call schema%contradict(schema%keys(moes)%full_name(), schema%keys(si)%full_name(), &
         "moes_m, moes_l and radius_ratio, or load, mean_velocity, reduced_modulus and radius or radius_x and radius_y", status)
   end subroutine check_contact_kind

   !> SI values must make a contact that can exist; a slip of units mostly does not
   subroutine check_operating_point(schema, input, status)
      type(schema_t), intent(in) :: schema
      type(case_t), intent(in) :: input
      type(status_t), intent(inout) :: status
      class(contact_t), allocatable :: contact
      type(scales_t) :: scales
      type(operating_t) :: point
      real(dp) :: least
      character(len=:), allocatable :: what, expected

      call find_contact(input, contact, scales, point)
      if (.not. input%contact%si) then
         if (point%round_m > most_m) then
            call schema%refuse("contact.moes_m", too_large_m//short(point%round_m), "a moes_m that makes it 1e5 at most", status)
            return
         end if
         if (input%lubricant%pressure_viscosity > 0.0_dp .or. .not. input%contact%moes_l > 0.0_dp) return
         call schema%contradict("lubricant.pressure_viscosity", "contact.moes_l", &
                                "moes_l = 0.0, or a pressure_viscosity above 0", status)
         return
      end if
      what = ""
      expected = ""
      least = least_strain*input%contact%reduced_modulus
      if (scales%pressure < least .or. scales%pressure > 2.0e10_dp) then
         what = "the Hertz pressure is " // short(scales%pressure) // " Pa"
         expected = "values in SI units with a Hertz pressure between "//short(least)//" Pa (4e-7 of reduced_modulus) and 2e10 Pa"
      else if (scales%length > input%contact%radius_x) then
         what = "the Hertz radius " // short(scales%length) // " m exceeds that of the ball"
         expected = "values in SI units with a contact much smaller than the ball"
      else if (point%moes_m < 0.1_dp) then
         what = "the Moes parameter M is " // short(point%moes_m)
         expected = "values in SI units with M of 0.1 at least"
      else if (point%round_m > most_m) then
         what = too_large_m // short(point%round_m)
         expected = "values in SI units with an M between 0.1 and 1e5"
      else if (point%moes_l > 100.0_dp) then
         what = "the Moes parameter L is " // short(point%moes_l)
         expected = "values in SI units with L of 100 at most"
      end if
      if (what == "") return
      associate (key => schema%keys(most_unusual(schema)))
         call schema%refuse(key%full_name(), what // " with " // key%full_name() // " = " // key%value_text(), &
                            expected // key%in_millimetres(key%value_text()), status)
      end associate
   end subroutine check_operating_point

   !> Shape, scales and operating point, without the heat of the inlet
   subroutine find_contact(input, contact, scales, point)
      type(case_t), intent(in) :: input
      class(contact_t), allocatable, intent(out) :: contact
      type(scales_t), intent(out) :: scales
      type(operating_t), intent(out) :: point

      call new_contact(input%contact%radius_ratio, input%contact%angle*pi/180.0_dp, contact)
      associate (c => input%contact, l => input%lubricant)
         if (c%si) then
            scales = hertz_scales(contact, c%load, c%radius_x, c%reduced_modulus)
            point = operating_point(input, contact, scales, l%viscosity)
         else
            point = operating_from_moes(c%moes_m, c%moes_l, contact%ellipticity, contact%kernel_factor)
            if (point%alpha_bar > 0.0_dp) scales%pressure = point%alpha_bar/l%pressure_viscosity
         end if
      end associate
   end subroutine find_contact

   !> Operating point of a contact in SI units with a viscosity [Pa s]
   pure function operating_point(input, contact, scales, viscosity) result(point)
      type(case_t), intent(in) :: input
      class(contact_t), intent(in) :: contact
      type(scales_t), intent(in) :: scales
      real(dp), intent(in) :: viscosity
      type(operating_t) :: point

      associate (c => input%contact)
         point = operating_from_si(c%load, c%mean_velocity, c%radius_x, c%reduced_modulus, viscosity, &
                                   input%lubricant%pressure_viscosity, scales%pressure, contact%ellipticity, &
                                   contact%kernel_factor)
      end associate
   end function operating_point

   !> Hertz pressure of a case [Pa]
   real(dp) function hertz_pressure(input)
      type(case_t), intent(in) :: input
      class(contact_t), allocatable :: contact
      type(scales_t) :: scales
      type(operating_t) :: point

      call find_contact(input, contact, scales, point)
      hertz_pressure = scales%pressure
   end function hertz_pressure

   !> The domain must hold the contact
   subroutine check_extent(schema, input, status)
      type(schema_t), intent(in) :: schema
      type(case_t), intent(in) :: input
      type(status_t), intent(inout) :: status
      class(contact_t), allocatable :: contact
      type(scales_t) :: scales
      type(operating_t) :: point
      character(len=*), parameter :: borders(3) = [character(len=13) :: "grid.x_inlet", "grid.x_outlet", "grid.y_extent"]
      real(dp) :: ends(3)
      integer :: axis, k

      call find_contact(input, contact, scales, point)
      if (input%grid%border == "flooded" .and. .not. contact%is_even()) then
         call schema%refuse("grid.border", "grid.border = 'flooded' with contact.angle = " &
                            // to_text(input%contact%angle), "'zero': the pressure far from a turned contact is not known", status)
         return
      end if
      ends = [-input%grid%x_inlet, input%grid%x_outlet, input%grid%y_extent]
      do k = 1, 3
         axis = merge(2, 1, k == 3)
         if (ends(k) >= beyond_contact*contact%reach(axis)) cycle
         call schema%refuse(trim(borders(k)), trim(borders(k)) // " is " // short(ends(k)) &
                            // " a from the centre, and the contact reaches to " // short(contact%reach(axis)) // " a", &
                            "at least " // short(beyond_contact*contact%reach(axis)) // " a", status)
         return
      end do
   end subroutine check_extent

   !> Border and domain follow from the operating point, side by side, unless they are given
   subroutine complete_domain(schema, input)
      type(schema_t), intent(in) :: schema
      type(case_t), intent(inout) :: input
      class(contact_t), allocatable :: contact
      type(scales_t) :: scales
      type(operating_t) :: point
      type(domain_t) :: domain

      call find_contact(input, contact, scales, point)
      if (.not. schema%given("grid", "border") .and. flooded_by_default(contact, point) .and. contact%is_even()) then
         input%grid%border = "flooded"
      end if
      domain = needed_domain(contact, point, input%grid%border == "flooded")
      if (.not. schema%given("grid", "x_inlet")) input%grid%x_inlet = domain%inlet
      if (.not. schema%given("grid", "x_outlet")) input%grid%x_outlet = domain%outlet
      if (.not. schema%given("grid", "y_extent")) input%grid%y_extent = domain%side
      if (.not. schema%given("grid", "points") .and. .not. input%grid%target_error > 0.0_dp .and. &
          input%surface%kind == "smooth" .and. input%second_surface%kind == "smooth") then
         if (misses_much(input, contact, point)) input%grid%points = 2*input%grid%points - 1
      end if
      if (.not. input%grid%points_y > 0) input%grid%points_y = rows(input, contact)
   end subroutine complete_domain

   !> Whether the usual grid misses more of the film than a smooth contact may
   pure logical function misses_much(input, contact, point)
      type(case_t), intent(in) :: input
      class(contact_t), intent(in) :: contact
      type(operating_t), intent(in) :: point
      real(dp) :: errors(2)

      associate (g => input%grid)
         errors = relative_errors(contact, point, (g%x_outlet - g%x_inlet)/(g%points - 1))
      end associate
      misses_much = errors(1) > most_missed
   end function misses_much

   !> Nodes along Y: as many as along X in a round contact, else as many as make cells of the shape wanted
   pure integer function rows(input, contact)
      type(case_t), intent(in) :: input
      class(contact_t), intent(in) :: contact
      integer :: levels, intervals(2), halved, multiple
      real(dp) :: wanted

      rows = input%grid%points
      if (contact%is_round()) return
      call find_levels(rows, rows, levels, intervals)
      if (levels == 0) return
      halved = (rows - 1)/intervals(1)
      associate (g => input%grid)
         wanted = 2.0_dp*g%y_extent*intervals(1)/(cell_ratio(contact%reach(2)/contact%reach(1))*(g%x_outlet - g%x_inlet))
      end associate
      ! many rows are halved further, until they are few
      multiple = 2
      do while (wanted > 0.5_dp*multiple*few_rows)
         multiple = 2*multiple
      end do
      rows = max(fewest_rows, multiple*nint(wanted/multiple))*halved + 1
   end function rows

   !> Side of a cell along Y over that along X: cells longer along the longer axis reach the same error with fewer nodes, as
   !> long as multigrid converges as on square ones
   pure real(dp) function cell_ratio(elongation)
      real(dp), intent(in) :: elongation
      cell_ratio = min(largest_ratio, max(least_ratio, elongation))
   end function cell_ratio

   !> Of the keys that were given and make the operating point the one whose value is the least usual
   integer function most_unusual(schema) result(culprit)
      type(schema_t), intent(in) :: schema
      type(case_t), target :: usual
      type(schema_t) :: defaults
      character(len=9), parameter :: groups(12) = [character(len=9) :: "contact", "contact", "contact", "contact", &
         "contact", "contact", "lubricant", "lubricant", "bodies", "bodies", "bodies", "bodies"]
      character(len=18), parameter :: names(12) = [character(len=18) :: si_keys, "viscosity", "pressure_viscosity", &
                                                   "radius_x1", "radius_y1", "radius_x2", "radius_y2"]
      !> Powers of ten around their defaults that are common; the radii of bodies around that of the ball
      real(dp), parameter :: common(12) = [3.0_dp, 2.0_dp, 1.0_dp, 0.5_dp, 1.0_dp, 1.0_dp, 2.0_dp, 0.5_dp, 1.0_dp, 1.0_dp, &
                                           1.0_dp, 1.0_dp]
      real(dp) :: value, unusual, most
      integer :: k, at

      call bind_keys(defaults, usual)
      culprit = schema%find("lubricant", "viscosity")
      most = -1.0_dp
      do k = 1, size(names)
         at = schema%find(groups(k), names(k))
         if (.not. schema%keys(at)%given) cycle
         ! flat
         if (groups(k) == "bodies" .and. .not. abs(schema%keys(at)%real_value) > 0.0_dp) cycle
         value = defaults%keys(at)%real_value
         if (index(names(k), "radius") == 1) value = usual%contact%radius
         unusual = abs(log10(abs(schema%keys(at)%real_value)/value))/common(k)
         if (unusual <= most) cycle
         most = unusual
         culprit = at
      end do
   end function most_unusual

   !> Of slide-to-roll ratio and velocities of the surfaces one gives the others: body 1 moves at 1 + SRR/2, body 2 at
   !> 1 - SRR/2 times the mean velocity
   subroutine complete_kinematics(schema, input, status)
      type(schema_t), intent(in) :: schema
      type(case_t), intent(inout) :: input
      type(status_t), intent(inout) :: status
      real(dp) :: side

      side = merge(1.0_dp, -1.0_dp, input%contact%rough_surface == 1)
      associate (first => input%surface%velocity_ratio, second => input%second_surface%velocity_ratio, &
                 srr => input%contact%slide_to_roll)
         if (schema%given("surface", "velocity_ratio") .and. schema%given("second_surface", "velocity_ratio")) then
            if (abs(first + second - 2.0_dp) > rounding) then
               call schema%contradict("surface.velocity_ratio", "second_surface.velocity_ratio", &
                  "one of the two, or velocity ratios that add up to 2: contact.mean_velocity is the mean of both bodies", &
                  status, to_text(first) // " and " // to_text(second) // " add up to " // to_text(first + second))
               return
            end if
         end if
         if (.not. schema%given("contact", "slide_to_roll")) then
            if (schema%given("surface", "velocity_ratio")) then
               srr = sliding(side, first)
            else if (schema%given("second_surface", "velocity_ratio")) then
               srr = sliding(-side, second)
            end if
         end if
         call settle_velocity(schema, "surface", input%contact%rough_surface, srr, first, status)
         call settle_velocity(schema, "second_surface", 3 - input%contact%rough_surface, srr, second, status)
      end associate
   end subroutine complete_kinematics

   !> The velocity of a surface, which follows from the slide-to-roll ratio; one that was given must agree with it
   subroutine settle_velocity(schema, group, body, srr, ratio, status)
      type(schema_t), intent(in) :: schema
      character(len=*), intent(in) :: group
      !> Which body the surface is on: 1 or 2
      integer, intent(in) :: body
      real(dp), intent(in) :: srr
      real(dp), intent(inout) :: ratio
      type(status_t), intent(inout) :: status
      real(dp) :: side, follows

      side = merge(1.0_dp, -1.0_dp, body == 1)
      follows = 1.0_dp + 0.5_dp*side*srr
      if (.not. schema%given(group, "velocity_ratio")) then
         ratio = follows
      else if (schema%given("contact", "slide_to_roll") .and. abs(ratio - follows) > rounding .and. &
               .not. status%failed()) then
         call schema%contradict(group // ".velocity_ratio", "contact.slide_to_roll", &
            "one of the two, or slide_to_roll = " // to_text(sliding(side, ratio)) // " with this velocity_ratio", &
            status, "with contact.slide_to_roll = " // to_text(srr) // ", &" // group // ", on body " // to_text(body) &
            // ", moves at " // to_text(follows) // " times the mean velocity, not at " // to_text(ratio))
      end if
   end subroutine settle_velocity

   !> Slide-to-roll ratio from the velocity of the rough surface, free of the rounding of the difference: 0.02 for 1.01
   pure real(dp) function sliding(side, ratio)
      !> 1 for surface 1, -1 for surface 2
      real(dp), intent(in) :: side, ratio
      sliding = anint(side*(ratio - 1.0_dp)*2.0e12_dp)/1.0e12_dp
   end function sliding
end module ehl_case_contact

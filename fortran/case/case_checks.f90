! SPDX-License-Identifier: BSD-3-Clause
!> Checks of combinations of keys: keys that exclude each other, operating points and domains that cannot be solved, and values that
!> pyehl has to derive
module ehl_case_checks
   use ehl_case, only: case_t, surface_case_t
   use ehl_case_check_duty, only: check_duty
   use ehl_case_check_inlet, only: beyond_contact, check_inlet, rounding
   use ehl_case_check_lubricant, only: check_lubricant
   use ehl_case_check_surface, only: check_surfaces
   use ehl_case_check_line, only: check_line
   use ehl_case_check_roller, only: check_length, check_roller
   use ehl_case_defaults, only: moes_keys, si_keys, sliding, velocity_ratio
   use ehl_case_point, only: find_contact
   use ehl_case_source, only: case_source_t
   use ehl_contact, only: contact_t
   use ehl_grid, only: find_levels, max_coarsest
   use ehl_kinds, only: dp
   use ehl_moes, only: operating_t
   use ehl_scales, only: scales_t
   use ehl_status, only: status_t
   use ehl_text, only: short, to_text
   implicit none (type, external)
   private
   public :: check_given, check_complete

   !> Maximum M of the equivalent round contact
   real(dp), parameter :: max_m = 1.0e5_dp
   !> Minimum p_h/E' of a plausible contact: 0.1 MPa between steel bodies
   real(dp), parameter :: min_strain = 4.0e-7_dp
   !> Difference below which velocity ratios are equal
   real(dp), parameter :: same_velocity = 1.0e-9_dp
   !> Rq over Ra of normally distributed heights; relative difference below which two heights are equal
   real(dp), parameter :: rq_over_ra = sqrt(0.5_dp*acos(-1.0_dp)), same_height = 1.0e-6_dp
   character(len=*), parameter :: by_pyehl = "what 'pyehl check CASE.nml --resolved out.nml' writes, for ehl out.nml; or ", &
      si_units = "load, mean_velocity, reduced_modulus and radius or radius_x and radius_y", &
      of_line = "moes_m_line and moes_l_line, or load_per_length, mean_velocity, reduced_modulus and radius"

contains

   !> Checks before the defaults are set: contradictory keys, and keys from which pyehl derives others
   subroutine check_given(source, input, status)
      type(case_source_t), intent(in) :: source
      type(case_t), intent(in) :: input
      type(status_t), intent(inout) :: status
      character(len=:), allocatable :: moes, si, expected
      character(len=22), parameter :: profile_files(2) = [character(len=22) :: "contact.profile_file", "contact.profile_file_2"]
      character(len=14), parameter :: tables(2, 2) = reshape([character(len=14) :: "profile_y", "profile_drop", &
                                                                                   "profile_y_2", "profile_drop_2"], [2, 2])
      integer :: body

      call check_line(source, input, status)
      call check_roller(source, input, status)
      moes = source%first_given("contact", moes_keys)
      si = source%first_given("contact", si_keys)
      if (moes /= "" .and. si /= "") then
         expected = "moes_m, moes_l and radius_ratio, or "//si_units
         if (input%contact%is_line()) expected = of_line
         call source%contradict(moes, si, expected, status)
      end if
      associate (c => input%contact)
         if (source%given("contact.radius") .and. (c%radius_x > 0.0_dp .or. c%radius_y > 0.0_dp)) then
           call source%contradict("contact.radius", source%first_given("contact", si_keys(6:)), &
                                   "radius of a round contact, or radius_x and radius_y", status)
         end if
         if ((c%radius_x > 0.0_dp) .neqv. (c%radius_y > 0.0_dp)) then
           call source%refuse(source%first_given("contact", si_keys(6:)), "one of contact.radius_x and radius_y", &
                               "both, or contact.radius of a round contact", status)
         end if
      end associate
      if (input%contact%is_cylinder()) then
         call need(source%first_given("bodies"), "contact", si_keys(4:5), "reduced radius and modulus alone")
      else
         call need(source%first_given("bodies"), "contact", si_keys(5:7), "reduced radii and modulus alone")
      end if
      call need(if_given("lubricant.name"), "lubricant", [character(len=18) :: "viscosity", "pressure_viscosity", &
                                                          "viscosity_law"], "the constants of the oil")
      if (input%lubricant%kinematic_viscosity_40 > 0.0_dp) call need("lubricant.kinematic_viscosity_40", "lubricant", &
                [character(len=21) :: "viscosity", "pressure_viscosity", "temperature_viscosity"], "the viscosity at the inlet")
      call need(if_given("lubricant.table"), "lubricant", [character(len=17) :: "viscosity_law", "table_temperature", &
                                                           "table_pressure", "table_viscosity"], "another law")
      call need(if_given("duty.file"), "duty", ["time"], "the values of the table")
      do body = 1, 2
         if (input%contact%profiles(body)%kind /= "file") cycle
         call need(if_given(trim(profile_files(body))), "contact", tables(:, body), "the values of the table")
      end do
      call need_height("surface", input%surface)
      call need_height("second_surface", input%second_surface)

   contains

      !> The key if it is given, otherwise ''
      function if_given(name) result(key)
         character(len=*), intent(in) :: name
         character(len=:), allocatable :: key
         key = ""
         if (source%given(name)) key = name
      end function if_given

      !> Refuse a key that the solver does not use without the values that pyehl derives from it. Those of a resolved case do not
      !> follow from an option.
      subroutine need(key, group, keys, or)
         character(len=*), intent(in) :: key, group, keys(:), or
         integer :: k

         if (key == "") return
         do k = 1, size(keys)
            if (source%given(group//"."//keys(k)) .and. .not. (source%by_option(key) .and. &
                                                               source%derived(group//"."//keys(k)))) cycle
            call source%refuse(key, key//" without "//group//"."//trim(keys(k))//", which pyehl derives from it", by_pyehl//or, &
                               status)
            return
         end do
      end subroutine need

      subroutine need_height(group, s)
         character(len=*), intent(in) :: group
         type(surface_case_t), intent(in) :: s
         character(len=:), allocatable :: key

         key = ""
         if (s%finish /= "none") key = group//".finish"
         if (s%rq > 0.0_dp) key = group//".rq"
         if (s%ra > 0.0_dp) key = group//".ra"
         call need(key, group, [character(len=10) :: "kind", "rms_height"], "rms_height alone")
         if (s%finish /= "none") call need(group//".finish", group, ["rolloff_wavenumber"], "the values of the finish alone")
         if (.not. status%failed() .and. key /= group//".finish" .and. key /= "") then
            if (abs(merge(rq_over_ra*s%ra, s%rq, s%ra > 0.0_dp) - s%rms_height) > same_height*s%rms_height) then
               call source%contradict(key, group//".rms_height", "one of the two", status)
            end if
         end if
      end subroutine need_height
   end subroutine check_given

   !> Checks of a complete case
   subroutine check_complete(source, input, status)
      type(case_source_t), intent(in) :: source
      type(case_t), intent(in) :: input
      type(status_t), intent(inout) :: status
      class(contact_t), allocatable :: contact
      type(scales_t) :: scales
      type(operating_t) :: point

      call check_bodies(source, input, status)
      if (.not. input%contact%is_line()) then
         call source%check_range("contact.radius_ratio", input%contact%radius_ratio, "contact.radius_y", "radius_x/radius_y", &
                                 status)
      end if
      if (status%failed()) return
      call find_contact(input, contact, scales, point)
      call check_length(source, input, scales, status)
      call check_point(source, input, scales, point, status)
      call check_inlet(source, input, contact, scales, status)
      call check_domain(source, input, contact, status)
      call check_points(source, input, status)
      call check_motion(source, input, status)
      if (.not. status%failed()) call check_lubricant(source, input, scales, point, status)
      if (.not. status%failed()) call check_surfaces(source, input, status)
      call check_duty(source, input, status)
      if (input%time%steps > 0 .and. input%time%max_periods > 0) then
        call source%contradict("time.max_periods", "time.steps", "one of the two, the other 0", status)
      end if
   end subroutine check_complete

   !> Reduced radii and modulus must be those of the bodies
   subroutine check_bodies(source, input, status)
      type(case_source_t), intent(in) :: source
      type(case_t), intent(in) :: input
      type(status_t), intent(inout) :: status

      if (.not. input%bodies%given) return
      associate (b => input%bodies, c => input%contact)
         call agree("radius_x", 1.0_dp/c%radius_x, curvature(b%radius_x1) + curvature(b%radius_x2))
         if (.not. c%is_cylinder()) call agree("radius_y", 1.0_dp/c%radius_y, curvature(b%radius_y1) + curvature(b%radius_y2))
         call agree("reduced_modulus", 2.0_dp/c%reduced_modulus, (1.0_dp - b%poisson_1**2)/b%modulus_1 &
                    + (1.0_dp - b%poisson_2**2)/b%modulus_2)
      end associate

   contains

      pure real(dp) function curvature(radius)
         real(dp), intent(in) :: radius
         curvature = 0.0_dp
         if (abs(radius) > 0.0_dp) curvature = 1.0_dp/radius
      end function curvature

      subroutine agree(key, value, derived)
         character(len=*), intent(in) :: key
         real(dp), intent(in) :: value, derived
         if (abs(value - derived) > rounding*abs(value)) call source%refuse("contact."//key, "contact."//key// &
            " is not that of &bodies", by_pyehl//"one of the two", status)
      end subroutine agree
   end subroutine check_bodies

   !> Refuse implausible operating points, which mostly follow from wrong units
   subroutine check_point(source, input, scales, point, status)
      type(case_source_t), intent(in) :: source
      type(case_t), intent(in) :: input
      type(scales_t), intent(in) :: scales
      type(operating_t), intent(in) :: point
      type(status_t), intent(inout) :: status
      character(len=:), allocatable :: key
      real(dp) :: minimum

      key = merge("contact.load  ", "contact.moes_m", input%contact%si)
      if (input%contact%is_line()) key = merge("contact.load_per_length", "contact.moes_m_line    ", input%contact%si)
      if (.not. input%contact%si) then
         call check_largest()
         if (point%moes_l > 0.0_dp .and. .not. input%lubricant%pressure_viscosity > 0.0_dp) then
           call source%contradict("lubricant.pressure_viscosity", trim(merge("contact.moes_l_line", "contact.moes_l     ", &
                                   input%contact%is_line())), "an L of 0, or a pressure_viscosity above 0", status)
         end if
         return
      end if
      minimum = min_strain*input%contact%reduced_modulus
      if (scales%pressure < minimum .or. scales%pressure > 2.0e10_dp) then
         call source%refuse(trim(key), "the Hertz pressure is "//short(scales%pressure)//" Pa", "values in SI units with one "// &
                            "between "//short(minimum)//" Pa (4e-7 of reduced_modulus) and 2e10 Pa", status)
      else if (scales%length > input%contact%radius_x) then
         call source%refuse(trim(key), "the Hertz radius "//short(scales%length)//" m exceeds the reduced radius", &
                            "values in SI units with a contact much smaller than the reduced radius", status)
      else if (point%moes_m < 0.1_dp) then
         call source%refuse(trim(key), "the Moes parameter M is "//short(point%moes_m), "values in SI units with 0.1 at least", &
                            status)
      else if (point%moes_l > 100.0_dp) then
         call source%refuse("lubricant.pressure_viscosity", "the Moes parameter L is "//short(point%moes_l), &
                            "values in SI units with 100 at most", status)
      end if
      call check_largest()

   contains

      subroutine check_largest()
         if (point%round_m > max_m) call source%refuse(trim(key), "the Moes parameter M of the round contact with the same "// &
            "equations is "//short(point%round_m), "an M of 1e5 at most", status)
      end subroutine check_largest
   end subroutine check_point

   !> The domain must contain the contact
   subroutine check_domain(source, input, contact, status)
      type(case_source_t), intent(in) :: source
      type(case_t), intent(in) :: input
      class(contact_t), intent(in) :: contact
      type(status_t), intent(inout) :: status
      character(len=*), parameter :: borders(3) = [character(len=13) :: "grid.x_inlet", "grid.x_outlet", "grid.y_extent"]
      real(dp) :: ends(3), reach(3)
      integer :: k

      if (input%grid%border == "flooded" .and. .not. contact%is_even()) call source%refuse("grid.border", &
         "grid.border = 'flooded' with contact.angle = "//to_text(input%contact%angle), &
         "'zero': the pressure far from a rotated contact is not known", status)
      ends = [-input%grid%x_inlet, input%grid%x_outlet, input%grid%y_extent]
      reach = contact%reach([1, 1, 2])
      do k = 1, merge(2, 3, input%contact%is_cylinder())
         if (ends(k) < beyond_contact*reach(k)) call source%refuse(trim(borders(k)), trim(borders(k))//" is "//short(ends(k))// &
            " a from the centre, and the contact reaches to "//short(reach(k))//" a", "at least "// &
            short(beyond_contact*reach(k))//" a", status)
      end do
   end subroutine check_domain

   !> Halving points - 1 must lead to a possible coarsest grid, and points_y - 1 must be divisible as often
   subroutine check_points(source, input, status)
      type(case_source_t), intent(in) :: source
      type(case_t), intent(in) :: input
      type(status_t), intent(inout) :: status
      integer :: below, above, step, levels, intervals(2)

      associate (nx => input%grid%points, ny => input%grid%points_y)
         below = nx
         do while (below > 17 .and. .not. has_levels(below, below))
            below = below - 1
         end do
         above = nx
         do while (.not. has_levels(above, above))
            above = above + 1
         end do
         if (above > nx) then
            call source%refuse("grid.points", "grid.points = "//to_text(nx)//": too few grids can be made by halving", &
                               "an odd number with points - 1 halved down to an even number of "//to_text(max_coarsest)// &
                               " or less; the nearest are "//to_text(below)//" and "//to_text(above), status)
            return
         end if
         if (input%contact%is_line()) return
         call source%check_range("grid.points_y", real(ny, dp), "grid.y_extent", "domain and grid.points", status)
         if (status%failed()) return
         call find_levels(nx, nx, levels, intervals)
         step = 2*((nx - 1)/intervals(1))
         if (mod(ny - 1, step) == 0 .and. has_levels(nx, ny)) return
         below = max(4*step, ((ny - 1)/step)*step)
         call source%refuse("grid.points_y", "grid.points_y = "//to_text(ny)//" with "//to_text(nx)//" nodes along X", &
                            "points_y - 1 in multiples of "//to_text(step)//": the nearest are "//to_text(below + 1)//" and "// &
                            to_text(below + step + 1), status)
      end associate
   end subroutine check_points

   !> Whether a grid can be coarsened far enough
   pure logical function has_levels(nx, ny)
      integer, intent(in) :: nx, ny
      integer :: levels, intervals(2)

      call find_levels(nx, ny, levels, intervals)
      has_levels = levels > 0
   end function has_levels

   !> The velocities of both surfaces must follow from the slide-to-roll ratio
   subroutine check_motion(source, input, status)
      type(case_source_t), intent(in) :: source
      type(case_t), intent(in) :: input
      type(status_t), intent(inout) :: status

      call check("surface", input%contact%rough_surface, input%surface%velocity_ratio)
      call check("second_surface", 3 - input%contact%rough_surface, input%second_surface%velocity_ratio)

   contains

      subroutine check(group, body, ratio)
         character(len=*), intent(in) :: group
         integer, intent(in) :: body
         real(dp), intent(in) :: ratio

         if (abs(ratio - velocity_ratio(body, input%contact%slide_to_roll)) <= same_velocity) return
         call source%refuse(group//".velocity_ratio", group//".velocity_ratio = "//to_text(ratio)//" with "// &
            "contact.slide_to_roll = "//to_text(input%contact%slide_to_roll), "one of the two, or slide_to_roll = "// &
            to_text(sliding(body, ratio))//"; velocity ratios of both surfaces add up to 2", status)
      end subroutine check
   end subroutine check_motion
end module ehl_case_checks

! SPDX-License-Identifier: BSD-3-Clause
!> What one key alone cannot tell: keys that exclude each other, defaults that depend on other
!> keys, and operating points that cannot be meant
module ehl_case_check
   use ehl_case, only: case_t
   use ehl_case_contact, only: check_contact_kind, check_extent, check_operating_point, complete_domain, &
                               complete_kinematics
   use ehl_case_lubricant, only: check_boundary_film, check_shear_law, complete_lubricant
   use ehl_case_oil, only: check_law, complete_law, complete_oil
   use ehl_case_radii, only: complete_radii
   use ehl_case_surface, only: check_surfaces, complete_surfaces
   use ehl_case_temperature, only: check_heat, complete_alpha, complete_viscosity
   use ehl_grid, only: coarsest_most, find_levels
   use ehl_schema, only: schema_t
   use ehl_status, only: status_t
   use ehl_text, only: to_text
   implicit none (type, external)
   private
   public :: check_case, complete_case

contains

   !> Check a case whose keys are all good by themselves, and complete it
   subroutine check_case(schema, input, status)
      type(schema_t), intent(in) :: schema
      type(case_t), intent(inout) :: input
      type(status_t), intent(inout) :: status

      call check_contact_kind(schema, input, status)
      call complete_radii(schema, input, status)
      if (.not. status%failed()) call complete_oil(schema, input, status)
      if (.not. status%failed()) call complete_viscosity(schema, input, status)
      if (.not. status%failed()) call complete_alpha(schema, input, status)
      if (.not. status%failed()) call complete_law(schema, input, status)
      if (.not. status%failed()) call check_operating_point(schema, input, status)
      if (.not. status%failed()) call complete_domain(schema, input)
      if (.not. status%failed()) call check_extent(schema, input, status)
      if (.not. status%failed()) call complete_kinematics(schema, input, status)
      if (.not. status%failed()) call complete_lubricant(schema, input, status)
      if (.not. status%failed()) call check_law(schema, input, status)
      if (.not. status%failed()) call check_shear_law(schema, input, status)
      if (.not. status%failed()) call check_boundary_film(schema, input, status)
      if (.not. status%failed()) call check_heat(schema, input, status)
      if (.not. status%failed()) call check_points(schema, input, status)
      if (.not. status%failed()) call complete_surfaces(schema, input)
      if (.not. status%failed()) call check_surfaces(schema, input, status)
      if (.not. status%failed()) call check_time(schema, input, status)
   end subroutine check_case

   !> Give values to keys that follow from others; check_case tells what contradicts
   subroutine complete_case(schema, input)
      type(schema_t), intent(in) :: schema
      type(case_t), intent(inout) :: input
      type(status_t) :: ignored(8)

      call check_contact_kind(schema, input, ignored(1))
      call complete_radii(schema, input, ignored(2))
      call complete_oil(schema, input, ignored(3))
      call complete_viscosity(schema, input, ignored(4))
      call complete_alpha(schema, input, ignored(5))
      call complete_law(schema, input, ignored(6))
      call complete_domain(schema, input)
      call complete_kinematics(schema, input, ignored(7))
      call complete_lubricant(schema, input, ignored(8))
      call complete_surfaces(schema, input)
   end subroutine complete_case

   !> Halving points - 1 must end at a grid that can be the coarsest one, and points_y - 1 must halve as often
   subroutine check_points(schema, input, status)
      type(schema_t), intent(in) :: schema
      type(case_t), intent(in) :: input
      type(status_t), intent(inout) :: status
      integer :: below, above, points
      character(len=:), allocatable :: why

      points = input%grid%points
      if (has_levels(points, points)) then
         call check_rows(schema, input, status)
         return
      end if
      below = points
      do while (below > 17 .and. .not. has_levels(below, below))
         below = below - 1
      end do
      above = points
      do while (.not. has_levels(above, above))
         above = above + 1
      end do
      why = "too few grids can be made by halving"
      if (mod(points, 2) == 0) why = "an even number of points"
      call schema%refuse("grid.points", "grid.points = " // to_text(points) // ": " &
         // why, "an odd number with points - 1 halved down to an even number of " // to_text(coarsest_most) // " or less; " &
         // "the nearest are " // to_text(below) // " and " // to_text(above), status)
   end subroutine check_points

   !> Rows of a grid whose number of columns is good
   subroutine check_rows(schema, input, status)
      type(schema_t), intent(in) :: schema
      type(case_t), intent(in) :: input
      type(status_t), intent(inout) :: status
      integer :: levels, intervals(2), step, below

      associate (nx => input%grid%points, ny => input%grid%points_y)
         call find_levels(nx, nx, levels, intervals)
         step = 2*((nx - 1)/intervals(1))
         if (mod(ny - 1, step) == 0 .and. has_levels(nx, ny)) return
         below = max(4*step, ((ny - 1)/step)*step)
         call schema%refuse("grid.points_y", "grid.points_y = "//to_text(ny)//" with "//to_text(nx)// &
                            " nodes along X", "points_y - 1 in multiples of "//to_text(step)//": the nearest are "// &
                            to_text(below + 1)//" and "//to_text(below + step + 1), status)
      end associate
   end subroutine check_rows

   !> Whether a grid can be coarsened far enough
   pure logical function has_levels(nx, ny)
      integer, intent(in) :: nx, ny
      integer :: levels, intervals(2)

      call find_levels(nx, ny, levels, intervals)
      has_levels = levels > 0
   end function has_levels

   !> A number of steps and a number of periods cannot both rule
   subroutine check_time(schema, input, status)
      type(schema_t), intent(in) :: schema
      type(case_t), intent(in) :: input
      type(status_t), intent(inout) :: status

      if (input%time%steps == 0 .or. input%time%max_periods == 0) return
      call schema%refuse("time.max_periods", "time.max_periods contradicts time.steps", "one of the two, the other 0", status)
   end subroutine check_time
end module ehl_case_check

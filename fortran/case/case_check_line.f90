! SPDX-License-Identifier: BSD-3-Clause
!> Checks of the keys of point and line contacts
module ehl_case_check_line
   use ehl_case, only: case_t
   use ehl_case_defaults, only: line_keys, point_keys
   use ehl_case_source, only: case_source_t
   use ehl_kinds, only: dp
   use ehl_status, only: status_t
   implicit none (type, external)
   private
   public :: check_line

contains

   !> Refuse keys of a point for a line, keys of a line for a point, and options without meaning for a line. check_roller refuses
   !> the keys that a roller does not have.
   subroutine check_line(source, input, status)
      type(case_source_t), intent(in) :: source
      type(case_t), intent(in) :: input
      type(status_t), intent(inout) :: status
      character(len=*), parameter :: shape = "contact.shape = 'line'"
      character(len=:), allocatable :: key

      if (input%contact%is_roller()) return
      if (.not. input%contact%is_line()) then
         key = source%first_given("contact", line_keys)
         if (key /= "") call source%refuse(key, key//" in a point contact", shape//", or "//key_of_point(key)// &
                                           " of a point: M and L of a line are defined differently", status)
         return
      end if
      key = source%first_given("contact", point_keys)
      if (key /= "") call source%refuse(key, key//" with "//shape, key_of_line(key), status)
      if (status%failed()) return
      if (source%given("grid.y_extent")) key = "grid.y_extent"
      if (source%given("grid.points_y")) key = "grid.points_y"
      if (key /= "") call source%refuse(key, key//" with "//shape, "none: the strip is one period of the surfaces "// &
                                        "wide, its cells are nearly square", status)
      if (source%given("solver.deflection") .and. input%solver%deflection /= "fft") call source%refuse("solver.deflection", &
         "solver.deflection = 'mlmi' with "//shape, "'fft': multi-integration is not available for a periodic strip", status)
      if (input%lubricant%thermal_friction == "always" .and. .not. abs(input%contact%slide_to_roll) < 2.0_dp) then
         call source%refuse("lubricant.thermal_friction", "lubricant.thermal_friction = 'always' with a wall at rest under an "// &
                            "infinite line, whose temperature has no limit", "'auto' or 'never', or a slide_to_roll between "// &
                            "-2 and 2", status)
      end if
   end subroutine check_line

   !> Keys of a point contact in place of a key of a line
   pure function key_of_point(key) result(words)
      character(len=*), intent(in) :: key
      character(len=:), allocatable :: words

      select case (key)
      case ("contact.load_per_length")
         words = "contact.load [N]"
      case default
         words = key(:len(key) - 5)
      end select
   end function key_of_point

   !> Keys of a line contact in place of a key of a point
   pure function key_of_line(key) result(words)
      character(len=*), intent(in) :: key
      character(len=:), allocatable :: words

      select case (key)
      case ("contact.load")
         words = "contact.load_per_length [N/m]"
      case ("contact.moes_m", "contact.moes_l")
         words = key//"_line: M and L of a line are defined differently from those of a point"
      case ("contact.radius_x", "contact.radius_y", "contact.radius_ratio")
         words = "contact.radius alone: a line is not curved across the motion"
      case default
         words = "none: a line is perpendicular to the motion"
      end select
   end function key_of_line
end module ehl_case_check_line

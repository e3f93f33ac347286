! SPDX-License-Identifier: BSD-3-Clause
!> The resolved case as namelist text, and the list of all options
module ehl_case_writer
   use ehl_case, only: case_t, is_feature
   use ehl_case_key, only: key_t
   use ehl_derived, only: mark_default, mark_derived
   use ehl_kinds, only: dp
   use ehl_schema, only: schema_t
   use ehl_text, only: newline
   implicit none (type, external)
   private
   public :: case_text, options_text

contains

   !> A case as namelist text that reads back as the same case, every value spelled out. Of keys
   !> that exclude each other only the one that holds is written. Values that were not given are marked.
   function case_text(input) result(text)
      type(case_t), intent(in) :: input
      character(len=:), allocatable :: text
      type(case_t), target :: copy, defaults
      type(schema_t) :: schema, constant
      character(len=:), allocatable :: mark, lines
      integer :: k

      copy = input
      call schema%bind(copy)
      call constant%bind(defaults)
      text = ""
      do k = 1, size(schema%keys)
         if (opens_group(schema, k)) lines = ""
         if (holds(input, schema%keys(k))) then
            mark = ""
            if (allocated(input%given)) mark = mark_of(schema%keys(k), constant%keys(k), input%given(k))
            lines = lines // key_line(schema%keys(k), mark) // newline
         end if
         if (closes_group(schema, k) .and. lines /= "") text = text // "&" // trim(schema%keys(k)%group) // newline // lines &
                                                                // "/" // newline
      end do
   end function case_text

   !> Whether a key carries a value, and its rival does not
   pure logical function holds(input, key)
      type(case_t), intent(in) :: input
      type(key_t), intent(in) :: key

      select case (key%full_name())
      case ("contact.moes_m", "contact.moes_l", "contact.radius_ratio")
         holds = .not. input%contact%si
      case ("contact.load", "contact.mean_velocity", "contact.reduced_modulus")
         holds = input%contact%si
      case ("contact.radius")
         holds = input%contact%si .and. input%contact%round
      case ("contact.radius_x", "contact.radius_y")
         holds = input%contact%si .and. .not. input%contact%round
      case ("bodies.radius_x1", "bodies.radius_y1", "bodies.radius_x2", "bodies.radius_y2", "bodies.modulus_1", &
            "bodies.modulus_2", "bodies.poisson_1", "bodies.poisson_2")
         holds = input%bodies%given
      case ("surface.amplitude")
         holds = input%surface%amplitude_given
      case ("surface.amplitude_over_film")
         holds = (input%surface%kind == "harmonic" .or. is_feature(input%surface%kind)) &
                 .and. .not. input%surface%amplitude_given .and. .not. input%surface%height_m > 0.0_dp
      case ("surface.width")
         holds = .not. input%surface%width_m > 0.0_dp
      case ("surface.length")
         holds = .not. input%surface%length_m > 0.0_dp
      case ("lubricant.temperature", "lubricant.density_15", "lubricant.thermal_expansion")
         holds = input%lubricant%kinematic_viscosity_40 > 0.0_dp
      case ("lubricant.limiting_coefficient")
         holds = input%lubricant%limiting_stress <= 0.0_dp
      case default
         holds = .true.
      end select
   end function holds

   !> One key with its value and its meaning
   function key_line(key, mark) result(line)
      type(key_t), intent(in) :: key
      character(len=*), intent(in) :: mark
      character(len=:), allocatable :: line

      line = "   " // trim(key%name) // " = " // key%value_text()
      line = line // repeat(" ", max(1, 44 - len(line))) // "! "
      if (key%unit /= "-") line = line // "[" // trim(key%unit) // "] "
      line = line // trim(key%meaning) // mark
   end function key_line

   !> What the line of a key ends in: a mark where its value was not given
   function mark_of(key, default, given) result(mark)
      type(key_t), intent(in) :: key, default
      logical, intent(in) :: given
      character(len=:), allocatable :: mark

      mark = ""
      if (given) return
      mark = " " // mark_derived
      if (key%value_text() == default%value_text()) mark = " " // mark_default
   end function mark_of

   pure logical function opens_group(schema, k)
      type(schema_t), intent(in) :: schema
      integer, intent(in) :: k

      opens_group = k == 1
      if (k > 1) opens_group = schema%keys(k)%group /= schema%keys(k - 1)%group
   end function opens_group

   pure logical function closes_group(schema, k)
      type(schema_t), intent(in) :: schema
      integer, intent(in) :: k

      closes_group = k == size(schema%keys)
      if (.not. closes_group) closes_group = opens_group(schema, k + 1)
   end function closes_group

   !> All keys, one a line with tabs between the columns:
   !> group.key, unit, default, allowed values, meaning
   function options_text() result(text)
      character(len=:), allocatable :: text
      type(case_t), target :: defaults
      type(schema_t) :: schema
      character(len=1), parameter :: tab = achar(9)
      integer :: k

      call schema%bind(defaults)
      text = ""
      do k = 1, size(schema%keys)
         associate (key => schema%keys(k))
            text = text // key%full_name() // tab // trim(key%unit) // tab // key%value_text() &
                   // tab // trim(key%allowed) // tab // trim(key%meaning) // newline
         end associate
      end do
   end function options_text
end module ehl_case_writer

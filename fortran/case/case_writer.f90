! SPDX-License-Identifier: BSD-3-Clause
!> The resolved case as namelist text, and the list of all options
module ehl_case_writer
   use ehl_case, only: case_t, contact_case_t, is_feature, lubricant_case_t, surface_case_t
   use ehl_case_key, only: key_t, mark_default, mark_derived, name_length
   use ehl_case_law, only: knows_temperature, own_law, uses_law
   use ehl_kinds, only: dp
   use ehl_keys, only: bind_keys
   use ehl_schema, only: schema_t
   use ehl_text, only: newline
   implicit none (type, external)
   private
   public :: case_text, options_text

contains

   !> A case as namelist text that reads back as the same case, every value spelled out. Of keys
   !> that exclude each other only the one that holds is written. Values that were not given are marked. A second
   !> surface that nobody asked for is left out.
   function case_text(input) result(text)
      type(case_t), intent(in) :: input
      character(len=:), allocatable :: text
      type(case_t), target :: copy, defaults
      type(schema_t) :: schema, constant
      character(len=name_length), allocatable :: groups(:)
      character(len=:), allocatable :: mark, lines
      integer :: k, n

      copy = input
      call bind_keys(schema, copy)
      call bind_keys(constant, defaults)
      allocate (groups, source=schema%group_names())
      text = ""
      do n = 1, size(groups)
         if (groups(n) == "second_surface" .and. .not. has_second(input, schema)) cycle
         lines = ""
         do k = 1, size(schema%keys)
            if (schema%keys(k)%group /= groups(n) .or. .not. holds(input, schema%keys(k))) cycle
            mark = ""
            if (allocated(input%given)) mark = mark_of(schema%keys(k), constant%keys(k), input%given(k))
            lines = lines // key_line(schema%keys(k), mark) // newline
         end do
         if (lines /= "") text = text // "&" // trim(groups(n)) // newline // lines // "/" // newline
      end do
   end function case_text

   !> Whether there is a second surface, or somebody has said something of one
   pure logical function has_second(input, schema)
      type(case_t), intent(in) :: input
      type(schema_t), intent(in) :: schema

      has_second = input%second_surface%kind /= "smooth"
      if (allocated(input%given)) has_second = has_second .or. any(input%given .and. schema%keys%group == "second_surface")
   end function has_second

   !> Whether a key carries a value, and its rival does not
   pure logical function holds(input, key)
      type(case_t), intent(in) :: input
      type(key_t), intent(in) :: key

      select case (trim(key%group))
      case ("contact")
         holds = holds_of_contact(input%contact, key)
      case ("bodies")
         holds = input%bodies%given
      case ("lubricant")
         holds = holds_of_lubricant(input%lubricant, key)
      case ("surface")
         holds = holds_of_surface(input%surface, key)
      case ("second_surface")
         holds = holds_of_surface(input%second_surface, key)
      case default
         holds = .true.
      end select
   end function holds

   !> The same of a key of a surface
   pure logical function holds_of_surface(s, key)
      type(surface_case_t), intent(in) :: s
      type(key_t), intent(in) :: key

      select case (trim(key%name))
      case ("amplitude")
         holds_of_surface = s%amplitude_given
      case ("amplitude_over_film")
         holds_of_surface = (s%kind == "harmonic" .or. is_feature(s%kind)) .and. .not. s%amplitude_given .and. &
                            .not. s%height_m > 0.0_dp
      case ("width")
         holds_of_surface = .not. s%width_m > 0.0_dp
      case ("length")
         holds_of_surface = .not. s%length_m > 0.0_dp
      case default
         holds_of_surface = .true.
      end select
   end function holds_of_surface

   !> The same of a key of the contact
   pure logical function holds_of_contact(c, key)
      type(contact_case_t), intent(in) :: c
      type(key_t), intent(in) :: key

      select case (trim(key%name))
      case ("moes_m", "moes_l", "radius_ratio")
         holds_of_contact = .not. c%si
      case ("load", "mean_velocity", "reduced_modulus")
         holds_of_contact = c%si
      case ("hardness", "thermal_conductivity_2", "thermal_diffusivity_2")
         holds_of_contact = key%real_value > 0.0_dp
      case ("radius")
         holds_of_contact = c%si .and. c%round
      case ("radius_x", "radius_y")
         holds_of_contact = c%si .and. .not. c%round
      case default
         holds_of_contact = .true.
      end select
   end function holds_of_contact

   !> The same of a key of the lubricant; constants of a law begin with its name
   pure logical function holds_of_lubricant(l, key)
      type(lubricant_case_t), intent(in) :: l
      type(key_t), intent(in) :: key

      holds_of_lubricant = .true.
      select case (trim(key%name))
      case ("name")
         holds_of_lubricant = l%name /= ""
      case ("table")
         holds_of_lubricant = l%table%text() /= ""
      case ("temperature")
         holds_of_lubricant = knows_temperature(l) .or. l%temperature_viscosity > 0.0_dp
      case ("thermal_expansion")
         holds_of_lubricant = knows_temperature(l) .or. l%temperature_viscosity > 0.0_dp
         if (l%density_law == "tait") holds_of_lubricant = l%kinematic_viscosity_40 > 0.0_dp
      case ("density_15")
         holds_of_lubricant = l%kinematic_viscosity_40 > 0.0_dp
      case ("limiting_coefficient")
         holds_of_lubricant = l%limiting_stress <= 0.0_dp
      case default
         select case (key%name(:index(key%name, "_")))
         case ("vogel_", "dicke_")
            holds_of_lubricant = uses_law(l, "dicke")
         case ("yasutomi_")
            holds_of_lubricant = uses_law(l, "yasutomi")
         case ("doolittle_")
            holds_of_lubricant = uses_law(l, "doolittle")
         case ("tait_")
            holds_of_lubricant = uses_law(l, "doolittle") .or. l%density_law == "tait"
         case ("murnaghan_")
            holds_of_lubricant = l%density_law == "murnaghan"
         case ("range_")
            holds_of_lubricant = own_law(l) /= ""
         case default
            continue
         end select
      end select
   end function holds_of_lubricant

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

   !> All keys, one a line with tabs between the columns:
   !> group.key, unit, default, allowed values, meaning
   function options_text() result(text)
      character(len=:), allocatable :: text
      type(case_t), target :: defaults
      type(schema_t) :: schema
      character(len=1), parameter :: tab = achar(9)
      integer :: k

      call bind_keys(schema, defaults)
      text = ""
      do k = 1, size(schema%keys)
         associate (key => schema%keys(k))
            text = text // key%full_name() // tab // trim(key%unit) // tab // key%value_text() &
                   // tab // trim(key%allowed) // tab // trim(key%meaning) // newline
         end associate
      end do
   end function options_text
end module ehl_case_writer

! SPDX-License-Identifier: BSD-3-Clause
!> The resolved case as namelist text, and the list of all options
module ehl_case_writer
   use ehl_case, only: case_t, is_feature, surface_case_t
   use ehl_case_key, only: key_t, mark_default, mark_derived
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
      character(len=:), allocatable :: mark, lines
      integer :: k

      copy = input
      call bind_keys(schema, copy)
      call bind_keys(constant, defaults)
      text = ""
      do k = 1, size(schema%keys)
         if (schema%keys(k)%group == "second_surface" .and. .not. has_second(input, schema)) cycle
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
      case ("bodies")
         holds = input%bodies%given
      case ("surface")
         holds = holds_of_surface(input%surface, key)
      case ("second_surface")
         holds = holds_of_surface(input%second_surface, key)
      case default
         holds = holds_elsewhere(input, key)
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

   !> The same of any other key
   pure logical function holds_elsewhere(input, key)
      type(case_t), intent(in) :: input
      type(key_t), intent(in) :: key

      select case (key%full_name())
      case ("contact.moes_m", "contact.moes_l", "contact.radius_ratio")
         holds_elsewhere = .not. input%contact%si
      case ("contact.load", "contact.mean_velocity", "contact.reduced_modulus")
         holds_elsewhere = input%contact%si
      case ("contact.hardness")
         holds_elsewhere = input%contact%hardness > 0.0_dp
      case ("contact.thermal_conductivity_2")
         holds_elsewhere = input%contact%thermal_conductivity_2 > 0.0_dp
      case ("contact.thermal_diffusivity_2")
         holds_elsewhere = input%contact%thermal_diffusivity_2 > 0.0_dp
      case ("contact.radius")
         holds_elsewhere = input%contact%si .and. input%contact%round
      case ("contact.radius_x", "contact.radius_y")
         holds_elsewhere = input%contact%si .and. .not. input%contact%round
      case ("lubricant.name")
         holds_elsewhere = input%lubricant%name /= ""
      case ("lubricant.table")
         holds_elsewhere = input%lubricant%table /= ""
      case ("lubricant.vogel_viscosity", "lubricant.vogel_b", "lubricant.vogel_c", "lubricant.dicke_a1", "lubricant.dicke_a2", &
            "lubricant.dicke_b1", "lubricant.dicke_b2")
         holds_elsewhere = uses_law(input%lubricant, "dicke")
      case ("lubricant.yasutomi_tg0", "lubricant.yasutomi_a1", "lubricant.yasutomi_a2", "lubricant.yasutomi_b1", &
            "lubricant.yasutomi_b2", "lubricant.yasutomi_c1", "lubricant.yasutomi_c2", "lubricant.yasutomi_viscosity")
         holds_elsewhere = uses_law(input%lubricant, "yasutomi")
      case ("lubricant.doolittle_viscosity", "lubricant.doolittle_temperature", "lubricant.doolittle_b", &
            "lubricant.doolittle_r0", "lubricant.doolittle_expansion")
         holds_elsewhere = uses_law(input%lubricant, "doolittle")
      case ("lubricant.tait_modulus", "lubricant.tait_rate", "lubricant.tait_softening", "lubricant.tait_expansion", &
            "lubricant.tait_temperature")
         holds_elsewhere = uses_law(input%lubricant, "doolittle") .or. input%lubricant%density_law == "tait"
      case ("lubricant.murnaghan_modulus", "lubricant.murnaghan_rate", "lubricant.murnaghan_softening")
         holds_elsewhere = input%lubricant%density_law == "murnaghan"
      case ("lubricant.range_temperature_min", "lubricant.range_temperature_max", "lubricant.range_pressure_max")
         holds_elsewhere = own_law(input%lubricant) /= ""
      case ("lubricant.temperature")
         holds_elsewhere = knows_temperature(input%lubricant) .or. input%lubricant%temperature_viscosity > 0.0_dp
      case ("lubricant.thermal_expansion")
         holds_elsewhere = knows_temperature(input%lubricant) .or. input%lubricant%temperature_viscosity > 0.0_dp
         if (input%lubricant%density_law == "tait") holds_elsewhere = input%lubricant%kinematic_viscosity_40 > 0.0_dp
      case ("lubricant.density_15")
         holds_elsewhere = input%lubricant%kinematic_viscosity_40 > 0.0_dp
      case ("lubricant.limiting_coefficient")
         holds_elsewhere = input%lubricant%limiting_stress <= 0.0_dp
      case default
         holds_elsewhere = .true.
      end select
   end function holds_elsewhere

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

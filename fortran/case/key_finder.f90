! SPDX-License-Identifier: BSD-3-Clause
!> Groups and keys by name, and what to say about a name that nobody knows, as one that people give to what is called otherwise
!> here, or is not modelled
module ehl_key_finder
   use ehl_scanner, only: token_t
   use ehl_schema, only: schema_t
   use ehl_source, only: source_t
   use ehl_status, only: status_t
   use ehl_text, only: lower_case, nearest_word
   implicit none (type, external)
   private
   public :: find_key, known_groups, join

   !> Names of keys and groups between bars, in what group ('': in any, or of a group), and the sentence
   type :: other_name_t
      character(len=220) :: names
      character(len=9) :: group
      character(len=220) :: sentence
   end type other_name_t

   type(other_name_t), parameter :: table(*) = [ &
      other_name_t("|e|e1|e2|e_1|e_2|modulus|elastic_modulus|young|youngs_modulus|youngs_modulus_1|youngs_modulus_2|nu|nu1|nu2"// &
         "|nu_1|nu_2|poisson|poissons_ratio|poisson_ratio|", "", &
         "E and nu of each body are keys of &bodies (modulus_1, poisson_1, modulus_2, poisson_2); contact.reduced_modulus is "// &
         "E' with 2/E' = sum of (1 - nu^2)/E"), &
      other_name_t("|e_star|effective_modulus|equivalent_modulus|", "", &
         "contact.reduced_modulus is E' with 2/E' = sum of (1 - nu^2)/E, twice the modulus E* of 1/E* = sum of (1 - nu^2)/E"), &
      other_name_t("|hertz_pressure|max_pressure|maximum_pressure|pressure|p_h|p_max|", "", &
         "a pressure is no input: the Hertz pressure follows from load, radius and reduced_modulus of &contact, and "// &
         "'pyehl film' tells it"), &
      other_name_t("|speed|speed1|speed2|speed_1|speed_2|u1|u2|u_1|u_2|velocity|velocity_1|velocity_2|entrainment_speed"// &
         "|rolling_speed|sliding_speed|srr|", "contact", &
         "speeds are contact.mean_velocity = (u1 + u2)/2 and contact.slide_to_roll = (u1 - u2)/mean_velocity"), &
      other_name_t("|line_load|load_per_length|", "", &
         "line contacts are not modelled: contact.load [N] is that of a point contact, round or elliptical up to 30 to 1"), &
      other_name_t("|length|", "contact", &
         "line contacts are not modelled: contact.load [N] is that of a point contact, round or elliptical up to 30 to 1"), &
      other_name_t("|spin|spin_ratio|spin_velocity|", "", &
         "spin is not modelled: both bodies move along x, with contact.mean_velocity and contact.slide_to_roll"), &
      other_name_t("|starved|starvation|", "", &
         "there is no key for it: an inlet is starved by grid.border = 'zero' and a grid.x_inlet near the contact"), &
      other_name_t("|wear|wear_rate|wear_coefficient|", "", &
         "wear is not modelled: surfaces keep their heights"), &
      other_name_t("|plasticity|plastic|hardness|yield_stress|yield_strength|", "", &
         "contact.hardness [Pa] limits the pressure of the solids, with lubricant.boundary_film; without it they stay elastic, "// &
         "and the judgement of a result names pressures above 4.2 GPa")]

contains

   !> Position of a key in the schema; unknown and repeated keys are faults
   integer function find_key(source, schema, group, name, status)
      type(source_t), intent(in) :: source
      type(schema_t), intent(in) :: schema
      character(len=*), intent(in) :: group
      type(token_t), intent(in) :: name
      type(status_t), intent(inout) :: status
      character(len=:), allocatable :: what, expected, where_else
      integer :: k

      find_key = schema%find(group, lower_case(name%text))
      if (find_key > 0) then
         if (.not. (schema%keys(find_key)%given .and. source%has_lines)) return
         what = "key "//schema%keys(find_key)%full_name()//" is there twice"
         expected = "every key once"
      else
         what = "unknown key '"//name%text//"' in &"//group
         where_else = hint(name%text, schema%names_of(group), "")
         do k = 1, size(schema%keys)
            if (schema%keys(k)%name /= lower_case(name%text)) cycle
            where_else = "; '"//trim(schema%keys(k)%name)//"' belongs to &"//trim(schema%keys(k)%group)
            exit
         end do
         expected = about_name(group, name%text)
         if (expected == "") expected = "one of the keys "//join(schema%names_of(group), ", ")//where_else
      end if
      call source%refuse(name%first, name%last, what, expected, status)
   end function find_key

   !> What to expect in place of an unknown group: what there is to say about the name, or the groups with a prefix
   pure function known_groups(name, names, prefix) result(text)
      character(len=*), intent(in) :: name, names(:), prefix
      character(len=:), allocatable :: text

      text = about_name("", name)
      if (text == "") text = "one of the groups "//prefix//join(names, ", "//prefix)//hint(name, names, prefix)
   end function known_groups

   !> The sentence about the name of a key in a group, or with '' of a group; empty where there is none
   pure function about_name(group, name) result(sentence)
      character(len=*), intent(in) :: group, name
      character(len=:), allocatable :: sentence
      integer :: k

      sentence = ""
      do k = 1, size(table)
         if (index(table(k)%names, "|"//lower_case(name)//"|") == 0) cycle
         if (table(k)%group == "" .or. table(k)%group == group) sentence = trim(table(k)%sentence)
      end do
   end function about_name

   !> Names with something between them
   pure function join(names, between) result(text)
      character(len=*), intent(in) :: names(:), between
      character(len=:), allocatable :: text
      integer :: k

      text = trim(names(1))
      do k = 2, size(names)
         text = text//between//trim(names(k))
      end do
   end function join

   !> '; did you mean ...?' where a name is near
   pure function hint(name, names, prefix) result(text)
      character(len=*), intent(in) :: name, names(:), prefix
      character(len=:), allocatable :: text

      text = nearest_word(name, names)
      if (text /= "") text = "; did you mean '"//prefix//text//"'?"
   end function hint
end module ehl_key_finder

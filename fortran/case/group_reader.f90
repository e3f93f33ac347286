! SPDX-License-Identifier: BSD-3-Clause
!> The groups of a case file, key by key; every fault ends in one message with its place. Groups and keys by name, and what to
!> say about a name that nobody knows, as one that people give to what is called otherwise here, or is not modelled.
module ehl_group_reader
   use ehl_case_key, only: mark_default, mark_derived, name_length
   use ehl_case_value, only: set_value
   use ehl_schema, only: schema_t
   use ehl_source, only: line_number, scan_token, source_t, token_atom, token_comma, token_end, token_equals, token_group, &
                         token_open_string, token_slash, token_string, token_t
   use ehl_status, only: status_t
   use ehl_text, only: is_digit, is_letter, join, lower_case, nearest_word, newline, to_text
   implicit none (type, external)
   private
   public :: read_groups, find_key, known_groups

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

   !> All groups of the file
   subroutine read_groups(source, schema, status)
      type(source_t), intent(in) :: source
      type(schema_t), intent(inout) :: schema
      type(status_t), intent(inout) :: status
      character(len=name_length), allocatable :: names(:)
      logical, allocatable :: seen(:)
      character(len=:), allocatable :: group
      type(token_t) :: opening, name, value
      !> Behind the last piece
      integer :: position
      !> Key before, 0 for none
      integer :: k

      allocate (names, source=schema%group_names())
      allocate (seen(size(names)), source=.false.)
      call check_characters()
      position = 1
      do while (.not. status%failed())
         call scan_token(source%text, position, opening)
         if (opening%kind == token_end) return
         call open_group()
         k = 0
         do while (.not. status%failed())
            call scan_token(source%text, position, name)
            if (name%kind == token_comma .and. k > 0) then
               call scan_token(source%text, position, name)
               if (name%kind /= token_slash) call refuse_list()
            end if
            if (name%kind == token_slash) exit
            if (.not. status%failed()) call read_key()
         end do
      end do

   contains

      !> A case file is text: control characters have no place in it
      subroutine check_characters()
         integer :: i, code

         do i = 1, len(source%text)
            code = iachar(source%text(i:i))
            if (code >= 32 .or. any(code == [9, 10, 13])) cycle
            call source%refuse(i, i, "this is not a text file (byte "//to_text(code)//")", "namelist text", status)
            return
         end do
      end subroutine check_characters

      !> A piece outside of groups opens a known group for the first time
      subroutine open_group()
         character(len=:), allocatable :: what, expected
         integer :: number

         group = lower_case(opening%text)
         expected = "one of the groups &"//join(names, ", &")
         number = findloc(names == group, .true., dim=1)
         if (opening%kind /= token_group) then
            what = "text outside of a group"
         else if (number == 0) then
            what = "unknown group &"//opening%text
            expected = known_groups(opening%text, names, "&")
         else if (seen(number)) then
            what = "group &"//group//" is there twice"
            expected = "all keys of a group in one place"
         else
            seen(number) = .true.
            return
         end if
         call source%refuse(opening%first, opening%last, what, expected, status)
      end subroutine open_group

      !> Every key takes one value: '1, 2' is a list. `name` stands behind a comma.
      subroutine refuse_list()
         character(len=:), allocatable :: what

         if (name%kind == token_comma) then
            what = "two commas behind "
         else if (name%kind == token_string .or. name%kind == token_open_string) then
            what = "second value for "
         else if (name%kind == token_atom .and. scan(name%text//" ", "0123456789+-.*") == 1) then
            what = "second value for "
         else
            return
         end if
         call source%refuse(name%first, name%last, what//schema%keys(k)%full_name(), "one value, then the next key or '/'", status)
      end subroutine refuse_list

      !> A key, which begins with `name`, and its value
      subroutine read_key()
         type(status_t) :: reading

         if (name%kind == token_group .or. name%kind == token_end) then
            call source%refuse(min(name%first, end_of_text()), name%last, "group &"//group//", opened in line "// &
                      to_text(line_number(source%text, opening%first))//", is not closed", "'/'", status)
            return
         end if
         call read_equals()
         if (status%failed()) return
         k = find_key(source, schema, group, name, status)
         if (status%failed()) return
         call scan_token(source%text, position, value)
         call check_value()
         if (status%failed()) return
         call set_value(schema%keys(k), source, 1, name, value, reading)
         ! a value that an option replaces need not be acceptable
         if (reading%failed() .and. .not. schema%keys(k)%replaced) status = reading
         schema%keys(k)%marked = has_mark(source%text(value%last + 1:))
      end subroutine read_key

      !> Behind the text, without blanks and line ends at its end
      pure integer function end_of_text()
         end_of_text = verify(source%text, " "//achar(9)//achar(13)//newline, back=.true.) + 1
      end function end_of_text

      !> '=' behind a key; without it, what the text behind the last value may be
      subroutine read_equals()
         character(len=:), allocatable :: what, expected
         type(token_t) :: equals
         integer :: behind

         behind = position
         if (name%kind == token_atom) then
            call scan_token(source%text, position, equals)
            if (equals%kind == token_equals) return
            if (schema%find(group, lower_case(name%text)) > 0) then
               call source%refuse(behind, behind, "no '=' behind "//group//"."//lower_case(name%text), "'=' and a value", status)
               return
            end if
         end if
         what = "unexpected text in &"//group
         expected = "a key of the group, or '/'"
         if (k > 0) then
            associate (key => schema%keys(k))
               what = "text behind the value of "//key%full_name()
               if (name%kind == token_atom) then
                  if (key%unit /= "-") what = "unit or other "//what
                  expected = key%type_text()//" and nothing else, then the next key or '/'"
               end if
            end associate
         end if
         call source%refuse(name%first, name%last, what, expected, status)
      end subroutine read_equals

      !> A value is there, and it has no decimal comma as in '0,84'
      subroutine check_value()
         type(token_t) :: next
         integer :: behind
         logical :: missing

         associate (key => schema%keys(k), comma => value%last + 1)
            missing = all(value%kind /= [token_atom, token_string, token_open_string])
            if (value%kind == token_atom) then
               ! the key behind it?
               behind = position
               call scan_token(source%text, behind, next)
               missing = next%kind == token_equals .and. is_letter(value%text(1:1))
            end if
            if (missing) then
               call source%refuse(min(value%first, end_of_text()), value%last, "no value for "//key%full_name(), &
                                  key%type_text(), status)
            else if (value%kind == token_atom .and. comma < len(source%text)) then
               if (source%text(comma:comma) == "," .and. is_digit(source%text(comma - 1:comma - 1)) .and. &
                   is_digit(source%text(comma + 1:comma + 1))) then
                  call source%refuse(comma, comma, "decimal comma in the value of "//key%full_name(), &
                            key%type_text()//", with a decimal point", status)
               end if
            end if
         end associate
      end subroutine check_value
   end subroutine read_groups

   !> Whether the first line of a text ends in a mark
   pure logical function has_mark(text)
      character(len=*), intent(in) :: text
      integer :: last

      last = verify(text(:scan(text, achar(13)//newline) - 1), " ", back=.true.)
      has_mark = ends_in(mark_default) .or. ends_in(mark_derived)

   contains

      pure logical function ends_in(mark)
         character(len=*), intent(in) :: mark
         ends_in = text(max(1, last - len(mark) + 1):last) == mark
      end function ends_in
   end function has_mark

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

   !> '; did you mean ...?' where a name is near
   pure function hint(name, names, prefix) result(text)
      character(len=*), intent(in) :: name, names(:), prefix
      character(len=:), allocatable :: text

      text = nearest_word(name, names)
      if (text /= "") text = "; did you mean '"//prefix//text//"'?"
   end function hint
end module ehl_group_reader

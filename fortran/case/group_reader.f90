! SPDX-License-Identifier: BSD-3-Clause
!> The groups of a case file, key by key; every fault ends in one message with its place
module ehl_group_reader
   use ehl_case_key, only: mark_default, mark_derived, name_length
   use ehl_case_value, only: set_value
   use ehl_key_finder, only: find_key, join, known_groups
   use ehl_scanner, only: scan_token, token_atom, token_comma, token_end, token_equals, token_group, token_open_string, &
                          token_slash, token_string, token_t
   use ehl_schema, only: schema_t
   use ehl_source, only: line_number, source_t
   use ehl_status, only: status_t
   use ehl_text, only: is_digit, is_letter, lower_case, newline, to_text
   implicit none (type, external)
   private
   public :: read_groups

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
end module ehl_group_reader

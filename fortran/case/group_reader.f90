! SPDX-License-Identifier: BSD-3-Clause
!> The groups of a case file, key by key; every fault ends in one message with its place
module ehl_group_reader
   use ehl_case_key, only: name_length
   use ehl_case_value, only: set_value
   use ehl_derived, only: has_mark
   use ehl_key_finder, only: find_key, group_position, hint, join
   use ehl_scanner, only: scan_token, token_atom, token_comma, token_end, token_equals, &
                          token_group, token_open_string, token_slash, token_string, token_t
   use ehl_schema, only: schema_t
   use ehl_source, only: line_number, point_at, source_t
   use ehl_status, only: ehl_bad_input, status_t
   use ehl_text, only: is_digit, is_letter, lower_case, to_text
   implicit none (type, external)
   private
   public :: read_groups

contains

   !> All groups of the file
   subroutine read_groups(source, schema, status)
      type(source_t), intent(in) :: source
      type(schema_t), intent(inout) :: schema
      type(status_t), intent(inout) :: status
      type(token_t) :: token
      logical, allocatable :: seen(:)
      integer :: position

      call check_characters(source, status)
      allocate (seen(size(schema%group_names())), source=.false.)
      position = 1
      do while (.not. status%failed())
         call scan_token(source%text, position, token)
         if (token%kind == token_end) return
         call open_group(source, schema, token, seen, status)
         if (.not. status%failed()) call read_group(source, schema, token, position, status)
      end do
   end subroutine read_groups

   !> A case file is text: control characters have no place in it
   subroutine check_characters(source, status)
      type(source_t), intent(in) :: source
      type(status_t), intent(inout) :: status
      integer :: i, code

      do i = 1, len(source%text)
         code = iachar(source%text(i:i))
         if (code >= 32 .or. code == 9 .or. code == 10 .or. code == 13) cycle
         call status%fail(ehl_bad_input, point_at(source, i, i, "this is not a text file (byte " &
                                                  // to_text(code) // ")", "namelist text"))
         return
      end do
   end subroutine check_characters

   !> Check that a piece outside of groups opens a known group for the first time
   subroutine open_group(source, schema, token, seen, status)
      type(source_t), intent(in) :: source
      type(schema_t), intent(in) :: schema
      type(token_t), intent(in) :: token
      logical, intent(inout) :: seen(:)
      type(status_t), intent(inout) :: status
      character(len=:), allocatable :: what, expected
      character(len=name_length), allocatable :: names(:)
      integer :: k

      allocate (names, source=schema%group_names())
      expected = "one of the groups &" // join(names, ", &")
      if (token%kind /= token_group) then
         what = "text outside of a group"
      else
         k = group_position(names, lower_case(token%text))
         if (k == 0) then
            what = "unknown group &" // token%text
            expected = expected // hint(token%text, names, "&")
         else if (seen(k)) then
            what = "group &" // trim(names(k)) // " is there twice"
            expected = "all keys of a group in one place"
         else
            seen(k) = .true.
            return
         end if
      end if
      call status%fail(ehl_bad_input, point_at(source, token%first, token%last, what, expected))
   end subroutine open_group

   !> Keys and values up to the '/' of a group
   subroutine read_group(source, schema, opening, position, status)
      type(source_t), intent(in) :: source
      type(schema_t), intent(inout) :: schema
      type(token_t), intent(in) :: opening
      integer, intent(inout) :: position
      type(status_t), intent(inout) :: status
      character(len=:), allocatable :: group
      type(token_t) :: name, token
      type(status_t) :: value_status
      integer :: k

      group = lower_case(opening%text)
      k = 0
      do
         value_status = status_t()
         call scan_token(source%text, position, name)
         if (name%kind == token_slash) return
         if (name%kind == token_comma .and. k > 0) then
            call scan_token(source%text, position, token)
            if (token%kind == token_slash) return
            call refuse_list(source, schema, k, token, status)
            if (status%failed()) return
            name = token
         end if
         if (name%kind == token_group .or. name%kind == token_end) then
            call refuse_open_group(source, opening, name, status)
            return
         end if
         call scan_equals(source, schema, group, k, name, position, status)
         if (status%failed()) return
         k = find_key(source, schema, group, name, status)
         if (status%failed()) return
         call scan_token(source%text, position, token)
         call refuse_missing_value(source, schema, k, token, position, status)
         if (.not. status%failed()) call refuse_decimal_comma(source, schema, k, token, status)
         if (status%failed()) return
         call set_value(schema%keys(k), source, 1, name, token, value_status)
         if (value_status%failed() .and. .not. schema%keys(k)%replaced) then
            status = value_status
            return
         end if
         schema%keys(k)%marked = has_mark(source%text, token%last)
      end do
   end subroutine read_group

   !> '0,84' is a decimal comma
   subroutine refuse_decimal_comma(source, schema, k, token, status)
      type(source_t), intent(in) :: source
      type(schema_t), intent(in) :: schema
      integer, intent(in) :: k
      type(token_t), intent(in) :: token
      type(status_t), intent(inout) :: status
      integer :: comma

      comma = token%last + 1
      if (token%kind /= token_atom .or. comma >= len(source%text)) return
      if (source%text(comma:comma) /= ",") return
      if (.not. (is_digit(source%text(comma - 1:comma - 1)) .and. &
                 is_digit(source%text(comma + 1:comma + 1)))) return
      call status%fail(ehl_bad_input, point_at(source, comma, comma, &
         "decimal comma in the value of " // schema%keys(k)%full_name(), &
         schema%keys(k)%type_text() // ", with a decimal point"))
   end subroutine refuse_decimal_comma

   !> Every key takes one value: '1, 2' is a list
   subroutine refuse_list(source, schema, k, token, status)
      type(source_t), intent(in) :: source
      type(schema_t), intent(in) :: schema
      integer, intent(in) :: k
      !> What stands behind a comma
      type(token_t), intent(in) :: token
      type(status_t), intent(inout) :: status
      character(len=:), allocatable :: what

      what = ""
      select case (token%kind)
      case (token_atom)
         if (scan(token%text(1:1), "0123456789+-.*") == 1) what = "second value for "
      case (token_string, token_open_string)
         what = "second value for "
      case (token_comma)
         what = "two commas behind "
      case default
         continue
      end select
      if (what == "") return
      call status%fail(ehl_bad_input, point_at(source, token%first, token%last, &
         what // schema%keys(k)%full_name(), "one value, then the next key or '/'"))
   end subroutine refuse_list

   !> A group ran into the next one or into the end of the file
   subroutine refuse_open_group(source, opening, token, status)
      type(source_t), intent(in) :: source
      type(token_t), intent(in) :: opening, token
      type(status_t), intent(inout) :: status
      integer :: at

      at = token%first
      if (token%kind == token_end) at = max(1, len_text(source%text) + 1)
      call status%fail(ehl_bad_input, point_at(source, at, max(at, token%last), &
         "group &" // lower_case(opening%text) // ", opened in line " &
         // to_text(line_number(source%text, opening%first)) // ", is not closed", "'/'"))
   end subroutine refuse_open_group

   !> Length of a text without blanks and line ends at its end
   pure integer function len_text(text)
      character(len=*), intent(in) :: text

      len_text = verify(text, " " // achar(9) // achar(10) // achar(13), back=.true.)
   end function len_text

   !> Check that a key is followed by '='; if not, say what the text behind the last value may be
   subroutine scan_equals(source, schema, group, k, name, position, status)
      type(source_t), intent(in) :: source
      type(schema_t), intent(in) :: schema
      character(len=*), intent(in) :: group
      !> The key before, 0 for none
      integer, intent(in) :: k
      type(token_t), intent(in) :: name
      integer, intent(inout) :: position
      type(status_t), intent(inout) :: status
      character(len=:), allocatable :: what, expected
      type(token_t) :: token
      integer :: behind

      behind = position
      if (name%kind == token_atom) then
         call scan_token(source%text, position, token)
         if (token%kind == token_equals) return
         if (schema%find(group, lower_case(name%text)) > 0) then
            call status%fail(ehl_bad_input, point_at(source, behind, behind, &
               "no '=' behind " // group // "." // lower_case(name%text), "'=' and a value"))
            return
         end if
      end if
      what = "unexpected text in &" // group
      expected = "a key of the group, or '/'"
      if (k > 0) then
         what = "text behind the value of " // schema%keys(k)%full_name()
         if (name%kind == token_atom .and. schema%keys(k)%unit /= "") then
            if (schema%keys(k)%unit /= "-") what = "unit or other text behind the value of " &
                                                   // schema%keys(k)%full_name()
            expected = schema%keys(k)%type_text() // " and nothing else, then the next key or '/'"
         end if
      end if
      call status%fail(ehl_bad_input, point_at(source, name%first, name%last, what, expected))
   end subroutine scan_equals

   !> Whether a value stands where one should
   subroutine refuse_missing_value(source, schema, k, token, position, status)
      type(source_t), intent(in) :: source
      type(schema_t), intent(in) :: schema
      integer, intent(in) :: k
      type(token_t), intent(in) :: token
      !> Behind the token
      integer, intent(in) :: position
      type(status_t), intent(inout) :: status
      type(token_t) :: next
      integer :: behind, at

      if (token%kind == token_atom) then
         behind = position
         call scan_token(source%text, behind, next)
         if (next%kind /= token_equals .or. .not. is_letter(token%text(1:1))) return
      else if (token%kind == token_string .or. token%kind == token_open_string) then
         return
      end if
      at = min(token%first, len_text(source%text) + 1)
      call status%fail(ehl_bad_input, point_at(source, at, max(at, token%last), &
         "no value for " // schema%keys(k)%full_name(), schema%keys(k)%type_text()))
   end subroutine refuse_missing_value
end module ehl_group_reader

! SPDX-License-Identifier: BSD-3-Clause
!> From the text of a case file and --set options to a complete case
module ehl_case_reader
   use ehl_case, only: case_t
   use ehl_case_check, only: check_case
   use ehl_case_value, only: set_value
   use ehl_files, only: read_text
   use ehl_scanner, only: scan_token, token_atom, token_comma, token_end, token_equals, &
                          token_group, token_open_string, token_slash, token_string, token_t
   use ehl_schema, only: name_length, schema_t
   use ehl_source, only: line_number, point_at, source_t
   use ehl_status, only: ehl_bad_input, status_t
   use ehl_text, only: is_digit, is_letter, lower_case, nearest_word, newline, to_text
   implicit none (type, external)
   private
   public :: read_case, read_case_file

   !> Largest case file; anything longer is not one
   integer, parameter :: largest_file = 1000000

contains

   !> Read, check and complete the case in a file; see read_case
   subroutine read_case_file(path, options, input, status)
      character(len=*), intent(in) :: path, options
      type(case_t), intent(out), target :: input
      type(status_t), intent(inout) :: status
      character(len=:), allocatable :: text

      call read_text(path, largest_file, text, status)
      if (status%failed()) then
         status%code = ehl_bad_input
         status%message = status%message // newline // "expected: the name of a case file"
         return
      end if
      call read_case(text, path, options, input, status)
   end subroutine read_case_file

   !> Read, check and complete a case. Every fault ends in one message with its place.
   subroutine read_case(text, origin, options, input, status)
      !> Namelist text
      character(len=*), intent(in) :: text
      !> Name of the file it came from, for messages and for relative file names
      character(len=*), intent(in) :: origin
      !> Options group.key=value that replace values of the text, one a line; may be empty
      character(len=*), intent(in) :: options
      type(case_t), intent(out), target :: input
      type(status_t), intent(inout) :: status
      type(schema_t) :: schema
      type(source_t), allocatable :: sources(:)
      integer :: k

      call schema%bind(input)
      sources = [source_t(origin, text)]
      call split_options(options, sources)
      call read_groups(sources(1), schema, status)
      do k = 2, size(sources)
         if (status%failed()) return
         call read_option(sources(k), k, schema, status)
      end do
      if (status%failed()) return
      call check_case(schema, input, sources, status)
   end subroutine read_case

   !> One source per option
   subroutine split_options(options, sources)
      character(len=*), intent(in) :: options
      type(source_t), allocatable, intent(inout) :: sources(:)
      integer :: start, length

      start = 1
      do while (start <= len(options))
         length = index(options(start:), newline) - 1
         if (length < 0) length = len(options) - start + 1
         if (length > 0) then
            sources = [sources, source_t("--set " // options(start:start + length - 1), &
                                         options(start:start + length - 1), .false.)]
         end if
         start = start + length + 1
      end do
   end subroutine split_options

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

   !> Position of a name in a list; 0 when it is not there
   pure integer function group_position(names, name)
      character(len=*), intent(in) :: names(:), name

      do group_position = 1, size(names)
         if (names(group_position) == name) return
      end do
      group_position = 0
   end function group_position

   !> Keys and values up to the '/' of a group
   subroutine read_group(source, schema, opening, position, status)
      type(source_t), intent(in) :: source
      type(schema_t), intent(inout) :: schema
      type(token_t), intent(in) :: opening
      integer, intent(inout) :: position
      type(status_t), intent(inout) :: status
      character(len=:), allocatable :: group
      type(token_t) :: name, token
      integer :: k

      group = lower_case(opening%text)
      k = 0
      do
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
         call set_value(schema%keys(k), source, 1, name, token, status)
         if (status%failed()) return
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

   !> Position of a key in the schema; unknown and repeated keys are faults
   integer function find_key(source, schema, group, name, status)
      type(source_t), intent(in) :: source
      type(schema_t), intent(in) :: schema
      character(len=*), intent(in) :: group
      type(token_t), intent(in) :: name
      type(status_t), intent(inout) :: status
      character(len=:), allocatable :: what, expected
      integer :: k

      find_key = schema%find(group, lower_case(name%text))
      if (find_key > 0) then
         if (schema%keys(find_key)%given .and. source%has_lines) then
            what = "key " // schema%keys(find_key)%full_name() // " is there twice"
            expected = "every key once"
            call status%fail(ehl_bad_input, point_at(source, name%first, name%last, what, expected))
         end if
         return
      end if
      what = "unknown key '" // name%text // "' in &" // group
      expected = "one of the keys " // join(schema%names_of(group), ", ") &
                 // hint(name%text, schema%names_of(group), "")
      do k = 1, size(schema%keys)
         if (schema%keys(k)%name == lower_case(name%text)) then
            expected = "one of the keys " // join(schema%names_of(group), ", ") &
                       // "; '" // trim(schema%keys(k)%name) // "' belongs to &" &
                       // trim(schema%keys(k)%group)
         end if
      end do
      call status%fail(ehl_bad_input, point_at(source, name%first, name%last, what, expected))
   end function find_key

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

   !> One option group.key=value; words need no quotes here
   subroutine read_option(source, number, schema, status)
      type(source_t), intent(in) :: source
      integer, intent(in) :: number
      type(schema_t), intent(inout) :: schema
      type(status_t), intent(inout) :: status
      character(len=:), allocatable :: group, value
      type(token_t) :: name, token
      integer :: dot, equals, k, position

      equals = index(source%text, "=")
      dot = index(source%text(:max(equals - 1, 0)), ".")
      if (dot == 0) then
         call status%fail(ehl_bad_input, point_at(source, 1, max(1, len(source%text)), &
            "option is not complete", "group.key=value"))
         return
      end if
      group = lower_case(trim(adjustl(source%text(:dot - 1))))
      if (group_position(schema%group_names(), group) == 0) then
         call status%fail(ehl_bad_input, point_at(source, 1, max(1, dot - 1), &
            "unknown group '" // group // "'", "one of " // join(schema%group_names(), ", ") &
            // hint(group, schema%group_names(), "")))
         return
      end if
      name%first = dot + 1
      name%last = max(dot + 1, equals - 1)
      name%text = trim(adjustl(source%text(dot + 1:equals - 1)))
      k = find_key(source, schema, group, name, status)
      if (status%failed()) return
      if (schema%keys(k)%given .and. schema%keys(k)%source > 1) then
         call status%fail(ehl_bad_input, point_at(source, 1, equals - 1, &
            "key " // schema%keys(k)%full_name() // " is set twice", "every key once"))
         return
      end if
      value = source%text(equals + 1:)
      position = equals + 1
      call scan_token(source%text, position, token)
      if (token%kind /= token_string) then
         ! The rest of the option is the value, whatever it looks like
         token%kind = token_atom
         token%first = equals + max(1, verify(value, " "))
         token%text = trim(adjustl(value))
         token%last = max(token%first, token%first + len(token%text) - 1)
         if (token%text == "") token%kind = token_end
      else if (position <= len_trim(source%text)) then
         call status%fail(ehl_bad_input, point_at(source, position, len_trim(source%text), &
            "text behind the value of " // schema%keys(k)%full_name(), "nothing more"))
         return
      end if
      if (token%kind == token_end) then
         call status%fail(ehl_bad_input, point_at(source, equals + 1, equals + 1, &
            "no value for " // schema%keys(k)%full_name(), schema%keys(k)%type_text()))
         return
      end if
      call set_value(schema%keys(k), source, number, name, token, status)
   end subroutine read_option

   !> Names with something between them
   pure function join(names, between) result(text)
      character(len=*), intent(in) :: names(:), between
      character(len=:), allocatable :: text
      integer :: k

      text = trim(names(1))
      do k = 2, size(names)
         text = text // between // trim(names(k))
      end do
   end function join

   !> '; did you mean ...?' where a name is near
   pure function hint(name, names, prefix) result(text)
      character(len=*), intent(in) :: name, names(:), prefix
      character(len=:), allocatable :: text

      text = nearest_word(name, names)
      if (text /= "") text = "; did you mean '" // prefix // text // "'?"
   end function hint
end module ehl_case_reader

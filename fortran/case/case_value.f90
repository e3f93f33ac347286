! SPDX-License-Identifier: BSD-3-Clause
!> From a piece of text to the value of one key, or a message that says why not
module ehl_case_value
   use ehl_case, only: path_length, word_length
   use ehl_case_key, only: allowed_length, choices, key_t, kind_integer, kind_logical, kind_path, kind_real, kind_word, origin_t
   use ehl_kinds, only: dp
   use ehl_scanner, only: token_atom, token_open_string, token_string, token_t
   use ehl_source, only: source_t
   use ehl_status, only: status_t
   use ehl_text, only: lower_case, nearest_word, to_text
   implicit none (type, external)
   private
   public :: set_value

contains

   !> Give a key its value and remember where it came from
   subroutine set_value(key, source, number, name, token, status)
      type(key_t), intent(inout) :: key
      type(source_t), intent(in) :: source
      !> Number of the source: 1 the file, beyond it the options
      integer, intent(in) :: number
      type(token_t), intent(in) :: name, token
      type(status_t), intent(inout) :: status
      character(len=:), allocatable :: problem, expected, near, shown
      integer :: first

      if (token%kind == token_open_string) then
         call source%refuse(token%first, token%last, "the quote in the value of " // key%full_name() // " is not closed", &
                            key%type_text(), status)
         return
      end if
      key%origin_t = origin_t(.true., number, name%first, name%last, token%first, token%last)
      problem = ""
      expected = key%type_text()
      first = token%first
      select case (key%kind)
      case (kind_real, kind_integer)
         call set_number(key, token, number > 1, problem, first)
      case (kind_logical)
         call set_logical(key, token, problem)
      case default
         if (token%kind == token_atom .and. number == 1) then
            problem = "no quotes around the text"
            if (key%kind == kind_word) problem = "no quotes around the word"
            if (key%kind == kind_path) problem = "no quotes around the file name"
         else if (key%kind == kind_word) then
            call set_word(key, token, problem)
         else if (len(token%text) > path_length) then
            problem = "longer than " // to_text(path_length) // " characters"
         else
            call key%text_value%set(token%text)
         end if
      end select
      if (problem == "") return
      if (problem == "out of range") expected = expected // key%in_millimetres(token%text)
      ! units are too short to be near each other
      if (key%kind == kind_word .and. any(len_trim(choices(key%allowed)) > 2)) then
         near = nearest_word(token%text, choices(key%allowed))
         if (near /= "") expected = expected // "; did you mean '" // near // "'?"
      end if
      shown = source%text(token%first:token%last)
      if (len(shown) > 60) shown = shown(:57) // "..."
      call source%refuse(first, token%last, key%full_name() // " = " // shown // ": " // problem, expected, status)
   end subroutine set_value

   !> Real and integer values
   subroutine set_number(key, token, is_option, problem, first)
      type(key_t), intent(inout) :: key
      type(token_t), intent(in) :: token
      !> Whether it is no value of a file: then 65.0 is a whole number
      logical, intent(in) :: is_option
      character(len=:), allocatable, intent(inout) :: problem
      !> Where the fault is in the text
      integer, intent(inout) :: first
      real(dp) :: value
      integer :: length, stat

      length = number_length(token%text)
      if (token%kind == token_string) then
         problem = "text where a number is wanted"
      else if (index(token%text, ",") > 0) then
         problem = "decimal comma, or more than one value"
      else if (is_not_finite(token%text)) then
         problem = "not a finite number"
      else if (index(token%text, "*") > 0) then
         problem = "not one plain number"
      else if (length == 0) then
         problem = "not a number"
      else if (length < len(token%text)) then
         problem = "text behind the number"
         first = token%first + length
      else if (is_huge(token%text)) then
         problem = "too large for a number"
      else
         read (token%text, *, iostat=stat) value
         if (stat /= 0) then
            problem = "cannot be read as a number"
         else if (key%kind == kind_integer .and. (verify(token%text, "+-0123456789") > 0 .and. &
                                                  .not. (is_option .and. .not. abs(value - anint(value)) > 0.0_dp))) then
            problem = "not a whole number"
         else if (.not. key%allows(value)) then
            problem = "out of range"
         else if (key%kind == kind_integer) then
            key%integer_value = nint(value)
         else
            key%real_value = value
         end if
      end if
   end subroutine set_number

   !> Characters of the decimal number that a text begins with: -1.5e-3, .5, 2, 1.d0; 0 when it begins with none
   pure integer function number_length(text)
      character(len=*), intent(in) :: text
      character(len=len(text) + 1) :: line
      integer :: at, digits

      number_length = 0
      line = text
      at = behind_sign(1)
      digits = digits_at(at)
      at = at + digits
      if (line(at:at) == ".") then
         digits = digits + digits_at(at + 1)
         at = at + 1 + digits_at(at + 1)
      end if
      if (digits == 0) return
      number_length = at - 1
      if (scan(line(at:at), "eEdD") == 0) return
      at = behind_sign(at + 1)
      if (digits_at(at) > 0) number_length = at + digits_at(at) - 1

   contains

      !> Position behind an optional sign
      pure integer function behind_sign(first)
         integer, intent(in) :: first
         behind_sign = first + scan(line(first:first), "+-")
      end function behind_sign

      !> Number of digits from a position on
      pure integer function digits_at(first)
         integer, intent(in) :: first
         digits_at = verify(line(first:), "0123456789") - 1
      end function digits_at
   end function number_length

   !> Whether reading a number might overflow: a hundred digits before the point, or three of a positive exponent
   pure logical function is_huge(number)
      character(len=*), intent(in) :: number
      integer :: mark

      mark = scan(number, "eEdD")
      is_huge = scan(number // ".", ".eEdD") > 100
      if (mark == 0 .or. index(number, "-", back=.true.) > mark) return
      is_huge = is_huge .or. len(number) - max(mark, index(number, "+", back=.true.)) > 2
   end function is_huge

   !> Words that other programs write for nan and inf
   pure logical function is_not_finite(text)
      character(len=*), intent(in) :: text
      character(len=:), allocatable :: word

      word = lower_case(text(verify(text // " ", "+-"):))
      is_not_finite = index(word, "nan") == 1 .or. index(word, "inf") == 1
   end function is_not_finite

   !> .true., .false. and their short forms
   subroutine set_logical(key, token, problem)
      type(key_t), intent(inout) :: key
      type(token_t), intent(in) :: token
      character(len=:), allocatable, intent(inout) :: problem

      select case (lower_case(token%text))
      case (".true.", "true", "t", ".t.")
         key%logical_value = .true.
      case (".false.", "false", "f", ".f.")
         key%logical_value = .false.
      case default
         problem = "not a truth value"
      end select
      if (token%kind == token_string) problem = "text where a truth value is wanted"
   end subroutine set_logical

   !> One of the allowed words, in any case
   subroutine set_word(key, token, problem)
      type(key_t), intent(inout) :: key
      type(token_t), intent(in) :: token
      character(len=:), allocatable, intent(inout) :: problem
      character(len=allowed_length), allocatable :: list(:)
      integer :: k

      allocate (list, source=choices(key%allowed))
      problem = "no such choice"
      do k = 1, size(list)
         if (lower_case(list(k)) /= lower_case(token%text)) cycle
         key%word_value = list(k)(:word_length)
         problem = ""
      end do
   end subroutine set_word
end module ehl_case_value

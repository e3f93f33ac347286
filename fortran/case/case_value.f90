! SPDX-License-Identifier: BSD-3-Clause
!> From a piece of text to the value of one key, or a message that says why not
module ehl_case_value
   use ehl_case, only: path_length, word_length
   use ehl_case_key, only: key_t, kind_integer, kind_logical, kind_path, kind_real, kind_text, kind_word
   use ehl_kinds, only: dp
   use ehl_scanner, only: is_real_number, is_whole_number, token_atom, token_open_string, &
                          token_string, token_t
   use ehl_source, only: point_at, source_t
   use ehl_status, only: ehl_bad_input, status_t
   use ehl_text, only: lower_case, nearest_word, to_text
   implicit none (type, external)
   private
   public :: set_value

   !> Largest power of ten that is tried to be read: beyond it reading itself may overflow
   integer, parameter :: maxexponent_10 = range(1.0_dp) - 1

contains

   !> Give a key its value and remember where it came from
   subroutine set_value(key, source, number, name, token, status)
      type(key_t), intent(inout) :: key
      type(source_t), intent(in) :: source
      !> Number of the source: 1 the file, beyond it the --set options
      integer, intent(in) :: number
      type(token_t), intent(in) :: name, token
      type(status_t), intent(inout) :: status
      character(len=:), allocatable :: problem

      if (token%kind == token_open_string) then
         call status%fail(ehl_bad_input, point_at(source, token%first, token%last, &
            "the quote in the value of " // key%full_name() // " is not closed", key%type_text()))
         return
      end if
      key%given = .true.
      key%source = number
      key%name_first = name%first
      key%name_last = name%last
      key%first = token%first
      key%last = token%last
      problem = ""
      select case (key%kind)
      case (kind_real)
         call set_number(key, token, problem)
      case (kind_integer)
         call set_number(key, token, problem)
      case (kind_logical)
         call set_logical(key, token, problem)
      case (kind_word)
         call set_word(key, token, number > 1, problem)
      case (kind_path, kind_text)
         call set_path(key, token, number > 1, problem)
      case default
         problem = "no such kind"
      end select
      if (problem == "") return
      call refuse(key, source, token, problem, status)
   end subroutine set_value

   !> One message about the value of a key
   subroutine refuse(key, source, token, problem, status)
      type(key_t), intent(in) :: key
      type(source_t), intent(in) :: source
      type(token_t), intent(in) :: token
      character(len=*), intent(in) :: problem
      type(status_t), intent(inout) :: status
      character(len=:), allocatable :: expected, near
      integer :: first, length

      expected = key%type_text()
      if (key%kind == kind_word) then
         near = nearest_word(token%text, choices(key%allowed))
         if (near /= "") expected = expected // "; did you mean '" // near // "'?"
      end if
      first = token%first
      if (problem == "text behind the number") then
         length = number_length(token%text)
         first = token%first + length
      end if
      call status%fail(ehl_bad_input, point_at(source, first, token%last, &
         key%full_name() // " = " // shortened(source%text(token%first:token%last)) // ": " // problem, &
         expected))
   end subroutine refuse

   !> A value as a message shows it
   pure function shortened(text) result(answer)
      character(len=*), intent(in) :: text
      character(len=:), allocatable :: answer

      answer = text
      if (len(text) > 60) answer = text(:57) // "..."
   end function shortened

   !> Real and integer values
   subroutine set_number(key, token, problem)
      type(key_t), intent(inout) :: key
      type(token_t), intent(in) :: token
      character(len=:), allocatable, intent(inout) :: problem
      real(dp) :: value
      integer :: stat

      if (token%kind == token_string) then
         problem = "text where a number is wanted"
         return
      end if
      if (index(token%text, ",") > 0) then
         problem = "decimal comma, or more than one value"
         return
      end if
      if (.not. is_real_number(token%text)) then
         problem = "not a number"
         if (number_length(token%text) > 0) problem = "text behind the number"
         if (index(token%text, "*") > 0) problem = "not one plain number"
         if (is_not_finite(token%text)) problem = "not a finite number"
         return
      end if
      if (decimal_exponent(token%text) > maxexponent_10) then
         problem = "too large for a number"
         return
      end if
      read (token%text, *, iostat=stat) value
      if (stat /= 0) then
         problem = "cannot be read as a number"
      else if (key%kind == kind_integer .and. .not. is_whole_number(token%text)) then
         problem = "not a whole number"
      else if (.not. key%allows(value)) then
         problem = "out of range"
      else if (key%kind == kind_integer) then
         key%integer_value = nint(value)
      else
         key%real_value = value
      end if
   end subroutine set_number

   !> Upper bound of the power of ten of a number: digits before the point, and the exponent
   pure integer function decimal_exponent(text)
      character(len=*), intent(in) :: text
      integer :: mark, stat, power, first

      mark = scan(text, "eEdD")
      decimal_exponent = scan(text, ".eEdD") - 1
      if (decimal_exponent < 0) decimal_exponent = len(text)
      if (mark == 0) return
      first = mark + 1
      if (len(text) - first > 8) then
         ! So long an exponent is out of range whatever it is, unless it is negative
         power = 10**8
         if (text(first:first) == "-") power = -10**8
      else
         read (text(first:), *, iostat=stat) power
         if (stat /= 0) power = 10**8
      end if
      decimal_exponent = decimal_exponent + power
   end function decimal_exponent

   !> Words that other programs write for nan and inf
   pure logical function is_not_finite(text)
      character(len=*), intent(in) :: text
      character(len=:), allocatable :: word

      word = lower_case(text)
      if (scan(word(1:1), "+-") == 1) word = word(2:)
      is_not_finite = index(word, "nan") == 1 .or. index(word, "inf") == 1
   end function is_not_finite

   !> Characters of the number that a text begins with; 0 when it begins with none
   pure integer function number_length(text)
      character(len=*), intent(in) :: text

      do number_length = len(text), 1, -1
         if (is_real_number(text(:number_length))) return
      end do
      number_length = 0
   end function number_length

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
   subroutine set_word(key, token, bare, problem)
      type(key_t), intent(inout) :: key
      type(token_t), intent(in) :: token
      !> Whether the word may stand without quotes
      logical, intent(in) :: bare
      character(len=:), allocatable, intent(inout) :: problem
      character(len=len(key%allowed)), allocatable :: list(:)
      integer :: k

      if (token%kind == token_atom .and. .not. bare) then
         problem = "no quotes around the word"
         return
      end if
      list = choices(key%allowed)
      do k = 1, size(list)
         if (lower_case(list(k)) == lower_case(token%text)) then
            key%word_value = list(k)(:word_length)
            return
         end if
      end do
      problem = "no such choice"
   end subroutine set_word

   !> Words of a list 'this|that'
   pure function choices(allowed) result(list)
      character(len=*), intent(in) :: allowed
      character(len=len(allowed)), allocatable :: list(:)
      integer :: start, bar

      allocate (list(0))
      start = 1
      do
         bar = index(allowed(start:), "|")
         if (bar == 0) exit
         list = [character(len=len(allowed)) :: list, allowed(start:start + bar - 2)]
         start = start + bar
      end do
      list = [character(len=len(allowed)) :: list, trim(allowed(start:))]
   end function choices

   !> A file name, or any text
   subroutine set_path(key, token, bare, problem)
      type(key_t), intent(inout) :: key
      type(token_t), intent(in) :: token
      logical, intent(in) :: bare
      character(len=:), allocatable, intent(inout) :: problem

      if (token%kind == token_atom .and. .not. bare) then
         problem = "no quotes around the " // trim(merge("file name", "text     ", key%kind == kind_path))
      else if (len(token%text) > path_length) then
         problem = "longer than " // to_text(path_length) // " characters"
      else
         key%path_value = token%text
      end if
   end subroutine set_path
end module ehl_case_value

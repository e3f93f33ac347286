! SPDX-License-Identifier: BSD-3-Clause
!> A text with a name, the pieces of namelist text in it with their positions, and messages that point into it
module ehl_source
   use ehl_status, only: ehl_bad_input, status_t
   use ehl_text, only: newline, to_text
   implicit none (type, external)
   private
   public :: source_t, line_number, token_t, scan_token, token_end, token_group, token_atom, token_string, token_equals, &
             token_comma, token_slash, token_open_string

   !> Longest part of a line that a message shows
   integer, parameter :: shown = 100

   !> The text of a case file, or of one --set option
   type :: source_t
      !> What a message calls it: a file name, or '--set' and the option
      character(len=:), allocatable :: name
      !> Ends with a line end
      character(len=:), allocatable :: text
      !> Whether messages give line and column
      logical :: has_lines = .true.
   contains
      procedure :: refuse
   end type source_t

   integer, parameter :: token_end = 0
   !> '&name'; a name, number or logical; 'text' between quotes; '='; ','; '/'
   integer, parameter :: token_group = 1, token_atom = 2, token_string = 3
   integer, parameter :: token_equals = 4, token_comma = 5, token_slash = 6
   !> A quote that is not closed on its line
   integer, parameter :: token_open_string = 7

   !> One piece: text(first:last)
   type :: token_t
      integer :: kind = token_end
      integer :: first = 0, last = 0
      !> The characters of an atom; the name of a group without '&'; a string without its quotes
      character(len=:), allocatable :: text
   end type token_t

   character(len=*), parameter :: blank = " "//achar(9)//achar(13)//newline

contains

   !> Refuse what stands at text(first:last) with a message of several lines:
   !> name:line:column: error: what; the line; a caret under the fault; what was expected
   subroutine refuse(self, first, last, what, expected, status)
      class(source_t), intent(in) :: self
      integer, intent(in) :: first, last
      character(len=*), intent(in) :: what, expected
      type(status_t), intent(inout) :: status
      character(len=:), allocatable :: place, margin, number
      integer :: start, finish, from

      associate (text => self%text)
         start = index(text(:first - 1), newline, back=.true.) + 1
         finish = start + index(text(start:), newline) - 2
         ! of a long line only the part around the fault is shown
         from = start
         if (first - start > shown - 20) then
            from = first - shown/2
            do while (is_continuation(text(from:from)))
               from = from - 1
            end do
         end if
         place = self%name
         margin = "  "
         if (self%has_lines) then
            number = to_text(line_number(text, first))
            place = place//":"//number//":"//to_text(characters(text(start:first - 1)) + 1)
            margin = margin//number//" "
         end if
         call status%fail(ehl_bad_input, place//": error: "//what//newline// &
                          margin//"| "//one_line(text(from:min(finish, from + shown - 1)))//newline// &
                          repeat(" ", len(margin))//"| "//blanks_for(text(from:first - 1))// &
                          repeat("^", max(1, characters(text(first:min(last, finish)))))//newline// &
                          "expected: "//expected)
      end associate
   end subroutine refuse

   !> Line of a position, from 1
   pure integer function line_number(text, position)
      character(len=*), intent(in) :: text
      integer, intent(in) :: position
      integer :: i

      line_number = 1 + count([(text(i:i) == newline, i=1, position - 1)])
   end function line_number

   !> Whether a byte is not the first one of a character of UTF-8 text
   elemental logical function is_continuation(byte)
      character(len=1), intent(in) :: byte
      is_continuation = iand(iachar(byte), 192) == 128
   end function is_continuation

   !> Number of characters of UTF-8 text
   pure integer function characters(text)
      character(len=*), intent(in) :: text
      integer :: i

      characters = count([(.not. is_continuation(text(i:i)), i=1, len(text))])
   end function characters

   !> Blanks as wide as the text; tabs stay tabs, so that the caret stands right
   pure function blanks_for(text) result(blanks)
      character(len=*), intent(in) :: text
      character(len=:), allocatable :: blanks
      integer :: i

      blanks = ""
      do i = 1, len(text)
         if (.not. is_continuation(text(i:i))) blanks = blanks//merge(text(i:i), " ", text(i:i) == achar(9))
      end do
   end function blanks_for

   !> A line fit for a terminal: control characters other than tabs as blanks
   pure function one_line(line) result(clean)
      character(len=*), intent(in) :: line
      character(len=len(line)) :: clean
      integer :: i

      clean = line
      do i = 1, len(line)
         if ((iachar(line(i:i)) < 32 .and. line(i:i) /= achar(9)) .or. iachar(line(i:i)) == 127) clean(i:i) = " "
      end do
   end function one_line

   !> The piece at or behind the position, which moves behind it; '!' starts a comment
   subroutine scan_token(text, position, token)
      !> Ends with a line end
      character(len=*), intent(in) :: text
      integer, intent(inout) :: position
      type(token_t), intent(out) :: token

      token%text = ""
      do while (position <= len(text))
         if (text(position:position) == "!") then
            position = position + index(text(position:), newline)
         else if (scan(text(position:position), blank) == 1) then
            position = position + 1
         else
            exit
         end if
      end do
      token%first = position
      token%last = position
      if (position > len(text)) return
      select case (text(position:position))
      case ("=")
         token%kind = token_equals
      case (",")
         token%kind = token_comma
      case ("/")
         token%kind = token_slash
      case ("'", '"')
         call scan_string(text, token)
      case ("&")
         token%kind = token_group
         token%last = position + length_of_atom(text(position + 1:))
         token%text = text(position + 1:token%last)
      case default
         token%kind = token_atom
         ! a character that can begin no piece is a piece of its own
         token%last = position + max(1, length_of_atom(text(position:))) - 1
         token%text = text(position:token%last)
      end select
      position = token%last + 1
   end subroutine scan_token

   !> A string from its opening quote; a doubled quote stands for one
   subroutine scan_string(text, token)
      character(len=*), intent(in) :: text
      type(token_t), intent(inout) :: token
      integer :: i

      token%kind = token_open_string
      i = token%first + 1
      do while (text(i:i) /= newline)
         if (text(i:i) == text(token%first:token%first)) then
            if (text(i + 1:i + 1) /= text(i:i)) then
               token%kind = token_string
               token%last = i
               return
            end if
            i = i + 1
         end if
         token%text = token%text//text(i:i)
         i = i + 1
      end do
      token%last = i - 1
   end subroutine scan_string

   !> Number of characters that belong to one word or number
   pure integer function length_of_atom(text)
      character(len=*), intent(in) :: text
      length_of_atom = scan(text, blank//",/=!'""&;") - 1
   end function length_of_atom
end module ehl_source

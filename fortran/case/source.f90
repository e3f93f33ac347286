! SPDX-License-Identifier: BSD-3-Clause
!> A text with a name, and messages that point into it
module ehl_source
   use ehl_status, only: ehl_bad_input, status_t
   use ehl_text, only: newline, to_text
   implicit none (type, external)
   private
   public :: source_t, line_number

   !> Longest part of a line that a message shows
   integer, parameter :: shown = 100

   !> The text of a case file, or of one option
   type :: source_t
      !> What a message calls it: a file name, or the option as it was given
      character(len=:), allocatable :: name
      !> Ends with a line end
      character(len=:), allocatable :: text
      !> Whether messages give line and column
      logical :: has_lines = .true.
   contains
      procedure :: refuse
   end type source_t

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
      character(len=characters(text)) :: blanks
      integer :: i, n

      n = 0
      do i = 1, len(text)
         if (is_continuation(text(i:i))) cycle
         n = n + 1
         blanks(n:n) = merge(text(i:i), " ", text(i:i) == achar(9))
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
end module ehl_source

! SPDX-License-Identifier: BSD-3-Clause
!> A text with a name, and messages that point into it
module ehl_source
   use ehl_text, only: newline, to_text
   implicit none (type, external)
   private
   public :: source_t, point_at, line_number, column_number

   !> Longest part of a line that a message shows
   integer, parameter :: shown = 100

   !> The text of a case file, or of one --set option
   type :: source_t
      !> What a message calls it: a file name, or '--set' and the option
      character(len=:), allocatable :: name
      character(len=:), allocatable :: text
      !> Whether messages give line and column
      logical :: has_lines = .true.
   end type source_t

contains

   !> A message of several lines about text(first:last):
   !> name:line:column: error: what; the line; a caret under the fault; what was expected
   function point_at(source, first, last, what, expected) result(message)
      type(source_t), intent(in) :: source
      integer, intent(in) :: first, last
      character(len=*), intent(in) :: what, expected
      character(len=:), allocatable :: message
      character(len=:), allocatable :: place, margin, line
      integer :: start, finish, from, at

      call line_bounds(source%text, first, start, finish)
      ! Of a long line only the part around the fault is shown
      from = start
      if (first - start > shown - 20) from = first - shown/2
      from = whole_character(source%text, from, start)
      line = one_line(source%text(from:min(finish, from + shown - 1)))
      margin = "  "
      place = source%name
      if (source%has_lines) then
         margin = "  " // to_text(line_number(source%text, first)) // " "
         place = place // ":" // to_text(line_number(source%text, first)) // ":" &
                 // to_text(column_number(source%text, first))
      end if
      at = min(first, finish + 1)
      message = place // ": error: " // what // newline &
                // margin // "| " // line // newline &
                // repeat(" ", len(margin)) // "| " // blanks_for(source%text(from:at - 1)) &
                // repeat("^", max(1, characters(source%text(at:min(last, finish))))) // newline &
                // "expected: " // expected
   end function point_at

   !> First and last character of the line that holds the position (last is before the line end)
   pure subroutine line_bounds(text, position, start, finish)
      character(len=*), intent(in) :: text
      integer, intent(in) :: position
      integer, intent(out) :: start, finish

      start = index(text(:min(position - 1, len(text))), newline, back=.true.) + 1
      finish = index(text(start:), newline)
      if (finish == 0) then
         finish = len(text)
      else
         finish = start + finish - 2
      end if
   end subroutine line_bounds

   !> Line of a position, from 1
   pure integer function line_number(text, position)
      character(len=*), intent(in) :: text
      integer, intent(in) :: position
      integer :: i

      line_number = 1
      do i = 1, min(position - 1, len(text))
         if (text(i:i) == newline) line_number = line_number + 1
      end do
   end function line_number

   !> Column of a position, in characters from 1
   pure integer function column_number(text, position)
      character(len=*), intent(in) :: text
      integer, intent(in) :: position
      integer :: start, finish

      call line_bounds(text, position, start, finish)
      column_number = characters(text(start:min(position - 1, len(text)))) + 1
   end function column_number

   !> Number of characters of UTF-8 text: continuation bytes do not count
   pure integer function characters(text)
      character(len=*), intent(in) :: text
      integer :: i

      characters = 0
      do i = 1, len(text)
         if (iand(iachar(text(i:i)), 192) /= 128) characters = characters + 1
      end do
   end function characters

   !> The position, moved left to the first byte of a UTF-8 character
   pure integer function whole_character(text, position, start)
      character(len=*), intent(in) :: text
      integer, intent(in) :: position, start

      whole_character = position
      do while (whole_character > start)
         if (iand(iachar(text(whole_character:whole_character)), 192) /= 128) exit
         whole_character = whole_character - 1
      end do
   end function whole_character

   !> Blanks as wide as the text; tabs stay tabs, so that the caret stands right
   pure function blanks_for(text) result(blanks)
      character(len=*), intent(in) :: text
      character(len=:), allocatable :: blanks
      integer :: i

      blanks = ""
      do i = 1, len(text)
         if (text(i:i) == achar(9)) then
            blanks = blanks // achar(9)
         else if (iand(iachar(text(i:i)), 192) /= 128) then
            blanks = blanks // " "
         end if
      end do
   end function blanks_for

   !> A line fit for a terminal: control characters other than tabs as blanks
   pure function one_line(line) result(clean)
      character(len=*), intent(in) :: line
      character(len=len(line)) :: clean
      integer :: i

      clean = line
      do i = 1, len(line)
         if (iachar(line(i:i)) < 32 .and. line(i:i) /= achar(9)) clean(i:i) = " "
         if (iachar(line(i:i)) == 127) clean(i:i) = " "
      end do
   end function one_line
end module ehl_source

! SPDX-License-Identifier: BSD-3-Clause
!> The pieces of namelist text, each with its position
module ehl_scanner
   use ehl_text, only: is_digit, newline
   implicit none (type, external)
   private
   public :: token_t, scan_token, is_real_number, is_whole_number
   public :: token_end, token_group, token_atom, token_string, token_equals, token_comma
   public :: token_slash, token_open_string

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

   character(len=*), parameter :: blank = " " // achar(9) // achar(13) // newline

contains

   !> The piece at or behind the position, which moves behind it; '!' starts a comment
   subroutine scan_token(text, position, token)
      character(len=*), intent(in) :: text
      integer, intent(inout) :: position
      type(token_t), intent(out) :: token
      integer :: skip

      do
         if (position > len(text)) exit
         if (text(position:position) == "!") then
            skip = index(text(position:), newline)
            if (skip == 0) skip = len(text) - position + 2
            position = position + skip
         else if (scan(text(position:position), blank) == 1) then
            position = position + 1
         else
            exit
         end if
      end do
      token%first = position
      token%last = position
      token%text = ""
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
         token%last = end_of_atom(text, position + 1)
         token%text = text(position + 1:token%last)
      case default
         token%kind = token_atom
         token%last = end_of_atom(text, position)
         token%text = text(position:token%last)
      end select
      position = token%last + 1
   end subroutine scan_token

   !> A string from its opening quote; a doubled quote stands for one
   subroutine scan_string(text, token)
      character(len=*), intent(in) :: text
      type(token_t), intent(inout) :: token
      character(len=1) :: quote
      integer :: i

      quote = text(token%first:token%first)
      token%kind = token_string
      i = token%first + 1
      do
         if (i > len(text)) exit
         if (text(i:i) == newline) exit
         if (text(i:i) == quote) then
            if (i == len(text)) then
               token%last = i
               return
            end if
            if (text(i + 1:i + 1) /= quote) then
               token%last = i
               return
            end if
            i = i + 1
         end if
         token%text = token%text // text(i:i)
         i = i + 1
      end do
      token%kind = token_open_string
      token%last = i - 1
   end subroutine scan_string

   !> Last position of the run of characters that belong to one word or number
   pure integer function end_of_atom(text, first)
      character(len=*), intent(in) :: text
      integer, intent(in) :: first
      integer :: length

      length = scan(text(first:), blank // ",/=!'""&;") - 1
      if (length < 0) length = len(text) - first + 1
      ! A character that can begin no piece is a piece of its own
      end_of_atom = first + length - 1
      if (end_of_atom < first .and. first <= len(text)) then
         if (text(first:first) == ";") end_of_atom = first
      end if
   end function end_of_atom

   !> Whether the whole text is a decimal real or integer: -1.5e-3, .5, 2, 1.d0
   pure logical function is_real_number(text)
      character(len=*), intent(in) :: text
      integer :: i, digits

      is_real_number = .false.
      i = behind_sign(text, 1)
      digits = digits_at(text, i)
      i = i + digits
      if (i <= len(text)) then
         if (text(i:i) == ".") then
            digits = digits + digits_at(text, i + 1)
            i = i + 1 + digits_at(text, i + 1)
         end if
      end if
      if (digits == 0) return
      if (i <= len(text)) then
         if (scan(text(i:i), "eEdD") == 0) return
         i = behind_sign(text, i + 1)
         digits = digits_at(text, i)
         if (digits == 0) return
         i = i + digits
      end if
      is_real_number = i == len(text) + 1
   end function is_real_number

   !> Whether the whole text is an integer
   pure logical function is_whole_number(text)
      character(len=*), intent(in) :: text
      integer :: i, digits

      i = behind_sign(text, 1)
      digits = digits_at(text, i)
      is_whole_number = digits > 0 .and. i + digits == len(text) + 1
   end function is_whole_number

   !> Position behind an optional sign
   pure integer function behind_sign(text, first)
      character(len=*), intent(in) :: text
      integer, intent(in) :: first

      behind_sign = first
      if (first > len(text)) return
      if (scan(text(first:first), "+-") == 1) behind_sign = first + 1
   end function behind_sign

   !> Number of digits from a position on
   pure integer function digits_at(text, first)
      character(len=*), intent(in) :: text
      integer, intent(in) :: first
      integer :: i

      digits_at = 0
      do i = first, len(text)
         if (.not. is_digit(text(i:i))) return
         digits_at = digits_at + 1
      end do
   end function digits_at
end module ehl_scanner

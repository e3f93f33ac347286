! SPDX-License-Identifier: BSD-3-Clause
!> The pieces of namelist text, each with its position
module ehl_scanner
   use ehl_text, only: newline
   implicit none (type, external)
   private
   public :: token_t, scan_token
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

   character(len=*), parameter :: blank = " "//achar(9)//achar(13)//newline

contains

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
end module ehl_scanner

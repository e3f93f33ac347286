! SPDX-License-Identifier: BSD-3-Clause
!> Text: numbers as text, lower case, lines, and the nearest of several words
!>
!> Several threads convert numbers to text. gfortran stores the length of an allocatable function result in static memory, so
!> the length of these texts follows from the arguments. tests/core/test_threads.py detects allocatable results in threads.
module ehl_text
   use, intrinsic :: iso_fortran_env, only: int64
   use ehl_kinds, only: dp
   use ehl_number_text, only: fixed_buffer, integer_buffer, real_buffer, rounded_buffer
   implicit none (type, external)
   private
   public :: newline, to_text, fixed, percent, rounded, short, lower_case, nearest_word, quoted

   !> Line separator in texts and files
   character(len=*), parameter :: newline = new_line("a")

   !> A number or a logical value as the shortest text that reads back as the same value
   interface to_text
      module procedure real_to_text
      module procedure integer_to_text
      module procedure long_to_text
      module procedure logical_to_text
   end interface to_text

   !> A number to three, or a given number of, digits
   interface rounded
      module procedure rounded_to_three
      module procedure rounded_to
   end interface rounded

contains

   !> Shortest decimal text that reads back as exactly x: '0.4', '2.2e-8', '600.0';
   !> 'nan', 'inf' or '-inf' if x is not finite
   pure function real_to_text(x) result(text)
      real(dp), intent(in) :: x
      character(len=len_trim(real_buffer(x))) :: text
      text = real_buffer(x)
   end function real_to_text

   !> A number by an edit descriptor such as 'f8.4', without blanks; by 'es12.5' if it does not fit, and to three
   !> digits if rounding would change it too much: 2.64E-06, not 0.0000
   pure function fixed(x, form) result(text)
      real(dp), intent(in) :: x
      character(len=*), intent(in) :: form
      character(len=len_trim(fixed_buffer(x, form))) :: text
      text = fixed_buffer(x, form)
   end function fixed

   !> A number to four digits, for messages
   pure function short(x) result(text)
      real(dp), intent(in) :: x
      character(len=len_trim(fixed_buffer(x, "es10.3"))) :: text
      text = fixed_buffer(x, "es10.3")
   end function short

   !> A number to three digits
   pure function rounded_to_three(x) result(text)
      real(dp), intent(in) :: x
      character(len=len_trim(rounded_buffer(x, 3))) :: text
      text = rounded_buffer(x, 3)
   end function rounded_to_three

   !> A number to a given number of digits
   pure function rounded_to(x, digits) result(text)
      real(dp), intent(in) :: x
      integer, intent(in) :: digits
      character(len=len_trim(rounded_buffer(x, digits))) :: text
      text = rounded_buffer(x, digits)
   end function rounded_to

   !> A fraction in per cent
   pure function percent(fraction) result(text)
      real(dp), intent(in) :: fraction
      character(len=len_trim(rounded_buffer(100.0_dp*fraction, 2)) + 2) :: text
      text = trim(rounded_buffer(100.0_dp*fraction, 2))//" %"
   end function percent

   !> Integer without blanks
   pure function integer_to_text(i) result(text)
      integer, intent(in) :: i
      character(len=len_trim(integer_buffer(int(i, int64)))) :: text
      text = integer_buffer(int(i, int64))
   end function integer_to_text

   !> Integer of 64 bits without blanks
   pure function long_to_text(i) result(text)
      integer(int64), intent(in) :: i
      character(len=len_trim(integer_buffer(i))) :: text
      text = integer_buffer(i)
   end function long_to_text

   !> .true. or .false.
   pure function logical_to_text(flag) result(text)
      logical, intent(in) :: flag
      character(len=merge(6, 7, flag)) :: text

      text = ".false."
      if (flag) text = ".true."
   end function logical_to_text

   !> Text between single quotes, inner quotes doubled as in a namelist
   pure function quoted(text) result(answer)
      character(len=*), intent(in) :: text
      character(len=:), allocatable :: answer
      integer :: i

      answer = "'"
      do i = 1, len(text)
         answer = answer // text(i:i)
         if (text(i:i) == "'") answer = answer // "'"
      end do
      answer = answer // "'"
   end function quoted

   !> Text with its ASCII capitals in lower case
   pure function lower_case(text) result(answer)
      character(len=*), intent(in) :: text
      character(len=len(text)) :: answer
      integer :: i, code

      do i = 1, len(text)
         code = iachar(text(i:i))
         if (code >= iachar("A") .and. code <= iachar("Z")) code = code + 32
         answer(i:i) = achar(code)
      end do
   end function lower_case

   !> The word of the list with the fewest edits from the given one (insertion,
   !> deletion, substitution, transposition); empty if none is near
   pure function nearest_word(word, list) result(answer)
      character(len=*), intent(in) :: word
      character(len=*), intent(in) :: list(:)
      character(len=:), allocatable :: answer
      integer :: k, distance, best

      answer = ""
      best = max(2, len_trim(word)/2) + 1
      do k = 1, size(list)
         distance = edits(trim(lower_case(word)), trim(list(k)))
         ! A beginning of the word counts as near: 'visc' for 'viscosity'
         if (len_trim(word) >= 3 .and. index(trim(list(k)), trim(lower_case(word))) == 1) distance = 1
         if (distance < best) then
            best = distance
            answer = trim(list(k))
         end if
      end do
   end function nearest_word

   !> Edit distance with transpositions (Damerau, restricted form)
   pure integer function edits(a, b)
      character(len=*), intent(in) :: a, b
      integer :: d(-1:len(a), -1:len(b))
      integer :: i, j, cost

      d = len(a) + len(b)
      d(0:, 0) = [(i, i=0, len(a))]
      d(0, 0:) = [(j, j=0, len(b))]
      do j = 1, len(b)
         do i = 1, len(a)
            cost = merge(0, 1, a(i:i) == b(j:j))
            d(i, j) = min(d(i - 1, j) + 1, d(i, j - 1) + 1, d(i - 1, j - 1) + cost)
            if (i > 1 .and. j > 1) then
               if (a(i:i) == b(j - 1:j - 1) .and. a(i - 1:i - 1) == b(j:j)) then
                  d(i, j) = min(d(i, j), d(i - 2, j - 2) + 1)
               end if
            end if
         end do
      end do
      edits = d(len(a), len(b))
   end function edits
end module ehl_text

! SPDX-License-Identifier: BSD-3-Clause
!> Text: numbers as text, lower case, lines, and the nearest of several words
module ehl_text
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use, intrinsic :: iso_fortran_env, only: int64
   use ehl_kinds, only: dp
   implicit none (type, external)
   private
   public :: newline, to_text, fixed, percent, rounded, short, lower_case, is_letter, is_digit, nearest_word, quoted

   !> Line separator in texts and files
   character(len=*), parameter :: newline = new_line("a")

   !> A number or a truth value as the shortest text that reads back as the same value
   interface to_text
      module procedure real_to_text
      module procedure integer_to_text
      module procedure long_to_text
      module procedure logical_to_text
   end interface to_text

contains

   !> Shortest decimal text that reads back as exactly x: '0.4', '2.2e-8', '600.0';
   !> 'nan', 'inf' or '-inf' where x is not finite
   pure function real_to_text(x) result(text)
      real(dp), intent(in) :: x
      character(len=:), allocatable :: text
      character(len=32) :: buffer
      character(len=16) :: form
      character(len=:), allocatable :: digits
      real(dp) :: back
      integer :: n, exponent, mark, stat

      if (.not. ieee_is_finite(x)) then
         text = "nan"
         if (x > huge(x)) text = "inf"
         if (x < -huge(x)) text = "-inf"
         return
      end if
      if (.not. abs(x) > 0.0_dp) then
         text = "0.0"
         return
      end if
      do n = 1, 17
         write (form, "(a, i0, a)") "(es32.", n - 1, "e3)"
         write (buffer, form) x
         read (buffer, *, iostat=stat) back
         if (stat == 0 .and. .not. abs(back - x) > 0.0_dp) exit
      end do
      buffer = adjustl(buffer)
      mark = scan(buffer, "E")
      read (buffer(mark + 1:), *) exponent
      digits = keep_digits(buffer(:mark - 1))
      text = place_point(digits, exponent)
      if (x < 0.0_dp) text = "-" // text
   end function real_to_text

   !> A number by an edit descriptor such as 'f8.4', without blanks around it; by 'es12.5' where it does not fit
   function fixed(x, form) result(text)
      real(dp), intent(in) :: x
      character(len=*), intent(in) :: form
      character(len=:), allocatable :: text
      character(len=32) :: buffer

      write (buffer, "("//form//")") x
      if (buffer(1:1) == "*") write (buffer, "(es12.5)") x
      text = trim(adjustl(buffer))
   end function fixed

   !> Four digits of a number, for messages
   function short(x) result(text)
      real(dp), intent(in) :: x
      character(len=:), allocatable :: text
      text = fixed(x, "es10.3")
   end function short

   !> A number to three digits, or so many
   function rounded(x, digits) result(text)
      real(dp), intent(in) :: x
      integer, intent(in), optional :: digits
      character(len=:), allocatable :: text
      integer :: n, decimals

      n = 3
      if (present(digits)) n = digits
      decimals = n
      ! 9.996 is '10.0'
      if (abs(x) > 0.0_dp) decimals = max(0, n - 1 - floor(log10(abs(x)*(1.0_dp + 0.5_dp*10.0_dp**(-n)))))
      text = fixed(x, "f32."//to_text(decimals))
      if (decimals == 0) text = text(:len(text) - 1)
   end function rounded

   !> A share in per cent
   function percent(share) result(text)
      real(dp), intent(in) :: share
      character(len=:), allocatable :: text

      text = rounded(100.0_dp*share, 2)//" %"
   end function percent

   !> The digits of a mantissa, without sign, point and trailing zeros
   pure function keep_digits(mantissa) result(digits)
      character(len=*), intent(in) :: mantissa
      character(len=:), allocatable :: digits
      integer :: i, last

      digits = ""
      do i = 1, len(mantissa)
         if (is_digit(mantissa(i:i))) digits = digits // mantissa(i:i)
      end do
      last = verify(digits, "0", back=.true.)
      digits = digits(:max(last, 1))
   end function keep_digits

   !> d.ddd * 10**exponent written plainly where that is short, else with an exponent
   pure function place_point(digits, exponent) result(text)
      character(len=*), intent(in) :: digits
      integer, intent(in) :: exponent
      character(len=:), allocatable :: text
      integer :: n

      n = len(digits)
      if (exponent >= 0 .and. exponent < 7) then
         if (n <= exponent + 1) then
            text = digits // repeat("0", exponent + 1 - n) // ".0"
         else
            text = digits(:exponent + 1) // "." // digits(exponent + 2:)
         end if
      else if (exponent < 0 .and. exponent >= -4) then
         text = "0." // repeat("0", -exponent - 1) // digits
      else
         text = digits(1:1)
         if (n > 1) text = text // "." // digits(2:)
         text = text // "e" // integer_to_text(exponent)
      end if
   end function place_point

   !> Integer without blanks
   pure function integer_to_text(i) result(text)
      integer, intent(in) :: i
      character(len=:), allocatable :: text
      text = long_to_text(int(i, int64))
   end function integer_to_text

   !> The same for large ones
   pure function long_to_text(i) result(text)
      integer(int64), intent(in) :: i
      character(len=:), allocatable :: text
      character(len=24) :: buffer

      write (buffer, "(i0)") i
      text = trim(buffer)
   end function long_to_text

   !> .true. or .false.
   pure function logical_to_text(flag) result(text)
      logical, intent(in) :: flag
      character(len=:), allocatable :: text

      text = ".false."
      if (flag) text = ".true."
   end function logical_to_text

   !> Text between single quotes, inner quotes doubled as a namelist wants them
   pure function quoted(text) result(answer)
      character(len=*), intent(in) :: text
      character(len=:), allocatable :: answer
      integer :: i

      answer = "'"
      do i = 1, len_trim(text)
         answer = answer // text(i:i)
         if (text(i:i) == "'") answer = answer // "'"
      end do
      answer = answer // "'"
   end function quoted

   !> ASCII capitals made small
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

   !> ASCII letter or underscore
   elemental logical function is_letter(c)
      character(len=1), intent(in) :: c
      is_letter = (c >= "a" .and. c <= "z") .or. (c >= "A" .and. c <= "Z") .or. c == "_"
   end function is_letter

   !> ASCII digit
   elemental logical function is_digit(c)
      character(len=1), intent(in) :: c
      is_digit = c >= "0" .and. c <= "9"
   end function is_digit

   !> The word of the list that needs the fewest edits to become the given one (insertion,
   !> deletion, substitution, swap of neighbours); empty when none is near
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

   !> Edit distance with swaps of neighbours (Damerau, restricted form)
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

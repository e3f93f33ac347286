! SPDX-License-Identifier: BSD-3-Clause
!> Numbers as text padded with blanks. ehl_text trims them; these functions define the length of its results, which requires a
!> separate module.
module ehl_number_text
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use, intrinsic :: iso_fortran_env, only: int64
   use ehl_kinds, only: dp
   implicit none (type, external)
   private
   public :: amount_buffer, real_buffer, fixed_buffer, rounded_buffer, integer_buffer

   !> Maximum length of the text of a number; formats by the number of digits
   integer, parameter :: longest_number = 32
   character(len=*), parameter :: forms(17) = [character(len=11) :: &
                                               "(es32.0e3)", "(es32.1e3)", "(es32.2e3)", "(es32.3e3)", "(es32.4e3)", &
                                               "(es32.5e3)", "(es32.6e3)", "(es32.7e3)", "(es32.8e3)", "(es32.9e3)", &
                                               "(es32.10e3)", "(es32.11e3)", "(es32.12e3)", "(es32.13e3)", "(es32.14e3)", &
                                               "(es32.15e3)", "(es32.16e3)"]

contains

   !> Shortest decimal text that reads back as exactly x: '0.4', '2.2e-8', '600.0'; 'nan', 'inf' or '-inf' if x is not finite
   pure function real_buffer(x) result(text)
      real(dp), intent(in) :: x
      character(len=longest_number) :: text
      character(len=longest_number) :: buffer
      character(len=17) :: digits
      real(dp) :: back
      real(dp), parameter :: nearly_huge = 1.797693134862e308_dp
      integer :: n, first, exponent, mark, last, stat

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
      ! if 15 digits read back, they are the shortest text once trailing zeros are removed; except for subnormal numbers, and the
      ! largest numbers would overflow if rounded up
      first = merge(15, 1, abs(x) >= tiny(x))
      if (abs(x) > nearly_huge) first = 17
      do n = first, 17
         write (buffer, forms(n)) abs(x)
         read (buffer, *, iostat=stat) back
         if (stat == 0 .and. .not. abs(back - abs(x)) > 0.0_dp) exit
      end do
      buffer = adjustl(buffer)
      mark = scan(buffer, "E")
      read (buffer(mark + 1:), *) exponent
      digits = buffer(1:1)//buffer(3:mark - 1)
      last = max(1, verify(trim(digits), "0", back=.true.))
      text = place_point(digits(:last), exponent)
      if (x < 0.0_dp) text = "-"//trim(text)
   end function real_buffer

   !> A number by an edit descriptor, see `fixed` of ehl_text
   pure function fixed_buffer(x, form) result(text)
      real(dp), intent(in) :: x
      character(len=*), intent(in) :: form
      character(len=longest_number) :: text

      real(dp) :: shown, allowed
      integer :: stat

      write (text, "("//form//")") x
      if (text(1:1) == "*") write (text, "(es12.5)") x
      text = adjustl(text)
      read (text, *, iostat=stat) shown
      ! a descriptor with three or more decimals must show three significant digits, others two
      allowed = merge(0.005_dp, 0.05_dp, form(1:1) == "f" .and. scan(form, "3456789", back=.true.) == len(form))
      if (stat == 0 .and. abs(shown - x) > allowed*abs(x)) then
         if (abs(x) < 1.0e-3_dp) then
            write (text, "(es10.2)") x
            text = adjustl(text)
         else
            text = rounded_buffer(x, 3)
         end if
      end if
   end function fixed_buffer

   !> A number to n significant digits, or to a whole number if that has more
   pure function rounded_buffer(x, n) result(text)
      real(dp), intent(in) :: x
      integer, intent(in) :: n
      character(len=longest_number) :: text
      character(len=8) :: form
      integer :: decimals, last

      decimals = n
      ! 9.996 is '10.0'
      if (abs(x) > 0.0_dp) decimals = max(0, n - 1 - floor(log10(abs(x)*(1.0_dp + 0.5_dp*10.0_dp**(-n)))))
      write (form, "(a, i0)") "f32.", decimals
      write (text, "("//trim(form)//")") x
      text = adjustl(text)
      last = len_trim(text)
      if (text(last:last) == ".") text(last:last) = " "
   end function rounded_buffer

   !> Text of d.ddd * 10**exponent, without an exponent if that is short
   pure function place_point(digits, exponent) result(text)
      character(len=*), intent(in) :: digits
      integer, intent(in) :: exponent
      character(len=longest_number) :: text
      integer :: n

      n = len(digits)
      if (exponent >= 0 .and. exponent < 7) then
         if (n <= exponent + 1) then
            text = digits//repeat("0", exponent + 1 - n)//".0"
         else
            text = digits(:exponent + 1)//"."//digits(exponent + 2:)
         end if
      else if (exponent < 0 .and. exponent >= -4) then
         text = "0."//repeat("0", -exponent - 1)//digits
      else if (n > 1) then
         text = digits(1:1)//"."//digits(2:)//"e"//trim(integer_buffer(int(exponent, int64)))
      else
         text = digits//"e"//trim(integer_buffer(int(exponent, int64)))
      end if
   end function place_point

   !> An integer
   pure function integer_buffer(i) result(text)
      integer(int64), intent(in) :: i
      character(len=longest_number) :: text
      write (text, "(i0)") i
   end function integer_buffer

   !> Bytes as text with a unit
   pure function amount_buffer(bytes) result(text)
      real(dp), intent(in) :: bytes
      character(len=40) :: text

      if (bytes < 1.0e9_dp) then
         text = trim(integer_buffer(ceiling(bytes/1.0e6_dp, int64)))//" MB"
      else
         text = trim(fixed_buffer(bytes/1.0e9_dp, "f16.1"))//" GB"
      end if
   end function amount_buffer
end module ehl_number_text

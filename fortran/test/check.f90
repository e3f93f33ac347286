! SPDX-License-Identifier: BSD-3-Clause
!> Checks for the unit tests: failed checks are printed and counted
module check
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use, intrinsic :: iso_fortran_env, only: error_unit
   use ehl_kinds, only: dp
   implicit none (type, external)
   private
   public :: is_true, is_close, is_equal, is_text, has_text, n_checks, n_failures

   !> Number of checks, and of failed checks
   integer, protected :: n_checks = 0, n_failures = 0

contains

   !> Check that the condition holds
   subroutine is_true(condition, what)
      logical, intent(in) :: condition
      character(len=*), intent(in) :: what

      n_checks = n_checks + 1
      if (condition) return
      n_failures = n_failures + 1
      write (error_unit, "(2a)") "FAILED: ", what
   end subroutine is_true

   !> Check that |value - expected| <= tolerance; NaN is never close
   subroutine is_close(value, expected, tolerance, what)
      real(dp), intent(in) :: value, expected, tolerance
      character(len=*), intent(in) :: what
      character(len=100) :: numbers
      logical :: close_enough

      close_enough = .not. ieee_is_nan(value)
      if (close_enough) close_enough = abs(value - expected) <= tolerance
      write (numbers, "(3(a, es24.16))") " is", value, " expected", expected, " within", tolerance
      call is_true(close_enough, what // trim(numbers))
   end subroutine is_close

   !> Check that two integers are equal
   subroutine is_equal(value, expected, what)
      integer, intent(in) :: value, expected
      character(len=*), intent(in) :: what
      character(len=60) :: numbers

      write (numbers, "(2(a, i0))") " is ", value, " expected ", expected
      call is_true(value == expected, what // trim(numbers))
   end subroutine is_equal

   !> Check that two texts are equal
   subroutine is_text(value, expected, what)
      character(len=*), intent(in) :: value, expected, what

      call is_true(value == expected .and. len(value) == len(expected), &
                   what // " is '" // value // "' expected '" // expected // "'")
   end subroutine is_text

   !> Check that a text contains another one
   subroutine has_text(value, part, what)
      character(len=*), intent(in) :: value, part, what

      call is_true(index(value, part) > 0, what // ": no '" // part // "' in '" // value // "'")
   end subroutine has_text
end module check

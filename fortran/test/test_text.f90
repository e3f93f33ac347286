! SPDX-License-Identifier: BSD-3-Clause
!> Numbers as text, nearest words
module test_text
   use, intrinsic :: iso_fortran_env, only: int64
   use check, only: is_equal, is_text, is_true
   use ehl_kinds, only: dp
   use ehl_text, only: fixed, lower_case, nearest_word, percent, quoted, rounded, short, to_text
   implicit none (type, external)
   private
   public :: run_text

contains

   subroutine run_text()
      call is_text(to_text(600.0_dp), "600.0", "whole number")
      call is_text(to_text(2.2e-8_dp), "2.2e-8", "small number")
      call is_text(to_text(-9.734e-3_dp), "-0.009734", "negative number")
      call is_text(to_text(2.26e11_dp), "2.26e11", "large number")
      call is_text(to_text(0.0_dp), "0.0", "zero")
      call is_text(to_text(1234567.0_dp), "1234567.0", "seven digits")
      call is_text(to_text(0.1_dp + 0.2_dp), "0.30000000000000004", "17 digits")
      call is_text(to_text(5.0e-324_dp), "5e-324", "smallest number")
      call is_text(to_text(1.2e-310_dp), "1.2e-310", "a subnormal number")
      call is_text(to_text(-huge(1.0_dp)), "-1.7976931348623157e308", "largest number")
      call is_text(to_text(-12)//to_text(12345678901_int64)//".", "-1212345678901.", "integers")
      call is_text(to_text(.true.)//to_text(.false.), ".true..false.", "logical values")
      call is_text(fixed(-0.5_dp, "f8.3")//short(2.0_dp/3.0_dp), "-0.5006.667E-01", "by edit descriptors")
      call is_text(fixed(2.6435e-6_dp, "f10.4")//" "//fixed(0.0123_dp, "f8.1")//" "//fixed(0.2_dp, "f4.1")// &
                   " "//fixed(3.157e-4_dp, "f10.4")//" "// &
                   fixed(0.0_dp, "f4.1"), "2.64E-06 0.0123 0.2 3.16E-04 0.0", "small numbers")
      call is_text(fixed(1.0e10_dp, "f4.1"), "1.00000E+10", "by a descriptor that is too narrow")
      call is_text(rounded(9.996_dp)//" "//rounded(123456.0_dp)//" "//rounded(0.012346_dp, 4), "10.0 123456 0.01235", "rounded")
      call is_text(percent(0.0123456_dp), "1.2 %", "per cent")
      call is_text(quoted("it's"), "'it''s'", "quoted text")
      call is_text(lower_case("Moes_M"), "moes_m", "lower case")
      call round_trips()
      call is_text(nearest_word("pionts", [character(len=8) :: "x_inlet", "points"]), "points", "swap")
      call is_text(nearest_word("visc", [character(len=9) :: "density", "viscosity"]), "viscosity", &
                   "beginning of a word")
      call is_text(nearest_word("zzzzzz", [character(len=8) :: "x_inlet", "points"]), "", "nothing near")
   end subroutine run_text

   !> Every number reads back as the same number
   subroutine round_trips()
      integer, parameter :: samples = 2000
      character(len=:), allocatable :: text
      real(dp) :: x, back, u(2)
      integer :: k, stat, wrong

      wrong = 0
      do k = 1, samples
         call random_number(u)
         x = (u(1) - 0.5_dp)*10.0_dp**int(600.0_dp*u(2) - 300.0_dp)
         text = to_text(x)
         read (text, *, iostat=stat) back
         if (stat /= 0 .or. abs(back - x) > 0.0_dp) wrong = wrong + 1
      end do
      call is_equal(wrong, 0, "numbers that do not read back as the same number")
      call is_true(to_text(tiny(1.0_dp)) /= "0.0", "the smallest normal number is not zero")
   end subroutine round_trips
end module test_text

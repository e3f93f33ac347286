! SPDX-License-Identifier: BSD-3-Clause
!> Numbers as text, nearest words
module test_text
   use check, only: is_equal, is_text, is_true
   use ehl_kinds, only: dp
   use ehl_text, only: lower_case, nearest_word, quoted, to_text
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
      call is_text(to_text(.true.), ".true.", "truth value")
      call is_text(quoted("it's"), "'it''s'", "quoted text")
      call is_text(lower_case("Moes_M"), "moes_m", "lower case")
      call round_trips()
      call is_text(nearest_word("pionts", [character(len=8) :: "x_inlet", "points"]), "points", "swap")
      call is_text(nearest_word("visc", [character(len=9) :: "density", "viscosity"]), "viscosity", &
                   "beginning of a word")
      call is_text(nearest_word("zzzzzz", [character(len=8) :: "x_inlet", "points"]), "", "nothing near")
   end subroutine run_text

   !> Every number reads back as itself
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
      call is_equal(wrong, 0, "numbers that do not read back as themselves")
      call is_true(to_text(tiny(1.0_dp)) /= "0.0", "the smallest number is not zero")
   end subroutine round_trips
end module test_text

! SPDX-License-Identifier: BSD-3-Clause
!> The error of the friction ratio and its parts, the last lines of a run, and locks that fail
module test_report
   use check, only: has_text, is_close, is_equal, is_text, is_true
   use ehl_conclusion, only: conclusion
   use ehl_kinds, only: dp
   use ehl_lock, only: lock, lock_t, unlock
   use ehl_ratio_error, only: ratio_error_t
   use ehl_record, only: record_t
   use ehl_status, only: ehl_internal, status_t
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_quiet_nan, ieee_value
   implicit none (type, external)
   private
   public :: run_report

   !> Open, and no mutex at all
   type(lock_t), target :: good, none

contains

   subroutine run_report()
      call values_read_back()
      call parts_and_sum()
      call last_lines()
      call lock_fails()
   end subroutine run_report

   subroutine values_read_back()
      type(record_t) :: record

      call record%set("a", 0.1_dp)
      call record%set("b", ieee_value(1.0_dp, ieee_quiet_nan))
      call record%set("c", 'a "word" \')
      call is_close(record%number("a"), 0.1_dp, 0.0_dp, "number of a record")
      call is_true(.not. ieee_is_finite(record%number("b")), "null of a record")
      call is_true(.not. ieee_is_finite(record%number("d")), "number that is not there")
      call is_text(record%text("c"), 'a "word" \', "text of a record")
      call is_text(record%text("d"), "", "text that is not there")
      call is_true(record%has("b") .and. .not. record%has("d"), "names of a record")
   end subroutine values_read_back

   !> Parts count without their sign; one that is not known makes the sum unknown, each reason is told once
   subroutine parts_and_sum()
      type(record_t) :: record
      type(ratio_error_t) :: known, unknown
      real(dp) :: nothing

      nothing = ieee_value(nothing, ieee_quiet_nan)
      call known%add(record, "one", 0.25_dp, "")
      call known%add(record, "two", -0.5_dp, "")
      call known%report(record)
      call is_close(record%number("two"), 0.5_dp, 0.0_dp, "part")
      call is_close(record%number("mu_ratio_error"), 0.75_dp, 0.0_dp, "sum of the parts")
      call is_text(record%text("mu_ratio_error_note"), "", "note of a known error")
      call unknown%add(record, "one", nothing, "first")
      call unknown%add(record, "two", nothing, "second")
      call unknown%add(record, "three", nothing, "first")
      call unknown%report(record)
      call is_true(.not. ieee_is_finite(record%number("mu_ratio_error")), "sum with an unknown part")
      call is_text(record%text("mu_ratio_error_note"), "first; second", "note of an unknown error")
   end subroutine parts_and_sum

   subroutine last_lines()
      type(record_t) :: record
      character(len=:), allocatable :: text
      character(len=*), parameter :: lf = new_line("a")

      call record%set("status", "cycle limit")
      call record%set("H_c", ieee_value(1.0_dp, ieee_quiet_nan))
      call is_text(conclusion(record), "H_c        none: the run ended with the status 'cycle limit'", "no solution")
      call record%set("status", "converged")
      call record%set("H_c", 0.024369_dp)
      call record%set("H_c_error", 0.000266_dp)
      call record%set("H_min", 0.008315_dp)
      call record%set("H_min_error", ieee_value(1.0_dp, ieee_quiet_nan))
      call is_text(conclusion(record), "H_c        0.02437 +- 0.00027"//lf//"H_min      0.008315, error not known", &
                   "smooth contact without a size")
      call record%set("film_scale_m", 9.5863e-6_dp)
      call record%set("H_c_error", 0.0266_dp)
      call record%set("mu_ratio", 1.1849_dp)
      call record%set("mu_ratio_error", 0.0484_dp)
      call record%set("lambda_ratio", 1.59_dp)
      call record%set("lambda_ratio_central", 4.67_dp)
      text = conclusion(record)
      call has_text(text, "H_c        0.024 +- 0.027, h_c 234 +- 255 nm"//lf, "central film in nm")
      call has_text(text, lf//"mu_r/mu_s  1.185 +- 0.048"//lf, "friction ratio")
      call has_text(text, "h_min/sigma 1.590, h_c/sigma 4.670", "film over roughness")
      call record%set("mu_ratio_error", ieee_value(1.0_dp, ieee_quiet_nan))
      call record%set("mu_ratio_error_note", "no coarser run")
      call has_text(conclusion(record), "mu_r/mu_s  1.18490, error not known: no coarser run", "unknown error")
   end subroutine last_lines

   !> What the system says is told, and the lock is not held then
   subroutine lock_fails()
      type(status_t) :: fine, bad

      call lock(good, fine)
      call unlock(good, fine)
      call lock(good, fine)
      call unlock(good, fine)
      call is_true(.not. fine%failed(), "lock and unlock")
      none%mutex = -1
      call lock(none, bad)
      call is_equal(bad%code, ehl_internal, "lock that is no mutex")
      ! after a failure it is not taken: were it, this would wait for ever
      call lock(good, bad)
      call lock(good, fine)
      call unlock(good, fine)
      call is_true(.not. fine%failed(), "lock after a failure")
   end subroutine lock_fails
end module test_report

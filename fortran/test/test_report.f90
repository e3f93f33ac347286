! SPDX-License-Identifier: BSD-3-Clause
!> The error of the friction ratio and its parts, the last lines of a run, and locks that fail
module test_report
   use check, only: has_text, is_close, is_equal, is_text, is_true
   use ehl_conclusion, only: conclusion
   use ehl_assessment, only: holds, judge, no_result, with_care
   use ehl_kinds, only: dp, not_known
   use ehl_lock, only: lock, lock_t, unlock
   use ehl_ratio_error, only: ratio_error_t
   use ehl_record, only: record_t
   use ehl_status, only: ehl_internal, status_t
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   implicit none (type, external)
   private
   public :: run_report

   !> Open, and no mutex at all
   type(lock_t), target :: good, none

contains

   subroutine run_report()
      call parts_and_sum()
      call last_lines()
      call assessments()
      call lock_fails()
   end subroutine run_report

   !> Parts count without their sign; one that is not known makes the sum unknown, each reason is told once
   subroutine parts_and_sum()
      type(record_t) :: record
      type(ratio_error_t) :: known, unknown

      call known%add(record, "one", 0.25_dp, "")
      call known%add(record, "two", -0.5_dp, "")
      call known%report(record)
      call is_close(record%number("two"), 0.5_dp, 0.0_dp, "part")
      call is_close(record%number("mu_ratio_error"), 0.75_dp, 0.0_dp, "sum of the parts")
      call is_text(record%text("mu_ratio_error_note"), "", "note of a known error")
      call unknown%add(record, "one", not_known, "first")
      call unknown%add(record, "two", not_known, "second")
      call unknown%add(record, "three", not_known, "first")
      call unknown%report(record)
      call is_true(.not. ieee_is_finite(record%number("mu_ratio_error")), "sum with an unknown part")
      call is_text(record%text("mu_ratio_error_note"), "first; second", "note of an unknown error")
   end subroutine parts_and_sum

   subroutine last_lines()
      type(record_t) :: record
      character(len=:), allocatable :: text
      character(len=*), parameter :: lf = new_line("a")

      call record%set("status", "cycle limit")
      call record%set("H_c", not_known)
      call is_text(conclusion(record), "assessment no result: the status is 'cycle limit'", "no solution")
      call record%set("message", "too coarse")
      call is_text(conclusion(record), "assessment no result: the status is 'cycle limit': too coarse", "why there is none")
      call record%set("status", "converged")
      call record%set("H_c", 0.024369_dp)
      call record%set("H_c_error", 0.000266_dp)
      call record%set("H_min", 0.008315_dp)
      call record%set("H_min_error", not_known)
      call is_text(conclusion(record), "H_c        0.02437 +- 0.00027 (grid)"//lf//"H_min      0.008315, error not known"//lf// &
                   "assessment full film: smooth surfaces; the case gives no size in metres; but the error of H_min is not "// &
                   "known", "smooth contact without a size")
      call record%set("H_c_error", 0.0266_dp)
      call record%set("h_c_m", 233.6e-9_dp)
      call record%set("h_c_error_m", 255.0e-9_dp)
      call record%set("P_max", 1.0049_dp)
      call record%set("p_max_Pa", 1.0215e9_dp)
      call record%set("p_max_rough_Pa", 1.0684e9_dp)
      call record%set("mu_ratio", 1.1849_dp)
      call record%set("mu_ratio_error", 0.0484_dp)
      call record%set("lambda_ratio", 1.59_dp)
      call record%set("lambda_ratio_central", 4.67_dp)
      call record%set("mu", 0.04_dp)
      call record%set("mu_smooth", 0.0338_dp)
      call record%set("shear_law", "eyring")
      text = conclusion(record)
      call has_text(text, "H_c        0.024 +- 0.027, h_c 234 +- 255 nm (grid)"//lf, "central film in nm")
      call has_text(text, lf//"p_max      1.0049 p_h, error not known, 1.0215 GPa; rough 1.0684 GPa"//lf, "pressures")
      call has_text(text, lf//"mu_r/mu_s  1.185 +- 0.048 (grid)"//lf, "friction ratio")
      call has_text(text, "Lambda     1.590 (h_c/sigma 4.670), smooth films", "film over roughness")
      call has_text(text, lf//"mu         0.04000, smooth contact 0.03380; law 'eyring'"//lf, "friction with its law")
      call record%set("mu_ratio_error", not_known)
      call record%set("mu_ratio_error_note", "no coarser run")
      call has_text(conclusion(record), "mu_r/mu_s  1.18490, error not known: no coarser run", "unknown error")
      ! as a prediction has them
      call record%set("P_max", not_known)
      call record%set("p_rise_max_Pa", 8.53e7_dp)
      call has_text(conclusion(record), lf//"p_max      1.0215 GPa; rough 1.0684 GPa, up to 0.0853 GPa above the smooth "// &
                    "contact, error not known"//lf, "pressures of a prediction")
      call record%set("p_max_rough_Pa", not_known)
      call record%set("p_rise_max_error_Pa", 1.2e7_dp)
      call has_text(conclusion(record), lf//"p_max      1.0215 GPa; rough 0.085 +- 0.012 GPa above the smooth "// &
                    "contact (model)"//lf, &
                    "its rise alone")
   end subroutine last_lines

   !> Each thing that a result may be short of has its word, and the worst comes first
   subroutine assessments()
      type(record_t) :: good, record
      character(len=:), allocatable :: text
      integer :: worth

      call record%set("status", "converged")
      call record%set("H_c", 0.02_dp)
      call record%set("H_c_error", 1.0e-4_dp)
      call record%set("h_min_m", 3.0e-8_dp)
      ! as Python hands a summary over
      call good%take_json(record%to_json())
      call judge(good, text, worth)
      call is_text(text, "full film: the minimum film is 30.0 nm: Lambda = 3 with an rms roughness of 10.0 nm", "full film")
      call is_equal(worth, holds, "worth of a full film")

      record = good
      call record%set("H_c_error", 0.002_dp)
      call is_judged(record, "full film: the minimum film is 30.0 nm: Lambda = 3 with an rms roughness of 10.0 nm; but "// &
                     "H_c is known to 10 % only", with_care)
      record = good
      call record%set("flash_temperature_K", 40.0_dp)
      call is_judged(record, "but the surfaces warm by 40.0 K", with_care)
      ! the friction has the heat in it then
      call record%set("temperature_rise_max_K", 60.0_dp)
      call judge(record, text, worth)
      call is_equal(worth, holds, "heat that counts")

      record = good
      call record%set("status", "target missed")
      call is_judged(record, "full film: the minimum film is 30.0 nm: Lambda = 3 with an rms roughness of 10.0 nm; but "// &
                     "grid.target_error is missed", with_care)
      record = good
      call record%set("lambda_ratio", 0.8_dp)
      call is_judged(record, "thin film: Lambda = 0.800 is below 1", with_care)
      call record%set("h_min_rough_m", 3.4e-9_dp)
      call is_judged(record, "thin film: the minimum film over the roughness is 3.40 nm, below 10 nm", with_care)
      call record%set("p_max_Pa", 1.0e9_dp)
      call record%set("p_max_rough_Pa", 4.5e9_dp)
      call is_judged(record, "beyond the solids: the pressure reaches 4.50 GPa", with_care)

      record = good
      call record%set("mu_ratio", 1.2_dp)
      call record%set("mu_ratio_error", 0.01_dp)
      call record%set("mu_ratio_unresolved", -0.12_dp)
      call is_judged(record, "unresolved waves: they hold 10 % of mu_r/mu_s by prediction", with_care)
      call record%set("mu_ratio_unresolved", not_known)
      call record%set("variance_unresolved", 0.3_dp)
      call is_judged(record, "unresolved waves: they hold 30 % of the variance", with_care)

      call record%set("status", "film breakdown")
      call record%set("message", "5 nm below zero")
      call is_judged(record, "film breakdown: 5 nm below zero", no_result)
      ! of a run: the roughness, on a smooth contact that is solved; else the smooth contact itself
      call record%set("status", "negative film")
      call is_judged(record, "film breakdown: 5 nm below zero", no_result)
      call record%set("H_c", not_known)
      call is_judged(record, "no result: the status is 'negative film': 5 nm below zero", no_result)

      record = good
      call record%set("pressure_viscosity_note", "alpha = 1 is an estimate")
      call is_judged(record, "but alpha is an estimate (-17 to +12 % of the film)", with_care)
      call record%set("pressure_viscosity_note", "alpha = 1 is the default")
      call is_judged(record, "but alpha is that of another oil", with_care)

   contains

      subroutine is_judged(record, words, expected)
         type(record_t), intent(in) :: record
         character(len=*), intent(in) :: words
         integer, intent(in) :: expected

         call judge(record, text, worth)
         call has_text(text, words, words)
         call is_equal(worth, expected, "worth: "//words)
      end subroutine is_judged
   end subroutine assessments

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

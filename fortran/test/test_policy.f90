! SPDX-License-Identifier: BSD-3-Clause
!> The sequence of cycles in a time step
module test_policy
   use check, only: is_equal, is_true
   use ehl_cycle, only: coarsening_alcouffe, cycle_options_t
   use ehl_kinds, only: dp
   use ehl_step_policy, only: attempt_limited, attempt_damped, attempt_last, attempt_predicted, step_restarts, step_ends, &
                              step_continues, step_policy_t
   implicit none (type, external)
   private
   public :: run_policy

contains

   subroutine run_policy()
      call attempts_in_order()
      call cheap_first_cycle()
   end subroutine run_policy

   !> A step that does not converge is attempted from the predicted pressure, from the last one, with limited changes, and
   !> damped; a slow cycle changes the coarsening permanently if that is allowed
   subroutine attempts_in_order()
      type(step_policy_t) :: policy
      type(cycle_options_t) :: options
      integer :: attempts(300), next, k

      call policy%set(options, .false., 30)
      call policy%begin(1.0e-4_dp, .false.)
      call policy%begin_attempt(1.0_dp)
      do k = 1, 300
         attempts(k) = policy%attempt
         call policy%after_cycle(1, .false., 1.0e-4_dp, 1.0e-4_dp, next)
         if (any(k == [5, 14, 23])) call is_equal(next, step_restarts, "the residual does not fall")
         if (k < 300 .and. all(k /= [5, 14, 23])) call is_equal(next, step_continues, "one more cycle")
         if (next == step_restarts) call policy%begin_attempt(1.0_dp)
      end do
      call is_equal(next, step_ends, "no more cycles")
      call is_true(all(attempts(:5) == attempt_predicted) .and. all(attempts(6:14) == attempt_last) .and. &
                   all(attempts(15:23) == attempt_limited) .and. all(attempts(24:) == attempt_damped), "attempts in their order")
      call policy%begin(1.0e-4_dp, .false.)
      call policy%begin_attempt(1.0_dp)
      call is_equal(policy%attempt, attempt_predicted, "the next step starts from the predicted pressure")
      call policy%after_cycle(2, .true., 1.0e-3_dp, 1.0e-5_dp, next)
      call is_equal(next, step_ends, "tolerances are met")
      call is_equal(policy%changed_at, 0, "no change of the coarsening")

      call policy%set(options, .true., 30)
      call policy%begin(1.0e-4_dp, .false.)
      call policy%begin_attempt(1.0_dp)
      call policy%after_cycle(3, .false., 1.0_dp, 0.5_dp, next)
      call is_equal(next, step_restarts, "a slow cycle")
      call is_equal(policy%changed_at, 3, "changes the coarsening")
      call policy%begin_attempt(1.0_dp)
      call is_equal(policy%options%coarsening, coarsening_alcouffe, "to Alcouffe's")
      call policy%after_cycle(3, .false., 1.0_dp, 0.5_dp, next)
      call is_equal(next, step_continues, "another slow cycle")
      call is_equal(policy%options%pre, options%pre + 1, "is followed by one more sweep")
      call policy%set(options, .true., 30)
      call is_equal(policy%changed_at, 0, "a new run has not changed it")
   end subroutine attempts_in_order

   !> A good prediction needs no sweep before the coarse grids; if that did not suffice, the next cycles have these sweeps
   !> and do not count as slow. A step that measures makes a second cycle even if the first one meets the tolerance.
   subroutine cheap_first_cycle()
      type(step_policy_t) :: policy
      type(cycle_options_t) :: options
      integer :: next

      call policy%set(options, .true., 30)
      call policy%begin(1.0e-4_dp, .false.)
      call policy%begin_attempt(3.0e-4_dp)
      call is_equal(policy%options%pre, 0, "no sweep before the coarse grids")
      call is_equal(policy%options%post, options%pre + options%post, "as many sweeps as in the usual cycle")
      call policy%after_cycle(1, .false., 3.0e-4_dp, 2.9e-4_dp, next)
      call is_equal(next, step_continues, "it did not suffice")
      call is_equal(policy%options%pre, options%pre, "the usual cycle follows")
      call is_equal(policy%options%post, options%post, "with its sweeps after the coarse grids")
      call is_equal(policy%changed_at, 0, "the coarsening does not change")
      call policy%begin(1.0e-4_dp, .false.)
      call policy%begin_attempt(1.0e-2_dp)
      call is_equal(policy%options%pre, options%pre, "a prediction that is far off")

      call policy%begin(1.0e-4_dp, .true.)
      call policy%begin_attempt(3.0e-4_dp)
      call policy%after_cycle(2, .true., 3.0e-4_dp, 0.5e-4_dp, next)
      call is_equal(next, step_continues, "one more cycle to measure")
      call policy%after_cycle(2, .true., 0.5e-4_dp, 0.1e-4_dp, next)
      call is_equal(next, step_ends, "and no more")
   end subroutine cheap_first_cycle
end module test_policy

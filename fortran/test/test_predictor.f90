! SPDX-License-Identifier: BSD-3-Clause
!> The predictor of a time step
module test_predictor
   use check, only: is_close, is_true
   use ehl_flow_factory, only: new_flow
   use ehl_grid, only: new_grid
   use ehl_kinds, only: dp
   use ehl_level, only: level_t
   use ehl_predictor, only: predictor_t
   use ehl_status, only: status_t
   implicit none (type, external)
   private
   public :: run_predictor

contains

   subroutine run_predictor()
      call predictor_of_stationary_and_moving_patterns()
   end subroutine run_predictor

   !> Without Poiseuille flow a moving pattern is convected and a stationary one extrapolated in time, to second order
   subroutine predictor_of_stationary_and_moving_patterns()
      type(predictor_t) :: predictor
      type(level_t) :: level
      type(status_t) :: status
      real(dp), parameter :: ripple = 0.005_dp
      real(dp) :: p(33, 33, -1:3)
      integer :: i, k
      logical :: moves

      level%grid = new_grid(33, 33, -2.0_dp, 2.0_dp, 1.0_dp, .false.)
      call level%poiseuille%setup(level%grid)
      allocate (level%p(33, 33), source=0.0_dp)
      call new_flow(level%lubricant, 1.0_dp, level%flow)
      call level%flow%setup(level%grid, status)
      do k = 1, 2
         moves = k == 1
         do i = 1, 33
            if (moves) then
               p(i, :, :) = spread(1.0_dp + 0.1_dp*sin(0.7_dp*real(i - [-1, 0, 1, 2, 3], dp)), 1, 33)
            else
               p(i, :, :) = spread(1.0_dp + 0.1_dp*sin(0.7_dp*i)*real([1, 0, 1, 4, 9], dp), 1, 33)
            end if
         end do
         call predictor%setup(33, 33, [1.0_dp], status)
         level%p = p(:, :, 2)
         call predictor%learn(p(:, :, 1:-1:-1), level)
         call predictor%predict(p(:, :, 2:0:-1), level)
         call is_close(maxval(abs(level%p(6:31, :) - p(6:31, :, 3))), 0.0_dp, 1.0e-12_dp, &
                       merge("moving pattern    ", "stationary pattern", moves))
      end do
      ! with Poiseuille flow a smooth error of 0.04 counts less than a ripple of 0.005, without it more
      do i = 1, 33
         p(i, :, 1) = 1.0_dp - 0.02_dp*i + 0.25_dp*ripple*(-1)**i
         p(i, :, 0) = 1.0_dp
         p(i, :, -1) = 1.0_dp
         level%p(i, :) = p(i, :, 1) + 2.0_dp*(-0.02_dp*(i - 1) - 0.25_dp*ripple*(-1)**i) + ripple*(-1)**i
      end do
      call predictor%learn(p(:, :, 1:-1:-1), level)
      call is_true(minval(predictor%weights(6:29, :, 1)) > 0.95_dp, "without Poiseuille flow convection is predicted")
      level%flow%eps = 1.0_dp
      call predictor%learn(p(:, :, 1:-1:-1), level)
      call is_true(maxval(predictor%weights(6:29, :, 1)) < 0.05_dp, "with Poiseuille flow the ripple is an error")
      call is_true(.not. status%failed(), "predictor")
   end subroutine predictor_of_stationary_and_moving_patterns
end module test_predictor

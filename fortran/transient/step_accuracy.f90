! SPDX-License-Identifier: BSD-3-Clause
!> Tolerance of the time steps: their algebraic error changes mu_r/mu_s by less than a fraction of its grid error
!> (docs/theory/time-steps.md).
!> Both errors are estimated during the run from the Newtonian friction, which is most sensitive to the pressure, also with a
!> shear-thinning law. Steps of more than one cycle show the change of mu_r/mu_s due to the residual after the first cycle. The grid
!> error of mu_r/mu_s is assumed to be at least a fraction of its increase above 1, times the relative grid error of the smooth
!> friction.
module ehl_step_accuracy
   use ehl_kinds, only: dp
   implicit none (type, external)
   private
   public :: step_accuracy_t, step_tolerance, max_tolerance_ratio

   !> Minimum grid error of mu_r/mu_s over |mu_r/mu_s - 1| times the relative error of the smooth friction
   real(dp), parameter :: min_error_fraction = 0.25_dp
   !> Minimum increase assumed in steps that belong to no mean
   real(dp), parameter :: min_increase = 0.3_dp
   !> Time constant of the rms of the increase [steps]
   real(dp), parameter :: averaging_steps = 64.0_dp
   !> Interval of steps with an additional cycle that measures the sensitivity
   integer, parameter :: measured_steps = 30
   !> Decay of the maximum sensitivity with each measurement
   real(dp), parameter :: decay = 0.9_dp
   !> Maximum tolerance over `strict`
   real(dp), parameter :: max_tolerance_ratio = 40.0_dp

   type :: step_accuracy_t
      !> Rms residual that is small enough for every case
      real(dp) :: strict = 0.0_dp
      !> Newtonian friction of the smooth contact on the same grid
      real(dp) :: friction_smooth = 1.0_dp
      !> Allowed error of mu_r/mu_s over its increase; 0: not known
      real(dp) :: allowed = 0.0_dp
      !> Mean square of mu_r/mu_s - 1, with Newtonian friction
      real(dp) :: mean_square = 0.0_dp
      !> Change of mu_r/mu_s per residual; 0: not known
      real(dp) :: sensitivity = 0.0_dp
      !> Maximum tolerance so far
      real(dp) :: largest = 0.0_dp
   contains
      procedure :: set
      procedure :: tolerance
      procedure :: measures
      procedure :: learn
      procedure :: follow
   end type step_accuracy_t

contains

   !> Rms residual at which the algebraic error of mu_r/mu_s is below the fraction `accuracy` of the discretisation error in all
   !> cases: 8e-5 at h = 1/128 and a tenth, proportional to both
   pure real(dp) function step_tolerance(mesh, accuracy)
      real(dp), intent(in) :: mesh, accuracy
      step_tolerance = 8.0e-4_dp*accuracy*(128.0_dp*mesh)
   end function step_tolerance

   !> Set up for a run
   pure subroutine set(self, mesh, accuracy, friction_smooth, friction_error)
      class(step_accuracy_t), intent(inout) :: self
      !> Mesh size; allowed algebraic error over the grid error
      real(dp), intent(in) :: mesh, accuracy
      !> Newtonian friction of the smooth contact, and its relative grid error (0: not known)
      real(dp), intent(in) :: friction_smooth, friction_error

      self%strict = step_tolerance(mesh, accuracy)
      self%friction_smooth = friction_smooth
      self%allowed = accuracy*min_error_fraction*friction_error
      self%mean_square = 0.0_dp
      self%sensitivity = 0.0_dp
      self%largest = self%strict
   end subroutine set

   !> Tolerance of the rms residual of a step
   real(dp) function tolerance(self, in_mean)
      class(step_accuracy_t), intent(inout) :: self
      !> Whether the step belongs to the mean of mu_r/mu_s
      logical, intent(in) :: in_mean
      real(dp) :: increase

      tolerance = self%strict
      if (.not. self%sensitivity > 0.0_dp) return
      increase = sqrt(self%mean_square)
      if (.not. in_mean) increase = max(increase, min_increase)
      tolerance = min(max(self%strict, self%allowed*increase/self%sensitivity), max_tolerance_ratio*self%strict)
      self%largest = max(self%largest, tolerance)
   end function tolerance

   !> Whether the step makes an additional cycle that measures the sensitivity
   pure logical function measures(self, step)
      class(step_accuracy_t), intent(in) :: self
      integer, intent(in) :: step
      measures = self%sensitivity > 0.0_dp .and. mod(step, measured_steps) == 0
   end function measures

   !> Update the sensitivity from Newtonian friction and residual after the first cycle and at the end of a step
   pure subroutine learn(self, friction_first, residual_first, friction, residual)
      class(step_accuracy_t), intent(inout) :: self
      real(dp), intent(in) :: friction_first, residual_first, friction, residual
      real(dp) :: change

      if (.not. residual_first > residual) return
      change = abs(friction_first - friction)/self%friction_smooth
      self%sensitivity = max(change/(residual_first - residual), decay*self%sensitivity)
   end subroutine learn

   !> Update the increase from the Newtonian friction of a step
   pure subroutine follow(self, friction)
      class(step_accuracy_t), intent(inout) :: self
      real(dp), intent(in) :: friction

      self%mean_square = self%mean_square + ((friction/self%friction_smooth - 1.0_dp)**2 - self%mean_square)/averaging_steps
   end subroutine follow
end module ehl_step_accuracy

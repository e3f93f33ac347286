! SPDX-License-Identifier: BSD-3-Clause
!> Accuracy of the time steps: their algebraic error changes mu_r/mu_s by less than a share of its grid error. Both are
!> measured in the run, with the friction of a Newtonian lubricant whatever its shear law: that friction is the most
!> sensitive to the pressure. Where the flow thins, pressure and film are those of the law; the friction of the
!> law itself is not used: it may hardly differ from the smooth one where pressures still do. Steps that go on after their
!> first cycle show by how much mu_r/mu_s would have been wrong with the residual after it. The grid error of mu_r/mu_s is
!> taken to be at least a share of its rise over 1, that of the smooth friction on this grid being the measure; see
!> docs/design.md.
module ehl_step_accuracy
   use ehl_kinds, only: dp
   implicit none (type, external)
   private
   public :: step_accuracy_t, step_tolerance, loosest

   !> Least grid error of mu_r/mu_s, as a share of its distance from 1 and of the relative error of the smooth friction
   real(dp), parameter :: rise_share = 0.25_dp
   !> That distance at the least for steps that belong to no mean yet
   real(dp), parameter :: rise_before = 0.3_dp
   !> Steps over which that distance is taken (rms, fading)
   real(dp), parameter :: memory = 64.0_dp
   !> Interval of steps with an additional cycle, to measure
   integer, parameter :: measured_steps = 30
   !> Factor by which the weight of an earlier measurement decreases with every new one
   real(dp), parameter :: fading = 0.9_dp
   !> Largest tolerance, in strict ones
   real(dp), parameter :: loosest = 40.0_dp

   type :: step_accuracy_t
      !> Residual (rms) that is small enough for every case
      real(dp) :: strict = 0.0_dp
      !> Newtonian friction of the smooth contact on the same grid
      real(dp) :: friction_smooth = 1.0_dp
      !> Error of mu_r/mu_s allowed, as a share of its distance from 1; 0: it is not known
      real(dp) :: allowed = 0.0_dp
      !> Mean square of that distance
      real(dp) :: rise = 0.0_dp
      !> Change of mu_r/mu_s by a residual; 0: it is not known
      real(dp) :: sensitivity = 0.0_dp
      !> Largest tolerance so far
      real(dp) :: largest = 0.0_dp
   contains
      procedure :: set
      procedure :: tolerance
      procedure :: measures
      procedure :: learn
      procedure :: follow
   end type step_accuracy_t

contains

   !> Residual (rms) that leaves the algebraic error of mu_r/mu_s below a tenth of the discretisation error in all cases:
   !> 8e-5 on h = 1/128 and in proportion to h elsewhere; see docs/design.md
   pure real(dp) function step_tolerance(mesh, accuracy)
      real(dp), intent(in) :: mesh, accuracy
      step_tolerance = 8.0e-4_dp*accuracy*(128.0_dp*mesh)
   end function step_tolerance

   !> Set up for a run
   pure subroutine set(self, mesh, accuracy, friction_smooth, friction_error)
      class(step_accuracy_t), intent(inout) :: self
      !> Mesh size; allowed algebraic error as a share of the grid error
      real(dp), intent(in) :: mesh, accuracy
      !> Newtonian friction of the smooth contact, and its relative grid error; 0: that is not known
      real(dp), intent(in) :: friction_smooth, friction_error

      self%strict = step_tolerance(mesh, accuracy)
      self%friction_smooth = friction_smooth
      self%allowed = accuracy*rise_share*friction_error
      self%rise = 0.0_dp
      self%sensitivity = 0.0_dp
      self%largest = self%strict
   end subroutine set

   !> Largest residual (rms) of a step
   real(dp) function tolerance(self, in_mean)
      class(step_accuracy_t), intent(inout) :: self
      !> Whether the step counts in the mean of mu_r/mu_s
      logical, intent(in) :: in_mean
      real(dp) :: rise

      tolerance = self%strict
      if (.not. self%sensitivity > 0.0_dp) return
      rise = sqrt(self%rise)
      if (.not. in_mean) rise = max(rise, rise_before)
      tolerance = min(max(self%strict, self%allowed*rise/self%sensitivity), loosest*self%strict)
      self%largest = max(self%largest, tolerance)
   end function tolerance

   !> Whether the step makes a cycle more than it needs
   pure logical function measures(self, step)
      class(step_accuracy_t), intent(in) :: self
      integer, intent(in) :: step
      measures = self%sensitivity > 0.0_dp .and. mod(step, measured_steps) == 0
   end function measures

   !> A step that had more than one cycle: Newtonian friction and residual after the first one, and at its end
   pure subroutine learn(self, friction_first, residual_first, friction, residual)
      class(step_accuracy_t), intent(inout) :: self
      real(dp), intent(in) :: friction_first, residual_first, friction, residual
      real(dp) :: change

      if (.not. residual_first > residual) return
      change = abs(friction_first - friction)/self%friction_smooth
      self%sensitivity = max(change/(residual_first - residual), fading*self%sensitivity)
   end subroutine learn

   !> Newtonian friction of a step
   pure subroutine follow(self, friction)
      class(step_accuracy_t), intent(inout) :: self
      real(dp), intent(in) :: friction

      self%rise = self%rise + ((friction/self%friction_smooth - 1.0_dp)**2 - self%rise)/memory
   end subroutine follow
end module ehl_step_accuracy

! SPDX-License-Identifier: BSD-3-Clause
!> Length of the time steps under a duty (docs/theory/duty.md)
module ehl_duty_steps
   use ehl_duty, only: duty_state_t, duty_t
   use ehl_kinds, only: dp
   implicit none (type, external)
   private
   public :: duty_steps_t, state_size

   !> Minimum speed, over the maximum, from which the step is computed
   real(dp), parameter :: min_speed = 0.1_dp
   !> Maximum change of load, curvature, viscosity, layer (of the larger value) and of mean velocity (of the maximum) in a step
   real(dp), parameter :: max_change = 0.1_dp
   !> Maximum ratio of a step to the previous one; above 2.4 BDF2 is unstable
   real(dp), parameter :: growth = 1.5_dp
   !> Maximum number of halvings of a step that does not converge, and of one with too large an error
   integer, parameter :: max_cuts = 8, max_error_cuts = 5
   !> Fraction of the target error allowed in a step of any length: smaller errors are below those of the residual and of the
   !> minimum film, which jumps from node to node
   real(dp), parameter :: min_fraction = 0.05_dp
   !> Time in which the film passes through the contact and the errors of its steps add up [a/u]
   real(dp), parameter :: transit = 2.0_dp
   !> Maximum step with a target error, over that from the mesh size
   real(dp), parameter :: max_step_factor = 4.0_dp
   !> Size of the saved state
   integer, parameter :: state_size = 5

   type :: duty_steps_t
      !> Previous steps, the latest first; 0: none yet
      real(dp) :: steps(3) = 0.0_dp
      !> Factor of the next step from the error of the last one
      real(dp) :: next_factor = 1.0_dp
      !> Number of halvings of the present step
      integer :: cuts = 0
   contains
      procedure :: next
      procedure :: assess
      procedure :: before
      procedure :: keep
      procedure :: cut
      procedure :: ratio
      procedure :: pack => pack_numbers
      procedure :: unpack => unpack_numbers
   end type duty_steps_t

contains

   !> Length of the next step
   pure real(dp) function next(self, duty, time, mesh, moves) result(step)
      class(duty_steps_t), intent(in) :: self
      type(duty_t), intent(in) :: duty
      real(dp), intent(in) :: time, mesh
      !> Whether rough surfaces move, so that the speed of the faster one counts
      logical, intent(in) :: moves
      type(duty_state_t) :: now, then
      real(dp) :: speed, slow, factor, knots(2)
      integer :: k

      now = duty%at(time)
      slow = min_speed*duty%max_speed()
      factor = duty%step_factor
      step = factor*mesh/max(slow, speed_of(now))
      if (self%steps(1) > 0.0_dp) then
         if (duty%target_error > 0.0_dp) factor = max_step_factor*factor
         step = min(factor*mesh/max(slow, speed_of(now)), self%steps(1)*min(growth, self%next_factor))
      end if
      do k = 1, max_cuts
         then = duty%at(time + step)
         speed = max(slow, speed_of(then))
         if (step > 1.001_dp*factor*mesh/speed) then
            step = max(0.5_dp*step, factor*mesh/speed)
         else if (changes(now, then)) then
            step = 0.5_dp*step
         else
            exit
         end if
      end do
      step = step*0.5_dp**self%cuts
      ! end the step at a row of the table unless the rows are as close as the steps
      knots = duty%next_knot(time)
      if (knots(2) - knots(1) > step .or. knots(1) > duty%end_time() - 1.0e-9_dp*duty%length()) then
         associate (remaining => knots(1) - time)
            if (remaining < 1.001_dp*step) then
               step = remaining
            else if (remaining < 2.0_dp*step) then
               step = 0.5_dp*remaining
            end if
         end associate
      end if

   contains

      pure real(dp) function speed_of(state)
         type(duty_state_t), intent(in) :: state
         speed_of = abs(state%mean_velocity())
         if (moves) speed_of = max(speed_of, maxval(abs(state%speeds)))
      end function speed_of

      !> Whether the conditions change too much in a step
      pure logical function changes(a, b)
         type(duty_state_t), intent(in) :: a, b
         real(dp) :: before(5), after(5)

         before = [a%load, a%viscosity, a%layer, a%curvatures]
         after = [b%load, b%viscosity, b%layer, b%curvatures]
         changes = abs(b%mean_velocity() - a%mean_velocity()) > max_change*duty%max_speed() &
                   .or. any(abs(after - before) > max_change*max(after, before))
      end function changes
   end function next

   !> Ratio of a step to the previous one; 1 for the first, before which the contact is steady
   pure real(dp) function ratio(self, step)
      class(duty_steps_t), intent(in) :: self
      real(dp), intent(in) :: step

      ratio = 1.0_dp
      if (self%steps(1) > 0.0_dp) ratio = step/self%steps(1)
   end function ratio

   !> Test the error added by a step: `accepted` is false if it exceeds the target and the step may be halved
   subroutine assess(self, duty, step, speed, error, accepted)
      class(duty_steps_t), intent(inout) :: self
      type(duty_t), intent(in) :: duty
      !> The step, the mean velocity, and the relative error of the films that the step adds
      real(dp), intent(in) :: step, speed, error
      logical, intent(out) :: accepted
      real(dp) :: allowed

      accepted = .true.
      self%next_factor = growth
      if (.not. duty%target_error > 0.0_dp) return
      allowed = duty%target_error*max(min_fraction, step*max(abs(speed), min_speed*duty%max_speed())/transit)
      self%next_factor = min(growth, max(0.5_dp, 0.8_dp*(allowed/max(error, tiny(1.0_dp)))**(1.0_dp/3.0_dp)))
      accepted = error <= allowed .or. self%cuts >= max_error_cuts
   end subroutine assess

   !> A step and the previous ones; before the first one the contact is steady, so that they may have its length
   pure function before(self, step) result(steps)
      class(duty_steps_t), intent(in) :: self
      real(dp), intent(in) :: step
      real(dp) :: steps(3)

      steps = [step, self%steps(:2)]
      where (.not. steps > 0.0_dp) steps = step
   end function before

   !> Accept the step
   pure subroutine keep(self, step)
      class(duty_steps_t), intent(inout) :: self
      real(dp), intent(in) :: step

      self%steps = self%before(step)
      self%cuts = 0
   end subroutine keep

   !> Halve the step; false if the maximum number of halvings is reached
   logical function cut(self)
      class(duty_steps_t), intent(inout) :: self

      cut = self%cuts < max_cuts
      if (cut) self%cuts = self%cuts + 1
   end function cut

   !> Store the state as numbers
   pure function pack_numbers(self) result(numbers)
      class(duty_steps_t), intent(in) :: self
      real(dp) :: numbers(state_size)
      numbers = [self%steps, self%next_factor, real(self%cuts, dp)]
   end function pack_numbers

   !> Restore the state from numbers
   pure subroutine unpack_numbers(self, numbers)
      class(duty_steps_t), intent(inout) :: self
      real(dp), intent(in) :: numbers(state_size)

      self%steps = numbers(1:3)
      self%next_factor = numbers(4)
      self%cuts = nint(numbers(5))
   end subroutine unpack_numbers
end module ehl_duty_steps

! SPDX-License-Identifier: BSD-3-Clause
!> Time steps under a changing duty: how long they are
module ehl_duty_steps
   use ehl_duty, only: duty_state_t, duty_t
   use ehl_kinds, only: dp
   implicit none (type, external)
   private
   public :: duty_steps_t, kept_numbers

   !> Longest step: that by the mesh and the largest speed over this share
   real(dp), parameter :: slowest = 0.1_dp
   !> Largest change of load, curvature, viscosity, layer (of the larger value) and of mean velocity (of the largest) in a step
   real(dp), parameter :: max_change = 0.1_dp
   !> A step is at most so many times the one before: with more than 2.4 backward differences are not stable
   real(dp), parameter :: growth = 1.5_dp
   !> Steps that do not converge are cut by half so many times, those that miss the error so many
   integer, parameter :: max_cuts = 8, max_for_error = 5
   !> Share of the target error that a step may have, however short it is: smaller errors are below those of the residual and of
   !> the minimum film, which jumps from node to node
   real(dp), parameter :: min_share = 0.05_dp
   !> Time in which the film passes the contact [a/u]: errors of its steps add up
   real(dp), parameter :: transit = 2.0_dp
   !> With a target error steps may be so many times as long as by the mesh
   real(dp), parameter :: longest = 4.0_dp
   !> Numbers of it in a saved state
   integer, parameter :: kept_numbers = 5

   type :: duty_steps_t
      !> Last steps, the latest first; 0: none yet
      real(dp) :: steps(3) = 0.0_dp
      !> Factor for the next step by the error of the last one
      real(dp) :: wanted = 1.0_dp
      !> Times that the present step was cut
      integer :: cuts = 0
   contains
      procedure :: next
      procedure :: judge
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
      !> Whether rough surfaces move, so that the faster one counts
      logical, intent(in) :: moves
      type(duty_state_t) :: now, then
      real(dp) :: speed, slow, share, knots(2)
      integer :: k

      now = duty%at(time)
      slow = slowest*duty%fastest()
      share = duty%step_share
      step = share*mesh/max(slow, speed_of(now))
      if (self%steps(1) > 0.0_dp) then
         if (duty%target_error > 0.0_dp) share = longest*share
         step = min(share*mesh/max(slow, speed_of(now)), self%steps(1)*min(growth, self%wanted))
      end if
      do k = 1, max_cuts
         then = duty%at(time + step)
         speed = max(slow, speed_of(then))
         if (step > 1.001_dp*share*mesh/speed) then
            step = max(0.5_dp*step, share*mesh/speed)
         else if (changes(now, then)) then
            step = 0.5_dp*step
         else
            exit
         end if
      end do
      step = step*0.5_dp**self%cuts
      ! a step ends at a row of the table, unless rows are as close as steps
      knots = duty%next_knot(time)
      if (knots(2) - knots(1) > step .or. knots(1) > duty%end_time() - 1.0e-9_dp*duty%length()) then
         associate (left => knots(1) - time)
            if (left < 1.001_dp*step) then
               step = left
            else if (left < 2.0_dp*step) then
               step = 0.5_dp*left
            end if
         end associate
      end if

   contains

      pure real(dp) function speed_of(state)
         type(duty_state_t), intent(in) :: state
         speed_of = abs(state%mean_velocity())
         if (moves) speed_of = max(speed_of, maxval(abs(state%speeds)))
      end function speed_of

      !> Whether too much changes in a step
      pure logical function changes(a, b)
         type(duty_state_t), intent(in) :: a, b
         real(dp) :: before(5), after(5)

         before = [a%load, a%viscosity, a%layer, a%curvatures]
         after = [b%load, b%viscosity, b%layer, b%curvatures]
         changes = abs(b%mean_velocity() - a%mean_velocity()) > max_change*duty%fastest() &
                   .or. any(abs(after - before) > max_change*max(after, before))
      end function changes
   end function next

   !> Step over the one before it; 1 at the beginning, before which all is steady
   pure real(dp) function ratio(self, step)
      class(duty_steps_t), intent(in) :: self
      real(dp), intent(in) :: step

      ratio = 1.0_dp
      if (self%steps(1) > 0.0_dp) ratio = step/self%steps(1)
   end function ratio

   !> Assess the error that a step adds: not good if it exceeds the target and the step can be cut
   subroutine judge(self, duty, step, speed, error, good)
      class(duty_steps_t), intent(inout) :: self
      type(duty_t), intent(in) :: duty
      !> Mean velocity; error of the films, relative
      real(dp), intent(in) :: step, speed, error
      logical, intent(out) :: good
      real(dp) :: allowed

      good = .true.
      self%wanted = growth
      if (.not. duty%target_error > 0.0_dp) return
      allowed = duty%target_error*max(min_share, step*max(abs(speed), slowest*duty%fastest())/transit)
      self%wanted = min(growth, max(0.5_dp, 0.8_dp*(allowed/max(error, tiny(1.0_dp)))**(1.0_dp/3.0_dp)))
      good = error <= allowed .or. self%cuts >= max_for_error
   end subroutine judge

   !> A step of this length, and those before it; before the first one all is steady, so that they may be as long as it
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

   !> Cut the step; whether that is still possible
   logical function cut(self)
      class(duty_steps_t), intent(inout) :: self

      cut = self%cuts < max_cuts
      if (cut) self%cuts = self%cuts + 1
   end function cut

   !> Store the state as numbers
   pure function pack_numbers(self) result(numbers)
      class(duty_steps_t), intent(in) :: self
      real(dp) :: numbers(kept_numbers)
      numbers = [self%steps, self%wanted, real(self%cuts, dp)]
   end function pack_numbers

   !> Restore the state from numbers
   pure subroutine unpack_numbers(self, numbers)
      class(duty_steps_t), intent(inout) :: self
      real(dp), intent(in) :: numbers(kept_numbers)

      self%steps = numbers(1:3)
      self%wanted = numbers(4)
      self%cuts = nint(numbers(5))
   end subroutine unpack_numbers
end module ehl_duty_steps

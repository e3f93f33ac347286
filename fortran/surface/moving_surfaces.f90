! SPDX-License-Identifier: BSD-3-Clause
!> The rough surfaces of a contact on the move: when they come near it, fill it, repeat and leave it
module ehl_moving_surfaces
   use ehl_kinds, only: dp
   use ehl_rough_surfaces, only: rough_surfaces_t
   implicit none (type, external)
   private
   public :: moving_surfaces_t

   !> Difference of periods, as a part of one, and of velocity ratios below which they are equal
   real(dp), parameter :: same = 1.0e-9_dp
   !> Where there is no common period: part of a period by which surfaces should miss their start, and may at the most
   real(dp), parameter :: near = 0.02_dp, farthest = 0.25_dp
   !> Least number of positions in which they meet, those of both: n periods of one and m of the other, without a common
   !> factor, take the mean of all products of their waves but those of order n + m
   integer, parameter :: fewest = 5
   !> Longest common period that is searched for a message
   integer, parameter :: max_named = 10000

   !> Motion of all surfaces of a run
   type, extends(rough_surfaces_t) :: moving_surfaces_t
      !> Time in which the friction repeats, see find_period; of what passes once the time of the passage
      real(dp) :: period = 0.0_dp
      !> Periods of the slowest surface in it, and by what part of a period another one misses its start then
      integer :: repeats = 1
      real(dp) :: mismatch = 0.0_dp
      !> Whether they meet in enough positions in that time for a mean; how many periods of the slowest would hold whole
      !> ones of all, where that is known and more; 0: it is not
      logical :: meets = .true.
      integer :: whole = 0
   contains
      procedure :: move
      procedure :: rest
      procedure :: some_rest
      procedure :: pass_once
      procedure :: velocities
      procedure :: slowest
      procedure :: begin
      procedure :: time_filled
      procedure :: time_to_mean
      procedure :: find_period
      procedure :: end_of_passage
   end type moving_surfaces_t

contains

   !> Whether a rough surface is on the move: time steps
   pure logical function move(self)
      class(moving_surfaces_t), intent(in) :: self
      integer :: k
      move = any([(.not. self%of(k)%surface%at_rest(), k=1, self%count())])
   end function move

   !> Whether there is a rough surface and none moves: a steady contact
   pure logical function rest(self)
      class(moving_surfaces_t), intent(in) :: self
      rest = self%rough() .and. .not. self%move()
   end function rest

   !> Whether one is at rest while another one moves: the steady contact with the roughness at rest comes first
   pure logical function some_rest(self)
      class(moving_surfaces_t), intent(in) :: self
      integer :: k

      some_rest = self%move() .and. any([(self%of(k)%surface%at_rest(), k=1, self%count())])
   end function some_rest

   !> Whether something passes the contact once: the run ends when it has left
   pure logical function pass_once(self)
      class(moving_surfaces_t), intent(in) :: self
      integer :: k
      pass_once = any([(self%of(k)%surface%passes_once .and. .not. (self%move() .and. self%of(k)%surface%at_rest()), &
                        k=1, self%count())])
   end function pass_once

   !> Different velocities over the mean velocity of what moves, the least first
   pure function velocities(self) result(ratios)
      class(moving_surfaces_t), intent(in) :: self
      real(dp), allocatable :: ratios(:)
      integer :: k

      allocate (ratios(0))
      do k = 1, self%count()
         associate (surface => self%of(k)%surface)
            if (surface%at_rest() .or. any(abs(ratios - surface%velocity_ratio) <= same)) cycle
            ! in an order that does not depend on which surface is the first
            ratios = [pack(ratios, ratios < surface%velocity_ratio), surface%velocity_ratio, &
                      pack(ratios, ratios > surface%velocity_ratio)]
         end associate
      end do
   end function velocities

   !> Number of the slowest of those that move
   pure integer function slowest(self)
      class(moving_surfaces_t), intent(in) :: self
      integer :: k

      slowest = minloc([(self%of(k)%surface%velocity_ratio, k=1, self%count())], dim=1, &
                       mask=[(.not. self%of(k)%surface%at_rest(), k=1, self%count())])
   end function slowest

   !> Time at which the first of them comes near the contact, and not before 0; steps until then change nothing
   pure real(dp) function begin(self)
      class(moving_surfaces_t), intent(in) :: self
      integer :: k

      begin = huge(1.0_dp)
      do k = 1, self%count()
         associate (surface => self%of(k)%surface)
            if (.not. surface%at_rest()) begin = min(begin, surface%time_near())
         end associate
      end do
      begin = max(0.0_dp, begin)
   end function begin

   !> Time at which the fronts of all that move have passed X
   pure real(dp) function time_filled(self, x)
      class(moving_surfaces_t), intent(in) :: self
      real(dp), intent(in) :: x
      integer :: k

      time_filled = -huge(1.0_dp)
      do k = 1, self%count()
         associate (surface => self%of(k)%surface)
            if (.not. surface%at_rest()) time_filled = max(time_filled, (x - surface%x_start)/surface%velocity_ratio)
         end associate
      end do
   end function time_filled

   !> Time from a given time until the friction is part of a mean; negative if that was earlier
   pure real(dp) function time_to_mean(self, time)
      class(moving_surfaces_t), intent(in) :: self
      real(dp), intent(in) :: time
      real(dp), allocatable :: times(:)
      integer :: k

      allocate (times(0))
      do k = 1, self%count()
         if (counts(self, k)) times = [times, self%of(k)%surface%time_to_mean(time)]
      end do
      if (self%pass_once()) then
         time_to_mean = minval(times)
      else
         time_to_mean = maxval(times)
      end if
   end function time_to_mean

   !> Time at which what passes once has left the contact
   pure real(dp) function end_of_passage(self)
      class(moving_surfaces_t), intent(in) :: self
      end_of_passage = self%time_to_mean(0.0_dp) + self%period
   end function end_of_passage

   !> Whether a surface determines the mean: it moves, and it passes once if any surface does
   pure logical function counts(self, k)
      type(moving_surfaces_t), intent(in) :: self
      integer, intent(in) :: k
      counts = .not. self%of(k)%surface%at_rest() .and. (self%of(k)%surface%passes_once .or. .not. self%pass_once())
   end function counts

   !> Find the time in which the friction repeats: the smallest one that holds whole periods of all surfaces. Where none
   !> with so many periods of the slowest one does, a time after which all are nearly where they began; `mismatch` is
   !> by how much they are not. Of what passes once, the time from when it comes near until it has left, in whole periods
   !> of roughness on the other body.
   pure subroutine find_period(self, most)
      class(moving_surfaces_t), intent(inout) :: self
      !> Most periods of the slowest surface
      integer, intent(in) :: most
      real(dp), allocatable :: periods(:), others(:)
      real(dp) :: passage
      integer :: k

      self%repeats = 1
      self%mismatch = 0.0_dp
      self%meets = .true.
      self%whole = 0
      self%period = 0.0_dp
      allocate (periods(0), others(0))
      do k = 1, self%count()
         associate (surface => self%of(k)%surface)
            if (surface%at_rest()) cycle
            if (counts(self, k)) then
               periods = [periods, surface%time_period()]
            else
               others = [others, surface%time_period()]
            end if
         end associate
      end do
      if (size(periods) == 0) return
      self%period = maxval(periods)
      if (self%pass_once()) then
         if (size(periods) > 1) then
            passage = 0.0_dp
            do k = 1, self%count()
               if (counts(self, k)) passage = max(passage, self%of(k)%surface%time_to_mean(0.0_dp) &
                                                  + self%of(k)%surface%time_period())
            end do
            self%period = passage - self%time_to_mean(0.0_dp)
         end if
         if (size(others) > 0) self%period = ceiling(self%period/maxval(others) - same)*maxval(others)
         return
      end if
      if (size(periods) == 1) return
      self%repeats = common(periods, most)
      if (self%repeats == 0) call find_near(self, periods, most)
      self%period = self%repeats*maxval(periods)
   end subroutine find_period

   !> Least number of the longest of some periods that holds whole periods of all; 0: none up to so many
   pure integer function common(periods, most)
      real(dp), intent(in) :: periods(:)
      integer, intent(in) :: most

      do common = 1, most
         if (missed(common*maxval(periods), periods) <= common*same) return
      end do
      common = 0
   end function common

   !> A number of the longest period after which all are nearly where they began, and have met in several positions: with 4
   !> periods to 4 of nearly the same length their relative motion is small
   pure subroutine find_near(self, periods, most)
      class(moving_surfaces_t), intent(inout) :: self
      real(dp), intent(in) :: periods(:)
      integer, intent(in) :: most
      real(dp) :: mismatch
      integer :: n

      self%repeats = most
      self%mismatch = farthest
      self%meets = .false.
      do n = 1, most
         mismatch = missed(n*maxval(periods), periods)
         if (positions(n, nint(n*maxval(periods)/minval(periods))) < fewest .or. mismatch >= self%mismatch) cycle
         self%repeats = n
         self%mismatch = mismatch
         self%meets = .true.
         if (mismatch <= near) exit
      end do
      self%whole = common(periods, max_named)
   end subroutine find_near

   !> Positions in which one surface meets another one in so many periods of both
   pure integer function positions(n, m)
      integer, intent(in) :: n, m
      integer :: a, b, rest

      a = n
      b = m
      do while (b > 0)
         rest = modulo(a, b)
         a = b
         b = rest
      end do
      positions = (n + m)/a
   end function positions

   !> By what part of a period one of them misses its start after a time
   pure real(dp) function missed(time, periods)
      real(dp), intent(in) :: time, periods(:)
      missed = maxval(abs(time/periods - anint(time/periods)))
   end function missed
end module ehl_moving_surfaces

! SPDX-License-Identifier: BSD-3-Clause
!> The moving rough surfaces of a contact: times at which they approach it, fill it, repeat and leave it
module ehl_moving_surfaces
   use ehl_kinds, only: dp
   use ehl_rough_surfaces, only: rough_surfaces_t
   implicit none (type, external)
   private
   public :: moving_surfaces_t

   !> Relative difference of periods, and difference of velocity ratios, below which they are equal
   real(dp), parameter :: same = 1.0e-9_dp
   !> Without a common period: desired and maximum mismatch of the surfaces after the averaging time, as a fraction of a period
   real(dp), parameter :: good_mismatch = 0.02_dp, max_mismatch = 0.25_dp
   !> Minimum number of relative positions: n periods of one surface and m of the other, without a common factor,
   !> give the mean of all products of their waves except those of order n + m
   integer, parameter :: min_positions = 5
   !> Longest common period, in periods of the slowest surface, that a message names
   integer, parameter :: max_named = 10000

   !> Motion of all surfaces of a run
   type, extends(rough_surfaces_t) :: moving_surfaces_t
      !> Time in which the friction repeats, see find_period; of features the time of the passage
      real(dp) :: period = 0.0_dp
      !> Number of periods of the slowest surface in it, and mismatch of the others after it, as a fraction of their period
      integer :: repeats = 1
      real(dp) :: mismatch = 0.0_dp
      !> Whether there are enough relative positions in that time for a mean; number of periods of the slowest surface that would be
      !> a common period, if that is longer; 0: not known
      logical :: enough_positions = .true.
      integer :: whole = 0
   contains
      procedure :: move
      procedure :: all_stationary
      procedure :: some_stationary
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

   !> Whether a rough surface moves, which requires time steps
   pure logical function move(self)
      class(moving_surfaces_t), intent(in) :: self
      integer :: k
      move = any([(.not. self%of(k)%surface%at_rest(), k=1, self%count())])
   end function move

   !> Whether there are rough surfaces and none moves, so that the contact is steady
   pure logical function all_stationary(self)
      class(moving_surfaces_t), intent(in) :: self
      all_stationary = self%rough() .and. .not. self%move()
   end function all_stationary

   !> Whether some surfaces are stationary and others move: the steady contact with the stationary roughness is solved first
   pure logical function some_stationary(self)
      class(moving_surfaces_t), intent(in) :: self
      integer :: k

      some_stationary = self%move() .and. any([(self%of(k)%surface%at_rest(), k=1, self%count())])
   end function some_stationary

   !> Whether a feature passes the contact once: the run ends when it has left; true also for features if no surface moves
   pure logical function pass_once(self)
      class(moving_surfaces_t), intent(in) :: self
      integer :: k
      pass_once = any([(self%of(k)%surface%passes_once .and. .not. (self%move() .and. self%of(k)%surface%at_rest()), &
                        k=1, self%count())])
   end function pass_once

   !> Distinct velocities of the moving surfaces over the mean velocity, in increasing order
   pure function velocities(self) result(ratios)
      class(moving_surfaces_t), intent(in) :: self
      real(dp), allocatable :: ratios(:)
      integer :: k

      allocate (ratios(0))
      do k = 1, self%count()
         associate (surface => self%of(k)%surface)
            if (surface%at_rest() .or. any(abs(ratios - surface%velocity_ratio) <= same)) cycle
            ! the order does not depend on that of the surfaces
            ratios = [pack(ratios, ratios < surface%velocity_ratio), surface%velocity_ratio, &
                      pack(ratios, ratios > surface%velocity_ratio)]
         end associate
      end do
   end function velocities

   !> Index of the slowest moving surface
   pure integer function slowest(self)
      class(moving_surfaces_t), intent(in) :: self
      integer :: k

      slowest = minloc([(self%of(k)%surface%velocity_ratio, k=1, self%count())], dim=1, &
                       mask=[(.not. self%of(k)%surface%at_rest(), k=1, self%count())])
   end function slowest

   !> Time, at least 0, at which the first surface approaches the contact; earlier steps would change nothing
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

   !> Time at which the fronts of all moving surfaces have passed X
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

   !> Time from a given time until friction counts for the mean; negative if that was earlier
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

   !> Time at which all features have left the contact
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

   !> Find the time in which the friction repeats: the smallest common period of all surfaces. If there is none within `max_periods`
   !> periods of the slowest one, a time after which all are nearly in phase again, with a `mismatch`. For features, the time
   !> from when the first approaches the contact until the last has left, rounded up to whole periods of roughness on
   !> the other body.
   pure subroutine find_period(self, max_periods)
      class(moving_surfaces_t), intent(inout) :: self
      !> Maximum number of periods of the slowest surface
      integer, intent(in) :: max_periods
      real(dp), allocatable :: periods(:), others(:)
      real(dp) :: passage
      integer :: k

      self%repeats = 1
      self%mismatch = 0.0_dp
      self%enough_positions = .true.
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
      self%repeats = common(periods, max_periods)
      if (self%repeats == 0) call find_near(self, periods, max_periods)
      self%period = self%repeats*maxval(periods)
   end subroutine find_period

   !> Smallest n such that n times the longest period is a common period of all; 0: none up to `max_periods`
   pure integer function common(periods, max_periods)
      real(dp), intent(in) :: periods(:)
      integer, intent(in) :: max_periods

      do common = 1, max_periods
         if (phase_mismatch(common*maxval(periods), periods) <= common*same) return
      end do
      common = 0
   end function common

   !> Find a number n of the longest periods after which all are nearly in phase again, with several relative positions:
   !> after 4 periods each, of nearly the same length, they have hardly moved relative to each other
   pure subroutine find_near(self, periods, max_periods)
      class(moving_surfaces_t), intent(inout) :: self
      real(dp), intent(in) :: periods(:)
      integer, intent(in) :: max_periods
      real(dp) :: mismatch
      integer :: n

      self%repeats = max_periods
      self%mismatch = max_mismatch
      self%enough_positions = .false.
      do n = 1, max_periods
         mismatch = phase_mismatch(n*maxval(periods), periods)
         if (positions(n, nint(n*maxval(periods)/minval(periods))) < min_positions .or. mismatch >= self%mismatch) cycle
         self%repeats = n
         self%mismatch = mismatch
         self%enough_positions = .true.
         if (mismatch <= good_mismatch) exit
      end do
      self%whole = common(periods, max_named)
   end subroutine find_near

   !> Number of relative positions of two surfaces in n periods of one and m of the other
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

   !> Maximum phase difference from the start after a time, as a fraction of a period
   pure real(dp) function phase_mismatch(time, periods)
      real(dp), intent(in) :: time, periods(:)
      phase_mismatch = maxval(abs(time/periods - anint(time/periods)))
   end function phase_mismatch
end module ehl_moving_surfaces

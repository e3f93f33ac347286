! SPDX-License-Identifier: BSD-3-Clause
!> When rough surfaces come near a contact, fill it, repeat and leave it
submodule (ehl_moving_surfaces) ehl_motion
   implicit none (type, external)

   !> Difference of periods, as a part of one, and of velocity ratios that is none
   real(dp), parameter :: same = 1.0e-9_dp
   !> Where there is no common period: part of a period by which surfaces may miss their start, and the least number of
   !> periods, so that the surfaces meet in several positions
   real(dp), parameter :: near = 0.02_dp
   integer, parameter :: fewest = 4

contains

   pure module function velocities(self) result(ratios)
      class(moving_surfaces_t), intent(in) :: self
      real(dp), allocatable :: ratios(:)
      integer :: k

      allocate (ratios(0))
      do k = 1, self%count()
         associate (surface => self%of(k)%surface)
            if (surface%at_rest() .or. any(abs(ratios - surface%velocity_ratio) <= same)) cycle
            ratios = [ratios, surface%velocity_ratio]
         end associate
      end do
   end function velocities

   pure integer module function slowest(self)
      class(moving_surfaces_t), intent(in) :: self
      integer :: k

      slowest = minloc([(self%of(k)%surface%velocity_ratio, k=1, self%count())], dim=1, &
                       mask=[(.not. self%of(k)%surface%at_rest(), k=1, self%count())])
   end function slowest

   pure real(dp) module function begin(self)
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

   pure real(dp) module function time_to_mean(self, time)
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

   pure real(dp) module function end_of_passage(self)
      class(moving_surfaces_t), intent(in) :: self
      end_of_passage = self%time_to_mean(0.0_dp) + self%period
   end function end_of_passage

   !> Whether a surface rules the mean: it moves, and it passes once if anything does
   pure logical function counts(self, k)
      type(moving_surfaces_t), intent(in) :: self
      integer, intent(in) :: k
      counts = .not. self%of(k)%surface%at_rest() .and. (self%of(k)%surface%passes_once .or. .not. self%pass_once())
   end function counts

   pure module subroutine find_period(self, most)
      class(moving_surfaces_t), intent(inout) :: self
      integer, intent(in) :: most
      real(dp), allocatable :: periods(:), others(:)
      real(dp) :: passage, mismatch
      integer :: k, n

      self%repeats = 1
      self%mismatch = 0.0_dp
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
      do n = 1, most
         mismatch = missed(n*maxval(periods), periods)
         if (mismatch <= n*same) exit
      end do
      if (n > most) then
         mismatch = huge(1.0_dp)
         do k = min(fewest, most), most
            if (missed(k*maxval(periods), periods) >= mismatch) cycle
            n = k
            mismatch = missed(k*maxval(periods), periods)
            if (mismatch <= near) exit
         end do
         self%mismatch = mismatch
      end if
      self%repeats = n
      self%period = n*maxval(periods)
   end subroutine find_period

   !> By what part of a period one of them misses its start after a time
   pure real(dp) function missed(time, periods)
      real(dp), intent(in) :: time, periods(:)
      missed = maxval(abs(time/periods - anint(time/periods)))
   end function missed
end submodule ehl_motion

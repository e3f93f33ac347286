! SPDX-License-Identifier: BSD-3-Clause
!> When rough surfaces come near a contact, fill it, repeat and leave it
submodule (ehl_moving_surfaces) ehl_motion
   implicit none (type, external)

contains

   pure module function velocities(self) result(ratios)
      class(moving_surfaces_t), intent(in) :: self
      real(dp), allocatable :: ratios(:)
      integer :: k

      allocate (ratios(0))
      do k = 1, self%count()
         if (.not. self%of(k)%surface%at_rest()) ratios = [ratios, self%of(k)%surface%velocity_ratio]
      end do
   end function velocities

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
      integer :: k

      time_to_mean = -huge(1.0_dp)
      do k = 1, self%count()
         associate (surface => self%of(k)%surface)
            if (.not. surface%at_rest()) time_to_mean = max(time_to_mean, surface%time_to_mean(time))
         end associate
      end do
   end function time_to_mean

   pure real(dp) module function time_filled(self, x)
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

   pure real(dp) module function period(self)
      class(moving_surfaces_t), intent(in) :: self
      integer :: k

      period = 0.0_dp
      do k = 1, self%count()
         associate (surface => self%of(k)%surface)
            if (.not. surface%at_rest()) period = max(period, surface%time_period())
         end associate
      end do
   end function period

   pure real(dp) module function end_of_passage(self)
      class(moving_surfaces_t), intent(in) :: self
      integer :: k

      end_of_passage = 0.0_dp
      do k = 1, self%count()
         associate (surface => self%of(k)%surface)
            if (surface%passes_once .and. .not. surface%at_rest()) end_of_passage = max(end_of_passage, surface%end_of_passage())
         end associate
      end do
   end function end_of_passage
end submodule ehl_motion

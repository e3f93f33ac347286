! SPDX-License-Identifier: BSD-3-Clause
!> A single feature that passes the contact once: dent, bump, ridge or groove
module ehl_feature
   use ehl_grid, only: grid_t
   use ehl_kinds, only: dp, pi
   use ehl_surface, only: aliased_below, surface_t, x_filled, x_matters
   implicit none (type, external)
   private
   public :: feature_t, new_feature

   !> Half the extent of a feature over its width; beyond it the height is less than 3e-4 of the amplitude
   real(dp), parameter :: reach_over_width = 0.6_dp
   !> Value of s^2 above which the height is set to 0: 10^(-10 s^2) is below rounding
   real(dp), parameter :: vanished = 1.6_dp
   !> Distance between the features of a strip: minimum [a], and over their size along Y
   real(dp), parameter :: min_spacing = 4.0_dp, apart = 4.0_dp

   !> With xi across the feature and eta along it, rotated by the angle from X and Y,
   !>
   !>     RR = +-A 10^(-10 s^2) cos(2 pi s),
   !>
   !> dent and bump: s^2 = (xi/width)^2 + (eta/length)^2; ridge and groove: s = xi/width, and with a length times
   !> 10^(-10 e^2), e = max(0, |eta| - length/2)/width. The profile is that of Venner, Lubrecht & ten Napel 1991
   !> (J. Tribology 113, 777) and of Venner & Lubrecht 1994 (J. Tribology 116, 751).
   type, extends(surface_t) :: feature_t
      !> 1: bump, ridge; -1: dent, groove
      real(dp) :: sign = 1.0_dp
      !> Size across and along [a]; length 0: a ridge or groove without ends
      real(dp) :: width = 0.5_dp, length = 0.5_dp
      !> Whether it is a ridge or groove
      logical :: is_line = .false.
      !> Cosine and sine of the angle
      real(dp) :: turn(2) = [1.0_dp, 0.0_dp]
      !> Y of the centre, and distance from the centre to either end along X [a]
      real(dp) :: y_start = 0.0_dp, reach = 0.0_dp
   contains
      procedure :: height
      procedure :: unresolved
      procedure :: centre
      procedure :: repeat_along_y
      procedure :: is_endless_across
      procedure :: size_y
      procedure, private :: wavelengths
   end type feature_t

contains

   !> A feature; lengths in Hertz radii (length 0 of a dent or bump: its width), amplitude scaled by a^2/R.
   !> At time 0 the front end of a moving feature, or the centre of a stationary one, is at x_start.
   pure function new_feature(is_raised, is_line, amplitude, width, length, angle, y_start, velocity_ratio, x_start) &
      result(self)
      !> Bump or ridge, not dent or groove; ridge or groove, not dent or bump
      logical, intent(in) :: is_raised, is_line
      !> Angle counter-clockwise [degrees]; at 0 the width is along X
      real(dp), intent(in) :: amplitude, width, length, angle, y_start, velocity_ratio, x_start
      type(feature_t) :: self

      self%amplitude = amplitude
      self%sign = merge(1.0_dp, -1.0_dp, is_raised)
      self%is_line = is_line
      self%width = width
      self%length = length
      if (.not. self%is_line .and. .not. length > 0.0_dp) self%length = width
      self%turn = cosine_sine(angle)
      ! a round feature does not depend on the angle
      if (.not. self%is_line .and. .not. abs(self%length - width) > 0.0_dp) self%turn = [1.0_dp, 0.0_dp]
      self%y_start = y_start
      self%velocity_ratio = velocity_ratio
      self%x_start = x_start
      self%front_length = 0.0_dp
      self%even_in_y = .not. abs(y_start) > 0.0_dp .and. .not. abs(product(self%turn)) > 0.0_dp
      self%passes_once = .true.
      self%reach = reach_of(self)
      if (velocity_ratio > 0.0_dp) self%period = velocity_ratio*passage_time(self)
   end function new_feature

   !> Cosine and sine of an angle [degrees], exact at multiples of 90
   pure function cosine_sine(angle) result(turn)
      real(dp), intent(in) :: angle
      real(dp) :: turn(2), rest

      rest = modulo(angle, 360.0_dp)
      turn = [cos(rest*pi/180.0_dp), sin(rest*pi/180.0_dp)]
      if (.not. abs(modulo(rest, 90.0_dp)) > 0.0_dp) turn = anint(turn)
   end function cosine_sine

   !> Half of its length along the motion; of a ridge or groove the part within the contact
   pure real(dp) function reach_of(self) result(reach)
      type(feature_t), intent(in) :: self
      real(dp) :: half, endless

      half = reach_over_width*self%width
      associate (c => abs(self%turn(1)), s => abs(self%turn(2)))
         if (.not. self%is_line) then
            reach = reach_over_width*norm2([self%width*c, self%length*s])
            return
         end if
         endless = huge(1.0_dp)
         if (c > epsilon(1.0_dp)) endless = (abs(x_matters) + half + abs(self%y_start)*s)/c - abs(x_matters)
         reach = endless
         if (self%length > 0.0_dp) reach = min(endless, half*c + (0.5_dp*self%length + half)*s)
      end associate
   end function reach_of

   !> Time from when its front end approaches the contact until both the feature and the film perturbation that it has caused in
   !> the inlet, which moves with the mean velocity, have left
   pure real(dp) function passage_time(self) result(time)
      type(feature_t), intent(in) :: self
      real(dp) :: out, in

      out = (x_filled + 2.0_dp*self%reach - x_matters)/self%velocity_ratio
      in = (-x_filled + 2.0_dp*self%reach - x_matters)/self%velocity_ratio
      time = max(out, in + 2.0_dp*x_filled)
   end function passage_time

   !> Repeat the feature along Y, on a strip of a line contact, at a distance; 0: a distance at which its neighbours have little
   !> influence
   pure subroutine repeat_along_y(self, distance)
      class(feature_t), intent(inout) :: self
      real(dp), intent(in) :: distance

      if (self%is_endless_across()) return
      self%period_y = distance
      if (.not. distance > 0.0_dp) self%period_y = max(min_spacing, apart*self%size_y())
   end subroutine repeat_along_y

   !> Whether the feature does not vary along Y
   pure logical function is_endless_across(self)
      class(feature_t), intent(in) :: self
      is_endless_across = self%is_line .and. .not. self%length > 0.0_dp .and. .not. abs(self%turn(2)) > 0.0_dp
   end function is_endless_across

   !> Length along Y; 0: endless
   pure real(dp) function size_y(self)
      class(feature_t), intent(in) :: self

      associate (c => abs(self%turn(1)), s => abs(self%turn(2)), half => reach_over_width*self%width)
         if (.not. self%is_line) then
            size_y = 2.0_dp*reach_over_width*norm2([self%width*s, self%length*c])
         else if (self%length > 0.0_dp) then
            size_y = 2.0_dp*(half*s + (0.5_dp*self%length + half)*c)
         else
            size_y = merge(0.0_dp, 2.0_dp*half, c > 0.0_dp)
         end if
      end associate
   end function size_y

   !> X of the centre at a time
   pure real(dp) function centre(self, time)
      class(feature_t), intent(in) :: self
      real(dp), intent(in) :: time
      centre = self%x_start
      if (.not. self%at_rest()) centre = self%front_position(time) - self%reach
   end function centre

   !> Roughness at the nodes, at time T
   subroutine height(self, grid, time, rr)
      class(feature_t), intent(inout) :: self
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: time
      real(dp), intent(out) :: rr(:, :)
      !> Distances from the centre along the motion and across it; xi/width, eta, s^2
      real(dp) :: x(grid%nx), y, across, along, square
      integer :: i, j

      x = grid%columns() - self%centre(time)
      do j = 1, grid%ny
         y = grid%y(j) - self%y_start
         if (self%period_y > 0.0_dp) y = y - self%period_y*anint(y/self%period_y)
         do i = 1, grid%nx
            across = (x(i)*self%turn(1) + y*self%turn(2))/self%width
            along = y*self%turn(1) - x(i)*self%turn(2)
            square = across**2
            if (.not. self%is_line) square = square + (along/self%length)**2
            rr(i, j) = 0.0_dp
            if (square > vanished) cycle
            rr(i, j) = self%sign*self%amplitude*10.0_dp**(-10.0_dp*square)*cos(2.0_dp*pi*sqrt(square))
            if (self%is_line .and. self%length > 0.0_dp) rr(i, j) = rr(i, j) &
               *10.0_dp**(-10.0_dp*(max(0.0_dp, abs(along) - 0.5_dp*self%length)/self%width)**2)
         end do
      end do
   end subroutine height

   !> Width of its profile along X and along Y [a]
   pure function wavelengths(self) result(length)
      class(feature_t), intent(in) :: self
      real(dp) :: length(2), other

      other = 0.0_dp
      if (.not. self%is_line) other = 1.0_dp/self%length
      associate (c => self%turn(1)/self%width, s => self%turn(2)/self%width, t => other*self%turn)
         length = 1.0_dp/max(epsilon(1.0_dp), [norm2([c, t(2)]), norm2([s, t(1)])])
      end associate
   end function wavelengths

   !> Fraction of the variance of its profile in waves with fewer nodes per period than `nodes`, in the less resolved of
   !> both directions: the spectrum of exp(-c s^2) cos(k s) is known in closed form. No wave is truncated, but a feature no wider
   !> than two mesh sizes counts as not resolved.
   pure real(dp) function unresolved(self, grid, nodes)
      class(feature_t), intent(in) :: self
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: nodes
      real(dp) :: has(2), q, k, scale

      has = self%wavelengths()/self%meshes(grid)
      unresolved = 0.0_dp
      if (any(has <= aliased_below)) then
         unresolved = 1.0_dp
      else if (nodes > aliased_below) then
         k = 2.0_dp*pi
         q = k*minval(has)/nodes
         scale = sqrt(20.0_dp*log(10.0_dp))
         unresolved = 0.5_dp*(erfc((q - k)/scale) + erfc((q + k)/scale)) + exp(-(k/scale)**2)*erfc(q/scale)
         unresolved = unresolved/(1.0_dp + exp(-(k/scale)**2))
      end if
   end function unresolved
end module ehl_feature

! SPDX-License-Identifier: BSD-3-Clause
!> The duty of a contact: load, speeds, radii, viscosity and oil layer over time, each divided by its value in the case, which sets
!> the scales (docs/theory/duty.md)
module ehl_duty
   use ehl_kinds, only: dp
   implicit none (type, external)
   private
   public :: duty_t, duty_state_t, duty_load, duty_u1, duty_u2, duty_radius_x, duty_radius_y, duty_viscosity, &
             duty_layer, quantities

   !> Indices of the quantities
   integer, parameter :: duty_load = 1, duty_u1 = 2, duty_u2 = 3, duty_radius_x = 4, duty_radius_y = 5, duty_viscosity = 6, &
                         duty_layer = 7
   integer, parameter :: quantities = 7
   !> Times before the table: in which the quantities change from the case to the first row [a/u of the faster of both], and in
   !> which the film then adapts to it [a/u of the first row]
   real(dp), parameter :: ramp = 2.0_dp, follow = 4.0_dp
   !> Minimum mean velocity of the first row over that of the case for which time to adapt is added
   real(dp), parameter :: at_rest = 0.05_dp
   !> Relative difference below which values are equal
   real(dp), parameter :: same = 1.0e-12_dp

   !> Conditions at a time over those of the case; speeds over the mean velocity of the case
   type :: duty_state_t
      real(dp) :: load = 1.0_dp, speeds(2) = 1.0_dp, viscosity = 1.0_dp, layer = 1.0_dp
      !> Curvatures along X and Y
      real(dp) :: curvatures(2) = 1.0_dp
      !> Displacements of the surfaces since the first row of the table [a]
      real(dp) :: displacements(2) = 0.0_dp
   contains
      procedure :: mean_velocity
   end type duty_state_t

   type :: duty_t
      !> Whether the case has a duty
      logical :: active = .false.
      !> Whether rough surfaces move throughout
      logical :: rough = .false.
      !> Times [a/u], from 0, and values over those of the case (velocities over its mean velocity), shape (times, quantities)
      real(dp), allocatable :: time(:), values(:, :)
      logical :: cubic = .false., periodic = .false.
      integer :: periods = 1
      !> Time step over that from the mesh size, target of the time-step error of the films (0: none)
      real(dp) :: step_factor = 1.0_dp, target_error = 0.0_dp
      !> Newtonian stress of eta0 at H = 1 and a sliding speed equal to the mean velocity of the case [Pa]
      real(dp) :: stress = 0.0_dp
      !> Oil layer rho H of the case; 0: the inlet is flooded
      real(dp) :: layer = 0.0_dp
      !> a/u [s]
      real(dp) :: time_scale = 0.0_dp
      !> Values of the case
      real(dp) :: reference(quantities) = 1.0_dp
      !> Time derivatives at the rows of the table, for cubic interpolation; displacements of the surfaces there
      real(dp), allocatable, private :: slopes(:, :), displacement(:, :)
      !> Time until which all quantities are those of the case; negative if the first row differs
      real(dp), private :: constant_until = -1.0_dp
   contains
      procedure :: setup
      procedure :: at
      procedure :: is_constant
      procedure :: begin
      procedure :: end_time
      procedure :: length
      procedure :: reverses
      procedure :: max_speed
      procedure :: next_knot
      procedure :: steps_expected
      procedure, private :: raw
   end type duty_t

contains

   !> Mean velocity over that of the case, possibly negative
   pure real(dp) function mean_velocity(self)
      class(duty_state_t), intent(in) :: self
      mean_velocity = 0.5_dp*(self%speeds(1) + self%speeds(2))
   end function mean_velocity

   !> Compute time derivatives and displacements from times and values
   pure subroutine setup(self)
      class(duty_t), intent(inout) :: self
      integer :: n, k
      real(dp) :: before, after

      n = size(self%time)
      self%active = .true.
      allocate (self%slopes(n, quantities), self%displacement(n, 2), source=0.0_dp)
      if (self%cubic) then
         do k = 1, n
            ! slope of the parabola through a row and its neighbours
            if (k > 1 .and. k < n) then
               before = self%time(k) - self%time(k - 1)
               after = self%time(k + 1) - self%time(k)
               self%slopes(k, :) = parabola(self%values(k - 1, :), self%values(k, :), self%values(k + 1, :), before, after)
            else if (self%periodic) then
               before = self%time(n) - self%time(n - 1)
               after = self%time(2) - self%time(1)
               self%slopes(k, :) = parabola(self%values(n - 1, :), self%values(1, :), self%values(2, :), before, after)
            end if
         end do
         if (.not. self%periodic) then
            ! slope at the end of the parabola through three rows
            if (n == 2) then
               self%slopes = spread((self%values(2, :) - self%values(1, :))/self%time(2), 1, 2)
            else
               self%slopes(1, :) = 2.0_dp*(self%values(2, :) - self%values(1, :))/(self%time(2) - self%time(1)) - self%slopes(2, :)
               self%slopes(n, :) = 2.0_dp*(self%values(n, :) - self%values(n - 1, :))/(self%time(n) - self%time(n - 1)) &
                                   - self%slopes(n - 1, :)
            end if
         end if
      end if
      do k = 2, n
         self%displacement(k, :) = self%displacement(k - 1, :) + displacement_from(self, k - 1, self%time(k) - self%time(k - 1))
      end do
      do k = 1, n
         if (any(abs(self%values(k, :) - self%reference) > same) .or. any(abs(self%slopes(k, :)) > same)) exit
      end do
      if (k > n) self%constant_until = self%end_time()
      if (k > 1 .and. k <= n) self%constant_until = self%time(k - 1)
   end subroutine setup

   !> Whether no roughness moves and all quantities are those of the case, up to and at a time
   pure logical function is_constant(self, time)
      class(duty_t), intent(in) :: self
      real(dp), intent(in) :: time
      is_constant = .not. self%rough .and. self%constant_until >= 0.0_dp .and. time <= self%constant_until*(1.0_dp + 1.0e-9_dp)
   end function is_constant

   !> Slope of a parabola at the middle of three rows
   elemental real(dp) function parabola(a, b, c, before, after)
      real(dp), intent(in) :: a, b, c, before, after
      parabola = ((b - a)/before*after + (c - b)/after*before)/(before + after)
   end function parabola

   !> Displacements of the surfaces in a time after row k
   pure function displacement_from(self, k, time) result(displacement)
      class(duty_t), intent(in) :: self
      integer, intent(in) :: k
      real(dp), intent(in) :: time
      real(dp) :: displacement(2), s, step

      step = self%time(k + 1) - self%time(k)
      s = time/step
      associate (a => self%values(k, duty_u1:duty_u2), b => self%values(k + 1, duty_u1:duty_u2))
         if (self%cubic) then
            associate (c => step*self%slopes(k, duty_u1:duty_u2), d => step*self%slopes(k + 1, duty_u1:duty_u2))
               displacement = step*s*(a + s*(0.5_dp*c + s*((3.0_dp*(b - a) - 2.0_dp*c - d)/3.0_dp &
                                                           + s*(2.0_dp*(a - b) + c + d)/4.0_dp)))
            end associate
         else
            displacement = step*s*(a + 0.5_dp*s*(b - a))
         end if
      end associate
   end function displacement_from

   !> Values and displacements interpolated at a time within the table
   pure subroutine raw(self, time, values, displacement)
      class(duty_t), intent(in) :: self
      real(dp), intent(in) :: time
      real(dp), intent(out) :: values(quantities), displacement(2)
      real(dp) :: s, step
      integer :: k, low, high

      low = 1
      high = size(self%time)
      do while (high - low > 1)
         k = (low + high)/2
         if (self%time(k) <= time) then
            low = k
         else
            high = k
         end if
      end do
      k = low
      step = self%time(k + 1) - self%time(k)
      s = (time - self%time(k))/step
      associate (a => self%values(k, :), b => self%values(k + 1, :))
         if (self%cubic) then
            associate (c => step*self%slopes(k, :), d => step*self%slopes(k + 1, :))
               values = a + s*(c + s*(3.0_dp*(b - a) - 2.0_dp*c - d + s*(2.0_dp*(a - b) + c + d)))
            end associate
         else
            values = a + s*(b - a)
         end if
      end associate
      displacement = self%displacement(k, :) + displacement_from(self, k, time - self%time(k))
   end subroutine raw

   !> Conditions at a time; before the table they change linearly from the case to the first row
   pure function at(self, time) result(state)
      class(duty_t), intent(in) :: self
      real(dp), intent(in) :: time
      type(duty_state_t) :: state
      real(dp) :: values(quantities), fraction, whole
      integer :: n

      n = size(self%time)
      if (time < 0.0_dp) then
         fraction = min(1.0_dp, (time - self%begin())/ramp_time(self))
         values = self%reference + fraction*(self%values(1, :) - self%reference)
         state%displacements = 0.0_dp
      else if (self%periodic) then
         whole = aint(time/self%length())
         call self%raw(time - whole*self%length(), values, state%displacements)
         state%displacements = state%displacements + whole*self%displacement(n, :)
      else
         call self%raw(min(time, self%time(n)), values, state%displacements)
      end if
      state%load = values(duty_load)
      state%speeds = values(duty_u1:duty_u2)
      state%curvatures = 1.0_dp/values(duty_radius_x:duty_radius_y)
      state%viscosity = values(duty_viscosity)
      state%layer = values(duty_layer)
   end function at

   !> Length of the ramp before the table
   pure real(dp) function ramp_time(self)
      class(duty_t), intent(in) :: self
      ramp_time = ramp/max(1.0_dp, abs(0.5_dp*sum(self%values(1, duty_u1:duty_u2))))
   end function ramp_time

   !> Start time of the run: 0, or negative if the first row is not the case
   pure real(dp) function begin(self)
      class(duty_t), intent(in) :: self
      real(dp) :: speed

      begin = 0.0_dp
      if (all(abs(self%values(1, :) - self%reference) <= same)) return
      begin = -ramp_time(self)
      speed = abs(0.5_dp*sum(self%values(1, duty_u1:duty_u2)))
      if (speed > at_rest) begin = begin - follow/speed
   end function begin

   !> Time between the first and the last row
   pure real(dp) function length(self)
      class(duty_t), intent(in) :: self
      length = self%time(size(self%time))
   end function length

   !> End time of the run
   pure real(dp) function end_time(self)
      class(duty_t), intent(in) :: self
      end_time = merge(self%periods, 1, self%periodic)*self%length()
   end function end_time

   !> Whether the mean velocity is negative at a row
   pure logical function reverses(self)
      class(duty_t), intent(in) :: self
      reverses = any(self%values(:, duty_u1) + self%values(:, duty_u2) < 0.0_dp)
   end function reverses

   !> Maximum mean velocity over that of the case
   pure real(dp) function max_speed(self)
      class(duty_t), intent(in) :: self
      max_speed = maxval(abs(0.5_dp*(self%values(:, duty_u1) + self%values(:, duty_u2))))
   end function max_speed

   !> Approximate number of time steps on a mesh
   pure real(dp) function steps_expected(self, mesh)
      class(duty_t), intent(in) :: self
      real(dp), intent(in) :: mesh
      real(dp) :: time

      time = self%begin()
      if (self%is_constant(self%constant_until)) time = max(time, self%constant_until)
      steps_expected = (self%end_time() - time)*self%max_speed()/(self%step_factor*mesh)
   end function steps_expected

   !> Times of the next two rows after a given time, the second as if the table were repeated; huge after the last row
   pure function next_knot(self, time) result(knots)
      class(duty_t), intent(in) :: self
      real(dp), intent(in) :: time
      real(dp) :: knots(2), whole, local
      integer :: k, n
      real(dp), parameter :: rounding = 1.0e-9_dp

      n = size(self%time)
      if (time < -rounding*self%length()) then
         knots = [0.0_dp, self%time(2)]
         return
      end if
      whole = 0.0_dp
      if (self%periodic) whole = aint(time/self%length() + rounding)
      local = time - whole*self%length()
      do k = 2, n
         if (self%time(k) > local + rounding*self%length()) exit
      end do
      knots = huge(1.0_dp)
      if (k > n) return
      knots(1) = whole*self%length() + self%time(k)
      knots(2) = knots(1) + self%time(2)
      if (k < n) knots(2) = whole*self%length() + self%time(k + 1)
   end function next_knot
end module ehl_duty

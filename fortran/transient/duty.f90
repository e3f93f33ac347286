! SPDX-License-Identifier: BSD-3-Clause
!> The duty of a contact: load, speeds, radii, viscosity and layer of oil over time, each over its value in the case, which fixes
!> the scales (docs/theory/duty.md)
module ehl_duty
   use ehl_kinds, only: dp
   implicit none (type, external)
   private
   public :: duty_t, duty_state_t, duty_load, duty_u1, duty_u2, duty_radius_x, duty_radius_y, duty_viscosity, &
             duty_layer, quantities

   !> Places of the quantities
   integer, parameter :: duty_load = 1, duty_u1 = 2, duty_u2 = 3, duty_radius_x = 4, duty_radius_y = 5, duty_viscosity = 6, &
                         duty_layer = 7
   integer, parameter :: quantities = 7
   !> Before the table: time in which all quantities change from the case to its first row, and in which the film follows
   !> [a/u of the first row]
   real(dp), parameter :: ramp = 2.0_dp, settling = 4.0_dp
   !> Mean velocity of the first row over that of the case below which the film does not follow
   real(dp), parameter :: at_rest = 0.05_dp
   !> Relative difference below which a value is that of the case
   real(dp), parameter :: same = 1.0e-12_dp

   !> Conditions at a time, over the values of the case; speeds over the mean velocity of the case
   type :: duty_state_t
      real(dp) :: load = 1.0_dp, speeds(2) = 1.0_dp, viscosity = 1.0_dp, layer = 1.0_dp
      !> Curvatures along the motion and across it
      real(dp) :: curvatures(2) = 1.0_dp
      !> Displacements of the surfaces since the beginning of the table [a]
      real(dp) :: ways(2) = 0.0_dp
   contains
      procedure :: mean_velocity
   end type duty_state_t

   type :: duty_t
      !> Whether there is one
      logical :: active = .false.
      !> Whether rough surfaces move all the time
      logical :: rough = .false.
      !> Times [a/u] from 0 on, and values at them over those of the case (times, quantities)
      real(dp), allocatable :: time(:), values(:, :)
      logical :: cubic = .false., periodic = .false.
      integer :: periods = 1
      !> Time step over that by the mesh, target of the error of films by steps (0: none)
      real(dp) :: step_share = 1.0_dp, target_error = 0.0_dp
      !> [Pa] Newtonian stress of eta0 and H = 1 that slides with the mean velocity of the case
      real(dp) :: stress = 0.0_dp
      !> Oil layer rho H of the case; 0: the inlet is flooded
      real(dp) :: layer = 0.0_dp
      !> [s] a/u
      real(dp) :: time_scale = 0.0_dp
      !> The case itself
      real(dp) :: reference(quantities) = 1.0_dp
      !> Change with time at the nodes, for cubic interpolation; displacements of the surfaces there
      real(dp), allocatable, private :: slopes(:, :), way(:, :)
      !> Time until which all is as in the case, from the beginning on; before it: the first row is another state
      real(dp), private :: rest_ends = -1.0_dp
   contains
      procedure :: setup
      procedure :: at
      procedure :: rests
      procedure :: begin
      procedure :: end_time
      procedure :: length
      procedure :: reverses
      procedure :: fastest
      procedure :: next_knot
      procedure :: steps_expected
      procedure, private :: raw
   end type duty_t

contains

   !> Mean velocity over that of the case; it may be negative
   pure real(dp) function mean_velocity(self)
      class(duty_state_t), intent(in) :: self
      mean_velocity = 0.5_dp*(self%speeds(1) + self%speeds(2))
   end function mean_velocity

   !> Compute slopes and displacements from times and values
   pure subroutine setup(self)
      class(duty_t), intent(inout) :: self
      integer :: n, k
      real(dp) :: before, behind

      n = size(self%time)
      self%active = .true.
      allocate (self%slopes(n, quantities), self%way(n, 2), source=0.0_dp)
      if (self%cubic) then
         do k = 1, n
            ! of the parabola through a node and its neighbours
            if (k > 1 .and. k < n) then
               before = self%time(k) - self%time(k - 1)
               behind = self%time(k + 1) - self%time(k)
               self%slopes(k, :) = parabola(self%values(k - 1, :), self%values(k, :), self%values(k + 1, :), before, behind)
            else if (self%periodic) then
               before = self%time(n) - self%time(n - 1)
               behind = self%time(2) - self%time(1)
               self%slopes(k, :) = parabola(self%values(n - 1, :), self%values(1, :), self%values(2, :), before, behind)
            end if
         end do
         if (.not. self%periodic) then
            ! of the parabola through a node and the two beside it
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
         self%way(k, :) = self%way(k - 1, :) + part(self, k - 1, self%time(k) - self%time(k - 1))
      end do
      do k = 1, n
         if (any(abs(self%values(k, :) - self%reference) > same) .or. any(abs(self%slopes(k, :)) > same)) exit
      end do
      if (k > n) self%rest_ends = self%end_time()
      if (k > 1 .and. k <= n) self%rest_ends = self%time(k - 1)
   end subroutine setup

   !> Whether all quantities are those of the case up to and at a time
   pure logical function rests(self, time)
      class(duty_t), intent(in) :: self
      real(dp), intent(in) :: time
      rests = .not. self%rough .and. self%rest_ends >= 0.0_dp .and. time <= self%rest_ends*(1.0_dp + 1.0e-9_dp)
   end function rests

   !> Slope at the middle of three nodes
   elemental real(dp) function parabola(a, b, c, before, behind)
      real(dp), intent(in) :: a, b, c, before, behind
      parabola = ((b - a)/before*behind + (c - b)/behind*before)/(before + behind)
   end function parabola

   !> Displacements of the surfaces from node k on in a time
   pure function part(self, k, time) result(way)
      class(duty_t), intent(in) :: self
      integer, intent(in) :: k
      real(dp), intent(in) :: time
      real(dp) :: way(2), s, step

      step = self%time(k + 1) - self%time(k)
      s = time/step
      associate (a => self%values(k, duty_u1:duty_u2), b => self%values(k + 1, duty_u1:duty_u2))
         if (self%cubic) then
            associate (c => step*self%slopes(k, duty_u1:duty_u2), d => step*self%slopes(k + 1, duty_u1:duty_u2))
               way = step*s*(a + s*(0.5_dp*c + s*((3.0_dp*(b - a) - 2.0_dp*c - d)/3.0_dp + s*(2.0_dp*(a - b) + c + d)/4.0_dp)))
            end associate
         else
            way = step*s*(a + 0.5_dp*s*(b - a))
         end if
      end associate
   end function part

   !> Values and displacements by the table, at a time within it
   pure subroutine raw(self, time, values, way)
      class(duty_t), intent(in) :: self
      real(dp), intent(in) :: time
      real(dp), intent(out) :: values(quantities), way(2)
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
      way = self%way(k, :) + part(self, k, time - self%time(k))
   end subroutine raw

   !> Conditions at a time; before the table they change from the case to its first row
   pure function at(self, time) result(state)
      class(duty_t), intent(in) :: self
      real(dp), intent(in) :: time
      type(duty_state_t) :: state
      real(dp) :: values(quantities), share, whole
      integer :: n

      n = size(self%time)
      if (time < 0.0_dp) then
         share = min(1.0_dp, (time - self%begin())/ramp_time(self))
         values = self%reference + share*(self%values(1, :) - self%reference)
         state%ways = 0.0_dp
      else if (self%periodic) then
         whole = aint(time/self%length())
         call self%raw(time - whole*self%length(), values, state%ways)
         state%ways = state%ways + whole*self%way(n, :)
      else
         call self%raw(min(time, self%time(n)), values, state%ways)
      end if
      state%load = values(duty_load)
      state%speeds = values(duty_u1:duty_u2)
      state%curvatures = 1.0_dp/values(duty_radius_x:duty_radius_y)
      state%viscosity = values(duty_viscosity)
      state%layer = values(duty_layer)
   end function at

   !> Time of the ramp before the table
   pure real(dp) function ramp_time(self)
      class(duty_t), intent(in) :: self
      ramp_time = ramp/max(1.0_dp, abs(0.5_dp*sum(self%values(1, duty_u1:duty_u2))))
   end function ramp_time

   !> Time at which the run begins: 0, or before where the first row is not the case
   pure real(dp) function begin(self)
      class(duty_t), intent(in) :: self
      real(dp) :: speed

      begin = 0.0_dp
      if (all(abs(self%values(1, :) - self%reference) <= same)) return
      begin = -ramp_time(self)
      speed = abs(0.5_dp*sum(self%values(1, duty_u1:duty_u2)))
      if (speed > at_rest) begin = begin - settling/speed
   end function begin

   !> Time from the first row to the last
   pure real(dp) function length(self)
      class(duty_t), intent(in) :: self
      length = self%time(size(self%time))
   end function length

   !> Time at which the run ends
   pure real(dp) function end_time(self)
      class(duty_t), intent(in) :: self
      end_time = merge(self%periods, 1, self%periodic)*self%length()
   end function end_time

   !> Whether the mean velocity is negative at a row
   pure logical function reverses(self)
      class(duty_t), intent(in) :: self
      reverses = any(self%values(:, duty_u1) + self%values(:, duty_u2) < 0.0_dp)
   end function reverses

   !> Largest mean velocity over that of the case
   pure real(dp) function fastest(self)
      class(duty_t), intent(in) :: self
      fastest = maxval(abs(0.5_dp*(self%values(:, duty_u1) + self%values(:, duty_u2))))
   end function fastest

   !> About how many time steps there are on a mesh
   pure real(dp) function steps_expected(self, mesh)
      class(duty_t), intent(in) :: self
      real(dp), intent(in) :: mesh
      real(dp) :: time

      time = self%begin()
      if (self%rests(self%rest_ends)) time = max(time, self%rest_ends)
      steps_expected = (self%end_time() - time)*self%fastest()/(self%step_share*mesh)
   end function steps_expected

   !> Time of the next row after a given time, and of the one after that; a very late one after the last
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

! SPDX-License-Identifier: BSD-3-Clause
!> Far field beyond the border of the domain: the pressure of a fully flooded contact, and the load that it sustains there.
!>
!> Far from the contact the bodies count as rigid, the lubricant has the properties at P = 0, and H = r^2 f/2 has no length scale,
!> with f = cos^2 + D sin^2 of the angle from the inlet direction, so that P = lambda_bar g(angle)/r^3. The Reynolds equation then
!> is (f^3 g')' - 9 f^3 g = -8 cos(angle) with the solution g = 4 cos(angle)/((3 + 2 D) f^2) + amplitude u(angle), (f^3 u')' = 9 f^3
!> u; in a round contact f = 1 and u = cosh(3 angle). The first term is that of Kapitza (1955), exact with r/(4 H^2) in place of
!> 1/(r^3 f^2) also where H = c + r^2 f/2; with the second term g and g' vanish where the film ruptures. Further terms decay with
!> the sixth power of the distance. In the rows of a wide contact the inlet border has the pressure of ehl_wide_inlet.
module ehl_far_field
   use ehl_contact, only: contact_t
   use ehl_grid, only: grid_t
   use ehl_kinds, only: dp, pi
   use ehl_level, only: cavity_pressure, level_t
   use ehl_line_inlet, only: row_flow, set_line_border
   use ehl_wide_inlet, only: inlet_integral, reduced_to_real
   implicit none (type, external)
   private
   public :: far_field_t

   !> Round contact: angle from the inlet at which the film ruptures, tan(angle) = -3 tanh(3 angle), and the amplitude of
   !> cosh(3 angle) for which pressure and slope vanish there
   real(dp), parameter :: round_rupture = 1.8925539054585183_dp, round_amplitude = 1.7311986173015447e-03_dp
   !> Steps from 0 to pi in the table of u, which increases by 0.1 % per step in a round contact, by up to 2 % for D = 250
   integer, parameter :: steps = 8000
   !> Quadrature points of the integral beyond the border: angles, and inverse distances
   integer, parameter :: angles = 64, distances = 8

   type :: far_field_t
      private
      !> Whether the contact is an infinite line (see ehl_line_inlet)
      logical :: line = .false.
      !> Whether the contact is so wide that its inlet is that of a line contact in each row; half its width
      logical :: wide = .false.
      real(dp) :: half_width = 1.0_dp
      !> D = R_x/R_y; angle at which the film ruptures; amplitude of u
      real(dp) :: radius_ratio = 1.0_dp, rupture = round_rupture, amplitude = round_amplitude
      !> u at equal steps of the angle; not allocated in a round contact
      real(dp), allocatable :: u(:)
   contains
      procedure :: setup
      procedure :: set_border
      procedure, private :: set_wide_inlet
      procedure, private :: pressure
      procedure, private :: around
      procedure, private :: opening
      procedure, private :: load_beyond
   end type far_field_t

contains

   !> Set up the part that does not depend on the grid
   pure subroutine setup(self, contact)
      class(far_field_t), intent(inout) :: self
      class(contact_t), intent(in) :: contact
      real(dp) :: state(2), k(2, 4), angle, ratio, step
      integer :: n

      self%line = contact%is_line()
      self%wide = contact%is_wide()
      self%half_width = contact%reach(2)
      self%radius_ratio = contact%radius_ratio
      if (contact%is_round() .or. self%line) return
      if (allocated(self%u)) deallocate (self%u)
      allocate (self%u(0:steps))
      step = pi/steps
      state = [1.0_dp, 0.0_dp]
      self%amplitude = 0.0_dp
      do n = 0, steps
         angle = n*step
         self%u(n) = state(1)
         ! the smallest amplitude with g >= 0 everywhere: g and g' vanish at the rupture
         ratio = -4.0_dp*cos(angle)/((3.0_dp + 2.0_dp*self%radius_ratio)*self%opening(angle)**2*state(1))
         if (ratio > self%amplitude) then
            self%amplitude = ratio
            self%rupture = angle
         end if
         k(:, 1) = slope(state, angle)
         k(:, 2) = slope(state + 0.5_dp*step*k(:, 1), angle + 0.5_dp*step)
         k(:, 3) = slope(state + 0.5_dp*step*k(:, 2), angle + 0.5_dp*step)
         k(:, 4) = slope(state + step*k(:, 3), angle + step)
         state = state + step*(k(:, 1) + 2.0_dp*k(:, 2) + 2.0_dp*k(:, 3) + k(:, 4))/6.0_dp
      end do

   contains

      !> Derivatives of u and of f^3 u' with respect to the angle
      pure function slope(at, angle) result(change)
         real(dp), intent(in) :: at(2), angle
         real(dp) :: change(2)
         change = [at(2)/self%opening(angle)**3, 9.0_dp*self%opening(angle)**3*at(1)]
      end function slope
   end subroutine setup

   !> Set the pressure of a flooded contact on the border, and the load of the nodes: the total load minus that beyond the border
   subroutine set_border(self, level, load)
      class(far_field_t), intent(in) :: self
      type(level_t), intent(inout) :: level
      !> Load of the contact, iint P dX dY
      real(dp), intent(in) :: load
      real(dp) :: speed_parameter
      integer :: i, j

      if (self%line) then
         call set_line_border(level, load)
         return
      end if
      speed_parameter = 1.0_dp/level%flow%inverse_speed
      associate (grid => level%grid)
         do j = 1, grid%ny
            do i = 1, grid%nx, merge(1, grid%nx - 1, grid%is_border(j))
               level%p(i, j) = speed_parameter*self%pressure(grid%x(i), grid%y(j), level%h(i, j))
            end do
         end do
         if (self%wide) call self%set_wide_inlet(level, speed_parameter)
         j = 1 + nint((0.0_dp - grid%y0)/grid%hy)
         level%load = load - speed_parameter*self%load_beyond(grid, level%h(1, j) - 0.5_dp*grid%x0**2)
      end associate
   end subroutine set_border

   !> Set the pressure on the inlet border within the width of the dry contact: that of a line contact times the ratio of the
   !> pressures far away, which is the effect of the flow across the motion
   subroutine set_wide_inlet(self, level, speed_parameter)
      class(far_field_t), intent(in) :: self
      type(level_t), intent(inout) :: level
      !> lambda_bar
      real(dp), intent(in) :: speed_parameter
      real(dp) :: x, y, width, ratio, reduced, alpha
      integer :: j

      alpha = level%lubricant%initial_slope()
      associate (grid => level%grid)
         x = abs(grid%x0)
         do j = 1, grid%ny
            y = grid%y(j)
            width = 1.0_dp - (y/self%half_width)**2
            if (grid%is_border(j) .or. .not. (width > 0.0_dp .and. x**2 > width)) cycle
            ratio = 0.75_dp*hypot(1.0_dp, y/x)*self%around(atan2(abs(y), x))
            ! in the first cycles the flow may exceed the film at the border
            reduced = speed_parameter*ratio*inlet_integral(x, level%h(1, j), row_flow(level, j), width)
            level%p(1, j) = max(cavity_pressure, reduced_to_real(reduced, alpha))
         end do
      end associate
   end subroutine set_wide_inlet

   !> Pressure far from the contact over lambda_bar: r/(4 H^2) f^2 g
   pure real(dp) function pressure(self, x, y, film)
      class(far_field_t), intent(in) :: self
      real(dp), intent(in) :: x, y, film
      pressure = 0.25_dp*hypot(x, y)/film**2*self%around(atan2(abs(y), -x))
   end function pressure

   !> f^2 g as a function of the angle from the inlet
   pure real(dp) function around(self, angle)
      class(far_field_t), intent(in) :: self
      real(dp), intent(in) :: angle
      integer :: n
      real(dp) :: t

      around = 0.0_dp
      if (.not. angle < self%rupture) return
      if (allocated(self%u)) then
         t = angle/pi*steps
         n = min(int(t), steps - 1)
         t = t - n
         around = 4.0_dp/(3.0_dp + 2.0_dp*self%radius_ratio)*cos(angle) &
                  + self%amplitude*((1.0_dp - t)*self%u(n) + t*self%u(n + 1))*self%opening(angle)**2
      else
         around = 0.8_dp*cos(angle) + self%amplitude*cosh(3.0_dp*angle)
      end if
   end function around

   !> f: the gap of the rigid bodies over r^2/2
   pure real(dp) function opening(self, angle)
      class(far_field_t), intent(in) :: self
      real(dp), intent(in) :: angle
      opening = cos(angle)**2 + self%radius_ratio*sin(angle)**2
   end function opening

   !> Load beyond the cells of the grid over lambda_bar, H = c + r^2 f/2: with s = 1/r the integral over the angle of
   !> g int ds/(1 + 2 c/f s^2)^2 from s = 0 to the border
   pure real(dp) function load_beyond(self, grid, c)
      class(far_field_t), intent(in) :: self
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: c
      real(dp) :: angle, inlet, outlet, side, last, s, sum_s, f
      integer :: k, l

      inlet = -(grid%x0 - 0.5_dp*grid%hx)
      outlet = grid%x(grid%nx) + 0.5_dp*grid%hx
      side = grid%y(grid%ny) + 0.5_dp*grid%hy
      load_beyond = 0.0_dp
      do k = 1, angles
         angle = (k - 0.5_dp)/angles*self%rupture
         f = 1.0_dp
         if (allocated(self%u)) f = self%opening(angle)
         last = max(cos(angle)/inlet, sin(angle)/side, -cos(angle)/outlet)
         sum_s = 0.0_dp
         do l = 1, distances
            s = (l - 0.5_dp)/distances*last
            sum_s = sum_s + last/(1.0_dp + 2.0_dp*(c/f)*s**2)**2
         end do
         load_beyond = load_beyond + self%around(angle)/f**2*sum_s
      end do
      load_beyond = load_beyond*2.0_dp*self%rupture/(angles*distances)
   end function load_beyond
end module ehl_far_field

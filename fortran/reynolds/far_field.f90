! SPDX-License-Identifier: BSD-3-Clause
!> What lies beyond the border of the domain: the pressure of a fully flooded contact, and the load that it carries there.
!>
!> Far away the bodies are rigid, the lubricant is that at P = 0, and H = r^2/2 has no length of its own, so that
!> P = lambda_bar g(angle)/r^3. The Reynolds equation then is g'' - 9 g = -8 cos(angle), the angle counted from the inlet,
!> with the solution g = 0.8 cos(angle) + share cosh(3 angle). The first part is that of Kapitza (1955), exact as
!> r/(4 H^2) also where H = c + r^2/2; the second one lets g and g' vanish where the film ruptures. What else a contact
!> adds dies away with the sixth power of the distance.
module ehl_far_field
   use ehl_grid, only: grid_t
   use ehl_kinds, only: dp, pi
   use ehl_level, only: level_t
   implicit none (type, external)
   private
   public :: set_far_field

   !> Angle from the inlet at which the film ruptures, tan(angle) = -3 tanh(3 angle), and the share of cosh(3 angle) that
   !> lets pressure and slope vanish there
   real(dp), parameter :: rupture = 1.8925539054585183_dp, share = 1.7311986173015447e-03_dp
   !> Angles, and points along the inverse distance, of the integral beyond the border
   integer, parameter :: angles = 64, distances = 8

contains

   !> Give the border the pressure of a flooded contact, and leave to the nodes the load that is not carried beyond it
   subroutine set_far_field(level, load)
      type(level_t), intent(inout) :: level
      !> Load of the contact, iint P dX dY
      real(dp), intent(in) :: load
      real(dp) :: speed_parameter
      integer :: i, j

      speed_parameter = 1.0_dp/level%flow%inverse_speed
      associate (grid => level%grid)
         do j = 1, grid%ny
            do i = 1, grid%nx, merge(1, grid%nx - 1, grid%is_border(j))
               level%p(i, j) = speed_parameter*pressure(grid%x(i), grid%y(j), level%h(i, j))
            end do
         end do
         j = 1 + nint((0.0_dp - grid%y0)/grid%hy)
         level%load = load - speed_parameter*load_beyond(grid, level%h(1, j) - 0.5_dp*grid%x0**2)
      end associate
   end subroutine set_far_field

   !> Pressure far from the contact over lambda_bar: r/(4 H^2) g
   pure real(dp) function pressure(x, y, film)
      real(dp), intent(in) :: x, y, film
      pressure = 0.25_dp*hypot(x, y)/film**2*around(atan2(abs(y), -x))
   end function pressure

   !> g: what the pressure is around the contact, by the angle from the inlet
   pure real(dp) function around(angle)
      real(dp), intent(in) :: angle
      around = 0.0_dp
      if (angle < rupture) around = 0.8_dp*cos(angle) + share*cosh(3.0_dp*angle)
   end function around

   !> Load beyond the cells of the grid over lambda_bar, H = c + r^2/2: with u = 1/r the integral over the angle of
   !> g int du/(1 + 2 c u^2)^2 from 0 to the border
   pure real(dp) function load_beyond(grid, c)
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: c
      real(dp) :: angle, inlet, outlet, side, last, u, along
      integer :: k, l

      inlet = -(grid%x0 - 0.5_dp*grid%hx)
      outlet = grid%x(grid%nx) + 0.5_dp*grid%hx
      side = grid%y(grid%ny) + 0.5_dp*grid%hy
      load_beyond = 0.0_dp
      do k = 1, angles
         angle = (k - 0.5_dp)/angles*rupture
         last = max(cos(angle)/inlet, sin(angle)/side, -cos(angle)/outlet)
         along = 0.0_dp
         do l = 1, distances
            u = (l - 0.5_dp)/distances*last
            along = along + last/(1.0_dp + 2.0_dp*c*u**2)**2
         end do
         load_beyond = load_beyond + around(angle)*along
      end do
      load_beyond = load_beyond*2.0_dp*rupture/(angles*distances)
   end function load_beyond
end module ehl_far_field

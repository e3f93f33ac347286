! SPDX-License-Identifier: BSD-3-Clause
!> Temperature of two walls that move through the heat source of a contact, row by row along the motion, and of the film
!> between them
!>
!> A wall of conductivity k [W/(m K)] and diffusivity kappa [m^2/s] that moves at u [m/s] under the heat flux q(x) [W/m^2]:
!>
!>    rise(x) = 1/k sqrt(kappa/(pi u)) int q(x')/sqrt(x - x') dx',   x' < x                                            (1)
!>
!> (Carslaw & Jaeger 1959, section 10.7), exact for large u a/(2 kappa), where heat is conducted normal to the wall alone.
!> Otherwise u is increased by a constant times kappa/a, such that the maximum temperature rise of a wall at rest is that under
!> a Hertz contact (for a circle as in Tian & Kennedy 1994, J. Tribol. 116, 167; by more under a narrow contact, see
!> raised_speed). The heat is constant over each cell of a row, and integrated exactly.
!>
!> Of the heat q = q_1 + q_2, generated uniformly across the film thickness h, wall 1 receives
!>
!>    q_1 = q/2 + k_f (T_2 - T_1)/h                                                                                    (2)
!>
!> and the mean temperature across the film of conductivity k_f is (T_1 + T_2)/2 + q h/(12 k_f).
module ehl_wall_heat
   use ehl_contact, only: contact_t
   use ehl_heat, only: raised_speed
   use ehl_kinds, only: dp, pi
   implicit none (type, external)
   private
   public :: wall_heat_t, wall_strength, speed_of_rest, heat_source, heat_response_t

   !> Maximum over s of int sqrt(1 - x^2)/sqrt(s - x) dx, x from -1 to s
   real(dp), parameter :: fast_integral = 2.18830_dp

   !> Number of partial sums in `history`
   integer, parameter :: side_by_side = 16

   !> A row of equidistant nodes between two walls
   type :: wall_heat_t
      !> Temperature rise of each wall at a node by unit heat of its own cell [K m^2/W]
      real(dp) :: own(2) = 0.0_dp
      !> Rise by unit heat of an upstream cell over that of the own cell: element n - m for the cell m nodes upstream
      real(dp), allocatable :: upstream(:)
   contains
      procedure :: start
      procedure :: history
      procedure :: response
   end type wall_heat_t

   !> Response to the heat q [W/m^2] of a cell at this cell; a value v is linear in q: v(1) + v(2) q
   type :: heat_response_t
      !> Heat into wall 1 minus that into wall 2 [W/m^2], mean temperature rise across the film [K]
      real(dp) :: difference(2) = 0.0_dp, film(2) = 0.0_dp
   end type heat_response_t

contains

   !> 1/k sqrt(kappa/(pi u)) of a wall [K m^(3/2)/W]; rest: see speed_of_rest, length: a [m], potential: see heat_source
   pure real(dp) function wall_strength(speed, conductivity, diffusivity, rest, length, potential)
      real(dp), intent(in) :: speed, conductivity, diffusivity, rest, length, potential
      wall_strength = sqrt(diffusivity/(pi*raised_speed(abs(speed), rest*diffusivity/length, potential)))/conductivity
   end function wall_strength

   !> Speed over kappa/a at which (1) has the maximum temperature rise of a wall at rest under a semi-ellipsoidal heat source,
   !> a q l/(2 pi k), l = iint P/r at the centre; about 2.47 for a circle
   pure real(dp) function speed_of_rest(contact)
      class(contact_t), intent(in) :: contact
      real(dp) :: half, potential

      ! under an infinite line contact the temperature of a wall at rest has no limit
      speed_of_rest = 0.0_dp
      if (contact%is_line()) return
      call find_source(contact, half, potential)
      speed_of_rest = half*(2.0_dp*pi*fast_integral/potential)**2/pi
   end function speed_of_rest

   !> Data of a contact for flash_temperature: half its length along the motion, through its centre [a], and
   !> iint P/r at the centre over that of a circle of this radius; of an infinite line 1 and huge()
   pure function heat_source(contact) result(source)
      class(contact_t), intent(in) :: contact
      real(dp) :: source(2)
      real(dp) :: half, potential

      source = 1.0_dp
      if (contact%is_round()) return
      if (contact%is_line()) then
         source(2) = huge(1.0_dp)
         return
      end if
      call find_source(contact, half, potential)
      source = [half, potential/(0.5_dp*pi**2*half)]
   end function heat_source

   !> Half the length of a contact along the motion, through its centre [a]; iint P/r at the centre [a]
   pure subroutine find_source(contact, half, potential)
      class(contact_t), intent(in) :: contact
      real(dp), intent(out) :: half, potential
      real(dp) :: pressure(1), x

      potential = -contact%dry_separation/contact%kernel_factor
      x = 0.5_dp*min(1.0_dp, contact%ellipticity)
      call contact%pressure_row([x], 0.0_dp, pressure)
      half = x/sqrt(1.0_dp - pressure(1)**2)
   end subroutine find_source

   !> Prepare a row of n nodes at a distance `step` [m], between walls of these strengths
   pure subroutine start(self, n, step, strengths)
      class(wall_heat_t), intent(inout) :: self
      integer, intent(in) :: n
      real(dp), intent(in) :: step, strengths(2)
      integer :: m

      self%own = 2.0_dp*strengths*sqrt(0.5_dp*step)
      if (allocated(self%upstream)) deallocate (self%upstream)
      allocate (self%upstream(n - 1))
      do m = 1, n - 1
         self%upstream(n - m) = sqrt(2.0_dp*m + 1.0_dp) - sqrt(2.0_dp*m - 1.0_dp)
      end do
   end subroutine start

   !> Temperature rise [K] at node i by the heat into a wall [W/m^2] at the upstream nodes from `first` to `last`
   pure real(dp) function history(self, wall, heat, first, last, i)
      class(wall_heat_t), intent(in) :: self
      integer, intent(in) :: wall, first, last, i
      real(dp), contiguous, intent(in) :: heat(:)
      !> Several partial sums, whose additions do not depend on each other
      real(dp) :: parts(side_by_side)
      integer :: shift, k, rest

      shift = size(self%upstream) + 1 - i
      rest = first + mod(last - first + 1, side_by_side) - 1
      parts = 0.0_dp
      do k = first, rest
         parts(1) = parts(1) + self%upstream(shift + k)*heat(k)
      end do
      do k = rest + 1, last, side_by_side
         parts = parts + self%upstream(shift + k:shift + k + side_by_side - 1)*heat(k:k + side_by_side - 1)
      end do
      history = self%own(wall)*sum(parts)
   end function history

   !> Response to the heat of a cell; before: temperature rises of the walls by the heat upstream [K], film: h [m],
   !> conductivity: k_f [W/(m K)]
   pure type(heat_response_t) function response(self, before, film, conductivity)
      class(wall_heat_t), intent(in) :: self
      real(dp), intent(in) :: before(2), film, conductivity
      real(dp) :: g, divisor

      g = 2.0_dp*conductivity/film
      divisor = 1.0_dp + 0.5_dp*g*sum(self%own)
      associate (own => self%own)
         response%difference = g*[before(2) - before(1), 0.5_dp*(own(2) - own(1))]/divisor
         response%film = 0.25_dp*(own(1) - own(2))*response%difference + &
                         [0.5_dp*sum(before), 0.25_dp*sum(own) + film/(12.0_dp*conductivity)]
      end associate
   end function response
end module ehl_wall_heat

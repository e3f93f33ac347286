! SPDX-License-Identifier: BSD-3-Clause
!> The infinite line contact: a cylinder on a flat (Hertz 1882; Johnson 1985, section 4.2 c). Loads and
!> areas are per unit length.
!>
!> Lengths are scaled by the half width b = sqrt(8 w R/(pi E')), w the load per unit length; p_h = 2 w/(pi b). The deflection is
!> -(1/pi) int P ln|X - X'| dX', the mean over Y of k_b iint P/r with k_b = 1/(2 pi). A line contact has no
!> absolute deflection: H00 belongs to a kernel that is zero at |X - X'| = 1. M and L are those of a line contact (Moes 2000),
!> defined differently from those of a point contact:
!>
!>    M = w/(E' R) (2U)^(-1/2),  L = G (2U)^(1/4),  alpha_bar = L sqrt(M/(2 pi)),  lambda_bar = 3 pi^2/(8 M^2)
module ehl_line
   use ehl_contact, only: contact_t
   use ehl_kinds, only: dp, pi
   use ehl_moes, only: operating_t, round_load
   use ehl_scales, only: scales_t
   implicit none (type, external)
   private
   public :: new_line_contact

   type, extends(contact_t) :: line_t
   contains
      procedure :: scales
      procedure :: moes_load
      procedure :: operating
      procedure :: film_formula
      procedure :: area
      procedure :: flash_area
      procedure :: gap_row
      procedure :: pressure_row
   end type line_t

contains

   !> The line contact
   pure function new_line_contact() result(contact)
      type(line_t) :: contact

      contact%dimensions = 1
      ! R_x/R_y
      contact%radius_ratio = 0.0_dp
      contact%load = 0.5_dp*pi
      contact%kernel_factor = 0.5_dp/pi
      ! the pressure sqrt(1 - X^2) causes the deflection (1 + 2 ln 2)/4 at X = 0
      contact%dry_separation = -0.25_dp - 0.5_dp*log(2.0_dp)
   end function new_line_contact

   !> b, b^2/R and p_h from the load per unit length [N/m]
   pure function scales(self, load, radius, reduced_modulus)
      class(line_t), intent(in) :: self
      real(dp), intent(in) :: load, radius, reduced_modulus
      type(scales_t) :: scales

      associate (unused => self)
      end associate
      scales%length = sqrt(8.0_dp*load*radius/(pi*reduced_modulus))
      scales%pressure = 2.0_dp*load/(pi*scales%length)
      scales%film = scales%length**2/radius
   end function scales

   !> M from the load per unit length [N/m]
   pure real(dp) function moes_load(self, load, radius, reduced_modulus, speed)
      class(line_t), intent(in) :: self
      real(dp), intent(in) :: load, radius, reduced_modulus, speed

      associate (unused => self)
      end associate
      moes_load = load/(reduced_modulus*radius)*(2.0_dp*speed)**(-0.5_dp)
   end function moes_load

   !> Operating point from M and L of the line contact
   pure function operating(self, moes_m, moes_l) result(point)
      class(line_t), intent(in) :: self
      real(dp), intent(in) :: moes_m, moes_l
      type(operating_t) :: point

      associate (unused => self)
      end associate
      point%moes_m = moes_m
      point%moes_l = moes_l
      point%alpha_bar = moes_l*sqrt(moes_m/(2.0_dp*pi))
      point%speed_parameter = 3.0_dp*pi**2/(8.0_dp*moes_m**2)
      point%round_m = round_load(point%speed_parameter)
   end function operating

   !> Central film of an incompressible lubricant by Moes (1992), scaled by b^2/R: the film (h/R)(2U)^(-1/2) is 8 M H/pi
   pure real(dp) function film_formula(self, moes_m, moes_l)
      class(line_t), intent(in) :: self
      real(dp), intent(in) :: moes_m, moes_l
      real(dp) :: rigid, elastic, s

      associate (unused => self)
      end associate
      rigid = 3.0_dp/moes_m
      elastic = 2.62105_dp*moes_m**(-0.2_dp)
      s = (7.0_dp + 8.0_dp*exp(-2.0_dp*elastic/rigid))/5.0_dp
      film_formula = (rigid**(7.0_dp/3.0_dp) + elastic**(7.0_dp/3.0_dp))**(3.0_dp*s/7.0_dp)
      if (moes_l > 0.0_dp) then
         rigid = 1.28666_dp*moes_l**(2.0_dp/3.0_dp)
         elastic = 1.31106_dp*moes_m**(-0.125_dp)*moes_l**0.75_dp
         film_formula = film_formula + (rigid**(-3.5_dp) + elastic**(-3.5_dp))**(-2.0_dp*s/7.0_dp)
      end if
      film_formula = film_formula**(1.0_dp/s)*pi/(8.0_dp*moes_m)
   end function film_formula

   !> Area of the dry contact per unit length: its width 2 b
   pure real(dp) function area(self)
      class(line_t), intent(in) :: self

      associate (unused => self)
      end associate
      area = 2.0_dp
   end function area

   !> Area per unit length over which the mean of the Hertz pressure is 2/3 of its maximum, as in a circular contact
   pure real(dp) function flash_area(self, length)
      class(line_t), intent(in) :: self
      real(dp), intent(in) :: length

      associate (unused => self)
      end associate
      flash_area = 0.75_dp*pi*length
   end function flash_area

   !> X^2/2
   pure subroutine gap_row(self, x, y, values)
      class(line_t), intent(in) :: self
      real(dp), intent(in) :: x(:), y
      real(dp), intent(out) :: values(:)

      associate (unused => self, unused_y => y)
      end associate
      values = 0.5_dp*x**2
   end subroutine gap_row

   !> sqrt(1 - X^2), zero outside
   pure subroutine pressure_row(self, x, y, values)
      class(line_t), intent(in) :: self
      real(dp), intent(in) :: x(:), y
      real(dp), intent(out) :: values(:)

      associate (unused => self, unused_y => y)
      end associate
      values = sqrt(max(0.0_dp, 1.0_dp - x**2))
   end subroutine pressure_row
end module ehl_line

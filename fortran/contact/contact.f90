! SPDX-License-Identifier: BSD-3-Clause
!> The macroscopic contact: shape of the two bodies and the load on them. The base type is a ball on a flat (Hertz 1881);
!> other shapes extend it (ehl_contact_factory creates them). Lengths, films and pressures are scaled (ehl_scales).
module ehl_contact
   use ehl_film_formula, only: film_central_formula
   use ehl_kinds, only: dp, pi
   use ehl_moes, only: operating_from_moes, operating_t
   use ehl_scales, only: circle_factor, scales_from_si, scales_t
   implicit none (type, external)
   private
   public :: contact_t

   real(dp), parameter :: wide = 4.0_dp

   type :: contact_t
      !> Integrals over the contact are in a^2, or for a line contact in b
      integer :: dimensions = 2
      !> Semi-axis of the dry contact across the motion over that along it, of a roller half its length over b; D = R_x/R_y
      real(dp) :: ellipticity = 1.0_dp, radius_ratio = 1.0_dp
      !> Angle of the principal axes against X and Y [rad], counter-clockwise; half lengths of the dry contact along X and Y
      real(dp) :: angle = 0.0_dp, reach(2) = 1.0_dp
      !> iint P dX dY; k_b of the deflection k_b iint P/r; H00 of the dry contact
      real(dp) :: load = 2.0_dp*pi/3.0_dp, kernel_factor = circle_factor, dry_separation = -1.0_dp
      !> Equivalent contact, with axes along X and Y and the same curvatures along them: radius along X
      !> over R_x, ratio of the radii, kappa k_b over that of a circle
      real(dp) :: radius = 1.0_dp, ratio = 1.0_dp, kernel_ratio = 1.0_dp
   contains
      procedure :: is_round
      procedure :: is_even
      procedure :: is_wide
      procedure :: is_line
      procedure :: is_roller
      procedure :: growth
      procedure :: scales
      procedure :: moes_load
      procedure :: operating
      procedure :: film_formula
      procedure :: area
      procedure :: flash_area
      procedure :: gap_row
      procedure :: pressure_row
   end type contact_t

contains

   !> Whether the contact is rotationally symmetric
   pure logical function is_round(self)
      class(contact_t), intent(in) :: self
      is_round = .not. abs(self%radius_ratio - 1.0_dp) > 0.0_dp
   end function is_round

   !> Whether Y > 0 is the mirror image of Y < 0
   pure logical function is_even(self)
      class(contact_t), intent(in) :: self
      is_even = .not. abs(self%angle) > 0.0_dp
   end function is_even

   !> Whether it is an ellipse more than four times as wide as long along the motion
   pure logical function is_wide(self)
      class(contact_t), intent(in) :: self
      is_wide = self%reach(2) > wide*self%reach(1) .and. .not. (self%is_line() .or. self%is_roller())
   end function is_wide

   !> Whether it is an infinite line contact, whose values are per unit length
   pure logical function is_line(self)
      class(contact_t), intent(in) :: self
      is_line = self%dimensions == 1
   end function is_line

   !> Whether the bodies end across the motion, at the sides of the domain
   pure logical function is_roller(self)
      class(contact_t), intent(in) :: self

      associate (unused => self)
      end associate
      is_roller = .false.
   end function is_roller

   !> Half width of the dry contact along X at a load and a curvature; all three over their values in the case
   elemental real(dp) function growth(self, load, curvature)
      class(contact_t), intent(in) :: self
      real(dp), intent(in) :: load, curvature

      growth = (load/curvature)**(1.0_dp/merge(2.0_dp, 3.0_dp, self%is_line() .or. self%is_roller()))
   end function growth

   !> The scales of the contact in SI units
   pure function scales(self, load, radius, reduced_modulus)
      class(contact_t), intent(in) :: self
      !> Load [N], of a line contact per unit length [N/m]; reduced radius R_x in the plane of the motion [m], reduced modulus E'
      !> [Pa], 2/E' = sum (1 - nu^2)/E
      real(dp), intent(in) :: load, radius, reduced_modulus
      type(scales_t) :: scales
      scales = scales_from_si(load, radius, reduced_modulus, self%ellipticity, self%kernel_factor)
   end function scales

   !> Moes load parameter M with R_x
   pure real(dp) function moes_load(self, load, radius, reduced_modulus, speed)
      class(contact_t), intent(in) :: self
      !> As in `scales`; U = eta0 u/(E' R)
      real(dp), intent(in) :: load, radius, reduced_modulus, speed

      associate (unused => self)
      end associate
      moes_load = load/(reduced_modulus*radius**2)*(2.0_dp*speed)**(-0.75_dp)
   end function moes_load

   !> Operating point from M and L
   pure function operating(self, moes_m, moes_l) result(point)
      class(contact_t), intent(in) :: self
      real(dp), intent(in) :: moes_m, moes_l
      type(operating_t) :: point
      point = operating_from_moes(moes_m, moes_l, self%ellipticity, self%kernel_factor)
   end function operating

   !> Area of the dry contact [a^dimensions]
   pure real(dp) function area(self)
      class(contact_t), intent(in) :: self
      area = pi*self%ellipticity
   end function area

   !> Area [m^2] over which the mean of a Hertz pressure is 2/3 of its maximum; length: scale of lengths [m]
   pure real(dp) function flash_area(self, length)
      class(contact_t), intent(in) :: self
      real(dp), intent(in) :: length
      flash_area = pi*length**2*self%ellipticity
   end function flash_area

   !> Gap of the undeformed bodies in the columns x of a row at y, 0 where they touch: X^2/2 + Y^2/2
   pure subroutine gap_row(self, x, y, values)
      class(contact_t), intent(in) :: self
      !> Shape (nx)
      real(dp), intent(in) :: x(:), y
      real(dp), intent(out) :: values(:)

      associate (unused => self)
      end associate
      values = 0.5_dp*(x**2 + y**2)
   end subroutine gap_row

   !> Pressure of the dry contact in the columns x of a row at y: sqrt(1 - X^2 - Y^2), zero outside
   pure subroutine pressure_row(self, x, y, values)
      class(contact_t), intent(in) :: self
      !> Shape (nx)
      real(dp), intent(in) :: x(:), y
      real(dp), intent(out) :: values(:)

      associate (unused => self)
      end associate
      values = sqrt(max(0.0_dp, 1.0_dp - x**2 - y**2))
   end subroutine pressure_row

   !> Central film of an incompressible lubricant by Nijenbanning, Venner & Moes (1994) for the equivalent contact: M is
   !> proportional to R^(-5/4), L to R^(-1/4), and films to a^2/R
   pure real(dp) function film_formula(self, moes_m, moes_l)
      class(contact_t), intent(in) :: self
      real(dp), intent(in) :: moes_m, moes_l
      real(dp) :: length

      length = (self%radius*self%ellipticity*self%kernel_factor/circle_factor/self%kernel_ratio)**(1.0_dp/3.0_dp)
      film_formula = film_central_formula(moes_m*self%radius**(-1.25_dp), moes_l*self%radius**(-0.25_dp), self%ratio, &
                                          self%kernel_ratio)*length**2/self%radius
   end function film_formula
end module ehl_contact

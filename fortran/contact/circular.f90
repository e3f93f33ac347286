! SPDX-License-Identifier: BSD-3-Clause
!> The circular contact of a ball on a flat (Hertz)
module ehl_circular
   use ehl_contact, only: contact_t
   use ehl_film_formula, only: film_central_formula
   use ehl_kinds, only: dp, pi
   implicit none (type, external)
   private
   public :: circular_t, circular_from_si

   type, extends(contact_t) :: circular_t
   contains
      procedure :: gap_row
      procedure :: pressure_row
      procedure :: load
      procedure :: dry_separation
      procedure :: film_formula
   end type circular_t

contains

   !> Scales of the dry contact: a = (3 w R/(2 E'))^(1/3), p_h = 3 w/(2 pi a^2)
   pure function circular_from_si(load, radius, reduced_modulus) result(contact)
      !> Load [N], reduced radius R [m], reduced modulus E' [Pa] with 2/E' = sum (1 - nu^2)/E
      real(dp), intent(in) :: load, radius, reduced_modulus
      type(circular_t) :: contact

      contact%radius = (1.5_dp*load*radius/reduced_modulus)**(1.0_dp/3.0_dp)
      contact%pressure = 1.5_dp*load/(pi*contact%radius**2)
      contact%film_scale = contact%radius**2/radius
   end function circular_from_si

   !> X^2/2 + Y^2/2
   pure subroutine gap_row(self, x, y, values)
      class(circular_t), intent(in) :: self
      real(dp), intent(in) :: x(:), y
      real(dp), intent(out) :: values(:)

      associate (unused => self)
      end associate
      values = 0.5_dp*(x**2 + y**2)
   end subroutine gap_row

   !> sqrt(1 - X^2 - Y^2), zero outside
   pure subroutine pressure_row(self, x, y, values)
      class(circular_t), intent(in) :: self
      real(dp), intent(in) :: x(:), y
      real(dp), intent(out) :: values(:)

      associate (unused => self)
      end associate
      values = sqrt(max(0.0_dp, 1.0_dp - x**2 - y**2))
   end subroutine pressure_row

   !> iint P dX dY
   pure real(dp) function load(self)
      class(circular_t), intent(in) :: self
      associate (unused => self)
      end associate
      load = 2.0_dp*pi/3.0_dp
   end function load

   !> H00 of the dry contact, whose deflection at the centre is 1
   pure real(dp) function dry_separation(self)
      class(circular_t), intent(in) :: self
      associate (unused => self)
      end associate
      dry_separation = -1.0_dp
   end function dry_separation

   !> Nijenbanning, Venner & Moes (1994)
   pure real(dp) function film_formula(self, moes_m, moes_l)
      class(circular_t), intent(in) :: self
      real(dp), intent(in) :: moes_m, moes_l
      associate (unused => self)
      end associate
      film_formula = film_central_formula(moes_m, moes_l)
   end function film_formula
end module ehl_circular

! SPDX-License-Identifier: BSD-3-Clause
!> The circular contact of a ball on a flat (Hertz)
module ehl_circular
   use ehl_contact, only: contact_t
   use ehl_film_formula, only: film_central_formula
   use ehl_kinds, only: dp, pi
   use ehl_scales, only: circle_factor
   implicit none (type, external)
   private
   public :: circular_t

   type, extends(contact_t) :: circular_t
   contains
      procedure :: gap_row
      procedure :: pressure_row
      procedure :: load
      procedure :: kernel_factor
      procedure :: dry_separation
      procedure :: film_formula
   end type circular_t

contains

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

   !> 2/pi^2
   pure real(dp) function kernel_factor(self)
      class(circular_t), intent(in) :: self
      associate (unused => self)
      end associate
      kernel_factor = circle_factor
   end function kernel_factor

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
      film_formula = film_central_formula(moes_m, moes_l, 1.0_dp, 1.0_dp)
   end function film_formula
end module ehl_circular

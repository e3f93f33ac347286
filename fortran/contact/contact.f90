! SPDX-License-Identifier: BSD-3-Clause
!> The macroscopic contact: what of a scene is due to the shape of the two bodies and the load on them.
!> A shape extends `contact_t`; only ehl_contact_factory knows one. Lengths, films and pressures by the scales of the
!> contact (ehl_scales).
module ehl_contact
   use ehl_kinds, only: dp
   implicit none (type, external)
   private
   public :: contact_t

   type, abstract :: contact_t
      !> Semi-axis of the dry contact across the motion over that along it; D = R_x/R_y
      real(dp) :: ellipticity = 1.0_dp, radius_ratio = 1.0_dp
      !> Angle of the principal axes against X and Y [rad], counter-clockwise; how far the dry contact reaches along X and Y
      real(dp) :: angle = 0.0_dp, reach(2) = 1.0_dp
   contains
      procedure :: is_round
      procedure :: is_even
      procedure(row), deferred :: gap_row
      procedure(row), deferred :: pressure_row
      procedure(number), deferred :: load
      procedure(number), deferred :: kernel_factor
      procedure(number), deferred :: dry_separation
      procedure(film), deferred :: film_formula
   end type contact_t

   abstract interface
      !> gap_row: gap of the undeformed bodies, 0 where they touch; pressure_row: pressure of the dry contact.
      !> In the columns x of a row at y.
      pure subroutine row(self, x, y, values)
         import :: contact_t, dp
         implicit none (type, external)
         class(contact_t), intent(in) :: self
         !> Shape (nx)
         real(dp), intent(in) :: x(:), y
         real(dp), intent(out) :: values(:)
      end subroutine row

      !> load: iint P dX dY; kernel_factor: k_b of the deflection k_b iint P/r; dry_separation: H00 of the dry contact
      pure real(dp) function number(self)
         import :: contact_t, dp
         implicit none (type, external)
         class(contact_t), intent(in) :: self
      end function number

      !> Central film by formula, incompressible
      pure real(dp) function film(self, moes_m, moes_l)
         import :: contact_t, dp
         implicit none (type, external)
         class(contact_t), intent(in) :: self
         real(dp), intent(in) :: moes_m, moes_l
      end function film
   end interface

contains

   !> Whether nothing tells X from Y
   pure logical function is_round(self)
      class(contact_t), intent(in) :: self
      is_round = .not. abs(self%radius_ratio - 1.0_dp) > 0.0_dp
   end function is_round

   !> Whether Y > 0 is the mirror image of Y < 0
   pure logical function is_even(self)
      class(contact_t), intent(in) :: self
      is_even = .not. abs(self%angle) > 0.0_dp
   end function is_even
end module ehl_contact

! SPDX-License-Identifier: BSD-3-Clause
!> The macroscopic contact: what of a scene is due to the shape of the two bodies and the load on them.
!> A shape extends `contact_t`; no other module knows one. Lengths by the Hertz radius a, films by a^2/R,
!> pressures by the Hertz pressure p_h.
module ehl_contact
   use ehl_kinds, only: dp
   implicit none (type, external)
   private
   public :: contact_t

   type, abstract :: contact_t
      !> Hertz radius a [m] and film scale a^2/R [m]; 0: the contact is given by numbers without dimension
      real(dp) :: radius = 0.0_dp, film_scale = 0.0_dp
      !> Hertz pressure p_h [Pa]; 0 where neither viscosity nor density varies
      real(dp) :: pressure = 0.0_dp
   contains
      procedure :: has_size
      procedure(row), deferred :: gap_row
      procedure(row), deferred :: pressure_row
      procedure(number), deferred :: load
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

      !> load: iint P dX dY; dry_separation: H00 of the dry contact
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

   !> Whether its size in metres is known
   pure logical function has_size(self)
      class(contact_t), intent(in) :: self
      has_size = self%radius > 0.0_dp
   end function has_size
end module ehl_contact

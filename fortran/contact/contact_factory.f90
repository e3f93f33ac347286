! SPDX-License-Identifier: BSD-3-Clause
!> From the bodies of a contact to its shape and its scales. No other module names a shape.
module ehl_contact_factory
   use ehl_circular, only: circular_scales, circular_t
   use ehl_contact, only: contact_t
   use ehl_kinds, only: dp
   use ehl_scales, only: scales_t
   implicit none (type, external)
   private
   public :: new_contact, hertz_scales

contains

   !> The shape of a contact
   subroutine new_contact(contact)
      class(contact_t), allocatable, intent(out) :: contact
      allocate (circular_t :: contact)
   end subroutine new_contact

   !> The scales of a contact in SI units: those of the dry contact (Hertz 1881)
   pure function hertz_scales(load, radius, reduced_modulus) result(scales)
      !> Load [N], reduced radius R [m], reduced modulus E' [Pa] with 2/E' = sum (1 - nu^2)/E
      real(dp), intent(in) :: load, radius, reduced_modulus
      type(scales_t) :: scales
      scales = circular_scales(load, radius, reduced_modulus)
   end function hertz_scales
end module ehl_contact_factory

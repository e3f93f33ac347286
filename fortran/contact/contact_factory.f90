! SPDX-License-Identifier: BSD-3-Clause
!> From the bodies of a contact to its shape and its scales. No other module names a shape.
module ehl_contact_factory
   use ehl_contact, only: contact_t
   use ehl_elliptical, only: new_elliptical
   use ehl_kinds, only: dp
   use ehl_scales, only: scales_from_si, scales_t
   implicit none (type, external)
   private
   public :: new_contact, hertz_scales

contains

   !> The shape of a contact: round where both radii are the same
   subroutine new_contact(radius_ratio, angle, contact)
      !> D = R_x/R_y; angle of the plane of R_x against that of the motion [rad]
      real(dp), intent(in) :: radius_ratio, angle
      class(contact_t), allocatable, intent(out) :: contact

      if (abs(radius_ratio - 1.0_dp) > 0.0_dp) then
         allocate (contact, source=new_elliptical(radius_ratio, angle))
      else
         allocate (contact_t :: contact)
      end if
   end subroutine new_contact

   !> The scales of a contact in SI units
   pure function hertz_scales(contact, load, radius, reduced_modulus) result(scales)
      class(contact_t), intent(in) :: contact
      !> Load [N], reduced radius R_x in the plane of the motion [m], reduced modulus E' [Pa] with
      !> 2/E' = sum (1 - nu^2)/E
      real(dp), intent(in) :: load, radius, reduced_modulus
      type(scales_t) :: scales
      scales = scales_from_si(load, radius, reduced_modulus, contact%ellipticity, contact%kernel_factor)
   end function hertz_scales
end module ehl_contact_factory

! SPDX-License-Identifier: BSD-3-Clause
!> Creates a contact from its bodies. Modules outside this folder do not refer to types that extend contact_t.
module ehl_contact_factory
   use ehl_contact, only: contact_t
   use ehl_elliptical, only: new_elliptical
   use ehl_kinds, only: dp
   use ehl_line, only: new_line_contact
   use ehl_roller, only: new_roller, profile_t
   implicit none (type, external)
   private
   public :: new_contact, new_roller_contact

contains

   !> Create a line contact, a round one if both radii are equal, or an elliptical one
   subroutine new_contact(radius_ratio, angle, contact, line)
      !> D = R_x/R_y; angle of the plane of R_x against that of the motion [rad]
      real(dp), intent(in) :: radius_ratio, angle
      class(contact_t), allocatable, intent(out) :: contact
      !> Whether it is an infinite line contact, whatever the ratio
      logical, intent(in), optional :: line
      logical :: infinite

      infinite = .false.
      if (present(line)) infinite = line
      if (infinite) then
         allocate (contact, source=new_line_contact())
      else if (abs(radius_ratio - 1.0_dp) > 0.0_dp) then
         allocate (contact, source=new_elliptical(radius_ratio, angle))
      else
         allocate (contact_t :: contact)
      end if
   end subroutine new_contact

   !> Create the contact of a roller of finite length under a load [N]
   subroutine new_roller_contact(profile, load, radius, reduced_modulus, contact)
      type(profile_t), intent(in) :: profile
      !> Reduced radius along the motion [m], reduced modulus [Pa]
      real(dp), intent(in) :: load, radius, reduced_modulus
      class(contact_t), allocatable, intent(out) :: contact

      allocate (contact, source=new_roller(profile, load, radius, reduced_modulus))
   end subroutine new_roller_contact
end module ehl_contact_factory

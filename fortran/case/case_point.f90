! SPDX-License-Identifier: BSD-3-Clause
!> Shape, scales and operating point of the contact of a case
module ehl_case_point
   use ehl_case, only: case_t
   use ehl_contact, only: contact_t
   use ehl_contact_factory, only: hertz_scales, new_contact
   use ehl_kinds, only: dp, pi
   use ehl_moes, only: operating_from_moes, operating_from_si, operating_t
   use ehl_scales, only: scales_t
   implicit none (type, external)
   private
   public :: find_contact, operating_point

contains

   !> Shape, scales and operating point, without the heat of the inlet
   subroutine find_contact(input, contact, scales, point)
      type(case_t), intent(in) :: input
      class(contact_t), allocatable, intent(out) :: contact
      type(scales_t), intent(out) :: scales
      type(operating_t), intent(out) :: point

      call new_contact(input%contact%radius_ratio, input%contact%angle*pi/180.0_dp, contact)
      associate (c => input%contact, l => input%lubricant)
         if (c%si) then
            scales = hertz_scales(contact, c%load, c%radius_x, c%reduced_modulus)
            point = operating_point(input, contact, scales, l%viscosity)
         else
            point = operating_from_moes(c%moes_m, c%moes_l, contact%ellipticity, contact%kernel_factor)
            if (point%alpha_bar > 0.0_dp) scales%pressure = point%alpha_bar/l%pressure_viscosity
         end if
      end associate
   end subroutine find_contact

   !> Operating point of a contact in SI units with a viscosity [Pa s]
   pure function operating_point(input, contact, scales, viscosity) result(point)
      type(case_t), intent(in) :: input
      class(contact_t), intent(in) :: contact
      type(scales_t), intent(in) :: scales
      real(dp), intent(in) :: viscosity
      type(operating_t) :: point

      associate (c => input%contact)
         point = operating_from_si(c%load, c%mean_velocity, c%radius_x, c%reduced_modulus, viscosity, &
                                   input%lubricant%pressure_viscosity, scales%pressure, contact%ellipticity, &
                                   contact%kernel_factor)
      end associate
   end function operating_point
end module ehl_case_point

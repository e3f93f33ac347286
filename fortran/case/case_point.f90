! SPDX-License-Identifier: BSD-3-Clause
!> Shape, scales and operating point of the contact of a case
module ehl_case_point
   use ehl_case, only: case_t
   use ehl_contact, only: contact_t
   use ehl_contact_factory, only: new_contact, new_roller_contact
   use ehl_kinds, only: dp, pi
   use ehl_moes, only: operating_t
   use ehl_scales, only: scales_t
   implicit none (type, external)
   private
   public :: find_contact, operating_point

contains

   !> Shape, scales and operating point, without shear heating in the inlet
   subroutine find_contact(input, contact, scales, point)
      type(case_t), intent(in) :: input
      class(contact_t), allocatable, intent(out) :: contact
      type(scales_t), intent(out) :: scales
      type(operating_t), intent(out) :: point
      real(dp) :: numbers(2)

      if (input%contact%is_roller()) then
         associate (c => input%contact)
            call new_roller_contact(c%body_profile(), c%load, c%radius_x, c%reduced_modulus, contact)
         end associate
      else
         call new_contact(input%contact%radius_ratio, input%contact%angle*pi/180.0_dp, contact, input%contact%is_line())
      end if
      associate (c => input%contact, l => input%lubricant)
         if (c%si) then
            scales = contact%scales(c%size_of_load(), c%radius_x, c%reduced_modulus)
            point = operating_point(input, contact, scales, l%viscosity)
         else
            numbers = c%moes_numbers()
            point = contact%operating(numbers(1), numbers(2))
            if (point%alpha_bar > 0.0_dp) scales%pressure = point%alpha_bar/l%pressure_viscosity
         end if
      end associate
   end subroutine find_contact

   !> Operating point of a contact in SI units at a viscosity [Pa s]
   pure function operating_point(input, contact, scales, viscosity) result(point)
      type(case_t), intent(in) :: input
      class(contact_t), intent(in) :: contact
      type(scales_t), intent(in) :: scales
      real(dp), intent(in) :: viscosity
      type(operating_t) :: point
      real(dp) :: speed

      associate (c => input%contact, alpha => input%lubricant%pressure_viscosity)
         speed = viscosity*c%mean_velocity/(c%reduced_modulus*c%radius_x)
         point = contact%operating(contact%moes_load(c%size_of_load(), c%radius_x, c%reduced_modulus, speed), &
                                   alpha*c%reduced_modulus*(2.0_dp*speed)**0.25_dp)
         point%alpha_bar = alpha*scales%pressure
      end associate
   end function operating_point
end module ehl_case_point

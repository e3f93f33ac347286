! SPDX-License-Identifier: BSD-3-Clause
!> The radii of a contact in SI units: one of a round contact, or two
module ehl_case_radii
   use ehl_case, only: case_t
   use ehl_kinds, only: dp
   use ehl_refusal, only: contradict, refuse, short
   use ehl_schema, only: schema_t
   use ehl_source, only: source_t
   use ehl_status, only: status_t
   implicit none (type, external)
   private
   public :: complete_radii

contains

   !> Both radii, and their ratio, from what was given
   subroutine complete_radii(schema, input, sources, status)
      type(schema_t), intent(in) :: schema
      type(case_t), intent(inout) :: input
      type(source_t), intent(in) :: sources(:)
      type(status_t), intent(inout) :: status
      character(len=8), parameter :: names(2) = ["radius_x", "radius_y"]
      integer :: one

      associate (c => input%contact)
         if (status%failed() .or. .not. c%si) return
         c%round = .not. (c%radius_x > 0.0_dp .or. c%radius_y > 0.0_dp)
         if (c%round) then
            c%radius_x = c%radius
            c%radius_y = c%radius
         else if (.not. (c%radius_x > 0.0_dp .and. c%radius_y > 0.0_dp)) then
            one = merge(1, 2, c%radius_x > 0.0_dp)
            call refuse(schema, sources, "contact", names(one), "contact."//names(one)//" without contact."//names(3 - one), &
                        "both, or contact.radius of a round contact", status)
            return
         else if (schema%given("contact", "radius")) then
            one = merge(1, 2, schema%given("contact", "radius_x"))
            call contradict(schema, sources, "contact.radius", "contact."//names(one), &
                            "radius of a round contact, or radius_x and radius_y", status)
            return
         end if
         c%radius_ratio = c%radius_x/c%radius_y
         associate (key => schema%keys(schema%find("contact", "radius_ratio")))
            if (key%allows(c%radius_ratio)) return
            call refuse(schema, sources, "contact", "radius_y", "radius_x/radius_y is "//short(c%radius_ratio), &
                        "a ratio in "//trim(key%allowed)//", an ellipse of at most 30 to 1", status)
         end associate
      end associate
   end subroutine complete_radii
end module ehl_case_radii

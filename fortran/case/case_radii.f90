! SPDX-License-Identifier: BSD-3-Clause
!> The radii of a contact in SI units: one of a round contact, two, or those of both bodies
module ehl_case_radii
   use ehl_case, only: case_t
   use ehl_kinds, only: dp
   use ehl_schema, only: schema_t
   use ehl_status, only: status_t
   use ehl_text, only: short
   implicit none (type, external)
   private
   public :: complete_radii

   !> Relative difference of values that is none
   real(dp), parameter :: rounding = 1.0e-6_dp

contains

   !> Both radii, and their ratio, from what was given
   subroutine complete_radii(schema, input, status)
      type(schema_t), intent(in) :: schema
      type(case_t), intent(inout) :: input
      type(status_t), intent(inout) :: status
      character(len=8), parameter :: names(2) = ["radius_x", "radius_y"]
      character(len=9), parameter :: bodies(4) = ["radius_y1", "radius_y2", "radius_x1", "radius_x2"]
      character(len=:), allocatable :: name, remedy
      integer :: one

      associate (c => input%contact)
         if (status%failed()) return
         call complete_bodies(schema, input, status)
         if (status%failed() .or. .not. c%si) return
         c%round = .not. (c%radius_x > 0.0_dp .or. c%radius_y > 0.0_dp)
         if (c%round) then
            c%radius_x = c%radius
            c%radius_y = c%radius
         else if (.not. (c%radius_x > 0.0_dp .and. c%radius_y > 0.0_dp)) then
            one = merge(1, 2, c%radius_x > 0.0_dp)
            call schema%refuse("contact."//names(one), "contact."//names(one)//" without contact."//names(3 - one), &
                               "both, or contact.radius of a round contact", status)
            return
         else if (schema%given("contact", "radius")) then
            one = merge(1, 2, schema%given("contact", "radius_x"))
            call schema%contradict("contact.radius", "contact."//names(one), &
                                   "radius of a round contact, or radius_x and radius_y", status)
            return
         end if
         c%radius_ratio = c%radius_x/c%radius_y
         associate (key => schema%keys(schema%find("contact", "radius_ratio")))
            if (key%allows(c%radius_ratio)) return
            name = "contact.radius_y"
            if (input%bodies%given) name = "bodies."//bodies(1)
            do one = size(bodies), 1, -1
               if (schema%given("bodies", bodies(one))) name = "bodies."//bodies(one)
            end do
            remedy = "radius_y of at most "//short(250.0_dp*c%radius_x)//" m, as of a crowned roller; a line contact is not solved"
            if (c%radius_ratio > 1.0_dp) remedy = "radius_x of at most "//short(250.0_dp*c%radius_y)//" m"
            call schema%refuse(name, "radius_x/radius_y is "//short(c%radius_ratio), &
                               "a ratio in "//trim(key%allowed)//", an ellipse of at most 30 to 1: "//remedy, status)
         end associate
      end associate
   end subroutine complete_radii

   !> Reduced radii and reduced modulus of the bodies, if one of their keys was given
   subroutine complete_bodies(schema, input, status)
      type(schema_t), intent(in) :: schema
      type(case_t), intent(inout) :: input
      type(status_t), intent(inout) :: status
      character(len=15), parameter :: rivals(7) = [character(len=15) :: "radius_x", "radius_y", "reduced_modulus", "radius", &
                                                   "moes_m", "moes_l", "radius_ratio"]
      real(dp) :: follows(3)
      logical :: agrees(size(rivals))
      integer :: k, first

      first = findloc(schema%keys%given .and. schema%keys%group == "bodies", .true., dim=1)
      input%bodies%given = first > 0
      if (first == 0) return
      associate (b => input%bodies, c => input%contact)
         follows = [reduced_radius([b%radius_x1, b%radius_x2]), reduced_radius([b%radius_y1, b%radius_y2]), &
                    2.0_dp/((1.0_dp - b%poisson_1**2)/b%modulus_1 + (1.0_dp - b%poisson_2**2)/b%modulus_2)]
         ! a resolved case has these with the bodies
         agrees = .false.
         agrees(:3) = abs([c%radius_x, c%radius_y, c%reduced_modulus] - follows) <= rounding*follows
         do k = 1, size(rivals)
            if (agrees(k) .or. .not. schema%given("contact", trim(rivals(k)))) cycle
            call schema%contradict(schema%keys(first)%full_name(), "contact."//trim(rivals(k)), &
                                   "the bodies, or reduced radii and modulus, or Moes numbers", status)
            return
         end do
         c%radius_x = follows(1)
         c%radius_y = follows(2)
         c%reduced_modulus = follows(3)
         call check_closed(schema, "radius_x", [b%radius_x1, b%radius_x2], c%radius_x, status)
         call check_closed(schema, "radius_y", [b%radius_y1, b%radius_y2], c%radius_y, status)
         call schema%check_range("contact.reduced_modulus", c%reduced_modulus, &
                                 merge("bodies.modulus_1", "bodies.modulus_2", b%modulus_1 < b%modulus_2), "the bodies", status)
      end associate
   end subroutine complete_bodies

   !> R with 1/R = 1/R_1 + 1/R_2, a flat body being 0; 0 where the gap does not open
   pure real(dp) function reduced_radius(radii)
      real(dp), intent(in) :: radii(2)
      real(dp) :: curvature
      integer :: k

      curvature = 0.0_dp
      do k = 1, 2
         if (abs(radii(k)) > 0.0_dp) curvature = curvature + 1.0_dp/radii(k)
      end do
      reduced_radius = 0.0_dp
      if (curvature > 0.0_dp) reduced_radius = 1.0_dp/curvature
   end function reduced_radius

   !> Refuse bodies whose gap does not open in one direction, or hardly does
   subroutine check_closed(schema, name, radii, reduced, status)
      type(schema_t), intent(in) :: schema
      !> Name of the reduced radius; its value, and those of the bodies [m]
      character(len=*), intent(in) :: name
      real(dp), intent(in) :: radii(2), reduced
      type(status_t), intent(inout) :: status
      character(len=1) :: place

      if (status%failed()) return
      place = merge("1", "2", radii(1) < 0.0_dp .or. .not. abs(radii(2)) > 0.0_dp)
      if (reduced > 0.0_dp) then
         call schema%check_range("contact."//name, reduced, "bodies."//name//place, "the bodies", status)
      else
         call schema%refuse("bodies."//name//place, "bodies."//name//"1 = "//short(radii(1))//" and "//name//"2 = "// &
                            short(radii(2))//": the gap does not open in this direction", "a convex body, and a concave one "// &
                            "(negative) only with a larger radius than the convex one", status)
      end if
   end subroutine check_closed
end module ehl_case_radii

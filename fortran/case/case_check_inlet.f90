! SPDX-License-Identifier: BSD-3-Clause
!> Checks of a starved inlet in a complete case
module ehl_case_check_inlet
   use ehl_case, only: case_t, surface_case_t
   use ehl_case_defaults, only: is_starved
   use ehl_case_source, only: case_source_t
   use ehl_contact, only: contact_t
   use ehl_kinds, only: dp
   use ehl_scales, only: scales_t
   use ehl_status, only: status_t
   use ehl_text, only: short
   implicit none (type, external)
   private
   public :: beyond_contact, check_inlet, rounding

   !> Minimum distance of the borders of the domain from the centre, over that of the edge of the contact
   real(dp), parameter :: beyond_contact = 1.05_dp
   !> Relative difference below which values are equal
   real(dp), parameter :: rounding = 1.0e-6_dp

contains

   !> A starved inlet has P = 0 at its border, and the meniscus lies ahead of the contact
   subroutine check_inlet(source, input, contact, scales, status)
      type(case_source_t), intent(in) :: source
      type(case_t), intent(in) :: input
      class(contact_t), intent(in) :: contact
      type(scales_t), intent(in) :: scales
      type(status_t), intent(inout) :: status
      character(len=*), parameter :: one = "one of the two"
      character(len=:), allocatable :: key
      real(dp) :: minimum

      key = source%first_given("inlet", [character(len=14) :: "position", "position_hertz", "film", "film_hertz"])
      associate (inlet => input%inlet)
         if (.not. input%contact%si .and. max(inlet%position, inlet%film) > 0.0_dp) then
            key = merge("inlet.position", "inlet.film    ", inlet%position > 0.0_dp)
            call source%refuse(key, trim(key)//" in metres with Moes numbers", trim(key)//"_hertz, in a or a^2/R", status)
         end if
         if (inlet%position_hertz > 0.0_dp .and. inlet%film_hertz > 0.0_dp) then
            call source%refuse(key, "inlet.position with inlet.film", "one of them: the oil begins where the layer fills the gap", &
                               status)
         end if
         if (inlet%passages > 1 .and. .not. inlet%film_hertz > 0.0_dp) call source%refuse("inlet.passages", &
            "inlet.passages without inlet.film", "the layer of the first passage", status)
         if (.not. is_starved(input)) return
         if (inlet%position > 0.0_dp) call agree("inlet.position", "inlet.position_hertz", inlet%position/scales%length, &
                                                 inlet%position_hertz)
         if (inlet%film > 0.0_dp) call agree("inlet.film", "inlet.film_hertz", inlet%film/scales%film, inlet%film_hertz)
         if (inlet%position_hertz > 0.0_dp) then
            call agree("inlet.position", "grid.x_inlet", inlet%position_hertz, -input%grid%x_inlet)
            minimum = beyond_contact*contact%reach(1)
            if (inlet%position_hertz < minimum) call source%refuse(key, key//" is "//short(inlet%position_hertz)// &
               " a ahead of the centre, and the contact reaches to "//short(contact%reach(1))//" a", &
               "at least "//short(minimum)//" a", status)
            call source%check_range("inlet.position_hertz", inlet%position_hertz, key, key//" and the contact", status)
         end if
         if (input%grid%border == "flooded") call source%contradict("grid.border", key, "grid.border = 'zero' or none", status)
         if (.not. inlet%film_hertz > 0.0_dp) return
         call source%check_range("inlet.film_hertz", inlet%film_hertz, key, key//" and the contact", status)
         minimum = input%lubricant%boundary_film
         if (inlet%film_hertz*scales%film < minimum*(1.0_dp - rounding)) call source%refuse(key, key//" = "// &
            short(inlet%film_hertz*scales%film)//" m is below the boundary film of "//short(minimum)//" m", &
            "a layer above lubricant.boundary_film", status)
         if (input%duty%active() .and. inlet%passages > 1) call source%refuse("inlet.passages", "inlet.passages with a duty", &
            "one of the two: the layer of a duty is duty.inlet_film", status)
         call need_smooth("surface", input%surface)
         call need_smooth("second_surface", input%second_surface)
      end associate

   contains

      subroutine agree(first, second, value, other)
         character(len=*), intent(in) :: first, second
         real(dp), intent(in) :: value, other
         if (abs(value - other) > rounding*abs(value)) call source%contradict(first, second, one, status)
      end subroutine agree

      subroutine need_smooth(group, s)
         character(len=*), intent(in) :: group
         type(surface_case_t), intent(in) :: s
         if (s%kind /= "smooth") call source%refuse(group//".kind", group//".kind = '"//trim(s%kind)//"' with "//key, &
            "smooth surfaces, or inlet.position for a rough contact that is starved", status)
      end subroutine need_smooth
   end subroutine check_inlet
end module ehl_case_check_inlet

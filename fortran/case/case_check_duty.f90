! SPDX-License-Identifier: BSD-3-Clause
!> Checks of a duty
module ehl_case_check_duty
   use ehl_case, only: case_t, has_no_height
   use ehl_case_source, only: case_source_t
   use ehl_kinds, only: dp
   use ehl_status, only: status_t
   use ehl_text, only: short, to_text
   implicit none (type, external)
   private
   public :: check_duty

   !> Minimum load over that of the case
   real(dp), parameter :: min_load = 1.0e-3_dp
   !> Relative difference below which the first and the last row of a period are equal
   real(dp), parameter :: same = 1.0e-9_dp
   character(len=*), parameter :: keys(9) = [character(len=13) :: "load", "u1", "u2", "mean_velocity", "slide_to_roll", &
                                             "radius_x", "radius_y", "viscosity", "inlet_film"]

contains

   !> Refuse a duty that is incomplete or cannot be solved
   subroutine check_duty(source, input, status)
      type(case_source_t), intent(in) :: source
      type(case_t), intent(in) :: input
      type(status_t), intent(inout) :: status
      real(dp), allocatable :: numbers(:)
      character(len=:), allocatable :: key
      real(dp) :: minimum
      integer :: k, n

      if (status%failed()) return
      associate (d => input%duty, time => input%duty%list("time"))
         n = size(time)
         do k = 1, size(keys)
            numbers = d%list(trim(keys(k)))
            if (size(numbers) == 0 .or. size(numbers) == n) cycle
            call refuse(trim(keys(k)), to_text(size(numbers))//" values at "//to_text(n)//" times", "a value at each of duty.time")
         end do
         if (.not. d%active()) then
            key = source%first_given("duty")
            if (key /= "") call source%refuse(key, key//" without a table", "values at duty.time", status)
            return
         end if
         if (.not. input%contact%si) call refuse("time", "a duty with a contact given by Moes numbers", &
                                                 "contact.load, mean_velocity, "// &
                                                 "radius and reduced_modulus: a duty is in SI units")
         if (n < 2) call refuse("time", "a single time", "two rows or more")
         do k = 2, n
            if (.not. time(k) > time(k - 1)) then
               call refuse("time", "time "//to_text(time(k))//" s after "//to_text(time(k - 1))//" s", "times that increase")
               exit
            end if
         end do
         if (all([(size(d%list(trim(keys(k)))) == 0, k=1, size(keys))])) then
            call refuse("time", "times alone", "one of load, u1, u2, mean_velocity, slide_to_roll, radius_x, "// &
                        "radius_y, viscosity, inlet_film")
         end if
         if ((size(d%list("u1")) > 0) .neqv. (size(d%list("u2")) > 0)) then
            call refuse(merge("u1", "u2", size(d%list("u1")) > 0), "one of duty.u1 and duty.u2", &
                        "both, or duty.mean_velocity and duty.slide_to_roll")
         end if
         if (size(d%list("u1")) > 0 .and. (size(d%list("mean_velocity")) > 0 .or. size(d%list("slide_to_roll")) > 0)) then
            call refuse("u1", "duty.u1 together with duty.mean_velocity or duty.slide_to_roll", &
                        "either u1 and u2, or mean_velocity and slide_to_roll")
         end if
         numbers = d%list("load")
         minimum = min_load*input%contact%size_of_load()
         if (size(numbers) > 0) then
            if (minval(numbers) < minimum) call refuse("load", "a load of "//to_text(minval(numbers)), &
               "at least "//short(minimum)//", 0.001 of that of the case: below it the contact opens")
         end if
         call positive("radius_x")
         call positive("radius_y")
         call positive("viscosity")
         call positive("inlet_film")
         call check_layer()
         if (input%contact%is_cylinder() .and. size(d%list("radius_y")) > 0) then
            call refuse("radius_y", "duty.radius_y of a "//trim(input%contact%shape), "duty.radius_x alone")
         end if
         if (abs(input%contact%angle) > 0.0_dp .and. size(d%list("radius_x")) + size(d%list("radius_y")) > 0) then
            call refuse("radius_x", "radii that change in a rotated contact", "contact.angle = 0.0")
         end if
         if (d%periodic) call check_period()
         if (source%first_given("time") /= "") call source%refuse(source%first_given("time"), source%first_given("time")// &
            " with a duty", "none of &time: the table sets the duration, duty.time_step and duty.target_error the "// &
            "time steps", status)
         if (input%grid%border == "flooded") call source%refuse("grid.border", "grid.border = 'flooded' with a duty", &
            "'zero': the pressure at a flooded border contains no squeeze term", status)
         if (d%reverses() .and. abs(input%grid%x_inlet + input%grid%x_outlet) > 1.0e-9_dp*input%grid%x_outlet) then
            call source%refuse("grid.x_inlet", "a domain from "//to_text(input%grid%x_inlet)//" to "// &
                               to_text(input%grid%x_outlet)//" a, and the mean velocity changes sign", &
                               "an inlet on both sides: x_outlet = -x_inlet", status)
         end if
         if (input%grid%target_error > 0.0_dp) call source%refuse("grid.target_error", "grid.target_error with a duty", &
            "grid.points; duty.target_error is that of the time steps", status)
         call check_surface("surface", input%contact%rough_surface)
         call check_surface("second_surface", 3 - input%contact%rough_surface)
      end associate

   contains

      subroutine refuse(key, what, expected)
         character(len=*), intent(in) :: key, what, expected
         if (status%failed()) return
         call source%refuse("duty."//key, what, expected, status)
      end subroutine refuse

      subroutine positive(key)
         character(len=*), intent(in) :: key
         numbers = input%duty%list(key)
         if (size(numbers) == 0) return
         if (minval(numbers) <= 0.0_dp) call refuse(key, "duty."//key//" of "//to_text(minval(numbers)), "positive numbers")
      end subroutine positive

      !> A variable oil layer needs a layer in the case, and must not be below the boundary film
      subroutine check_layer()
         numbers = input%duty%list("inlet_film")
         if (size(numbers) == 0) return
         if (.not. input%inlet%film_hertz > 0.0_dp) call refuse("inlet_film", "duty.inlet_film without inlet.film", &
                                                                "inlet.film, the layer of the case")
         if (minval(numbers) < input%lubricant%boundary_film) call refuse("inlet_film", "duty.inlet_film of "// &
            to_text(minval(numbers))//" m below the boundary film of "//short(input%lubricant%boundary_film)//" m", &
            "layers above lubricant.boundary_film")
      end subroutine check_layer

      !> A period must end with its first values
      subroutine check_period()
         integer :: i

         do i = 1, size(keys)
            numbers = input%duty%list(trim(keys(i)))
            if (size(numbers) < 2) cycle
            if (abs(numbers(size(numbers)) - numbers(1)) > same*maxval(abs(numbers))) then
               call refuse(trim(keys(i)), "duty."//trim(keys(i))//" ends at "//to_text(numbers(size(numbers)))// &
                           " and begins at "//to_text(numbers(1)), "a period that ends where it begins, or periodic = .false.")
            end if
         end do
      end subroutine check_period

      !> Refuse a rough surface at rest in the case: under a duty its position follows from its displacement over velocity_ratio
      subroutine check_surface(group, body)
         character(len=*), intent(in) :: group
         integer, intent(in) :: body
         real(dp) :: ratio

         if (group == "surface") then
            if (has_no_height(input%surface)) return
         else
            if (has_no_height(input%second_surface)) return
         end if
         ratio = 1.0_dp + 0.5_dp*merge(1.0_dp, -1.0_dp, body == 1)*input%contact%slide_to_roll
         if (ratio > 0.0_dp .or. status%failed()) return
         call source%refuse(group//".kind", "a rough surface that is at rest in the case, with a duty", &
                            "a contact.slide_to_roll with which it moves", status)
      end subroutine check_surface
   end subroutine check_duty
end module ehl_case_check_duty

! SPDX-License-Identifier: BSD-3-Clause
!> The duty of a case in Hertz units
module ehl_plan_duty
   use ehl_case, only: case_t
   use ehl_duty, only: duty_load, duty_radius_x, duty_radius_y, duty_t, duty_u1, duty_u2, duty_viscosity, &
                       duty_layer, quantities
   use ehl_kinds, only: dp
   use ehl_scales, only: scales_t
   implicit none (type, external)
   private
   public :: plan_duty

contains

   !> Quantities that change with time, over those of the case; inactive without a duty
   pure function plan_duty(input, scales, inlet_viscosity) result(duty)
      type(case_t), intent(in) :: input
      type(scales_t), intent(in) :: scales
      !> Viscosity in the inlet, with shear heating [Pa s]
      real(dp), intent(in) :: inlet_viscosity
      type(duty_t) :: duty
      real(dp), allocatable :: mean(:), slide(:)
      integer :: n

      if (.not. input%duty%active()) return
      associate (d => input%duty, c => input%contact)
         n = size(d%time)
         duty%time_scale = scales%length/c%mean_velocity
         duty%stress = inlet_viscosity*c%mean_velocity/scales%film
         duty%layer = input%inlet%film_hertz
         duty%time = (d%time - d%time(1))/duty%time_scale
         duty%cubic = d%interpolation == "cubic"
         duty%periodic = d%periodic
         duty%periods = d%periods
         duty%step_factor = d%time_step
         duty%target_error = d%target_error
         duty%reference(duty_u1:duty_u2) = 1.0_dp + [0.5_dp, -0.5_dp]*c%slide_to_roll
         allocate (duty%values(n, quantities))
         call fill(duty_load, d%list("load")/c%size_of_load())
         call fill(duty_radius_x, d%list("radius_x")/c%radius_x)
         call fill(duty_radius_y, d%list("radius_y")/max(c%radius_y, tiny(1.0_dp)))
         call fill(duty_viscosity, d%list("viscosity")/input%lubricant%viscosity)
         call fill(duty_layer, d%list("inlet_film")/max(input%inlet%film_hertz*scales%film, tiny(1.0_dp)))
         if (size(d%list("u1")) > 0) then
            call fill(duty_u1, d%u1/c%mean_velocity)
            call fill(duty_u2, d%u2/c%mean_velocity)
         else
            mean = d%list("mean_velocity")/c%mean_velocity
            slide = d%list("slide_to_roll")
            if (size(mean) == 0) mean = spread(1.0_dp, 1, n)
            if (size(slide) == 0) slide = spread(c%slide_to_roll, 1, n)
            call fill(duty_u1, mean*(1.0_dp + 0.5_dp*slide))
            call fill(duty_u2, mean*(1.0_dp - 0.5_dp*slide))
         end if
      end associate
      call duty%setup()

   contains

      !> Set the values of a quantity; without values those of the case
      pure subroutine fill(k, ratios)
         integer, intent(in) :: k
         real(dp), intent(in) :: ratios(:)

         duty%values(:, k) = duty%reference(k)
         if (size(ratios) > 0) duty%values(:, k) = ratios
      end subroutine fill
   end function plan_duty
end module ehl_plan_duty

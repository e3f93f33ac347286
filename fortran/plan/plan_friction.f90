! SPDX-License-Identifier: BSD-3-Clause
!> Data of a case for absolute friction and frictional heating
module ehl_plan_friction
   use ehl_case, only: case_t
   use ehl_case_point, only: operating_point
   use ehl_contact, only: contact_t
   use ehl_heat, only: thermal_loading, thermal_reduction
   use ehl_kinds, only: dp
   use ehl_moes, only: operating_t
   use ehl_scales, only: scales_t
   implicit none (type, external)
   private
   public :: sliding_t, plan_sliding

   !> Motion, load and thermal data of a contact
   type :: sliding_t
      !> Name of the shear law
      character(len=32) :: law = "newtonian"
      !> Slide-to-roll ratio; mean velocity [m/s], 0 if not given in m/s
      real(dp) :: slide_to_roll = 0.0_dp, mean_velocity = 0.0_dp
      !> Load [N], of a line per unit length [N/m]
      real(dp) :: load = 0.0_dp
      !> Shear stress above which the lubricant is not Newtonian [Pa]
      real(dp) :: newtonian_limit = 0.0_dp
      !> Thermal conductivity [W/(m K)] and diffusivity [m^2/s] of bodies 1 and 2
      real(dp) :: conductivity(2) = 0.0_dp, diffusivity(2) = 0.0_dp
      !> Thermal reduction of the film, 1 without inlet shear heating; thermal loading parameter
      real(dp) :: reduction = 1.0_dp, loading = 0.0_dp
      !> Viscosity in the inlet, with shear heating [Pa s]
      real(dp) :: inlet_viscosity = 0.0_dp
   contains
      procedure :: speeds
   end type sliding_t

contains

   !> Speeds of the surfaces [m/s]
   pure function speeds(self)
      class(sliding_t), intent(in) :: self
      real(dp) :: speeds(2)
      speeds = self%mean_velocity*(1.0_dp + [0.5_dp, -0.5_dp]*self%slide_to_roll)
   end function speeds

   !> Motion, load and thermal data of a case
   pure function plan_sliding(input, contact, scales) result(sliding)
      type(case_t), intent(in) :: input
      class(contact_t), intent(in) :: contact
      type(scales_t), intent(in) :: scales
      type(sliding_t) :: sliding

      sliding%law = input%lubricant%shear_law
      sliding%slide_to_roll = input%contact%slide_to_roll
      sliding%newtonian_limit = input%lubricant%eyring_stress
      associate (c => input%contact)
         sliding%conductivity = [c%thermal_conductivity, c%thermal_conductivity_2]
         sliding%diffusivity = [c%thermal_diffusivity, c%thermal_diffusivity_2]
      end associate
      if (.not. sliding%conductivity(2) > 0.0_dp) sliding%conductivity(2) = sliding%conductivity(1)
      if (.not. sliding%diffusivity(2) > 0.0_dp) sliding%diffusivity(2) = sliding%diffusivity(1)
      if (.not. input%contact%si) return
      associate (c => input%contact, l => input%lubricant)
         sliding%mean_velocity = c%mean_velocity
         sliding%load = c%size_of_load()
         sliding%inlet_viscosity = l%viscosity
         if (.not. l%thermal_reduction) return
         sliding%loading = thermal_loading(l%temperature_viscosity, l%viscosity, c%mean_velocity, l%thermal_conductivity)
         sliding%reduction = thermal_reduction(sliding%loading, scales%pressure/c%reduced_modulus, c%slide_to_roll)
         sliding%inlet_viscosity = inlet_viscosity(input, contact, scales, sliding%reduction)
      end associate
   end function plan_sliding

   !> Viscosity [Pa s] at which the film formula gives `ratio` times the film at the viscosity of the case
   pure real(dp) function inlet_viscosity(input, contact, scales, ratio)
      type(case_t), intent(in) :: input
      class(contact_t), intent(in) :: contact
      type(scales_t), intent(in) :: scales
      real(dp), intent(in) :: ratio
      real(dp) :: low, high, target
      integer :: k

      inlet_viscosity = input%lubricant%viscosity
      if (.not. (ratio > 0.0_dp .and. ratio < 1.0_dp)) return
      ! the film increases at least as the power 0.4 of the viscosity
      high = log(inlet_viscosity)
      low = high + 2.5_dp*log(ratio)
      target = ratio*film_at(input, contact, scales, high)
      do k = 1, 60
         if (film_at(input, contact, scales, 0.5_dp*(low + high)) < target) then
            low = 0.5_dp*(low + high)
         else
            high = 0.5_dp*(low + high)
         end if
      end do
      inlet_viscosity = exp(0.5_dp*(low + high))
   end function inlet_viscosity

   !> Central film by formula [a^2/R] at the logarithm of a viscosity
   pure real(dp) function film_at(input, contact, scales, log_viscosity)
      type(case_t), intent(in) :: input
      class(contact_t), intent(in) :: contact
      type(scales_t), intent(in) :: scales
      real(dp), intent(in) :: log_viscosity
      type(operating_t) :: point

      point = operating_point(input, contact, scales, exp(log_viscosity))
      film_at = contact%film_formula(point%moes_m, point%moes_l)
   end function film_at
end module ehl_plan_friction

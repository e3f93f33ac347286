! SPDX-License-Identifier: BSD-3-Clause
!> Creates the flow of a lubricant: Newtonian or shear-thinning
module ehl_flow_factory
   use ehl_flow, only: flow_t
   use ehl_kinds, only: dp
   use ehl_lubricant, only: lubricant_t
   use ehl_newtonian_flow, only: newtonian_flow_t
   use ehl_shear_thinning_flow, only: new_shear_thinning_flow
   implicit none (type, external)
   private
   public :: new_flow

contains

   !> Create a flow; its arrays are not allocated yet
   subroutine new_flow(lubricant, speed_parameter, flow)
      type(lubricant_t), intent(in) :: lubricant
      !> lambda_bar
      real(dp), intent(in) :: speed_parameter
      class(flow_t), allocatable, intent(out) :: flow

      associate (shear => lubricant%shear)
         if (shear%thins_flow()) then
            allocate (flow, source=new_shear_thinning_flow(shear%thinning(), shear%scale/shear%stress, &
                                                     shear%gradient_scale/shear%stress))
         else
            allocate (newtonian_flow_t :: flow)
         end if
      end associate
      flow%inverse_speed = 1.0_dp/speed_parameter
   end subroutine new_flow
end module ehl_flow_factory

! SPDX-License-Identifier: BSD-3-Clause
!> From a lubricant to the kind of flow that it has
module ehl_flow_factory
   use ehl_flow, only: flow_t
   use ehl_kinds, only: dp
   use ehl_newtonian_flow, only: newtonian_flow_t
   implicit none (type, external)
   private
   public :: new_flow

contains

   !> A flow, without its arrays yet
   subroutine new_flow(speed_parameter, flow)
      !> lambda_bar
      real(dp), intent(in) :: speed_parameter
      class(flow_t), allocatable, intent(out) :: flow

      allocate (newtonian_flow_t :: flow)
      flow%inverse_speed = 1.0_dp/speed_parameter
   end subroutine new_flow
end module ehl_flow_factory

! SPDX-License-Identifier: BSD-3-Clause
!> The scales of a contact: what one is in metres and pascals
module ehl_scales
   use ehl_kinds, only: dp
   implicit none (type, external)
   private
   public :: scales_t

   type :: scales_t
      !> Lengths: Hertz radius a [m]; films: a^2/R [m]; 0: the contact is given by numbers without dimension
      real(dp) :: length = 0.0_dp, film = 0.0_dp
      !> Pressures: Hertz pressure p_h [Pa]; 0 where neither viscosity nor density varies
      real(dp) :: pressure = 0.0_dp
   contains
      procedure :: has_size
   end type scales_t

contains

   !> Whether the size of the contact in metres is known
   pure logical function has_size(self)
      class(scales_t), intent(in) :: self
      has_size = self%length > 0.0_dp
   end function has_size
end module ehl_scales

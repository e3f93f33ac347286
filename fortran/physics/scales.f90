! SPDX-License-Identifier: BSD-3-Clause
!> The scales of a contact: units of lengths, films and pressures in metres and pascals
module ehl_scales
   use ehl_kinds, only: dp, pi
   implicit none (type, external)
   private
   public :: scales_t, scales_from_si, circle_factor

   !> Factor k_b of the deflection of a circular contact
   real(dp), parameter :: circle_factor = 2.0_dp/pi**2

   type :: scales_t
      !> Lengths: semi-axis a of the dry contact along the motion, of a line its half width b [m]; films: a^2/R_x [m];
      !> 0: the contact is given by dimensionless parameters
      real(dp) :: length = 0.0_dp, film = 0.0_dp
      !> Pressures: Hertz pressure p_h [Pa]; 0 if viscosity and density are constant
      real(dp) :: pressure = 0.0_dp
   contains
      procedure :: has_size
   end type scales_t

contains

   !> Scales of a dry contact (Hertz 1881): a = (3 w R_x/(pi^2 kappa k_b E'))^(1/3), p_h = 3 w/(2 pi kappa a^2)
   pure function scales_from_si(load, radius, reduced_modulus, ellipticity, kernel_factor) result(scales)
      !> Load w [N], reduced radius R_x in the plane of the motion [m], reduced modulus E' [Pa]
      real(dp), intent(in) :: load, radius, reduced_modulus
      !> kappa, the semi-axis across the motion over a; k_b
      real(dp), intent(in) :: ellipticity, kernel_factor
      type(scales_t) :: scales

      scales%length = (1.5_dp*load*radius/(reduced_modulus*ellipticity*(kernel_factor/circle_factor)))**(1.0_dp/3.0_dp)
      scales%pressure = 1.5_dp*load/(pi*ellipticity*scales%length**2)
      scales%film = scales%length**2/radius
   end function scales_from_si

   !> Whether the size of the contact in metres is known
   pure logical function has_size(self)
      class(scales_t), intent(in) :: self
      has_size = self%length > 0.0_dp
   end function has_size
end module ehl_scales

! SPDX-License-Identifier: BSD-3-Clause
!> The operating point of a contact: Moes parameters and the groups of the dimensionless Reynolds equation. The groups of an
!> elliptical contact are those of a circular one with different M and L (Biboulet & Houpert 2010).
module ehl_moes
   use ehl_kinds, only: dp, pi
   use ehl_scales, only: circle_factor
   implicit none (type, external)
   private
   public :: operating_t, operating_from_moes, round_load

   !> Operating point. Dimensionless unless a unit is given.
   type :: operating_t
      !> Moes load parameter M = W2 (2U)^(-3/4), of a line contact W1 (2U)^(-1/2), and material parameter L = G (2U)^(1/4)
      real(dp) :: moes_m = 0.0_dp, moes_l = 0.0_dp
      !> M of the round contact with the same speed parameter
      real(dp) :: round_m = 0.0_dp
      !> alpha_bar = alpha p_h; circle: (L/pi) (3M/2)^(1/3)
      real(dp) :: alpha_bar = 0.0_dp
      !> Speed parameter lambda_bar = 12 eta0 u R_x^2/(a^3 p_h); circle: (128 pi^3/(3 M^4))^(1/3)
      real(dp) :: speed_parameter = 0.0_dp
   end type operating_t

contains

   !> Operating point from M and L, defined with R_x
   pure function operating_from_moes(moes_m, moes_l, ellipticity, kernel_factor) result(point)
      !> kappa and k_b of the contact
      real(dp), intent(in) :: moes_m, moes_l, ellipticity, kernel_factor
      type(operating_t) :: point
      real(dp) :: ratio, l

      ratio = kernel_factor/circle_factor
      point%round_m = moes_m/(ellipticity*ratio**0.25_dp)
      l = moes_l*ratio**0.75_dp

      point%moes_m = moes_m
      point%moes_l = moes_l
      point%alpha_bar = l/pi*(1.5_dp*point%round_m)**(1.0_dp/3.0_dp)
      point%speed_parameter = (128.0_dp*pi**3/(3.0_dp*point%round_m**4))**(1.0_dp/3.0_dp)
   end function operating_from_moes

   !> M of the round contact with a speed parameter
   pure real(dp) function round_load(speed_parameter)
      real(dp), intent(in) :: speed_parameter
      round_load = (128.0_dp*pi**3/(3.0_dp*speed_parameter**3))**0.25_dp
   end function round_load
end module ehl_moes

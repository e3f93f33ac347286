! SPDX-License-Identifier: BSD-3-Clause
!> Central film thickness by the formula of Nijenbanning, Venner & Moes (1994, Wear 176, 217)
module ehl_film_formula
   use ehl_kinds, only: dp
   implicit none (type, external)
   private
   public :: film_central_formula, starved_film, starved_ratio

contains

   !> Central film scaled by a^2/R_x, for an incompressible lubricant: a blend of the rigid/elastic and
   !> isoviscous/piezoviscous asymptotes, all in the Moes film H^M = (h/R_x)(2U)^(-1/2). Validated for
   !> radius_ratio <= 1.
   pure real(dp) function film_central_formula(moes_m, moes_l, radius_ratio, kernel_ratio) result(film)
      real(dp), intent(in) :: moes_m, moes_l
      !> D = R_x/R_y; kappa k_b over that of a circle, so that a = (1.5 M/kernel_ratio)^(1/3) (2U)^(1/4) R_x
      real(dp), intent(in) :: radius_ratio, kernel_ratio
      real(dp) :: rigid_isoviscous, elastic_isoviscous, rigid_piezoviscous, elastic_piezoviscous, &
                  rigid_limit, s, isoviscous, elastic

      associate (d => radius_ratio)
         elastic = 1.0_dp + 0.006_dp*log(d) + 0.63_dp*d**(4.0_dp/7.0_dp)
         rigid_isoviscous = 145.0_dp*(1.0_dp + 0.796_dp*d**(14.0_dp/15.0_dp))**(-15.0_dp/7.0_dp)/(d*moes_m**2)
         elastic_isoviscous = 3.18_dp*elastic**(-14.0_dp/25.0_dp)*d**(-1.0_dp/15.0_dp)*moes_m**(-2.0_dp/15.0_dp)
         ! 1 + 0.691 d
         rigid_piezoviscous = 1.29_dp*(1.691_dp + 0.691_dp*(d - 1.0_dp))**(-2.0_dp/3.0_dp)*moes_l**(2.0_dp/3.0_dp)
         elastic_piezoviscous = 1.48_dp*elastic**(-7.0_dp/20.0_dp)*d**(-1.0_dp/24.0_dp)*moes_m**(-1.0_dp/12.0_dp) &
                                *moes_l**0.75_dp
         rigid_limit = 1.8_dp/d
      end associate
      s = 1.5_dp*(1.0_dp + exp(-1.2_dp*elastic_isoviscous/rigid_isoviscous))
      isoviscous = rigid_isoviscous**1.5_dp &
                   + (elastic_isoviscous**(-4) + rigid_limit**(-4))**(-3.0_dp/8.0_dp)
      film = isoviscous**(2.0_dp*s/3.0_dp)
      if (moes_l > 0.0_dp) film = film + (rigid_piezoviscous**(-8) + elastic_piezoviscous**(-8))**(-s/8.0_dp)
      film = film**(1.0_dp/s)*(1.5_dp*moes_m/kernel_ratio)**(-2.0_dp/3.0_dp)
   end function film_central_formula

   !> Central film with an oil layer rho H at the inlet (0: flooded), thinner than both: Chevalier, Lubrecht, Cann, Colin & Dalmaz
   !> (1998, J. Tribol. 120, 126), whose exponent is between 2 and 5
   pure real(dp) function starved_film(flooded, layer) result(film)
      real(dp), intent(in) :: flooded, layer
      real(dp), parameter :: exponent = 3.0_dp

      film = flooded
      if (layer > 0.0_dp) film = (flooded**(-exponent) + layer**(-exponent))**(-1.0_dp/exponent)
   end function starved_film

   !> Central film of a point contact over the flooded one if the oil meniscus is at a distance m from the centre:
   !> ((m - 1)/(m* - 1))^0.29 with m* = 1 + 3.06 H^0.58 (Hamrock & Dowson 1977, part IV; at an ellipticity of 6)
   pure real(dp) function starved_ratio(flooded, position) result(ratio)
      !> Flooded film [a^2/R_x], distance [a]
      real(dp), intent(in) :: flooded, position
      ratio = min(1.0_dp, max(position - 1.0_dp, 0.0_dp)/(3.06_dp*flooded**0.58_dp))**0.29_dp
   end function starved_ratio
end module ehl_film_formula

! SPDX-License-Identifier: BSD-3-Clause
!> Central film thickness by the formula of Nijenbanning, Venner & Moes (1994, Wear 176, 217)
module ehl_film_formula
   use ehl_kinds, only: dp
   implicit none (type, external)
   private
   public :: film_central_formula

contains

   !> Central film of a circular contact, scaled by a^2/R, for an incompressible lubricant. Blends the
   !> rigid/elastic, isoviscous/piezoviscous asymptotes, all in the Moes film H^M = (h/R)(2U)^(-1/2).
   pure real(dp) function film_central_formula(moes_m, moes_l) result(film)
      real(dp), intent(in) :: moes_m, moes_l
      real(dp) :: rigid_isoviscous, elastic_isoviscous, rigid_piezoviscous, elastic_piezoviscous, &
                  rigid_limit, s, isoviscous

      rigid_isoviscous = 145.0_dp*1.796_dp**(-15.0_dp/7.0_dp)/moes_m**2
      elastic_isoviscous = 3.18_dp*1.63_dp**(-14.0_dp/25.0_dp)*moes_m**(-2.0_dp/15.0_dp)
      rigid_piezoviscous = 1.29_dp*1.691_dp**(-2.0_dp/3.0_dp)*moes_l**(2.0_dp/3.0_dp)
      elastic_piezoviscous = 1.48_dp*1.63_dp**(-7.0_dp/20.0_dp)*moes_m**(-1.0_dp/12.0_dp)*moes_l**0.75_dp
      rigid_limit = 1.8_dp
      s = 1.5_dp*(1.0_dp + exp(-1.2_dp*elastic_isoviscous/rigid_isoviscous))
      isoviscous = rigid_isoviscous**1.5_dp &
                   + (elastic_isoviscous**(-4) + rigid_limit**(-4))**(-3.0_dp/8.0_dp)
      film = isoviscous**(2.0_dp*s/3.0_dp)
      if (moes_l > 0.0_dp) film = film + (rigid_piezoviscous**(-8) + elastic_piezoviscous**(-8))**(-s/8.0_dp)
      film = film**(1.0_dp/s)*(1.5_dp*moes_m)**(-2.0_dp/3.0_dp)
   end function film_central_formula
end module ehl_film_formula

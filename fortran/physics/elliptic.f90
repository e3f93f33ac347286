! SPDX-License-Identifier: BSD-3-Clause
!> Complete elliptic integrals in Carlson's symmetric form
module ehl_elliptic
   use ehl_kinds, only: dp, pi
   implicit none (type, external)
   private
   public :: complete_rf, complete_rd

contains

   !> R_F(0, x, y) for x, y > 0: pi/2 over the arithmetic-geometric mean of their square roots (DLMF 19.22.8)
   pure real(dp) function complete_rf(x, y)
      real(dp), intent(in) :: x, y
      real(dp) :: a, g, mean

      a = sqrt(x)
      g = sqrt(y)
      do while (abs(a - g) > 4.0_dp*epsilon(1.0_dp)*a)
         mean = 0.5_dp*(a + g)
         g = sqrt(a*g)
         a = mean
      end do
      complete_rf = pi/(a + g)
   end function complete_rf

   !> R_D(0, y, z) for y, z > 0 by duplication (Carlson 1995, Numer. Algorithms 10; DLMF 19.36.2)
   pure real(dp) function complete_rd(y, z)
      real(dp), intent(in) :: y, z
      real(dp) :: p(3), root(3), mean, spread, lambda, power, total, d(3), e2, e3, e4, e5

      p = [0.0_dp, y, z]
      mean = (y + 3.0_dp*z)/5.0_dp
      ! this spread limits the truncation error of the series below to rounding
      spread = (0.25_dp*epsilon(1.0_dp))**(-1.0_dp/6.0_dp)*maxval(abs(mean - p))
      total = 0.0_dp
      power = 1.0_dp
      do while (power*spread >= abs(mean))
         root = sqrt(p)
         lambda = root(1)*root(2) + root(1)*root(3) + root(2)*root(3)
         total = total + power/(root(3)*(p(3) + lambda))
         p = 0.25_dp*(p + lambda)
         mean = 0.25_dp*(mean + lambda)
         power = 0.25_dp*power
      end do
      d = 1.0_dp - p/mean
      d(3) = -(d(1) + d(2))/3.0_dp
      e2 = d(1)*d(2) - 6.0_dp*d(3)**2
      e3 = (3.0_dp*d(1)*d(2) - 8.0_dp*d(3)**2)*d(3)
      e4 = 3.0_dp*(d(1)*d(2) - d(3)**2)*d(3)**2
      e5 = d(1)*d(2)*d(3)**3
      complete_rd = 3.0_dp*total + power*mean**(-1.5_dp) &
                    *(1.0_dp - 3.0_dp*e2/14.0_dp + e3/6.0_dp + 9.0_dp*e2**2/88.0_dp - 3.0_dp*e4/22.0_dp &
                      - 9.0_dp*e2*e3/52.0_dp + 3.0_dp*e5/26.0_dp)
   end function complete_rd
end module ehl_elliptic

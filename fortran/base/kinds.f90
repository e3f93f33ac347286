! SPDX-License-Identifier: BSD-3-Clause
!> Number kinds, taken from iso_c_binding so that the Python interface agrees with the solver, and constants
module ehl_kinds
   use, intrinsic :: iso_c_binding, only: c_double, c_int64_t
   implicit none (type, external)
   private
   public :: dp, not_known, pi

   !> Real numbers of every field and scalar
   integer, parameter :: dp = c_double
   !> The quiet NaN, for unknown values
   real(dp), parameter :: not_known = transfer(int(z"7FF8000000000000", c_int64_t), 1.0_dp)
   real(dp), parameter :: pi = 3.141592653589793238462643383279502884_dp
end module ehl_kinds

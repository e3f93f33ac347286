! SPDX-License-Identifier: BSD-3-Clause
!> Number kinds, taken from iso_c_binding so that the Python face agrees with the solver
module ehl_kinds
   use, intrinsic :: iso_c_binding, only: c_double
   implicit none (type, external)
   private
   public :: dp, pi

   !> Real numbers of every field and scalar
   integer, parameter :: dp = c_double
   real(dp), parameter :: pi = 3.141592653589793238462643383279502884_dp
end module ehl_kinds

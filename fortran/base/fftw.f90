! SPDX-License-Identifier: BSD-3-Clause
!> The Fortran interface of FFTW 3, as distributed with FFTW
module ehl_fftw
   use, intrinsic :: iso_c_binding
   implicit none
   public
   include "fftw3.f03"
end module ehl_fftw

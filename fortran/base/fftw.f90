! SPDX-License-Identifier: BSD-3-Clause
!> The interface of FFTW 3, as FFTW ships it
module ehl_fftw
   use, intrinsic :: iso_c_binding
   implicit none
   public
   include "fftw3.f03"
end module ehl_fftw

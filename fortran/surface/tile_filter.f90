! SPDX-License-Identifier: BSD-3-Clause
!> Filter of a spectrum with a shortest and a longest cut-off wavelength, sharp or Gaussian
module ehl_tile_filter
   use, intrinsic :: iso_c_binding, only: c_double_complex
   use ehl_fftw_planner, only: to_heights, to_spectrum
   use ehl_kinds, only: dp, pi
   use ehl_status, only: ehl_bad_input, status_t
   implicit none (type, external)
   private
   public :: filter_t, filter_spectrum, filter_heights

   !> Cut-offs of a filter. Lengths in any common unit.
   type :: filter_t
      !> Shortest and longest wavelength 2 pi/|q| that passes; 0: no limit
      real(dp) :: shortest = 0.0_dp, longest = 0.0_dp
      !> Whether the filters are areal Gaussian filters (ISO 16610-61), which pass half of the amplitude at the cut-off. Otherwise
      !> they are sharp.
      logical :: gaussian = .false.
   contains
      procedure :: transmission
      procedure :: passes_all
   end type filter_t

contains

   !> Fraction of the amplitude of waves of wavenumber |q| [rad per length] that passes.
   !> Sharp: 1 for 2 pi/longest <= |q| <= 2 pi/shortest, else 0. Gaussian: exp(-pi (alpha shortest/l)^2) times
   !> 1 - exp(-pi (alpha longest/l)^2) with l = 2 pi/|q| and alpha = sqrt(ln 2/pi). The mean (q = 0) is removed by `longest`.
   elemental real(dp) function transmission(self, q)
      class(filter_t), intent(in) :: self
      real(dp), intent(in) :: q
      !> pi alpha^2
      real(dp), parameter :: exponent = log(2.0_dp)
      !> Tolerance for rounding of the wavenumber, so that a wave at the cut-off passes
      real(dp), parameter :: slack = 1.0e-12_dp
      real(dp) :: ratio(2)

      ! wavelengths of the cut-offs over that of the wave
      ratio = [self%shortest, self%longest]*q/(2.0_dp*pi)
      transmission = 1.0_dp
      if (self%gaussian) then
         if (self%shortest > 0.0_dp) transmission = exp(-exponent*ratio(1)**2)
         if (self%longest > 0.0_dp) transmission = transmission*(1.0_dp - exp(-exponent*ratio(2)**2))
      else
         if (self%shortest > 0.0_dp .and. ratio(1) > 1.0_dp + slack) transmission = 0.0_dp
         if (self%longest > 0.0_dp .and. ratio(2) < 1.0_dp - slack) transmission = 0.0_dp
      end if
   end function transmission

   !> Whether the filter changes nothing
   pure logical function passes_all(self)
      class(filter_t), intent(in) :: self
      passes_all = .not. (self%shortest > 0.0_dp .or. self%longest > 0.0_dp)
   end function passes_all

   !> Filter half a spectrum (nx/2 + 1, ny) of a tile of size length_x by length_y
   pure subroutine filter_spectrum(filter, spectrum, length_x, length_y)
      type(filter_t), intent(in) :: filter
      complex(c_double_complex), intent(inout) :: spectrum(:, :)
      real(dp), intent(in) :: length_x, length_y
      real(dp) :: qx, qy
      integer :: i, j, ny

      if (filter%passes_all()) return
      ny = size(spectrum, 2)
      do j = 1, ny
         qy = 2.0_dp*pi*merge(j - 1, j - 1 - ny, 2*(j - 1) <= ny)/length_y
         do i = 1, size(spectrum, 1)
            qx = 2.0_dp*pi*(i - 1)/length_x
            spectrum(i, j) = spectrum(i, j)*filter%transmission(hypot(qx, qy))
         end do
      end do
   end subroutine filter_spectrum

   !> Filter the heights of a periodic tile, at least 2 x 2
   subroutine filter_heights(filter, heights, length_x, length_y, status)
      type(filter_t), intent(in) :: filter
      real(dp), intent(inout) :: heights(:, :)
      real(dp), intent(in) :: length_x, length_y
      type(status_t), intent(inout) :: status
      complex(c_double_complex), allocatable :: spectrum(:, :)

      if (status%failed() .or. filter%passes_all()) return
      if (minval(shape(heights)) < 2 .or. .not. min(length_x, length_y) > 0.0_dp) then
         call status%fail(ehl_bad_input, "a tile to filter needs at least 2 x 2 heights and positive lengths")
         return
      end if
      call to_spectrum(heights, spectrum, status)
      if (status%failed()) return
      call filter_spectrum(filter, spectrum, length_x, length_y)
      call to_heights(spectrum, heights, status)
   end subroutine filter_heights
end module ehl_tile_filter

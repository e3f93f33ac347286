! SPDX-License-Identifier: BSD-3-Clause
!> Self-affine surfaces with random phases: C2D proportional to max(|q|, q_r)^(-2 - 2 Hurst) up to the Nyquist
!> wavenumbers of the tile, zero at q = 0; zero mean, exact rms height, periodic. The phases come from the raw
!> words of PCG64, component by component (q_x slowest): a seed defines the same surface in every program.
module ehl_fractal
   use, intrinsic :: iso_c_binding, only: c_double_complex
   use, intrinsic :: iso_fortran_env, only: int32
   use ehl_fftw_planner, only: to_heights
   use ehl_kinds, only: dp, pi
   use ehl_pcg64, only: pcg64_t
   use ehl_status, only: ehl_no_memory, status_t
   use ehl_text, only: to_text
   implicit none (type, external)
   private
   public :: fractal_t, make_fractal

   !> Parameters of a fractal surface
   type :: fractal_t
      !> Size of the tile along X and Y [m]
      real(dp) :: length_x = 1.0_dp, length_y = 1.0_dp
      !> Rms height [m]
      real(dp) :: rms_height = 1.0_dp
      !> Hurst exponent, and the wavenumber below which the spectrum is flat [rad/m], 0: none
      real(dp) :: hurst = 0.8_dp, rolloff_wavenumber = 0.0_dp
      !> Seed as 32-bit words, the lowest first
      integer(int32), allocatable :: seed(:)
      !> Whether the moduli of the components are random, as in a Gaussian field; otherwise they follow the power law exactly
      logical :: gaussian = .false.
      !> Correlation length along X over that along Y; the roll-off applies to the shorter one
      real(dp) :: lay_ratio = 1.0_dp
   end type fractal_t

contains

   !> Heights [m] of a surface, heights(ny, nx): Y first, in the order of the components
   subroutine make_fractal(what, heights, status)
      type(fractal_t), intent(in) :: what
      real(dp), intent(out) :: heights(:, :)
      type(status_t), intent(inout) :: status
      complex(c_double_complex), allocatable :: component(:, :)
      type(pcg64_t) :: bits
      real(dp) :: sums(size(heights, 2)), mean, rms, u, qx, qy
      integer :: i, j, nx, ny, stat

      heights = 0.0_dp
      if (status%failed()) return
      ny = size(heights, 1)
      nx = size(heights, 2)
      allocate (component(ny/2 + 1, nx), stat=stat)
      if (stat /= 0) then
         call status%fail(ehl_no_memory, "no memory for a fractal surface of "//to_text(nx)//" x "//to_text(ny)//" pixels")
         return
      end if
      call bits%seed(what%seed)
      do i = 1, nx
         do j = 1, ny/2 + 1
            u = 2.0_dp*pi*bits%uniform()
            component(j, i) = cmplx(cos(u), sin(u), dp)
         end do
      end do
      if (what%gaussian) then
         do i = 1, nx
            do j = 1, ny/2 + 1
               ! 1 - u is exact: the number is a multiple of 2^-53
               component(j, i) = component(j, i)*sqrt(-log(1.0_dp - bits%uniform()))
            end do
         end do
      end if
      call make_hermitian(component, ny, what%gaussian)
      do i = 1, nx
         qx = 2.0_dp*pi*merge(i - 1, i - 1 - nx, 2*(i - 1) < nx)/what%length_x*max(1.0_dp, what%lay_ratio)
         do j = 1, ny/2 + 1
            if (i == 1 .and. j == 1) cycle
            qy = 2.0_dp*pi*(j - 1)/what%length_y/min(1.0_dp, what%lay_ratio)
            component(j, i) = component(j, i)*max(hypot(qx, qy), what%rolloff_wavenumber)**(-1.0_dp - what%hurst)
         end do
      end do
      component(1, 1) = (0.0_dp, 0.0_dp)
      call to_heights(component, heights, status)
      if (status%failed()) return
      do i = 1, nx
         sums(i) = sum(heights(:, i))
      end do
      mean = sum(sums)/(real(nx, dp)*ny)
      do i = 1, nx
         heights(:, i) = heights(:, i) - mean
         sums(i) = sum(heights(:, i)**2)
      end do
      rms = sqrt(sum(sums)/(real(nx, dp)*ny))
      do i = 1, nx
         heights(:, i) = heights(:, i)*(what%rms_height/rms)
      end do
   end subroutine make_fractal

   !> Impose the symmetry of a real surface on the rows q_y = 0 and Nyquist of a half spectrum: component (q_x, q_y) there is
   !> the conjugate of (-q_x, q_y). The up to four self-conjugate components are real: a random sign at the
   !> given modulus or, for a Gaussian field, a normal random number of the same mean square.
   subroutine make_hermitian(component, ny, gaussian)
      complex(c_double_complex), intent(inout) :: component(:, :)
      integer, intent(in) :: ny
      logical, intent(in) :: gaussian
      integer :: i, j, m, nx

      nx = size(component, 2)
      do j = 1, ny/2 + 1
         if (j > 1 .and. 2*(j - 1) /= ny) cycle
         do m = 1, (nx - 1)/2
            component(j, nx + 1 - m) = conjg(component(j, 1 + m))
         end do
         do i = 1, nx
            if (i > 1 .and. 2*(i - 1) /= nx) cycle
            if (gaussian) then
               component(j, i) = sqrt(2.0_dp)*component(j, i)%re
            else
               component(j, i) = sign(abs(component(j, i)), component(j, i)%re)
            end if
         end do
      end do
   end subroutine make_hermitian
end module ehl_fractal

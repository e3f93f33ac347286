! SPDX-License-Identifier: BSD-3-Clause
!> The three passes of a convolution by FFT over the data: along X, along Y and back, along X
module ehl_fft_passes
   use, intrinsic :: iso_c_binding, only: c_ptr, c_double_complex
   use ehl_kinds, only: dp
   use ehl_fftw, only: fftw_execute_dft_r2c, fftw_execute_dft_c2r, fftw_execute_dft
   !$ use omp_lib, only: omp_get_thread_num
   implicit none (type, external)
   private
   public :: side_by_side, rows_to_spectra, convolve_columns, spectra_to_rows

   integer, parameter :: zp = c_double_complex
   !> Columns transformed together along Y: two cache lines of every row
   integer, parameter :: side_by_side = 8

contains

   !> Rows first..last of p, padded, to spectra
   subroutine rows_to_spectra(nx, ny, lx, nk, first, last, threads, plan, p, row, spectrum)
      integer, intent(in) :: nx, ny, lx, nk, first, last, threads
      type(c_ptr), intent(in) :: plan
      real(dp), intent(in) :: p(:, :)
      real(dp), intent(inout) :: row(lx, threads)
      complex(zp), intent(inout) :: spectrum(nk, ny)
      integer :: j, me

      !$omp parallel num_threads(threads) default(none) private(j, me) &
      !$omp shared(nx, first, last, plan, p, row, spectrum)
      me = 1
      !$ me = omp_get_thread_num() + 1
      !$omp do schedule(dynamic, 8)
      do j = first, last
         row(:nx, me) = p(:, j)
         row(nx + 1:, me) = 0.0_dp
         call fftw_execute_dft_r2c(plan, row(:, me), spectrum(:, j))
      end do
      !$omp end do
      !$omp end parallel
   end subroutine rows_to_spectra

   !> Spectra of rows first..last in, spectra of the deflection of all rows out
   subroutine convolve_columns(ny, ly, nk, first, last, mirror, threads, forward, backward, &
                               kernel, spectrum, columns)
      integer, intent(in) :: ny, ly, nk, first, last, threads
      logical, intent(in) :: mirror
      type(c_ptr), intent(in) :: forward, backward
      real(dp), intent(in) :: kernel(0:ly/2, nk)
      complex(zp), intent(inout) :: spectrum(nk, ny)
      complex(zp), intent(inout) :: columns(0:ly - 1, side_by_side, 2, threads)
      integer :: c, j, k, me, start, width

      !$omp parallel num_threads(threads) default(none) private(c, j, k, me, start, width) &
      !$omp shared(ny, ly, nk, first, last, mirror, forward, backward, kernel, spectrum, columns)
      me = 1
      !$ me = omp_get_thread_num() + 1
      !$omp do schedule(dynamic, 1)
      do start = 1, nk, side_by_side
         width = min(side_by_side, nk - start + 1)
         columns(:, :, 1, me) = (0.0_dp, 0.0_dp)
         do j = first, last
            do c = 1, width
               columns(j - 1, c, 1, me) = spectrum(start + c - 1, j)
            end do
         end do
         if (mirror) then
            do c = 1, width
               do j = max(first, 2), last
                  columns(ly - j + 1, c, 1, me) = columns(j - 1, c, 1, me)
               end do
            end do
         end if
         call fftw_execute_dft(forward, columns(:, :, 1, me), columns(:, :, 2, me))
         do c = 1, width
            do k = 0, ly/2
               columns(k, c, 2, me) = columns(k, c, 2, me)*kernel(k, start + c - 1)
            end do
            do k = 1, ly/2 - 1
               columns(ly - k, c, 2, me) = columns(ly - k, c, 2, me)*kernel(k, start + c - 1)
            end do
         end do
         call fftw_execute_dft(backward, columns(:, :, 2, me), columns(:, :, 1, me))
         do j = 1, ny
            do c = 1, width
               spectrum(start + c - 1, j) = columns(j - 1, c, 1, me)
            end do
         end do
      end do
      !$omp end do
      !$omp end parallel
   end subroutine convolve_columns

   !> Spectra back to the deflection; they are destroyed
   subroutine spectra_to_rows(nx, ny, lx, nk, threads, plan, spectrum, row, w)
      integer, intent(in) :: nx, ny, lx, nk, threads
      type(c_ptr), intent(in) :: plan
      complex(zp), intent(inout) :: spectrum(nk, ny)
      real(dp), intent(inout) :: row(lx, threads)
      real(dp), intent(out) :: w(:, :)
      integer :: j, me

      !$omp parallel num_threads(threads) default(none) private(j, me) &
      !$omp shared(nx, ny, plan, spectrum, row, w)
      me = 1
      !$ me = omp_get_thread_num() + 1
      !$omp do schedule(dynamic, 8)
      do j = 1, ny
         call fftw_execute_dft_c2r(plan, spectrum(:, j), row(:, me))
         w(:, j) = row(:nx, me)
      end do
      !$omp end do
      !$omp end parallel
   end subroutine spectra_to_rows
end module ehl_fft_passes

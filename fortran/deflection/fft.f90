! SPDX-License-Identifier: BSD-3-Clause
!> Deflection by zero-padded real FFTs: exact to rounding
!>
!> The sum over n nodes per side is a circular convolution of length 2(n-1) or more: at 2(n-1) the offsets -(n-1)
!> and n-1 coincide, but the kernel is even, so the result is exact for any P on
!> the border. The kernel's transform is real. Rows of zeros that pad Y are never transformed in X: rows
!> 1..ny are transformed to spectra, then a few columns at a time are gathered, padded, transformed along
!> Y, multiplied and transformed back while they are in the cache, and only the rows needed
!> are transformed back in X. Rows of zero pressure beside the borders are skipped. On a folded grid columns are completed by
!> their mirror image; FFTW's cosine transforms took three times as long. A strip is periodic along Y: its columns
!> are not padded, and a strip of one row is not transformed along Y.
module ehl_fft
   use, intrinsic :: iso_c_binding, only: c_ptr, c_null_ptr, c_associated, c_f_pointer, &
      c_int, c_size_t, c_double_complex
   use, intrinsic :: iso_fortran_env, only: int64
   use ehl_kinds, only: dp
   use ehl_grid, only: grid_t
   use ehl_status, only: status_t, ehl_no_memory, ehl_internal
   use ehl_deflection, only: deflection_t
   use ehl_kernel, only: fill_grid_kernel, fill_kernel
   use ehl_fftw, only: fftw_alloc_real, fftw_alloc_complex, fftw_free, &
      fftw_plan_r2r_1d, fftw_plan_r2r_2d, fftw_plan_dft_r2c_1d, fftw_plan_dft_c2r_1d, fftw_plan_many_dft, &
      fftw_execute_r2r, fftw_execute_dft_r2c, fftw_execute_dft_c2r, fftw_execute_dft, FFTW_ESTIMATE, &
      FFTW_REDFT00, FFTW_FORWARD, FFTW_BACKWARD
   use ehl_fftw_planner, only: drop_plan, good_size, lock_planner, unlock_planner
   !$ use omp_lib, only: omp_get_thread_num
   implicit none (type, external)
   private
   public :: fft_deflection_t

   integer, parameter :: zp = c_double_complex
   !> Columns transformed together along Y: two cache lines of every row
   integer, parameter :: side_by_side = 8

   !> Convolution by FFTW. Owns plans and aligned memory: not to be copied by assignment.
   type, extends(deflection_t) :: fft_deflection_t
      private
      integer :: nx = 0, ny = 0, threads = 1
      !> Padded lengths, and number of complex values in the spectrum of a row
      integer :: lx = 0, ly = 0, nk = 0
      logical :: mirror = .false.
      type(c_ptr) :: row_forward = c_null_ptr, row_backward = c_null_ptr
      type(c_ptr) :: column_forward = c_null_ptr, column_backward = c_null_ptr
      !> Transform of the kernel divided by lx*ly, real: offsets (0:ly/2, 0:lx/2)
      real(dp), pointer, contiguous :: kernel(:, :) => null()
      !> Spectra of the rows: (nk, ny)
      complex(zp), pointer, contiguous :: spectrum(:, :) => null()
      !> One padded row per thread: (lx, threads)
      real(dp), pointer, contiguous :: row(:, :) => null()
      !> Two blocks of padded columns per thread: (ly*side_by_side, 2, threads)
      complex(zp), pointer, contiguous :: columns(:, :, :) => null()
      type(c_ptr) :: storage(4) = c_null_ptr
      integer(int64) :: allocated_bytes = 0
   contains
      procedure :: setup
      procedure :: apply
      procedure :: bytes
      final :: release
   end type fft_deflection_t

contains

   !> Prepare for a grid; exact to rounding, whatever `accuracy`
   subroutine setup(self, grid, factor, accuracy, threads, status)
      class(fft_deflection_t), intent(inout) :: self
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: factor, accuracy
      integer, intent(in) :: threads
      type(status_t), intent(inout) :: status

      associate (unused => accuracy)
      end associate
      call clear(self)
      self%nx = grid%nx
      self%ny = grid%ny
      self%mirror = grid%mirror
      self%threads = max(1, threads)
      self%lx = 2*good_size(grid%nx - 1)
      self%ly = 2*good_size(grid%full_ny() - 1)
      if (grid%periodic) self%ly = grid%full_ny()
      self%nk = self%lx/2 + 1
      call reserve(self, status)
      if (status%failed()) return
      call lock_planner(status)
      if (status%failed()) return
      call make_plans(self)
      call unlock_planner(status)
      if (.not. (c_associated(self%row_forward) .and. c_associated(self%row_backward) .and. &
                 c_associated(self%column_forward) .and. c_associated(self%column_backward))) then
         call status%fail(ehl_internal, "FFTW made no plan for the deflection")
         return
      end if
      call transform_kernel(self, grid, factor, status)
   end subroutine setup

   !> W = K P
   subroutine apply(self, p, w)
      class(fft_deflection_t), intent(inout) :: self
      real(dp), intent(in) :: p(:, :)
      real(dp), intent(out) :: w(:, :)
      integer :: first, last

      do first = 1, self%ny
         if (.not. all(abs(p(:, first)) <= 0.0_dp)) exit
      end do
      if (first > self%ny) then
         w = 0.0_dp
         return
      end if
      do last = self%ny, first, -1
         if (.not. all(abs(p(:, last)) <= 0.0_dp)) exit
      end do
      call rows_to_spectra(self%nx, self%ny, self%lx, self%nk, first, last, self%threads, &
                           self%row_forward, p, self%row, self%spectrum)
      if (self%ny == 1) then
         self%spectrum(:, 1) = self%spectrum(:, 1)*self%kernel(1, :)
      else
         call convolve_columns(self%ny, self%ly, self%nk, first, last, self%mirror, self%threads, &
                               self%column_forward, self%column_backward, self%kernel, &
                               self%spectrum, self%columns)
      end if
      call spectra_to_rows(self%nx, self%ny, self%lx, self%nk, self%threads, &
                           self%row_backward, self%spectrum, self%row, w)
   end subroutine apply

   !> Transform rows first..last of p, padded, to spectra
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

   !> Convolve along Y: in, spectra of rows first..last; out, spectra of the deflection of all rows
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

   !> Transform the spectra back to the deflection; overwrites the spectra
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

   !> Allocated bytes
   pure integer(int64) function bytes(self)
      class(fft_deflection_t), intent(in) :: self
      bytes = self%allocated_bytes
   end function bytes

   !> Aligned memory for spectra, kernel and the threads' buffers
   subroutine reserve(self, status)
      type(fft_deflection_t), intent(inout) :: self
      type(status_t), intent(inout) :: status
      integer(c_size_t) :: reals(2), complexes(2)

      reals(1) = int(self%ly/2 + 1, c_size_t)*self%nk
      reals(2) = int(self%lx, c_size_t)*self%threads
      complexes(1) = int(self%nk, c_size_t)*self%ny
      complexes(2) = int(self%ly, c_size_t)*side_by_side*2*self%threads
      self%storage(1) = fftw_alloc_real(reals(1))
      self%storage(2) = fftw_alloc_real(reals(2))
      self%storage(3) = fftw_alloc_complex(complexes(1))
      self%storage(4) = fftw_alloc_complex(complexes(2))
      if (.not. (c_associated(self%storage(1)) .and. c_associated(self%storage(2)) .and. &
                 c_associated(self%storage(3)) .and. c_associated(self%storage(4)))) then
         call clear(self)
         call status%fail(ehl_no_memory, "no memory for the FFT deflection")
         return
      end if
      self%allocated_bytes = 8*sum(int(reals, int64)) + 16*sum(int(complexes, int64))
      call c_f_pointer(self%storage(1), self%kernel, [self%ly/2 + 1, self%nk])
      call c_f_pointer(self%storage(2), self%row, [self%lx, self%threads])
      call c_f_pointer(self%storage(3), self%spectrum, [self%nk, self%ny])
      call c_f_pointer(self%storage(4), self%columns, [self%ly*side_by_side, 2, self%threads])
   end subroutine reserve

   !> Make the four one-dimensional plans; the caller must have locked the planner
   subroutine make_plans(self)
      type(fft_deflection_t), intent(inout) :: self
      integer(c_int) :: length(1)

      length = self%ly
      self%row_forward = fftw_plan_dft_r2c_1d(self%lx, self%row, self%spectrum, FFTW_ESTIMATE)
      self%row_backward = fftw_plan_dft_c2r_1d(self%lx, self%spectrum, self%row, FFTW_ESTIMATE)
      self%column_forward = fftw_plan_many_dft( &
         1, length, side_by_side, self%columns(:, 1, 1), length, 1, self%ly, &
         self%columns(:, 2, 1), length, 1, self%ly, FFTW_FORWARD, FFTW_ESTIMATE)
      self%column_backward = fftw_plan_many_dft( &
         1, length, side_by_side, self%columns(:, 2, 1), length, 1, self%ly, &
         self%columns(:, 1, 1), length, 1, self%ly, FFTW_BACKWARD, FFTW_ESTIMATE)
   end subroutine make_plans

   !> Cosine transform of the kernel, scaled for a forward and a backward transform
   subroutine transform_kernel(self, grid, factor, status)
      type(fft_deflection_t), intent(inout) :: self
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: factor
      type(status_t), intent(inout) :: status
      type(c_ptr) :: plan
      real(dp), pointer, contiguous :: in_place(:, :)
      real(dp), allocatable :: table(:, :)

      in_place => self%kernel
      call lock_planner(status)
      if (status%failed()) return
      if (grid%is_row()) then
         plan = fftw_plan_r2r_1d(self%nk, self%kernel, in_place, FFTW_REDFT00, FFTW_ESTIMATE)
      else
         plan = fftw_plan_r2r_2d(self%nk, self%ly/2 + 1, self%kernel, in_place, &
                                 FFTW_REDFT00, FFTW_REDFT00, FFTW_ESTIMATE)
      end if
      call unlock_planner(status)
      if (.not. c_associated(plan)) then
         call status%fail(ehl_internal, "FFTW made no plan for the kernel of the deflection")
         return
      end if
      ! the first index of the table is the offset in Y
      if (grid%periodic) then
         allocate (table(self%nk, self%ly/2 + 1))
         call fill_grid_kernel(grid, factor, table)
         self%kernel(:, :) = transpose(table)
      else
         call fill_kernel(self%kernel, factor, grid%hy, grid%hx, [1, 1])
      end if
      call fftw_execute_r2r(plan, self%kernel, in_place)
      self%kernel = self%kernel/(real(self%lx, dp)*real(self%ly, dp))
      call drop_plan(plan)
   end subroutine transform_kernel

   !> Release plans and memory
   subroutine clear(self)
      type(fft_deflection_t), intent(inout) :: self
      integer :: k

      call drop_plan(self%row_forward)
      call drop_plan(self%row_backward)
      call drop_plan(self%column_forward)
      call drop_plan(self%column_backward)
      nullify (self%kernel, self%spectrum, self%row, self%columns)
      do k = 1, size(self%storage)
         if (c_associated(self%storage(k))) call fftw_free(self%storage(k))
         self%storage(k) = c_null_ptr
      end do
      self%allocated_bytes = 0
   end subroutine clear

   !> Finalizer
   subroutine release(self)
      type(fft_deflection_t), intent(inout) :: self
      call clear(self)
   end subroutine release
end module ehl_fft

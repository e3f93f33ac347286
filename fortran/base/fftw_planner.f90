! SPDX-License-Identifier: BSD-3-Clause
!> FFTW's planner, which only one thread may use at a time, and the transforms of tiles. Executing plans needs no lock.
module ehl_fftw_planner
   use, intrinsic :: iso_c_binding, only: c_associated, c_double_complex, c_f_pointer, c_int, c_loc, c_null_ptr, c_ptr
   use ehl_fftw, only: fftw_destroy_plan, fftw_estimate, fftw_execute_dft_c2r, fftw_execute_dft_r2c, fftw_execute_r2r, &
                       fftw_plan_dft_1d, fftw_plan_dft_c2r_1d, fftw_plan_dft_c2r_2d, fftw_plan_dft_r2c_2d, &
                       fftw_plan_r2r_2d, fftw_redft10
   use ehl_kinds, only: dp
   use ehl_lock, only: lock, lock_t, unlock
   use ehl_status, only: ehl_internal, ehl_no_memory, status_t
   use ehl_text, only: to_text
   implicit none (type, external)
   private
   public :: lock_planner, unlock_planner, drop_plan
   public :: plan_complex, plan_to_real, to_spectrum, to_cosines, to_heights, good_size

   type(lock_t), target :: planner

contains

   !> Reserve the planner for this thread; after a failure the caller must not create a plan
   subroutine lock_planner(status)
      type(status_t), intent(inout) :: status
      call lock(planner, status)
   end subroutine lock_planner

   !> Release the planner for other threads
   subroutine unlock_planner(status)
      type(status_t), intent(inout) :: status
      call unlock(planner, status)
   end subroutine unlock_planner

   !> Destroy a plan if there is one; if the lock fails it is left allocated, which is safe
   subroutine drop_plan(plan)
      type(c_ptr), intent(inout) :: plan
      type(status_t) :: status

      if (.not. c_associated(plan)) return
      call lock_planner(status)
      if (.not. status%failed()) call fftw_destroy_plan(plan)
      if (.not. status%failed()) call unlock_planner(status)
      plan = c_null_ptr
   end subroutine drop_plan

   !> Release the planner; an error if FFTW has made no plan
   subroutine finish_planning(plan, what, status)
      type(c_ptr), intent(in) :: plan
      !> Purpose of the plan, for the message
      character(len=*), intent(in) :: what
      type(status_t), intent(inout) :: status

      call unlock_planner(status)
      if (.not. c_associated(plan)) call status%fail(ehl_internal, "FFTW made no plan for "//what)
   end subroutine finish_planning

   !> Plan of a complex transform in place
   subroutine plan_complex(plan, n, work, direction, status)
      type(c_ptr), intent(out) :: plan
      integer, intent(in) :: n
      complex(c_double_complex), intent(inout), target, contiguous :: work(:)
      !> fftw_forward or fftw_backward
      integer(c_int), intent(in) :: direction
      type(status_t), intent(inout) :: status
      complex(c_double_complex), pointer, contiguous :: same(:)

      plan = c_null_ptr
      same => work
      call lock_planner(status)
      if (status%failed()) return
      plan = fftw_plan_dft_1d(int(n, c_int), work, same, direction, fftw_estimate)
      call finish_planning(plan, "a complex transform", status)
   end subroutine plan_complex

   !> Plan of a transform from half a spectrum to n real values
   subroutine plan_to_real(plan, n, spectrum, values, status)
      type(c_ptr), intent(out) :: plan
      integer, intent(in) :: n
      !> Shapes (n/2 + 1) and (n)
      complex(c_double_complex), intent(inout) :: spectrum(:)
      real(dp), intent(inout) :: values(:)
      type(status_t), intent(inout) :: status

      plan = c_null_ptr
      call lock_planner(status)
      if (status%failed()) return
      plan = fftw_plan_dft_c2r_1d(int(n, c_int), spectrum, values, fftw_estimate)
      call finish_planning(plan, "a real transform", status)
   end subroutine plan_to_real

   !> Half spectrum (n1/2 + 1, n2) of values (n1, n2), divided by n1 n2: amplitudes of exp(i(k1 x1 + k2 x2)).
   !> Needs no memory except that of the spectrum.
   subroutine to_spectrum(values, spectrum, status)
      real(dp), intent(in) :: values(:, :)
      complex(c_double_complex), allocatable, target, intent(out) :: spectrum(:, :)
      type(status_t), intent(inout) :: status
      real(dp), pointer, contiguous :: padded(:, :)
      type(c_ptr) :: plan
      integer :: j, n(2), stat

      if (status%failed()) return
      n = shape(values)
      allocate (spectrum(n(1)/2 + 1, n(2)), stat=stat)
      if (stat /= 0) then
         call status%fail(ehl_no_memory, "no memory for the spectrum of "//to_text(n(1))//" x "//to_text(n(2))//" heights")
         return
      end if
      call c_f_pointer(c_loc(spectrum), padded, [2*(n(1)/2 + 1), n(2)])
      call lock_planner(status)
      if (status%failed()) return
      plan = fftw_plan_dft_r2c_2d(int(n(2), c_int), int(n(1), c_int), padded, spectrum, fftw_estimate)
      call finish_planning(plan, "the spectrum of a tile", status)
      if (status%failed()) return
      do j = 1, n(2)
         padded(:n(1), j) = values(:, j)
      end do
      call fftw_execute_dft_r2c(plan, padded, spectrum)
      call drop_plan(plan)
      do j = 1, n(2)
         spectrum(:, j) = spectrum(:, j)/(real(n(1), dp)*n(2))
      end do
   end subroutine to_spectrum

   !> Cosine transform (DCT-II) of values (n1, n2), divided by 4 n1 n2: amplitudes of the waves of a (2 n1, 2 n2) tile, the values
   !> mirrored half a pixel before the first one along both axes. Needs no memory except that of the result.
   subroutine to_cosines(values, cosines, status)
      real(dp), intent(in) :: values(:, :)
      real(dp), allocatable, target, intent(out) :: cosines(:, :)
      type(status_t), intent(inout) :: status
      real(dp), pointer, contiguous :: same(:, :)
      type(c_ptr) :: plan
      integer :: j, n(2), stat

      if (status%failed()) return
      n = shape(values)
      allocate (cosines(n(1), n(2)), stat=stat)
      if (stat /= 0) then
         call status%fail(ehl_no_memory, "no memory for the waves of "//to_text(n(1))//" x "//to_text(n(2))//" heights")
         return
      end if
      same => cosines
      call lock_planner(status)
      if (status%failed()) return
      plan = fftw_plan_r2r_2d(int(n(2), c_int), int(n(1), c_int), cosines, same, fftw_redft10, fftw_redft10, fftw_estimate)
      call finish_planning(plan, "the waves of a mirrored map", status)
      if (status%failed()) return
      do j = 1, n(2)
         cosines(:, j) = values(:, j)
      end do
      call fftw_execute_r2r(plan, cosines, same)
      call drop_plan(plan)
      do j = 1, n(2)
         cosines(:, j) = cosines(:, j)/(4.0_dp*n(1)*n(2))
      end do
   end subroutine to_cosines

   !> The inverse of to_spectrum; overwrites the spectrum
   subroutine to_heights(spectrum, values, status)
      complex(c_double_complex), allocatable, target, intent(inout) :: spectrum(:, :)
      real(dp), intent(out) :: values(:, :)
      type(status_t), intent(inout) :: status
      real(dp), pointer, contiguous :: padded(:, :)
      type(c_ptr) :: plan
      integer :: j, n(2)

      values = 0.0_dp
      if (status%failed()) return
      n = shape(values)
      call c_f_pointer(c_loc(spectrum), padded, [2*(n(1)/2 + 1), n(2)])
      call lock_planner(status)
      if (status%failed()) return
      plan = fftw_plan_dft_c2r_2d(int(n(2), c_int), int(n(1), c_int), spectrum, padded, fftw_estimate)
      call finish_planning(plan, "the heights of a tile", status)
      if (status%failed()) return
      call fftw_execute_dft_c2r(plan, spectrum, padded)
      call drop_plan(plan)
      do j = 1, n(2)
         values(:, j) = padded(:n(1), j)
      end do
      deallocate (spectrum)
   end subroutine to_heights

   !> Smallest number >= n without prime factors above 7
   pure integer function good_size(n)
      integer, intent(in) :: n
      integer :: rest, k
      integer, parameter :: primes(4) = [2, 3, 5, 7]

      good_size = max(n, 1)
      do
         rest = good_size
         do k = 1, size(primes)
            do while (mod(rest, primes(k)) == 0)
               rest = rest/primes(k)
            end do
         end do
         if (rest == 1) return
         good_size = good_size + 1
      end do
   end function good_size
end module ehl_fftw_planner

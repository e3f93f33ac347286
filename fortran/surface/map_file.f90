! SPDX-License-Identifier: BSD-3-Clause
!> Height maps from .npy files
module ehl_map_file
   use ehl_kinds, only: dp
   use ehl_memory, only: check_memory
   use ehl_npy, only: npy_shape, read_npy
   use ehl_status, only: ehl_file, status_t
   use ehl_text, only: to_text
   implicit none (type, external)
   private
   public :: read_map, check_heights

contains

   !> Read the heights of a map [m], X first; they must be finite, at least 4 x 4 pixels
   subroutine read_map(path, heights, status)
      character(len=*), intent(in) :: path
      real(dp), allocatable, intent(out) :: heights(:, :)
      type(status_t), intent(inout) :: status
      integer :: n(2), j

      call npy_shape(path, n, status)
      call check_heights(path, n, status)
      allocate (heights(0, 0))
      if (.not. status%failed()) call read_npy(path, heights, status)
      if (status%failed()) return
      do j = 1, size(heights, 2)
         if (all(abs(heights(:, j)) < huge(1.0_dp))) cycle
         call status%fail(ehl_file, path//": the map has points that are not finite: fill them first")
         return
      end do
      if (size(heights, 1) < 4 .or. size(heights, 2) < 4) then
         call status%fail(ehl_file, path//": the map has "//to_text(size(heights, 1))//" x "// &
                          to_text(size(heights, 2))//" pixels; at least 4 x 4 are needed")
      end if
   end subroutine read_map

   !> Fail if the memory does not suffice for the heights of a map and their spectrum; FFTW would abort
   subroutine check_heights(what, n, status)
      !> Name of the map, for messages
      character(len=*), intent(in) :: what
      !> Pixels along X and Y
      integer, intent(in) :: n(2)
      type(status_t), intent(inout) :: status
      !> Bytes that FFTW needs to plan and execute a transform, measured on 1024 x 1024 and 1500 x 1500 heights
      real(dp), parameter :: fftw_bytes = 3.0e6_dp

      call check_memory(what//": a map of "//to_text(n(1))//" x "//to_text(n(2))//" heights", &
                        16.0_dp*n(1)*real(n(2), dp) + fftw_bytes, status)
   end subroutine check_heights
end module ehl_map_file

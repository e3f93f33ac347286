! SPDX-License-Identifier: BSD-3-Clause
!> Deflection of a grid of one row by direct summation, which up to about a thousand nodes costs less than the plans of an FFT
module ehl_row_sum
   use, intrinsic :: iso_fortran_env, only: int64
   use ehl_deflection, only: deflection_t
   use ehl_grid, only: grid_t
   use ehl_kernel, only: coefficient
   use ehl_kinds, only: dp
   use ehl_status, only: ehl_no_memory, status_t
   implicit none (type, external)
   private
   public :: row_sum_t

   !> Number of nodes whose pressures are added in one pass
   integer, parameter :: together = 4

   type, extends(deflection_t) :: row_sum_t
      private
      !> Kernel by the signed distance in nodes
      real(dp), allocatable :: kernel(:)
      integer :: nx = 0
   contains
      procedure :: setup
      procedure :: apply
      procedure :: bytes
   end type row_sum_t

contains

   !> Prepare for a grid; exact to rounding, whatever `accuracy`
   subroutine setup(self, grid, factor, accuracy, threads, status)
      class(row_sum_t), intent(inout) :: self
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: factor, accuracy
      integer, intent(in) :: threads
      type(status_t), intent(inout) :: status
      integer :: i, stat

      associate (unused => accuracy, too => threads)
      end associate
      if (allocated(self%kernel)) deallocate (self%kernel)
      allocate (self%kernel(2 - grid%nx - together:grid%nx - 1), source=0.0_dp, stat=stat)
      if (stat /= 0) then
         call status%fail(ehl_no_memory, "no memory for the deflection of a row")
         return
      end if
      self%nx = grid%nx
      do i = 0, grid%nx - 1
         self%kernel(i) = coefficient(grid, factor, i, 0)
         self%kernel(-i) = self%kernel(i)
      end do
   end subroutine setup

   !> W = K P
   subroutine apply(self, p, w)
      class(row_sum_t), intent(inout) :: self
      real(dp), intent(in) :: p(:, :)
      real(dp), intent(out) :: w(:, :)
      integer :: k, first, last

      w = 0.0_dp
      first = findloc(abs(p(:, 1)) > 0.0_dp, .true., dim=1)
      last = findloc(abs(p(:, 1)) > 0.0_dp, .true., dim=1, back=.true.)
      if (first == 0) return
      do k = first, last, together
         call add(self%nx, p(k:min(k + together - 1, last), 1), self%kernel(1 - k - (together - 1):self%nx - k), w(:, 1))
      end do
   end subroutine apply

   !> Add the deflection by the pressures p of adjacent nodes; kernel(i): deflection at node i by the first of them
   pure subroutine add(n, p, kernel, w)
      integer, intent(in) :: n
      real(dp), intent(in) :: p(:), kernel(2 - together:n)
      real(dp), intent(inout) :: w(n)
      real(dp) :: q(0:together - 1)
      integer :: i

      q = 0.0_dp
      q(:size(p) - 1) = p
      do i = 1, n
         w(i) = w(i) + ((q(0)*kernel(i) + q(1)*kernel(i - 1)) + (q(2)*kernel(i - 2) + q(3)*kernel(i - 3)))
      end do
   end subroutine add

   !> Allocated bytes
   pure integer(int64) function bytes(self)
      class(row_sum_t), intent(in) :: self
      bytes = 0
      if (allocated(self%kernel)) bytes = 8*size(self%kernel, kind=int64)
   end function bytes
end module ehl_row_sum

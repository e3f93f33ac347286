! SPDX-License-Identifier: BSD-3-Clause
!> Frames of a transient run: pressure and film at time intervals
module ehl_frames
   use ehl_grid, only: grid_t
   use ehl_kinds, only: dp
   use ehl_level, only: gap, level_t
   use ehl_npy, only: matrix_t
   use ehl_status, only: ehl_no_memory, status_t
   implicit none (type, external)
   private
   public :: frames_t

   type :: frames_t
      !> Number of frames
      integer :: n = 0
      !> Time [a/u] of each; P and H on the whole domain, shape (nx, full_ny). The arrays may be longer than n.
      real(dp), allocatable :: times(:)
      type(matrix_t), allocatable :: p(:), h(:)
   contains
      procedure :: start
      procedure :: keep
      procedure :: add
   end type frames_t

contains

   !> Delete all frames
   subroutine start(self)
      class(frames_t), intent(inout) :: self

      self%n = 0
      if (allocated(self%times)) deallocate (self%times, self%p, self%h)
      allocate (self%times(16), self%p(16), self%h(16))
   end subroutine start

   !> Keep P and H after a step if a frame is due: after every time step if the interval is at most one time step
   subroutine keep(self, level, time, time_step, interval, status)
      class(frames_t), intent(inout) :: self
      type(level_t), intent(in) :: level
      real(dp), intent(in) :: time, time_step
      !> Time between frames; 0: no frames
      real(dp), intent(in) :: interval
      type(status_t), intent(inout) :: status

      if (interval <= 0.0_dp) return
      ! real numbers, as the number of intervals may exceed the largest integer
      if (interval > time_step .and. .not. aint(time/interval) > aint((time - time_step)/interval)) return
      call self%add(level%grid, status)
      if (status%failed()) return
      self%times(self%n) = time
      call level%grid%unfold(level%p, self%p(self%n)%values)
      call level%grid%unfold(gap(level), self%h(self%n)%values)
   end subroutine keep

   !> Allocate another frame
   subroutine add(self, grid, status)
      class(frames_t), intent(inout) :: self
      type(grid_t), intent(in) :: grid
      type(status_t), intent(inout) :: status
      integer :: stat

      if (self%n == size(self%times)) then
         self%times = [self%times, self%times]
         call double(self%p)
         call double(self%h)
      end if
      associate (next => self%n + 1)
         allocate (self%p(next)%values(grid%nx, grid%full_ny()), self%h(next)%values(grid%nx, grid%full_ny()), stat=stat)
      end associate
      if (stat == 0) then
         self%n = self%n + 1
      else
         call status%fail(ehl_no_memory, "no memory for another frame of the transient run")
      end if
   end subroutine add

   !> Double the size of the array without copying the matrices
   subroutine double(matrices)
      type(matrix_t), allocatable, intent(inout) :: matrices(:)
      type(matrix_t), allocatable :: more(:)
      integer :: k

      allocate (more(2*size(matrices)))
      do k = 1, size(matrices)
         call move_alloc(matrices(k)%values, more(k)%values)
      end do
      call move_alloc(more, matrices)
   end subroutine double
end module ehl_frames

! SPDX-License-Identifier: BSD-3-Clause
!> Frames of a transient run: pressure and film at intervals of time
module ehl_frames
   use ehl_grid, only: grid_t
   use ehl_kinds, only: dp
   use ehl_level, only: level_t
   implicit none (type, external)
   private
   public :: frames_t

   !> Times, and P and H on the whole domain, (nx, full_ny, frame)
   type :: frames_t
      real(dp), allocatable :: times(:), p(:, :, :), h(:, :, :)
   contains
      procedure :: start
      procedure :: keep
   end type frames_t

contains

   !> No frame yet
   subroutine start(self, grid)
      class(frames_t), intent(inout) :: self
      type(grid_t), intent(in) :: grid
      allocate (self%times(0), self%p(grid%nx, grid%full_ny(), 0), self%h(grid%nx, grid%full_ny(), 0))
   end subroutine start

   !> Keep P and H after a step if a frame is due
   subroutine keep(self, level, time, time_step, interval)
      class(frames_t), intent(inout) :: self
      type(level_t), intent(in) :: level
      real(dp), intent(in) :: time, time_step
      !> Time from frame to frame; 0: none
      real(dp), intent(in) :: interval
      real(dp), allocatable :: values(:, :)

      if (interval <= 0.0_dp) return
      if (int(time/interval) == int((time - time_step)/interval)) return
      self%times = [self%times, time]
      allocate (values(level%grid%nx, level%grid%full_ny()))
      call level%grid%unfold(level%p, values)
      self%p = reshape([self%p, values], [shape(values), size(self%times)])
      call level%grid%unfold(level%h, values)
      self%h = reshape([self%h, values], [shape(values), size(self%times)])
   end subroutine keep
end module ehl_frames

! SPDX-License-Identifier: BSD-3-Clause
!> What a transient run keeps on its way: frames, pressure and film at intervals of time; and the extremes of both while
!> something passes the contact, with where and when
module ehl_frames
   use ehl_grid, only: grid_t
   use ehl_kinds, only: dp
   use ehl_level, only: gap, level_t
   use ehl_npy, only: matrix_t
   use ehl_status, only: ehl_no_memory, status_t
   implicit none (type, external)
   private
   public :: frames_t, extremes_t, extreme_pressure, extreme_film

   type :: frames_t
      !> Frames so far
      integer :: n = 0
      !> Time [a/u] of each; P and H on the whole domain, (nx, full_ny). Places behind the last frame are spare.
      real(dp), allocatable :: times(:)
      type(matrix_t), allocatable :: p(:), h(:)
   contains
      procedure :: start
      procedure :: keep
      procedure :: add
   end type frames_t

   !> Largest pressure; least film; largest pressure above that of the smooth contact at the same place; least film
   !> over that of the smooth contact there
   integer, parameter :: extreme_pressure = 1, extreme_film = 2, extreme_rise = 3, extreme_ratio = 4

   type :: extremes_t
      !> Value [p_h or a^2/R or -], T [a/u], X, Y [a] of each
      real(dp) :: found(4, 4) = spread([-huge(1.0_dp), huge(1.0_dp), -huge(1.0_dp), huge(1.0_dp)], 1, 4)
   contains
      procedure :: see
      procedure, private :: note
   end type extremes_t

contains

   !> No frame yet
   subroutine start(self)
      class(frames_t), intent(inout) :: self

      self%n = 0
      if (allocated(self%times)) deallocate (self%times, self%p, self%h)
      allocate (self%times(16), self%p(16), self%h(16))
   end subroutine start

   !> Keep P and H after a step if a frame is due: after every step where the interval is no longer than a step
   subroutine keep(self, level, time, time_step, interval, status)
      class(frames_t), intent(inout) :: self
      type(level_t), intent(in) :: level
      real(dp), intent(in) :: time, time_step
      !> Time from frame to frame; 0: none
      real(dp), intent(in) :: interval
      type(status_t), intent(inout) :: status

      if (interval <= 0.0_dp) return
      ! no integers: the number of intervals may exceed the largest
      if (interval > time_step .and. .not. aint(time/interval) > aint((time - time_step)/interval)) return
      call self%add(level%grid, status)
      if (status%failed()) return
      self%times(self%n) = time
      call level%grid%unfold(level%p, self%p(self%n)%values)
      call level%grid%unfold(gap(level), self%h(self%n)%values)
   end subroutine keep

   !> Room for one more frame
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

   !> Twice as many places; the matrices stay where they are
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

   !> Look at the state after a time step; the first of equal values counts
   subroutine see(self, level, p_smooth, h_smooth, time)
      class(extremes_t), intent(inout) :: self
      type(level_t), intent(in) :: level
      !> Pressure and film of the smooth contact, (nx, ny)
      real(dp), intent(in) :: p_smooth(:, :), h_smooth(:, :)
      real(dp), intent(in) :: time

      call self%note(level, extreme_pressure, 1.0_dp, level%p, time)
      call self%note(level, extreme_film, -1.0_dp, gap(level), time)
      call self%note(level, extreme_rise, 1.0_dp, level%p - p_smooth, time)
      call self%note(level, extreme_ratio, -1.0_dp, gap(level)/h_smooth, time)
   end subroutine see

   !> Keep the largest value (sign 1) or the least (-1), with its place, when it is beyond the one kept
   subroutine note(self, level, which, sign, values, time)
      class(extremes_t), intent(inout) :: self
      type(level_t), intent(in) :: level
      integer, intent(in) :: which
      real(dp), intent(in) :: sign, time
      real(dp), contiguous, intent(in) :: values(:, :)
      integer :: place(2)

      if (.not. maxval(sign*values) > sign*self%found(1, which)) return
      place = maxloc(sign*values)
      self%found(:, which) = [values(place(1), place(2)), time, level%grid%x(place(1)), level%grid%y(place(2))]
   end subroutine note
end module ehl_frames

! SPDX-License-Identifier: BSD-3-Clause
!> Deflection by multilevel multi-integration (Brandt & Lubrecht 1990; Venner & Lubrecht 2000)
module ehl_mlmi
   use ehl_kinds, only: dp
   use ehl_grid, only: grid_t
   use ehl_status, only: status_t, ehl_bad_input, ehl_no_memory
   use ehl_deflection, only: deflection_t
   use ehl_mlmi_stencil, only: transfer_weights
   use ehl_mlmi_stage, only: stage_t
   use ehl_mlmi_down, only: take, descend, sum_directly
   use ehl_mlmi_up, only: ascend
   implicit none (type, external)
   private
   public :: mlmi_deflection_t

   !> Grids are halved down to this many nodes a side
   integer, parameter :: few = 17

   type, extends(deflection_t) :: mlmi_deflection_t
      private
      integer :: threads = 1
      !> Transfers use 2t points
      integer, public :: t = 4
      real(dp), public :: safety = 3.0_dp
      integer, public :: coarsest = few
      real(dp), allocatable :: omega(:)
      !> The grids, finest first
      type(stage_t), allocatable :: stages(:)
      !> Row buffers of the threads: (elements, buffers, threads)
      real(dp), allocatable :: work(:, :, :)
   contains
      procedure :: setup
      procedure :: apply
      procedure :: bytes
      procedure :: taps
   end type mlmi_deflection_t

contains

   !> Prepare for a grid
   subroutine setup(self, grid, accuracy, threads, status)
      class(mlmi_deflection_t), intent(inout) :: self
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: accuracy
      integer, intent(in) :: threads
      type(status_t), intent(inout) :: status
      integer :: s, n, axis, step(2), low(2), high(2), longest, stat
      logical :: met

      self%threads = max(1, threads)
      self%omega = transfer_weights(self%t)
      n = 0
      step = 1
      do
         axis = next_axis(grid, step, self%coarsest)
         if (axis == 0) exit
         step(axis) = 2*step(axis)
         n = n + 1
      end do
      if (allocated(self%stages)) deallocate (self%stages)
      allocate (self%stages(n + 1), stat=stat)
      step = 1
      low = 0
      high = [grid%nx - 1, grid%ny - 1]
      longest = grid%nx + 1
      do s = 1, n
         axis = next_axis(grid, step, self%coarsest)
         call self%stages(s)%stencil%make(axis, step, grid%hx, grid%hy, self%omega, &
                                          self%safety*accuracy*2.0_dp**(-1.5_dp*(s - 1)), met)
         if (.not. met) then
            call status%fail(ehl_bad_input, "accuracy is too small")
            return
         end if
         call self%stages(s)%halve(low, high, axis, grid%mirror, self%t, status)
         if (status%failed()) return
         step(axis) = 2*step(axis)
         low = self%stages(s)%coarse_low
         high = self%stages(s)%coarse_high
         longest = max(longest, high(1) - low(1) + 1 + 2*self%stages(s)%margin)
      end do
      call self%stages(n + 1)%finish(low, high, grid%mirror, step, grid%hx, grid%hy, status)
      if (status%failed()) return
      longest = max(longest, high(1) - low(1) + 9)
      if (allocated(self%work)) deallocate (self%work)
      allocate (self%work(longest, 3, self%threads), source=0.0_dp)
   end subroutine setup

   !> Axis to halve next on the grid of every step-th node: the one with the finer mesh,
   !> 0 if both have few nodes
   pure integer function next_axis(grid, step, coarsest)
      type(grid_t), intent(in) :: grid
      integer, intent(in) :: step(2), coarsest
      logical :: many(2)

      many = ([grid%nx, grid%full_ny()] - 1)/step + 1 > coarsest
      if (all(many)) then
         next_axis = merge(1, 2, step(1)*grid%hx <= step(2)*grid%hy*1.001_dp)
      else
         next_axis = findloc(many, .true., dim=1)
      end if
   end function next_axis

   !> W = K P
   subroutine apply(self, p, w)
      class(mlmi_deflection_t), intent(inout) :: self
      real(dp), intent(in) :: p(:, :)
      real(dp), intent(out) :: w(:, :)
      integer :: s, n

      n = size(self%stages)
      call take(self%stages(1), self%threads, p, self%work)
      do s = 1, n - 1
         call descend(self%stages(s), self%stages(s + 1), self%omega, self%threads, self%work)
      end do
      if (n == 1) then
         call sum_directly(self%stages(n), self%threads, self%work, w)
         return
      end if
      call sum_directly(self%stages(n), self%threads, self%work, self%stages(n - 1)%coarse)
      do s = n - 1, 2, -1
         call ascend(self%stages(s), self%omega, self%threads, self%work, &
                     self%stages(s - 1)%coarse)
      end do
      call ascend(self%stages(1), self%omega, self%threads, self%work, w)
   end subroutine apply

   !> Allocated bytes
   pure integer(8) function bytes(self)
      class(mlmi_deflection_t), intent(in) :: self
      integer :: s

      bytes = 0
      if (allocated(self%work)) bytes = bytes + 8*size(self%work, kind=8)
      if (.not. allocated(self%stages)) return
      do s = 1, size(self%stages)
         bytes = bytes + self%stages(s)%bytes()
      end do
   end function bytes

   pure real(dp) function taps(self)
      class(mlmi_deflection_t), intent(in) :: self
      integer :: s
      taps = 0
      do s = 1, size(self%stages) - 1
         taps = taps + 0.75_dp*self%stages(s)%stencil%taps()/2.0_dp**(s - 1)
      end do
   end function taps
end module ehl_mlmi

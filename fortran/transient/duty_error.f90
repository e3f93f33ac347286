! SPDX-License-Identifier: BSD-3-Clause
!> Error of the film by the time steps under a duty: the error that each adds at a node, convected with the flow
!> (docs/theory/duty.md)
module ehl_duty_error
   use ehl_kinds, only: dp
   use ehl_status, only: ehl_no_memory, status_t
   implicit none (type, external)
   private
   public :: duty_error_t

   !> Upstream of so many half widths of the contact the pressure flow evens out the error of a step
   real(dp), parameter :: ahead = 1.25_dp
   !> Films before a step from which its error is estimated
   integer, parameter :: films_before = 3

   type :: duty_error_t
      !> Films before the present step, the latest first, (nx, ny, 3), and the error of the last one, (nx, ny)
      real(dp), allocatable :: films(:, :, :), error(:, :)
   contains
      procedure :: start
      procedure :: settle
      procedure :: worst
      procedure :: add
      procedure :: upstream
   end type duty_error_t

contains

   !> Before the first step all is steady
   subroutine start(self, film, active, status)
      class(duty_error_t), intent(inout) :: self
      real(dp), intent(in) :: film(:, :)
      !> Without a duty nothing is stored
      logical, intent(in) :: active
      type(status_t), intent(inout) :: status
      integer :: n(2), stat

      n = merge(shape(film), 0, active)
      if (allocated(self%films)) deallocate (self%films, self%error)
      allocate (self%films(n(1), n(2), films_before), self%error(n(1), n(2)), source=0.0_dp, stat=stat)
      if (stat /= 0) then
         call status%fail(ehl_no_memory, "no memory for the error of time steps")
      else if (active) then
         self%films = spread(film, 3, films_before)
      end if
   end subroutine start

   !> The steady film in the discretisation of the steps: its difference from the one before counts as an error, which the flow
   !> transports away
   subroutine settle(self, film)
      class(duty_error_t), intent(inout) :: self
      !> Shape (nx, ny)
      real(dp), intent(in) :: film(:, :)

      self%error = abs(film - self%films(:, :, 1))
      self%films = spread(film, 3, films_before)
   end subroutine settle

   !> Factors of the films after a step and before it in the error that the step adds: the third difference, which BDF2 leaves out
   pure function factors_of(steps) result(factors)
      !> The step, and those before it
      real(dp), intent(in) :: steps(films_before)
      real(dp) :: t(0:films_before), factors(0:films_before)
      integer :: i, k

      t(0) = 0.0_dp
      do k = 1, films_before
         t(k) = t(k - 1) - steps(k)
      end do
      ! of the third divided difference
      do k = 0, films_before
         factors(k) = 1.0_dp/product(pack(t(k) - t, [(i /= k, i=0, films_before)]))
      end do
      factors = factors*steps(1)**2*(steps(1) + steps(2))
   end function factors_of

   !> Error of the film that a step adds in a row
   pure function added(self, film, factors, j) result(error)
      class(duty_error_t), intent(in) :: self
      !> Row j after the step
      real(dp), intent(in) :: film(:)
      real(dp), intent(in) :: factors(0:films_before)
      integer, intent(in) :: j
      real(dp) :: error(size(film))

      error = abs(factors(0)*film + factors(1)*self%films(:, j, 1) + factors(2)*self%films(:, j, 2) &
                  + factors(3)*self%films(:, j, 3))
   end function added

   !> Largest error that a step adds within the contact along a row, over the film there
   pure real(dp) function worst(self, x, film, steps, half_width, j)
      class(duty_error_t), intent(in) :: self
      real(dp), intent(in) :: x(:), film(:), steps(films_before), half_width
      integer, intent(in) :: j
      worst = maxval(added(self, film, factors_of(steps), j)/film, mask=abs(x) <= half_width)
   end function worst

   !> Accept a step: errors move with the flow, towards larger X, and its own are added
   subroutine add(self, x, film, steps, displacement, half_width)
      class(duty_error_t), intent(inout) :: self
      real(dp), intent(in) :: x(:), film(:, :), steps(films_before)
      !> Displacement of the flow in the step, half width of the contact along X [a]
      real(dp), intent(in) :: displacement, half_width
      real(dp) :: before(1 - (int(displacement/(x(2) - x(1))) + 1):ubound(x, 1)), part, factors(0:films_before)
      integer :: nx, j, k, nodes

      nx = ubound(x, 1)
      nodes = int(displacement/(x(2) - x(1)))
      part = displacement/(x(2) - x(1)) - nodes
      before = 0.0_dp
      factors = factors_of(steps)
      do j = 1, ubound(film, 2)
         before(1:) = self%error(:, j)
         self%error(:, j) = added(self, film(:, j), factors, j) + (1.0_dp - part)*before(1 - nodes:nx - nodes) &
                            + part*before(-nodes:nx - nodes - 1)
         where (x < -ahead*half_width) self%error(:, j) = 0.0_dp
         do k = films_before, 2, -1
            self%films(:, j, k) = self%films(:, j, k - 1)
         end do
         self%films(:, j, 1) = film(:, j)
      end do
   end subroutine add

   !> Largest error in a row up to a node, which it may reach earlier or later than with the mean velocity
   pure real(dp) function upstream(self, i, j)
      class(duty_error_t), intent(in) :: self
      integer, intent(in) :: i, j
      upstream = maxval(self%error(:i, j))
   end function upstream
end module ehl_duty_error

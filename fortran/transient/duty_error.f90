! SPDX-License-Identifier: BSD-3-Clause
!> Time-step error of the film under a duty: the error added by each step at a node, convected with the flow (docs/theory/duty.md)
module ehl_duty_error
   use ehl_kinds, only: dp
   use ehl_status, only: ehl_no_memory, status_t
   implicit none (type, external)
   private
   public :: duty_error_t

   !> Distance upstream of the centre [half widths of the contact] beyond which the Poiseuille flow removes the error of a step
   real(dp), parameter :: error_reach = 1.25_dp
   !> Number of previous films in the error estimate of a step
   integer, parameter :: films_before = 3

   type :: duty_error_t
      !> Previous films, the latest first, shape (nx, ny, 3), and the error of the latest, shape (nx, ny)
      real(dp), allocatable :: films(:, :, :), error(:, :)
   contains
      procedure :: start
      procedure :: settle
      procedure :: max_added
      procedure :: add
      procedure :: upstream
   end type duty_error_t

contains

   !> Start from a steady film
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

   !> Start again from the steady film in the discretisation of the steps. Its difference from the previous film counts as an error,
   !> which is convected with the flow.
   subroutine settle(self, film)
      class(duty_error_t), intent(inout) :: self
      !> Shape (nx, ny)
      real(dp), intent(in) :: film(:, :)

      self%error = abs(film - self%films(:, :, 1))
      self%films = spread(film, 3, films_before)
   end subroutine settle

   !> Factors of the films after and before a step in the error added by it: the truncation error of BDF2, a third difference
   pure function factors_of(steps) result(factors)
      !> The step and the previous ones
      real(dp), intent(in) :: steps(films_before)
      real(dp) :: t(0:films_before), factors(0:films_before)
      integer :: i, k

      t(0) = 0.0_dp
      do k = 1, films_before
         t(k) = t(k - 1) - steps(k)
      end do
      ! third divided difference
      do k = 0, films_before
         factors(k) = 1.0_dp/product(pack(t(k) - t, [(i /= k, i=0, films_before)]))
      end do
      factors = factors*steps(1)**2*(steps(1) + steps(2))
   end function factors_of

   !> Error of the film in row j added by a step
   pure function added(self, film, factors, j) result(error)
      class(duty_error_t), intent(in) :: self
      !> Film of row j after the step
      real(dp), intent(in) :: film(:)
      real(dp), intent(in) :: factors(0:films_before)
      integer, intent(in) :: j
      real(dp) :: error(size(film))

      error = abs(factors(0)*film + factors(1)*self%films(:, j, 1) + factors(2)*self%films(:, j, 2) &
                  + factors(3)*self%films(:, j, 3))
   end function added

   !> Maximum relative error of the film added by a step within the contact along row j
   pure real(dp) function max_added(self, x, film, steps, half_width, j)
      class(duty_error_t), intent(in) :: self
      real(dp), intent(in) :: x(:), film(:), steps(films_before), half_width
      integer, intent(in) :: j
      max_added = maxval(added(self, film, factors_of(steps), j)/film, mask=abs(x) <= half_width)
   end function max_added

   !> Accept a step: move the errors with the flow, towards larger X, and add that of the step
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
         where (x < -error_reach*half_width) self%error(:, j) = 0.0_dp
         do k = films_before, 2, -1
            self%films(:, j, k) = self%films(:, j, k - 1)
         end do
         self%films(:, j, 1) = film(:, j)
      end do
   end subroutine add

   !> Maximum error in row j up to node i, since errors may move faster or slower than the mean velocity
   pure real(dp) function upstream(self, i, j)
      class(duty_error_t), intent(in) :: self
      integer, intent(in) :: i, j
      upstream = maxval(self%error(:i, j))
   end function upstream
end module ehl_duty_error

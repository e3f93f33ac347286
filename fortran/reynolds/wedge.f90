! SPDX-License-Identifier: BSD-3-Clause
!> Wedge and squeeze terms d(rho H)/dX + d(rho H)/dT on one grid: an implicit part, upstream in X, and the part of
!> earlier times
module ehl_wedge
   use ehl_kinds, only: dp
   implicit none (type, external)
   private
   public :: wedge_t, old_times, wedge_reach, line_reach
   public :: wedge_steady, wedge_narrow, wedge_separate

   !> Steady, second-order upstream; a time step along the characteristic (Venner's narrow upstream scheme for both terms
   !> together); a time step with the two differences of Zhang et al., second-order upstream and second-order backward.
   !> All are of first order in X in the first interior column.
   integer, parameter :: wedge_steady = 0, wedge_narrow = 1, wedge_separate = 2
   !> Number of earlier times that a step needs
   integer, parameter :: old_times = 2
   !> Number of upstream nodes in the implicit part
   integer, parameter :: wedge_reach = 2
   !> Number of these in line systems; nodes further upstream enter the residual alone
   integer, parameter :: line_reach = 2

   !> m is the mass content rho H of a row, shape (nx)
   type :: wedge_t
      integer, private :: scheme = wedge_steady
      !> Factors of m at a node and upstream of it, in general and in the first interior column
      real(dp), private :: c(0:wedge_reach) = 0.0_dp, c_first(0:wedge_reach) = 0.0_dp
      !> The part of c(0) that is due to the squeeze term; 0: steady
      real(dp) :: squeeze = 0.0_dp
      real(dp), private :: inverse_step = 0.0_dp
      !> Factors of the earlier times, to be divided by the time step
      real(dp), private :: past(old_times) = [-2.0_dp, 0.5_dp]
   contains
      procedure :: set_steady
      procedure :: set_step
      procedure :: subtract_row
      procedure :: line_row
      procedure :: last_active
      procedure :: weights
      procedure :: east_flow
      procedure :: rate
      procedure :: line_weights
      procedure :: history_row
   end type wedge_t

contains

   !> Set the steady scheme; hx: mesh size along X
   pure subroutine set_steady(self, hx)
      class(wedge_t), intent(inout) :: self
      real(dp), intent(in) :: hx

      self%scheme = wedge_steady
      self%squeeze = 0.0_dp
      self%inverse_step = 0.0_dp
      self%c = [1.5_dp, -2.0_dp, 0.5_dp]/hx
      self%c_first = [1.0_dp, -1.0_dp, 0.0_dp]/hx
   end subroutine set_steady

   !> Set the scheme of a time step
   pure subroutine set_step(self, scheme, hx, time_step, speed, ratio)
      class(wedge_t), intent(inout) :: self
      !> wedge_narrow or wedge_separate
      integer, intent(in) :: scheme
      real(dp), intent(in) :: hx, time_step
      !> With wedge_separate: mean velocity, at least 0, over its scale; the step over the previous one
      real(dp), intent(in), optional :: speed, ratio
      real(dp) :: u

      call self%set_steady(hx)
      self%scheme = scheme
      u = 1.0_dp
      if (present(speed)) u = speed
      self%squeeze = 1.5_dp/time_step
      self%past = [-2.0_dp, 0.5_dp]
      if (present(ratio)) then
         self%squeeze = (1.0_dp + 2.0_dp*ratio)/(1.0_dp + ratio)/time_step
         self%past = [-1.0_dp - ratio, ratio**2/(1.0_dp + ratio)]
      end if
      self%inverse_step = 1.0_dp/time_step
      if (scheme == wedge_narrow) then
         self%c = [1.5_dp, 0.0_dp, 0.0_dp]/time_step
         self%c_first = [1.0_dp, 0.0_dp, 0.0_dp]/time_step
      else
         self%c = u*self%c
         self%c_first = u*self%c_first
         self%c(0) = self%c(0) + self%squeeze
         self%c_first(0) = self%c_first(0) + self%squeeze
      end if
   end subroutine set_step

   !> Subtract the implicit part from a row, in columns 2 to nx-1
   pure subroutine subtract_row(self, m, values)
      class(wedge_t), intent(in) :: self
      real(dp), intent(in) :: m(:)
      !> Shape (nx)
      real(dp), intent(inout) :: values(:)
      integer :: i

      associate (c => self%c, f => self%c_first)
         values(2) = values(2) - f(0)*m(2) - f(1)*m(1)
         do i = 3, size(m) - 1
            values(i) = values(i) - c(0)*m(i) - c(1)*m(i - 1) - c(2)*m(i - 2)
         end do
      end associate
   end subroutine subtract_row

   !> Add the implicit part in columns `first` to `last` to the rest of a line system; nodes are numbered from 1 at `first`
   pure subroutine line_row(self, m, first, last, rest)
      class(wedge_t), intent(in) :: self
      real(dp), contiguous, intent(in) :: m(:)
      integer, intent(in) :: first, last
      real(dp), contiguous, intent(inout) :: rest(:)
      integer :: i, k

      associate (c => self%c, f => self%c_first)
         if (first <= 2 .and. last >= 2) rest(3 - first) = rest(3 - first) + f(0)*m(2) + f(1)*m(1)
         do i = max(first, 3), min(last, size(m) - 1)
            k = i - first + 1
            rest(k) = rest(k) + c(0)*m(i) + c(1)*m(i - 1) + c(2)*m(i - 2)
         end do
      end associate
   end subroutine line_row

   !> Last node of a row beyond `from` (at least 2) where the right-hand side and the implicit part alone require
   !> pressure; `from` if there is none
   pure integer function last_active(self, m, rhs, from) result(i)
      class(wedge_t), intent(in) :: self
      real(dp), contiguous, intent(in) :: m(:), rhs(:)
      integer, intent(in) :: from

      associate (c => self%c)
         do i = size(m) - 1, from + 1, -1
            if (rhs(i) + c(0)*m(i) + c(1)*m(i - 1) + c(2)*m(i - 2) < 0.0_dp) return
         end do
      end associate
      i = from
   end function last_active

   !> Factors of m at column i and at the columns upstream of it
   pure function weights(self, i, passing, passed_fraction) result(c)
      class(wedge_t), intent(in) :: self
      integer, intent(in) :: i
      !> Whether the upstream node passes on all oil that it receives (supply.f90), so that its flow is not that of a filled gap
      logical, intent(in), optional :: passing
      !> Fraction of the deficit of that node that it passes downstream
      real(dp), intent(in), optional :: passed_fraction
      real(dp) :: c(0:wedge_reach)

      c = merge(self%c_first, self%c, i == 2)
      if (.not. present(passing)) return
      if (.not. passing) return
      if (self%squeeze > 0.0_dp .and. i > 2) then
         ! plus the equations of the upstream nodes, each with the fraction that is passed
         c = c + passed_fraction*([0.0_dp, self%c(0), self%c(1)] + passed_fraction*[0.0_dp, 0.0_dp, self%c(0)])
      else
         ! the flow through the east face alone
         c = [self%c(0), -self%c(2), 0.0_dp]
      end if
   end function weights

   !> Flow through the east face of a node of a filled gap over the mesh size, from m at the node and upstream of it
   pure real(dp) function east_flow(self, m, m_before) result(flow)
      class(wedge_t), intent(in) :: self
      real(dp), intent(in) :: m, m_before
      flow = (self%c(0) - self%squeeze)*m - self%c(2)*m_before
   end function east_flow

   !> Factor of m at the node itself
   pure real(dp) function rate(self)
      class(wedge_t), intent(in) :: self
      rate = self%c(0)
   end function rate

   !> Factors of m in line systems, in the first interior column and downstream of it
   pure subroutine line_weights(self, first, interior)
      class(wedge_t), intent(in) :: self
      real(dp), intent(out) :: first(0:line_reach), interior(0:line_reach)
      first = self%c_first(:line_reach)
      interior = self%c(:line_reach)
   end subroutine line_weights

   !> The part of earlier times, a row of the right-hand side, in columns 2 to nx-1
   pure subroutine history_row(self, m, values)
      class(wedge_t), intent(in) :: self
      !> Mass content of the row at the earlier times, the latest first, shape (nx, old_times)
      real(dp), intent(in) :: m(:, :)
      !> Shape (nx)
      real(dp), intent(inout) :: values(:)
      real(dp) :: r, b(old_times)
      integer :: i, shift

      r = self%inverse_step
      b = self%past
      ! along the characteristic one step back in time is one node upstream
      shift = merge(1, 0, self%scheme == wedge_narrow)
      do i = 3, size(m, 1) - 1
         values(i) = r*(b(1)*m(i - shift, 1) + b(2)*m(i - 2*shift, 2))
      end do
      if (self%scheme == wedge_narrow) then
         values(2) = -r*m(1, 1)
      else
         values(2) = r*(b(1)*m(2, 1) + b(2)*m(2, 2))
      end if
   end subroutine history_row
end module ehl_wedge

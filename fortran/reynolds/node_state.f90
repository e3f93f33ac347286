! SPDX-License-Identifier: BSD-3-Clause
!> The state of a node. It follows from the pressure: the node is cavitated where P <= 0, elsewhere the lubricant fills the gap and
!> flows. A cavitated node is inactive, and stays as it is, unless its residual requires pressure (residual < 0).
!>
!> A NaN is no state: it fails every comparison, and nothing here makes a number of it. Procedures take rows, since the
!> loops of other modules would not vectorise around a call.
module ehl_node_state
   use ehl_kinds, only: dp
   implicit none (type, external)
   private
   public :: cavity_pressure, last_flowing, flowing_around, cavitate, stay_cavitated, change_flowing, &
             zero_inactive_residual

   !> Pressure in a cavity, over p_h
   real(dp), parameter :: cavity_pressure = 0.0_dp

   !> Nodes that a search takes at a time
   integer, parameter :: stride = 8

contains

   !> Last node of a row that is not cavitated, or the first one
   pure integer function last_flowing(p) result(last)
      real(dp), contiguous, intent(in) :: p(:)

      last = size(p)
      ! several nodes at a time first
      do while (last > stride)
         if (count(p(last - stride + 1:last) <= cavity_pressure) < stride) exit
         last = last - stride
      end do
      do while (last > 1 .and. p(last) <= cavity_pressure)
         last = last - 1
      end do
   end function last_flowing

   !> 1 where the lubricant flows in a node of a row and in its four neighbours, else 0; in columns 2 to nx-1
   pure subroutine flowing_around(south, p, north, values)
      !> Pressure of the row and of those beside it, shape (nx)
      real(dp), contiguous, intent(in) :: south(:), p(:), north(:)
      real(dp), contiguous, intent(inout) :: values(:)
      integer :: i

      do i = 2, size(p) - 1
         values(i) = merge(1.0_dp, 0.0_dp, min(p(i), p(i - 1), p(i + 1), north(i), south(i)) > cavity_pressure)
      end do
   end subroutine flowing_around

   !> Let nodes cavitate whose pressure has become negative
   pure subroutine cavitate(p)
      real(dp), contiguous, intent(inout) :: p(:)
      integer :: i

      do i = 1, size(p)
         ! a NaN stays one, where max(0, NaN) could be cavitation
         p(i) = merge(p(i), cavity_pressure, .not. p(i) <= cavity_pressure)
      end do
   end subroutine cavitate

   !> Let nodes be cavitated that were so
   pure subroutine stay_cavitated(before, p)
      !> Pressure that they had
      real(dp), intent(in) :: before(:)
      real(dp), contiguous, intent(inout) :: p(:)
      integer :: i

      do i = 1, size(p)
         p(i) = merge(cavity_pressure, p(i), before(i) <= cavity_pressure)
      end do
   end subroutine stay_cavitated

   !> Give nodes in which the lubricant flows another pressure; where that is negative they cavitate
   pure subroutine change_flowing(after, p)
      real(dp), contiguous, intent(in) :: after(:)
      real(dp), contiguous, intent(inout) :: p(:)
      real(dp) :: new
      integer :: i

      do i = 1, size(p)
         new = merge(after(i), cavity_pressure, .not. after(i) <= cavity_pressure)
         p(i) = merge(new, p(i), p(i) > cavity_pressure)
      end do
   end subroutine change_flowing

   !> No residual at inactive nodes
   pure subroutine zero_inactive_residual(p, residual)
      real(dp), contiguous, intent(in) :: p(:)
      real(dp), contiguous, intent(inout) :: residual(:)
      integer :: i

      do i = 1, size(p)
         residual(i) = merge(0.0_dp, residual(i), p(i) <= cavity_pressure .and. residual(i) > 0.0_dp)
      end do
   end subroutine zero_inactive_residual
end module ehl_node_state

! SPDX-License-Identifier: BSD-3-Clause
!> What a level of the smooth contact begins with: its problem, and a first approximation of the solution
module ehl_first_approximation
   use ehl_contact, only: contact_t
   use ehl_cycle, only: prolong_solution
   use ehl_film, only: refresh
   use ehl_kinds, only: dp
   use ehl_level, only: level_t
   implicit none (type, external)
   private
   public :: begin_level

contains

   !> Level n, from the solution of the next coarser one or from the Hertz pressure. Film and coefficients are up to date
   !> after it.
   subroutine begin_level(levels, n, contact, film, from_coarser)
      type(level_t), intent(inout) :: levels(:)
      integer, intent(in) :: n
      class(contact_t), intent(in) :: contact
      !> Central film expected [a^2/R]
      real(dp), intent(in) :: film
      logical, intent(in) :: from_coarser
      integer :: j

      associate (level => levels(n), grid => levels(n)%grid)
         do j = 1, grid%ny
            call contact%gap_row(grid%columns(), grid%y(j), level%geometry(:, j))
         end do
         level%rhs = 0.0_dp
         level%load = contact%load()
         if (from_coarser) then
            call prolong_solution(levels(n - 1), level)
            return
         end if
         do j = 1, grid%ny
            call contact%pressure_row(grid%columns(), grid%y(j), level%p(:, j))
         end do
         level%h00 = film + contact%dry_separation()
         call refresh(level)
      end associate
   end subroutine begin_level
end module ehl_first_approximation

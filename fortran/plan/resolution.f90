! SPDX-License-Identifier: BSD-3-Clause
!> A-priori estimates of the grid that resolves a smooth contact
module ehl_resolution
   use ehl_contact, only: contact_t
   use ehl_grid, only: grid_t
   use ehl_grid_error, only: relative_errors
   use ehl_inlet, only: inlet_t
   use ehl_kinds, only: dp
   use ehl_moes, only: operating_t
   use ehl_reason, only: reason_coarse_grid, reason_narrow, reason_none
   implicit none (type, external)
   private
   public :: has_solution, points_for_inlet, points_for_solution, why_no_solution

   !> Maximum of half the a-priori error of H_min at which the discrete equations have a solution (docs/robustness.md)
   real(dp), parameter :: max_unresolved = 0.6_dp
   !> Aspect ratio Y/X below which hy = hx/4 can be too coarse at the ends, and a y_extent of an eighth of the length of the domain
   !> is sufficient
   real(dp), parameter :: max_narrow_ratio = 0.105_dp

contains

   !> Whether the discrete equations on a grid are expected to have a solution
   pure logical function has_solution(contact, point, grid)
      class(contact_t), intent(in) :: contact
      type(operating_t), intent(in) :: point
      type(grid_t), intent(in) :: grid
      real(dp) :: errors(2)

      errors = relative_errors(contact, point, grid%hx)
      has_solution = 0.5_dp*errors(2) <= max_unresolved
   end function has_solution

   !> Nodes along X of a grid that is expected to have a solution, at least those of the finest one
   pure integer function points_for_solution(contact, point, finest) result(points)
      class(contact_t), intent(in) :: contact
      type(operating_t), intent(in) :: point
      type(grid_t), intent(in) :: finest
      type(grid_t) :: grid

      grid = finest
      do while (.not. has_solution(contact, point, grid))
         grid = grid%finer()
      end do
      points = grid%nx
   end function points_for_solution

   !> Nodes along X of a grid that resolves the inlet
   pure integer function points_for_inlet(inlet, finest) result(points)
      type(inlet_t), intent(in) :: inlet
      type(grid_t), intent(in) :: finest
      type(grid_t) :: grid

      grid = finest
      do while (grid%hx > inlet%resolving_mesh())
         grid = grid%finer()
      end do
      points = grid%nx
   end function points_for_inlet

   !> Probable reason for a missing solution: a coarse grid; or the ends of a narrow contact, for which half of hy, in a domain a
   !> quarter as wide, may be sufficient (docs/evidence/errors_ellipses); reason_none if neither applies
   pure integer function why_no_solution(contact, point, finest) result(reason)
      class(contact_t), intent(in) :: contact
      type(operating_t), intent(in) :: point
      type(grid_t), intent(in) :: finest

      reason = reason_none
      if (.not. has_solution(contact, point, finest)) then
         reason = reason_coarse_grid
      else if (contact%reach(2) <= max_narrow_ratio*contact%reach(1) .and. 6.0_dp*finest%hy >= finest%hx) then
         reason = reason_narrow
      end if
   end function why_no_solution
end module ehl_resolution

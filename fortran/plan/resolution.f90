! SPDX-License-Identifier: BSD-3-Clause
!> What a grid resolves of a smooth contact, before anything is solved
module ehl_resolution
   use ehl_contact, only: contact_t
   use ehl_grid, only: grid_t
   use ehl_grid_error, only: relative_errors
   use ehl_inlet, only: inlet_t
   use ehl_kinds, only: dp
   use ehl_moes, only: operating_t
   use ehl_text, only: to_text
   implicit none (type, external)
   private
   public :: has_solution, too_coarse, better_grid, unresolved_inlet, no_inlet

   !> How a text begins that says why a contact touches
   character(len=*), parameter :: no_inlet = "the grid does not resolve the inlet"
   !> Most that half of the a-priori error of H_min may be where the equations have a solution (docs/robustness.md)
   real(dp), parameter :: most_unresolved = 0.6_dp
   !> Semi-axis across the motion over that along it from which on cells a quarter as long across can be too long, and a side
   !> of an eighth of the length of the domain is far enough
   real(dp), parameter :: max_narrow = 0.105_dp

contains

   !> Whether the equations have a solution on a grid, as far as that can be told
   pure logical function has_solution(contact, point, grid)
      class(contact_t), intent(in) :: contact
      type(operating_t), intent(in) :: point
      type(grid_t), intent(in) :: grid
      real(dp) :: errors(2)

      errors = relative_errors(contact, point, grid%hx)
      has_solution = 0.5_dp*errors(2) <= most_unresolved
   end function has_solution

   !> Why a grid has hardly a solution, with the nodes along X that will do; empty where it has one
   pure function too_coarse(contact, point, finest) result(text)
      class(contact_t), intent(in) :: contact
      type(operating_t), intent(in) :: point
      type(grid_t), intent(in) :: finest
      character(len=:), allocatable :: text
      type(grid_t) :: grid

      text = ""
      grid = finest
      do while (.not. has_solution(contact, point, grid))
         grid = grid%finer()
      end do
      if (grid%nx > finest%nx) text = "the grid is too coarse for a solution at this load: grid.points = "// &
                                      to_text(grid%nx)//" or more"
   end function too_coarse

   !> Why a contact touches on a grid of whose inlet not enough is resolved, with the nodes along X that will do
   pure function unresolved_inlet(inlet, finest) result(text)
      type(inlet_t), intent(in) :: inlet
      type(grid_t), intent(in) :: finest
      character(len=:), allocatable :: text
      type(grid_t) :: grid

      grid = finest
      do while (grid%hx > inlet%resolving_mesh())
         grid = grid%finer()
      end do
      text = no_inlet//", and the bodies may touch for that: grid.points = "//to_text(grid%nx)//" or more"
   end function unresolved_inlet

   !> What may help where there is no solution: a grid that has one, or in a narrow contact on a grid that seems fine enough cells
   !> half as long across, in a domain a quarter as wide; empty where nothing is known (docs/evidence/errors_ellipses)
   pure function better_grid(contact, point, finest) result(text)
      class(contact_t), intent(in) :: contact
      type(operating_t), intent(in) :: point
      type(grid_t), intent(in) :: finest
      character(len=:), allocatable :: text

      text = too_coarse(contact, point, finest)
      if (text /= "" .or. contact%reach(2) > max_narrow*contact%reach(1) .or. 6.0_dp*finest%hy < finest%hx) return
      text = "the ends of a narrow contact need shorter cells across the motion: grid.y_extent = "// &
             to_text(0.125_dp*finest%hx*(finest%nx - 1))//", grid.points_y = "//to_text(2*finest%nx - 1)// &
             " and solver.max_cycles = 100 may do"
   end function better_grid
end module ehl_resolution

! SPDX-License-Identifier: BSD-3-Clause
!> What a grid resolves of a smooth contact, before anything is solved
module ehl_resolution
   use ehl_contact, only: contact_t
   use ehl_grid, only: grid_t
   use ehl_inlet, only: inlet_t
   use ehl_kinds, only: dp
   use ehl_moes, only: operating_t
   use ehl_text, only: to_text
   implicit none (type, external)
   private
   public :: relative_errors, lone_grid_errors, has_solution, too_coarse, better_grid, unresolved_inlet, no_inlet

   !> How a text begins that says why a contact touches
   character(len=*), parameter :: no_inlet = "the grid does not resolve the inlet"
   !> Most that half of the a-priori error of H_min may be where the equations have a solution (docs/robustness.md)
   real(dp), parameter :: most_unresolved = 0.6_dp
   !> A-priori error of H_c by the second-order wedge term: 0.16 M h^2 (fitted to grids of 65^2 to 513^2 for 20 <= M <= 1000,
   !> 10 <= L <= 15), or in thick films, whose length is s = (2 H_c)^(1/2), (h/s)^2 times 0.85 (1 + (M/5)^2), whichever is less
   !> (33^2 to 513^2 for 0.05 <= M <= 20: 0.61 to 0.68 up to M = 1, 1.07 at M = 5, 2.9 at M = 20, with the film of the solution)
   real(dp), parameter :: by_contact = 0.16_dp, by_film = 0.85_dp, thick_m = 5.0_dp
   !> What grids miss in contacts that are narrow, over what they miss in round ones, by H_c and by H_min: 1 + a (1/kappa^2 - 1)
   !> and b/kappa^2 (docs/evidence/errors_ellipses)
   real(dp), parameter :: narrow_central = 0.05_dp, narrow_minimum = 0.3_dp
   !> What a grid misses of thin films whose viscosity is that of the inlet, over h^2/H_c^(1/3), H_c as it is on that grid:
   !> 0.26 to 0.31 of H_c, up to 0.34 of H_min (L = 0, 655 <= M <= 2304). Where viscosity rises by_contact tells more.
   real(dp), parameter :: by_inlet = 0.4_dp
   !> What a narrow contact misses that is solved on a single grid, over the a-priori error: 1.9 and 1.6 at kappa = 0.31, M = 1789
   real(dp), parameter :: alone_and_narrow = 2.0_dp
   !> Semi-axis across the motion over that along it from which on cells a quarter as long across can be too long, and a side
   !> of an eighth of the length of the domain is far enough
   real(dp), parameter :: most_narrow = 0.105_dp

contains

   !> Rough a-priori errors of H_c and H_min, relative: that of H_min is twice that of H_c; more in narrow contacts, whose ends
   !> are sharp
   pure function relative_errors(contact, point, grid) result(errors)
      class(contact_t), intent(in) :: contact
      type(operating_t), intent(in) :: point
      type(grid_t), intent(in) :: grid
      real(dp) :: errors(2)
      real(dp) :: square, film

      square = min(1.0_dp, contact%reach(2)/contact%reach(1))**2
      film = contact%film_formula(point%moes_m, point%moes_l)
      errors = min(by_contact*point%round_m, by_film*(1.0_dp + (point%round_m/thick_m)**2)/(2.0_dp*film))*grid%hx**2
      errors(1) = errors(1)*(1.0_dp + narrow_central*(1.0_dp/square - 1.0_dp))
      errors(2) = 2.0_dp*errors(2)*max(1.0_dp, narrow_minimum/square)
   end function relative_errors

   !> Errors of H_c and H_min that are solved on this grid alone: those known a priori, and no less than what it misses of the
   !> inlet, which where films are thin is as much as there is
   pure function lone_grid_errors(contact, point, grid, films) result(errors)
      class(contact_t), intent(in) :: contact
      type(operating_t), intent(in) :: point
      type(grid_t), intent(in) :: grid
      !> H_c and H_min on it
      real(dp), intent(in) :: films(2)
      real(dp) :: errors(2)

      errors = relative_errors(contact, point, grid)*films
      if (contact%reach(2) < contact%reach(1)) errors = alone_and_narrow*errors
      errors = max(errors, by_inlet*grid%hx**2/films(1)**(1.0_dp/3.0_dp))
   end function lone_grid_errors

   !> Whether the equations have a solution on a grid, as far as that can be told
   pure logical function has_solution(contact, point, grid)
      class(contact_t), intent(in) :: contact
      type(operating_t), intent(in) :: point
      type(grid_t), intent(in) :: grid
      real(dp) :: errors(2)

      errors = relative_errors(contact, point, grid)
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
      if (text /= "" .or. contact%reach(2) > most_narrow*contact%reach(1) .or. 6.0_dp*finest%hy < finest%hx) return
      text = "the ends of a narrow contact need shorter cells across the motion: grid.y_extent = "// &
             to_text(0.125_dp*finest%hx*(finest%nx - 1))//", grid.points_y = "//to_text(2*finest%nx - 1)// &
             " and solver.max_cycles = 100 may do"
   end function better_grid
end module ehl_resolution

! SPDX-License-Identifier: BSD-3-Clause
!> Codes: why a result is missing, and which model a coefficient of friction is by. Their texts are in pyehl/reasons.py.
module ehl_reason
   implicit none (type, external)
   private
   public :: reason_none, reason_no_solution, reason_two_grids, reason_no_limit, reason_small_domain, reason_inlet, &
             reason_coarse_grid, reason_narrow, reason_coarser_none, reason_coarser_inlet, reason_much_mass_defect, &
             reason_boundary_friction, reason_not_wanted, reason_steps, reason_not_yet, reason_nothing_carried, &
             reason_small_grid, reason_coarser_status, reason_pressures, reason_no_ratio, reason_few_positions, &
             reason_not_predicted, reason_moving_alone, reason_prediction, reason_end
   public :: friction_with_heat, friction_never, friction_no_slope, friction_no_sliding, friction_newtonian, friction_small, &
             friction_of_rough, friction_no_size, friction_rolling, friction_no_smooth, friction_above_limit, &
             friction_not_converged, friction_wall_at_rest, friction_rolling_line

   !> Of a missing error: there is no solution; fewer than three grids have one; the change from grid to grid does
   !> not fall; no flooded film to compare with; bodies touch because the inlet is not resolved; the grid is too coarse for a
   !> solution; the ends of a narrow contact
   integer, parameter :: reason_none = 0, reason_no_solution = 1, reason_two_grids = 2, reason_no_limit = 3, &
                         reason_small_domain = 4, reason_inlet = 5, reason_coarse_grid = 6, reason_narrow = 7
   !> Of a roller that ends under load
   integer, parameter :: reason_end = 24
   !> Of a load share: no solution on the next coarser grid, or none that resolves the inlet; a boundary film that gives much of
   !> the flow
   integer, parameter :: reason_coarser_none = 8, reason_coarser_inlet = 9, reason_much_mass_defect = 10
   !> Of friction: where bodies touch it is not known
   integer, parameter :: reason_boundary_friction = 11
   !> Of the grid error of the friction ratio, there is no run on the next coarser grid: time.estimate_error; time.steps; not
   !> yet; nothing of the surface is on that grid; no such grid; it ended with another status; or both runs have no limit
   integer, parameter :: reason_not_wanted = 12, reason_steps = 13, reason_not_yet = 14, reason_nothing_carried = 15, &
                         reason_small_grid = 16, reason_coarser_status = 17, reason_pressures = 18
   !> Of other parts of that error: no ratio; a mean over few positions of two surfaces; waves that are left out, which were not
   !> predicted, or cannot be for surfaces at rest, or by the reason of the caller
   integer, parameter :: reason_no_ratio = 19, reason_few_positions = 20, reason_not_predicted = 21, reason_moving_alone = 22, &
                         reason_prediction = 23
   !> What a coefficient of friction is: with the heat of sliding; isothermal as required, or as the slope of the viscosity with
   !> temperature is not known, nothing slides, the stress is Newtonian and above the Eyring stress, the heat changes it by next
   !> to nothing, or a wall at rest under a line has no steady temperature; with the heat of a rough contact
   integer, parameter :: friction_with_heat = 31, friction_never = 32, friction_no_slope = 33, friction_no_sliding = 34, &
                         friction_newtonian = 35, friction_small = 36, friction_wall_at_rest = 37, &
                         friction_of_rough = 38
   !> Why there is none: no speeds in m/s; rolling, and that of a line; no smooth contact; a Newtonian stress that no oil has;
   !> no temperature
   integer, parameter :: friction_no_size = 41, friction_rolling = 42, friction_no_smooth = 43, friction_above_limit = 44, &
                         friction_not_converged = 45, friction_rolling_line = 46
end module ehl_reason

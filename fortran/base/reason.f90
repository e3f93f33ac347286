! SPDX-License-Identifier: BSD-3-Clause
!> Codes: why a result is missing, and the model of a coefficient of friction. Their texts are in pyehl/reasons.py.
module ehl_reason
   implicit none (type, external)
   private
   public :: reason_none, reason_no_solution, reason_two_grids, reason_no_limit, reason_small_domain, reason_inlet, &
             reason_coarse_grid, reason_narrow, reason_coarser_none, reason_coarser_inlet, reason_much_mass_defect, &
             reason_boundary_friction, reason_not_requested, reason_steps, reason_not_yet, reason_none_resolved, &
             reason_small_grid, reason_coarser_status, reason_pressures, reason_no_ratio, reason_few_positions, &
             reason_not_predicted, reason_stationary_waves, reason_prediction, reason_end
   public :: friction_with_heat, friction_never, friction_no_slope, friction_no_sliding, friction_newtonian, friction_small, &
             friction_of_rough, friction_no_size, friction_rolling, friction_no_smooth, friction_above_limit, &
             friction_not_converged, friction_wall_at_rest, friction_rolling_line

   !> 0: nothing is missing. Missing error estimate: no solution; solutions on fewer than three grids; the change from grid to
   !> grid does not decrease; no flooded film for comparison; solid contact because the inlet is not resolved; the grid is too
   !> coarse for a solution; the ends of a narrow contact are not resolved
   integer, parameter :: reason_none = 0, reason_no_solution = 1, reason_two_grids = 2, reason_no_limit = 3, &
                         reason_small_domain = 4, reason_inlet = 5, reason_coarse_grid = 6, reason_narrow = 7
   !> Missing error estimate of a roller that ends under load
   integer, parameter :: reason_end = 24
   !> Missing error of a load share: no solution on the next coarser grid, or none that resolves the inlet; the boundary film
   !> supplies much of the flow
   integer, parameter :: reason_coarser_none = 8, reason_coarser_inlet = 9, reason_much_mass_defect = 10
   !> Missing friction: the boundary friction is not given
   integer, parameter :: reason_boundary_friction = 11
   !> Missing grid error of the friction ratio, because of the run on the next coarser grid: switched off by time.estimate_error;
   !> time.steps; not finished; that grid resolves none of the roughness; no such grid; different status; pressures that change too
   !> much from grid to grid
   integer, parameter :: reason_not_requested = 12, reason_steps = 13, reason_not_yet = 14, reason_none_resolved = 15, &
                         reason_small_grid = 16, reason_coarser_status = 17, reason_pressures = 18
   !> Other missing parts of that error: no ratio; a mean over few relative positions of two surfaces; omitted waves that were not
   !> predicted, or cannot be predicted for stationary surfaces, or for a reason of the caller
   integer, parameter :: reason_no_ratio = 19, reason_few_positions = 20, reason_not_predicted = 21, reason_stationary_waves = 22, &
                         reason_prediction = 23
   !> Model of a coefficient of friction: with frictional heating; isothermal as requested, or because the temperature dependence
   !> of the viscosity is not known, there is no sliding, the stress is Newtonian and above the Eyring stress, heating is small,
   !> or a stationary wall under a line contact has no steady temperature; with the heating of a rough contact
   integer, parameter :: friction_with_heat = 31, friction_never = 32, friction_no_slope = 33, friction_no_sliding = 34, &
                         friction_newtonian = 35, friction_small = 36, friction_wall_at_rest = 37, &
                         friction_of_rough = 38
   !> No coefficient of friction: no speeds in m/s; pure rolling, of a point or a line contact; no smooth contact; unphysical
   !> Newtonian stress; temperature not converged
   integer, parameter :: friction_no_size = 41, friction_rolling = 42, friction_no_smooth = 43, friction_above_limit = 44, &
                         friction_not_converged = 45, friction_rolling_line = 46
end module ehl_reason

! SPDX-License-Identifier: BSD-3-Clause
!> Options of the smooth contact, and convergence rules of its levels
module ehl_steady_options
   use ehl_cycle, only: cycle_options_t
   use ehl_inlet, only: inlet_t
   use ehl_kinds, only: dp
   implicit none (type, external)
   private
   public :: steady_options_t, end_rule_t, max_error, rule_of_circles, rule_of_ellipses, rule_of_others, rule_of_rollers

   !> Maximum relative algebraic error of a result on any grid
   real(dp), parameter :: max_error = 2.0e-3_dp

   !> Options of the smooth contact
   type :: steady_options_t
      !> Expected central film [a^2/R]
      real(dp) :: film_expected = 0.0_dp
      !> Number of levels, first level of nested iteration, cycle limit of a level
      integer :: levels = 0, start = 0, max_cycles = 0
      !> Options of the cycles, and of the second cycle of a level that started from a coarser one
      type(cycle_options_t) :: cycle, second_cycle
      !> First level on which coarse grids may leave sharp pressure spikes to relaxation
      integer :: spare_spikes_from = 1
      !> Allowed algebraic error over the discretisation error
      real(dp) :: accuracy = 0.1_dp
      !> Target of the relative error of H_c; 0: none, solve on the finest grid
      real(dp) :: target_error = 0.0_dp
      !> Whether the border has the pressure of a flooded contact instead of 0
      logical :: flooded = .false.
      !> rho H of the oil layer; 0: a filled gap
      real(dp) :: layer = 0.0_dp
      !> Passages, each with the layer left by the previous one, and the fraction of the deficit replenished between them
      integer :: passages = 1
      real(dp) :: replenishment = 0.0_dp
      !> Whether a failure on the finest level may restart with damped cycles
      logical :: may_restart = .false.
      !> Whether failed cycles are rejected from the start, and not only after a failure on the finest grid
      logical :: guarded = .false.
      !> Grid errors in the inlet with solid contact
      type(inlet_t) :: inlet
      !> Whether the contact is a circle and its flow Newtonian
      logical :: newtonian_circle = .true.
      !> Whether the contact is a line
      logical :: line = .false.
   end type steady_options_t

   !> Convergence rule of a level
   type :: end_rule_t
      !> Maximum relative error of the force balance that scaling the pressure may correct; its maximum effect on the film over the
      !> allowed algebraic error
      real(dp) :: small_load_error, load_fraction
      !> Whether the reduction of the residual limits the estimated reduction, and the algebraic error includes that of the load
      logical :: bounded
      !> Lower bound of the estimated reduction per cycle
      real(dp) :: min_reduction = 0.3_dp
   end type end_rule_t

   !> In shear-thinning flows and ellipses the second cycle often reaches the accuracy, but not the load tolerance of Newtonian
   !> circles, or its change is small by chance; the rule of Newtonian circles would reduce the error to 1/500 of the allowed one
   type(end_rule_t), parameter :: rule_of_circles = end_rule_t(3.0e-6_dp, 0.1_dp, .false.), &
                                  rule_of_others = end_rule_t(1.0e-5_dp, 0.25_dp, .true.), &
                                  !> When change and residual both decrease below 0.2 of the last, the next change is 0.15 to
                                  !> 0.25 of it
                                  rule_of_ellipses = end_rule_t(1.0e-5_dp, 0.25_dp, .true., 0.2_dp), &
                                  !> The error of coarse grids at the ends of a roller has little effect on the load
                                  rule_of_rollers = end_rule_t(1.0e-4_dp, 0.25_dp, .true.)
end module ehl_steady_options

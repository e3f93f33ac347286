! SPDX-License-Identifier: BSD-3-Clause
!> How the smooth contact is solved, and when a level of it ends
module ehl_steady_options
   use ehl_cycle, only: cycle_options_t
   use ehl_inlet, only: inlet_t
   use ehl_kinds, only: dp
   implicit none (type, external)
   private
   public :: steady_options_t, end_rule_t, max_error, rule_of_circles, rule_of_ellipses, rule_of_others, rule_of_rollers

   !> Largest relative algebraic error of a result, however coarse its grid
   real(dp), parameter :: max_error = 2.0e-3_dp

   !> How the smooth contact is solved
   type :: steady_options_t
      !> Central film expected, scaled by a^2/R
      real(dp) :: film_expected = 0.0_dp
      !> Levels, the one nested iteration starts on, most cycles on a level
      integer :: levels = 0, start = 0, max_cycles = 0
      !> Cycles of a level, and the second one where it began from a coarser level
      type(cycle_options_t) :: cycle, second_cycle
      !> First level whose cycles may leave sharp pressure spikes to the sweeps
      integer :: spares_from = 1
      !> Allowed algebraic error as a share of the discretisation error
      real(dp) :: accuracy = 0.1_dp
      !> Target of the relative error of H_c; 0: none, solve on the finest grid
      real(dp) :: target_error = 0.0_dp
      !> Whether the border has the pressure of a flooded contact, else 0
      logical :: flooded = .false.
      !> rho H of the oil layer; 0: a filled gap
      real(dp) :: layer = 0.0_dp
      !> Passages, each with the layer that the one before it leaves, and the share of the deficit that is replenished between them
      integer :: passages = 1
      real(dp) :: replenishment = 0.0_dp
      !> Whether a failure on the finest level may restart with damped cycles
      logical :: may_restart = .false.
      !> Whether cycles that end in no state of the contact are taken back from the beginning on, and not only after all else
      logical :: guarded = .false.
      !> Errors by the inlet where bodies touch
      type(inlet_t) :: inlet
      !> Whether the contact is a circle and its flow Newtonian
      logical :: newtonian_circle = .true.
      !> Whether it is a line
      logical :: line = .false.
   end type steady_options_t

   !> When a level ends
   type :: end_rule_t
      !> Relative error of the force balance that scaling the pressure may remove; its largest share of the allowed algebraic
      !> error
      real(dp) :: small_load_error, share_of_load
      !> Whether the reduction per cycle is no more than that of the residual, and the error counts that of the load
      logical :: bounded
      !> Least reduction per cycle in an estimate, even if change and residual fall faster
      real(dp) :: min_reduction = 0.3_dp
   end type end_rule_t

   !> Shear-thinning flows and ellipses often reach the accuracy in the second cycle but for the load, or for a change that was
   !> small by chance; the rule of Newtonian circles, which seldom do, would reduce it to 1/500 of the allowed algebraic error
   type(end_rule_t), parameter :: rule_of_circles = end_rule_t(3.0e-6_dp, 0.1_dp, .false.), &
                                  rule_of_others = end_rule_t(1.0e-5_dp, 0.25_dp, .true.), &
                                  !> Where change and residual both fall faster than by 0.2, the next change is 0.15 to 0.25 of the
                                  !> last one
                                  rule_of_ellipses = end_rule_t(1.0e-5_dp, 0.25_dp, .true., 0.2_dp), &
                                  !> The error at the ends of a roller on coarse grids changes the load by little
                                  rule_of_rollers = end_rule_t(1.0e-4_dp, 0.25_dp, .true.)
end module ehl_steady_options

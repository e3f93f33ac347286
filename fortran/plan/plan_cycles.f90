! SPDX-License-Identifier: BSD-3-Clause
!> Multigrid cycles of a plan
submodule (ehl_plan) ehl_plan_cycles
   use ehl_case_grid, only: blunt_spike, high_spike
   use ehl_cycle, only: coarsening_alcouffe, coarsening_classical
   use ehl_step_policy, only: damped_sweep, squeeze_correction
   implicit none (type, external)

   !> Aspect ratio Y/X above which all steps under a duty are damped: 7 instead of 80 cycles per step
   real(dp), parameter :: very_wide = 4.0_dp

contains

   module procedure pick_cycle
      logical :: row

      if (input%solver%cycle /= "auto") then
         plan%cycle_letter = input%solver%cycle(1:1)
         plan%step_cycle_letter = plan%cycle_letter
      end if
      ! line relaxation of a single row is nearly a Newton step
      row = plan%contact%is_line() .and. .not. plan%surfaces%width() > 0.0_dp
      if (row .and. input%solver%cycle == "auto") plan%cycle_letter = "V"
      plan%cycle = cycle_of(plan%cycle_letter)
      if (row) plan%cycle%pre = 1
      plan%cycle%spare_spikes = has_sharp_spike(plan)
      plan%second_cycle = plan%cycle
      if (plan%cycle%full .and. input%solver%cycle == "auto" .and. .not. (plan%surfaces%rough() .or. plan%solid_contact)) then
         ! The first cycle leaves little smooth error, so that a V cycle is sufficient. Rough contacts keep full cycles, since
         ! the friction ratio contains the error of the smooth friction.
         plan%second_cycle = cycle_of("V")
         plan%second_cycle%spare_spikes = plan%cycle%spare_spikes
      end if
      ! A time step begins close to its solution, so that the cheapest cycle is best; with two post-relaxations instead of two
      ! pre-relaxations more steps need a single cycle
      plan%step_cycle = cycle_of(plan%step_cycle_letter)
      plan%step_cycle%pre = 1
      plan%step_cycle%post = 2
      plan%step_cycle%finest_only = plan%duty%active .and. plan%contact%reach(2) > wide*plan%contact%reach(1)
      if (plan%duty%active .and. plan%contact%reach(2) > very_wide*plan%contact%reach(1)) then
         plan%step_cycle%relaxation_factor = damped_sweep
         plan%step_cycle%correction_factor = squeeze_correction
      end if
      plan%coarsening_may_change = input%solver%coarsening == "auto" .and. .not. (row .or. input%contact%is_roller())
      plan%step_cycle%coarsening = merge(coarsening_alcouffe, coarsening_classical, &
                                         input%solver%coarsening == "alcouffe")
   end procedure pick_cycle

   !> Whether the pressure spike of a smooth contact is a few nodes wide along an edge that is oblique to the rows
   pure logical function has_sharp_spike(plan)
      type(plan_t), intent(in) :: plan

      has_sharp_spike = plan%contact%reach(2) > oblique*plan%contact%reach(1) .and. plan%point%moes_l > high_spike .and. &
                        plan%point%alpha_bar > blunt_spike(plan%point%moes_l) .and. &
                        .not. (plan%surfaces%rough() .or. plan%solid_contact)
   end function has_sharp_spike

   !> Options of the cycle with a letter
   pure function cycle_of(letter) result(options)
      character(len=1), intent(in) :: letter
      type(cycle_options_t) :: options

      options%gamma = merge(2, 1, letter == "W")
      options%full = letter == "F"
   end function cycle_of
end submodule ehl_plan_cycles

! SPDX-License-Identifier: BSD-3-Clause
!> Why a run has no result, where it ended, and what to do about it: one line
module ehl_no_result
   use ehl_contact_run, only: contact_run_t, phase_stationary, phase_steps
   use ehl_kinds, only: dp
   use ehl_outcome, only: outcome_cycle_limit, outcome_diverged, outcome_interrupted, outcome_negative_film, outcome_unsettled
   use ehl_resolution, only: better_grid
   use ehl_text, only: fixed, to_text
   implicit none (type, external)
   private
   public :: why_no_result

   !> Waves as high as the film need so many nodes a wavelength (docs/limits.md); what may be in shorter ones
   integer, parameter :: enough_nodes = 32
   real(dp), parameter :: little = 0.01_dp

contains

   !> Empty for a run that has an answer, or is not at its end
   function why_no_result(run, coarse) result(text)
      type(contact_run_t), intent(in) :: run
      !> The run for the grid error, while it runs
      type(contact_run_t), intent(in), optional :: coarse
      character(len=:), allocatable :: text

      select case (run%outcome)
      case (outcome_negative_film)
         text = of_negative_film(run)
      case (outcome_cycle_limit)
         text = "the residual of "//place(run)//" is "//fixed(residual(run), "es8.1")//" after cycle "// &
                to_text(cycles(run))//"; "//finer(run)//", or a larger solver.max_cycles where the residual still falls"
      case (outcome_diverged)
         text = place(run)//" has a value that is not a number; "//finer(run)//" or solver.cycle = 'W'"
      case (outcome_interrupted)
         text = "stopped from outside in "
         if (present(coarse)) then
            text = text//"the run for the grid error: "//place(coarse)
         else
            text = text//place(run)
         end if
         if (run%phase == phase_steps) text = text//"; --resume goes on from there"
      case (outcome_unsettled)
         text = "the mean of mu_r/mu_s has not settled at T = "//fixed(run%transient%time, "f10.4")
         if (run%transient%mean%has_change()) text = text//": its last change is "// &
            fixed(run%transient%mean%change(), "es8.1")//", time.tolerance allows "//fixed(run%plan%time_tolerance, "es8.1")// &
            " of it"
         text = text//"; give a larger "//trim(merge("time.steps      ", "time.max_periods", run%plan%steps > 0))//" with --resume"
      case default
         text = ""
      end select
   end function why_no_result

   !> No positive film: by the grid, or by the roughness
   function of_negative_film(run) result(text)
      type(contact_run_t), intent(in) :: run
      character(len=:), allocatable :: text
      integer :: nodes

      if (.not. run%is_rough()) then
         text = place(run)//" has no positive film: "//finer(run)
         return
      end if
      text = "no solution with a positive film for "//place(run)
      if (run%history%n_rows() > 0) text = text//", minimum film before "//film_before(run)
      nodes = nodes_of_waves(run)
      text = text//"; the shortest waves have "
      if (nodes < enough_nodes) then
         text = text//to_text(nodes)//" nodes, and as high as the film they need "//to_text(enough_nodes)//": "//finer(run)//", "
      else
         text = text//to_text(enough_nodes)//" nodes or more: give "
      end if
      text = text//"a smoother surface"
      if (run%plan%scales%has_size() .and. .not. run%plan%lubricant%boundary_film > 0.0_dp) then
         text = text//" or lubricant.boundary_film"
      end if
      if (run%plan%surfaces%move() .and. .not. run%plan%surfaces%pass_once()) then
         text = text//"; pyehl predict says where the film ends"
      end if
   end function of_negative_film

   !> Where the run stands: the smooth contact, a share of the stationary roughness, or a time step
   function place(run) result(text)
      type(contact_run_t), intent(in) :: run
      character(len=:), allocatable :: text

      if (run%phase == phase_steps) then
         text = "the time step to T = "//fixed(run%transient%time + run%transient%time_step, "f10.4")
      else if (run%phase == phase_stationary) then
         text = "the roughness at rest times "//fixed(run%stationary%share, "f5.3")
      else
         text = "the smooth contact"
      end if
      text = text//" on "//to_text(run%grid%nx)//" x "//to_text(run%grid%full_ny())//" nodes"
   end function place

   !> What may help: another grid
   function finer(run) result(text)
      type(contact_run_t), intent(in) :: run
      character(len=:), allocatable :: text

      text = ""
      if (.not. run%is_rough()) text = better_grid(run%plan%contact, run%plan%point, run%plan%finest)
      if (text == "") text = "give a finer grid (grid.points = "//to_text(2*run%plan%finest%nx - 1)//")"
   end function finer

   !> Residual (rms) at the end
   pure real(dp) function residual(run)
      type(contact_run_t), intent(in) :: run

      residual = run%smooth%results(run%level())%residual
      if (run%phase == phase_stationary) residual = run%stationary%residual
      if (run%phase == phase_steps) residual = run%transient%residual
   end function residual

   !> Cycles of what was solved last
   pure integer function cycles(run)
      type(contact_run_t), intent(in) :: run

      cycles = run%smooth%results(run%level())%cycles
      if (run%phase == phase_stationary) cycles = run%stationary%cycles
      if (run%phase == phase_steps) cycles = run%transient%cycles
   end function cycles

   !> Minimum film of the last row of the history
   function film_before(run) result(text)
      type(contact_run_t), intent(in) :: run
      character(len=:), allocatable :: text
      real(dp), allocatable :: films(:)

      allocate (films, source=run%history%column("H_min"))
      associate (film => films(size(films)), scales => run%plan%scales)
         text = "H_min = "//fixed(film, "es10.3")
         if (scales%has_size()) text = fixed(film*scales%film*1.0e9_dp, "f10.1")//" nm"
      end associate
   end function film_before

   !> Nodes that all waves but a little of the variance have at least; no more than enough
   integer function nodes_of_waves(run) result(nodes)
      type(contact_run_t), intent(in) :: run
      integer :: middle, over

      nodes = 1
      over = enough_nodes + 1
      do while (over - nodes > 1)
         middle = (nodes + over)/2
         if (run%plan%surfaces%most_unresolved(run%grid, real(middle, dp)) > little) then
            over = middle
         else
            nodes = middle
         end if
      end do
   end function nodes_of_waves
end module ehl_no_result

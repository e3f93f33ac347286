! SPDX-License-Identifier: BSD-3-Clause
!> Solver of a case: plan, smooth contact, rough contact, the run on the next coarser grid, results. `ehl` and the Python package
!> solve a case through it alone.
module ehl_solver
   use ehl_case, only: case_t
   use ehl_write_case, only: write_case
   use ehl_checkpoint, only: checkpoint_t, coarser
   use ehl_contact_run, only: contact_run_t, phase_smooth, phase_stationary, phase_steps
   use ehl_fmg, only: full_multigrid
   use ehl_grid, only: grid_t
   use ehl_kinds, only: dp
   use ehl_moving_surfaces, only: moving_surfaces_t
   use ehl_observer, only: observer_t, single_step_t
   use ehl_outcome, only: outcome_converged, outcome_interrupted, outcome_running
   use ehl_plan, only: make_plan
   use ehl_plan_need, only: check_need
   use ehl_progress, only: progress_line, work_of
   use ehl_record, only: record_t
   use ehl_smooth_film, only: film_by_finer_grids, known_film
   use ehl_stationary_rough, only: solve_stationary
   use ehl_status, only: status_t
   use ehl_transient, only: solve_transient
   implicit none (type, external)
   private
   public :: solver_t, field_length, solve_phase

   !> Maximum length of the name of a field
   integer, parameter :: field_length = 32

   !> Run of the case, and the run on the next coarser grid for the grid error of the friction ratio
   type :: solver_t
      type(case_t), private :: input
      type(contact_run_t) :: run
      !> Coarser run, allocated while it runs; the state from which it resumes
      type(contact_run_t), allocatable, private :: coarse
      type(checkpoint_t), private :: coarse_checkpoint
      !> Whether the caller predicted the parts of mu_ratio due to truncated and unresolved waves; these parts, NaN: not known
      logical :: waves_predicted = .false.
      real(dp) :: predicted_waves(2) = 0.0_dp
   contains
      procedure :: start
      procedure :: solve
      procedure :: advance
      procedure :: outcome
      procedure :: done
      procedure :: converged
      procedure :: interrupt
      procedure :: finest
      procedure :: save_state
      procedure :: resume
      procedure :: progress
      procedure :: work
      procedure :: results
      procedure :: field
      procedure :: field_names
   end type solver_t

   ! in coarser_run.f90
   interface
      !> Start the run on the next coarser grid, with the same roughness
      module subroutine begin_coarse(self)
         class(solver_t), intent(inout) :: self
      end subroutine begin_coarse

      !> Complete the run on the next coarser grid. A failure of it does not fail this run.
      module subroutine solve_coarse(self, observer, leave)
         class(solver_t), intent(inout) :: self
         class(observer_t), intent(inout) :: observer
         logical, intent(out) :: leave
      end subroutine solve_coarse
   end interface

   ! in solver_results.f90 and solver_fields.f90
   interface
      !> All named results except fields, dimensionless unless the name has a unit. Results of an unconverged run are null;
      !> those of its last iterate have names that begin with "last_". Reasons are codes with numbers.
      module function results(self) result(record)
         class(solver_t), intent(in) :: self
         type(record_t) :: record
      end function results

      !> Names of the available fields: P and H; of a rough contact also P and H of the smooth contact, the roughness RR and the
      !> deformed roughness A_d = H_smooth - H; with frictional heating the temperature rises
      module subroutine field_names(self, names)
         class(solver_t), intent(in) :: self
         character(len=field_length), allocatable, intent(out) :: names(:)
      end subroutine field_names

      !> A field on the whole domain, values(nx, full_ny) on the present grid, or interpolated bilinearly to a finer one; see
      !> field_names
      module subroutine field(self, name, values, status)
         class(solver_t), intent(in) :: self
         character(len=*), intent(in) :: name
         real(dp), intent(out) :: values(:, :)
         type(status_t), intent(inout) :: status
      end subroutine field
   end interface

contains

   !> Plan the case and prepare the coarse grids
   subroutine start(self, input, status, heights, second_heights)
      class(solver_t), intent(inout) :: self
      type(case_t), intent(in) :: input
      type(status_t), intent(inout) :: status
      !> Heights of both surfaces [m], X first, in place of files; of size 0: none. They may be deallocated afterwards.
      real(dp), intent(in), optional :: heights(:, :), second_heights(:, :)
      type(moving_surfaces_t) :: to_make

      self%input = input
      call make_plan(input, to_make, self%run%plan, status, heights, second_heights)
      call check_need(self%run%plan, status)
      call self%run%begin(status)
      if (status%failed()) return
      self%run%state_prefix = ""
      if (self%run%plan%has_steps()) self%run%state_text = step_text(input)
   end subroutine start

   !> Solve the smooth contact, the contact with stationary roughness, the run on the next coarser grid, and the time steps. The
   !> observer may stop after any cycle or step; the next call continues there.
   subroutine solve(self, observer, status)
      class(solver_t), intent(inout) :: self
      class(observer_t), intent(inout) :: observer
      type(status_t), intent(inout) :: status
      logical :: leave

      do while (.not. self%done())
         if (allocated(self%coarse)) then
            call solve_coarse(self, observer, leave)
         else
            call solve_phase(self%run, observer, leave, status)
            if (.not. (leave .or. status%failed())) call next_phase(self, status)
         end if
         if (leave .or. status%failed() .or. self%done()) return
         if (allocated(self%coarse)) then
            call observer%watch(self%coarse, leave)
         else
            call observer%watch(self%run, leave)
         end if
         if (leave) return
      end do
   end subroutine solve

   !> Make one cycle or one time step
   subroutine advance(self, status)
      class(solver_t), intent(inout) :: self
      type(status_t), intent(inout) :: status
      type(single_step_t) :: observer

      call self%solve(observer, status)
   end subroutine advance

   !> Solve the present phase of a run
   subroutine solve_phase(run, observer, leave, status)
      type(contact_run_t), intent(inout) :: run
      class(observer_t), intent(inout) :: observer
      logical, intent(out) :: leave
      type(status_t), intent(inout) :: status

      select case (run%phase)
      case (phase_smooth)
         call full_multigrid(run, observer, leave, status)
      case (phase_stationary)
         call solve_stationary(run, observer, leave, status)
      case default
         call solve_transient(run, observer, leave, status)
      end select
   end subroutine solve_phase

   !> Start the next phase. The run on the next coarser grid starts before the time steps, or after a converged contact with
   !> stationary roughness.
   subroutine next_phase(self, status)
      class(solver_t), intent(inout) :: self
      type(status_t), intent(inout) :: status

      if (self%run%outcome == outcome_running) then
         if (self%run%phase == phase_smooth .and. self%run%plan%surfaces%needs_film()) call set_amplitude(self, status)
         if (.not. status%failed()) call self%run%next_phase(status)
         if (status%failed() .or. self%run%phase /= phase_steps) return
      else if (.not. (self%run%phase == phase_stationary .and. self%run%outcome == outcome_converged)) then
         return
      end if
      if (self%run%plan%coarse_run .and. self%run%coarser%outcome == outcome_running) call begin_coarse(self)
      if (allocated(self%run%predicted%pressure)) deallocate (self%run%predicted%pressure)
   end subroutine next_phase

   !> Set an amplitude given as a fraction of the film. The film is extrapolated, since its grid error would change the roughness
   !> from grid to grid, and so spoil the extrapolation of the results.
   subroutine set_amplitude(self, status)
      type(solver_t), intent(inout) :: self
      type(status_t), intent(inout) :: status
      real(dp) :: film

      film = known_film(self%run%smooth)
      if (.not. film > 0.0_dp) film = film_by_finer_grids(self%input, self%run%plan%surfaces, status)
      call self%run%plan%surfaces%take_film(film)
   end subroutine set_amplitude

   !> Status of the run. With stationary roughness a converged run counts as running until the coarser run has ended.
   pure integer function outcome(self)
      class(solver_t), intent(in) :: self
      outcome = self%run%outcome
      if (outcome == outcome_converged .and. allocated(self%coarse)) outcome = outcome_running
   end function outcome

   !> Whether the run has ended, converged or not
   pure logical function done(self)
      class(solver_t), intent(in) :: self
      done = self%outcome() /= outcome_running
   end function done

   !> Whether the run has converged
   pure logical function converged(self)
      class(solver_t), intent(in) :: self
      converged = self%outcome() == outcome_converged
   end function converged

   !> Interrupt the run. A coarser run is kept, so that its state can be saved.
   subroutine interrupt(self)
      class(solver_t), intent(inout) :: self

      if (.not. self%done()) self%run%outcome = outcome_interrupted
   end subroutine interrupt

   !> One line on the state, with the time left of a transient run
   function progress(self) result(text)
      class(solver_t), intent(in) :: self
      character(len=:), allocatable :: text

      if (allocated(self%coarse)) then
         text = progress_line(self%coarse, self%coarse%outcome, self%done())
      else
         text = progress_line(self%run, self%outcome(), self%done())
      end if
   end function progress

   !> Work of a transient run in time steps of the finest grid, including the coarser grid: done, and at earliest and latest end.
   !> All are 0 before the first step.
   subroutine work(self, done, earliest, latest)
      class(solver_t), intent(in) :: self
      real(dp), intent(out) :: done, earliest, latest

      if (allocated(self%coarse)) then
         call work_of(self%coarse, done, earliest, latest)
      else
         call work_of(self%run, done, earliest, latest)
      end if
   end subroutine work

   !> Grid of the fields: the finest one of the plan, or with grid.target_error, whose last grid is not known in advance, the finest
   !> one so far
   pure function finest(self) result(grid)
      class(solver_t), intent(in) :: self
      type(grid_t) :: grid

      grid = self%run%plan%finest
      if (self%run%plan%target_error > 0.0_dp) grid = self%run%grid
   end function finest

   !> Write the state into a folder, whose name ends with '/'
   subroutine save_state(self, folder, status)
      class(solver_t), intent(inout) :: self
      character(len=*), intent(in) :: folder
      type(status_t), intent(inout) :: status

      if (allocated(self%coarse)) call self%coarse%save(folder, status)
      call self%run%save(folder, status)
   end subroutine save_state

   !> Resume from the newest state in a folder, whose name ends with '/', after start and before the first advance. The smooth
   !> contact is solved again, to the same bits, before the time steps.
   subroutine resume(self, folder, note, status)
      class(solver_t), intent(inout) :: self
      character(len=*), intent(in) :: folder
      !> Note for the user; empty when there is no state yet
      character(len=:), allocatable, intent(out) :: note
      type(status_t), intent(inout) :: status

      call self%run%checkpoint%find(folder, step_text(self%input), note, status)
      if (status%failed() .or. self%run%checkpoint%found()) return
      call self%coarse_checkpoint%find(folder//coarser, step_text(self%input), note, status)
   end subroutine resume

   !> The case as text, with defaults for the keys that change no step: end of the run, threads, the coarser run, prediction, output
   !> except frames. A run may be resumed with other values of these.
   function step_text(input) result(text)
      type(case_t), intent(in) :: input
      character(len=:), allocatable :: text
      type(case_t) :: plain, default

      plain = input
      plain%solver%threads = default%solver%threads
      plain%solver%max_cycles = default%solver%max_cycles
      plain%time%tolerance = default%time%tolerance
      plain%time%max_periods = default%time%max_periods
      plain%time%steps = default%time%steps
      plain%time%estimate_error = default%time%estimate_error
      plain%psd = default%psd
      plain%output = default%output
      plain%output%frame_interval = input%output%frame_interval
      call write_case(plain, text)
   end function step_text
end module ehl_solver

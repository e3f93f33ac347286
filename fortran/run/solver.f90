! SPDX-License-Identifier: BSD-3-Clause
!> Solver of a case: plan, smooth contact, rough contact, the same on the next coarser grid, results. Both drivers use
!> this interface alone.
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

   !> Longest name of a field
   integer, parameter :: field_length = 32

   !> The contact of the case, and for the grid error of its friction ratio the same one on the next coarser grid
   type :: solver_t
      type(case_t), private :: input
      type(contact_run_t) :: run
      !> Allocated while it runs; the state from which it is resumed
      type(contact_run_t), allocatable, private :: coarse
      type(checkpoint_t), private :: coarse_checkpoint
      !> Whether the caller predicted the parts of mu_ratio in waves that the grid leaves out, and in those that it does
      !> not resolve, and these parts; NaN: none
      logical :: knows_waves = .false.
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

      !> Complete the run on the next coarser grid. Its failure is not one of this run.
      module subroutine solve_coarse(self, observer, leave)
         class(solver_t), intent(inout) :: self
         class(observer_t), intent(inout) :: observer
         logical, intent(out) :: leave
      end subroutine solve_coarse
   end interface

   ! in solver_results.f90 and solver_fields.f90
   interface
      !> All results but fields, by name; dimensionless but for the SI values. Only a converged run has
      !> results: otherwise they are null, and the last iterate stands under names that begin with "last_".
      !> Reasons are codes with numbers.
      module function results(self) result(record)
         class(solver_t), intent(in) :: self
         type(record_t) :: record
      end function results

      !> Names of the fields there are: P and H; in a transient run also those of the smooth contact, the roughness
      !> RR and the deformed roughness A_d = H_smooth - H; where the heat of friction counts the rises of temperature
      module subroutine field_names(self, names)
         class(solver_t), intent(in) :: self
         character(len=field_length), allocatable, intent(out) :: names(:)
      end subroutine field_names

      !> A field on the whole domain, values(nx, full_ny) of the grid reached so far, or bilinear between its nodes of a
      !> finer one; see field_names
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
      !> Heights of the maps of both surfaces [m], X first, in place of files; of size 0: none. They are no longer needed
      !> afterwards.
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

   !> The smooth contact; that with the stationary roughness; both on the next coarser grid; time steps. The observer may leave
   !> after any cycle or step; another call continues there.
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

   !> One cycle or one time step
   subroutine advance(self, status)
      class(solver_t), intent(inout) :: self
      type(status_t), intent(inout) :: status
      type(single_step_t) :: observer

      call self%solve(observer, status)
   end subroutine advance

   !> The present phase of a contact, to its end
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

   !> After a phase: the next one, and before time steps, or after all of a stationary surface, the run on the next coarser grid
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

   !> The amplitude that was given as a share of the film. It belongs to the case and not to the grid: a grid error of
   !> the film would be one of the roughness, and of a sign that extrapolation does not expect.
   subroutine set_amplitude(self, status)
      type(solver_t), intent(inout) :: self
      type(status_t), intent(inout) :: status
      real(dp) :: film

      film = known_film(self%run%smooth)
      if (.not. film > 0.0_dp) film = film_by_finer_grids(self%input, self%run%plan%surfaces, status)
      call self%run%plan%surfaces%take_film(film)
   end subroutine set_amplitude

   !> Status of the run; a run with a stationary surface ends when its error is known
   pure integer function outcome(self)
      class(solver_t), intent(in) :: self
      outcome = self%run%outcome
      if (outcome == outcome_converged .and. allocated(self%coarse)) outcome = outcome_running
   end function outcome

   !> Whether the run has ended, with or without a solution
   pure logical function done(self)
      class(solver_t), intent(in) :: self
      done = self%outcome() /= outcome_running
   end function done

   !> Whether the run has converged
   pure logical function converged(self)
      class(solver_t), intent(in) :: self
      converged = self%outcome() == outcome_converged
   end function converged

   !> Interrupt the run. A coarser run is kept: its state may have to be saved.
   subroutine interrupt(self)
      class(solver_t), intent(inout) :: self

      if (.not. self%done()) self%run%outcome = outcome_interrupted
   end subroutine interrupt

   !> One line about the state, with the time left of a transient run
   function progress(self) result(text)
      class(solver_t), intent(in) :: self
      character(len=:), allocatable :: text

      if (allocated(self%coarse)) then
         text = progress_line(self%coarse, self%coarse%outcome, self%done())
      else
         text = progress_line(self%run, self%outcome(), self%done())
      end if
   end function progress

   !> Work of a transient run that is done, in time steps of the finest grid, those on the coarser grid by their cost;
   !> and the work until its earliest and its latest end. All are 0 before the first step.
   subroutine work(self, done, earliest, latest)
      class(solver_t), intent(in) :: self
      real(dp), intent(out) :: done, earliest, latest

      if (allocated(self%coarse)) then
         call work_of(self%coarse, done, earliest, latest)
      else
         call work_of(self%run, done, earliest, latest)
      end if
   end subroutine work

   !> The grid that fields refer to: the finest one of the plan; with grid.target_error, whose last grid is not known in
   !> advance, the finest one so far
   pure function finest(self) result(grid)
      class(solver_t), intent(in) :: self
      type(grid_t) :: grid

      grid = self%run%plan%finest
      if (self%run%plan%target_error > 0.0_dp) grid = self%run%grid
   end function finest

   !> Write the state into a folder (its name ends in '/')
   subroutine save_state(self, folder, status)
      class(solver_t), intent(inout) :: self
      character(len=*), intent(in) :: folder
      type(status_t), intent(inout) :: status

      if (allocated(self%coarse)) call self%coarse%save(folder, status)
      call self%run%save(folder, status)
   end subroutine save_state

   !> After start and before the first advance: resume from the newest state in a folder (its name ends in '/').
   !> The smooth contact is solved again, to the same bits, before the first time step.
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

   !> The case as text, with the defaults of all keys that change no step: when to stop, threads, what to
   !> write. A run may be resumed with other values of these.
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

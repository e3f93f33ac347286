! SPDX-License-Identifier: BSD-3-Clause
!> A case on its way: plan, smooth contact, rough contact, the same on the next coarser grid, results. Both drivers call
!> nothing else.
module ehl_solver
   use ehl_case, only: case_t
   use ehl_write_case, only: write_case
   use ehl_checkpoint, only: checkpoint_t, coarser
   use ehl_contact_run, only: contact_run_t
   use ehl_grid, only: grid_t
   use ehl_kinds, only: dp
   use ehl_moving_surfaces, only: moving_surfaces_t
   use ehl_outcome, only: outcome_converged, outcome_failed, outcome_interrupted, outcome_running
   use ehl_plan, only: make_plan
   use ehl_plan_need, only: check_need
   use ehl_ratio_error, only: waves_t
   use ehl_record, only: record_t
   use ehl_report_touching, only: load_share_of
   use ehl_smooth_film, only: film_by_finer_grids, known_film
   use ehl_status, only: status_t
   implicit none (type, external)
   private
   public :: solver_t, field_length

   !> Longest name of a field
   integer, parameter :: field_length = 32

   !> Cost of a step on the next coarser grid, in steps: it has a quarter of the nodes
   real(dp), parameter :: coarse_step = 0.25_dp

   !> The run of the case, and for the grid error of its friction ratio another one on the next coarser grid
   type, extends(contact_run_t) :: solver_t
      type(case_t), private :: input
      !> Allocated while it runs; the state that it is to go on from
      type(contact_run_t), allocatable, private :: coarse
      type(checkpoint_t), private :: coarse_checkpoint
      !> What it has cost, in time steps of this run and in seconds
      real(dp), private :: coarse_work = 0.0_dp, coarse_seconds = 0.0_dp
      !> What is predicted of the waves that the grid does not resolve
      type(waves_t) :: waves
   contains
      procedure :: start
      procedure :: advance
      procedure :: stand
      procedure :: done
      procedure :: converged
      procedure :: interrupt
      procedure :: finest
      procedure :: save_state
      procedure :: resume
      procedure :: progress
      procedure :: work
      procedure :: summary
      procedure :: field
      procedure :: field_names
   end type solver_t

   ! in solver_progress.f90
   interface
      !> One line about the state, with the time left of a transient run
      module function progress(self) result(text)
         class(solver_t), intent(in) :: self
         character(len=:), allocatable :: text
      end function progress

      !> How much of a transient run is done, in time steps of the finest grid, those on the coarser grid by their cost;
      !> and how much there is until its earliest and its latest end. Both are 0 before the first step.
      module subroutine work(self, done, earliest, latest)
         class(solver_t), intent(in) :: self
         real(dp), intent(out) :: done, earliest, latest
      end subroutine work
   end interface

   ! in solver_results.f90 and solver_fields.f90
   interface
      !> All results but fields, by name; dimensionless but for the SI values. Only a converged run has
      !> results: otherwise they are null, and the last iterate stands under names that begin with "last_".
      module function summary(self) result(record)
         class(solver_t), intent(in) :: self
         type(record_t) :: record
      end function summary

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
      call make_plan(input, to_make, self%plan, status, heights, second_heights)
      call check_need(self%plan, status)
      call self%begin(status)
   end subroutine start

   !> One cycle or one time step. All of it is
   !>
   !>    the smooth contact
   !>    at rest:     the rough contact; both on the next coarser grid
   !>    on the move: with what is at rest, if there is any; all that on the next coarser grid; time steps
   subroutine advance(self, status)
      class(solver_t), intent(inout) :: self
      type(status_t), intent(inout) :: status
      logical :: both, in_steps

      if (self%done()) return
      if (allocated(self%coarse)) then
         call advance_coarse(self)
         return
      end if
      in_steps = self%in_steps
      call self%contact_run_t%advance(status)
      if (status%failed()) return
      both = (self%resting .and. self%outcome == outcome_converged) .or. (self%in_steps .and. .not. in_steps)
      if (self%roughness_is_due()) then
         if (self%plan%surfaces%needs_film()) call set_amplitude(self, status)
         if (.not. status%failed()) call self%begin_rough(status)
         both = self%in_steps
      end if
      if (status%failed() .or. .not. both) return
      if (self%plan%coarse_run .and. self%coarse_outcome == outcome_running) call begin_coarse(self)
      if (allocated(self%predicted%pressure)) deallocate (self%predicted%pressure)
   end subroutine advance

   !> The amplitude that was given as a share of the film. It belongs to the case and not to the grid: a grid error of
   !> the film would be one of the roughness, and of a sign that extrapolation does not expect.
   subroutine set_amplitude(self, status)
      type(solver_t), intent(inout) :: self
      type(status_t), intent(inout) :: status
      real(dp) :: film

      film = known_film(self%steady)
      if (.not. film > 0.0_dp) film = film_by_finer_grids(self%input, self%plan%surfaces, status)
      call self%plan%surfaces%take_film(film)
   end subroutine set_amplitude

   !> Start the run on the next coarser grid, with the same roughness
   subroutine begin_coarse(self)
      class(solver_t), intent(inout) :: self
      type(status_t) :: status
      type(case_t) :: input
      type(moving_surfaces_t) :: surfaces

      input = self%input
      input%output%frame_interval = 0.0_dp
      input%grid%points = (self%grid%nx + 1)/2
      input%grid%points_y = (self%grid%full_ny() + 1)/2
      input%grid%target_error = 0.0_dp
      input%time%estimate_error = .false.
      allocate (self%coarse)
      ! the same roughness, not the same share of another film
      call self%plan%surfaces%hand_over(surfaces)
      call make_plan(input, surfaces, self%coarse%plan, status)
      ! a plan that failed may not have taken them
      call self%plan%surfaces%take_back(surfaces)
      self%coarse%plan%heat%counts = .false.
      call self%coarse%begin(status)
      self%coarse%checkpoint = self%coarse_checkpoint
      self%coarse%predicted = self%predicted%coarser()
      if (allocated(self%why_front)) self%coarse%why_front = self%why_front
      if (status%failed()) call end_coarse(self, status)
   end subroutine begin_coarse

   !> One cycle or step of the coarser run. That it fails is no failure of this one.
   subroutine advance_coarse(self)
      class(solver_t), intent(inout) :: self
      type(status_t) :: status

      call self%coarse%advance(status)
      if (self%coarse%roughness_is_due() .and. .not. status%failed()) call self%coarse%begin_rough(status)
      if (status%failed() .or. self%coarse%outcome /= outcome_running) call end_coarse(self, status)
   end subroutine advance_coarse

   !> Keep how the coarser run ended, and its friction ratio if it converged; without that the grid error is not known
   subroutine end_coarse(self, status)
      class(solver_t), intent(inout) :: self
      type(status_t), intent(in) :: status

      self%coarse_outcome = self%coarse%outcome
      if (status%failed()) then
         self%coarse_outcome = outcome_failed
         self%coarse_message = status%message
      end if
      if (self%coarse_outcome == outcome_converged) then
         self%coarse_ratio = self%coarse%mu_ratio()
         if (self%plan%lubricant%boundary_film > 0.0_dp) self%coarse_load_share = load_share_of(self%coarse)
      end if
      self%coarse_work = coarse_step*self%coarse%transient%step
      self%coarse_seconds = self%coarse%seconds
      ! why a film ends is read off the waves
      call self%plan%surfaces%take_back(self%coarse%plan%surfaces)
      deallocate (self%coarse)
   end subroutine end_coarse

   !> How the run stands; a surface at rest has not ended before its error is known
   pure integer function stand(self)
      class(solver_t), intent(in) :: self
      stand = self%outcome
      if (stand == outcome_converged .and. allocated(self%coarse)) stand = outcome_running
   end function stand

   !> Whether the run has ended, well or not
   pure logical function done(self)
      class(solver_t), intent(in) :: self
      done = self%stand() /= outcome_running
   end function done

   !> Whether the run has ended well
   pure logical function converged(self)
      class(solver_t), intent(in) :: self
      converged = self%stand() == outcome_converged
   end function converged

   !> End the run here. A coarser run stays: it is where the run ended, and its state may have to be saved.
   subroutine interrupt(self)
      class(solver_t), intent(inout) :: self

      if (self%done()) return
      self%outcome = outcome_interrupted
   end subroutine interrupt

   !> The grid that fields refer to: the finest one of the plan; with a wanted error, which ends on a grid that nobody
   !> knows before, the finest one so far
   pure function finest(self) result(grid)
      class(solver_t), intent(in) :: self
      type(grid_t) :: grid

      grid = self%plan%finest
      if (self%plan%target_error > 0.0_dp) grid = self%grid
   end function finest

   !> Write the state into a folder (its name ends in '/')
   subroutine save_state(self, folder, status)
      class(solver_t), intent(inout) :: self
      character(len=*), intent(in) :: folder
      type(status_t), intent(inout) :: status

      if (allocated(self%coarse)) call self%coarse%save(folder//coarser, step_text(self%input), status)
      call self%save(folder, step_text(self%input), status)
   end subroutine save_state

   !> After start and before the first advance: go on from the newest state in a folder (its name ends in '/').
   !> The smooth contact is solved again, to the same bits, before the first time step.
   subroutine resume(self, folder, note, status)
      class(solver_t), intent(inout) :: self
      character(len=*), intent(in) :: folder
      !> What a person should know; empty when there is no state yet
      character(len=:), allocatable, intent(out) :: note
      type(status_t), intent(inout) :: status

      call self%checkpoint%find(folder, step_text(self%input), note, status)
      if (status%failed() .or. self%checkpoint%found()) return
      call self%coarse_checkpoint%find(folder//coarser, step_text(self%input), note, status)
   end subroutine resume

   !> The case as text, with the defaults of all keys that change no step: when to stop, threads, what to
   !> write. A run may go on with others of them.
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

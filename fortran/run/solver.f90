! SPDX-License-Identifier: BSD-3-Clause
!> A case on its way: plan, grids, transient run and results. Both drivers call nothing else.
module ehl_solver
   use ehl_case, only: case_t
   use ehl_checkpoint, only: checkpoint_t
   use ehl_frames, only: frames_t
   use ehl_grid, only: grid_t
   use ehl_hierarchy, only: hierarchy_t
   use ehl_kinds, only: dp
   use ehl_moving_surfaces, only: moving_surfaces_t
   use ehl_outcome, only: outcome_converged, outcome_interrupted, outcome_running
   use ehl_plan, only: make_plan, plan_t, relative_wedge_error
   use ehl_plan_need, only: check_need
   use ehl_ratio_error, only: waves_t
   use ehl_record, only: record_t
   use ehl_stationary_roughness, only: stationary_roughness_t
   use ehl_status, only: status_t
   use ehl_steady, only: steady_t
   use ehl_table, only: table_t
   use ehl_transient, only: transient_t
   implicit none (type, external)
   private
   public :: solver_t

   !> Cost of a step on the next coarser grid, in steps: it has a quarter of the nodes
   real(dp), parameter :: coarse_step = 0.25_dp
   !> A-priori error of H_c of grids that resolve the inlet: a smooth contact that fails there begins again with care
   real(dp), parameter :: resolved_error = 0.1_dp

   type :: solver_t
      !> Finest grid reached so far
      type(grid_t) :: grid
      !> A row per cycle
      type(table_t) :: history
      type(plan_t), private :: plan
      type(hierarchy_t), private :: hierarchy
      type(steady_t), private :: steady
      type(transient_t), private :: transient
      type(stationary_roughness_t), private :: rest
      !> Whether the transient run has begun; the contact with a rough surface at rest
      logical, private :: in_steps = .false., resting = .false.
      !> How the transient run stands
      integer, private :: outcome = outcome_running
      !> Seconds spent on time steps
      real(dp), private :: step_seconds = 0.0_dp
      !> Surfaces that were made already
      type(moving_surfaces_t), private :: surfaces
      type(case_t), private :: input
      !> Pressure and film of the smooth contact, kept where there is a rough one; frames of the transient run
      real(dp), allocatable, private :: p_smooth(:, :), h_smooth(:, :)
      type(frames_t) :: frames
      !> State on disk, and to go on from when the smooth contact is solved: of this run, of the coarser one before it begins
      type(checkpoint_t), private :: checkpoint, coarse_checkpoint
      !> The same run on the next coarser grid, for the grid error of the friction ratio
      type(solver_t), pointer, private :: coarse => null()
      !> How it ended, outcome_running if it has not; its mean friction ratio if it converged; the error that ended it
      integer, private :: coarse_outcome = outcome_running
      real(dp), private :: coarse_mean = 0.0_dp
      character(len=:), allocatable, private :: coarse_message
      !> What is predicted of the waves that the grid does not resolve
      type(waves_t) :: waves
      !> What that run has cost, in time steps of this one and in seconds
      real(dp), private :: coarse_work = 0.0_dp, coarse_seconds = 0.0_dp
   contains
      final :: close_solver
      procedure :: save_state
      procedure :: resume
      procedure :: moves
      procedure :: steps_made
      procedure :: start
      procedure :: describe
      procedure :: advance
      procedure :: done
      procedure :: finest
      procedure :: converged
      procedure :: interrupt
      procedure :: progress
      procedure :: work
      procedure :: summary
      procedure :: conclusion
      procedure :: field
      procedure :: field_names
      procedure, private :: level
      procedure, private :: stand
   end type solver_t

   ! in solver_run.f90
   interface
      !> One multigrid cycle of the smooth contact, then one time step
      recursive module subroutine advance(self, status)
         class(solver_t), intent(inout) :: self
         type(status_t), intent(inout) :: status
      end subroutine advance
   end interface

   ! in solver_state.f90
   interface
      !> Write the state into a folder (its name ends in '/'). Before the first time step there is nothing
      !> that is worth it.
      module subroutine save_state(self, folder, status)
         class(solver_t), intent(inout) :: self
         character(len=*), intent(in) :: folder
         type(status_t), intent(inout) :: status
      end subroutine save_state

      !> After start and before the first advance: go on from the newest state in a folder (its name ends in '/').
      !> The smooth contact is solved again, to the same bits, before the first time step.
      module subroutine resume(self, folder, note, status)
         class(solver_t), intent(inout) :: self
         character(len=*), intent(in) :: folder
         !> What a person should know; empty when there is no state yet
         character(len=:), allocatable, intent(out) :: note
         type(status_t), intent(inout) :: status
      end subroutine resume

      !> The state that was read takes the place of the start of the transient run
      module subroutine take_state(self, status)
         type(solver_t), intent(inout) :: self
         type(status_t), intent(inout) :: status
      end subroutine take_state
   end interface

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

   ! in solver_results.f90
   interface
      !> The plan in a few lines, for a person
      module function describe(self) result(text)
         class(solver_t), intent(in) :: self
         character(len=:), allocatable :: text
      end function describe

      !> All results but fields, by name; dimensionless but for the SI values. Only a converged run has
      !> results: otherwise they are null, and the last iterate stands under names that begin with "last_".
      module function summary(self) result(record)
         class(solver_t), intent(in) :: self
         type(record_t) :: record
      end function summary

      !> What a run that has ended gave, in a few lines for a person
      module function conclusion(self) result(text)
         class(solver_t), intent(in) :: self
         character(len=:), allocatable :: text
      end function conclusion

      !> Names of the fields there are: P and H; in a transient run also those of the smooth contact, the roughness
      !> RR and the deformed roughness A_d = H_smooth - H
      module subroutine field_names(self, names)
         class(solver_t), intent(in) :: self
         character(len=8), allocatable, intent(out) :: names(:)
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
   recursive subroutine start(self, input, status, heights, second_heights)
      class(solver_t), intent(inout) :: self
      type(case_t), intent(in) :: input
      type(status_t), intent(inout) :: status
      !> Heights of the maps of both surfaces [m], X first, in place of files; of size 0: none. They are no longer needed
      !> afterwards.
      real(dp), intent(in), optional :: heights(:, :), second_heights(:, :)
      logical :: is_part

      self%input = input
      ! the run on the coarser grid was counted with the one it belongs to
      is_part = self%surfaces%rough()
      call make_plan(input, self%surfaces, self%plan, status, heights, second_heights)
      if (.not. is_part) call check_need(self%plan, status)
      if (status%failed()) return
      associate (plan => self%plan)
         call self%hierarchy%setup(plan%coarsest, plan%levels, plan%lubricant, plan%point%speed_parameter, &
                                   plan%engine, plan%threads, status)
         call self%steady%start(plan%contact, plan%film_expected, plan%start, plan%levels, plan%cycle, &
                                plan%second_cycle, plan%accuracy, plan%target_error, plan%max_cycles, plan%flooded, &
                                relative_wedge_error(plan%point, plan%finest) <= resolved_error)
      end associate
      call self%hierarchy%grow(self%steady%n, status)
      if (status%failed()) return
      self%grid = self%hierarchy%levels(self%steady%n)%grid
      if (self%plan%surfaces%rest()) then
         call self%history%init([character(len=16) :: "cycle", "share", "mu_ratio", "H_c", "H_min", "P_max", "load_error", &
                                 "residual"])
      else if (self%moves()) then
         call self%history%init([character(len=16) :: "step", "T", "mu_ratio", "H_c", "H_min", "P_max", "load_error", &
                                 "cycles", "residual"])
      else
         call self%history%init([character(len=16) :: "level", "points", "cycle", "H_c", "H_min", "P_max", "F", &
                                 "load_error", "residual", "H_c_algebraic"])
      end if
   end subroutine start

   !> Time steps made so far
   pure integer function steps_made(self)
      class(solver_t), intent(in) :: self
      steps_made = merge(self%transient%step, 0, self%in_steps)
   end function steps_made

   !> Whether the case is a transient run
   pure logical function moves(self)
      class(solver_t), intent(in) :: self
      moves = self%plan%surfaces%move()
   end function moves

   !> How the run stands
   pure integer function stand(self)
      class(solver_t), intent(in) :: self
      stand = self%steady%outcome
      if (.not. self%plan%surfaces%rough()) return
      if (self%in_steps) then
         stand = self%outcome
      else if (self%resting) then
         stand = self%rest%outcome
         ! the error is not known yet
         if (associated(self%coarse)) stand = outcome_running
      else if (stand == outcome_converged) then
         stand = outcome_running
      end if
   end function stand

   !> The grid that fields refer to: the finest one of the plan; with a wanted error, which ends on a grid that nobody
   !> knows before, the finest one so far
   pure function finest(self) result(grid)
      class(solver_t), intent(in) :: self
      type(grid_t) :: grid

      grid = self%plan%finest
      if (self%plan%target_error > 0.0_dp) grid = self%grid
   end function finest

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

   !> End the run here
   subroutine interrupt(self)
      class(solver_t), intent(inout) :: self
      if (self%done()) return
      if (self%in_steps) then
         self%outcome = outcome_interrupted
      else if (self%resting) then
         self%rest%outcome = outcome_interrupted
         if (associated(self%coarse)) deallocate (self%coarse)
      else
         self%steady%outcome = outcome_interrupted
      end if
   end subroutine interrupt

   !> Level of the results: the present one, or the last one that has been worked on
   pure integer function level(self)
      class(solver_t), intent(in) :: self
      level = self%steady%n
      if (self%steady%results(level)%cycles == 0 .and. level > 1) then
         if (self%steady%results(level - 1)%cycles > 0) level = level - 1
      end if
   end function level

   !> Free what a solver points to
   impure elemental subroutine close_solver(self)
      type(solver_t), intent(inout) :: self
      if (associated(self%coarse)) deallocate (self%coarse)
   end subroutine close_solver
end module ehl_solver

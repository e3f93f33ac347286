! SPDX-License-Identifier: BSD-3-Clause
!> Run of a planned contact: state, history and order of the phases. The phases are the smooth contact (ehl_fmg), stationary
!> roughness (ehl_stationary_rough) and time steps (ehl_transient).
module ehl_contact_run
   use ehl_checkpoint, only: checkpoint_t, coarser_t
   use ehl_frames, only: frames_t
   use ehl_grid, only: grid_t
   use ehl_heated_friction, only: heated_t
   use ehl_hierarchy, only: hierarchy_t
   use ehl_kinds, only: dp
   use ehl_oil_flow, only: oil_names
   use ehl_outcome, only: outcome_converged, outcome_running, outcome_target_missed
   use ehl_level, only: gap, level_t
   use ehl_plan, only: plan_t
   use ehl_plan_surface, only: check_resolved
   use ehl_predicted_start, only: predicted_start_t
   use ehl_smooth_contact, only: smooth_contact_t
   use ehl_stationary_state, only: stationary_t
   use ehl_status, only: ehl_no_memory, status_t
   use ehl_stopping_criterion, only: transient_outcome
   use ehl_table, only: table_t
   use ehl_touching, only: known_names, touching_names
   use ehl_transient_state, only: transient_t
   implicit none (type, external)
   private
   public :: contact_run_t
   public :: phase_smooth, phase_stationary, phase_steps

   !> Phases: the smooth contact, the contact with a stationary rough surface, time steps
   integer, parameter :: phase_smooth = 1, phase_stationary = 2, phase_steps = 3

   !> Work in time steps of the finest grid: done, and at the earliest and latest end; seconds spent
   type :: work_t
      real(dp) :: done = 0.0_dp, earliest = 0.0_dp, latest = 0.0_dp, seconds = 0.0_dp
   end type work_t

   type :: contact_run_t
      type(plan_t) :: plan
      !> Status, and the present phase
      integer :: outcome = outcome_running, phase = phase_smooth
      !> Finest grid so far
      type(grid_t) :: grid
      type(hierarchy_t) :: hierarchy
      type(smooth_contact_t) :: smooth
      type(stationary_t) :: stationary
      type(transient_t) :: transient
      !> Predicted start of the time steps if planned, and the reason if it is not used
      type(predicted_start_t) :: predicted
      character(len=:), allocatable :: fallback_reason
      !> One row per cycle or time step; seconds spent on the rough contact
      type(table_t) :: history
      real(dp) :: seconds = 0.0_dp
      !> Pressure, film and separation of the smooth contact, kept for the rough one; frames of the transient run
      real(dp), allocatable :: p_smooth(:, :), h_smooth(:, :)
      real(dp) :: h00_smooth = 0.0_dp
      type(frames_t) :: frames
      !> Frictional heating of the smooth contact, and of the rough contact at the end
      type(heated_t) :: smooth_heat, rough_heat
      !> State on disk, from which a run resumes once the smooth contact is solved; text of its case, prefix of its file names
      type(checkpoint_t) :: checkpoint
      character(len=:), allocatable :: state_text, state_prefix
      !> Result on the next coarser grid; whether this run is the coarser one, the work of the other run, and the cost of a step
      !> of this run in steps of the finest grid
      type(coarser_t) :: coarser
      logical :: is_coarser = .false.
      type(work_t) :: other
      real(dp) :: step_cost = 1.0_dp
   contains
      procedure :: begin
      procedure, private :: begin_history
      procedure :: record_cycle
      procedure :: record_rough_cycle
      procedure :: record_step
      procedure :: next_phase
      procedure :: is_filling
      procedure :: restart_with_front
      procedure :: is_rough
      procedure :: level
      procedure :: mu_ratio
      procedure :: heat_ratio
      procedure :: save
   end type contact_run_t

   ! in contact_duty.f90
   interface
      !> Names of the columns of the history under a duty
      module subroutine duty_names(self, names)
         class(contact_run_t), intent(in) :: self
         character(len=16), allocatable, intent(out) :: names(:)
      end subroutine duty_names

      !> Row of the history after a step under a duty
      module subroutine duty_row(self, level, row)
         class(contact_run_t), intent(in) :: self
         type(level_t), intent(in) :: level
         real(dp), allocatable, intent(out) :: row(:)
      end subroutine duty_row
   end interface

   ! in contact_start.f90
   interface
      !> Start the time steps from the steady contact or from a prediction, or resume from a saved state
      module subroutine begin_steps(self, status)
         class(contact_run_t), intent(inout) :: self
         type(status_t), intent(inout) :: status
      end subroutine begin_steps

      !> Restart with a front after the first steps from a prediction failed
      module subroutine restart_with_front(self, outcome, status)
         class(contact_run_t), intent(inout) :: self
         !> Status of the failed step
         integer, intent(in) :: outcome
         type(status_t), intent(inout) :: status
      end subroutine restart_with_front
   end interface

   ! in contact_heat.f90
   interface
      !> Friction and temperature of the present contact on level n; with `keep` the temperature field is stored
      module subroutine add_heat(self, n, keep, found, status)
         class(contact_run_t), intent(in) :: self
         integer, intent(in) :: n
         logical, intent(in) :: keep
         type(heated_t), intent(out) :: found
         type(status_t), intent(inout) :: status
      end subroutine add_heat

      !> Thermal over isothermal friction after a step; NaN if not computed
      module subroutine step_heat(self, ratio, status)
         class(contact_run_t), intent(in) :: self
         real(dp), intent(out) :: ratio
         type(status_t), intent(inout) :: status
      end subroutine step_heat

      !> Thermal over isothermal friction of the converged rough contact, averaged as the friction ratio; NaN if unknown
      module real(dp) function heat_ratio(self)
         class(contact_run_t), intent(in) :: self
      end function heat_ratio
   end interface

contains

   !> Start a run: grids, smooth contact, and an empty history
   subroutine begin(self, status)
      class(contact_run_t), intent(inout) :: self
      type(status_t), intent(inout) :: status

      if (status%failed()) return
      if (allocated(self%plan%fallback_reason)) self%fallback_reason = self%plan%fallback_reason
      call self%hierarchy%setup(self%plan%coarsest, self%plan%levels, self%plan%lubricant, self%plan%point%speed_parameter, &
                                self%plan%contact%kernel_factor, self%plan%engine, self%plan%threads, status)
      call self%smooth%start(self%plan%contact, self%plan%steady_options_t)
      call self%hierarchy%grow(self%smooth%n, status)
      if (status%failed()) return
      self%grid = self%hierarchy%levels(self%smooth%n)%grid
      call self%begin_history()
   end subroutine begin

   !> Start an empty history
   subroutine begin_history(self)
      class(contact_run_t), intent(inout) :: self
      character(len=16), allocatable :: columns(:)

      if (self%plan%duty%active) then
         call duty_names(self, columns)
         if (self%plan%layer > 0.0_dp) columns = [character(len=16) :: columns, oil_names]
         columns = [character(len=16) :: columns, touching_names(:known_names(self%plan%lubricant))]
      else if (self%plan%surfaces%all_stationary()) then
         columns = [character(len=16) :: "cycle", "share", "mu_ratio", "H_c", "H_min", "P_max", "load_error", "residual"]
      else if (self%plan%surfaces%move()) then
         columns = [character(len=16) :: "step", "T", "mu_ratio", "H_c", "H_min", "P_max", "load_error", "cycles", "residual"]
         if (self%plan%heat%active) columns = [character(len=16) :: columns, "heat_ratio"]
         columns = [character(len=16) :: columns, touching_names(:known_names(self%plan%lubricant))]
      else
         columns = [character(len=16) :: "level", "points", "cycle", "H_c", "H_min", "P_max", "F", "load_error", "residual", &
                    "H_c_algebraic"]
         if (self%plan%passages > 1) columns = [character(len=16) :: columns, "passage", "oil_layer"]
      end if
      call self%history%init(columns)
   end subroutine begin_history

   !> Record a cycle of the smooth contact on level n. If another phase follows no row is added to the history.
   subroutine record_cycle(self, n, outcome, status)
      class(contact_run_t), intent(inout) :: self
      integer, intent(in) :: n
      !> Status of the smooth contact
      integer, intent(in) :: outcome
      type(status_t), intent(inout) :: status
      real(dp), allocatable :: row(:)

      self%grid = self%hierarchy%levels(n)%grid
      if (.not. (self%plan%has_next_phase() .and. outcome == outcome_converged)) self%outcome = outcome
      if (self%plan%heat%active .and. any(outcome == [outcome_converged, outcome_target_missed])) then
         call add_heat(self, n, .not. self%plan%has_next_phase(), self%smooth_heat, status)
      end if
      if (self%plan%has_next_phase()) return
      associate (result => self%smooth%results(n))
         row = [real(dp) :: n, self%grid%nx, result%cycles, result%m%film_central, result%m%film_minimum, &
                result%m%pressure_maximum, result%m%friction, result%m%load_error, result%residual, result%algebraic(1)]
         if (self%plan%passages > 1) row = [row, real(self%smooth%cycle_passage, dp), self%smooth%layer_central]
         call self%history%append(row, status)
      end associate
   end subroutine record_cycle

   !> Record a cycle with stationary roughness. If the other surface moves, time steps follow: then no row is added to the history,
   !> and the run has not yet converged.
   subroutine record_rough_cycle(self, outcome, seconds, status)
      class(contact_run_t), intent(inout) :: self
      !> Status of the contact with all of the roughness
      integer, intent(in) :: outcome
      !> Time spent on the cycle
      real(dp), intent(in) :: seconds
      type(status_t), intent(inout) :: status

      if (self%plan%surfaces%move()) then
         if (outcome /= outcome_converged) self%outcome = outcome
         return
      end if
      self%seconds = self%seconds + seconds
      self%outcome = outcome
      if (self%plan%heat%active .and. outcome == outcome_converged) then
         call add_heat(self, self%smooth%n, .true., self%rough_heat, status)
      end if
      associate (rough => self%stationary, m => self%stationary%m)
         call self%history%append([real(dp) :: rough%total_cycles, rough%fraction, rough%mu_ratio(), m%film_central, &
                                   m%film_minimum, m%pressure_maximum, m%load_error, rough%residual], status)
      end associate
   end subroutine record_rough_cycle

   !> Record a solved time step
   subroutine record_step(self, status)
      class(contact_run_t), intent(inout) :: self
      type(status_t), intent(inout) :: status
      real(dp), allocatable :: row(:)
      real(dp) :: numbers(size(touching_names)), heat_ratio_of_step

      associate (transient => self%transient, m => self%transient%m, level => self%hierarchy%levels(self%smooth%n))
         if (self%plan%duty%active) then
            call duty_row(self, level, row)
            if (self%plan%layer > 0.0_dp) row = [row, transient%duty%layer*transient%now%layer, m%oil%enters, m%oil%leaves, &
                                                 m%oil%sides, m%oil%content, m%oil%gain, m%oil%imbalance]
         else
            row = [real(dp) :: transient%step, transient%time, m%friction/transient%friction_smooth, m%film_central, &
                   m%film_minimum, m%pressure_maximum, m%load_error, transient%cycles, transient%residual]
            if (self%plan%heat%active) then
               call step_heat(self, heat_ratio_of_step, status)
               if (status%failed()) return
               row = [row, heat_ratio_of_step]
            end if
         end if
         numbers = m%touching%numbers()
         row = [row, numbers(:known_names(self%plan%lubricant))]
         call self%history%append(row, status)
         if (self%plan%surfaces%pass_once() .and. .not. self%plan%duty%active) then
            call transient%extremes%update(level, self%p_smooth, self%h_smooth, transient%time)
         end if
         self%outcome = transient_outcome(self%plan, transient)
         if (self%plan%heat%active .and. self%outcome == outcome_converged .and. .not. self%plan%duty%active) then
            call add_heat(self, self%smooth%n, .true., self%rough_heat, status)
         end if
         call self%frames%keep(level, transient%time, transient%time_step, self%plan%frame_interval, status)
      end associate
   end subroutine record_step

   !> Start the next phase: add the stationary roughness first, then the moving one
   subroutine next_phase(self, status)
      class(contact_run_t), intent(inout) :: self
      type(status_t), intent(inout) :: status

      if (self%phase == phase_smooth) call keep_smooth(self, status)
      if (status%failed()) return
      associate (surfaces => self%plan%surfaces, n => self%smooth%n)
         if (self%phase == phase_smooth .and. .not. self%plan%duty%active .and. &
             (surfaces%all_stationary() .or. surfaces%some_stationary())) then
            call self%stationary%start(self%hierarchy%levels(n), n, self%plan%contact, surfaces, self%plan%steady_options_t, status)
            self%phase = phase_stationary
         else
            call begin_steps(self, status)
         end if
      end associate
   end subroutine next_phase

   !> Prepare the surfaces for the final grid, and keep the fields of the smooth contact for the results
   subroutine keep_smooth(self, status)
      class(contact_run_t), intent(inout) :: self
      type(status_t), intent(inout) :: status
      integer :: stat

      if (self%plan%surfaces%rough()) then
         call self%plan%update_resolved_fraction(self%grid)
         call check_resolved(self%plan%surfaces, self%grid, status)
         call self%plan%surfaces%prepare(self%grid, status)
      end if
      if (status%failed()) return
      if (allocated(self%p_smooth)) deallocate (self%p_smooth, self%h_smooth)
      allocate (self%p_smooth(self%grid%nx, self%grid%ny), self%h_smooth(self%grid%nx, self%grid%ny), stat=stat)
      if (stat /= 0) then
         call status%fail(ehl_no_memory, "no memory for the fields of the smooth contact")
         return
      end if
      associate (level => self%hierarchy%levels(self%smooth%n))
         self%p_smooth(:, :) = level%p
         self%h_smooth(:, :) = gap(level)
         self%h00_smooth = level%h00
      end associate
   end subroutine keep_smooth

   !> Whether a run from a predicted start has not reached the steps of the mean
   pure logical function is_filling(self)
      class(contact_run_t), intent(in) :: self
      is_filling = self%transient%mean%transit > 0.0_dp .and. self%transient%mean%n < self%transient%mean%filled
   end function is_filling

   !> Whether the phase of the smooth contact has ended
   pure logical function is_rough(self)
      class(contact_run_t), intent(in) :: self
      is_rough = self%phase /= phase_smooth
   end function is_rough

   !> Level of the results: the present one, or the one before it if no cycle was made on the present one
   pure integer function level(self)
      class(contact_run_t), intent(in) :: self
      level = self%smooth%n
      if (self%smooth%results(level)%cycles == 0 .and. level > 1) then
         if (self%smooth%results(level - 1)%cycles > 0) level = level - 1
      end if
   end function level

   !> Friction ratio of a converged run
   pure real(dp) function mu_ratio(self)
      class(contact_run_t), intent(in) :: self
      if (self%phase == phase_stationary) then
         mu_ratio = self%stationary%mu_ratio()
      else
         mu_ratio = self%transient%mean%mean(0.0_dp)
      end if
   end function mu_ratio

   !> Write the state into a folder. Before the first time step no state exists.
   subroutine save(self, folder, status)
      class(contact_run_t), intent(inout) :: self
      !> Ends with '/'
      character(len=*), intent(in) :: folder
      type(status_t), intent(inout) :: status

      if (self%phase /= phase_steps .or. self%transient%step == 0) return
      call self%checkpoint%write(folder//self%state_prefix, self%state_text, self%transient, self%history, self%frames, &
                                 self%seconds, self%coarser, self%fallback_reason, status)
   end subroutine save
end module ehl_contact_run

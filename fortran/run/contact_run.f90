! SPDX-License-Identifier: BSD-3-Clause
!> A planned contact from its first cycle to its end: smooth, then with the rough surface, at rest or in time steps
module ehl_contact_run
   use ehl_checkpoint, only: checkpoint_t, words_t
   use ehl_clock, only: clock_t, start_clock
   use ehl_frames, only: frames_t
   use ehl_grid, only: grid_t
   use ehl_heated_friction, only: heated_t
   use ehl_hierarchy, only: hierarchy_t
   use ehl_kinds, only: dp
   use ehl_outcome, only: outcome_converged, outcome_running, outcome_target_missed
   use ehl_level, only: gap
   use ehl_plan, only: plan_t
   use ehl_plan_surface, only: check_carried
   use ehl_predicted_start, only: predicted_start_t
   use ehl_stationary_roughness, only: stationary_roughness_t
   use ehl_status, only: ehl_no_memory, status_t
   use ehl_steady, only: steady_t
   use ehl_stopping_criterion, only: transient_outcome
   use ehl_table, only: table_t
   use ehl_touching, only: known_names, touching_names
   use ehl_transient, only: transient_t
   implicit none (type, external)
   private
   public :: contact_run_t
   type :: contact_run_t
      type(plan_t) :: plan
      !> Finest grid reached so far
      type(grid_t) :: grid
      type(hierarchy_t) :: hierarchy
      type(steady_t) :: steady
      type(stationary_roughness_t) :: rest
      type(transient_t) :: transient
      !> What time steps begin with where the plan says so, and why they do not
      type(predicted_start_t) :: predicted
      character(len=:), allocatable :: why_front
      !> Whether the rough surface is in: in time steps; at rest
      logical :: in_steps = .false., resting = .false.
      !> How the run stands
      integer :: outcome = outcome_running
      !> A row per cycle or time step; seconds spent on those of the rough contact
      type(table_t) :: history
      real(dp) :: seconds = 0.0_dp
      !> Pressure, film and separation of the smooth contact, kept where there is a rough one; frames of the transient run
      real(dp), allocatable :: p_smooth(:, :), h_smooth(:, :)
      real(dp) :: h00_smooth = 0.0_dp
      type(frames_t) :: frames
      !> Heat of the smooth contact, and of the rough one at the end
      type(heated_t) :: smooth_heat, rough_heat
      !> State on disk, and to go on from when the smooth contact is solved
      type(checkpoint_t) :: checkpoint
      !> Of the same run on the next coarser grid: its friction ratio and load share, if it converged, and how it ended;
      !> outcome_running: it has not; the error that ended it
      real(dp) :: coarse_ratio = 0.0_dp, coarse_load_share = 0.0_dp
      integer :: coarse_outcome = outcome_running
      character(len=:), allocatable :: coarse_message
   contains
      procedure :: begin
      procedure, private :: begin_history
      procedure :: advance
      procedure :: roughness_is_due
      procedure :: begin_rough
      procedure :: level
      procedure :: mu_ratio
      procedure :: heat_ratio
      procedure :: save
   end type contact_run_t

   ! in contact_start.f90
   interface
      !> From the contact on level n, smooth or with what is at rest, to time steps, or to the state that was kept
      module subroutine begin_steps(self, n, status)
         class(contact_run_t), intent(inout) :: self
         integer, intent(in) :: n
         type(status_t), intent(inout) :: status
      end subroutine begin_steps

      !> Where the first steps from a prediction fail: all of them again behind a front
      module subroutine begin_again(self, status)
         class(contact_run_t), intent(inout) :: self
         type(status_t), intent(inout) :: status
      end subroutine begin_again
   end interface

   ! in contact_heat.f90
   interface
      !> Friction and temperature of the present contact on a level; the temperature at every node if it is to be kept
      module subroutine add_heat(self, n, keep, found, status)
         class(contact_run_t), intent(in) :: self
         integer, intent(in) :: n
         logical, intent(in) :: keep
         type(heated_t), intent(out) :: found
         type(status_t), intent(inout) :: status
      end subroutine add_heat

      !> Friction with heat over that without it after a step; NaN where it is not computed
      module real(dp) function step_heat(self)
         class(contact_run_t), intent(in) :: self
      end function step_heat

      !> The same of the rough contact of a run that has converged, over the time of its mean; NaN where it is not known
      module real(dp) function heat_ratio(self)
         class(contact_run_t), intent(in) :: self
      end function heat_ratio
   end interface

contains

   !> Prepare the coarse grids of the plan
   subroutine begin(self, status)
      class(contact_run_t), intent(inout) :: self
      type(status_t), intent(inout) :: status

      if (status%failed()) return
      if (allocated(self%plan%why_front)) self%why_front = self%plan%why_front
      call self%hierarchy%setup(self%plan%coarsest, self%plan%levels, self%plan%lubricant, self%plan%point%speed_parameter, &
                                self%plan%contact%kernel_factor, self%plan%engine, self%plan%threads, status)
      call self%steady%start(self%plan%contact, self%plan%steady_options_t)
      call self%hierarchy%grow(self%steady%n, status)
      if (status%failed()) return
      self%grid = self%hierarchy%levels(self%steady%n)%grid
      call self%begin_history()
   end subroutine begin

   !> A history without a row
   subroutine begin_history(self)
      class(contact_run_t), intent(inout) :: self
      character(len=16), allocatable :: columns(:)

      if (self%plan%surfaces%rest()) then
         columns = [character(len=16) :: "cycle", "share", "mu_ratio", "H_c", "H_min", "P_max", "load_error", "residual"]
      else if (self%plan%surfaces%move()) then
         columns = [character(len=16) :: "step", "T", "mu_ratio", "H_c", "H_min", "P_max", "load_error", "cycles", "residual"]
         if (self%plan%heat%counts) columns = [character(len=16) :: columns, "heat_ratio"]
         if (self%plan%lubricant%boundary_film > 0.0_dp) then
            columns = [character(len=16) :: columns, touching_names(:known_names(self%plan%lubricant))]
         end if
      else
         columns = [character(len=16) :: "level", "points", "cycle", "H_c", "H_min", "P_max", "F", "load_error", "residual", &
                    "H_c_algebraic"]
      end if
      call self%history%init(columns)
   end subroutine begin_history

   !> One multigrid cycle, or one time step
   subroutine advance(self, status)
      class(contact_run_t), intent(inout) :: self
      type(status_t), intent(inout) :: status

      if (self%in_steps) then
         call advance_step(self, status)
      else if (self%resting) then
         call advance_rest(self, status)
      else
         call advance_smooth(self, status)
      end if
   end subroutine advance

   !> One cycle of the smooth contact
   subroutine advance_smooth(self, status)
      class(contact_run_t), intent(inout) :: self
      type(status_t), intent(inout) :: status
      integer :: n

      n = self%steady%n
      call self%steady%advance(self%hierarchy, status)
      if (status%failed()) return
      self%grid = self%hierarchy%levels(n)%grid
      if (.not. self%roughness_is_due()) self%outcome = self%steady%outcome
      if (self%plan%heat%counts .and. any(self%steady%outcome == [outcome_converged, outcome_target_missed])) then
         call add_heat(self, n, .not. self%plan%surfaces%rough(), self%smooth_heat, status)
      end if
      if (self%plan%surfaces%rough()) return
      associate (result => self%steady%results(n))
         call self%history%append([real(dp) :: n, self%grid%nx, result%cycles, result%m%film_central, &
                                   result%m%film_minimum, result%m%pressure_maximum, result%m%friction, &
                                   result%m%load_error, result%residual, result%algebraic(1)])
      end associate
   end subroutine advance_smooth

   !> Whether the smooth contact is solved, and the rough one is to follow
   pure logical function roughness_is_due(self)
      class(contact_run_t), intent(in) :: self
      roughness_is_due = self%plan%surfaces%rough() .and. self%steady%outcome == outcome_converged .and. &
                         .not. (self%in_steps .or. self%resting)
   end function roughness_is_due

   !> Let the roughness into the smooth contact
   subroutine begin_rough(self, status)
      class(contact_run_t), intent(inout) :: self
      type(status_t), intent(inout) :: status
      integer :: stat

      call self%plan%see_waves(self%grid)
      call check_carried(self%plan%surfaces, self%grid, status)
      call self%plan%surfaces%prepare(self%grid, status)
      if (status%failed()) return
      associate (plan => self%plan, n => self%steady%n)
         if (allocated(self%p_smooth)) deallocate (self%p_smooth, self%h_smooth)
         allocate (self%p_smooth(self%grid%nx, self%grid%ny), self%h_smooth(self%grid%nx, self%grid%ny), stat=stat)
         if (stat /= 0) then
            call status%fail(ehl_no_memory, "no memory for the fields of the smooth contact")
            return
         end if
         self%p_smooth(:, :) = self%hierarchy%levels(n)%p
         self%h_smooth(:, :) = gap(self%hierarchy%levels(n))
         self%h00_smooth = self%hierarchy%levels(n)%h00
         if (plan%surfaces%rest() .or. plan%surfaces%some_rest()) then
            call self%rest%start(self%hierarchy%levels(n), n, plan%contact, plan%surfaces, plan%steady_options_t, status)
            self%resting = .true.
         else
            call begin_steps(self, n, status)
         end if
      end associate
   end subroutine begin_rough

   !> One cycle of the contact with what is at rest; when it is solved, on to what moves
   subroutine advance_rest(self, status)
      class(contact_run_t), intent(inout) :: self
      type(status_t), intent(inout) :: status
      type(clock_t) :: clock

      clock = start_clock()
      call self%rest%advance(self%hierarchy)
      if (self%plan%surfaces%move()) then
         if (self%rest%outcome == outcome_converged) then
            call begin_steps(self, self%steady%n, status)
         else
            self%outcome = self%rest%outcome
         end if
         return
      end if
      self%seconds = self%seconds + clock%seconds()
      self%outcome = self%rest%outcome
      if (self%plan%heat%counts .and. self%outcome == outcome_converged) then
         call add_heat(self, self%steady%n, .true., self%rough_heat, status)
      end if
      associate (rest => self%rest, m => self%rest%m)
         call self%history%append([real(dp) :: rest%total_cycles, rest%share, rest%mu_ratio(), m%film_central, &
                                   m%film_minimum, m%pressure_maximum, m%load_error, rest%residual])
      end associate
   end subroutine advance_rest

   !> One time step
   subroutine advance_step(self, status)
      class(contact_run_t), intent(inout) :: self
      type(status_t), intent(inout) :: status
      type(clock_t) :: clock
      real(dp), allocatable :: row(:)
      real(dp) :: numbers(size(touching_names))

      clock = start_clock()
      associate (transient => self%transient, m => self%transient%m, level => self%hierarchy%levels(self%steady%n))
         call transient%advance(self%hierarchy, self%steady%n, self%plan%surfaces, status)
         self%seconds = self%seconds + clock%seconds()
         if (status%failed()) return
         self%outcome = transient%state
         if (transient%state /= outcome_converged) then
            if (transient%mean%transit > 0.0_dp .and. transient%mean%n < transient%mean%filled) call begin_again(self, status)
            return
         end if
         row = [real(dp) :: transient%step, transient%time, m%friction/transient%friction_smooth, m%film_central, &
                m%film_minimum, m%pressure_maximum, m%load_error, transient%cycles, transient%residual]
         if (self%plan%heat%counts) row = [row, step_heat(self)]
         if (self%plan%lubricant%boundary_film > 0.0_dp) then
            numbers = m%touching%numbers()
            row = [row, numbers(:known_names(self%plan%lubricant))]
         end if
         call self%history%append(row)
         if (self%plan%surfaces%pass_once()) call transient%extremes%see(level, self%p_smooth, self%h_smooth, transient%time)
         self%outcome = transient_outcome(self%plan, transient)
         if (self%plan%heat%counts .and. self%outcome == outcome_converged) then
            call add_heat(self, self%steady%n, .true., self%rough_heat, status)
         end if
         call self%frames%keep(level, transient%time, transient%time_step, self%plan%frame_interval, status)
      end associate
   end subroutine advance_step

   !> Level of the results: the present one, or the last one that has been worked on
   pure integer function level(self)
      class(contact_run_t), intent(in) :: self
      level = self%steady%n
      if (self%steady%results(level)%cycles == 0 .and. level > 1) then
         if (self%steady%results(level - 1)%cycles > 0) level = level - 1
      end if
   end function level

   !> Friction ratio of a run that has converged
   pure real(dp) function mu_ratio(self)
      class(contact_run_t), intent(in) :: self
      if (self%resting) then
         mu_ratio = self%rest%mu_ratio()
      else
         mu_ratio = self%transient%mean%mean(0.0_dp)
      end if
   end function mu_ratio

   !> Write the state under names that begin with a prefix. Before the first time step there is nothing that is worth it.
   subroutine save(self, prefix, text, status)
      class(contact_run_t), intent(inout) :: self
      !> Folder with its '/', and what the names begin with; the case that the state belongs to
      character(len=*), intent(in) :: prefix, text
      type(status_t), intent(inout) :: status
      type(words_t) :: words(2)

      if (.not. self%in_steps .or. self%transient%step == 0) return
      if (allocated(self%coarse_message)) words(1)%text = self%coarse_message
      if (allocated(self%why_front)) words(2)%text = self%why_front
      call self%checkpoint%write(prefix, text, self%transient, self%history, self%frames, &
                                 [self%seconds, self%coarse_ratio, real(self%coarse_outcome, dp), &
                                  self%coarse_load_share], words, status)
   end subroutine save
end module ehl_contact_run

! SPDX-License-Identifier: BSD-3-Clause
!> A planned contact from its first cycle to its end: smooth, then with the rough surface, at rest or in time steps
module ehl_contact_run
   use ehl_checkpoint, only: checkpoint_t
   use ehl_clock, only: clock_t, start_clock
   use ehl_frames, only: frames_t
   use ehl_grid, only: grid_t
   use ehl_hierarchy, only: hierarchy_t
   use ehl_kinds, only: dp
   use ehl_level_result, only: friction_error
   use ehl_outcome, only: outcome_converged, outcome_running
   use ehl_plan, only: plan_t
   use ehl_plan_surface, only: check_carried
   use ehl_predicted_start, only: predicted_start_t
   use ehl_stationary_roughness, only: stationary_roughness_t
   use ehl_status, only: ehl_bad_input, status_t
   use ehl_steady, only: steady_t
   use ehl_stopping_criterion, only: transient_outcome
   use ehl_table, only: table_t
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
      !> Pressure and film of the smooth contact, kept where there is a rough one; frames of the transient run
      real(dp), allocatable :: p_smooth(:, :), h_smooth(:, :)
      type(frames_t) :: frames
      !> State on disk, and to go on from when the smooth contact is solved
      type(checkpoint_t) :: checkpoint
      !> Of the same run on the next coarser grid: its friction ratio, if it converged, and how it ended; outcome_running: it
      !> has not
      real(dp) :: coarse_ratio = 0.0_dp
      integer :: coarse_outcome = outcome_running
   contains
      procedure :: begin
      procedure :: advance
      procedure :: roughness_is_due
      procedure :: begin_rough
      procedure :: level
      procedure :: mu_ratio
      procedure :: save
   end type contact_run_t

contains

   !> Prepare the coarse grids of the plan
   subroutine begin(self, status)
      class(contact_run_t), intent(inout) :: self
      type(status_t), intent(inout) :: status

      if (status%failed()) return
      associate (plan => self%plan)
         call self%hierarchy%setup(plan%coarsest, plan%levels, plan%lubricant, plan%point%speed_parameter, &
                                   plan%contact%kernel_factor(), plan%engine, plan%threads, status)
         call self%steady%start(plan%contact, plan%steady_options_t)
      end associate
      call self%hierarchy%grow(self%steady%n, status)
      if (status%failed()) return
      self%grid = self%hierarchy%levels(self%steady%n)%grid
      if (self%plan%surfaces%rest()) then
         call self%history%init([character(len=16) :: "cycle", "share", "mu_ratio", "H_c", "H_min", "P_max", "load_error", &
                                 "residual"])
      else if (self%plan%surfaces%move()) then
         call self%history%init([character(len=16) :: "step", "T", "mu_ratio", "H_c", "H_min", "P_max", "load_error", &
                                 "cycles", "residual"])
      else
         call self%history%init([character(len=16) :: "level", "points", "cycle", "H_c", "H_min", "P_max", "F", &
                                 "load_error", "residual", "H_c_algebraic"])
      end if
   end subroutine begin

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

      call self%plan%see_waves(self%grid)
      call check_carried(self%plan%surfaces, self%grid, status)
      call self%plan%surfaces%prepare(self%grid, status)
      if (status%failed()) return
      associate (plan => self%plan, n => self%steady%n)
         self%p_smooth = self%hierarchy%levels(n)%p
         self%h_smooth = self%hierarchy%levels(n)%h
         if (plan%surfaces%rest() .or. plan%surfaces%some_rest()) then
            call self%rest%start(self%hierarchy%levels(n), n, plan%contact, plan%surfaces, plan%steady_options_t, status)
            self%resting = .true.
         else
            call begin_steps(self, n, status)
         end if
      end associate
   end subroutine begin_rough

   !> From the contact on level n, smooth or with what is at rest, to time steps, or to the state that was kept
   subroutine begin_steps(self, n, status)
      class(contact_run_t), intent(inout) :: self
      integer, intent(in) :: n
      type(status_t), intent(inout) :: status

      associate (plan => self%plan, transient => self%transient, m => self%steady%results(n)%m)
         ! where a feature passes once, the largest pressure and the least film are asked for, not the mean friction alone
         call transient%accuracy%set(self%grid%hx, plan%accuracy, m%friction_newtonian, &
                                     merge(0.0_dp, friction_error(self%steady%results, n), plan%surfaces%pass_once()))
         call transient%policy%set(plan%step_cycle, plan%coarsening_may_change, plan%max_cycles)
         call transient%start(self%hierarchy%levels(n), plan%contact, plan%surfaces, plan%skip_start, m%friction, status)
         if (status%failed()) return
         if (plan%predicted_start) call begin_filled(self, n, status)
         if (status%failed()) return
         call self%hierarchy%prepare_steps(n, plan%scheme, transient%time_step, status)
      end associate
      if (status%failed()) return
      self%in_steps = .true.
      self%resting = .false.
      call self%frames%start()
      if (self%checkpoint%found()) call take_state(self, status)
   end subroutine begin_steps

   !> The predicted start, unless somebody has said why there is none
   subroutine begin_filled(self, n, status)
      class(contact_run_t), intent(inout) :: self
      integer, intent(in) :: n
      type(status_t), intent(inout) :: status
      logical :: done

      if (allocated(self%why_front)) return
      if (.not. allocated(self%predicted%pressure)) then
         call status%fail(ehl_bad_input, "time.start = 'prediction': this program predicts nothing"//new_line("a")// &
                          "expected: time.start = 'front', or 'pyehl run'")
         return
      end if
      call self%transient%fill(self%hierarchy%levels(n), self%plan%surfaces, self%predicted, done)
      if (.not. done) self%why_front = "the film would be negative"
      deallocate (self%predicted%pressure)
   end subroutine begin_filled

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

      clock = start_clock()
      associate (transient => self%transient, m => self%transient%m, level => self%hierarchy%levels(self%steady%n))
         call transient%advance(self%hierarchy, self%steady%n, self%plan%surfaces, status)
         self%seconds = self%seconds + clock%seconds()
         if (status%failed()) return
         self%outcome = transient%state
         if (transient%state /= outcome_converged) return
         call self%history%append([real(dp) :: transient%step, transient%time, m%friction/transient%friction_smooth, &
                                   m%film_central, m%film_minimum, m%pressure_maximum, m%load_error, transient%cycles, &
                                   transient%residual])
         if (self%plan%surfaces%pass_once()) call transient%extremes%see(level, self%p_smooth, self%h_smooth, transient%time)
         self%outcome = transient_outcome(self%plan, transient)
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

      if (.not. self%in_steps .or. self%transient%step == 0) return
      call self%checkpoint%write(prefix, text, self%transient, self%history, self%frames, &
                                 [self%seconds, self%coarse_ratio, real(self%coarse_outcome, dp)], status)
   end subroutine save

   !> The state that was kept takes the place of the start of the transient run
   subroutine take_state(self, status)
      class(contact_run_t), intent(inout) :: self
      type(status_t), intent(inout) :: status
      real(dp) :: numbers(3)
      logical :: same

      call self%checkpoint%read(self%transient, self%history, self%frames, self%grid, numbers, status)
      if (status%failed()) return
      self%seconds = numbers(1)
      self%coarse_ratio = numbers(2)
      self%coarse_outcome = nint(numbers(3))
      call self%transient%restore(self%hierarchy%levels(self%steady%n), self%plan%surfaces, same)
      if (.not. same) then
         call status%fail(ehl_bad_input, self%checkpoint%path//": error: the film of this state does not follow from "// &
                          "its pressure"//new_line("a")//"expected: the surface and the program that it was made with")
         return
      end if
      self%outcome = transient_outcome(self%plan, self%transient)
   end subroutine take_state
end module ehl_contact_run

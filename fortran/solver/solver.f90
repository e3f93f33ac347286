! SPDX-License-Identifier: BSD-3-Clause
!> A case on its way: plan, grids, march and results. Both drivers call nothing else.
module ehl_solver
   use ehl_case, only: case_t
   use ehl_case_writer, only: case_text
   use ehl_checkpoint, only: read_checkpoint, state_t, write_checkpoint
   use ehl_clock, only: clock_t, start_clock
   use ehl_frames, only: frames_t
   use ehl_grid, only: grid_t
   use ehl_harmonic, only: harmonic_t
   use ehl_hierarchy, only: hierarchy_t
   use ehl_judge, only: judge_march, most_periods
   use ehl_kinds, only: dp
   use ehl_plan, only: make_plan, plan_t
   use ehl_plan_text, only: plan_text
   use ehl_record, only: record_t
   use ehl_report, only: cycle_line, find_skips, march_line, report_march, report_scene, report_skips, report_smooth, &
                         skip_lines, skip_t
   use ehl_status, only: ehl_bad_input, status_t
   use ehl_outcome, only: outcome_converged, outcome_cycle_limit, outcome_diverged, outcome_interrupted, outcome_names, &
                          outcome_negative_film, outcome_running, outcome_target_missed
   use ehl_steady, only: steady_t
   use ehl_table, only: table_t
   use ehl_transient, only: step_tolerance, transient_t
   implicit none (type, external)
   private
   public :: solver_t

   !> What the names of the states of the coarser run begin with
   character(len=*), parameter :: coarser = "coarser-"

   type :: solver_t
      !> Finest grid reached so far
      type(grid_t) :: grid
      !> A row per cycle
      type(table_t) :: history
      type(plan_t), private :: plan
      type(hierarchy_t), private :: hierarchy
      type(steady_t), private :: steady
      type(transient_t), private :: transient
      !> Whether the march in time has begun
      logical, private :: marching = .false.
      !> How the march in time stands
      integer, private :: outcome = outcome_running
      !> Seconds spent on time steps, and on the smooth contact
      real(dp), private :: step_seconds = 0.0_dp, step_seconds_coarse = 0.0_dp, smooth_seconds = 0.0_dp
      !> Heights of a map [m] that was given and not read
      real(dp), allocatable, private :: heights(:, :)
      type(case_t), private :: input
      !> Pressure and film of the smooth contact, kept for a march
      real(dp), allocatable, private :: p_smooth(:, :), h_smooth(:, :)
      !> Frames of the march; not allocated before it
      type(frames_t) :: frames
      !> States to go on from when the smooth contact is solved: of this run, of the coarser one
      type(state_t), allocatable, private :: state, coarse_state
      !> The same run on the next coarser grid, for the grid error of the friction ratio
      type(solver_t), pointer, private :: coarse => null()
      !> Its mean friction ratio; 0: it did not converge; less: it has not been made
      real(dp), private :: coarse_mean = -1.0_dp
   contains
      final :: close_solver
      procedure :: give_surface
      procedure :: save_state
      procedure :: resume
      procedure :: given_surface
      procedure :: moves
      procedure :: steps_made
      procedure :: start
      procedure :: describe
      procedure :: advance
      procedure :: done
      procedure :: converged
      procedure :: interrupt
      procedure :: progress
      procedure :: summary
      procedure :: skipped
      procedure :: field
      procedure :: field_names
      procedure, private :: level
      procedure, private :: stand
   end type solver_t

contains

   !> Heights of a map [m], X first, in place of a file; to be called before start
   subroutine give_surface(self, heights)
      class(solver_t), intent(inout) :: self
      real(dp), intent(in) :: heights(:, :)
      self%heights = heights
   end subroutine give_surface

   !> Plan the case and prepare the coarse grids
   recursive subroutine start(self, input, status)
      class(solver_t), intent(inout) :: self
      type(case_t), intent(in) :: input
      type(status_t), intent(inout) :: status


      self%input = input
      if (.not. allocated(self%heights)) allocate (self%heights(0, 0))
      call make_plan(input, self%heights, self%plan, status)
      if (status%failed()) return
      associate (plan => self%plan)
         call self%hierarchy%setup(plan%coarsest, plan%levels, plan%lubricant, plan%point%speed_parameter, &
                                   plan%engine, plan%cycle, plan%threads, status)
         call self%steady%start(plan)
      end associate
      call self%hierarchy%grow(self%steady%n, status)
      if (status%failed()) return
      self%grid = self%hierarchy%levels(self%steady%n)%grid
      if (allocated(self%plan%surface)) then
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
      steps_made = merge(self%transient%step, 0, self%marching)
   end function steps_made

   !> Heights [m] that were given in place of a file; of size 0 when there are none
   function given_surface(self) result(heights)
      class(solver_t), intent(in) :: self
      real(dp), allocatable :: heights(:, :)
      heights = self%heights
   end function given_surface

   !> Whether the case is a march in time
   pure logical function moves(self)
      class(solver_t), intent(in) :: self
      moves = allocated(self%plan%surface)
   end function moves

   !> Write the state into a folder (its name ends in '/'). Before the first time step there is nothing
   !> that is worth it.
   subroutine save_state(self, folder, status)
      class(solver_t), intent(in) :: self
      character(len=*), intent(in) :: folder
      type(status_t), intent(inout) :: status
      character(len=:), allocatable :: text

      text = step_text(self%input)
      if (associated(self%coarse)) call save_as(self%coarse, folder//coarser, text, status)
      call save_as(self, folder, text, status)
   end subroutine save_state

   !> Write the state of one run under names that begin with a prefix
   subroutine save_as(self, prefix, text, status)
      type(solver_t), intent(in) :: self
      character(len=*), intent(in) :: prefix, text
      type(status_t), intent(inout) :: status

      if (self%steps_made() == 0) return
      call write_checkpoint(prefix, text, self%transient, self%history, self%frames, &
                            [self%step_seconds, self%coarse_mean], status)
   end subroutine save_as

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
      text = case_text(plain)
   end function step_text

   !> After start and before the first advance: go on from the newest state in a folder (its name ends in '/').
   !> The smooth contact is solved again, to the same bits, before the first time step.
   subroutine resume(self, folder, note, status)
      class(solver_t), intent(inout) :: self
      character(len=*), intent(in) :: folder
      !> What a person should know; empty when there is no state yet
      character(len=:), allocatable, intent(out) :: note
      type(status_t), intent(inout) :: status
      character(len=:), allocatable :: text

      text = step_text(self%input)
      call read_checkpoint(folder, text, self%state, note, status)
      if (status%failed() .or. allocated(self%state)) return
      call read_checkpoint(folder//coarser, text, self%coarse_state, note, status)
   end subroutine resume

   !> The state that was read takes the place of the start of the march
   subroutine take_state(self, status)
      type(solver_t), intent(inout) :: self
      type(status_t), intent(inout) :: status
      logical :: same
      integer :: k

      associate (state => self%state, march => self%transient)
         if (any(shape(state%march%mass) /= shape(march%mass))) then
            call status%fail(ehl_bad_input, state%path//": error: this state belongs to another grid")
            return
         end if
         call march%restore(state%march, self%hierarchy%levels(self%steady%n), self%plan%surface, same)
         if (.not. same) then
            call status%fail(ehl_bad_input, state%path//": error: the film of this state does not follow from its "// &
                             "pressure"//new_line("a")//"expected: the surface and the program that it was made with")
            return
         end if
         do k = 1, size(state%rows, 2)
            call self%history%append(state%rows(:, k))
         end do
         self%frames = state%frames
         self%step_seconds = state%numbers(1)
         self%coarse_mean = state%numbers(2)
      end associate
      deallocate (self%state)
      self%outcome = judge_march(self%plan, self%transient)
   end subroutine take_state

   !> The plan in a few lines, for a person
   function describe(self) result(text)
      class(solver_t), intent(in) :: self
      character(len=:), allocatable :: text
      text = plan_text(self%plan)
   end function describe

   !> One multigrid cycle of the smooth contact, then one time step
   recursive subroutine advance(self, status)
      class(solver_t), intent(inout) :: self
      type(status_t), intent(inout) :: status

      if (self%done()) return
      if (associated(self%coarse)) then
         call advance_coarse(self, status)
      else if (self%marching) then
         call advance_step(self, status)
      else
         call advance_cycle(self, status)
         if (.not. status%failed() .and. allocated(self%plan%surface) .and. &
             self%steady%outcome == outcome_converged) call begin_march(self, status)
      end if
   end subroutine advance

   !> One multigrid cycle of the smooth contact
   subroutine advance_cycle(self, status)
      type(solver_t), intent(inout) :: self
      type(status_t), intent(inout) :: status
      type(clock_t) :: clock
      integer :: n

      clock = start_clock()
      n = self%steady%n
      call self%steady%advance(self%plan, self%hierarchy, status)
      self%smooth_seconds = self%smooth_seconds + clock%seconds()
      if (status%failed()) return
      self%grid = self%hierarchy%levels(n)%grid
      if (allocated(self%plan%surface)) return
      associate (result => self%steady%results(n))
         call self%history%append([real(dp) :: n, self%grid%nx, result%cycles, result%m%film_central, &
                                   result%m%film_minimum, result%m%pressure_maximum, result%m%friction, &
                                   result%m%load_error, result%residual, result%algebraic(1)])
      end associate
   end subroutine advance_cycle

   !> The smooth contact is solved: let the roughness in
   recursive subroutine begin_march(self, status)
      type(solver_t), intent(inout) :: self
      type(status_t), intent(inout) :: status
      integer :: k, n

      n = self%steady%n
      self%p_smooth = self%hierarchy%levels(n)%p
      self%h_smooth = self%hierarchy%levels(n)%h
      if (self%plan%amplitude_over_film > 0.0_dp) then
         select type (waviness => self%plan%surface)
         type is (harmonic_t)
            waviness%amplitude = self%plan%amplitude_over_film*self%steady%results(n)%m%film_central
         end select
      end if
      self%transient%narrow = self%plan%narrow
      self%transient%max_cycles = self%plan%max_cycles
      self%transient%coarsening = self%plan%step_cycle%coarsening
      self%transient%may_change = self%plan%coarsening_may_change
      self%transient%tolerance = step_tolerance(self%grid%hx, self%plan%accuracy)
      call self%transient%start(self%hierarchy%levels(n), self%plan%surface, self%plan%skip_start, &
                                self%steady%results(n)%m%friction, status)
      if (status%failed()) return
      do k = 1, n
         call self%hierarchy%levels(k)%set_transient(self%plan%narrow, self%transient%time_step, status)
      end do
      if (status%failed()) return
      self%hierarchy%options = self%plan%step_cycle
      self%marching = .true.
      call self%frames%start(self%grid)
      if (allocated(self%state)) call take_state(self, status)
      if (status%failed()) return
      if (self%plan%coarse_run .and. self%coarse_mean < 0.0_dp) call begin_coarse(self, status)
   end subroutine begin_march

   !> Start the run on the next coarser grid, with the same roughness
   recursive subroutine begin_coarse(self, status)
      type(solver_t), intent(inout) :: self
      type(status_t), intent(inout) :: status
      type(case_t) :: input

      input = self%input
      input%output%frame_interval = 0.0_dp
      input%grid%points = (self%grid%nx + 1)/2
      input%grid%target_error = 0.0_dp
      input%time%estimate_error = .false.
      select type (waviness => self%plan%surface)
      type is (harmonic_t)
         input%surface%amplitude = waviness%amplitude
         input%surface%amplitude_given = .true.
      end select
      allocate (self%coarse)
      call self%coarse%give_surface(self%heights)
      call self%coarse%start(input, status)
      if (allocated(self%coarse_state)) call move_alloc(self%coarse_state, self%coarse%state)
   end subroutine begin_coarse

   !> One step of the coarser run; at its end its mean is kept and the run freed. A coarser run that
   !> does not converge leaves the grid error unknown.
   recursive subroutine advance_coarse(self, status)
      type(solver_t), intent(inout) :: self
      type(status_t), intent(inout) :: status

      call self%coarse%advance(status)
      if (.not. self%coarse%done()) return
      self%coarse_mean = 0.0_dp
      if (self%coarse%converged()) self%coarse_mean = self%coarse%transient%mean%mean(0.0_dp)
      self%step_seconds_coarse = self%coarse%step_seconds
      deallocate (self%coarse)
   end subroutine advance_coarse

   !> Free what a solver points to
   impure elemental subroutine close_solver(self)
      type(solver_t), intent(inout) :: self
      if (associated(self%coarse)) deallocate (self%coarse)
   end subroutine close_solver

   !> One time step
   subroutine advance_step(self, status)
      type(solver_t), intent(inout) :: self
      type(status_t), intent(inout) :: status
      type(clock_t) :: clock

      clock = start_clock()
      associate (march => self%transient, m => self%transient%m)
         call march%advance(self%hierarchy, self%steady%n, self%plan%surface, status)
         self%step_seconds = self%step_seconds + clock%seconds()
         if (status%failed()) return
         if (march%step_converged()) then
            call self%history%append([real(dp) :: march%step, march%time, m%friction/march%friction_smooth, &
                                      m%film_central, m%film_minimum, m%pressure_maximum, m%load_error, march%cycles, &
                                      march%residual])
            self%outcome = judge_march(self%plan, self%transient)
            call self%frames%keep(self%hierarchy%levels(self%steady%n), march%time, march%time_step, &
                                  self%input%output%frame_interval)
         else if (.not. m%finite) then
            self%outcome = outcome_diverged
         else if (.not. m%positive) then
            self%outcome = outcome_negative_film
         else
            self%outcome = outcome_cycle_limit
         end if
      end associate
   end subroutine advance_step

   !> How the run stands
   integer function stand(self)
      class(solver_t), intent(in) :: self
      stand = self%steady%outcome
      if (.not. allocated(self%plan%surface)) return
      if (self%marching) then
         stand = self%outcome
      else if (stand == outcome_converged) then
         stand = outcome_running
      end if
   end function stand

   !> Whether the run has ended, well or not
   logical function done(self)
      class(solver_t), intent(in) :: self
      done = self%stand() /= outcome_running
   end function done

   !> Whether the run has ended well
   logical function converged(self)
      class(solver_t), intent(in) :: self
      converged = self%stand() == outcome_converged
   end function converged

   !> End the run here
   subroutine interrupt(self)
      class(solver_t), intent(inout) :: self
      if (self%done()) return
      if (self%marching) then
         self%outcome = outcome_interrupted
      else
         self%steady%outcome = outcome_interrupted
      end if
   end subroutine interrupt

   !> One line about the state
   recursive function progress(self) result(text)
      class(solver_t), intent(in) :: self
      character(len=:), allocatable :: text

      if (associated(self%coarse)) then
         text = "for the error, on the next coarser grid: "//self%coarse%progress()
      else if (self%marching) then
         text = march_line(self%plan, self%transient, self%stand(), self%step_seconds)
      else
         text = cycle_line(self%grid, self%steady%results(self%level()), self%stand())
      end if
   end function progress

   !> Level of the results: the present one, or the last one that has been worked on
   pure integer function level(self)
      class(solver_t), intent(in) :: self
      level = self%steady%n
      if (self%steady%results(level)%cycles == 0 .and. level > 1) then
         if (self%steady%results(level - 1)%cycles > 0) level = level - 1
      end if
   end function level

   !> All results but fields, by name; dimensionless but for the SI values. Only a converged run has
   !> results: otherwise they are null, and the last iterate stands under names that begin with "last_".
   function summary(self) result(record)
      class(solver_t), intent(in) :: self
      type(record_t) :: record
      type(skip_t), allocatable :: skips(:)
      logical :: good

      call record%set("status", trim(outcome_names(self%stand())))
      call record%set("converged", self%converged())
      ! the smooth results are good as soon as the march has begun
      good = self%marching .or. self%steady%outcome == outcome_converged .or. self%steady%outcome == outcome_target_missed
      call report_scene(record, self%plan, self%grid)
      call report_smooth(record, self%plan, self%steady, self%level(), good)
      if (self%marching) call report_march(record, self%plan, self%transient, self%converged(), &
                                              self%step_seconds, self%coarse_mean)
      if (self%marching .and. self%done()) then
         call find_skips(self%plan, self%transient, self%converged(), most_periods(self%plan), self%step_seconds, &
                         self%smooth_seconds, skips)
         call report_skips(record, skips)
      end if
      call record%set("bytes", real(self%hierarchy%bytes(), dp))
   end function summary

   !> What a march that has ended did not have to do, one line each, with the seconds that saved; empty for
   !> every other run
   function skipped(self) result(text)
      class(solver_t), intent(in) :: self
      character(len=:), allocatable :: text
      type(skip_t), allocatable :: skips(:)

      text = ""
      if (.not. (self%marching .and. self%done())) return
      call find_skips(self%plan, self%transient, self%converged(), most_periods(self%plan), self%step_seconds, &
                      self%smooth_seconds, skips)
      text = skip_lines(skips)
   end function skipped

   !> Names of the fields there are: P and H; in a march also those of the smooth contact, the roughness
   !> RR and the deformed roughness A_d = H_smooth - H
   subroutine field_names(self, names)
      class(solver_t), intent(in) :: self
      character(len=8), allocatable, intent(out) :: names(:)

      if (self%marching) then
         names = [character(len=8) :: "P", "H", "P_smooth", "H_smooth", "RR", "A_d"]
      else
         names = [character(len=8) :: "P", "H"]
      end if
   end subroutine field_names

   !> A field on the whole domain, values(nx, full_ny); see field_names
   subroutine field(self, name, values, status)
      class(solver_t), intent(in) :: self
      character(len=*), intent(in) :: name
      real(dp), intent(out) :: values(:, :)
      type(status_t), intent(inout) :: status
      character(len=8), allocatable :: names(:)

      values = 0.0_dp
      call self%field_names(names)
      if (all(names /= name)) then
         call status%fail(ehl_bad_input, "field '"//name//"' is not known: 'P' or 'H' was expected, in a march "// &
                          "also 'P_smooth', 'H_smooth', 'RR' or 'A_d'")
         return
      end if
      associate (level => self%hierarchy%levels(self%level()))
         select case (name)
         case ("P")
            call level%grid%unfold(level%p, values)
         case ("H")
            call level%grid%unfold(level%h, values)
         case ("P_smooth")
            call level%grid%unfold(self%p_smooth, values)
         case ("H_smooth")
            call level%grid%unfold(self%h_smooth, values)
         case ("RR")
            call level%grid%unfold(self%transient%rr, values)
         case default
            call level%grid%unfold(self%h_smooth - level%h, values)
         end select
      end associate
   end subroutine field
end module ehl_solver

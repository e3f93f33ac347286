! SPDX-License-Identifier: BSD-3-Clause
!> How a case runs: cycles of the smooth contact, time steps, and the same on the next coarser grid
submodule (ehl_solver) ehl_solver_run
   use ehl_clock, only: clock_t, start_clock
   use ehl_level_result, only: discretisation_error, extrapolated, friction_error
   use ehl_stopping_criterion, only: transient_outcome
   use ehl_plan_surface, only: check_carried
   use ehl_outcome, only: outcome_cycle_limit, outcome_diverged, outcome_failed, outcome_negative_film
   use ehl_status, only: ehl_no_memory
   use ehl_status, only: ehl_bad_input
   use ehl_text, only: to_text
   implicit none (type, external)

   !> Relative grid error of the smooth film from which its extrapolation is good enough for an amplitude
   real(dp), parameter :: film_error = 0.02_dp

contains

   recursive module subroutine advance(self, status)
      class(solver_t), intent(inout) :: self
      type(status_t), intent(inout) :: status

      if (self%done()) return
      if (associated(self%coarse)) then
         call advance_coarse(self)
      else if (self%in_steps) then
         call advance_step(self, status)
      else if (self%resting) then
         call advance_rest(self, status)
      else
         call advance_cycle(self, status)
         if (status%failed() .or. self%steady%outcome /= outcome_converged) return
         if (self%plan%surfaces%rest() .or. self%plan%surfaces%some_rest()) then
            call begin_rest(self, status)
         else if (self%plan%surfaces%move()) then
            call keep_smooth(self, status)
            call begin_transient(self, status)
         end if
      end if
   end subroutine advance

   !> One multigrid cycle of the smooth contact
   subroutine advance_cycle(self, status)
      type(solver_t), intent(inout) :: self
      type(status_t), intent(inout) :: status
      integer :: n

      n = self%steady%n
      call self%steady%advance(self%hierarchy, status)
      if (status%failed()) return
      self%grid = self%hierarchy%levels(n)%grid
      if (self%plan%surfaces%rough()) return
      associate (result => self%steady%results(n))
         call self%history%append([real(dp) :: n, self%grid%nx, result%cycles, result%m%film_central, &
                                   result%m%film_minimum, result%m%pressure_maximum, result%m%friction, &
                                   result%m%load_error, result%residual, result%algebraic(1)])
      end associate
   end subroutine advance_cycle

   !> The smooth contact is solved, or the one with what is at rest: let the roughness in
   recursive subroutine begin_transient(self, status)
      type(solver_t), intent(inout) :: self
      type(status_t), intent(inout) :: status
      integer :: n

      if (status%failed()) return
      n = self%steady%n
      ! where a feature passes once, the largest pressure and the least film are asked for, not the mean friction alone
      call self%transient%accuracy%set(self%grid%hx, self%plan%accuracy, self%steady%results(n)%m%friction_newtonian, &
                                       merge(0.0_dp, friction_error(self%steady%results, n), self%plan%surfaces%pass_once()))
      call self%transient%policy%set(self%plan%step_cycle, self%plan%coarsening_may_change, self%plan%max_cycles)
      call self%transient%start(self%hierarchy%levels(n), self%plan%contact, self%plan%surfaces, self%plan%skip_start, &
                                self%steady%results(n)%m%friction, status)
      if (status%failed()) return
      call self%hierarchy%prepare_steps(n, self%plan%scheme, self%transient%time_step, status)
      if (status%failed()) return
      self%in_steps = .true.
      self%resting = .false.
      call self%frames%start()
      if (self%checkpoint%found()) call take_state(self, status)
      if (status%failed()) return
      if (self%plan%coarse_run .and. self%coarse_outcome == outcome_running) call begin_coarse(self)
   end subroutine begin_transient

   !> The smooth contact is solved: what a rough one needs of it
   recursive subroutine keep_smooth(self, status)
      type(solver_t), intent(inout) :: self
      type(status_t), intent(inout) :: status

      call self%plan%see_waves(self%grid)
      call check_carried(self%plan%surfaces, self%grid, status)
      call self%plan%surfaces%prepare(self%grid, status)
      associate (n => self%steady%n)
         self%p_smooth = self%hierarchy%levels(n)%p
         self%h_smooth = self%hierarchy%levels(n)%h
      end associate
      if (self%plan%surfaces%needs_film() .and. .not. status%failed()) call set_amplitude(self, status)
   end subroutine keep_smooth

   !> The amplitude that was given as a share of the film. It belongs to the case and not to the grid: a grid error of
   !> the film would be one of the roughness, and of a sign that extrapolation does not expect.
   recursive subroutine set_amplitude(self, status)
      type(solver_t), intent(inout) :: self
      type(status_t), intent(inout) :: status
      real(dp) :: film

      film = known_film(self)
      if (.not. film > 0.0_dp) film = film_by_finer_grids(self, status)
      if (status%failed()) return
      call self%plan%surfaces%take_film(film)
      ! shares of the variance of both know both amplitudes now
      call self%plan%surfaces%see(self%grid)
   end subroutine set_amplitude

   !> Extrapolated central film of the smooth contact; 0 where its grid error is too large for that
   pure real(dp) function known_film(self)
      type(solver_t), intent(in) :: self
      real(dp) :: error(2), limit(2)

      known_film = 0.0_dp
      associate (n => self%steady%n, results => self%steady%results)
         if (n == 1) return
         if (.not. results(n - 1)%solved) return
         error = discretisation_error(results, n)
         limit = extrapolated(results, n)
         if (error(1) <= film_error*limit(1)) known_film = limit(1)
      end associate
   end function known_film

   !> The same by a run of the smooth contact alone on as many nodes as that takes
   recursive real(dp) function film_by_finer_grids(self, status) result(film)
      type(solver_t), intent(in) :: self
      type(status_t), intent(inout) :: status
      type(solver_t), allocatable :: finer
      type(case_t) :: input
      integer :: k

      film = 0.0_dp
      input = self%input
      input%surface%kind = "smooth"
      input%second_surface%kind = "smooth"
      ! the film is extrapolated: it is better than the grid
      input%grid%target_error = 0.9_dp*film_error
      allocate (finer)
      call finer%start(input, status)
      do while (.not. (finer%done() .or. status%failed()))
         call finer%advance(status)
      end do
      if (status%failed()) return
      if (finer%converged()) film = known_film(finer)
      if (film > 0.0_dp) return
      k = findloc(self%plan%surfaces%of%amplitude_over_film > 0.0_dp, .true., dim=1)
      associate (member => self%plan%surfaces%of(k))
         call status%fail(ehl_bad_input, trim(member%group)//".amplitude_over_film = "//to_text(member%amplitude_over_film)// &
                          ": the film of the smooth contact is not known to "//to_text(100.0_dp*film_error)// &
                          " % on grids of up to "//to_text(input%grid%max_points)//" points"//new_line("a")// &
                          "expected: amplitude, or a larger grid.max_points")
      end associate
   end function film_by_finer_grids

   !> The smooth contact is solved: put the rough surface at rest in its place
   recursive subroutine begin_rest(self, status)
      type(solver_t), intent(inout) :: self
      type(status_t), intent(inout) :: status

      call keep_smooth(self, status)
      call self%rest%start(self%hierarchy%levels(self%steady%n), self%plan%contact, self%plan%surfaces, self%plan%max_cycles, &
                           self%plan%accuracy, status)
      self%resting = .true.
   end subroutine begin_rest

   !> One cycle of the contact with what is at rest; when it is solved, on to what moves or to the next coarser grid
   recursive subroutine advance_rest(self, status)
      type(solver_t), intent(inout) :: self
      type(status_t), intent(inout) :: status
      type(clock_t) :: clock

      clock = start_clock()
      call self%rest%advance(self%hierarchy, self%steady%n, self%plan%cycle)
      if (self%plan%surfaces%move()) then
         if (self%rest%outcome == outcome_converged) call begin_transient(self, status)
         return
      end if
      self%step_seconds = self%step_seconds + clock%seconds()
      associate (rest => self%rest, m => self%rest%m)
         call self%history%append([real(dp) :: rest%total_cycles, rest%share, m%friction/rest%friction_smooth, &
                                   m%film_central, m%film_minimum, m%pressure_maximum, m%load_error, rest%residual])
      end associate
      if (self%plan%coarse_run .and. self%rest%outcome == outcome_converged) call begin_coarse(self)
   end subroutine advance_rest

   !> One time step
   subroutine advance_step(self, status)
      type(solver_t), intent(inout) :: self
      type(status_t), intent(inout) :: status
      type(clock_t) :: clock

      clock = start_clock()
      associate (transient => self%transient, m => self%transient%m)
         call transient%advance(self%hierarchy, self%steady%n, self%plan%surfaces, status)
         self%step_seconds = self%step_seconds + clock%seconds()
         if (status%failed()) return
         if (transient%step_converged()) then
            call self%history%append([real(dp) :: transient%step, transient%time, m%friction/transient%friction_smooth, &
                                      m%film_central, m%film_minimum, m%pressure_maximum, m%load_error, transient%cycles, &
                                      transient%residual])
            if (self%plan%surfaces%pass_once()) call transient%extremes%see(self%hierarchy%levels(self%steady%n), self%p_smooth, &
                                                                       self%h_smooth, transient%time)
            self%outcome = transient_outcome(self%plan, self%transient)
            call self%frames%keep(self%hierarchy%levels(self%steady%n), transient%time, transient%time_step, &
                                  self%input%output%frame_interval, status)
         else if (.not. m%finite) then
            self%outcome = outcome_diverged
         else if (.not. m%positive) then
            self%outcome = outcome_negative_film
         else
            self%outcome = outcome_cycle_limit
         end if
      end associate
   end subroutine advance_step

   !> Start the run on the next coarser grid, with the same roughness
   recursive subroutine begin_coarse(self)
      type(solver_t), intent(inout) :: self
      type(status_t) :: status
      type(case_t) :: input
      integer :: stat

      input = self%input
      input%output%frame_interval = 0.0_dp
      input%grid%points = (self%grid%nx + 1)/2
      input%grid%target_error = 0.0_dp
      input%time%estimate_error = .false.
      allocate (self%coarse, stat=stat)
      if (stat /= 0) then
         call status%fail(ehl_no_memory, "no memory for another solver")
      else
         call self%plan%surfaces%hand_over(self%coarse%surfaces)
         call self%coarse%start(input, status)
         self%coarse%checkpoint = self%coarse_checkpoint
      end if
      if (status%failed()) call end_coarse(self, status)
   end subroutine begin_coarse

   !> One step of the coarser run. That it fails is no failure of this one.
   recursive subroutine advance_coarse(self)
      type(solver_t), intent(inout) :: self
      type(status_t) :: status

      call self%coarse%advance(status)
      if (status%failed() .or. self%coarse%done()) call end_coarse(self, status)
   end subroutine advance_coarse

   !> Keep how the coarser run ended, and its mean if it converged; without that the grid error is not known
   recursive subroutine end_coarse(self, status)
      type(solver_t), intent(inout) :: self
      type(status_t), intent(in) :: status

      self%coarse_outcome = outcome_failed
      if (status%failed()) self%coarse_message = status%message
      if (.not. associated(self%coarse)) return
      self%coarse_work = coarse_step*self%coarse%transient%step
      self%coarse_seconds = self%coarse%step_seconds
      if (.not. status%failed()) self%coarse_outcome = self%coarse%stand()
      if (self%coarse_outcome == outcome_converged) then
         if (self%coarse%resting) then
            self%coarse_mean = self%coarse%rest%mu_ratio()
         else
            self%coarse_mean = self%coarse%transient%mean%mean(0.0_dp)
         end if
      end if
      deallocate (self%coarse)
   end subroutine end_coarse
end submodule ehl_solver_run

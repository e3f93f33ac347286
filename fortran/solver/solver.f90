! SPDX-License-Identifier: BSD-3-Clause
!> A case on its way: plan, grids, march and results. Both drivers call nothing else.
module ehl_solver
   use ehl_case, only: case_t
   use ehl_clock, only: clock_t, start_clock
   use ehl_grid, only: grid_t
   use ehl_harmonic, only: harmonic_t
   use ehl_hierarchy, only: hierarchy_t
   use ehl_kinds, only: dp
   use ehl_measures, only: measures_t
   use ehl_plan, only: make_plan, plan_t, plan_text
   use ehl_record, only: record_t
   use ehl_status, only: ehl_bad_input, status_t
   use ehl_outcome
   use ehl_steady, only: steady_t
   use ehl_table, only: table_t
   use ehl_text, only: to_text
   use ehl_transient, only: step_tolerance, transient_t
   use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
   implicit none (type, external)
   private
   public :: solver_t

   !> Periods after which a mean that has not settled never will
   integer, parameter :: automatic_periods = 6

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
      !> Seconds spent on time steps
      real(dp), private :: step_seconds = 0.0_dp
      !> Heights of a map [m] that was given and not read
      real(dp), allocatable, private :: heights(:, :)
   contains
      procedure :: give_surface
      procedure :: start
      procedure :: describe
      procedure :: advance
      procedure :: done
      procedure :: converged
      procedure :: interrupt
      procedure :: progress
      procedure :: summary
      procedure :: field
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
   subroutine start(self, input, status)
      class(solver_t), intent(inout) :: self
      type(case_t), intent(in) :: input
      type(status_t), intent(inout) :: status

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

   !> The plan in a few lines, for a person
   function describe(self) result(text)
      class(solver_t), intent(in) :: self
      character(len=:), allocatable :: text
      text = plan_text(self%plan)
   end function describe

   !> One multigrid cycle of the smooth contact, then one time step
   subroutine advance(self, status)
      class(solver_t), intent(inout) :: self
      type(status_t), intent(inout) :: status

      if (self%done()) return
      if (self%marching) then
         call advance_step(self)
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
      integer :: n

      n = self%steady%n
      call self%steady%advance(self%plan, self%hierarchy, status)
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
   subroutine begin_march(self, status)
      type(solver_t), intent(inout) :: self
      type(status_t), intent(inout) :: status
      integer :: k, n

      n = self%steady%n
      if (self%plan%amplitude_over_film > 0.0_dp) then
         select type (waviness => self%plan%surface)
         type is (harmonic_t)
            waviness%amplitude = self%plan%amplitude_over_film*self%steady%results(n)%m%film_central
         end select
      end if
      self%transient%narrow = self%plan%narrow
      self%transient%max_cycles = self%plan%max_cycles
      self%transient%tolerance = step_tolerance(self%grid%hx, self%plan%accuracy)
      call self%transient%start(self%hierarchy%levels(n), self%plan%surface, self%plan%skip_start, &
                                self%steady%results(n)%m%friction, status)
      if (status%failed()) return
      do k = 1, n
         call self%hierarchy%levels(k)%set_transient(self%plan%narrow, self%transient%time_step)
      end do
      self%marching = .true.
   end subroutine begin_march

   !> One time step
   subroutine advance_step(self)
      type(solver_t), intent(inout) :: self
      type(clock_t) :: clock

      clock = start_clock()
      associate (march => self%transient, m => self%transient%m)
         call march%advance(self%hierarchy, self%steady%n, self%plan%surface)
         self%step_seconds = self%step_seconds + clock%seconds()
         if (march%step_converged()) then
            call self%history%append([real(dp) :: march%step, march%time, m%friction/march%friction_smooth, &
                                      m%film_central, m%film_minimum, m%pressure_maximum, m%load_error, march%cycles, &
                                      march%residual])
            self%outcome = judge_march(self)
         else if (.not. m%finite) then
            self%outcome = outcome_diverged
         else if (.not. m%positive) then
            self%outcome = outcome_negative_film
         else
            self%outcome = outcome_cycle_limit
         end if
      end associate
   end subroutine advance_step

   !> Whether the march has come to its end
   integer function judge_march(self) result(outcome)
      type(solver_t), intent(in) :: self
      real(dp) :: periods

      outcome = outcome_running
      associate (march => self%transient, plan => self%plan, mean => self%transient%mean)
         if (plan%steps > 0) then
            if (march%step >= plan%steps) outcome = merge(outcome_converged, outcome_unsettled, mean%has_mean())
            return
         end if
         if (.not. mean%has_change()) return
         if (mean%change() <= plan%time_tolerance*mean%mean(0.0_dp)) then
            outcome = outcome_converged
            return
         end if
         periods = (march%step - mean%filled)*march%time_step/mean%period
         if (periods >= merge(plan%max_periods, automatic_periods, plan%max_periods > 0)) outcome = outcome_unsettled
      end associate
   end function judge_march

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
   function progress(self) result(text)
      class(solver_t), intent(in) :: self
      character(len=:), allocatable :: text
      integer :: n

      n = self%level()
      if (self%marching) then
         associate (march => self%transient)
            text = "step "//to_text(march%step)//"  T "//digits(march%time, "f8.4")//"  mu_r/mu_s "// &
                   digits(march%m%friction/march%friction_smooth, "f9.5")
            if (march%mean%has_mean()) text = text//"  mean "//digits(march%mean%mean(0.0_dp), "f9.5")
            text = text//"  H_min "//digits(march%m%film_minimum, "f10.6")//"  cycles "//to_text(march%cycles)// &
                   "  residual "//digits(march%residual, "es8.1")//"  "//trim(outcome_names(self%stand()))
            if (.not. self%done()) text = text//", about "//digits(seconds_left(self), "f9.0")//" s left"
         end associate
         return
      end if
      associate (result => self%steady%results(n))
         text = to_text(self%grid%nx)//" x "//to_text(self%grid%nx)//"  cycle "//to_text(result%cycles)// &
                "  H_c "//digits(result%m%film_central, "f10.6")//"  H_min "//digits(result%m%film_minimum, "f10.6")// &
                "  residual "//digits(result%residual, "es8.1")//"  "//trim(outcome_names(self%stand()))
      end associate
   end function progress

   !> Seconds until the first time the mean can be judged, or one more eighth of a period
   pure real(dp) function seconds_left(self)
      type(solver_t), intent(in) :: self
      real(dp) :: steps

      associate (march => self%transient, mean => self%transient%mean)
         steps = max(mean%filled, 0) + 1.5_dp*mean%period/mean%time_step - march%step
         if (steps < 1.0_dp) steps = 0.125_dp*mean%period/mean%time_step
         if (self%plan%steps > 0) steps = self%plan%steps - march%step
         seconds_left = steps*self%step_seconds/max(march%step, 1)
      end associate
   end function seconds_left

   !> Level of the results: the present one, or the last one that has been worked on
   pure integer function level(self)
      class(solver_t), intent(in) :: self
      level = self%steady%n
      if (self%steady%results(level)%cycles == 0 .and. level > 1) then
         if (self%steady%results(level - 1)%cycles > 0) level = level - 1
      end if
   end function level

   !> A number in a fixed form
   function digits(x, form) result(text)
      real(dp), intent(in) :: x
      character(len=*), intent(in) :: form
      character(len=:), allocatable :: text
      character(len=32) :: buffer

      write (buffer, "("//form//")") x
      text = trim(adjustl(buffer))
   end function digits

   !> All results but fields, by name; dimensionless but for the SI values. Only a converged
   !> run has results: otherwise they are null, and the last iterate stands under names
   !> that begin with "last_".
   function summary(self) result(record)
      class(solver_t), intent(in) :: self
      type(record_t) :: record
      integer :: n

      n = self%level()
      associate (plan => self%plan, result => self%steady%results(n))
         call record%set("status", trim(outcome_names(self%stand())))
         call record%set("converged", self%converged())
         call record%set("moes_m", plan%point%moes_m)
         call record%set("moes_l", plan%point%moes_l)
         call record%set("alpha_bar", plan%point%alpha_bar)
         call record%set("speed_parameter", plan%point%speed_parameter)
         call record%set("points", self%grid%nx)
         call record%set("x_mesh", self%grid%hx)
         call record%set("y_mesh", self%grid%hy)
         call set_results(self, record, n)
         if (self%marching) call set_march(self, record)
         call record%set("cycles", result%cycles)
         call record%set("total_cycles", sum(self%steady%results%cycles))
         call record%set("residual", result%residual)
         call record%set("restarts", self%steady%restarts)
         call record%set("hertz_pressure_Pa", plan%point%hertz_pressure)
         if (plan%point%hertz_radius > 0.0_dp) then
            call record%set("hertz_radius_m", plan%point%hertz_radius)
            call record%set("film_scale_m", plan%point%film_scale)
         end if
         call record%set("half_domain", self%grid%mirror)
         call record%set("deflection", plan%engine)
         call record%set("threads", plan%threads)
         call record%set("bytes", real(self%hierarchy%bytes(), dp))
      end associate
   end function summary

   !> The results proper, with their errors
   subroutine set_results(self, record, n)
      class(solver_t), intent(in) :: self
      type(record_t), intent(inout) :: record
      integer, intent(in) :: n
      type(measures_t) :: m
      real(dp) :: error(2), limit(2), nothing
      logical :: good

      nothing = ieee_value(nothing, ieee_quiet_nan)
      ! the smooth results are good as soon as the march has begun
      good = self%marching .or. self%steady%outcome == outcome_converged .or. self%steady%outcome == outcome_target_missed
      m = self%steady%results(n)%m
      if (.not. good) then
         call record%set("last_H_c", m%film_central)
         call record%set("last_H_min", m%film_minimum)
         call record%set("last_P_max", m%pressure_maximum)
         call record%set("last_F", m%friction)
         m%film_central = nothing
         m%film_minimum = nothing
         m%pressure_maximum = nothing
         m%friction = nothing
      end if
      error = nothing
      limit = nothing
      if (good .and. n > 1) then
         if (self%steady%results(n - 1)%solved) then
            error = self%steady%discretisation_error(n) + self%steady%results(n)%algebraic
            limit = self%steady%extrapolated(n)
         end if
      end if
      call record%set("H_c", m%film_central)
      call record%set("H_min", m%film_minimum)
      call record%set("P_max", m%pressure_maximum)
      call record%set("F", m%friction)
      call record%set("H_c_extrapolated", limit(1))
      call record%set("H_c_error", error(1))
      call record%set("H_min_extrapolated", limit(2))
      call record%set("H_min_error", error(2))
      call record%set("H_c_algebraic_error", self%steady%results(n)%algebraic(1))
      call record%set("H_min_algebraic_error", self%steady%results(n)%algebraic(2))
      call record%set("load_error", m%load_error)
      if (self%plan%point%hertz_radius > 0.0_dp) then
         call record%set("h_c_m", m%film_central*self%plan%point%film_scale)
         call record%set("h_min_m", m%film_minimum*self%plan%point%film_scale)
         call record%set("p_max_Pa", m%pressure_maximum*self%plan%point%hertz_pressure)
      end if
   end subroutine set_results

   !> Results of the march in time; null unless it came to a good end
   subroutine set_march(self, record)
      class(solver_t), intent(in) :: self
      type(record_t), intent(inout) :: record
      real(dp) :: nothing, range(2)

      nothing = ieee_value(nothing, ieee_quiet_nan)
      associate (march => self%transient, mean => self%transient%mean)
         if (self%converged()) then
            range = mean%extremes()
            call record%set("mu_ratio", mean%mean(0.0_dp))
            call record%set("mu_ratio_min", range(1))
            call record%set("mu_ratio_max", range(2))
            if (mean%has_change()) nothing = mean%change()
            call record%set("mu_ratio_error", nothing)
            call record%set("amplitude_ratio", mean%amplitude_ratio())
         else
            call record%set("mu_ratio", nothing)
            call record%set("mu_ratio_min", nothing)
            call record%set("mu_ratio_max", nothing)
            call record%set("mu_ratio_error", nothing)
            call record%set("amplitude_ratio", nothing)
            if (mean%has_mean()) call record%set("last_mu_ratio_mean", mean%mean(0.0_dp))
            if (mean%n > 0) call record%set("last_mu_ratio", mean%values(mean%n))
         end if
         select type (surface => self%plan%surface)
         type is (harmonic_t)
            call record%set("amplitude", surface%amplitude)
         end select
         call record%set("scheme", trim(merge("narrow", "paper ", self%plan%narrow)))
         call record%set("T", march%time)
         call record%set("T_period", mean%period)
         call record%set("steps", march%step)
         call record%set("steps_skipped", march%skipped)
         call record%set("cycles_per_step", real(march%total_cycles, dp)/max(march%step, 1))
         call record%set("seconds_per_step", self%step_seconds/max(march%step, 1))
         call record%set("step_residual_allowed", march%tolerance)
      end associate
   end subroutine set_march

   !> Field "P" or "H" on the unfolded grid, values(nx, full_ny)
   subroutine field(self, name, values, status)
      class(solver_t), intent(in) :: self
      character(len=*), intent(in) :: name
      real(dp), intent(out) :: values(:, :)
      type(status_t), intent(inout) :: status
      integer :: j, row, shift

      values = 0.0_dp
      associate (level => self%hierarchy%levels(self%level()))
         shift = level%grid%full_ny() - level%grid%ny
         do j = 1, level%grid%full_ny()
            row = j - shift
            if (row < 1) row = 2 - row
            select case (name)
            case ("P")
               values(:, j) = level%p(:, row)
            case ("H")
               values(:, j) = level%h(:, row)
            case default
               call status%fail(ehl_bad_input, "field '"//name//"' is not known: 'P' or 'H' was expected")
               return
            end select
         end do
      end associate
   end subroutine field
end module ehl_solver

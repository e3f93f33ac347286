! SPDX-License-Identifier: BSD-3-Clause
!> A case on its way: plan, grids, march and results. Both drivers call nothing else.
module ehl_solver
   use ehl_case, only: case_t
   use ehl_grid, only: grid_t
   use ehl_hierarchy, only: hierarchy_t
   use ehl_kinds, only: dp
   use ehl_measures, only: measures_t
   use ehl_plan, only: make_plan, plan_t, plan_text
   use ehl_record, only: record_t
   use ehl_status, only: ehl_bad_input, status_t
   use ehl_steady, only: outcome_converged, outcome_interrupted, outcome_names, outcome_running, &
                         outcome_target_missed, steady_t
   use ehl_table, only: table_t
   use ehl_text, only: to_text
   use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
   implicit none (type, external)
   private
   public :: solver_t

   type :: solver_t
      !> Finest grid reached so far
      type(grid_t) :: grid
      !> A row per cycle
      type(table_t) :: history
      type(plan_t), private :: plan
      type(hierarchy_t), private :: hierarchy
      type(steady_t), private :: steady
   contains
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
   end type solver_t

contains

   !> Plan the case and prepare the coarse grids
   subroutine start(self, input, status)
      class(solver_t), intent(inout) :: self
      type(case_t), intent(in) :: input
      type(status_t), intent(inout) :: status

      call make_plan(input, self%plan, status)
      if (status%failed()) return
      associate (plan => self%plan)
         call self%hierarchy%setup(plan%coarsest, plan%levels, plan%lubricant, plan%point%speed_parameter, &
                                   plan%engine, plan%cycle, plan%threads, status)
         call self%steady%start(plan)
      end associate
      call self%hierarchy%grow(self%steady%n, status)
      if (status%failed()) return
      self%grid = self%hierarchy%levels(self%steady%n)%grid
      call self%history%init([character(len=16) :: "level", "points", "cycle", "H_c", "H_min", "P_max", "F", &
                              "load_error", "residual", "H_c_algebraic"])
   end subroutine start

   !> The plan in a few lines, for a person
   function describe(self) result(text)
      class(solver_t), intent(in) :: self
      character(len=:), allocatable :: text
      text = plan_text(self%plan)
   end function describe

   !> One multigrid cycle
   subroutine advance(self, status)
      class(solver_t), intent(inout) :: self
      type(status_t), intent(inout) :: status
      integer :: n

      if (self%done()) return
      n = self%steady%n
      call self%steady%advance(self%plan, self%hierarchy, status)
      if (status%failed()) return
      self%grid = self%hierarchy%levels(n)%grid
      associate (result => self%steady%results(n))
         call self%history%append([real(dp) :: n, self%grid%nx, result%cycles, result%m%film_central, &
                                   result%m%film_minimum, result%m%pressure_maximum, result%m%friction, &
                                   result%m%load_error, result%residual, result%algebraic(1)])
      end associate
   end subroutine advance

   !> Whether the run has ended, well or not
   logical function done(self)
      class(solver_t), intent(in) :: self
      done = self%steady%outcome /= outcome_running
   end function done

   !> Whether the run has ended well
   logical function converged(self)
      class(solver_t), intent(in) :: self
      converged = self%steady%outcome == outcome_converged
   end function converged

   !> End the run here
   subroutine interrupt(self)
      class(solver_t), intent(inout) :: self
      if (.not. self%done()) self%steady%outcome = outcome_interrupted
   end subroutine interrupt

   !> One line about the state
   function progress(self) result(text)
      class(solver_t), intent(in) :: self
      character(len=:), allocatable :: text
      integer :: n

      n = self%level()
      associate (result => self%steady%results(n))
         text = to_text(self%grid%nx)//" x "//to_text(self%grid%nx)//"  cycle "//to_text(result%cycles)// &
                "  H_c "//digits(result%m%film_central, "f10.6")//"  H_min "//digits(result%m%film_minimum, "f10.6")// &
                "  residual "//digits(result%residual, "es8.1")//"  "//trim(outcome_names(self%steady%outcome))
      end associate
   end function progress

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
         call record%set("status", trim(outcome_names(self%steady%outcome)))
         call record%set("converged", self%converged())
         call record%set("moes_m", plan%point%moes_m)
         call record%set("moes_l", plan%point%moes_l)
         call record%set("alpha_bar", plan%point%alpha_bar)
         call record%set("speed_parameter", plan%point%speed_parameter)
         call record%set("points", self%grid%nx)
         call record%set("x_mesh", self%grid%hx)
         call record%set("y_mesh", self%grid%hy)
         call set_results(self, record, n)
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
      good = self%steady%outcome == outcome_converged .or. self%steady%outcome == outcome_target_missed
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

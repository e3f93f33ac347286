! SPDX-License-Identifier: BSD-3-Clause
!> The smooth, steady solution by full multigrid
module ehl_steady
   use ehl_contact, only: contact_t
   use ehl_contact_results, only: contact_results_t, load_tolerance, measure
   use ehl_cycle, only: cycle_options_t, damped_cycle, most_damping, prolong_solution
   use ehl_far_field, only: far_field_t
   use ehl_film, only: refresh
   use ehl_hierarchy, only: hierarchy_t
   use ehl_iteration, only: iteration_t, reduction
   use ehl_kinds, only: dp
   use ehl_level_result, only: film_errors, level_result_t
   use ehl_outcome, only: outcome_converged, outcome_cycle_limit, outcome_diverged, outcome_negative_film, outcome_running, &
                          outcome_target_missed
   use ehl_level, only: level_t
   use ehl_status, only: ehl_no_memory, status_t
   use ehl_steady_options, only: end_rule_t, rule_of_circles, rule_of_others, steady_options_t
   use ehl_touching, only: mostly_touching, much_supplied
   implicit none (type, external)
   private
   public :: steady_t, largest_error, residual_tolerance

   !> Relative discretisation errors below this are not believed, as two levels may agree by chance
   real(dp), parameter :: least_error = 2.0e-5_dp
   !> Algebraic error of the load share of a boundary film, which ends a level where the films have ended moving
   real(dp), parameter :: share_tolerance = 1.0e-3_dp
   !> What the residual may leave of it, by share_left, over the algebraic error wanted: mostly less than a fifth of that is left
   !> (docs/evidence/inlet)
   real(dp), parameter :: cover = 5.0_dp
   !> Most cycles of a contact that touches, over those of others: the edge of a touching zone moves by a node in several cycles
   integer, parameter :: touching_cycles = 3
   !> Largest reduction per cycle that is believed of it: where the film is close to the boundary film the edge of a touching
   !> zone moves by a node in several cycles
   real(dp), parameter :: most_share_reduction = 0.99_dp
   !> Largest residual (rms, as far as it concerns the film; the wedge term is of order 1 in the inlet) of a converged
   !> solution
   real(dp), parameter :: residual_tolerance = 2.0e-3_dp
   !> What an error of the load changes the film, per relative error: the deflection by the Hertz pressure differs from its
   !> mean under it by 1/5 at the centre and by 3/10 at the edge [a^2/R]
   real(dp), parameter :: film_per_load = 0.3_dp
   !> Largest relative algebraic error of a result, however coarse its grid
   real(dp), parameter :: largest_error = 2.0e-3_dp
   !> Relative algebraic error wanted on the first grid, where no discretisation error is known yet; and where two finer grids
   !> follow: the first one then gives a guess, and enters no result
   real(dp), parameter :: start_tolerance = 1.0e-3_dp, guess_tolerance = 3.0e-2_dp
   !> Relative algebraic error that a light cycle can be trusted with: where less is wanted it costs a cycle
   real(dp), parameter :: light_error = 3.0e-4_dp
   !> A residual that no state on the way to a solution has, unless the one before it was nearly as large
   real(dp), parameter :: most_residual = 2.0_dp
   !> Cycles that are few: on a level that began from a coarser one, and from the Hertz pressure
   integer, parameter :: few = 2, few_from_guess = 3

   !> What is known of the cycles of a level, to take back what leaves no state of the contact
   type :: guard_t
      !> Degree of damping of the next cycle, 0: none; the degree of the last cycle that was taken back, and that which stays
      integer :: damping = 0, was_damped = 0, lasting = 0
      !> Cycles made since the degree was changed
      integer :: since = 0
      !> State before the last cycle
      real(dp), allocatable :: p_before(:, :)
      real(dp) :: h00_before = 0.0_dp
      !> Residual after the last cycle that was not taken back, and some cycles ago
      real(dp) :: residual_kept = 0.0_dp, residual_then = huge(1.0_dp)
   end type guard_t

   !> Full multigrid on its way: the state of the iteration is that of level n
   type, extends(iteration_t) :: steady_t
      class(contact_t), allocatable, private :: contact
      type(steady_options_t), private :: how
      !> What is at a flooded border
      type(far_field_t), private :: far_field
      !> How all of it stands
      integer :: outcome = outcome_running
      !> Whether level n has a first approximation, whether cycles are made with care
      logical, private :: entered = .false., careful = .false.
      !> Whether a cycle that ends in no state of the contact is taken back, and cycles that stall are accelerated
      logical, private :: guarded = .false.
      type(guard_t), private :: guard
      !> Restarts: on a finer grid after a failure on a coarse one, with care after one on the finest
      integer :: restarts = 0
      type(level_result_t), allocatable :: results(:)
      !> Changes of H_c and H_min in the last cycle, and the residual after it
      real(dp), private :: change(2) = 0.0_dp, residual_before = 0.0_dp
      !> Residual over that before the last cycle
      real(dp), private :: stall = 0.0_dp
      !> Change of the load share of a boundary film in the last cycle
      real(dp), private :: share_change = 0.0_dp
   contains
      procedure :: start
      procedure :: advance
      procedure :: may_balance
      procedure :: meets
   end type steady_t

   ! in steady_guard.f90
   interface
      !> Begin with the cycles of a level
      module subroutine begin_guard(self)
         class(steady_t), intent(inout) :: self
      end subroutine begin_guard

      !> The state before a cycle
      module subroutine keep_state(self, level, status)
         class(steady_t), intent(inout) :: self
         type(level_t), intent(in) :: level
         type(status_t), intent(inout) :: status
      end subroutine keep_state

      !> Take a cycle back that has left no state of the contact, and make smaller changes; accelerate cycles that stall
      module subroutine guard_cycle(self, hierarchy, status)
         class(steady_t), intent(inout) :: self
         type(hierarchy_t), intent(inout) :: hierarchy
         type(status_t), intent(inout) :: status
      end subroutine guard_cycle
   end interface

contains

   !> Ready for the first cycle
   subroutine start(self, contact, how)
      class(steady_t), intent(out) :: self
      class(contact_t), intent(in) :: contact
      type(steady_options_t), intent(in) :: how

      self%contact = contact
      self%how = how
      if (how%flooded) call self%far_field%setup(contact)
      self%max_cycles = how%max_cycles
      self%of_film = .true.
      self%guarded = how%guarded
      self%n = how%start
      self%results = spread(level_result_t(), 1, how%levels)
   end subroutine start

   !> One cycle of full multigrid, so that whoever calls can stop after any. All of it is
   !>
   !>    do n = start, levels
   !>       begin level n from the solution of level n - 1, the first one from the Hertz pressure
   !>       do until the algebraic error is a share of the discretisation error
   !>          cycle on level n
   !>       end do
   !>       if (the discretisation error is the one wanted) exit
   !>    end do
   !>
   !> A coarse level that runs out of cycles is a beginning for the next one still; what has no solution is fail_level's.
   subroutine advance(self, hierarchy, status)
      class(steady_t), intent(inout) :: self
      type(hierarchy_t), intent(inout) :: hierarchy
      type(status_t), intent(inout) :: status
      logical :: finest

      if (self%outcome /= outcome_running) return
      if (.not. self%entered) call enter_level(self, hierarchy, status)
      if (status%failed()) return
      if (self%how%flooded) call self%far_field%set_border(hierarchy%levels(self%n), self%contact%load)
      self%options = next_cycle(self)
      self%max_cycles = self%how%max_cycles
      if (is_end(self) .and. counts_share(self)) self%max_cycles = touching_cycles*self%max_cycles
      if (self%guarded) call keep_state(self, hierarchy%levels(self%n), status)
      call self%improve(hierarchy)
      if (self%guarded) call guard_cycle(self, hierarchy, status)
      if (status%failed()) return
      finest = self%n == self%how%levels
      associate (result => self%results(self%n))
         result%m = self%m
         result%cycles = self%cycles
         result%residual = self%residual
         if (self%state == outcome_running) return
         result%solved = self%state == outcome_converged .or. (self%state == outcome_cycle_limit .and. .not. finest)
         if (self%guarded .and. self%state == outcome_cycle_limit .and. self%residual > most_residual) result%solved = .false.
         if (.not. result%solved) then
            call fail_level(self)
         else if (self%state == outcome_converged .and. has_target(self)) then
            self%outcome = outcome_converged
         else if (finest) then
            self%outcome = merge(outcome_target_missed, outcome_converged, self%how%target_error > 0.0_dp)
         else
            self%n = self%n + 1
            self%entered = .false.
         end if
      end associate
   end subroutine advance

   !> Begin on level n: from the solution on the next coarser one, or from the Hertz pressure
   subroutine enter_level(self, hierarchy, status)
      class(steady_t), intent(inout) :: self
      type(hierarchy_t), intent(inout) :: hierarchy
      type(status_t), intent(inout) :: status
      integer :: j

      call hierarchy%grow(self%n, status)
      if (status%failed()) return
      if (self%careful) call hierarchy%forget()
      associate (level => hierarchy%levels(self%n), grid => hierarchy%levels(self%n)%grid)
         do j = 1, grid%ny
            call self%contact%gap_row(grid%columns(), grid%y(j), level%film_rhs(:, j))
         end do
         level%rhs = 0.0_dp
         level%load = self%contact%load
         if (has_coarser(self)) then
            call prolong_solution(hierarchy%levels(self%n - 1), level)
            self%m = self%results(self%n - 1)%m
         else
            do j = 1, grid%ny
               call self%contact%pressure_row(grid%columns(), grid%y(j), level%p(:, j))
            end do
            level%h00 = self%how%film_expected + self%contact%dry_separation
            call refresh(level)
            self%m = measure(level)
         end if
      end associate
      self%results(self%n)%mesh = hierarchy%levels(self%n)%grid%hx
      self%state = outcome_running
      self%cycles = 0
      self%residual = 0.0_dp
      self%entered = .true.
      call begin_guard(self)
   end subroutine enter_level

   !> Algebraic errors by the change of the films
   logical function may_balance(self, before)
      class(steady_t), intent(inout) :: self
      type(contact_results_t), intent(in) :: before
      type(end_rule_t) :: rule
      real(dp) :: change(2), q, error, fall

      may_balance = .false.
      if (self%unsound() /= outcome_running) return
      rule = merge(rule_of_circles, rule_of_others, self%how%newtonian_circle)
      change = abs(self%m%films() - before%films())
      fall = huge(fall)
      if (rule%bounded .and. self%cycles > 1) fall = self%residual/max(self%residual_before, tiny(1.0_dp))
      q = reduction(change, self%change, self%cycles, fall)
      self%results(self%n)%algebraic = change*q/(1.0_dp - q)
      self%change = change
      self%stall = self%residual/max(self%residual_before, tiny(1.0_dp))
      call judge_share(self, abs(self%m%touching%load_share - before%touching%load_share))
      self%residual_before = self%residual
      error = abs(self%m%load_error)
      if (rule%bounded .and. is_end(self)) self%results(self%n)%algebraic = self%results(self%n)%algebraic + film_per_load*error
      may_balance = is_end(self) .and. error <= rule%small_load_error .and. accurate(self)
      if (may_balance) may_balance = film_per_load*error <= rule%share_of_load*minval(wanted(self))
   end function may_balance

   !> Algebraic error of the load share by its change in a cycle, as that of the films
   pure subroutine judge_share(self, change)
      class(steady_t), intent(inout) :: self
      real(dp), intent(in) :: change
      real(dp) :: q

      q = most_share_reduction
      if (self%cycles > 1) q = max(reduction([change], [self%share_change], self%cycles), &
                                   min(most_share_reduction, change/max(self%share_change, tiny(1.0_dp))))
      self%results(self%n)%share_algebraic = change*q/(1.0_dp - q)
      self%share_change = change
   end subroutine judge_share

   !> Whether the level is solved; the load must be right where the solution may end
   pure logical function meets(self)
      class(steady_t), intent(in) :: self
      meets = accurate(self) .and. (abs(self%m%load_error) <= load_tolerance .or. .not. is_end(self))
   end function meets

   !> Whether the error of H_c is the one that was asked for
   pure logical function has_target(self)
      class(steady_t), intent(in) :: self
      real(dp) :: errors(2)

      has_target = .false.
      if (.not. (self%how%target_error > 0.0_dp .and. has_coarser(self))) return
      errors = grid_errors(self) + self%results(self%n)%algebraic
      has_target = errors(1) <= self%how%target_error*self%m%film_central .and. &
                   self%how%inlet%resolves(self%m, self%results(self%n)%mesh)
   end function has_target

   !> Discretisation errors of H_c and H_min of the present state, by the next coarser level
   pure function grid_errors(self) result(errors)
      class(steady_t), intent(in) :: self
      real(dp) :: errors(2)

      errors = film_errors(self%m, self%results(self%n - 1)%m, self%results(self%n)%mesh, self%how%inlet)
   end function grid_errors

   !> The cycle to make: on a level that began from a coarser one a light one is the second, if what it leaves is good
   !> enough; with one sweep less at first where the coarser level was solved in few cycles
   pure function next_cycle(self) result(options)
      class(steady_t), intent(in) :: self
      type(cycle_options_t) :: options
      logical :: first

      options = self%how%cycle
      if (self%careful) options = damped_cycle(options)
      if (self%guard%damping > 0) options = damped_cycle(self%how%cycle, self%guard%damping)
      if (self%careful .or. self%guard%damping > 0) return
      if (self%how%second_cycle%full .eqv. self%how%cycle%full) return
      if (.not. has_coarser(self) .or. self%cycles /= 1) return
      if (any(wanted(self) < light_error*self%m%films())) return
      options = self%how%second_cycle
      first = self%n == 2
      if (.not. first) first = .not. self%results(self%n - 2)%solved
      if (self%results(self%n - 1)%cycles <= merge(few_from_guess, few, first)) options%pre = options%pre - 1
   end function next_cycle

   !> Whether the solution may end on the present level
   pure logical function is_end(self)
      class(steady_t), intent(in) :: self
      is_end = self%n == self%how%levels .or. self%how%target_error > 0.0_dp
   end function is_end

   !> Whether the algebraic errors are what the grid deserves, and on a level where the solution may end the residual, too
   pure logical function accurate(self)
      class(steady_t), intent(in) :: self
      accurate = all(self%results(self%n)%algebraic <= wanted(self)) .and. &
                 (self%residual <= residual_tolerance .or. .not. is_end(self)) .and. &
                 (share_is_known(self) .or. .not. counts_share(self))
   end function accurate

   !> Whether the load share is as accurate as the level deserves; what only the residual leaves open, and all cycles have not
   !> made small, is in the error that is stated
   pure logical function share_is_known(self)
      class(steady_t), intent(in) :: self
      real(dp) :: left

      left = 0.0_dp
      if (is_end(self) .and. self%cycles < self%max_cycles) left = self%how%inlet%share_left(self%m, self%residual)/cover
      share_is_known = max(left, self%results(self%n)%share_algebraic) <= share_wanted(self)
   end function share_is_known

   !> Whether the load share of a boundary film is a result, and the contact with it well posed
   pure logical function counts_share(self)
      class(steady_t), intent(in) :: self
      counts_share = rests_on_layer(self) .or. (self%how%inlet%film > 0.0_dp .and. self%m%touching%load_share > 0.0_dp .and. &
                                                self%m%touching%supply <= much_supplied)
   end function counts_share

   !> Algebraic error of that share which the present level deserves
   pure real(dp) function share_wanted(self)
      class(steady_t), intent(in) :: self
      share_wanted = max(share_tolerance, self%how%accuracy*self%how%inlet%share_error(self%m, self%results(self%n)%mesh))
   end function share_wanted

   !> Whether a boundary film carries most of the load; where it would have to give much contact is not well posed
   pure logical function rests_on_layer(self)
      class(steady_t), intent(in) :: self
      rests_on_layer = self%m%touching%load_share > mostly_touching .and. self%m%touching%supply <= much_supplied
   end function rests_on_layer

   !> Algebraic errors of H_c and H_min that the present level deserves
   pure function wanted(self)
      class(steady_t), intent(in) :: self
      real(dp) :: wanted(2), values(2), least

      least = merge(start_tolerance, least_error, rests_on_layer(self))
      values = self%m%films()
      if (has_coarser(self)) then
         wanted = self%how%accuracy*max(grid_errors(self), least*values)
      else
         wanted = start_tolerance*values
         if (self%n == self%how%levels) wanted = self%how%accuracy*wanted
         if (self%n < self%how%levels - 1 .and. .not. is_end(self)) wanted = guess_tolerance*values
      end if
      if (is_end(self)) wanted = min(wanted, largest_error*values)
   end function wanted

   !> Failure on a level: begin anew on the next finer one, where the discrete problem is better posed; on the finest one
   !> once from the first level on with care
   subroutine fail_level(self)
      class(steady_t), intent(inout) :: self
      logical :: finest, just_guarded

      finest = self%n == self%how%levels
      just_guarded = .false.
      if (finest .and. (self%careful .or. .not. self%how%may_restart)) then
         if (self%guarded) then
            self%outcome = self%state
            return
         end if
         self%guarded = .true.
         just_guarded = .true.
         self%careful = .false.
      end if
      self%results%solved = .false.
      self%restarts = self%restarts + 1
      self%entered = .false.
      self%careful = self%careful .or. (finest .and. .not. just_guarded)
      self%n = merge(self%how%start, self%n + 1, finest)
   end subroutine fail_level

   !> Whether the level begins from a coarser one
   pure logical function has_coarser(self)
      class(steady_t), intent(in) :: self
      has_coarser = .false.
      if (self%n > 1) has_coarser = self%results(self%n - 1)%solved
   end function has_coarser
end module ehl_steady

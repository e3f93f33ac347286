! SPDX-License-Identifier: BSD-3-Clause
!> The smooth, steady solution by full multigrid (nested iteration), one cycle at a time
module ehl_steady
   use ehl_contact, only: contact_t
   use ehl_cycle, only: careful_cycle, cycle_options_t
   use ehl_far_field, only: far_field_t
   use ehl_film, only: balance_load, film_residual, update_residual
   use ehl_first_approximation, only: begin_level
   use ehl_hierarchy, only: hierarchy_t
   use ehl_kinds, only: dp
   use ehl_contact_results, only: load_tolerance, measure, contact_results_t
   use ehl_level_result, only: discretisation_error, level_result_t
   use ehl_outcome, only: outcome_converged, outcome_cycle_limit, outcome_diverged, outcome_negative_film, &
                          outcome_running, outcome_target_missed
   use ehl_status, only: status_t
   implicit none (type, external)
   private
   public :: steady_t, largest_error, least_reduction, residual_tolerance

   !> The error after a cycle is at most q/(1 - q) of the last change, q being the reduction per
   !> cycle; no better reduction than this is believed
   real(dp), parameter :: least_reduction = 0.3_dp
   !> Relative discretisation errors below this are not believed, as two levels may agree by chance
   real(dp), parameter :: least_error = 2.0e-5_dp
   !> Largest residual (rms, as far as it concerns the film; the wedge term is of order 1 in the inlet) of a converged
   !> solution
   real(dp), parameter :: residual_tolerance = 2.0e-3_dp
   !> Relative errors of the force balance that may be taken away by scaling the pressure
   real(dp), parameter :: small_load_error = 3.0e-6_dp
   !> What that changes the film, per relative error: the deflection by the Hertz pressure differs from its mean under it by
   !> 1/5 at the centre and by 3/10 at the edge [a^2/R]. Share of the algebraic error wanted that it may take
   real(dp), parameter :: film_per_load = 0.3_dp, share_of_load = 0.1_dp
   !> Largest relative algebraic error of a result, however coarse its grid
   real(dp), parameter :: largest_error = 2.0e-3_dp
   !> Relative algebraic error wanted on the first grid, where no discretisation error is known yet
   real(dp), parameter :: start_tolerance = 1.0e-3_dp
   !> The same where two finer grids follow: the first one then gives a guess, and enters no result
   real(dp), parameter :: guess_tolerance = 3.0e-2_dp
   !> Relative algebraic error that a light cycle can be trusted with: where less is wanted (1025 x 1025 nodes at low M, 2049 x
   !> 2049) it costs a cycle in place of saving half of one
   real(dp), parameter :: light_error = 3.0e-4_dp
   !> Cycles that are few: on a level that began from a coarser one, and from the Hertz pressure
   integer, parameter :: few = 2, few_from_guess = 3

   !> State of the nested iteration
   type :: steady_t
      private
      class(contact_t), allocatable :: contact
      !> The first on a level and all but the second; the second one on a level that began from a coarser one
      type(cycle_options_t) :: cycle, second_cycle
      !> Levels; central film expected [a^2/R]; algebraic error as a share of the discretisation error; relative
      !> error of H_c at which to stop, 0: on the finest grid; most cycles on a level
      integer :: levels = 0, max_cycles = 0
      !> Whether the border has the pressure of a flooded contact, and which that is
      logical :: flooded = .false.
      type(far_field_t) :: far_field
      !> Whether what fails on the finest level may begin again with care
      logical :: may_restart = .false.
      real(dp) :: film_expected = 0.0_dp, accuracy = 0.0_dp, target_error = 0.0_dp
      !> Level to begin on, present level
      integer :: first = 0
      integer, public :: n = 0
      logical :: entered = .false., careful = .false.
      integer, public :: outcome = outcome_running
      !> Restarts: on a finer grid after a failure on a coarse one, with care after one on the finest
      integer, public :: restarts = 0
      type(level_result_t), allocatable, public :: results(:)
      !> Changes of H_c and H_min in the last cycle
      real(dp) :: change(2) = 0.0_dp
   contains
      procedure :: start
      procedure :: advance
      procedure, private :: enter_level
      procedure, private :: decide
      procedure, private :: next_cycle
      procedure, private :: is_end
      procedure, private :: accurate
      procedure, private :: may_scale
      procedure, private :: wanted
      procedure, private :: fail_level
   end type steady_t

contains

   !> Ready for the first cycle
   subroutine start(self, contact, film_expected, first, levels, cycle, second_cycle, accuracy, target_error, max_cycles, &
                    flooded, may_restart)
      class(steady_t), intent(inout) :: self
      class(contact_t), intent(in) :: contact
      !> Central film of the first guess [a^2/R]
      real(dp), intent(in) :: film_expected
      !> Level to begin on; levels in all
      integer, intent(in) :: first, levels
      !> The second one on a level that began from a coarser one
      type(cycle_options_t), intent(in) :: cycle, second_cycle
      !> Algebraic error as a share of the discretisation error; relative error of H_c at which to stop, 0: on the
      !> finest grid
      real(dp), intent(in) :: accuracy, target_error
      !> Most cycles on a level
      integer, intent(in) :: max_cycles
      !> Whether the border has the pressure of a flooded contact, else 0; whether what fails on the finest level may begin
      !> again with care
      logical, intent(in) :: flooded, may_restart

      self%contact = contact
      self%film_expected = film_expected
      self%levels = levels
      self%cycle = cycle
      self%second_cycle = second_cycle
      self%accuracy = accuracy
      self%target_error = target_error
      self%max_cycles = max_cycles
      self%flooded = flooded
      if (flooded) call self%far_field%setup(contact)
      self%may_restart = may_restart
      self%first = first
      self%n = first
      self%entered = .false.
      self%careful = .false.
      self%outcome = outcome_running
      self%restarts = 0
      self%results = spread(level_result_t(), 1, levels)
   end subroutine start

   !> One cycle on the present level, the step to the next level when this one is done
   subroutine advance(self, hierarchy, status)
      class(steady_t), intent(inout) :: self
      type(hierarchy_t), intent(inout) :: hierarchy
      type(status_t), intent(inout) :: status
      type(contact_results_t) :: before
      real(dp) :: change(2), q, residual

      if (self%outcome /= outcome_running) return
      if (.not. self%entered) call self%enter_level(hierarchy, status)
      if (status%failed()) return
      associate (result => self%results(self%n), level => hierarchy%levels(self%n))
         before = result%m
         if (self%flooded) call self%far_field%set_border(level, self%contact%load())
         call hierarchy%cycle(self%n, self%next_cycle(), residual)
         result%cycles = result%cycles + 1
         result%m = measure(level)
         if (.not. result%m%finite .or. .not. result%m%positive) then
            call self%fail_level(merge(outcome_negative_film, outcome_diverged, result%m%finite))
            return
         end if
         change = abs(result%m%films() - before%films())
         if (result%cycles == 1) then
            ! part of this change is discretisation error, so that its size says little of the next
            q = least_reduction
         else
            q = max(least_reduction, min(maxval(change/max(self%change, tiny(1.0_dp))), 0.95_dp))
         end if
         result%algebraic = change*q/(1.0_dp - q)
         self%change = change
         result%residual = film_residual(level)
         if (self%may_scale()) then
            call balance_load(level, result%m%load_error)
            call update_residual(level, residual)
            result%residual = film_residual(level)
            result%m = measure(level)
         end if
      end associate
      call self%decide()
   end subroutine advance

   !> Begin on the present level
   subroutine enter_level(self, hierarchy, status)
      class(steady_t), intent(inout) :: self
      type(hierarchy_t), intent(inout) :: hierarchy
      type(status_t), intent(inout) :: status

      call hierarchy%grow(self%n, status)
      if (status%failed()) return
      if (self%careful) call hierarchy%forget()
      call begin_level(hierarchy%levels, self%n, self%contact, self%film_expected, has_coarser(self))
      if (has_coarser(self)) then
         self%results(self%n)%m = self%results(self%n - 1)%m
      else
         self%results(self%n)%m = measure(hierarchy%levels(self%n))
      end if
      self%results(self%n)%cycles = 0
      self%entered = .true.
   end subroutine enter_level

   !> Whether the level is solved, and what to do then
   subroutine decide(self)
      class(steady_t), intent(inout) :: self
      real(dp) :: values(2)
      logical :: met

      associate (result => self%results(self%n), finest => self%n == self%levels)
         met = self%accurate()
         if (self%is_end()) met = met .and. abs(result%m%load_error) <= load_tolerance
         if (.not. met .and. result%cycles < self%max_cycles) return
         result%solved = .true.
         if (met .and. self%target_error > 0.0_dp .and. has_coarser(self)) then
            values = discretisation_error(self%results, self%n) + result%algebraic
            if (values(1) <= self%target_error*result%m%film_central) then
               self%outcome = outcome_converged
               return
            end if
         end if
         if (finest) then
            if (.not. met) call self%fail_level(outcome_cycle_limit)
            if (met) self%outcome = merge(outcome_target_missed, outcome_converged, self%target_error > 0.0_dp)
         else
            self%n = self%n + 1
            self%entered = .false.
         end if
      end associate
   end subroutine decide

   !> The cycle to make: on a level that began from a coarser one a light one is the second, if what it leaves is good
   !> enough; with one sweep less at first where the coarser level was solved in few cycles
   pure function next_cycle(self) result(options)
      class(steady_t), intent(in) :: self
      type(cycle_options_t) :: options
      logical :: first

      options = self%cycle
      if (self%careful) options = careful_cycle(options)
      if (self%careful .or. self%second_cycle%full .eqv. self%cycle%full) return
      associate (result => self%results(self%n))
         if (.not. has_coarser(self) .or. result%cycles /= 1) return
         if (any(self%wanted() < light_error*result%m%films())) return
      end associate
      options = self%second_cycle
      first = self%n == 2
      if (.not. first) first = .not. self%results(self%n - 2)%solved
      if (self%results(self%n - 1)%cycles <= merge(few_from_guess, few, first)) options%pre = options%pre - 1
   end function next_cycle

   !> Whether the solution may end on the present level
   pure logical function is_end(self)
      class(steady_t), intent(in) :: self
      is_end = self%n == self%levels .or. self%target_error > 0.0_dp
   end function is_end

   !> Whether the algebraic errors are what the grid deserves, and on a level where the solution may end the residual, too
   pure logical function accurate(self)
      class(steady_t), intent(in) :: self
      associate (result => self%results(self%n))
         accurate = all(result%algebraic <= self%wanted())
         if (self%is_end()) accurate = accurate .and. result%residual <= residual_tolerance
      end associate
   end function accurate

   !> Whether the load alone is not yet right, and so little wrong that scaling the pressure costs no accuracy of the film
   pure logical function may_scale(self)
      class(steady_t), intent(in) :: self
      real(dp) :: error

      error = abs(self%results(self%n)%m%load_error)
      may_scale = self%is_end() .and. error > load_tolerance .and. error <= small_load_error .and. self%accurate()
      if (may_scale) may_scale = film_per_load*error <= share_of_load*minval(self%wanted())
   end function may_scale

   !> Algebraic errors of H_c and H_min that the present level deserves
   pure function wanted(self)
      class(steady_t), intent(in) :: self
      real(dp) :: wanted(2)

      associate (values => self%results(self%n)%m%films())
         if (has_coarser(self)) then
            wanted = self%accuracy*max(discretisation_error(self%results, self%n), least_error*values)
         else
            wanted = start_tolerance*values
            if (self%n == self%levels) wanted = self%accuracy*wanted
            if (self%n < self%levels - 1 .and. .not. self%is_end()) wanted = guess_tolerance*values
         end if
         if (self%is_end()) wanted = min(wanted, largest_error*values)
      end associate
   end function wanted

   !> Failure on a level: begin anew on the next finer one, where the discrete problem is better posed; on the finest one
   !> once from the first level on with care, unless the film is negative: then there is hardly a solution
   subroutine fail_level(self, outcome)
      class(steady_t), intent(inout) :: self
      integer, intent(in) :: outcome
      logical :: finest

      finest = self%n == self%levels
      if (finest .and. (self%careful .or. .not. self%may_restart .or. outcome == outcome_negative_film)) then
         self%outcome = outcome
         return
      end if
      self%results%solved = .false.
      self%restarts = self%restarts + 1
      self%entered = .false.
      self%careful = self%careful .or. finest
      self%n = merge(self%first, self%n + 1, finest)
   end subroutine fail_level

   !> Whether the level begins from a coarser one
   pure logical function has_coarser(self)
      class(steady_t), intent(in) :: self
      has_coarser = .false.
      if (self%n > 1) has_coarser = self%results(self%n - 1)%solved
   end function has_coarser
end module ehl_steady

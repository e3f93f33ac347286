! SPDX-License-Identifier: BSD-3-Clause
!> Parts of a transient run: a step that fails, one that restarts, sweeps, and memory
module test_transient
   use check, only: is_close, is_equal, is_true
   use ehl_case, only: case_t
   use ehl_read_case, only: read_case
   use ehl_contact_run, only: contact_run_t
   use ehl_flow, only: dir_x
   use ehl_fmg, only: full_multigrid
   use ehl_kinds, only: dp
   use ehl_moving_surfaces, only: moving_surfaces_t
   use ehl_observer, only: observer_t, single_step_t
   use ehl_outcome, only: outcome_running
   use ehl_plan, only: make_plan
   use ehl_relaxation, only: usual_log_change, relax
   use ehl_reynolds, only: refresh, update_residual
   use ehl_status, only: status_t
   use ehl_transient, only: solve_transient
   implicit none (type, external)
   private
   public :: run_transient

   character(len=*), parameter :: heavy = "&contact moes_m = 500, moes_l = 10 / &grid points = 65 / "// &
                                  "&surface kind = 'harmonic', amplitude = 0.015, wavelength = 1, "// &
                                  "x_start = -1 / &solver coarsening = 'classical' /"
   character(len=*), parameter :: thin = "&contact moes_m = 100, moes_l = 2 / &grid points = 129 / "// &
                                  "&surface kind = 'harmonic', amplitude = 0.02, wavelength = 1, "// &
                                  "x_start = -1 / &solver coarsening = 'classical' /"

contains

   subroutine run_transient()
      call failed_step_leaves_the_last_state()
      call step_restarts()
      call sweeps_alone_do_not_diverge()
      call changes_are_limited()
      call mean_of_changes_is_complete()
      call transfers_when_needed()
   end subroutine run_transient

   !> A step that exceeds its number of cycles restores the fields of the last good one, from which more cycles lead to the
   !> same result, to the bit, as without the failure
   subroutine failed_step_leaves_the_last_state()
      type(contact_run_t) :: run
      type(status_t) :: status
      real(dp), dimension(65, 33) :: p, h, p_next
      real(dp) :: h00, allowed
      integer :: n, k

      call begin(heavy, run, n, status)
      do k = 1, 3
         call step(run, status)
         call is_true(run%outcome == outcome_running, "a step converges")
      end do
      associate (level => run%hierarchy%levels(n))
         p = level%p
         h = level%h
         h00 = level%h00
         allowed = run%transient%accuracy%strict
         run%transient%policy%max_cycles = 1
         run%transient%accuracy%strict = 1.0e-3_dp*allowed
         call step(run, status)
         call is_true(run%outcome /= outcome_running, "one cycle is too few")
         call is_equal(run%transient%step, 3, "the failed step does not count")
         call is_close(maxval(abs(level%p - p)), 0.0_dp, 0.0_dp, "pressure of the last good step")
         call is_close(maxval(abs(level%h - h)), 0.0_dp, 0.0_dp, "film of the last good step")
         call is_close(level%h00, h00, 0.0_dp, "H00 of the last good step")
         run%outcome = outcome_running
         run%transient%policy%max_cycles = run%plan%max_cycles
         run%transient%accuracy%strict = allowed
         call step(run, status)
         call is_true(run%outcome == outcome_running .and. run%transient%step == 4, "more cycles are enough")
         p_next = level%p
      end associate

      call begin(heavy, run, n, status)
      do k = 1, 4
         call step(run, status)
      end do
      call is_close(maxval(abs(run%hierarchy%levels(n)%p - p_next)), 0.0_dp, 0.0_dp, "the failed step changes nothing")
      call is_true(.not. status%failed(), "transient run")
   end subroutine failed_step_leaves_the_last_state

   !> A bad prediction is rejected: the step restarts from the last state and has the same result
   subroutine step_restarts()
      type(contact_run_t) :: run
      type(status_t) :: status
      real(dp) :: p(65, 33)
      integer :: n, k, j, cycles

      call begin(heavy, run, n, status)
      run%transient%accuracy%strict = 0.003_dp*run%transient%accuracy%strict
      run%transient%accuracy%allowed = 0.0_dp
      do k = 1, 4
         call step(run, status)
      end do
      p = run%hierarchy%levels(n)%p
      cycles = run%transient%cycles

      call begin(heavy, run, n, status)
      run%transient%accuracy%strict = 0.003_dp*run%transient%accuracy%strict
      run%transient%accuracy%allowed = 0.0_dp
      do k = 1, 3
         call step(run, status)
      end do
      ! only the predictor uses the pressure of three steps ago: peaks and valleys side by side
      do j = 1, 33
         run%transient%p_before(:, j, 3) = run%transient%p_before(:, j, 3)*[(merge(3.5_dp, 1.0_dp, mod(k, 2) == 0), k=1, 65)]
      end do
      call step(run, status)
      call is_true(run%outcome == outcome_running .and. run%transient%step == 4, "a wrong prediction is corrected")
      call is_true(run%transient%cycles > cycles, "after more cycles")
      call is_close(maxval(abs(run%hierarchy%levels(n)%p - p)), 0.0_dp, 2.0e-5_dp, "to the same pressure")
      call is_true(.not. status%failed(), "transient run")
   end subroutine step_restarts

   !> Sweeps of a time step do not amplify errors, even without coarse grids: here the conductance in all of
   !> the contact is of the order of the squeeze term in the line systems
   subroutine sweeps_alone_do_not_diverge()
      type(contact_run_t) :: run
      type(status_t) :: status
      real(dp) :: first, last
      integer :: n, k

      call begin(thin, run, n, status)
      call step(run, status)
      associate (level => run%hierarchy%levels(n), space => run%hierarchy%workspaces(n))
         level%p = level%p*(1.0_dp + 1.0e-3_dp*level%p)
         call refresh(level)
         call update_residual(level, first)
         do k = 1, 15
            call relax(level, space, usual_log_change, 1.0_dp)
            call refresh(level)
         end do
         call update_residual(level, last)
         call is_true(last < first, "the residual falls by sweeps alone")
      end associate
      call is_true(.not. status%failed(), "transient run")
   end subroutine sweeps_alone_do_not_diverge

   !> In a sweep of a time step a node changes its conductance by at most a factor of e^3, however wrong the pressure is; checked
   !> at nodes that neither dipoles nor the filter of smooth changes affects
   subroutine changes_are_limited()
      type(contact_run_t) :: run
      type(status_t) :: status
      real(dp), dimension(65, 33) :: p, gain
      real(dp) :: change, largest
      integer :: n, i, j

      call begin(heavy, run, n, status)
      call step(run, status)
      associate (level => run%hierarchy%levels(n), space => run%hierarchy%workspaces(n))
         level%p = 0.5_dp*level%p
         call refresh(level)
         p = level%p
         gain = level%flow%dlneps_dp(:, :, dir_x)
         call relax(level, space, usual_log_change, 1.0_dp)
         largest = 0.0_dp
         do j = 2, level%grid%ny - 1
            do i = 2, level%grid%nx - 1
               if (max(space%dipole(i, j), space%dipole(i - 1, j), space%dipole(i + 1, j), space%dipole(i, j - 1), &
                       space%dipole(i, j + 1), space%smoothing_weight(i, j)) > 0.0_dp) cycle
               change = abs(gain(i, j)*(level%p(i, j) - p(i, j)))
               largest = max(largest, change)
            end do
         end do
      end associate
      call is_true(largest > 2.0_dp, "the linear system requires a large change")
      call is_true(largest < 3.0_dp*(1.0_dp + 1.0e-12_dp), "the limit of changes holds")
      call is_true(.not. status%failed(), "transient run")
   end subroutine changes_are_limited

   !> The mean along X of the raw changes is the same whether it is computed everywhere or only
   !> where it is not zero
   subroutine mean_of_changes_is_complete()
      type(contact_run_t) :: run
      type(status_t) :: status
      real(dp), parameter :: weights(-4:4) = [1.0_dp, 8.0_dp, 28.0_dp, 56.0_dp, 70.0_dp, 56.0_dp, 28.0_dp, 8.0_dp, &
                                              1.0_dp]/256.0_dp
      real(dp) :: difference, largest
      integer :: n, i, j

      call begin(heavy, run, n, status)
      call step(run, status)
      associate (level => run%hierarchy%levels(n), space => run%hierarchy%workspaces(n))
         call relax(level, space, usual_log_change, 1.0_dp)
         difference = 0.0_dp
         largest = 0.0_dp
         do j = 1, level%grid%ny - 1
            do i = 5, level%grid%nx - 4
               difference = max(difference, abs(sum(weights*space%raw_change(i - 4:i + 4, j)) - space%mean_change(i, j)))
               largest = max(largest, abs(space%mean_change(i, j)))
            end do
         end do
      end associate
      call is_true(largest > 0.0_dp, "a smooth change is removed")
      call is_close(difference, 0.0_dp, 1.0e-12_dp*largest, "mean along X")
      call is_true(.not. status%failed(), "transient run")
   end subroutine mean_of_changes_is_complete

   !> Operator-dependent transfers need no memory before they are used
   subroutine transfers_when_needed()
      type(contact_run_t) :: run
      type(status_t) :: status
      integer :: n

      call begin(heavy, run, n, status)
      call step(run, status)
      call is_true(all(run%hierarchy%coarsenings%transfer%nx == 0), "no transfers for classical coarsening")
      associate (before => run%hierarchy%bytes())
         call run%hierarchy%prepare_coarsening(status)
         call is_true(all(run%hierarchy%coarsenings(2:n)%transfer%nx > 0), "transfers for Alcouffe coarsening")
         call is_true(run%hierarchy%bytes() > before, "transfers take memory")
      end associate
      call is_true(.not. status%failed(), "transfers")
   end subroutine transfers_when_needed

   !> One time step
   subroutine step(run, status)
      type(contact_run_t), intent(inout) :: run
      type(status_t), intent(inout) :: status
      type(single_step_t) :: observer
      logical :: leave

      call solve_transient(run, observer, leave, status)
   end subroutine step

   !> Solve the smooth contact of a case and start the transient run
   subroutine begin(text, run, n, status)
      character(len=*), intent(in) :: text
      type(contact_run_t), intent(out) :: run
      !> Finest level
      integer, intent(out) :: n
      type(status_t), intent(inout) :: status
      type(case_t), target :: input
      type(moving_surfaces_t) :: no_surfaces
      type(observer_t) :: unobserved
      logical :: leave

      call read_case(text, "test", "", input, status)
      call make_plan(input, no_surfaces, run%plan, status)
      call run%begin(status)
      call full_multigrid(run, unobserved, leave, status)
      call is_true(run%smooth%solved, "the smooth contact converges")
      call run%next_phase(status)
      n = run%smooth%n
   end subroutine begin
end module test_transient

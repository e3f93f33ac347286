! SPDX-License-Identifier: BSD-3-Clause
!> Start of the time steps: from the steady contact, or from a prediction of the contact filled with roughness
submodule (ehl_transient_state) ehl_transient_start
   use ehl_level, only: cavitate
   use ehl_oil_flow, only: content_row
   use ehl_predicted_start, only: first_mean, start_lag, transit
   use ehl_reynolds, only: balance_load
   use ehl_status, only: ehl_no_memory
   use ehl_wedge, only: old_times
   implicit none (type, external)

contains

   module procedure start
      integer :: k, stat

      if (status%failed()) return
      self%contact = contact
      self%n = n
      self%step = 0
      self%total_cycles = 0
      self%time_step = level%grid%hx
      self%skipped = 0
      if (skip .and. .not. duty%active) self%skipped = int(surfaces%begin()/self%time_step)
      self%time = self%skipped*self%time_step
      self%duty = duty
      self%duty_steps = duty_steps_t()
      self%settled = .not. level%supply%active
      self%settling = .false.
      if (duty%active) then
         self%time = duty%begin()
         self%now = duty%at(self%time)
         self%inverse_speed = level%flow%inverse_speed
      end if
      self%film_errors = 0.0_dp
      call self%duty_error%start(level%h, duty%active, status)
      self%friction_smooth = friction_smooth
      if (allocated(self%mass_content)) deallocate (self%mass_content, self%p_before, self%rr)
      associate (nx => level%grid%nx, ny => level%grid%ny)
         allocate (self%mass_content(nx, ny, old_times), self%p_before(nx, ny, 3), self%rr(nx, ny), stat=stat)
      end associate
      if (stat /= 0) then
         call status%fail(ehl_no_memory, "no memory for the time levels")
         return
      end if
      call self%predictor%setup(level%grid%nx, level%grid%ny, surfaces%velocities()*self%time_step/level%grid%hx, status)
      if (status%failed()) return
      do k = old_times, 1, -1
         if (duty%active) then
            call heights_of(surfaces, level, self%now, self%rr)
         else
            call surfaces%roughness(level%grid, self%time - (k - 1)*self%time_step, self%rr, moving=.true.)
         end if
         self%mass_content(:, :, k) = level%rho*(level%h - self%rr)
      end do
      if (level%supply%active) then
         ! the steady line contact may have been solved with a fixed meniscus
         call level%supply%setup(level%grid%hx, level%grid%ny, duty%layer)
         do k = 1, level%grid%ny
            call content_row(level, k, self%mass_content(:, k, 1))
         end do
         self%mass_content(:, :, 2) = self%mass_content(:, :, 1)
      end if
      do k = 1, size(self%p_before, 3)
         self%p_before(:, :, k) = level%p
      end do
      self%h00_before = level%h00
      self%m = measure(level)
      if (duty%active) then
         ! no mean under a duty
         call self%mean%start(huge(1.0_dp), 1, 0.0_dp, self%time_step, 0.0_dp)
      else
         call self%mean%start(surfaces%period, surfaces%repeats, surfaces%mismatch, self%time_step, &
                              surfaces%time_to_mean(self%time))
      end if
      self%extremes = extremes_t()
   end procedure start

   module procedure fill
      type(contact_results_t) :: smooth
      real(dp), allocatable :: mass_content(:, :, :)
      real(dp) :: h00_smooth
      integer :: j, k, stat

      done = .false.
      h00_smooth = level%h00
      smooth = self%m
      allocate (mass_content, source=self%mass_content, stat=stat)
      if (stat /= 0) then
         call status%fail(ehl_no_memory, "no memory for the time levels")
         return
      end if
      ! the latest pressure last, since it holds the smooth pressure until then
      do k = size(self%p_before, 3), 1, -1
         call surfaces%roughness(level%grid, from%time - (k - 1)*self%time_step, self%rr)
         call set_geometry(level, self%contact, self%rr)
         do j = 1, level%grid%ny
            level%p(:, j) = self%p_before(:, j, 1) + from%pressure(:, j, k)
            call cavitate(level%p(:, j))
         end do
         level%h00 = h00_smooth
         call refresh(level)
         call balance_load(level)
         self%m = measure(level)
         done = self%m%finite .and. self%m%positive
         if (.not. done) exit
         self%p_before(:, :, k) = level%p
         self%h00_before(k) = level%h00
         if (k <= old_times) self%mass_content(:, :, k) = level%mass_content
      end do
      if (done) then
         self%skipped = nint(from%time/self%time_step)
         self%time = self%skipped*self%time_step
         call self%mean%start(surfaces%period, surfaces%repeats, surfaces%mismatch, self%time_step, first_mean, start_lag, &
                              transit)
      else
         self%mass_content = mass_content
         do k = 2, size(self%p_before, 3)
            self%p_before(:, :, k) = self%p_before(:, :, 1)
         end do
         self%h00_before = h00_smooth
         self%m = smooth
      end if
   end procedure fill

   module procedure heights_of
      if (surfaces%rough()) then
         call surfaces%roughness(level%grid, 0.0_dp, rr, displacements=state%displacements)
      else
         rr = 0.0_dp
      end if
   end procedure heights_of
end submodule ehl_transient_start

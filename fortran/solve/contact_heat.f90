! SPDX-License-Identifier: BSD-3-Clause
!> Frictional heating in a run: of the smooth contact, and of the rough contact in some steps and at the end
submodule (ehl_contact_run) ehl_contact_heat
   use ehl_heated_friction, only: heat_film
   use ehl_kinds, only: not_known
   use ehl_status, only: ehl_no_memory
   implicit none (type, external)

   !> Number of time steps per period at which the heating is computed: the reduction of friction changes slowly
   integer, parameter :: samples = 32

contains

   module procedure add_heat
      real(dp), allocatable :: film(:, :)
      logical, allocatable :: touching(:, :)
      integer :: j, stat

      associate (level => self%hierarchy%levels(n))
         allocate (touching(level%grid%nx, level%grid%ny), film(level%grid%nx, level%grid%ny), stat=stat)
         if (stat /= 0) then
            call status%fail(ehl_no_memory, "no memory for the temperatures of film and walls")
            return
         end if
         do j = 1, level%grid%ny
            film(:, j) = level%boundary%film_row(level%h(:, j), j)
            touching(:, j) = level%boundary%supports(level%p(:, j), level%mass_content(:, j))
         end do
         call heat_film(self%plan%heat%film, level%grid, level%lubricant, level%p, film, keep, level%threads, found, level%flow, &
                        level%rho, touching)
      end associate
      if (.not. found%fits) call status%fail(ehl_no_memory, "no memory for the temperatures of film and walls")
   end procedure add_heat

   module procedure step_heat
      type(heated_t) :: found

      ratio = not_known
      if (mod(self%transient%step, interval(self)) > 0) return
      call add_heat(self, self%smooth%n, .false., found, status)
      ratio = found%ratio()
   end procedure step_heat

   module procedure heat_ratio
      real(dp), allocatable :: ratio(:), isothermal(:), step(:)

      heat_ratio = not_known
      if (self%phase == phase_stationary) then
         heat_ratio = self%rough_heat%ratio()
         return
      end if
      ratio = self%history%column("heat_ratio")
      isothermal = self%history%column("mu_ratio")
      step = self%history%column("step")
      associate (first => self%transient%mean%first_of_mean())
         ! NaN if the temperature of any of these steps was not solved
         associate (due => mod(nint(step(first:)), interval(self)) == 0)
            if (any(due)) heat_ratio = sum(ratio(first:)*isothermal(first:), mask=due)/sum(isothermal(first:), mask=due)
         end associate
      end associate
   end procedure heat_ratio

   !> Steps between two computations of the heating
   pure integer function interval(self)
      class(contact_run_t), intent(in) :: self

      associate (mean => self%transient%mean)
         interval = max(1, nint(mean%period/(samples*mean%time_step)))
      end associate
   end function interval
end submodule ehl_contact_heat

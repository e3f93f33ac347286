! SPDX-License-Identifier: BSD-3-Clause
!> The rough surfaces of a contact and their motion: what a run asks of all of them together
module ehl_moving_surfaces
   use ehl_grid, only: grid_t
   use ehl_kinds, only: dp
   use ehl_status, only: ehl_no_memory, status_t
   use ehl_surface, only: surface_t
   implicit none (type, external)
   private
   public :: moving_surfaces_t

   !> One of them
   type :: member_t
      !> Group of the case that describes it
      character(len=16) :: group = ""
      class(surface_t), allocatable :: surface
      !> Amplitude as a share of the smooth central film; 0: it is known already
      real(dp) :: amplitude_over_film = 0.0_dp
   end type member_t

   !> Any number of rough surfaces; none: the contact is smooth. Their heights add up.
   type :: moving_surfaces_t
      type(member_t), allocatable :: of(:)
      !> Shares of the variance: in waves that the grid would alias, which are left out; in waves with fewer than eight
      !> nodes a period, those included
      real(dp) :: left_out = 0.0_dp, unresolved = 0.0_dp
      !> Time in which the friction repeats, see find_period; of what passes once the time of the passage
      real(dp) :: period = 0.0_dp
      !> Periods of the slowest surface in it, and by what part of a period another one misses its start then
      integer :: repeats = 1
      real(dp) :: mismatch = 0.0_dp
      !> Heights of one of several, (nx, ny)
      real(dp), allocatable, private :: part(:, :)
   contains
      procedure :: add
      procedure :: count => count_surfaces
      procedure :: rough
      procedure :: move
      procedure :: rest
      procedure :: some_rest
      procedure :: pass_once
      procedure :: even_in_y
      procedure :: has_spectrum
      procedure :: same_on_grids
      procedure :: use_threads
      procedure :: see
      procedure :: most_unresolved
      procedure :: prepare
      procedure :: hand_over
      procedure :: roughness
      procedure :: bytes
      procedure :: bytes_on
      procedure :: needs_film
      procedure :: take_film
      procedure :: velocities
      procedure :: slowest
      procedure :: begin
      procedure :: time_to_mean
      procedure :: find_period
      procedure :: end_of_passage
      procedure :: rms_height
      procedure :: rms_slope
   end type moving_surfaces_t

   ! in motion.f90
   interface
      !> Velocities over the mean velocity of what moves
      pure module function velocities(self) result(ratios)
         class(moving_surfaces_t), intent(in) :: self
         real(dp), allocatable :: ratios(:)
      end function velocities

      !> Number of the slowest of those that move
      pure integer module function slowest(self)
         class(moving_surfaces_t), intent(in) :: self
      end function slowest

      !> Time at which the first of them comes near the contact, and not before 0; steps until then change nothing
      pure real(dp) module function begin(self)
         class(moving_surfaces_t), intent(in) :: self
      end function begin

      !> Time from a time on until friction belongs to a mean; negative when that was before
      pure real(dp) module function time_to_mean(self, time)
         class(moving_surfaces_t), intent(in) :: self
         real(dp), intent(in) :: time
      end function time_to_mean

      !> Find the time in which the friction repeats: the least one that holds whole periods of all surfaces. Where none
      !> with so many periods of the slowest one does, a time after which all are nearly where they began; `mismatch` tells
      !> by how much they are not. Of what passes once, the time from when it comes near until it has left, in whole periods
      !> of roughness on the other body.
      pure module subroutine find_period(self, most)
         class(moving_surfaces_t), intent(inout) :: self
         !> Most periods of the slowest surface
         integer, intent(in) :: most
      end subroutine find_period

      !> Time at which what passes once has left the contact
      pure real(dp) module function end_of_passage(self)
         class(moving_surfaces_t), intent(in) :: self
      end function end_of_passage
   end interface

   ! in statistics.f90
   interface
      !> Whether one has waves that a grid can leave out
      pure logical module function has_spectrum(self)
         class(moving_surfaces_t), intent(in) :: self
      end function has_spectrum

      !> Whether all are single waves or features, which are the same on every grid that carries them
      pure logical module function same_on_grids(self)
         class(moving_surfaces_t), intent(in) :: self
      end function same_on_grids

      !> What of the surfaces a grid carries: `left_out` and `unresolved`
      module subroutine see(self, grid)
         class(moving_surfaces_t), intent(inout) :: self
         type(grid_t), intent(in) :: grid
      end subroutine see

      !> Share of the variance in waves with fewer nodes a period than that, see surface_t: that of the surface with the
      !> largest share
      pure real(dp) module function most_unresolved(self, grid, nodes)
         class(moving_surfaces_t), intent(in) :: self
         type(grid_t), intent(in) :: grid
         real(dp), intent(in) :: nodes
      end function most_unresolved

      !> Root mean square of the composite heights [a^2/R], as of surfaces that have nothing in common; 0 where it is not
      !> known, or means nothing
      pure real(dp) module function rms_height(self)
         class(moving_surfaces_t), intent(in) :: self
      end function rms_height

      !> Root mean square slope of the composite heights [a/R], as rms_height
      pure real(dp) module function rms_slope(self)
         class(moving_surfaces_t), intent(in) :: self
      end function rms_slope
   end interface

contains

   !> Take over another surface
   subroutine add(self, group, surface, amplitude_over_film)
      class(moving_surfaces_t), intent(inout) :: self
      !> Group of the case that describes it
      character(len=*), intent(in) :: group
      class(surface_t), allocatable, intent(inout) :: surface
      !> Amplitude as a share of the smooth central film; 0: it is known already
      real(dp), intent(in) :: amplitude_over_film
      type(member_t), allocatable :: more(:)
      integer :: k, n

      n = self%count()
      allocate (more(n + 1))
      do k = 1, n
         call move_alloc(self%of(k)%surface, more(k)%surface)
         more(k)%group = self%of(k)%group
         more(k)%amplitude_over_film = self%of(k)%amplitude_over_film
      end do
      call move_alloc(surface, more(n + 1)%surface)
      more(n + 1)%group = group
      more(n + 1)%amplitude_over_film = amplitude_over_film
      call move_alloc(more, self%of)
   end subroutine add

   !> Number of surfaces
   pure integer function count_surfaces(self)
      class(moving_surfaces_t), intent(in) :: self
      count_surfaces = 0
      if (allocated(self%of)) count_surfaces = size(self%of)
   end function count_surfaces

   !> Whether there is a rough surface
   pure logical function rough(self)
      class(moving_surfaces_t), intent(in) :: self
      rough = self%count() > 0
   end function rough

   !> Whether a rough surface is on the move: time steps
   pure logical function move(self)
      class(moving_surfaces_t), intent(in) :: self
      integer :: k
      move = any([(.not. self%of(k)%surface%at_rest(), k=1, self%count())])
   end function move

   !> Whether there is a rough surface and none moves: a steady contact
   pure logical function rest(self)
      class(moving_surfaces_t), intent(in) :: self
      rest = self%rough() .and. .not. self%move()
   end function rest

   !> Whether one is at rest while another one moves: the steady contact with the roughness at rest comes first
   pure logical function some_rest(self)
      class(moving_surfaces_t), intent(in) :: self
      integer :: k

      some_rest = self%move() .and. any([(self%of(k)%surface%at_rest(), k=1, self%count())])
   end function some_rest

   !> Whether something passes the contact once: the run ends when it has left
   pure logical function pass_once(self)
      class(moving_surfaces_t), intent(in) :: self
      integer :: k
      pass_once = any([(self%of(k)%surface%passes_once .and. .not. (self%move() .and. self%of(k)%surface%at_rest()), &
                        k=1, self%count())])
   end function pass_once

   !> Whether half the domain is enough
   pure logical function even_in_y(self)
      class(moving_surfaces_t), intent(in) :: self
      integer :: k
      even_in_y = all([(self%of(k)%surface%even_in_y, k=1, self%count())])
   end function even_in_y

   !> Threads for heights; they do not depend on it
   subroutine use_threads(self, threads)
      class(moving_surfaces_t), intent(inout) :: self
      integer, intent(in) :: threads
      integer :: k

      do k = 1, self%count()
         self%of(k)%surface%threads = threads
      end do
   end subroutine use_threads

   !> Get ready for a grid: once, before heights are asked for
   subroutine prepare(self, grid, status)
      class(moving_surfaces_t), intent(inout) :: self
      type(grid_t), intent(in) :: grid
      type(status_t), intent(inout) :: status
      integer :: k, stat

      do k = 1, self%count()
         call self%of(k)%surface%prepare(grid, status)
      end do
      if (self%count() < 2 .or. status%failed()) return
      if (allocated(self%part)) deallocate (self%part)
      allocate (self%part(grid%nx, grid%ny), stat=stat)
      if (stat /= 0) call status%fail(ehl_no_memory, "no memory for the heights of several surfaces")
   end subroutine prepare

   !> Surfaces like these for another grid; what these have been prepared for stays
   subroutine hand_over(self, other)
      class(moving_surfaces_t), intent(inout) :: self
      type(moving_surfaces_t), intent(out) :: other
      class(surface_t), allocatable :: surface
      integer :: k

      do k = 1, self%count()
         call self%of(k)%surface%hand_over(surface)
         call other%add(self%of(k)%group, surface, 0.0_dp)
      end do
   end subroutine hand_over

   !> rr(nx, ny): sum of the heights at the nodes, at time T [a^2/R]
   subroutine roughness(self, grid, time, rr, moving)
      class(moving_surfaces_t), intent(inout) :: self
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: time
      real(dp), intent(out) :: rr(:, :)
      !> Of those alone that move, or that are at rest; at least one
      logical, intent(in), optional :: moving
      logical :: wanted(self%count())
      integer :: k, first

      wanted = .true.
      if (present(moving)) wanted = [(self%of(k)%surface%at_rest() .neqv. moving, k=1, self%count())]
      first = findloc(wanted, .true., dim=1)
      call self%of(first)%surface%height(grid, time, rr)
      do k = first + 1, self%count()
         if (.not. wanted(k)) cycle
         call self%of(k)%surface%height(grid, time, self%part)
         rr = rr + self%part
      end do
   end subroutine roughness

   !> Bytes of their arrays
   pure real(dp) function bytes(self)
      class(moving_surfaces_t), intent(in) :: self
      integer :: k

      bytes = sum([(self%of(k)%surface%bytes(), k=1, self%count())])
      if (allocated(self%part)) bytes = bytes + 8.0_dp*size(self%part)
   end function bytes

   !> Bytes that they will take when they are prepared for a grid
   pure real(dp) function bytes_on(self, grid)
      class(moving_surfaces_t), intent(in) :: self
      type(grid_t), intent(in) :: grid
      integer :: k

      bytes_on = sum([(self%of(k)%surface%bytes_on(grid), k=1, self%count())])
      if (self%count() > 1) bytes_on = bytes_on + 8.0_dp*grid%nx*grid%ny
   end function bytes_on

   !> Whether an amplitude was given as a share of the smooth central film
   pure logical function needs_film(self)
      class(moving_surfaces_t), intent(in) :: self
      needs_film = .false.
      if (self%rough()) needs_film = any(self%of%amplitude_over_film > 0.0_dp)
   end function needs_film

   !> The smooth central film [a^2/R], for amplitudes that are a share of it
   subroutine take_film(self, film)
      class(moving_surfaces_t), intent(inout) :: self
      real(dp), intent(in) :: film
      integer :: k

      do k = 1, self%count()
         associate (member => self%of(k))
            if (member%amplitude_over_film > 0.0_dp) member%surface%amplitude = member%amplitude_over_film*film
         end associate
      end do
   end subroutine take_film
end module ehl_moving_surfaces
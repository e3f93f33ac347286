! SPDX-License-Identifier: BSD-3-Clause
!> The rough surfaces of a contact: sum of their heights, fraction resolved by a grid, composite roughness
module ehl_rough_surfaces
   use ehl_grid, only: grid_t
   use ehl_kinds, only: dp
   use ehl_status, only: ehl_no_memory, status_t
   use ehl_surface, only: aliased_below, resolved_from, surface_t
   implicit none (type, external)
   private
   public :: rough_surfaces_t

   !> Difference below which velocity ratios are equal
   real(dp), parameter :: same = 1.0e-9_dp

   !> One rough surface
   type :: member_t
      !> Group of the case that defines it
      character(len=16) :: group = ""
      !> Body to which it belongs
      integer :: body = 1
      class(surface_t), allocatable :: surface
      !> Amplitude over the smooth central film; 0: not given relative to it
      real(dp) :: amplitude_over_film = 0.0_dp
   end type member_t

   !> Rough surfaces, whose heights are added; none: the contact is smooth
   type :: rough_surfaces_t
      type(member_t), allocatable :: of(:)
      !> Fractions of the variance: in waves that the grid would alias, which are omitted; in waves with fewer than eight
      !> nodes per period, including the former
      real(dp) :: left_out = 0.0_dp, unresolved = 0.0_dp
      !> Correlation of the heights of the first two, and of their gradients, if they move together
      real(dp) :: correlation(2) = 0.0_dp
      !> Heights of one of several surfaces, (nx, ny)
      real(dp), allocatable, private :: part(:, :)
   contains
      procedure :: add
      procedure :: count => count_surfaces
      procedure :: rough
      procedure :: even_in_y
      procedure :: width
      procedure :: move_together
      procedure :: has_spectrum
      procedure :: same_on_grids
      procedure :: use_threads
      procedure :: update_resolution
      procedure :: max_unresolved
      procedure :: prepare
      procedure :: transfer
      procedure :: reclaim
      procedure :: roughness
      procedure :: bytes
      procedure :: bytes_on
      procedure :: needs_film
      procedure :: take_film
      procedure :: rms_height
      procedure :: rms_slope
   end type rough_surfaces_t

contains

   !> Add a surface; it is deallocated in the caller
   subroutine add(self, group, surface, amplitude_over_film, body)
      class(rough_surfaces_t), intent(inout) :: self
      !> Group of the case that defines it
      character(len=*), intent(in) :: group
      class(surface_t), allocatable, intent(inout) :: surface
      !> Amplitude over the smooth central film; 0: not given relative to it
      real(dp), intent(in) :: amplitude_over_film
      integer, intent(in) :: body
      type(member_t), allocatable :: more(:)
      integer :: k, n

      n = self%count()
      allocate (more(n + 1))
      do k = 1, n
         call move_alloc(self%of(k)%surface, more(k)%surface)
         more(k)%group = self%of(k)%group
         more(k)%body = self%of(k)%body
         more(k)%amplitude_over_film = self%of(k)%amplitude_over_film
      end do
      call move_alloc(surface, more(n + 1)%surface)
      more(n + 1)%group = group
      more(n + 1)%body = body
      more(n + 1)%amplitude_over_film = amplitude_over_film
      call move_alloc(more, self%of)
      if (self%move_together()) self%correlation = self%of(1)%surface%correlation(self%of(2)%surface)
   end subroutine add

   !> Number of surfaces
   pure integer function count_surfaces(self)
      class(rough_surfaces_t), intent(in) :: self
      count_surfaces = 0
      if (allocated(self%of)) count_surfaces = size(self%of)
   end function count_surfaces

   !> Whether there is a rough surface
   pure logical function rough(self)
      class(rough_surfaces_t), intent(in) :: self
      rough = self%count() > 0
   end function rough

   !> Whether the heights are even in Y, so that half the domain is enough
   pure logical function even_in_y(self)
      class(rough_surfaces_t), intent(in) :: self
      integer :: k
      even_in_y = all([(self%of(k)%surface%even_in_y, k=1, self%count())])
   end function even_in_y

   !> Common period along Y of all surfaces, the width of a strip; 0: nothing varies along Y, negative: there is none
   pure real(dp) function width(self)
      class(rough_surfaces_t), intent(in) :: self
      real(dp), parameter :: rounding = 1.0e-9_dp
      integer :: k

      width = maxval([0.0_dp, (self%of(k)%surface%period_y, k=1, self%count())])
      do k = 1, self%count()
         associate (own => self%of(k)%surface%period_y)
            if (.not. own > 0.0_dp) cycle
            if (abs(width/own - nint(width/own)) > rounding*width/own) width = -1.0_dp
         end associate
         if (width < 0.0_dp) return
      end do
   end function width

   !> Whether there are two surfaces with the same velocity, or both stationary
   pure logical function move_together(self)
      class(rough_surfaces_t), intent(in) :: self
      move_together = .false.
      if (self%count() == 2) move_together = abs(self%of(1)%surface%velocity_ratio - self%of(2)%surface%velocity_ratio) <= same
   end function move_together

   !> Whether a surface has waves that a grid can omit
   pure logical function has_spectrum(self)
      class(rough_surfaces_t), intent(in) :: self
      integer :: k
      has_spectrum = any([(self%of(k)%surface%variance > 0.0_dp, k=1, self%count())])
   end function has_spectrum

   !> Whether all are single waves or features, which are the same on every grid that resolves them
   pure logical function same_on_grids(self)
      class(rough_surfaces_t), intent(in) :: self
      integer :: k
      same_on_grids = all([(self%of(k)%surface%amplitude > 0.0_dp, k=1, self%count())])
   end function same_on_grids

   !> Set the number of threads for heights, which do not depend on it
   subroutine use_threads(self, threads)
      class(rough_surfaces_t), intent(inout) :: self
      integer, intent(in) :: threads
      integer :: k

      do k = 1, self%count()
         self%of(k)%surface%threads = threads
      end do
   end subroutine use_threads

   !> Update the fractions that a grid does not resolve: `left_out` and `unresolved`
   subroutine update_resolution(self, grid)
      class(rough_surfaces_t), intent(inout) :: self
      type(grid_t), intent(in) :: grid

      self%left_out = unresolved_fraction(self, grid, aliased_below)
      self%unresolved = unresolved_fraction(self, grid, resolved_from)
   end subroutine update_resolution

   !> Fraction of the total variance in waves with fewer nodes per period than `nodes`; if a variance is not known the
   !> maximum over the surfaces
   pure real(dp) function unresolved_fraction(self, grid, nodes)
      class(rough_surfaces_t), intent(in) :: self
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: nodes
      real(dp) :: variance(self%count()), fraction(self%count())
      integer :: k

      do k = 1, self%count()
         fraction(k) = self%of(k)%surface%unresolved(grid, nodes)
         variance(k) = self%of(k)%surface%rms_height()**2
      end do
      unresolved_fraction = maxval(fraction)
      if (self%count() > 1 .and. all(variance > 0.0_dp)) unresolved_fraction = sum(variance*fraction)/sum(variance)
   end function unresolved_fraction

   !> Maximum fraction over the surfaces of the variance in waves with fewer nodes per period than `nodes`, see surface_t
   pure real(dp) function max_unresolved(self, grid, nodes)
      class(rough_surfaces_t), intent(in) :: self
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: nodes
      integer :: k

      max_unresolved = 0.0_dp
      do k = 1, self%count()
         max_unresolved = max(max_unresolved, self%of(k)%surface%unresolved(grid, nodes))
      end do
   end function max_unresolved

   !> Prepare for a grid; call once before heights are computed
   subroutine prepare(self, grid, status)
      class(rough_surfaces_t), intent(inout) :: self
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

   !> Make copies of the surfaces for another grid; the originals remain prepared for theirs
   subroutine transfer(self, other)
      class(rough_surfaces_t), intent(inout) :: self
      !> Empty before the call
      class(rough_surfaces_t), intent(inout) :: other
      class(surface_t), allocatable :: surface
      integer :: k

      do k = 1, self%count()
         call self%of(k)%surface%transfer(surface)
         call other%add(self%of(k)%group, surface, 0.0_dp, self%of(k)%body)
      end do
   end subroutine transfer

   !> Take back the data that was transferred to surfaces that are no longer needed
   subroutine reclaim(self, other)
      class(rough_surfaces_t), intent(inout) :: self, other
      integer :: k

      do k = 1, min(self%count(), other%count())
         call self%of(k)%surface%reclaim(other%of(k)%surface)
      end do
   end subroutine reclaim

   !> rr(nx, ny): sum of the heights at the nodes, at time T [a^2/R]
   subroutine roughness(self, grid, time, rr, moving, displacements)
      class(rough_surfaces_t), intent(inout) :: self
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: time
      real(dp), intent(out) :: rr(:, :)
      !> Only the moving (true) or the stationary (false) surfaces, at least one
      logical, intent(in), optional :: moving
      !> Displacements of body 1 and of body 2, in place of the time
      real(dp), intent(in), optional :: displacements(2)
      logical :: wanted(self%count())
      integer :: k, first

      wanted = .true.
      if (present(moving)) wanted = [(self%of(k)%surface%at_rest() .neqv. moving, k=1, self%count())]
      first = findloc(wanted, .true., dim=1)
      call self%of(first)%surface%height(grid, time_of(first), rr)
      do k = first + 1, self%count()
         if (.not. wanted(k)) cycle
         call self%of(k)%surface%height(grid, time_of(k), self%part)
         rr = rr + self%part
      end do

   contains

      !> Time that corresponds to the position of a surface
      pure real(dp) function time_of(k)
         integer, intent(in) :: k
         time_of = time
         if (present(displacements)) time_of = displacements(self%of(k)%body)/self%of(k)%surface%velocity_ratio
      end function time_of
   end subroutine roughness

   !> Allocated bytes
   pure real(dp) function bytes(self)
      class(rough_surfaces_t), intent(in) :: self
      integer :: k

      bytes = sum([(self%of(k)%surface%bytes(), k=1, self%count())])
      if (allocated(self%part)) bytes = bytes + 8.0_dp*size(self%part)
   end function bytes

   !> Bytes required when prepared for a grid
   pure real(dp) function bytes_on(self, grid)
      class(rough_surfaces_t), intent(in) :: self
      type(grid_t), intent(in) :: grid
      integer :: k

      bytes_on = sum([(self%of(k)%surface%bytes_on(grid), k=1, self%count())])
      if (self%count() > 1) bytes_on = bytes_on + 8.0_dp*grid%nx*grid%ny
   end function bytes_on

   !> Whether an amplitude was given relative to the smooth central film
   pure logical function needs_film(self)
      class(rough_surfaces_t), intent(in) :: self
      needs_film = .false.
      if (self%rough()) needs_film = any(self%of%amplitude_over_film > 0.0_dp)
   end function needs_film

   !> Set the amplitudes that are given relative to the smooth central film [a^2/R]
   subroutine take_film(self, film)
      class(rough_surfaces_t), intent(inout) :: self
      real(dp), intent(in) :: film
      integer :: k

      do k = 1, self%count()
         associate (member => self%of(k))
            if (member%amplitude_over_film > 0.0_dp) member%surface%amplitude = member%amplitude_over_film*film
         end associate
      end do
   end subroutine take_film

   !> Root mean square of the composite heights [a^2/R]; a surface for which it is not known or not defined counts as smooth.
   !> Surfaces that do not move together are uncorrelated on average.
   pure real(dp) function rms_height(self)
      class(rough_surfaces_t), intent(in) :: self
      integer :: k

      rms_height = 0.0_dp
      do k = 1, self%count()
         rms_height = hypot(rms_height, self%of(k)%surface%rms_height())
      end do
      if (self%count() == 2) rms_height = sqrt(max(0.0_dp, rms_height**2 + 2.0_dp*self%correlation(1)* &
                                      self%of(1)%surface%rms_height()*self%of(2)%surface%rms_height()))
   end function rms_height

   !> Root mean square slope of the composite heights [a/R], see rms_height
   pure real(dp) function rms_slope(self)
      class(rough_surfaces_t), intent(in) :: self
      integer :: k

      rms_slope = 0.0_dp
      do k = 1, self%count()
         rms_slope = hypot(rms_slope, self%of(k)%surface%rms_slope())
      end do
      if (self%count() == 2) rms_slope = sqrt(max(0.0_dp, rms_slope**2 + 2.0_dp*self%correlation(2)* &
                                     self%of(1)%surface%rms_slope()*self%of(2)%surface%rms_slope()))
   end function rms_slope
end module ehl_rough_surfaces

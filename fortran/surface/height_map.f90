! SPDX-License-Identifier: BSD-3-Clause
!> A height map as a periodic tile that is carried through the contact, or lies in it. Of the tile its spectrum is kept
!> alone, in the memory of one copy; for a grid, the heights of the waves that the grid carries are summed on the rows
!> of the grid, exactly, at points along X from which those between them are interpolated.
module ehl_height_map
   use, intrinsic :: iso_c_binding, only: c_double_complex, c_ptr
   use ehl_chirp, only: chirp_t
   use ehl_fftw, only: fftw_execute_dft_c2r
   use ehl_fftw_planner, only: drop_plan, good_size, plan_to_real, to_spectrum
   use ehl_grid, only: grid_t
   use ehl_kinds, only: dp
   use ehl_status, only: ehl_bad_input, ehl_no_memory, status_t
   use ehl_surface, only: aliased_below, surface_t
   use ehl_text, only: to_text
   use ehl_tile_filter, only: filter_spectrum, filter_t
   implicit none (type, external)
   private
   public :: height_map_t

   !> The tile is refined along X to so many points for each of its pixels by its Fourier series, and between these
   !> points a polynomial of degree 5 is used: its error is 2e-5 of the amplitude of the shortest wave (two pixels),
   !> and falls with the sixth power of the wavelength. Where the grid carries fewer waves, so many pixels are enough
   !> as carry them.
   integer, parameter :: refinement = 8
   integer, parameter :: points = 6

   !> Tile of heights; pixel (1, 1) lies on the front, at Y = 0
   type, extends(surface_t) :: height_map_t
      private
      !> Tile length along Y [a]
      real(dp) :: length_y = 0.0_dp
      !> Pixels along X and Y
      integer :: pixels(2) = 0
      !> Half spectrum of the heights [a^2/R], (pixels/2 + 1, pixels), X first, see to_spectrum; without the mean, cut
      complex(c_double_complex), allocatable :: spectrum(:, :)
      !> Refined heights on the rows of the grid: (refinement*pixels + points - 1, ny), the
      !> first of them repeated at the end
      real(dp), allocatable :: refined(:, :)
   contains
      procedure :: setup
      procedure :: prepare
      procedure :: hand_over
      procedure :: height
      procedure :: unresolved
      procedure :: bytes
      procedure, private :: carried
   end type height_map_t

contains

   !> Take a tile of heights of size length_x by length_y [a]; the front fades over front_length
   subroutine setup(self, tile, scale, length_x, length_y, filter, front_length, status)
      class(height_map_t), intent(inout) :: self
      !> Heights, X first, and their unit in a^2/R
      real(dp), intent(in) :: tile(:, :)
      real(dp), intent(in) :: scale
      real(dp), intent(in) :: length_x, length_y
      !> Cut of the spectrum, lengths in a
      type(filter_t), intent(in) :: filter
      real(dp), intent(in) :: front_length
      type(status_t), intent(inout) :: status
      integer :: j

      if (status%failed()) return
      self%pixels = shape(tile)
      if (minval(self%pixels) < 4) then
         call status%fail(ehl_bad_input, "a height map needs at least 4 x 4 pixels")
         return
      end if
      self%even_in_y = .true.
      do j = 2, self%pixels(2)/2
         self%even_in_y = .not. any(abs(tile(:, j) - tile(:, self%pixels(2) + 2 - j)) > 0.0_dp)
         if (.not. self%even_in_y) exit
      end do
      self%period = length_x
      self%length_y = length_y
      self%front_length = front_length
      call to_spectrum(tile, self%spectrum, status)
      if (status%failed()) return
      do j = 1, self%pixels(2)
         self%spectrum(:, j) = self%spectrum(:, j)*scale
      end do
      self%spectrum(1, 1) = (0.0_dp, 0.0_dp)
      self%variance_whole = variance_of(self, [huge(1), huge(1)])
      call filter_spectrum(filter, self%spectrum, length_x, length_y)
      self%variance = variance_of(self, [huge(1), huge(1)])
      if (allocated(self%refined)) deallocate (self%refined)
   end subroutine setup

   !> Give the spectrum to a surface of the same kind that is needed later, on another grid: one copy in memory
   subroutine hand_over(self, other)
      class(height_map_t), intent(inout) :: self
      class(surface_t), allocatable, intent(out) :: other
      complex(c_double_complex), allocatable :: spectrum(:, :)
      real(dp), allocatable :: refined(:, :)

      call move_alloc(self%spectrum, spectrum)
      call move_alloc(self%refined, refined)
      allocate (other, source=self)
      call move_alloc(refined, self%refined)
      select type (other)
      type is (height_map_t)
         call move_alloc(spectrum, other%spectrum)
      end select
   end subroutine hand_over

   !> Variance of the waves with at most so many periods in the tile along X and along Y [(a^2/R)^2]
   pure real(dp) function variance_of(self, most)
      class(height_map_t), intent(in) :: self
      integer, intent(in) :: most(2)
      real(dp) :: sums(self%pixels(2))
      integer :: j, last, nx, ny

      nx = self%pixels(1)
      ny = self%pixels(2)
      last = min(nx/2, most(1)) + 1
      sums = 0.0_dp
      do j = 1, ny
         if (min(j - 1, ny + 1 - j) > most(2)) cycle
         ! components with q_x < 0 are not stored
         sums(j) = 2.0_dp*sum(self%spectrum(:last, j)%re**2 + self%spectrum(:last, j)%im**2) - abs(self%spectrum(1, j))**2
         if (2*(last - 1) == nx) sums(j) = sums(j) - abs(self%spectrum(last, j))**2
      end do
      variance_of = sum(sums)
   end function variance_of

   !> Most periods in the tile, along X and Y, of waves that have at least so many nodes a period, or more than that
   pure function carried(self, grid, nodes, more) result(most)
      class(height_map_t), intent(in) :: self
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: nodes
      logical, intent(in) :: more
      integer :: most(2)
      !> So that rounding does not decide
      real(dp), parameter :: slack = 1.0e-9_dp

      most = int([self%period, self%length_y]/self%meshes(grid)/nodes*(1.0_dp + merge(-slack, slack, more)))
      most = min(most, self%pixels/2)
   end function carried

   !> Share of the variance in waves that have fewer nodes than that along X or along Y
   pure real(dp) function unresolved(self, grid, nodes)
      class(height_map_t), intent(in) :: self
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: nodes

      unresolved = 0.0_dp
      if (.not. self%variance > 0.0_dp .or. .not. allocated(self%spectrum)) return
      unresolved = max(0.0_dp, 1.0_dp - variance_of(self, self%carried(grid, nodes, .not. nodes > aliased_below))/self%variance)
   end function unresolved

   !> Bytes in use
   pure real(dp) function bytes(self)
      class(height_map_t), intent(in) :: self
      bytes = 0.0_dp
      if (allocated(self%spectrum)) bytes = 16.0_dp*size(self%spectrum, 1)*real(size(self%spectrum, 2), dp)
      if (allocated(self%refined)) bytes = bytes + 8.0_dp*size(self%refined, 1)*real(size(self%refined, 2), dp)
   end function bytes

   !> Heights on the rows of a grid, refined along X, of the waves that have more than two nodes a period
   subroutine prepare(self, grid, status)
      class(height_map_t), intent(inout) :: self
      type(grid_t), intent(in) :: grid
      type(status_t), intent(inout) :: status
      type(chirp_t) :: chirp
      complex(c_double_complex), allocatable :: rows(:, :), column(:), row(:)
      real(dp), allocatable :: values(:)
      type(c_ptr) :: plan
      integer :: i, j, k, n, ny, waves(2), stat

      if (status%failed()) return
      waves = self%carried(grid, aliased_below, .true.)
      ny = self%pixels(2)
      n = refinement*self%pixels(1)
      if (waves(1) < self%pixels(1)/2) n = min(n, good_size(refinement*(2*waves(1) + 1)))
      if (allocated(self%refined)) deallocate (self%refined)
      allocate (self%refined(n + points - 1, grid%ny), rows(grid%ny, 0:waves(1)), column(-waves(2):waves(2)), &
                row(0:n/2), values(n), stat=stat)
      if (stat /= 0) then
         call status%fail(ehl_no_memory, "no memory for the height map on "//to_text(grid%nx)//" x "//to_text(grid%ny)//" nodes")
         return
      end if
      call chirp%setup(waves(2), grid%ny, grid%y(1)/self%length_y, grid%hy/self%length_y, status)
      if (status%failed()) return
      do i = 0, waves(1)
         do k = -waves(2), waves(2)
            column(k) = self%spectrum(i + 1, modulo(k, ny) + 1)
         end do
         ! half of the shortest wave travels with +q and half with -q
         if (2*waves(2) == ny) column([-waves(2), waves(2)]) = 0.5_dp*column([-waves(2), waves(2)])
         if (2*i == self%pixels(1)) column = 0.5_dp*column
         call chirp%apply(column, rows(:, i))
      end do
      call chirp%clear()
      call plan_to_real(plan, n, row, values, status)
      if (status%failed()) return
      do j = 1, grid%ny
         row = (0.0_dp, 0.0_dp)
         row(:waves(1)) = rows(j, :)
         call fftw_execute_dft_c2r(plan, row, values)
         self%refined(:n, j) = values
         self%refined(n + 1:, j) = values(:points - 1)
      end do
      call drop_plan(plan)
   end subroutine prepare

   !> Roughness at the nodes, at time T; the same shift for every row, so that the
   !> weights of the interpolation are found once
   subroutine height(self, grid, time, rr)
      class(height_map_t), intent(inout) :: self
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: time
      real(dp), intent(out) :: rr(:, :)
      real(dp) :: distance, t, weight(points, grid%nx)
      integer :: i, j, k, n, first(grid%nx)

      n = size(self%refined, 1) - points + 1
      do i = 1, grid%nx
         distance = grid%x(i) - self%front_position(time)
         t = modulo(distance/self%period, 1.0_dp)*n
         first(i) = modulo(int(t) - 2, n) + 1
         t = t - int(t) + 2.0_dp
         do k = 1, points
            weight(k, i) = lagrange(t, k - 1)*self%share(distance)
         end do
      end do
      !$omp parallel do default(none) shared(self, grid, rr, first, weight) private(i) &
      !$omp num_threads(self%threads) if(self%threads > 1) schedule(static)
      do j = 1, grid%ny
         do i = 1, grid%nx
            rr(i, j) = sum(weight(:, i)*self%refined(first(i):first(i) + points - 1, j))
         end do
      end do
      !$omp end parallel do
   end subroutine height

   !> Lagrange polynomial number k of the nodes 0, 1, ... at t
   pure real(dp) function lagrange(t, k)
      real(dp), intent(in) :: t
      integer, intent(in) :: k
      integer :: m

      lagrange = 1.0_dp
      do m = 0, points - 1
         if (m /= k) lagrange = lagrange*(t - m)/(k - m)
      end do
   end function lagrange
end module ehl_height_map

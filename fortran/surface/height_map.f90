! SPDX-License-Identifier: BSD-3-Clause
!> A height map as a periodic tile that moves through the contact or is stationary. Of the tile only its waves are stored, which
!> need the memory of one copy of the heights; for a grid, the waves that it resolves are summed exactly on the rows of the grid at
!> points along X, and interpolated between these points.
module ehl_height_map
   use, intrinsic :: iso_c_binding, only: c_double_complex, c_ptr
   use ehl_chirp, only: chirp_t
   use ehl_fftw, only: fftw_execute_dft_c2r
   use ehl_fftw_planner, only: drop_plan, good_size, plan_to_real
   use ehl_grid, only: grid_t
   use ehl_kinds, only: dp
   use ehl_status, only: ehl_bad_input, ehl_no_memory, status_t
   use ehl_surface, only: aliased_below, surface_t
   use ehl_text, only: to_text
   use ehl_tile_filter, only: filter_t
   use ehl_tile_waves, only: tile_waves_t
   implicit none (type, external)
   private
   public :: height_map_t

   !> The Fourier series of the tile is evaluated at `refinement` points per pixel along X, and interpolated between these
   !> points by a polynomial of degree 5: its error is 2e-5 of the amplitude of the shortest wave (two pixels),
   !> and decreases with the sixth power of the wavelength. If the grid resolves fewer waves, pixels that resolve
   !> them suffice.
   integer, parameter :: refinement = 8
   integer, parameter :: points = 6

   !> Tile of heights; pixel (1, 1) is on the front, at Y = 0
   type, extends(surface_t) :: height_map_t
      private
      !> Its filtered waves [a^2/R] without the mean, lengths in a
      type(tile_waves_t) :: waves
      !> Refined heights on the rows of the grid, (refined_points + points - 1, ny); the first points are repeated at the end
      real(dp), allocatable :: refined(:, :)
   contains
      procedure :: setup
      procedure :: prepare
      procedure :: transfer
      procedure :: reclaim
      procedure :: height
      procedure :: unresolved
      procedure :: correlation
      procedure :: bytes
      procedure :: bytes_on
      procedure, private :: resolved_waves
      procedure, private :: refined_points
   end type height_map_t

contains

   !> Set the heights of a tile, or of a map that becomes a tile with its mirror images; size of the tile: length [a]; the
   !> front fades over front_length
   subroutine setup(self, heights, scale, length, mirrored, filter, front_length, status)
      class(height_map_t), intent(inout) :: self
      !> Heights, X first, and their unit in a^2/R
      real(dp), intent(in) :: heights(:, :)
      real(dp), intent(in) :: scale
      real(dp), intent(in) :: length(2)
      logical, intent(in) :: mirrored
      !> Filter of the spectrum, lengths in a
      type(filter_t), intent(in) :: filter
      real(dp), intent(in) :: front_length
      type(status_t), intent(inout) :: status
      integer, parameter :: all_waves(2) = huge(1) - 1

      if (status%failed()) return
      if (minval(shape(heights)) < 4) then
         call status%fail(ehl_bad_input, "a height map needs at least 4 x 4 pixels")
         return
      end if
      self%period = length(1)
      self%front_length = front_length
      call self%waves%take(heights, scale, length, mirrored, status)
      self%period_y = self%waves%length(2)
      if (status%failed()) return
      self%even_in_y = self%waves%even_in_y
      self%variance_whole = self%waves%variance(all_waves)
      call self%waves%cut(filter)
      self%variance = self%waves%variance(all_waves)
      self%slope = sqrt(self%waves%mean_square_slope())
      if (allocated(self%refined)) deallocate (self%refined)
   end subroutine setup

   !> Transfer the waves to a surface of the same kind on another grid, so that there is only one copy in memory
   subroutine transfer(self, other)
      class(height_map_t), intent(inout) :: self
      class(surface_t), allocatable, intent(out) :: other
      type(tile_waves_t) :: waves
      real(dp), allocatable :: refined(:, :)

      call self%waves%transfer_to(waves)
      call move_alloc(self%refined, refined)
      allocate (other, source=self)
      call move_alloc(refined, self%refined)
      select type (other)
      type is (height_map_t)
         call waves%transfer_to(other%waves)
      end select
   end subroutine transfer

   !> Transfer the waves back
   subroutine reclaim(self, other)
      class(height_map_t), intent(inout) :: self
      class(surface_t), intent(inout) :: other

      select type (other)
      type is (height_map_t)
         call other%waves%transfer_to(self%waves)
      end select
   end subroutine reclaim

   !> Maximum number of periods in the tile, along X and Y, of waves with at least `nodes` nodes per period (`more`: with more than
   !> `nodes`)
   pure function resolved_waves(self, grid, nodes, more) result(max_order)
      class(height_map_t), intent(in) :: self
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: nodes
      logical, intent(in) :: more
      integer :: max_order(2)
      !> Margin for rounding errors
      real(dp), parameter :: slack = 1.0e-9_dp

      max_order = int(min(self%waves%length/self%meshes(grid)/nodes*(1.0_dp + merge(-slack, slack, more)), &
                     0.5_dp*self%waves%pixels))
   end function resolved_waves

   !> Correlation of two tiles of the same size
   pure function correlation(self, other) result(both)
      class(height_map_t), intent(in) :: self
      class(surface_t), intent(in) :: other
      real(dp) :: both(2)

      both = 0.0_dp
      select type (other)
      class is (height_map_t)
         if (any(abs(self%waves%length - other%waves%length) > 1.0e-9_dp*self%waves%length)) return
         if (.not. (self%waves%are_present() .and. other%waves%are_present())) return
         both = self%waves%correlation(other%waves, other%x_start - self%x_start)
      end select
   end function correlation

   !> Fraction of the variance in waves with fewer nodes per period than `nodes` along X or along Y
   pure real(dp) function unresolved(self, grid, nodes)
      class(height_map_t), intent(in) :: self
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: nodes

      unresolved = 0.0_dp
      if (.not. self%variance > 0.0_dp .or. .not. self%waves%are_present()) return
      unresolved = max(0.0_dp, 1.0_dp - self%waves%variance(self%resolved_waves(grid, nodes, .not. nodes > aliased_below)) &
                       /self%variance)
   end function unresolved

   !> Bytes in use
   pure real(dp) function bytes(self)
      class(height_map_t), intent(in) :: self
      bytes = 0.0_dp
      if (self%waves%are_present()) bytes = self%waves%bytes()
      if (allocated(self%refined)) bytes = bytes + 8.0_dp*size(self%refined, 1)*real(size(self%refined, 2), dp)
   end function bytes

   !> Number of points along X of the refined tile, for waves of at most `max_order` periods in it
   pure integer function refined_points(self, max_order)
      class(height_map_t), intent(in) :: self
      integer, intent(in) :: max_order

      refined_points = refinement*self%waves%pixels(1)
      if (max_order < self%waves%pixels(1)/2) refined_points = min(refined_points, good_size(refinement*(2*max_order + 1)))
   end function refined_points

   !> Bytes of the waves, the refined heights and, during `prepare`, the waves of the rows
   pure real(dp) function bytes_on(self, grid)
      class(height_map_t), intent(in) :: self
      type(grid_t), intent(in) :: grid
      integer :: max_order(2)

      max_order = self%resolved_waves(grid, aliased_below, .true.)
      bytes_on = self%waves%bytes() + 8.0_dp*grid%ny*(self%refined_points(max_order(1)) + 2.0_dp*max_order(1))
   end function bytes_on

   !> Compute the refined heights on the rows of a grid, from the waves with more than two nodes per period
   subroutine prepare(self, grid, status)
      class(height_map_t), intent(inout) :: self
      type(grid_t), intent(in) :: grid
      type(status_t), intent(inout) :: status
      type(chirp_t) :: chirp
      complex(c_double_complex), allocatable :: rows(:, :), column(:), row(:)
      real(dp), allocatable :: values(:)
      type(c_ptr) :: plan
      integer :: i, j, n, max_order(2), stat

      if (status%failed()) return
      max_order = self%resolved_waves(grid, aliased_below, .true.)
      n = self%refined_points(max_order(1))
      if (allocated(self%refined)) deallocate (self%refined)
      allocate (self%refined(n + points - 1, grid%ny), rows(grid%ny, 0:max_order(1)), column(-max_order(2):max_order(2)), &
                row(0:n/2), values(n), stat=stat)
      if (stat /= 0) then
         call status%fail(ehl_no_memory, "no memory for the height map on "//to_text(grid%nx)//" x "//to_text(grid%ny)//" nodes")
         return
      end if
      call chirp%setup(max_order(2), grid%ny, grid%y(1)/self%waves%length(2), grid%hy/self%waves%length(2), status)
      if (status%failed()) return
      do i = 0, max_order(1)
         call self%waves%column(i, max_order(2), column)
         call chirp%apply(column, rows(:, i))
      end do
      call chirp%clear()
      call plan_to_real(plan, n, row, values, status)
      if (status%failed()) return
      do j = 1, grid%ny
         row = (0.0_dp, 0.0_dp)
         row(:max_order(1)) = rows(j, :)
         call fftw_execute_dft_c2r(plan, row, values)
         self%refined(:n, j) = values
         self%refined(n + 1:, j) = values(:points - 1)
      end do
      call drop_plan(plan)
   end subroutine prepare

   !> Roughness at the nodes, at time T; the shift is the same for every row, so that the
   !> weights of the interpolation are computed once
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
            weight(k, i) = lagrange(t, k - 1)*self%front_factor(distance)
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

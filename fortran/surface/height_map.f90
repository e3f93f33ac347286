! SPDX-License-Identifier: BSD-3-Clause
!> A height map as a periodic tile that is carried through the contact
module ehl_height_map
   use, intrinsic :: iso_c_binding, only: c_double_complex, c_int, c_ptr
   use ehl_fftw
   use ehl_grid, only: grid_t
   use ehl_kinds, only: dp, pi
   use ehl_status, only: ehl_bad_input, ehl_no_memory, status_t
   use ehl_surface, only: surface_t
   implicit none (type, external)
   private
   public :: height_map_t

   !> The tile is refined along X this many times by its Fourier series, and between these points a
   !> polynomial of degree 5 is used: its error is 2e-5 of the amplitude of the shortest wave of
   !> the tile (two pixels), and falls with the sixth power of the wavelength
   integer, parameter :: refinement = 8
   integer, parameter :: points = 6

   !> Tile of heights; pixel (1, 1) lies on the front, at Y = 0
   type, extends(surface_t) :: height_map_t
      !> Tile length along Y [a]
      real(dp) :: length_y = 0.0_dp
      !> Heights of the tile [a^2/R], X first
      real(dp), allocatable :: tile(:, :)
      !> Refined heights on the rows of the grid: (refinement*pixels + points - 1, ny), the
      !> first of them repeated at the end
      real(dp), allocatable, private :: refined(:, :)
   contains
      procedure :: setup
      procedure :: height
   end type height_map_t

contains

   !> Take a tile of heights [a^2/R] of size length_x by length_y [a]; the front fades over front_length
   subroutine setup(self, tile, length_x, length_y, velocity_ratio, x_start, front_length, status)
      class(height_map_t), intent(inout) :: self
      real(dp), intent(in) :: tile(:, :)
      real(dp), intent(in) :: length_x, length_y, velocity_ratio, x_start, front_length
      type(status_t), intent(inout) :: status

      if (size(tile, 1) < 4 .or. size(tile, 2) < 4) then
         call status%fail(ehl_bad_input, "a height map needs at least 4 x 4 pixels")
         return
      end if
      self%tile = tile
      self%even_in_y = all(tile(:, 2:) == tile(:, size(tile, 2):2:-1))
      self%period = length_x
      self%length_y = length_y
      self%velocity_ratio = velocity_ratio
      self%x_start = x_start
      self%front_length = front_length
      if (allocated(self%refined)) deallocate (self%refined)
   end subroutine setup

   !> Roughness at the nodes, at time T; the same shift for every row, so that the
   !> weights of the interpolation are found once
   subroutine height(self, grid, time, rr)
      class(height_map_t), intent(inout) :: self
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: time
      real(dp), intent(out) :: rr(:, :)
      real(dp) :: distance, t, weight(points, grid%nx)
      integer :: i, j, k, n, first(grid%nx)

      if (.not. allocated(self%refined)) call refine(self, grid)
      n = refinement*size(self%tile, 1)
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

   !> Fourier series of the tile on the rows of the grid, refined along X
   subroutine refine(self, grid)
      class(height_map_t), intent(inout) :: self
      type(grid_t), intent(in) :: grid
      complex(c_double_complex), allocatable :: spectrum(:, :), rows(:, :)
      real(dp), allocatable :: values(:, :), copy(:, :)
      complex(dp) :: wave
      type(c_ptr) :: plan
      real(dp) :: angle
      integer :: nx, ny, j, k, half, n

      nx = size(self%tile, 1)
      ny = size(self%tile, 2)
      n = refinement*nx
      half = nx/2 + 1
      allocate (spectrum(half, ny), rows(n/2 + 1, grid%ny), values(n, grid%ny), copy(nx, ny))
      !$omp critical (ehl_fftw_plan)
      plan = fftw_plan_dft_r2c_2d(int(ny, c_int), int(nx, c_int), copy, spectrum, fftw_estimate)
      !$omp end critical (ehl_fftw_plan)
      copy = self%tile
      call fftw_execute_dft_r2c(plan, copy, spectrum)
      !$omp critical (ehl_fftw_plan)
      call fftw_destroy_plan(plan)
      plan = fftw_plan_many_dft_c2r(1_c_int, [int(n, c_int)], int(grid%ny, c_int), rows, [int(n/2 + 1, c_int)], &
                                    1_c_int, int(n/2 + 1, c_int), values, [int(n, c_int)], 1_c_int, int(n, c_int), &
                                    fftw_estimate)
      !$omp end critical (ehl_fftw_plan)
      rows = (0.0_dp, 0.0_dp)
      do j = 1, grid%ny
         angle = 2.0_dp*pi*grid%y(j)/self%length_y
         do k = 0, ny - 1
            if (2*k == ny) then
               ! the shortest wave has no phase of its own: its real part
               wave = cos(angle*k)
            else
               wave = exp(cmplx(0.0_dp, angle*merge(k, k - ny, 2*k < ny), dp))
            end if
            rows(1:half, j) = rows(1:half, j) + wave*spectrum(:, k + 1)
         end do
      end do
      rows = rows/(real(nx, dp)*ny)
      if (mod(nx, 2) == 0) rows(half, :) = 0.5_dp*rows(half, :)
      call fftw_execute_dft_c2r(plan, rows, values)
      !$omp critical (ehl_fftw_plan)
      call fftw_destroy_plan(plan)
      !$omp end critical (ehl_fftw_plan)
      allocate (self%refined(n + points - 1, grid%ny))
      self%refined(1:n, :) = values
      self%refined(n + 1:, :) = values(1:points - 1, :)
   end subroutine refine
end module ehl_height_map

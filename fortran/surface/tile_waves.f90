! SPDX-License-Identifier: BSD-3-Clause
!> The waves of a periodic tile of heights, which need as much memory as the given heights: the spectrum of the tile; or, for a
!> map that becomes a tile with its mirror images, the cosine transform, a quarter of the spectrum of that tile
module ehl_tile_waves
   use, intrinsic :: iso_c_binding, only: c_double_complex
   use ehl_fftw_planner, only: to_cosines, to_spectrum
   use ehl_kinds, only: dp, pi
   use ehl_status, only: status_t
   use ehl_tile_filter, only: filter_spectrum, filter_t
   implicit none (type, external)
   private
   public :: tile_waves_t

   !> Waves exp(2 pi i (k x/length(1) + l y/length(2))); pixel (1, 1) lies at x = y = 0
   type :: tile_waves_t
      !> Pixels of the tile along X and Y, and its size; mirror images included
      integer :: pixels(2) = 0
      real(dp) :: length(2) = 0.0_dp
      !> Whether the tile is symmetric, the same at y and -y
      logical :: even_in_y = .false.
      logical, private :: mirrored = .false.
      !> Half spectrum (pixels/2 + 1, pixels), X first, see to_spectrum
      complex(c_double_complex), allocatable, private :: spectrum(:, :)
      !> Mirrored: amplitudes of the cosine waves with k, l = 0, 1, ... (pixels/2)
      real(dp), allocatable, private :: cosines(:, :)
   contains
      procedure :: take
      procedure :: cut
      procedure :: variance
      procedure :: mean_square_slope
      procedure :: correlation
      procedure :: column
      procedure :: transfer_to
      procedure :: are_present
      procedure :: bytes
   end type tile_waves_t

contains

   !> Compute the waves of heights times a scale, without the mean. Mirrored: the tile is the map with its mirror images, twice
   !> as long along X and Y, and its first column is the middle column of the map (the one after the middle for an even number).
   subroutine take(self, heights, scale, length, mirrored, status)
      class(tile_waves_t), intent(inout) :: self
      !> X first
      real(dp), intent(in) :: heights(:, :)
      real(dp), intent(in) :: scale
      !> Size of the tile
      real(dp), intent(in) :: length(2)
      logical, intent(in) :: mirrored
      type(status_t), intent(inout) :: status
      integer :: j

      if (status%failed()) return
      self%pixels = shape(heights)*merge(2, 1, mirrored)
      self%length = length
      self%mirrored = mirrored
      self%even_in_y = .true.
      do j = 1, self%pixels(2)/2
         self%even_in_y = .not. any(abs(heights(:, of_map(self, j)) - heights(:, of_map(self, -j))) > 0.0_dp)
         if (.not. self%even_in_y) exit
      end do
      if (mirrored) then
         call to_cosines(heights, self%cosines, status)
         if (status%failed()) return
         do j = 1, size(self%cosines, 2)
            self%cosines(:, j) = self%cosines(:, j)*scale
         end do
         self%cosines(1, 1) = 0.0_dp
      else
         call to_spectrum(heights, self%spectrum, status)
         if (status%failed()) return
         do j = 1, self%pixels(2)
            self%spectrum(:, j) = self%spectrum(:, j)*scale
         end do
         self%spectrum(1, 1) = (0.0_dp, 0.0_dp)
      end if
   end subroutine take

   !> Column of the given heights, counted from 1, at column j of the tile, counted from 0
   elemental integer function of_map(self, j)
      class(tile_waves_t), intent(in) :: self
      integer, intent(in) :: j

      if (self%mirrored) then
         of_map = modulo(j + self%pixels(2)/4, self%pixels(2))
         of_map = min(of_map, self%pixels(2) - 1 - of_map) + 1
      else
         of_map = modulo(j, self%pixels(2)) + 1
      end if
   end function of_map

   !> Filter the waves
   subroutine cut(self, filter)
      class(tile_waves_t), intent(inout) :: self
      type(filter_t), intent(in) :: filter
      integer :: i, j

      if (filter%passes_all()) return
      if (.not. self%mirrored) then
         call filter_spectrum(filter, self%spectrum, self%length(1), self%length(2))
         return
      end if
      do j = 1, size(self%cosines, 2)
         do i = 1, size(self%cosines, 1)
            self%cosines(i, j) = self%cosines(i, j) &
                                 *filter%transmission(2.0_dp*pi*hypot((i - 1)/self%length(1), (j - 1)/self%length(2)))
         end do
      end do
   end subroutine cut

   !> Variance of the waves with at most `max_order` periods in the tile along X and along Y
   pure real(dp) function variance(self, max_order)
      class(tile_waves_t), intent(in) :: self
      integer, intent(in) :: max_order(2)
      real(dp) :: sums(self%pixels(2))
      integer :: j, last, nx, ny

      nx = self%pixels(1)
      ny = self%pixels(2)
      sums = 0.0_dp
      if (self%mirrored) then
         last = min(nx/2, max_order(1) + 1)
         do j = 1, min(ny/2, max_order(2) + 1)
            ! waves with q and -q along X, then along Y
            sums(j) = 2.0_dp*sum(self%cosines(:last, j)**2) - self%cosines(1, j)**2
            if (j > 1) sums(j) = 2.0_dp*sums(j)
         end do
      else
         last = min(nx/2, max_order(1)) + 1
         do j = 1, ny
            if (min(j - 1, ny + 1 - j) > max_order(2)) cycle
            ! components with q_x < 0 are not stored
            sums(j) = 2.0_dp*sum(self%spectrum(:last, j)%re**2 + self%spectrum(:last, j)%im**2) - abs(self%spectrum(1, j))**2
            if (2*(last - 1) == nx) sums(j) = sums(j) - abs(self%spectrum(last, j))**2
         end do
      end if
      variance = sum(sums)
   end function variance

   !> Mean square of the gradient of the heights
   pure real(dp) function mean_square_slope(self)
      class(tile_waves_t), intent(in) :: self
      real(dp) :: sums(self%pixels(2))
      integer :: i, j, l, nx, ny

      nx = self%pixels(1)
      ny = self%pixels(2)
      sums = 0.0_dp
      if (self%mirrored) then
         do j = 1, ny/2
            do i = 1, nx/2
               sums(j) = sums(j) + merge(2, 1, i > 1)*merge(2, 1, j > 1)*self%cosines(i, j)**2*square(i - 1, j - 1)
            end do
         end do
      else
         do j = 1, ny
            l = min(j - 1, ny + 1 - j)
            do i = 1, nx/2 + 1
               ! components with q_x < 0 are not stored
               sums(j) = sums(j) + merge(2, 1, i > 1 .and. 2*(i - 1) < nx)*abs(self%spectrum(i, j))**2*square(i - 1, l)
            end do
         end do
      end if
      mean_square_slope = sum(sums)

   contains

      !> |q|^2 of a wave with k and l periods in the tile along X and along Y
      pure real(dp) function square(k, l)
         integer, intent(in) :: k, l
         square = (2.0_dp*pi)**2*((k/self%length(1))**2 + (l/self%length(2))**2)
      end function square
   end function mean_square_slope

   !> Correlation of the heights of two tiles of the same size, and of their gradients, in [-1, 1], from the waves that both have;
   !> ahead: distance along X by which the other tile is ahead
   pure function correlation(self, other, ahead) result(both)
      class(tile_waves_t), intent(in) :: self
      type(tile_waves_t), intent(in) :: other
      real(dp), intent(in) :: ahead
      real(dp) :: both(2)
      complex(c_double_complex) :: a(-(min(self%pixels(2), other%pixels(2))/2):min(self%pixels(2), other%pixels(2))/2)
      complex(c_double_complex) :: b(-(min(self%pixels(2), other%pixels(2))/2):min(self%pixels(2), other%pixels(2))/2)
      real(dp) :: sums(3, 2), terms(3, size(a)), squares(size(a))
      integer :: k, l, max_order

      max_order = size(a)/2
      sums = 0.0_dp
      do k = 0, min(self%pixels(1), other%pixels(1))/2
         call self%column(k, max_order, a)
         call other%column(k, max_order, b)
         b = b*turned(-2.0_dp*k*ahead/self%length(1))
         squares = [((k/self%length(1))**2 + (l/self%length(2))**2, l=-max_order, max_order)]
         terms(1, :) = a%re*b%re + a%im*b%im
         terms(2, :) = a%re**2 + a%im**2
         terms(3, :) = b%re**2 + b%im**2
         sums(:, 1) = sums(:, 1) + merge(2.0_dp, 1.0_dp, k > 0)*sum(terms, dim=2)
         sums(:, 2) = sums(:, 2) + merge(2.0_dp, 1.0_dp, k > 0)*matmul(terms, squares)
      end do
      both = 0.0_dp
      where (sums(2, :)*sums(3, :) > 0.0_dp) both = sums(1, :)/(sqrt(sums(2, :))*sqrt(sums(3, :)))
   end function correlation

   !> The waves with k periods along X and -max_order ... max_order along Y; half of the shortest (Nyquist) wave, which belongs to
   !> both q and -q
   pure subroutine column(self, k, max_order, values)
      class(tile_waves_t), intent(in) :: self
      integer, intent(in) :: k, max_order
      complex(c_double_complex), intent(out) :: values(-max_order:max_order)
      real(dp) :: along
      integer :: l

      if (self%mirrored) then
         values = (0.0_dp, 0.0_dp)
         ! a cosine series has no Nyquist wave
         if (2*k >= self%pixels(1)) return
         along = real(k, dp)/self%pixels(1)
         do l = -min(max_order, self%pixels(2)/2 - 1), min(max_order, self%pixels(2)/2 - 1)
            values(l) = self%cosines(k + 1, abs(l) + 1)*turned(along + l*(2*(self%pixels(2)/4) + 1)/real(self%pixels(2), dp))
         end do
      else
         do l = -max_order, max_order
            values(l) = self%spectrum(k + 1, modulo(l, self%pixels(2)) + 1)
         end do
         if (2*max_order == self%pixels(2)) values([-max_order, max_order]) = 0.5_dp*values([-max_order, max_order])
         if (2*k == self%pixels(1)) values = 0.5_dp*values
      end if
   end subroutine column

   !> exp(i pi t)
   elemental complex(c_double_complex) function turned(t)
      real(dp), intent(in) :: t
      turned = cmplx(cos(pi*modulo(t, 2.0_dp)), sin(pi*modulo(t, 2.0_dp)), c_double_complex)
   end function turned

   !> Transfer the waves to another tile
   subroutine transfer_to(self, other)
      class(tile_waves_t), intent(inout) :: self
      type(tile_waves_t), intent(inout) :: other

      other%pixels = self%pixels
      other%length = self%length
      other%even_in_y = self%even_in_y
      other%mirrored = self%mirrored
      call move_alloc(self%spectrum, other%spectrum)
      call move_alloc(self%cosines, other%cosines)
   end subroutine transfer_to

   !> Whether the waves have not been transferred
   pure logical function are_present(self)
      class(tile_waves_t), intent(in) :: self
      are_present = allocated(self%spectrum) .or. allocated(self%cosines)
   end function are_present

   !> Allocated bytes; after a transfer those before it
   pure real(dp) function bytes(self)
      class(tile_waves_t), intent(in) :: self

      if (self%mirrored) then
         bytes = 2.0_dp*self%pixels(1)*real(self%pixels(2), dp)
      else
         bytes = 16.0_dp*(self%pixels(1)/2 + 1)*real(self%pixels(2), dp)
      end if
   end function bytes
end module ehl_tile_waves

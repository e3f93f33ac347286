! SPDX-License-Identifier: BSD-3-Clause
!> Harmonic waviness (Zhang et al. 2019, eq. 15)
module ehl_harmonic
   use ehl_grid, only: grid_t
   use ehl_kinds, only: dp, pi
   use ehl_surface, only: aliased_below, surface_t
   implicit none (type, external)
   private
   public :: new_harmonic, endless

   !> Wavelength along Y of a wave that does not vary along Y [a]
   real(dp), parameter :: endless = 1.0e30_dp

   !> RR = A_i 10^(-10 max(0, (X - X_f)/lambda_x)^2) cos(2 pi (X - X_f)/lambda_x) cos(2 pi Y/lambda_y), with its front at
   !> X_f
   type, extends(surface_t) :: harmonic_t
      !> Wavelengths [a]
      real(dp) :: wavelength_x = 0.5_dp, wavelength_y = 0.5_dp
   contains
      procedure :: height
      procedure :: unresolved
      procedure :: rms_height
      procedure :: rms_slope
      procedure :: correlation
   end type harmonic_t

contains

   !> A waviness; wavelengths and x_start in Hertz radii, amplitude scaled by a^2/R
   pure function new_harmonic(amplitude, wavelength_x, wavelength_y, velocity_ratio, x_start) result(self)
      real(dp), intent(in) :: amplitude, wavelength_x, wavelength_y, velocity_ratio, x_start
      type(harmonic_t) :: self

      self%amplitude = amplitude
      self%wavelength_x = wavelength_x
      self%wavelength_y = wavelength_y
      self%velocity_ratio = velocity_ratio
      self%x_start = x_start
      self%period = wavelength_x
      if (wavelength_y < endless) self%period_y = wavelength_y
      self%front_length = wavelength_x
   end function new_harmonic

   !> Unresolved fraction of the variance: 0 or 1, because there is one wave
   pure real(dp) function unresolved(self, grid, nodes)
      class(harmonic_t), intent(in) :: self
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: nodes
      real(dp) :: has(2)

      has = [self%wavelength_x, self%wavelength_y]/self%meshes(grid)
      unresolved = 0.0_dp
      if (any(has < nodes) .or. any(has <= aliased_below)) unresolved = 1.0_dp
   end function unresolved

   !> Rms height of a product of two cosines, or of one cosine
   pure real(dp) function rms_height(self)
      class(harmonic_t), intent(in) :: self
      rms_height = 0.5_dp*self%amplitude
      if (.not. self%wavelength_y < endless) rms_height = sqrt(2.0_dp)*rms_height
   end function rms_height

   !> Correlation of two equal waves from their distance along X; 0 for different waves
   pure function correlation(self, other) result(both)
      class(harmonic_t), intent(in) :: self
      class(surface_t), intent(in) :: other
      real(dp) :: both(2)

      both = 0.0_dp
      select type (other)
      class is (harmonic_t)
         if (abs(self%wavelength_x - other%wavelength_x) > 1.0e-9_dp*self%wavelength_x) return
         if (abs(self%wavelength_y - other%wavelength_y) > 1.0e-9_dp*self%wavelength_y) return
         both = cos(2.0_dp*pi*(other%x_start - self%x_start)/self%wavelength_x)
      end select
   end function correlation

   !> Rms slope of a product of two cosines, or of one cosine
   pure real(dp) function rms_slope(self)
      class(harmonic_t), intent(in) :: self
      rms_slope = self%rms_height()*hypot(2.0_dp*pi/self%wavelength_x, 2.0_dp*pi/self%wavelength_y)
   end function rms_slope

   !> Roughness at the nodes, at time T
   subroutine height(self, grid, time, rr)
      class(harmonic_t), intent(inout) :: self
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: time
      real(dp), intent(out) :: rr(:, :)
      real(dp) :: along(grid%nx), distance
      integer :: i, j

      do i = 1, grid%nx
         distance = grid%x(i) - self%front_position(time)
         along(i) = self%amplitude*self%front_factor(distance)*cos(2.0_dp*pi*distance/self%wavelength_x)
      end do
      do j = 1, grid%ny
         rr(:, j) = along*cos(2.0_dp*pi*grid%y(j)/self%wavelength_y)
      end do
   end subroutine height
end module ehl_harmonic

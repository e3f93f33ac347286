! SPDX-License-Identifier: BSD-3-Clause
!> Roughness of one surface, moving or stationary: interface of all kinds
module ehl_surface
   use ehl_grid, only: grid_t
   use ehl_kinds, only: dp
   use ehl_status, only: status_t
   implicit none (type, external)
   private
   public :: surface_t, aliased_below, resolved_from, x_matters, x_filled

   !> A wave with at most `aliased_below` nodes per period would be aliased by the grid and is omitted; a wave with at least
   !> `resolved_from` nodes per period is resolved.
   real(dp), parameter :: aliased_below = 2.0_dp, resolved_from = 8.0_dp
   !> The roughness matters downstream of this X; further upstream the film is too thick
   real(dp), parameter :: x_matters = -1.25_dp
   !> The roughness fills the contact when its front has passed this X
   real(dp), parameter :: x_filled = 1.05_dp

   !> Roughness RR(X, Y, T), scaled by a^2/R, peaks positive, that moves along X with
   !> velocity_ratio times the mean velocity and enters behind a front at
   !> X = x_start + velocity_ratio T. Stationary roughness (velocity_ratio 0) is everywhere, with its origin at X = x_start.
   type, abstract :: surface_t
      !> Velocity of the rough surface over the mean velocity
      real(dp) :: velocity_ratio = 1.01_dp
      !> Position of the front at T = 0 [a]
      real(dp) :: x_start = -2.5_dp
      !> Length after which the pattern repeats along X [a]
      real(dp) :: period = 0.0_dp
      !> Length over which the front fades [a]
      real(dp) :: front_length = 0.0_dp
      !> Whether it passes the contact once; `period` is then the distance from x_matters until it has left
      logical :: passes_once = .false.
      !> Whether RR(X, -Y) = RR(X, Y) to the bit, so that half the domain suffices
      logical :: even_in_y = .true.
      !> Length after which the pattern repeats along Y [a]; 0: it does not vary or does not repeat
      real(dp) :: period_y = 0.0_dp
      !> Amplitude A_i of a wave, height or depth of a feature [a^2/R]; negative: it has none
      real(dp) :: amplitude = -1.0_dp
      !> Variance of the heights [(a^2/R)^2], and that before filtering; 0: not known
      real(dp) :: variance = 0.0_dp, variance_whole = 0.0_dp
      !> Root mean square of the gradient of the heights [a/R]; 0: not known
      real(dp) :: slope = 0.0_dp
      !> Threads to use; the heights do not depend on it
      integer :: threads = 1
   contains
      !> Roughness on a grid at a time
      procedure(height_i), deferred :: height
      !> Fraction of the variance in waves that a grid does not resolve
      procedure(unresolved_i), deferred :: unresolved
      procedure :: prepare
      procedure :: transfer
      procedure :: reclaim
      procedure :: meshes
      procedure :: bytes
      procedure :: rms_height
      procedure :: rms_slope
      procedure :: correlation
      procedure :: bytes_on
      !> Position of the front at time T
      procedure :: front_position
      !> Time in which the pattern repeats
      procedure :: time_period
      procedure :: at_rest
      procedure :: time_near
      procedure :: time_to_mean
      procedure :: front_factor
   end type surface_t

   abstract interface
      !> rr(nx, ny) = RR at the nodes, at time T
      subroutine height_i(self, grid, time, rr)
         import :: surface_t, grid_t, dp
         implicit none (type, external)
         class(surface_t), intent(inout) :: self
         type(grid_t), intent(in) :: grid
         real(dp), intent(in) :: time
         real(dp), intent(out) :: rr(:, :)
      end subroutine height_i

      !> Fraction of the variance in waves with fewer nodes per period than `nodes` along X or Y, counted in space
      !> and in time (a step is a mesh size at the mean velocity). Waves with aliased_below nodes
      !> are included.
      pure real(dp) function unresolved_i(self, grid, nodes)
         import :: surface_t, grid_t, dp
         implicit none (type, external)
         class(surface_t), intent(in) :: self
         type(grid_t), intent(in) :: grid
         real(dp), intent(in) :: nodes
      end function unresolved_i
   end interface

contains

   !> Prepare for a grid; call once before heights are computed
   subroutine prepare(self, grid, status)
      class(surface_t), intent(inout) :: self
      type(grid_t), intent(in) :: grid
      type(status_t), intent(inout) :: status

      associate (unused => self, unused_grid => grid, unused_status => status)
      end associate
   end subroutine prepare

   !> Make a copy of this surface for another grid; this one remains prepared for its grid
   subroutine transfer(self, other)
      class(surface_t), intent(inout) :: self
      class(surface_t), allocatable, intent(out) :: other

      allocate (other, source=self)
   end subroutine transfer

   !> Take back the data that was transferred to a surface that is no longer needed
   subroutine reclaim(self, other)
      class(surface_t), intent(inout) :: self, other

      associate (unused => self, unused_other => other)
      end associate
   end subroutine reclaim

   !> Allocated bytes
   pure real(dp) function bytes(self)
      class(surface_t), intent(in) :: self
      associate (unused => self)
      end associate
      bytes = 0.0_dp
   end function bytes

   !> Root mean square of the heights [a^2/R]; 0 if it is not known or not defined
   pure real(dp) function rms_height(self)
      class(surface_t), intent(in) :: self
      rms_height = sqrt(self%variance)
   end function rms_height

   !> Root mean square of the gradient of the heights [a/R]; 0 if it is not known or not defined
   pure real(dp) function rms_slope(self)
      class(surface_t), intent(in) :: self
      rms_slope = self%slope
   end function rms_slope

   !> Correlation of its heights and of its gradients with those of another surface at the same velocity; 0 if it is
   !> not known, or for uncorrelated surfaces
   pure function correlation(self, other) result(both)
      class(surface_t), intent(in) :: self
      class(surface_t), intent(in) :: other
      real(dp) :: both(2)

      associate (unused => self, unused_other => other)
      end associate
      both = 0.0_dp
   end function correlation

   !> Bytes required when prepared for a grid
   pure real(dp) function bytes_on(self, grid)
      class(surface_t), intent(in) :: self
      type(grid_t), intent(in) :: grid
      associate (unused => grid)
      end associate
      bytes_on = self%bytes()
   end function bytes_on

   !> Sampling distances of waves along X, in space or in time, and along Y [a]
   pure function meshes(self, grid)
      class(surface_t), intent(in) :: self
      type(grid_t), intent(in) :: grid
      real(dp) :: meshes(2)
      meshes = [grid%hx*max(1.0_dp, self%velocity_ratio), grid%hy]
   end function meshes

   !> x_start + velocity_ratio T
   elemental real(dp) function front_position(self, time)
      class(surface_t), intent(in) :: self
      real(dp), intent(in) :: time
      front_position = self%x_start + self%velocity_ratio*time
   end function front_position

   !> period/velocity_ratio; of a feature the time of the passage
   elemental real(dp) function time_period(self)
      class(surface_t), intent(in) :: self
      time_period = self%period/self%velocity_ratio
   end function time_period

   !> Whether the surface does not move
   pure logical function at_rest(self)
      class(surface_t), intent(in) :: self
      at_rest = .not. abs(self%velocity_ratio) > 0.0_dp
   end function at_rest

   !> Time at which the front, with half its length, reaches x_matters
   pure real(dp) function time_near(self)
      class(surface_t), intent(in) :: self
      time_near = (x_matters - 0.5_dp*self%front_length - self%x_start)/self%velocity_ratio
   end function time_near

   !> Time from a given time until friction counts for the mean: roughness fills the contact, or a feature approaches it
   pure real(dp) function time_to_mean(self, time)
      class(surface_t), intent(in) :: self
      real(dp), intent(in) :: time
      time_to_mean = (merge(x_matters, x_filled, self%passes_once) - self%front_position(time))/self%velocity_ratio
   end function time_to_mean

   !> Factor of the roughness at a distance d ahead of the front (Zhang et al. 2019, eq. 15): 10^(-10 max(0, d/length)^2);
   !> stationary roughness has no front
   elemental real(dp) function front_factor(self, distance)
      class(surface_t), intent(in) :: self
      real(dp), intent(in) :: distance
      front_factor = 1.0_dp
      if (.not. self%at_rest()) front_factor = 10.0_dp**(-10.0_dp*max(0.0_dp, distance/self%front_length)**2)
   end function front_factor
end module ehl_surface

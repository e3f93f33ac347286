! SPDX-License-Identifier: BSD-3-Clause
!> Heights and slopes of the rough surfaces of a contact, and what of them a grid carries
submodule (ehl_moving_surfaces) ehl_statistics
   use ehl_surface, only: aliased_below, resolved_from
   implicit none (type, external)

contains

   pure logical module function has_spectrum(self)
      class(moving_surfaces_t), intent(in) :: self
      integer :: k
      has_spectrum = any([(self%of(k)%surface%variance > 0.0_dp, k=1, self%count())])
   end function has_spectrum

   pure logical module function same_on_grids(self)
      class(moving_surfaces_t), intent(in) :: self
      integer :: k
      same_on_grids = all([(self%of(k)%surface%amplitude > 0.0_dp, k=1, self%count())])
   end function same_on_grids

   module subroutine see(self, grid)
      class(moving_surfaces_t), intent(inout) :: self
      type(grid_t), intent(in) :: grid

      self%left_out = share_unresolved(self, grid, aliased_below)
      self%unresolved = share_unresolved(self, grid, resolved_from)
   end subroutine see

   !> Share of the variance of all in waves with fewer nodes a period than that; where a variance is not known the
   !> largest share of one
   pure real(dp) function share_unresolved(self, grid, nodes)
      type(moving_surfaces_t), intent(in) :: self
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: nodes
      real(dp) :: variance(self%count()), share(self%count())
      integer :: k

      do k = 1, self%count()
         share(k) = self%of(k)%surface%unresolved(grid, nodes)
         variance(k) = self%of(k)%surface%rms_height()**2
      end do
      share_unresolved = maxval(share)
      if (self%count() > 1 .and. all(variance > 0.0_dp)) share_unresolved = sum(variance*share)/sum(variance)
   end function share_unresolved

   pure real(dp) module function most_unresolved(self, grid, nodes)
      class(moving_surfaces_t), intent(in) :: self
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: nodes
      integer :: k

      most_unresolved = 0.0_dp
      do k = 1, self%count()
         most_unresolved = max(most_unresolved, self%of(k)%surface%unresolved(grid, nodes))
      end do
   end function most_unresolved

   pure real(dp) module function rms_height(self)
      class(moving_surfaces_t), intent(in) :: self
      integer :: k

      rms_height = 0.0_dp
      do k = 1, self%count()
         rms_height = hypot(rms_height, self%of(k)%surface%rms_height())
      end do
   end function rms_height

   pure real(dp) module function rms_slope(self)
      class(moving_surfaces_t), intent(in) :: self
      integer :: k

      rms_slope = 0.0_dp
      do k = 1, self%count()
         rms_slope = hypot(rms_slope, self%of(k)%surface%rms_slope())
      end do
   end function rms_slope
end submodule ehl_statistics

! SPDX-License-Identifier: BSD-3-Clause
!> Oil that passes a contact whose inlet is short of it (supply.f90): what comes, what leaves behind and at the sides
module ehl_oil_flow
   use ehl_kinds, only: dp
   use ehl_level, only: last_flowing, level_t
   use ehl_reynolds, only: flow_operator
   implicit none (type, external)
   private
   public :: oil_flow_t, measure_flow, flow_tolerance, leaving

   !> Largest imbalance of a solution
   real(dp), parameter :: flow_tolerance = 1.0e-6_dp

   !> Flows per time, int rho H dY at the mean velocity [a^3/R]; of a line per length
   type :: oil_flow_t
      real(dp) :: enters = 0.0_dp, leaves = 0.0_dp, sides = 0.0_dp
      !> What is gained or lost on the way, over what enters; 0 where the inlet is flooded
      real(dp) :: imbalance = 0.0_dp
      !> Whether the layer fills the gap at the border of the domain
      logical :: fills_border = .false.
      !> Of a line: how much thinner than at its nodes the film may be between two of them [a^2/R]
      real(dp) :: between = 0.0_dp
   end type oil_flow_t

contains

   !> Balance of the present state, from behind the second column on
   function measure_flow(level) result(flow)
      type(level_t), intent(in) :: level
      type(oil_flow_t) :: flow
      real(dp), dimension(level%grid%ny) :: first, last, side
      integer :: j

      if (.not. level%supply%active) return
      first = 0.0_dp
      last = 0.0_dp
      side = 0.0_dp
      associate (grid => level%grid)
         do j = grid%first_inner(), grid%last_inner()
            call ends_of_row(level, j, first(j), last(j))
            first(j) = first(j)*grid%weight(j)/grid%hx
            last(j) = last(j)*grid%weight(j)/grid%hx
            if (grid%is_row()) cycle
            if (grid%is_border(grid%south(j))) side(j) = side(j) &
               + level%poiseuille%across(level%p, level%flow, j, grid%south(j))*grid%images(j)
            if (grid%is_border(grid%north(j))) side(j) = side(j) &
               + level%poiseuille%across(level%p, level%flow, j, grid%north(j))*grid%images(j)
         end do
         flow%fills_border = level%supply%held == 1 .and. .not. level%supply%short > 0.0_dp
         if (level%supply%held == 0) then
            flow%fills_border = any(level%supply%layer > 0.5_dp*(level%mass_content(1, :) + level%mass_content(2, :)))
         end if
      end associate
      flow%enters = sum(first)
      flow%leaves = sum(last)
      flow%sides = sum(side)
      if (level%grid%is_row()) flow%between = between(level%h(:, 1))
      ! a line that is not flooded has to let all through
      if (level%supply%held > 0) flow%enters = level%supply%layer(1)
      if (flow%fills_border .and. level%supply%held > 0) flow%enters = min(flow%enters, flow%leaves)
      flow%imbalance = (flow%enters - flow%leaves - flow%sides)/max(flow%enters, tiny(1.0_dp))
   end function measure_flow

   !> The same of the nodes of a row, each with the curvature there
   pure real(dp) function between(h)
      real(dp), intent(in) :: h(:)
      integer :: n

      n = size(h)
      between = minval(h) - minval(h(2:n - 1) - max(0.0_dp, h(:n - 2) - 2.0_dp*h(2:n - 1) + h(3:))/8.0_dp)
   end function between

   !> rho H times the fill fraction behind the contact, by row
   function leaving(level) result(layer)
      type(level_t), intent(in) :: level
      real(dp) :: layer(level%grid%ny)
      real(dp) :: first
      integer :: j

      layer = level%supply%layer
      do j = level%grid%first_inner(), level%grid%last_inner()
         call ends_of_row(level, j, first, layer(j))
      end do
   end function leaving

   !> Flow through row j behind the second column and behind the last one
   subroutine ends_of_row(level, j, first, last)
      type(level_t), intent(in) :: level
      integer, intent(in) :: j
      real(dp), intent(out) :: first, last
      real(dp) :: values(level%grid%nx)
      logical :: passing(level%grid%nx)

      call flow_operator(level, j, values, passing)
      first = through(2)
      if (level%supply%held > 0) then
         ! where the film ruptures
         last = through(last_flowing(level%p(:, j)))
      else
         last = through(level%grid%nx - 1)
      end if

   contains

      !> Through the east face of node i: of a filled gap less what is missing, and what the pressure drives
      real(dp) function through(i)
         integer, intent(in) :: i

         associate (hx => level%grid%hx, m => level%mass_content(:, j))
            through = hx*dot_product(level%wedge%weights(i, .true.), [m(i), m(i - 1), 0.0_dp]) &
                      + level%poiseuille%through_east(level%p, level%flow, i, j)
            if (passing(i)) through = through + hx*values(i)
         end associate
      end function through
   end subroutine ends_of_row
end module ehl_oil_flow

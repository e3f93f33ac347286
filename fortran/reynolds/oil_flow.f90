! SPDX-License-Identifier: BSD-3-Clause
!> Oil flow through a starved contact (supply.f90): at the inlet, at the outlet and at the sides
module ehl_oil_flow
   use ehl_kinds, only: dp
   use ehl_level, only: last_flowing, level_t
   use ehl_reynolds, only: flow_operator
   implicit none (type, external)
   private
   public :: oil_flow_t, content_row, measure_flow, flow_tolerance, leaving, oil_names

   !> Maximum imbalance of a solution
   real(dp), parameter :: flow_tolerance = 1.0e-6_dp
   !> Columns of a history
   character(len=*), parameter :: oil_names(7) = [character(len=13) :: "oil_layer", "oil_in", "oil_out", "oil_at_sides", &
                                                  "oil_content", "oil_gain", "oil_imbalance"]

   !> Flows over the mean velocity of the case: int rho H dY of oil that moves at this velocity [a^3/R]; of a line contact per unit
   !> length
   type :: oil_flow_t
      real(dp) :: enters = 0.0_dp, leaves = 0.0_dp, sides = 0.0_dp
      !> Imbalance over the flow that enters; 0 where the inlet is flooded. In a time step at least over the flow of the
      !> layer, or of the minimum rho H of each row if that is less, at the mean velocity of the case.
      real(dp) :: imbalance = 0.0_dp
      !> Oil between the faces where it enters and leaves in a time step, int rho H dX dY [a^4/R], and its time derivative
      real(dp) :: content = 0.0_dp, gain = 0.0_dp
      !> Whether the layer fills the gap at the border of the domain
      logical :: fills_border = .false.
      !> Of a line contact: by how much the film between two nodes may be thinner than at the nodes [a^2/R]
      real(dp) :: between = 0.0_dp
   end type oil_flow_t

contains

   !> Balance of the present state, from the east face of the second column to the east face of last_counted
   function measure_flow(level) result(flow)
      type(level_t), intent(in) :: level
      type(oil_flow_t) :: flow
      real(dp), dimension(level%grid%ny) :: first, last, side, held, gain, min_flow
      real(dp) :: content(level%grid%nx)
      integer :: j, n

      if (.not. level%supply%active) return
      first = 0.0_dp
      last = 0.0_dp
      side = 0.0_dp
      held = 0.0_dp
      gain = 0.0_dp
      min_flow = 0.0_dp
      associate (grid => level%grid)
         n = last_counted(level)
         do j = grid%first_inner(), grid%last_inner()
            call ends_of_row(level, j, first(j), last(j))
            first(j) = first(j)*grid%weight(j)/grid%hx
            last(j) = last(j)*grid%weight(j)/grid%hx
            call content_row(level, j, content)
            held(j) = grid%weight(j)*sum(content(3:grid%nx - 2))
            if (level%wedge%squeeze > 0.0_dp) then
               gain(j) = grid%weight(j)*sum(level%wedge%squeeze*content(3:n) + level%rhs(3:n, j))
               min_flow(j) = grid%weight(j)/grid%hx*min(level%supply%layer(j), minval(level%mass_content(:, j)))
            end if
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
      ! a starved line contact passes all oil
      if (level%supply%held > 0) flow%enters = level%supply%layer(1)
      if (flow%fills_border .and. level%supply%held > 0) flow%enters = min(flow%enters, flow%leaves)
      flow%content = sum(held)
      flow%gain = sum(gain)
      flow%imbalance = (flow%enters - flow%leaves - flow%sides - flow%gain)/max(flow%enters, sum(min_flow), tiny(1.0_dp))
   end function measure_flow

   !> Column through whose east face the oil leaves. In time steps this face is as far from the outlet border as the face of entry
   !> from the inlet border, so that a reversal of the motion does not change the oil between them.
   pure integer function last_counted(level)
      type(level_t), intent(in) :: level
      last_counted = level%grid%nx - merge(2, 1, level%wedge%squeeze > 0.0_dp)
   end function last_counted

   !> Oil at the nodes of row j: rho H minus the deficit where oil does not fill the gap
   subroutine content_row(level, j, content)
      type(level_t), intent(in) :: level
      integer, intent(in) :: j
      !> Shape (nx)
      real(dp), intent(out) :: content(:)
      real(dp), dimension(level%grid%nx) :: values, short

      content = level%mass_content(:, j)
      if (.not. level%supply%active) return
      call flow_operator(level, j, values, short=short)
      content = content - short
   end subroutine content_row

   !> By how much a film is thinner between the nodes of a row, from its curvature
   pure real(dp) function between(h)
      real(dp), intent(in) :: h(:)
      integer :: n

      n = size(h)
      between = minval(h) - minval(h(2:n - 1) - max(0.0_dp, h(:n - 2) - 2.0_dp*h(2:n - 1) + h(3:))/8.0_dp)
   end function between

   !> rho H times the fill fraction downstream of the contact, by row
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

   !> Flow in row j through the east faces of the second column and of last_counted, or of the last node with pressure where the
   !> meniscus is fixed
   subroutine ends_of_row(level, j, first, last)
      type(level_t), intent(in) :: level
      integer, intent(in) :: j
      real(dp), intent(out) :: first, last
      real(dp), dimension(level%grid%nx) :: values, missing

      call flow_operator(level, j, values, missing=missing)
      first = through(2)
      if (level%supply%held > 0) then
         ! where the film ruptures
         last = through(last_flowing(level%p(:, j)))
      else
         last = through(last_counted(level))
      end if

   contains

      !> Flow through the east face of node i: that of a filled gap minus the deficit, plus the Poiseuille flow
      real(dp) function through(i)
         integer, intent(in) :: i

         associate (hx => level%grid%hx, m => level%mass_content(:, j))
            through = hx*level%wedge%east_flow(m(i), m(i - 1)) + level%poiseuille%through_east(level%p, level%flow, i, j) &
                      - hx*missing(i)
         end associate
      end function through
   end subroutine ends_of_row
end module ehl_oil_flow

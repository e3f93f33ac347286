! SPDX-License-Identifier: BSD-3-Clause
!> Position of the meniscus of a line contact with a given oil layer. Without side flow the flow through the contact equals that of
!> the layer. A flow just below that of a flooded contact hardly depends on the position of the meniscus, so that a free meniscus
!> moves from cycle to cycle. Here it is fixed while the contact is solved as with `inlet.position`; the resulting flow gives the
!> next position:
!>
!>    node k with P(k) = 0, and the mass defect s downstream of it, 0 <= s <= (G(k) - layer)/hx, such that the flow is the layer's
!>
!> The flow decreases with k and s: k is bracketed by doubling steps and bisected, then s is found by the Illinois method.
module ehl_meniscus
   use ehl_kinds, only: dp
   use ehl_level, only: level_t
   use ehl_oil_flow, only: flow_tolerance
   implicit none (type, external)
   private
   public :: meniscus_t

   !> The flow is accepted when its change per cycle is below this fraction of its deviation, after a minimum number of cycles
   real(dp), parameter :: settled_change = 0.1_dp
   integer, parameter :: min_cycles = 3
   !> Upper bound of s over (G(k) - layer)/hx: the film at the meniscus changes with s
   real(dp), parameter :: s_margin = 1.2_dp
   !> Relative width of the bracket of s below which the search is restarted, since the film has changed
   real(dp), parameter :: same = 1.0e-12_dp

   type :: meniscus_t
      logical :: active = .false.
      !> Node k; s over its upper bound; the upper bound, in the units of the Reynolds operator
      integer :: node = 1
      real(dp) :: fraction = 0.0_dp
      real(dp), private :: s_max = 0.0_dp
      !> Bracket of the node; 0: not known. Length of the next step [nodes].
      integer, private :: low = 0, high = 0, step = 1
      !> Bracket of `fraction`, and the excess flow at its ends; the end that was kept in the last step
      real(dp), private :: fractions(2) = [0.0_dp, 1.0_dp], excess(2) = 0.0_dp
      integer, private :: stayed = 0
      !> Flow after the last cycle; cycles since the meniscus moved
      real(dp), private :: flow = 0.0_dp
      integer, private :: cycles = 0
   contains
      procedure :: begin
      procedure :: hold
      procedure :: follow
      procedure, private :: restart_search
      procedure, private :: search_node
      procedure, private :: search_fraction
      procedure, private :: pin
   end type meniscus_t

contains

   !> Start on a level, from the node of the solution on the next coarser level if there is one
   pure subroutine begin(self, from_coarser)
      class(meniscus_t), intent(inout) :: self
      logical, intent(in) :: from_coarser

      self%active = .true.
      self%node = merge(2*self%node - merge(0, 1, self%fraction > 0.5_dp), 1, from_coarser)
      call self%restart_search()
   end subroutine begin

   !> Restart the search from the present node
   pure subroutine restart_search(self)
      class(meniscus_t), intent(inout) :: self

      self%fraction = 0.0_dp
      self%low = 0
      self%high = 0
      self%step = 1
      self%cycles = 0
   end subroutine restart_search

   !> Fix the meniscus at its node
   subroutine hold(self, level)
      class(meniscus_t), intent(inout) :: self
      type(level_t), intent(inout) :: level

      level%supply%held = self%node
      level%supply%short = self%fraction*self%s_max
      level%p(:self%node, 1) = 0.0_dp
   end subroutine hold

   !> Move the meniscus after a cycle if the flow has converged and is not that of the layer
   subroutine follow(self, level, flow, moved)
      class(meniscus_t), intent(inout) :: self
      type(level_t), intent(inout) :: level
      !> Flow through the contact
      real(dp), intent(in) :: flow
      logical, intent(out) :: moved
      real(dp) :: deviation, change

      moved = .false.
      deviation = flow - level%supply%layer(1)
      change = abs(flow - self%flow)
      self%flow = flow
      self%cycles = self%cycles + 1
      if (self%cycles < min_cycles .or. change > settled_change*abs(deviation)) return
      if (abs(deviation) <= 0.5_dp*flow_tolerance*level%supply%layer(1)) return
      ! flooded
      if (self%node == 1 .and. deviation < 0.0_dp .and. .not. self%fraction > 0.0_dp) return
      if (self%high == self%low + 1 .and. self%low > 0) then
         call self%search_fraction(deviation)
      else
         call self%search_node(level, deviation)
      end if
      self%cycles = 0
      moved = .true.
      call self%hold(level)
   end subroutine follow

   !> Choose the next node; once two neighbours bracket the solution, the upstream one, with s
   subroutine search_node(self, level, deviation)
      class(meniscus_t), intent(inout) :: self
      type(level_t), intent(in) :: level
      real(dp), intent(in) :: deviation

      if (deviation > 0.0_dp) then
         self%low = self%node
         self%excess(1) = deviation
      else
         self%high = self%node
         self%excess(2) = deviation
      end if
      if (self%low == 0) then
         self%node = max(1, self%node - self%step)
      else if (self%high == 0) then
         self%node = min(self%node + self%step, next_gap(level, self%low))
      else
         self%node = (self%low + self%high)/2
      end if
      self%step = 2*self%step
      if (self%low > 0 .and. self%high == self%low + 1) call self%pin(level)
   end subroutine search_node

   !> Fix the node. s lies between 0 and the value at which the next node downstream has zero pressure.
   subroutine pin(self, level)
      class(meniscus_t), intent(inout) :: self
      type(level_t), intent(in) :: level

      self%node = self%low
      self%s_max = s_margin*(full_flow(level, self%node) - level%supply%layer(1))/level%grid%hx
      self%fractions = [0.0_dp, 1.0_dp]
      self%stayed = 0
      self%fraction = self%excess(1)/(self%excess(1) - self%excess(2))/s_margin
   end subroutine pin

   !> Next value of s by the Illinois method; too narrow a bracket restarts the search
   subroutine search_fraction(self, deviation)
      class(meniscus_t), intent(inout) :: self
      real(dp), intent(in) :: deviation
      integer :: side

      side = merge(1, 2, deviation > 0.0_dp)
      self%fractions(side) = self%fraction
      self%excess(side) = deviation
      if (self%stayed == 3 - side) self%excess(3 - side) = 0.5_dp*self%excess(3 - side)
      self%stayed = 3 - side
      if (self%fractions(2) - self%fractions(1) <= same) then
         call self%restart_search()
         return
      end if
      self%fraction = (self%fractions(1)*self%excess(2) - self%fractions(2)*self%excess(1))/(self%excess(2) - self%excess(1))
   end subroutine search_fraction

   !> Flow of a filled gap through the east face of node i
   pure real(dp) function full_flow(level, i)
      type(level_t), intent(in) :: level
      integer, intent(in) :: i

      associate (m => level%mass_content(:, 1))
         full_flow = 0.5_dp*(m(1) + m(2))
         if (i > 1) full_flow = 1.5_dp*m(i) - 0.5_dp*m(i - 1)
      end associate
   end function full_flow

   !> Next node downstream with at most half the gap: a film that begins too close to the contact breaks down
   pure integer function next_gap(level, node) result(i)
      type(level_t), intent(in) :: level
      integer, intent(in) :: node

      i = node + 1
      do while (full_flow(level, i) > 0.5_dp*full_flow(level, node) .and. level%grid%x(i + 1) < 0.0_dp)
         i = i + 1
      end do
   end function next_gap
end module ehl_meniscus

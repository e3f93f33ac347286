! SPDX-License-Identifier: BSD-3-Clause
!> Flow factors (factor_rows.f90) of the nodes of a grid, cached with their derivatives: near the cached sliding B and gradient
!> S, factors and stress are extrapolated to first order, with an error below 1e-4 in addition to that of factor_rows.f90
!> (more in coarse-grid corrections). Sweeps and cycles change B and S of most nodes so little that extrapolation suffices. Thus
!> factors depend on the history of the cache, until `forget`. Where the flow is Newtonian nothing is cached: memory access would
!> take longer than the test for this case.
module ehl_cached_factors
   use, intrinsic :: iso_fortran_env, only: int64, real32
   use ehl_factor_rows, only: factor_rows_t, find_factors, flows_newtonian
   use ehl_kinds, only: dp
   use ehl_thinning, only: eyring, max_nodes, thinning_t
   implicit none (type, external)
   private
   public :: cached_factors_t

   !> Maximum changes for extrapolation: of B relative to B + sliding_offset; of S, for Carreau relative to
   !> 1 + |S_x| + |S_y|. Where the curvature of F exceeds `weak_curvature` they are inversely proportional to it.
   !> Verified by test/test_flow.f90
   real(dp), parameter :: max_change = 0.01_dp, sliding_offset = 0.1_dp, weak_curvature = 0.15_dp
   !> Factor of these changes in a coarse-grid correction, where errors of a few per mille of the factors do not matter
   real(dp), parameter :: coarse_grid_ratio = 5.0_dp
   !> A component of S much below this changes the factors only by its square: a quotient by it would be dominated by rounding
   real(dp), parameter :: min_component = 0.05_dp
   !> B of a node without factors, different from any B >= 0: all nodes of a segment have factors, or none
   real(dp), parameter :: none = -1.0_dp
   !> Cached values of a node: B, S, phi and the stress; and in single precision, because memory bandwidth limits the speed,
   !> derivatives: those of ln(phi_x) and ln(phi_y) with respect to ln(B), to S_x and to S_y, the tangents of both directions, and
   !> those of the stress with respect to B, S_x and S_y
   integer, parameter :: f_b = 1, f_s = 2, f_phi = 4, f_stress = 6, fields = 6
   integer, parameter :: c_by_sliding = 1, c_by_x = 3, c_by_y = 5, c_tangent = 7, c_stress_by_sliding = 9, &
                         c_stress_by_gradient = 10, change_fields = 11

   type :: cached_factors_t
      type(thinning_t) :: law
      !> Whether factors are extrapolated for small changes (see `extrapolate`), and the maximum of these
      logical, private :: follows = .true.
      real(dp), private :: reach = 0.0_dp
      !> Whether the level is solved for a correction of a finer one, which allows larger changes
      logical :: correcting = .false.
      !> Number of nodes in a segment of a row, at most `max_nodes`
      integer :: width = 0
      !> Shape (node of the segment, field, segment, row)
      real(dp), allocatable, private :: values(:, :, :, :)
      real(real32), allocatable, private :: changes(:, :, :, :)
   contains
      procedure :: setup
      procedure :: extrapolate
      procedure :: forget
      procedure :: find
      procedure :: stress
      procedure :: film_exponent
      procedure :: bytes
   end type cached_factors_t

contains

   !> Allocate the cache of a grid
   subroutine setup(self, nx, ny, stat)
      class(cached_factors_t), intent(inout) :: self
      integer, intent(in) :: nx, ny
      !> 0 if the allocation succeeded
      integer, intent(out) :: stat
      integer :: blocks

      blocks = (nx - 1)/max_nodes + 1
      self%width = (nx - 1)/blocks + 1
      call self%extrapolate(self%follows)
      allocate (self%values(self%width, fields, blocks, ny), source=none, stat=stat)
      if (stat == 0) allocate (self%changes(self%width, change_fields, blocks, ny), source=0.0_real32, stat=stat)
      if (stat /= 0) self%width = 0
   end subroutine setup

   !> Extrapolate factors for small changes, or compute them again after any change; those of the other choice are discarded
   pure subroutine extrapolate(self, follows)
      class(cached_factors_t), intent(inout) :: self
      logical, intent(in) :: follows

      if (follows .neqv. self%follows) call self%forget()
      self%follows = follows
      self%reach = merge(max_change/max(1.0_dp, self%law%curvature()/weak_curvature), 0.0_dp, follows)
   end subroutine extrapolate

   !> Discard all factors: they are computed again when needed
   pure subroutine forget(self)
      class(cached_factors_t), intent(inout) :: self
      if (allocated(self%values)) self%values(:, f_b, :, :) = none
   end subroutine forget

   !> Factors of a segment of row j of size(b) nodes, their derivatives with respect to the sliding, and the tangent
   pure subroutine find(self, b, s, segment, j, rows, newtonian)
      class(cached_factors_t), intent(inout) :: self
      !> B >= 0, and S along X and along Y of as many nodes, or more, shape (nodes, 2)
      real(dp), contiguous, intent(in) :: b(:), s(:, :)
      integer, intent(in) :: segment, j
      type(factor_rows_t), intent(inout) :: rows
      !> Whether the whole segment flows as a Newtonian lubricant; `rows` is not changed in this case
      logical, intent(out) :: newtonian
      type(factor_rows_t) :: found
      real(dp) :: beyond(max_nodes), ss(max_nodes, 2), reach, relative, bound
      integer :: i, n, outside, from, to

      n = size(b)
      newtonian = flows_newtonian(self%law, b, s)
      if (newtonian) then
         ! film_exponent would use the cached values of another state
         if (self%values(1, f_b, segment, j) > none) self%values(:n, f_b, segment, j) = none
         return
      end if
      reach = self%reach*merge(coarse_grid_ratio, 1.0_dp, self%correcting)
      relative = merge(0.0_dp, reach, self%law%law == eyring)
      associate (cached => self%values(:, :, segment, j))
         do i = 1, n
            bound = reach + relative*(abs(cached(i, f_s)) + abs(cached(i, f_s + 1)))
            beyond(i) = max(abs(b(i) - cached(i, f_b)) - reach*(cached(i, f_b) + sliding_offset), &
                            abs(s(i, 1) - cached(i, f_s)) - bound, abs(s(i, 2) - cached(i, f_s + 1)) - bound)
         end do
         outside = 0
         do i = 1, n
            outside = outside + merge(0, 1, beyond(i) <= 0.0_dp)
         end do
         if (outside > 0) then
            from = findloc(beyond(:n) <= 0.0_dp, .false., dim=1)
            to = findloc(beyond(:n) <= 0.0_dp, .false., dim=1, back=.true.)
            n = to - from + 1
            ss(:n, :) = s(from:to, :)
            call find_factors(self%law, b(from:to), ss, found)
            call store(b(from:to), ss, found, cached(from:, :), self%changes(from:, :, segment, j))
         end if
         call follow(b, s, cached, self%changes(:, :, segment, j), rows)
      end associate
   end subroutine find

   !> Store factors in the cache
   pure subroutine store(b, s, found, cached, changes)
      real(dp), intent(in) :: b(:), s(:, :)
      type(factor_rows_t), intent(in) :: found
      real(dp), intent(inout) :: cached(:, :)
      real(real32), intent(inout) :: changes(:, :)
      !> d ln|S_x|/dS_x, d ln|S_y|/dS_y; d ln(phi)/d ln|S| of a direction, by its own component of S and by the other;
      !> along: 1 in direction X, 0 in direction Y; across: 0 and 1
      real(dp) :: per_x, per_y, own, other, along, across
      integer :: i, d

      do d = 1, 2
         along = merge(1.0_dp, 0.0_dp, d == 1)
         across = 1.0_dp - along
         do i = 1, size(b)
            per_x = s(i, 1)/(s(i, 1)**2 + min_component**2)
            per_y = s(i, 2)/(s(i, 2)**2 + min_component**2)
            own = found%tangent(i, d)/found%phi(i, d) - 1.0_dp
            other = found%by_gradient(i, d) - own
            cached(i, f_s + d - 1) = s(i, d)
            cached(i, f_phi + d - 1) = found%phi(i, d)
            changes(i, c_by_sliding + d - 1) = real(found%by_sliding(i, d), real32)
            changes(i, c_by_x + d - 1) = real((along*own + across*other)*per_x, real32)
            changes(i, c_by_y + d - 1) = real((across*own + along*other)*per_y, real32)
            changes(i, c_tangent + d - 1) = real(found%tangent(i, d), real32)
            changes(i, c_stress_by_gradient + d - 1) = real(found%stress_by_gradient(i, d), real32)
         end do
      end do
      do i = 1, size(b)
         cached(i, f_b) = b(i)
         cached(i, f_stress) = found%stress(i)
         changes(i, c_stress_by_sliding) = real(found%stress_by_sliding(i), real32)
      end do
   end subroutine store

   !> Extrapolate the cached factors to first order
   pure subroutine follow(b, s, cached, changes, rows)
      real(dp), contiguous, intent(in) :: b(:), s(:, :)
      real(dp), contiguous, intent(in) :: cached(:, :)
      real(real32), contiguous, intent(in) :: changes(:, :)
      type(factor_rows_t), intent(inout) :: rows
      !> Changes of ln(B) and of S
      real(dp) :: db, dx, dy
      integer :: i

      do i = 1, size(b)
         db = (b(i) - cached(i, f_b))/(cached(i, f_b) + tiny(1.0_dp))
         dx = s(i, 1) - cached(i, f_s)
         dy = s(i, 2) - cached(i, f_s + 1)
         rows%by_sliding(i, 1) = changes(i, c_by_sliding)
         rows%by_sliding(i, 2) = changes(i, c_by_sliding + 1)
         rows%tangent(i, 1) = changes(i, c_tangent)
         rows%tangent(i, 2) = changes(i, c_tangent + 1)
         rows%phi(i, 1) = cached(i, f_phi)*(1.0_dp + rows%by_sliding(i, 1)*db + changes(i, c_by_x)*dx + changes(i, c_by_y)*dy)
         rows%phi(i, 2) = cached(i, f_phi + 1)*(1.0_dp + rows%by_sliding(i, 2)*db + changes(i, c_by_x + 1)*dx &
                                              + changes(i, c_by_y + 1)*dy)
      end do
   end subroutine follow

   !> Mean stress of a segment of row j, and its derivative with respect to B, from the cache
   pure subroutine stress(self, b, s, segment, j, values, by_sliding)
      class(cached_factors_t), intent(in) :: self
      !> As in `find`
      real(dp), contiguous, intent(in) :: b(:), s(:, :)
      integer, intent(in) :: segment, j
      real(dp), contiguous, intent(out) :: values(:), by_sliding(:)
      integer :: i

      if (.not. self%values(1, f_b, segment, j) > none) then
         values = b
         by_sliding = 1.0_dp
         return
      end if
      associate (cached => self%values(:, :, segment, j), changes => self%changes(:, :, segment, j))
         do i = 1, size(b)
            by_sliding(i) = changes(i, c_stress_by_sliding)
            values(i) = cached(i, f_stress) + by_sliding(i)*(b(i) - cached(i, f_b)) &
                        + changes(i, c_stress_by_gradient)*(s(i, 1) - cached(i, f_s)) &
                        + changes(i, c_stress_by_gradient + 1)*(s(i, 2) - cached(i, f_s + 1))
         end do
      end associate
   end subroutine stress

   !> d ln(eps)/d ln(H) at node (i, j), from the cache
   pure real(dp) function film_exponent(self, i, j, direction)
      class(cached_factors_t), intent(in) :: self
      integer, intent(in) :: i, j, direction
      real(dp) :: s(2), by_gradient(2)
      integer :: segment, k

      film_exponent = 3.0_dp
      segment = (i - 1)/self%width + 1
      k = i - (segment - 1)*self%width
      if (.not. self%values(k, f_b, segment, j) > none) return
      associate (cached => self%values(k, :, segment, j), changes => self%changes(k, :, segment, j))
         s = cached(f_s:f_s + 1)
         ! by_gradient is for ln|S|: divide by per_x and per_y of `store`, not by 0
         s = sign(max(abs(s), real(tiny(1.0_real32), dp)), s)
         by_gradient = [changes(c_by_x + direction - 1), changes(c_by_y + direction - 1)]*(s + min_component**2/s)
         film_exponent = 3.0_dp - changes(c_by_sliding + direction - 1) + sum(by_gradient)
      end associate
   end function film_exponent

   !> Allocated bytes
   pure integer(int64) function bytes(self)
      class(cached_factors_t), intent(in) :: self
      bytes = 0
      if (allocated(self%changes)) bytes = 8*size(self%values, kind=int64) + 4*size(self%changes, kind=int64)
   end function bytes
end module ehl_cached_factors

! SPDX-License-Identifier: BSD-3-Clause
!> Newton solution of the coarsest level, with the force balance; only this solution changes H00 within a cycle
module ehl_coarsest
   use, intrinsic :: iso_fortran_env, only: int64
   use ehl_dense_lu, only: back_substitute, factor
   use ehl_grid, only: grid_t
   use ehl_kernel, only: fill_grid_kernel
   use ehl_kinds, only: dp
   use ehl_level, only: cavitate, cavity_pressure, level_t
   use ehl_poiseuille, only: max_neighbours
   use ehl_reynolds, only: flow_operator, missing_load, refresh, reynolds_operator
   use ehl_status, only: ehl_no_memory, status_t
   use ehl_wedge, only: wedge_reach
   implicit none (type, external)
   private
   public :: coarsest_t

   !> Residual over that at the start at which the iteration ends, and the maximum number of Newton steps
   real(dp), parameter :: reduction = 0.05_dp
   integer, parameter :: max_steps = 12
   !> Old LU factors are used as long as a step reduces the residual to this fraction
   real(dp), parameter :: slow = 0.3_dp
   !> Maximum number of trials of a step, each half as long as the one before
   integer, parameter :: max_halvings = 12

   !> Work space of the dense Newton iteration. Unknowns are the pressures of the interior nodes,
   !> row by row of the grid, and H00 as the last one.
   type :: coarsest_t
      integer :: n = 0, first = 0, last = 0
      !> Deflection by a unit pressure at an unknown's node (n), at any node (nx*ny)
      real(dp), allocatable :: k(:, :)
      !> LU factors of the Jacobian (n+1, n+1), its transpose, and row exchanges
      real(dp), allocatable :: lu(:, :), jacobian(:, :)
      integer, allocatable :: pivot(:)
      !> Right-hand side and solution of a Newton step, and the state before it
      real(dp), allocatable :: residual(:), direction(:), p_before(:, :)
      real(dp) :: h00_before = 0.0_dp
      !> Nodes that are cavitated, and nodes that the present step holds at zero pressure
      logical, allocatable :: cavitated(:), held(:)
      !> Whether lu holds a factorisation
      logical :: factored = .false.
      !> Factorisations made so far
      integer :: factorisations = 0
   contains
      procedure :: setup
      procedure :: solve
      procedure :: find_residual
      procedure, private :: move
      procedure :: bytes
      procedure :: assemble
   end type coarsest_t

contains

   !> Tabulate the kernel
   subroutine setup(self, grid, factor, status)
      class(coarsest_t), intent(inout) :: self
      type(grid_t), intent(in) :: grid
      !> k_b
      real(dp), intent(in) :: factor
      type(status_t), intent(inout) :: status
      real(dp) :: kernel(grid%nx, 2*grid%ny)
      integer :: i, j, k, l, col, stat

      if (status%failed()) return
      self%first = grid%first_inner()
      self%last = grid%last_inner()
      self%n = (grid%nx - 2)*(self%last - self%first + 1)
      allocate (self%k(self%n, grid%nx*grid%ny), self%lu(self%n + 1, self%n + 1), &
                self%jacobian(self%n + 1, self%n + 1), self%pivot(self%n + 1), &
                self%residual(self%n + 1), self%direction(self%n + 1), &
                self%p_before(grid%nx, grid%ny), self%cavitated(self%n), self%held(self%n), stat=stat)
      if (stat /= 0) then
         call status%fail(ehl_no_memory, "no memory for the coarsest level")
         return
      end if
      call fill_grid_kernel(grid, factor, kernel)
      do l = self%first, self%last
         do k = 2, grid%nx - 1
            col = unknown(self, grid%nx, k, l)
            do j = 1, grid%ny
               do i = 1, grid%nx
                  self%k(col, i + (j - 1)*grid%nx) = kernel(1 + abs(i - k), 1 + abs(j - l))
                  if (grid%images(l) > 1) self%k(col, i + (j - 1)*grid%nx) = &
                     self%k(col, i + (j - 1)*grid%nx) + kernel(1 + abs(i - k), j + l - 1)
               end do
            end do
         end do
      end do
      self%factored = .false.
   end subroutine setup

   !> Allocated bytes of kernel, Jacobian and LU factors
   pure integer(int64) function bytes(self)
      class(coarsest_t), intent(in) :: self
      bytes = 0
      if (allocated(self%k)) bytes = 8*(size(self%k, kind=int64) + 2*size(self%lu, kind=int64))
   end function bytes

   !> Number of the unknown at node (i, j)
   pure integer function unknown(self, nx, i, j)
      class(coarsest_t), intent(in) :: self
      integer, intent(in) :: nx, i, j
      unknown = (i - 1) + (j - self%first)*(nx - 2)
   end function unknown

   !> Newton iteration with an active set of cavitated nodes, from the level's present state until
   !> the residual is `reduction` times its start value, for at most `max_steps` steps. The LU
   !> factors are used again in later steps and calls as long as they reduce the residual enough.
   subroutine solve(self, level)
      class(coarsest_t), intent(inout) :: self
      type(level_t), intent(inout) :: level
      real(dp) :: norm, norm_start, norm_before
      integer :: step
      logical :: fresh

      call refresh(level)
      call self%find_residual(level, norm_start)
      norm = norm_start
      do step = 1, max_steps
         if (norm <= reduction*norm_start .or. norm <= tiny(1.0_dp)) exit
         fresh = .not. self%factored
         if (fresh) call self%assemble(level)
         self%direction = self%residual
         call back_substitute(self%lu, self%pivot, self%direction)
         self%p_before = level%p
         self%h00_before = level%h00
         norm_before = norm
         call self%move(level, fresh, norm)
         if (fresh .and. norm < huge(1.0_dp)) then
            if (norm > slow*norm_before) self%factored = .false.
         else if (.not. norm <= slow*norm_before .or. .not. is_positive(level)) then
            ! the old factors are not good enough: undo the step and factor again
            level%p = self%p_before
            level%h00 = self%h00_before
            call refresh(level)
            call self%find_residual(level, norm)
            self%factored = .false.
            ! new factors do not help either: the matrix is singular, or contains a NaN
            if (fresh) exit
         end if
      end do
   end subroutine solve

   !> Make a Newton step; with fresh factors it is halved until the film is positive
   subroutine move(self, level, fresh, norm)
      class(coarsest_t), intent(inout) :: self
      type(level_t), intent(inout) :: level
      logical, intent(in) :: fresh
      real(dp), intent(out) :: norm
      real(dp) :: damping
      integer :: half, i, j, nx, u

      nx = level%grid%nx
      self%held = self%cavitated
      damping = 1.0_dp
      do half = 1, merge(max_halvings, 1, fresh)
         do j = self%first, self%last
            do i = 2, nx - 1
               u = unknown(self, nx, i, j)
               level%p(i, j) = self%p_before(i, j) + damping*self%direction(u)
               ! exactly, so that rounding does not free the node
               if (self%held(u)) level%p(i, j) = cavity_pressure
            end do
            call cavitate(level%p(2:nx - 1, j))
         end do
         level%h00 = self%h00_before + damping*self%direction(self%n + 1)
         call refresh(level)
         if (is_positive(level)) exit
         damping = 0.5_dp*damping
      end do
      call self%find_residual(level, norm)
   end subroutine move

   !> Whether the film is positive; above a boundary film it always is
   pure logical function is_positive(level)
      type(level_t), intent(in) :: level
      is_positive = level%boundary%has_film(minval(level%h) > 0.0_dp)
   end function is_positive

   !> Right-hand side of the Newton step, and its norm; cavitated nodes count only when they
   !> require pressure
   subroutine find_residual(self, level, norm)
      class(coarsest_t), intent(inout) :: self
      type(level_t), intent(in) :: level
      real(dp), intent(out) :: norm
      real(dp) :: weight, row(level%grid%nx)
      integer :: i, j, u

      norm = 0.0_dp
      do j = self%first, self%last
         weight = level%grid%images(j)
         call reynolds_operator(level, j, row)
         row = level%rhs(:, j) - row
         call level%boundary%residual_row(level%rhs(:, j), level%mass_content(:, j), j, row)
         do i = 2, level%grid%nx - 1
            u = unknown(self, level%grid%nx, i, j)
            self%residual(u) = row(i)
            if (level%p(i, j) < cavity_pressure .or. &
                (level%p(i, j) <= cavity_pressure .and. self%residual(u) >= 0.0_dp)) then
               self%cavitated(u) = .true.
               self%residual(u) = -level%p(i, j)
            else
               self%cavitated(u) = .false.
            end if
            ! weighted as in the whole contact, so that half a domain has the same norm as the whole one
            norm = norm + weight*self%residual(u)**2
         end do
      end do
      self%residual(self%n + 1) = missing_load(level)
      norm = sqrt(norm/((level%grid%nx - 2)*level%grid%inner_rows()) + self%residual(self%n + 1)**2)
   end subroutine find_residual

   !> Assemble and factor the Jacobian
   subroutine assemble(self, level)
      class(coarsest_t), intent(inout) :: self
      type(level_t), intent(in) :: level
      real(dp) :: coupling(max_neighbours), rate(max_neighbours), own, part, excess, returned, c(0:wedge_reach)
      integer :: i, j, k, m, u, nx, at, nb(2, max_neighbours), direction(max_neighbours), neighbours
      real(dp) :: row(level%grid%nx)
      logical :: passing(level%grid%nx, self%first:self%last)

      nx = level%grid%nx
      passing = .false.
      do j = self%first, self%last
         if (level%supply%active) call flow_operator(level, j, row, passing(:, j))
      end do
      ! transposed, so that a row is contiguous
      self%jacobian = 0.0_dp
      do j = self%first, self%last
         do i = 2, nx - 1
            u = unknown(self, nx, i, j)
            if (self%cavitated(u)) then
               self%jacobian(u, u) = 1.0_dp
               cycle
            end if
            at = i + (j - 1)*nx
            if (level%boundary%touches(i, j)) then
               call add_film(i, j, -level%boundary%rate*level%rho(i, j))
               call add_pressure(i, j, -level%boundary%rate*level%h_drho_dp(i, j))
               cycle
            end if
            own = 0.0_dp
            returned = 1.0_dp
            call add_poiseuille(i)
            ! oil that flows back to starved upstream nodes is transported back to this one
            do k = i - 1, 2, -1
               if (.not. passing(k, j)) exit
               returned = level%supply%passed_fraction*returned
               call add_poiseuille(k)
            end do
            c = level%wedge%weights(i, passing(i - 1, j), level%supply%passed_fraction)
            call add_film(i, j, own - c(0)*level%rho(i, j))
            call add_pressure(i, j, -c(0)*level%h_drho_dp(i, j))
            do m = 1, ubound(c, 1)
               if (i - m < 1) cycle
               call add_film(i - m, j, -c(m)*level%rho(i - m, j))
               call add_pressure(i - m, j, -c(m)*level%h_drho_dp(i - m, j))
            end do
         end do
      end do
      do j = self%first, self%last
         do i = 2, nx - 1
            self%jacobian(unknown(self, nx, i, j), self%n + 1) = level%grid%weight(j)
         end do
      end do
      self%lu = transpose(self%jacobian)
      call factor(self%lu, self%pivot)
      self%factored = .true.
      self%factorisations = self%factorisations + 1

   contains

      !> Add the returning fraction of the Poiseuille term of node (k, j) to the row of node (i, j)
      subroutine add_poiseuille(k)
         integer, intent(in) :: k

         call level%poiseuille%couplings(level%flow, k, j, neighbours, nb, direction, coupling, rate, excess)
         coupling(:neighbours) = returned*coupling(:neighbours)
         rate(:neighbours) = returned*rate(:neighbours)
         excess = returned*excess
         call add_pressure(k, j, -sum(coupling) - excess)
         do m = 1, neighbours
            associate (flow => level%flow, ii => nb(1, m), jj => nb(2, m), d => direction(m))
               call add_pressure(ii, jj, coupling(m))
               ! a Galerkin operator does not change
               if (level%poiseuille%frozen) cycle
               part = rate(m)*(level%p(ii, jj) - level%p(k, j))
               if (k == i) own = own + flow%film_exponent(i, j, d)*flow%eps(i, j, d)/level%boundary%film_at(level%h, i, j)*part
               if (k /= i) call add_film(k, j, flow%film_exponent(k, j, d)*flow%eps(k, j, d) &
                                         /level%boundary%film_at(level%h, k, j)*part)
               call add_pressure(ii, jj, flow%eps(ii, jj, d)*flow%dlneps_dp(ii, jj, d)*part)
               call add_pressure(k, j, flow%eps(k, j, d)*flow%dlneps_dp(k, j, d)*part)
               call add_film(ii, jj, flow%film_exponent(ii, jj, d)*flow%eps(ii, jj, d) &
                             /level%boundary%film_at(level%h, ii, jj)*part)
            end associate
         end do
      end subroutine add_poiseuille

      !> Add a derivative with respect to the pressure of node (ii, jj) to the row of unknown u
      subroutine add_pressure(ii, jj, value)
         integer, intent(in) :: ii, jj
         real(dp), intent(in) :: value
         if (ii < 2 .or. ii > nx - 1 .or. jj < self%first .or. jj > self%last) return
         self%jacobian(unknown(self, nx, ii, jj), u) = self%jacobian(unknown(self, nx, ii, jj), u) + value
      end subroutine add_pressure

      !> Add a derivative with respect to the film at node (ii, jj) to the row of unknown u
      subroutine add_film(ii, jj, value)
         integer, intent(in) :: ii, jj
         real(dp), intent(in) :: value
         self%jacobian(1:self%n, u) = self%jacobian(1:self%n, u) + value*self%k(:, ii + (jj - 1)*nx)
         self%jacobian(self%n + 1, u) = self%jacobian(self%n + 1, u) + value
      end subroutine add_film
   end subroutine assemble

end module ehl_coarsest

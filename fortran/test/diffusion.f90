! SPDX-License-Identifier: BSD-3-Clause
!> A model problem: -div(D grad p) = 0 with strongly varying D, p = 0 on the border.
!>
!> Unit square, 129 x 129 nodes, six levels (129 to 5), five-point operator with arithmetic means of D at
!> the nodes, V(2,1) cycles with lexicographic Gauss-Seidel sweeps, from a random start.
!> Classical: bilinear interpolation, its transpose, coarse operators from D at every second node.
!> Alcouffe: operator-dependent interpolation, its transpose, P^T A P.
module diffusion
   use check, only: is_true
   use ehl_alcouffe, only: transfer_t
   use ehl_galerkin, only: galerkin_product, product_work_t
   use ehl_grid, only: grid_t, new_grid, new_strip
   use ehl_kinds, only: dp, pi
   use ehl_nine_point, only: nine_point_t
   use ehl_status, only: status_t
   implicit none (type, external)
   private
   public :: problem_t, points, levels, alcouffe, classical, new_problem
   public :: cosine, grooves, checkerboard, noise, scatter
   public :: coarsen, factor, residual

   integer, parameter :: points = 129, levels = 6
   logical, parameter :: alcouffe = .true., classical = .false.

   !> One level
   type :: problem_t
      type(grid_t) :: grid
      type(nine_point_t) :: a
      !> Transfer to the next coarser grid
      type(transfer_t) :: transfer
      type(product_work_t) :: work
      !> D, solution, right-hand side, residual; 1 at nodes that are solved for, else 0
      real(dp), allocatable :: d(:, :), u(:, :), f(:, :), r(:, :), free(:, :)
   end type problem_t

contains

   !> Levels of a square or of a strip that is periodic along Y, whole or folded
   subroutine new_problem(p, mirror, rows, strip)
      type(problem_t), allocatable, intent(out) :: p(:)
      logical, intent(in) :: mirror
      !> Number of nodes along Y if it differs from that along X
      integer, intent(in), optional :: rows
      logical, intent(in), optional :: strip
      type(status_t) :: status
      integer :: k, ny

      ny = points
      if (present(rows)) ny = rows
      allocate (p(levels))
      p(levels)%grid = new_grid(points, ny, 0.0_dp, 1.0_dp, 0.5_dp, mirror)
      if (present(strip)) then
         if (strip) p(levels)%grid = new_strip(points, points - 1, 0.0_dp, 1.0_dp, 1.0_dp, mirror)
      end if
      do k = levels - 1, 1, -1
         p(k)%grid = p(k + 1)%grid%coarser()
      end do
      do k = 1, levels
         associate (nx => p(k)%grid%nx, ny => p(k)%grid%ny)
            allocate (p(k)%d(nx, ny), p(k)%u(nx, ny), p(k)%f(nx, ny), p(k)%r(nx, ny), p(k)%free(nx, ny), &
                      source=0.0_dp)
            p(k)%free(2:nx - 1, p(k)%grid%first_inner():p(k)%grid%last_inner()) = 1.0_dp
         end associate
         call p(k)%a%setup(p(k)%grid, status)
         if (k > 1) call p(k)%transfer%setup(p(k - 1)%grid, 1, .false., status)
         if (k > 1) call p(k)%work%setup(p(k - 1)%grid, status)
      end do
      call is_true(.not. status%failed(), "set-up of a test problem")
   end subroutine new_problem

   !> D = (1 + 0.9 cos cos)^3 with `wave` points per wavelength
   subroutine cosine(p, wave)
      type(problem_t), intent(inout) :: p
      real(dp), intent(in) :: wave
      integer :: i, j

      do j = 1, p%grid%ny
         do i = 1, p%grid%nx
            p%d(i, j) = (1.0_dp + 0.9_dp*cos(2.0_dp*pi*p%grid%x(i)/p%grid%hx/wave) &
                         *cos(2.0_dp*pi*p%grid%y(j)/p%grid%hy/wave))**3
         end do
      end do
   end subroutine cosine

   !> Grooves of small D, one node wide, along Y and along X, seven nodes apart
   subroutine grooves(p)
      type(problem_t), intent(inout) :: p

      p%d = 1.0_dp
      p%d(4::7, :) = 1.0e-4_dp
      p%d(:, 4::7) = 1.0e-4_dp
   end subroutine grooves

   !> D = 1 and 1000 on 8 x 8 fields
   subroutine checkerboard(p)
      type(problem_t), intent(inout) :: p
      integer :: i, j

      do j = 1, p%grid%ny
         do i = 1, p%grid%nx
            p%d(i, j) = merge(1.0_dp, 1.0e3_dp, mod(8*(i - 1)/points + 8*(j - 1)/points, 2) == 0)
         end do
      end do
   end subroutine checkerboard

   !> Uncorrelated D whose logarithm has a normal distribution with standard deviation 2
   subroutine noise(p)
      type(problem_t), intent(inout) :: p
      real(dp) :: u(2)
      integer :: i, j, seed

      seed = 7
      do j = 1, p%grid%ny
         do i = 1, p%grid%nx
            u(1) = uniform(seed)
            u(2) = uniform(seed)
            p%d(i, j) = exp(2.0_dp*sqrt(-2.0_dp*log(u(1)))*cos(2.0_dp*pi*u(2)))
         end do
      end do
   end subroutine noise

   !> Uniform random number in (0, 1): minimal standard generator (Park & Miller 1988)
   real(dp) function uniform(seed)
      integer, intent(inout) :: seed
      integer, parameter :: a = 16807, m = 2147483647, q = 127773, r = 2836

      seed = a*mod(seed, q) - r*(seed/q)
      if (seed <= 0) seed = seed + m
      uniform = real(seed, dp)/m
   end function uniform

   !> Random numbers between -1/2 and 1/2
   subroutine scatter(u)
      real(dp), intent(out) :: u(:, :)
      integer :: i, j, seed

      seed = 3
      do j = 1, size(u, 2)
         do i = 1, size(u, 1)
            u(i, j) = uniform(seed) - 0.5_dp
         end do
      end do
   end subroutine scatter

   !> Five-point operator with arithmetic means of D
   subroutine five_point(p)
      type(problem_t), intent(inout) :: p
      integer :: i, j

      p%a%east = 0.0_dp
      p%a%north = 0.0_dp
      p%a%north_east = 0.0_dp
      p%a%north_west = 0.0_dp
      p%a%excess = 0.0_dp
      p%a%five = .true.
      do j = 1, p%grid%ny
         do i = 1, p%grid%nx - 1
            p%a%east(i, j) = 0.5_dp*(p%d(i, j) + p%d(i + 1, j))
            if (p%grid%mirror .and. p%grid%images(j) == 1) p%a%east(i, j) = 0.5_dp*p%a%east(i, j)
         end do
      end do
      do j = 1, p%grid%last_inner()
         if (p%grid%north(j) < j .and. p%grid%mirror) cycle
         p%a%north(1:, j) = 0.5_dp*(p%d(:, j) + p%d(:, p%grid%north(j)))
      end do
   end subroutine five_point

   !> Coarse operators and transfers
   subroutine coarsen(p, operator_dependent)
      type(problem_t), intent(inout) :: p(:)
      logical, intent(in) :: operator_dependent
      integer :: k

      call five_point(p(levels))
      do k = levels, 2, -1
         associate (fine => p(k), coarse => p(k - 1))
            coarse%d = fine%d(::2, ::2)
            coarse%free = fine%free(::2, ::2)
            if (operator_dependent) then
               call fine%transfer%find_weights(fine%a, fine%free, fine%free)
               call galerkin_product(fine%a, fine%transfer, fine%work, coarse%a)
            else
               call fine%transfer%find_weights(fine%a, fine%free, 0.0_dp*fine%free)
               call five_point(coarse)
            end if
         end associate
      end do
   end subroutine coarsen

   !> Convergence factor: reduction of the residual (Euclidean norm) per cycle, geometric mean of cycles 11 to 20
   real(dp) function factor(p)
      type(problem_t), intent(inout) :: p(:)
      real(dp) :: norm, before
      integer :: cycle, seed, i, j

      seed = 1
      associate (top => p(levels))
         do j = 1, top%grid%ny
            do i = 1, top%grid%nx
               top%u(i, j) = (uniform(seed) - 0.5_dp)*top%free(i, j)
            end do
         end do
         top%f = 0.0_dp
         factor = 1.0_dp
         before = 1.0_dp
         do cycle = 1, 20
            call v_cycle(p, levels)
            call residual(top)
            norm = sqrt(sum(top%r**2))
            if (cycle == 10) before = norm
         end do
         factor = (norm/before)**0.1_dp
      end associate
   end function factor

   recursive subroutine v_cycle(p, k)
      type(problem_t), intent(inout) :: p(:)
      integer, intent(in) :: k
      integer :: j, sweep
      real(dp) :: row(p(k)%grid%nx)

      if (k == 1) then
         do sweep = 1, 40
            call gauss_seidel(p(k))
         end do
         return
      end if
      call gauss_seidel(p(k))
      call gauss_seidel(p(k))
      call residual(p(k))
      associate (fine => p(k), coarse => p(k - 1))
         coarse%f = 0.0_dp
         coarse%u = 0.0_dp
         do j = merge(1, 2, coarse%grid%mirror), coarse%grid%ny - 1
            call fine%transfer%restrict_row(fine%r, j, coarse%f(:, j))
         end do
         call v_cycle(p, k - 1)
         do j = merge(1, 2, fine%grid%mirror), fine%grid%ny - 1
            call fine%transfer%prolong_row(coarse%u, j, row)
            fine%u(:, j) = fine%u(:, j) + row
         end do
      end associate
      call gauss_seidel(p(k))
   end subroutine v_cycle

   !> r = f + div(D grad u)
   subroutine residual(p)
      type(problem_t), intent(inout) :: p
      integer :: j

      p%r = 0.0_dp
      do j = p%grid%first_inner(), p%grid%last_inner()
         call p%a%apply_row(p%u, j, p%r(:, j))
         p%r(2:p%grid%nx - 1, j) = p%f(2:p%grid%nx - 1, j) + p%r(2:p%grid%nx - 1, j)
      end do
   end subroutine residual

   subroutine gauss_seidel(p)
      type(problem_t), intent(inout) :: p
      real(dp) :: s
      integer :: i, j

      associate (a => p%a, u => p%u)
         do j = merge(1, 2, p%grid%mirror), p%grid%ny - 1
            do i = 2, p%grid%nx - 1
               s = p%f(i, j) + a%east(i, j)*u(i + 1, j) + a%east(i - 1, j)*u(i - 1, j) + a%north(i, j)*u(i, j + 1) &
                   + a%north_east(i, j)*u(i + 1, j + 1) + a%north_west(i, j)*u(i - 1, j + 1)
               if (j > 1) s = s + a%north(i, j - 1)*u(i, j - 1) + a%north_east(i - 1, j - 1)*u(i - 1, j - 1) &
                              + a%north_west(i + 1, j - 1)*u(i + 1, j - 1)
               u(i, j) = s/a%diagonal(i, j)
            end do
         end do
      end associate
   end subroutine gauss_seidel
end module diffusion

! SPDX-License-Identifier: BSD-3-Clause
!> Operator-dependent coarsening on -div(D grad p) = 0 with D that varies strongly, p = 0 on the border.
!>
!> Set-up: unit square, 129 x 129 nodes, six levels (129 to 5), five-point operator with arithmetic
!> means of D at the nodes, V(2,1) cycles with Gauss-Seidel sweeps in the order of storage, from a
!> random start. The factor is the reduction of the residual (Euclidean norm) per cycle, geometric mean
!> of cycles 11 to 20. Classical: bilinear interpolation, its transpose, coarse operators
!> from D at every second node. Alcouffe: operator-dependent interpolation, its transpose, P^T A P.
module test_alcouffe
   use check, only: is_close, is_true
   use ehl_alcouffe, only: transfer_t
   use ehl_galerkin, only: galerkin_product
   use ehl_grid, only: grid_t, new_grid
   use ehl_kinds, only: dp, pi
   use ehl_nine_point, only: nine_point_t
   use ehl_status, only: status_t
   implicit none (type, external)
   private
   public :: run_alcouffe

   integer, parameter :: points = 129, levels = 6
   logical, parameter :: alcouffe = .true., classical = .false.

   type :: problem_t
      type(grid_t) :: grid
      type(nine_point_t) :: a
      !> Transfer to the next coarser grid
      type(transfer_t) :: transfer
      real(dp), allocatable :: d(:, :), u(:, :), f(:, :), r(:, :), free(:, :)
   end type problem_t

contains

   subroutine run_alcouffe()
      call product_is_the_product()
      call interpolation_keeps_constants()
      call constant_coefficient_is_bilinear()
      call folded_is_whole()
      call factors()
   end subroutine run_alcouffe

   !> Factors of convergence, against those of classical transfers
   subroutine factors()
      type(problem_t), allocatable :: p(:)
      real(dp) :: f(0:1)
      integer :: wave

      ! measured 0.111 and 0.131 where the classical factor is 0.75 and 0.78; six points a wave, which no
      ! coarser grid repeats, 0.24 against 0.46
      do wave = 4, 8, 4
         call new_problem(p, .false.)
         call cosine(p(levels), real(wave, dp))
         f = both(p)
         call is_true(f(1) < 0.15_dp, "Alcouffe on the cosine")
         call is_true(f(0) > 2.0_dp*f(1), "classical is slower on the cosine")
      end do
      call cosine(p(levels), 6.0_dp)
      f = both(p)
      call is_true(f(1) < 0.27_dp .and. f(0) > f(1), "Alcouffe on a cosine that the coarse grids do not repeat")
      ! measured 0.080, 0.549, 0.796, where classical transfers diverge
      call grooves(p(levels))
      f = both(p)
      call is_true(f(1) < 0.1_dp .and. f(0) > 1.0_dp, "Alcouffe on grooves")
      call checkerboard(p(levels))
      f = both(p)
      call is_true(f(1) < 0.6_dp .and. f(0) > 1.0_dp, "Alcouffe on a checkerboard")
      call noise(p(levels))
      f = both(p)
      call is_true(f(1) < 0.85_dp .and. f(0) > 1.0_dp, "Alcouffe on white noise")
   end subroutine factors

   !> Factors with classical and with Alcouffe transfers
   function both(p) result(f)
      type(problem_t), intent(inout) :: p(:)
      real(dp) :: f(0:1)

      call coarsen(p, classical)
      f(0) = factor(p)
      call coarsen(p, alcouffe)
      f(1) = factor(p)
   end function both

   !> (1 + 0.9 cos cos)^3 with so many points per wave
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

   !> Grooves one node wide that hardly conduct, along Y and along X, seven nodes apart
   subroutine grooves(p)
      type(problem_t), intent(inout) :: p

      p%d = 1.0_dp
      p%d(4::7, :) = 1.0e-4_dp
      p%d(:, 4::7) = 1.0e-4_dp
   end subroutine grooves

   !> 8 x 8 fields of 1 and 1000
   subroutine checkerboard(p)
      type(problem_t), intent(inout) :: p
      integer :: i, j

      do j = 1, p%grid%ny
         do i = 1, p%grid%nx
            p%d(i, j) = merge(1.0_dp, 1.0e3_dp, mod(8*(i - 1)/points + 8*(j - 1)/points, 2) == 0)
         end do
      end do
   end subroutine checkerboard

   !> Logarithm normally distributed, standard deviation 2, no correlation between nodes
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

   !> Uniform in (0, 1): minimal standard generator (Park & Miller 1988)
   real(dp) function uniform(seed)
      integer, intent(inout) :: seed
      integer, parameter :: a = 16807, m = 2147483647, q = 127773, r = 2836

      seed = a*mod(seed, q) - r*(seed/q)
      if (seed <= 0) seed = seed + m
      uniform = real(seed, dp)/m
   end function uniform

   !> Levels of a square, whole or folded
   subroutine new_problem(p, mirror)
      type(problem_t), allocatable, intent(out) :: p(:)
      logical, intent(in) :: mirror
      type(status_t) :: status
      integer :: k

      allocate (p(levels))
      p(levels)%grid = new_grid(points, 0.0_dp, 1.0_dp, 0.5_dp, mirror)
      do k = levels - 1, 1, -1
         p(k)%grid = p(k + 1)%grid%coarser()
      end do
      do k = 1, levels
         associate (nx => p(k)%grid%nx, ny => p(k)%grid%ny)
            allocate (p(k)%d(nx, ny), p(k)%u(nx, ny), p(k)%f(nx, ny), p(k)%r(nx, ny), p(k)%free(nx, ny), &
                      source=0.0_dp)
            p(k)%free(2:nx - 1, merge(1, 2, mirror):ny - 1) = 1.0_dp
         end associate
         call p(k)%a%setup(p(k)%grid, status)
         if (k > 1) call p(k)%transfer%setup(p(k)%grid, p(k - 1)%grid, 1, .false., status)
      end do
      call is_true(.not. status%failed(), "set-up of a test problem")
   end subroutine new_problem

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
            if (p%grid%mirror .and. j == 1) p%a%east(i, j) = 0.5_dp*p%a%east(i, j)
         end do
      end do
      do j = 1, p%grid%ny - 1
         p%a%north(1:, j) = 0.5_dp*(p%d(:, j) + p%d(:, j + 1))
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
               call galerkin_product(fine%a, fine%transfer, coarse%a)
            else
               call fine%transfer%find_weights(fine%a, fine%free, 0.0_dp*fine%free)
               call five_point(coarse)
            end if
         end associate
      end do
   end subroutine coarsen

   !> Reduction of the residual per cycle
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
      do j = merge(1, 2, p%grid%mirror), p%grid%ny - 1
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

   !> P^T (A (P u)) by the transfers and the operator one after the other, for two products in a row
   !> (five-point and nine-point operators), with nodes that are not free, whole and folded
   subroutine product_is_the_product()
      type(problem_t), allocatable :: p(:)
      real(dp), allocatable :: wanted(:), made(:)
      real(dp) :: largest, row(points)
      integer :: half, j, k

      do half = 0, 1
         call new_problem(p, half == 1)
         call noise(p(levels))
         p(levels)%free(40:47, 20:31) = 0.0_dp
         call coarsen(p, alcouffe)
         do k = levels, levels - 1, -1
            associate (fine => p(k), coarse => p(k - 1))
               call scatter(coarse%u)
               coarse%u = coarse%u*fine%transfer%free
               fine%u = 0.0_dp
               do j = 1, fine%grid%ny
                  call fine%transfer%prolong_row(coarse%u, j, row(:fine%grid%nx))
                  fine%u(:, j) = row(:fine%grid%nx)
               end do
               fine%f = 0.0_dp
               call residual(fine)
               allocate (wanted(coarse%grid%nx), made(coarse%grid%nx), source=0.0_dp)
               largest = 0.0_dp
               do j = merge(1, 2, coarse%grid%mirror), coarse%grid%ny - 1
                  call fine%transfer%restrict_row(fine%r, j, wanted)
                  call coarse%a%apply_row(coarse%u, j, made)
                  largest = max(largest, maxval(abs(made - wanted)*fine%transfer%free(:, j)))
               end do
               call is_close(largest/maxval(abs(fine%r)), 0.0_dp, 1.0e-12_dp, "Galerkin product")
               deallocate (wanted, made)
            end associate
         end do
      end do
   end subroutine product_is_the_product

   !> Away from the border a constant stays one, whatever the coefficient
   subroutine interpolation_keeps_constants()
      type(problem_t), allocatable :: p(:)
      real(dp) :: row(points), largest
      integer :: j

      call new_problem(p, .false.)
      call noise(p(levels))
      call coarsen(p, alcouffe)
      p(levels - 1)%u = 1.0_dp
      largest = 0.0_dp
      do j = 3, points - 2
         call p(levels)%transfer%prolong_row(p(levels - 1)%u, j, row)
         largest = max(largest, maxval(abs(row(3:points - 2) - 1.0_dp)))
      end do
      call is_close(largest, 0.0_dp, 1.0e-12_dp, "interpolation of a constant")
   end subroutine interpolation_keeps_constants

   !> A constant coefficient makes the interpolation bilinear, next to the border too
   subroutine constant_coefficient_is_bilinear()
      type(problem_t), allocatable :: p(:)

      call new_problem(p, .false.)
      p(levels)%d = 3.0_dp
      call coarsen(p, alcouffe)
      associate (t => p(levels)%transfer, n => p(levels - 1)%grid%nx)
         call is_close(maxval(abs(t%along_x(:, 2:n - 2, 2:n - 1) - 0.5_dp)), 0.0_dp, 1.0e-14_dp, "weights along X")
         call is_close(maxval(abs(t%along_y(:, 2:n - 1, 2:n - 2) - 0.5_dp)), 0.0_dp, 1.0e-14_dp, "weights along Y")
         call is_close(maxval(abs(t%centre(:, 2:n - 2, 2:n - 2) - 0.25_dp)), 0.0_dp, 1.0e-14_dp, "weights amid four")
         call is_close(maxval(abs(t%along_x(2, 1, 2:n - 1) - 0.5_dp)), 0.0_dp, 1.0e-14_dp, "weights at the border")
      end associate
   end subroutine constant_coefficient_is_bilinear

   !> A coefficient that is even in Y: the operators of the half domain are those of the whole one
   subroutine folded_is_whole()
      type(problem_t), allocatable :: half(:), whole(:)
      integer :: k, middle

      call new_problem(half, .true.)
      call new_problem(whole, .false.)
      call cosine(half(levels), 6.0_dp)
      call cosine(whole(levels), 6.0_dp)
      call coarsen(half, alcouffe)
      call coarsen(whole, alcouffe)
      do k = levels - 1, levels - 2, -1
         associate (h => half(k)%a, w => whole(k)%a)
            middle = (whole(k)%grid%ny + 1)/2
            call is_close(maxval(abs(h%east(:, 2:) - w%east(:, middle + 1:))), 0.0_dp, 1.0e-11_dp, "folded: east")
            call is_close(maxval(abs(2.0_dp*h%east(:, 1) - w%east(:, middle))), 0.0_dp, 1.0e-11_dp, "folded: axis")
            call is_close(maxval(abs(h%north - w%north(:, middle:))), 0.0_dp, 1.0e-11_dp, "folded: north")
            call is_close(maxval(abs(h%north_east - w%north_east(:, middle:))), 0.0_dp, 1.0e-11_dp, "folded: north-east")
         end associate
      end do
   end subroutine folded_is_whole

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
end module test_alcouffe

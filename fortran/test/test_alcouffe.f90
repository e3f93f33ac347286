! SPDX-License-Identifier: BSD-3-Clause
!> Operator-dependent coarsening: its parts, and convergence factors of a model problem with and without it
module test_alcouffe
   use check, only: is_close, is_true
   use diffusion, only: alcouffe, checkerboard, classical, coarsen, cosine, factor, grooves, levels, new_problem, noise, &
                        points, problem_t, residual, scatter
   use ehl_kinds, only: dp
   implicit none (type, external)
   private
   public :: run_alcouffe

contains

   subroutine run_alcouffe()
      call product_is_the_product()
      call interpolation_keeps_constants()
      call constant_coefficient_is_bilinear()
      call folded_is_whole()
      call factors()
   end subroutine run_alcouffe

   !> Convergence factors, compared with those of classical transfers
   subroutine factors()
      type(problem_t), allocatable :: p(:)
      real(dp) :: f(0:1)
      integer :: wave

      ! measured 0.111 and 0.131 with Alcouffe, 0.75 and 0.78 with classical transfers; with six points per wavelength, which no
      ! coarser grid represents, 0.24 and 0.46
      do wave = 4, 8, 4
         call new_problem(p, .false.)
         call cosine(p(levels), real(wave, dp))
         f = both(p)
         call is_true(f(1) < 0.15_dp, "Alcouffe on the cosine")
         call is_true(f(0) > 2.0_dp*f(1), "classical is slower on the cosine")
      end do
      call cosine(p(levels), 6.0_dp)
      f = both(p)
      call is_true(f(1) < 0.27_dp .and. f(0) > f(1), "Alcouffe on a cosine that the coarse grids do not represent")
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

   !> Convergence factors with classical and with Alcouffe transfers
   function both(p) result(f)
      type(problem_t), intent(inout) :: p(:)
      real(dp) :: f(0:1)

      call coarsen(p, classical)
      f(0) = factor(p)
      call coarsen(p, alcouffe)
      f(1) = factor(p)
   end function both

   !> The Galerkin product equals P^T (A (P u)) by transfers and operator in turn, for two successive products
   !> (five-point and nine-point operators), with nodes that are not free, whole and folded, on as many rows as columns
   !> and on more, and on a strip, whole and folded
   subroutine product_is_the_product()
      type(problem_t), allocatable :: p(:)
      real(dp), allocatable :: wanted(:), made(:)
      real(dp) :: largest, row(points)
      integer :: kind, j, k

      do kind = 0, 5
         call new_problem(p, mod(kind, 2) == 1, merge(193, points, kind > 1), strip=kind > 3)
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
               do j = coarse%grid%first_inner(), coarse%grid%last_inner()
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

   !> Away from the border the interpolation of a constant is exact for any coefficient
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

   !> For a constant coefficient the interpolation is bilinear, also beside the border
   subroutine constant_coefficient_is_bilinear()
      type(problem_t), allocatable :: p(:)

      call new_problem(p, .false.)
      p(levels)%d = 3.0_dp
      call coarsen(p, alcouffe)
      associate (t => p(levels)%transfer, n => p(levels - 1)%grid%nx)
         call is_close(maxval(abs(t%along_x(:, 2:n - 2, 2:n - 1) - 0.5_dp)), 0.0_dp, 1.0e-14_dp, "weights along X")
         call is_close(maxval(abs(t%along_y(:, 2:n - 1, 2:n - 2) - 0.5_dp)), 0.0_dp, 1.0e-14_dp, "weights along Y")
         call is_close(maxval(abs(t%centre(:, 2:n - 2, 2:n - 2) - 0.25_dp)), 0.0_dp, 1.0e-14_dp, "weights between four")
         call is_close(maxval(abs(t%along_x(2, 1, 2:n - 1) - 0.5_dp)), 0.0_dp, 1.0e-14_dp, "weights at the border")
      end associate
   end subroutine constant_coefficient_is_bilinear

   !> For a coefficient that is even in Y the operators of half the domain are those of the whole domain
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
end module test_alcouffe

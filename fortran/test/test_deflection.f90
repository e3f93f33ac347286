! SPDX-License-Identifier: BSD-3-Clause
!> Deflection engines, compared with each other and with analytic solutions
module test_deflection
   use check, only: is_true, is_close, is_equal, has_text
   use, intrinsic :: iso_fortran_env, only: int64
   use ehl_kinds, only: dp, pi
   use ehl_grid, only: grid_t, new_grid, new_strip
   use ehl_status, only: status_t, ehl_bad_input
   use ehl_kernel, only: kernel_coefficient
   use ehl_deflection, only: deflection_t
   use direct, only: sum_directly
   use ehl_deflection_factory, only: new_deflection, deflection_engines
   use pressed_grid, only: grids, hertz, inlet, kind_name, named, patch, press, random, some_grid
   implicit none (type, external)
   private
   public :: run_deflection

   !> k_b of the circular contact
   real(dp), parameter :: factor = 2.0_dp/pi**2

contains

   !> All checks
   subroutine run_deflection()
      call kernel_is_exact()
      call engines_give_hertz()
      call row_is_hertz()
      call strip_is_periodic()
      call folded_strip_is_a_strip()
      call fft_is_direct()
      call mlmi_is_direct()
      call folded_is_whole()
      call threads_do_not_matter()
      call history_does_not_matter()
      call scale_does_not_matter()
      call memory_is_linear()
      call bad_requests_are_refused()
   end subroutine run_deflection

   !> Closed form at the origin, symmetry, and a cell as the sum of smaller cells, near and far
   subroutine kernel_is_exact()
      real(dp) :: whole, parts
      integer :: a, i, j

      call is_close(kernel_coefficient(factor, 0, 0, 0.1_dp, 0.1_dp), 0.8_dp*asinh(1.0_dp)/pi**2, &
                    1.0e-16_dp, "kernel at the origin")
      call is_close(kernel_coefficient(factor, -3, 2, 0.1_dp, 0.2_dp), &
                    kernel_coefficient(factor, 2, -3, 0.2_dp, 0.1_dp), 1.0e-17_dp, "kernel is symmetric")
      do a = 0, 40, 4
         whole = kernel_coefficient(factor, a, a/2, 0.3_dp, 0.6_dp)
         parts = 0.0_dp
         do j = -1, 1
            do i = -1, 1
               parts = parts + kernel_coefficient(factor, 3*a + i, 3*(a/2) + j, 0.1_dp, 0.2_dp)
            end do
         end do
         call is_close(parts/whole, 1.0_dp, 1.0e-12_dp, "kernel of nine cells")
      end do
   end subroutine kernel_is_exact

   !> Under the Hertz pressure of a line contact W + X^2/2 is constant to an error of order 1.5; direct summation and FFT agree
   subroutine row_is_hertz()
      class(deflection_t), allocatable :: engine
      type(grid_t) :: grid
      type(status_t) :: status
      real(dp), allocatable :: p(:, :), w(:, :), other(:, :)
      real(dp) :: error(2)
      integer :: n

      do n = 1, 2
         grid = new_strip(256*2**n + 1, 1, -2.0_dp, 2.0_dp, 0.0_dp)
         associate (x => grid%columns())
            allocate (p(grid%nx, 1), w(grid%nx, 1), other(grid%nx, 1))
            p(:, 1) = sqrt(max(0.0_dp, 1.0_dp - x**2))
            call new_deflection("fft", engine, status, grid)
            call engine%setup(grid, 0.5_dp/pi, 0.0_dp, 1, status)
            call engine%apply(p, w)
            call new_deflection("fft", engine, status)
            call engine%setup(grid, 0.5_dp/pi, 0.0_dp, 2, status)
            call engine%apply(p, other)
            call is_true(.not. status%failed(), "engines of a row")
            call is_close(maxval(abs(w - other)), 0.0_dp, 1.0e-13_dp, "row: sum and FFT")
            ! H00 of the dry contact is -(1 + 2 ln 2)/4
            w(:, 1) = w(:, 1) + 0.5_dp*x**2 - 0.25_dp - 0.5_dp*log(2.0_dp)
            error(n) = maxval(abs(w(:, 1)), mask=abs(x) < 0.8_dp)
         end associate
         deallocate (p, w, other)
      end do
      call is_close(error(2), 0.0_dp, 2.5e-5_dp, "row: Hertz, inside")
      call is_true(error(2) < 0.4_dp*error(1), "row: Hertz converges")
   end subroutine row_is_hertz

   !> The mean over Y of the deflection of a strip is that of a row, and the deflection of a wave of one period along Y is
   !> 2 pi k_b/q, to second order in the mesh size: (q h)^2/24
   subroutine strip_is_periodic()
      class(deflection_t), allocatable :: engine
      type(grid_t) :: grid, row
      type(status_t) :: status
      real(dp), allocatable :: p(:, :), w(:, :), of_row(:, :)
      real(dp), parameter :: factor = 0.5_dp/pi, width = 0.75_dp
      real(dp) :: q
      integer :: j

      grid = new_strip(513, 32, -6.0_dp, 6.0_dp, width)
      row = new_strip(513, 1, -6.0_dp, 6.0_dp, 0.0_dp)
      allocate (p(513, 32), w(513, 32), of_row(513, 1))
      q = 2.0_dp*pi/width
      do j = 1, grid%ny
         p(:, j) = cos(q*grid%y(j))
      end do
      call new_deflection("fft", engine, status, grid)
      call engine%setup(grid, factor, 0.0_dp, 2, status)
      call engine%apply(p, w)
      call is_close(maxval(abs(w(257, :)/p(257, :) - 2.0_dp*pi*factor/q), mask=abs(p(257, :)) > 0.5_dp), 0.0_dp, &
                    2.0_dp*pi*factor/q*(q*grid%hy)**2/20.0_dp, "strip: a wave across")
      call is_close(sum(w)/size(w), 0.0_dp, 1.0e-14_dp, "strip: zero mean")
      do j = 1, grid%ny
         p(:, j) = (1.0_dp + 0.9_dp*p(:, j))*max(0.0_dp, 1.0_dp - grid%columns()**2)
      end do
      call engine%apply(p, w)
      call new_deflection("fft", engine, status, row)
      call engine%setup(row, factor, 0.0_dp, 1, status)
      call engine%apply(reshape(sum(p, dim=2)/grid%ny, [513, 1]), of_row)
      call is_close(maxval(abs(sum(w, dim=2)/grid%ny - of_row(:, 1))), 0.0_dp, 1.0e-12_dp, "strip: its mean is a row")
      call is_true(.not. status%failed(), "engines of a strip")
   end subroutine strip_is_periodic

   !> Half a strip with a pressure that is even in Y has the deflection of the whole strip
   subroutine folded_strip_is_a_strip()
      class(deflection_t), allocatable :: engine
      type(grid_t) :: grid(2)
      type(status_t) :: status
      real(dp), allocatable :: p(:, :), w(:, :), whole(:, :), unfolded(:, :)
      integer :: j, k

      do k = 1, 2
         grid(k) = new_strip(129, 24, -3.0_dp, 3.0_dp, 1.2_dp, mirror=k == 2)
         allocate (p(129, grid(k)%ny), w(129, grid(k)%ny))
         do j = 1, grid(k)%ny
            p(:, j) = (1.0_dp + 0.9_dp*cos(2.0_dp*pi*grid(k)%y(j)/1.2_dp))*max(0.0_dp, 1.0_dp - grid(k)%columns()**2)
         end do
         call new_deflection("fft", engine, status, grid(k))
         call engine%setup(grid(k), 0.5_dp/pi, 0.0_dp, 1, status)
         call engine%apply(p, w)
         if (k == 1) whole = w
         if (k == 2) then
            allocate (unfolded(129, grid(2)%full_ny()))
            call grid(2)%unfold(w, unfolded)
            call is_true(grid(2)%ny == 13 .and. grid(2)%full_ny() == 24, "rows of a folded strip")
            call is_close(sum(grid(2)%weight([(j, j=1, grid(2)%ny)])), grid(1)%hx, 1.0e-14_dp, "weights of a folded strip")
            call is_close(maxval(abs(unfolded - whole)), 0.0_dp, 1.0e-13_dp, "folded strip")
         end if
         deallocate (p, w)
      end do
      call is_true(.not. status%failed(), "engines of half a strip")
   end subroutine folded_strip_is_a_strip

   !> W = 1 - r^2/2 inside the contact, and its continuation outside. The error of the piecewise-constant
   !> pressure is largest at the edge of the contact, where its slope is infinite: 7.7e-4
   !> on 257 x 257, with order 1.4; well inside it is a tenth of that, with order 2.
   subroutine engines_give_hertz()
      real(dp) :: worst(2), inside(2)
      integer :: e, n

      do e = 1, size(deflection_engines)
         do n = 1, 2
            call hertz_error(trim(deflection_engines(e)), 64*2**n + 1, worst(n), inside(n))
         end do
         call is_close(worst(2), 7.7e-4_dp, 0.2e-4_dp, deflection_engines(e)//": Hertz")
         call is_true(worst(2) < 0.4_dp*worst(1), deflection_engines(e)//": Hertz converges")
         call is_true(inside(2) < 1.0e-4_dp, deflection_engines(e)//": Hertz, inside")
         call is_true(inside(2) < 0.3_dp*inside(1), deflection_engines(e)//": Hertz, order 2")
      end do
   end subroutine engines_give_hertz

   !> Largest error of the Hertz deflection, and that for r < 1/2
   subroutine hertz_error(engine, points, worst, inside)
      character(len=*), intent(in) :: engine
      integer, intent(in) :: points
      real(dp), intent(out) :: worst, inside
      type(grid_t) :: grid
      real(dp), allocatable :: p(:, :), w(:, :)
      real(dp) :: r, exact
      integer :: i, j

      grid = new_grid(points, points, -2.5_dp, 1.5_dp, 2.0_dp, .true.)
      call press(hertz, grid, p)
      call deflect(engine, grid, p, 1.0e-5_dp, 1, w)
      worst = 0.0_dp
      inside = 0.0_dp
      do j = 1, grid%ny
         do i = 1, grid%nx
            r = hypot(grid%x(i), grid%y(j))
            if (r <= 1.0_dp) then
               exact = 1.0_dp - 0.5_dp*r**2
            else
               exact = ((2.0_dp - r**2)*asin(1.0_dp/r) + sqrt(r**2 - 1.0_dp))/pi
            end if
            worst = max(worst, abs(w(i, j) - exact))
            if (r < 0.5_dp) inside = max(inside, abs(w(i, j) - exact))
         end do
      end do
   end subroutine hertz_error

   !> The FFT is exact for any pressure on the border
   subroutine fft_is_direct()
      type(grid_t) :: grid
      integer :: g

      do g = 1, grids
         grid = some_grid(g)
         call is_true(difference("fft", grid, random, 0.0_dp) < 1.0e-12_dp, &
                      "fft is direct on "//named(grid))
      end do
   end subroutine fft_is_direct

   !> MLMI reaches the requested accuracy
   subroutine mlmi_is_direct()
      type(grid_t) :: grid
      real(dp), parameter :: accuracy(4) = [1.0e-3_dp, 2.0e-5_dp, 1.0e-7_dp, 1.0e-10_dp]
      integer :: g, which, a

      do g = 1, grids
         grid = some_grid(g)
         do which = hertz, patch
            do a = 1, size(accuracy)
               call is_true(difference("mlmi", grid, which, accuracy(a)) &
                            < accuracy(a), "mlmi is direct on "//named(grid)//", " &
                            //trim(kind_name(which))//" pressure")
            end do
         end do
      end do
   end subroutine mlmi_is_direct

   !> Half a symmetric contact has the deflection of the whole contact
   subroutine folded_is_whole()
      type(grid_t) :: half, whole
      real(dp), allocatable :: p(:, :), p_whole(:, :), w(:, :), w_whole(:, :)
      integer :: e, which, n

      half = new_grid(129, 129, -2.5_dp, 1.5_dp, 1.7_dp, .true.)
      whole = new_grid(129, 129, -2.5_dp, 1.5_dp, 1.7_dp, .false.)
      n = half%ny
      allocate (p_whole(whole%nx, whole%ny))
      do e = 1, size(deflection_engines)
         do which = hertz, random
            call press(which, half, p)
            p_whole(:, n:) = p
            p_whole(:, :n) = p(:, n:1:-1)
            call deflect(trim(deflection_engines(e)), half, p, 1.0e-5_dp, 1, w)
            call deflect(trim(deflection_engines(e)), whole, p_whole, 1.0e-5_dp, 1, w_whole)
            call is_true(maxval(abs(w - w_whole(:, n:))) < 1.0e-13_dp*maxval(w), &
                         deflection_engines(e)//": folded is whole, "//trim(kind_name(which)))
         end do
      end do
   end subroutine folded_is_whole

   !> The result does not depend on the number of threads, to the bit
   subroutine threads_do_not_matter()
      type(grid_t) :: grid
      real(dp), allocatable :: p(:, :), one(:, :), more(:, :)
      integer :: e, fold, threads

      do fold = 0, 1
         grid = new_grid(129, 129, -2.5_dp, 1.5_dp, 2.0_dp, fold == 1)
         call press(inlet, grid, p)
         do e = 1, size(deflection_engines)
            call deflect(trim(deflection_engines(e)), grid, p, 1.0e-5_dp, 1, one)
            do threads = 2, 4, 2
               call deflect(trim(deflection_engines(e)), grid, p, 1.0e-5_dp, threads, more)
               call is_true(all(abs(more - one) <= 0.0_dp), &
                            deflection_engines(e)//": threads do not matter")
            end do
         end do
      end do
   end subroutine threads_do_not_matter

   !> An earlier application has no effect, on the same grid or on another
   subroutine history_does_not_matter()
      class(deflection_t), allocatable :: engine
      type(grid_t) :: grid
      type(status_t) :: status
      real(dp), allocatable :: p(:, :), w(:, :), fresh(:, :), zero(:, :)
      integer :: e

      do e = 1, size(deflection_engines)
         call new_deflection(trim(deflection_engines(e)), engine, status)
         grid = new_grid(33, 33, -1.5_dp, 1.5_dp, 1.5_dp, .false.)
         call engine%setup(grid, factor, 1.0e-3_dp, 2, status)
         grid = new_grid(65, 65, -2.5_dp, 1.5_dp, 2.0_dp, .true.)
         call engine%setup(grid, factor, 1.0e-5_dp, 1, status)
         call is_true(.not. status%failed(), deflection_engines(e)//": set up again")
         call press(random, grid, p)
         allocate (w, mold=p)
         call engine%apply(p, w)
         call press(patch, grid, p)
         call engine%apply(p, w)
         call deflect(trim(deflection_engines(e)), grid, p, 1.0e-5_dp, 1, fresh)
         call is_true(all(abs(w - fresh) <= 0.0_dp), deflection_engines(e)//": no effect of earlier pressures")
         zero = 0.0_dp*p
         call engine%apply(zero, w)
         call is_true(all(abs(w) <= 0.0_dp), deflection_engines(e)//": zero for zero pressure")
         deallocate (w)
      end do
   end subroutine history_does_not_matter

   !> The deflection is linear in the scale of the pressure
   subroutine scale_does_not_matter()
      type(grid_t) :: grid
      real(dp), allocatable :: p(:, :), w(:, :), tiny_w(:, :)
      real(dp), parameter :: scale = 2.0_dp**(-60)
      integer :: e

      grid = new_grid(65, 65, -2.5_dp, 1.5_dp, 2.0_dp, .false.)
      call press(inlet, grid, p)
      do e = 1, size(deflection_engines)
         call deflect(trim(deflection_engines(e)), grid, p, 1.0e-4_dp, 1, w)
         call deflect(trim(deflection_engines(e)), grid, scale*p, 1.0e-4_dp, 1, tiny_w)
         call is_true(all(abs(tiny_w - scale*w) <= 0.0_dp), &
                      deflection_engines(e)//": scale does not matter")
      end do
   end subroutine scale_does_not_matter

   !> Memory is proportional to the number of nodes, and is that of a few fields
   subroutine memory_is_linear()
      class(deflection_t), allocatable :: engine
      type(status_t) :: status
      type(grid_t) :: grid
      integer(int64) :: bytes(2)
      integer :: e, n

      do e = 1, size(deflection_engines)
         call new_deflection(trim(deflection_engines(e)), engine, status)
         call is_true(engine%bytes() == 0, deflection_engines(e)//": no memory before setup")
         do n = 1, 2
            grid = new_grid(64*2**n + 1, 64*2**n + 1, -2.5_dp, 1.5_dp, 2.0_dp, .false.)
            call engine%setup(grid, factor, 1.0e-4_dp, 1, status)
            bytes(n) = engine%bytes()
         end do
         call is_true(bytes(2) < 4.5_dp*bytes(1) .and. bytes(2) > 3.0_dp*bytes(1), &
                      deflection_engines(e)//": memory is linear")
         call is_true(bytes(2) < 6*8*grid%nx*grid%ny, deflection_engines(e)//": memory")
      end do
   end subroutine memory_is_linear

   !> Unknown engines and unreachable accuracies are refused
   subroutine bad_requests_are_refused()
      class(deflection_t), allocatable :: engine
      type(status_t) :: unknown, out_of_reach

      call new_deflection("fmm", engine, unknown)
      call is_equal(unknown%code, ehl_bad_input, "unknown engine")
      call has_text(unknown%message, "'fmm'", "unknown engine")
      call is_true(.not. allocated(engine), "no engine of an unknown name")
      call new_deflection("mlmi", engine, out_of_reach)
      call engine%setup(new_grid(65, 65, -2.5_dp, 1.5_dp, 2.0_dp, .false.), factor, 1.0e-13_dp, 1, &
                        out_of_reach)
      call is_equal(out_of_reach%code, ehl_bad_input, "accuracy out of reach")
      call has_text(out_of_reach%message, "1.00E-13", "accuracy out of reach")
   end subroutine bad_requests_are_refused

   !> Largest difference between an engine and direct summation, relative to the largest deflection
   real(dp) function difference(engine, grid, which, accuracy)
      character(len=*), intent(in) :: engine
      type(grid_t), intent(in) :: grid
      integer, intent(in) :: which
      real(dp), intent(in) :: accuracy
      real(dp), allocatable :: p(:, :), w(:, :), exact(:, :)

      call press(which, grid, p)
      allocate (exact, mold=p)
      call sum_directly(grid, factor, p, exact)
      call deflect(engine, grid, p, accuracy, 1, w)
      difference = maxval(abs(w - exact))/maxval(abs(exact))
   end function difference

   !> Deflection w by a new engine
   subroutine deflect(name, grid, p, accuracy, threads, w)
      character(len=*), intent(in) :: name
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: p(:, :), accuracy
      integer, intent(in) :: threads
      real(dp), allocatable, intent(out) :: w(:, :)
      class(deflection_t), allocatable :: engine
      type(status_t) :: status

      allocate (w(grid%nx, grid%ny))
      call new_deflection(name, engine, status)
      if (.not. status%failed()) call engine%setup(grid, factor, accuracy, threads, status)
      call is_true(.not. status%failed(), name//" is set up")
      if (status%failed()) then
         w = huge(1.0_dp)
      else
         call engine%apply(p, w)
      end if
   end subroutine deflect
end module test_deflection

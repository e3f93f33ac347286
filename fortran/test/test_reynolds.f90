! SPDX-License-Identifier: BSD-3-Clause
!> The discrete Reynolds equation: its Poiseuille term, also with different conductances along X and Y, and the
!> Jacobian of the coarsest grid
module test_reynolds
   use check, only: is_close, is_true
   use ehl_coarsest, only: coarsest_t
   use ehl_deflection_factory, only: new_deflection
   use ehl_reynolds, only: refresh
   use ehl_flow, only: dir_x, flow_t
   use ehl_flow_factory, only: new_flow
   use ehl_grid, only: grid_t, new_grid
   use ehl_kinds, only: dp, pi
   use ehl_level, only: level_t
   use ehl_lubricant, only: density_dowson_higginson, lubricant_t, new_lubricant, viscosity_roelands
   use ehl_nine_point, only: nine_point_t
   use ehl_poiseuille, only: line_terms_t, max_neighbours, poiseuille_t
   use ehl_status, only: status_t
   implicit none (type, external)
   private
   public :: run_reynolds

   !> A flow with different conductances along X and Y, which increase less with the film than Newtonian ones
   type, extends(flow_t) :: uneven_flow_t
   contains
      procedure :: find_row
      procedure :: film_exponent
      procedure :: stress_row
   end type uneven_flow_t
   !> d ln(eps)/d ln(H) along X and Y
   real(dp), parameter :: powers(2) = [2.0_dp, 2.5_dp]

contains

   subroutine run_reynolds()
      call term_of_polynomials()
      call forms_agree()
      call jacobian_against_differences()
   end subroutine run_reynolds

   !> For linear conductances and a quadratic pressure the five-point difference is exact
   subroutine term_of_polynomials()
      type(poiseuille_t) :: poiseuille
      type(uneven_flow_t) :: flow
      type(grid_t) :: grid
      type(status_t) :: status
      real(dp) :: p(41, 33), row(41), largest
      integer :: i, j

      grid = grid_t(nx=41, ny=33, x0=-1.2_dp, y0=-0.9_dp, hx=0.05_dp, hy=0.06_dp)
      flow%dir_y = 2
      call flow%setup(grid, status)
      call poiseuille%setup(grid)
      do j = 1, grid%ny
         do i = 1, grid%nx
            associate (x => grid%x(i), y => grid%y(j))
               p(i, j) = x**2 + 3.0_dp*y**2 + x*y
               flow%eps(i, j, :) = [2.0_dp + x + y, 5.0_dp - y + 2.0_dp*x]
            end associate
         end do
      end do
      largest = 0.0_dp
      do j = 2, grid%ny - 1
         call poiseuille%apply_row(p, flow, j, row)
         do i = 2, grid%nx - 1
            associate (x => grid%x(i), y => grid%y(j))
               largest = max(largest, abs(row(i) - (2.0_dp*x + y + 2.0_dp*(2.0_dp + x + y)) &
                                          - (6.0_dp*(5.0_dp - y + 2.0_dp*x) - 6.0_dp*y - x)))
            end associate
         end do
      end do
      call is_close(largest, 0.0_dp, 1.0e-10_dp, "Poiseuille term of polynomials")
      call is_true(.not. status%failed(), "an uneven flow")
   end subroutine term_of_polynomials

   !> The term of a row, its part in a line system, the couplings of single nodes and the frozen operator agree
   subroutine forms_agree()
      type(poiseuille_t) :: poiseuille, product
      class(flow_t), allocatable :: flow
      type(lubricant_t) :: no_lubricant
      type(grid_t) :: grid
      type(status_t) :: status
      type(line_terms_t) :: terms
      real(dp), dimension(17) :: row, frozen, rhs
      real(dp) :: p(17, 9), coupling(max_neighbours), rate(max_neighbours), excess, sums, largest(3)
      integer :: i, j, m, n, kind, neighbour(2, max_neighbours), direction(max_neighbours)

      do kind = 1, 3
         grid = grid_t(nx=17, ny=9, x0=-1.0_dp, y0=0.0_dp, hx=0.1_dp, hy=0.15_dp, mirror=kind < 3, periodic=kind == 3)
         if (kind /= 2) call new_flow(no_lubricant, 1.0_dp, flow)
         if (kind == 2) then
            deallocate (flow)
            allocate (uneven_flow_t :: flow)
            flow%dir_y = 2
         end if
         call flow%setup(grid, status)
         call scatter(flow%eps(:, :, dir_x))
         if (kind == 2) call scatter(flow%eps(:, :, 2))
         call scatter(p)
         call poiseuille%setup(grid)
         call product%setup(grid)
         product%product = nine_point_t()
         call product%prepare_product(status)
         call poiseuille%integrate(flow, 1, grid%last_inner(), product%product)
         product%frozen = .true.
         largest = 0.0_dp
         rhs = 0.7_dp
         do j = 1, grid%last_inner()
            call poiseuille%apply_row(p, flow, j, row)
            call product%apply_row(p, flow, j, frozen)
            largest(1) = max(largest(1), maxval(abs(row(2:16) - frozen(2:16))))
            call poiseuille%line_row(p, flow, rhs, j, 1, 17, terms)
            largest(2) = max(largest(2), maxval(abs(0.7_dp - terms%rest(2:16) - row(2:16))))
            do i = 2, grid%nx - 1
               call poiseuille%couplings(flow, i, j, n, neighbour, direction, coupling, rate, excess)
               sums = -excess*p(i, j)
               do m = 1, n
                  sums = sums + coupling(m)*(p(neighbour(1, m), neighbour(2, m)) - p(i, j))
               end do
               largest(3) = max(largest(3), abs(sums - row(i)), abs(coupling(1) - terms%east(i)), &
                                abs(coupling(3) + coupling(4) + terms%other(i)))
            end do
         end do
         call is_close(largest(1), 0.0_dp, 1.0e-11_dp, "frozen five-point operator")
         call is_close(largest(2), 0.0_dp, 1.0e-11_dp, "residual of a line system")
         call is_close(largest(3), 0.0_dp, 1.0e-11_dp, "couplings of a node")
      end do
      call is_true(.not. status%failed(), "operators")
   end subroutine forms_agree

   !> The coarsest grid's Jacobian times a random change equals the change of the residual, with the force balance
   subroutine jacobian_against_differences()
      type(level_t) :: level
      type(coarsest_t) :: coarsest
      type(status_t) :: status
      real(dp), allocatable :: change(:), p(:, :), before(:), wanted(:)
      real(dp), parameter :: step = 1.0e-6_dp
      real(dp) :: norm, h00
      integer :: half, kind

      do half = 0, 1
         do kind = 1, 2
            call some_level(level, half == 1, kind == 2, status)
            call coarsest%setup(level%grid, level%kernel_factor, status)
            call is_true(.not. status%failed(), "a level")
            call refresh(level)
            call is_true(minval(level%h) > 0.0_dp, "a positive film")
            call coarsest%find_residual(level, norm)
            call is_true(any(coarsest%cavitated) .and. .not. all(coarsest%cavitated), "cavitated nodes and others")
            call coarsest%assemble(level)
            allocate (change(coarsest%n + 1), wanted(coarsest%n + 1))
            call scatter_line(change)
            ! at P = 0 the equation has a kink
            where (pack(level%p(2:level%grid%nx - 1, coarsest%first:coarsest%last), .true.) <= 0.0_dp)
               change(:coarsest%n) = 0.0_dp
            end where
            p = level%p
            h00 = level%h00
            call residual_at(step)
            before = coarsest%residual
            call residual_at(-step)
            wanted = (coarsest%residual - before)/(2.0_dp*step)
            call is_close(maxval(abs(matmul(change, coarsest%jacobian) - wanted))/maxval(abs(wanted)), 0.0_dp, 1.0e-7_dp, &
                          "Jacobian of the coarsest grid")
            deallocate (change, wanted)
            call clear()
         end do
      end do

   contains

      !> Residual with the unknowns changed by part*change
      subroutine residual_at(part)
         real(dp), intent(in) :: part
         integer :: j

         do j = coarsest%first, coarsest%last
            associate (from => (j - coarsest%first)*(level%grid%nx - 2))
               level%p(2:level%grid%nx - 1, j) = p(2:level%grid%nx - 1, j) + part*change(from + 1:from + level%grid%nx - 2)
            end associate
         end do
         level%h00 = h00 + part*change(coarsest%n + 1)
         call refresh(level)
         call coarsest%find_residual(level, norm)
      end subroutine residual_at

      subroutine clear()
         type(level_t) :: no_level
         type(coarsest_t) :: nothing

         level = no_level
         coarsest = nothing
      end subroutine clear
   end subroutine jacobian_against_differences

   !> A level with a pressure that ends before the outlet
   subroutine some_level(level, mirror, uneven, status)
      type(level_t), intent(inout) :: level
      logical, intent(in) :: mirror, uneven
      type(status_t), intent(inout) :: status
      integer :: i, j

      level%grid = new_grid(17, 17, -2.5_dp, 1.5_dp, 2.0_dp, mirror)
      level%lubricant = new_lubricant(viscosity_roelands, density_dowson_higginson, 6.0_dp, 1.0e9_dp, 0.6_dp, 1.96e8_dp)
      if (uneven) then
         allocate (uneven_flow_t :: level%flow)
         level%flow%dir_y = 2
         level%flow%inverse_speed = 50.0_dp
      else
         call new_flow(level%lubricant, 0.02_dp, level%flow)
      end if
      call level%setup(status)
      call new_deflection("fft", level%engine, status)
      level%kernel_factor = 2.0_dp/pi**2
      call level%engine%setup(level%grid, level%kernel_factor, 1.0e-12_dp, 1, status)
      level%h00 = -0.5_dp
      level%load = 2.0_dp
      do j = 1, level%grid%ny
         do i = 1, level%grid%nx
            associate (x => level%grid%x(i), y => level%grid%y(j))
               level%film_rhs(i, j) = 0.5_dp*(x**2 + y**2)
               level%p(i, j) = max(0.0_dp, 1.2_dp*exp(-x**2 - y**2) - 0.1_dp*max(0.0_dp, x + 0.3_dp*sin(5.0_dp*y)**2))
               if (level%grid%is_border(j) .or. i == 1 .or. i == level%grid%nx) level%p(i, j) = 0.0_dp
            end associate
         end do
      end do
   end subroutine some_level

   !> eps_x = 2 rho H^2/eta^0.7, eps_y = rho H^2.5/eta^0.4
   pure subroutine find_row(self, lubricant, p, h, rho, drho_dp, j, last)
      class(uneven_flow_t), intent(inout) :: self
      type(lubricant_t), intent(in) :: lubricant
      real(dp), contiguous, intent(in) :: p(:, :), h(:), rho(:), drho_dp(:)
      integer, intent(in) :: j, last
      real(dp), dimension(size(p, 1)) :: log_eta, slope

      associate (unused => last)
      end associate
      call lubricant%log_viscosity(max(p(:, j), 0.0_dp), log_eta, slope)
      self%eps(:, j, 1) = 2.0_dp*rho*h**powers(1)*exp(-0.7_dp*log_eta)*self%inverse_speed
      self%eps(:, j, 2) = rho*h**powers(2)*exp(-0.4_dp*log_eta)*self%inverse_speed
      self%dlneps_dp(:, j, 1) = drho_dp/rho - 0.7_dp*slope
      self%dlneps_dp(:, j, 2) = drho_dp/rho - 0.4_dp*slope
   end subroutine find_row

   pure real(dp) function film_exponent(self, i, j, direction)
      class(uneven_flow_t), intent(in) :: self
      integer, intent(in) :: i, j, direction
      associate (unused => self%dir_y + i + j)
      end associate
      film_exponent = powers(direction)
   end function film_exponent

   pure subroutine stress_row(self, lubricant, p, h, rho, j, newtonian, stress)
      class(uneven_flow_t), intent(in) :: self
      type(lubricant_t), intent(in) :: lubricant
      real(dp), contiguous, intent(in) :: p(:, :), h(:), rho(:)
      integer, intent(in) :: j
      real(dp), contiguous, intent(out) :: newtonian(:), stress(:)

      associate (unused => lubricant, unused_p => p)
      end associate
      newtonian = self%inverse_speed*rho*h**2/self%eps(:, j, dir_x)
      stress = newtonian
   end subroutine stress_row

   !> Pseudo-random numbers between 0 and 1
   subroutine scatter(values)
      real(dp), intent(out) :: values(:, :)
      integer :: j

      do j = 1, size(values, 2)
         call scatter_line(values(:, j))
         values(:, j) = modulo(values(:, j) + 0.618_dp*j, 1.0_dp)
      end do
   end subroutine scatter

   subroutine scatter_line(values)
      real(dp), intent(out) :: values(:)
      real(dp) :: seed
      integer :: i

      seed = 0.37_dp
      do i = 1, size(values)
         seed = modulo(seed*997.0_dp + 0.1234567_dp, 1.0_dp)
         values(i) = seed
      end do
   end subroutine scatter_line
end module test_reynolds

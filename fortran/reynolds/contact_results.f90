! SPDX-License-Identifier: BSD-3-Clause
!> Results of a solution: film thicknesses, pressure, friction, load
module ehl_contact_results
   use ehl_reynolds, only: load_excess
   use ehl_grid, only: grid_t
   use ehl_kinds, only: dp
   use ehl_level, only: gap_row, level_t
   use ehl_oil_flow, only: measure_flow, oil_flow_t
   use ehl_touching, only: measure_touching, touching_t
   implicit none (type, external)
   private
   public :: contact_results_t, measure, central_row, central_value, load_tolerance

   !> Maximum relative error of the force balance of a solution
   real(dp), parameter :: load_tolerance = 1.0e-6_dp

   !> Maximum relative deficit of the boundary film at a node of a solution
   real(dp), parameter :: film_tolerance = 1.0e-2_dp

   !> Results of one state. Dimensionless: films by a^2/R, pressure by p_h.
   type :: contact_results_t
      !> Film at X = Y = 0, minimum film, maximum pressure
      real(dp) :: film_central = 0.0_dp, film_minimum = 0.0_dp, pressure_maximum = 0.0_dp
      !> Friction integral: iint tau dX dY over the Newtonian stress of eta = eta0 and H = 1. For a Newtonian lubricant
      !> that is iint eta/(eta0 H) dX dY at any sliding speed (Zhang et al. 2019, eq. 5)
      real(dp) :: friction = 0.0_dp
      !> Friction integral of a Newtonian lubricant, without the shear law
      real(dp) :: friction_newtonian = 0.0_dp
      !> Load that the nodes have to sustain, and its relative error
      real(dp) :: load = 0.0_dp
      real(dp) :: load_error = 0.0_dp
      !> Whether every number is finite, and every film positive
      logical :: finite = .false., positive = .false.
      !> Whether no film is thinner than the boundary film; in an iterate it may be
      logical :: holds = .true.
      !> Solid contact. Its friction is that of the boundary film, or 0 where that is not given.
      type(touching_t) :: touching
      !> Oil flow of a starved inlet
      type(oil_flow_t) :: oil
   contains
      procedure :: films
      procedure :: scale
   end type contact_results_t

contains

   !> Evaluate the present state of a level whose film and coefficients are up to date
   function measure(level) result(m)
      type(level_t), intent(in) :: level
      type(contact_results_t) :: m
      real(dp), dimension(level%grid%ny) :: smallest, largest, friction, newtonian
      real(dp), dimension(level%grid%nx) :: viscous, stress
      integer :: j

      !$omp parallel do default(none) shared(level, smallest, largest, friction, newtonian) private(viscous, stress) &
      !$omp num_threads(level%threads) if(level%parallel) schedule(static)
      do j = 1, level%grid%ny
         smallest(j) = minval(gap_row(level, j))
         largest(j) = maxval(level%p(:, j))
         call level%flow%stress_row(level%lubricant, level%p, level%boundary%film_row(level%h(:, j), j), level%rho(:, j), j, &
                                    viscous, stress)
         call level%boundary%stress_row(level%p(:, j), level%mass_content(:, j), level%lubricant%boundary_stress, viscous, stress)
         newtonian(j) = sum(viscous)*level%grid%weight(j)
         friction(j) = sum(stress)*level%grid%weight(j)
      end do
      !$omp end parallel do
      m%film_minimum = minval(smallest)
      m%pressure_maximum = maxval(largest)
      m%friction = sum(friction)
      m%friction_newtonian = sum(newtonian)
      m%load = level%load
      m%load_error = load_excess(level)
      m%film_central = central_of_row(level%grid, gap_row(level, central_row(level%grid)))
      ! a NaN fails every comparison
      m%finite = abs(m%load_error) < huge(1.0_dp) .and. abs(m%film_central) < huge(1.0_dp) &
                 .and. m%friction < huge(1.0_dp) .and. abs(m%film_minimum) < huge(1.0_dp)
      m%positive = level%boundary%has_film(all(smallest > 0.0_dp))
      m%holds = level%boundary%holds(level%mass_content, film_tolerance)
      m%touching = measure_touching(level)
      m%oil = measure_flow(level)
   end function measure

   !> Central film and minimum film
   pure function films(self)
      class(contact_results_t), intent(in) :: self
      real(dp) :: films(2)
      films = [self%film_central, self%film_minimum]
   end function films

   !> Scale films, pressure and friction by the ratios of `to` to `from`
   pure subroutine scale(self, from, to)
      class(contact_results_t), intent(inout) :: self
      type(contact_results_t), intent(in) :: from, to

      self%film_central = self%film_central*to%film_central/from%film_central
      self%film_minimum = self%film_minimum*to%film_minimum/from%film_minimum
      self%pressure_maximum = self%pressure_maximum*to%pressure_maximum/from%pressure_maximum
      self%friction = self%friction*to%friction/from%friction
   end subroutine scale

   !> Value of a field at X = Y = 0; between two nodes by cubic interpolation along X
   pure real(dp) function central_value(grid, values)
      type(grid_t), intent(in) :: grid
      !> Shape (nx, ny)
      real(dp), intent(in) :: values(:, :)

      central_value = central_of_row(grid, values(:, central_row(grid)))
   end function central_value

   !> Row at Y = 0
   pure integer function central_row(grid)
      type(grid_t), intent(in) :: grid
      central_row = 1 + nint((0.0_dp - grid%y0)/grid%hy)
   end function central_row

   !> Value of the row at Y = 0, values(nx), at X = 0
   pure real(dp) function central_of_row(grid, values)
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: values(:)
      real(dp) :: t
      integer :: i

      t = (0.0_dp - grid%x0)/grid%hx
      i = nint(t)
      if (abs(t - i) < 1.0e-9_dp) then
         central_of_row = values(i + 1)
         return
      end if
      i = int(t) + 1
      t = t - (i - 1)
      associate (v => values(i - 1:i + 2))
         central_of_row = -t*(t - 1.0_dp)*(t - 2.0_dp)/6.0_dp*v(1) + (t*t - 1.0_dp)*(t - 2.0_dp)/2.0_dp*v(2) &
                         - t*(t + 1.0_dp)*(t - 2.0_dp)/2.0_dp*v(3) + t*(t*t - 1.0_dp)/6.0_dp*v(4)
      end associate
   end function central_of_row
end module ehl_contact_results

! SPDX-License-Identifier: BSD-3-Clause
!> Friction with the temperature of the film
!>
!> The frictional heat q = tau |u1 - u2| heats the walls and the film (contact/wall_heat.f90), and the shear stress tau
!> follows from the shear law at eta(p, T). Heat is not conducted upstream: a row is solved from
!> node to node, each by one equation f(q) = q - |u1 - u2| tau(T(q)) = 0 that has one root, because tau decreases with T and T
!> increases with q. Pressure and film are those of the isothermal flow; a contact that changes in time is treated as
!> quasi-steady. Where the bodies touch at a boundary film the stress is mu_b P at any temperature; its heat enters the
!> walls as that of the film does, and the boundary film has the conductivity of the lubricant.
module ehl_heated_friction
   use ehl_flow, only: flow_t
   use ehl_grid, only: grid_t
   use ehl_kinds, only: dp
   use ehl_lubricant, only: lubricant_t
   use ehl_wall_heat, only: heat_response_t, wall_heat_t
   use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
   implicit none (type, external)
   private
   public :: film_heat_t, heated_t, heat_film

   !> Heat that raises the temperature of film and walls by less than this [K] is neglected
   real(dp), parameter :: negligible = 1.0e-4_dp
   !> Relative tolerance of the heat of a node; maximum number of steps, of which every sixth is a bisection (27 of these suffice)
   real(dp), parameter :: tolerance = 1.0e-8_dp
   integer, parameter :: max_steps = 200, bisect_after = 6

   !> Input of the heat calculation of a contact
   type :: film_heat_t
      !> Sliding speed |u1 - u2| [m/s], thermal conductivity of the lubricant [W/(m K)]
      real(dp) :: speed = 0.0_dp, conductivity = 0.0_dp
      !> Source strengths of wall 1 and wall 2, see wall_strength [K m^(3/2)/W]
      real(dp) :: strengths(2) = 0.0_dp
      !> Scales of lengths and films: a, a^2/R [m]
      real(dp) :: length = 0.0_dp, film = 0.0_dp
   end type film_heat_t

   !> Friction and temperature of a contact
   type :: heated_t
      !> Friction integral as in contact_results_t, with and without heating
      real(dp) :: friction = 0.0_dp, isothermal = 0.0_dp
      !> Maximum temperature rise above the inlet [K]: of the mean across the film, of wall 1, of wall 2
      real(dp) :: max_rise(3) = 0.0_dp
      !> Whether every node was solved
      logical :: solved = .false.
      !> Whether there was memory for the temperature rises at the nodes
      logical :: fits = .true.
      !> Temperature rises at the nodes (nx, ny, 3), if requested
      real(dp), allocatable :: rise(:, :, :)
   contains
      procedure :: ratio
   end type heated_t

contains

   !> Friction with heating over that without it; NaN where it is not known
   pure real(dp) function ratio(self)
      class(heated_t), intent(in) :: self
      ratio = ieee_value(ratio, ieee_quiet_nan)
      if (self%solved) ratio = self%friction/self%isothermal
   end function ratio

   !> Friction and temperature of a contact
   subroutine heat_film(heat, grid, lubricant, p, h, keep, threads, found, flow, rho, touching)
      type(film_heat_t), intent(in) :: heat
      type(grid_t), intent(in) :: grid
      type(lubricant_t), intent(in) :: lubricant
      !> Pressure and film, shape (nx, ny)
      real(dp), contiguous, intent(in) :: p(:, :), h(:, :)
      !> Whether the temperature rises at the nodes are requested
      logical, intent(in) :: keep
      integer, intent(in) :: threads
      type(heated_t), intent(out) :: found
      !> The flow, for the isothermal stress, and the density (nx, ny); absent: the stress of the shear law in sliding alone
      class(flow_t), intent(in), optional :: flow
      real(dp), contiguous, intent(in), optional :: rho(:, :)
      !> Where the bodies touch at the boundary film (nx, ny); absent: nowhere
      logical, contiguous, intent(in), optional :: touching(:, :)
      type(wall_heat_t) :: walls
      real(dp), dimension(grid%ny) :: friction, isothermal
      real(dp) :: max_rise(3, grid%ny), rise(grid%nx, 3), newtonian(grid%nx), stress(grid%nx)
      logical :: solved(grid%ny), solid(grid%nx)
      integer :: j, stat

      call walls%start(grid%nx, grid%hx*heat%length, heat%strengths)
      if (keep) then
         allocate (found%rise(grid%nx, grid%ny, 3), stat=stat)
         found%fits = stat == 0
         if (.not. found%fits) return
      end if
      !$omp parallel do default(none) shared(heat, grid, lubricant, p, h, keep, found, flow, rho, touching, walls, &
      !$omp friction, isothermal, max_rise, solved) private(rise, newtonian, stress, solid) &
      !$omp num_threads(threads) if(threads > 1) schedule(dynamic)
      do j = 1, grid%ny
         if (present(flow)) then
            call flow%stress_row(lubricant, p, h(:, j), rho(:, j), j, newtonian, stress)
         else
            stress = law_stress(lubricant, p(:, j), h(:, j), spread(0.0_dp, 1, grid%nx))
         end if
         solid = .false.
         if (present(touching)) solid = touching(:, j)
         where (solid) stress = lubricant%boundary_stress*p(:, j)
         isothermal(j) = sum(stress)*grid%weight(j)
         call heat_row(heat, walls, lubricant, p(:, j), h(:, j), solid, stress, rise, solved(j))
         friction(j) = sum(stress)*grid%weight(j)
         max_rise(:, j) = maxval(rise, dim=1)
         if (keep) found%rise(:, j, :) = rise
      end do
      !$omp end parallel do
      found%friction = sum(friction)
      found%isothermal = sum(isothermal)
      found%max_rise = maxval(max_rise, dim=2)
      found%solved = all(solved)
   end subroutine heat_film

   !> Temperature rises of film and walls in one row [K]
   pure subroutine heat_row(heat, walls, lubricant, p, h, solid, stress, rise, solved)
      type(film_heat_t), intent(in) :: heat
      type(wall_heat_t), intent(in) :: walls
      type(lubricant_t), intent(in) :: lubricant
      real(dp), intent(in) :: p(:), h(:)
      !> Where the stress is that of the boundary film, at any temperature
      logical, intent(in) :: solid(:)
      !> Shear stress over the scale of the law: in isothermal, out with heating
      real(dp), intent(inout) :: stress(:)
      !> Shape (nx, 3)
      real(dp), intent(out) :: rise(:, :)
      logical, intent(out) :: solved
      type(heat_response_t) :: response
      !> Heat into each wall; heat of a node over the stress of the law at its pressure and film
      real(dp) :: into(size(p), 2), factor(size(p)), flux, wall_rise, before(2), reduction, q, difference
      logical :: node_solved
      integer :: i, k, first, last

      rise = 0.0_dp
      into = 0.0_dp
      solved = .true.
      flux = heat%speed*lubricant%shear%scale
      ! temperature rise of the walls by unit heat on the whole row
      wall_rise = sqrt(2.0_dp*size(p))*maxval(walls%own)
      associate (counts => flux*stress*(wall_rise + heat%film*h/(12.0_dp*heat%conductivity)) > negligible)
         first = findloc(counts, .true., dim=1)
         last = findloc(counts, .true., dim=1, back=.true.)
      end associate
      if (first == 0) return
      factor = law_stress(lubricant, p, h, rise(:, 1))
      ! a limiting stress is 0 where the pressure is 0
      where (factor > 0.0_dp) factor = flux*stress/factor
      reduction = 1.0_dp
      do i = first, size(p)
         do k = 1, 2
            before(k) = walls%history(k, into(:, k), first, i - 1, i)
         end do
         response = walls%response(before, heat%film*h(i), heat%conductivity)
         q = 0.0_dp
         if (solid(i)) then
            q = flux*stress(i)
         else if (i <= last) then
            call heat_node(lubricant, p(i), h(i), factor(i), response%film, reduction, q, node_solved)
            solved = solved .and. node_solved
            stress(i) = q/flux
         end if
         ! the hotter wall heats the other one through the film, also where there is no frictional heat
         difference = response%difference(1) + response%difference(2)*q
         into(i, :) = 0.5_dp*[q + difference, q - difference]
         rise(i, 1) = response%film(1) + response%film(2)*q
         rise(i, 2:) = before + walls%own*into(i, :)
      end do
   end subroutine heat_row

   !> Heat q [W/m^2] of a node: `factor` times the stress of the law at the temperature rise film(1) + film(2) q. Bracketed
   !> secant method; reduction: heat over that at q = 0, in at the previous node as the initial guess, out at this one.
   pure subroutine heat_node(lubricant, p, h, factor, film, reduction, q, solved)
      type(lubricant_t), intent(in) :: lubricant
      real(dp), intent(in) :: p, h, factor, film(2)
      real(dp), intent(inout) :: reduction
      real(dp), intent(out) :: q
      logical, intent(out) :: solved
      real(dp) :: q_max, low, high, before, f, f_before, next
      integer :: k

      q_max = heat_at(0.0_dp)
      q = q_max
      solved = .true.
      if (.not. q_max > 0.0_dp) return
      low = 0.0_dp
      high = q_max
      before = 0.0_dp
      f_before = -q_max
      q = reduction*q_max
      do k = 1, max_steps
         f = q - heat_at(q)
         solved = abs(f) <= tolerance*q_max
         if (solved) exit
         if (f > 0.0_dp) then
            high = q
         else
            low = q
         end if
         next = 0.5_dp*(low + high)
         ! bisect if the secant step leaves the bracket, and after every few secant steps
         if (abs(f - f_before) > 0.0_dp .and. mod(k, bisect_after) > 0) next = q - f*(q - before)/(f - f_before)
         if (.not. (next >= low .and. next <= high)) next = 0.5_dp*(low + high)
         before = q
         f_before = f
         q = next
      end do
      reduction = q/q_max

   contains

      !> Heat at the temperature rise by q
      pure real(dp) function heat_at(q)
         real(dp), intent(in) :: q
         real(dp) :: stress(1)
         stress = law_stress(lubricant, [p], [h], [film(1) + film(2)*q])
         heat_at = factor*stress(1)
      end function heat_at
   end subroutine heat_node

   !> Shear stress by sliding at pressures, films and temperature rises [K], over the scale of the law
   pure function law_stress(lubricant, p, h, rise) result(stress)
      type(lubricant_t), intent(in) :: lubricant
      real(dp), intent(in) :: p(:), h(:), rise(:)
      real(dp) :: stress(size(p))

      call lubricant%log_viscosity_at(p, rise, stress)
      stress = exp(stress)/h
      if (lubricant%shear%thins()) call lubricant%shear%reduce(p, stress)
   end function law_stress
end module ehl_heated_friction

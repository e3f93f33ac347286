! SPDX-License-Identifier: BSD-3-Clause
!> Friction with the temperature of the film
!>
!> The heat of sliding q = tau |u1 - u2| warms the walls and the film (contact/wall_heat.f90), and the warmer lubricant has
!> the shear stress tau of its law at eta(p, T). Heat is not conducted upstream: a row is solved from
!> node to node, each by one equation f(q) = q - |u1 - u2| tau(T(q)) = 0 that has one root, for tau falls with T and T
!> increases with q. Pressure and film are those of the isothermal flow; a contact that changes in time is treated as
!> quasi-steady. Where the bodies touch at a boundary film the stress is mu_b P whatever the temperature: its heat warms the
!> walls as that of the film does, through a boundary film that conducts as the lubricant.
module ehl_heated_friction
   use ehl_flow, only: flow_t
   use ehl_grid, only: grid_t
   use ehl_kinds, only: dp
   use ehl_lubricant, only: lubricant_t
   use ehl_wall_heat, only: share_t, wall_heat_t
   use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
   implicit none (type, external)
   private
   public :: film_heat_t, heated_t, heat_film

   !> Heat that warms neither film nor walls by more than this [K] is left out
   real(dp), parameter :: negligible = 1.0e-4_dp
   !> Relative error of the heat of a node, and most steps to it, some of them bisections: 27 of these would do
   real(dp), parameter :: tolerance = 1.0e-8_dp
   integer, parameter :: max_steps = 200, bisect_after = 6

   !> Input of the heat of a contact
   type :: film_heat_t
      !> Sliding speed |u1 - u2| [m/s], thermal conductivity of the lubricant [W/(m K)]
      real(dp) :: speed = 0.0_dp, conductivity = 0.0_dp
      !> Of wall 1 and wall 2, see wall_strength [K m^(3/2)/W]
      real(dp) :: strengths(2) = 0.0_dp
      !> What lengths and films are scaled by: a, a^2/R [m]
      real(dp) :: length = 0.0_dp, film = 0.0_dp
   end type film_heat_t

   !> A contact with its heat
   type :: heated_t
      !> Friction integral as in contact_results_t, and that without the heat
      real(dp) :: friction = 0.0_dp, isothermal = 0.0_dp
      !> Maximum increase over the temperature of the inlet [K]: of the mean across the film, of wall 1, of wall 2
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

   !> Friction with the heat over that without it; NaN where it is not known
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
      !> The flow with its stress of the isothermal contact, and the density (nx, ny); not given: the law at the sliding
      class(flow_t), intent(in), optional :: flow
      real(dp), contiguous, intent(in), optional :: rho(:, :)
      !> Where the bodies touch at the boundary film (nx, ny); not given: nowhere
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

   !> One row: rises of film and walls [K]
   pure subroutine heat_row(heat, walls, lubricant, p, h, solid, stress, rise, solved)
      type(film_heat_t), intent(in) :: heat
      type(wall_heat_t), intent(in) :: walls
      type(lubricant_t), intent(in) :: lubricant
      real(dp), intent(in) :: p(:), h(:)
      !> Where the stress is that of the boundary film, whatever the temperature
      logical, intent(in) :: solid(:)
      !> In: shear stress of the isothermal contact, over the scale of the law; out: with the heat
      real(dp), intent(inout) :: stress(:)
      !> Shape (nx, 3)
      real(dp), intent(out) :: rise(:, :)
      logical, intent(out) :: solved
      type(share_t) :: share
      !> Heat into each wall; heat of a node over the stress that the law has at its pressure and film
      real(dp) :: into(size(p), 2), factor(size(p)), flux, warms, before(2), left, q, difference
      logical :: good
      integer :: i, k, first, last

      rise = 0.0_dp
      into = 0.0_dp
      solved = .true.
      flux = heat%speed*lubricant%shear%scale
      ! what unit heat on the whole row warms the walls by
      warms = sqrt(2.0_dp*size(p))*maxval(walls%own)
      associate (counts => flux*stress*(warms + heat%film*h/(12.0_dp*heat%conductivity)) > negligible)
         first = findloc(counts, .true., dim=1)
         last = findloc(counts, .true., dim=1, back=.true.)
      end associate
      if (first == 0) return
      factor = law_stress(lubricant, p, h, rise(:, 1))
      ! a limiting stress is none where there is no pressure
      where (factor > 0.0_dp) factor = flux*stress/factor
      left = 1.0_dp
      do i = first, size(p)
         do k = 1, 2
            before(k) = walls%history(k, into(:, k), first, i - 1, i)
         end do
         share = walls%share(before, heat%film*h(i), heat%conductivity)
         q = 0.0_dp
         if (solid(i)) then
            q = flux*stress(i)
         else if (i <= last) then
            call heat_node(lubricant, p(i), h(i), factor(i), share%film, left, q, good)
            solved = solved .and. good
            stress(i) = q/flux
         end if
         ! the hotter wall warms the other one through the film, also where nothing makes heat
         difference = share%difference(1) + share%difference(2)*q
         into(i, :) = 0.5_dp*[q + difference, q - difference]
         rise(i, 1) = share%film(1) + share%film(2)*q
         rise(i, 2:) = before + walls%own*into(i, :)
      end do
   end subroutine heat_row

   !> Heat q [W/m^2] of a node that is `factor` times the stress of the law at the temperature that it makes,
   !> film(1) + film(2) q. By the secant method in a bracket, from the share of the heat without that of its own that is
   !> left at the node before.
   pure subroutine heat_node(lubricant, p, h, factor, film, left, q, solved)
      type(lubricant_t), intent(in) :: lubricant
      real(dp), intent(in) :: p, h, factor, film(2)
      real(dp), intent(inout) :: left
      real(dp), intent(out) :: q
      logical, intent(out) :: solved
      real(dp) :: most, low, high, before, f, f_before, next
      integer :: k

      most = heat_at(0.0_dp)
      q = most
      solved = .true.
      if (.not. most > 0.0_dp) return
      low = 0.0_dp
      high = most
      before = 0.0_dp
      f_before = -most
      q = left*most
      do k = 1, max_steps
         f = q - heat_at(q)
         solved = abs(f) <= tolerance*most
         if (solved) exit
         if (f > 0.0_dp) then
            high = q
         else
            low = q
         end if
         next = 0.5_dp*(low + high)
         ! a step of the secant that leaves the bracket, or many of them, are worse than half of it
         if (abs(f - f_before) > 0.0_dp .and. mod(k, bisect_after) > 0) next = q - f*(q - before)/(f - f_before)
         if (.not. (next >= low .and. next <= high)) next = 0.5_dp*(low + high)
         before = q
         f_before = f
         q = next
      end do
      left = q/most

   contains

      !> Heat at the temperature that q makes
      pure real(dp) function heat_at(q)
         real(dp), intent(in) :: q
         real(dp) :: stress(1)
         stress = law_stress(lubricant, [p], [h], [film(1) + film(2)*q])
         heat_at = factor*stress(1)
      end function heat_at
   end subroutine heat_node

   !> Shear stress of the sliding at pressures, films and temperature increases [K], over the scale of the law
   pure function law_stress(lubricant, p, h, rise) result(stress)
      type(lubricant_t), intent(in) :: lubricant
      real(dp), intent(in) :: p(:), h(:), rise(:)
      real(dp) :: stress(size(p))

      call lubricant%log_viscosity_at(p, rise, stress)
      stress = exp(stress)/h
      if (lubricant%shear%thins()) call lubricant%shear%reduce(p, stress)
   end function law_stress
end module ehl_heated_friction

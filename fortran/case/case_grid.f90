! SPDX-License-Identifier: BSD-3-Clause
!> Defaults of border, domain and numbers of nodes
module ehl_case_grid
   use ehl_case, only: case_t, grid_case_t
   use ehl_contact, only: contact_t
   use ehl_contact_factory, only: new_contact
   use ehl_domain, only: domain_t, flooded_by_default, needed_domain
   use ehl_grid, only: find_levels, long_x
   use ehl_grid_error, only: relative_errors
   use ehl_kinds, only: dp
   use ehl_moes, only: operating_t
   use ehl_scales, only: scales_t
   implicit none (type, external)
   private
   public :: blunt_spike, high_spike, grid_keys, fill_grid, duty_widening

   !> Keys of &grid whose defaults depend on the contact
   character(len=8), parameter :: grid_keys(5) = [character(len=8) :: "border", "x_inlet", "x_outlet", "y_extent", "points"]
   !> Smallest and largest number of intervals along Y on a coarsest grid
   integer, parameter :: min_rows = 8, few_rows = 32
   !> Smallest and largest ratio hy/hx of a cell, and the smallest one in a smooth contact: the film of a narrow contact varies
   !> across the motion over its width
   real(dp), parameter :: min_ratio = 0.25_dp, largest_ratio = 1.41_dp, min_smooth = 0.125_dp
   !> Largest ratio hy/hx in a smooth contact, and the same over kappa: the film of a wide contact varies slowly across the motion.
   !> Valid for alpha p_h up to `blunt_spike`, and without shear thinning for L up to `high_spike`: above, the pressure spike on
   !> the oblique edge is a few nodes wide and oscillates on such cells (docs/theory/relaxation.md).
   real(dp), parameter :: largest_smooth = 2.8_dp, smooth_per_kappa = 0.5_dp
   !> L above which the pressure spike is high. Leaving the spike to relaxation then saves cycles: at L = 21 to 28 a quarter to two
   !> thirds of the cycles are needed, at 6 and 7 up to three times as many. Below it a roller, whose film away from the ends
   !> follows its profile, has the longest cells at any alpha p_h.
   real(dp), parameter :: high_spike = 15.0_dp
   !> kappa above which the trailing edge is nearly parallel to Y, and L up to which the cells are then long at any alpha p_h: of
   !> 39 contacts with kappa from 22 to 30, L from 7 to 9 and alpha p_h above 35 all are solved on long cells and 37 on short ones,
   !> and of these 34 take less time (docs/evidence/machines).
   real(dp), parameter :: straight_edge = 22.0_dp, low_spike = 9.0_dp
   !> A-priori error of H_c above which the default grid of a smooth contact has twice the intervals
   real(dp), parameter :: max_error = 0.05_dp
   !> Largest a-priori error of H_c on a smaller grid of a steady, flooded wide contact, near the median error of 0.4 % of balls on
   !> discs (docs/evidence/machines); intervals of these grids, and 1/h of the usual one
   real(dp), parameter :: small_error = 0.005_dp
   integer, parameter :: fewer_intervals(6) = [160, 192, 256, 320, 384, 512], only_if_usual = 320, per_unit = 128

contains

   !> Set border, domain and numbers of nodes from the operating point unless given
   pure subroutine fill_grid(contact, point, smooth, thins, given, grid, widening, reverses, may_reduce)
      class(contact_t), intent(in) :: contact
      type(operating_t), intent(in) :: point
      !> Whether both surfaces are smooth; whether the flow is shear-thinning
      logical, intent(in) :: smooth, thins
      !> Whether each of grid_keys is given
      logical, intent(in) :: given(5)
      type(grid_case_t), intent(inout) :: grid
      !> Duty: largest half lengths of the contact along X and Y over those of the case; whether the flow reverses
      real(dp), intent(in) :: widening(2)
      logical, intent(in) :: reverses
      !> Whether a wide contact may have a shorter domain and fewer nodes: it is steady and flooded, without a boundary film
      logical, intent(in) :: may_reduce
      type(domain_t) :: domain
      logical :: blunt, sharp

      if (.not. given(1) .and. flooded_by_default(contact, point) .and. contact%is_even()) grid%border = "flooded"
      ! With a sharp spike cycles are sensitive to the grid: 1/52 and 10/12 (seed/number of benchmarks/machines.py) have no solution
      ! on short domains
      sharp = point%moes_l > high_spike .and. .not. point%alpha_bar < blunt_spike(point%moes_l)
      domain = needed_domain(contact, point, grid%border == "flooded", smooth .and. may_reduce .and. .not. sharp)
      if (.not. given(2)) grid%x_inlet = widening(1)*domain%inlet
      if (.not. given(3)) grid%x_outlet = merge(-grid%x_inlet, widening(1)*domain%outlet, reverses)
      if (.not. given(4)) grid%y_extent = widening(2)*domain%side
      if (smooth .and. .not. given(5) .and. .not. grid%target_error > 0.0_dp) then
         grid%points = points(contact, point, grid, may_reduce)
      end if
      blunt = point%alpha_bar < blunt_spike(point%moes_l)
      if (contact%reach(2) > straight_edge*contact%reach(1)) blunt = blunt .or. point%moes_l < low_spike
      if (contact%is_roller()) then
         blunt = blunt .or. point%moes_l < high_spike
      else
         blunt = blunt .and. (point%moes_l < high_spike .or. thins)
      end if
      if (.not. grid%points_y > 0) then
         grid%points_y = rows(contact, smooth, smooth .and. blunt, &
                              contact%is_round() .and. .not. abs(widening(2) - widening(1)) > 0.0_dp, grid)
      end if
   end subroutine fill_grid

   !> Default number of nodes along X, by the a-priori error of H_c
   pure integer function points(contact, point, grid, may_reduce)
      class(contact_t), intent(in) :: contact
      type(operating_t), intent(in) :: point
      !> With the usual number of nodes
      type(grid_case_t), intent(in) :: grid
      logical, intent(in) :: may_reduce
      integer :: k, usual

      points = grid%points
      if (may_reduce .and. contact%is_wide()) then
         ! a short domain has fewer nodes at the same mesh size
         usual = min(points - 1, ceiling(per_unit*(grid%x_outlet - grid%x_inlet)))
         usual = minval(fewer_intervals, fewer_intervals >= usual)
         do k = 1, size(fewer_intervals)
            points = fewer_intervals(k) + 1
            if (fewer_intervals(k) == usual) exit
            if (2*fewer_intervals(k) < usual .or. fewer_intervals(k) == only_if_usual) cycle
            if (.not. error(points) > small_error) return
         end do
      end if
      if (error(points) > max_error) points = 2*points - 1

   contains

      pure real(dp) function error(nodes)
         integer, intent(in) :: nodes
         real(dp) :: errors(2)

         errors = relative_errors(contact, point, (grid%x_outlet - grid%x_inlet)/(nodes - 1))
         error = errors(1)
      end function error
   end function points

   !> Largest alpha p_h of a blunt spike. With long cells a contact with alpha p_h = 19.6 and L = 12.8 ends at the cycle limit. With
   !> L below 7 all nine contacts with alpha p_h from 26 to 54 are faster, with L from 7 to 9 all ten with alpha p_h from 21 to 35
   !> (docs/evidence/machines).
   pure real(dp) function blunt_spike(moes_l)
      real(dp), intent(in) :: moes_l

      blunt_spike = merge(19.0_dp, 21.0_dp, moes_l > 10.0_dp)
      if (moes_l < low_spike) blunt_spike = 35.0_dp
      if (moes_l < 7.0_dp) blunt_spike = huge(blunt_spike)
   end function blunt_spike

   !> Largest half lengths of the dry contact along X and Y under the duty over those of the case
   function duty_widening(input) result(widening)
      type(case_t), intent(in) :: input
      real(dp) :: widening(2)
      real(dp), allocatable :: load(:), radius(:), across(:)
      integer :: k

      widening = 1.0_dp
      if (.not. input%duty%active()) return
      load = input%duty%list("load")
      radius = input%duty%list("radius_x")
      across = input%duty%list("radius_y")
      if (size(load) == 0) load = 0.0_dp*input%duty%time + input%contact%size_of_load()
      if (size(radius) == 0) radius = 0.0_dp*input%duty%time + input%contact%radius_x
      if (size(load) /= size(radius)) return
      if (size(across) == 0 .or. input%contact%is_cylinder()) then
         widening = max(1.0_dp, maxval(load*radius)/(input%contact%size_of_load()*input%contact%radius_x)) &
                    **merge(1.0_dp/2.0_dp, 1.0_dp/3.0_dp, input%contact%is_cylinder())
         return
      end if
      if (size(across) /= size(load) .or. .not. input%contact%si) return
      if (minval(load) <= 0.0_dp .or. minval(radius) <= 0.0_dp .or. minval(across) <= 0.0_dp) return
      do k = 1, size(load)
         widening = max(widening, half_lengths(load(k), radius(k), radius(k)/across(k)) &
                        /half_lengths(input%contact%load, input%contact%radius_x, input%contact%radius_ratio))
      end do

   contains

      !> Half lengths of the dry contact along X and Y [m]
      function half_lengths(load, radius, ratio) result(lengths)
         real(dp), intent(in) :: load, radius, ratio
         real(dp) :: lengths(2)
         class(contact_t), allocatable :: contact
         type(scales_t) :: scales

         call new_contact(ratio, input%contact%angle, contact)
         scales = contact%scales(load, radius, input%contact%reduced_modulus)
         lengths = scales%length*contact%reach
      end function half_lengths
   end function duty_widening

   !> Nodes along Y: as many as along X in a contact that remains round, 1 in a line contact, otherwise from the ratio hy/hx of the
   !> cells
   pure integer function rows(contact, smooth, blunt, round, grid)
      class(contact_t), intent(in) :: contact
      !> Whether both surfaces are smooth; whether the pressure spike is blunt; whether the contact is round at any time
      logical, intent(in) :: smooth, blunt, round
      type(grid_case_t), intent(in) :: grid
      integer :: levels, intervals(2), halved, multiple
      real(dp) :: target, ratio

      rows = merge(1, grid%points, contact%is_line())
      if (round .or. contact%is_line()) return
      call find_levels(rows, rows, levels, intervals)
      if (levels == 0) return
      halved = (rows - 1)/intervals(1)
      ratio = cell_ratio(contact%reach(2)/contact%reach(1), smooth, blunt)
      if (contact%is_roller() .and. blunt) ratio = largest_smooth
      target = 2.0_dp*grid%y_extent*intervals(1)/(ratio*(grid%x_outlet - grid%x_inlet))
      ! cells short along Y are first coarsened along Y only (ehl_hierarchy)
      multiple = 2
      do while (ratio < 1.0_dp/long_x)
         ratio = 2.0_dp*ratio
         multiple = 2*multiple
      end do
      ! many rows are halved further
      do while (target > 0.5_dp*multiple*few_rows)
         multiple = 2*multiple
      end do
      rows = max(min_rows, multiple*nint(target/multiple))*halved + 1
   end function rows

   !> Ratio hy/hx of the cells: cells elongated along the longer axis give the same error with fewer nodes, as long as multigrid
   !> converges as on square cells
   pure real(dp) function cell_ratio(elongation, smooth, blunt)
      real(dp), intent(in) :: elongation
      logical, intent(in) :: smooth, blunt

      cell_ratio = min(largest_ratio, max(merge(min_smooth, min_ratio, smooth), elongation))
      if (blunt) cell_ratio = max(cell_ratio, min(largest_smooth, smooth_per_kappa*elongation))
   end function cell_ratio
end module ehl_case_grid

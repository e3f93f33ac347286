! SPDX-License-Identifier: BSD-3-Clause
!> Results of a solution with solid contact at a boundary film (boundary_film.f90)
module ehl_touching
   use ehl_kinds, only: dp
   use ehl_level, only: cavity_pressure, gap_row, level_t
   use ehl_lubricant, only: lubricant_t
   use ehl_reynolds, only: flow_operator
   implicit none (type, external)
   private
   public :: touching_t, measure_touching, mostly_touching, much_mass_defect, touching_names, known_names, at_depth

   !> Mass defect, as a fraction of the flow, above which the model of the boundary film does not hold (chosen)
   real(dp), parameter :: much_mass_defect = 0.1_dp

   !> Load share above which the film thicknesses are those of the boundary film, so that a coarser grid does not give their error
   real(dp), parameter :: mostly_touching = 0.5_dp

   !> Names of the values of `numbers`
   character(len=*), parameter :: touching_names(7) = [character(len=16) :: "load_share", "contact_area", "mass_defect", &
                                                       "hard_load_share", "hard_area", "plastic_depth", "hard_flowing"]
   !> Index of the depth
   integer, parameter :: at_depth = 6

   !> Solid contact of one state; without a boundary film all values are 0
   type :: touching_t
      !> iint P dX dY where the bodies touch, over that of the contact; area of solid contact [a^2], of a line contact per unit
      !> length [a]
      real(dp) :: load_share = 0.0_dp, area = 0.0_dp
      !> Flow that the boundary film supplies at touching nodes, over the Couette flow through the line X = 0
      real(dp) :: mass_defect = 0.0_dp
      !> Load share where the solids yield, area where they yield (unit as above), maximum depth of yielding [a^2/R], and the load
      !> share where they yield with a film above the boundary film
      real(dp) :: hard_share = 0.0_dp, hard_area = 0.0_dp, depth = 0.0_dp, flowing_share = 0.0_dp
   contains
      procedure :: numbers
   end type touching_t

contains

   !> Evaluate the present state of a level whose film and coefficients are up to date
   type(touching_t) function measure_touching(level) result(m)
      type(level_t), intent(in) :: level
      real(dp), dimension(level%grid%ny) :: load, area, supplied, flow, whole, hard, flowing, depth
      real(dp) :: row(level%grid%nx)
      logical :: yield(level%grid%nx)
      integer :: j, middle

      middle = 1 + nint((0.0_dp - level%grid%x0)/level%grid%hx)
      if (.not. level%boundary%active) return
      supplied = 0.0_dp
      do j = 1, level%grid%ny
         associate (touching => level%boundary%supports(level%p(:, j), level%mass_content(:, j)), weight => level%grid%weight(j))
            whole(j) = weight*sum(level%p(:, j))
            load(j) = weight*sum(level%p(:, j), mask=touching)
            area(j) = weight*count(touching)
            flow(j) = merge(weight*level%mass_content(middle, j)/level%grid%hx, 0.0_dp, level%p(middle, j) > cavity_pressure)
            yield = level%boundary%yielding%nodes(level%grid%nx, j)
            flowing(j) = weight*sum(level%p(:, j), mask=yield .and. .not. touching)
            hard(j) = weight*sum(level%p(:, j), mask=yield)
            m%hard_area = m%hard_area + weight*count(yield)
            depth(j) = maxval(gap_row(level, j) - level%h(:, j))
            if (level%grid%is_border(j)) cycle
            call flow_operator(level, j, row)
            row = level%rhs(:, j) - row
            supplied(j) = weight*sum(row, mask=touching .and. level%boundary%states(level%grid%nx, j))
         end associate
      end do
      m%load_share = sum(load)/sum(whole)
      m%area = sum(area)
      m%mass_defect = sum(supplied)/sum(flow)
      m%hard_share = sum(hard)/sum(whole)
      m%flowing_share = sum(flowing)/sum(whole)
      m%depth = maxval(depth)
   end function measure_touching

   !> Number of values: none without a boundary film; the last four need a hardness
   pure integer function known_names(lubricant)
      type(lubricant_t), intent(in) :: lubricant
      known_names = merge(size(touching_names), 3, lubricant%boundary_limit > 0.0_dp)
      if (.not. lubricant%boundary_film > 0.0_dp) known_names = 0
   end function known_names

   !> Values in the order of touching_names
   pure function numbers(self)
      class(touching_t), intent(in) :: self
      real(dp) :: numbers(size(touching_names))
      numbers = [self%load_share, self%area, self%mass_defect, self%hard_share, self%hard_area, self%depth, self%flowing_share]
   end function numbers
end module ehl_touching

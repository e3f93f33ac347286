! SPDX-License-Identifier: BSD-3-Clause
!> Grids of a plan
submodule (ehl_plan) ehl_plan_grids
   use ehl_domain, only: domain_t, flooding_layer
   use ehl_grid, only: find_levels, max_coarsest, new_grid
   use ehl_grid_error, only: relative_errors
   use ehl_resolution, only: has_solution
   use ehl_strip_grid, only: make_strip
   implicit none (type, external)

   !> Minimum number of nodes along X of the first grid of nested iteration
   integer, parameter :: min_start_points = 33
   !> Minimum number of intervals of the coarsest grid of a line if nothing varies along it
   integer, parameter :: coarsest_of_line = 64
   !> Length (2 H_c)^(1/2) of a thick film [a], and maximum mesh size of the coarsest grid over this length
   real(dp), parameter :: thick_film = 0.8_dp, coarsest_mesh = 0.9_dp
   !> Maximum a-priori error of H_c at which a failed smooth contact is restarted with damped cycles
   real(dp), parameter :: resolved_error = 0.1_dp

contains

   module procedure pick_grids
      type(grid_t) :: grid
      logical :: mirror
      integer :: intervals(2), level
      real(dp) :: film, width

      if (status%failed()) return
      mirror = input%solver%symmetry == "auto" .and. plan%contact%is_even() .and. plan%surfaces%even_in_y()
      call find_levels(input%grid%points, merge(input%grid%points, input%grid%points_y, plan%contact%is_line()), plan%levels, &
                       intervals)
      if (plan%contact%is_line()) then
         ! the direct solution of a single row is cheap on a finer grid
         do while (intervals(1) < merge(max_coarsest, coarsest_of_line, plan%surfaces%width() > 0.0_dp) .and. plan%levels > 1)
            intervals = 2*intervals
            plan%levels = plan%levels - 1
         end do
      end if
      ! a coarsest grid that does not resolve a thick film gives wrong corrections
      film = sqrt(2.0_dp*plan%film_expected)
      if (plan%levels > 1 .and. 2*minval(intervals) <= max_coarsest .and. film > thick_film .and. &
          input%grid%x_outlet - input%grid%x_inlet > coarsest_mesh*film*intervals(1)) then
         intervals = 2*intervals
         plan%levels = plan%levels - 1
      end if
      if (plan%levels == 0) then
         call status%fail(ehl_bad_input, "grid of "//to_text(input%grid%points)//" points cannot be coarsened far enough")
         return
      end if
      if (plan%target_error > 0.0_dp) then
         plan%levels = 1
         do while (intervals(1)*2**plan%levels + 1 <= input%grid%max_points)
            plan%levels = plan%levels + 1
         end do
      end if
      associate (g => input%grid)
         if (plan%contact%is_line()) then
            width = plan%surfaces%width()
            call make_strip(width, intervals(1), plan%levels, g%x_inlet, g%x_outlet, mirror, plan%surfaces%rough() .and. &
                            input%solver%coarsening == "alcouffe", plan%coarsest, status)
            if (status%failed()) return
         else
            plan%coarsest = new_grid(intervals(1) + 1, intervals(2) + 1, g%x_inlet, g%x_outlet, g%y_extent, mirror)
            plan%coarsest%ends = plan%contact%is_roller()
         end if
         plan%domain_error = domain_error(plan%contact, plan%point, domain_t(g%x_inlet, g%x_outlet, g%y_extent), plan%flooded, &
                                        plan%starved .and. plan%layer <= flooding_layer(plan%contact, plan%point, g%x_inlet))
      end associate
      grid = plan%coarsest
      plan%start = 0
      do level = 1, plan%levels
         if (level > 1) grid = grid%finer()
         if (plan%start == 0 .and. grid%nx >= min_start_points .and. &
             (plan%solid_contact .or. has_solution(plan%contact, plan%point, grid))) plan%start = level
      end do
      if (plan%start == 0) plan%start = plan%levels
      plan%finest = grid
      associate (errors => relative_errors(plan%contact, plan%point, grid%hx))
         plan%may_restart = errors(1) <= resolved_error .or. plan%solid_contact .or. &
                            plan%contact%reach(2) > wide*plan%contact%reach(1)
      end associate
   end procedure pick_grids
end submodule ehl_plan_grids

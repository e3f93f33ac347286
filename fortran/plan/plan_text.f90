! SPDX-License-Identifier: BSD-3-Clause
!> The plan of a run in words
module ehl_plan_text
   use ehl_cycle, only: coarsening_alcouffe, cycle_options_t
   use ehl_grid, only: grid_t
   use ehl_kinds, only: dp
   use ehl_plan, only: plan_t
   use ehl_plan_need, only: need_lines
   use ehl_resolution, only: too_coarse, unresolved_inlet
   use ehl_steady_options, only: max_error
   use ehl_surface_text, only: scene_lines, wave_lines
   use ehl_text, only: fixed, newline, to_text
   use ehl_wedge, only: wedge_narrow
   implicit none (type, external)
   private
   public :: plan_text

contains

   !> The plan for a person: a few lines and a table of the levels
   function plan_text(plan) result(text)
      type(plan_t), intent(in) :: plan
      character(len=:), allocatable :: text
      character(len=:), allocatable :: why
      type(grid_t) :: grid
      character(len=80) :: row
      integer :: k

      text = "contact    M = "//fixed(plan%point%moes_m, "g0.5")//", L = "//fixed(plan%point%moes_l, "g0.5")// &
             ", alpha p_h = "//fixed(plan%point%alpha_bar, "g0.5")//", speed parameter = "// &
             fixed(plan%point%speed_parameter, "es9.3")
      if (plan%scales%has_size()) call add("           a = "//fixed(plan%scales%length, "es10.4")//" m, p_h = "// &
                                            fixed(plan%scales%pressure, "es10.4")//" Pa")
      if (.not. plan%contact%is_round()) call tell_ellipse()
      if (allocated(plan%lubricant_note)) call add("lubricant  "//plan%lubricant_note)
      if (plan%alpha_note /= "") call add("lubricant  "//plan%alpha_note)
      call tell_friction()
      if (plan%surfaces%rough()) then
         call add(scene_lines(plan%surfaces))
         if (plan%surfaces%move()) call tell_time()
         if (plan%coarse_run) call add("error      of the friction ratio: computed on the next coarser grid too")
         call add(wave_lines(plan))
      else
         call add("problem    smooth and steady: no time levels, no roughness")
      end if
      call tell_domain()
      call add("deflection "//plan%engine//", threads "//to_text(plan%threads))
      call tell_cycles()
      if (plan%target_error > 0.0_dp) then
         call add("stop       at the first grid whose relative error of H_c is below "//fixed(plan%target_error, "es8.1"))
      else
         call add("stop       on the finest grid, algebraic error below "//fixed(plan%accuracy, "f5.2")// &
                  " of the discretisation error and "//fixed(100.0_dp*max_error, "f4.1")// &
                  " % of the film, load error below 1e-6")
      end if
      text = text//newline//need_lines(plan)//"level  points    stored nodes  mesh size   use"
      grid = plan%coarsest
      do k = 1, plan%levels
         if (k > 1) grid = grid%finer()
         write (row, "(i5,i8,i16,f11.6,3x,a)") k, grid%nx, grid%nx*grid%ny, grid%hx, trim(use_of(k))
         call add(trim(row))
      end do
      why = too_coarse(plan%contact, plan%point, plan%finest)
      if (why /= "") call add("warning    "//why)

   contains

      !> One more line
      subroutine add(line)
         character(len=*), intent(in) :: line
         text = text//newline//line
      end subroutine add

      !> Shape of a contact that is not round, and of the cells of its grid
      subroutine tell_ellipse()
         associate (contact => plan%contact, g => plan%finest)
            call add("ellipse    semi-axis across the motion over a, that along it: "//fixed(contact%ellipticity, "g0.5")// &
                     "; R_x/R_y = "//fixed(contact%radius_ratio, "g0.5"))
            call add("cells      "//fixed(g%hy/g%hx, "g0.4")//" times as long across the motion as along it: "// &
                     to_text(g%nx)//" x "//to_text(g%full_ny())//" nodes")
         end associate
      end subroutine tell_ellipse

      !> Sliding and shear law, and the heat of the inlet where it counts
      subroutine tell_friction()
         character(len=:), allocatable :: speed, flow

         associate (s => plan%sliding)
            flow = "the flow is Newtonian"
            if (plan%lubricant%shear%thins_flow()) flow = "the flow obeys it, too"
            speed = ""
            if (s%mean_velocity > 0.0_dp) speed = " ("//fixed(abs(s%slide_to_roll)*s%mean_velocity, "es10.3")//" m/s)"
            call add("friction   "//trim(s%law)//" shear stress, slide-to-roll ratio "//fixed(s%slide_to_roll, "f8.4")// &
                     speed//"; "//flow)
            call add("           coefficients are "//plan%heat%note)
            if (plan%lubricant%boundary_film > 0.0_dp) call add("boundary   bodies touch at a film of "// &
               fixed(plan%lubricant%boundary_film*plan%scales%film, "es10.3")//" m at ambient pressure; their friction "// &
               "there is "//boundary_friction())
            if (plan%inlet%in_doubt(plan%finest%hx)) call add("           "//unresolved_inlet(plan%inlet, plan%finest))
            if (plan%lubricant%boundary_limit > 0.0_dp) call add("hardness   the solids yield at "// &
               fixed(plan%lubricant%boundary_limit*plan%scales%pressure, "es10.3")//" Pa, "// &
               fixed(plan%lubricant%boundary_limit, "f6.3")//" p_h")
            if (s%loading > 0.0_dp) call add("heat       shear heating of the inlet (Gupta et al. 1992): film times "// &
               fixed(s%reduction, "f7.4")//" by an inlet viscosity of "//fixed(s%inlet_viscosity, "es10.3")// &
               " Pa s, which M and L belong to")
         end associate
      end subroutine tell_friction

      !> Of the boundary film, in words
      function boundary_friction() result(words)
         character(len=:), allocatable :: words

         words = "not known"
         associate (l => plan%lubricant)
            if (l%boundary_stress > 0.0_dp) words = fixed(l%boundary_stress*l%shear%scale/plan%scales%pressure, "f6.3")// &
                                                    " of the pressure"
         end associate
      end function boundary_friction

      !> Steps in time, and their end
      subroutine tell_time()
         call add("time       "//trim(merge("narrow upstream", "as in the paper", plan%scheme == wedge_narrow))// &
                  ", step = mesh size = "//fixed(plan%finest%hx, "f9.6"))
         if (plan%predicted_start) call add("start      with the contact full of roughness, from the prediction")
         if (allocated(plan%fallback_reason)) call add("start      behind a front, with no prediction: "//plan%fallback_reason)
         if (plan%steps > 0) then
            call add("end        after "//to_text(plan%steps)//" steps")
         else if (plan%surfaces%pass_once()) then
            call add("end        when it has left the contact, with the film that it made in the inlet: T = "// &
                     fixed(plan%surfaces%end_of_passage(), "f8.4"))
         else
            call add("end        when the mean of mu_r/mu_s over whole periods changes by less than "// &
                     fixed(plan%time_tolerance, "es8.1"))
         end if
      end subroutine tell_time

      !> Borders, what they cost, and whether half of it is enough
      subroutine tell_domain()
         character(len=:), allocatable :: cost, pressure, half

         associate (g => plan%coarsest)
            cost = "it is far too small for a flooded contact"
            if (plan%domain_cost(1) < 1.0_dp) cost = "it costs at most "//fixed(100.0_dp*plan%domain_cost(1), "f9.2")// &
                                                     " % of the flooded film"
            pressure = "P = 0"
            if (plan%flooded) pressure = "the pressure of a fully flooded contact"
            half = "the whole of it is solved"
            if (g%mirror) half = "symmetric in Y: the half Y >= 0 is solved"
            call add("domain     "//fixed(g%x0, "g0.5")//" <= X <= "//fixed(g%x(g%nx), "g0.5")//", |Y| <= "// &
                     fixed(g%y(g%ny), "g0.5")//"; "//cost)
            call add("           at its border "//pressure//"; "//half)
         end associate
      end subroutine tell_domain

      subroutine tell_cycles()
         character(len=:), allocatable :: second, steps

         second = ""
         steps = ""
         if (plan%cycle%full .and. .not. plan%second_cycle%full) then
            second = ", the second on a finer grid V"//sweeps_of(plan%second_cycle)
         end if
         if (plan%surfaces%move()) then
            steps = ", time steps "//plan%step_cycle_letter//sweeps_of(plan%step_cycle)// &
                    " (no sweeps first where the prediction is close), "// &
                    trim(merge("Alcouffe ", "classical", plan%step_cycle%coarsening == coarsening_alcouffe))//" coarsening"
            if (plan%coarsening_may_change) steps = steps//", Alcouffe when a cycle is slow"
         end if
         call add("cycles     "//plan%cycle_letter//sweeps_of(plan%cycle)//second//steps)
      end subroutine tell_cycles

      function use_of(level) result(words)
         integer, intent(in) :: level
         character(len=48) :: words
         words = "correction"
         if (level == 1) words = "correction, solved directly"
         if (level >= plan%start) words = "solution"
         if (level == plan%start) words = "solution, from the Hertz pressure"
      end function use_of
   end function plan_text

   !> Sweeps before and after the coarse grids: '(2,1)'
   function sweeps_of(cycle) result(text)
      type(cycle_options_t), intent(in) :: cycle
      character(len=:), allocatable :: text

      text = "("//to_text(cycle%pre)//","//to_text(cycle%post)//")"
   end function sweeps_of
end module ehl_plan_text

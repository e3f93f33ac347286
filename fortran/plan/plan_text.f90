! SPDX-License-Identifier: BSD-3-Clause
!> The plan of a run in words
module ehl_plan_text
   use ehl_feature, only: feature_t
   use ehl_cycle, only: coarsening_alcouffe, cycle_options_t
   use ehl_grid, only: grid_t
   use ehl_kinds, only: dp
   use ehl_plan, only: plan_t
   use ehl_plan_need, only: need_lines
   use ehl_steady, only: largest_error
   use ehl_text, only: fixed, to_text
   use ehl_wedge, only: wedge_narrow
   implicit none (type, external)
   private
   public :: plan_text

contains

   !> The plan for a person: a few lines and a table of the levels
   function plan_text(plan) result(text)
      type(plan_t), intent(in) :: plan
      character(len=:), allocatable :: text
      type(grid_t) :: grid
      character(len=160) :: line
      integer :: k

      write (line, "(a,g0.5,a,g0.5,a,g0.5,a,es9.3)") "contact    M = ", plan%point%moes_m, ", L = ", plan%point%moes_l, &
         ", alpha p_h = ", plan%point%alpha_bar, ", speed parameter = ", plan%point%speed_parameter
      text = trim(line)//new_line("a")
      if (plan%contact%has_size()) then
         write (line, "(a,es10.4,a,es10.4,a)") "           a = ", plan%contact%radius, " m, p_h = ", &
            plan%contact%pressure, " Pa"
         text = text//trim(line)//new_line("a")
      end if
      text = text//friction_lines(plan)
      if (plan%rests()) then
         text = text//rest_lines(plan)
      else if (plan%moves()) then
         text = text//scene_lines(plan)
         write (line, "(a,f9.6)") "time       "//trim(merge("narrow upstream", "as in the paper", plan%scheme == wedge_narrow))// &
            ", step = mesh size = ", plan%finest%hx
         text = text//trim(line)//new_line("a")
         if (plan%coarse_run) text = text// &
            "error      of the friction ratio: the transient run is made on the next coarser grid too"// &
            new_line("a")
         if (plan%steps > 0) then
            text = text//"end        after "//to_text(plan%steps)//" steps"//new_line("a")
         else if (plan%surface%passes_once) then
            write (line, "(a,f8.4)") "end        when it has left the contact, with the film that it made in the inlet: T = ", &
               plan%surface%end_of_passage()
            text = text//trim(line)//new_line("a")
         else
            write (line, "(a,es8.1)") "end        when the mean of mu_r/mu_s over whole periods changes by less than ", &
               plan%time_tolerance
            text = text//trim(line)//new_line("a")
         end if
      else
         text = text//"scene      smooth and steady: no time levels, no roughness"//new_line("a")
      end if
      if (allocated(plan%surface)) text = text//wave_lines(plan)
      text = text//domain_lines(plan)
      text = text//"deflection "//plan%engine//", threads "//to_text(plan%threads)//new_line("a")
      text = text//"cycles     "//plan%cycle_letter//sweeps_of(plan%cycle)
      if (plan%cycle%full .and. .not. plan%second_cycle%full) then
         text = text//", the second on a finer grid V"//sweeps_of(plan%second_cycle)
      end if
      if (plan%moves()) then
         text = text//", time steps "//plan%step_cycle_letter//sweeps_of(plan%step_cycle)// &
                " (no sweeps first where the prediction is close), "// &
                trim(merge("Alcouffe ", "classical", plan%step_cycle%coarsening == coarsening_alcouffe))//" coarsening"
         if (plan%coarsening_may_change) text = text//", Alcouffe when a cycle is slow"
      end if
      text = text//new_line("a")
      if (plan%target_error > 0.0_dp) then
         write (line, "(a,es8.1)") "stop       at the first grid whose relative error of H_c is below ", plan%target_error
      else
         write (line, "(a,f5.2,a,f4.1,a)") "stop       on the finest grid, algebraic error below ", plan%accuracy, &
            " of the discretisation error and", 100.0_dp*largest_error, " % of the film, load error below 1e-6"
      end if
      text = text//trim(line)//new_line("a")
      text = text//need_lines(plan)
      text = text//"level  points    stored nodes  mesh size   use"
      grid = plan%coarsest
      do k = 1, plan%levels
         if (k > 1) grid = grid%finer()
         write (line, "(i5,i8,i16,f11.6,3x,a)") k, grid%nx, grid%nx*grid%ny, grid%hx, trim(use_of(k))
         text = text//new_line("a")//trim(line)
      end do

   contains

      function use_of(level) result(words)
         integer, intent(in) :: level
         character(len=48) :: words
         words = "correction"
         if (level == 1) words = "correction, solved directly"
         if (level >= plan%start) words = "solution"
         if (level == plan%start) words = "solution, from the Hertz pressure"
      end function use_of
   end function plan_text

   !> Borders, what they cost, and whether half of it is enough
   function domain_lines(plan) result(text)
      type(plan_t), intent(in) :: plan
      character(len=:), allocatable :: text
      character(len=160) :: line

      associate (grid => plan%coarsest)
         write (line, "(a,g0.5,a,g0.5,a,g0.5)") "domain     ", grid%x0, " <= X <= ", grid%x(grid%nx), ", |Y| <= ", grid%y(grid%ny)
         text = trim(line)
         if (plan%domain_cost(1) < 1.0_dp) then
            text = text//"; it costs at most "//fixed(100.0_dp*plan%domain_cost(1), "f9.2")//" % of the flooded film"
         else
            text = text//"; it is far too small for a flooded contact"
         end if
         text = text//new_line("a")//"           at its border "
         if (plan%flooded) then
            text = text//"the pressure of a fully flooded contact; "
         else
            text = text//"P = 0; "
         end if
         if (grid%mirror) then
            text = text//"symmetric in Y: the half Y >= 0 is solved"//new_line("a")
         else
            text = text//"the whole of it is solved"//new_line("a")
         end if
      end associate
   end function domain_lines

   !> What moves: roughness without end, or a feature that passes once
   function scene_lines(plan) result(text)
      type(plan_t), intent(in) :: plan
      character(len=:), allocatable :: text
      character(len=128) :: line

      select type (surface => plan%surface)
      type is (feature_t)
         write (line, "(a,f7.4,a,f7.4,a)") "scene      "//feature_words(surface)//" passes once, velocity ratio ", &
            surface%velocity_ratio, ", its centre at X = 0 at T = ", (surface%reach - surface%x_start)/surface%velocity_ratio
         text = trim(line)//new_line("a")//"           "//size_words(surface)//new_line("a")// &
                "           the smooth contact is solved once, before"//new_line("a")
      class default
         write (line, "(a,f6.3,a,f7.4,a)") "scene      roughness on the move, period ", surface%period, &
            " a, velocity ratio ", surface%velocity_ratio, "; the smooth contact is solved once, before"
         text = trim(line)//new_line("a")
      end select
   end function scene_lines

   !> What a feature is
   pure function feature_words(feature) result(text)
      type(feature_t), intent(in) :: feature
      character(len=:), allocatable :: text

      text = "a "
      if (feature%is_line) then
         text = text//trim(merge("ridge ", "groove", feature%sign > 0.0_dp))
      else
         text = text//merge("bump", "dent", feature%sign > 0.0_dp)
      end if
   end function feature_words

   !> Size and place of a feature
   function size_words(feature) result(text)
      type(feature_t), intent(in) :: feature
      character(len=:), allocatable :: text
      character(len=128) :: line

      write (line, "(f9.4,a)") feature%width, " a wide, without ends"
      if (feature%length > 0.0_dp) write (line, "(f9.4,a,f9.4,a)") feature%width, " a wide and", feature%length, " a long"
      text = trim(adjustl(line))
      if (feature%amplitude > 0.0_dp) then
         write (line, "(es10.3,a)") feature%amplitude, " a^2/R "//merge("high", "deep", feature%sign > 0.0_dp)
         text = text//", "//trim(adjustl(line))
      end if
      write (line, "(f9.4)") feature%y_start
      text = text//", at Y = "//trim(adjustl(line))
   end function size_words

   !> How much of the surface the finest grid carries
   function wave_lines(plan) result(text)
      type(plan_t), intent(in) :: plan
      character(len=:), allocatable :: text
      character(len=128) :: line

      text = ""
      if (plan%surface%passes_once) then
         write (line, "(a,es8.1,a)") "waves      with fewer than 8 nodes a period hold ", plan%unresolved, &
            " of the variance of its profile"
         text = trim(line)//new_line("a")
         return
      end if
      if (plan%surface%variance > 0.0_dp .and. plan%contact%film_scale > 0.0_dp) then
         write (line, "(a,es9.2,a)") "surface    rms height ", sqrt(plan%surface%variance)*plan%contact%film_scale, " m"
         text = trim(line)
         if (plan%surface%variance < plan%surface%variance_whole) then
            write (line, "(a,es9.2,a)") ", of", sqrt(plan%surface%variance_whole)*plan%contact%film_scale, &
               " m before its spectrum was cut"
            text = text//trim(line)
         end if
         text = text//new_line("a")
      end if
      write (line, "(a,es8.1,a)") "waves      with fewer than 8 nodes a period hold ", plan%unresolved, &
         " of the variance of the surface;"
      text = text//trim(line)
      write (line, "(es8.1,a)") plan%left_out, " of it, with 2 and fewer, is left out"
      text = text//" "//trim(adjustl(line))//new_line("a")
   end function wave_lines

   !> A rough surface at rest: where it lies, and where the error comes from
   function rest_lines(plan) result(text)
      type(plan_t), intent(in) :: plan
      character(len=:), allocatable :: text
      character(len=128) :: line

      select type (surface => plan%surface)
      type is (feature_t)
         write (line, "(a,f8.4)") "scene      "//feature_words(surface)//" at rest, steady; its centre at X = x_start = ", &
            surface%x_start
         text = trim(line)//new_line("a")//"           "//size_words(surface)
      class default
         write (line, "(a,f6.3,a,f8.4)") "scene      roughness at rest, steady; period ", surface%period, &
            " a, it is everywhere, its origin at X = x_start = ", surface%x_start
         text = trim(line)
      end select
      text = text//new_line("a")//"           the smooth contact is solved before"//new_line("a")
      if (plan%coarse_run) text = text//"error      of the friction ratio: solved on the next coarser grid too"//new_line("a")
   end function rest_lines

   !> Sliding and shear law, and the heat of the inlet where it counts
   function friction_lines(plan) result(text)
      type(plan_t), intent(in) :: plan
      character(len=:), allocatable :: text
      character(len=160) :: line

      associate (s => plan%sliding)
         write (line, "(a,f8.4)") "friction   "//trim(s%law)//" shear stress, slide-to-roll ratio ", s%slide_to_roll
         text = trim(line)
         if (s%mean_velocity > 0.0_dp) then
            write (line, "(a,es10.3,a)") " (", abs(s%slide_to_roll)*s%mean_velocity, " m/s)"
            text = text//trim(line)
         end if
         if (plan%lubricant%shear%thins_flow()) then
            text = text//"; the flow obeys it, too"//new_line("a")
         else
            text = text//"; the flow is Newtonian"//new_line("a")
         end if
         if (.not. s%loading > 0.0_dp) return
         write (line, "(a,f7.4,a,es10.3,a)") "heat       shear heating of the inlet (Gupta et al. 1992): film times ", &
            s%reduction, " by an inlet viscosity of ", s%inlet_viscosity, " Pa s, which M and L belong to"
         text = text//trim(line)//new_line("a")
      end associate
   end function friction_lines

   !> Sweeps before and after the coarse grids: '(2,1)'
   function sweeps_of(cycle) result(text)
      type(cycle_options_t), intent(in) :: cycle
      character(len=:), allocatable :: text

      text = "("//to_text(cycle%pre)//","//to_text(cycle%post)//")"
   end function sweeps_of
end module ehl_plan_text

! SPDX-License-Identifier: BSD-3-Clause
!> The rough surfaces of a plan in words
module ehl_surface_text
   use ehl_feature, only: feature_t
   use ehl_kinds, only: dp
   use ehl_moving_surfaces, only: moving_surfaces_t
   use ehl_plan, only: plan_t
   use ehl_surface, only: surface_t
   use ehl_text, only: to_text
   implicit none (type, external)
   private
   public :: scene_lines, rest_lines, wave_lines, window_words

contains

   !> What moves: roughness without end, or a feature that passes once
   function scene_lines(plan) result(text)
      type(plan_t), intent(in) :: plan
      character(len=:), allocatable :: text
      character(len=128) :: line

      associate (surfaces => plan%surfaces)
         text = surface_lines(surfaces)
         if (surfaces%count() > 1 .and. .not. surfaces%pass_once()) then
            if (.not. surfaces%meets) then
               line = "           "//window_words(surfaces)
            else if (surfaces%mismatch > 0.0_dp) then
               write (line, "(a,i0,a,f9.4,a)") "           no common period: means over ", surfaces%repeats, &
                  " periods of the slowest, ", surfaces%period, " a/u,"
               text = text//trim(line)//new_line("a")
               write (line, "(a,f6.4,a)") "           after which a surface misses its start by ", surfaces%mismatch, &
                  " of a period; the error of that is part of mu_ratio_error"
            else
               write (line, "(a,f9.4,a,i0,a)") "           both repeat after ", surfaces%period, " a/u, ", surfaces%repeats, &
                  " periods of the slowest"
            end if
            text = text//trim(line)//new_line("a")
         end if
         if (surfaces%some_rest()) then
            text = text//"           the smooth contact is solved before, then the one with what is at rest"//new_line("a")
         else
            text = text//"           the smooth contact is solved once, before"//new_line("a")
         end if
      end associate
   end function scene_lines

   !> Why the error of a mean over a time that is no common period is not known, and what would do
   function window_words(surfaces) result(text)
      type(moving_surfaces_t), intent(in) :: surfaces
      character(len=:), allocatable :: text

      text = "the mean holds "//to_text(surfaces%repeats)//" periods of the slowest surface, and both meet in few positions then"
      if (surfaces%whole > 0) text = text//": time.max_periods = "//to_text(surfaces%whole)//" for all"
   end function window_words

   !> Each surface, what it is and how it moves
   function surface_lines(surfaces) result(text)
      type(moving_surfaces_t), intent(in) :: surfaces
      character(len=:), allocatable :: text, what
      character(len=128) :: line
      integer :: k

      text = ""
      do k = 1, surfaces%count()
         what = "scene      "
         if (surfaces%count() > 1) what = what//"&"//trim(surfaces%of(k)%group)//": "
         select type (surface => surfaces%of(k)%surface)
         type is (feature_t)
            if (surface%at_rest()) then
               write (line, "(a,f8.4)") " at rest, its centre at X = x_start = ", surface%x_start
            else
               write (line, "(a,f7.4,a,f7.4,a)") " passes once, velocity ratio ", surface%velocity_ratio, &
                  ", its centre at X = 0 at T = ", (surface%reach - surface%x_start)/surface%velocity_ratio
            end if
            text = text//what//feature_words(surface)//trim(line)//new_line("a")//"           "//size_words(surface)
         class default
            if (surface%at_rest()) then
               write (line, "(a,f6.3,a,f8.4)") "roughness at rest, period ", surface%period, &
                  " a, it is everywhere, its origin at X = x_start = ", surface%x_start
            else
               write (line, "(a,f6.3,a,f7.4)") "roughness on the move, period ", surface%period, " a, velocity ratio ", &
                  surface%velocity_ratio
            end if
            text = text//what//trim(line)
         end select
         text = text//new_line("a")
      end do
   end function surface_lines

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

   !> How much of the surfaces the finest grid carries
   function wave_lines(plan) result(text)
      type(plan_t), intent(in) :: plan
      character(len=:), allocatable :: text
      character(len=128) :: line
      integer :: k
      logical :: known

      text = ""
      associate (surfaces => plan%surfaces)
         ! an amplitude that is a share of the film is not known at first
         known = all([(surfaces%of(k)%surface%rms_height() > 0.0_dp, k=1, surfaces%count())])
         if (surfaces%has_spectrum() .and. plan%contact%has_size()) then
            do k = 1, surfaces%count()
               text = text//height_line(surfaces%of(k)%surface, plan%contact%film_scale)
            end do
            if (surfaces%count() > 1 .and. known) then
               write (line, "(a,es9.2,a,f8.5)") "surface    composite rms height ", surfaces%rms_height()*plan%contact%film_scale, &
                  " m, rms slope ", surfaces%rms_slope()*plan%contact%film_scale/plan%contact%radius
               text = text//trim(line)//new_line("a")
            end if
         end if
         write (line, "(a,es8.1,a)") "waves      with fewer than 8 nodes a period hold ", surfaces%unresolved, &
            " of the variance of"
         if (surfaces%pass_once() .and. surfaces%count() == 1) then
            text = trim(line)//" its profile"//new_line("a")
            return
         end if
         text = text//trim(line)//" the surface;"
         write (line, "(es8.1,a)") surfaces%left_out, " of it, with 2 and fewer, is left out"
         text = text//" "//trim(adjustl(line))//new_line("a")
      end associate
   end function wave_lines

   !> Rms height of a surface with a spectrum, and before that was cut
   function height_line(surface, film_scale) result(text)
      class(surface_t), intent(in) :: surface
      !> [m]
      real(dp), intent(in) :: film_scale
      character(len=:), allocatable :: text
      character(len=128) :: line

      text = ""
      if (.not. surface%variance > 0.0_dp) return
      write (line, "(a,es9.2,a)") "surface    rms height ", sqrt(surface%variance)*film_scale, " m"
      text = trim(line)
      if (surface%variance < surface%variance_whole) then
         write (line, "(a,es9.2,a)") ", of", sqrt(surface%variance_whole)*film_scale, " m before its spectrum was cut"
         text = text//trim(line)
      end if
      text = text//new_line("a")
   end function height_line

   !> Rough surfaces at rest: where they lie, and where the error comes from
   function rest_lines(plan) result(text)
      type(plan_t), intent(in) :: plan
      character(len=:), allocatable :: text

      text = surface_lines(plan%surfaces)//"           a steady contact; the smooth one is solved before"//new_line("a")
      if (plan%coarse_run) text = text//"error      of the friction ratio: solved on the next coarser grid too"//new_line("a")
   end function rest_lines
end module ehl_surface_text

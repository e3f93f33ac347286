! SPDX-License-Identifier: BSD-3-Clause
!> The rough surfaces of a plan in words
module ehl_surface_text
   use ehl_feature, only: feature_t
   use ehl_kinds, only: dp
   use ehl_moving_surfaces, only: moving_surfaces_t
   use ehl_plan, only: plan_t
   use ehl_surface, only: surface_t
   use ehl_text, only: fixed, newline, percent, to_text
   implicit none (type, external)
   private
   public :: scene_lines, wave_lines, window_words

   character(len=*), parameter :: indent = "           "

contains

   !> What moves or lies in the contact: roughness without end, or a single feature
   function scene_lines(surfaces) result(text)
      type(moving_surfaces_t), intent(in) :: surfaces
      character(len=:), allocatable :: text, label
      integer :: k

      text = ""
      do k = 1, surfaces%count()
         label = "problem    "
         if (surfaces%count() > 1) label = label//"&"//trim(surfaces%of(k)%group)//": "
         text = text//label//surface_words(surfaces%of(k)%surface, surfaces%rest())//newline
      end do
      if (surfaces%count() > 1 .and. .not. (surfaces%rest() .or. surfaces%some_rest() .or. surfaces%pass_once())) then
         text = text//indent//meeting_words(surfaces)//newline
      end if
      if (surfaces%some_rest()) then
         text = text//indent//"the smooth contact is solved before, then the one with what is at rest"
      else
         text = text//indent//"the smooth contact is solved once, before"
      end if
   end function scene_lines

   !> When both surfaces are where they began
   function meeting_words(surfaces) result(text)
      type(moving_surfaces_t), intent(in) :: surfaces
      character(len=:), allocatable :: text

      if (.not. surfaces%meets) then
         text = window_words(surfaces)
      else if (surfaces%mismatch > 0.0_dp) then
         text = "no common period: means over "//to_text(surfaces%repeats)//" periods of the slowest, "// &
                fixed(surfaces%period, "f9.4")//" a/u,"//newline//indent//"after which a surface misses its start by "// &
                fixed(surfaces%mismatch, "f6.4")//" of a period; the error of that is part of mu_ratio_error"
      else
         text = "both repeat after "//fixed(surfaces%period, "f9.4")//" a/u, "//to_text(surfaces%repeats)// &
                " periods of the slowest"
      end if
   end function meeting_words

   !> Why the error of a mean over a time that is no common period is not known, and what would do
   function window_words(surfaces) result(text)
      type(moving_surfaces_t), intent(in) :: surfaces
      character(len=:), allocatable :: text

      text = "the mean holds "//to_text(surfaces%repeats)//" periods of the slowest surface, and both meet in few positions then"
      if (surfaces%whole > 0) text = text//": time.max_periods = "//to_text(surfaces%whole)//" for all"
   end function window_words

   !> A surface, what it is and how it moves
   function surface_words(surface, steady) result(text)
      class(surface_t), intent(in) :: surface
      !> Whether nothing moves: the contact is steady
      logical, intent(in) :: steady
      character(len=:), allocatable :: text, velocity, still

      still = " at rest"//trim(merge(", steady", "        ", steady))//"; "
      velocity = ", velocity ratio "//fixed(surface%velocity_ratio, "f7.4")
      select type (surface)
      type is (feature_t)
         if (surface%at_rest()) then
            text = feature_words(surface)//still//"its centre at X = x_start = "//fixed(surface%x_start, "f8.4")
         else
            text = feature_words(surface)//" passes once"//velocity//", its centre at X = 0 at T = "// &
                   fixed((surface%reach - surface%x_start)/surface%velocity_ratio, "f7.4")
         end if
         text = text//newline//indent//size_words(surface)
      class default
         if (surface%at_rest()) then
            text = "roughness"//still//"period "//fixed(surface%period, "f6.3")// &
                   " a, it is everywhere, its origin at X = x_start = "//fixed(surface%x_start, "f8.4")
         else
            text = "roughness on the move, period "//fixed(surface%period, "f6.3")//" a"//velocity
         end if
      end select
   end function surface_words

   !> What a feature is
   pure function feature_words(feature) result(text)
      type(feature_t), intent(in) :: feature
      character(len=:), allocatable :: text

      if (feature%is_line) then
         text = "a "//trim(merge("ridge ", "groove", feature%sign > 0.0_dp))
      else
         text = "a "//merge("bump", "dent", feature%sign > 0.0_dp)
      end if
   end function feature_words

   !> Size and place of a feature
   function size_words(feature) result(text)
      type(feature_t), intent(in) :: feature
      character(len=:), allocatable :: text

      text = fixed(feature%width, "f9.4")//" a wide"
      if (feature%length > 0.0_dp) then
         text = text//" and "//fixed(feature%length, "f9.4")//" a long"
      else
         text = text//", without ends"
      end if
      if (feature%amplitude > 0.0_dp) text = text//", "//fixed(feature%amplitude, "es10.3")//" a^2/R "// &
                                             merge("high", "deep", feature%sign > 0.0_dp)
      text = text//", at Y = "//fixed(feature%y_start, "f9.4")
   end function size_words

   !> How much of the surfaces the finest grid carries
   function wave_lines(plan) result(text)
      type(plan_t), intent(in) :: plan
      character(len=:), allocatable :: text, label
      integer :: k
      logical :: known

      text = ""
      associate (surfaces => plan%surfaces, scales => plan%scales)
         ! an amplitude that is a share of the film is not known at first
         known = surfaces%count() > 1 .and. all([(surfaces%of(k)%surface%rms_height() > 0.0_dp, k=1, surfaces%count())])
         if (surfaces%has_spectrum() .and. scales%has_size()) then
            do k = 1, surfaces%count()
               label = ""
               if (surfaces%count() > 1) label = "&"//trim(surfaces%of(k)%group)//": "
               text = text//height_line(surfaces%of(k)%surface, label, scales%film)
            end do
            if (known) then
               text = text//"surface    composite rms height "//fixed(surfaces%rms_height()*scales%film, "es9.2")// &
                      " m, rms slope "//fixed(surfaces%rms_slope()*scales%film/scales%length, "f8.5")
               if (surfaces%move_together()) text = text//"; both move together, correlation "// &
                                                    fixed(surfaces%correlation(1), "f9.2")
               text = text//newline
            end if
         end if
         text = text//"waves      with fewer than 8 nodes a period hold "//share_words(surfaces%unresolved)// &
                " of the variance of "
         if (surfaces%pass_once() .and. surfaces%count() == 1) then
            text = text//"its profile"
         else
            text = text//"the surface; "//share_words(surfaces%left_out)//" of it, with 2 and fewer, is left out"
         end if
      end associate
   end function wave_lines

   !> A share of the variance in per cent
   function share_words(share) result(text)
      real(dp), intent(in) :: share
      character(len=:), allocatable :: text

      text = percent(share)
      if (share < 1.0e-4_dp) text = "less than 0.01 %"
      if (.not. share > 0.0_dp) text = "0 %"
   end function share_words

   !> Rms height of a surface with a spectrum, and before that was cut
   function height_line(surface, label, film_scale) result(text)
      class(surface_t), intent(in) :: surface
      !> Of several surfaces the group that it is of
      character(len=*), intent(in) :: label
      !> [m]
      real(dp), intent(in) :: film_scale
      character(len=:), allocatable :: text

      text = ""
      if (.not. surface%rms_height() > 0.0_dp) then
         if (label /= "") text = "surface    "//label//"rms height by its share of the film, once that is known"//newline
         return
      end if
      text = "surface    "//label//"rms height "//fixed(surface%rms_height()*film_scale, "es9.2")//" m"
      if (surface%variance < surface%variance_whole) text = text//", of "// &
         fixed(sqrt(surface%variance_whole)*film_scale, "es9.2")//" m before its spectrum was cut"
      text = text//newline
   end function height_line
end module ehl_surface_text

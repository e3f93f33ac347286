! SPDX-License-Identifier: BSD-3-Clause
!> Fields of a run
submodule (ehl_solver) ehl_solver_fields
   use ehl_level, only: gap
   use ehl_status, only: ehl_bad_input, ehl_no_memory
   implicit none (type, external)

   !> Temperature rises of the film and of the walls
   character(len=field_length), parameter :: temperatures(3) = [character(len=field_length) :: &
      "temperature_rise_K", "temperature_rise_wall_1_K", "temperature_rise_wall_2_K"]

contains

   module procedure field_names
      if (self%run%is_rough() .and. self%run%plan%surfaces%rough()) then
         names = [character(len=field_length) :: "P", "H", "P_smooth", "H_smooth", "RR", "A_d"]
      else
         names = [character(len=field_length) :: "P", "H"]
      end if
      if (allocated(self%run%smooth_heat%rise) .or. allocated(self%run%rough_heat%rise)) names = [names, temperatures]
   end procedure field_names

   module procedure field
      character(len=field_length), allocatable :: names(:)
      real(dp), allocatable :: own(:, :)
      integer :: stat, k

      values = 0.0_dp
      call self%field_names(names)
      if (all(names /= name)) then
         call status%fail(ehl_bad_input, "field '"//name//"' is not known: 'P' or 'H' was expected, with a rough "// &
                          "surface also 'P_smooth', 'H_smooth', 'RR' or 'A_d'; with frictional heating also '"// &
                          trim(temperatures(1))//"', '"//trim(temperatures(2))//"' or '"//trim(temperatures(3))//"'")
         return
      end if
      associate (level => self%run%hierarchy%levels(self%run%level()))
         allocate (own(level%grid%nx, level%grid%full_ny()), stat=stat)
         if (stat /= 0) then
            call status%fail(ehl_no_memory, "no memory for a field")
            return
         end if
         select case (name)
         case ("P")
            call level%grid%unfold(level%p, own)
         case ("H")
            call level%grid%unfold(gap(level), own)
         case ("P_smooth")
            call level%grid%unfold(self%run%p_smooth, own)
         case ("H_smooth")
            call level%grid%unfold(self%run%h_smooth, own)
         case ("RR")
            if (self%run%phase == phase_stationary) then
               call level%grid%unfold(self%run%stationary%rr, own)
            else
               call level%grid%unfold(self%run%transient%rr, own)
            end if
         case ("A_d")
            call level%grid%unfold(self%run%h_smooth - gap(level), own)
         case default
            k = findloc(temperatures, name, dim=1)
            if (allocated(self%run%rough_heat%rise)) then
               call level%grid%unfold(self%run%rough_heat%rise(:, :, k), own)
            else
               call level%grid%unfold(self%run%smooth_heat%rise(:, :, k), own)
            end if
         end select
      end associate
      call refine(own, values)
   end procedure field

   !> Interpolate bilinearly to a grid of the same extent whose numbers of intervals are a multiple of those of the coarse one
   pure subroutine refine(coarse, fine)
      real(dp), intent(in) :: coarse(:, :)
      real(dp), intent(out) :: fine(:, :)
      real(dp) :: s, t
      integer :: i, j, k, l, m

      if (all(shape(fine) == shape(coarse))) then
         fine = coarse
         return
      end if
      m = (size(fine, 1) - 1)/(size(coarse, 1) - 1)
      do j = 1, size(fine, 2)
         l = min((j - 1)/m + 1, size(coarse, 2) - 1)
         t = real(j - 1 - (l - 1)*m, dp)/m
         do i = 1, size(fine, 1)
            k = min((i - 1)/m + 1, size(coarse, 1) - 1)
            s = real(i - 1 - (k - 1)*m, dp)/m
            fine(i, j) = (1.0_dp - t)*((1.0_dp - s)*coarse(k, l) + s*coarse(k + 1, l)) &
                         + t*((1.0_dp - s)*coarse(k, l + 1) + s*coarse(k + 1, l + 1))
         end do
      end do
   end subroutine refine
end submodule ehl_solver_fields

! SPDX-License-Identifier: BSD-3-Clause
!> What a transient run did not have to do
module ehl_skipped_work
   use, intrinsic :: iso_fortran_env, only: int64
   use ehl_friction_mean, only: start_up
   use ehl_kinds, only: dp
   use ehl_plan, only: plan_t
   use ehl_text, only: to_text
   use ehl_transient, only: transient_t
   implicit none (type, external)
   private
   public :: skipped_work

   !> Periods that a transient run of a fixed length needs: until the start has died out, and one to take the mean of
   integer, parameter :: fixed_periods = start_up + 1

contains

   !> One text each
   function skipped_work(plan, transient, good) result(skips)
      type(plan_t), intent(in) :: plan
      type(transient_t), intent(in) :: transient
      !> Whether the transient run ended because the mean has settled
      logical, intent(in) :: good
      character(len=128), allocatable :: skips(:)
      integer(int64) :: left
      integer :: periods

      allocate (skips(0))
      associate (grid => plan%finest)
         if (grid%mirror) call add(to_text(grid%nx*(grid%full_ny() - grid%ny))//" of "//to_text(grid%nx*grid%full_ny())// &
                                   " nodes: the scene is symmetric in Y")
      end associate
      if (transient%skipped > 0) call add(to_text(transient%skipped)//" steps before the roughness came near the contact")
      periods = merge(plan%max_periods, fixed_periods, plan%max_periods > 0)
      ! beyond the largest integer with many periods of a slow surface
      left = ceiling(max(transient%mean%filled, 0) + periods*transient%mean%period/transient%mean%repeats/transient%time_step, &
                     int64) - transient%step
      if (good .and. plan%steps == 0 .and. left > 0 .and. .not. plan%surfaces%pass_once()) then
         call add(to_text(left)//" steps up to the end of period "//to_text(periods)//": the mean of mu_r/mu_s had settled")
      end if
      call add("a second solve of the smooth contact: one gave the start of the transient run and mu_s")
      call add("corrections of the deflection where P = 0")

   contains

      subroutine add(what)
         character(len=*), intent(in) :: what
         skips = [character(len=128) :: skips, what]
      end subroutine add
   end function skipped_work
end module ehl_skipped_work

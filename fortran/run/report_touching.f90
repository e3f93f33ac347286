! SPDX-License-Identifier: BSD-3-Clause
!> Contact at a boundary film in the summary: what of the load it carries, where, and what the layer gives
module ehl_report_touching
   use ehl_grid, only: grid_t
   use ehl_kinds, only: dp, not_known, pi
   use ehl_plan, only: plan_t
   use ehl_record, only: record_t
   use ehl_resolution, only: has_solution
   use ehl_touching, only: touching_names
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   implicit none (type, external)
   private
   public :: report_touching, no_boundary_friction

   !> Layer over the central film by formula from which on that film hardly matters
   real(dp), parameter :: dry_from = 2.0_dp
   !> Why there is no friction
   character(len=*), parameter :: no_boundary_friction = "the bodies touch, and the friction there is not known: "// &
                                                         "lubricant.boundary_friction and sliding are needed"

contains

   !> Results of the contact of the case, null unless they are good; nothing where there is no boundary film
   subroutine report_touching(record, plan, grid, numbers, coarser, stop_error, why)
      type(record_t), intent(inout) :: record
      type(plan_t), intent(in) :: plan
      !> Of the results
      type(grid_t), intent(in) :: grid
      !> As touching.f90 has them; NaN: there is no solution
      real(dp), intent(in) :: numbers(size(touching_names))
      !> Load share on the next coarser grid; NaN where it is not known, and then why
      real(dp), intent(in) :: coarser
      !> Error of the share by the end of the run; NaN where there is no solution
      real(dp), intent(in) :: stop_error
      character(len=*), intent(in) :: why
      real(dp) :: error
      character(len=:), allocatable :: note

      if (.not. plan%lubricant%boundary_film > 0.0_dp) return
      ! of order 1, as the edge of a touching zone lies between two nodes
      error = abs(numbers(1) - coarser)
      note = ""
      if (.not. ieee_is_finite(numbers(1))) then
         note = "there is no solution"
      else if (.not. ieee_is_finite(coarser)) then
         note = why
      else if (.not. (is_dry(plan) .or. has_solution(plan%contact, plan%point, grid%coarser()))) then
         note = "the next coarser grid does not resolve the inlet, and bodies touch on it for that"
         error = not_known
      end if
      call record%set("boundary_film", plan%lubricant%boundary_film)
      call record%set("contact_load_share", numbers(1))
      call record%set("contact_load_share_error", error + stop_error)
      call record%set("contact_load_share_error_grid", error)
      call record%set("contact_load_share_error_stop", stop_error)
      call record%set("contact_load_share_error_note", note)
      call record%set("contact_area_share", numbers(2)/(pi*plan%contact%ellipticity))
      call record%set("layer_supply", numbers(3))
      if (.not. plan%lubricant%boundary_limit > 0.0_dp) return
      call record%set("load_share_at_hardness", numbers(4))
      call record%set("area_share_at_hardness", numbers(5)/(pi*plan%contact%ellipticity))
      call record%set("plastic_depth_max_m", numbers(6)*plan%scales%film)
      call record%set("flowing_load_share_at_hardness", numbers(7))
   end subroutine report_touching

   !> Whether the film that the inlet makes is nothing beside the layer
   logical function is_dry(plan)
      type(plan_t), intent(in) :: plan

      associate (point => plan%point)
         is_dry = plan%lubricant%boundary_film > dry_from*plan%contact%film_formula(point%moes_m, point%moes_l)
      end associate
   end function is_dry
end module ehl_report_touching

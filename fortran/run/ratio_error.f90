! SPDX-License-Identifier: BSD-3-Clause
!> The error of mu_ratio: parts under names of their own and their sum, or why it is not known
module ehl_ratio_error
   use ehl_kinds, only: dp
   use ehl_record, only: record_t
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   implicit none (type, external)
   private
   public :: ratio_error_t, waves_t

   !> The sum so far. A part that is not known makes it unknown.
   type :: ratio_error_t
      private
      real(dp) :: sum = 0.0_dp
      character(len=:), allocatable :: note
   contains
      procedure :: add
      procedure :: report
   end type ratio_error_t

   !> What a prediction says of the waves that the grid leaves out, and of those that it does not resolve
   type :: waves_t
      !> Whether there is a prediction
      logical :: known = .false.
      !> Parts of mu_ratio in these waves; NaN where the prediction gives none
      real(dp) :: left_out = 0.0_dp, unresolved = 0.0_dp
      !> Why it gives none
      character(len=:), allocatable :: why
   end type waves_t

contains

   !> Add a part to the sum, and to a record under its name
   subroutine add(self, record, name, part, why)
      class(ratio_error_t), intent(inout) :: self
      type(record_t), intent(inout) :: record
      character(len=*), intent(in) :: name
      !> Of either sign; NaN where it is not known
      real(dp), intent(in) :: part
      !> Why it is not known
      character(len=*), intent(in) :: why

      call record%set(name, abs(part))
      self%sum = self%sum + abs(part)
      if (ieee_is_finite(part)) return
      if (.not. allocated(self%note)) then
         self%note = why
      else if (index(self%note, why) == 0) then
         self%note = self%note//"; "//why
      end if
   end subroutine add

   !> The sum, null where a part is not known, and then the reasons
   subroutine report(self, record)
      class(ratio_error_t), intent(in) :: self
      type(record_t), intent(inout) :: record

      call record%set("mu_ratio_error", self%sum)
      if (allocated(self%note)) then
         call record%set("mu_ratio_error_note", self%note)
      else
         call record%set("mu_ratio_error_note", "")
      end if
   end subroutine report
end module ehl_ratio_error

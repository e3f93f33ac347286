! SPDX-License-Identifier: BSD-3-Clause
!> Errors as values: a code and a message, passed as the last argument
module ehl_status
   implicit none (type, external)
   private
   public :: status_t
   public :: ehl_bad_input, ehl_closed, ehl_no_memory, ehl_file, ehl_internal

   !> No error
   integer, parameter :: ehl_ok = 0
   !> The case file or an argument is not acceptable
   integer, parameter :: ehl_bad_input = 1
   !> A handle does not name an open solver
   integer, parameter :: ehl_closed = 2
   !> An allocation failed
   integer, parameter :: ehl_no_memory = 3
   !> A file could not be read or written
   integer, parameter :: ehl_file = 4
   !> A condition that should never occur
   integer, parameter :: ehl_internal = 5

   !> Outcome of a call
   type :: status_t
      !> One of the codes above
      integer :: code = ehl_ok
      !> Error message for the user; empty without an error
      character(len=:), allocatable :: message
      !> group.key of the refused value of a case, if there is one
      character(len=:), allocatable :: key
   contains
      procedure :: failed
      procedure :: fail
   end type status_t

contains

   !> Whether there is an error
   pure logical function failed(self)
      class(status_t), intent(in) :: self
      failed = self%code /= ehl_ok
   end function failed

   !> Record an error unless there is an earlier one
   subroutine fail(self, code, message, key)
      class(status_t), intent(inout) :: self
      integer, intent(in) :: code
      character(len=*), intent(in) :: message
      character(len=*), intent(in), optional :: key
      if (self%failed()) return
      self%code = code
      self%message = message
      if (present(key)) self%key = key
   end subroutine fail
end module ehl_status

! SPDX-License-Identifier: BSD-3-Clause
!> How routines for Python end
module ehl_reply
   use, intrinsic :: iso_c_binding, only: c_int
   use ehl_status, only: status_t
   implicit none (type, external)
   private
   public :: reply

contains

   !> Code and text of a status
   subroutine reply(status, stat, message)
      type(status_t), intent(in) :: status
      integer(c_int), intent(out) :: stat
      character(len=4096), intent(out) :: message

      stat = int(status%code, c_int)
      message = ""
      if (status%failed()) message = status%message
   end subroutine reply
end module ehl_reply

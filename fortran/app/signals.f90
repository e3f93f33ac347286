! SPDX-License-Identifier: BSD-3-Clause
!> SIGINT and SIGTERM stop the program after the present cycle or time step
module ehl_signals
   use, intrinsic :: iso_c_binding, only: c_funloc, c_funptr, c_int
   implicit none (type, external)
   private
   public :: watch_signals, stop_requested

   logical, volatile :: received = .false.

   integer(c_int), parameter :: sigint = 2, sigterm = 15

   interface
      type(c_funptr) function posix_signal(number, handler) bind(c, name="signal")
         import :: c_funptr, c_int
         implicit none (type, external)
         integer(c_int), value :: number
         type(c_funptr), value :: handler
      end function posix_signal
   end interface

contains

   !> Catch both signals from now on
   subroutine watch_signals()
      type(c_funptr) :: previous

      previous = posix_signal(sigint, c_funloc(note_signal))
      previous = posix_signal(sigterm, c_funloc(note_signal))
   end subroutine watch_signals

   !> Whether a signal was received
   logical function stop_requested()
      stop_requested = received
   end function stop_requested

   !> Signal handler; the same signal a second time ends the program at once
   subroutine note_signal(number) bind(c)
      integer(c_int), value :: number
      type(c_funptr) :: previous

      received = .true.
      previous = posix_signal(number, default_action())
   end subroutine note_signal

   !> Default action of a signal (SIG_DFL, a null address)
   type(c_funptr) function default_action()
      use, intrinsic :: iso_c_binding, only: c_null_funptr

      default_action = c_null_funptr
   end function default_action
end module ehl_signals

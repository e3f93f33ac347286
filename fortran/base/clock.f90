! SPDX-License-Identifier: BSD-3-Clause
!> Wall time
module ehl_clock
   use, intrinsic :: iso_fortran_env, only: int64
   use ehl_kinds, only: dp
   implicit none (type, external)
   private
   public :: clock_t, start_clock

   !> A stopwatch
   type :: clock_t
      private
      integer(int64) :: started = 0
   contains
      procedure :: seconds
   end type clock_t

contains

   !> A stopwatch that starts now
   function start_clock() result(clock)
      type(clock_t) :: clock

      call system_clock(clock%started)
   end function start_clock

   !> Seconds since the start
   real(dp) function seconds(self)
      class(clock_t), intent(in) :: self
      integer(int64) :: now, rate

      call system_clock(now, rate)
      seconds = real(now - self%started, dp)/real(rate, dp)
   end function seconds
end module ehl_clock

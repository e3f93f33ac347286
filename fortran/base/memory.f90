! SPDX-License-Identifier: BSD-3-Clause
!> How much memory is free
module ehl_memory
   use, intrinsic :: iso_fortran_env, only: int64
   use ehl_kinds, only: dp
   implicit none (type, external)
   private
   public :: free_bytes

contains

   !> Bytes that the machine and the control group of the process still have; huge where nobody tells
   real(dp) function free_bytes()
      real(dp) :: limit, used

      free_bytes = number_in("/proc/meminfo", "MemAvailable:")*1024.0_dp
      limit = number_in("/sys/fs/cgroup/memory.max", "")
      used = number_in("/sys/fs/cgroup/memory.current", "")
      if (limit < huge(1.0_dp) .and. used < huge(1.0_dp)) free_bytes = min(free_bytes, max(0.0_dp, limit - used))
   end function free_bytes

   !> The number behind a word at the beginning of a line of a file; huge when there is none
   real(dp) function number_in(path, word) result(number)
      character(len=*), intent(in) :: path, word
      character(len=256) :: line
      integer(int64) :: found
      integer :: lun, stat, read_stat

      number = huge(1.0_dp)
      open (newunit=lun, file=path, status="old", action="read", iostat=stat)
      if (stat /= 0) return
      do
         read (lun, "(a)", iostat=stat) line
         if (stat /= 0) exit
         if (index(line, word) /= 1) cycle
         read (line(len(word) + 1:), *, iostat=read_stat) found
         if (read_stat == 0) number = real(found, dp)
         exit
      end do
      close (lun)
   end function number_in
end module ehl_memory

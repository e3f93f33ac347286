! SPDX-License-Identifier: BSD-3-Clause
!> Free memory, and the check of a memory requirement, for `ehl` and the Python package
module ehl_memory
   use, intrinsic :: iso_fortran_env, only: int64
   use ehl_kinds, only: dp
   use ehl_number_text, only: amount_buffer
   use ehl_status, only: ehl_no_memory, status_t
   implicit none (type, external)
   private
   public :: check_memory, free_bytes, amount

   !> Maximum length of a line of the files read here
   integer, parameter :: longest = 4096

contains

   !> Fail if a memory requirement exceeds the free memory
   subroutine check_memory(what, needed, status)
      !> Name of what needs the memory, for the message
      character(len=*), intent(in) :: what
      real(dp), intent(in) :: needed
      type(status_t), intent(inout) :: status
      real(dp) :: free

      if (status%failed()) return
      free = free_bytes("")
      if (needed <= free) return
      call status%fail(ehl_no_memory, what//" needs "//amount(needed)//" of memory, "//amount(free)//" are free")
   end subroutine check_memory

   !> Bytes as text with a unit
   pure function amount(bytes) result(text)
      real(dp), intent(in) :: bytes
      character(len=len_trim(amount_buffer(bytes))) :: text
      text = amount_buffer(bytes)
   end function amount

   !> Minimum of the free bytes of the machine, of the control groups of the process and of its address space; huge if none is
   !> reported
   real(dp) function free_bytes(root) result(free)
      !> Folder that contains /proc and /sys: empty except in tests
      character(len=*), intent(in) :: root
      character(len=longest) :: line
      real(dp) :: limit, used
      integer :: lun, stat

      free = min(number_in(root//"/proc/meminfo", "MemAvailable:"), huge(free)/1024)*1024
      limit = number_in(root//"/proc/self/limits", "Max address space")
      used = number_in(root//"/proc/self/status", "VmSize:")
      if (limit < huge(limit) .and. used < huge(used)) free = min(free, max(0.0_dp, limit - 1024*used))
      open (newunit=lun, file=root//"/proc/self/cgroup", status="old", action="read", iostat=stat)
      if (stat /= 0) return
      do
         read (lun, "(a)", iostat=stat) line
         if (stat /= 0) exit
         if (index(line, "0::/") == 1) then
            call limit_by_groups(root//"/sys/fs/cgroup", trim(line(4:)), "memory.max", "memory.current", &
                                 "inactive_file", free)
         else if (index(line, ":memory:/") > 0) then
            call limit_by_groups(root//"/sys/fs/cgroup/memory", trim(line(index(line, ":memory:/") + 8:)), &
                                 "memory.limit_in_bytes", "memory.usage_in_bytes", "total_inactive_file", free)
         end if
      end do
      close (lun)
   end function free_bytes

   !> Reduce `free` to the free bytes of a control group and its parents; inactive pages of files count as free
   subroutine limit_by_groups(root, path, limit_name, used_name, cache_name, free)
      character(len=*), intent(in) :: root, path, limit_name, used_name, cache_name
      real(dp), intent(inout) :: free
      real(dp) :: limit, used, cache
      integer :: last

      last = len(path)
      do
         if (path(last:last) == "/") last = last - 1
         associate (group => root//path(:last)//"/")
            limit = number_in(group//limit_name, "")
            used = number_in(group//used_name, "")
            cache = number_in(group//"memory.stat", cache_name//" ")
         end associate
         if (.not. cache < huge(cache)) cache = 0.0_dp
         if (limit < huge(limit) .and. used < huge(used)) free = min(free, max(0.0_dp, limit - used + cache))
         if (last == 0) return
         last = index(path(:last), "/", back=.true.)
      end do
   end subroutine limit_by_groups

   !> The number after a word at the beginning of a line of a file; huge if there is none
   real(dp) function number_in(path, word) result(number)
      character(len=*), intent(in) :: path, word
      character(len=longest) :: line
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

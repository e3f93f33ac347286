! SPDX-License-Identifier: BSD-3-Clause
!> Running processes, and files left behind by processes that have ended
module ehl_processes
   use, intrinsic :: iso_c_binding, only: c_int
   use ehl_files, only: remove_file, remove_folder
   use ehl_folders, only: error_number, folder_above, link_text, list_folder, name_t
   implicit none (type, external)
   private
   public :: process_is_there, remove_left_over

   interface
      integer(c_int) function posix_kill(process, signal) bind(c, name="kill")
         import :: c_int
         implicit none (type, external)
         integer(c_int), value :: process, signal
      end function posix_kill
   end interface

contains

   !> Whether a process with this number runs on this machine
   logical function process_is_there(process)
      character(len=*), intent(in) :: process
      !> No signal, only a check; error number for processes of other users
      integer(c_int), parameter :: none = 0, not_permitted = 1
      integer(c_int) :: number
      integer :: stat

      process_is_there = .false.
      if (verify(process, "0123456789") > 0) return
      read (process, *, iostat=stat) number
      if (stat /= 0) return
      if (number <= 0) return
      process_is_there = posix_kill(number, none) == 0
      if (process_is_there) return
      process_is_there = error_number() == not_permitted
   end function process_is_there

   !> Remove what killed processes have left beside a path, in folders path//between//"-"//number: files that may be removed, and
   !> the folder if it is then empty
   subroutine remove_left_over(path, between, list, may_remove)
      !> Absolute path without a final '/', and beginning of the suffix
      character(len=*), intent(in) :: path, between
      !> List that is passed to may_remove
      character(len=*), intent(in) :: list
      interface
         !> Whether a file with this name may be removed
         logical function may_remove(name, list)
            implicit none (type, external)
            character(len=*), intent(in) :: name, list
         end function may_remove
      end interface
      type(name_t), allocatable :: beside(:), names(:)
      character(len=:), allocatable :: folder, beginning, number
      logical :: gone
      integer :: k, n

      folder = folder_above(path)
      beginning = path(index(path, "/", back=.true.) + 1:)//between//"-"
      if (.not. list_folder(folder, beside, beginning)) return
      do k = 1, size(beside)
         associate (name => beside(k)%text)
            if (index(name, beginning) /= 1) cycle
            ! the number of the process, followed by that of the attempt
            number = name(len(beginning) + 1:)
            number = number(:scan(number//"-", "-") - 1)
            if (number == "" .or. verify(number, "0123456789") > 0 .or. process_is_there(number)) cycle
            if (link_text(folder//"/"//name) /= "") cycle
            if (.not. list_folder(folder//"/"//name, names)) cycle
            do n = 1, size(names)
               if (may_remove(names(n)%text, list)) gone = remove_file(folder//"/"//name//"/"//names(n)%text)
            end do
            gone = remove_folder(folder//"/"//name)
         end associate
      end do
   end subroutine remove_left_over
end module ehl_processes

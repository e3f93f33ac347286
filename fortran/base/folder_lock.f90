! SPDX-License-Identifier: BSD-3-Clause
!> Lock of a folder while a run writes into it: a file DIR.lock beside it, with process, its start and machine. The lock of
!> a process that has ended is taken over, or removed with the next result that is written beside it.
module ehl_folder_lock
   use, intrinsic :: iso_c_binding, only: c_char, c_int, c_null_char, c_size_t
   use ehl_files, only: file_exists, fortran_text, may_write, process_mark, remove_file, rename_path
   use ehl_folders, only: folder_above, full_path, is_there, list_folder, make_parents, move_new, name_t, spare_path
   use ehl_processes, only: process_is_there
   use ehl_status, only: ehl_bad_input, ehl_file, status_t
   use ehl_text, only: newline
   use ehl_whole_file, only: read_text, write_text
   implicit none (type, external)
   private
   public :: folder_lock_t, remove_stale_locks

   type :: folder_lock_t
      !> Path of the lock file; not allocated: nothing is locked
      character(len=:), allocatable, private :: path
   contains
      procedure :: take
      procedure :: release
   end type folder_lock_t

   character(len=*), parameter :: suffix = ".lock", mark = "! A run writes into the folder beside this file; removed with its end"
   !> Maximum size of a lock file [bytes]
   integer, parameter :: longest = 4096

   interface
      integer(c_int) function posix_gethostname(buffer, length) bind(c, name="gethostname")
         import :: c_char, c_int, c_size_t
         implicit none (type, external)
         character(kind=c_char), intent(out) :: buffer(*)
         integer(c_size_t), value :: length
      end function posix_gethostname
   end interface

contains

   !> Lock a folder; refuse one that another run or another solver of this process has locked. There is no lock if no file can
   !> be written beside the folder.
   subroutine take(self, folder, status)
      class(folder_lock_t), intent(inout) :: self
      character(len=*), intent(in) :: folder
      type(status_t), intent(inout) :: status
      character(len=:), allocatable :: path, fresh, text
      type(status_t) :: reading
      logical :: done
      integer :: k

      if (status%failed()) return
      path = full_path(folder)//suffix
      if (allocated(self%path)) then
         if (self%path == path) return
      end if
      call self%release()
      call make_parents(path)
      if (.not. may_write(folder_above(path))) return
      fresh = spare_path(path)
      ! write the complete file before it gets its name
      call write_text(fresh, mark//newline//process_mark()//" "//start_of(process_mark())//" "//machine()//newline, status)
      do k = 1, 3
         if (status%failed()) exit
         if (move_new(fresh, path)) then
            self%path = path
            return
         end if
         reading = status_t()
         call read_text(path, longest, text, reading)
         ! the other run may have ended meanwhile
         if (.not. is_there(path)) cycle
         call refuse_if_held(folder, path, text, status)
         if (.not. status%failed()) call remove_if_unchanged(path, text)
      end do
      done = remove_file(fresh)
      if (.not. status%failed()) call status%fail(ehl_file, path//": error: cannot be written")
   end subroutine take

   !> Unlock the folder
   subroutine release(self)
      class(folder_lock_t), intent(inout) :: self
      logical :: gone

      if (.not. allocated(self%path)) return
      gone = remove_file(self%path)
      deallocate (self%path)
   end subroutine release

   !> Remove stale locks in a folder: those of runs of this machine that have ended
   subroutine remove_stale_locks(folder, ended)
      character(len=*), intent(in) :: folder
      !> Absolute paths of the folders of these runs
      type(name_t), allocatable, intent(out) :: ended(:)
      type(name_t), allocatable :: names(:)
      character(len=:), allocatable :: path, text
      type(status_t) :: reading, held
      logical :: done
      integer :: k

      allocate (ended(0))
      done = list_folder(folder, names, suffix)
      do k = 1, size(names)
         path = folder//"/"//names(k)%text
         if (index(path, suffix, back=.true.) /= len(path) - len(suffix) + 1) cycle
         reading = status_t()
         held = status_t()
         call read_text(path, longest, text, reading)
         if (.not. reading%failed()) call refuse_if_held(folder, path, text, held)
         if (reading%failed() .or. held%failed()) cycle
         call remove_if_unchanged(path, text)
         ! via a variable: gfortran 12 gives a component that is set to an expression a length of one byte
         path = path(:len(path) - len(suffix))
         ended = [ended, name_t(path)]
      end do
   end subroutine remove_stale_locks

   !> Refuse the lock of a process that runs, or may run
   subroutine refuse_if_held(folder, path, text, status)
      !> Folder as the user wrote it; path of the lock and its content
      character(len=*), intent(in) :: folder, path, text
      type(status_t), intent(inout) :: status
      character(len=256) :: process, start, host
      integer :: stat

      if (index(text, mark//newline) /= 1) then
         call status%fail(ehl_bad_input, path//": error: pyehl run did not write this file"//newline// &
                          "expected: another folder for the results, or this file under another name")
         return
      end if
      read (text(len(mark) + 2:), *, iostat=stat) process, start, host
      if (stat /= 0) return
      if (host == machine()) then
         if (.not. process_is_there(trim(process))) return
         ! another process may have got the number
         if (start_of(trim(process)) /= start) return
      end if
      call status%fail(ehl_bad_input, folder//": error: process "//trim(process)//" on "//trim(host)// &
                       " is writing a result into this folder"//newline// &
                       "expected: another folder, or wait until it has ended; if it no longer runs, remove "//path)
   end subroutine refuse_if_held

   !> Remove a lock if it still has this content: another run may have replaced it
   subroutine remove_if_unchanged(path, text)
      character(len=*), intent(in) :: path, text
      character(len=:), allocatable :: backup, found
      type(status_t) :: reading
      logical :: done

      backup = spare_path(path//".old")
      if (.not. rename_path(path, backup)) return
      call read_text(backup, longest, found, reading)
      done = .false.
      if (found /= text) done = move_new(backup, path)
      if (.not. done) done = remove_file(backup)
   end subroutine remove_if_unchanged

   !> Name of this machine
   function machine() result(name)
      character(len=:), allocatable :: name
      character(kind=c_char) :: buffer(257)

      buffer = c_null_char
      name = "?"
      if (posix_gethostname(buffer, size(buffer, kind=c_size_t) - 1) /= 0) return
      if (buffer(1) /= c_null_char) name = fortran_text(buffer)
   end function machine

   !> Start time of a process after that of the machine [clock ticks]; '0' if it is not known
   function start_of(process) result(start)
      character(len=*), intent(in) :: process
      character(len=:), allocatable :: start
      character(len=1024) :: line
      character(len=64) :: words(20)
      integer :: lun, stat

      start = "0"
      if (.not. file_exists("/proc/"//process//"/stat")) return
      open (newunit=lun, file="/proc/"//process//"/stat", status="old", action="read", iostat=stat)
      if (stat /= 0) return
      read (lun, "(a)", iostat=stat) line
      close (lun)
      if (stat /= 0) return
      ! the start time is the 20th word after the name of the program in parentheses
      read (line(index(line, ")", back=.true.) + 1:), *, iostat=stat) words
      if (stat == 0) start = trim(words(20))
   end function start_of
end module ehl_folder_lock

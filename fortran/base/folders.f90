! SPDX-License-Identifier: BSD-3-Clause
!> Linux system calls for folders: their contents, and the exchange of two folders in one step
module ehl_folders
   use, intrinsic :: iso_c_binding, only: c_associated, c_char, c_f_pointer, c_f_procpointer, c_funptr, &
                                          c_int, c_int64_t, c_null_char, c_null_ptr, c_ptr, c_short, c_size_t
   use ehl_files, only: absolute_path, c_text, file_exists, fortran_text, make_folder, may_write, of_two_paths, &
                        process_mark, real_path, rename_path
   use ehl_text, only: to_text
   implicit none (type, external)
   private
   public :: error_number
   public :: name_t, list_folder, swap_paths, move_new, make_link, link_text, is_there, is_movable, spare_path
   public :: is_here, full_path, folder_above, lock_folder, make_parents, unlock_folder

   !> The name of a file or folder
   type :: name_t
      character(len=:), allocatable :: text
   end type name_t

   !> struct dirent of Linux with 64 bits
   type, bind(c) :: entry_t
      integer(c_int64_t) :: inode, offset
      integer(c_short) :: length
      character(kind=c_char) :: kind
      character(kind=c_char) :: name(256)
   end type entry_t

   !> Flags of renameat2, and its constant for the working directory
   integer(c_int), parameter :: never_replace = 1, exchange = 2, here = -100

   abstract interface
      integer(c_int) function renameat2(from_folder, from, to_folder, to, flags) bind(c)
         import :: c_char, c_int
         implicit none (type, external)
         integer(c_int), value :: from_folder, to_folder, flags
         character(kind=c_char), intent(in) :: from(*), to(*)
      end function renameat2
   end interface

   procedure(of_two_paths), bind(c, name="link") :: posix_link
   procedure(of_two_paths), bind(c, name="symlink") :: posix_symlink

   interface
      type(c_ptr) function posix_errno() bind(c, name="__errno_location")
         import :: c_ptr
         implicit none (type, external)
      end function posix_errno

      type(c_ptr) function posix_opendir(path) bind(c, name="opendir")
         import :: c_char, c_ptr
         implicit none (type, external)
         character(kind=c_char), intent(in) :: path(*)
      end function posix_opendir

      type(c_ptr) function posix_readdir(folder) bind(c, name="readdir")
         import :: c_ptr
         implicit none (type, external)
         type(c_ptr), value :: folder
      end function posix_readdir

      integer(c_int) function posix_closedir(folder) bind(c, name="closedir")
         import :: c_int, c_ptr
         implicit none (type, external)
         type(c_ptr), value :: folder
      end function posix_closedir

      integer(c_int) function posix_dirfd(folder) bind(c, name="dirfd")
         import :: c_int, c_ptr
         implicit none (type, external)
         type(c_ptr), value :: folder
      end function posix_dirfd

      integer(c_int) function posix_flock(descriptor, operation) bind(c, name="flock")
         import :: c_int
         implicit none (type, external)
         integer(c_int), value :: descriptor, operation
      end function posix_flock

      integer(c_size_t) function posix_readlink(path, buffer, length) bind(c, name="readlink")
         import :: c_char, c_size_t
         implicit none (type, external)
         character(kind=c_char), intent(in) :: path(*)
         character(kind=c_char), intent(out) :: buffer(*)
         integer(c_size_t), value :: length
      end function posix_readlink

      type(c_funptr) function posix_dlsym(library, name) bind(c, name="dlsym")
         import :: c_char, c_funptr, c_ptr
         implicit none (type, external)
         type(c_ptr), value :: library
         character(kind=c_char), intent(in) :: name(*)
      end function posix_dlsym
   end interface

contains

   !> Error number of the last system call
   integer(c_int) function error_number()
      integer(c_int), pointer :: reason

      call c_f_pointer(posix_errno(), reason)
      error_number = reason
   end function error_number

   !> Names in a folder, sorted; false if it cannot be read
   logical function list_folder(path, names, containing)
      character(len=*), intent(in) :: path
      type(name_t), allocatable, intent(out) :: names(:)
      !> Only names that contain this text: the time of sorting is quadratic in their number
      character(len=*), intent(in), optional :: containing
      type(c_ptr) :: folder, place
      type(entry_t), pointer :: entry
      character(len=:), allocatable :: text
      integer :: k
      integer(c_int) :: stat

      allocate (names(0))
      folder = posix_opendir(c_text(path))
      list_folder = c_associated(folder)
      if (.not. list_folder) return
      do
         place = posix_readdir(folder)
         if (.not. c_associated(place)) exit
         call c_f_pointer(place, entry)
         text = fortran_text(entry%name)
         if (text == "." .or. text == "..") cycle
         if (present(containing)) then
            if (index(text, containing) == 0) cycle
         end if
         k = 1
         do while (k <= size(names))
            if (lgt(names(k)%text, text)) exit
            k = k + 1
         end do
         names = [names(:k - 1), name_t(text), names(k:)]
      end do
      stat = posix_closedir(folder)
   end function list_folder

   !> Lock a folder, after other processes have finished their changes; ends with `unlock_folder`, or with the process
   function lock_folder(path) result(lock)
      character(len=*), intent(in) :: path
      type(c_ptr) :: lock
      integer(c_int), parameter :: alone = 2, interrupted = 4
      integer(c_int) :: stat

      lock = posix_opendir(c_text(path))
      if (.not. c_associated(lock)) return
      do
         if (posix_flock(posix_dirfd(lock), alone) == 0) return
         if (error_number() /= interrupted) exit
      end do
      ! the file system has no locks
      stat = posix_closedir(lock)
      lock = c_null_ptr
   end function lock_folder

   !> Release the lock of a folder
   subroutine unlock_folder(lock)
      type(c_ptr), intent(in) :: lock
      integer(c_int) :: stat

      if (c_associated(lock)) stat = posix_closedir(lock)
   end subroutine unlock_folder

   !> Exchange two files or folders, in one step if the file system supports that. False: nothing
   !> has changed, or `other` is left under a spare name.
   logical function swap_paths(one, other)
      character(len=*), intent(in) :: one, other
      character(len=:), allocatable :: backup

      swap_paths = renamed(one, other, exchange)
      if (swap_paths) return
      backup = spare_path(one//".old")
      if (.not. rename_path(other, backup)) return
      swap_paths = rename_path(one, other)
      if (swap_paths) then
         swap_paths = rename_path(backup, one)
      else
         swap_paths = rename_path(backup, other)
         swap_paths = .false.
      end if
   end function swap_paths

   !> Rename a file or folder; false if the new name exists
   logical function move_new(from, to)
      character(len=*), intent(in) :: from, to

      move_new = renamed(from, to, never_replace)
      if (move_new) return
      if (.not. is_there(to)) move_new = rename_path(from, to)
   end function move_new

   !> Rename with flags, which not all systems and file systems support
   logical function renamed(from, to, flags)
      character(len=*), intent(in) :: from, to
      integer(c_int), intent(in) :: flags
      type(c_funptr) :: place
      procedure(renameat2), pointer :: call_it

      place = posix_dlsym(c_null_ptr, c_text("renameat2"))
      renamed = c_associated(place)
      if (.not. renamed) return
      call c_f_procpointer(place, call_it)
      renamed = call_it(here, c_text(from), here, c_text(to), flags) == 0
   end function renamed

   !> Make a symbolic link; false if the name exists
   logical function make_link(target_path, path)
      character(len=*), intent(in) :: target_path, path

      make_link = posix_symlink(c_text(target_path), c_text(path)) == 0
   end function make_link

   !> Target of a symbolic link; empty if there is none
   function link_text(path) result(text)
      character(len=*), intent(in) :: path
      character(len=:), allocatable :: text
      character(kind=c_char) :: buffer(4097)
      integer(c_size_t) :: length

      length = posix_readlink(c_text(path), buffer, size(buffer, kind=c_size_t) - 1)
      buffer(max(0_c_size_t, length) + 1) = c_null_char
      text = fortran_text(buffer)
   end function link_text

   !> Whether a name exists, also as a broken link
   logical function is_there(path)
      character(len=*), intent(in) :: path

      is_there = file_exists(path)
      if (.not. is_there) is_there = link_text(path) /= ""
   end function is_there

   !> Whether a folder can be exchanged with one beside it: it is not a mount point, and the folder above can be written
   logical function is_movable(path)
      character(len=*), intent(in) :: path
      integer(c_int), parameter :: other_device = 18

      is_movable = may_write(folder_above(path))
      ! a hard link to a folder always fails; the error differs if it would cross file systems
      if (posix_link(c_text(path), c_text(spare_path(path//".partial"))) == 0) return
      if (error_number() == other_device) is_movable = .false.
   end function is_movable

   !> A path that does not exist, with this beginning
   function spare_path(beginning) result(path)
      character(len=*), intent(in) :: beginning
      character(len=:), allocatable :: path
      integer :: k

      path = beginning//"-"//process_mark()
      k = 1
      do while (is_there(path))
         k = k + 1
         path = beginning//"-"//process_mark()//"-"//to_text(k)
      end do
   end function spare_path

   !> Whether a folder is the working directory
   logical function is_here(path)
      character(len=*), intent(in) :: path

      is_here = path == real_path(absolute_path("."))
   end function is_here

   !> Absolute path of a folder without a final '/'; empty if it cannot be used
   function full_path(folder) result(path)
      character(len=*), intent(in) :: folder
      character(len=:), allocatable :: path
      integer :: last

      path = ""
      last = verify(folder, "/", back=.true.)
      if (last == 0) return
      path = real_path(absolute_path(folder(:last)))
      if (path == "/") path = ""
   end function full_path

   !> The folder that contains an absolute path
   pure function folder_above(path) result(folder)
      character(len=*), intent(in) :: path
      character(len=:), allocatable :: folder

      folder = path(:max(1, index(path, "/", back=.true.) - 1))
   end function folder_above

   !> Make the folders above a path
   subroutine make_parents(path)
      character(len=*), intent(in) :: path
      integer :: slash
      logical :: made

      do slash = 2, len(path)
         if (path(slash:slash) /= "/") cycle
         if (file_exists(path(:slash - 1))) cycle
         made = make_folder(path(:slash - 1))
         if (.not. made) return
      end do
   end subroutine make_parents
end module ehl_folders

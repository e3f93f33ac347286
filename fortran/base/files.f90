! SPDX-License-Identifier: BSD-3-Clause
!> POSIX calls for files and folders, which standard Fortran lacks
module ehl_files
   use, intrinsic :: iso_c_binding, only: c_associated, c_char, c_int, c_null_char, c_ptr, c_size_t
   use, intrinsic :: iso_fortran_env, only: int64
   use ehl_text, only: to_text
   implicit none (type, external)
   private
   public :: flush_file, file_bytes, file_exists, is_file, may_write, make_folder, remove_folder, remove_file
   public :: of_two_paths, rename_path, absolute_path, real_path, folder_of, process_mark, c_text, fortran_text
   public :: posix_close, posix_open

   abstract interface
      integer(c_int) function of_path(path) bind(c)
         import :: c_char, c_int
         implicit none (type, external)
         character(kind=c_char), intent(in) :: path(*)
      end function of_path

      integer(c_int) function of_two_paths(one, other) bind(c)
         import :: c_char, c_int
         implicit none (type, external)
         character(kind=c_char), intent(in) :: one(*), other(*)
      end function of_two_paths
   end interface

   ! not for arguments passed by value: gfortran 12 passes an address in some of the calls
   procedure(of_path), bind(c, name="rmdir") :: posix_rmdir
   procedure(of_path), bind(c, name="unlink") :: posix_unlink
   procedure(of_two_paths), bind(c, name="rename") :: posix_rename

   interface
      integer(c_int) function posix_mkdir(path, mode) bind(c, name="mkdir")
         import :: c_char, c_int
         implicit none (type, external)
         character(kind=c_char), intent(in) :: path(*)
         integer(c_int), value :: mode
      end function posix_mkdir

      integer(c_int) function posix_access(path, mode) bind(c, name="access")
         import :: c_char, c_int
         implicit none (type, external)
         character(kind=c_char), intent(in) :: path(*)
         integer(c_int), value :: mode
      end function posix_access

      integer(c_int) function posix_open(path, flags) bind(c, name="open")
         import :: c_char, c_int
         implicit none (type, external)
         character(kind=c_char), intent(in) :: path(*)
         integer(c_int), value, intent(in) :: flags
      end function posix_open

      integer(c_int) function posix_fsync(descriptor) bind(c, name="fsync")
         import :: c_int
         implicit none (type, external)
         integer(c_int), value :: descriptor
      end function posix_fsync

      integer(c_int) function posix_close(descriptor) bind(c, name="close")
         import :: c_int
         implicit none (type, external)
         integer(c_int), value, intent(in) :: descriptor
      end function posix_close

      type(c_ptr) function posix_getcwd(buffer, length) bind(c, name="getcwd")
         import :: c_char, c_ptr, c_size_t
         implicit none (type, external)
         character(kind=c_char), intent(out) :: buffer(*)
         integer(c_size_t), value :: length
      end function posix_getcwd

      type(c_ptr) function posix_realpath(path, resolved) bind(c, name="realpath")
         import :: c_char, c_ptr
         implicit none (type, external)
         character(kind=c_char), intent(in) :: path(*)
         character(kind=c_char), intent(out) :: resolved(*)
      end function posix_realpath

      integer(c_size_t) function posix_lseek(descriptor, offset, from) bind(c, name="lseek")
         import :: c_int, c_size_t
         implicit none (type, external)
         integer(c_int), value, intent(in) :: descriptor, from
         integer(c_size_t), value, intent(in) :: offset
      end function posix_lseek

      integer(c_size_t) function posix_read(descriptor, bytes, count) bind(c, name="read")
         import :: c_char, c_int, c_size_t
         implicit none (type, external)
         integer(c_int), value, intent(in) :: descriptor
         character(kind=c_char), intent(out) :: bytes(*)
         integer(c_size_t), value, intent(in) :: count
      end function posix_read

      integer(c_int) function posix_getpid() bind(c, name="getpid")
         import :: c_int
         implicit none (type, external)
      end function posix_getpid
   end interface

contains

   !> Flush a file to the disk, so that it survives a power failure; false if that fails
   logical function flush_file(path)
      character(len=*), intent(in) :: path
      integer(c_int), parameter :: to_write = 1
      integer(c_int) :: descriptor

      descriptor = posix_open(c_text(path), to_write)
      flush_file = descriptor >= 0
      if (.not. flush_file) return
      flush_file = posix_fsync(descriptor) == 0
      if (posix_close(descriptor) /= 0) flush_file = .false.
   end function flush_file

   !> Whether a file or folder exists
   logical function file_exists(path)
      character(len=*), intent(in) :: path
      integer(c_int), parameter :: there = 0

      file_exists = posix_access(c_text(path), there) == 0
   end function file_exists

   !> Length of a file [bytes]; 0 if it does not exist
   integer(int64) function file_bytes(path)
      character(len=*), intent(in) :: path

      inquire (file=path, size=file_bytes)
      file_bytes = max(file_bytes, 0_int64)
   end function file_bytes

   !> Whether this process may write a file, or into a folder
   logical function may_write(path)
      character(len=*), intent(in) :: path
      integer(c_int), parameter :: to_write = 2

      may_write = posix_access(c_text(path), to_write) == 0
   end function may_write

   !> Whether a path is a file: not a folder, device or pipe, which might block or never end. A path that cannot be
   !> opened counts as a file: reading it reports the reason.
   logical function is_file(path)
      character(len=*), intent(in) :: path
      !> Do not wait for the other end of a pipe (Linux)
      integer(c_int), parameter :: at_once = 2048, from_start = 0, from_end = 2
      integer(c_int) :: descriptor, closed
      integer(c_size_t) :: length
      character(kind=c_char) :: byte(1)

      is_file = .not. file_exists(path//"/.")
      if (.not. is_file) return
      descriptor = posix_open(c_text(path), at_once)
      if (descriptor < 0) return
      length = posix_lseek(descriptor, 0_c_size_t, from_end)
      is_file = length >= 0
      ! a device of length 0 contains bytes, or has no position after its end; `.and.` may evaluate both operands
      if (length == 0) then
         is_file = posix_lseek(descriptor, 1_c_size_t, from_start) == 1
         if (is_file) is_file = posix_lseek(descriptor, 0_c_size_t, from_start) == 0
         if (is_file) is_file = posix_read(descriptor, byte, 1_c_size_t) == 0
      end if
      closed = posix_close(descriptor)
      if (closed /= 0) is_file = .false.
   end function is_file

   !> Make a folder; false if that is not possible or it exists
   logical function make_folder(path)
      character(len=*), intent(in) :: path
      integer(c_int), parameter :: for_all = int(o"777", c_int)

      make_folder = posix_mkdir(c_text(path), for_all) == 0
   end function make_folder

   !> Remove an empty folder; false if it is not empty or does not exist
   logical function remove_folder(path)
      character(len=*), intent(in) :: path

      remove_folder = posix_rmdir(c_text(path)) == 0
   end function remove_folder

   !> Remove a file; false if it does not exist
   logical function remove_file(path)
      character(len=*), intent(in) :: path

      remove_file = posix_unlink(c_text(path)) == 0
   end function remove_file

   !> Rename a file or folder in one step. A folder replaces another one only if the latter is empty.
   logical function rename_path(from, to)
      character(len=*), intent(in) :: from, to

      rename_path = posix_rename(c_text(from), c_text(to)) == 0
   end function rename_path

   !> Absolute path; relative paths start at the working directory
   function absolute_path(path) result(absolute)
      character(len=*), intent(in) :: path
      character(len=:), allocatable :: absolute
      character(kind=c_char) :: buffer(4096)
      type(c_ptr) :: answer

      absolute = path
      if (len(path) > 0) then
         if (path(1:1) == "/") return
      end if
      answer = posix_getcwd(buffer, size(buffer, kind=8))
      if (.not. c_associated(answer)) return
      absolute = fortran_text(buffer) // "/" // path
   end function absolute_path

   !> Path of an existing file or folder without links and dots; the path itself if it does not exist
   function real_path(path) result(resolved)
      character(len=*), intent(in) :: path
      character(len=:), allocatable :: resolved
      character(kind=c_char) :: buffer(4097)

      resolved = path
      if (c_associated(posix_realpath(c_text(path), buffer))) resolved = fortran_text(buffer)
   end function real_path

   !> The folder part of a path with its '/'; empty if there is none
   pure function folder_of(path) result(folder)
      character(len=*), intent(in) :: path
      character(len=:), allocatable :: folder

      folder = path(:index(path, "/", back=.true.))
   end function folder_of

   !> A text that differs from process to process, for the names of temporary folders
   function process_mark() result(mark)
      character(len=:), allocatable :: mark

      mark = to_text(int(posix_getpid()))
   end function process_mark

   !> Text from a null-terminated buffer
   pure function fortran_text(buffer) result(text)
      character(kind=c_char), intent(in) :: buffer(:)
      character(len=:), allocatable :: text
      integer :: i

      allocate (character(len=findloc(buffer, c_null_char, dim=1) - 1) :: text)
      do i = 1, len(text)
         text(i:i) = buffer(i)
      end do
   end function fortran_text

   !> Null-terminated text for C
   pure function c_text(text) result(answer)
      character(len=*), intent(in) :: text
      character(kind=c_char) :: answer(len(text) + 1)
      integer :: i

      do i = 1, len(text)
         answer(i) = text(i:i)
      end do
      answer(len(text) + 1) = c_null_char
   end function c_text
end module ehl_files

! SPDX-License-Identifier: BSD-3-Clause
!> Standard input, output and error of a program
module ehl_streams
   use, intrinsic :: iso_c_binding, only: c_char, c_int, c_size_t
   use ehl_files, only: c_text, posix_close, posix_open
   use ehl_status, only: ehl_file, status_t
   implicit none (type, external)
   private
   public :: guard_streams, put_line

   interface
      integer(c_size_t) function posix_write(descriptor, bytes, length) bind(c, name="write")
         import :: c_char, c_int, c_size_t
         implicit none (type, external)
         integer(c_int), value, intent(in) :: descriptor
         character(kind=c_char), intent(in) :: bytes(*)
         integer(c_size_t), value, intent(in) :: length
      end function posix_write

      integer(c_int) function posix_dup(descriptor) bind(c, name="dup")
         import :: c_int
         implicit none (type, external)
         integer(c_int), value :: descriptor
      end function posix_dup
   end interface

contains

   !> Refuse a closed standard output: the first file that is opened would receive what is printed. Closed standard input and
   !> error are opened on /dev/null.
   subroutine guard_streams(status)
      type(status_t), intent(inout) :: status
      integer(c_int), parameter :: to_read_and_write = 2
      integer(c_int) :: stream, copy

      do stream = 0, 2
         copy = posix_dup(stream)
         if (copy >= 0) then
            copy = posix_close(copy)
         else
            copy = posix_open(c_text("/dev/null"), to_read_and_write)
            if (stream == 1) call status%fail(ehl_file, "standard output: error: it is closed")
         end if
      end do
   end subroutine guard_streams

   !> Write a line to standard output; false if that fails, which gfortran's runtime library does not report
   logical function put_line(text)
      character(len=*), intent(in) :: text
      integer(c_int), parameter :: output = 1
      integer(c_size_t) :: first, done

      first = 1
      do while (first <= len(text) + 1)
         associate (rest => c_text(text(first:)//new_line("a")))
            done = posix_write(output, rest, size(rest, kind=c_size_t) - 1)
         end associate
         put_line = done > 0
         if (.not. put_line) return
         first = first + done
      end do
   end function put_line
end module ehl_streams

! SPDX-License-Identifier: BSD-3-Clause
!> Arrays of real(dp) as .npy files (NumPy format 1.0)
module ehl_npy
   use, intrinsic :: iso_fortran_env, only: int32, int64, int8, real32
   use ehl_whole_file, only: end_writing, open_to_write
   use ehl_kinds, only: dp
   use ehl_status, only: ehl_file, ehl_no_memory, status_t
   use ehl_text, only: newline, to_text
   implicit none (type, external)
   private
   public :: matrix_t, write_npy, read_npy, npy_shape

   !> One matrix of a stack
   type :: matrix_t
      real(dp), allocatable :: values(:, :)
   end type matrix_t

   !> Write a vector, a matrix or a stack of matrices; a matrix keeps Fortran order, so that values(i, j) in Fortran
   !> is values[i - 1, j - 1] in Python
   interface write_npy
      module procedure write_vector
      module procedure write_matrix
      module procedure write_stack
   end interface write_npy

   character(len=*), parameter :: magic = char(147) // "NUMPY"

contains

   subroutine write_vector(path, values, status)
      character(len=*), intent(in) :: path
      real(dp), intent(in) :: values(:)
      type(status_t), intent(inout) :: status

      call write_values(path, header("False", "(" // to_text(size(values)) // ",)"), &
                        reshape(values, [size(values), 1]), status)
   end subroutine write_vector

   subroutine write_matrix(path, values, status)
      character(len=*), intent(in) :: path
      real(dp), intent(in) :: values(:, :)
      type(status_t), intent(inout) :: status

      call write_values(path, header("True", "(" // to_text(size(values, 1)) // ", " &
                                     // to_text(size(values, 2)) // ")"), values, status)
   end subroutine write_matrix

   !> A stack of matrices of the same shape: stack(k)%values(i, j) is values[i - 1, j - 1, k - 1] in Python
   subroutine write_stack(path, stack, status)
      character(len=*), intent(in) :: path
      type(matrix_t), intent(in) :: stack(:)
      type(status_t), intent(inout) :: status

      associate (n => shape(stack(1)%values))
         call write_values(path, header("True", "(" // to_text(n(1)) // ", " // to_text(n(2)) // ", " &
                                        // to_text(size(stack)) // ")"), stack(1)%values, status, stack(2:))
      end associate
   end subroutine write_stack

   !> Magic, version, length and description, padded to a multiple of 64 bytes
   pure function header(fortran_order, shape_text) result(text)
      character(len=*), intent(in) :: fortran_order, shape_text
      character(len=:), allocatable :: text
      integer :: length

      text = "{'descr': '<f8', 'fortran_order': " // fortran_order // ", 'shape': " &
             // shape_text // ", }"
      length = 64*((10 + len(text) + 1 + 63)/64) - 10
      text = text // repeat(" ", length - len(text) - 1) // newline
      text = magic // char(1) // char(0) // char(mod(length, 256)) // char(length/256) // text
   end function header

   !> Header and numbers; machines with the other byte order are not supported
   subroutine write_values(path, head, values, status, further)
      character(len=*), intent(in) :: path, head
      real(dp), intent(in) :: values(:, :)
      type(status_t), intent(inout) :: status
      !> Further matrices of the same shape
      type(matrix_t), intent(in), optional :: further(:)
      character(len=256) :: reason
      integer :: lun, stat, k, more

      more = 0
      if (present(further)) more = size(further)
      if (transfer(1_int32, 0_int8) /= 1_int8) then
         call status%fail(ehl_file, path // ": this machine is not little-endian")
         return
      end if
      call open_to_write(path, "unformatted", lun, status)
      if (status%failed()) return
      write (lun, iostat=stat, iomsg=reason) head, values
      do k = 1, more
         if (stat == 0) write (lun, iostat=stat, iomsg=reason) further(k)%values
      end do
      call end_writing(lun, path, len(head) + 8_int64*(1 + more)*size(values, kind=int64), stat, reason, status)
   end subroutine write_values

   !> Shape of the matrix in a file, as read_npy would return it
   subroutine npy_shape(path, n, status)
      character(len=*), intent(in) :: path
      integer, intent(out) :: n(2)
      type(status_t), intent(inout) :: status
      logical :: by_rows, single
      integer :: lun

      call open_npy(path, lun, n, by_rows, single, status)
      if (.not. status%failed()) close (lun)
   end subroutine npy_shape

   !> Read a matrix of little-endian float64 or float32 in either order, format 1.0 to 3.0;
   !> values(i, j) is the file's [i - 1, j - 1]
   subroutine read_npy(path, values, status)
      character(len=*), intent(in) :: path
      real(dp), allocatable, intent(inout) :: values(:, :)
      type(status_t), intent(inout) :: status
      !> Number of rows, or for Fortran order columns, read at a time
      integer, parameter :: block = 64
      real(dp), allocatable :: rows(:, :)
      real(real32), allocatable :: short(:)
      logical :: by_rows, single
      integer :: lun, stat, n(2), i, last

      call open_npy(path, lun, n, by_rows, single, status)
      if (status%failed()) return
      if (allocated(values)) deallocate (values)
      allocate (values(n(1), n(2)), rows(merge(n(2), 0, by_rows), min(block, n(1))), &
                short(merge(merge(n(2), n(1), by_rows), 0, single)), stat=stat)
      if (stat /= 0) then
         call status%fail(ehl_no_memory, path // ": no memory for " // to_text(n(1)) // " x " // to_text(n(2)) // " numbers")
         close (lun)
         return
      end if
      do i = 1, n(merge(1, 2, by_rows)), block
         last = min(i + block - 1, n(merge(1, 2, by_rows)))
         if (by_rows) then
            call read_values(lun, short, rows(:, :last - i + 1), stat)
            values(i:last, :) = transpose(rows(:, :last - i + 1))
         else
            call read_values(lun, short, values(:, i:last), stat)
         end if
         if (stat /= 0) exit
      end do
      if (stat /= 0) call status%fail(ehl_file, path // ": cannot read the array: it is shorter than its header states")
      close (lun)
   end subroutine read_npy

   !> Read the next numbers of a file, column by column
   subroutine read_values(lun, short, values, stat)
      integer, intent(in) :: lun
      !> Buffer for a column of single precision; size 0: the file is in double precision
      real(real32), intent(inout) :: short(:)
      real(dp), contiguous, intent(inout) :: values(:, :)
      integer, intent(out) :: stat
      integer :: j

      stat = 0
      do j = 1, size(values, 2)
         if (size(short) == 0) then
            read (lun, iostat=stat) values(:, j)
         else
            read (lun, iostat=stat) short
            if (stat == 0) values(:, j) = short
         end if
         if (stat /= 0) return
      end do
   end subroutine read_values

   !> Open a file and read its header, up to the first number
   subroutine open_npy(path, lun, n, by_rows, single, status)
      character(len=*), intent(in) :: path
      integer, intent(out) :: lun, n(2)
      !> Whether the last index of the array varies fastest; whether its numbers are in single precision
      logical, intent(out) :: by_rows, single
      type(status_t), intent(inout) :: status
      character(len=:), allocatable :: head, problem
      character(len=10) :: front
      character(len=2) :: more
      character(len=256) :: reason
      integer :: stat, length
      integer(int64) :: bytes

      n = 0
      by_rows = .true.
      single = .false.
      head = ""
      if (status%failed()) return
      open (newunit=lun, file=path, status="old", action="read", access="stream", &
            form="unformatted", iostat=stat, iomsg=reason)
      if (stat /= 0) then
         call status%fail(ehl_file, path // ": cannot open: " // trim(reason))
         return
      end if
      problem = "it is not an .npy file"
      inquire (unit=lun, size=bytes)
      read (lun, iostat=stat) front
      if (stat == 0 .and. front(1:6) == magic) then
         length = iachar(front(9:9)) + 256*iachar(front(10:10))
         if (iachar(front(7:7)) > 1) then
            read (lun, iostat=stat) more
            length = length + 65536*iachar(more(1:1))
         end if
         if (stat == 0 .and. length < 65536) then
            head = repeat(" ", length)
            read (lun, iostat=stat) head
            if (stat == 0) call read_header(head, n, problem)
         end if
      end if
      single = index(head, "'descr': '<f4'") > 0
      if (problem == "" .and. merge(4, 8, single)*int(n(1), int64)*n(2) > bytes) problem = "it is shorter than its header states"
      by_rows = index(head, "'fortran_order': True") == 0
      if (problem == "") return
      call status%fail(ehl_file, path // ": cannot read the array: " // problem)
      close (lun)
   end subroutine open_npy

   !> Shape of the array from its header; problem: empty if the array can be read
   subroutine read_header(head, n, problem)
      character(len=*), intent(in) :: head
      integer, intent(out) :: n(2)
      character(len=:), allocatable, intent(inout) :: problem
      integer :: first, last, stat, i

      n = 0
      if (index(head, "'descr': '<f8'") == 0 .and. index(head, "'descr': '<f4'") == 0) then
         problem = "its numbers are not little-endian float64 or float32"
         return
      end if
      problem = "it is not a matrix"
      first = index(head, "(")
      last = index(head, ")")
      if (first == 0 .or. last < first + 4) return
      if (head(last - 1:last - 1) == ",") return
      read (head(first + 1:last - 1), *, iostat=stat) n
      if (stat == 0 .and. all(n > 0) .and. count([(head(i:i) == ",", i=first, last)]) == 1) problem = ""
   end subroutine read_header
end module ehl_npy

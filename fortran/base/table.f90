! SPDX-License-Identifier: BSD-3-Clause
!> A table of numbers that grows row by row and is written as CSV
module ehl_table
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use, intrinsic :: iso_fortran_env, only: int64
   use ehl_whole_file, only: end_writing, open_to_write
   use ehl_kinds, only: dp
   use ehl_number_text, only: real_buffer
   use ehl_status, only: ehl_internal, ehl_no_memory, status_t
   use ehl_text, only: to_text
   implicit none (type, external)
   private
   public :: table_t

   !> Maximum length of a column name
   integer, parameter :: column_name_length = 32

   !> Rows of real numbers under named columns
   type :: table_t
      private
      character(len=column_name_length), allocatable :: names(:)
      !> values(column, row); allocated with spare rows
      real(dp), allocatable :: values(:, :)
      integer :: rows = 0
   contains
      procedure :: init
      procedure :: append
      procedure :: add_column
      procedure :: n_rows
      procedure :: n_columns
      procedure :: column
      procedure :: entry_of
      procedure :: row
      procedure :: write_csv
   end type table_t

contains

   !> Name the columns and delete all rows
   subroutine init(self, names)
      class(table_t), intent(inout) :: self
      character(len=*), intent(in) :: names(:)
      integer :: k

      if (allocated(self%values)) deallocate (self%values)
      if (allocated(self%names)) deallocate (self%names)
      allocate (self%names(size(names)))
      do k = 1, size(names)
         self%names(k) = adjustl(names(k))
      end do
      allocate (self%values(size(names), 64))
      self%rows = 0
   end subroutine init

   !> Add a row; values(:) has one number per column
   subroutine append(self, values, status)
      class(table_t), intent(inout) :: self
      real(dp), intent(in) :: values(:)
      type(status_t), intent(inout) :: status
      real(dp), allocatable :: larger(:, :)
      integer :: stat

      if (self%rows == size(self%values, 2)) then
         allocate (larger(size(self%values, 1), 2*self%rows), stat=stat)
         if (stat /= 0) then
            call status%fail(ehl_no_memory, "no memory for row "//to_text(self%rows + 1)//" of the history")
            return
         end if
         larger(:, :self%rows) = self%values
         call move_alloc(larger, self%values)
      end if
      self%rows = self%rows + 1
      self%values(:, self%rows) = values
   end subroutine append

   !> Add a column after the others; values(:) has one number per row
   subroutine add_column(self, name, values)
      class(table_t), intent(inout) :: self
      character(len=*), intent(in) :: name
      real(dp), intent(in) :: values(:)
      real(dp), allocatable :: wider(:, :)

      allocate (wider(self%n_columns() + 1, size(self%values, 2)))
      wider(:self%n_columns(), :self%rows) = self%values(:, :self%rows)
      wider(self%n_columns() + 1, :self%rows) = values
      call move_alloc(wider, self%values)
      self%names = [character(len=column_name_length) :: self%names, name]
   end subroutine add_column

   !> Number of rows
   pure integer function n_rows(self)
      class(table_t), intent(in) :: self
      n_rows = self%rows
   end function n_rows

   !> Number of columns
   pure integer function n_columns(self)
      class(table_t), intent(in) :: self

      n_columns = 0
      if (allocated(self%names)) n_columns = size(self%names)
   end function n_columns

   !> Values of a row, one per column
   pure function row(self, k) result(values)
      class(table_t), intent(in) :: self
      integer, intent(in) :: k
      real(dp), allocatable :: values(:)
      values = self%values(:, k)
   end function row

   !> Values of the column with this name, one per row; empty if there is no such column
   pure function column(self, name) result(values)
      class(table_t), intent(in) :: self
      character(len=*), intent(in) :: name
      real(dp), allocatable :: values(:)
      integer :: k

      do k = 1, self%n_columns()
         if (self%names(k) == name) then
            values = self%values(k, :self%rows)
            return
         end if
      end do
      allocate (values(0))
   end function column

   !> The entry of a column in a row; the column must exist
   pure real(dp) function entry_of(self, name, row)
      class(table_t), intent(in) :: self
      character(len=*), intent(in) :: name
      integer, intent(in) :: row
      integer :: k

      k = 1
      do while (self%names(k) /= name)
         k = k + 1
      end do
      entry_of = self%values(k, row)
   end function entry_of

   !> Write a heading and one line per row. A column of whole numbers is written without a
   !> decimal point; values that are not finite are left empty.
   subroutine write_csv(self, path, status)
      class(table_t), intent(in) :: self
      character(len=*), intent(in) :: path
      type(status_t), intent(inout) :: status
      logical, allocatable :: whole(:)
      character(len=:), allocatable :: line
      character(len=256) :: reason
      integer(int64) :: length
      integer :: lun, stat, i, k

      if (.not. allocated(self%names)) then
         call status%fail(ehl_internal, "the table for " // path // " has no columns")
         return
      end if
      call open_to_write(path, "formatted", lun, status)
      if (status%failed()) return
      allocate (whole(size(self%names)))
      line = ""
      do k = 1, size(self%names)
         whole(k) = all(is_whole(self%values(k, :self%rows)))
         if (k > 1) line = line // ","
         line = line // trim(self%names(k))
      end do
      write (lun, "(a)", iostat=stat, iomsg=reason) line
      length = len(line) + 1
      do i = 1, self%rows
         if (stat /= 0) exit
         line = ""
         do k = 1, size(self%names)
            if (k > 1) line = line // ","
            call add_cell(line, self%values(k, i), whole(k))
         end do
         write (lun, "(a)", iostat=stat, iomsg=reason) line
         length = length + len(line) + 1
      end do
      call end_writing(lun, path, length, stat, reason, status)
   end subroutine write_csv

   !> Whether a number is whole (and fits an integer)
   elemental logical function is_whole(x)
      real(dp), intent(in) :: x

      is_whole = .false.
      if (ieee_is_finite(x)) then
         if (abs(x) < 2.0e9_dp) is_whole = .not. abs(x - anint(x)) > 0.0_dp
      end if
   end function is_whole

   !> Append one value to a line of text
   pure subroutine add_cell(line, x, whole)
      character(len=:), allocatable, intent(inout) :: line
      real(dp), intent(in) :: x
      logical, intent(in) :: whole

      if (whole) then
         line = line//to_text(nint(x))
      else if (ieee_is_finite(x)) then
         ! to_text would convert it twice, once for its length
         line = line//trim(real_buffer(x))
      end if
   end subroutine add_cell
end module ehl_table

! SPDX-License-Identifier: BSD-3-Clause
!> Height maps from files: .npy, or text with one row of numbers for each X
module ehl_map_file
   use ehl_kinds, only: dp
   use ehl_npy, only: read_npy
   use ehl_status, only: ehl_file, status_t
   use ehl_text, only: to_text
   implicit none (type, external)
   private
   public :: read_map

   !> Longest line of a text map
   integer, parameter :: line_length = 1048576

contains

   !> Heights of a map [m], X first; finite, at least 4 x 4 pixels
   subroutine read_map(path, heights, status)
      character(len=*), intent(in) :: path
      real(dp), allocatable, intent(out) :: heights(:, :)
      type(status_t), intent(inout) :: status
      integer :: length

      length = len_trim(path)
      if (length > 4 .and. path(max(1, length - 3):length) == ".npy") then
         call read_npy(trim(path), heights, status)
      else
         call read_text(trim(path), heights, status)
      end if
      if (status%failed()) return
      if (.not. all(abs(heights) < huge(1.0_dp))) then
         call status%fail(ehl_file, trim(path)//": the map has points that are not finite: fill them first")
      else if (size(heights, 1) < 4 .or. size(heights, 2) < 4) then
         call status%fail(ehl_file, trim(path)//": the map has "//to_text(size(heights, 1))//" x "// &
                          to_text(size(heights, 2))//" pixels; at least 4 x 4 are needed")
      end if
   end subroutine read_map

   !> Text: blank-separated numbers, '#' begins a comment, every row of the same length
   subroutine read_text(path, heights, status)
      character(len=*), intent(in) :: path
      real(dp), allocatable, intent(out) :: heights(:, :)
      type(status_t), intent(inout) :: status
      character(len=:), allocatable :: line
      character(len=256) :: reason
      real(dp), allocatable :: rows(:, :)
      integer :: lun, stat, number, columns, n

      allocate (heights(0, 0))
      open (newunit=lun, file=path, status="old", action="read", iostat=stat, iomsg=reason)
      if (stat /= 0) then
         call status%fail(ehl_file, path//": cannot open: "//trim(reason))
         return
      end if
      allocate (character(len=line_length) :: line)
      number = 0
      n = 0
      columns = 0
      do
         read (lun, "(a)", iostat=stat, iomsg=reason) line
         if (stat /= 0) exit
         number = number + 1
         if (index(line, "#") > 0) line(index(line, "#"):) = ""
         if (line == "") cycle
         if (columns == 0) then
            columns = count_words(line)
            allocate (rows(columns, 64))
         end if
         if (count_words(line) /= columns) then
            call status%fail(ehl_file, path//":"//to_text(number)//": "//to_text(count_words(line))// &
                             " numbers where "//to_text(columns)//" were expected")
            exit
         end if
         if (n == size(rows, 2)) rows = reshape(rows, [columns, 2*n], pad=[0.0_dp])
         n = n + 1
         read (line, *, iostat=stat) rows(:, n)
         if (stat /= 0) then
            call status%fail(ehl_file, path//":"//to_text(number)//": this row is not numbers alone")
            exit
         end if
      end do
      close (lun)
      if (status%failed()) return
      if (n == 0) then
         call status%fail(ehl_file, path//": there are no numbers in it")
         return
      end if
      heights = transpose(rows(:, :n))
   end subroutine read_text

   !> Words of a line, separated by blanks, tabs or commas
   pure integer function count_words(line)
      character(len=*), intent(in) :: line
      character(len=*), parameter :: separators = " ,"//achar(9)
      integer :: i
      logical :: inside, blank

      count_words = 0
      inside = .false.
      do i = 1, len_trim(line)
         blank = index(separators, line(i:i)) > 0
         if (.not. blank .and. .not. inside) count_words = count_words + 1
         inside = .not. blank
      end do
   end function count_words
end module ehl_map_file

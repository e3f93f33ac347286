! SPDX-License-Identifier: BSD-3-Clause
!> Height maps from files: .npy, or text with one row of numbers for each X
module ehl_map_file
   use ehl_kinds, only: dp
   use ehl_memory, only: check_memory
   use ehl_npy, only: npy_shape, read_npy
   use ehl_status, only: ehl_file, status_t
   use ehl_text, only: to_text
   implicit none (type, external)
   private
   public :: read_map, check_heights

   !> What numbers, "nan" and "inf" are made of, and what stands between them
   character(len=*), parameter :: number_characters = "0123456789+-.eEdDnNaAiIfFtTyY, "

contains

   !> Heights of a map [m], X first; finite, at least 4 x 4 pixels
   subroutine read_map(path, heights, status)
      character(len=*), intent(in) :: path
      real(dp), allocatable, intent(out) :: heights(:, :)
      type(status_t), intent(inout) :: status
      integer :: length, n(2), j

      length = len_trim(path)
      if (length > 4 .and. path(max(1, length - 3):length) == ".npy") then
         call npy_shape(trim(path), n, status)
         call check_heights(trim(path), n, status)
         allocate (heights(0, 0))
         if (.not. status%failed()) call read_npy(trim(path), heights, status)
      else
         call read_text(trim(path), heights, status)
      end if
      if (status%failed()) return
      do j = 1, size(heights, 2)
         if (all(abs(heights(:, j)) < huge(1.0_dp))) cycle
         call status%fail(ehl_file, trim(path)//": the map has points that are not finite: fill them first")
         return
      end do
      if (size(heights, 1) < 4 .or. size(heights, 2) < 4) then
         call status%fail(ehl_file, trim(path)//": the map has "//to_text(size(heights, 1))//" x "// &
                          to_text(size(heights, 2))//" pixels; at least 4 x 4 are needed")
      end if
   end subroutine read_map

   !> Refuse a map that would not fit. It needs room twice: for the heights and their spectrum.
   subroutine check_heights(what, n, status)
      !> What wants the memory
      character(len=*), intent(in) :: what
      !> Pixels along X and Y
      integer, intent(in) :: n(2)
      type(status_t), intent(inout) :: status

      call check_memory(what//": a map of "//to_text(n(1))//" x "//to_text(n(2))//" heights", 16.0_dp*n(1)*real(n(2), dp), status)
   end subroutine check_heights

   !> Text: numbers separated by blanks, tabs, commas or semicolons, '#' begins a comment, every row of the same length
   subroutine read_text(path, heights, status)
      character(len=*), intent(in) :: path
      real(dp), allocatable, intent(out) :: heights(:, :)
      type(status_t), intent(inout) :: status
      character(len=:), allocatable :: line
      character(len=256) :: reason
      real(dp), allocatable :: rows(:, :)
      integer :: lun, stat, number, columns, n, last

      allocate (heights(0, 0))
      open (newunit=lun, file=path, status="old", action="read", iostat=stat, iomsg=reason)
      if (stat /= 0) then
         call status%fail(ehl_file, path//": cannot open: "//trim(reason))
         return
      end if
      allocate (character(len=4096) :: line)
      number = 0
      n = 0
      columns = 0
      do
         call read_line(lun, line, last, stat)
         if (stat /= 0) exit
         number = number + 1
         call plain(line, last)
         if (last == 0) cycle
         if (columns == 0) then
            columns = count_words(line(:last))
            allocate (rows(columns, 64))
         end if
         if (count_words(line(:last)) /= columns) then
            call status%fail(ehl_file, path//":"//to_text(number)//":"//to_text(column_of(line(:last), columns + 1))//": "// &
                             to_text(count_words(line(:last)))//" numbers where "//to_text(columns)//" were expected")
            exit
         end if
         if (n == size(rows, 2)) then
            call check_heights(path//" (so far)", [columns, 2*n], status)
            if (status%failed()) exit
            call make_room(rows, n)
         end if
         n = n + 1
         ! '/' and '2*1.0' mean something else to Fortran
         stat = verify(line(:last), number_characters)
         if (stat == 0) read (line(:last), *, iostat=stat) rows(:, n)
         if (stat /= 0) then
            associate (bad => first_bad(line(:last)))
               call status%fail(ehl_file, path//":"//to_text(number)//":"//to_text(column_of(line(:last), bad))//": '"// &
                                word_of(line(:last), bad)//"' is no number; expected: heights in m")
            end associate
            exit
         end if
      end do
      close (lun)
      if (status%failed()) return
      if (n == 0) then
         call status%fail(ehl_file, path//": there are no numbers in it")
         return
      end if
      deallocate (heights)
      allocate (heights(n, columns))
      heights = transpose(rows(:, :n))
   end subroutine read_text

   !> The next line, of any length, in line(:last)
   subroutine read_line(lun, line, last, stat)
      integer, intent(in) :: lun
      character(len=:), allocatable, intent(inout) :: line
      integer, intent(out) :: last, stat
      character(len=:), allocatable :: longer
      integer :: got

      last = 0
      do
         read (lun, "(a)", advance="no", size=got, iostat=stat) line(last + 1:)
         last = last + got
         if (stat /= 0) exit
         ! the line goes on
         allocate (character(len=2*len(line)) :: longer)
         longer(:last) = line(:last)
         call move_alloc(longer, line)
      end do
      if (is_iostat_eor(stat) .or. (is_iostat_end(stat) .and. last > 0)) stat = 0
   end subroutine read_line

   !> A line without its comment and the blanks at its end; semicolons and tabs become separators of Fortran
   pure subroutine plain(line, last)
      character(len=:), allocatable, intent(inout) :: line
      integer, intent(inout) :: last
      integer :: i

      i = index(line(:last), "#")
      if (i > 0) last = i - 1
      do i = 1, last
         if (line(i:i) == ";") line(i:i) = ","
         if (line(i:i) == achar(9) .or. line(i:i) == achar(13)) line(i:i) = " "
      end do
      last = len_trim(line(:last))
   end subroutine plain

   !> Twice as many rows
   pure subroutine make_room(rows, n)
      real(dp), allocatable, intent(inout) :: rows(:, :)
      integer, intent(in) :: n
      real(dp), allocatable :: more(:, :)

      allocate (more(size(rows, 1), 2*n))
      more(:, :n) = rows
      call move_alloc(more, rows)
   end subroutine make_room

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

   !> Column of the first letter of a word; behind the last word where there are fewer
   pure integer function column_of(line, number)
      character(len=*), intent(in) :: line
      integer, intent(in) :: number

      do column_of = 1, len_trim(line)
         if (count_words(line(:column_of)) == number) return
      end do
   end function column_of

   !> A word by its number
   pure function word_of(line, number) result(word)
      character(len=*), intent(in) :: line
      integer, intent(in) :: number
      character(len=:), allocatable :: word

      word = line(column_of(line, number):)
      word = word(:scan(word//" ", " ,"//achar(9)) - 1)
   end function word_of

   !> Number of the first word that is no number
   integer function first_bad(line)
      character(len=*), intent(in) :: line
      character(len=:), allocatable :: word
      real(dp) :: value
      integer :: stat

      do first_bad = 1, count_words(line)
         stat = verify(word_of(line, first_bad), number_characters)
         word = word_of(line, first_bad)
         if (stat == 0) read (word, *, iostat=stat) value
         if (stat /= 0) return
      end do
   end function first_bad
end module ehl_map_file

! SPDX-License-Identifier: BSD-3-Clause
!> Checks of the values in namelist text, and the intrinsic read of each group
module ehl_case_values
   use ehl_case, only: case_t, path_length
   use ehl_case_groups, only: group_names, read_group, write_group
   use ehl_case_ranges, only: allows, range_of, words_of
   use ehl_case_source, only: case_source_t
   use ehl_files, only: absolute_path, folder_of
   use ehl_kinds, only: dp
   use ehl_namelist_pieces, only: keep_pieces, name_length, piece_t
   use ehl_status, only: status_t
   use ehl_text, only: lower_case, nearest_word, quoted, to_text
   implicit none (type, external)
   private
   public :: check_pieces, is_one_of, read_pieces

   !> Keys whose values are names of files
   character(len=name_length), parameter :: files(4) = [character(len=name_length) :: "file", "table", "profile_file", &
                                                        "profile_file_2"]

contains

   !> Whether other pieces have the key of a piece
   pure logical function is_one_of(piece, others)
      type(piece_t), intent(in) :: piece, others(:)
      is_one_of = any(others%group == piece%group .and. others%key == piece%key)
   end function is_one_of

   !> Refuse pieces with unknown or repeated names, and values outside their range
   subroutine check_pieces(source, status, replacing)
      type(case_source_t), intent(inout) :: source
      type(status_t), intent(inout) :: status
      !> Pieces that replace others, whose invalid values are then dropped
      type(piece_t), intent(in), optional :: replacing(:)
      type(status_t) :: ignored
      logical, allocatable :: valid(:)
      type(case_t) :: default_case
      character(len=name_length), allocatable :: keys(:)
      character(len=path_length + 2), allocatable :: values(:)
      character(len=name_length) :: group
      integer :: k, place

      group = ""
      allocate (valid(size(source%pieces)), source=.true.)
      do k = 1, size(source%pieces)
         if (status%failed()) return
         associate (piece => source%pieces(k))
            if (all(group_names /= piece%group)) then
               call source%refuse(piece%name(), "unknown group '"//trim(piece%group)//"'", one_of(piece%group, group_names), status)
               return
            end if
            if (piece%group /= group) call write_group(trim(piece%group), default_case, keys, values)
            group = piece%group
            place = findloc(keys, piece%key, dim=1)
            if (place == 0) then
               call source%refuse(piece%name(), "unknown key '"//trim(piece%key)//"' in &"//trim(piece%group), &
                                  one_of(piece%key, keys), status)
            else if (source%find(piece%name()) /= k) then
               call source%refuse(piece%name(), "key "//piece%name()//" is set twice", "every key once", status)
            else
               ignored = status_t()
               call check_value(source, piece, trim(values(place)), ignored)
               valid(k) = .not. ignored%failed()
               if (present(replacing)) then
                  if (is_one_of(piece, replacing)) cycle
               end if
               if (.not. valid(k)) status = ignored
            end if
         end associate
      end do
      call keep_pieces(source%pieces, valid)
   end subroutine check_pieces

   !> Suggestion for a name
   pure function one_of(name, names) result(expected)
      character(len=*), intent(in) :: name, names(:)
      character(len=:), allocatable :: expected
      integer :: k

      expected = nearest_word(trim(name), names)
      if (expected /= "") then
         expected = "'"//expected//"'"
         return
      end if
      expected = "one of "//trim(names(1))
      do k = 2, size(names)
         expected = expected//", "//trim(names(k))
      end do
   end function one_of

   !> Refuse an invalid value, or convert it for the intrinsic read; paths of files become absolute
   subroutine check_value(source, piece, default, status)
      type(case_source_t), intent(in) :: source
      type(piece_t), intent(inout) :: piece
      !> The default as namelist text, which gives the type; '': a list of numbers
      character(len=*), intent(in) :: default
      type(status_t), intent(inout) :: status
      character(len=:), allocatable :: range, value, expected
      character(len=name_length), allocatable :: words(:)
      real(dp) :: number
      integer :: stat, whole, place

      value = piece%value
      range = range_of(trim(piece%group), trim(piece%key))
      stat = merge(0, 1, piece%values == 1)
      if (default == "") then
         expected = "numbers separated by commas"
         stat = verify(value, "0123456789+-.eEdD, ")
      else if (index(default, "'") == 1) then
         expected = "a text between quotes"
         if (range /= "") expected = "one of '"//replaced(range, "|", "', '")//"'"
         if (scan(value, "'""") == 1 .and. len(value) > 1) then
            value = replaced(value(2:len(value) - 1), value(1:1)//value(1:1), value(1:1))
         else if (.not. allocated(piece%option)) then
            stat = 1
         end if
         if (len(value) > path_length) stat = 1
         if (range /= "") then
            words = words_of(range)
            place = 0
            do whole = 1, size(words)
               if (lower_case(trim(words(whole))) == lower_case(value)) place = whole
            end do
            if (place == 0) stat = 1
            if (place > 0) value = trim(words(place))
         else if (any(piece%key == files)) then
            if (value /= "" .and. index(value, "/") /= 1 .and. .not. allocated(piece%option)) then
              value = folder_of(source%origin)//value
            end if
            if (value /= "") value = absolute_path(value)
         end if
         value = quoted(value)
      else if (index(default, ".t") + index(default, ".f") == 1) then
         expected = ".true. or .false."
         if (all(lower_case(value) /= [character(len=7) :: ".true.", ".false.", "true", "false", "t", "f"])) stat = 1
      else
         expected = "a number in "//range
         if (scan(default, ".e") == 0) expected = "a whole number in "//range
         if (verify(value, "0123456789+-.eEdD") > 0 .or. is_huge(value)) stat = 1
         if (stat == 0) read (value, *, iostat=stat) number
         if (stat == 0) stat = merge(0, 1, allows(range, number))
         ! underflow
         if (stat == 0 .and. scan(value, "123456789") > 0 .and. .not. abs(number) > 0.0_dp) stat = 1
         if (stat == 0 .and. scan(default, ".e") == 0 .and. verify(value, "0123456789+-") > 0) then
            ! a command-line option may be 65.0
            if (abs(number - anint(number)) > 0.0_dp .or. .not. allocated(piece%option)) stat = 1
            value = to_text(nint(number))
         end if
      end if
      if (piece%values == 0) then
         call source%refuse(piece%name(), "no value for "//piece%name(), expected, status)
      else if (stat /= 0) then
         call source%refuse(piece%name(), piece%name()//" = "//piece%value, expected, status)
      end if
      piece%value = value
   end subroutine check_value

   !> Whether reading a number may overflow: a hundred or more digits before the point, or three or more of a positive exponent
   pure logical function is_huge(number)
      character(len=*), intent(in) :: number
      integer :: mark

      mark = scan(number, "eEdD")
      is_huge = scan(number//".", ".eEdD") > 100
      if (mark == 0 .or. index(number, "-", back=.true.) > mark) return
      is_huge = is_huge .or. len(number) - max(mark, index(number, "+", back=.true.)) > 2
   end function is_huge

   !> Replace all `old` in a text by `new`
   pure function replaced(text, old, new) result(answer)
      character(len=*), intent(in) :: text, old, new
      character(len=:), allocatable :: answer
      integer :: first, n

      answer = ""
      first = 1
      do
         n = index(text(first:), old)
         if (n == 0) exit
         answer = answer//text(first:first + n - 2)//new
         first = first + n - 1 + len(old)
      end do
      answer = answer//text(first:)
   end function replaced

   !> Read each group with one intrinsic read
   subroutine read_pieces(source, input, status)
      type(case_source_t), intent(in) :: source
      type(case_t), intent(inout) :: input
      type(status_t), intent(inout) :: status
      character(len=:), allocatable :: text, name
      logical :: accepted
      integer :: k, n

      do n = 1, size(group_names)
         name = trim(group_names(n))
         text = ""
         do k = 1, size(source%pieces)
            associate (piece => source%pieces(k))
               if (piece%group == name) text = text//" "//trim(piece%key)//" = "//piece%value
            end associate
         end do
         if (text == "") cycle
         ! both surfaces have the same namelist group
         call read_group(name, "&"//name(index(name, "_") + 1:)//text//" /", input, accepted)
         if (.not. accepted) call source%refuse(name, "&"//name//" cannot be read", "values of its keys", status)
      end do
   end subroutine read_pieces
end module ehl_case_values

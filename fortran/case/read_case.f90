! SPDX-License-Identifier: BSD-3-Clause
!> A case from a plain namelist: the one reader of the program and of the extension. Pieces of the text are checked one by one,
!> then each group is read by one intrinsic read, completed by what the numerics knows, and checked as a whole.
module ehl_read_case
   use ehl_case, only: case_t, lubricant_case_t, path_length
   use ehl_case_check_lubricant, only: check_constants
   use ehl_case_checks, only: check_complete, check_given
   use ehl_case_defaults, only: complete, make_isotherms
   use ehl_case_groups, only: group_names, read_group, write_group
   use ehl_case_ranges, only: allows, range_of, words_of
   use ehl_case_source, only: case_source_t
   use ehl_files, only: absolute_path, folder_of
   use ehl_kinds, only: dp
   use ehl_namelist_pieces, only: keep_pieces, mark_default, mark_derived, name_length, piece_t, split_text
   use ehl_status, only: ehl_bad_input, status_t
   use ehl_text, only: lower_case, nearest_word, newline, quoted, to_text
   use ehl_whole_file, only: read_text
   implicit none (type, external)
   private
   public :: defaults_text, read_case, read_case_file, read_lubricant, write_case

   !> Largest case file; anything longer is not one
   integer, parameter :: largest_file = 1000000
   !> What pyehl makes of an oil, a data sheet, two bodies or a finish, and no routine here
   character(len=name_length), parameter :: made_by_pyehl(*) = [character(len=name_length) :: "radius_x", "radius_y", &
      "reduced_modulus", "viscosity", "pressure_viscosity", "temperature_viscosity", "viscosity_law", "inlet_law", &
      "alpha_origin", "kind", "table_temperature", "table_pressure", "table_viscosity"], &
      groups_by_pyehl(*) = [character(len=name_length) :: "contact", "lubricant", "surface", "second_surface"]
   !> Begins an option that a person typed in a shell
   character(len=*), parameter :: typed = "--set "

contains

   !> Read, check and complete the case in a file; see read_case
   subroutine read_case_file(path, options, input, status)
      character(len=*), intent(in) :: path, options
      type(case_t), intent(out) :: input
      type(status_t), intent(inout) :: status
      character(len=:), allocatable :: text

      call read_text(path, largest_file, text, status)
      if (status%failed()) then
         status%code = ehl_bad_input
         status%message = status%message//newline//"expected: the name of a case file"
         return
      end if
      call read_case(text, path, options, input, status)
   end subroutine read_case_file

   !> Read, check and complete a case
   subroutine read_case(text, origin, options, input, status)
      !> Namelist text
      character(len=*), intent(in) :: text
      !> Name of the file it came from, for messages and for relative file names
      character(len=*), intent(in) :: origin
      !> Options group.key=value that replace values of the text, one a line, behind '--set ' where a person typed them so
      character(len=*), intent(in) :: options
      type(case_t), intent(out) :: input
      type(status_t), intent(inout) :: status
      type(case_source_t) :: source
      type(piece_t), allocatable :: replacing(:)
      integer :: k, first, last

      source%origin = origin
      call split_text(origin, text, source%pieces, status)
      allocate (replacing(0))
      first = 1
      do while (first <= len(options) .and. .not. status%failed())
         last = first + index(options(first:)//newline, newline) - 2
         if (last >= first) call keep_pieces(replacing, [(.true., k=1, size(replacing))], [option_piece(options(first:last))])
         first = last + 2
      end do
      if (.not. status%failed()) call check_pieces(source, status, replacing)
      if (.not. status%failed()) call drop_marked(source)
      if (size(replacing) > 0 .and. .not. status%failed()) then
         call keep_pieces(source%pieces, [(.not. is_one_of(source%pieces(k), replacing), k=1, size(source%pieces))], replacing)
         call check_pieces(source, status)
      end if
      if (.not. status%failed()) call read_pieces(source, input, status)
      if (.not. status%failed()) call check_given(source, input, status)
      if (.not. status%failed()) call check_constants(source, input, status)
      if (.not. status%failed()) call complete(source, input, status)
      if (.not. status%failed()) call check_complete(source, input, status)
      if (.not. status%failed()) call write_case(input, input%text, source)
   end subroutine read_case

   !> The group &lubricant alone, of a resolved case
   subroutine read_lubricant(text, lubricant, status)
      character(len=*), intent(in) :: text
      type(lubricant_case_t), intent(out) :: lubricant
      type(status_t), intent(inout) :: status
      type(case_source_t) :: source
      type(case_t) :: input
      character(len=:), allocatable :: why

      source%origin = "the lubricant"
      call split_text(source%origin, text, source%pieces, status)
      if (.not. status%failed()) call check_pieces(source, status)
      if (.not. status%failed()) call read_pieces(source, input, status)
      if (status%failed()) return
      lubricant = input%lubricant
      call make_isotherms(lubricant, why)
      if (why /= "") call source%refuse("lubricant.table_viscosity", "a table of viscosities "//why, "one of isotherms", status)
   end subroutine read_lubricant

   !> All keys with default and range, one a line with tabs between
   subroutine defaults_text(text)
      character(len=:), allocatable, intent(out) :: text
      type(case_t) :: usual
      character(len=name_length), allocatable :: keys(:)
      character(len=path_length + 2), allocatable :: values(:)
      character(len=1), parameter :: tab = achar(9)
      integer :: k, n

      text = ""
      do n = 1, size(group_names)
         call write_group(trim(group_names(n)), usual, keys, values)
         do k = 1, size(keys)
            text = text//trim(group_names(n))//"."//trim(keys(k))//tab//trim(values(k))//tab// &
                   range_of(trim(group_names(n)), trim(keys(k)))//newline
         end do
      end do
   end subroutine defaults_text

   !> An option as a piece
   pure function option_piece(option) result(piece)
      character(len=*), intent(in) :: option
      type(piece_t) :: piece
      character(len=:), allocatable :: text
      integer :: dot, equals

      text = option
      if (index(text, typed) == 1) text = text(len(typed) + 1:)
      equals = index(text//"=", "=")
      dot = index(text(:equals - 1), ".")
      piece%group = lower_case(adjustl(text(:dot - 1)))
      piece%key = lower_case(adjustl(text(dot + 1:equals - 1)))
      piece%value = trim(adjustl(text(min(len(text), equals) + 1:)))
      piece%values = merge(1, 0, piece%value /= "")
      piece%option = option
   end function option_piece

   !> Whether the key of a piece is one of those of others
   pure logical function is_one_of(piece, others)
      type(piece_t), intent(in) :: piece, others(:)
      is_one_of = any(others%group == piece%group .and. others%key == piece%key)
   end function is_one_of

   !> Refuse pieces with unknown names, names that stand twice, and values that their keys do not take
   subroutine check_pieces(source, status, replacing)
      type(case_source_t), intent(inout) :: source
      type(status_t), intent(inout) :: status
      !> Pieces that will replace some: a value that is not acceptable is left out then
      type(piece_t), intent(in), optional :: replacing(:)
      type(status_t) :: ignored
      logical, allocatable :: good(:)
      type(case_t) :: usual
      character(len=name_length), allocatable :: keys(:)
      character(len=path_length + 2), allocatable :: values(:)
      character(len=name_length) :: group
      integer :: k, place

      group = ""
      allocate (good(size(source%pieces)), source=.true.)
      do k = 1, size(source%pieces)
         if (status%failed()) return
         associate (piece => source%pieces(k))
            if (all(group_names /= piece%group)) then
               call source%refuse(piece%name(), "unknown group '"//trim(piece%group)//"'", one_of(piece%group, group_names), status)
               return
            end if
            if (piece%group /= group) call write_group(trim(piece%group), usual, keys, values)
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
               good(k) = .not. ignored%failed()
               if (present(replacing)) then
                  if (is_one_of(piece, replacing)) cycle
               end if
               if (.not. good(k)) status = ignored
            end if
         end associate
      end do
      call keep_pieces(source%pieces, good)
   end subroutine check_pieces

   !> What a name could have been
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

   !> Refuse a value that its key does not take, and make it one that the intrinsic read takes; names of files become absolute
   subroutine check_value(source, piece, usual, status)
      type(case_source_t), intent(in) :: source
      type(piece_t), intent(inout) :: piece
      !> The default as namelist text, by its kind; '': a list of numbers
      character(len=*), intent(in) :: usual
      type(status_t), intent(inout) :: status
      character(len=:), allocatable :: range, value, expected
      character(len=name_length), allocatable :: words(:)
      real(dp) :: number
      integer :: stat, whole, place

      value = piece%value
      range = range_of(trim(piece%group), trim(piece%key))
      stat = merge(0, 1, piece%values == 1)
      if (usual == "") then
         expected = "numbers with commas between them"
         stat = verify(value, "0123456789+-.eEdD, ")
      else if (index(usual, "'") == 1) then
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
         else if (piece%key == "file" .or. piece%key == "table") then
            if (value /= "" .and. index(value, "/") /= 1 .and. .not. allocated(piece%option)) &
               value = folder_of(source%origin)//value
            if (value /= "") value = absolute_path(value)
         end if
         value = quoted(value)
      else if (index(usual, ".t") + index(usual, ".f") == 1) then
         expected = ".true. or .false."
         if (all(lower_case(value) /= [character(len=7) :: ".true.", ".false.", "true", "false", "t", "f"])) stat = 1
      else
         expected = "a number in "//range
         if (scan(usual, ".e") == 0) expected = "a whole number in "//range
         if (verify(value, "0123456789+-.eEdD") > 0) stat = 1
         if (stat == 0 .and. scan(usual, ".e") == 0) read (value, *, iostat=stat) whole
         if (stat == 0) read (value, *, iostat=stat) number
         if (stat == 0) stat = merge(0, 1, allows(range, number))
         ! smaller than any number
         if (stat == 0 .and. scan(value, "123456789") > 0 .and. .not. abs(number) > 0.0_dp) stat = 1
      end if
      if (piece%values == 0) then
         call source%refuse(piece%name(), "no value for "//piece%name(), expected, status)
      else if (stat /= 0) then
         call source%refuse(piece%name(), piece%name()//" = "//piece%value, expected, status)
      end if
      piece%value = value
   end subroutine check_value

   !> A text with all of its parts `old` as `new`
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

   !> Read every group by one intrinsic read
   subroutine read_pieces(source, input, status)
      type(case_source_t), intent(in) :: source
      type(case_t), intent(inout) :: input
      type(status_t), intent(inout) :: status
      character(len=:), allocatable :: text, name
      integer :: k, n, stat

      do n = 1, size(group_names)
         name = trim(group_names(n))
         text = ""
         do k = 1, size(source%pieces)
            associate (piece => source%pieces(k))
               if (piece%group == name) text = text//" "//trim(piece%key)//" = "//piece%value
            end associate
         end do
         if (text == "") cycle
         ! both surfaces are one group
         call read_group(name, "&"//name(index(name, "_") + 1:)//text//" /", input, stat)
         if (stat /= 0) call source%refuse(name, "&"//name//" cannot be read", "values of its keys", status)
      end do
   end subroutine read_pieces

   !> Drop marked values that are what follows from the others: so an option on a resolved case does the same as on the case
   !> that it was made of. A value that somebody has changed, or that pyehl alone can make, counts as given.
   subroutine drop_marked(source)
      type(case_source_t), intent(inout) :: source
      type(case_source_t) :: given
      type(case_t) :: trial, usual
      type(status_t) :: ignored
      character(len=name_length), allocatable :: keys(:)
      character(len=path_length + 2), allocatable :: values(:)
      character(len=name_length) :: group
      logical, allocatable :: follows(:)
      integer :: k

      allocate (follows(size(source%pieces)))
      follows = source%pieces%marked
      if (.not. any(follows)) return
      group = ""
      do k = 1, size(follows)
         if (.not. (follows(k) .and. any(made_by_pyehl == source%pieces(k)%key) .and. &
                   any(groups_by_pyehl == source%pieces(k)%group))) cycle
         if (source%pieces(k)%group /= group) call write_group(trim(source%pieces(k)%group), usual, keys, values)
         group = source%pieces(k)%group
         follows(k) = values(findloc(keys, source%pieces(k)%key, dim=1)) == source%pieces(k)%value
      end do
      given = source
      call keep_pieces(given%pieces, .not. follows)
      call read_pieces(given, trial, ignored)
      call complete(given, trial, ignored)
      group = ""
      do k = 1, size(follows)
         if (.not. follows(k)) cycle
         if (source%pieces(k)%group /= group) call write_group(trim(source%pieces(k)%group), trial, keys, values)
         group = source%pieces(k)%group
         follows(k) = values(findloc(keys, source%pieces(k)%key, dim=1)) == source%pieces(k)%value
      end do
      call keep_pieces(source%pieces, .not. follows)
   end subroutine drop_marked

   !> A complete case as namelist text. Of keys that exclude each other only the one that holds is written; with a source,
   !> values that were not given are marked.
   subroutine write_case(input, text, source)
      type(case_t), intent(in) :: input
      character(len=:), allocatable, intent(out) :: text
      type(case_source_t), intent(in), optional :: source
      type(case_t) :: case, usual
      character(len=name_length), allocatable :: keys(:)
      character(len=path_length + 2), allocatable :: values(:), defaults(:)
      character(len=:), allocatable :: line
      integer :: k, n

      case = input
      text = ""
      do n = 1, size(group_names)
         call write_group(trim(group_names(n)), case, keys, values)
         call write_group(trim(group_names(n)), usual, keys, defaults)
         if (group_names(n) == "bodies" .and. .not. input%bodies%given) cycle
         text = text//"&"//trim(group_names(n))//newline
         do k = 1, size(keys)
            if (.not. holds(trim(group_names(n))//"."//trim(keys(k)), input)) cycle
            line = "   "//trim(keys(k))//" = "//trim(values(k))
            if (values(k) == "") then
               call list_text(keys(k), input, line)
               if (line == "") cycle
            else if (present(source)) then
               if (.not. source%given(trim(group_names(n))//"."//keys(k))) &
                  line = line//" "//merge(mark_default, mark_derived, values(k) == defaults(k))
            end if
            text = text//line//newline
         end do
         text = text//"/"//newline
      end do
   end subroutine write_case

   !> Numbers of the table of viscosities by their key; '' where there is none
   pure subroutine list_text(key, input, line)
      character(len=*), intent(in) :: key
      type(case_t), intent(in) :: input
      character(len=:), allocatable, intent(out) :: line
      real(dp), allocatable :: numbers(:)
      integer :: k

      line = ""
      if (.not. allocated(input%lubricant%table_viscosity)) return
      associate (l => input%lubricant)
         numbers = l%table_viscosity
         if (key == "table_temperature") numbers = l%table_temperature
         if (key == "table_pressure") numbers = l%table_pressure
      end associate
      if (size(numbers) == 0) return
      line = "   "//trim(key)//" = "//to_text(numbers(1))
      do k = 2, size(numbers)
         line = line//", "//to_text(numbers(k))
      end do
   end subroutine list_text

   !> Whether a key carries a value, and its rival does not
   pure logical function holds(name, input)
      character(len=*), intent(in) :: name
      type(case_t), intent(in) :: input

      holds = .true.
      associate (c => input%contact)
         select case (name)
         case ("contact.moes_m", "contact.moes_l", "contact.radius_ratio")
            holds = .not. c%si
         case ("contact.load", "contact.mean_velocity", "contact.reduced_modulus")
            holds = c%si
         case ("contact.radius")
            holds = c%si .and. c%round
         case ("contact.radius_x", "contact.radius_y")
            holds = c%si .and. .not. c%round
         case ("surface.amplitude", "surface.amplitude_over_film")
            holds = input%surface%amplitude_given .eqv. index(name, "film") == 0
         case ("second_surface.amplitude", "second_surface.amplitude_over_film")
            holds = input%second_surface%amplitude_given .eqv. index(name, "film") == 0
         case default
            continue
         end select
      end associate
   end function holds
end module ehl_read_case

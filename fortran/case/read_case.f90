! SPDX-License-Identifier: BSD-3-Clause
!> Reader of a case from namelist text, for `ehl` and the Python package. It checks the pieces of the text one by one, reads each
!> group with one intrinsic read, sets the defaults, and checks the complete case.
module ehl_read_case
   use ehl_case, only: case_t, lubricant_case_t, path_length
   use ehl_case_check_lubricant, only: check_constants
   use ehl_case_checks, only: check_complete, check_given
   use ehl_case_defaults, only: complete, make_isotherms
   use ehl_case_groups, only: write_group
   use ehl_case_source, only: case_source_t
   use ehl_case_values, only: check_pieces, is_one_of, read_pieces
   use ehl_namelist_pieces, only: keep_pieces, name_length, piece_t, split_text
   use ehl_status, only: ehl_bad_input, status_t
   use ehl_text, only: lower_case, newline
   use ehl_whole_file, only: read_text
   use ehl_write_case, only: write_case
   implicit none (type, external)
   private
   public :: read_case, read_case_file, read_lubricant

   !> Maximum size of a case file [bytes]
   integer, parameter :: max_file_size = 1000000
   !> Keys except lists that pyehl derives, from two bodies, an oil, a data sheet, a table, a finish or a roughness parameter, and
   !> their groups
   character(len=name_length), parameter :: keys_by_pyehl(*) = [character(len=name_length) :: "radius", "radius_x", "radius_y", &
      "reduced_modulus", "viscosity", "pressure_viscosity", "temperature_viscosity", "viscosity_law", "inlet_law", &
      "alpha_origin", "kind", "rms_height"], &
      groups_by_pyehl(*) = [character(len=name_length) :: "contact", "lubricant", "surface", "second_surface"]
   !> Keys from which pyehl derives others of the same group; those of contact follow from &bodies
   character(len=name_length), parameter :: source_keys(*) = [character(len=name_length) :: "name", "table", &
      "kinematic_viscosity_40", "finish", "ra", "rq"]
   !> Prefix of an option from the command line
   character(len=*), parameter :: option_prefix = "--set "

contains

   !> Read, check and complete the case in a file; see read_case
   subroutine read_case_file(path, options, input, status)
      character(len=*), intent(in) :: path, options
      type(case_t), intent(out) :: input
      type(status_t), intent(inout) :: status
      character(len=:), allocatable :: text

      call read_text(path, max_file_size, text, status)
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
      !> Name of its file, for messages and relative file names
      character(len=*), intent(in) :: origin
      !> Options group.key=value that replace values of the text, one per line, with '--set ' in front if from the command line
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

   !> Read only the group &lubricant of a resolved case
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

   !> Convert an option to a piece
   pure function option_piece(option) result(piece)
      character(len=*), intent(in) :: option
      type(piece_t) :: piece
      character(len=:), allocatable :: text
      integer :: dot, equals

      text = option
      if (index(text, option_prefix) == 1) text = text(len(option_prefix) + 1:)
      equals = index(text//"=", "=")
      dot = index(text(:equals - 1), ".")
      piece%group = lower_case(adjustl(text(:dot - 1)))
      piece%key = lower_case(adjustl(text(dot + 1:equals - 1)))
      piece%value = trim(adjustl(text(min(len(text), equals) + 1:)))
      piece%values = merge(1, 0, piece%value /= "")
      piece%option = option
   end function option_piece

   !> Drop marked values that equal those derived from the others, so that an option has the same effect on a resolved case as on
   !> the original. A changed value, or one that pyehl derived, counts as given; an option that would change the latter is refused.
   subroutine drop_marked(source)
      type(case_source_t), intent(inout) :: source
      type(case_source_t) :: given
      type(case_t) :: trial
      type(status_t) :: ignored
      character(len=name_length), allocatable :: keys(:)
      character(len=path_length + 2), allocatable :: values(:)
      character(len=name_length) :: group
      logical, allocatable :: follows(:)
      integer :: k

      allocate (follows(size(source%pieces)))
      ! pyehl derives lists from files
      follows = source%pieces%marked .and. source%pieces%values <= 1
      if (.not. any(follows)) return
      do k = 1, size(follows)
         if (.not. (follows(k) .and. any(keys_by_pyehl == source%pieces(k)%key) .and. &
                   any(groups_by_pyehl == source%pieces(k)%group))) cycle
         follows(k) = .not. has_source(source%pieces(k)%group)
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
         source%pieces(k)%marked = follows(k)
      end do
      call keep_pieces(source%pieces, .not. follows)

   contains

      !> Whether the text gives a key from which pyehl derives values of a group
      logical function has_source(of)
         character(len=*), intent(in) :: of
         integer :: i

         has_source = .false.
         do i = 1, size(source%pieces)
            associate (piece => source%pieces(i))
               if (piece%marked) cycle
               has_source = has_source .or. (of == "contact" .and. piece%group == "bodies") .or. &
                            (of == piece%group .and. any(source_keys == piece%key))
            end associate
         end do
      end function has_source
   end subroutine drop_marked
end module ehl_read_case

! SPDX-License-Identifier: BSD-3-Clause
!> From the text of a case file and options group.key=value to a complete case
module ehl_case_reader
   use ehl_case, only: case_t
   use ehl_case_check, only: check_case, complete_case
   use ehl_case_value, only: set_value
   use ehl_group_reader, only: read_groups
   use ehl_key_finder, only: find_key, known_groups
   use ehl_scanner, only: scan_token, token_atom, token_string, token_t
   use ehl_keys, only: bind_keys
   use ehl_schema, only: schema_t
   use ehl_source, only: source_t
   use ehl_status, only: ehl_bad_input, status_t
   use ehl_text, only: lower_case, newline
   use ehl_whole_file, only: read_text
   implicit none (type, external)
   private
   public :: read_case, read_case_file

   !> Largest case file; anything longer is not one
   integer, parameter :: largest_file = 1000000
   !> Begins an option that a person typed in a shell
   character(len=*), parameter :: typed = "--set "

contains

   !> Read, check and complete the case in a file; see read_case
   subroutine read_case_file(path, options, input, status)
      character(len=*), intent(in) :: path, options
      type(case_t), intent(out), target :: input
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

   !> Read, check and complete a case. Every fault ends in one message with its place.
   subroutine read_case(text, origin, options, input, status)
      !> Namelist text
      character(len=*), intent(in) :: text
      !> Name of the file it came from, for messages and for relative file names
      character(len=*), intent(in) :: origin
      !> Options group.key=value that replace values of the text, one a line, behind '--set ' where a person typed them so;
      !> may be empty
      character(len=*), intent(in) :: options
      type(case_t), intent(out), target :: input
      type(status_t), intent(inout) :: status
      type(schema_t) :: schema
      type(source_t), allocatable :: sources(:)
      type(token_t) :: name
      type(status_t) :: later
      integer :: start, last, k, n, key

      call bind_keys(schema, input)
      ! part by part: array constructors of texts leave copies of them behind; empty lines leave places at the end
      allocate (sources(2 + count([(options(k:k) == newline, k=1, len(options))])))
      sources(1)%name = origin
      sources(1)%text = text//newline
      start = 1
      n = 1
      do while (start <= len(options))
         last = start + index(options(start:)//newline, newline) - 2
         if (last >= start) then
            n = n + 1
            ! messages call an option as it was given
            sources(n)%name = options(start:last)
            if (index(options(start:last), typed) == 1) start = start + len(typed)
            sources(n)%text = options(start:last)//newline
            sources(n)%has_lines = .false.
         end if
         start = last + 2
      end do
      ! faults of options are told when they are read
      do k = 2, n
         later = status_t()
         call find_option(sources(k), schema, key, name, later)
         if (.not. later%failed()) schema%keys(key)%replaced = .true.
      end do
      call read_groups(sources(1), schema, status)
      if (.not. status%failed()) call settle_marks(schema, sources(:1))
      do k = 2, n
         if (.not. status%failed()) call read_option(sources(k), k, schema, status)
      end do
      if (status%failed()) return
      input%given = schema%keys%given
      call move_alloc(sources, schema%sources)
      call check_case(schema, input, status)
   end subroutine read_case

   !> Key of an option group.key=value
   subroutine find_option(source, schema, key, name, status)
      type(source_t), intent(in) :: source
      type(schema_t), intent(in) :: schema
      !> Position of the key in the schema
      integer, intent(out) :: key
      !> Its name in the option, up to the equals sign
      type(token_t), intent(out) :: name
      type(status_t), intent(inout) :: status
      character(len=:), allocatable :: group
      integer :: dot, equals

      key = 0
      equals = index(source%text, "=")
      dot = index(source%text(:max(equals - 1, 0)), ".")
      if (dot == 0) then
         call source%refuse(1, len(source%text), "option is not complete", "group.key=value", status)
         return
      end if
      group = lower_case(trim(adjustl(source%text(:dot - 1))))
      name = token_t(token_atom, dot + 1, max(dot + 1, equals - 1), trim(adjustl(source%text(dot + 1:equals - 1))))
      associate (names => schema%group_names())
         if (any(names == group)) then
            key = find_key(source, schema, group, name, status)
         else
            call source%refuse(1, max(1, dot - 1), "unknown group '"//group//"'", known_groups(group, names, ""), status)
         end if
      end associate
   end subroutine find_option

   !> One option; words need no quotes here
   subroutine read_option(source, number, schema, status)
      type(source_t), intent(in) :: source
      !> Among the sources
      integer, intent(in) :: number
      type(schema_t), intent(inout) :: schema
      type(status_t), intent(inout) :: status
      type(token_t) :: name, value
      integer :: equals, first, k, last, position

      call find_option(source, schema, k, name, status)
      if (status%failed()) return
      equals = index(source%text, "=")
      first = equals + verify(source%text(equals + 1:), " ")
      last = verify(source%text, " "//newline, back=.true.)
      position = first
      call scan_token(source%text, position, value)
      associate (key => schema%keys(k))
         if (key%given .and. key%source > 1) then
            call source%refuse(1, equals - 1, "key "//key%full_name()//" is set twice", "every key once", status)
         else if (first > last) then
            call source%refuse(equals + 1, equals + 1, "no value for "//key%full_name(), key%type_text(), status)
         else if (value%kind == token_string .and. position <= last) then
            call source%refuse(position, last, "text behind the value of "//key%full_name(), "nothing more", status)
         else
            ! without quotes the rest of the option is the value, whatever it looks like
            if (value%kind /= token_string) value = token_t(token_atom, first, last, source%text(first:last))
            call set_value(key, source, number, name, value, status)
         end if
      end associate
   end subroutine read_option

   !> Take a marked value as not given if it is what follows from those that were given: so an option on a written case
   !> does the same as on the case that it was written from, and a value that somebody has changed counts as given
   subroutine settle_marks(schema, sources)
      type(schema_t), intent(inout) :: schema
      !> Where the values came from: the case file
      type(source_t), intent(in) :: sources(:)
      type(case_t), target :: trial, defaults
      type(schema_t) :: tried, constant
      integer :: k

      if (.not. any(schema%keys%marked)) return
      call bind_keys(constant, defaults)
      call bind_keys(tried, trial)
      do k = 1, size(schema%keys)
         if (schema%keys(k)%given .and. .not. schema%keys(k)%marked) call tried%keys(k)%take(schema%keys(k))
      end do
      tried%sources = sources
      call complete_case(tried, trial)
      do k = 1, size(schema%keys)
         associate (key => schema%keys(k))
            if (key%marked .and. key%value_text() == tried%keys(k)%value_text()) call key%take(constant%keys(k))
         end associate
      end do
   end subroutine settle_marks
end module ehl_case_reader

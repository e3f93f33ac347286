! SPDX-License-Identifier: BSD-3-Clause
!> Options group.key=value of the command line
module ehl_option_reader
   use ehl_case_value, only: set_value
   use ehl_key_finder, only: find_key, group_position, hint, join
   use ehl_scanner, only: scan_token, token_atom, token_end, token_string, token_t
   use ehl_schema, only: schema_t
   use ehl_source, only: point_at, source_t
   use ehl_status, only: ehl_bad_input, status_t
   use ehl_text, only: lower_case, newline
   implicit none (type, external)
   private
   public :: split_options, note_option, read_option

contains

   !> One source per option
   subroutine split_options(options, sources)
      character(len=*), intent(in) :: options
      type(source_t), allocatable, intent(inout) :: sources(:)
      integer :: start, length

      start = 1
      do while (start <= len(options))
         length = index(options(start:), newline) - 1
         if (length < 0) length = len(options) - start + 1
         if (length > 0) then
            sources = [sources, source_t("--set " // options(start:start + length - 1), &
                                         options(start:start + length - 1), .false.)]
         end if
         start = start + length + 1
      end do
   end subroutine split_options

   !> Note that an option replaces a value of the file, which need not be acceptable then. Faults of the option are told
   !> when it is read.
   subroutine note_option(source, schema)
      type(source_t), intent(in) :: source
      type(schema_t), intent(inout) :: schema
      type(token_t) :: name
      type(status_t) :: later
      integer :: k, equals

      call find_option(source, schema, k, name, equals, later)
      if (.not. later%failed()) schema%keys(k)%replaced = .true.
   end subroutine note_option

   !> Key that an option names
   subroutine find_option(source, schema, k, name, equals, status)
      type(source_t), intent(in) :: source
      type(schema_t), intent(in) :: schema
      !> Position of the key in the schema, and of the equals sign in the option
      integer, intent(out) :: k, equals
      type(token_t), intent(out) :: name
      type(status_t), intent(inout) :: status
      character(len=:), allocatable :: group
      integer :: dot

      k = 0
      equals = index(source%text, "=")
      dot = index(source%text(:max(equals - 1, 0)), ".")
      if (dot == 0) then
         call status%fail(ehl_bad_input, point_at(source, 1, max(1, len(source%text)), &
            "option is not complete", "group.key=value"))
         return
      end if
      group = lower_case(trim(adjustl(source%text(:dot - 1))))
      if (group_position(schema%group_names(), group) == 0) then
         call status%fail(ehl_bad_input, point_at(source, 1, max(1, dot - 1), &
            "unknown group '" // group // "'", "one of " // join(schema%group_names(), ", ") &
            // hint(group, schema%group_names(), "")))
         return
      end if
      name%first = dot + 1
      name%last = max(dot + 1, equals - 1)
      name%text = trim(adjustl(source%text(dot + 1:equals - 1)))
      k = find_key(source, schema, group, name, status)
   end subroutine find_option

   !> One option group.key=value; words need no quotes here
   subroutine read_option(source, number, schema, status)
      type(source_t), intent(in) :: source
      integer, intent(in) :: number
      type(schema_t), intent(inout) :: schema
      type(status_t), intent(inout) :: status
      character(len=:), allocatable :: value
      type(token_t) :: name, token
      integer :: equals, k, position

      call find_option(source, schema, k, name, equals, status)
      if (status%failed()) return
      if (schema%keys(k)%given .and. schema%keys(k)%source > 1) then
         call status%fail(ehl_bad_input, point_at(source, 1, equals - 1, &
            "key " // schema%keys(k)%full_name() // " is set twice", "every key once"))
         return
      end if
      value = source%text(equals + 1:)
      position = equals + 1
      call scan_token(source%text, position, token)
      if (token%kind /= token_string) then
         ! The rest of the option is the value, whatever it looks like
         token%kind = token_atom
         token%first = equals + max(1, verify(value, " "))
         token%text = trim(adjustl(value))
         token%last = max(token%first, token%first + len(token%text) - 1)
         if (token%text == "") token%kind = token_end
      else if (position <= len_trim(source%text)) then
         call status%fail(ehl_bad_input, point_at(source, position, len_trim(source%text), &
            "text behind the value of " // schema%keys(k)%full_name(), "nothing more"))
         return
      end if
      if (token%kind == token_end) then
         call status%fail(ehl_bad_input, point_at(source, equals + 1, equals + 1, &
            "no value for " // schema%keys(k)%full_name(), schema%keys(k)%type_text()))
         return
      end if
      call set_value(schema%keys(k), source, number, name, token, status)
   end subroutine read_option
end module ehl_option_reader

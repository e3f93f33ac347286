! SPDX-License-Identifier: BSD-3-Clause
!> Groups and keys by name, and what to say about a name that nobody knows
module ehl_key_finder
   use ehl_other_names, only: about_name
   use ehl_scanner, only: token_t
   use ehl_schema, only: schema_t
   use ehl_source, only: point_at, source_t
   use ehl_status, only: ehl_bad_input, status_t
   use ehl_text, only: lower_case, nearest_word
   implicit none (type, external)
   private
   public :: find_key, known_groups, join

contains

   !> Position of a key in the schema; unknown and repeated keys are faults
   integer function find_key(source, schema, group, name, status)
      type(source_t), intent(in) :: source
      type(schema_t), intent(in) :: schema
      character(len=*), intent(in) :: group
      type(token_t), intent(in) :: name
      type(status_t), intent(inout) :: status
      character(len=:), allocatable :: what, expected, where_else
      integer :: k

      find_key = schema%find(group, lower_case(name%text))
      if (find_key > 0) then
         if (.not. (schema%keys(find_key)%given .and. source%has_lines)) return
         what = "key "//schema%keys(find_key)%full_name()//" is there twice"
         expected = "every key once"
      else
         what = "unknown key '"//name%text//"' in &"//group
         where_else = hint(name%text, schema%names_of(group), "")
         do k = 1, size(schema%keys)
            if (schema%keys(k)%name /= lower_case(name%text)) cycle
            where_else = "; '"//trim(schema%keys(k)%name)//"' belongs to &"//trim(schema%keys(k)%group)
            exit
         end do
         expected = about_name(group, name%text)
         if (expected == "") expected = "one of the keys "//join(schema%names_of(group), ", ")//where_else
      end if
      call status%fail(ehl_bad_input, point_at(source, name%first, name%last, what, expected))
   end function find_key

   !> What to expect in place of an unknown group: what there is to say about the name, or the groups with a prefix
   pure function known_groups(name, names, prefix) result(text)
      character(len=*), intent(in) :: name, names(:), prefix
      character(len=:), allocatable :: text

      text = about_name("", name)
      if (text == "") text = "one of the groups "//prefix//join(names, ", "//prefix)//hint(name, names, prefix)
   end function known_groups

   !> Names with something between them
   pure function join(names, between) result(text)
      character(len=*), intent(in) :: names(:), between
      character(len=:), allocatable :: text
      integer :: k

      text = trim(names(1))
      do k = 2, size(names)
         text = text//between//trim(names(k))
      end do
   end function join

   !> '; did you mean ...?' where a name is near
   pure function hint(name, names, prefix) result(text)
      character(len=*), intent(in) :: name, names(:), prefix
      character(len=:), allocatable :: text

      text = nearest_word(name, names)
      if (text /= "") text = "; did you mean '"//prefix//text//"'?"
   end function hint
end module ehl_key_finder

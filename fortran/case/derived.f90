! SPDX-License-Identifier: BSD-3-Clause
!> Values of a written case that nobody gave: the writer marks them, and the reader takes the mark away from those
!> that somebody has changed since. All others follow anew from what they depend on, so that an option
!> group.key=value on a written case does the same as on the case that it was written from.
module ehl_derived
   use ehl_case, only: case_t
   use ehl_case_check, only: complete_case
   use ehl_case_key, only: key_t
   use ehl_schema, only: schema_t
   use ehl_source, only: source_t
   use ehl_text, only: newline
   implicit none (type, external)
   private
   public :: mark_default, mark_derived, has_mark, settle_marks

   !> Ends of the lines of keys that were not given: the value is a constant default, or follows from other keys
   character(len=*), parameter :: mark_default = "! default", mark_derived = "! derived"

contains

   !> Whether the line of the value that ends at a position ends in a mark
   pure logical function has_mark(text, position)
      character(len=*), intent(in) :: text
      integer, intent(in) :: position
      character(len=:), allocatable :: line
      integer :: length

      line = text(position + 1:)
      length = scan(line, achar(13)//newline) - 1
      if (length >= 0) line = line(:length)
      has_mark = ends_in(line, mark_default) .or. ends_in(line, mark_derived)
   end function has_mark

   pure logical function ends_in(line, mark)
      character(len=*), intent(in) :: line, mark
      integer :: last

      last = len_trim(line)
      ends_in = .false.
      if (last >= len(mark)) ends_in = line(last - len(mark) + 1:last) == mark
   end function ends_in

   !> Take a marked value as not given if it is what follows from those that were given
   subroutine settle_marks(schema, sources)
      type(schema_t), intent(inout) :: schema
      !> Where the values came from: the case file
      type(source_t), intent(in) :: sources(:)
      type(case_t), target :: trial, defaults
      type(schema_t) :: tried, constant
      integer :: k

      if (.not. any(schema%keys%marked)) return
      call constant%bind(defaults)
      call tried%bind(trial)
      do k = 1, size(schema%keys)
         if (.not. schema%keys(k)%given .or. schema%keys(k)%marked) cycle
         call tried%keys(k)%copy_value(schema%keys(k))
         call copy_place(tried%keys(k), schema%keys(k))
      end do
      call complete_case(tried, trial, sources)
      do k = 1, size(schema%keys)
         associate (key => schema%keys(k))
            if (.not. key%marked) cycle
            if (key%value_text() /= tried%keys(k)%value_text()) cycle
            call key%copy_value(constant%keys(k))
            key%given = .false.
         end associate
      end do
   end subroutine settle_marks

   !> A key was given where another one was
   subroutine copy_place(key, other)
      type(key_t), intent(inout) :: key
      type(key_t), intent(in) :: other

      key%given = other%given
      key%source = other%source
      key%name_first = other%name_first
      key%name_last = other%name_last
      key%first = other%first
      key%last = other%last
   end subroutine copy_place
end module ehl_derived

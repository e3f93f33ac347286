! SPDX-License-Identifier: BSD-3-Clause
!> Named values in the order in which they were set, written as one JSON object
module ehl_record
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ehl_kinds, only: dp, not_known
   use ehl_text, only: newline, to_text
   implicit none (type, external)
   private
   public :: record_t

   !> One name and its value, already as JSON
   type :: item_t
      character(len=:), allocatable :: name
      character(len=:), allocatable :: value
   end type item_t

   !> A small ordered collection of named values
   type :: record_t
      private
      type(item_t), allocatable :: items(:)
   contains
      !> call record%set(name, value): real(dp), integer, logical or character, or a list of
      !> character, or several real(dp) under names with blanks between them; a name that is there already gets the new value
      generic :: set => set_real, set_reals, set_integer, set_logical, set_text, set_texts
      procedure, private :: set_reals
      procedure, private :: set_texts
      procedure, private :: set_real
      procedure, private :: set_integer
      procedure, private :: set_logical
      procedure, private :: set_text
      procedure, private :: put
      procedure, private :: value_of
      !> What is there under a name
      procedure :: has
      procedure :: number
      procedure :: text => text_value
      procedure :: to_json
      procedure :: take_json
   end type record_t

contains

   !> Set a real value; nan and inf become null
   subroutine set_real(self, name, value)
      class(record_t), intent(inout) :: self
      character(len=*), intent(in) :: name
      real(dp), intent(in) :: value

      if (ieee_is_finite(value)) then
         call self%put(name, to_text(value))
      else
         call self%put(name, "null")
      end if
   end subroutine set_real

   !> Set several real values, one for each of the names
   subroutine set_reals(self, names, values)
      class(record_t), intent(inout) :: self
      !> With one blank between two of them
      character(len=*), intent(in) :: names
      real(dp), intent(in) :: values(:)
      integer :: first, next, k

      first = 1
      do k = 1, size(values)
         next = first + index(names(first:)//" ", " ")
         call self%set(names(first:next - 2), values(k))
         first = next
      end do
   end subroutine set_reals

   !> Set a list of texts; trailing blanks are dropped
   subroutine set_texts(self, name, values)
      class(record_t), intent(inout) :: self
      character(len=*), intent(in) :: name
      character(len=*), intent(in) :: values(:)
      character(len=:), allocatable :: list
      integer :: k

      list = ""
      do k = 1, size(values)
         if (k > 1) list = list // ", "
         list = list // json_text(trim(values(k)))
      end do
      call self%put(name, "[" // list // "]")
   end subroutine set_texts

   !> Set an integer value
   subroutine set_integer(self, name, value)
      class(record_t), intent(inout) :: self
      character(len=*), intent(in) :: name
      integer, intent(in) :: value
      call self%put(name, to_text(value))
   end subroutine set_integer

   !> Set a truth value
   subroutine set_logical(self, name, value)
      class(record_t), intent(inout) :: self
      character(len=*), intent(in) :: name
      logical, intent(in) :: value

      call self%put(name, trim(merge("true ", "false", value)))
   end subroutine set_logical

   !> Set a text; trailing blanks are dropped
   subroutine set_text(self, name, value)
      class(record_t), intent(inout) :: self
      character(len=*), intent(in) :: name
      character(len=*), intent(in) :: value
      call self%put(name, json_text(trim(value)))
   end subroutine set_text

   !> Store a value that is JSON already
   subroutine put(self, name, value)
      class(record_t), intent(inout) :: self
      character(len=*), intent(in) :: name
      character(len=*), intent(in) :: value
      integer :: k

      if (.not. allocated(self%items)) allocate (self%items(0))
      do k = 1, size(self%items)
         if (self%items(k)%name == name) then
            self%items(k)%value = value
            return
         end if
      end do
      self%items = [self%items, item_t(name, value)]
   end subroutine put

   !> The value under a name, as JSON; empty where there is none
   pure function value_of(self, name) result(value)
      class(record_t), intent(in) :: self
      character(len=*), intent(in) :: name
      character(len=:), allocatable :: value
      integer :: k

      value = ""
      if (.not. allocated(self%items)) return
      do k = 1, size(self%items)
         if (self%items(k)%name == name) value = self%items(k)%value
      end do
   end function value_of

   !> Whether there is a value under a name, null included
   pure logical function has(self, name)
      class(record_t), intent(in) :: self
      character(len=*), intent(in) :: name
      has = len(self%value_of(name)) > 0
   end function has

   !> The number under a name; NaN where there is none
   pure real(dp) function number(self, name)
      class(record_t), intent(in) :: self
      character(len=*), intent(in) :: name
      character(len=:), allocatable :: value
      integer :: stat

      value = self%value_of(name)
      read (value, *, iostat=stat) number
      if (stat /= 0) number = not_known
   end function number

   !> The text under a name, its escapes taken away; empty where there is none
   pure function text_value(self, name) result(text)
      class(record_t), intent(in) :: self
      character(len=*), intent(in) :: name
      character(len=:), allocatable :: text
      character(len=:), allocatable :: value
      integer :: i

      text = ""
      value = self%value_of(name)
      if (index(value, '"') /= 1) return
      i = 2
      do while (i < len(value))
         if (value(i:i) == "\") i = i + 1
         text = text // value(i:i)
         i = i + 1
      end do
   end function text_value

   !> The record as a JSON object, one value a line. Reals have as many digits as they need to
   !> read back as the same number.
   function to_json(self) result(text)
      class(record_t), intent(in) :: self
      character(len=:), allocatable :: text
      integer :: k

      text = "{"
      if (allocated(self%items)) then
         do k = 1, size(self%items)
            if (k > 1) text = text // ","
            text = text // newline // "  " // json_text(self%items(k)%name) // ": " &
                   // self%items(k)%value
         end do
      end if
      text = text // newline // "}" // newline
   end function to_json

   !> Take the values of a JSON object that has one value a line, as `to_json` writes it
   subroutine take_json(self, text)
      class(record_t), intent(inout) :: self
      character(len=*), intent(in) :: text
      integer :: start, last, first, colon

      start = 1
      do while (start <= len(text))
         last = start + index(text(start:)//newline, newline) - 2
         first = index(text(start:last), '"')
         colon = index(text(start:last), '": ')
         if (first > 0 .and. colon > first) then
            first = start + first
            colon = start + colon
            call self%put(text(first:colon - 2), text(colon + 2:last - merge(1, 0, text(last:last) == ",")))
         end if
         start = last + 2
      end do
   end subroutine take_json

   !> A JSON string with its escapes
   pure function json_text(value) result(text)
      character(len=*), intent(in) :: value
      character(len=:), allocatable :: text
      character(len=*), parameter :: hex = "0123456789abcdef"
      integer :: i, code

      text = '"'
      do i = 1, len(value)
         code = iachar(value(i:i))
         if (value(i:i) == '"' .or. value(i:i) == "\") then
            text = text // "\" // value(i:i)
         else if (code < 32) then
            text = text // "\u00" // hex(code/16 + 1:code/16 + 1) // hex(mod(code, 16) + 1:mod(code, 16) + 1)
         else
            text = text // value(i:i)
         end if
      end do
      text = text // '"'
   end function json_text
end module ehl_record

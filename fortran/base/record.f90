! SPDX-License-Identifier: BSD-3-Clause
!> Named values in the order in which they were set: results of a run, and codes of reasons, whose texts are in pyehl
module ehl_record
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ehl_kinds, only: dp, not_known
   use ehl_text, only: newline, to_text
   implicit none (type, external)
   private
   public :: record_t, kind_real, kind_integer, kind_logical, kind_code, kind_detail, kind_text, kind_list, kind_note

   !> Kind of a value: a result (first three); the code of a status or a reason (ehl_reason); a number in the text of a reason; a
   !> text; a list of texts in JSON; a text within the text of a reason
   integer, parameter :: kind_real = 1, kind_integer = 2, kind_logical = 3, kind_code = 4, kind_detail = 5, kind_text = 6, &
                         kind_list = 7, kind_note = 8

   !> One name and its value
   type :: item_t
      character(len=:), allocatable :: name
      integer :: kind = kind_real
      real(dp) :: value = 0.0_dp
      character(len=:), allocatable :: text
   end type item_t

   !> A small ordered collection of named values
   type :: record_t
      private
      type(item_t), allocatable :: items(:)
   contains
      !> call record%set(name, value): real(dp), integer, logical or character, a list of character, or several real(dp) under names
      !> separated by blanks; replaces the value of an existing name
      generic :: set => set_real, set_reals, set_integer, set_logical, set_text, set_texts
      procedure, private :: set_real, set_reals, set_integer, set_logical, set_text, set_texts
      procedure :: set_code
      procedure :: set_detail
      procedure :: set_note
      procedure, private :: put
      procedure :: number
      procedure :: list
      procedure :: to_json
   end type record_t

contains

   subroutine set_real(self, name, value)
      class(record_t), intent(inout) :: self
      character(len=*), intent(in) :: name
      real(dp), intent(in) :: value
      call self%put(name, kind_real, value)
   end subroutine set_real

   !> Set several real values, one per name
   subroutine set_reals(self, names, values)
      class(record_t), intent(inout) :: self
      !> Names, separated by one blank
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

   subroutine set_integer(self, name, value)
      class(record_t), intent(inout) :: self
      character(len=*), intent(in) :: name
      integer, intent(in) :: value
      call self%put(name, kind_integer, real(value, dp))
   end subroutine set_integer

   subroutine set_logical(self, name, value)
      class(record_t), intent(inout) :: self
      character(len=*), intent(in) :: name
      logical, intent(in) :: value
      call self%put(name, kind_logical, merge(1.0_dp, 0.0_dp, value))
   end subroutine set_logical

   !> Set a text; trailing blanks are dropped
   subroutine set_text(self, name, text)
      class(record_t), intent(inout) :: self
      character(len=*), intent(in) :: name
      character(len=*), intent(in) :: text
      call self%put(name, kind_text, 0.0_dp, trim(text))
   end subroutine set_text

   !> Set a list of texts without quotes in them; trailing blanks are dropped
   subroutine set_texts(self, name, texts)
      class(record_t), intent(inout) :: self
      character(len=*), intent(in) :: name
      character(len=*), intent(in) :: texts(:)
      character(len=:), allocatable :: list
      integer :: k

      list = ""
      do k = 1, size(texts)
         if (k > 1) list = list//", "
         list = list//'"'//trim(texts(k))//'"'
      end do
      call self%put(name, kind_list, 0.0_dp, "["//list//"]")
   end subroutine set_texts

   !> Set the code of a status or a reason, which is not written to JSON
   subroutine set_code(self, name, code)
      class(record_t), intent(inout) :: self
      character(len=*), intent(in) :: name
      integer, intent(in) :: code
      call self%put(name, kind_code, real(code, dp))
   end subroutine set_code

   !> Set a number in the text of a reason, which is not written to JSON
   subroutine set_detail(self, name, value)
      class(record_t), intent(inout) :: self
      character(len=*), intent(in) :: name
      real(dp), intent(in) :: value
      call self%put(name, kind_detail, value)
   end subroutine set_detail

   !> Set a text within the text of a reason, which is not written to JSON
   subroutine set_note(self, name, text)
      class(record_t), intent(inout) :: self
      character(len=*), intent(in) :: name
      character(len=*), intent(in) :: text
      call self%put(name, kind_note, 0.0_dp, text)
   end subroutine set_note

   !> Set an item, or replace that of the same name
   subroutine put(self, name, kind, value, text)
      class(record_t), intent(inout) :: self
      character(len=*), intent(in) :: name
      integer, intent(in) :: kind
      real(dp), intent(in) :: value
      character(len=*), intent(in), optional :: text
      type(item_t) :: item
      integer :: k

      item = item_t(name, kind, value, "")
      if (present(text)) item%text = text
      if (.not. allocated(self%items)) allocate (self%items(0))
      do k = 1, size(self%items)
         if (self%items(k)%name == name) then
            self%items(k) = item
            return
         end if
      end do
      self%items = [self%items, item]
   end subroutine put

   !> The number under a name; NaN if there is none
   pure real(dp) function number(self, name)
      class(record_t), intent(in) :: self
      character(len=*), intent(in) :: name
      integer :: k

      number = not_known
      if (.not. allocated(self%items)) return
      do k = 1, size(self%items)
         if (self%items(k)%name == name) number = self%items(k)%value
      end do
   end function number

   !> All values for a caller in another language: names, one per line, with a text after a tab; kinds and values
   subroutine list(self, names, kinds, values)
      class(record_t), intent(in) :: self
      character(len=:), allocatable, intent(out) :: names
      integer, allocatable, intent(out) :: kinds(:)
      real(dp), allocatable, intent(out) :: values(:)
      integer :: k

      names = ""
      allocate (kinds(0), values(0))
      if (.not. allocated(self%items)) return
      kinds = self%items%kind
      values = self%items%value
      do k = 1, size(self%items)
         names = names//self%items(k)%name
         if (any(kinds(k) == [kind_text, kind_note])) names = names//achar(9)//one_line(self%items(k)%text)
         names = names//newline
      end do
   end subroutine list

   !> A text with its line ends replaced by blanks
   pure function one_line(text)
      character(len=*), intent(in) :: text
      character(len=len(text)) :: one_line
      integer :: i

      one_line = text
      do i = 1, len(text)
         if (text(i:i) == newline) one_line(i:i) = " "
      end do
   end function one_line

   !> Results and texts as a JSON object, one value per line. Reals have the digits that they need to read back as the same
   !> number; nan and inf are null.
   function to_json(self) result(text)
      class(record_t), intent(in) :: self
      character(len=:), allocatable :: text
      character(len=:), allocatable :: value
      integer :: k, n

      text = "{"
      n = 0
      if (allocated(self%items)) n = size(self%items)
      do k = 1, n
         associate (item => self%items(k))
            select case (item%kind)
            case (kind_real)
               value = "null"
               if (ieee_is_finite(item%value)) value = to_text(item%value)
            case (kind_integer)
               value = to_text(nint(item%value))
            case (kind_logical)
               value = trim(merge("true ", "false", item%value > 0.0_dp))
            case (kind_text)
               value = '"'//item%text//'"'
            case (kind_list)
               value = item%text
            case default
               cycle
            end select
            if (text /= "{") text = text//","
            text = text//newline//'  "'//item%name//'": '//value
         end associate
      end do
      text = text//newline//"}"//newline
   end function to_json
end module ehl_record

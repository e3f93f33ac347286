! SPDX-License-Identifier: BSD-3-Clause
!> A key of a case file: what it takes, what it means, and where its value lives
module ehl_case_key
   use ehl_case, only: text_case_t, word_length
   use ehl_kinds, only: dp
   use ehl_text, only: quoted, to_text
   implicit none (type, external)
   private
   public :: key_t, origin_t, choices, allowed_length, name_length, mark_default, mark_derived
   public :: kind_real, kind_integer, kind_logical, kind_word, kind_path, kind_text

   integer, parameter :: name_length = 24, allowed_length = 96
   integer, parameter :: kind_real = 1, kind_integer = 2, kind_logical = 3
   !> Ends of the lines of keys of a written case that were not given: constant defaults, and what follows from other keys
   character(len=*), parameter :: mark_default = "! default", mark_derived = "! derived"
   !> One of a list of words; a file name; any text
   integer, parameter :: kind_word = 4, kind_path = 5, kind_text = 6

   !> Whether the input gave a key, and where: source number, first and last position of the name, first and last position
   !> of the value
   type :: origin_t
      logical :: given = .false.
      integer :: source = 0, name_first = 0, name_last = 0, first = 0, last = 0
   end type origin_t

   !> One key
   type, extends(origin_t) :: key_t
      character(len=name_length) :: group = "", name = ""
      integer :: kind = 0
      character(len=8) :: unit = "-"
      !> Numbers: an interval such as '(0, 10]', '0 or [1, 5]'; words: 'this|that'
      character(len=allowed_length) :: allowed = ""
      character(len=96) :: meaning = ""
      !> The value inside the case, one of these
      real(dp), pointer :: real_value => null()
      integer, pointer :: integer_value => null()
      logical, pointer :: logical_value => null()
      character(len=word_length), pointer :: word_value => null()
      type(text_case_t), pointer :: text_value => null()
      !> Whether the input says that nobody gave it; whether an option replaces what the file gives
      logical :: marked = .false., replaced = .false.
   contains
      procedure :: full_name
      procedure :: value_text
      procedure :: type_text
      procedure :: in_millimetres
      procedure :: allows
      procedure :: take
   end type key_t

contains

   !> group.name
   pure function full_name(self) result(name)
      class(key_t), intent(in) :: self
      character(len=:), allocatable :: name

      name = trim(self%group) // "." // trim(self%name)
   end function full_name

   !> The value as a namelist writes it
   pure function value_text(self) result(text)
      class(key_t), intent(in) :: self
      character(len=:), allocatable :: text

      select case (self%kind)
      case (kind_real)
         text = to_text(self%real_value)
      case (kind_integer)
         text = to_text(self%integer_value)
      case (kind_logical)
         text = to_text(self%logical_value)
      case (kind_word)
         text = quoted(trim(self%word_value))
      case default
         text = quoted(self%text_value%text())
      end select
   end function value_text

   !> What kind of value the key takes, in words, with its range
   pure function type_text(self) result(text)
      class(key_t), intent(in) :: self
      character(len=:), allocatable :: text
      character(len=allowed_length), allocatable :: words(:)
      integer :: k

      select case (self%kind)
      case (kind_real, kind_integer)
         text = "a number"
         if (self%kind == kind_integer) text = "a whole number"
         if (self%unit /= "-") text = text // " (unit " // trim(self%unit) // ", not written)"
         text = text // " in " // trim(self%allowed)
      case (kind_logical)
         text = ".true. or .false."
      case (kind_word)
         words = choices(self%allowed)
         text = ""
         do k = 1, size(words) - 1
            text = text // quoted(trim(words(k))) // ", "
         end do
         text = text // "or " // quoted(trim(words(size(words))))
      case (kind_path)
         text = "a file name between quotes"
      case default
         text = "a text between quotes"
      end select
   end function type_text

   !> '; 9.525 mm is 9.525e-3' for the number of a radius that will be in mm; else empty
   pure function in_millimetres(self, number) result(text)
      class(key_t), intent(in) :: self
      character(len=*), intent(in) :: number
      character(len=:), allocatable :: text
      real(dp) :: value
      integer :: stat

      text = ""
      if (index(self%name, "radius") /= 1 .or. self%unit /= "m" .or. scan(number, "eEdD") > 0) return
      read (number, *, iostat=stat) value
      if (stat == 0 .and. abs(value) >= 1.0_dp) text = "; " // number // " mm is " // number // "e-3"
   end function in_millimetres

   !> Words of a list 'this|that'
   pure function choices(allowed) result(list)
      character(len=*), intent(in) :: allowed
      character(len=allowed_length), allocatable :: list(:)
      integer :: start, bar

      allocate (list(0))
      start = 1
      do
         bar = index(allowed(start:) // "|", "|")
         list = [character(len=allowed_length) :: list, allowed(start:start + bar - 2)]
         start = start + bar
         if (start > len(allowed)) return
      end do
   end function choices

   !> Whether a number lies in the allowed interval: '[1, 5]', '(0, 5]', '0 or [1, 5]'
   pure logical function allows(self, value)
      class(key_t), intent(in) :: self
      real(dp), intent(in) :: value
      real(dp) :: low, high
      integer :: opening, comma, closing

      opening = scan(self%allowed, "[(")
      closing = scan(self%allowed, "])")
      comma = index(self%allowed, ",")
      read (self%allowed(opening + 1:comma - 1), *) low
      read (self%allowed(comma + 1:closing - 1), *) high
      allows = value >= low .and. value <= high
      if (self%allowed(opening:opening) == "(") allows = allows .and. value > low
      if (self%allowed(closing:closing) == ")") allows = allows .and. value < high
      if (index(self%allowed, "0 or ") == 1) allows = allows .or. .not. abs(value) > 0.0_dp
   end function allows

   !> Take the value of the same key of another case, and where that was given
   subroutine take(self, other)
      class(key_t), intent(inout) :: self
      type(key_t), intent(in) :: other

      select case (self%kind)
      case (kind_real)
         self%real_value = other%real_value
      case (kind_integer)
         self%integer_value = other%integer_value
      case (kind_logical)
         self%logical_value = other%logical_value
      case (kind_word)
         self%word_value = other%word_value
      case default
         self%text_value = other%text_value
      end select
      self%origin_t = other%origin_t
   end subroutine take
end module ehl_case_key

! SPDX-License-Identifier: BSD-3-Clause
!> The given keys of a case, and error messages that name a key
module ehl_case_source
   use ehl_case_ranges, only: allows, range_of
   use ehl_kinds, only: dp
   use ehl_namelist_pieces, only: piece_t
   use ehl_status, only: ehl_bad_input, status_t
   use ehl_text, only: newline, short, to_text
   implicit none (type, external)
   private
   public :: case_source_t

   type :: case_source_t
      !> Name of the text, for messages and for relative file names
      character(len=:), allocatable :: origin
      !> All given keys, each once
      type(piece_t), allocatable :: pieces(:)
   contains
      procedure :: find
      procedure :: given
      procedure :: by_option
      procedure :: derived
      procedure :: first_given
      procedure :: refuse
      procedure :: contradict
      procedure :: check_range
   end type case_source_t

contains

   !> Position of the piece of group.key; 0: the key was not given
   pure integer function find(self, name)
      class(case_source_t), intent(in) :: self
      character(len=*), intent(in) :: name

      do find = size(self%pieces), 1, -1
         if (self%pieces(find)%name() == name) return
      end do
   end function find

   !> Whether group.key was given
   pure logical function given(self, name)
      class(case_source_t), intent(in) :: self
      character(len=*), intent(in) :: name
      given = self%find(trim(name)) > 0
   end function given

   !> Whether group.key was given by an option
   pure logical function by_option(self, name)
      class(case_source_t), intent(in) :: self
      character(len=*), intent(in) :: name
      integer :: k

      k = self%find(trim(name))
      by_option = .false.
      if (k > 0) by_option = allocated(self%pieces(k)%option)
   end function by_option

   !> Whether the text of a resolved case has a value of group.key that pyehl derived: it is marked, or a list
   pure logical function derived(self, name)
      class(case_source_t), intent(in) :: self
      character(len=*), intent(in) :: name
      integer :: k

      k = self%find(trim(name))
      derived = .false.
      if (k > 0) derived = .not. allocated(self%pieces(k)%option) .and. (self%pieces(k)%marked .or. self%pieces(k)%values > 1)
   end function derived

   !> First given key of a group, or of some keys of it; '' if none is given
   pure function first_given(self, group, keys) result(name)
      class(case_source_t), intent(in) :: self
      character(len=*), intent(in) :: group
      character(len=*), intent(in), optional :: keys(:)
      character(len=:), allocatable :: name
      integer :: k

      name = ""
      do k = size(self%pieces), 1, -1
         if (self%pieces(k)%group /= group) cycle
         if (present(keys)) then
            if (all(self%pieces(k)%key /= keys)) cycle
         end if
         name = self%pieces(k)%name()
      end do
   end function first_given

   !> Refuse a case because of a key
   subroutine refuse(self, name, what, expected, status)
      class(case_source_t), intent(in) :: self
      !> group.key
      character(len=*), intent(in) :: name
      character(len=*), intent(in) :: what, expected
      type(status_t), intent(inout) :: status
      character(len=:), allocatable :: place
      integer :: k

      place = self%origin
      k = self%find(trim(name))
      if (k > 0) then
         place = place//":"//to_text(self%pieces(k)%line)
         if (allocated(self%pieces(k)%option)) place = self%pieces(k)%option
      end if
      call status%fail(ehl_bad_input, place//": error: "//what//newline//"expected: "//expected, trim(name))
   end subroutine refuse

   !> Refuse two keys that exclude each other, at the later one
   subroutine contradict(self, one, other, expected, status)
      class(case_source_t), intent(in) :: self
      !> group.key of both
      character(len=*), intent(in) :: one, other, expected
      type(status_t), intent(inout) :: status
      character(len=:), allocatable :: what

      if (self%find(trim(one)) < self%find(trim(other))) then
         what = trim(other)//" contradicts "//trim(one)
      else
         what = trim(one)//" contradicts "//trim(other)
      end if
      call self%refuse(what(:index(what, " ") - 1), what, expected, status)
   end subroutine contradict

   !> Refuse a derived value outside its range, at the key from which it follows
   subroutine check_range(self, name, value, source_key, from, status)
      class(case_source_t), intent(in) :: self
      !> group.key of the derived value and of its source
      character(len=*), intent(in) :: name, source_key
      real(dp), intent(in) :: value
      !> Text on the source
      character(len=*), intent(in) :: from
      type(status_t), intent(inout) :: status
      character(len=:), allocatable :: range
      integer :: dot

      dot = index(name, ".")
      range = range_of(name(:dot - 1), name(dot + 1:))
      if (.not. allows(range, value)) call self%refuse(source_key, name//" = "//short(value)//" follows from "//from, &
                                                       "a number in "//range, status)
   end subroutine check_range
end module ehl_case_source

! SPDX-License-Identifier: BSD-3-Clause
!> A table of keys, each bound to a place in a case: what reading, checking, writing and documenting walk; and messages about
!> values that each by itself is good, with the place of the key
module ehl_schema
   use ehl_case, only: path_length, text_case_t, word_length
   use ehl_case_key, only: key_t, kind_integer, kind_logical, kind_real, kind_word, name_length
   use ehl_files, only: absolute_path, folder_of
   use ehl_kinds, only: dp
   use ehl_source, only: source_t
   use ehl_status, only: ehl_bad_input, ehl_internal, status_t
   use ehl_text, only: newline, short, to_text
   implicit none (type, external)
   private
   public :: schema_t

   type :: schema_t
      type(key_t), allocatable :: keys(:)
      !> Group of the keys that are added next, and how many there are
      character(len=name_length) :: group = ""
      integer :: n = 0
      !> Where the values came from; the first is the case file
      type(source_t), allocatable :: sources(:)
   contains
      procedure :: find
      procedure :: given
      procedure :: first_given
      procedure :: refuse
      procedure :: contradict
      procedure :: check_range
      procedure :: find_file
      procedure :: group_names
      procedure :: names_of
      procedure :: reals
      procedure :: integers
      procedure :: logicals
      procedure :: words
      procedure :: texts
      procedure, private :: add
   end type schema_t

contains

   !> A key behind the others; places behind it are spare
   subroutine add(self, key)
      class(schema_t), intent(inout) :: self
      type(key_t), intent(in) :: key

      if (.not. allocated(self%keys)) allocate (self%keys(128))
      if (self%n == size(self%keys)) self%keys = [self%keys, self%keys]
      self%n = self%n + 1
      self%keys(self%n) = key
      self%keys(self%n)%group = self%group
   end subroutine add

   subroutine reals(self, name, value, unit, allowed, meaning)
      class(schema_t), intent(inout) :: self
      character(len=*), intent(in) :: name, unit, allowed, meaning
      real(dp), intent(inout), target :: value

      call self%add(key_t(name=name, kind=kind_real, unit=unit, allowed=allowed, meaning=meaning, real_value=value))
   end subroutine reals

   subroutine integers(self, name, value, allowed, meaning)
      class(schema_t), intent(inout) :: self
      character(len=*), intent(in) :: name, allowed, meaning
      integer, intent(inout), target :: value

      call self%add(key_t(name=name, kind=kind_integer, allowed=allowed, meaning=meaning, integer_value=value))
   end subroutine integers

   subroutine logicals(self, name, value, meaning)
      class(schema_t), intent(inout) :: self
      character(len=*), intent(in) :: name, meaning
      logical, intent(inout), target :: value

      call self%add(key_t(name=name, kind=kind_logical, allowed=".true.|.false.", meaning=meaning, logical_value=value))
   end subroutine logicals

   subroutine words(self, name, value, allowed, meaning)
      class(schema_t), intent(inout) :: self
      character(len=*), intent(in) :: name, allowed, meaning
      character(len=word_length), intent(inout), target :: value

      call self%add(key_t(name=name, kind=kind_word, allowed=allowed, meaning=meaning, word_value=value))
   end subroutine words

   subroutine texts(self, name, value, kind, meaning)
      class(schema_t), intent(inout) :: self
      character(len=*), intent(in) :: name, meaning
      integer, intent(in) :: kind
      type(text_case_t), intent(inout), target :: value

      call self%add(key_t(name=name, kind=kind, meaning=meaning, text_value=value))
   end subroutine texts

   !> Position of a key in the table; 0 when there is no such key
   pure integer function find(self, group, name)
      class(schema_t), intent(in) :: self
      character(len=*), intent(in) :: group, name

      do find = 1, size(self%keys)
         if (self%keys(find)%group == group .and. self%keys(find)%name == name) return
      end do
      find = 0
   end function find

   !> Whether the input gave a key
   pure logical function given(self, group, name)
      class(schema_t), intent(in) :: self
      character(len=*), intent(in) :: group, name
      integer :: k

      k = self%find(group, name)
      given = .false.
      if (k > 0) given = self%keys(k)%given
   end function given

   !> Names of all groups, in order
   pure function group_names(self) result(names)
      class(schema_t), intent(in) :: self
      character(len=name_length), allocatable :: names(:)
      integer :: k

      names = [self%keys(1)%group]
      do k = 2, size(self%keys)
         if (self%keys(k)%group /= names(size(names))) names = [names, self%keys(k)%group]
      end do
   end function group_names

   !> Names of the keys of a group, in order
   pure function names_of(self, group) result(names)
      class(schema_t), intent(in) :: self
      character(len=*), intent(in) :: group
      character(len=name_length), allocatable :: names(:)
      integer :: k

      names = pack(self%keys%name, [(self%keys(k)%group == group, k=1, size(self%keys))])
   end function names_of

   !> Position of a key that must be in the table; 0 and an internal error where it is not
   subroutine find_key(self, name, k, status)
      class(schema_t), intent(in) :: self
      !> group.name of the key
      character(len=*), intent(in) :: name
      integer, intent(out) :: k
      type(status_t), intent(inout) :: status

      k = position_of(self, name)
      if (k == 0) call status%fail(ehl_internal, "there is no key "//name)
   end subroutine find_key

   !> Refuse a case at the value of a key
   subroutine refuse(self, name, what, expected, status)
      class(schema_t), intent(in) :: self
      !> group.name of the key
      character(len=*), intent(in) :: name
      character(len=*), intent(in) :: what, expected
      type(status_t), intent(inout) :: status
      integer :: k

      call find_key(self, name, k, status)
      if (k == 0) return
      associate (key => self%keys(k))
         if (key%given) then
            call self%sources(key%source)%refuse(key%first, key%last, what, expected, status)
         else
            call status%fail(ehl_bad_input, self%sources(1)%name//": error: "//what//newline//"expected: "//expected)
         end if
      end associate
   end subroutine refuse

   !> Refuse two keys that exclude each other, at the one that stands later
   subroutine contradict(self, one, other, expected, status, why)
      class(schema_t), intent(in) :: self
      !> group.name of two keys that the input gave
      character(len=*), intent(in) :: one, other
      character(len=*), intent(in) :: expected
      type(status_t), intent(inout) :: status
      !> What contradicts, in values
      character(len=*), intent(in), optional :: why
      integer :: both(2)
      character(len=:), allocatable :: what

      call find_key(self, one, both(1), status)
      call find_key(self, other, both(2), status)
      if (any(both == 0)) return
      if (is_before(self, both(1), both(2))) both = both([2, 1])
      associate (key => self%keys(both(1)))
         what = key%full_name()//" contradicts "//self%keys(both(2))%full_name()
         if (present(why)) what = what//": "//why
         call self%sources(key%source)%refuse(key%name_first, key%name_last, what, expected, status)
      end associate
   end subroutine contradict

   !> Refuse a value of a key that nobody gave, and that its range does not allow, at the key that it follows from
   subroutine check_range(self, name, value, culprit, from, status)
      class(schema_t), intent(in) :: self
      !> group.name of both
      character(len=*), intent(in) :: name, culprit
      real(dp), intent(in) :: value
      !> What it follows from, in words
      character(len=*), intent(in) :: from
      type(status_t), intent(inout) :: status
      integer :: k

      call find_key(self, name, k, status)
      if (k == 0) return
      associate (key => self%keys(k))
         if (.not. key%allows(value)) call self%refuse(culprit, name//" = "//short(value)//" follows from "//from, &
                                                       key%type_text(), status)
      end associate
   end subroutine check_range

   !> Make the name of a file absolute; one in the case file starts at the folder of that file, one in an option at the
   !> working folder
   subroutine find_file(self, name, file, status)
      class(schema_t), intent(in) :: self
      !> group.name of its key
      character(len=*), intent(in) :: name
      type(text_case_t), intent(inout) :: file
      type(status_t), intent(inout) :: status
      character(len=:), allocatable :: path
      integer :: k

      call find_key(self, name, k, status)
      if (k == 0) return
      path = file%text()
      if (path(1:1) /= "/" .and. self%keys(k)%source == 1) path = folder_of(self%sources(1)%name)//path
      path = absolute_path(path)
      if (len(path) > path_length) then
         call self%refuse(name, name//": the full name is longer than "//to_text(path_length)//" characters", "a shorter path", &
                          status)
      else
         call file%set(path)
      end if
   end subroutine find_file

   !> Position of group.name
   pure integer function position_of(self, full_name)
      class(schema_t), intent(in) :: self
      character(len=*), intent(in) :: full_name
      integer :: dot

      dot = index(full_name, ".")
      position_of = self%find(full_name(:dot - 1), full_name(dot + 1:))
   end function position_of

   !> Of some keys the given one that stands first; 0 when none is given
   pure integer function first_given(self, group, names)
      class(schema_t), intent(in) :: self
      character(len=*), intent(in) :: group, names(:)
      integer :: k, position

      first_given = 0
      do k = 1, size(names)
         position = self%find(group, names(k))
         if (.not. self%keys(position)%given) cycle
         if (first_given == 0) first_given = position
         if (is_before(self, position, first_given)) first_given = position
      end do
   end function first_given

   !> Whether key a stands before key b: file before options, then by place
   pure logical function is_before(self, a, b)
      class(schema_t), intent(in) :: self
      integer, intent(in) :: a, b

      associate (p => self%keys(a), q => self%keys(b))
         is_before = p%source < q%source .or. (p%source == q%source .and. p%first < q%first)
      end associate
   end function is_before
end module ehl_schema

! SPDX-License-Identifier: BSD-3-Clause
!> A table of keys, each bound to a place in a case: what reading, checking, writing and documenting walk
module ehl_schema
   use ehl_case, only: path_length, word_length
   use ehl_case_key, only: key_t, kind_integer, kind_logical, kind_real, kind_word, name_length
   use ehl_kinds, only: dp
   implicit none (type, external)
   private
   public :: schema_t

   type :: schema_t
      type(key_t), allocatable :: keys(:)
      !> Group of the keys that are added next, and how many there are
      character(len=name_length) :: group = ""
      integer :: n = 0
   contains
      procedure :: find
      procedure :: given
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
      character(len=path_length), intent(inout), target :: value

      call self%add(key_t(name=name, kind=kind, meaning=meaning, path_value=value))
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

      given = self%keys(self%find(group, name))%given
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
end module ehl_schema

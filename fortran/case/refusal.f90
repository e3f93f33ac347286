! SPDX-License-Identifier: BSD-3-Clause
!> Messages about values that each by itself is good, with the place of the key
module ehl_refusal
   use ehl_kinds, only: dp
   use ehl_schema, only: schema_t
   use ehl_source, only: point_at, source_t
   use ehl_status, only: ehl_bad_input, status_t
   use ehl_text, only: fixed
   implicit none (type, external)
   private
   public :: refuse, contradict, first_given, is_before, short

contains

   !> Refuse a case at the value of a key
   subroutine refuse(schema, sources, group, name, what, expected, status)
      type(schema_t), intent(in) :: schema
      type(source_t), intent(in) :: sources(:)
      character(len=*), intent(in) :: group, name, what, expected
      type(status_t), intent(inout) :: status

      associate (key => schema%keys(schema%find(group, name)))
         if (key%given) then
            call status%fail(ehl_bad_input, point_at(sources(key%source), key%first, key%last, &
                                                     what, expected))
         else
            call status%fail(ehl_bad_input, sources(1)%name // ": error: " // what &
                             // new_line("a") // "expected: " // expected)
         end if
      end associate
   end subroutine refuse

   !> Refuse two keys that exclude each other, at the one that stands later
   subroutine contradict(schema, sources, one, other, expected, status, why)
      type(schema_t), intent(in) :: schema
      type(source_t), intent(in) :: sources(:)
      !> group.name of two keys that the input gave
      character(len=*), intent(in) :: one, other
      character(len=*), intent(in) :: expected
      type(status_t), intent(inout) :: status
      !> What contradicts, in values
      character(len=*), intent(in), optional :: why
      integer :: later, earlier, swap
      character(len=:), allocatable :: what

      later = position_of(schema, one)
      earlier = position_of(schema, other)
      if (is_before(schema, later, earlier)) then
         swap = later
         later = earlier
         earlier = swap
      end if
      associate (key => schema%keys(later))
         what = key%full_name() // " contradicts " // schema%keys(earlier)%full_name()
         if (present(why)) what = what // ": " // why
         call status%fail(ehl_bad_input, point_at(sources(key%source), key%name_first, key%name_last, what, expected))
      end associate
   end subroutine contradict

   !> Position of group.name
   pure integer function position_of(schema, full_name)
      type(schema_t), intent(in) :: schema
      character(len=*), intent(in) :: full_name
      integer :: dot

      dot = index(full_name, ".")
      position_of = schema%find(full_name(:dot - 1), full_name(dot + 1:))
   end function position_of

   !> Of some keys the given one that stands first; 0 when none is given
   integer function first_given(schema, group, names)
      type(schema_t), intent(in) :: schema
      character(len=*), intent(in) :: group, names(:)
      integer :: k, position

      first_given = 0
      do k = 1, size(names)
         position = schema%find(group, names(k))
         if (.not. schema%keys(position)%given) cycle
         if (first_given == 0) first_given = position
         if (is_before(schema, position, first_given)) first_given = position
      end do
   end function first_given

   !> Whether key a stands before key b: file before options, then by place
   pure logical function is_before(schema, a, b)
      type(schema_t), intent(in) :: schema
      integer, intent(in) :: a, b

      associate (p => schema%keys(a), q => schema%keys(b))
         is_before = p%source < q%source .or. (p%source == q%source .and. p%first < q%first)
      end associate
   end function is_before

   !> Four digits of a number, for messages
   function short(x) result(text)
      real(dp), intent(in) :: x
      character(len=:), allocatable :: text
      text = fixed(x, "es10.3")
   end function short
end module ehl_refusal

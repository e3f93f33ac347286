! SPDX-License-Identifier: BSD-3-Clause
!> A file of measured viscosities: comma-separated, a line of names with pressure_Pa, temperature_degC and viscosity_Pa_s in
!> any order among others, then a line for each state. Lines that are blank or begin with '#' are skipped.
module ehl_viscosity_file
   use ehl_heat, only: freezing
   use ehl_kinds, only: dp
   use ehl_source, only: source_t
   use ehl_status, only: ehl_bad_input, status_t
   use ehl_text, only: lower_case, newline, to_text
   use ehl_viscosity_table, only: isotherm_t, new_isotherm
   use ehl_whole_file, only: read_text
   implicit none (type, external)
   private
   public :: read_isotherms

   !> Largest file
   integer, parameter :: largest_file = 1000000
   character(len=16), parameter :: columns(3) = &
      [character(len=16) :: "pressure_Pa", "temperature_degC", "viscosity_Pa_s"]
   !> What is accepted of them
   real(dp), parameter :: least(3) = [0.0_dp, -100.0_dp, 1.0e-6_dp], greatest(3) = [1.0e11_dp, 500.0_dp, 1.0e15_dp]
   !> Highest pressure [Pa] that is as good as none: it changes the viscosity by some 2 %
   real(dp), parameter :: ambient = 1.0e6_dp
   character(len=*), parameter :: header = "a line with the names pressure_Pa, temperature_degC and viscosity_Pa_s"

   !> A state and the line that has it, by the place of its first character
   type :: state_t
      real(dp) :: values(3) = 0.0_dp
      integer :: first = 1, last = 1
   end type state_t

contains

   !> The isotherms of a file, by rising temperature; a fault is told with file and line
   subroutine read_isotherms(path, isotherms, status)
      character(len=*), intent(in) :: path
      type(isotherm_t), allocatable, intent(out) :: isotherms(:)
      type(status_t), intent(inout) :: status
      type(source_t) :: source
      type(state_t), allocatable :: states(:)
      character(len=:), allocatable :: text
      integer :: first, last

      allocate (isotherms(0))
      call read_text(path, largest_file, text, status)
      if (status%failed()) then
         status%code = ehl_bad_input
         status%message = status%message//newline//"expected: a file of measured viscosities, "//header
         return
      end if
      do first = 1, len(text)
         if (text(first:first) == achar(13)) text(first:first) = " "
      end do
      source = source_t(path, text//newline)
      call read_states(source, states, status)
      if (status%failed()) return
      call sort(states)
      first = 1
      do while (first <= size(states))
         last = first
         do while (last < size(states))
            if (states(last + 1)%values(2) > states(first)%values(2)) exit
            last = last + 1
         end do
         call check_isotherm(source, states(first:last), status)
         if (status%failed()) return
         isotherms = [isotherms, new_isotherm(states(first)%values(2) + freezing, states(first:last)%values(1), &
                                              states(first:last)%values(3))]
         first = last + 1
      end do
   end subroutine read_isotherms

   !> All lines behind the names
   subroutine read_states(source, states, status)
      type(source_t), intent(in) :: source
      type(state_t), allocatable, intent(out) :: states(:)
      type(status_t), intent(inout) :: status
      integer :: places(3), first, last, k
      type(state_t) :: state

      allocate (states(0))
      places = 0
      first = 1
      do while (first <= len(source%text) .and. .not. status%failed())
         last = first + index(source%text(first:), newline) - 2
         associate (line => source%text(first:last))
            if (verify(line, " "//achar(9)) > 0 .and. index(adjustl(line), "#") /= 1) then
               if (places(1) == 0) then
                  do k = 1, 3
                     places(k) = place_of(line, trim(columns(k)))
                  end do
                  if (any(places == 0)) call source%refuse(first, last, "no column "//trim(columns(findloc(places, 0, dim=1))), &
                                                           header, status)
               else
                  state = state_t(first=first, last=last)
                  do k = 1, 3
                     call read_value(source, first, last, places(k), k, state%values(k), status)
                  end do
                  states = [states, state]
               end if
            end if
         end associate
         first = last + 2
      end do
      if (.not. status%failed() .and. size(states) == 0) call status%fail(ehl_bad_input, source%name// &
         ": error: no measured viscosity"//newline//"expected: "//header//", and a line for each state behind it")
   end subroutine read_states

   !> Number of the field of a line that holds a name; 0: none
   pure integer function place_of(line, name)
      character(len=*), intent(in) :: line, name
      integer :: from, to

      place_of = 0
      from = 1
      do while (from <= len(line) + 1)
         to = from + index(line(from:)//",", ",") - 2
         place_of = place_of + 1
         if (lower_case(trim(adjustl(line(from:to)))) == lower_case(name)) return
         from = to + 2
      end do
      place_of = 0
   end function place_of

   !> One number of a line
   subroutine read_value(source, first, last, place, column, value, status)
      type(source_t), intent(in) :: source
      integer, intent(in) :: first, last, place, column
      real(dp), intent(out) :: value
      type(status_t), intent(inout) :: status
      character(len=:), allocatable :: field
      integer :: from, to, k, stat

      value = 0.0_dp
      from = first
      do k = 2, place
         from = from + index(source%text(from:last)//",", ",")
      end do
      to = min(last, from + index(source%text(from:last)//",", ",") - 2)
      field = ""
      if (from <= last) field = trim(adjustl(source%text(from:to)))
      stat = 1
      if (field /= "" .and. verify(field, "0123456789+-.eEdD") == 0) read (field, *, iostat=stat) value
      if (stat == 0) then
         if (value >= least(column) .and. value <= greatest(column)) return
      end if
      call source%refuse(min(from, last), max(min(from, last), to), trim(columns(column))//" = '"//field//"'", &
                         "a number in ["//to_text(least(column))//", "//to_text(greatest(column))//"]", status)
   end subroutine read_value

   !> By temperature, then by pressure
   pure subroutine sort(states)
      type(state_t), intent(inout) :: states(:)
      type(state_t) :: moved
      integer :: i, k

      do i = 2, size(states)
         moved = states(i)
         k = i - 1
         do while (k >= 1)
            if (.not. is_before(moved, states(k))) exit
            states(k + 1) = states(k)
            k = k - 1
         end do
         states(k + 1) = moved
      end do
   end subroutine sort

   pure logical function is_before(a, b)
      type(state_t), intent(in) :: a, b
      is_before = a%values(2) < b%values(2) .or. (.not. a%values(2) > b%values(2) .and. a%values(1) < b%values(1))
   end function is_before

   !> Two pressures or more, the first ambient, each once, and a viscosity that rises with them
   subroutine check_isotherm(source, states, status)
      type(source_t), intent(in) :: source
      type(state_t), intent(in) :: states(:)
      type(status_t), intent(inout) :: status
      integer :: k

      if (size(states) == 1) then
         call refuse(1, "a single pressure at "//to_text(states(1)%values(2))//" degC", "two pressures or more at each temperature")
      else if (states(1)%values(1) > ambient) then
         call refuse(1, "the lowest pressure at "//to_text(states(1)%values(2))//" degC", "a viscosity at ambient pressure, "// &
                     to_text(ambient)//" Pa or less, at each temperature")
      end if
      do k = 2, size(states)
         if (.not. states(k)%values(1) > states(k - 1)%values(1)) then
            call refuse(k, "the same state as before", "each pressure once at each temperature")
         else if (.not. states(k)%values(3) > states(k - 1)%values(3)) then
            call refuse(k, "the viscosity does not rise from "//to_text(states(k - 1)%values(1))//" Pa, where it is "// &
                        to_text(states(k - 1)%values(3))//" Pa s", "a viscosity that rises with pressure at each temperature")
         end if
      end do

   contains

      subroutine refuse(number, what, expected)
         integer, intent(in) :: number
         character(len=*), intent(in) :: what, expected
         call source%refuse(states(number)%first, states(number)%last, what, expected, status)
      end subroutine refuse
   end subroutine check_isotherm
end module ehl_viscosity_file

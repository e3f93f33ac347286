! SPDX-License-Identifier: BSD-3-Clause
!> Command line of the program
module ehl_arguments
   use ehl_status, only: ehl_bad_input, status_t
   use ehl_text, only: nearest_word, newline
   implicit none (type, external)
   private
   public :: arguments_t, get_arguments, help_text

   !> Arguments of the command line
   type :: arguments_t
      !> Case file and result folder
      character(len=:), allocatable :: case_file, folder
      !> Result folder of the run to resume; empty: none
      character(len=:), allocatable :: resume
      !> Options '--set group.key=value', one per line
      character(len=:), allocatable :: options
      !> Whether the result folder may hold other files
      logical :: force = .false.
      logical :: quiet = .false., version = .false., help = .false.
   end type arguments_t

   character(len=*), parameter :: switches(*) = [character(len=12) :: &
      "-o", "--output", "--set", "--resume", "--force", "--quiet", "--version", "--help"]

contains

   !> Read the command line
   subroutine get_arguments(arguments, status)
      type(arguments_t), intent(out) :: arguments
      type(status_t), intent(inout) :: status
      character(len=:), allocatable :: word, value
      integer :: k

      arguments%case_file = ""
      arguments%folder = ""
      arguments%resume = ""
      arguments%options = ""
      k = 0
      do while (k < command_argument_count() .and. .not. status%failed())
         k = k + 1
         word = argument(k)
         select case (word)
         case ("-o", "--output")
            call next_argument(k, word, arguments%folder, status)
         case ("--set")
            call next_argument(k, word, value, status)
            if (index(value, newline) > 0) call refuse("--set: more than one line", status)
            arguments%options = arguments%options // "--set " // value // newline
         case ("--resume")
            call next_argument(k, word, arguments%resume, status)
            if (arguments%resume == "") call refuse("the folder after --resume has no name", status)
         case ("--force")
            arguments%force = .true.
         case ("-q", "--quiet")
            arguments%quiet = .true.
         case ("--version")
            arguments%version = .true.
         case ("-h", "--help")
            arguments%help = .true.
         case default
            call take_other(word, arguments, status)
         end select
      end do
      if (status%failed()) return
      if (arguments%help .or. arguments%version) return
      if (arguments%resume /= "") then
         if (arguments%folder == "") arguments%folder = arguments%resume
      else if (arguments%case_file == "") then
         call refuse("no case file", status)
      else if (arguments%folder == "") then
         call refuse("no result folder: -o DIR is missing", status)
      end if
   end subroutine get_arguments

   !> Take the case file, or refuse an unknown option
   subroutine take_other(word, arguments, status)
      character(len=*), intent(in) :: word
      type(arguments_t), intent(inout) :: arguments
      type(status_t), intent(inout) :: status
      character(len=:), allocatable :: near

      if (index(word, "-") == 1 .and. len(word) > 1) then
         near = nearest_word(word, switches)
         if (near /= "") near = "; did you mean '" // near // "'?"
         call refuse("unknown option '" // word // "'" // near, status)
      else if (word == "") then
         call refuse("the name of the case file is empty", status)
      else if (arguments%case_file /= "") then
         call refuse("second case file '" // word // "'", status)
      else
         arguments%case_file = word
      end if
   end subroutine take_other

   !> Take the value of an option
   subroutine next_argument(k, option, value, status)
      integer, intent(inout) :: k
      character(len=*), intent(in) :: option
      character(len=:), allocatable, intent(out) :: value
      type(status_t), intent(inout) :: status

      k = k + 1
      value = ""
      if (k <= command_argument_count()) then
         value = argument(k)
      else
         call refuse("no value after " // option, status)
      end if
   end subroutine next_argument

   !> Argument number k
   function argument(k) result(text)
      integer, intent(in) :: k
      character(len=:), allocatable :: text
      integer :: length

      call get_command_argument(k, length=length)
      allocate (character(len=length) :: text)
      if (length > 0) call get_command_argument(k, text)
   end function argument

   subroutine refuse(what, status)
      character(len=*), intent(in) :: what
      type(status_t), intent(inout) :: status

      call status%fail(ehl_bad_input, "ehl: error: " // what // newline &
                       // "expected: ehl CASE.nml -o DIR [--set group.key=value ...]")
   end subroutine refuse

   !> Text of --help
   function help_text() result(text)
      character(len=:), allocatable :: text

      text = "Solve an elastohydrodynamically lubricated point or line contact." // newline // newline &
             // "  ehl CASE.nml -o DIR [--set group.key=value ...] [--force] [--quiet]" // newline &
             // "  ehl --resume DIR [CASE.nml] [-o DIR] [--set group.key=value ...] [--force] [--quiet]" // newline // newline &
             // "  CASE.nml   namelist file, keys as in cases/README.md; every key has a default. A case with a table, a" // &
             " data" // newline &
             // "             sheet or two bodies must be resolved first: 'pyehl check CASE.nml --resolved out.nml'" // newline &
             // "  -o DIR     folder for the results: new, empty, or of an earlier run" // newline &
             // "  --force    accept a folder with other files and keep them" // newline &
             // "  --set      replace a value of the case, any number of times" // newline &
             // "  --resume   resume the interrupted run in DIR; results are bitwise identical" // newline &
             // "  --quiet    print nothing but errors" // newline &
             // "  --version  print the version and how it was built" // newline // newline &
             // "Exit status: 0 converged, 1 not converged or failed, 2 bad input, 130 interrupted." &
             // newline
   end function help_text
end module ehl_arguments

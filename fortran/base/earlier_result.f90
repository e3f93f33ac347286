! SPDX-License-Identifier: BSD-3-Clause
!> The result that a folder already contains: its kind, its files, and the files derived from it
module ehl_earlier_result
   use ehl_folders, only: name_t
   use ehl_status, only: status_t
   use ehl_text, only: newline
   use ehl_whole_file, only: holds_text, read_text
   implicit none (type, external)
   private
   public :: found_t, read_result, is_replaceable, command_of, summary

   !> Contents of a folder
   type :: found_t
      !> Absolute path without links
      character(len=:), allocatable :: path
      !> Kind of the result in it; empty: none
      character(len=:), allocatable :: kind
      !> The files of that result, as JSON; all entries of the folder
      character(len=:), allocatable :: files
      type(name_t), allocatable :: entries(:)
      logical :: exists = .false.
      !> Whether it can be exchanged with a folder beside it
      logical :: movable = .true.
   end type found_t

   character(len=*), parameter :: summary = "summary.json"
   !> Marks in pictures, exports and reports, and endings of their names
   character(len=*), parameter :: marks(*) = [character(len=40) :: "pyehl plot: replaced when made again", &
                                              "pyehl export: replaced when made again", &
                                              "pyehl report: replaced when made again"]
   character(len=*), parameter :: endings(*) = [character(len=5) :: ".png", ".pdf", ".svg", ".gif", ".mp4", ".nc", ".html"]
   !> Maximum size of a summary [bytes]
   integer, parameter :: longest = 16*1024**2

contains

   !> Read kind and files of the result in a folder from its summary
   subroutine read_result(found)
      type(found_t), intent(inout) :: found
      character(len=:), allocatable :: text
      type(status_t) :: reading

      call read_text(found%path//"/"//summary, longest, text, reading)
      if (reading%failed()) return
      found%files = between(text, newline//'  "files": [', "]")
      if (index(found%files, '"'//summary//'"') > 0) found%kind = between(text, newline//'  "kind": "', '"')
   end subroutine read_result

   !> The part of a text between two other texts; empty if they are not found
   pure function between(text, before, after) result(part)
      character(len=*), intent(in) :: text, before, after
      character(len=:), allocatable :: part
      integer :: first

      part = ""
      first = index(text, before)
      if (first == 0) return
      part = text(first + len(before):)
      part = part(:max(0, index(part, after) - 1))
   end function between

   !> Whether a file may be replaced with the result: it is one of its files, or derived from it
   logical function is_replaceable(found, name, folder)
      type(found_t), intent(in) :: found
      character(len=*), intent(in) :: name
      !> Folder that contains the file
      character(len=*), intent(in) :: folder
      integer :: k, point

      is_replaceable = index(found%files, '"'//name//'"') > 0 .and. index(name, '"') == 0
      point = index(name, ".", back=.true.)
      if (is_replaceable .or. found%kind == "" .or. point == 0) return
      if (.not. any(endings == name(point:))) return
      do k = 1, size(marks)
         if (holds_text(folder//"/"//name, trim(marks(k)))) is_replaceable = .true.
      end do
   end function is_replaceable

   !> The command that produces results of a kind
   pure function command_of(kind) result(command)
      character(len=*), intent(in) :: kind
      character(len=:), allocatable :: command

      select case (kind)
      case ("solution")
         command = "pyehl run"
      case ("prediction")
         command = "pyehl predict"
      case default
         command = "pyehl "//kind
      end select
   end function command_of
end module ehl_earlier_result

! SPDX-License-Identifier: BSD-3-Clause
!> The result that is in a folder already: its kind, its files, and what was made of it
module ehl_earlier_result
   use ehl_folders, only: name_t
   use ehl_status, only: status_t
   use ehl_text, only: newline
   use ehl_whole_file, only: holds_text, read_text
   implicit none (type, external)
   private
   public :: found_t, read_result, gives_way, command_of, summary

   !> What is in a folder
   type :: found_t
      !> From the root, without links
      character(len=:), allocatable :: path
      !> Kind of the result that is there; empty: none
      character(len=:), allocatable :: kind
      !> The files of that result, as JSON; all that is there
      character(len=:), allocatable :: files
      type(name_t), allocatable :: entries(:)
      logical :: exists = .false.
      !> Whether a folder beside it can take its place
      logical :: movable = .true.
   end type found_t

   character(len=*), parameter :: summary = "summary.json"
   !> What pictures, exports and reports name themselves, and how their names end
   character(len=*), parameter :: marks(*) = [character(len=40) :: "pyehl plot: replaced when made again", &
                                              "pyehl export: replaced when made again", &
                                              "pyehl report: replaced when made again"]
   character(len=*), parameter :: endings(*) = [character(len=5) :: ".png", ".pdf", ".svg", ".gif", ".mp4", ".nc", ".html"]
   !> Bytes of the longest summary
   integer, parameter :: longest = 16*1024**2

contains

   !> Kind and files of the result in a folder, by its summary
   subroutine read_result(found)
      type(found_t), intent(inout) :: found
      character(len=:), allocatable :: text
      type(status_t) :: reading

      call read_text(found%path//"/"//summary, longest, text, reading)
      if (reading%failed()) return
      found%files = between(text, newline//'  "files": [', "]")
      if (index(found%files, '"'//summary//'"') > 0) found%kind = between(text, newline//'  "kind": "', '"')
   end subroutine read_result

   !> The part of a text between two others; empty when they are not there
   pure function between(text, before, behind) result(part)
      character(len=*), intent(in) :: text, before, behind
      character(len=:), allocatable :: part
      integer :: first

      part = ""
      first = index(text, before)
      if (first == 0) return
      part = text(first + len(before):)
      part = part(:max(0, index(part, behind) - 1))
   end function between

   !> Whether a name in a folder is of the result there: one of its files, or made of it
   logical function gives_way(found, name, folder)
      type(found_t), intent(in) :: found
      character(len=*), intent(in) :: name
      !> Where the files are now
      character(len=*), intent(in) :: folder
      integer :: k, point

      gives_way = index(found%files, '"'//name//'"') > 0 .and. index(name, '"') == 0
      point = index(name, ".", back=.true.)
      if (gives_way .or. found%kind == "" .or. point == 0) return
      if (.not. any(endings == name(point:))) return
      do k = 1, size(marks)
         if (holds_text(folder//"/"//name, trim(marks(k)))) gives_way = .true.
      end do
   end function gives_way

   !> The command that makes results of a kind
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

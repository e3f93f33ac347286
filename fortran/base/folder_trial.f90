! SPDX-License-Identifier: BSD-3-Clause
!> Check before a computation whether the folders of its result can be made, by making and removing them
module ehl_folder_trial
   use ehl_files, only: file_exists, make_folder, remove_folder
   use ehl_folders, only: is_there, spare_path
   use ehl_status, only: ehl_bad_input, status_t
   use ehl_text, only: newline
   implicit none (type, external)
   private
   public :: try_folder, try_path

   character(len=*), parameter :: any_other = "expected: another folder"
   !> Maximum length of the path of a result, so that the names of its files fit
   integer, parameter :: longest = 3900

contains

   !> Refuse a folder if `fresh`, beside it or in it, cannot be made
   subroutine try_folder(folder, fresh, status)
      !> Folder as the user wrote it; path of its temporary folder
      character(len=*), intent(in) :: folder, fresh
      type(status_t), intent(inout) :: status

      if (tried(fresh)) return
      call status%fail(ehl_bad_input, folder//": error: "//fresh//" cannot be made, as the result needs it: the name is too "// &
                       "long, or the disk is full"//newline//any_other)
   end subroutine try_folder

   !> Refuse a missing folder that cannot be made: no permission in the existing part of its path, or names that are too long
   subroutine try_path(folder, path, more, status)
      !> Folder as the user wrote it; absolute path; suffix of its temporary name
      character(len=*), intent(in) :: folder, path, more
      type(status_t), intent(inout) :: status
      character(len=:), allocatable :: above, why
      integer :: first, last

      above = path
      do while (.not. is_there(above))
         above = above(:index(above, "/", back=.true.) - 1)
         if (above == "") exit
      end do
      why = ""
      if (.not. tried(spare_path(above//"/"//more))) then
         why = "no permission to write into "//above
         if (above == "") why = "no permission to write into /"
         if (above /= "") then
            if (.not. file_exists(above//"/.")) why = above//" is not a folder"
         end if
      end if
      first = len(above) + 2
      do while (why == "" .and. first <= len(path))
         last = first + index(path(first:)//"/", "/") - 2
         if (.not. tried(spare_path(above//"/"//path(first:last)//more))) why = "the name is too long"
         first = last + 2
      end do
      if (len(path) > longest) why = "the path is too long"
      if (why /= "") call status%fail(ehl_bad_input, folder//": error: cannot be made: "//why//newline//any_other)
   end subroutine try_path

   !> Whether a folder can be made; it is removed again
   logical function tried(path)
      character(len=*), intent(in) :: path
      tried = make_folder(path)
      if (tried) tried = remove_folder(path)
   end function tried
end module ehl_folder_trial

! SPDX-License-Identifier: BSD-3-Clause
!> The folder of a result: which folder is accepted, and how the result is put in place.
!>
!> A folder is accepted for a result of one kind if it is empty, or contains only an earlier result of this kind. A result
!> lists its kind and its files in summary.json. Pictures, exports and reports of it, which contain a mark, are removed with it
!> when it is replaced. Otherwise the folder is refused; with `force` other files are kept, if the result needs none of their names.
!>
!> The new result is written beside the folder and then exchanged with the earlier one, in one step if the file system supports
!> that: the folder then contains a complete result at any time.
module ehl_destination
   use, intrinsic :: iso_c_binding, only: c_ptr
   use ehl_earlier_result, only: command_of, found_t, is_replaceable, read_result, summary
   use ehl_files, only: absolute_path, file_exists, make_folder, may_write, real_path, remove_file, remove_folder, rename_path
   use ehl_folders, only: swap_paths, folder_above, full_path, is_here, is_movable, is_there, link_text, list_folder, &
                          lock_folder, make_link, make_parents, move_new, spare_path, unlock_folder, name_t
   use ehl_folder_lock, only: remove_stale_locks
   use ehl_folder_trial, only: try_folder, try_path
   use ehl_processes, only: remove_left_over
   use ehl_status, only: ehl_bad_input, ehl_file, status_t
   use ehl_text, only: newline
   implicit none (type, external)
   private
   public :: destination_t

   !> A folder for a result
   type :: destination_t
      !> Path as the user wrote it, and kind of the result
      character(len=:), allocatable :: folder, kind
      !> Lists with one item per line: names that the result may need, paths that the command reads, and other
      !> names that belong to this kind
      character(len=:), allocatable :: names, inputs, kept
      !> Whether the folder may contain other files
      logical :: force = .false.
   contains
      procedure :: check
      procedure :: begin
      procedure :: finish
   end type destination_t

   character(len=*), parameter :: any_other = "expected: another folder", &
      ! beginnings of the names of unfinished results; a killed command leaves them behind
      partial = ".partial", leftover = partial//"-"
   !> Number of names that are tried for a new folder
   integer, parameter :: tries = 3

contains

   !> Refuse a folder that must not be changed or cannot be written
   subroutine check(self, status, resumes)
      class(destination_t), intent(in) :: self
      type(status_t), intent(inout) :: status
      !> Whether an earlier result is kept and completed
      logical, intent(in), optional :: resumes
      type(found_t) :: found

      call inspect(self, found, status)
      if (.not. status%failed() .and. found%exists) call try_folder(self%folder, fresh_path(found), status)
      if (status%failed() .or. found%kind == "") return
      if (present(resumes)) then
         if (resumes) return
      end if
      if (is_here(found%path)) then
         call status%fail(ehl_bad_input, self%folder//": error: holds a result and is the working directory: it "// &
                          "cannot be replaced in one step"//newline//any_other)
      else if (.not. found%movable) then
         call status%fail(ehl_bad_input, self%folder//": error: holds a result and cannot be replaced in one step: "// &
                          "it is a mount point, or there is no permission to write into the folder above"// &
                          newline//any_other)
      end if
   end subroutine check

   !> Check the folder, and make an empty temporary folder for the files of the result
   subroutine begin(self, fresh, status)
      class(destination_t), intent(in) :: self
      character(len=:), allocatable, intent(out) :: fresh
      type(status_t), intent(inout) :: status
      type(found_t) :: found
      type(name_t), allocatable :: ended(:)
      integer :: k

      fresh = ""
      call self%check(status)
      if (.not. status%failed()) call inspect(self, found, status)
      if (status%failed()) return
      call make_parents(found%path)
      call remove_stale_locks(folder_above(found%path), ended)
      call remove_left_over(found%path, partial, self%names, is_of_result)
      do k = 1, size(ended)
         call remove_left_over(ended(k)%text, partial, self%names, is_of_result)
      end do
      do k = 1, tries
         fresh = fresh_path(found)
         ! a process with the same number on another machine may use the name
         if (make_folder(fresh)) return
      end do
      call status%fail(ehl_file, self%folder//": error: cannot be written")
   end subroutine begin

   !> Whether a name is in the list of the result's names. Not an internal procedure: as an argument it would need an executable
   !> stack.
   logical function is_of_result(name, list)
      character(len=*), intent(in) :: name, list
      is_of_result = listed(name, list) .or. name == summary
   end function is_of_result

   !> Path of the temporary folder for the files of the result
   function fresh_path(found) result(path)
      type(found_t), intent(in) :: found
      character(len=:), allocatable :: path

      path = spare_path(found%path//partial)
      if (.not. found%movable) path = spare_path(found%path//"/"//leftover(:len(leftover) - 1))
   end function fresh_path

   !> Check again, and put the files from a folder made by `begin` in place. After a failure they are still in that folder, or
   !> those that could not be moved.
   subroutine finish(self, fresh, status)
      class(destination_t), intent(in) :: self
      character(len=*), intent(in) :: fresh
      type(status_t), intent(inout) :: status
      type(found_t) :: found
      type(c_ptr) :: lock
      logical :: done

      lock = lock_folder(folder_above(fresh))
      call inspect(self, found, status)
      if (.not. status%failed()) then
         if (.not. found%exists) then
            done = move_new(fresh, found%path)
         else if (found%kind /= "") then
            done = replaced(found, fresh)
         else
            done = .false.
            ! the working directory cannot be exchanged
            if (.not. is_here(found%path)) done = rename_path(fresh, found%path)
            if (.not. done) done = filled(found%path, fresh)
         end if
         if (.not. done) call status%fail(ehl_file, self%folder//": error: cannot be replaced")
      end if
      call unlock_folder(lock)
      if (status%failed()) status%message = status%message//newline//"the new result is in "//fresh
   end subroutine finish

   !> Read the contents of the folder, and apply the rule above
   subroutine inspect(self, found, status)
      class(destination_t), intent(in) :: self
      type(found_t), intent(out) :: found
      type(status_t), intent(inout) :: status

      found%kind = ""
      found%files = ""
      allocate (found%entries(0))
      found%path = full_path(self%folder)
      found%exists = is_there(found%path)
      if (found%path == "") then
         call status%fail(ehl_bad_input, "-o '"//self%folder//"': error: this names no folder"//newline// &
                          "expected: the name of a folder for the results")
         return
      else if (.not. found%exists) then
         call try_path(self%folder, found%path, partial, status)
         return
      else if (.not. file_exists(found%path)) then
         call refuse("a link to nothing", any_other)
         return
      else if (.not. file_exists(found%path//"/.")) then
         call refuse("this is a file, not a folder", any_other)
         return
      end if
      if (.not. list_folder(found%path, found%entries)) then
         call refuse("no permission to read this folder", any_other)
      else if (.not. may_write(found%path)) then
         call refuse("no permission to write into this folder", any_other)
      else
         found%movable = is_movable(found%path)
         call read_result(found)
         call apply_rule()
      end if

   contains

      !> Apply the rule above to a folder that can be written
      subroutine apply_rule()
         logical :: replaceable, is_read
         integer :: k

         if (found%kind /= "" .and. found%kind /= self%kind) then
            call refuse("holds a result of "//command_of(found%kind), any_other)
            return
         end if
         do k = 1, size(found%entries)
            associate (name => found%entries(k)%text)
               replaceable = is_replaceable(found, name, found%path)
               is_read = is_input(self, found, name)
               if (replaceable .and. is_read) then
                  call refuse("'"//name//"' in it is read by this command", any_other)
               else if (.not. (replaceable .or. listed(name, self%kept) .or. index(name, leftover) == 1)) then
                  if (listed(name, self%names)) then
                     call refuse("holds '"//name//"', which "//command_of(self%kind)//" did not write, and "// &
                                 "the result needs this name", any_other)
                  else if (.not. self%force) then
                     call refuse("holds '"//name//"', which "//command_of(self%kind)//" did not write", &
                                 any_other//", or --force, which keeps '"//name//"' beside the result")
                  end if
               end if
            end associate
            if (status%failed()) return
         end do
      end subroutine apply_rule

      subroutine refuse(what, expected)
         character(len=*), intent(in) :: what, expected

         call status%fail(ehl_bad_input, self%folder//": error: "//what//newline//expected)
      end subroutine refuse
   end subroutine inspect

   !> Exchange the earlier result and the new one, and move the other files to the new one. A symbolic link represents each of them
   !> until it is moved.
   logical function replaced(found, fresh)
      type(found_t), intent(in) :: found
      character(len=*), intent(in) :: fresh
      character(len=:), allocatable :: back
      logical :: gone
      integer :: k

      back = "../"//fresh(index(fresh, "/", back=.true.) + 1:)//"/"
      do k = 1, size(found%entries)
         associate (name => found%entries(k)%text)
            replaced = removable(name, found%path)
            if (.not. replaced) then
               replaced = make_link(back//name, fresh//"/"//name)
               if (.not. replaced) return
            end if
         end associate
      end do
      replaced = swap_paths(fresh, found%path)
      if (.not. replaced) return
      ! what cannot be moved or removed now remains where its link points to
      do k = 1, size(found%entries)
         associate (name => found%entries(k)%text)
            gone = removable(name, fresh)
            ! another process may have moved it
            if (link_text(found%path//"/"//name) == back//name) then
               gone = swap_paths(fresh//"/"//name, found%path//"/"//name)
               if (gone) gone = link_text(fresh//"/"//name) == back//name
            end if
            if (gone) gone = remove_file(fresh//"/"//name)
         end associate
      end do
      gone = remove_folder(fresh)

   contains

      !> Whether a file in a folder belongs to the earlier result
      logical function removable(name, folder)
         character(len=*), intent(in) :: name, folder

         removable = .not. file_exists(folder//"/"//name//"/.")
         if (removable) removable = is_replaceable(found, name, folder)
      end function removable
   end function replaced

   !> Move the files of a result into a folder without a result, the summary last
   logical function filled(path, fresh)
      character(len=*), intent(in) :: path, fresh
      type(name_t), allocatable :: names(:)
      integer :: k

      filled = list_folder(fresh, names)
      do k = 1, size(names)
         if (is_there(path//"/"//names(k)%text)) filled = .false.
      end do
      if (.not. filled) return
      do k = 1, size(names)
         if (names(k)%text == summary) cycle
         filled = move_new(fresh//"/"//names(k)%text, path//"/"//names(k)%text)
         if (.not. filled) return
      end do
      filled = move_new(fresh//"/"//summary, path//"/"//summary)
      if (filled) filled = remove_folder(fresh)
   end function filled

   !> Whether the command reads a file of this name in the folder
   logical function is_input(self, found, name)
      class(destination_t), intent(in) :: self
      type(found_t), intent(in) :: found
      character(len=*), intent(in) :: name
      character(len=:), allocatable :: path
      integer :: first, last

      is_input = .false.
      first = 1
      do while (first <= len(self%inputs))
         last = first + index(self%inputs(first:), newline) - 1
         path = real_path(absolute_path(self%inputs(first:last - 1)))
         if (path == found%path//"/"//name) is_input = .true.
         first = last + 1
      end do
   end function is_input

   !> Whether a name is in a list with one name per line
   pure logical function listed(name, list)
      character(len=*), intent(in) :: name, list

      listed = index(newline//list, newline//name//newline) > 0
   end function listed
end module ehl_destination

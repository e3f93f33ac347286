! SPDX-License-Identifier: BSD-3-Clause
!> The folder DIR.checkpoint beside the results DIR, with the data to resume an interrupted transient run: the case, surfaces that
!> came from Python, and the last two states.
module ehl_checkpoint_folder
   use ehl_case, only: case_t
   use ehl_checkpoint, only: coarser, frame_file, state_files
   use ehl_clock, only: clock_t, start_clock
   use ehl_contact_run, only: contact_run_t
   use ehl_files, only: file_exists, make_folder, remove_file, remove_folder, rename_path
   use ehl_folder_lock, only: folder_lock_t
   use ehl_folders, only: full_path, is_there, list_folder, make_parents, move_new, name_t, spare_path
   use ehl_kinds, only: dp
   use ehl_processes, only: remove_left_over
   use ehl_npy, only: read_npy, write_npy
   use ehl_solver, only: solver_t
   use ehl_status, only: ehl_bad_input, ehl_file, status_t
   use ehl_text, only: newline
   use ehl_whole_file, only: holds_text, write_text
   implicit none (type, external)
   private
   public :: checkpoint_folder_t, find_checkpoint, checkpoint_path

   character(len=*), parameter :: suffix = ".checkpoint", case_file = "case.nml", surface_file = "surface.npy", &
      second_file = "second_surface.npy", &
      ! first line of the case, which identifies the folder
      mark = "! Case of a transient run whose states are beside it; removed with them"
   !> States of the run and of the run on the coarser grid; all files of the folder except frames
   character(len=*), parameter :: states(*) = [character(len=32) :: state_files, coarser//state_files], &
      files(*) = [character(len=32) :: states, surface_file, second_file, case_file]

   !> Writes the state at intervals
   type :: checkpoint_folder_t
      private
      !> Ends with '/'; not allocated: no states are saved
      character(len=:), allocatable :: folder
      real(dp) :: interval = 0.0_dp
      type(clock_t) :: since
      !> Lock of the folder of the results
      type(folder_lock_t) :: lock
   contains
      procedure :: open => open_folder
      procedure :: is_due
      generic :: save => save_run, save_solver
      procedure, private :: save_run, save_solver
      procedure :: close => close_folder
      procedure :: release
      procedure :: has_state
   end type checkpoint_folder_t

contains

   !> Checkpoint folder of a result folder; ends with '/'
   function checkpoint_path(results) result(folder)
      character(len=*), intent(in) :: results
      character(len=:), allocatable :: folder
      folder = full_path(results)//suffix//"/"
   end function checkpoint_path

   !> Find the data to resume the run with these results: its case file, and its surfaces [m] (of size 0 if the case has them)
   subroutine find_checkpoint(results, path, heights, second_heights, status)
      character(len=*), intent(in) :: results
      character(len=:), allocatable, intent(out) :: path
      real(dp), allocatable, intent(out) :: heights(:, :), second_heights(:, :)
      type(status_t), intent(inout) :: status
      character(len=:), allocatable :: folder, hint

      allocate (heights(0, 0), second_heights(0, 0))
      folder = checkpoint_path(results)
      path = folder//case_file
      if (.not. file_exists(path)) then
         hint = ""
         if (index(results, suffix) > 1) hint = ", without '"//suffix//"'"
         call status%fail(ehl_bad_input, "--resume "//results//": error: there is no "//path//newline// &
                          "expected: the result folder of a transient run that was stopped before its end"//hint)
         return
      end if
      if (file_exists(folder//surface_file)) call read_npy(folder//surface_file, heights, status)
      if (file_exists(folder//second_file)) call read_npy(folder//second_file, second_heights, status)
   end subroutine find_checkpoint

   !> Lock the folder of the results until `release`. For a transient run with checkpoints make its folder, and refuse one with
   !> other files. States of an earlier run are backed up under the name in the note, unless this run resumes from them.
   subroutine open_folder(self, results, input, solver, resumed, heights, second_heights, note, status)
      class(checkpoint_folder_t), intent(inout) :: self
      character(len=*), intent(in) :: results
      type(case_t), intent(in) :: input
      type(solver_t), intent(in) :: solver
      !> Result folder of the resumed run; empty: none
      character(len=*), intent(in) :: resumed
      !> Heights of both surfaces [m] that did not come from files; of size 0: none
      real(dp), intent(in) :: heights(:, :), second_heights(:, :)
      character(len=:), allocatable, intent(out) :: note
      type(status_t), intent(inout) :: status
      logical :: same
      character(len=:), allocatable :: place

      note = ""
      call self%lock%take(results, status)
      if (status%failed()) return
      if (.not. solver%run%plan%has_steps() .or. input%output%checkpoint_interval <= 0.0_dp) return
      place = checkpoint_path(results)
      call check_state_folder(place, status)
      if (status%failed()) return
      call remove_left_over(place(:len(place) - 1), ".partial", "", is_left_over)
      same = .false.
      if (resumed /= "") same = place == checkpoint_path(resumed)
      if (.not. same) then
         if (holds_state(place)) call back_up(place, note, status)
      end if
      if (status%failed()) return
      self%folder = place
      self%interval = input%output%checkpoint_interval
      self%since = start_clock()
      call make_parents(place(:len(place) - 1))
      ! the folder gets its name when its files are complete
      if (.not. is_there(place)) place = spare_path(place(:len(place) - 1)//".partial")//"/"
      if (.not. file_exists(place)) then
         if (.not. make_folder(place)) call status%fail(ehl_file, self%folder//": error: cannot make this folder")
      end if
      call put_heights(place//surface_file, heights, status)
      call put_heights(place//second_file, second_heights, status)
      if (.not. status%failed()) call write_text(place//case_file//".new", mark//newline//input%text, status)
      if (.not. status%failed()) call put(place//case_file, status)
      if (status%failed() .or. place == self%folder) return
      same = move_new(place(:len(place) - 1), self%folder(:len(self%folder) - 1))
      if (.not. same) call status%fail(ehl_file, self%folder//": error: cannot make this folder")
   end subroutine open_folder

   !> Whether the next save is due
   logical function is_due(self)
      class(checkpoint_folder_t), intent(in) :: self
      is_due = .false.
      if (allocated(self%folder)) is_due = self%since%seconds() >= self%interval
   end function is_due

   !> Save the state of a run
   subroutine save_run(self, run, status)
      class(checkpoint_folder_t), intent(inout) :: self
      type(contact_run_t), intent(inout) :: run
      type(status_t), intent(inout) :: status

      if (.not. allocated(self%folder)) return
      call run%save(self%folder, status)
      self%since = start_clock()
   end subroutine save_run

   !> Save the state of a solver, including that on the coarser grid
   subroutine save_solver(self, solver, status)
      class(checkpoint_folder_t), intent(inout) :: self
      type(solver_t), intent(inout) :: solver
      type(status_t), intent(inout) :: status

      if (.not. allocated(self%folder)) return
      call solver%save_state(self%folder, status)
      self%since = start_clock()
   end subroutine save_solver

   !> Whether the folder holds a state to resume from
   logical function has_state(self)
      class(checkpoint_folder_t), intent(in) :: self
      has_state = .false.
      if (allocated(self%folder)) has_state = holds_state(self%folder)
   end function has_state

   !> Remove the states of a converged run
   subroutine close_folder(self)
      class(checkpoint_folder_t), intent(inout) :: self

      if (.not. allocated(self%folder)) return
      call remove_files(self%folder)
      deallocate (self%folder)
   end subroutine close_folder

   !> Unlock the folder of the results
   subroutine release(self)
      class(checkpoint_folder_t), intent(inout) :: self
      call self%lock%release()
   end subroutine release

   !> Whether a folder holds a state
   logical function holds_state(folder)
      character(len=*), intent(in) :: folder
      integer :: k

      holds_state = .false.
      do k = 1, size(states)
         if (file_exists(folder//trim(states(k)))) holds_state = .true.
      end do
   end function holds_state

   !> Refuse an existing folder that holds other files than the state of a run
   subroutine check_state_folder(folder, status)
      character(len=*), intent(in) :: folder
      type(status_t), intent(inout) :: status
      type(name_t), allocatable :: names(:)
      logical :: whole
      integer :: k

      if (.not. is_there(folder(:len(folder) - 1))) return
      whole = list_folder(folder, names)
      if (whole .and. size(names) > 0) whole = holds_text(folder//case_file, mark)
      do k = 1, size(names)
         if (whole .and. is_state_file(names(k)%text)) cycle
         call status%fail(ehl_bad_input, folder(:len(folder) - 1)//": error: holds '"//names(k)%text// &
                          "', which does not belong to the state of a run"//newline// &
                          "expected: another folder for the results, or output.checkpoint_interval = 0")
         return
      end do
      if (.not. whole) call status%fail(ehl_bad_input, folder(:len(folder) - 1)// &
                                        ": error: cannot read this folder"//newline// &
                                        "expected: another folder for the results")
   end subroutine check_state_folder

   !> Whether a file belongs to a state, complete or partly written
   logical function is_state_file(name)
      character(len=*), intent(in) :: name
      integer :: last

      last = index(name//" ", ".new ") - 1
      if (last < 1) last = len(name)
      is_state_file = any(files == name(:last)) .or. index(name, frame_file) == 1
   end function is_state_file

   !> Whether a file left by a killed process belongs to a state
   logical function is_left_over(name, list)
      character(len=*), intent(in) :: name, list

      associate (unused => list)
      end associate
      is_left_over = is_state_file(name)
   end function is_left_over

   !> Rename the folder of an earlier run
   subroutine back_up(folder, note, status)
      character(len=*), intent(in) :: folder
      character(len=:), allocatable, intent(inout) :: note
      type(status_t), intent(inout) :: status
      character(len=:), allocatable :: backup

      backup = folder(:len(folder) - 1)//".previous"
      call check_state_folder(backup//"/", status)
      if (status%failed()) return
      call remove_files(backup//"/")
      if (rename_path(folder(:len(folder) - 1), backup)) then
         note = "the state of an earlier run is now in "//backup
      else
         call status%fail(ehl_file, backup//": error: cannot back up the state of an earlier run here")
      end if
   end subroutine back_up

   !> Write the heights of a surface, if any
   subroutine put_heights(path, heights, status)
      character(len=*), intent(in) :: path
      real(dp), intent(in) :: heights(:, :)
      type(status_t), intent(inout) :: status

      if (size(heights) == 0 .or. status%failed()) return
      call write_npy(path//".new", heights, status)
      if (.not. status%failed()) call put(path, status)
   end subroutine put_heights

   !> Give a complete file its name
   subroutine put(path, status)
      character(len=*), intent(in) :: path
      type(status_t), intent(inout) :: status
      if (.not. rename_path(path//".new", path)) call status%fail(ehl_file, path//": error: cannot write")
   end subroutine put

   !> Remove the files of a state from a folder, also partly written ones, and the folder if it is then empty
   subroutine remove_files(folder)
      character(len=*), intent(in) :: folder
      type(name_t), allocatable :: names(:)
      logical :: gone
      integer :: k

      gone = list_folder(folder, names)
      do k = 1, size(names)
         if (names(k)%text /= case_file .and. is_state_file(names(k)%text)) gone = remove_file(folder//names(k)%text)
      end do
      ! last, since a run can be resumed from a folder with this file
      gone = remove_file(folder//case_file)
      gone = remove_folder(folder(:len(folder) - 1))
   end subroutine remove_files
end module ehl_checkpoint_folder

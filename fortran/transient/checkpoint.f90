! SPDX-License-Identifier: BSD-3-Clause
!> The state of a transient run on disk, so that a run killed at any instant can go on from the last good one: two files
!> in turn, each whole or not there, with a version and a checksum, and beside them two files that only grow, with what
!> every step adds to the history and with the frames. A state says how much of these belongs to it.
module ehl_checkpoint
   use, intrinsic :: iso_fortran_env, only: int64
   use ehl_binary_file, only: binary_file_t
   use ehl_checkpoint_layout, only: family, head_t, magic, pass_body, pass_frame, pass_head, pass_row
   use ehl_file_extent, only: begins_with, file_bytes, is_sealed
   use ehl_files, only: file_exists, remove_file, rename_path
   use ehl_frames, only: frames_t
   use ehl_grid, only: grid_t
   use ehl_kinds, only: dp
   use ehl_status, only: ehl_bad_input, ehl_file, status_t
   use ehl_table, only: table_t
   use ehl_text, only: newline, to_text
   use ehl_transient, only: transient_t
   implicit none (type, external)
   private
   public :: checkpoint_t, coarser, series_files, state_files

   !> The files of a run; behind a prefix those of the run on the coarser grid
   character(len=*), parameter :: state_files(2) = ["checkpoint.a", "checkpoint.b"], &
      series_files(2) = ["checkpoint.rows  ", "checkpoint.frames"], coarser = "coarser-"
   !> What a file can be; otherwise the step of its state
   integer, parameter :: missing = -1, damaged = -2, other_version = -3

   type :: checkpoint_t
      private
      !> Folder with its '/', and what the names begin with; empty: nothing is known of any files
      character(len=:), allocatable :: prefix
      !> What the two states are
      integer :: states(2) = missing
      !> Steps, frames and bytes that are in the growing files
      type(head_t) :: head
      !> Whether there is a state to go on from
      logical :: waiting = .false.
   contains
      procedure :: write => write_state
      procedure :: find => find_state
      procedure :: found
      procedure :: newest
      procedure :: read => read_state
   end type checkpoint_t

contains

   !> Write the state after a step, in place of the older one
   subroutine write_state(self, prefix, text, transient, history, frames, grid, numbers, status)
      class(checkpoint_t), intent(inout) :: self
      !> Folder with its '/', and what the names begin with; the case that the state belongs to
      character(len=*), intent(in) :: prefix, text
      type(transient_t), intent(inout) :: transient
      type(table_t), intent(inout) :: history
      type(frames_t), intent(inout) :: frames
      type(grid_t), intent(in) :: grid
      !> Seconds spent on the steps, mean friction ratio of the coarser run, how that run ended
      real(dp), intent(in) :: numbers(3)
      type(status_t), intent(inout) :: status
      type(binary_file_t) :: file
      character(len=:), allocatable :: path
      real(dp) :: kept(3)
      logical :: gone

      if (.not. allocated(self%prefix)) self%prefix = ""
      if (self%prefix /= prefix) then
         self%prefix = prefix
         self%states = missing
         self%head = head_t()
      end if
      ! a state that is there already must not take the place of the one before it
      if (maxval(self%states) == transient%step) return
      call append_series(self, transient, history, frames, grid, status)
      if (status%failed()) return
      self%head%text = text
      path = prefix//state_files(minloc(self%states, dim=1))
      kept = numbers
      call file%create(path//".new")
      call pass_head(file, self%head)
      call pass_body(file, transient, kept)
      call file%seal()
      call file%close(status)
      if (.not. status%failed()) then
         if (rename_path(path//".new", path)) then
            self%states(minloc(self%states, dim=1)) = transient%step
            return
         end if
         call status%fail(ehl_file, path//": error: cannot write: it cannot be renamed")
      end if
      gone = remove_file(path//".new")
   end subroutine write_state

   !> Append to the growing files what has come since the last state
   subroutine append_series(self, transient, history, frames, grid, status)
      class(checkpoint_t), intent(inout) :: self
      type(transient_t), intent(inout) :: transient
      type(table_t), intent(inout) :: history
      type(frames_t), intent(inout) :: frames
      type(grid_t), intent(in) :: grid
      type(status_t), intent(inout) :: status
      type(binary_file_t) :: file
      character(len=:), allocatable :: rows, pictures
      integer(int64) :: there(2)
      integer :: k

      rows = self%prefix//trim(series_files(1))
      pictures = self%prefix//trim(series_files(2))
      associate (head => self%head)
         ! where somebody has taken them away they begin again
         there = [file_bytes(rows), file_bytes(pictures)]
         if (any(there < [head%rows%bytes, head%pictures%bytes])) head = head_t()
         call file%append(rows, head%rows)
         do k = head%step + 1, transient%step
            call pass_row(file, k, history, transient)
         end do
         call file%close(status)
         if (status%failed()) return
         head%step = transient%step
         head%rows = file%extent
         if (frames%n == head%frames) return
         call file%append(pictures, head%pictures)
         do k = head%frames + 1, frames%n
            call pass_frame(file, k, frames, grid, status)
         end do
         call file%close(status)
         if (status%failed()) return
         head%frames = frames%n
         head%pictures = file%extent
      end associate
   end subroutine append_series

   !> Look for the newest good state of a case. That there are files and none of them is good, or that the state belongs
   !> to another case, is an error.
   subroutine find_state(self, prefix, text, note, status)
      class(checkpoint_t), intent(inout) :: self
      character(len=*), intent(in) :: prefix, text
      !> What a person should know: the step, and whether a damaged file was passed over
      character(len=:), allocatable, intent(out) :: note
      type(status_t), intent(inout) :: status
      character(len=:), allocatable :: path
      integer :: k

      note = ""
      self%prefix = prefix
      do k = 1, 2
         self%states(k) = what_is(prefix, state_files(k))
      end do
      if (all(self%states == missing)) return
      path = self%newest()
      if (maxval(self%states) < 0) then
         if (any(self%states == other_version)) then
            call status%fail(ehl_bad_input, path//": error: this state was written by another version of the program"// &
                             newline//"expected: '"//magic//"'")
         else
            call status%fail(ehl_bad_input, path//": error: this state is damaged, and there is no other"//newline// &
                             "expected: a file that is whole")
         end if
         return
      end if
      call read_head(path, self%head, status)
      if (status%failed()) return
      if (self%head%text /= text) then
         call status%fail(ehl_bad_input, path//": error: this state belongs to another case"//newline// &
                          first_difference(self%head%text, text))
         return
      end if
      note = "going on after step "//to_text(self%head%step)//" with the state in "//path
      if (any(self%states == damaged)) note = note//"; "//state_files(minloc(self%states, dim=1))// &
                                              " is damaged and was passed over"
      self%waiting = .true.
   end subroutine find_state

   !> Whether there is a state to go on from
   pure logical function found(self)
      class(checkpoint_t), intent(in) :: self
      found = self%waiting
   end function found

   !> Path of the newest state
   function newest(self) result(path)
      class(checkpoint_t), intent(in) :: self
      character(len=:), allocatable :: path
      path = self%prefix//state_files(maxloc(self%states, dim=1))
   end function newest

   !> Read the state that was found into a run that has started
   subroutine read_state(self, transient, history, frames, grid, numbers, status)
      class(checkpoint_t), intent(inout) :: self
      type(transient_t), intent(inout) :: transient
      type(table_t), intent(inout) :: history
      type(frames_t), intent(inout) :: frames
      type(grid_t), intent(in) :: grid
      !> Seconds spent on the steps, mean friction ratio of the coarser run, how that run ended
      real(dp), intent(out) :: numbers(3)
      type(status_t), intent(inout) :: status
      type(binary_file_t) :: file
      integer :: k

      self%waiting = .false.
      numbers = 0.0_dp
      associate (head => self%head)
         call file%open(self%newest())
         call pass_head(file, head)
         call pass_body(file, transient, numbers)
         call file%seal()
         call file%close(status)
         if (status%failed()) return
         transient%step = head%step
         call file%open(self%prefix//trim(series_files(1)))
         do k = 1, head%step
            call pass_row(file, k, history, transient)
         end do
         call file%close(status)
         if (status%failed() .or. head%frames == 0) return
         call file%open(self%prefix//trim(series_files(2)))
         do k = 1, head%frames
            call pass_frame(file, k, frames, grid, status)
         end do
         call file%close(status)
      end associate
   end subroutine read_state

   !> Step of the state in a file if all of it is there as it was written, else what is wrong
   integer function what_is(prefix, name)
      character(len=*), intent(in) :: prefix, name
      type(head_t) :: head
      type(status_t) :: status

      what_is = missing
      if (.not. file_exists(prefix//name)) return
      what_is = damaged
      if (.not. is_sealed(prefix//name)) return
      call read_head(prefix//name, head, status)
      if (head%version /= magic .and. index(head%version, family) == 1) what_is = other_version
      if (status%failed()) return
      if (.not. begins_with(prefix//trim(series_files(1)), head%rows)) return
      if (begins_with(prefix//trim(series_files(2)), head%pictures)) what_is = head%step
   end function what_is

   !> What a state begins with
   subroutine read_head(path, head, status)
      character(len=*), intent(in) :: path
      type(head_t), intent(inout) :: head
      type(status_t), intent(inout) :: status
      type(binary_file_t) :: file

      call file%open(path)
      call pass_head(file, head)
      call file%close(status)
   end subroutine read_head

   !> Where two cases differ for the first time
   function first_difference(theirs, ours) result(text)
      character(len=*), intent(in) :: theirs, ours
      character(len=:), allocatable :: text
      integer :: start, i

      start = 1
      do i = 1, min(len(theirs), len(ours))
         if (theirs(i:i) /= ours(i:i)) exit
         if (ours(i:i) == newline) start = i + 1
      end do
      text = "expected: "//line(theirs)//newline//"found:    "//line(ours)

   contains

      !> The line that begins at `start`, without its comment
      function line(whole)
         character(len=*), intent(in) :: whole
         character(len=:), allocatable :: line
         line = whole(start:)
         line = line(:scan(line//newline, newline) - 1)
         line = trim(adjustl(line(:index(line//" ! ", " ! ") - 1)))
      end function line
   end function first_difference
end module ehl_checkpoint

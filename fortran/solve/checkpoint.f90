! SPDX-License-Identifier: BSD-3-Clause
!> The state of a transient run on disk, from which a run killed at any instant resumes: the newest state and the one before it,
!> each with a version and a checksum, and replaced by renaming so that it is complete or absent. Each frame is written once, into
!> its own file.
module ehl_checkpoint
   use ehl_duty_steps, only: state_size
   use ehl_files, only: file_exists, remove_file, rename_path
   use ehl_frames, only: frames_t
   use ehl_grid, only: grid_t
   use ehl_kinds, only: dp
   use ehl_outcome, only: outcome_running
   use ehl_checksummed_file, only: end_reading, end_checksummed, has_checksum, open_checksummed
   use ehl_status, only: ehl_bad_input, ehl_file, status_t
   use ehl_table, only: table_t
   use ehl_text, only: newline, to_text
   use ehl_transient_state, only: transient_t
   implicit none (type, external)
   private
   public :: checkpoint_t, coarser, coarser_t, frame_file, state_files

   !> File names of the newest state and of the one before it; prefix of the frames; prefix of the states of the run on the
   !> coarser grid
   character(len=*), parameter :: state_files(2) = ["checkpoint.a", "checkpoint.b"], frame_file = "checkpoint.frame-", &
      coarser = "coarser-"
   !> First bytes of a state: `family` and the version of the format
   character(len=*), parameter :: family = "ehl checkpoint v", magic = family//"17"
   !> Codes of a file without a valid state; otherwise its code is the step
   integer, parameter :: missing = -1, damaged = -2, other_version = -3

   !> Header of a state, after `magic`
   type :: head_t
      integer :: step = 0, frames = 0
      !> Text of the case
      character(len=:), allocatable :: text
   end type head_t

   !> Result of the same contact on the next coarser grid: its status (outcome_running: unfinished), the message of its error, and
   !> if it converged its friction ratio and load share
   type :: coarser_t
      integer :: outcome = outcome_running
      character(len=:), allocatable :: message
      real(dp) :: ratio = 0.0_dp, load_share = 0.0_dp
   end type coarser_t

   type :: checkpoint_t
      !> File of the state to resume from
      character(len=:), allocatable :: path
      !> Its header
      type(head_t), private :: head
      !> Folder with its '/' and prefix of the file names; empty: no files known
      character(len=:), allocatable, private :: prefix
      !> Step of the newest state, number of frames on disk
      integer, private :: newest = missing, frames = 0
   contains
      procedure :: write => write_state
      procedure :: find => find_state
      procedure :: found
      procedure :: read => read_state
      procedure :: end_resuming
      procedure :: forget
   end type checkpoint_t

contains

   !> Write the state after a step; the newest file so far becomes the older one
   subroutine write_state(self, prefix, text, transient, history, frames, seconds, coarse, fallback_reason, status)
      class(checkpoint_t), intent(inout) :: self
      !> Folder with its '/' and prefix of the file names; text of the case
      character(len=*), intent(in) :: prefix, text
      type(transient_t), intent(in) :: transient
      type(table_t), intent(in) :: history
      type(frames_t), intent(in) :: frames
      !> Seconds spent on the steps; result on the coarser grid; why the steps did not start from a prediction
      real(dp), intent(in) :: seconds
      type(coarser_t), intent(in) :: coarse
      character(len=:), allocatable, intent(in) :: fallback_reason
      type(status_t), intent(inout) :: status
      character(len=:), allocatable :: path, first, second
      character(len=256) :: reason
      logical :: done
      integer :: lun, stat, k

      if (.not. allocated(self%prefix)) self%prefix = ""
      if (self%prefix /= prefix) then
         self%prefix = prefix
         self%newest = missing
         self%frames = 0
      end if
      if (self%newest == transient%step) return
      do k = 1, frames%n
         call name_frame(prefix, k, path)
         done = file_exists(path)
         if (done .and. k <= self%frames) cycle
         call open_checksummed(path, "write", lun, status)
         if (status%failed()) return
         write (lun, iostat=stat, iomsg=reason) frames%times(k), frames%p(k)%values, frames%h(k)%values
         call end_checksummed(lun, path, stat, reason, status)
         if (status%failed()) return
      end do
      self%frames = frames%n
      path = prefix//state_files(1)
      call open_checksummed(path//".new", "write", lun, status)
      if (status%failed()) return
      first = ""
      second = ""
      if (allocated(coarse%message)) first = coarse%message
      if (allocated(fallback_reason)) second = fallback_reason
      ! the same order as in read_head and read_state
      associate (t => transient, mean => transient%mean)
         write (lun, iostat=stat, iomsg=reason) magic, t%step, frames%n, len(text), text, &
            t%skipped, t%time, t%time_step, t%residual, t%cycles, t%total_cycles, t%policy%coarsening, &
            t%policy%changed_at, t%h00_before, t%friction_smooth, t%mass_content, t%p_before, t%predictor%weights, &
            t%accuracy%mean_square, t%accuracy%sensitivity, t%accuracy%largest, t%film_checksum, t%extremes%found, mean%filled, &
            mean%lag, mean%transit, t%duty_steps%pack(), t%duty_error%films, t%duty_error%error, t%film_errors, &
            seconds, coarse%ratio, real(coarse%outcome, dp), coarse%load_share, &
            len(first), first, len(second), second, &
            (history%row(k), mean%values(k), mean%film(k), mean%roughness(k), k=1, t%step)
      end associate
      call end_checksummed(lun, path//".new", stat, reason, status)
      if (.not. status%failed()) then
         ! a damaged file must not replace the older state
         if (self%newest /= missing) done = rename_path(path, prefix//state_files(2))
         if (rename_path(path//".new", path)) then
            self%newest = transient%step
            return
         end if
         call status%fail(ehl_file, path//": error: cannot write: it cannot be renamed")
      end if
      done = remove_file(path//".new")
   end subroutine write_state

   !> Find the newest valid state of a case. It is an error if files exist but none is valid, or if the state belongs to another
   !> case.
   subroutine find_state(self, prefix, text, note, status)
      class(checkpoint_t), intent(inout) :: self
      character(len=*), intent(in) :: prefix, text
      !> Message for the user: the step, and whether a file that is damaged or of another version was skipped
      character(len=:), allocatable, intent(out) :: note
      type(status_t), intent(inout) :: status
      integer :: k, state

      note = ""
      do k = 1, 2
         state = state_code(prefix, state_files(k), self%head)
         if (k == 1) self%newest = state
         if (state >= 0) exit
      end do
      if (self%newest == missing .and. state == missing) return
      ! without an older state, report the fault of the newest one
      if (state == missing) then
         state = self%newest
         k = 1
      end if
      self%path = prefix//state_files(min(k, 2))
      if (state == other_version) then
         call status%fail(ehl_bad_input, self%path//": error: this state was written by another version of the program"// &
                          newline//"expected: '"//magic//"'")
      else if (state == damaged) then
         call status%fail(ehl_bad_input, self%path//": error: this state is damaged, and there is no other"//newline// &
                          "expected: an undamaged file")
      else if (self%head%text /= text) then
         call status%fail(ehl_bad_input, self%path//": error: this state belongs to another case"//newline// &
                          first_difference(self%head%text, text))
      end if
      if (status%failed()) return
      note = "resuming after step "//to_text(self%head%step)//" with the state in "//self%path
      if (self%newest == damaged) note = note//"; "//state_files(1)//" is damaged and was skipped"
      if (self%newest == other_version) note = note//"; "//state_files(1)//" of another version of the program was skipped"
      self%newest = max(self%newest, missing)
      self%prefix = prefix
      self%frames = self%head%frames
   end subroutine find_state

   !> Whether a state to resume from was found
   pure logical function found(self)
      class(checkpoint_t), intent(in) :: self
      found = allocated(self%path)
   end function found

   !> Read the found state into a run after its start
   subroutine read_state(self, transient, history, frames, grid, seconds, coarse, fallback_reason, status)
      class(checkpoint_t), intent(in) :: self
      type(transient_t), intent(inout) :: transient
      type(table_t), intent(inout) :: history
      type(frames_t), intent(inout) :: frames
      type(grid_t), intent(in) :: grid
      !> As in write_state
      real(dp), intent(out) :: seconds
      type(coarser_t), intent(out) :: coarse
      character(len=:), allocatable, intent(inout) :: fallback_reason
      type(status_t), intent(inout) :: status
      type(head_t) :: head
      real(dp) :: row(history%n_columns()), values(3), outcome, numbers(state_size)
      character(len=:), allocatable :: path
      character(len=256) :: reason
      integer :: lun, stat, k

      seconds = 0.0_dp
      outcome = 0.0_dp
      call open_checksummed(self%path, "read", lun, status)
      if (status%failed()) return
      call read_head(lun, head, stat)
      transient%step = head%step
      associate (t => transient)
         if (stat == 0) read (lun, iostat=stat, iomsg=reason) &
            t%skipped, t%time, t%time_step, t%residual, t%cycles, t%total_cycles, t%policy%coarsening, &
            t%policy%changed_at, t%h00_before, t%friction_smooth, t%mass_content, t%p_before, t%predictor%weights, &
            t%accuracy%mean_square, t%accuracy%sensitivity, t%accuracy%largest, t%film_checksum, t%extremes%found, t%mean%filled, &
            t%mean%lag, t%mean%transit, numbers, t%duty_error%films, t%duty_error%error, t%film_errors, seconds, &
            coarse%ratio, outcome, coarse%load_share
         if (stat == 0) call t%duty_steps%unpack(numbers)
         coarse%outcome = nint(outcome)
         if (stat == 0) call read_text(lun, coarse%message, stat)
         if (stat == 0) call read_text(lun, fallback_reason, stat)
         do k = 1, t%step
            if (stat == 0) read (lun, iostat=stat, iomsg=reason) row, values
            if (stat /= 0) exit
            call history%append(row, status)
            call t%mean%append(values(1), values(2), values(3), status)
            if (status%failed()) exit
         end do
      end associate
      call end_reading(lun, self%path, stat, reason, status)
      do k = 1, head%frames
         call name_frame(self%prefix, k, path)
         if (.not. status%failed()) call frames%add(grid, status)
         if (.not. status%failed()) call open_checksummed(path, "read", lun, status)
         if (status%failed()) return
         read (lun, iostat=stat, iomsg=reason) frames%times(k), frames%p(k)%values, frames%h(k)%values
         call end_reading(lun, path, stat, reason, status)
      end do
   end subroutine read_state

   !> Step of the state in a file if it is valid, otherwise the code of its fault
   integer function state_code(prefix, name, head)
      character(len=*), intent(in) :: prefix, name
      type(head_t), intent(out) :: head
      integer :: lun, stat, k
      type(status_t) :: status
      character(len=len(magic)) :: version
      character(len=:), allocatable :: path

      state_code = missing
      if (.not. file_exists(prefix//name)) return
      state_code = damaged
      call open_checksummed(prefix//name, "read", lun, status)
      if (status%failed()) return
      read (lun, iostat=stat) version
      if (stat == 0 .and. version /= magic .and. index(version, family) == 1) state_code = other_version
      close (lun)
      if (state_code == other_version) return
      ! before the header is read: the length of the text in a damaged file may have any value
      if (.not. has_checksum(prefix//name)) return
      call open_checksummed(prefix//name, "read", lun, status)
      if (status%failed()) return
      call read_head(lun, head, stat)
      close (lun)
      do k = 1, head%frames
         call name_frame(prefix, k, path)
         if (.not. has_checksum(path)) return
      end do
      if (stat == 0) state_code = head%step
   end function state_code

   !> Read the header of a state
   subroutine read_head(lun, head, stat)
      integer, intent(in) :: lun
      type(head_t), intent(out) :: head
      integer, intent(out) :: stat
      character(len=len(magic)) :: version
      integer :: length

      read (lun, iostat=stat) version, head%step, head%frames, length
      if (stat /= 0) return
      allocate (character(len=length) :: head%text)
      read (lun, iostat=stat) head%text
      if (stat /= 0) head%text = ""
   end subroutine read_head

   !> Read a text; an empty one leaves `text` unchanged
   subroutine read_text(lun, text, stat)
      integer, intent(in) :: lun
      character(len=:), allocatable, intent(inout) :: text
      integer, intent(out) :: stat
      integer :: length

      read (lun, iostat=stat) length
      if (stat /= 0 .or. length == 0) return
      if (allocated(text)) deallocate (text)
      allocate (character(len=length) :: text)
      read (lun, iostat=stat) text
      if (stat /= 0) text = ""
   end subroutine read_text

   !> After the run has resumed there is no state to resume from any more
   subroutine end_resuming(self)
      class(checkpoint_t), intent(inout) :: self
      if (allocated(self%path)) deallocate (self%path)
   end subroutine end_resuming

   !> The run starts from the beginning: delete earlier states and overwrite earlier frames
   subroutine forget(self)
      class(checkpoint_t), intent(inout) :: self
      logical :: gone
      integer :: k

      if (.not. allocated(self%prefix)) return
      do k = 1, size(state_files)
         gone = remove_file(self%prefix//state_files(k))
      end do
      self%newest = missing
      self%frames = 0
   end subroutine forget

   !> File of frame k
   pure subroutine name_frame(prefix, k, path)
      character(len=*), intent(in) :: prefix
      integer, intent(in) :: k
      character(len=:), allocatable, intent(out) :: path
      path = prefix//frame_file//to_text(k)
   end subroutine name_frame

   !> First line in which two cases differ
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

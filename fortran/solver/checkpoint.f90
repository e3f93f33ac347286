! SPDX-License-Identifier: BSD-3-Clause
!> The state of a transient run on disk: two files in turn, each whole or not there, with a version
!> and a checksum, so that a run killed at any instant can go on from the last good one
module ehl_checkpoint
   use, intrinsic :: iso_fortran_env, only: int32, int64, int8
   use ehl_checksum, only: crc32
   use ehl_files, only: check_written, file_exists, flush_file, remove_file, rename_path
   use ehl_frames, only: frames_t
   use ehl_kinds, only: dp
   use ehl_status, only: ehl_bad_input, ehl_file, status_t
   use ehl_table, only: table_t
   use ehl_text, only: newline, to_text
   use ehl_transient, only: transient_t
   implicit none (type, external)
   private
   public :: state_t, checkpoint_names, write_checkpoint, read_checkpoint

   !> Both have the same length; the version counts the layouts of the file
   character(len=*), parameter :: magic = "ehl checkpoint v7", family = magic(:len(magic) - 1)
   !> The two files of a run; behind a prefix those of the run on the coarser grid
   character(len=*), parameter :: checkpoint_names(2) = ["checkpoint.a", "checkpoint.b"]
   !> What a file can be; otherwise the step of its state
   integer, parameter :: missing = -1, damaged = -2, other_version = -3

   !> A state that was read
   type :: state_t
      !> What changes from step to step
      type(transient_t) :: march
      !> Rows of the history, (columns, rows)
      real(dp), allocatable :: rows(:, :)
      type(frames_t) :: frames
      !> Seconds spent on the steps, mean friction ratio of the coarser run
      real(dp) :: numbers(2) = 0.0_dp
      !> Where it comes from
      character(len=:), allocatable :: path
   end type state_t

contains

   !> Write the state after a step; the file that is written is the one with the older state
   subroutine write_checkpoint(prefix, text, march, history, frames, numbers, status)
      !> Folder with its '/', and what the names begin with; the case that the state belongs to
      character(len=*), intent(in) :: prefix, text
      type(transient_t), intent(in) :: march
      type(table_t), intent(in) :: history
      type(frames_t), intent(in) :: frames
      !> Seconds spent on the steps, mean friction ratio of the coarser run
      real(dp), intent(in) :: numbers(2)
      type(status_t), intent(inout) :: status
      character(len=:), allocatable :: path
      character(len=256) :: reason
      integer(int8), allocatable :: bytes(:)
      real(dp), allocatable :: rows(:, :)
      integer :: lun, stat, found(2)
      logical :: gone
      type(status_t) :: written

      found = [what_is(prefix//checkpoint_names(1)), what_is(prefix//checkpoint_names(2))]
      ! a state that is there already must not take the place of the one before it
      if (maxval(found) == march%step) return
      path = prefix//checkpoint_names(minloc(found, dim=1))
      rows = history%all_rows()
      reason = ""
      open (newunit=lun, file=path//".new", status="replace", action="write", access="stream", &
            form="unformatted", iostat=stat, iomsg=reason)
      if (stat == 0) then
         write (lun, iostat=stat, iomsg=reason) magic, march%step, len(text), text, &
            shape(march%mass_content), march%skipped, march%time, march%time_step, march%residual, march%cycles, &
            march%total_cycles, march%total_sweeps, march%policy%coarsening, march%policy%changed_at, &
            march%h00_before, march%friction_smooth, &
            numbers, march%mass_content, march%p_before, march%predictor%weights, &
            march%accuracy%rise, march%accuracy%sensitivity, march%accuracy%largest, march%film_mark, march%mean%n, &
            march%mean%values(:march%mean%n), march%mean%film(:march%mean%n), march%mean%roughness(:march%mean%n), &
            march%extremes%found, shape(rows), rows, shape(frames%p), frames%times, frames%p, frames%h
         if (stat == 0) then
            close (lun, iostat=stat, iomsg=reason)
         else
            close (lun)
         end if
      end if
      if (stat == 0) then
         call read_bytes(path//".new", bytes, stat)
         reason = "it cannot be read back"
      end if
      if (stat == 0) open (newunit=lun, file=path//".new", status="old", action="write", access="stream", &
                           position="append", form="unformatted", iostat=stat, iomsg=reason)
      if (stat == 0) write (lun, iostat=stat, iomsg=reason) crc32(bytes)
      if (stat == 0) close (lun, iostat=stat, iomsg=reason)
      if (stat == 0) then
         call check_written(path//".new", size(bytes, kind=int64) + 4, written)
         if (written%failed()) stat = 1
         reason = "the disk is full"
      end if
      if (stat == 0) then
         reason = "it does not get onto the disk"
         if (flush_file(path//".new")) then
            if (rename_path(path//".new", path)) return
            reason = "it cannot be renamed"
         end if
      end if
      gone = remove_file(path//".new")
      call status%fail(ehl_file, path//": error: cannot write the state of the run: "//trim(reason))
   end subroutine write_checkpoint

   !> Read the newest good state of a case. Without any file `state` is not allocated; when there are files
   !> and none of them is good, or the state belongs to another case, that is an error.
   subroutine read_checkpoint(prefix, text, state, note, status)
      character(len=*), intent(in) :: prefix, text
      type(state_t), allocatable, intent(out) :: state
      !> What a person should know: the step, and whether a damaged file was passed over
      character(len=:), allocatable, intent(out) :: note
      type(status_t), intent(inout) :: status
      integer :: found(2), k

      note = ""
      found = [what_is(prefix//checkpoint_names(1)), what_is(prefix//checkpoint_names(2))]
      if (all(found == missing)) return
      k = maxloc(found, dim=1)
      if (found(k) < 0) then
         if (any(found == other_version)) then
            call status%fail(ehl_bad_input, prefix//checkpoint_names(k)//": error: this state was written by "// &
                             "another version of the program"//newline//"expected: '"//magic//"'")
         else
            call status%fail(ehl_bad_input, prefix//checkpoint_names(k)//": error: this state is damaged, "// &
                             "and there is no other"//newline//"expected: a file that is whole")
         end if
         return
      end if
      allocate (state)
      state%path = prefix//checkpoint_names(k)
      call read_state(state, text, status)
      if (status%failed()) return
      note = "going on after step "//to_text(state%march%step)//" with the state in "//state%path
      if (any(found == damaged)) note = note//"; "//checkpoint_names(3 - k)//" is damaged and was passed over"
   end subroutine read_checkpoint

   !> The state in a file that is whole
   subroutine read_state(state, text, status)
      type(state_t), intent(inout) :: state
      character(len=*), intent(in) :: text
      type(status_t), intent(inout) :: status
      character(len=:), allocatable :: their_text
      character(len=len(magic)) :: their_magic
      character(len=256) :: reason
      integer :: lun, stat, length, dims(3), shape_rows(2), n

      reason = ""
      open (newunit=lun, file=state%path, status="old", action="read", access="stream", form="unformatted", &
            iostat=stat, iomsg=reason)
      if (stat /= 0) then
         call status%fail(ehl_file, state%path//": error: cannot open: "//trim(reason))
         return
      end if
      associate (march => state%march)
         read (lun, iostat=stat, iomsg=reason) their_magic, march%step, length
         if (stat == 0) then
            allocate (character(len=length) :: their_text)
            read (lun, iostat=stat, iomsg=reason) their_text, dims
         end if
         if (stat == 0 .and. their_text /= text) then
            close (lun)
            call status%fail(ehl_bad_input, state%path//": error: this state belongs to another case"//newline// &
                             first_difference(their_text, text))
            return
         end if
         if (stat == 0) then
            allocate (march%mass_content(dims(1), dims(2), dims(3)), march%p_before(dims(1), dims(2), dims(3) + 1))
            call march%predictor%allocate_weights(dims(1), dims(2), status)
            if (status%failed()) then
               close (lun)
               return
            end if
            read (lun, iostat=stat, iomsg=reason) march%skipped, march%time, march%time_step, march%residual, march%cycles, &
               march%total_cycles, march%total_sweeps, march%policy%coarsening, march%policy%changed_at, &
               march%h00_before, march%friction_smooth, state%numbers, march%mass_content, march%p_before, &
               march%predictor%weights, march%accuracy%rise, march%accuracy%sensitivity, march%accuracy%largest, march%film_mark, n
         end if
         if (stat == 0) then
            march%mean%n = n
            allocate (march%mean%values(n), march%mean%film(n), march%mean%roughness(n))
            read (lun, iostat=stat, iomsg=reason) march%mean%values, march%mean%film, march%mean%roughness, &
               march%extremes%found, shape_rows
         end if
      end associate
      if (stat == 0) then
         allocate (state%rows(shape_rows(1), shape_rows(2)))
         read (lun, iostat=stat, iomsg=reason) state%rows, dims
      end if
      associate (frames => state%frames)
         if (stat == 0) then
            allocate (frames%times(dims(3)), frames%p(dims(1), dims(2), dims(3)), frames%h(dims(1), dims(2), dims(3)))
            read (lun, iostat=stat, iomsg=reason) frames%times, frames%p, frames%h
         end if
      end associate
      close (lun)
      if (stat /= 0) call status%fail(ehl_file, state%path//": error: cannot read the state of the run: "//trim(reason))
   end subroutine read_state

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

   !> Step of the state in a file whose checksum is right, else what is wrong with the file
   integer function what_is(path)
      character(len=*), intent(in) :: path
      integer(int8), allocatable :: bytes(:)
      integer(int64) :: n
      integer :: stat

      what_is = missing
      if (.not. file_exists(path)) return
      what_is = damaged
      call read_bytes(path, bytes, stat)
      n = size(bytes, kind=int64) - 4
      if (stat /= 0 .or. n < len(magic) + 4) return
      if (transfer(bytes(n + 1:n + 4), 0_int32) /= crc32(bytes(:n))) return
      if (transfer(bytes(:len(magic)), magic) == magic) then
         what_is = transfer(bytes(len(magic) + 1:len(magic) + 4), 0)
      else if (transfer(bytes(:len(family)), family) == family) then
         what_is = other_version
      end if
   end function what_is

   !> All bytes of a file
   subroutine read_bytes(path, bytes, stat)
      character(len=*), intent(in) :: path
      integer(int8), allocatable, intent(out) :: bytes(:)
      integer, intent(out) :: stat
      integer(int64) :: n
      integer :: lun

      open (newunit=lun, file=path, status="old", action="read", access="stream", form="unformatted", iostat=stat)
      if (stat /= 0) then
         allocate (bytes(0))
         return
      end if
      inquire (unit=lun, size=n)
      allocate (bytes(max(n, 0_int64)))
      read (lun, iostat=stat) bytes
      if (stat /= 0) deallocate (bytes)
      if (stat /= 0) allocate (bytes(0))
      close (lun)
   end subroutine read_bytes
end module ehl_checkpoint

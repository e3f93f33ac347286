! SPDX-License-Identifier: BSD-3-Clause
!> The state of a march in time on disk: two files in turn, each whole or not there, with a version
!> and a checksum, so that a run killed at any instant can go on from the last good one
module ehl_checkpoint
   use, intrinsic :: iso_fortran_env, only: int32, int64, int8
   use ehl_checksum, only: crc32
   use ehl_files, only: file_exists, remove_file, rename_path
   use ehl_kinds, only: dp
   use ehl_status, only: ehl_file, status_t
   use ehl_table, only: table_t
   use ehl_text, only: to_text
   use ehl_transient, only: transient_t
   implicit none (type, external)
   private
   public :: write_checkpoint, read_checkpoint, remove_checkpoints

   character(len=*), parameter :: magic = "ehl checkpoint v1"
   character(len=*), parameter :: names(2) = ["checkpoint.a", "checkpoint.b"]

contains

   !> Write the state after a step; the file that is written is the one with the older state
   subroutine write_checkpoint(folder, text, march, history, numbers, status)
      !> Folder, ending in '/', and the case that the state belongs to
      character(len=*), intent(in) :: folder, text
      type(transient_t), intent(in) :: march
      type(table_t), intent(in) :: history
      !> Seconds spent on the steps, mean friction ratio of the coarser run
      real(dp), intent(in) :: numbers(2)
      type(status_t), intent(inout) :: status
      character(len=:), allocatable :: path
      character(len=256) :: reason
      integer(int8), allocatable :: bytes(:)
      real(dp), allocatable :: rows(:, :)
      integer :: lun, stat

      path = folder//names(1 + older(folder))
      rows = history%all_rows()
      open (newunit=lun, file=path//".new", status="replace", action="write", access="stream", &
            form="unformatted", iostat=stat, iomsg=reason)
      if (stat == 0) write (lun, iostat=stat, iomsg=reason) magic, march%step, len(text), text, &
         shape(march%mass), march%skipped, march%time, march%time_step, march%residual, march%cycles, &
         march%total_cycles, march%h00_before, march%friction_smooth, numbers, march%mass, march%p_before, &
         march%mean%n, march%mean%values(:march%mean%n), march%mean%film(:march%mean%n), &
         march%mean%roughness(:march%mean%n), shape(rows), rows
      if (stat == 0) close (lun, iostat=stat, iomsg=reason)
      if (stat == 0) call read_bytes(path//".new", bytes, stat)
      if (stat == 0) open (newunit=lun, file=path//".new", status="old", action="write", access="stream", &
                           position="append", form="unformatted", iostat=stat, iomsg=reason)
      if (stat == 0) write (lun, iostat=stat, iomsg=reason) crc32(bytes)
      if (stat == 0) close (lun, iostat=stat, iomsg=reason)
      if (stat == 0) then
         if (.not. rename_path(path//".new", path)) stat = 1
      end if
      if (stat /= 0) call status%fail(ehl_file, path//": cannot write the checkpoint: "//trim(reason))
   end subroutine write_checkpoint

   !> Read the newest good state of a case into a march that has been started; `found` tells whether
   !> there was one. A checkpoint of another case is an error.
   subroutine read_checkpoint(folder, text, march, history, numbers, found, status)
      character(len=*), intent(in) :: folder, text
      type(transient_t), intent(inout) :: march
      type(table_t), intent(inout) :: history
      real(dp), intent(out) :: numbers(2)
      logical, intent(out) :: found
      type(status_t), intent(inout) :: status
      character(len=:), allocatable :: path, their_text
      character(len=len(magic)) :: their_magic
      real(dp), allocatable :: rows(:, :)
      integer :: lun, stat, length, step, dims(3), shape_rows(2), i

      numbers = 0.0_dp
      found = newest(folder) > 0
      if (.not. found) return
      path = folder//names(newest(folder))
      open (newunit=lun, file=path, status="old", action="read", access="stream", form="unformatted", iostat=stat)
      if (stat == 0) read (lun, iostat=stat) their_magic, step, length
      if (stat == 0) then
         allocate (character(len=length) :: their_text)
         read (lun, iostat=stat) their_text, dims
         if (stat == 0 .and. their_text /= text) then
            call status%fail(ehl_file, path//": this checkpoint belongs to another case; its keys differ from those given")
            close (lun)
            return
         end if
      end if
      if (stat == 0 .and. any(dims /= shape(march%mass))) stat = 1
      if (stat == 0) read (lun, iostat=stat) march%skipped, march%time, march%time_step, march%residual, march%cycles, &
         march%total_cycles, march%h00_before, march%friction_smooth, numbers, march%mass, march%p_before, march%mean%n
      if (stat == 0) then
         march%step = step
         call march%mean%reserve(march%mean%n)
         associate (n => march%mean%n)
            read (lun, iostat=stat) march%mean%values(:n), march%mean%film(:n), march%mean%roughness(:n), shape_rows
         end associate
      end if
      if (stat == 0) then
         allocate (rows(shape_rows(1), shape_rows(2)))
         read (lun, iostat=stat) rows
         do i = 1, shape_rows(2)
            call history%append(rows(:, i))
         end do
      end if
      close (lun)
      if (stat /= 0) call status%fail(ehl_file, path//": the checkpoint does not fit this case")
   end subroutine read_checkpoint

   !> Remove both files, and what a killed writer left
   subroutine remove_checkpoints(folder)
      character(len=*), intent(in) :: folder
      logical :: gone
      integer :: k

      do k = 1, 2
         if (file_exists(folder//names(k))) gone = remove_file(folder//names(k))
         if (file_exists(folder//names(k)//".new")) gone = remove_file(folder//names(k)//".new")
      end do
   end subroutine remove_checkpoints

   !> 0 or 1: which of the two files to write next
   integer function older(folder)
      character(len=*), intent(in) :: folder
      older = merge(1, 0, newest(folder) == 1)
   end function older

   !> Number of the good file with the latest step; 0 when there is none
   integer function newest(folder)
      character(len=*), intent(in) :: folder
      integer :: k, step(2)

      do k = 1, 2
         step(k) = good_step(folder//names(k))
      end do
      newest = 0
      if (maxval(step) >= 0) newest = maxloc(step, dim=1)
   end function newest

   !> Step of a checkpoint whose checksum is right, -1 for any other file
   integer function good_step(path)
      character(len=*), intent(in) :: path
      integer(int8), allocatable :: bytes(:)
      integer(int64) :: n
      integer :: stat

      good_step = -1
      if (.not. file_exists(path)) return
      call read_bytes(path, bytes, stat)
      n = size(bytes, kind=int64) - 4
      if (stat /= 0 .or. n < len(magic) + 4) return
      if (transfer(bytes(n + 1:n + 4), 0_int32) /= crc32(bytes(:n))) return
      if (transfer(bytes(:len(magic)), magic) /= magic) return
      good_step = transfer(bytes(len(magic) + 1:len(magic) + 4), 0)
   end function good_step

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

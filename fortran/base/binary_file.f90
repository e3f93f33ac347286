! SPDX-License-Identifier: BSD-3-Clause
!> Binary files whose layout is described once: the same calls of `item`, in the same order, write a file that was
!> made and read one that was opened. A checksum is taken of all that passes.
module ehl_binary_file
   use, intrinsic :: iso_fortran_env, only: int64, int8
   use ehl_file_extent, only: extent_t, file_bytes
   use ehl_files, only: flush_file
   use ehl_kinds, only: dp
   use ehl_status, only: ehl_file, status_t
   implicit none (type, external)
   private
   public :: binary_file_t

   !> Numbers that pass at a time
   integer, parameter :: block = 8192

   type :: binary_file_t
      !> Whether items are written, else read
      logical :: writing = .false.
      !> All that has passed; when more is appended, also what was there
      type(extent_t) :: extent
      character(len=:), allocatable, private :: path
      character(len=256), private :: reason = ""
      integer, private :: lun = 0, stat = 0
      logical, private :: opened = .false.
   contains
      procedure :: create
      procedure :: append
      procedure :: open => open_file
      procedure :: close => close_file
      procedure :: seal
      procedure :: refuse
      procedure :: failed
      generic :: item => text, whole_number, number, vector, matrix, stack, part
      procedure, private :: text, whole_number, number, vector, matrix, stack, part, numbers
   end type binary_file_t

contains

   !> Make a file to be written, in place of what was there
   subroutine create(self, path)
      class(binary_file_t), intent(inout) :: self
      character(len=*), intent(in) :: path
      call open_as(self, path, "replace", "write")
      self%writing = .true.
   end subroutine create

   !> Write on behind the beginning of a file; what stands behind that is lost
   subroutine append(self, path, there)
      class(binary_file_t), intent(inout) :: self
      character(len=*), intent(in) :: path
      type(extent_t), intent(in) :: there
      integer :: stat

      if (there%bytes == 0) then
         call self%create(path)
         return
      end if
      call open_as(self, path, "old", "readwrite")
      self%writing = .true.
      self%extent = there
      if (self%stat /= 0) return
      write (self%lun, pos=there%bytes + 1, iostat=stat)
      if (stat /= 0) call self%refuse("it cannot be appended to")
   end subroutine append

   !> Open a file to be read
   subroutine open_file(self, path)
      class(binary_file_t), intent(inout) :: self
      character(len=*), intent(in) :: path
      call open_as(self, path, "old", "read")
      self%writing = .false.
   end subroutine open_file

   subroutine open_as(self, path, there, action)
      type(binary_file_t), intent(inout) :: self
      character(len=*), intent(in) :: path, there, action
      character(len=256) :: reason
      integer :: stat

      self%path = path
      self%stat = 0
      self%extent = extent_t()
      open (newunit=self%lun, file=path, status=there, action=action, access="stream", form="unformatted", &
            iostat=stat, iomsg=reason)
      self%opened = stat == 0
      if (stat /= 0) call self%refuse(reason)
   end subroutine open_as

   !> Whether an item did not pass
   pure logical function failed(self)
      class(binary_file_t), intent(in) :: self
      failed = self%stat /= 0
   end function failed

   !> What was read cannot be meant: no further item passes
   subroutine refuse(self, reason)
      class(binary_file_t), intent(inout) :: self
      character(len=*), intent(in) :: reason

      if (self%stat /= 0) return
      self%stat = 1
      self%reason = reason
   end subroutine refuse

   !> Close the file. What was written is on the disk itself then, lest it is lost with the power.
   subroutine close_file(self, status)
      class(binary_file_t), intent(inout) :: self
      type(status_t), intent(inout) :: status
      integer :: stat

      if (self%opened) then
         close (self%lun, iostat=stat)
         if (stat /= 0) call self%refuse("it cannot be closed")
      end if
      self%opened = .false.
      if (self%writing .and. self%stat == 0) then
         ! a write to a full disk that takes a part is no error for the library of gfortran
         if (file_bytes(self%path) < self%extent%bytes) then
            call self%refuse("the disk is full, or a limit of the size of files is reached")
         else if (.not. flush_file(self%path)) then
            call self%refuse("it does not get onto the disk")
         end if
      end if
      if (self%stat == 0) return
      if (self%writing) then
         call status%fail(ehl_file, self%path//": error: cannot write: "//trim(self%reason))
      else
         call status%fail(ehl_file, self%path//": error: cannot read: "//trim(self%reason))
      end if
   end subroutine close_file

   !> A text of known length
   subroutine text(self, value)
      class(binary_file_t), intent(inout) :: self
      character(len=*), intent(inout) :: value
      character(len=256) :: reason
      integer :: stat

      if (self%stat /= 0) return
      if (self%writing) then
         write (self%lun, iostat=stat, iomsg=reason) value
      else
         read (self%lun, iostat=stat, iomsg=reason) value
      end if
      if (stat /= 0) call self%refuse(reason)
      call self%extent%add(transfer(value, [0_int8], len(value)))
   end subroutine text

   subroutine whole_number(self, value)
      class(binary_file_t), intent(inout) :: self
      integer, intent(inout) :: value
      character(len=storage_size(value)/8) :: bytes

      bytes = transfer(value, bytes)
      call self%item(bytes)
      value = transfer(bytes, value)
   end subroutine whole_number

   subroutine number(self, value)
      class(binary_file_t), intent(inout) :: self
      real(dp), intent(inout) :: value
      real(dp) :: values(1)

      values = value
      call self%numbers(values, 1_int64)
      value = values(1)
   end subroutine number

   subroutine vector(self, values)
      class(binary_file_t), intent(inout) :: self
      real(dp), contiguous, intent(inout) :: values(:)
      call pass_shape(self, shape(values))
      call self%numbers(values, size(values, kind=int64))
   end subroutine vector

   subroutine matrix(self, values)
      class(binary_file_t), intent(inout) :: self
      real(dp), contiguous, intent(inout) :: values(:, :)
      call pass_shape(self, shape(values))
      call self%numbers(values, size(values, kind=int64))
   end subroutine matrix

   subroutine stack(self, values)
      class(binary_file_t), intent(inout) :: self
      real(dp), contiguous, intent(inout) :: values(:, :, :)
      call pass_shape(self, shape(values))
      call self%numbers(values, size(values, kind=int64))
   end subroutine stack

   !> How much of another file belongs to this one
   subroutine part(self, value)
      class(binary_file_t), intent(inout) :: self
      type(extent_t), intent(inout) :: value
      integer :: halves(2)

      halves = transfer(value%bytes, halves)
      call self%item(halves(1))
      call self%item(halves(2))
      call self%item(value%checksum%remainder)
      value%bytes = transfer(halves, value%bytes)
   end subroutine part

   !> Arrays are read into arrays of the same shape
   subroutine pass_shape(self, ours)
      class(binary_file_t), intent(inout) :: self
      integer, intent(in) :: ours(:)
      integer :: k, n

      do k = 1, size(ours)
         n = ours(k)
         call self%item(n)
         if (n /= ours(k)) call self%refuse("it belongs to another grid")
      end do
   end subroutine pass_shape

   subroutine numbers(self, values, n)
      class(binary_file_t), intent(inout) :: self
      integer(int64), intent(in) :: n
      real(dp), intent(inout) :: values(n)
      integer(int64) :: first, last
      character(len=256) :: reason
      integer :: stat

      do first = 1, n, block
         if (self%stat /= 0) return
         last = min(first + block - 1, n)
         if (self%writing) then
            write (self%lun, iostat=stat, iomsg=reason) values(first:last)
         else
            read (self%lun, iostat=stat, iomsg=reason) values(first:last)
         end if
         if (stat /= 0) call self%refuse(reason)
         call self%extent%add(transfer(values(first:last), [0_int8], int(8*(last - first + 1))))
      end do
   end subroutine numbers

   !> The last item: the checksum of those before it
   subroutine seal(self)
      class(binary_file_t), intent(inout) :: self
      integer :: ours, theirs

      ours = self%extent%checksum%value()
      theirs = ours
      call self%item(theirs)
      if (theirs /= ours) call self%refuse("it is damaged")
   end subroutine seal
end module ehl_binary_file

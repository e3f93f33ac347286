! SPDX-License-Identifier: BSD-3-Clause
!> Binary files: what is written is read again, files that grow, damage and other shapes
module test_binary
   use, intrinsic :: iso_fortran_env, only: int32, int8
   use check, only: has_text, is_close, is_equal, is_true
   use ehl_binary_file, only: binary_file_t
   use ehl_checksum, only: checksum_t
   use ehl_file_extent, only: begins_with, extent_t, is_sealed
   use ehl_files, only: process_mark, remove_file
   use ehl_kinds, only: dp
   use ehl_status, only: status_t
   implicit none (type, external)
   private
   public :: run_binary

contains

   subroutine run_binary()
      call checksum_of_the_standard()
      call what_is_written_is_read()
      call files_grow()
   end subroutine run_binary

   !> The check value of CRC-32: that of the digits 1 to 9, here in two pieces
   subroutine checksum_of_the_standard()
      type(checksum_t) :: sum

      call sum%add(transfer("1234", [0_int8]))
      call sum%add(transfer("56789", [0_int8]))
      call is_equal(int(sum%value()), -873187034, "0xCBF43926")
   end subroutine checksum_of_the_standard

   subroutine what_is_written_is_read()
      type(binary_file_t) :: file
      type(status_t) :: status, failure
      character(len=:), allocatable :: path
      character(len=3) :: word
      real(dp) :: stack(40, 50, 6), again(40, 50, 6), other(50, 40, 6), number
      integer :: n, lun
      logical :: gone

      path = "binary-"//process_mark()
      call random_number(stack)
      word = "ehl"
      n = 7
      number = 0.1_dp
      call file%create(path)
      call pass(stack)
      call is_true(.not. status%failed(), "written")
      call is_true(is_sealed(path), "and sealed")
      word = ""
      n = 0
      number = 0.0_dp
      call file%open(path)
      call pass(again)
      call is_true(.not. status%failed(), "read")
      call is_true(word == "ehl" .and. n == 7, "text and whole number")
      call is_close(number, 0.1_dp, 0.0_dp, "number")
      call is_close(maxval(abs(again - stack)), 0.0_dp, 0.0_dp, "more numbers than pass at a time")
      call file%open(path)
      call file%item(word)
      call file%item(n)
      call file%item(number)
      call file%item(other)
      call file%close(failure)
      call has_text(failure%message, "another grid", "an array of another shape")
      open (newunit=lun, file=path, access="stream", form="unformatted", status="old", action="readwrite")
      write (lun, pos=1000) 1_int8
      close (lun)
      call is_true(.not. is_sealed(path), "damage is seen")
      call file%open(path)
      call pass(again)
      call has_text(status%message, "damaged", "while it is read too")
      gone = remove_file(path)

   contains

      subroutine pass(values)
         real(dp), intent(inout) :: values(:, :, :)
         call file%item(word)
         call file%item(n)
         call file%item(number)
         call file%item(values)
         call file%seal()
         call file%close(status)
      end subroutine pass
   end subroutine what_is_written_is_read

   !> What is appended continues the checksum; a tail that was cut off is written over
   subroutine files_grow()
      type(binary_file_t) :: file
      type(extent_t) :: two, three
      type(status_t) :: status
      character(len=:), allocatable :: path
      integer :: k, n
      logical :: gone

      path = "growing-"//process_mark()
      call grow([1, 2])
      two = file%extent
      call grow([9])
      call is_true(begins_with(path, two), "what was there stays")
      call grow([3])
      three = file%extent
      call is_equal(int(three%bytes), 3*storage_size(1_int32)/8, "length")
      call is_true(begins_with(path, three), "checksum of the whole")
      call file%open(path)
      do k = 1, 3
         call file%item(n)
         call is_equal(n, k, "in order")
      end do
      call file%close(status)
      call is_true(.not. status%failed(), "files that grow")
      gone = remove_file(path)

   contains

      subroutine grow(values)
         integer, intent(in) :: values(:)

         call file%append(path, two)
         do k = 1, size(values)
            n = values(k)
            call file%item(n)
         end do
         call file%close(status)
      end subroutine grow
   end subroutine files_grow
end module test_binary

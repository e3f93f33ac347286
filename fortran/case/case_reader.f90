! SPDX-License-Identifier: BSD-3-Clause
!> From the text of a case file and --set options to a complete case
module ehl_case_reader
   use ehl_case, only: case_t
   use ehl_case_check, only: check_case
   use ehl_derived, only: settle_marks
   use ehl_group_reader, only: read_groups
   use ehl_option_reader, only: note_option, read_option, split_options
   use ehl_schema, only: schema_t
   use ehl_source, only: source_t
   use ehl_status, only: ehl_bad_input, status_t
   use ehl_text, only: newline
   use ehl_whole_file, only: read_text
   implicit none (type, external)
   private
   public :: read_case, read_case_file

   !> Largest case file; anything longer is not one
   integer, parameter :: largest_file = 1000000

contains

   !> Read, check and complete the case in a file; see read_case
   subroutine read_case_file(path, options, input, status)
      character(len=*), intent(in) :: path, options
      type(case_t), intent(out), target :: input
      type(status_t), intent(inout) :: status
      character(len=:), allocatable :: text

      call read_text(path, largest_file, text, status)
      if (status%failed()) then
         status%code = ehl_bad_input
         status%message = status%message // newline // "expected: the name of a case file"
         return
      end if
      call read_case(text, path, options, input, status)
   end subroutine read_case_file

   !> Read, check and complete a case. Every fault ends in one message with its place.
   subroutine read_case(text, origin, options, input, status)
      !> Namelist text
      character(len=*), intent(in) :: text
      !> Name of the file it came from, for messages and for relative file names
      character(len=*), intent(in) :: origin
      !> Options group.key=value that replace values of the text, one a line; may be empty
      character(len=*), intent(in) :: options
      type(case_t), intent(out), target :: input
      type(status_t), intent(inout) :: status
      type(schema_t) :: schema
      type(source_t), allocatable :: sources(:)
      integer :: k

      call schema%bind(input)
      sources = [source_t(origin, text)]
      call split_options(options, sources)
      do k = 2, size(sources)
         call note_option(sources(k), schema)
      end do
      call read_groups(sources(1), schema, status)
      if (.not. status%failed()) call settle_marks(schema, sources(:1))
      do k = 2, size(sources)
         if (status%failed()) return
         call read_option(sources(k), k, schema, status)
      end do
      if (status%failed()) return
      input%given = schema%keys%given
      call check_case(schema, input, sources, status)
   end subroutine read_case
end module ehl_case_reader

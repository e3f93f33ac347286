! SPDX-License-Identifier: BSD-3-Clause
!> The file that a key names
module ehl_case_path
   use ehl_case, only: path_length
   use ehl_files, only: absolute_path, folder_of
   use ehl_refusal, only: refuse
   use ehl_schema, only: schema_t
   use ehl_source, only: source_t
   use ehl_status, only: status_t
   use ehl_text, only: to_text
   implicit none (type, external)
   private
   public :: find_file

contains

   !> Make the name of a file absolute; one in the case file starts at the folder of that file, one in an option at the
   !> working folder
   subroutine find_file(schema, sources, group, name, file, status)
      type(schema_t), intent(in) :: schema
      type(source_t), intent(in) :: sources(:)
      !> The key
      character(len=*), intent(in) :: group, name
      character(len=path_length), intent(inout) :: file
      type(status_t), intent(inout) :: status
      character(len=:), allocatable :: path

      path = trim(file)
      if (path(1:1) /= "/" .and. schema%keys(schema%find(group, name))%source == 1) path = folder_of(sources(1)%name) // path
      path = absolute_path(path)
      if (len(path) > path_length) then
         call refuse(schema, sources, group, name, group // "." // name // ": the full name is longer than " &
                     // to_text(path_length) // " characters", "a shorter path", status)
      else
         file = path
      end if
   end subroutine find_file
end module ehl_case_path

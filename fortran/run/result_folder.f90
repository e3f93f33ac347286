! SPDX-License-Identifier: BSD-3-Clause
!> Files of a result, the same for `ehl` and the Python package
module ehl_result_folder
   use ehl_case, only: case_t
   use ehl_contact_run, only: phase_steps
   use ehl_files, only: remove_file, remove_folder
   use ehl_folders, only: list_folder, name_t
   use ehl_kinds, only: dp
   use ehl_npy, only: write_npy
   use ehl_record, only: record_t
   use ehl_report_duty, only: duty_history
   use ehl_solver, only: field_length, solver_t
   use ehl_status, only: ehl_no_memory, status_t
   use ehl_table, only: table_t
   use ehl_text, only: newline
   use ehl_version, only: version
   use ehl_whole_file, only: write_text
   implicit none (type, external)
   private
   public :: result_names, write_results

   !> All files that a result may have, one per line
   character(len=*), parameter :: result_names = &
      "case.nml"//newline//"plan.txt"//newline//"summary.json"//newline//"history.csv"//newline// &
      "X.npy"//newline//"Y.npy"//newline//"P.npy"//newline//"H.npy"//newline//"P_smooth.npy"//newline// &
      "H_smooth.npy"//newline//"RR.npy"//newline//"A_d.npy"//newline//"frame_T.npy"//newline// &
      "frame_P.npy"//newline//"frame_H.npy"//newline//"temperature_rise_K.npy"//newline// &
      "temperature_rise_wall_1_K.npy"//newline//"temperature_rise_wall_2_K.npy"//newline

contains

   !> Write all results of a solver into an empty folder, which is removed after a failure
   subroutine write_results(folder, input, solver, status, wall_seconds)
      character(len=*), intent(in) :: folder
      !> The resolved case
      type(case_t), intent(in) :: input
      type(solver_t), intent(inout) :: solver
      type(status_t), intent(inout) :: status
      !> If present, write the summary of `ehl`, with numbers and single words; pyehl writes its own summary, with sentences
      real(dp), intent(in), optional :: wall_seconds
      type(name_t), allocatable :: names(:)
      logical :: done
      integer :: k

      call write_files(folder // "/", input, solver, status, wall_seconds)
      if (.not. status%failed()) return
      done = list_folder(folder, names)
      do k = 1, size(names)
         done = remove_file(folder // "/" // names(k)%text)
      end do
      done = remove_folder(folder)
   end subroutine write_results

   !> Write the files of a result into a folder whose name ends with '/'
   subroutine write_files(folder, input, solver, status, wall_seconds)
      character(len=*), intent(in) :: folder
      type(case_t), intent(in) :: input
      type(solver_t), intent(inout) :: solver
      type(status_t), intent(inout) :: status
      real(dp), intent(in), optional :: wall_seconds
      type(table_t) :: history
      type(record_t) :: summary
      type(name_t), allocatable :: names(:)
      character(len=field_length), allocatable :: files(:)
      logical :: done
      integer :: k

      call write_text(folder // "case.nml", input%text, status)
      if (.not. status%failed()) then
         history = solver%run%history
         if (solver%run%plan%duty%active .and. solver%run%phase == phase_steps) call duty_history(solver%run, history)
         call history%write_csv(folder // "history.csv", status)
      end if
      if (.not. status%failed() .and. input%output%fields) call write_fields(folder, solver, status)
      if (status%failed() .or. .not. present(wall_seconds)) return
      summary = solver%results()
      call summary%set("version", version)
      call summary%set("wall_seconds", wall_seconds)
      done = list_folder(folder, names)
      files = [character(len=field_length) :: (names(k)%text, k=1, size(names)), "summary.json"]
      call summary%set("files", files)
      call write_text(folder // "summary.json", summary%to_json(), status)
   end subroutine write_files

   !> Write X and Y as vectors, and fields as matrices of shape (nx, ny)
   subroutine write_fields(folder, solver, status)
      character(len=*), intent(in) :: folder
      type(solver_t), intent(inout) :: solver
      type(status_t), intent(inout) :: status
      real(dp), allocatable :: x(:), y(:), values(:, :)
      character(len=field_length), allocatable :: names(:)
      integer :: i, ny, k, stat

      associate (grid => solver%finest())
         ny = grid%full_ny()
         allocate (x(grid%nx), y(ny), values(grid%nx, ny), stat=stat)
         if (stat /= 0) then
            call status%fail(ehl_no_memory, "no memory to write the fields")
            return
         end if
         x(:) = grid%x([(i, i=1, grid%nx)])
         y(:) = grid%y([(i, i=1, ny)] - grid%rows_below())
      end associate
      call write_npy(folder // "X.npy", x, status)
      if (.not. status%failed()) call write_npy(folder // "Y.npy", y, status)
      call solver%field_names(names)
      do k = 1, size(names)
         if (.not. status%failed()) call solver%field(trim(names(k)), values, status)
         if (.not. status%failed()) call write_npy(folder // trim(names(k)) // ".npy", values, status)
      end do
      associate (frames => solver%run%frames, n => solver%run%frames%n)
         if (n == 0) return
         if (.not. status%failed()) call write_npy(folder // "frame_T.npy", frames%times(:n), status)
         if (.not. status%failed()) call write_npy(folder // "frame_P.npy", frames%p(:n), status)
         if (.not. status%failed()) call write_npy(folder // "frame_H.npy", frames%h(:n), status)
      end associate
   end subroutine write_fields
end module ehl_result_folder

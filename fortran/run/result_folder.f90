! SPDX-License-Identifier: BSD-3-Clause
!> The result folder, the same for both drivers. It appears whole or not at all: everything is
!> written into a folder beside it, which is then renamed.
module ehl_result_folder
   use ehl_case, only: case_t
   use ehl_case_writer, only: case_text
   use ehl_files, only: absolute_path, file_exists, make_folder, process_mark, real_path, &
                        remove_folder, remove_known, rename_path
   use ehl_kinds, only: dp
   use ehl_npy, only: write_npy
   use ehl_record, only: record_t
   use ehl_solver, only: solver_t
   use ehl_status, only: ehl_bad_input, ehl_file, status_t
   use ehl_version, only: version
   use ehl_whole_file, only: write_text
   implicit none (type, external)
   private
   public :: check_folder, full_path, make_parents, write_results

   !> What pyehl writes into a result folder; only these are ever removed
   character(len=*), parameter :: known_files(*) = [character(len=24) :: &
      "case.nml", "plan.txt", "summary.json", "history.csv", "X.npy", "Y.npy", "P.npy", "H.npy", &
      "P_smooth.npy", "H_smooth.npy", "RR.npy", "A_d.npy", "frame_T.npy", "frame_P.npy", "frame_H.npy", &
      "results.nc", &
      "centre_lines.png", "film.png", "deformed_roughness.png", "rough_and_smooth.png", &
      "friction.png", "extremes.png", &
      "centre_lines.pdf", "film.pdf", "deformed_roughness.pdf", "rough_and_smooth.pdf", &
      "friction.pdf", "extremes.pdf", &
      "centre_lines.svg", "film.svg", "deformed_roughness.svg", "rough_and_smooth.svg", &
      "friction.svg", "extremes.svg", &
      "movie.gif", "movie.mp4"]

contains

   !> Before a run: refuse a folder that could not be written, or that holds something else
   !> than results
   subroutine check_folder(folder, status)
      character(len=*), intent(in) :: folder
      type(status_t), intent(inout) :: status
      character(len=:), allocatable :: target_folder, partial

      target_folder = full_path(folder)
      if (target_folder == "") then
         call status%fail(ehl_bad_input, "-o '" // folder // "': error: this names no folder" &
                          // new_line("a") // "expected: the name of a folder for the results")
         return
      end if
      if (holds_other(target_folder)) then
         ! An empty folder can be removed, and is made again
         if (.not. remove_folder(target_folder)) then
            call status%fail(ehl_bad_input, folder // ": error: there is something else than " &
                             // "results of an earlier run" // new_line("a") &
                             // "expected: a new or empty folder, or one with such results")
            return
         end if
         if (.not. make_folder(target_folder)) then
            call status%fail(ehl_file, folder // ": error: cannot make this folder")
            return
         end if
      end if
      call make_parents(target_folder)
      partial = target_folder // ".partial-" // process_mark()
      if (.not. make_folder(partial)) then
         call status%fail(ehl_bad_input, folder // ": error: cannot write here" // new_line("a") &
                          // "expected: a folder that can be made and written")
      else if (.not. remove_folder(partial)) then
         call status%fail(ehl_file, partial // ": error: cannot remove this folder")
      end if
   end subroutine check_folder

   !> Write everything that a solver knows. An earlier result in the folder gives way; files
   !> in it that are not ours are kept in a folder that the note names.
   subroutine write_results(folder, input, solver, wall_seconds, note, status)
      character(len=*), intent(in) :: folder
      !> The resolved case
      type(case_t), intent(in) :: input
      type(solver_t), intent(inout) :: solver
      real(dp), intent(in) :: wall_seconds
      !> What else a person should know; mostly empty
      character(len=:), allocatable, intent(out) :: note
      type(status_t), intent(inout) :: status
      character(len=:), allocatable :: target_folder, partial, previous

      note = ""
      target_folder = full_path(folder)
      partial = target_folder // ".partial-" // process_mark()
      previous = target_folder // ".previous-" // process_mark()
      if (.not. make_folder(partial)) then
         call status%fail(ehl_file, partial // ": error: cannot make this folder")
         return
      end if
      call write_files(partial // "/", input, solver, wall_seconds, status)
      if (status%failed()) then
         call remove_known(partial, known_files)
         return
      end if
      if (is_result(target_folder)) then
         if (.not. rename_path(target_folder, previous)) then
            call status%fail(ehl_file, target_folder // ": error: cannot replace; the results are in " &
                             // partial)
            return
         end if
      end if
      if (.not. rename_path(partial, target_folder)) then
         call status%fail(ehl_file, target_folder // ": error: cannot make; the results are in " // partial)
         return
      end if
      if (file_exists(previous)) then
         call remove_known(previous, known_files)
         if (file_exists(previous)) note = "other files of the earlier result are in " // previous
      end if
   end subroutine write_results

   !> The files of a result, into a folder whose name ends in '/'
   subroutine write_files(folder, input, solver, wall_seconds, status)
      character(len=*), intent(in) :: folder
      type(case_t), intent(in) :: input
      type(solver_t), intent(inout) :: solver
      real(dp), intent(in) :: wall_seconds
      type(status_t), intent(inout) :: status
      type(record_t) :: summary

      summary = solver%summary()
      call summary%set("version", version)
      call summary%set("wall_seconds", wall_seconds)
      call write_text(folder // "case.nml", case_text(input), status)
      if (.not. status%failed()) call write_text(folder // "plan.txt", solver%describe(), status)
      if (.not. status%failed()) call solver%history%write_csv(folder // "history.csv", status)
      if (.not. status%failed() .and. input%output%fields) call write_fields(folder, solver, status)
      if (.not. status%failed()) call write_text(folder // "summary.json", summary%to_json(), status)
   end subroutine write_files

   !> X and Y as vectors, fields as (nx, ny) matrices
   subroutine write_fields(folder, solver, status)
      character(len=*), intent(in) :: folder
      type(solver_t), intent(inout) :: solver
      type(status_t), intent(inout) :: status
      real(dp), allocatable :: x(:), y(:), values(:, :)
      character(len=8), allocatable :: names(:)
      integer :: i, ny, k

      associate (grid => solver%finest())
         ny = grid%full_ny()
         allocate (x(grid%nx), y(ny), values(grid%nx, ny))
         x(:) = grid%x([(i, i=1, grid%nx)])
         y(:) = grid%y([(i, i=1, ny)] - (ny - grid%ny))
      end associate
      call write_npy(folder // "X.npy", x, status)
      if (.not. status%failed()) call write_npy(folder // "Y.npy", y, status)
      call solver%field_names(names)
      do k = 1, size(names)
         if (.not. status%failed()) call solver%field(trim(names(k)), values, status)
         if (.not. status%failed()) call write_npy(folder // trim(names(k)) // ".npy", values, status)
      end do
      associate (frames => solver%frames, n => solver%frames%n)
         if (n == 0) return
         if (.not. status%failed()) call write_npy(folder // "frame_T.npy", frames%times(:n), status)
         if (.not. status%failed()) call write_npy(folder // "frame_P.npy", frames%p(:n), status)
         if (.not. status%failed()) call write_npy(folder // "frame_H.npy", frames%h(:n), status)
      end associate
   end subroutine write_fields

   !> The folder from the root without a '/' at its end; empty when it cannot be a folder of ours
   function full_path(folder) result(path)
      character(len=*), intent(in) :: folder
      character(len=:), allocatable :: path
      integer :: last

      path = ""
      last = verify(folder, "/", back=.true.)
      if (last == 0) return
      path = real_path(absolute_path(folder(:last)))
      if (path == "/") path = ""
   end function full_path

   !> Whether a folder holds results
   logical function is_result(folder)
      character(len=*), intent(in) :: folder

      is_result = file_exists(folder // "/summary.json")
      if (is_result) is_result = file_exists(folder // "/case.nml")
   end function is_result

   !> Whether something is there that is not a result folder
   logical function holds_other(folder)
      character(len=*), intent(in) :: folder

      holds_other = file_exists(folder)
      if (holds_other) holds_other = .not. is_result(folder)
   end function holds_other

   !> Make the folders above a path
   subroutine make_parents(path)
      character(len=*), intent(in) :: path
      integer :: slash
      logical :: made

      do slash = 2, len(path)
         if (path(slash:slash) /= "/") cycle
         if (file_exists(path(:slash - 1))) cycle
         made = make_folder(path(:slash - 1))
         if (.not. made) return
      end do
   end subroutine make_parents
end module ehl_result_folder

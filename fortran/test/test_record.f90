! SPDX-License-Identifier: BSD-3-Clause
!> Records, tables and .npy files
module test_record
   use check, only: has_text, is_close, is_equal, is_text, is_true
   use ehl_files, only: process_mark, remove_file
   use ehl_kinds, only: dp, not_known
   use ehl_npy, only: read_npy, write_npy
   use ehl_record, only: kind_code, kind_detail, kind_integer, kind_list, kind_logical, kind_note, kind_real, kind_text, record_t
   use ehl_status, only: ehl_file, status_t
   use ehl_table, only: table_t
   use ehl_whole_file, only: read_text, write_text
   implicit none (type, external)
   private
   public :: run_record

contains

   subroutine run_record()
      call record_to_json()
      call table_to_csv()
      call matrix_to_file()
   end subroutine run_record

   subroutine record_to_json()
      type(record_t) :: record
      character(len=*), parameter :: lf = new_line("a")
      character(len=:), allocatable :: names
      integer, allocatable :: kinds(:)
      real(dp), allocatable :: values(:)

      call is_text(record%to_json(), "{" // lf // "}" // lf, "empty record")
      call record%set("H_c", 0.1_dp)
      call record%set("cycles", 3)
      call record%set("si", .true.)
      call record%set("status", "converged")
      call record%set("F", not_known)
      call record%set("cycles", 4)
      call record%set("files", [character(len=4) :: "x", "long"])
      call record%set("H_min c", [0.5_dp, 2.0_dp])
      call record%set_code("F_note", 7)
      call record%set_detail("points", 65.0_dp)
      call record%set_note("why", "two"//lf//"lines")
      call is_text(record%to_json(), "{" // lf // '  "H_c": 0.1,' // lf // '  "cycles": 4,' // lf // '  "si": true,' // lf &
                   // '  "status": "converged",' // lf // '  "F": null,' // lf // '  "files": ["x", "long"],' // lf &
                   // '  "H_min": 0.5,' // lf // '  "c": 2.0' // lf // "}" // lf, "record without codes, details and notes")
      call is_close(record%number("H_min"), 0.5_dp, 0.0_dp, "number of a record")
      call record%list(names, kinds, values)
      call has_text(names, "status"//achar(9)//"converged"//lf//"F"//lf, "names with texts")
      call has_text(names, "F_note"//lf//"points"//lf//"why"//achar(9)//"two lines"//lf, "names of codes, details and notes")
      call is_true(all(kinds == [kind_real, kind_integer, kind_logical, kind_text, kind_real, kind_list, kind_real, kind_real, &
                                 kind_code, kind_detail, kind_note]), "kinds")
      call is_close(sum(values(2:3)) + sum(values(7:10)), 79.5_dp, 0.0_dp, "values")
   end subroutine record_to_json

   subroutine table_to_csv()
      type(table_t) :: table
      type(status_t) :: status
      character(len=:), allocatable :: text, path
      integer :: k

      path = "test_table-" // process_mark() // ".csv"
      call table%init([character(len=8) :: "cycle", "residual"])
      do k = 1, 100
         call table%append([real(k, dp), 0.5_dp**k], status)
      end do
      call is_equal(table%n_rows(), 100, "rows of the table")
      call is_equal(size(table%column("nothing")), 0, "values of a column that is not there")
      call is_close(sum(table%column("cycle")), 5050.0_dp, 0.0_dp, "sum of a column")
      call table%write_csv(path, status)
      call read_text(path, 100000, text, status)
      call is_true(.not. status%failed(), "table written and read")
      call is_equal(index(text, "cycle,residual" // new_line("a") // "1,0.5" // new_line("a") // "2,0.25"), &
                    1, "beginning of the table")
      call is_true(remove_file(path), "table removed")
      call table%write_csv("no/such/folder/" // path, status)
      call is_equal(status%code, ehl_file, "table in a folder that is not there")
   end subroutine table_to_csv

   subroutine matrix_to_file()
      type(status_t) :: status
      real(dp) :: values(3, 2)
      real(dp), allocatable :: back(:, :)
      character(len=:), allocatable :: path
      integer :: i

      path = "test_matrix-" // process_mark() // ".npy"
      values = reshape([(real(i, dp), i=1, 6)], [3, 2])
      call write_npy(path, values, status)
      call read_npy(path, back, status)
      call is_true(.not. status%failed(), "matrix written and read")
      call is_equal(size(back, 1), 3, "first extent")
      call is_close(maxval(abs(back - values)), 0.0_dp, 0.0_dp, "difference of the matrices")
      call write_text(path, "nothing like an array, but long enough", status)
      call read_npy(path, back, status)
      call is_equal(status%code, ehl_file, "text instead of a matrix")
      call has_text(status%message, path, "message about a text")
      call is_true(remove_file(path), "matrix removed")
   end subroutine matrix_to_file
end module test_record

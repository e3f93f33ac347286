! SPDX-License-Identifier: BSD-3-Clause
!> Records, tables and .npy files
module test_record
   use check, only: has_text, is_close, is_equal, is_text, is_true
   use ehl_files, only: process_mark, remove_file
   use ehl_kinds, only: dp, not_known
   use ehl_npy, only: read_npy, write_npy
   use ehl_record, only: record_t
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
      type(record_t) :: record, lists
      character(len=*), parameter :: lf = new_line("a")

      call is_text(record%to_json(), "{" // lf // "}" // lf, "empty record")
      call record%set("H_c", 0.1_dp)
      call record%set("cycles", 3)
      call record%set("si", .true.)
      call record%set("status", 'a "word" \')
      call record%set("F", not_known)
      call record%set("cycles", 4)
      call is_text(record%to_json(), "{" // lf // '  "H_c": 0.1,' // lf // '  "cycles": 4,' // lf &
                   // '  "si": true,' // lf // '  "status": "a \"word\" \\",' // lf &
                   // '  "F": null' // lf // "}" // lf, "record")
      call is_text(record%text("status"), 'a "word" \', "text of a record")
      call is_true(record%has("F") .and. .not. record%has("G"), "names of a record")
      call lists%set("b", [character(len=4) :: 'x"', "long"])
      call lists%set("c", [character(len=4) ::])
      call lists%set("H_c H_min c F", [0.5_dp, not_known, 2.0_dp, 0.25_dp])
      call is_text(lists%to_json(), "{" // lf // '  "b": ["x\"", "long"],' // lf // '  "c": 2.0,' // lf // '  "H_c": 0.5,' // lf &
                   // '  "H_min": null,' // lf // '  "F": 0.25' // lf // "}" // lf, "lists in a record, several values at once")
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

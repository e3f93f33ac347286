! SPDX-License-Identifier: BSD-3-Clause
!> Reading, checking and writing cases
module test_case
   use check, only: has_text, is_close, is_equal, is_text, is_true
   use ehl_case, only: case_t, text_case_t
   use ehl_case_reader, only: read_case
   use ehl_case_writer, only: case_text
   use ehl_kinds, only: dp
   use ehl_schema, only: schema_t
   use ehl_status, only: ehl_bad_input, ehl_internal, status_t
   implicit none (type, external)
   private
   public :: run_case

   character(len=1), parameter :: lf = new_line("a")

contains

   subroutine run_case()
      call defaults_are_the_papers()
      call contact_kinds()
      call writes_what_it_reads()
      call options_win()
      call faults_have_places()
      call misspelt_names_are_faults_of_the_program()
   end subroutine run_case

   !> A name in the source that is no key: an error, not the memory before the table
   subroutine misspelt_names_are_faults_of_the_program()
      type(schema_t) :: schema
      type(status_t) :: status(3)
      type(text_case_t) :: file
      real(dp), target :: value

      value = 1.0_dp
      schema%group = "contact"
      call schema%reals("load", value, "N", "", "load")
      call schema%contradict("contact.load", "contact.laod", "one", status(1))
      call schema%check_range("contact.laod", value, "contact.load", "load", status(2))
      call schema%find_file("contact.laod", file, status(3))
      call is_true(all(status%code == ehl_internal), "a misspelt name of a key is an internal error")
   end subroutine misspelt_names_are_faults_of_the_program

   subroutine defaults_are_the_papers()
      type(case_t) :: input
      type(status_t) :: status

      call read_case("", "empty", "", input, status)
      call is_true(.not. status%failed(), "an empty case is a case")
      call is_true(input%contact%si, "an empty case is in SI units")
      call is_close(input%contact%load, 600.0_dp, 0.0_dp, "default load")
      call is_close(input%lubricant%roelands_z, 0.66841_dp, 1.0e-5_dp, "default Roelands exponent")
      call is_equal(input%grid%points, 513, "default points")
   end subroutine defaults_are_the_papers

   subroutine contact_kinds()
      type(case_t) :: input
      type(status_t) :: status

      call read_case("&contact moes_m = 200, /", "moes", "", input, status)
      call is_true(.not. status%failed() .and. .not. input%contact%si, "M alone makes a Moes case")
      call is_close(input%contact%moes_m, 200.0_dp, 0.0_dp, "given M")
      call is_close(input%contact%moes_l, 10.0_dp, 0.0_dp, "default L")
      call read_case("&Contact RADIUS = 1.d-2 / ! end", "si", "", input, status)
      call is_true(.not. status%failed() .and. input%contact%si, "a radius makes an SI case")
      call is_close(input%contact%radius, 0.01_dp, 0.0_dp, "given radius")
   end subroutine contact_kinds

   subroutine writes_what_it_reads()
      type(case_t) :: input, again
      type(status_t) :: status
      character(len=:), allocatable :: text

      call read_case("&contact moes_m=123.456 moes_l=7 / &grid points=257 x_inlet=-4.5/ " &
                     // "&surface kind='harmonic' amplitude=9.734e-3 wavelength=.25/ " &
                     // "&solver cycle=""v"" threads=2/ &psd load_balance=T/", "text", "", input, status)
      call is_true(.not. status%failed(), "a case with many keys")
      call is_text(trim(input%solver%cycle), "V", "words are read in any case")
      call is_close(input%surface%wavelength_y, 0.25_dp, 0.0_dp, "wavelength along Y as given for both")
      call is_close(input%surface%x_start, -4.5_dp, 0.0_dp, "roughness begins at the inlet")
      call is_true(input%psd%load_balance, "short form of true")
      text = case_text(input)
      call read_case(text, "written", "", again, status)
      call is_true(.not. status%failed(), "a written case can be read")
      call is_text(case_text(again), text, "a case read and written again")
   end subroutine writes_what_it_reads

   subroutine options_win()
      type(case_t) :: input
      type(status_t) :: status

      call read_case("&grid points = 257 /", "text", "grid.points=129" // lf // "surface.kind=fractal" // lf, &
                     input, status)
      call is_true(.not. status%failed(), "options are read")
      call is_equal(input%grid%points, 129, "an option replaces the value of the file")
      call is_text(trim(input%surface%kind), "fractal", "an option's word needs no quotes")
   end subroutine options_win

   subroutine faults_have_places()
      call fault("&grid" // lf // "  pionts = 65 /", "", "text:2:3: error", "'points'")
      call fault("&grid" // lf // "  x_inlet = -2,5 /", "", "text:2:15: error", "decimal comma")
      call fault("&contact load = 600 N /", "", "text:1:21: error", "contact.load")
      call fault("&grid points = 65", "", "text:1:18: error", "'/'")
      call fault("&grid points = 512 /", "", "text:1:16: error", "513")
      call fault("&contact load = nan /", "", "text:1:17: error", "finite")
      call fault("&contact load = 1e999 /", "", "text:1:17: error", "too large")
      call fault("&contact load = 1e99999999999 /", "", "text:1:17: error", "too large")
      call fault("&contact load = 1e-99999999999 /", "", "text:1:17: error", "out of range")
      call fault("", "grid.pionts=65", "grid.pionts=65: error", "'points'")
      call fault("", "points=65", "points=65: error", "group.key=value")
   end subroutine faults_have_places

   !> A case that must be refused with a message that begins and goes on as wanted
   subroutine fault(text, options, beginning, part)
      character(len=*), intent(in) :: text, options, beginning, part
      type(case_t) :: input
      type(status_t) :: status

      call read_case(text, "text", options, input, status)
      call is_equal(status%code, ehl_bad_input, "code for " // text // options)
      if (.not. status%failed()) return
      call is_equal(index(status%message, beginning), 1, "place in '" // status%message // "'")
      call has_text(status%message, part, "message")
   end subroutine fault
end module test_case

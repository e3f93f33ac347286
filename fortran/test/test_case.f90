! SPDX-License-Identifier: BSD-3-Clause
!> Reading, completing, checking and writing cases
module test_case
   use check, only: has_text, is_close, is_equal, is_text, is_true
   use ehl_case, only: case_t
   use ehl_kinds, only: dp
   use ehl_read_case, only: read_case
   use ehl_status, only: ehl_bad_input, status_t
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
      call options_move_what_follows()
      call derived_values_are_required()
   end subroutine run_case

   !> An option on a written case also changes the derived values
   subroutine options_move_what_follows()
      type(case_t) :: first, resolved, direct
      type(status_t) :: status
      character(len=*), parameter :: text = "&contact moes_m = 30 / &surface kind = 'harmonic' amplitude = 0.01 /"

      call read_case(text, "text", "", first, status)
      call read_case(first%text, "written", "contact.moes_m=2"//lf//"grid.points=65", resolved, status)
      call read_case(text, "text", "contact.moes_m=2"//lf//"grid.points=65", direct, status)
      call is_true(.not. status%failed(), "options on a written case")
      call is_text(resolved%text, direct%text, "an option on a written case does what it does on the case itself")
      call is_true(resolved%grid%x_inlet < first%grid%x_inlet .and. resolved%grid%points_y == 65, "domain and nodes follow")
      ! a changed value is used although its line is marked as derived
      call read_case("&grid x_inlet = -3.7 ! derived"//lf//"/", "changed", "", direct, status)
      call is_close(direct%grid%x_inlet, -3.7_dp, 0.0_dp, "a changed value with a mark")
   end subroutine options_move_what_follows

   !> Keys that the solver does not read need the values that pyehl derives from them
   subroutine derived_values_are_required()
      type(case_t) :: input
      type(status_t) :: status

      call fault("&lubricant name = 'fva3' /", "", "text:1: error: lubricant.name", "pyehl check")
      call fault("&lubricant kinematic_viscosity_40 = 95 kinematic_viscosity_100 = 10 /", "", "text:1: error: lubricant.kin", &
                 "pyehl check")
      call fault("&bodies radius_x1 = 0.01 radius_y1 = 0.01 /", "", "text:1: error: bodies.radius_", "pyehl check")
      call fault("&surface finish = 'ground' /", "", "text:1: error: surface.finish", "pyehl check")
      call fault("&lubricant viscosity_law = 'table' /", "", "text:1: error: the law 'table'", "pyehl check")
      call fault("&bodies radius_x1 = 0.01 radius_y1 = 0.01 /"//lf//"&contact radius_x = 0.01 radius_y = 0.02 "// &
                 "reduced_modulus = 2.2637e11 /", "", "text:2: error: contact.radius_y", "pyehl check")
      call read_case("&bodies radius_x1=0.01 radius_y1=0.01/ &contact radius_x=0.01 radius_y=0.01 reduced_modulus=2.26373626e11/", &
                     "text", "", input, status)
      call is_true(.not. status%failed() .and. input%bodies%given, "bodies with what follows from them")
      call read_case("&lubricant viscosity_law = 'table' temperature = 40 table_temperature = 40, 40, 80, 80 "// &
                     "table_pressure = 1e5, 4e9, 1e5, 4e9"//lf//" table_viscosity = 0.06, 1e7, 0.01, 1e6 /", "text", "", input, &
                     status)
      call is_true(.not. status%failed(), "a table of viscosities")
      call is_close(input%lubricant%viscosity, 0.06_dp, 1.0e-3_dp, "the viscosity of the table")
      call is_equal(size(input%lubricant%isotherms), 2, "its isotherms")
   end subroutine derived_values_are_required

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

      call read_case("&contact moes_m=123.456 moes_l=7 / &grid points=257 x_inlet=-4.5/ " &
                     // "&surface kind='harmonic' amplitude=9.734e-3 wavelength=.25/ " &
                     // "&solver cycle=""v"" threads=2/ &psd load_balance=T/", "text", "", input, status)
      call is_true(.not. status%failed(), "a case with many keys")
      call is_text(trim(input%solver%cycle), "V", "words are read in any case")
      call is_close(input%surface%wavelength_y, 0.25_dp, 0.0_dp, "wavelength along Y as given for both")
      call is_close(input%surface%x_start, -4.5_dp, 0.0_dp, "roughness begins at the inlet")
      call is_true(input%psd%load_balance, "short form of true")
      call read_case(input%text, "written", "", again, status)
      call is_true(.not. status%failed(), "a written case can be read")
      call is_text(again%text, input%text, "a case read and written again")
      call has_text(input%text, "wavelength_y = 0.25 ! derived", "a mark")
   end subroutine writes_what_it_reads

   subroutine options_win()
      type(case_t) :: input
      type(status_t) :: status

      call read_case("&grid points = 257 /", "text", "grid.points=129" // lf // "surface.kind=fractal" // lf, &
                     input, status)
      call is_true(.not. status%failed(), "options are read")
      call read_case("&grid points = 64.5 /", "text", "grid.points=129.0"//lf//"surface.kind=fractal", input, status)
      call is_true(.not. status%failed(), "an option replaces a value that is not acceptable")
      call is_equal(input%grid%points, 129, "an option replaces the value of the file")
      call is_text(trim(input%surface%kind), "fractal", "an option's word needs no quotes")
   end subroutine options_win

   subroutine faults_have_places()
      call fault("&grid"//lf//"  pionts = 65 /", "", "text:2: error", "'points'")
      call fault("&gird points = 65 /", "", "text:1: error", "'grid'")
      call fault("&grid"//lf//"  x_inlet = -2,5 /", "", "text:2: error: grid.x_inlet = -2, 5", "a number in [-1e4, -1.05]")
      call fault("&contact load = 600 N /", "", "text:1: error: contact.load = 600, N", "a number in (0, 1e5]")
      call fault("&contact load = 2*600 /", "", "text:1: error: contact.load", "(0, 1e5]")
      call fault("&contact load = /", "", "text:1: error: no value for contact.load", "(0, 1e5]")
      call fault("&contact load(1) = 5 /", "", "text:1: error: unknown key 'load(1)'", "'load'")
      call fault("&grid points = 65", "", "text:1: error", "'/'")
      call fault("&grid points = 65 &solver threads = 1 /", "", "text:1: error: &grid", "'/'")
      call fault("points = 65 /", "", "text:1: error", "&group")
      call fault("&grid points = 65.0 /", "", "text:1: error: grid.points = 65.0", "a whole number in [17, 4097]")
      call fault("&grid points = 512 /", "", "text:1: error", "513")
      call fault("&grid points = 65 / &grid max_points = 65 /", "", "text:1: error: &grid is given twice", "once")
      call fault("&grid points = 65 points = 65 /", "", "text:1: error", "every key once")
      call fault("&surface kind = harmonic /", "", "text:1: error: surface.kind", "'harmonic'")
      call fault("&surface kind = 'harmonic"//lf//"' /", "", "text:1: error", "'...'")
      call fault("&psd load_balance = yes /", "", "text:1: error", ".true. or .false.")
      call fault("&contact load = nan /", "", "text:1: error", "(0, 1e5]")
      call fault("&contact load = 1e999 /", "", "text:1: error", "(0, 1e5]")
      call fault("&contact load = 1e99999999999 /", "", "text:1: error", "(0, 1e5]")
      call fault("&surface x_start = 1e-99999 /", "", "text:1: error", "[-1e5, 1e4]")
      call fault("", "grid.pionts=65", "grid.pionts=65: error", "'points'")
      call fault("", "--set grid.points=64", "--set grid.points=64: error", "65")
      call fault("", "points=65", "points=65: error", "group")
      call fault("&contact moes_m = 100 load = 50 /", "", "text:1: error: contact.load contradicts contact.moes_m", "moes_l")
      call fault("&contact slide_to_roll = 0.1 / &surface velocity_ratio = 1 /", "", "text:1: error: surface.velocity", "= 0.0")
      call fault("&contact load = 1e4 radius = 1e-4 /", "", "text:1: error: the Hertz", "SI units")
   end subroutine faults_have_places

   !> Check that a case is refused with a message that has this beginning and contains `part`
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

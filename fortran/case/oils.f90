! SPDX-License-Identifier: BSD-3-Clause
!> Oils by name: constants as their sources print them, in the units of the keys of &lubricant. The one place that has them:
!> `ehl` reads them here, `pyehl` by ehl_f2py_lubricant.
module ehl_oils
   use ehl_kinds, only: dp
   use ehl_text, only: newline, to_text
   implicit none (type, external)
   private
   public :: oil_t, oil_named, oil_names, oils_text

   !> A key of &lubricant, its value, and where that stands
   type :: constant_t
      character(len=24) :: key = ""
      real(dp) :: value = 0.0_dp
      character(len=48) :: place = ""
   end type constant_t

   !> An oil
   type :: oil_t
      character(len=32) :: name = "", viscosity_law = ""
      character(len=:), allocatable :: title, source, range
      type(constant_t), allocatable :: constants(:)
   end type oil_t

   character(len=8), parameter :: oil_names(3) = [character(len=8) :: "fva3", "n100", "pao100"]

   character(len=*), parameter :: wingertszahn = "Wingertszahn, Koch, Maccioni, Concli & Sauer 2023, Lubricants 11, 369", &
      arana = "Arana, Larranaga & Ulacia 2019, Proc. IMechE J 233, 303, after measurements of Mann 1995", &
      no_range = "the source does not state the range of the measurements; it applies them at 42 and 50 degC", &
      mann_range = "the source names states from 25 to 60 degC and up to 510 MPa, and does not tell the whole range"
   !> K that a constant for theta in K is shifted by
   real(dp), parameter :: kelvin = 273.15_dp

contains

   !> An oil of oil_names
   pure function oil_named(name) result(oil)
      character(len=*), intent(in) :: name
      type(oil_t) :: oil

      oil%name = name
      oil%viscosity_law = "dicke"
      select case (name)
      case ("fva3")
         oil%title = "FVA reference oil 3, mineral, ISO VG 100"
         oil%source = wingertszahn
         oil%range = no_range
         oil%constants = [constant_t("vogel_viscosity", 0.062e-3_dp, "Table A1, K"), &
                          constant_t("vogel_b", 1021.7_dp, "Table A1, B"), &
                          constant_t("vogel_c", 101.5517_dp, "Table A1, C"), &
                          constant_t("dicke_a1", 327.7918e5_dp, "Table A1"), &
                          constant_t("dicke_a2", 2.9862e5_dp, "Table A1"), &
                          constant_t("dicke_b1", 4.419e-3_dp, "Table A1"), &
                          constant_t("dicke_b2", 3.0115e-4_dp, "Table A1"), &
                          constant_t("density_15", 887.6_dp, "Table A1"), &
                          constant_t("thermal_expansion", 6.0e-4_dp/0.8876_dp, "Table A1, 6e-4 g/(ml K)"), &
                          constant_t("thermal_conductivity", 0.134_dp, "Table A1")]
      case ("n100")
         oil%title = "N100 of Mann, naphthenic mineral base oil, ISO VG 100"
         oil%source = arana
         oil%range = mann_range
         oil%constants = [constant_t("kinematic_viscosity_40", 97.9_dp, "Table 2"), &
                          constant_t("kinematic_viscosity_100", 8.61_dp, "Table 2"), &
                          constant_t("density_15", 900.0_dp, "Table 2, at 15.6 degC"), &
                          constant_t("dicke_a1", -7.23e7_dp + 3.48e5_dp*kelvin, "Table 3, a1 + a2 273.15 K"), &
                          constant_t("dicke_a2", 3.48e5_dp, "Table 3"), &
                          constant_t("dicke_b1", 5.00e-3_dp - 1.83e-5_dp*kelvin, "Table 3, b1 + b2 273.15 K"), &
                          constant_t("dicke_b2", -1.83e-5_dp, "Table 3"), &
                          constant_t("limiting_coefficient", 0.053_dp, "Table 2, after Hoglund 1999"), &
                          constant_t("range_temperature_min", 25.0_dp, "states named in the text"), &
                          constant_t("range_temperature_max", 60.0_dp, "states named in the text"), &
                          constant_t("range_pressure_max", 5.1e8_dp, "states named in the text")]
      case ("pao100")
         oil%title = "PAO100 of Mann, polyalphaolefin base oil, ISO VG 100"
         oil%source = arana
         oil%range = mann_range
         oil%constants = [constant_t("kinematic_viscosity_40", 94.1_dp, "Table 2"), &
                          constant_t("kinematic_viscosity_100", 14.0_dp, "Table 2"), &
                          constant_t("density_15", 840.0_dp, "Table 2, at 15.6 degC"), &
                          constant_t("dicke_a1", -5.73e7_dp + 3.90e5_dp*kelvin, "Table 3, a1 + a2 273.15 K"), &
                          constant_t("dicke_a2", 3.90e5_dp, "Table 3"), &
                          constant_t("dicke_b1", -39.5e-3_dp + 23.54e-5_dp*kelvin, "Table 3, b1 + b2 273.15 K"), &
                          constant_t("dicke_b2", 23.54e-5_dp, "Table 3"), &
                          constant_t("limiting_coefficient", 0.035_dp, "Table 2, after Hoglund 1999"), &
                          constant_t("range_temperature_min", 25.0_dp, "states named in the text"), &
                          constant_t("range_temperature_max", 60.0_dp, "states named in the text"), &
                          constant_t("range_pressure_max", 5.1e8_dp, "states named in the text")]
      case default
         allocate (oil%constants(0))
      end select
   end function oil_named

   !> All oils as text: a line 'name, law, title, source, range' with tabs between, then one 'name, key, value, place' for each
   !> constant
   function oils_text() result(text)
      character(len=:), allocatable :: text
      character(len=1), parameter :: tab = achar(9)
      type(oil_t) :: oil
      integer :: i, k

      text = ""
      do i = 1, size(oil_names)
         oil = oil_named(trim(oil_names(i)))
         text = text//trim(oil%name)//tab//trim(oil%viscosity_law)//tab//oil%title//tab//oil%source//tab//oil%range//newline
         do k = 1, size(oil%constants)
            associate (c => oil%constants(k))
               text = text//trim(oil%name)//tab//trim(c%key)//tab//to_text(c%value)//tab//trim(c%place)//newline
            end associate
         end do
      end do
   end function oils_text
end module ehl_oils

! SPDX-License-Identifier: BSD-3-Clause
!> The lubricant of a case: defaults that depend on other keys, and laws that need them
module ehl_case_lubricant
   use ehl_case, only: case_t
   use ehl_case_contact, only: hertz_pressure
   use ehl_kinds, only: dp
   use ehl_schema, only: schema_t
   use ehl_status, only: status_t
   use ehl_text, only: short
   implicit none (type, external)
   private
   public :: check_boundary_film, check_shear_law, complete_lubricant

   !> Roelands exponents of liquids: water has 0.04, mineral oils 0.6
   real(dp), parameter :: least_z = 1.0e-3_dp, largest_z = 2.0_dp

contains

   !> Roelands exponent from viscosity, alpha and p0 unless given; the PSD model's viscosity law
   subroutine complete_lubricant(schema, input, status)
      type(schema_t), intent(in) :: schema
      type(case_t), intent(inout) :: input
      type(status_t), intent(inout) :: status

      associate (l => input%lubricant)
         if (.not. schema%given("lubricant", "roelands_z")) then
            l%roelands_z = l%pressure_viscosity*l%roelands_p0/(log(l%viscosity) + 9.67_dp)
         end if
         if (input%psd%viscosity_law == "") input%psd%viscosity_law = l%viscosity_law
         if (all(input%psd%viscosity_law /= [character(len=32) :: "roelands", "barus", l%viscosity_law])) then
            call schema%refuse("psd.viscosity_law", "psd.viscosity_law = '" // trim(input%psd%viscosity_law) &
                               // "' with lubricant.viscosity_law = '" // trim(l%viscosity_law) // "'", &
                               "'roelands', 'barus' or that of the lubricant", status)
         end if
         if (l%viscosity_law == "roelands" .or. input%psd%viscosity_law == "roelands") call check_roelands(schema, input, status)
      end associate
   end subroutine complete_lubricant

   !> Refuse an exponent that no liquid has, at the key that it is from; a law without it is the way out
   subroutine check_roelands(schema, input, status)
      type(schema_t), intent(in) :: schema
      type(case_t), intent(in) :: input
      type(status_t), intent(inout) :: status
      character(len=22) :: sources(5)
      character(len=:), allocatable :: what, at
      integer :: k

      associate (l => input%lubricant)
         ! without alpha the law has nothing to say
         if (.not. l%pressure_viscosity > 0.0_dp .or. (l%roelands_z >= least_z .and. l%roelands_z <= largest_z)) return
         ! a small one mostly has its reason in alpha, a large one in the viscosity
         sources = [character(len=22) :: "roelands_z", "pressure_viscosity", "viscosity", "kinematic_viscosity_40", "roelands_p0"]
         if (l%roelands_z > largest_z) sources(2:4) = sources([3, 4, 2])
         at = "roelands_z"
         do k = size(sources), 1, -1
            if (schema%given("lubricant", trim(sources(k)))) at = trim(sources(k))
         end do
         what = "lubricant.roelands_z = "//short(l%roelands_z)
         if (at /= "roelands_z") what = what//" follows from viscosity, pressure_viscosity and roelands_p0"
         call schema%refuse("lubricant."//at, what, "a number in [0.001, 2] under Roelands' law; or viscosity_law = 'barus', "// &
                            "which has no roelands_z", status)
      end associate
   end subroutine check_roelands

   !> Parameters of the shear law; a law with a stress needs a contact in SI units
   subroutine check_shear_law(schema, input, status)
      type(schema_t), intent(in) :: schema
      type(case_t), intent(in) :: input
      type(status_t), intent(inout) :: status

      associate (l => input%lubricant)
         if (l%limiting_stress > 0.0_dp .and. schema%given("lubricant", "limiting_coefficient")) then
            call schema%contradict("lubricant.limiting_stress", "lubricant.limiting_coefficient", &
                                   "one of the two, or limiting_stress = 0.0", status)
            return
         end if
         if (l%shear_law == "newtonian") return
         if (.not. input%contact%si) then
            call schema%refuse("lubricant.shear_law", "lubricant.shear_law = '" // trim(l%shear_law) &
                               // "' with a contact given by moes_m and moes_l, which has no sliding speed in m/s", &
                               "'newtonian', or load, mean_velocity, radius and reduced_modulus", status)
         else if (l%shear_law == "carreau" .and. .not. (l%carreau_stress > 0.0_dp .and. l%carreau_exponent > 0.0_dp)) then
            call schema%refuse("lubricant.shear_law", "lubricant.shear_law = 'carreau' without " &
                               // "carreau_stress and carreau_exponent", "both, as measured for the oil: no two oils share them", &
                               status)
         end if
      end associate
   end subroutine check_shear_law

   !> A boundary film needs a contact in SI units; its friction and a hardness need it. Smooth bodies must be able to carry the
   !> load below the hardness.
   subroutine check_boundary_film(schema, input, status)
      type(schema_t), intent(in) :: schema
      type(case_t), intent(in) :: input
      type(status_t), intent(inout) :: status
      real(dp) :: pressure

      pressure = hertz_pressure(input)
      associate (l => input%lubricant, hardness => input%contact%hardness)
         if (l%boundary_friction > 0.0_dp .and. .not. l%boundary_film > 0.0_dp) then
            call schema%refuse("lubricant.boundary_friction", "lubricant.boundary_friction = " &
                               // short(l%boundary_friction) // " without lubricant.boundary_film: no bodies touch", &
                               "a boundary_film in m, or boundary_friction = 0.0", status)
         else if (hardness > 0.0_dp .and. .not. l%boundary_film > 0.0_dp) then
            call schema%refuse("contact.hardness", "contact.hardness = " // short(hardness) &
                               // " without lubricant.boundary_film: no bodies touch", &
                               "a boundary_film in m, or hardness = 0.0", status)
         else if (l%boundary_film > 0.0_dp .and. .not. input%contact%si) then
            call schema%refuse("lubricant.boundary_film", "lubricant.boundary_film = " // short(l%boundary_film) &
                               // " with a contact given by moes_m and moes_l, which has no size in m", &
                               "0.0, or load, mean_velocity, radius and reduced_modulus", status)
         else if (hardness > 0.0_dp .and. .not. hardness > pressure) then
            call schema%refuse("contact.hardness", "contact.hardness = " // short(hardness) // " Pa, and the Hertz pressure is " &
                               // short(pressure) // " Pa: smooth bodies would yield", &
                               "more than the Hertz pressure, a lower load, or 0.0 for elastic solids", status)
         else if (l%boundary_film > 0.0_dp .and. input%solver%coarsening == "alcouffe") then
            call schema%contradict("lubricant.boundary_film", "solver.coarsening", &
                                   "coarsening = 'auto' or 'classical'", status, &
                                   "transfers by the conductance do not converge where bodies touch")
         end if
      end associate
   end subroutine check_boundary_film
end module ehl_case_lubricant

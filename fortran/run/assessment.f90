! SPDX-License-Identifier: BSD-3-Clause
!> What a result is worth to an engineer: one line from its summary, of a solution or a prediction
module ehl_assessment
   use ehl_kinds, only: dp, pi
   use ehl_record, only: record_t
   use ehl_resolution, only: no_inlet
   use ehl_text, only: fixed, percent, short => rounded, to_text
   use ehl_touching, only: much_supplied
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   implicit none (type, external)
   private
   public :: judge, holds, with_care, no_result

   !> What a result is worth
   integer, parameter :: holds = 0, with_care = 1, no_result = 2

   !> Pressure [Pa] from which bearing steel keeps a dent of 1e-4 of the diameter of the ball (ISO 76:2006); the solids
   !> of the model stay elastic
   real(dp), parameter :: yields = 4.2e9_dp
   !> Film [m] of the size of the layers that additives leave on steel and of what a scan does not show
   real(dp), parameter :: molecular = 10.0e-9_dp
   !> Film over roughness below which surfaces count as touching, and from which they do not (Tallian 1967)
   real(dp), parameter :: touching = 1.0_dp, apart = 3.0_dp
   !> A result whose error is a larger share of it is not well known
   real(dp), parameter :: well_known = 0.05_dp
   !> Correlation of two surfaces above which they are no pair of independent ones
   real(dp), parameter :: alike = 0.5_dp
   !> Status of a prediction whose film is known, and whose pressures are beyond the model
   character(len=*), parameter :: beyond = "beyond linear response"
   !> Flash temperature [K] above which an oil is thinner than computed, where its heat is left out
   real(dp), parameter :: hot = 10.0_dp
   !> Contact radius and film over the radius of curvature from which the theory of small ones is named, and mean strain over
   !> the former (Tabor 1951)
   real(dp), parameter :: slender_contact = 0.1_dp, slender_film = 0.01_dp, mean_strain = 0.2_dp

contains

   !> A word and the reason for it: 'no result', 'film breakdown', 'beyond the solids', 'unresolved inlet', 'mixed film',
   !> 'yielding solids',
   !> 'thin film', 'unresolved waves' or 'full film', then what else there is to know
   subroutine judge(summary, text, worth)
      type(record_t), intent(in) :: summary
      character(len=:), allocatable, intent(out) :: text
      integer, intent(out) :: worth
      character(len=:), allocatable :: status, doubts, rest
      logical :: breaks

      status = summary%text("status")
      worth = no_result
      ! a run whose smooth contact is solved
      breaks = status == "film breakdown" .or. (status == "negative film" .and. ieee_is_finite(summary%number("H_c")))
      if (breaks) then
         text = "film breakdown: "//summary%text("message")
      else if (all(status /= [character(len=len(beyond)) :: "converged", "predicted", "target missed", beyond])) then
         text = "no result: the status is '"//status//"'"
         if (summary%text("message") /= "") text = text//": "//summary%text("message")
      else
         worth = with_care
         doubts = of_pressure(summary)//of_contact(summary)//of_yielding(summary)//of_waves(summary)
         rest = of_errors(summary)//of_heat(summary)//of_two_alike(summary)//of_slenderness(summary)
         if (summary%text("surface_findings") /= "") rest = rest//"the map is not roughness alone: "// &
                                                         summary%text("surface_findings")//"; "
         if (status == "target missed") rest = "grid.target_error is missed; "//rest
         if (status == beyond) rest = "mu_r/mu_s is not known: "//summary%text("message")//"; "//rest
         if (doubts /= "") then
            text = doubts(:len(doubts) - 2)
         else
            text = "full film: "//minimum_film(summary)
            if (rest == "") worth = holds
         end if
         if (rest /= "") text = text//"; but "//rest(:len(rest) - 2)
      end if
   end subroutine judge

   !> A pressure at which the solids yield; of all these functions: nothing, or a text that ends in '; '
   function of_pressure(summary) result(text)
      type(record_t), intent(in) :: summary
      character(len=:), allocatable :: text
      real(dp) :: pressure

      text = ""
      if (summary%has("load_share_at_hardness")) return
      ! a comparison with NaN is false
      pressure = summary%number("p_max_Pa")
      if (larger(summary%number("p_max_rough_Pa"), 0.0_dp)) pressure = summary%number("p_max_rough_Pa")
      if (larger(pressure, yields)) text = "beyond the solids: the pressure reaches "//short(pressure*1.0e-9_dp)// &
         " GPa, bearing steel yields above "//short(yields*1.0e-9_dp, 2)//" GPa (ISO 76), and the solids of the model do not; "
   end function of_pressure

   !> Bodies that touch at a boundary film, or a film that is thin
   function of_contact(summary) result(text)
      type(record_t), intent(in) :: summary
      character(len=:), allocatable :: text

      if (.not. larger(summary%number("contact_load_share"), 0.0_dp)) then
         text = of_film(summary)
         if (index(summary%text("H_c_error_note"), no_inlet) == 1) text = "unresolved inlet: "//summary%text("H_c_error_note")//"; "
         return
      end if
      text = "mixed film: "//percent(summary%number("contact_load_share"))//" of the load is carried at the boundary film, "
      if (ieee_is_finite(summary%number("contact_load_share_error"))) then
         text = text//"with an error of "//percent(summary%number("contact_load_share_error"))//" of the load; "
      else
         text = text//"with an error that is not known; "
      end if
      if (larger(summary%number("layer_supply"), much_supplied)) text = text//"the layer would have to give "// &
         percent(summary%number("layer_supply"))//" of the flow, where the model ends; "
   end function of_contact

   !> Solids that yield at their hardness
   function of_yielding(summary) result(text)
      type(record_t), intent(in) :: summary
      character(len=:), allocatable :: text

      text = ""
      if (larger(summary%number("load_share_at_hardness"), 0.0_dp)) text = "yielding solids: "// &
         percent(summary%number("load_share_at_hardness"))//" of the load is carried at their hardness, and they give way by "// &
         "up to "//short(summary%number("plastic_depth_max_m")*1.0e9_dp)//" nm, as in a first pass; "
   end function of_yielding

   !> A film that is thin beside molecules or beside the roughness
   function of_film(summary) result(text)
      type(record_t), intent(in) :: summary
      character(len=:), allocatable :: text
      real(dp) :: ratio

      text = ""
      if (larger(molecular, least(summary))) text = "thin film: "//minimum_film(summary)//", below "// &
         short(molecular*1.0e9_dp, 2)//" nm, where additives and what a scan does not show count, and asperities may touch; "
      ratio = summary%number("lambda_ratio")
      if (text == "" .and. larger(touching, ratio)) text = "thin film: Lambda = "//short(ratio)//" is below "// &
         short(touching, 1)//" for the undeformed roughness; "//minimum_film(summary)//"; "
   end function of_film

   !> Waves that the grid does not resolve
   function of_waves(summary) result(text)
      type(record_t), intent(in) :: summary
      character(len=:), allocatable :: text
      real(dp) :: part

      text = ""
      if (.not. summary%has("mu_ratio_unresolved")) return
      part = summary%number("mu_ratio_unresolved")
      if (ieee_is_finite(part)) then
         part = abs(part)/summary%number("mu_ratio")
         if (larger(part, well_known)) text = "unresolved waves: they hold "//percent(part)//" of mu_r/mu_s by prediction, "// &
            "give grid.points more nodes; "
      else
         part = summary%number("variance_unresolved")
         if (larger(part, well_known)) text = "unresolved waves: they hold "//percent(part)//" of the variance of the "// &
            "surface, give grid.points more nodes; "
      end if
   end function of_waves

   !> Errors that are large or not known, and a point outside of what a model was measured on
   function of_errors(summary) result(text)
      type(record_t), intent(in) :: summary
      character(len=:), allocatable :: text
      character(len=*), parameter :: names(3) = [character(len=8) :: "H_c", "H_min", "mu_ratio"]
      character(len=:), allocatable :: name, error, word
      real(dp) :: share
      integer :: k

      text = ""
      do k = 1, size(names)
         name = trim(names(k))
         if (.not. ieee_is_finite(summary%number(name))) cycle
         word = name
         if (name == "mu_ratio") word = "mu_r/mu_s"
         error = name//"_error"
         if (summary%has(name//"_model_error")) error = name//"_model_error"
         share = summary%number(error)/abs(summary%number(name))
         if (.not. ieee_is_finite(share)) then
            text = text//"the error of "//word//" is not known; "
         else if (share > well_known) then
            text = text//word//" is known to "//percent(share)//" only; "
         end if
      end do
      if (index(summary%text("pressure_viscosity_note"), "estimate") > 0) then
         text = text//"alpha is an estimate (-17 to +12 % of the film); "
      else if (summary%text("pressure_viscosity_note") /= "") then
         text = text//"alpha is that of another oil; "
      end if
      if (summary%text("outside_range") /= "") text = text//summary%text("outside_range")//" outside of the range of the "// &
         "response; "
   end function of_errors

   !> Heat that is left out
   function of_heat(summary) result(text)
      type(record_t), intent(in) :: summary
      character(len=:), allocatable :: text
      real(dp) :: rise

      text = ""
      rise = summary%number("flash_temperature_K")
      if (.not. larger(rise, hot) .or. ieee_is_finite(summary%number("temperature_rise_max_K"))) return
      text = "the surfaces warm by "//short(rise)//" K, and the oil of the model does not; "
   end function of_heat

   !> Two surfaces that move together and are much the same
   function of_two_alike(summary) result(text)
      type(record_t), intent(in) :: summary
      character(len=:), allocatable :: text

      text = ""
      if (larger(abs(summary%number("surface_correlation")), alike)) text = "the two surfaces move together and are alike "// &
         "(correlation "//fixed(summary%number("surface_correlation"), "f9.2")//"), so that their waves add up; "
   end function of_two_alike

   !> A contact that is wide, or a film that is thick, beside the radius: the half-space, the parabolas of its bodies and the
   !> Reynolds equation are for small ones. The mean strain of a dry contact is about 0.2 a/R (Tabor 1951).
   function of_slenderness(summary) result(text)
      type(record_t), intent(in) :: summary
      character(len=:), allocatable :: text
      real(dp) :: wide, thick

      text = ""
      wide = summary%number("film_scale_m")/summary%number("hertz_radius_m")
      thick = summary%number("h_c_m")/summary%number("hertz_radius_m")*wide
      if (summary%has("ellipticity")) wide = max(wide, wide*summary%number("ellipticity")*summary%number("radius_ratio"))
      if (larger(wide, slender_contact)) then
         text = "the contact radius is "//short(wide, 2)//" of the radius of curvature"
         if (.not. summary%has("ellipticity")) text = text//" (p_h/E' = "//short(wide/pi, 2)//")"
         text = text//", a strain of about "//percent(mean_strain*wide)//", and the half-space is for small strains; "
      end if
      if (larger(thick, slender_film)) text = text//"the film is "//short(thick, 2)//" of the radius, and the Reynolds "// &
         "equation is for slender gaps; "
   end function of_slenderness

   !> The minimum film in words
   function minimum_film(summary) result(text)
      type(record_t), intent(in) :: summary
      character(len=:), allocatable :: text
      real(dp) :: film, ratio

      film = least(summary)
      ratio = summary%number("lambda_ratio")
      if (ieee_is_finite(film) .and. ieee_is_finite(summary%number("h_min_rough_m"))) then
         text = "the minimum film over the roughness is "//short(film*1.0e9_dp)//" nm"
      else if (ieee_is_finite(film)) then
         text = "the minimum film is "//short(film*1.0e9_dp)//" nm"
         if (.not. summary%has("lambda_ratio")) text = text//": Lambda = "//short(apart, 1)// &
                                                        " with an rms roughness of "//short(film/apart*1.0e9_dp)//" nm"
      else
         text = "smooth surfaces; the case gives no size in metres"
         if (ieee_is_finite(ratio)) text = "Lambda = "//short(ratio)
      end if
   end function minimum_film

   !> Minimum film [m]: over the roughness where it is known
   real(dp) function least(summary)
      type(record_t), intent(in) :: summary

      least = summary%number("h_min_rough_m")
      if (.not. ieee_is_finite(least)) least = summary%number("h_min_m")
   end function least

   !> a > b, and false where one of them is not known
   pure logical function larger(a, b)
      real(dp), intent(in) :: a, b

      larger = .false.
      if (ieee_is_finite(a) .and. ieee_is_finite(b)) larger = a > b
   end function larger
end module ehl_assessment

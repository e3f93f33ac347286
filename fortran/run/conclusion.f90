! SPDX-License-Identifier: BSD-3-Clause
!> What a run or a prediction ends with: a few lines for a person, from its summary
module ehl_conclusion
   use ehl_assessment, only: judge
   use ehl_kinds, only: dp
   use ehl_record, only: record_t
   use ehl_text, only: fixed, newline, to_text
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   implicit none (type, external)
   private
   public :: conclusion, resumption

   real(dp), parameter :: nanometres = 1.0e9_dp, gigapascals = 1.0e-9_dp

contains

   !> Names in the first 11 columns: films and pressure with their errors, in nm and GPa where the case has a size, friction,
   !> heat, and what all that is worth
   function conclusion(summary) result(text)
      type(record_t), intent(in) :: summary
      character(len=:), allocatable :: text
      character(len=:), allocatable :: assessment
      integer :: worth

      text = film("c", "")//film("min", rough_film())//pressure()//lambda()//ratio()//friction()//heat()
      call judge(summary, assessment, worth)
      text = text//"assessment "//assessment

   contains

      !> Whether a number is there
      pure logical function known(name)
         character(len=*), intent(in) :: name
         known = ieee_is_finite(summary%number(name))
      end function known

      !> What the error of a value is of, in parentheses; empty where the error is not known
      function of(source, error)
         character(len=*), intent(in) :: source, error
         character(len=:), allocatable :: of
         of = ""
         if (known(error)) of = " ("//source//")"
      end function of

      !> Central or minimum film
      function film(which, more)
         character(len=*), intent(in) :: which, more
         character(len=:), allocatable :: film
         character(len=:), allocatable :: in_metres

         film = ""
         in_metres = ""
         if (known("h_"//which//"_m")) then
            in_metres = with_error(summary%number("h_"//which//"_m")*nanometres, &
                                   summary%number("h_"//which//"_error_m")*nanometres, "f10.2", " nm")
         end if
         if (known("H_"//which)) then
            film = "H_"//which//repeat(" ", 9 - len(which))// &
                   with_error(summary%number("H_"//which), summary%number("H_"//which//"_error"), "f10.6", "")
            if (in_metres /= "") film = film//", h_"//which//" "//in_metres
            if (summary%text("error_estimate") == "a priori") then
               film = film//" (grid, a priori)"
            else
               film = film//of("grid", "H_"//which//"_error")
            end if
         else if (in_metres /= "") then
            film = "h_"//which//repeat(" ", 9 - len(which))//in_metres//of("grid", "h_"//which//"_error_m")//", smooth contact"
         end if
         if (film /= "") film = film//more//newline
      end function film

      !> The minimum film of the rough contact, where it is known
      function rough_film()
         character(len=:), allocatable :: rough_film

         rough_film = ""
         if (known("h_min_rough_m")) then
            rough_film = "; rough "//fixed(summary%number("h_min_rough_m")*nanometres, "f10.2")//" nm"
            if (known("h_min_rough_error_m")) rough_film = "; rough "//with_error(summary%number("h_min_rough_m")*nanometres, &
               summary%number("h_min_rough_error_m")*nanometres, "f10.2", " nm")//of("model", "h_min_rough_error_m")
         else if (known("H_min_rough")) then
            rough_film = "; rough "//fixed(summary%number("H_min_rough"), "f10.6")
         end if
      end function rough_film

      !> The maximum pressures of the smooth and the rough contact
      function pressure()
         character(len=:), allocatable :: pressure, rise

         pressure = ""
         if (known("P_max")) then
            pressure = "p_max      "//with_error(summary%number("P_max"), summary%number("P_max_error"), "f10.4", " p_h")// &
                       of("grid", "P_max_error")
            if (known("p_max_Pa")) pressure = pressure//", "//giga("p_max_Pa")
            if (known("p_max_rough_Pa")) then
               pressure = pressure//"; rough "//giga("p_max_rough_Pa")
            else if (known("P_max_rough")) then
               pressure = pressure//"; rough "//fixed(summary%number("P_max_rough"), "f10.4")//" p_h"
            end if
         else if (known("p_max_Pa")) then
            pressure = "p_max      "//giga("p_max_Pa")
            if (known("p_max_rough_Pa")) pressure = pressure//"; rough "//giga("p_max_rough_Pa")
         else if (known("h_c_m")) then
            pressure = "p_h        "//giga("hertz_pressure_Pa")
         end if
         ! of a prediction
         if (known("p_rise_max_Pa")) then
            rise = with_error(summary%number("p_rise_max_Pa")*gigapascals, summary%number("p_rise_max_error_Pa")*gigapascals, &
                              "f10.4", " GPa above the smooth contact")//of("model", "p_rise_max_error_Pa")
            if (pressure == "") pressure = "p_max      not known"
            pressure = pressure//merge("; rough ", ", up to ", known("p_max_Pa") .and. .not. known("p_max_rough_Pa"))//rise
         end if
         if (pressure /= "") pressure = pressure//newline
      end function pressure

      !> A pressure in GPa
      function giga(name)
         character(len=*), intent(in) :: name
         character(len=:), allocatable :: giga
         giga = fixed(summary%number(name)*gigapascals, "f10.4")//" GPa"
      end function giga

      !> Film over roughness
      function lambda()
         character(len=:), allocatable :: lambda

         lambda = ""
         if (.not. known("lambda_ratio")) return
         lambda = "Lambda     "//fixed(summary%number("lambda_ratio"), "f9.3")//" (h_c/sigma "// &
                  fixed(summary%number("lambda_ratio_central"), "f9.3")//"), smooth films over undeformed roughness"//newline
      end function lambda

      !> Friction ratio, and why its error is not known; of a prediction first the mean over the tracks of the surface
      function ratio()
         character(len=:), allocatable :: ratio
         character(len=:), allocatable :: error, source

         ratio = ""
         if (.not. known("mu_ratio")) return
         error = "mu_ratio_error"
         source = "grid"
         if (summary%has("mu_ratio_model_error")) then
            error = "mu_ratio_model_error"
            source = "model"
         end if
         ratio = with_error(summary%number("mu_ratio"), summary%number(error), "f9.5", "")//of(source, error)
         if (known("mu_ratio_tracks")) then
            if (nint(summary%number("tracks")) > 1) ratio = &
               with_error(summary%number("mu_ratio_tracks"), summary%number("mu_ratio_tracks_spread"), "f9.5", "", 3)// &
               " (mean and scatter over "//to_text(nint(summary%number("tracks")))//" tracks); on the track of the case "//ratio
         end if
         ratio = "mu_r/mu_s  "//ratio
         if (summary%text("mu_ratio_error_note") /= "") ratio = ratio//": "//summary%text("mu_ratio_error_note")
         ratio = ratio//newline
      end function ratio

      !> Coefficient of friction with the law that it is by, or why there is none
      function friction()
         character(len=:), allocatable :: friction

         friction = ""
         if (known("mu")) then
            friction = "mu         "//fixed(summary%number("mu"), "f9.5")
            if (summary%has("mu_ratio") .and. known("mu_smooth")) friction = friction//", smooth contact "// &
               fixed(summary%number("mu_smooth"), "f9.5")
         else if (known("mu_smooth")) then
            friction = "mu         smooth contact "//fixed(summary%number("mu_smooth"), "f9.5")
         else if (summary%text("mu_note") /= "" .and. (known("H_c") .or. known("h_c_m"))) then
            friction = "mu         none: "//summary%text("mu_note")//newline
            return
         end if
         if (friction /= "") friction = friction//"; law '"//summary%text("shear_law")//"'"//newline
      end function friction

      !> Rises of temperature
      function heat()
         character(len=:), allocatable :: heat

         heat = ""
         if (known("temperature_rise_max_K")) heat = "film "//fixed(summary%number("temperature_rise_max_K"), "f9.1")//" K"
         if (known("flash_temperature_K")) then
            if (heat /= "") heat = heat//", "
            heat = heat//"surfaces "//fixed(summary%number("flash_temperature_K"), "f9.1")//" K (flash temperature)"
         end if
         if (heat /= "") heat = "heat       "//heat//" warmer"//newline
      end function heat
   end function conclusion

   !> How a run with this status can go on, up to the name of its result folder; empty where it would end the same way
   function resumption(status, program) result(text)
      character(len=*), intent(in) :: status
      !> As a person calls it
      character(len=*), intent(in) :: program
      character(len=:), allocatable :: text

      select case (status)
      case ("interrupted", "failed")
         text = "to resume: "//program//" --resume "
      case ("not settled")
         text = "to go on with a larger time.max_periods or time.steps (--set): "//program//" --resume "
      case ("cycle limit")
         text = "to go on with a larger solver.max_cycles (--set): "//program//" --resume "
      case default
         text = ""
      end select
   end function resumption

   !> A value with its error to two digits, or to so many, and as many digits itself: '1.185 +- 0.048',
   !> '2.6435E-06 +- 5.5E-09'
   function with_error(value, error, plain, unit, digits) result(text)
      real(dp), intent(in) :: value, error
      !> Edit descriptor of a value whose error is not known
      character(len=*), intent(in) :: plain, unit
      integer, intent(in), optional :: digits
      character(len=:), allocatable :: text
      character(len=:), allocatable :: form
      !> Values below that have an exponent
      real(dp), parameter :: small = 1.0e-4_dp
      integer :: decimals

      if (.not. ieee_is_finite(error)) then
         text = fixed(value, plain)//unit//", error not known"
         return
      end if
      decimals = 1
      if (present(digits)) decimals = digits - 1
      decimals = max(0, decimals - floor(log10(max(abs(error), 1.0e-9_dp*abs(value), tiny(error)))))
      if (abs(value) < small .and. abs(value) > 0.0_dp) then
         form = "es24."//to_text(min(15, max(1, decimals + floor(log10(abs(value))))))
         text = in_form(value, form)//" +- "//in_form(error, "es8.1")//unit
         return
      end if
      form = "f24."//to_text(min(9, decimals))
      text = without_point(in_form(value, form))//" +- "//without_point(in_form(error, form))//unit
   end function with_error

   !> A number by an edit descriptor, as it stands
   pure function in_form(x, form) result(text)
      real(dp), intent(in) :: x
      character(len=*), intent(in) :: form
      character(len=:), allocatable :: text
      character(len=32) :: buffer

      write (buffer, "("//form//")") x
      text = trim(adjustl(buffer))
   end function in_form

   !> A number without a point at its end
   pure function without_point(number) result(text)
      character(len=*), intent(in) :: number
      character(len=:), allocatable :: text
      text = number(:len(number) - merge(1, 0, number(len(number):) == "."))
   end function without_point
end module ehl_conclusion

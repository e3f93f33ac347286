! SPDX-License-Identifier: BSD-3-Clause
!> What a run ends with: a few lines for a person, from its summary
module ehl_conclusion
   use ehl_kinds, only: dp
   use ehl_record, only: record_t
   use ehl_text, only: fixed, newline, to_text
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   implicit none (type, external)
   private
   public :: conclusion

   real(dp), parameter :: nanometres = 1.0e9_dp

contains

   !> Films with their errors, in nm where the case has a size; friction and film over roughness where there are any
   function conclusion(summary) result(text)
      type(record_t), intent(in) :: summary
      character(len=:), allocatable :: text
      character(len=:), allocatable :: none
      real(dp) :: mu

      none = "none: the run ended with the status '"//summary%text("status")//"'"
      if (.not. ieee_is_finite(summary%number("H_c"))) then
         text = "H_c        "//none
         if (summary%text("H_c_error_note") /= "") text = text//newline//"           "//summary%text("H_c_error_note")
         return
      end if
      text = film("c", "")//newline//film("min", rough_film())
      if (summary%has("mu_ratio")) text = text//newline//ratio()
      mu = summary%number("mu")
      if (ieee_is_finite(mu)) then
         text = text//newline//"mu         "//fixed(mu, "f9.5")
         if (summary%has("mu_ratio")) text = text//", smooth contact "//fixed(summary%number("mu_smooth"), "f9.5")
      end if
      if (summary%has("lambda_ratio")) text = text//newline//"Lambda     h_min/sigma "// &
                                              fixed(summary%number("lambda_ratio"), "f9.3")//", h_c/sigma "// &
                                              fixed(summary%number("lambda_ratio_central"), "f9.3")//", smooth films"

   contains

      !> Central or minimum film
      function film(which, more)
         character(len=*), intent(in) :: which, more
         character(len=:), allocatable :: film
         real(dp) :: scale, value, error

         value = summary%number("H_"//which)
         error = summary%number("H_"//which//"_error")
         film = "H_"//which//repeat(" ", 9 - len(which))//with_error(value, error, "f10.6")
         if (summary%has("film_scale_m")) then
            scale = summary%number("film_scale_m")*nanometres
            film = film//", h_"//which//" "//with_error(value*scale, error*scale, "f10.2")//" nm"
         end if
         if (summary%text("error_estimate") == "a priori") film = film//" (error a priori)"
         film = film//more
      end function film

      !> The least film of the rough contact, where it is known
      function rough_film()
         character(len=:), allocatable :: rough_film

         rough_film = ""
         if (.not. ieee_is_finite(summary%number("H_min_rough"))) return
         rough_film = "; rough "//fixed(summary%number("H_min_rough"), "f10.6")
         if (summary%has("h_min_rough_m")) then
            rough_film = "; rough "//fixed(summary%number("h_min_rough_m")*nanometres, "f10.2")//" nm"
         end if
      end function rough_film

      !> Friction ratio
      function ratio()
         character(len=:), allocatable :: ratio

         ratio = "mu_r/mu_s  "
         if (.not. ieee_is_finite(summary%number("mu_ratio"))) then
            ratio = ratio//none
            return
         end if
         ratio = ratio//with_error(summary%number("mu_ratio"), summary%number("mu_ratio_error"), "f9.5")
         if (summary%text("mu_ratio_error_note") /= "") ratio = ratio//": "//summary%text("mu_ratio_error_note")
      end function ratio
   end function conclusion

   !> A value with its error to two digits, and as many digits itself: '1.185 +- 0.048'
   function with_error(value, error, plain) result(text)
      real(dp), intent(in) :: value, error
      !> Edit descriptor of a value whose error is not known
      character(len=*), intent(in) :: plain
      character(len=:), allocatable :: text
      character(len=:), allocatable :: form

      if (.not. ieee_is_finite(error)) then
         text = fixed(value, plain)//", error not known"
         return
      end if
      form = "f24."//to_text(min(9, max(0, 1 - floor(log10(max(abs(error), tiny(error)))))))
      text = without_point(fixed(value, form))//" +- "//without_point(fixed(error, form))
   end function with_error

   !> A number without a point at its end
   pure function without_point(number) result(text)
      character(len=*), intent(in) :: number
      character(len=:), allocatable :: text
      text = number(:len(number) - merge(1, 0, number(len(number):) == "."))
   end function without_point
end module ehl_conclusion

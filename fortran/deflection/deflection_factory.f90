! SPDX-License-Identifier: BSD-3-Clause
!> From the name of a deflection engine to the engine
module ehl_deflection_factory
   use ehl_status, only: status_t, ehl_bad_input
   use ehl_deflection, only: deflection_t
   use ehl_fft, only: fft_deflection_t
   use ehl_mlmi, only: mlmi_deflection_t
   implicit none (type, external)
   private
   public :: new_deflection, deflection_engines

   !> The engines' names
   character(len=*), parameter :: deflection_engines(*) = [character(len=6) :: &
      "mlmi", "fft"]

contains

   !> Engine of a name, still to be set up for a grid
   subroutine new_deflection(engine, deflection, status)
      character(len=*), intent(in) :: engine
      class(deflection_t), allocatable, intent(out) :: deflection
      type(status_t), intent(inout) :: status

      select case (engine)
      case ("mlmi")
         allocate (mlmi_deflection_t :: deflection)
      case ("fft")
         allocate (fft_deflection_t :: deflection)
      case default
         call status%fail(ehl_bad_input, "deflection engine '"//trim(engine)// &
                          "' is not known: 'mlmi' or 'fft' was expected")
      end select
   end subroutine new_deflection
end module ehl_deflection_factory

! SPDX-License-Identifier: BSD-3-Clause
!> Creates a deflection engine by its name
module ehl_deflection_factory
   use ehl_status, only: status_t, ehl_bad_input
   use ehl_deflection, only: deflection_t
   use ehl_fft, only: fft_deflection_t
   use ehl_grid, only: grid_t
   use ehl_mlmi, only: mlmi_deflection_t
   use ehl_row_sum, only: row_sum_t
   implicit none (type, external)
   private
   public :: new_deflection, deflection_engines

   !> Names of the engines
   character(len=*), parameter :: deflection_engines(*) = [character(len=6) :: &
      "mlmi", "fft"]

   !> Number of nodes of a row up to which direct summation costs less than an FFT including its plans
   integer, parameter :: short = 1025

contains

   !> Create an engine by its name; it is not set up for a grid yet
   subroutine new_deflection(engine, deflection, status, grid)
      character(len=*), intent(in) :: engine
      class(deflection_t), allocatable, intent(out) :: deflection
      type(status_t), intent(inout) :: status
      !> The grid: for a short row the deflection is summed directly, whatever the engine
      type(grid_t), intent(in), optional :: grid

      if (present(grid)) then
         if (grid%is_row() .and. grid%nx <= short) then
            allocate (row_sum_t :: deflection)
            return
         end if
      end if
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

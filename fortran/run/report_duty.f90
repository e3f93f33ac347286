! SPDX-License-Identifier: BSD-3-Clause
!> Named results of a contact under a duty: extremes with their times and errors
module ehl_report_duty
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use ehl_contact_run, only: contact_run_t
   use ehl_kinds, only: dp, not_known
   use ehl_record, only: record_t
   use ehl_report_smooth, only: report_smooth
   use ehl_table, only: table_t
   implicit none (type, external)
   private
   public :: duty_history, duty_mean, report_duty

   !> Quantities whose extremes are reported: columns of the history, and units
   character(len=*), parameter :: quantities(6) = [character(len=5) :: "h_c", "h_min", "p_max", "mu", "power", "flash"], &
      units(6) = [character(len=3) :: "_m", "_m", "_Pa", "", "_W", "_K"]

contains

   !> History of a contact under a duty with the errors of its quantities: those of grid and domain from the smooth contact of the
   !> case, and those of the time steps
   subroutine duty_history(run, history)
      type(contact_run_t), intent(in) :: run
      type(table_t), intent(out) :: history
      type(record_t) :: steady
      !> Columns of the relative time-step errors, and names of the smooth results with grid errors
      character(len=*), parameter :: by_steps(3) = [character(len=14) :: "c_step_error", "min_step_error", "p_step_error"], &
         smooth(3) = [character(len=5) :: "H_c", "H_min", "P_max"]
      real(dp), allocatable :: values(:), steps(:), grid(:), power(:), radius(:), size_now(:)
      integer :: k

      history = run%history
      call report_smooth(steady, run%plan, run%smooth, run%level(), .true.)
      allocate (radius, source=history%column("radius_x"))
      allocate (size_now, source=run%plan%contact%growth(history%column("load"), 1.0_dp/radius))
      do k = 1, size(smooth)
         allocate (values, source=history%column(trim(quantities(k))//units(k)))
         allocate (steps, source=history%column(by_steps(k)))
         allocate (grid(size(values)), source=relative(trim(smooth(k))))
         ! the grid error in the inlet is proportional to h^2/H^(4/3) (inlet.f90), scaled by the present size of the contact
         if (k <= 2) grid = grid*max(1.0_dp, (steady%number(trim(quantities(k))//"_m")/(values*radius))**(4.0_dp/3.0_dp) &
                                     *size_now**(2.0_dp/3.0_dp))
         call history%add_column(trim(quantities(k))//"_error"//units(k), values*(steps + grid))
         deallocate (values, steps, grid)
      end do
      allocate (values, source=abs(history%column("mu"))*relative("F") + history%column("mu_step_error"))
      call history%add_column("mu_error", values)
      associate (s => run%plan%sliding)
         values = values*(s%load*s%mean_velocity)*history%column("load")*abs(history%column("slide"))
      end associate
      call history%add_column("power_error_W", values)
      ! the flash temperature is proportional to the power
      allocate (power, source=history%column("power_W"))
      where (abs(power) > 0.0_dp) values = values/power
      call history%add_column("flash_error_K", values*history%column("flash_K"))

   contains

      !> Relative error of a result of the smooth contact
      real(dp) function relative(name)
         character(len=*), intent(in) :: name

         relative = steady%number(name//"_error")/steady%number(name)
      end function relative
   end subroutine duty_history

   !> Extremes over the table, or over the last period of a periodic one; null unless the run reached its end
   subroutine report_duty(record, run, converged)
      type(record_t), intent(inout) :: record
      type(contact_run_t), intent(in) :: run
      logical, intent(in) :: converged
      type(table_t) :: history
      real(dp), allocatable :: time(:), values(:)
      logical, allocatable :: in_window(:)
      real(dp) :: found
      integer :: k

      call duty_history(run, history)
      associate (duty => run%plan%duty, t => run%transient)
         allocate (time, source=history%column("t_s"))
         allocate (in_window(size(time)), source=time >= begin(run, 1)*(1.0_dp - 1.0e-9_dp))
         do k = 1, size(quantities)
            if (k <= 2) call report_extreme("_min", trim(quantities(k)), trim(units(k)), -1.0_dp)
            call report_extreme(merge("    ", "_max", quantities(k) == "p_max"), trim(quantities(k)), trim(units(k)), 1.0_dp)
         end do
         if (run%plan%lubricant%boundary_film > 0.0_dp) call report_extreme("_max", "load_share", "", 1.0_dp)
         found = not_known
         if (converged .and. duty%periodic .and. duty%periods > 1) then
            found = change()
         end if
         if (duty%periodic) call record%set("duty_period_change", found)
         call record%set("duty_begin_s duty_end_s", [duty%begin(), duty%end_time()]*duty%time_scale)
         call record%set("T", t%time)
         call record%set("steps", t%step)
         call record%set("cycles_per_step", real(t%total_cycles, dp)/max(t%step, 1))
         call record%set("seconds_per_step", run%seconds/max(t%step, 1))
      end associate

   contains

      !> Report an extreme of a quantity with its time and error
      subroutine report_extreme(which, name, unit, direction)
         !> "_min", "_max", or blank if the name includes it
         character(len=*), intent(in) :: which, name, unit
         !> 1 for a maximum, -1 for a minimum
         real(dp), intent(in) :: direction
         real(dp) :: extreme(3)
         integer :: i

         values = history%column(name//unit)
         extreme = not_known
         ! NaN at one time: the extreme is not known
         if (converged .and. any(in_window) .and. all(.not. (ieee_is_nan(values) .and. in_window))) then
            i = maxloc(direction*values, dim=1, mask=in_window)
            extreme = [values(i), time(i), history%entry_of(name//"_error"//unit, i)]
         end if
         associate (title => "duty_"//name//trim(which))
            call record%set(title//unit//" "//title//"_t_s "//title//"_error"//unit, extreme)
         end associate
      end subroutine report_extreme

      !> Relative change of the mean central film between the last two periods
      real(dp) function change()
         real(dp) :: means(2)
         integer :: n

         associate (period => run%plan%duty%length()*run%plan%duty%time_scale)
            do n = 1, 2
               means(n) = mean(history, "h_c_m", begin(run, n), begin(run, n) + period)
            end do
         end associate
         change = abs(means(1)/means(2) - 1.0_dp)
      end function change
   end subroutine report_duty

   !> Mean of a column of the history over the table, or over the last period of a periodic one
   real(dp) function duty_mean(run, column)
      type(contact_run_t), intent(in) :: run
      character(len=*), intent(in) :: column

      duty_mean = mean(run%history, column, begin(run, 1), 0.5_dp*huge(1.0_dp))
   end function duty_mean

   !> Start of the last `periods` periods [s]
   pure real(dp) function begin(run, periods)
      type(contact_run_t), intent(in) :: run
      integer, intent(in) :: periods

      begin = 0.0_dp
      associate (duty => run%plan%duty)
         if (duty%periodic) begin = max(0.0_dp, (duty%end_time() - periods*duty%length())*duty%time_scale)
      end associate
   end function begin

   !> Mean of a column from time `first` to `last` [s] by the trapezoidal rule; with a single row the last value
   real(dp) function mean(history, column, first, last)
      type(table_t), intent(in) :: history
      character(len=*), intent(in) :: column
      real(dp), intent(in) :: first, last
      real(dp), allocatable :: time(:), values(:)
      real(dp) :: whole
      integer :: n

      allocate (time, source=history%column("t_s"))
      allocate (values, source=history%column(column))
      mean = 0.0_dp
      whole = 0.0_dp
      do n = 2, size(time)
         if (time(n - 1) < first*(1.0_dp - 1.0e-9_dp) .or. time(n) > last*(1.0_dp + 1.0e-9_dp)) cycle
         mean = mean + 0.5_dp*(values(n) + values(n - 1))*(time(n) - time(n - 1))
         whole = whole + time(n) - time(n - 1)
      end do
      if (whole > 0.0_dp) then
         mean = mean/whole
      else
         mean = values(size(values))
      end if
   end function mean
end module ehl_report_duty

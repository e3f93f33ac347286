! SPDX-License-Identifier: BSD-3-Clause
!> Results of a contact under a duty by name: extremes with their instants, errors
module ehl_report_duty
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use ehl_contact_run, only: contact_run_t
   use ehl_kinds, only: dp, not_known
   use ehl_record, only: record_t
   implicit none (type, external)
   private
   public :: report_duty

contains

   !> Extremes over the table, of a periodic one over the last period; null unless the run reached its end. After the results of
   !> the smooth contact, whose errors of films in the same proportion are those of the grid.
   subroutine report_duty(record, run, converged)
      type(record_t), intent(inout) :: record
      type(contact_run_t), intent(in) :: run
      logical, intent(in) :: converged
      !> Names of extremes, columns they are of, 1 for a largest and -1 for a least value
      character(len=*), parameter :: names(8) = [character(len=16) :: "duty_h_c_min", "duty_h_c_max", "duty_h_min_min", &
         "duty_h_min_max", "duty_p_max", "duty_mu_max", "duty_power_max", "duty_flash_max"], &
         columns(8) = [character(len=16) :: "h_c_m", "h_c_m", "h_min_m", "h_min_m", "p_max_Pa", "mu", "power_W", "flash_K"], &
         units(8) = [character(len=3) :: "_m", "_m", "_m", "_m", "_Pa", "", "_W", "_K"]
      real(dp), parameter :: signs(8) = [-1.0_dp, 1.0_dp, -1.0_dp, 1.0_dp, 1.0_dp, 1.0_dp, 1.0_dp, 1.0_dp]
      !> Smooth results, to which the relative grid errors of the extremes are equal
      character(len=*), parameter :: smooth(8) = [character(len=5) :: "H_c", "H_c", "H_min", "H_min", "P_max", "F", "F", "F"]
      !> Column of `errors` with that of the time steps
      integer, parameter :: by_steps(8) = [1, 1, 2, 2, 4, 3, 3, 3]
      real(dp), allocatable :: time(:), values(:), errors(:, :)
      logical, allocatable :: counts(:)
      real(dp) :: found, at, error
      integer :: k, i

      associate (duty => run%plan%duty, t => run%transient)
         allocate (time, source=run%history%column("t_s"))
         allocate (counts(size(time)), source=time >= from(1)*(1.0_dp - 1.0e-9_dp))
         allocate (errors(size(time), 4))
         errors(:, 1) = run%history%column("c_step_error")
         errors(:, 2) = run%history%column("min_step_error")
         ! friction follows the film
         errors(:, 3) = max(errors(:, 1), errors(:, 2))
         errors(:, 4) = run%history%column("p_step_error")
         do k = 1, size(names)
            values = run%history%column(trim(columns(k)))
            found = not_known
            at = not_known
            error = not_known
            ! not known at one instant: the extreme is not known
            if (converged .and. any(counts) .and. all(.not. (ieee_is_nan(values) .and. counts))) then
               i = maxloc(signs(k)*values, dim=1, mask=counts)
               found = values(i)
               at = time(i)
               error = found*(errors(i, by_steps(k)) + record%number(trim(smooth(k))//"_error") &
                              /record%number(trim(smooth(k))))
            end if
            call record%set(trim(names(k))//trim(units(k)), found)
            call record%set(trim(names(k))//"_t_s", at)
            call record%set(trim(names(k))//"_error"//trim(units(k)), error)
         end do
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

      !> Where the last of so many periods begins [s]
      pure real(dp) function from(periods)
         integer, intent(in) :: periods

         from = 0.0_dp
         associate (duty => run%plan%duty)
            if (duty%periodic) from = max(0.0_dp, (duty%end_time() - periods*duty%length())*duty%time_scale)
         end associate
      end function from

      !> Change of the mean central film from the last period but one to the last, relative
      real(dp) function change()
         real(dp) :: means(2)
         integer :: n

         values = run%history%column("h_c_m")
         do n = 1, 2
            means(n) = mean(from(n), from(n) + run%plan%duty%length()*run%plan%duty%time_scale)
         end do
         change = abs(means(1)/means(2) - 1.0_dp)
      end function change

      !> Mean over a time, by trapezia
      pure real(dp) function mean(first, last)
         real(dp), intent(in) :: first, last
         real(dp) :: whole
         integer :: n

         mean = 0.0_dp
         whole = 0.0_dp
         do n = 2, size(time)
            if (time(n - 1) < first*(1.0_dp - 1.0e-9_dp) .or. time(n) > last*(1.0_dp + 1.0e-9_dp)) cycle
            mean = mean + 0.5_dp*(values(n) + values(n - 1))*(time(n) - time(n - 1))
            whole = whole + time(n) - time(n - 1)
         end do
         mean = mean/whole
      end function mean
   end subroutine report_duty
end module ehl_report_duty

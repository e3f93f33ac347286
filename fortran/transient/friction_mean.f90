! SPDX-License-Identifier: BSD-3-Clause
!> Mean of the friction ratio over whole periods, and the criterion that it has settled
module ehl_friction_mean
   use ehl_kinds, only: dp
   use ehl_status, only: ehl_no_memory, status_t
   use ehl_text, only: to_text
   implicit none (type, external)
   private
   public :: friction_mean_t, periods_compared, automatic_periods

   !> The mean of the last period is compared with those of periods that end earlier by these fractions of the longest lag, which
   !> is half a period of the slowest surface unless a predicted start sets a shorter one
   real(dp), parameter :: lags(*) = [0.25_dp, 0.5_dp, 0.75_dp, 1.0_dp]
   real(dp), parameter :: longest_lag = 0.5_dp
   !> The mean is taken over one period, or after this many periods over all but the first `start_up` ones, in which the effect of
   !> the start decays. Means that settle so late are dominated by pressure peaks of single nodes, which each period samples at
   !> other phases, since a period is not a whole number of steps.
   real(dp), parameter :: many_periods = 20.0_dp
   integer, parameter :: start_up = 2
   !> Periods of the slowest surface after which an unsettled run is stopped; the slowest known run settled after 21
   integer, parameter :: automatic_periods = 36

   !> Friction ratio at equidistant times
   type :: friction_mean_t
      !> Period, and time between values
      real(dp) :: period = 0.0_dp, time_step = 0.0_dp
      !> Periods of the slowest surface in a period, and the mismatch of the other surface after it as a fraction of its period
      integer :: repeats = 1
      real(dp) :: mismatch = 0.0_dp
      !> Longest lag between means that are compared, in periods
      real(dp) :: lag = longest_lag
      !> Time after which the start has no effect; 0: not used
      real(dp) :: transit = 0.0_dp
      !> Steps before the roughness fills the contact, which belong to no mean
      integer :: filled = 0
      integer :: n = 0
      real(dp), allocatable :: values(:)
      !> Film and roughness at X = Y = 0 at the same times [a^2/R]
      real(dp), allocatable :: film(:), roughness(:)
   contains
      procedure :: start
      procedure :: append
      procedure :: mean
      procedure :: has_mean
      procedure :: extremes
      procedure :: first_of_mean
      procedure :: change
      procedure :: has_change
      procedure :: settled
      procedure :: uncertainty
      procedure :: window_error
      procedure :: periods
      procedure :: window
      procedure :: amplitude_ratio
   end type friction_mean_t

contains

   !> Number of periods until a mean can be compared with earlier ones
   pure real(dp) function periods_compared(repeats)
      !> Periods of the slowest surface in a period
      integer, intent(in) :: repeats
      periods_compared = 1.0_dp + longest_lag/repeats
   end function periods_compared

   !> Start without values; the roughness fills the contact after time_filled
   subroutine start(self, period, repeats, mismatch, time_step, time_filled, lag, transit)
      class(friction_mean_t), intent(inout) :: self
      real(dp), intent(in) :: period, time_step, time_filled
      !> As in friction_mean_t
      integer, intent(in) :: repeats
      real(dp), intent(in) :: mismatch
      !> Longest lag [a/u]; the default and the maximum are half a period of the slowest surface
      real(dp), intent(in), optional :: lag
      !> Time after which the start has no effect
      real(dp), intent(in), optional :: transit

      self%period = period
      self%repeats = repeats
      self%mismatch = mismatch
      self%lag = longest_lag/repeats
      if (present(lag)) self%lag = min(self%lag, lag/period)
      self%transit = 0.0_dp
      if (present(transit)) self%transit = transit
      self%time_step = time_step
      self%filled = ceiling(time_filled/time_step)
      self%n = 0
      if (.not. allocated(self%values)) allocate (self%values(1024), self%film(1024), self%roughness(1024))
   end subroutine start

   !> Append the values of a step: friction ratio, film and roughness at X = Y = 0
   subroutine append(self, value, film, roughness, status)
      class(friction_mean_t), intent(inout) :: self
      real(dp), intent(in) :: value, film, roughness
      type(status_t), intent(inout) :: status

      if (self%n == size(self%values)) then
         call double(self%values, status)
         call double(self%film, status)
         call double(self%roughness, status)
         if (status%failed()) return
      end if
      self%n = self%n + 1
      self%values(self%n) = value
      self%film(self%n) = film
      self%roughness(self%n) = roughness
   end subroutine append

   !> Double the size of an array
   subroutine double(values, status)
      real(dp), allocatable, intent(inout) :: values(:)
      type(status_t), intent(inout) :: status
      real(dp), allocatable :: more(:)
      integer :: stat

      allocate (more(2*size(values)), stat=stat)
      if (stat /= 0) then
         call status%fail(ehl_no_memory, "no memory for the friction of more than "//to_text(size(values))//" time steps")
         return
      end if
      more(:size(values)) = values
      call move_alloc(more, values)
   end subroutine double

   !> A_d/A_i at X = Y = 0: ratio of the standard deviations of film and roughness there over the last period
   pure real(dp) function amplitude_ratio(self)
      class(friction_mean_t), intent(in) :: self
      integer :: first

      first = max(1, self%n - int(self%period/self%time_step))
      amplitude_ratio = deviation(self%film(first:self%n))/deviation(self%roughness(first:self%n))
   end function amplitude_ratio

   !> Standard deviation of values
   pure real(dp) function deviation(v)
      real(dp), intent(in) :: v(:)
      deviation = sqrt(sum((v - sum(v)/size(v))**2)/size(v))
   end function deviation

   !> Number of periods since the contact was filled
   pure real(dp) function periods(self)
      class(friction_mean_t), intent(in) :: self
      periods = (self%n - max(self%filled, 1))*self%time_step/self%period
   end function periods

   !> Length of the averaging window, whole periods [a/u]
   pure real(dp) function window(self)
      class(friction_mean_t), intent(in) :: self
      window = self%period
      if (self%periods() >= many_periods) window = self%period*int(self%periods() - start_up)
   end function window

   !> Whether a whole period has passed since the contact was filled
   pure logical function has_mean(self)
      class(friction_mean_t), intent(in) :: self
      has_mean = self%periods() >= 1.0_dp
   end function has_mean

   !> Whether the mean can be compared with earlier ones
   pure logical function has_change(self)
      class(friction_mean_t), intent(in) :: self
      has_change = self%periods() >= 1.0_dp + self%lag
   end function has_change

   !> Mean over the window that ends `lag` before the last value: the exact integral of the polygon through the values
   pure real(dp) function mean(self, lag)
      class(friction_mean_t), intent(in) :: self
      real(dp), intent(in) :: lag
      real(dp) :: last, length

      last = self%n - lag/self%time_step
      length = self%window()/self%time_step
      mean = integral(self%values(:self%n), last - length, last)/length
   end function mean

   !> Integral of the polygon through values between two positions [steps], the first value at 1. Values outside have no effect,
   !> even if not finite.
   pure real(dp) function integral(values, from, to)
      real(dp), intent(in) :: values(:), from, to
      integer :: first, last

      first = ceiling(from)
      last = int(to)
      if (first > last) then
         integral = 0.5_dp*(at(values, from) + at(values, to))*(to - from)
         return
      end if
      integral = 0.5_dp*(at(values, from) + values(first))*(first - from) &
                 + 0.5_dp*(sum(values(first:last - 1)) + sum(values(first + 1:last))) &
                 + 0.5_dp*(values(last) + at(values, to))*(to - last)
   end function integral

   !> Polygon through values at a position [steps]
   pure real(dp) function at(values, position)
      real(dp), intent(in) :: values(:), position
      integer :: k

      k = min(max(int(position), 1), size(values) - 1)
      at = values(k) + (position - k)*(values(k + 1) - values(k))
   end function at

   !> Minimum and maximum value in the averaging window
   pure function extremes(self) result(range)
      class(friction_mean_t), intent(in) :: self
      real(dp) :: range(2)

      associate (first => self%first_of_mean())
         range = [minval(self%values(first:self%n)), maxval(self%values(first:self%n))]
      end associate
   end function extremes

   !> Index of the first value in the averaging window, which ends with the last value
   pure integer function first_of_mean(self)
      class(friction_mean_t), intent(in) :: self
      first_of_mean = max(1, self%n - int(self%window()/self%time_step))
   end function first_of_mean

   !> Maximum difference between the last mean and the earlier ones; of a mean over many periods half of the maximum difference to
   !> the means over its first, middle and last half, since the error decreases with the length of the mean
   pure real(dp) function change(self)
      class(friction_mean_t), intent(in) :: self
      real(dp) :: length, last, half
      integer :: k

      change = 0.0_dp
      if (self%periods() < many_periods) then
         do k = 1, size(lags)
            change = max(change, abs(self%mean(lags(k)*(self%lag*self%period)) - self%mean(0.0_dp)))
         end do
         return
      end if
      length = self%window()/self%time_step
      half = self%period*int(0.5_dp*self%window()/self%period)/self%time_step
      do k = 0, 2
         last = self%n - 0.5_dp*k*(length - half)
         change = max(change, 0.5_dp*abs(integral(self%values(:self%n), last - half, last)/half - self%mean(0.0_dp)))
      end do
   end function change

   !> Error of the mean at the end of the run: its change, times the number of lags until the start has no effect
   pure real(dp) function uncertainty(self)
      class(friction_mean_t), intent(in) :: self
      uncertainty = self%change()*max(1.0_dp, (self%transit + self%window() - self%n*self%time_step)/(self%lag*self%period))
   end function uncertainty

   !> Whether the relative change of the mean is within the tolerance. The scale is the mean, or over many periods, with peaks far
   !> above the mean, the maximum. Without a common period the error of the window is added to the tolerance.
   pure logical function settled(self, tolerance)
      class(friction_mean_t), intent(in) :: self
      real(dp), intent(in) :: tolerance
      real(dp) :: range(2), scale

      settled = .false.
      if (.not. self%has_change()) return
      scale = self%mean(0.0_dp)
      if (self%periods() >= many_periods) then
         range = self%extremes()
         scale = range(2)
      end if
      settled = self%change() <= tolerance*scale + self%window_error()
   end function settled

   !> Error of a mean over a window that is not a common period of two surfaces. The worst case is a product of waves of which the
   !> window holds 1 - m or 1 + m periods, with the mismatch m. At most sin(pi m)/(pi (1 - m)) of the amplitude remains in the
   !> mean, which is less than m times the range for m up to a quarter.
   pure real(dp) function window_error(self)
      class(friction_mean_t), intent(in) :: self
      real(dp) :: range(2)

      window_error = 0.0_dp
      if (.not. self%mismatch > 0.0_dp .or. self%n == 0) return
      range = self%extremes()
      window_error = self%mismatch*(range(2) - range(1))
   end function window_error
end module ehl_friction_mean

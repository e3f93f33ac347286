! SPDX-License-Identifier: BSD-3-Clause
!> Viscosity interpolated in a table of measured values: ln(eta) along each isotherm by monotone cubics in pressure (Fritsch &
!> Butland 1984), between isotherms linear in 1/T. Beyond the table it is extrapolated linearly, which the
!> plan and the summary report.
module ehl_viscosity_table
   use ehl_kinds, only: dp
   use ehl_viscosity_law, only: viscosity_law_t
   implicit none (type, external)
   private
   public :: isotherm_t, viscosity_table_t, new_isotherm, new_viscosity_table

   !> Pressures in increasing order, ln of the viscosities [Pa s] and the derivatives with respect to pressure
   type :: isotherm_t
      !> [K]
      real(dp) :: temperature = 0.0_dp
      real(dp), allocatable :: p(:), values(:), slopes(:)
   contains
      procedure :: evaluate
   end type isotherm_t

   type, extends(viscosity_law_t) :: viscosity_table_t
      !> In increasing temperature, pressures over the Hertz pressure
      type(isotherm_t), allocatable :: isotherms(:)
      !> Temperature of the inlet [K]; ln(eta0/Pa s); -(d eta/dT)/eta [1/K] of a table of a single isotherm
      real(dp) :: inlet = 0.0_dp, level = 0.0_dp, beta = 0.0_dp
   contains
      procedure :: log_viscosity
      procedure :: log_viscosity_at
      procedure, private :: at
   end type viscosity_table_t

contains

   !> An isotherm from its temperature [K], two or more pressures [Pa] in increasing order and viscosities [Pa s]
   pure function new_isotherm(temperature, p, viscosity) result(isotherm)
      real(dp), intent(in) :: temperature, p(:), viscosity(:)
      type(isotherm_t) :: isotherm
      real(dp) :: h(size(p) - 1), chords(size(p) - 1)
      integer :: k, n

      n = size(p)
      isotherm%temperature = temperature
      allocate (isotherm%p, source=p)
      allocate (isotherm%values(n), isotherm%slopes(n))
      isotherm%values = log(viscosity)
      h = p(2:) - p(:n - 1)
      chords = (isotherm%values(2:) - isotherm%values(:n - 1))/h
      isotherm%slopes(1) = chords(1)
      isotherm%slopes(n) = chords(n - 1)
      do k = 2, n - 1
         isotherm%slopes(k) = harmonic(h(k - 1), h(k), chords(k - 1), chords(k))
      end do
   end function new_isotherm

   !> Weighted harmonic mean of the slopes of two intervals; 0 if they differ in sign
   pure real(dp) function harmonic(left, right, before, after)
      real(dp), intent(in) :: left, right, before, after

      harmonic = 0.0_dp
      if (before*after > 0.0_dp) harmonic = 3.0_dp*(left + right)/((2.0_dp*right + left)/before + (right + 2.0_dp*left)/after)
   end function harmonic

   !> The law from isotherms with pressures in Pa, the Hertz pressure [Pa], the temperature of the inlet [K] and beta
   !> [1/K], which only a single isotherm needs
   pure function new_viscosity_table(isotherms, hertz_pressure, temperature, beta) result(law)
      type(isotherm_t), intent(in) :: isotherms(:)
      real(dp), intent(in) :: hertz_pressure, temperature, beta
      type(viscosity_table_t) :: law
      real(dp) :: slope
      integer :: k

      allocate (law%isotherms, source=isotherms)
      do k = 1, size(isotherms)
         law%isotherms(k)%p = isotherms(k)%p/hertz_pressure
         law%isotherms(k)%slopes = isotherms(k)%slopes*hertz_pressure
      end do
      law%inlet = temperature
      law%beta = beta
      call law%at(0.0_dp, 0.0_dp, law%level, slope)
      law%ambient_viscosity = exp(law%level)
   end function new_viscosity_table

   !> ln(eta) of an isotherm, and its derivative with respect to p
   pure subroutine evaluate(self, p, value, slope)
      class(isotherm_t), intent(in) :: self
      real(dp), intent(in) :: p
      real(dp), intent(out) :: value, slope
      integer :: low, high, middle
      real(dp) :: h, t, chord

      low = 1
      high = size(self%p)
      if (p <= self%p(low) .or. p >= self%p(high)) then
         low = merge(low, high, p <= self%p(low))
         value = self%values(low) + self%slopes(low)*(p - self%p(low))
         slope = self%slopes(low)
         return
      end if
      do while (high - low > 1)
         middle = (low + high)/2
         if (self%p(middle) > p) then
            high = middle
         else
            low = middle
         end if
      end do
      h = self%p(high) - self%p(low)
      t = (p - self%p(low))/h
      chord = (self%values(high) - self%values(low))/h
      associate (m => self%slopes)
         value = self%values(low) + h*t*(m(low) + t*(3.0_dp*chord - 2.0_dp*m(low) - m(high) &
                                                     + t*(m(low) + m(high) - 2.0_dp*chord)))
         slope = m(low) + t*(2.0_dp*(3.0_dp*chord - 2.0_dp*m(low) - m(high)) + 3.0_dp*t*(m(low) + m(high) - 2.0_dp*chord))
      end associate
   end subroutine evaluate

   !> ln(eta/Pa s), and its derivative with respect to p, at a pressure and a temperature rise [K]
   pure subroutine at(self, p, rise, value, slope)
      class(viscosity_table_t), intent(in) :: self
      real(dp), intent(in) :: p, rise
      real(dp), intent(out) :: value, slope
      real(dp) :: hot_value, hot_slope, weight
      integer :: k

      if (size(self%isotherms) == 1) then
         call self%isotherms(1)%evaluate(p, value, slope)
         value = value - self%beta*rise
         return
      end if
      k = 1
      do while (k < size(self%isotherms) - 1 .and. self%isotherms(k + 1)%temperature < self%inlet + rise)
         k = k + 1
      end do
      associate (cold => self%isotherms(k), hot => self%isotherms(k + 1))
         weight = (1.0_dp/cold%temperature - 1.0_dp/(self%inlet + rise))/(1.0_dp/cold%temperature - 1.0_dp/hot%temperature)
         call cold%evaluate(p, value, slope)
         call hot%evaluate(p, hot_value, hot_slope)
      end associate
      value = value + weight*(hot_value - value)
      slope = slope + weight*(hot_slope - slope)
   end subroutine at

   !> ln(eta/eta0) at the temperature of the inlet, and its derivative with respect to p
   pure subroutine log_viscosity(self, p, values, slope)
      class(viscosity_table_t), intent(in) :: self
      real(dp), intent(in) :: p(:)
      real(dp), intent(out) :: values(:), slope(:)
      integer :: i

      do i = 1, size(p)
         call self%at(p(i), 0.0_dp, values(i), slope(i))
         values(i) = values(i) - self%level
      end do
   end subroutine log_viscosity

   !> ln(eta/eta0) at temperature rises above the inlet [K]
   pure subroutine log_viscosity_at(self, p, rise, values)
      class(viscosity_table_t), intent(in) :: self
      real(dp), intent(in) :: p(:), rise(:)
      real(dp), intent(out) :: values(:)
      real(dp) :: slope
      integer :: i

      do i = 1, size(p)
         call self%at(p(i), rise(i), values(i), slope)
         values(i) = values(i) - self%level
      end do
   end subroutine log_viscosity_at
end module ehl_viscosity_table

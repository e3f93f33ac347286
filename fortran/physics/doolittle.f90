! SPDX-License-Identifier: BSD-3-Clause
!> Viscosity by the free volume of Doolittle 1951, with the volume of Tait (Bair 2007):
!>
!>    eta = eta_R exp{B R0 [v/(V/V_R - R0 v) - 1/(1 - R0)]},   v = 1 + eps (T - T_R)
!>
!> v is the occupied volume over that at T_R, and eps its thermal expansion; V_R and eta_R are total volume and viscosity at T_R
!> and ambient pressure, R0 is the occupied fraction of V_R there. Where the free volume V/V_R - R0 v is not positive the oil is
!> solid and its viscosity infinite.
module ehl_doolittle
   use ehl_kinds, only: dp
   use ehl_tait, only: tait_t
   use ehl_viscosity_law, only: solid, viscosity_law_t
   implicit none (type, external)
   private
   public :: doolittle_t, new_doolittle

   type, extends(viscosity_law_t) :: doolittle_t
      private
      type(tait_t) :: state
      !> V/V_R of this law over that of `state`, whose T_R may be different
      real(dp) :: scale = 1.0_dp
      !> B R0, R0, eps [1/K]
      real(dp) :: b_r0 = 0.0_dp, occupied = 0.5_dp, expansion = 0.0_dp
      !> T - T_R of the inlet [K], ln(eta_0/eta_R)
      real(dp) :: above = 0.0_dp, level = 0.0_dp
   contains
      procedure :: log_viscosity
      procedure :: log_viscosity_at
      procedure, private :: above_reference
      procedure, private :: free_volume
   end type doolittle_t

contains

   !> The law from eta_R [Pa s], B, R0, eps [1/K], T_R [K], the equation of state and the temperature of the inlet [K]
   pure function new_doolittle(reference_viscosity, b, occupied, expansion, reference, state, temperature) result(law)
      real(dp), intent(in) :: reference_viscosity, b, occupied, expansion, reference, temperature
      type(tait_t), intent(in) :: state
      type(doolittle_t) :: law

      law%state = state
      law%scale = 1.0_dp/state%volume(0.0_dp, reference - temperature)
      law%b_r0 = b*occupied
      law%occupied = occupied
      law%expansion = expansion
      law%above = temperature - reference
      law%level = law%above_reference(0.0_dp, 0.0_dp)
      law%ambient_viscosity = reference_viscosity*exp(law%level)
   end function new_doolittle

   !> Free volume over V_R at a pressure over the Hertz pressure and a temperature rise above the inlet [K]
   elemental real(dp) function free_volume(self, p, rise)
      class(doolittle_t), intent(in) :: self
      real(dp), intent(in) :: p, rise

      free_volume = self%scale*self%state%volume(p, rise) - self%occupied*(1.0_dp + self%expansion*(self%above + rise))
   end function free_volume

   !> ln(eta/eta_R) at a pressure and a temperature rise [K]
   elemental real(dp) function above_reference(self, p, rise)
      class(doolittle_t), intent(in) :: self
      real(dp), intent(in) :: p, rise
      real(dp) :: free

      free = self%free_volume(p, rise)
      above_reference = solid()
      if (free > 0.0_dp) then
         above_reference = self%b_r0*((1.0_dp + self%expansion*(self%above + rise))/free - 1.0_dp/(1.0_dp - self%occupied))
      end if
   end function above_reference

   !> ln(eta/eta0) at the temperature of the inlet, and its derivative with respect to p
   pure subroutine log_viscosity(self, p, values, slope)
      class(doolittle_t), intent(in) :: self
      real(dp), intent(in) :: p(:)
      real(dp), intent(out) :: values(:), slope(:)
      real(dp) :: free
      integer :: i

      do i = 1, size(p)
         values(i) = self%above_reference(p(i), 0.0_dp) - self%level
         free = self%free_volume(p(i), 0.0_dp)
         slope(i) = 0.0_dp
         if (free > 0.0_dp) slope(i) = -self%b_r0*(1.0_dp + self%expansion*self%above)*self%scale &
                                       *self%state%volume_slope(p(i))/free**2
      end do
   end subroutine log_viscosity

   !> ln(eta/eta0) at temperature rises above the inlet [K]
   pure subroutine log_viscosity_at(self, p, rise, values)
      class(doolittle_t), intent(in) :: self
      real(dp), intent(in) :: p(:), rise(:)
      real(dp), intent(out) :: values(:)

      values = self%above_reference(p, rise) - self%level
   end subroutine log_viscosity_at
end module ehl_doolittle

! SPDX-License-Identifier: BSD-3-Clause
!> Lubricants for Python, and flow and stress with shear thinning; for the rules see ehl_f2py_solver.
!>
!> `law` is 1 for Eyring and 2 for Carreau, whose power-law exponent is `exponent`; B and S are those of flow_factors.f90.
module ehl_f2py_lubricant
   use, intrinsic :: iso_c_binding, only: c_double, c_int
   use ehl_case, only: lubricant_case_t
   use ehl_case_law, only: make_lubricant
   use ehl_flow_factors, only: exact_factors, factors_t
   use ehl_handles, only: reply
   use ehl_lubricant, only: lubricant_t
   use ehl_read_case, only: read_lubricant
   use ehl_status, only: status_t
   use ehl_thinning, only: thinning_t
   implicit none (type, external)
   private
   public :: properties, flow_factors, sliding_stresses

contains

   !> ln(eta/eta0) and rho/rho0 of a lubricant at pressures p [Pa] and temperature rises above the inlet [K]; `group` is &lubricant
   !> of a resolved case
   subroutine properties(group, n, p, rise, log_viscosity, density, stat, message)
      character(len=*), intent(in) :: group
      integer(c_int), intent(in) :: n
      real(c_double), intent(inout) :: p(n), rise(n), log_viscosity(n), density(n)
      integer(c_int), intent(out) :: stat
      character(len=4096), intent(out) :: message
      type(lubricant_case_t) :: keys
      type(lubricant_t) :: lubricant
      type(status_t) :: status

      call read_lubricant(group, keys, status)
      ! a pressure of 1 Pa in place of the Hertz pressure
      if (.not. status%failed()) call make_lubricant(keys, keys%pressure_viscosity, 1.0_c_double, lubricant, status)
      if (.not. status%failed()) then
         call lubricant%log_viscosity_at(p, rise, log_viscosity)
         call lubricant%density_at(p, rise, density)
      end if
      call reply(status, stat, message)
   end subroutine properties

   !> n sets of flow factors: phi_x, phi_y, and for phi_x d ln(phi)/d ln(B), d ln(phi)/d ln(S) and d(phi S)/dS; phi_x and phi_y are
   !> NaN where the iteration does not converge
   subroutine flow_factors(n, law, exponent, b, gradient, found)
      integer(c_int), intent(in) :: n, law
      real(c_double), intent(in) :: exponent
      real(c_double), intent(inout) :: b(n), gradient(2, n), found(5, n)
      type(factors_t) :: factors
      integer :: i
      !f2py threadsafe

      do i = 1, n
         factors = exact_factors(thinning_t(law, exponent), b(i), gradient(:, i))
         found(:, i) = [factors%phi, factors%by_sliding(1), factors%by_gradient(1), factors%tangent(1)]
      end do
   end subroutine flow_factors

   !> Shear stresses in sliding without a pressure gradient, over the stress of the law (Eyring or Carreau stress); NaN where the
   !> iteration does not converge
   subroutine sliding_stresses(n, law, exponent, b, stress)
      integer(c_int), intent(in) :: n, law
      real(c_double), intent(in) :: exponent
      real(c_double), intent(inout) :: b(n), stress(n)
      type(thinning_t) :: thinning
      !f2py threadsafe

      thinning = thinning_t(law, exponent)
      stress = thinning%sliding_stress(b)
   end subroutine sliding_stresses
end module ehl_f2py_lubricant

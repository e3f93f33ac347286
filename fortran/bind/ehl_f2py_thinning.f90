! SPDX-License-Identifier: BSD-3-Clause
!> Flow and stress of lubricants that thin by shear for Python; for the rules see ehl_f2py_solver.
!>
!> `law` is 1 for Eyring and 2 for Carreau with `exponent` n; B and S are those of flow_factors.f90.
module ehl_f2py_thinning
   use, intrinsic :: iso_c_binding, only: c_double, c_int
   use ehl_flow_factors, only: exact_factors, factors_t
   use ehl_thinning, only: thinning_t
   implicit none (type, external)
   private
   public :: flow_factors, sliding_stresses

contains

   !> Flow factors through the film, n times: phi_x, phi_y, and of phi_x d ln(phi)/d ln(B), d ln(phi)/d ln(S) and
   !> d(phi S)/dS; NaNs where they are not found
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

   !> Stresses of films that slide without a gradient of pressure, in units of that of the law; NaNs where not found
   subroutine sliding_stresses(n, law, exponent, b, stress)
      integer(c_int), intent(in) :: n, law
      real(c_double), intent(in) :: exponent
      real(c_double), intent(inout) :: b(n), stress(n)
      type(thinning_t) :: thinning
      !f2py threadsafe

      thinning = thinning_t(law, exponent)
      stress = thinning%sliding_stress(b)
   end subroutine sliding_stresses
end module ehl_f2py_thinning

! SPDX-License-Identifier: BSD-3-Clause
!> A-priori discretisation errors of the film of a smooth contact
module ehl_grid_error
   use ehl_contact, only: contact_t
   use ehl_kinds, only: dp
   use ehl_moes, only: operating_t
   implicit none (type, external)
   private
   public :: relative_errors, single_grid_errors

   !> A-priori error of H_c due to the second-order wedge term: the smaller of 0.16 M h^2 (fitted to grids of 65^2 to 513^2 for
   !> 20 <= M <= 1000, 10 <= L <= 15) and, for thick films with the length scale s = (2 H_c)^(1/2), 0.85 (1 + (M/5)^2) (h/s)^2
   !> (measured on 33^2 to 513^2 for 0.05 <= M <= 20 over (h/s)^2: 0.61 to 0.68 up to M = 1, 1.07 at M = 5, 2.9 at M = 20)
   real(dp), parameter :: by_contact = 0.16_dp, by_film = 0.85_dp, thick_m = 5.0_dp
   !> Errors of H_c and H_min in narrow contacts over those in round ones: 1 + a (1/kappa^2 - 1)
   !> and max(1, b/kappa^2) (docs/evidence/errors_ellipses)
   real(dp), parameter :: narrow_central = 0.05_dp, narrow_minimum = 0.3_dp
   !> Error of thin films of constant viscosity over h^2/H_c^(1/3), H_c on that grid: 0.26 to 0.31 for H_c, up to 0.34 for H_min
   !> (L = 0, 655 <= M <= 2304). For piezoviscous films see by_contact.
   real(dp), parameter :: by_inlet = 0.4_dp
   !> Error of a narrow contact on a single grid over the a-priori error: 1.9 and 1.6 at kappa = 0.31, M = 1789
   real(dp), parameter :: alone_and_narrow = 2.0_dp

contains

   !> Approximate relative a-priori errors of H_c and H_min: in round and wide contacts that of H_min is twice that of H_c; both
   !> are larger in narrow contacts, whose ends are sharp
   pure function relative_errors(contact, point, h) result(errors)
      class(contact_t), intent(in) :: contact
      type(operating_t), intent(in) :: point
      !> Mesh size along X [a]
      real(dp), intent(in) :: h
      real(dp) :: errors(2)
      real(dp) :: square, film

      square = min(1.0_dp, contact%reach(2)/contact%reach(1))**2
      film = contact%film_formula(point%moes_m, point%moes_l)
      errors = min(by_contact*point%round_m, by_film*(1.0_dp + (point%round_m/thick_m)**2)/(2.0_dp*film))*h**2
      errors(1) = errors(1)*(1.0_dp + narrow_central*(1.0_dp/square - 1.0_dp))
      errors(2) = 2.0_dp*errors(2)*max(1.0_dp, narrow_minimum/square)
   end function relative_errors

   !> Errors of H_c and H_min solved on this grid alone: the a-priori errors, but at least that of the inlet of a thin film
   pure function single_grid_errors(contact, point, h, films) result(errors)
      class(contact_t), intent(in) :: contact
      type(operating_t), intent(in) :: point
      !> Mesh size along X [a]
      real(dp), intent(in) :: h
      !> H_c and H_min on this grid
      real(dp), intent(in) :: films(2)
      real(dp) :: errors(2)

      errors = relative_errors(contact, point, h)*films
      if (contact%reach(2) < contact%reach(1)) errors = alone_and_narrow*errors
      errors = max(errors, by_inlet*h**2/films(1)**(1.0_dp/3.0_dp))
   end function single_grid_errors
end module ehl_grid_error

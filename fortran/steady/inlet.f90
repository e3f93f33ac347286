! SPDX-License-Identifier: BSD-3-Clause
!> Resolution of the inlet of a contact with solid contact at a boundary film.
!>
!> Bodies that touch have the film of the boundary film on every grid that is too coarse for the inlet: two such grids agree,
!> which does not show their error. That is the error of the film that the inlet would make. In the inlet of a Hertz contact the gap
!> opens as xi^(3/2) (Greenwood 1972), so that pressure builds up over a length of H^(2/3), and the wedge term of second order
!> misses a share of that film of
!>
!>    e = c (h/H^(2/3))^2,   h the mesh size [a], H the central film by formula [a^2/R].
!>
!> With c = 1.3 it covers the campaign in docs/evidence/inlet; the other numbers are from there, too.
module ehl_inlet
   use ehl_contact_results, only: contact_results_t
   use ehl_kinds, only: dp
   use ehl_touching, only: mostly_touching
   implicit none (type, external)
   private
   public :: inlet_t, share_by_film

   !> c, and the largest e of a grid that determines which part of the load is at the boundary film
   real(dp), parameter :: factor = 1.3_dp, resolved_share = 0.12_dp
   !> Load share, and its part of the friction, up to which it hardly matters whether the grid is the reason: films grow as
   !> grids become finer, and no share is wrong by more than itself
   real(dp), parameter :: small_share = 0.05_dp, small_friction = 0.1_dp
   !> Error of the formula; minimum film of a smooth contact over the central one
   real(dp), parameter :: formula_error = 0.15_dp, min_over_central = 0.3_dp
   !> Relative change of the load share by a relative change of the film; error of what is left of the load, at the edge of a
   !> contact that touches nearly everywhere
   real(dp), parameter :: share_by_film = 8.0_dp, edge_error = 0.5_dp
   !> Error of the load share over s (1 - s) r/H: what the residual r (rms, of the wedge term) leaves open adds up along a
   !> touching zone and moves its edge, by a node in several cycles, so that changes per cycle say little. It covers 135 of
   !> 138 results (M from 100 to 2500, boundary films of 0.4 to 1.1 times the film, against a residual 10 to 1000 times smaller)
   real(dp), parameter :: share_by_residual = 80.0_dp

   type :: inlet_t
      !> Central film by formula and boundary film, both under the Hertz pressure [a^2/R]; 0: there is no boundary film
      real(dp) :: film = 0.0_dp, boundary_film = 0.0_dp
      !> Shear stress of the boundary film over its pressure, as lubricant_t has it
      real(dp) :: stress = 0.0_dp
   contains
      procedure :: missed
      procedure :: is_dry
      procedure :: in_doubt
      procedure :: resolves
      procedure :: resolving_mesh
      procedure :: film_errors
      procedure :: share_error
      procedure :: share_left
   end type inlet_t

contains

   !> Relative error e of the film that the inlet makes, on a grid of mesh size h
   pure real(dp) function missed(self, h)
      class(inlet_t), intent(in) :: self
      real(dp), intent(in) :: h
      missed = factor*h**2/self%film**(4.0_dp/3.0_dp)
   end function missed

   !> Whether the boundary film is thicker than the film by the inlet, whatever the grid
   pure logical function is_dry(self)
      class(inlet_t), intent(in) :: self
      is_dry = self%boundary_film >= (1.0_dp + formula_error)*self%film
   end function is_dry

   !> Whether a contact may touch on a grid of mesh size h for that: there the film is thinner by more than is missed of H
   pure logical function in_doubt(self, h)
      class(inlet_t), intent(in) :: self
      real(dp), intent(in) :: h

      in_doubt = .false.
      if (.not. self%film > 0.0_dp .or. self%is_dry()) return
      associate (e => self%missed(h))
         in_doubt = e > resolved_share .and. self%boundary_film > min_over_central*(1.0_dp - 2.0_dp*e)*self%film
      end associate
   end function in_doubt

   !> Whether a solution on a grid of mesh size h determines which part of the load is at the boundary film
   pure logical function resolves(self, m, h)
      class(inlet_t), intent(in) :: self
      type(contact_results_t), intent(in) :: m
      real(dp), intent(in) :: h

      resolves = .true.
      if (.not. self%film > 0.0_dp .or. self%is_dry()) return
      if (self%missed(h) <= resolved_share) return
      associate (share => m%touching%load_share)
         resolves = share <= small_share .and. share*self%stress*m%load <= small_friction*m%friction
      end associate
   end function resolves

   !> Mesh size that resolves it
   pure real(dp) function resolving_mesh(self)
      class(inlet_t), intent(in) :: self
      resolving_mesh = sqrt(resolved_share/factor)*self%film**(2.0_dp/3.0_dp)
   end function resolving_mesh

   !> Errors of H_c and H_min of a contact that touches: the grid error of the film, but no more than the distance to the film by
   !> formula. Else 0.
   pure function film_errors(self, m, h) result(errors)
      class(inlet_t), intent(in) :: self
      type(contact_results_t), intent(in) :: m
      real(dp), intent(in) :: h
      real(dp) :: errors(2), e

      errors = 0.0_dp
      if (.not. self%film > 0.0_dp) return
      errors = max(0.0_dp, (1.0_dp + formula_error)*self%film - m%films())
      e = self%missed(h)
      if (e < 1.0_dp) errors = min(errors, m%films()*e/(1.0_dp - e))
   end function film_errors

   !> Error of the load share by that of the film
   pure real(dp) function share_error(self, m, h)
      class(inlet_t), intent(in) :: self
      type(contact_results_t), intent(in) :: m
      real(dp), intent(in) :: h

      share_error = 0.0_dp
      associate (share => m%touching%load_share)
         if (share > mostly_touching) share_error = edge_error*(1.0_dp - share)
         if (.not. self%film > 0.0_dp .or. self%is_dry()) return
         share_error = max(share_error, share*min(1.0_dp, share_by_film*self%missed(h)))
      end associate
   end function share_error

   !> Error of the load share by the residual that is left. A state near the one where all of it is at the boundary film leaves
   !> that slowly, if the film of the inlet is thicker: there the share may be any.
   pure real(dp) function share_left(self, m, residual)
      class(inlet_t), intent(in) :: self
      type(contact_results_t), intent(in) :: m
      real(dp), intent(in) :: residual
      real(dp) :: steepness

      share_left = 0.0_dp
      associate (share => m%touching%load_share)
         if (.not. self%film > 0.0_dp .or. .not. share > 0.0_dp .or. self%is_dry()) return
         steepness = share*(1.0_dp - share)
         if (share > mostly_touching) steepness = 0.25_dp
         ! no share is wrong by more than its range
         share_left = min(share_by_residual*steepness*residual/m%film_central, max(share, 1.0_dp - share))
      end associate
   end function share_left
end module ehl_inlet

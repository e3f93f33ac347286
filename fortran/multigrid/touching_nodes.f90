! SPDX-License-Identifier: BSD-3-Clause
!> Contact at a boundary film (reynolds/boundary_film.f90) in relaxation and on coarse grids. Without one these change nothing.
module ehl_touching_nodes
   use ehl_bilinear, only: weight_row
   use ehl_boundary_film, only: boundary_film_t
   use ehl_grid, only: grid_t
   use ehl_kinds, only: dp
   use ehl_node_state, only: cavity_pressure
   implicit none (type, external)
   private
   public :: begin_coarse, keep_film, last_touching, mark_touching_dipoles, max_flowing_conductance, max_flowing_conductance_row, &
             restrict_touching, separate_touching, touching_lines

contains

   !> Of each node of row j and its four neighbours, in columns 2 to nx-1: the largest conductance of those that flow
   pure subroutine max_flowing_conductance(boundary, p, eps, j, south, north, values)
      type(boundary_film_t), intent(in) :: boundary
      !> Pressure and conductance along Y, shape (nx, ny)
      real(dp), contiguous, intent(in) :: p(:, :), eps(:, :)
      integer, intent(in) :: j, south, north
      !> Shape (nx)
      real(dp), contiguous, intent(inout) :: values(:)
      integer :: i

      if (.not. boundary%active) return
      do i = 2, size(values) - 1
         values(i) = max(of(i, j), of(i - 1, j), of(i + 1, j), of(i, north), of(i, south))
      end do

   contains

      !> Conductance of a node if it flows, else 0
      pure real(dp) function of(k, l)
         integer, intent(in) :: k, l
         of = merge(eps(k, l)*(1.0_dp - boundary%touching(k, l)), 0.0_dp, p(k, l) > cavity_pressure)
      end function of
   end subroutine max_flowing_conductance

   !> Of three rows, south, j and north: the largest conductance of each column, as if nothing could flow at a touching node
   pure subroutine max_flowing_conductance_row(boundary, eps, j, south, north, values)
      type(boundary_film_t), intent(in) :: boundary
      !> Shape (nx, ny)
      real(dp), contiguous, intent(in) :: eps(:, :)
      integer, intent(in) :: j, south, north
      !> Shape (nx)
      real(dp), contiguous, intent(inout) :: values(:)

      if (.not. boundary%active) return
      values = max(eps(:, south)*(1.0_dp - boundary%touching(:, south)), eps(:, j)*(1.0_dp - boundary%touching(:, j)), &
                   eps(:, north)*(1.0_dp - boundary%touching(:, north)))
   end subroutine max_flowing_conductance_row

   !> Nodes of row j that touch change distributively, beside a cavity, too
   pure subroutine mark_touching_dipoles(boundary, p, j, dipole)
      type(boundary_film_t), intent(in) :: boundary
      !> Shape (nx)
      real(dp), contiguous, intent(in) :: p(:)
      integer, intent(in) :: j
      !> 1 where a node does, else 0; shape (nx)
      real(dp), contiguous, intent(inout) :: dipole(:)

      if (.not. boundary%active) return
      where (p > cavity_pressure) dipole = max(dipole, boundary%touching(:, j))
   end subroutine mark_touching_dipoles

   !> Last touching node of row j whose film is below the boundary film; 2 if there is none
   pure integer function last_touching(boundary, mass_content, j) result(i)
      type(boundary_film_t), intent(in) :: boundary
      !> Shape (nx)
      real(dp), contiguous, intent(in) :: mass_content(:)
      integer, intent(in) :: j

      i = 2
      if (.not. boundary%active) return
      do i = size(mass_content) - 1, 3, -1
         if (boundary%touching(i, j) > 0.0_dp .and. mass_content(i) < boundary%thickness) return
      end do
      i = 2
   end function last_touching

   !> For line systems of the rows side by side: which nodes touch, and their residuals, from node 2 to `last`
   pure subroutine touching_lines(boundary, rows, last, rhs, mass_content, residual, touching)
      type(boundary_film_t), intent(in) :: boundary
      integer, intent(in) :: rows(:), last
      !> Shape (nx, ny)
      real(dp), contiguous, intent(in) :: rhs(:, :), mass_content(:, :)
      !> Shape (lines, last) and (lines, nx)
      real(dp), intent(inout) :: residual(:, :), touching(:, :)
      real(dp) :: row(size(rhs, 1))
      integer :: l

      if (.not. boundary%active) return
      do l = 1, size(rows)
         row(2:last) = residual(l, 2:last)
         call boundary%residual_row(rhs(:, rows(l)), mass_content(:, rows(l)), rows(l), row)
         residual(l, 2:last) = row(2:last)
         touching(l, :last) = boundary%touching(:last, rows(l))
      end do
   end subroutine touching_lines

   !> States of the coarse nodes while their level is solved: those touch that have pressure and around which more than half
   !> touches. None yields: where half of a coarse grid did, nothing would be left to carry a missing load.
   subroutine begin_coarse(boundary, fine, coarse, step, p)
      type(boundary_film_t), intent(inout) :: boundary
      !> Boundary film of the fine level; coarse grid, and its mesh sizes over those of the fine one
      type(boundary_film_t), intent(in) :: fine
      type(grid_t), intent(in) :: coarse
      integer, intent(in) :: step(2)
      !> Restricted pressure, shape (nx, ny)
      real(dp), contiguous, intent(in) :: p(:, :)
      integer :: j

      if (.not. boundary%active) return
      boundary%frozen = .true.
      boundary%yield_mass = 0.0_dp
      boundary%rate = fine%rate
      do j = 1, coarse%ny
         call weight_row(coarse, step, fine%touching, j, boundary%touching(:, j))
         boundary%touching(:, j) = merge(1.0_dp, 0.0_dp, boundary%touching(:, j) > 0.5_dp .and. p(:, j) > cavity_pressure)
      end do
   end subroutine begin_coarse

   !> Keep the residuals of touching nodes apart, and leave those of flowing nodes: touching nodes hand theirs to touching nodes of
   !> the coarse level alone. In the equation of a flowing node they would be a source that the motion carries through the contact.
   subroutine separate_touching(boundary, residual)
      type(boundary_film_t), intent(inout) :: boundary
      !> Shape (nx, ny)
      real(dp), contiguous, intent(inout) :: residual(:, :)
      integer :: j

      if (.not. boundary%active) return
      do j = 1, size(residual, 2)
         boundary%touching_residual(:, j) = residual(:, j)*boundary%touching(:, j)
         residual(:, j) = residual(:, j) - boundary%touching_residual(:, j)
      end do
   end subroutine separate_touching

   !> Put the restricted residuals of touching nodes into row j of a coarse grid
   pure subroutine restrict_touching(boundary, fine, coarse, step, j, residual)
      type(boundary_film_t), intent(in) :: boundary
      !> As for begin_coarse
      type(boundary_film_t), intent(in) :: fine
      type(grid_t), intent(in) :: coarse
      integer, intent(in) :: step(2), j
      !> Shape (nx)
      real(dp), contiguous, intent(inout) :: residual(:)
      real(dp) :: restricted(size(residual))

      if (.not. boundary%active) return
      call weight_row(coarse, step, fine%touching_residual, j, restricted)
      residual = merge(restricted, residual, boundary%touching(:, j) > 0.0_dp)
   end subroutine restrict_touching

   !> Take out of row j of a change of the film the nodes that do not yield: a film that comes of pressures which nodes do not take
   !> on says nothing about whether they yield
   pure subroutine keep_film(boundary, j, change)
      type(boundary_film_t), intent(in) :: boundary
      integer, intent(in) :: j
      !> Shape (nx)
      real(dp), contiguous, intent(inout) :: change(:)
      if (boundary%yields) change = merge(0.0_dp, change, boundary%yield_mass(:, j) > 0.0_dp)
   end subroutine keep_film
end module ehl_touching_nodes

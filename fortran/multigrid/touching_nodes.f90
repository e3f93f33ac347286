! SPDX-License-Identifier: BSD-3-Clause
!> Touching nodes (boundary_film.f90) in sweeps, line systems and coarse problems, and the cycles they need
submodule (ehl_boundary_film) ehl_touching_nodes
   use ehl_coarse_problem, only: weight_row
   use ehl_level, only: cavity_pressure
   implicit none (type, external)

   !> Minimum cycle limit per node along X: trapped lubricant moves about three nodes per cycle, through at most half of the nodes
   real(dp), parameter :: cycles_per_node = 0.5_dp
   !> Relative load error above which the cycles are stopped, and the cycles made before this test
   real(dp), parameter :: max_load_error = 1.0_dp
   integer, parameter :: load_test_after = 10

contains

   module procedure max_flowing_conductance
      integer :: i

      if (.not. self%active) return
      do i = 2, size(values) - 1
         values(i) = max(of(i, j), of(i - 1, j), of(i + 1, j), of(i, north), of(i, south))
      end do

   contains

      !> Conductance of a node if it flows, else 0
      pure real(dp) function of(k, l)
         integer, intent(in) :: k, l
         of = merge(eps(k, l)*(1.0_dp - self%touching(k, l)), 0.0_dp, p(k, l) > cavity_pressure)
      end function of
   end procedure max_flowing_conductance

   module procedure max_conductance_of_rows
      if (.not. self%active) return
      values = max(eps(:, south)*(1.0_dp - self%touching(:, south)), eps(:, j)*(1.0_dp - self%touching(:, j)), &
                   eps(:, north)*(1.0_dp - self%touching(:, north)))
   end procedure max_conductance_of_rows

   module procedure mark_dipoles
      if (.not. self%active) return
      where (p > cavity_pressure) dipole = max(dipole, self%touching(:, j))
   end procedure mark_dipoles

   module procedure last_touching
      i = 2
      if (.not. self%active) return
      do i = size(mass_content) - 1, 3, -1
         if (self%touching(i, j) > 0.0_dp .and. mass_content(i) < self%thickness) return
      end do
      i = 2
   end procedure last_touching

   module procedure line_residuals
      real(dp) :: row(size(rhs, 1))
      integer :: l

      any_touches = .false.
      if (.not. self%active) return
      do l = 1, size(rows)
         touching(l, :last) = self%touching(:last, rows(l))
         ! yielding nodes are marked as touching, too
         if (.not. any(self%touching(:last, rows(l)) > 0.0_dp)) cycle
         any_touches = .true.
         row(2:last) = residual(l, 2:last)
         call self%residual_row(rhs(:, rows(l)), mass_content(:, rows(l)), rows(l), row)
         residual(l, 2:last) = row(2:last)
      end do
   end procedure line_residuals

   module procedure begin_coarse
      integer :: j

      if (.not. self%active) return
      self%frozen = .true.
      self%yielding%coarse = .true.
      call self%yielding%forget()
      self%rate = fine%rate
      do j = 1, coarse%ny
         call weight_row(coarse, step, fine%touching, j, self%touching(:, j))
         self%touching(:, j) = merge(1.0_dp, 0.0_dp, self%touching(:, j) > 0.5_dp .and. p(:, j) > cavity_pressure)
      end do
   end procedure begin_coarse

   module procedure end_coarse
      self%frozen = .false.
      self%yielding%coarse = .false.
   end procedure end_coarse

   module procedure separate_residual
      integer :: j

      if (.not. self%active) return
      do j = 1, size(residual, 2)
         self%touching_residual(:, j) = residual(:, j)*self%touching(:, j)
         residual(:, j) = residual(:, j) - self%touching_residual(:, j)
      end do
   end procedure separate_residual

   module procedure restrict_residual
      real(dp) :: restricted(size(residual))

      if (.not. self%active) return
      call weight_row(coarse, step, fine%touching_residual, j, restricted)
      residual = merge(restricted, residual, self%touching(:, j) > 0.0_dp)
   end procedure restrict_residual

   module procedure cycle_limit
      cycle_limit = usual
      if (self%active) cycle_limit = max(usual, int(cycles_per_node*nodes))
   end procedure cycle_limit

   module procedure load_diverges
      load_diverges = self%active .and. cycles > load_test_after .and. abs(load_error) > max_load_error
   end procedure load_diverges
end submodule ehl_touching_nodes

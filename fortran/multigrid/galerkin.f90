! SPDX-License-Identifier: BSD-3-Clause
!> Alcouffe coarsening: the coarse operator P^T A P of a nine-point operator A and a transfer P (alcouffe.f90)
module ehl_galerkin
   use, intrinsic :: iso_fortran_env, only: int64
   use ehl_alcouffe, only: transfer_t
   use ehl_grid, only: grid_t
   use ehl_kinds, only: dp
   use ehl_level, only: cavity_pressure, level_t
   use ehl_nine_point, only: nine_point_t
   use ehl_status, only: ehl_no_memory, status_t
   implicit none (type, external)
   private
   public :: build_galerkin, coarsening_t, galerkin_product, product_work_t

   !> Interpolation depends on the operator where conductance/mesh-size^2 (the smaller one) in the neighbourhood is above this;
   !> elsewhere the deflection, which is not part of the operator, matters and interpolation is bilinear
   real(dp), parameter :: dependent_from = 10.0_dp

   !> Contributions of the cells above a coarse row to the next row's couplings, shape (0:nx, ny)
   type :: product_work_t
      real(dp), allocatable :: above_east(:, :), above_excess(:, :)
   contains
      procedure :: setup => setup_work
   end type product_work_t

   !> Transfer between a grid and the next coarser one, and its input. Nothing is allocated before setup.
   type :: coarsening_t
      type(transfer_t) :: transfer
      !> Operator of the fine grid unless that is a product itself; 1 at free nodes; 1 where interpolation depends on the operator
      type(nine_point_t) :: a
      real(dp), allocatable :: free(:, :), dependent(:, :)
      type(product_work_t) :: work
   contains
      procedure :: setup => setup_coarsening
      procedure :: bytes
   end type coarsening_t

contains

   !> Allocate for a coarse grid
   subroutine setup_work(self, coarse, status)
      class(product_work_t), intent(inout) :: self
      type(grid_t), intent(in) :: coarse
      type(status_t), intent(inout) :: status
      integer :: stat

      if (status%failed()) return
      allocate (self%above_east(0:coarse%nx, coarse%ny), self%above_excess(0:coarse%nx, coarse%ny), source=0.0_dp, stat=stat)
      if (stat /= 0) call status%fail(ehl_no_memory, "no memory for a Galerkin product")
   end subroutine setup_work

   !> Allocate; threads: OpenMP threads to use
   subroutine setup_coarsening(self, fine, coarse, threads, parallel, status)
      class(coarsening_t), intent(inout) :: self
      type(grid_t), intent(in) :: fine, coarse
      integer, intent(in) :: threads
      logical, intent(in) :: parallel
      type(status_t), intent(inout) :: status
      integer :: stat

      call self%transfer%setup(coarse, threads, parallel, status)
      call self%work%setup(coarse, status)
      call self%a%setup(fine, status)
      if (status%failed()) return
      allocate (self%free(fine%nx, fine%ny), self%dependent(fine%nx, fine%ny), stat=stat)
      if (stat /= 0) call status%fail(ehl_no_memory, "no memory for the grid transfer")
   end subroutine setup_coarsening

   !> Allocated bytes
   pure integer(int64) function bytes(self)
      class(coarsening_t), intent(in) :: self

      bytes = self%transfer%bytes() + self%a%bytes()
      if (allocated(self%free)) bytes = bytes + 16*(size(self%free, kind=int64) + size(self%work%above_east, kind=int64))
   end function bytes

   !> coarse = P^T fine P.
   !>
   !> Taken as an energy, a coupling o between two fine nodes is o (u_1 - u_2)^2 and an excess s is
   !> s u^2, where u = sum of weights times coarse values. Each of them lies inside one coarse
   !> cell, on one coarse edge or at one coarse node, and adds to the couplings there.
   subroutine galerkin_product(fine, transfer, work, coarse)
      type(nine_point_t), intent(in) :: fine
      type(transfer_t), intent(in) :: transfer
      !> Set up for the coarse grid
      type(product_work_t), intent(inout) :: work
      !> Set up for the coarse grid
      type(nine_point_t), intent(inout) :: coarse
      integer :: j

      coarse%five = .false.
      !$omp parallel do default(none) shared(fine, transfer, work, coarse) &
      !$omp num_threads(transfer%threads) if(transfer%parallel) schedule(static)
      do j = 1, transfer%ny
         call nodes_and_edges(fine, transfer, j, coarse%east(:, j), coarse%excess(:, j))
         coarse%north(:, j) = 0.0_dp
         coarse%north_east(:, j) = 0.0_dp
         coarse%north_west(:, j) = 0.0_dp
         if (j <= transfer%between) call cells(fine, transfer, j, coarse, work%above_east(:, j), work%above_excess(:, j))
      end do
      !$omp end parallel do
      !$omp parallel do default(none) shared(transfer, work, coarse) &
      !$omp num_threads(transfer%threads) if(transfer%parallel) schedule(static)
      do j = 1, transfer%ny
         if (transfer%south(j) == 0) cycle
         coarse%east(:, j) = coarse%east(:, j) + work%above_east(:, transfer%south(j))
         coarse%excess(:, j) = coarse%excess(:, j) + work%above_excess(:, transfer%south(j))
      end do
      !$omp end parallel do
   end subroutine galerkin_product

   !> Coarse nodes of row j and the edges between them
   pure subroutine nodes_and_edges(fine, transfer, j, east, excess)
      type(nine_point_t), intent(in) :: fine
      type(transfer_t), intent(in) :: transfer
      integer, intent(in) :: j
      !> Shape (0:nx)
      real(dp), intent(out) :: east(0:), excess(0:)
      real(dp) :: o, s(2), w(2)
      integer :: i, l

      l = 2*j - 1
      east = 0.0_dp
      excess = 0.0_dp
      do i = 1, transfer%nx - 1
         w = transfer%along_x(:, i, j)
         o = 0.0_dp
         s = 0.0_dp
         call add_pair(fine%east(2*i - 1, l), [transfer%free(i, j) - w(1), -w(2)], o, s)
         call add_pair(fine%east(2*i, l), [-w(1), transfer%free(i + 1, j) - w(2)], o, s)
         if (.not. fine%five) call add_pair(fine%excess(2*i, l), w, o, s)
         east(i) = o
         excess(i) = excess(i) + s(1) + fine%excess(2*i - 1, l)*transfer%free(i, j)
         excess(i + 1) = s(2)
      end do
   end subroutine nodes_and_edges

   !> Cells between coarse rows j and j+1, and the edges between these rows
   pure subroutine cells(fine, transfer, j, coarse, above_east, above_excess)
      type(nine_point_t), intent(in) :: fine
      type(transfer_t), intent(in) :: transfer
      integer, intent(in) :: j
      !> Row j is changed
      type(nine_point_t), intent(inout) :: coarse
      !> Contributions to row j+1, shape (0:nx)
      real(dp), intent(out) :: above_east(0:), above_excess(0:)
      real(dp), dimension(4) :: c, e, n, s, w, corner, excess
      !> Couplings of a cell's corners: sw-se, sw-nw, sw-ne, se-nw, se-ne, nw-ne
      real(dp) :: o(6), pair, ends(2)
      integer :: i, k, l, above

      above_east = 0.0_dp
      above_excess = 0.0_dp
      l = 2*j
      above = transfer%north(j)
      do i = 1, transfer%nx
         k = 2*i
         w = [transfer%along_y(1, i, j), 0.0_dp, transfer%along_y(2, i, j), 0.0_dp]
         pair = 0.0_dp
         ends = 0.0_dp
         call add_pair(fine%north(k - 1, l - 1), [transfer%free(i, j) - w(1), -w(3)], pair, ends)
         call add_pair(fine%north(k - 1, l), [-w(1), transfer%free(i, above) - w(3)], pair, ends)
         if (.not. fine%five) call add_pair(fine%excess(k - 1, l), w([1, 3]), pair, ends)
         coarse%north(i, j) = coarse%north(i, j) + pair
         coarse%excess(i, j) = coarse%excess(i, j) + ends(1)
         above_excess(i) = above_excess(i) + ends(2)
         if (i == transfer%nx) cycle
         e = [0.0_dp, transfer%along_y(1, i + 1, j), 0.0_dp, transfer%along_y(2, i + 1, j)]
         s = [transfer%along_x(1, i, j), transfer%along_x(2, i, j), 0.0_dp, 0.0_dp]
         n = [0.0_dp, 0.0_dp, transfer%along_x(1, i, above), transfer%along_x(2, i, above)]
         c = transfer%centre(:, i, j)
         o = 0.0_dp
         excess = 0.0_dp
         call add_cell(fine%east(k - 1, l), c - w, o, excess)
         call add_cell(fine%east(k, l), c - e, o, excess)
         call add_cell(fine%north(k, l - 1), c - s, o, excess)
         call add_cell(fine%north(k, l), c - n, o, excess)
         if (.not. fine%five) then
            corner = [transfer%free(i, j), transfer%free(i + 1, j), transfer%free(i, above), transfer%free(i + 1, above)]
            call add_cell(fine%excess(k, l), c, o, excess)
            call add_cell(fine%north_east(k - 1, l - 1), c - [corner(1), 0.0_dp, 0.0_dp, 0.0_dp], o, excess)
            call add_cell(fine%north_west(k + 1, l - 1), c - [0.0_dp, corner(2), 0.0_dp, 0.0_dp], o, excess)
            call add_cell(fine%north_west(k, l), c - [0.0_dp, 0.0_dp, corner(3), 0.0_dp], o, excess)
            call add_cell(fine%north_east(k, l), c - [0.0_dp, 0.0_dp, 0.0_dp, corner(4)], o, excess)
            call add_cell(fine%north_east(k - 1, l), n - w, o, excess)
            call add_cell(fine%north_west(k + 1, l), n - e, o, excess)
            call add_cell(fine%north_east(k, l - 1), e - s, o, excess)
            call add_cell(fine%north_west(k, l - 1), w - s, o, excess)
         end if
         coarse%east(i, j) = coarse%east(i, j) + o(1)
         coarse%north(i, j) = coarse%north(i, j) + o(2)
         coarse%north_east(i, j) = o(3)
         coarse%north_west(i + 1, j) = o(4)
         coarse%north(i + 1, j) = o(5)
         above_east(i) = o(6)
         coarse%excess(i:i + 1, j) = coarse%excess(i:i + 1, j) + excess(1:2)
         above_excess(i:i + 1) = above_excess(i:i + 1) + excess(3:4)
      end do
   end subroutine cells

   !> Energy o (sum of d times values)^2 of a coupling on an edge
   pure subroutine add_pair(o, d, pair, excess)
      real(dp), intent(in) :: o, d(2)
      real(dp), intent(inout) :: pair, excess(2)

      pair = pair - o*d(1)*d(2)
      excess = excess + o*d*(d(1) + d(2))
   end subroutine add_pair

   !> Energy o (sum of d times corner values)^2 of a coupling in a cell
   pure subroutine add_cell(o, d, pairs, excess)
      real(dp), intent(in) :: o, d(4)
      real(dp), intent(inout) :: pairs(6), excess(4)
      real(dp) :: t(4)

      t = o*d
      pairs = pairs - [t(1)*d(2), t(1)*d(3), t(1)*d(4), t(2)*d(3), t(2)*d(4), t(3)*d(4)]
      excess = excess + t*((d(1) + d(2)) + (d(3) + d(4)))
   end subroutine add_cell

   !> Transfer from the fine operator, and the Poiseuille operator of the coarse level. That operator is frozen while the
   !> coarse level is solved: if it followed P and H of that level, the cycle would diverge in the contact.
   subroutine build_galerkin(fine, coarse, coarsening)
      type(level_t), intent(in) :: fine
      type(level_t), intent(inout) :: coarse
      type(coarsening_t), intent(inout) :: coarsening
      real(dp) :: limit, largest(fine%grid%nx)
      integer :: i, j, first, last

      first = fine%grid%first_inner()
      last = fine%grid%last_inner()
      limit = dependent_from*min(fine%grid%hx, fine%grid%hy)**2
      coarsening%free = 0.0_dp
      coarsening%dependent = 0.0_dp
      !$omp parallel do default(none) shared(fine, coarsening, first, last, limit) private(i, largest) &
      !$omp num_threads(fine%threads) if(fine%parallel) schedule(static)
      do j = first, last
         call fine%flow%max_neighbour_conductance(j, fine%grid%south(j), fine%grid%north(j), largest)
         do i = 2, fine%grid%nx - 1
            if (fine%p(i, j) > cavity_pressure) coarsening%free(i, j) = 1.0_dp
            if (largest(i) >= limit) coarsening%dependent(i, j) = 1.0_dp
         end do
      end do
      !$omp end parallel do
      if (fine%poiseuille%frozen) then
         call coarsen(fine%poiseuille%product)
      else
         call five_point(fine, coarsening%a)
         call coarsen(coarsening%a)
      end if
      coarse%poiseuille%frozen = .true.

   contains

      !> Transfer and coarse operator of a fine operator
      subroutine coarsen(a)
         type(nine_point_t), intent(in) :: a

         call coarsening%transfer%find_weights(a, coarsening%free, coarsening%dependent)
         call galerkin_product(a, coarsening%transfer, coarsening%work, coarse%poiseuille%product)
      end subroutine coarsen
   end subroutine build_galerkin

   !> The five-point Poiseuille operator of a level, integrated over the cells
   subroutine five_point(level, a)
      type(level_t), intent(in) :: level
      type(nine_point_t), intent(inout) :: a
      integer :: j

      a%five = .true.
      !$omp parallel do default(none) shared(level, a) &
      !$omp num_threads(level%threads) if(level%parallel) schedule(static)
      do j = 1, level%grid%last_inner()
         call level%poiseuille%integrate(level%flow, j, j, a)
      end do
      !$omp end parallel do
   end subroutine five_point
end module ehl_galerkin

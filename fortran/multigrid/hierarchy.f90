! SPDX-License-Identifier: BSD-3-Clause
!> The grids of a multigrid solution, coarsest first
module ehl_hierarchy
   use, intrinsic :: iso_fortran_env, only: int64
   use ehl_alcouffe, only: transfer_t
   use ehl_coarsest, only: coarsest_t
   use ehl_cycle, only: coarsening_classical, cycle_options_t, finest_cycle
   use ehl_deflection_factory, only: new_deflection
   use ehl_grid, only: grid_t
   use ehl_kinds, only: dp
   use ehl_level, only: level_t
   use ehl_lubricant, only: lubricant_t
   use ehl_status, only: ehl_no_memory, status_t
   implicit none (type, external)
   private
   public :: hierarchy_t, deflection_accuracy

   type :: hierarchy_t
      type(level_t), allocatable :: levels(:)
      !> Operator-dependent transfer between each level and the next coarser one; set up when first used
      type(transfer_t), allocatable :: transfers(:)
      type(coarsest_t) :: coarsest
      type(cycle_options_t) :: options
      !> Levels that have been set up
      integer :: ready = 0
      character(len=:), allocatable :: engine
   contains
      procedure :: setup
      procedure :: grow
      procedure :: coarsen
      procedure :: cycle => run_cycle
      procedure :: forget
      procedure :: bytes
   end type hierarchy_t

contains

   !> Levels from the coarsest grid on; only the coarsest one gets its arrays yet
   subroutine setup(self, coarsest, n, lubricant, speed_parameter, engine, options, threads, status)
      class(hierarchy_t), intent(inout) :: self
      !> Coarsest grid, and how many levels there are to be at the most
      type(grid_t), intent(in) :: coarsest
      integer, intent(in) :: n
      type(lubricant_t), intent(in) :: lubricant
      real(dp), intent(in) :: speed_parameter
      !> Deflection engine
      character(len=*), intent(in) :: engine
      type(cycle_options_t), intent(in) :: options
      integer, intent(in) :: threads
      type(status_t), intent(inout) :: status
      integer :: k, stat

      if (status%failed()) return
      self%ready = 0
      self%engine = engine
      self%options = options
      if (allocated(self%levels)) deallocate (self%levels, self%transfers)
      allocate (self%levels(n), self%transfers(n), stat=stat)
      if (stat /= 0) then
         call status%fail(ehl_no_memory, "no memory for the grid levels")
         return
      end if
      do k = 1, n
         self%levels(k)%lubricant = lubricant
         self%levels(k)%inverse_speed = 1.0_dp/speed_parameter
         self%levels(k)%threads = threads
      end do
      self%levels(1)%grid = coarsest
      call self%coarsest%setup(coarsest, status)
      call self%grow(1, status)
   end subroutine setup

   !> Set up the levels as far as level n
   subroutine grow(self, n, status)
      class(hierarchy_t), intent(inout) :: self
      integer, intent(in) :: n
      type(status_t), intent(inout) :: status
      integer :: k

      do k = self%ready + 1, n
         associate (level => self%levels(k))
            if (k > 1) level%grid = self%levels(k - 1)%grid%finer()
            call level%setup(status)
            if (status%failed()) return
            call new_deflection(self%engine, level%engine, status)
            if (status%failed()) return
            call level%engine%setup(level%grid, deflection_accuracy(level%grid), level%threads, status)
            if (status%failed()) return
         end associate
         self%ready = k
      end do
   end subroutine grow

   !> Coarsen in this way from now on. What only Alcouffe's needs is allocated when it is first asked for.
   subroutine coarsen(self, coarsening, status)
      class(hierarchy_t), intent(inout) :: self
      !> coarsening_classical or coarsening_alcouffe, of ehl_cycle
      integer, intent(in) :: coarsening
      type(status_t), intent(inout) :: status
      integer :: k

      if (status%failed()) return
      self%options%coarsening = coarsening
      if (coarsening == coarsening_classical) return
      do k = 2, self%ready
         if (self%transfers(k)%nx > 0) cycle
         associate (fine => self%levels(k), coarse => self%levels(k - 1))
            call coarse%poiseuille%prepare_product(status)
            call self%transfers(k)%setup(fine%grid, coarse%grid, fine%threads, fine%parallel, status)
         end associate
         if (status%failed()) return
      end do
   end subroutine coarsen

   !> Error of the deflection, relative to its largest value, that stays below a tenth of the
   !> discretisation error of a piecewise-constant Hertz pressure (2.2e-4 at h = 1/128)
   pure real(dp) function deflection_accuracy(grid)
      type(grid_t), intent(in) :: grid
      deflection_accuracy = 2.2e-5_dp*(128.0_dp*max(grid%hx, grid%hy))**1.35_dp
   end function deflection_accuracy

   !> One multigrid cycle with level n as the finest
   subroutine run_cycle(self, n, residual, sweeps)
      class(hierarchy_t), intent(inout) :: self
      integer, intent(in) :: n
      !> What is left (rms)
      real(dp), intent(out) :: residual
      !> Sweeps made on level n
      integer, intent(out), optional :: sweeps

      call finest_cycle(self%levels, self%transfers, n, self%coarsest, self%options, residual, sweeps)
   end subroutine run_cycle

   !> Drop what one cycle leaves for the next beyond the fields of its finest level
   subroutine forget(self)
      class(hierarchy_t), intent(inout) :: self
      self%coarsest%factored = .false.
   end subroutine forget

   !> Allocated bytes
   pure integer(int64) function bytes(self)
      class(hierarchy_t), intent(in) :: self
      integer :: k

      bytes = self%coarsest%bytes()
      do k = 1, self%ready
         bytes = bytes + self%levels(k)%bytes() + self%levels(k)%engine%bytes() + self%transfers(k)%bytes()
      end do
   end function bytes
end module ehl_hierarchy

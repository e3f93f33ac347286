! SPDX-License-Identifier: BSD-3-Clause
!> Elastic deflection of the half-space: interface of all engines
module ehl_deflection
   use, intrinsic :: iso_fortran_env, only: int64
   use ehl_kinds, only: dp
   use ehl_grid, only: grid_t
   use ehl_status, only: status_t
   implicit none (type, external)
   private
   public :: deflection_t

   !> Elastic deflection W = k_b iint P dX' dY' / r on one grid, P piecewise constant on cells of hx x hy
   !> centred at the nodes; a strip includes its periodic images, and its mean over Y is -2 k_b int P ln|X - X'| dX'.
   !> P is scaled by the Hertz pressure, W by a^2/R.
   type, abstract :: deflection_t
   contains
      !> Prepare for a grid: kernels, plans, work arrays
      procedure(setup_i), deferred :: setup
      !> W = K P
      procedure(apply_i), deferred :: apply
      !> Allocated bytes
      procedure(bytes_i), deferred :: bytes
   end type deflection_t

   abstract interface
      !> Prepare for a grid
      subroutine setup_i(self, grid, factor, accuracy, threads, status)
         import :: deflection_t, grid_t, dp, status_t
         implicit none (type, external)
         class(deflection_t), intent(inout) :: self
         type(grid_t), intent(in) :: grid
         !> k_b
         real(dp), intent(in) :: factor
         !> Maximum error allowed, relative to the maximum deflection; engines that are exact
         !> to rounding ignore it
         real(dp), intent(in) :: accuracy
         !> OpenMP threads to use; the result does not depend on it
         integer, intent(in) :: threads
         type(status_t), intent(inout) :: status
      end subroutine setup_i

      !> W = K P over the whole contact (mirror image included on a folded grid)
      subroutine apply_i(self, p, w)
         import :: deflection_t, dp
         implicit none (type, external)
         class(deflection_t), intent(inout) :: self
         real(dp), intent(in) :: p(:, :)
         real(dp), intent(out) :: w(:, :)
      end subroutine apply_i

      !> Allocated bytes
      pure integer(int64) function bytes_i(self)
         import :: deflection_t, int64
         implicit none (type, external)
         class(deflection_t), intent(in) :: self
      end function bytes_i
   end interface
end module ehl_deflection

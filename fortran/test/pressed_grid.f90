! SPDX-License-Identifier: BSD-3-Clause
!> Grids and pressures for the tests of the deflection
module pressed_grid
   use ehl_grid, only: grid_t, new_grid
   use ehl_kinds, only: dp
   implicit none (type, external)
   private
   public :: hertz, inlet, random, patch, kind_name, press, some_grid, grids, named

   !> Kinds of pressure
   integer, parameter :: hertz = 1, inlet = 2, random = 3, patch = 4
   character(len=*), parameter :: kind_name(4) = [character(len=6) :: &
      "Hertz", "inlet", "random", "patch"]
   !> Number of grids
   integer, parameter :: grids = 11

contains

   !> A pressure p of a given kind
   subroutine press(which, grid, p)
      integer, intent(in) :: which
      type(grid_t), intent(in) :: grid
      real(dp), allocatable, intent(out) :: p(:, :)
      real(dp) :: r, seed
      integer :: i, j

      allocate (p(grid%nx, grid%ny))
      seed = 0.5_dp
      do j = 1, grid%ny
         do i = 1, grid%nx
            r = hypot(grid%x(i), grid%y(j))
            seed = modulo(seed*997.0_dp + 0.1234567_dp, 1.0_dp)
            select case (which)
            case (hertz)
               p(i, j) = sqrt(max(0.0_dp, 1.0_dp - r**2))
            case (inlet)
               p(i, j) = sqrt(max(0.0_dp, 1.0_dp - r**2))
               if (grid%x(i) < 0.0_dp) p(i, j) = max(p(i, j), 0.3_dp*exp(-3.0_dp*r))
            case (random)
               p(i, j) = seed
            case default
               p(i, j) = 0.0_dp
               if (abs(grid%x(i) - 0.3_dp) < 0.6_dp .and. abs(grid%y(j)) < 0.7_dp) then
                  p(i, j) = 0.5_dp + seed
               end if
            end select
         end do
      end do
   end subroutine press

   !> Different grids: odd and even numbers of halvings, hx /= hy, sides of
   !> different lengths and numbers of nodes, whole and folded
   type(grid_t) function some_grid(number)
      integer, intent(in) :: number

      select case (number)
      case (1)
         some_grid = new_grid(17, 17, -2.5_dp, 1.5_dp, 2.0_dp, .false.)
      case (2)
         some_grid = new_grid(65, 65, -2.5_dp, 1.5_dp, 2.0_dp, .false.)
      case (3)
         some_grid = new_grid(65, 65, -2.5_dp, 1.5_dp, 2.0_dp, .true.)
      case (4)
         some_grid = new_grid(63, 63, -2.5_dp, 1.5_dp, 3.1_dp, .true.)
      case (5)
         some_grid = new_grid(47, 47, -3.5_dp, 1.5_dp, 1.5_dp, .false.)
      case (6)
         some_grid = grid_t(nx=81, ny=21, x0=-2.5_dp, y0=-1.2_dp, hx=0.05_dp, hy=0.12_dp)
      case (7, 8)
         some_grid = new_grid(33, 161, -2.5_dp, 1.5_dp, 20.0_dp, number == 8)
      case (9, 10)
         some_grid = new_grid(129, 49, -2.5_dp, 1.5_dp, 0.9_dp, number == 10)
      case default
         some_grid = grid_t(nx=30, ny=40, x0=-1.7_dp, y0=0.0_dp, hx=0.11_dp, hy=0.04_dp, &
                            mirror=.true.)
      end select
   end function some_grid

   !> Description of a grid
   function named(grid) result(name)
      type(grid_t), intent(in) :: grid
      character(len=:), allocatable :: name
      character(len=60) :: text

      write (text, "(i0, ' x ', i0, a)") grid%nx, grid%ny, merge(" folded", "       ", grid%mirror)
      name = trim(text)
   end function named
end module pressed_grid

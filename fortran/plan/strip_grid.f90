! SPDX-License-Identifier: BSD-3-Clause
!> Grid of a line contact: a strip whose width is the period of its surfaces along the line
module ehl_strip_grid
   use ehl_grid, only: grid_t, new_strip
   use ehl_kinds, only: dp
   use ehl_status, only: ehl_bad_input, status_t
   use ehl_text, only: short, to_text
   implicit none (type, external)
   private
   public :: make_strip

   !> Maximum number of rows of the finest grid
   integer, parameter :: max_rows = 16384

contains

   !> Make the coarsest grid, with nearly square cells: an even number of rows, or one row if nothing varies along Y
   subroutine make_strip(width, intervals, levels, x_inlet, x_outlet, mirror, alcouffe, coarsest, status)
      !> Width; 0: nothing varies along Y; negative: the surfaces have no common period
      real(dp), intent(in) :: width
      !> Intervals of the coarsest grid along X, and number of levels
      integer, intent(in) :: intervals, levels
      real(dp), intent(in) :: x_inlet, x_outlet
      !> Whether half of the strip is enough, and whether operator-dependent transfers are requested
      logical, intent(in) :: mirror, alcouffe
      type(grid_t), intent(inout) :: coarsest
      type(status_t), intent(inout) :: status
      character(len=1), parameter :: newline = new_line("a")
      real(dp) :: rows

      if (width < 0.0_dp) then
         call status%fail(ehl_bad_input, "the two surfaces of a line contact have no common period across the motion"//newline// &
                          "expected: lengths across the motion one of which is a whole multiple of the other; of a "// &
                          "single feature it is spacing_y")
         return
      end if
      rows = 2.0_dp*max(1.0_dp, anint(0.5_dp*width*intervals/(x_outlet - x_inlet)))
      if (rows*2.0_dp**(levels - 1) > max_rows) then
         call status%fail(ehl_bad_input, "a line contact whose surfaces repeat after "//short(width)//" b has "// &
                          short(rows*2.0_dp**(levels - 1))//" rows of nodes on this grid"//newline//"expected: at most "// &
                          to_text(max_rows)//" rows: fewer grid.points, shorter surfaces, or wavelength_y = 1e6 for a wave "// &
                          "that does not vary along the line")
         return
      end if
      if (.not. width > 0.0_dp) then
         rows = 1.0_dp
         if (alcouffe) call status%fail(ehl_bad_input, "solver.coarsening = 'alcouffe' where nothing varies along a line"// &
                                        newline//"expected: 'auto' or 'classical'")
      end if
      coarsest = new_strip(intervals + 1, nint(rows), x_inlet, x_outlet, width, mirror)
   end subroutine make_strip
end module ehl_strip_grid

! SPDX-License-Identifier: BSD-3-Clause
!> The layout of a state of a transient run on disk: each routine serves writing and reading
module ehl_checkpoint_layout
   use ehl_binary_file, only: binary_file_t
   use ehl_file_extent, only: extent_t
   use ehl_frames, only: frames_t
   use ehl_grid, only: grid_t
   use ehl_kinds, only: dp
   use ehl_status, only: status_t
   use ehl_table, only: table_t
   use ehl_transient, only: transient_t
   implicit none (type, external)
   private
   public :: family, head_t, magic, pass_body, pass_frame, pass_head, pass_row

   !> What a state begins with: its last character counts the layouts
   character(len=*), parameter :: magic = "ehl checkpoint v9", family = magic(:len(magic) - 1)

   !> What a state begins with
   type :: head_t
      character(len=len(magic)) :: version = magic
      integer :: step = 0, frames = 0
      !> How much of the growing files belongs to the state
      type(extent_t) :: rows, pictures
      !> The case
      character(len=:), allocatable :: text
   end type head_t

contains

   !> The beginning of a state
   subroutine pass_head(file, head)
      type(binary_file_t), intent(inout) :: file
      type(head_t), intent(inout) :: head
      integer :: length

      call file%item(head%version)
      if (head%version /= magic) call file%refuse("it was written by another version of the program")
      call file%item(head%step)
      call file%item(head%frames)
      call file%item(head%rows)
      call file%item(head%pictures)
      length = 0
      if (file%writing) length = len(head%text)
      call file%item(length)
      if (file%failed()) return
      if (.not. file%writing) head%text = repeat(" ", length)
      call file%item(head%text)
   end subroutine pass_head

   !> What changes from step to step
   subroutine pass_body(file, transient, numbers)
      type(binary_file_t), intent(inout) :: file
      type(transient_t), intent(inout) :: transient
      real(dp), intent(inout) :: numbers(3)

      call file%item(transient%skipped)
      call file%item(transient%time)
      call file%item(transient%time_step)
      call file%item(transient%residual)
      call file%item(transient%cycles)
      call file%item(transient%total_cycles)
      call file%item(transient%total_sweeps)
      call file%item(transient%policy%coarsening)
      call file%item(transient%policy%changed_at)
      call file%item(transient%h00_before)
      call file%item(transient%friction_smooth)
      call file%item(transient%mass_content)
      call file%item(transient%p_before)
      call file%item(transient%predictor%weights)
      call file%item(transient%accuracy%rise)
      call file%item(transient%accuracy%sensitivity)
      call file%item(transient%accuracy%largest)
      call file%item(transient%film_mark)
      call file%item(transient%extremes%found)
      call file%item(numbers)
   end subroutine pass_body

   !> What step k adds to the history and to the mean
   subroutine pass_row(file, k, history, transient)
      type(binary_file_t), intent(inout) :: file
      integer, intent(in) :: k
      type(table_t), intent(inout) :: history
      type(transient_t), intent(inout) :: transient
      real(dp) :: row(history%n_columns()), values(3)

      associate (mean => transient%mean)
         if (file%writing) then
            row = history%row(k)
            values = [mean%values(k), mean%film(k), mean%roughness(k)]
         end if
         call file%item(row)
         call file%item(values)
         if (file%writing .or. file%failed()) return
         call history%append(row)
         call mean%append(values(1), values(2), values(3))
      end associate
   end subroutine pass_row

   !> Frame k
   subroutine pass_frame(file, k, frames, grid, status)
      type(binary_file_t), intent(inout) :: file
      integer, intent(in) :: k
      type(frames_t), intent(inout) :: frames
      type(grid_t), intent(in) :: grid
      type(status_t), intent(inout) :: status

      if (.not. file%writing) call frames%add(grid, status)
      if (status%failed()) return
      call file%item(frames%times(k))
      call file%item(frames%p(k)%values)
      call file%item(frames%h(k)%values)
   end subroutine pass_frame
end module ehl_checkpoint_layout

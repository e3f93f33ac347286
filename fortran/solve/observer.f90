! SPDX-License-Identifier: BSD-3-Clause
!> Observer, called after every cycle of a steady contact and after every time step except the last of a run, which may stop the
!> loop. A stopped loop continues at the next call.
module ehl_observer
   use ehl_contact_run, only: contact_run_t
   implicit none (type, external)
   private
   public :: observer_t, single_step_t

   !> Default observer: never stops
   type :: observer_t
   contains
      procedure :: watch
   end type observer_t

   !> Stops after one cycle or time step
   type, extends(observer_t) :: single_step_t
   contains
      procedure :: watch => watch_one
   end type single_step_t

contains

   !> Never stop
   subroutine watch(self, run, leave)
      class(observer_t), intent(inout) :: self
      !> After the cycle or step; its state may be saved
      type(contact_run_t), intent(inout) :: run
      logical, intent(out) :: leave

      associate (unused => self, unused_run => run)
      end associate
      leave = .false.
   end subroutine watch

   !> Always stop
   subroutine watch_one(self, run, leave)
      class(single_step_t), intent(inout) :: self
      type(contact_run_t), intent(inout) :: run
      logical, intent(out) :: leave

      call self%observer_t%watch(run, leave)
      leave = .true.
   end subroutine watch_one
end module ehl_observer

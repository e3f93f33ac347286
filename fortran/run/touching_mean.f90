! SPDX-License-Identifier: BSD-3-Clause
!> Contact at a boundary film over a run
module ehl_touching_mean
   use ehl_contact_run, only: contact_run_t
   use ehl_friction_mean, only: friction_mean_t
   use ehl_kinds, only: dp
   use ehl_touching, only: at_depth, known_names, touching_names
   implicit none (type, external)
   private
   public :: load_share_of, share_stop_error, touching_of

contains

   !> What reynolds/touching.f90 reads off the contact of a run that has converged; in time steps means over the time of the mean
   !> friction ratio, and the greatest depth
   function touching_of(run) result(numbers)
      class(contact_run_t), intent(in) :: run
      real(dp) :: numbers(size(touching_names))
      integer :: k, first

      if (run%in_steps) then
         first = run%transient%mean%first_of_mean()
         numbers = 0.0_dp
         do k = 1, known_names(run%plan%lubricant)
            associate (values => run%history%column(touching_names(k)))
               numbers(k) = sum(values(first:))/max(1, size(values) - first + 1)
               if (k == at_depth) numbers(k) = maxval(values(first:))
            end associate
         end do
      else if (run%resting) then
         numbers = run%rest%m%touching%numbers()
      else
         numbers = run%steady%results(run%level())%m%touching%numbers()
      end if
   end function touching_of

   !> The load share alone
   real(dp) function load_share_of(run)
      class(contact_run_t), intent(in) :: run
      real(dp) :: numbers(size(touching_names))

      numbers = touching_of(run)
      load_share_of = numbers(1)
   end function load_share_of

   !> Error of the load share by the end of the run: that of a mean over time, as of the friction ratio; else 0
   real(dp) function share_stop_error(run)
      class(contact_run_t), intent(in) :: run
      type(friction_mean_t) :: mean

      share_stop_error = 0.0_dp
      if (.not. run%in_steps) return
      mean = run%transient%mean
      mean%values = run%history%column(touching_names(1))
      share_stop_error = mean%uncertainty()
   end function share_stop_error
end module ehl_touching_mean

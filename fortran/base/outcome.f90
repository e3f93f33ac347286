! SPDX-License-Identifier: BSD-3-Clause
!> Status of a run
module ehl_outcome
   implicit none (type, external)
   private
   public :: outcome_running, outcome_converged, outcome_cycle_limit, outcome_diverged, outcome_negative_film, &
             outcome_target_missed, outcome_interrupted, outcome_unsettled, outcome_failed, outcome_names

   !> Running; converged; limit of cycles reached; not a number; a film that is not positive; target_error not reached on the
   !> largest grid; stopped from outside; mean friction not converged; ended by an error
   integer, parameter :: outcome_running = 0, outcome_converged = 1, outcome_cycle_limit = 2, &
                         outcome_diverged = 3, outcome_negative_film = 4, outcome_target_missed = 5, &
                         outcome_interrupted = 6, outcome_unsettled = 7, outcome_failed = 8
   !> Their names in summary.json
   character(len=*), parameter :: outcome_names(0:8) = [character(len=13) :: "running", "converged", "cycle limit", &
                                                        "diverged", "negative film", "target missed", &
                                                        "interrupted", "not settled", "failed"]
end module ehl_outcome

! SPDX-License-Identifier: BSD-3-Clause
!> Fourier sums at equidistant points with any start and spacing, exact and in O(n log n) operations: the chirp-z transform
!> (Bluestein 1970; Rabiner, Schafer & Rader 1969)
module ehl_chirp
   use, intrinsic :: iso_c_binding, only: c_double_complex, c_null_ptr, c_ptr
   use ehl_fftw, only: fftw_backward, fftw_execute_dft, fftw_forward
   use ehl_fftw_planner, only: drop_plan, good_size, plan_complex
   use ehl_kinds, only: dp, pi
   use ehl_status, only: ehl_no_memory, status_t
   implicit none (type, external)
   private
   public :: chirp_t

   integer, parameter :: zp = c_double_complex

   !> Sums over k = -waves ... waves of c(k) exp(2 pi i k (start + (j - 1) step)), j = 1 ... points
   type :: chirp_t
      private
      integer :: waves = 0, points = 0, n = 0
      !> Factors of the coefficients and of the sums, transform of the chirp, work space
      complex(zp), allocatable :: before(:), after(:), kernel(:), work(:)
      type(c_ptr) :: forward = c_null_ptr, backward = c_null_ptr
   contains
      procedure :: setup
      procedure :: apply
      procedure :: clear
   end type chirp_t

contains

   !> Prepare; start and step in periods
   subroutine setup(self, waves, points, start, step, status)
      class(chirp_t), intent(inout) :: self
      integer, intent(in) :: waves, points
      real(dp), intent(in) :: start, step
      type(status_t), intent(inout) :: status
      integer :: k, stat

      if (status%failed()) return
      self%waves = waves
      self%points = points
      self%n = good_size(points + 2*waves)
      allocate (self%before(-waves:waves), self%after(0:points - 1), self%kernel(0:self%n - 1), self%work(0:self%n - 1), &
                stat=stat)
      if (stat /= 0) then
         call status%fail(ehl_no_memory, "no memory for the Fourier sums of a height map")
         return
      end if
      call plan_complex(self%forward, self%n, self%work, fftw_forward, status)
      call plan_complex(self%backward, self%n, self%work, fftw_backward, status)
      if (status%failed()) return
      ! k j = (k^2 + j^2 - (j - k)^2)/2
      do k = -waves, waves
         self%before(k) = phase_factor(modulo(k*start, 1.0_dp))*phase_factor(half_square(k, step))
      end do
      do k = 0, points - 1
         self%after(k) = phase_factor(half_square(k, step))/self%n
      end do
      self%work = (0.0_dp, 0.0_dp)
      do k = -waves, points - 1 + waves
         self%work(modulo(k, self%n)) = conjg(phase_factor(half_square(k, step)))
      end do
      call fftw_execute_dft(self%forward, self%work, self%work)
      self%kernel = self%work
   end subroutine setup

   !> The sums of the coefficients c(-waves:waves)
   subroutine apply(self, c, sums)
      class(chirp_t), intent(inout) :: self
      complex(zp), intent(in) :: c(:)
      complex(zp), intent(out) :: sums(:)

      associate (w => self%waves)
         self%work(:2*w) = c*self%before
         self%work(2*w + 1:) = (0.0_dp, 0.0_dp)
         call fftw_execute_dft(self%forward, self%work, self%work)
         self%work = self%work*self%kernel
         call fftw_execute_dft(self%backward, self%work, self%work)
         sums = self%after*self%work(w:w + self%points - 1)
      end associate
   end subroutine apply

   !> Release the plans
   subroutine clear(self)
      class(chirp_t), intent(inout) :: self
      call drop_plan(self%forward)
      call drop_plan(self%backward)
   end subroutine clear

   !> exp(2 pi i t)
   elemental complex(zp) function phase_factor(t)
      real(dp), intent(in) :: t
      phase_factor = cmplx(cos(2.0_dp*pi*t), sin(2.0_dp*pi*t), zp)
   end function phase_factor

   !> step k^2/2, without whole periods
   elemental real(dp) function half_square(k, step)
      integer, intent(in) :: k
      real(dp), intent(in) :: step
      half_square = modulo(0.5_dp*step*real(k, dp)**2, 1.0_dp)
   end function half_square
end module ehl_chirp

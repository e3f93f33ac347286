! SPDX-License-Identifier: BSD-3-Clause
!> The contact of a roller of finite length, scaled by the line contact (ehl_line) under the mean load per unit length. With its b
!> and R, the sum g of both profiles and the misalignment theta the gap is
!>
!>    G = X^2/2 + (R/b^2) (g(bY) + theta b Y),    |Y| <= L/2,    L = length/b
!>
!>    crown        g = y^2/(2 R_crown)
!>    logarithmic  g = -A ln(1 - (2y/length)^2)  (Johns & Gohar 1981, as in ISO/TS 16281), constant within a thousandth of
!>                 the length from the end
!>    chamfer      g = slope of a straight chamfer times the distance from its beginning
!>    file         a table, interpolated linearly
!>
!> The domain ends at the ends of the roller, where P = 0; the elastic half-space continues beyond them.
module ehl_roller
   use ehl_contact, only: contact_t
   use ehl_kinds, only: dp, pi
   use ehl_line, only: new_line_contact
   use ehl_moes, only: operating_t
   use ehl_scales, only: scales_t
   implicit none (type, external)
   private
   public :: body_profile_t, profile_t, new_roller, roller_t

   !> Profile of one body, in metres
   type :: body_profile_t
      character(len=16) :: kind = "none"
      !> Radius of a crown; A; length of each chamfer and drop at its end
      real(dp) :: crown_radius = 0.0_dp, log_amplitude = 0.0_dp, chamfer_length = 0.0_dp, chamfer_drop = 0.0_dp
      !> A table, in increasing y
      real(dp), allocatable :: y(:), table(:)
   contains
      procedure :: drop => drop_of_body
   end type body_profile_t

   !> Profiles of both bodies, length of the roller [m] and angle between the axes [rad]
   type :: profile_t
      type(body_profile_t) :: of(2)
      real(dp) :: length = 0.0_dp, misalignment = 0.0_dp
   contains
      procedure :: drop
      procedure :: is_symmetric
   end type profile_t

   type, extends(contact_t) :: roller_t
      type(profile_t) :: profile
      !> b, and R/b^2
      real(dp), private :: width = 1.0_dp, per_metre = 1.0_dp
   contains
      procedure :: is_even
      procedure :: is_roller
      procedure :: scales
      procedure :: moes_load
      procedure :: operating
      procedure :: film_formula
      procedure :: area
      procedure :: flash_area
      procedure :: gap_row
      procedure :: pressure_row
   end type roller_t

   !> Fraction of the half length at which the logarithm ends
   real(dp), parameter :: last = 0.998_dp
   !> Gap that is added at the ends of the roller and beyond [b^2/R], and relative tolerance of their position for rounding
   real(dp), parameter :: open = 2.0_dp, rounding = 1.0e-9_dp
   !> Number of slices for the load distribution
   integer, parameter :: slices = 200

contains

   !> The contact under a load [N]
   pure function new_roller(profile, load, radius, reduced_modulus) result(contact)
      type(profile_t), intent(in) :: profile
      real(dp), intent(in) :: load, radius, reduced_modulus
      type(roller_t) :: contact
      type(scales_t) :: scales

      contact%profile = profile
      scales = contact%scales(load, radius, reduced_modulus)
      contact%width = scales%length
      contact%per_metre = 1.0_dp/scales%film
      contact%radius_ratio = 0.0_dp
      contact%ellipticity = 0.5_dp*profile%length/scales%length
      contact%load = pi*contact%ellipticity
      contact%kernel_factor = 0.5_dp/pi
      ! that of a line contact minus k_b int P dX = 1/4 times the difference of the kernels in the middle of the roller,
      ! 2 asinh(L/(2|X - X'|)) + 2 ln|X - X'|, which is 2 ln L for a long roller
      contact%dry_separation = -0.25_dp - 0.5_dp*log(2.0_dp) - 0.5_dp*log(2.0_dp*contact%ellipticity)
      contact%reach = [sqrt(max_load_ratio(contact)), contact%ellipticity]
   end function new_roller

   !> Maximum load per unit length over its mean if the load of each slice of the roller is proportional to its approach (Palmgren):
   !> (approach - minimum gap)/d, d the approach of bodies without a profile; at least 1
   pure real(dp) function max_load_ratio(contact)
      type(roller_t), intent(in) :: contact
      real(dp) :: gap(slices), row(1), low, high, approach
      integer :: k

      do k = 1, slices
         call contact%gap_row([0.0_dp], contact%ellipticity*((2.0_dp*k - 1.0_dp)/slices - 1.0_dp), row)
         gap(k) = row(1)
      end do
      low = minval(gap)
      high = low + slices*abs(contact%dry_separation)
      do k = 1, 60
         approach = 0.5_dp*(low + high)
         if (sum(max(0.0_dp, approach - gap)) > slices*abs(contact%dry_separation)) then
            high = approach
         else
            low = approach
         end if
      end do
      max_load_ratio = max(1.0_dp, (approach - minval(gap))/abs(contact%dry_separation))
   end function max_load_ratio

   !> Sum of the drops of both bodies at y [m]
   pure real(dp) function drop(self, y)
      class(profile_t), intent(in) :: self
      real(dp), intent(in) :: y
      drop = self%of(1)%drop(self%length, y) + self%of(2)%drop(self%length, y)
   end function drop

   !> Drop [m] of one body at y [m]; length of the roller [m]
   pure real(dp) function drop_of_body(self, length, y) result(drop)
      class(body_profile_t), intent(in) :: self
      real(dp), intent(in) :: length, y
      real(dp) :: s
      integer :: k

      select case (self%kind)
      case ("crown")
         drop = 0.5_dp*y**2/self%crown_radius
      case ("logarithmic")
         s = min(last, 2.0_dp*abs(y)/length)
         drop = -self%log_amplitude*log(1.0_dp - s**2)
      case ("chamfer")
         s = abs(y) - (0.5_dp*length - self%chamfer_length)
         drop = self%chamfer_drop*max(0.0_dp, s)/self%chamfer_length
      case ("file")
         drop = 0.0_dp
         if (size(self%y) < 2 .or. size(self%table) /= size(self%y)) return
         k = max(1, min(size(self%y) - 1, count(self%y <= y)))
         s = (y - self%y(k))/(self%y(k + 1) - self%y(k))
         drop = self%table(k) + min(1.0_dp, max(0.0_dp, s))*(self%table(k + 1) - self%table(k))
      case default
         drop = 0.0_dp
      end select
   end function drop_of_body

   !> Whether the profile is symmetric about the middle
   pure logical function is_symmetric(self)
      class(profile_t), intent(in) :: self
      integer :: body, k

      is_symmetric = .not. abs(self%misalignment) > 0.0_dp
      do body = 1, 2
         associate (one => self%of(body), l => self%length)
            if (one%kind /= "file") cycle
            do k = 1, size(one%y)
               is_symmetric = is_symmetric .and. .not. abs(one%drop(l, one%y(k)) - one%drop(l, -one%y(k))) > 0.0_dp
            end do
         end associate
      end do
   end function is_symmetric

   !> Whether Y > 0 is the mirror image of Y < 0
   pure logical function is_even(self)
      class(roller_t), intent(in) :: self
      is_even = self%profile%is_symmetric()
   end function is_even

   !> Whether the bodies end at the sides of the domain
   pure logical function is_roller(self)
      class(roller_t), intent(in) :: self

      associate (unused => self)
      end associate
      is_roller = .true.
   end function is_roller

   !> b, b^2/R and p_h from the mean load per unit length
   pure function scales(self, load, radius, reduced_modulus)
      class(roller_t), intent(in) :: self
      real(dp), intent(in) :: load, radius, reduced_modulus
      type(scales_t) :: scales

      associate (line => new_line_contact())
         scales = line%scales(load/self%profile%length, radius, reduced_modulus)
      end associate
   end function scales

   !> M of the line contact
   pure real(dp) function moes_load(self, load, radius, reduced_modulus, speed)
      class(roller_t), intent(in) :: self
      real(dp), intent(in) :: load, radius, reduced_modulus, speed

      associate (line => new_line_contact())
         moes_load = line%moes_load(load/self%profile%length, radius, reduced_modulus, speed)
      end associate
   end function moes_load

   !> Operating point from M and L of the line contact
   pure function operating(self, moes_m, moes_l) result(point)
      class(roller_t), intent(in) :: self
      real(dp), intent(in) :: moes_m, moes_l
      type(operating_t) :: point

      associate (unused => self, line => new_line_contact())
         point = line%operating(moes_m, moes_l)
      end associate
   end function operating

   !> Film formula of the line contact
   pure real(dp) function film_formula(self, moes_m, moes_l)
      class(roller_t), intent(in) :: self
      real(dp), intent(in) :: moes_m, moes_l

      associate (unused => self, line => new_line_contact())
         film_formula = line%film_formula(moes_m, moes_l)
      end associate
   end function film_formula

   !> Area of the dry contact [b^2]: its width 2 b times the length
   pure real(dp) function area(self)
      class(roller_t), intent(in) :: self
      area = 4.0_dp*self%ellipticity
   end function area

   !> Area [m^2] over which the mean of the Hertz pressure of the line contact is 2/3 of its maximum
   pure real(dp) function flash_area(self, length)
      class(roller_t), intent(in) :: self
      real(dp), intent(in) :: length
      flash_area = 1.5_dp*pi*self%ellipticity*length**2
   end function flash_area

   !> Gap: X^2/2 + profile + misalignment; larger by `open` at the ends and beyond
   pure subroutine gap_row(self, x, y, values)
      class(roller_t), intent(in) :: self
      real(dp), intent(in) :: x(:), y
      real(dp), intent(out) :: values(:)

      associate (metres => self%width*y)
         values = 0.5_dp*x**2 + self%per_metre*(self%profile%drop(metres) + self%profile%misalignment*metres) &
                  + merge(open, 0.0_dp, abs(y) > self%ellipticity*(1.0_dp - rounding))
      end associate
   end subroutine gap_row

   !> Pressure sqrt(1 - X^2) of a roller without a profile, without the effect of its ends
   pure subroutine pressure_row(self, x, y, values)
      class(roller_t), intent(in) :: self
      real(dp), intent(in) :: x(:), y
      real(dp), intent(out) :: values(:)

      values = merge(sqrt(max(0.0_dp, 1.0_dp - x**2)), 0.0_dp, abs(y) < self%ellipticity)
   end subroutine pressure_row
end module ehl_roller

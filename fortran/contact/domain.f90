! SPDX-License-Identifier: BSD-3-Clause
!> The domain that a contact needs, and the error of the film due to a finite domain.
!>
!> The pressure on the border is either that of a fully flooded contact (ehl_far_field): the error decreases with
!> the third power of the distance in thick films, where the load determines it, and with the fifth in thin films, where
!> the inlet does.
!>
!> Or it is P = 0, and the pressure of the inlet beyond the border is missing: it increases as dP/dX ~ (H - H_c)/H^3, H = H_c + g,
!> with the gap g of the dry contact. At a distance x from the centre it has reached the fraction q(x) = Q(x)/Q(1),
!> Q(x) = int_x^inf g/(H_c + g)^3 dX, and the relative error of the film is a fixed multiple of q at the border. In thick films
!> the pressure beyond the border also supports a fraction of about lambda_bar/x of the load.
!>
!> Data of the fitted factors: docs/evidence/errors.
module ehl_domain
   use ehl_contact, only: contact_t
   use ehl_kinds, only: dp, pi
   use ehl_line_domain, only: line_domain_error, line_ends
   use ehl_moes, only: operating_t
   use ehl_scales, only: circle_factor
   use ehl_wide_inlet, only: gap_of_row => dry_gap, wide_inlet_error
   implicit none (type, external)
   private
   public :: domain_t, flooded_by_default, flooding_layer, needed_domain, domain_error, ratio_error

   !> inlet <= X <= outlet, -side <= Y <= side [a]
   type :: domain_t
      real(dp) :: inlet = -2.5_dp, outlet = 1.5_dp, side = 2.0_dp
   end type domain_t

   !> Maximum relative error of H_c due to a default domain
   real(dp), parameter :: tolerance = 0.002_dp
   !> From this M on border and domain are those of Zhang et al. 2019, unless the case states otherwise or the contact is wide
   !> (is_wide), where P = 0 on the border would change the film by several per cent
   real(dp), parameter :: first_usual = 500.0_dp
   !> Flooded border. Thick films: error of the load due to sides and inlet, over lambda_bar s^2/r^3 with the length
   !> s = (2 H_c)^(1/2); maximum and minimum sensitivity of the film to load, and the M at half of the maximum. Thin films:
   !> error due to an inlet of 2.5 a, its power of s, and the maximum of s for that. Error of H_min over that of H_c.
   real(dp), parameter :: load_by_sides = 0.025_dp, load_by_inlet = 0.05_dp, by_load = 2.0_dp, min_by_load = 0.5_dp, &
                          half_by_load = 8.0_dp, by_inlet = 0.0042_dp, inlet_power = 1.3_dp, thin = 0.75_dp, &
                          minimum_over_central = 1.5_dp
   !> Lengths of short domains of wide contacts, with the same times powers of 2
   real(dp), parameter :: short_widths(3) = [2.5_dp, 3.0_dp, 4.0_dp]
   !> P = 0: errors of H_c due to inlet and sides, and the additional error of H_min due to the sides, over q; film below which
   !> the error due to the inlet is larger, and its power of the film
   real(dp), parameter :: of_inlet = 0.46_dp, of_sides = 0.06_dp, of_sides_at_minimum = 0.15_dp, &
                          thin_film = 0.06_dp, thin_power = 0.25_dp
   !> Error due to the sides of a wide contact: additional decay, relative to a round contact, with the distance of the sides from
   !> its ends in half lengths along the motion. At least 1.2 in thin films at kappa = 1.5 to 16 and 1.15 to 2 half widths
   !> (docs/evidence/machines); not measured in films above `thick_for_decay`, where it is 0
   real(dp), parameter :: end_decay = 1.2_dp, thick_for_decay = 0.2_dp
   !> Load beyond inlet and sides, over lambda_bar; minimum sensitivity of the film to load around M = 5, where the
   !> sensitivity of the film formula vanishes and the elastic deflection matters
   real(dp), parameter :: load_beyond_inlet = 1.0_dp, load_beyond_sides = 0.25_dp, min_sensitivity = 0.5_dp, &
                          dented_below = 5.5_dp
   !> Around an ellipse the deflection extends further, by the factor kappa k_b over that of a round contact: maximum of this
   !> factor of the error with a flooded border, and its power with P = 0, where a narrow contact also has a larger error
   real(dp), parameter :: max_wide = 4.0_dp, wide_power = 0.4_dp
   !> Sides of a wide contact in half widths, and length s of a film above which they are further out; with a flooded
   !> border at most one half length along the motion beyond its ends, but at least `min_beyond` half widths: sides 1.5
   !> times as far away change H_c by 0.02 % and H_min by up to 0.13 % (docs/evidence/machines)
   real(dp), parameter :: beyond_ends = 1.3_dp, thick_at_ends = 0.95_dp, min_beyond = 1.08_dp
   !> Sides of a narrow contact over the length on which its gap opens across the motion (side_scale); the errors of
   !> H_c and H_min at twice that, with a flooded border and with P = 0, and their decay with the distance: upper limits of 21
   !> random contacts with either border (docs/evidence/machines/narrow_sides.csv)
   real(dp), parameter :: beyond_narrow = 4.0_dp, flooded_narrow(2) = [0.009_dp, 0.0125_dp], &
                          of_narrow(2) = [0.02_dp, 0.032_dp], narrow_decay = 4.0_dp
   !> An inlet so far away that its error vanishes
   real(dp), parameter :: far = 1.0e6_dp
   !> Number of points of the midpoint rule
   integer, parameter :: points = 100

contains

   !> Whether the border has the pressure of a flooded contact by default
   pure logical function flooded_by_default(contact, point)
      class(contact_t), intent(in) :: contact
      type(operating_t), intent(in) :: point
      flooded_by_default = .false.
      if (contact%is_roller()) return
      flooded_by_default = contact%is_line() .or. point%round_m < first_usual .or. contact%is_wide()
   end function flooded_by_default

   !> The domain of a contact: that of Zhang et al. 2019, with other sides around an ellipse; with a flooded border a domain of
   !> that shape that increases with the film; of a line or a roller from ehl_line_domain. Around a round contact it is square.
   !> X = 0 is a node of every grid of 32 n + 1 nodes.
   pure function needed_domain(contact, point, flooded, short) result(domain)
      class(contact_t), intent(in) :: contact
      type(operating_t), intent(in) :: point
      logical, intent(in) :: flooded
      !> Whether the domain of a flooded wide contact is as short as its error allows
      logical, intent(in) :: short
      type(domain_t) :: domain
      real(dp) :: ends(2)

      if (contact%is_line()) then
         ends = line_ends(contact, point)
         domain = domain_t(ends(1), ends(2), 0.0_dp)
         return
      end if
      if (contact%is_roller()) then
         ! for the width at the maximum load per unit length; X = 0 remains a node
         ends = line_ends(contact, point)*contact%reach(1)
         do while (line_domain_error(contact, point, ends(1)/contact%reach(1), .false.) > tolerance)
            ends = 1.1_dp*ends
         end do
         domain = domain_t(ends(1), ends(2), contact%reach(2))
         return
      end if
      domain%side = domain%side*sides_over_round(contact)
      domain%inlet = domain%inlet*contact%reach(1)
      domain%outlet = domain%outlet*contact%reach(1)
      if (flooded .and. short .and. contact%is_wide()) then
         domain = shortest_domain(contact, point)
      else if (flooded) then
         call widen(contact, point, domain)
      end if
      domain%side = min(domain%side, side_of_wide(contact, point, flooded), side_of_narrow(contact, point))
   end function needed_domain

   !> The shortest domain of a flooded wide contact whose error is tolerated
   pure function shortest_domain(contact, point) result(domain)
      class(contact_t), intent(in) :: contact
      type(operating_t), intent(in) :: point
      type(domain_t) :: domain
      real(dp) :: error(2), width
      integer :: k

      k = 0
      do
         ! 2.5, 3, 4, 5, 6, 8, ...: grids of 5, 3 and 4 times 2^n intervals have the same mesh sizes
         width = short_widths(1 + mod(k, 3))*2.0_dp**(k/3)
         domain = domain_t(-0.5625_dp*width, 0.4375_dp*width, max(2.0_dp, 0.5_dp*width)*sides_over_round(contact))
         error = domain_error(contact, point, domain, .true.)
         if (.not. error(1) > tolerance) return
         k = k + 1
      end do
   end function shortest_domain

   !> Widen the domain of a flooded contact until its error, with rigid bodies beyond the border, is tolerated
   pure subroutine widen(contact, point, domain)
      class(contact_t), intent(in) :: contact
      type(operating_t), intent(in) :: point
      type(domain_t), intent(inout) :: domain
      real(dp) :: error(2), wanted, unit, width

      wanted = 4.0_dp
      do
         error = domain_error(contact, point, domain, .true., rigid=.true.)
         if (.not. error(1) > tolerance) return
         wanted = 1.02_dp*wanted
         unit = 0.32_dp*10.0_dp**max(0, floor(log10(0.25_dp*wanted)))
         width = unit*ceiling(wanted/unit)
         domain = domain_t(-0.625_dp*width, 0.375_dp*width, 0.5_dp*width*sides_over_round(contact))
      end do
   end subroutine widen

   !> Distance of the sides of a wide contact from the centre; the domain beyond an end affects only the film at that end
   pure real(dp) function side_of_wide(contact, point, flooded) result(side)
      class(contact_t), intent(in) :: contact
      type(operating_t), intent(in) :: point
      logical, intent(in) :: flooded
      real(dp) :: wide, length, beyond

      wide = elongation(contact)
      side = huge(side)
      if (.not. wide > 1.0_dp) return
      ! over the half length along the motion, with the radius of curvature along it
      length = sqrt(2.0_dp*contact%film_formula(point%moes_m, point%moes_l)*contact%radius)/contact%reach(1)
      beyond = beyond_ends + (2.0_dp - beyond_ends)/wide**2
      if (flooded) beyond = min(beyond, max(min_beyond, 1.0_dp + 1.0_dp/wide))
      side = contact%reach(2)*beyond*max(1.0_dp, length/thick_at_ends)
   end function side_of_wide

   !> Distance of the sides of a narrow contact from the centre: small compared with its length along the motion, because the gap
   !> opens with the smaller radius across the motion
   pure real(dp) function side_of_narrow(contact, point) result(side)
      class(contact_t), intent(in) :: contact
      type(operating_t), intent(in) :: point

      side = huge(side)
      if (elongation(contact) < 1.0_dp) side = beyond_narrow*side_scale(contact, point)
   end function side_of_narrow

   !> Length over which the gap opens across the motion: that of the dry contact plus that of a film between rigid bodies
   pure real(dp) function side_scale(contact, point)
      class(contact_t), intent(in) :: contact
      type(operating_t), intent(in) :: point

      side_scale = sqrt(contact%reach(2)**2 + 2.0_dp*contact%film_formula(point%moes_m, point%moes_l)*contact%radius/contact%ratio)
   end function side_scale

   !> Extent of the dry contact across the motion over that along it
   pure real(dp) function elongation(contact)
      class(contact_t), intent(in) :: contact
      elongation = contact%reach(2)/contact%reach(1)
   end function elongation

   !> Distance of the sides over that around a round contact: that of the ends in a wide contact; at least 1 in a narrow one,
   !> because its gap opens slowly relative to the semi-axis
   pure real(dp) function sides_over_round(contact)
      class(contact_t), intent(in) :: contact
      sides_over_round = maxval(contact%reach)
   end function sides_over_round

   !> Upper estimates of the relative errors of H_c and H_min due to the domain, relative to the flooded contact; 1 or more: unknown
   pure recursive function domain_error(contact, point, domain, flooded, starved, rigid) result(error)
      class(contact_t), intent(in) :: contact
      type(operating_t), intent(in) :: point
      type(domain_t), intent(in) :: domain
      logical, intent(in) :: flooded
      !> Whether the inlet border is the position of the meniscus, so that only the sides have an error; absent: false
      logical, intent(in), optional :: starved
      !> Whether the bodies count as rigid beyond the border, as in contacts that are not wide; absent: false
      logical, intent(in), optional :: rigid
      real(dp) :: error(2)
      real(dp) :: at_sides(2), film, length, whole, inlet, load, sides, side, wide, width
      logical :: line_like

      if (present(starved)) then
         if (starved) then
            error = 0.0_dp
            if (.not. (contact%is_line() .or. contact%is_roller())) error = &
               domain_error(contact, point, domain_t(-far, domain%outlet, domain%side), flooded)
            return
         end if
      end if
      if (contact%is_line()) then
         error = line_domain_error(contact, point, domain%inlet, flooded)
         return
      end if
      if (contact%is_roller()) then
         error = line_domain_error(contact, point, domain%inlet/contact%reach(1), flooded)
         return
      end if
      side = domain%side/sides_over_round(contact)
      width = contact%ellipticity*contact%kernel_factor/circle_factor
      film = contact%film_formula(point%moes_m, point%moes_l)
      associate (lambda_bar => point%speed_parameter)
         if (flooded) then
            length = sqrt(2.0_dp*film)
            load = lambda_bar*length**2*max(min_by_load, by_load/(1.0_dp + (point%round_m/half_by_load)**2))
            at_sides = load*load_by_sides/side**3*[1.0_dp, minimum_over_central]
            error = load*load_by_inlet/abs(domain%inlet)**3
            line_like = contact%is_wide()
            if (present(rigid)) line_like = line_like .and. .not. rigid
            if (line_like) then
               error = error + wide_inlet_error(contact, point, -domain%inlet, film)
            else
               error = error + by_inlet*min(max_wide, max(1.0_dp, width))*min(length, thin)**inlet_power &
                       *(2.5_dp/abs(domain%inlet))**5
            end if
            error(2) = minimum_over_central*error(1)
         else
            whole = pressure_gain(1.0_dp, film)
            inlet = pressure_gain(-domain%inlet/contact%reach(1), film)/whole
            sides = pressure_gain(max(1.0_dp, side), film)/whole
            wide = elongation(contact)
            if (wide > 1.0_dp .and. side > 1.0_dp) then
               sides = sides*exp(-end_decay*max(0.0_dp, 1.0_dp - film/thick_for_decay)*(wide - 1.0_dp)*(side - 1.0_dp))
            end if
            load = lambda_bar*max(sensitivity(contact, point), min_sensitivity*min(1.0_dp, (dented_below/point%round_m)**6))
            width = merge(width**wide_power, 1.0_dp/width, width >= 1.0_dp)
            at_sides = (of_sides*sides + load*load_beyond_sides/side)*width + [0.0_dp, of_sides_at_minimum*sides]
            error = (of_inlet*max(1.0_dp, (thin_film/film)**thin_power)*inlet + load*load_beyond_inlet/abs(domain%inlet))*width
         end if
      end associate
      if (elongation(contact) < 1.0_dp) at_sides = min(at_sides, merge(flooded_narrow, of_narrow, flooded) &
                                                       *(2.0_dp*side_scale(contact, point)/domain%side)**narrow_decay)
      error = error + at_sides
   end function domain_error

   !> Thickness of the oil layer that fills the gap downstream of a position X < 0
   pure real(dp) function flooding_layer(contact, point, x) result(layer)
      class(contact_t), intent(in) :: contact
      type(operating_t), intent(in) :: point
      real(dp), intent(in) :: x
      real(dp) :: r

      r = max(1.0_dp, -x/contact%reach(1))
      layer = contact%film_formula(point%moes_m, point%moes_l)
      if (contact%is_line()) then
         layer = layer + gap_of_row(r, 1.0_dp)
      else
         layer = layer + dry_gap(r)
      end if
   end function flooding_layer

   !> Error of a friction ratio due to a relative error of H_c: the increase of friction by waves of a fixed height is about
   !> proportional to (height/film)^2, and exponential where they change the pressure strongly (docs/evidence/errors)
   pure real(dp) function ratio_error(error, ratio)
      real(dp), intent(in) :: error, ratio
      ratio_error = 2.0_dp*error*abs(ratio - 1.0_dp)*max(1.0_dp, log(max(ratio, 1.0_dp)))
   end function ratio_error

   !> -d ln h/d ln w at constant speed, by the film formula
   pure real(dp) function sensitivity(contact, point)
      class(contact_t), intent(in) :: contact
      type(operating_t), intent(in) :: point
      real(dp), parameter :: step = 1.05_dp

      ! H is h over a^2/R, and a^2 is proportional to the load to the power 2/3
      sensitivity = -log(contact%film_formula(point%moes_m*step, point%moes_l) &
                         /contact%film_formula(point%moes_m/step, point%moes_l))/(2.0_dp*log(step)) - 2.0_dp/3.0_dp
   end function sensitivity

   !> Q(x): midpoint rule in t, X = x + c (t/(1 - t))^2
   pure real(dp) function pressure_gain(x, film)
      real(dp), intent(in) :: x, film
      real(dp) :: t, scale, gap
      integer :: k

      pressure_gain = 0.0_dp
      scale = max(1.0_dp, sqrt(film))
      do k = 1, points
         t = (k - 0.5_dp)/points
         gap = dry_gap(x + scale*(t/(1.0_dp - t))**2)
         pressure_gain = pressure_gain + gap/(film + gap)**3*2.0_dp*scale*t/(1.0_dp - t)**3/points
      end do
   end function pressure_gain

   !> Gap of the dry contact at a distance of r >= 1 from its centre (Johnson 1985, eq. 3.42a)
   elemental real(dp) function dry_gap(r)
      real(dp), intent(in) :: r
      dry_gap = ((r**2 - 2.0_dp)*acos(1.0_dp/r) + sqrt(r**2 - 1.0_dp))/pi
   end function dry_gap
end module ehl_domain

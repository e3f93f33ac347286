! SPDX-License-Identifier: BSD-3-Clause
!> The domain that a contact needs, and what a domain costs. P = 0 at its border takes away the pressure that a fully
!> flooded inlet would have there, so that the film is too thin.
!>
!> Pressure rises in the inlet by dP/dX ~ (H - H_c)/H^3, H = H_c + g, with the gap g of the dry contact. Up to a
!> distance x from the centre it has gained the share q(x) = Q(x)/Q(1) of all, Q(x) = int_x^inf g/(H_c + g)^3 dX, and
!> the film falls by a fixed multiple of what is cut off. In thick films the pressure beyond the border carries load
!> too: a share of about lambda_bar/x, which the film feels as it feels load. The factors were fitted to contacts on
!> domains of 4 a to 16 a, 8 <= M <= 2000, 0 <= L <= 25 (docs/evidence/errors).
module ehl_domain
   use ehl_contact, only: contact_t
   use ehl_kinds, only: dp, pi
   use ehl_moes, only: operating_t
   implicit none (type, external)
   private
   public :: domain_t, needed_domain, domain_cost, ratio_cost, too_small

   !> Why an error has no part from the domain, where its cost is 1 or more
   character(len=*), parameter :: too_small = "the domain is so small that the film of a flooded contact cannot be told from it"

   !> inlet <= X <= outlet, -side <= Y <= side [a]
   type :: domain_t
      real(dp) :: inlet = -2.5_dp, outlet = 1.5_dp, side = 2.0_dp
   end type domain_t

   !> Relative cost of H_c that a domain may have by the upper estimate; the true cost is two thirds of it
   real(dp), parameter :: tolerance = 0.0022_dp
   !> From the second M on the domain is that of Zhang et al. 2019, up to the first one that of the tolerance
   real(dp), parameter :: last_needed = 400.0_dp, first_usual = 500.0_dp
   !> Largest width: in lengths of a thick film, (2 H_c)^(1/2), on wider ones cycles do not converge; and in a
   real(dp), parameter :: widest_in_films = 12.0_dp, widest = 12.0_dp
   !> What inlet and sides cost H_c, and what the sides cost H_min beside that, over q; films below which the inlet
   !> costs more, with the power of that
   real(dp), parameter :: of_inlet = 0.46_dp, of_sides = 0.06_dp, of_sides_at_minimum = 0.15_dp, &
                          thin_film = 0.06_dp, thin_power = 0.25_dp
   !> Load beyond inlet and sides, over lambda_bar
   real(dp), parameter :: load_beyond_inlet = 1.0_dp, load_beyond_sides = 0.25_dp
   !> Least sensitivity of the film to load around M = 5, where the film formula has none and the elastic dent counts
   real(dp), parameter :: least_sensitivity = 0.5_dp, dented_below = 5.5_dp
   !> Points of an integral
   integer, parameter :: points = 100

contains

   !> The domain of a contact: cells are square, and X = 0 is a node of every grid of 32 n + 1 nodes
   pure function needed_domain(contact, point) result(domain)
      class(contact_t), intent(in) :: contact
      type(operating_t), intent(in) :: point
      type(domain_t) :: domain
      real(dp) :: outlet, low, high, width, unit, film

      if (point%moes_m >= first_usual) return
      film = sqrt(2.0_dp*contact%film_formula(point%moes_m, point%moes_l))
      outlet = max(domain%outlet, 1.5_dp*film)
      low = max(domain%outlet - domain%inlet, outlet + 1.1_dp)
      high = max(widest, widest_in_films*film)
      if (cost_of(low) <= tolerance) then
         high = low
      else if (cost_of(high) <= tolerance) then
         do while (high > 1.01_dp*low)
            width = sqrt(low*high)
            if (cost_of(width) > tolerance) then
               low = width
            else
               high = width
            end if
         end do
      end if
      width = domain%outlet - domain%inlet
      if (high <= width) return
      if (point%moes_m > last_needed) high = width + (high - width)*log(first_usual/point%moes_m)/log(first_usual/last_needed)
      unit = 0.32_dp*10.0_dp**max(0, floor(log10(high/width)))
      width = unit*ceiling(high/unit)
      domain%side = 0.5_dp*width
      domain%outlet = width*ceiling(32.0_dp*outlet/width)/32.0_dp
      domain%inlet = domain%outlet - width

   contains

      pure real(dp) function cost_of(w)
         real(dp), intent(in) :: w
         real(dp) :: cost(2)
         cost = domain_cost(contact, point, domain_t(outlet - w, outlet, 0.5_dp*w))
         cost_of = cost(1)
      end function cost_of
   end function needed_domain

   !> Shares of H_c and H_min of the flooded contact that a domain takes away, as an upper estimate; 1 and more: nothing
   !> can be said
   pure function domain_cost(contact, point, domain) result(cost)
      class(contact_t), intent(in) :: contact
      type(operating_t), intent(in) :: point
      type(domain_t), intent(in) :: domain
      real(dp) :: cost(2)
      real(dp) :: film, whole, inlet, sides, load

      film = contact%film_formula(point%moes_m, point%moes_l)
      whole = pressure_gain(1.0_dp, film)
      inlet = pressure_gain(-domain%inlet, film)/whole
      sides = pressure_gain(domain%side, film)/whole
      load = point%speed_parameter*(load_beyond_inlet/abs(domain%inlet) + load_beyond_sides/domain%side)
      cost(1) = of_inlet*max(1.0_dp, (thin_film/film)**thin_power)*inlet + of_sides*sides &
                + load*max(sensitivity(contact, point), least_sensitivity*min(1.0_dp, (dented_below/point%moes_m)**6))
      cost(2) = cost(1) + of_sides_at_minimum*sides
   end function domain_cost

   !> What a cost of H_c makes of a friction ratio: waves of a height of their own rise as the film falls, with about the
   !> square of their height over it, and exponentially where they raise the pressure by much (docs/evidence/errors)
   pure real(dp) function ratio_cost(cost, ratio)
      real(dp), intent(in) :: cost, ratio
      ratio_cost = 2.0_dp*cost*abs(ratio - 1.0_dp)*max(1.0_dp, log(max(ratio, 1.0_dp)))
   end function ratio_cost

   !> -d ln h/d ln w at constant speed, by the film formula
   pure real(dp) function sensitivity(contact, point)
      class(contact_t), intent(in) :: contact
      type(operating_t), intent(in) :: point
      real(dp), parameter :: step = 1.05_dp

      ! H is h over a^2/R, and a^2 goes with the load to the power 2/3
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

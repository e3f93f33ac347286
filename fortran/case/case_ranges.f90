! SPDX-License-Identifier: BSD-3-Clause
!> Ranges of the keys of a case: an interval of numbers, '(0, 10]' or '0 or [1, 5]', or a list of words, 'this|that'. pyehl/case has
!> the same ranges with units and meanings; a test compares both.
module ehl_case_ranges
   use ehl_kinds, only: dp
   implicit none (type, external)
   private
   public :: range_of, allows, words_of

   character(len=*), parameter :: contact_ranges = &
      "shape point|line|roller; moes_m (0, 1e6]; moes_l [0, 100]; moes_m_line (0, 1e4]; moes_l_line [0, 100]; " &
      // "radius_ratio [0.004, 250]; load (0, 1e5]; load_per_length (0, 1e9]; mean_velocity (0, 200]; " &
      // "radius [1e-5, 10]; radius_x 0 or [1e-5, 1000]; radius_y 0 or [1e-5, 1000]; reduced_modulus [1e4, 2e12]; " &
      // "hardness 0 or [1e5, 1e12]; angle [-90, 90]; slide_to_roll [-2, 2]; rough_surface [1, 2]; " &
      // "thermal_conductivity [0.1, 500]; thermal_diffusivity [1e-8, 1e-3]; " &
      // "thermal_conductivity_2 0 or [0.1, 500]; thermal_diffusivity_2 0 or [1e-8, 1e-3]; length 0 or [1e-5, 10]; " &
      // "profile none|crown|logarithmic|chamfer|file; crown_radius 0 or [1e-4, 1e6]; log_amplitude 0 or [1e-10, 1e-2]; " &
      // "chamfer_length 0 or [1e-7, 1]; chamfer_drop 0 or [1e-9, 1]; misalignment [-0.1, 0.1]; " &
      // "profile_2 none|crown|logarithmic|chamfer|file; crown_radius_2 0 or [1e-4, 1e6]; " &
      // "log_amplitude_2 0 or [1e-10, 1e-2]; chamfer_length_2 0 or [1e-7, 1]; chamfer_drop_2 0 or [1e-9, 1]"
   character(len=*), parameter :: bodies_ranges = &
      "radius_x1 [-1e3, 1e3]; radius_y1 [-1e3, 1e3]; radius_x2 [-1e3, 1e3]; radius_y2 [-1e3, 1e3]; " &
      // "modulus_1 [1e3, 2e12]; modulus_2 [1e3, 2e12]; poisson_1 [-0.5, 0.5]; poisson_2 [-0.5, 0.5]"
   character(len=*), parameter :: lubricant_ranges = &
      "alpha_origin given|estimated|default; viscosity [1e-4, 10]; " &
      // "pressure_viscosity 0 or [1e-10, 1e-7]; viscosity_law roelands|barus|dicke|yasutomi|doolittle|table; " &
      // "inlet_law dicke|yasutomi|doolittle|table|; roelands_z [0, 1e4]; roelands_p0 [1e7, 1e10]; " &
      // "vogel_viscosity 0 or [1e-9, 1]; vogel_b [0, 1e4]; vogel_c [-100, 300]; dicke_a1 [-1e10, 1e10]; " &
      // "dicke_a2 [-1e8, 1e8]; dicke_b1 [-1, 1]; " &
      // "dicke_b2 [-0.01, 0.01]; yasutomi_tg0 [-200, 100]; yasutomi_a1 [0, 1e4]; yasutomi_a2 [0, 1e-7]; " &
      // "yasutomi_b1 [0, 1e-6]; yasutomi_b2 [-2, 0]; yasutomi_c1 0 or [1, 100]; yasutomi_c2 0 or [1, 500]; " &
      // "yasutomi_viscosity [1e3, 1e15]; doolittle_viscosity 0 or [1e-6, 1e3]; " &
      // "doolittle_temperature [-100, 300]; doolittle_b 0 or [0.1, 50]; doolittle_r0 0 or [0.1, 0.99]; " &
      // "doolittle_expansion [-0.01, 0.01]; density_law dowson-higginson|incompressible|murnaghan|tait; " &
      // "murnaghan_modulus 0 or [1e8, 1e12]; murnaghan_rate 0 or [1, 50]; murnaghan_softening [0, 0.1]; " &
      // "tait_modulus 0 or [1e8, 1e12]; tait_rate 0 or [1, 50]; tait_softening [0, 0.1]; " &
      // "tait_expansion [0, 5e-3]; tait_temperature [-100, 300]; range_temperature_min [-100, 500]; " &
      // "range_temperature_max [-100, 500]; range_pressure_max 0 or [1e5, 1e11]; " &
      // "shear_law newtonian|eyring|limiting|carreau; flow consistent|newtonian; eyring_stress [1e4, 1e9]; " &
      // "limiting_stress 0 or [1e5, 1e10]; limiting_coefficient [1e-4, 1]; carreau_stress 0 or [1e2, 1e10]; " &
      // "carreau_exponent 0 or [0.05, 1]; boundary_film 0 or [1e-11, 1e-5]; boundary_friction 0 or [1e-3, 2]; " &
      // "temperature [-60, 250]; kinematic_viscosity_40 0 or [1, 1e5]; kinematic_viscosity_100 0 or [0.5, 1e4]; " &
      // "density_15 [500, 2000]; thermal_expansion [0, 2e-3]; temperature_viscosity 0 or [1e-3, 0.3]; " &
      // "thermal_conductivity [0.01, 2]; thermal_friction auto|always|never"
   character(len=*), parameter :: grid_ranges = &
      "points [17, 4097]; points_y 0 or [9, 40961]; x_inlet [-1e4, -1.05]; x_outlet [1.05, 1e4]; " &
      // "y_extent [0.03, 1e4]; border flooded|zero; target_error 0 or [1e-5, 0.1]; max_points [17, 8193]"
   character(len=*), parameter :: surface_ranges = &
      "kind smooth|harmonic|map|fractal|dent|bump|ridge|groove; amplitude [0, 1]; amplitude_over_film [0, 10]; " &
      // "wavelength [0.01, 100]; wavelength_x [0.01, 100]; wavelength_y [0.01, 1e6]; velocity_ratio [0, 2]; " &
      // "x_start [-1e5, 1e4]; height_m 0 or [1e-12, 1e-4]; width [0.01, 100]; length 0 or [0.01, 100]; " &
      // "width_m 0 or [1e-9, 0.1]; length_m 0 or [1e-9, 0.1]; angle [-360, 360]; y_start [-20, 20]; " &
      // "spacing_y 0 or [0.01, 1000]; length_x 0 or [1e-9, 1]; " &
      // "length_y 0 or [1e-9, 1]; height_unit m|mm|um|nm; lateral_unit same|m|mm|um|nm; " &
      // "profile none|isotropic|ridges; crop_x_min [0, 1]; crop_x_max [0, 1]; crop_y_min [0, 1]; " &
      // "crop_y_max [0, 1]; sign [-1, 1]; outliers 0 or [3, 1e6]; align_lines none|x|y; fill harmonic|none; " &
      // "detrend auto|none|centre|tilt|curvature; rotate [-360, 360]; edges auto|mirror|window|periodic; " &
      // "track [-1, 1]; tile_x 0 or [1e-9, 10]; tile_y 0 or [1e-9, 10]; shortest_wavelength [0, 1]; " &
      // "longest_wavelength [0, 1]; filter sharp|gaussian; rms_height [0, 1e-4]; ra [0, 1e-4]; rq [0, 1e-4]; " &
      // "finish none|ground|honed|superfinished|polished; lay_ratio [0.01, 100]; hurst [0, 1]; " &
      // "rolloff_wavenumber [0, 1e11]; pixels [4, 8192]; seed [0, 2147483647]; modulus deterministic|gaussian"
   character(len=*), parameter :: inlet_ranges = &
      "position [0, 10]; position_hertz 0 or [1.05, 1e4]; film [0, 0.01]; film_hertz [0, 1e4]; passages [1, 1000]; " &
      // "replenishment [0, 1]"
   character(len=*), parameter :: time_ranges = &
      "scheme narrow|paper; tolerance [1e-8, 0.5]; max_periods [0, 100000]; start front|prediction; " &
      // "steps [0, 10000000]"
   character(len=*), parameter :: duty_ranges = &
      "interpolation linear|cubic; periods [1, 1000]; time_step [0.01, 4]; target_error 0 or [1e-5, 0.1]"
   character(len=*), parameter :: solver_ranges = &
      "deflection mlmi|fft; coarsening auto|classical|alcouffe; symmetry auto|full; cycle auto|W|V|F; " &
      // "accuracy [1e-6, 1]; max_cycles [1, 10000]; threads [1, 256]"
   character(len=*), parameter :: psd_ranges = &
      "reduction response|amplitude; smooth solved|hertz; film_thickness [0, 1e-3]; film_limit [0, 1e-3]; " &
      // "wavelength_convention components|wavevector|pattern; stiffness exact|paper; " &
      // "viscosity_law roelands|barus|dicke|yasutomi|doolittle|table|; positions [0, 4096]"
   character(len=*), parameter :: output_ranges = &
      "frame_interval [0, 1000]; checkpoint_interval [0, 1e6]"

contains

   !> Range of a key; '' if any text is allowed
   pure function range_of(group, key) result(range)
      character(len=*), intent(in) :: group, key
      character(len=:), allocatable :: range, list
      integer :: first

      select case (group)
      case ("contact")
         list = contact_ranges
      case ("bodies")
         list = bodies_ranges
      case ("lubricant")
         list = lubricant_ranges
      case ("inlet")
         list = inlet_ranges
      case ("grid")
         list = grid_ranges
      case ("surface", "second_surface")
         list = surface_ranges
      case ("time")
         list = time_ranges
      case ("duty")
         list = duty_ranges
      case ("solver")
         list = solver_ranges
      case ("psd")
         list = psd_ranges
      case default
         list = output_ranges
      end select
      list = "; "//list//";"
      first = index(list, "; "//trim(key)//" ")
      range = ""
      if (first == 0) return
      list = list(first + len_trim(key) + 3:)
      range = list(:index(list, ";") - 1)
   end function range_of

   !> Whether a number lies in an interval, which includes its upper end
   pure logical function allows(range, value)
      character(len=*), intent(in) :: range
      real(dp), intent(in) :: value
      real(dp) :: low, high
      integer :: opening, comma

      opening = scan(range, "[(")
      comma = index(range, ",")
      read (range(opening + 1:comma - 1), *) low
      read (range(comma + 1:len(range) - 1), *) high
      allows = value >= low .and. value <= high
      if (range(opening:opening) == "(") allows = allows .and. value > low
      if (index(range, "0 or ") == 1) allows = allows .or. .not. abs(value) > 0.0_dp
   end function allows

   !> Words of a list
   pure function words_of(range) result(words)
      character(len=*), intent(in) :: range
      character(len=32), allocatable :: words(:)
      integer :: first, bar

      allocate (words(0))
      first = 1
      do while (first <= len(range) + 1)
         bar = first + index(range(first:)//"|", "|") - 1
         words = [character(len=32) :: words, range(first:bar - 1)]
         first = bar + 1
      end do
   end function words_of
end module ehl_case_ranges

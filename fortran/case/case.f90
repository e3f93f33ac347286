! SPDX-License-Identifier: BSD-3-Clause
!> All keys of a case file, one type per namelist group, with the defaults
module ehl_case
   use ehl_kinds, only: dp
   use ehl_roller, only: body_profile_t, profile_t
   use ehl_viscosity_table, only: isotherm_t
   implicit none (type, external)
   private
   public :: bodies_case_t, case_t, contact_case_t, duty_case_t, grid_case_t, inlet_case_t, lubricant_case_t, output_case_t, &
             psd_case_t, solver_case_t, surface_case_t, time_case_t, is_feature, has_no_height, word_length, &
             path_length

   !> Maximum length of an option word
   integer, parameter :: word_length = 32
   !> Maximum length of a file name
   integer, parameter :: path_length = 1024

   ! pyehl/case gives the units and meanings of the keys, ehl_case_ranges their ranges. For some keys 0 means
   ! "not given".

   !> &contact: the operating point, in Moes numbers or SI units
   type :: contact_case_t
      !> Whether the case is in SI units, with load, mean_velocity, radius and reduced_modulus, or in Moes numbers. Not a key; set
      !> by the reader.
      logical :: si = .true.
      !> A point, an infinite line or a roller, each with its own keys
      character(len=word_length) :: shape = "point"
      real(dp) :: moes_m = 1000.0_dp, moes_l = 10.0_dp
      real(dp) :: moes_m_line = 20.0_dp, moes_l_line = 10.0_dp
      real(dp) :: load = 600.0_dp
      real(dp) :: load_per_length = 2.0e5_dp
      real(dp) :: mean_velocity = 0.84_dp
      !> Radius of a round contact, of a line or of a roller
      real(dp) :: radius = 0.018_dp
      !> Whether `radius` applies, not radius_x and radius_y. Not a key; set by the reader.
      logical :: round = .true.
      !> Set by the reader from `radius` if not given
      real(dp) :: radius_x = 0.0_dp, radius_y = 0.0_dp
      !> radius_x/radius_y, set by the reader for a case in SI units
      real(dp) :: radius_ratio = 1.0_dp
      real(dp) :: reduced_modulus = 2.26e11_dp
      !> Maximum pressure that the solids sustain
      real(dp) :: hardness = 0.0_dp
      !> Angle from the direction of motion to the plane of radius_x, counter-clockwise
      real(dp) :: angle = 0.0_dp
      real(dp) :: slide_to_roll = 0.02_dp
      !> Body with &surface; the other one has &second_surface
      integer :: rough_surface = 1
      !> Body 1, by default bearing steel
      real(dp) :: thermal_conductivity = 46.0_dp, thermal_diffusivity = 1.25e-5_dp
      !> Body 2; 0: as body 1
      real(dp) :: thermal_conductivity_2 = 0.0_dp, thermal_diffusivity_2 = 0.0_dp
      !> Roller: length, misalignment, profiles of both bodies, and files of their tables, which pyehl reads, with absolute paths
      real(dp) :: length = 0.0_dp, misalignment = 0.0_dp
      type(body_profile_t) :: profiles(2)
      character(len=path_length) :: profile_files(2) = ""
   contains
      procedure :: is_line
      procedure :: is_roller
      procedure :: is_cylinder
      procedure :: body_profile
      procedure :: size_of_load
      procedure :: moes_numbers
   end type contact_case_t

   !> &bodies: radii and moduli from which the reduced ones follow if one of these keys is given
   type :: bodies_case_t
      !> Radii of body 1 and of body 2
      real(dp) :: radius_x1 = 0.0_dp, radius_y1 = 0.0_dp, radius_x2 = 0.0_dp, radius_y2 = 0.0_dp
      !> By default steel
      real(dp) :: modulus_1 = 2.06e11_dp, modulus_2 = 2.06e11_dp, poisson_1 = 0.3_dp, poisson_2 = 0.3_dp
      !> Whether the group is given. Not a key; set by the reader.
      logical :: given = .false.
   end type bodies_case_t

   !> &lubricant: viscosity and density under pressure, shear stress, temperature
   type :: lubricant_case_t
      !> An oil with known constants, used for keys that are not given
      character(len=word_length) :: name = ""
      !> File of measured viscosities, which pyehl reads, with an absolute path
      character(len=path_length) :: table = ""
      !> Its contents [degC], [Pa], [Pa s], sorted by temperature, then by pressure
      real(dp), allocatable, dimension(:) :: table_temperature, table_pressure, table_viscosity
      !> The same as isotherms. Not a key; set by the reader.
      type(isotherm_t), allocatable :: isotherms(:)
      real(dp) :: viscosity = 0.04_dp
      real(dp) :: pressure_viscosity = 2.2e-8_dp
      !> Whether pressure_viscosity is given, estimated from a data sheet, or the default with a given viscosity
      character(len=word_length) :: alpha_origin = "given"
      character(len=word_length) :: viscosity_law = "roelands"
      !> Law that gave viscosity and pressure-viscosity coefficient at the inlet; '': viscosity_law, or with Roelands'
      !> or Barus' law none
      character(len=word_length) :: inlet_law = ""
      !> Set by the reader
      real(dp) :: roelands_z = 0.0_dp
      real(dp) :: roelands_p0 = 1.96e8_dp
      real(dp) :: vogel_viscosity = 0.0_dp, vogel_b = 0.0_dp, vogel_c = 0.0_dp
      real(dp) :: dicke_a1 = 0.0_dp, dicke_a2 = 0.0_dp, dicke_b1 = 0.0_dp, dicke_b2 = 0.0_dp
      real(dp) :: yasutomi_tg0 = 0.0_dp, yasutomi_a1 = 0.0_dp, yasutomi_a2 = 0.0_dp, yasutomi_b1 = 0.0_dp, &
                  yasutomi_b2 = 0.0_dp, yasutomi_c1 = 0.0_dp, yasutomi_c2 = 0.0_dp, yasutomi_viscosity = 1.0e12_dp
      real(dp) :: doolittle_viscosity = 0.0_dp, doolittle_temperature = 0.0_dp, doolittle_b = 0.0_dp, doolittle_r0 = 0.0_dp, &
                  doolittle_expansion = 0.0_dp
      character(len=word_length) :: density_law = "dowson-higginson"
      real(dp) :: murnaghan_modulus = 0.0_dp, murnaghan_rate = 0.0_dp, murnaghan_softening = 0.0_dp
      real(dp) :: tait_modulus = 0.0_dp, tait_rate = 0.0_dp, tait_softening = 0.0_dp, tait_expansion = 0.0_dp, &
                  tait_temperature = 0.0_dp
      !> Range of the measurements from which the constants of the laws follow; all 0: not known
      real(dp) :: range_temperature_min = 0.0_dp, range_temperature_max = 0.0_dp, range_pressure_max = 0.0_dp
      character(len=word_length) :: shear_law = "newtonian"
      character(len=word_length) :: flow = "consistent"
      real(dp) :: eyring_stress = 5.0e6_dp
      real(dp) :: limiting_stress = 0.0_dp, limiting_coefficient = 0.06_dp
      real(dp) :: carreau_stress = 0.0_dp, carreau_exponent = 0.0_dp
      real(dp) :: boundary_film = 0.0_dp, boundary_friction = 0.0_dp
      real(dp) :: temperature = 40.0_dp
      real(dp) :: kinematic_viscosity_40 = 0.0_dp, kinematic_viscosity_100 = 0.0_dp
      real(dp) :: density_15 = 870.0_dp
      real(dp) :: thermal_expansion = 6.5e-4_dp
      logical :: thermal_reduction = .false.
      !> Set by the reader from a law, by pyehl from a data sheet
      real(dp) :: temperature_viscosity = 0.0_dp
      real(dp) :: thermal_conductivity = 0.14_dp
      character(len=word_length) :: thermal_friction = "auto"
   end type lubricant_case_t

   !> &inlet: a starved inlet
   type :: inlet_case_t
      !> Distance of the meniscus ahead of the centre [m]; the same [a], set by the reader
      real(dp) :: position = 0.0_dp, position_hertz = 0.0_dp
      !> Thickness of the oil layer at the inlet [m]; the same [a^2/R], set by the reader
      real(dp) :: film = 0.0_dp, film_hertz = 0.0_dp
      !> Number of successive contacts, and fraction of the missing oil that returns between them
      integer :: passages = 1
      real(dp) :: replenishment = 0.0_dp
   end type inlet_case_t

   !> &grid: the domain in Hertz radii a and its finest grid; all except target_error and max_points set by the reader
   type :: grid_case_t
      integer :: points = 513
      !> As many as along X in a round contact, otherwise from the shape of the cells; 1 in a line contact
      integer :: points_y = 0
      real(dp) :: x_inlet = -2.5_dp, x_outlet = 1.5_dp, y_extent = 2.0_dp
      character(len=word_length) :: border = "zero"
      real(dp) :: target_error = 0.0_dp
      integer :: max_points = 2049
   end type grid_case_t

   !> &surface and &second_surface: the moving roughness of a body
   type :: surface_case_t
      character(len=word_length) :: kind = "smooth"
      !> Whether `amplitude` is given instead of `amplitude_over_film`. Not a key; set by the reader.
      logical :: amplitude_given = .false.
      real(dp) :: amplitude = 0.0_dp
      real(dp) :: amplitude_over_film = 0.4_dp
      real(dp) :: height_m = 0.0_dp
      real(dp) :: width = 0.5_dp, length = 0.0_dp
      real(dp) :: width_m = 0.0_dp, length_m = 0.0_dp
      real(dp) :: angle = 0.0_dp
      real(dp) :: y_start = 0.0_dp
      real(dp) :: spacing_y = 0.0_dp
      real(dp) :: wavelength = 0.5_dp
      !> These, the velocity and the start are set by the reader
      real(dp) :: wavelength_x = 0.5_dp, wavelength_y = 0.5_dp
      real(dp) :: velocity_ratio = 1.01_dp
      real(dp) :: x_start = -2.5_dp
      !> File, whose path the reader makes absolute. The solver reads .npy files, pyehl all others.
      character(len=path_length) :: file = "", channel = ""
      !> Set by the reader for a fractal surface
      real(dp) :: length_x = 0.0_dp, length_y = 0.0_dp
      real(dp) :: crop_x_min = 0.0_dp, crop_x_max = 0.0_dp, crop_y_min = 0.0_dp, crop_y_max = 0.0_dp
      character(len=word_length) :: height_unit = "m"
      character(len=word_length) :: lateral_unit = "same"
      character(len=word_length) :: profile = "none"
      integer :: sign = 1
      real(dp) :: outliers = 0.0_dp
      character(len=word_length) :: align_lines = "none"
      character(len=word_length) :: fill = "harmonic"
      character(len=word_length) :: detrend = "auto"
      real(dp) :: rotate = 0.0_dp
      character(len=word_length) :: edges = "auto"
      real(dp) :: track = 0.0_dp
      real(dp) :: tile_x = 0.0_dp, tile_y = 0.0_dp
      logical :: tile_mirrored = .false.
      real(dp) :: shortest_wavelength = 0.0_dp, longest_wavelength = 0.0_dp
      character(len=word_length) :: filter = "sharp"
      !> Set by pyehl from ra, rq or finish, which also gives hurst, lay_ratio and rolloff_wavenumber
      real(dp) :: rms_height = 0.05e-6_dp
      real(dp) :: ra = 0.0_dp, rq = 0.0_dp
      character(len=word_length) :: finish = "none"
      real(dp) :: lay_ratio = 1.0_dp
      real(dp) :: hurst = 0.8_dp
      real(dp) :: rolloff_wavenumber = 0.0_dp
      integer :: pixels = 256
      integer :: seed = 1
      character(len=word_length) :: modulus = "deterministic"
   end type surface_case_t

   !> &time: the transient run of a moving surface
   type :: time_case_t
      character(len=word_length) :: scheme = "narrow"
      real(dp) :: tolerance = 1.0e-3_dp
      integer :: max_periods = 0
      logical :: skip_start = .true.
      character(len=word_length) :: start = "front"
      logical :: estimate_error = .true.
      integer :: steps = 0
   end type time_case_t

   !> &duty: quantities that change with time; not allocated or of size 0: constant
   type :: duty_case_t
      !> File of the table, which pyehl reads, with an absolute path
      character(len=path_length) :: file = ""
      character(len=word_length) :: interpolation = "linear"
      logical :: periodic = .false.
      integer :: periods = 3
      !> Time step over that from the mesh size; target of the time-step error of the films
      real(dp) :: time_step = 1.0_dp, target_error = 0.0_dp
      real(dp), allocatable, dimension(:) :: time, load, u1, u2, mean_velocity, slide_to_roll, radius_x, radius_y, viscosity, &
                                             inlet_film
   contains
      procedure :: active => has_duty
      procedure :: list
      procedure :: reverses
   end type duty_case_t

   !> &solver: how the equations are solved
   type :: solver_case_t
      character(len=word_length) :: deflection = "mlmi"
      character(len=word_length) :: coarsening = "auto"
      character(len=word_length) :: symmetry = "auto"
      character(len=word_length) :: cycle = "auto"
      real(dp) :: accuracy = 0.1_dp
      integer :: max_cycles = 30
      integer :: threads = 1
   end type solver_case_t

   !> &psd: friction prediction from the surface spectrum, used only by pyehl
   type :: psd_case_t
      real(dp) :: film_thickness = 0.0_dp, film_limit = 0.0_dp
      character(len=word_length) :: reduction = "response"
      character(len=word_length) :: smooth = "solved"
      character(len=word_length) :: wavelength_convention = "components"
      character(len=word_length) :: stiffness = "exact"
      !> Set by the reader to that of &lubricant
      character(len=word_length) :: viscosity_law = ""
      logical :: load_balance = .false.
      integer :: positions = 0
   end type psd_case_t

   !> &output: fields, frames and checkpoints
   type :: output_case_t
      logical :: fields = .true.
      real(dp) :: frame_interval = 0.0_dp
      real(dp) :: checkpoint_interval = 30.0_dp
   end type output_case_t

   !> A whole case
   type :: case_t
      type(contact_case_t) :: contact
      type(bodies_case_t) :: bodies
      type(lubricant_case_t) :: lubricant
      type(inlet_case_t) :: inlet
      type(grid_case_t) :: grid
      type(surface_case_t) :: surface
      !> The surface of the other body
      type(surface_case_t) :: second_surface
      type(time_case_t) :: time
      type(duty_case_t) :: duty
      type(solver_case_t) :: solver
      type(psd_case_t) :: psd
      type(output_case_t) :: output
      !> The case as namelist text
      character(len=:), allocatable :: text
   end type case_t

contains

   !> Whether the contact is an infinite line
   pure logical function is_line(self)
      class(contact_case_t), intent(in) :: self
      is_line = self%shape == "line"
   end function is_line

   !> Whether the contact is a roller of finite length
   pure logical function is_roller(self)
      class(contact_case_t), intent(in) :: self
      is_roller = self%shape == "roller"
   end function is_roller

   !> Whether the contact has a single radius, and no curvature across the motion except by a profile
   pure logical function is_cylinder(self)
      class(contact_case_t), intent(in) :: self
      is_cylinder = self%is_line() .or. self%is_roller()
   end function is_cylinder

   !> Profile of both bodies of a roller
   pure function body_profile(self) result(profile)
      class(contact_case_t), intent(in) :: self
      type(profile_t) :: profile

      profile = profile_t(self%profiles, self%length, self%misalignment)
   end function body_profile

   !> Whether the case has a duty
   pure logical function has_duty(self)
      class(duty_case_t), intent(in) :: self
      has_duty = size(self%list("time")) > 0
   end function has_duty

   !> Whether the mean velocity is negative at times
   pure logical function reverses(self)
      class(duty_case_t), intent(in) :: self
      reverses = any(self%list("mean_velocity") < 0.0_dp)
      if (size(self%list("u1")) > 0 .and. size(self%list("u1")) == size(self%list("u2"))) then
         reverses = reverses .or. any(self%u1 + self%u2 < 0.0_dp)
      end if
   end function reverses

   !> Numbers of a key; of size 0 if not given
   pure function list(self, key) result(numbers)
      class(duty_case_t), intent(in) :: self
      character(len=*), intent(in) :: key
      real(dp), allocatable :: numbers(:)

      select case (key)
      case ("time")
         if (allocated(self%time)) numbers = self%time
      case ("load")
         if (allocated(self%load)) numbers = self%load
      case ("u1")
         if (allocated(self%u1)) numbers = self%u1
      case ("u2")
         if (allocated(self%u2)) numbers = self%u2
      case ("mean_velocity")
         if (allocated(self%mean_velocity)) numbers = self%mean_velocity
      case ("slide_to_roll")
         if (allocated(self%slide_to_roll)) numbers = self%slide_to_roll
      case ("radius_x")
         if (allocated(self%radius_x)) numbers = self%radius_x
      case ("radius_y")
         if (allocated(self%radius_y)) numbers = self%radius_y
      case ("viscosity")
         if (allocated(self%viscosity)) numbers = self%viscosity
      case ("inlet_film")
         if (allocated(self%inlet_film)) numbers = self%inlet_film
      case default
         continue
      end select
      if (.not. allocated(numbers)) allocate (numbers(0))
   end function list

   !> Load [N], or load per unit length of a line [N/m]
   pure real(dp) function size_of_load(self)
      class(contact_case_t), intent(in) :: self
      size_of_load = merge(self%load_per_length, self%load, self%is_line())
   end function size_of_load

   !> M and L of a point or line contact
   pure function moes_numbers(self) result(numbers)
      class(contact_case_t), intent(in) :: self
      real(dp) :: numbers(2)
      numbers = [self%moes_m, self%moes_l]
      if (self%is_line()) numbers = [self%moes_m_line, self%moes_l_line]
   end function moes_numbers

   !> Whether a kind of surface is a single feature
   pure logical function is_feature(kind)
      character(len=*), intent(in) :: kind
      character(len=*), parameter :: kinds(4) = [character(len=6) :: "dent", "bump", "ridge", "groove"]
      is_feature = any(kinds == kind)
   end function is_feature

   !> Whether the keys of a surface leave it smooth
   pure logical function has_no_height(s) result(none)
      type(surface_case_t), intent(in) :: s

      select case (s%kind)
      case ("smooth")
         none = .true.
      case ("map")
         none = .false.
      case ("fractal")
         none = .not. s%rms_height > 0.0_dp
      case default
         none = .not. max(merge(s%amplitude, s%amplitude_over_film, s%amplitude_given), s%height_m) > 0.0_dp
      end select
   end function has_no_height
end module ehl_case

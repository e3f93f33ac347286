! SPDX-License-Identifier: BSD-3-Clause
!> Everything a case file can say, one type per namelist group, with the defaults
module ehl_case
   use ehl_kinds, only: dp
   implicit none (type, external)
   private
   public :: case_t, surface_case_t, is_feature, word_length, path_length

   !> Longest option word
   integer, parameter :: word_length = 32
   !> Longest file name
   integer, parameter :: path_length = 1024

   !> &contact: the operating point, by its Moes numbers or in SI units
   type :: contact_case_t
      !> Whether the case was given in SI: then load, mean_velocity, radius and reduced_modulus
      !> hold, else moes_m and moes_l. Not a key; set by the reader.
      logical :: si = .true.
      !> [-] M = W2 (2U)^(-3/4), default 1000
      real(dp) :: moes_m = 1000.0_dp
      !> [-] L = G (2U)^(1/4), default 10; 0 is the isoviscous elastic limit
      real(dp) :: moes_l = 10.0_dp
      !> [N] load w, default 600
      real(dp) :: load = 600.0_dp
      !> [m/s] mean velocity of the surfaces (u1 + u2)/2, default 0.84
      real(dp) :: mean_velocity = 0.84_dp
      !> [m] reduced radius R of a round contact, default 0.018
      real(dp) :: radius = 0.018_dp
      !> Whether the case was given by `radius`. Not a key; set by the reader.
      logical :: round = .true.
      !> [m] reduced radii in the plane of the motion and across it; 0 (default): those of `radius`. Set by the reader.
      real(dp) :: radius_x = 0.0_dp, radius_y = 0.0_dp
      !> [-] radius_x/radius_y, default 1; set by the reader where the case was given in SI
      real(dp) :: radius_ratio = 1.0_dp
      !> [Pa] reduced modulus E', 2/E' = sum of (1 - nu^2)/E of the bodies, default 2.26e11
      real(dp) :: reduced_modulus = 2.26e11_dp
      !> [deg] angle of the plane of radius_x against that of the motion, counter-clockwise, default 0
      real(dp) :: angle = 0.0_dp
      !> [-] slide-to-roll ratio (u1 - u2)/u, default 0.02; follows from surface velocity_ratio where that is given
      real(dp) :: slide_to_roll = 0.02_dp
      !> Which surface is rough: 1 (default) or 2
      integer :: rough_surface = 1
      !> [W/(m K)] thermal conductivity of the solids, default 46 (bearing steel)
      real(dp) :: thermal_conductivity = 46.0_dp
      !> [m^2/s] thermal diffusivity of the solids, default 1.25e-5
      real(dp) :: thermal_diffusivity = 1.25e-5_dp
   end type contact_case_t

   !> &bodies: what makes the reduced radii and the reduced modulus; it rules where one of its keys is given
   type :: bodies_case_t
      !> [m] radii of body 1 and of body 2 in the plane of the motion and across it; negative: concave, 0 (default): flat
      real(dp) :: radius_x1 = 0.0_dp, radius_y1 = 0.0_dp, radius_x2 = 0.0_dp, radius_y2 = 0.0_dp
      !> [Pa] Young's moduli, default 2.06e11; [-] Poisson's ratios, default 0.3 (steel)
      real(dp) :: modulus_1 = 2.06e11_dp, modulus_2 = 2.06e11_dp, poisson_1 = 0.3_dp, poisson_2 = 0.3_dp
      !> Whether they hold. Not a key; set by the reader.
      logical :: given = .false.
   end type bodies_case_t

   !> &lubricant: viscosity and density under pressure
   type :: lubricant_case_t
      !> [Pa s] viscosity at ambient pressure eta0, default 0.04
      real(dp) :: viscosity = 0.04_dp
      !> [1/Pa] pressure-viscosity coefficient alpha, default 2.2e-8
      real(dp) :: pressure_viscosity = 2.2e-8_dp
      !> 'roelands' (default) or 'barus'
      character(len=word_length) :: viscosity_law = "roelands"
      !> [-] Roelands exponent z, default alpha p0/(ln eta0 + 9.67); set by the reader
      real(dp) :: roelands_z = 0.0_dp
      !> [Pa] Roelands pressure p0, default 1.96e8
      real(dp) :: roelands_p0 = 1.96e8_dp
      !> 'dowson-higginson' (default) or 'incompressible'
      character(len=word_length) :: density_law = "dowson-higginson"
      !> 'newtonian' (default), 'eyring', 'limiting' or 'carreau': shear stress, for friction
      character(len=word_length) :: shear_law = "newtonian"
      !> [Pa] Eyring stress, default 5e6
      real(dp) :: eyring_stress = 5.0e6_dp
      !> [Pa] limiting shear stress; 0 (default): limiting_coefficient times pressure
      real(dp) :: limiting_stress = 0.0_dp
      !> [-] limiting shear stress over pressure, default 0.06
      real(dp) :: limiting_coefficient = 0.06_dp
      !> [Pa] stress at which a Carreau fluid begins to thin, and [-] its power-law exponent; no defaults
      real(dp) :: carreau_stress = 0.0_dp, carreau_exponent = 0.0_dp
      !> [degC] temperature of the inlet, default 40; it rules where the viscosities of a data sheet are given
      real(dp) :: temperature = 40.0_dp
      !> [mm^2/s] kinematic viscosities at 40 and 100 degC; 0 (default): `viscosity` is given
      real(dp) :: kinematic_viscosity_40 = 0.0_dp, kinematic_viscosity_100 = 0.0_dp
      !> [kg/m^3] density at 15 degC, default 870; [1/K] its relative fall with temperature, default 6.5e-4
      real(dp) :: density_15 = 870.0_dp, thermal_expansion = 6.5e-4_dp
      !> whether shear heating of the inlet thins the film, default .false.
      logical :: thermal_reduction = .false.
      !> [1/K] -(d eta/dT)/eta; default from the data sheet, set by the reader
      real(dp) :: temperature_viscosity = 0.0_dp
      !> [W/(m K)] thermal conductivity of the oil, default 0.14
      real(dp) :: thermal_conductivity = 0.14_dp
   end type lubricant_case_t

   !> &grid: the domain in Hertz radii a and its finest grid
   type :: grid_case_t
      !> [-] nodes along X, odd and coarsenable, default 513
      integer :: points = 513
      !> [-] nodes along Y; 0 (default): as many as along X in a round contact, else by the domain. Set by the reader.
      integer :: points_y = 0
      !> [a] inlet boundary X, default -2.5
      real(dp) :: x_inlet = -2.5_dp
      !> [a] outlet boundary X, default 1.5
      real(dp) :: x_outlet = 1.5_dp
      !> [a] the domain is -y_extent <= Y <= y_extent, default 2
      real(dp) :: y_extent = 2.0_dp
      !> What is at the border: 'flooded', the pressure of a fully flooded contact, or 'zero', P = 0; default by M
      character(len=word_length) :: border = "zero"
      !> [-] relative error of the central film wanted; 0 (default): use `points` as it is, else
      !> grids of the family of `points` are refined until the estimated error is below it
      real(dp) :: target_error = 0.0_dp
      !> [-] largest number of nodes per side that target_error may choose, default 2049
      integer :: max_points = 2049
   end type grid_case_t

   !> &surface: the moving roughness
   type :: surface_case_t
      !> 'smooth' (default), 'harmonic', 'map', 'fractal'; 'dent', 'bump', 'ridge' or 'groove', which pass once
      character(len=word_length) :: kind = "smooth"
      !> Whether `amplitude` holds and not `amplitude_over_film`. Not a key; set by the reader.
      logical :: amplitude_given = .false.
      !> [a^2/R] harmonic amplitude A_i, height or depth of a single feature; no default
      real(dp) :: amplitude = 0.0_dp
      !> [-] the same as a share of the smooth central film, A_i/H_c, default 0.4
      real(dp) :: amplitude_over_film = 0.4_dp
      !> [m] height or depth of a single feature; 0 (default): amplitude or amplitude_over_film
      real(dp) :: height_m = 0.0_dp
      !> [a] size of a single feature across its line and along it; length 0 (default): dent and bump as long as
      !> wide, ridge and groove without ends
      real(dp) :: width = 0.5_dp, length = 0.0_dp
      !> [m] the same; 0 (default): width, length
      real(dp) :: width_m = 0.0_dp, length_m = 0.0_dp
      !> [deg] a single feature is turned counter-clockwise, default 0: across the motion
      real(dp) :: angle = 0.0_dp
      !> [a] position of a single feature across the motion, default 0
      real(dp) :: y_start = 0.0_dp
      !> [a] wavelength, default 0.5
      real(dp) :: wavelength = 0.5_dp
      !> [a] wavelengths along X and Y, default `wavelength`; set by the reader
      real(dp) :: wavelength_x = 0.5_dp, wavelength_y = 0.5_dp
      !> [-] velocity of the rough surface over the mean velocity, default 1 + SRR/2 (surface 1) or 1 - SRR/2; set
      !> by the reader
      real(dp) :: velocity_ratio = 1.01_dp
      !> [a] where the roughness begins at time 0, at rest its origin, default grid x_inlet; set by the reader
      real(dp) :: x_start = -2.5_dp
      !> Height map of kind 'map', heights in m, peaks positive; made absolute by the reader (a relative
      !> name starts at the folder of the case file). .npy and text are read here, the rest by pyehl
      character(len=path_length) :: file = ""
      !> Channel or data set of an instrument file, by name or number from 1; '' (default): its first
      character(len=path_length) :: channel = ""
      !> [m] size of the tile of a map or fractal surface; 0 (default): that of the file. Of a fractal
      !> surface the reader makes it 8.29e-4
      real(dp) :: length_x = 0.0_dp, length_y = 0.0_dp
      !> [m] part of the map that is used; a maximum of 0 (default): to its end
      real(dp) :: crop_x_min = 0.0_dp, crop_x_max = 0.0_dp, crop_y_min = 0.0_dp, crop_y_max = 0.0_dp
      !> 1 (default), or -1 for a map whose valleys are positive
      integer :: sign = 1
      !> [-] spikes beyond so many standard deviations are removed; 0 (default): none
      real(dp) :: outliers = 0.0_dp
      !> 'harmonic' (default): missing points are interpolated; 'none': refused
      character(len=word_length) :: fill = "harmonic"
      !> 'none', 'centre', 'tilt', 'curvature'; 'auto' (default): tilt for files of instruments, else none
      character(len=word_length) :: detrend = "auto"
      !> [deg] the map is turned counter-clockwise, default 0
      real(dp) :: rotate = 0.0_dp
      !> 'mirror', 'window', 'periodic'; 'auto' (default): mirror for files of instruments, else periodic
      character(len=word_length) :: edges = "auto"
      !> [m] the map is moved across the motion, so that the line at y = track passes the centre, default 0
      real(dp) :: track = 0.0_dp
      !> [m] size of the tile that pyehl has made of a map; 0 (default): length_x, length_y
      real(dp) :: tile_x = 0.0_dp, tile_y = 0.0_dp
      !> Whether the tile that pyehl has made is the heights that it gives with their mirror images, default .false.
      logical :: tile_mirrored = .false.
      !> [m] shortest and longest wavelength of a map or fractal surface that are left, default 0: no limit
      real(dp) :: shortest_wavelength = 0.0_dp, longest_wavelength = 0.0_dp
      !> 'sharp' (default) or 'gaussian': how the spectrum is cut there
      character(len=word_length) :: filter = "sharp"
      !> [m] rms height of a fractal surface before its spectrum is cut, default 0.05e-6
      real(dp) :: rms_height = 0.05e-6_dp
      !> [-] Hurst exponent of a fractal surface, default 0.8
      real(dp) :: hurst = 0.8_dp
      !> [rad/m] wavenumber below which the spectrum is flat; 0 (default): none
      real(dp) :: rolloff_wavenumber = 0.0_dp
      !> [-] pixels per side of a fractal surface, default 256
      integer :: pixels = 256
      !> [-] seed of the random phases, default 1
      integer :: seed = 1
      !> 'deterministic' (default) or 'gaussian' modulus of the Fourier components
      character(len=word_length) :: modulus = "deterministic"
   end type surface_case_t

   !> &time: the transient run of a moving surface
   type :: time_case_t
      !> 'narrow' (default) or 'paper': how wedge and squeeze terms are discretised
      character(len=word_length) :: scheme = "narrow"
      !> [-] relative change of the mean mu_r/mu_s between periods at which to stop, default 1e-3
      real(dp) :: tolerance = 1.0e-3_dp
      !> [-] most periods; 0 (default): automatic
      integer :: max_periods = 0
      !> whether nothing is solved before the roughness comes near the contact, default .true.
      logical :: skip_start = .true.
      !> whether the run is made on the next coarser grid too, for the grid error of the friction
      !> ratio (an eighth more work), default .true.
      logical :: estimate_error = .true.
      !> [-] exactly that many steps; 0 (default): until the friction is periodic
      integer :: steps = 0
   end type time_case_t

   !> &solver: how the equations are solved
   type :: solver_case_t
      !> 'mlmi' (default), 'fft' or 'direct': how the elastic deflection is evaluated
      character(len=word_length) :: deflection = "mlmi"
      !> Transfers and coarse operators in time steps
      character(len=word_length) :: coarsening = "auto"
      !> 'auto' (default): half the domain where the scene is symmetric in Y; 'full': never
      character(len=word_length) :: symmetry = "auto"
      !> 'W', 'V' or 'F' cycles; 'auto' (default): F for the smooth contact, V for time steps
      character(len=word_length) :: cycle = "auto"
      !> [-] algebraic error wanted as a share of the discretisation error, default 0.1
      real(dp) :: accuracy = 0.1_dp
      !> [-] most cycles per level, default 30
      integer :: max_cycles = 30
      !> [-] OpenMP threads, default 1; results do not depend on it
      integer :: threads = 1
   end type solver_case_t

   !> &psd: the friction prediction from the surface spectrum, made by pyehl alone
   type :: psd_case_t
      !> [m] central film; 0 (default): from the Nijenbanning-Venner-Moes formula
      real(dp) :: film_thickness = 0.0_dp
      !> 'response' (default) or 'amplitude': complex response of the contact, or the real ratio of the paper
      character(len=word_length) :: reduction = "response"
      !> 'solved' (default) or 'hertz': pressure and film under the roughness
      character(len=word_length) :: smooth = "solved"
      !> 'components' (default), 'wavevector' or 'pattern': the wavelength of a component
      character(len=word_length) :: wavelength_convention = "components"
      !> 'exact' (default) or 'paper' stiffness of the half-space
      character(len=word_length) :: stiffness = "exact"
      !> 'roelands' or 'barus'; default '': as in &lubricant, set by the reader
      character(len=word_length) :: viscosity_law = ""
      !> whether the pressure is rebalanced to carry the load, default .false.
      logical :: load_balance = .false.
      !> [-] positions of the surface over one passage; 0 (default): automatic
      integer :: positions = 0
   end type psd_case_t

   !> &output: what is written
   type :: output_case_t
      !> whether the fields X, Y, P, H are written, default .true.
      logical :: fields = .true.
      !> [a/u] time between frames of P and H that a transient run keeps, 0 (default): none
      real(dp) :: frame_interval = 0.0_dp
      !> [s] wall time between states of a transient run kept on disk, default 30; 0: none
      real(dp) :: checkpoint_interval = 30.0_dp
   end type output_case_t

   !> A whole case
   type :: case_t
      type(contact_case_t) :: contact
      type(bodies_case_t) :: bodies
      type(lubricant_case_t) :: lubricant
      type(grid_case_t) :: grid
      type(surface_case_t) :: surface
      type(time_case_t) :: time
      type(solver_case_t) :: solver
      type(psd_case_t) :: psd
      type(output_case_t) :: output
      !> Which keys were given, in the order of the table of keys; not allocated: nobody knows
      logical, allocatable :: given(:)
   end type case_t

contains

   !> Whether a kind of surface is a single feature
   pure logical function is_feature(kind)
      character(len=*), intent(in) :: kind
      character(len=*), parameter :: kinds(4) = [character(len=6) :: "dent", "bump", "ridge", "groove"]
      is_feature = any(kinds == kind)
   end function is_feature
end module ehl_case

! SPDX-License-Identifier: BSD-3-Clause
!> The one table of all keys: group, name, unit, allowed values, meaning, and where the value lives in a case; the
!> defaults are those of the types in ehl_case. ehl_law_keys has the constants of oils.
module ehl_keys
   use ehl_case, only: case_t, surface_case_t
   use ehl_case_key, only: kind_path, kind_text
   use ehl_law_keys, only: add_law_keys
   use ehl_oils, only: oil_names
   use ehl_schema, only: schema_t
   implicit none (type, external)
   private
   public :: bind_keys

contains

   !> Make the table for a case, which must outlive it
   subroutine bind_keys(self, input)
      type(schema_t), intent(out) :: self
      type(case_t), intent(inout), target :: input

      self%group = "contact"
      associate (c => input%contact)
         call self%reals("moes_m", c%moes_m, "-", "(0, 1e6]", "Moes load parameter M")
         call self%reals("moes_l", c%moes_l, "-", "[0, 100]", "Moes material parameter L")
         call self%reals("radius_ratio", c%radius_ratio, "-", "[0.004, 250]", &
                         "R_x/R_y of an elliptical contact, whose M and L are by R_x; 1: round")
         call self%reals("load", c%load, "N", "(0, 1e5]", "load")
         call self%reals("mean_velocity", c%mean_velocity, "m/s", "(0, 200]", "mean velocity of the two surfaces")
         call self%reals("radius", c%radius, "m", "[1e-5, 10]", "reduced radius of a round contact")
         call self%reals("radius_x", c%radius_x, "m", "0 or [1e-5, 1000]", &
                         "reduced radius in the plane of the motion; 0: radius")
         call self%reals("radius_y", c%radius_y, "m", "0 or [1e-5, 1000]", "reduced radius across the motion; both or none")
         call self%reals("reduced_modulus", c%reduced_modulus, "Pa", "[1e4, 2e12]", &
                         "E' with 2/E' = sum of (1 - nu^2)/E over the bodies")
         call self%reals("hardness", c%hardness, "Pa", "0 or [1e5, 1e12]", &
                         "greatest pressure of the solids, with boundary_film; 0: no limit")
         call self%reals("angle", c%angle, "deg", "[-90, 90]", &
                         "an elliptical contact is turned counter-clockwise against the motion")
         call self%reals("slide_to_roll", c%slide_to_roll, "-", "[-2, 2]", &
                         "slide-to-roll ratio (u1 - u2)/u; follows from a given velocity_ratio of a surface")
         call self%integers("rough_surface", c%rough_surface, "[1, 2]", "body with &surface; the other has &second_surface")
         call self%reals("thermal_conductivity", c%thermal_conductivity, "W/(m K)", "[0.1, 500]", &
                         "thermal conductivity of the solids, for the heat of friction")
         call self%reals("thermal_diffusivity", c%thermal_diffusivity, "m^2/s", "[1e-8, 1e-3]", &
                         "thermal diffusivity of the solids, for the heat of friction")
         call self%reals("thermal_conductivity_2", c%thermal_conductivity_2, "W/(m K)", "0 or [0.1, 500]", &
                         "that of body 2; 0: thermal_conductivity")
         call self%reals("thermal_diffusivity_2", c%thermal_diffusivity_2, "m^2/s", "0 or [1e-8, 1e-3]", &
                         "that of body 2; 0: thermal_diffusivity")
      end associate
      self%group = "bodies"
      associate (b => input%bodies)
         call self%reals("radius_x1", b%radius_x1, "m", "[-1e3, 1e3]", &
                         "radius of body 1 in the plane of the motion; negative: concave, 0: flat")
         call self%reals("radius_y1", b%radius_y1, "m", "[-1e3, 1e3]", "radius of body 1 across the motion")
         call self%reals("radius_x2", b%radius_x2, "m", "[-1e3, 1e3]", "radius of body 2 in the plane of the motion")
         call self%reals("radius_y2", b%radius_y2, "m", "[-1e3, 1e3]", "radius of body 2 across the motion")
         call self%reals("modulus_1", b%modulus_1, "Pa", "[1e3, 2e12]", "Young's modulus of body 1")
         call self%reals("modulus_2", b%modulus_2, "Pa", "[1e3, 2e12]", "Young's modulus of body 2")
         call self%reals("poisson_1", b%poisson_1, "-", "[-0.5, 0.5]", "Poisson's ratio of body 1")
         call self%reals("poisson_2", b%poisson_2, "-", "[-0.5, 0.5]", "Poisson's ratio of body 2")
      end associate
      self%group = "lubricant"
      associate (l => input%lubricant)
         call self%words("name", l%name, oil_words(), &
                         "an oil whose constants are known ('pyehl lubricants'); keys given beside it rule")
         call self%texts("table", l%table, kind_path, "measured viscosities over pressure and temperature: CSV")
         call self%reals("viscosity", l%viscosity, "Pa s", "[1e-4, 10]", "viscosity at ambient pressure")
         call self%reals("pressure_viscosity", l%pressure_viscosity, "1/Pa", "0 or [1e-10, 1e-7]", &
                         "pressure-viscosity coefficient; 0: the viscosity does not change with pressure")
         call self%words("viscosity_law", l%viscosity_law, "roelands|barus|dicke|yasutomi|doolittle|table", &
                         "viscosity under pressure; default that of name or table")
         call self%reals("roelands_z", l%roelands_z, "-", "[0, 1e4]", &
                         "Roelands exponent, there 1e-3 to 2; default alpha p0/(ln eta0 + 9.67)")
         call self%reals("roelands_p0", l%roelands_p0, "Pa", "[1e7, 1e10]", "Roelands reference pressure")
         call add_law_keys(self, l)
         call self%words("shear_law", l%shear_law, "newtonian|eyring|limiting|carreau", &
                         "shear stress in the contact")
         call self%words("flow", l%flow, "consistent|newtonian", &
                         "whether eyring and carreau thin the flow that makes the film, too, or the friction alone")
         call self%reals("eyring_stress", l%eyring_stress, "Pa", "[1e4, 1e9]", "Eyring stress")
         call self%reals("limiting_stress", l%limiting_stress, "Pa", "0 or [1e5, 1e10]", &
                         "limiting shear stress; 0: limiting_coefficient times pressure")
         call self%reals("limiting_coefficient", l%limiting_coefficient, "-", "[1e-4, 1]", &
                         "limiting shear stress over pressure")
         call self%reals("carreau_stress", l%carreau_stress, "Pa", "0 or [1e2, 1e10]", &
                         "stress G of Carreau at which thinning begins; no default")
         call self%reals("carreau_exponent", l%carreau_exponent, "-", "0 or [0.05, 1]", &
                         "power-law exponent n of Carreau; no default")
         call self%reals("boundary_film", l%boundary_film, "m", "0 or [1e-11, 1e-5]", &
                         "film at ambient pressure that contact does not squeeze out; 0: none, and no contact")
         call self%reals("boundary_friction", l%boundary_friction, "-", "0 or [1e-3, 2]", &
                         "friction coefficient where the bodies touch at the boundary film; 0: not known")
         call self%reals("temperature", l%temperature, "degC", "[-60, 250]", &
                         "temperature of the inlet; needs what tells the viscosity by temperature")
         call self%reals("kinematic_viscosity_40", l%kinematic_viscosity_40, "mm^2/s", "0 or [1, 1e5]", &
                         "at 40 degC, as on data sheets; viscosity then follows. 0: not known")
         call self%reals("kinematic_viscosity_100", l%kinematic_viscosity_100, "mm^2/s", "0 or [0.5, 1e4]", &
                         "at 100 degC; both or none")
         call self%reals("density_15", l%density_15, "kg/m^3", "[500, 2000]", "density at 15 degC")
         call self%reals("thermal_expansion", l%thermal_expansion, "1/K", "[0, 2e-3]", &
                         "relative fall of the density with temperature")
         call self%logicals("thermal_reduction", l%thermal_reduction, &
                            "shear heating of the inlet thins the film (Gupta et al. 1992)")
         call self%reals("temperature_viscosity", l%temperature_viscosity, "1/K", "0 or [1e-3, 0.3]", &
                         "-(d eta/dT)/eta; default from the kinematic viscosities, 0: not known")
         call self%reals("thermal_conductivity", l%thermal_conductivity, "W/(m K)", "[0.01, 2]", &
                         "thermal conductivity of the oil, for its heat")
         call self%words("thermal_friction", l%thermal_friction, "auto|always|never", &
                         "friction with the temperature of the film; auto: where it counts and temperature_viscosity is known")
      end associate
      self%group = "grid"
      associate (g => input%grid)
         call self%integers("points", g%points, "[17, 4097]", &
                            "nodes along X, odd; points - 1 halved stays even to 32; default 1025 if 513 misses 5 % of H_c")
         call self%integers("points_y", g%points_y, "0 or [9, 40961]", &
                            "nodes along Y, halved as often; default points in a round contact, else by the shape of the cells")
         call self%reals("x_inlet", g%x_inlet, "a", "[-1e4, -1.05]", "inlet boundary X; default by M and L")
         call self%reals("x_outlet", g%x_outlet, "a", "[1.05, 1e4]", "outlet boundary X; default by M and L")
         call self%reals("y_extent", g%y_extent, "a", "[0.03, 1e4]", &
                         "side boundaries Y = -y_extent and y_extent; default by M, L and the ellipse")
         call self%words("border", g%border, "flooded|zero", &
                         "pressure of a flooded contact, or P = 0; default: the former below M = 500 or above kappa = 4")
         call self%reals("target_error", g%target_error, "-", "0 or [1e-5, 0.1]", &
                         "relative error of H_c wanted; 0: solve on points as given")
         call self%integers("max_points", g%max_points, "[17, 8193]", "most nodes per side that target_error may choose")
      end associate
      self%group = "surface"
      call add_surface_keys(self, input%surface)
      self%group = "second_surface"
      call add_surface_keys(self, input%second_surface)
      self%group = "time"
      associate (t => input%time)
         call self%words("scheme", t%scheme, "narrow|paper", &
                         "wedge and squeeze: along the characteristic, or each by itself")
         call self%reals("tolerance", t%tolerance, "-", "[1e-8, 0.5]", &
                         "stop when the period mean of mu_r/mu_s changes less, relatively")
         call self%integers("max_periods", t%max_periods, "[0, 100000]", &
                            "most periods, of two surfaces those of the slower one; 0: 36")
         call self%words("start", t%start, "front|prediction", &
                         "roughness enters behind a front, or fills the contact as pyehl predicts")
         call self%logicals("skip_start", t%skip_start, "solve nothing before the roughness comes near the contact")
         call self%logicals("estimate_error", t%estimate_error, &
                            "run on the next coarser grid too, for the grid error of mu_ratio")
         call self%integers("steps", t%steps, "[0, 10000000]", "exactly so many steps; 0: until the friction is known")
      end associate
      self%group = "solver"
      associate (s => input%solver)
         call self%words("deflection", s%deflection, "mlmi|fft", "evaluation of the elastic deflection")
         call self%words("coarsening", s%coarsening, "auto|classical|alcouffe", &
                         "transfers in time steps: bilinear, or by the conductance (Galerkin)")
         call self%words("symmetry", s%symmetry, "auto|full", "auto: half the domain where the scene is symmetric in Y")
         call self%words("cycle", s%cycle, "auto|W|V|F", &
                         "multigrid cycle, all of a kind; auto: F and a light second one for a smooth contact, V for time steps")
         call self%reals("accuracy", s%accuracy, "-", "[1e-6, 1]", &
                         "algebraic error wanted as a share of the discretisation error")
         call self%integers("max_cycles", s%max_cycles, "[1, 10000]", &
                            "most cycles per level; three times as many at a boundary film, ten in a time step with damped changes")
         call self%integers("threads", s%threads, "[1, 256]", "OpenMP threads; the result does not depend on it")
      end associate
      self%group = "psd"
      associate (p => input%psd)
         call self%words("reduction", p%reduction, "response|amplitude", &
                         "what is left of a wave: complex response, or the real ratio of the paper")
         call self%words("smooth", p%smooth, "solved|hertz", &
                         "smooth contact: solved, or semi-ellipse and uniform film as in the paper")
         call self%reals("film_thickness", p%film_thickness, "m", "[0, 1e-3]", &
                         "central film; 0: solved, or with smooth = 'hertz' from the Nijenbanning-Venner-Moes formula")
         call self%reals("film_limit", p%film_limit, "m", "[0, 1e-3]", &
                         "film; the share of the contact with less is reported; 0: none")
         call self%words("wavelength_convention", p%wavelength_convention, "components|wavevector|pattern", &
                         "what the wavelength of a component is, for reduction = 'amplitude'")
         call self%words("stiffness", p%stiffness, "exact|paper", "stiffness of the half-space")
         call self%words("viscosity_law", p%viscosity_law, "roelands|barus|dicke|yasutomi|doolittle|table|", &
                         "viscosity under pressure; default as in &lubricant")
         call self%logicals("load_balance", p%load_balance, "rebalance the pressure to carry the load")
         call self%integers("positions", p%positions, "[0, 4096]", &
                            "positions of the surface over one passage; 0: automatic")
      end associate
      self%group = "output"
      associate (o => input%output)
         call self%logicals("fields", o%fields, "write the fields X, Y, P, H")
         call self%reals("frame_interval", o%frame_interval, "a/u", "[0, 1000]", &
                         "time between frames of P and H that a transient run keeps; 0: none")
         call self%reals("checkpoint_interval", o%checkpoint_interval, "s", "[0, 1e6]", &
                         "wall time between states of a transient run kept on disk; 0: none")
      end associate
      self%keys = self%keys(:self%n)
   end subroutine bind_keys

   !> Names of oils as choices, with none as the last one
   pure function oil_words() result(words)
      character(len=:), allocatable :: words
      integer :: k

      words = ""
      do k = 1, size(oil_names)
         words = words//trim(oil_names(k))//"|"
      end do
   end function oil_words

   !> A surface, in the group that is set
   subroutine add_surface_keys(self, s)
      type(schema_t), intent(inout) :: self
      type(surface_case_t), intent(inout), target :: s

      call self%words("kind", s%kind, "smooth|harmonic|map|fractal|dent|bump|ridge|groove", &
                      "the moving roughness; the last four pass once")
      call self%reals("amplitude", s%amplitude, "a^2/R", "[0, 1]", &
                      "amplitude A_i of a wave, height or depth of a feature; no default")
      call self%reals("amplitude_over_film", s%amplitude_over_film, "-", "[0, 10]", &
                      "the same as a share of the smooth central film, extrapolated to fine grids")
      call self%reals("wavelength", s%wavelength, "a", "[0.01, 100]", "harmonic wavelength")
      call self%reals("wavelength_x", s%wavelength_x, "a", "[0.01, 100]", "wavelength along X; default wavelength")
      call self%reals("wavelength_y", s%wavelength_y, "a", "[0.01, 1e6]", "wavelength along Y; default wavelength")
      call self%reals("velocity_ratio", s%velocity_ratio, "-", "[0, 2]", &
                      "velocity of the rough surface over the mean one; default 1 + SRR/2 on body 1, 1 - SRR/2 on body 2")
      call self%reals("x_start", s%x_start, "a", "[-1e5, 1e4]", &
                      "where the roughness begins at time 0, at rest its origin; default x_inlet")
      call self%reals("height_m", s%height_m, "m", "0 or [1e-12, 1e-4]", &
                      "height or depth of a single feature; 0: amplitude or amplitude_over_film")
      call self%reals("width", s%width, "a", "[0.01, 100]", "width of a single feature, across its line")
      call self%reals("length", s%length, "a", "0 or [0.01, 100]", &
                      "its length; 0: that of a dent or bump its width, of a ridge or groove endless")
      call self%reals("width_m", s%width_m, "m", "0 or [1e-9, 0.1]", "width of a single feature in metres; 0: width")
      call self%reals("length_m", s%length_m, "m", "0 or [1e-9, 0.1]", "length of a single feature in metres; 0: length")
      call self%reals("angle", s%angle, "deg", "[-360, 360]", &
                      "turn a single feature counter-clockwise; 0: it lies across the motion")
      call self%reals("y_start", s%y_start, "a", "[-20, 20]", "position of a single feature across the motion")
      call self%texts("file", s%file, kind_path, "height map of kind 'map': .npy, text, instrument file")
      call self%texts("channel", s%channel, kind_text, "channel of an instrument file: name, or number from 1")
      call self%reals("length_x", s%length_x, "m", "0 or [1e-9, 1]", &
                      "size of the map along X; 0: that of the file; fractal: 8.29e-4")
      call self%reals("length_y", s%length_y, "m", "0 or [1e-9, 1]", &
                      "size of the map along Y; 0: that of the file; fractal: 8.29e-4")
      call self%words("height_unit", s%height_unit, "m|mm|um|nm", &
                      "unit of the heights of a map that names none (.npy, text)")
      call self%words("lateral_unit", s%lateral_unit, "same|m|mm|um|nm", &
                      "unit of x and y in a list x y z, or of axes, that names none; same: that of the heights")
      call self%words("profile", s%profile, "none|isotropic|ridges", &
                      "the file is a profile: an isotropic surface of its spectrum, or it extended across")
      call self%reals("crop_x_min", s%crop_x_min, "m", "[0, 1]", "the map begins there along X")
      call self%reals("crop_x_max", s%crop_x_max, "m", "[0, 1]", "the map ends there; 0: at its end")
      call self%reals("crop_y_min", s%crop_y_min, "m", "[0, 1]", "the map begins there along Y")
      call self%reals("crop_y_max", s%crop_y_max, "m", "[0, 1]", "the map ends there; 0: at its end")
      call self%integers("sign", s%sign, "[-1, 1]", "-1: valleys of the map are positive")
      call self%reals("outliers", s%outliers, "-", "0 or [3, 1e6]", &
                      "points so many standard deviations off are spikes and removed; 0: none")
      call self%words("align_lines", s%align_lines, "none|x|y", &
                      "lines of a scan along X or Y are put level with each other, by their medians")
      call self%words("fill", s%fill, "harmonic|none", "missing points: interpolated, or refused")
      call self%words("detrend", s%detrend, "auto|none|centre|tilt|curvature", &
                      "form taken off; auto: tilt for instrument files, none for arrays")
      call self%reals("rotate", s%rotate, "deg", "[-360, 360]", "turn the map counter-clockwise")
      call self%words("edges", s%edges, "auto|mirror|window|periodic", &
                      "auto: mirror for instrument files, periodic for arrays")
      call self%reals("track", s%track, "m", "[-1, 1]", &
                      "line of a map or fractal surface that passes the centre, across the motion")
      call self%reals("tile_x", s%tile_x, "m", "0 or [1e-9, 10]", &
                      "size of the tile that pyehl has made of the map; not for input")
      call self%reals("tile_y", s%tile_y, "m", "0 or [1e-9, 10]", &
                      "size of the tile that pyehl has made of the map; not for input")
      call self%logicals("tile_mirrored", s%tile_mirrored, "that tile has mirror images; not for input")
      call self%reals("shortest_wavelength", s%shortest_wavelength, "m", "[0, 1]", &
                      "waves of a map or fractal surface shorter than this are cut; 0: none")
      call self%reals("longest_wavelength", s%longest_wavelength, "m", "[0, 1]", &
                      "waves of a map or fractal surface longer than this are cut; 0: none")
      call self%words("filter", s%filter, "sharp|gaussian", "how the spectrum is cut")
      call self%reals("rms_height", s%rms_height, "m", "[0, 1e-4]", &
                      "rms height of a fractal surface, before its spectrum is cut")
      call self%reals("ra", s%ra, "m", "[0, 1e-4]", "Ra in place of rms_height, of normal heights; 0: not given")
      call self%reals("rq", s%rq, "m", "[0, 1e-4]", "Rq in place of rms_height: the same; 0: not given")
      call self%words("finish", s%finish, "none|ground|honed|superfinished|polished", &
                      "a fractal surface with typical Ra, spectrum and lay, as far as not given")
      call self%reals("lay_ratio", s%lay_ratio, "-", "[0.01, 100]", &
                      "length of correlation along X over that along Y; below 1: lay across the motion")
      call self%reals("hurst", s%hurst, "-", "[0, 1]", "Hurst exponent")
      call self%reals("rolloff_wavenumber", s%rolloff_wavenumber, "rad/m", "[0, 1e11]", &
                      "the spectrum is flat below it; 0: no roll-off")
      call self%integers("pixels", s%pixels, "[4, 8192]", "pixels per side of a fractal surface")
      call self%integers("seed", s%seed, "[0, 2147483647]", "seed of the random phases")
      call self%words("modulus", s%modulus, "deterministic|gaussian", "modulus of the Fourier components")
   end subroutine add_surface_keys
end module ehl_keys

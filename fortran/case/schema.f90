! SPDX-License-Identifier: BSD-3-Clause
!> The one table of all keys: group, name, unit, allowed values, meaning, and where the value
!> lives in a case. Reading, checking, writing and documenting all walk this table; the
!> defaults are those of the types in ehl_case.
module ehl_schema
   use ehl_case, only: case_t, path_length, surface_case_t, word_length
   use ehl_case_key, only: key_t, kind_integer, kind_logical, kind_path, kind_real, kind_text, kind_word, name_length
   use ehl_kinds, only: dp
   implicit none (type, external)
   private
   public :: schema_t

   !> All keys, bound to one case
   type :: schema_t
      type(key_t), allocatable :: keys(:)
   contains
      procedure :: bind => bind_case
      procedure :: find
      procedure :: given
      procedure :: group_names
      procedure :: names_of
      procedure, private :: add_contact_keys
      procedure, private :: add_lubricant_keys
      procedure, private :: add_grid_keys
      procedure, private :: add_surface_keys
      procedure, private :: add_map_keys
      procedure, private :: add_feature_keys
      procedure, private :: add_time_keys
      procedure, private :: add_psd_keys
      procedure, private :: add
      procedure, private :: reals
      procedure, private :: integers
      procedure, private :: logicals
      procedure, private :: words
      procedure, private :: texts
   end type schema_t

   ! in schema_contact.f90
   interface
      module subroutine add_contact_keys(self, input)
         class(schema_t), intent(inout) :: self
         type(case_t), intent(inout), target :: input
      end subroutine add_contact_keys

      module subroutine add_lubricant_keys(self, input)
         class(schema_t), intent(inout) :: self
         type(case_t), intent(inout), target :: input
      end subroutine add_lubricant_keys

      !> A height map: its size, and what is done to it before it is a tile
      module subroutine add_map_keys(self, group, s)
         class(schema_t), intent(inout) :: self
         character(len=*), intent(in) :: group
         type(surface_case_t), intent(inout), target :: s
      end subroutine add_map_keys

      !> A single feature: its size and place
      module subroutine add_feature_keys(self, group, s)
         class(schema_t), intent(inout) :: self
         character(len=*), intent(in) :: group
         type(surface_case_t), intent(inout), target :: s
      end subroutine add_feature_keys
   end interface

contains

   !> Make the table for a case, which must outlive it
   subroutine bind_case(self, input)
      class(schema_t), intent(inout) :: self
      type(case_t), intent(inout), target :: input

      if (allocated(self%keys)) deallocate (self%keys)
      allocate (self%keys(0))
      call self%add_contact_keys(input)
      call self%add_lubricant_keys(input)
      call self%add_grid_keys(input)
      call self%add_surface_keys("surface", input%surface)
      call self%add_surface_keys("second_surface", input%second_surface)
      call self%add_time_keys(input)
      call self%add_psd_keys(input)
      call self%logicals("output", "fields", input%output%fields, "write the fields X, Y, P, H")
      call self%reals("output", "frame_interval", input%output%frame_interval, "a/u", "[0, 1000]", &
                      "time between frames of P and H that a transient run keeps; 0: none")
      call self%reals("output", "checkpoint_interval", input%output%checkpoint_interval, "s", "[0, 1e6]", &
                      "wall time between states of a transient run kept on disk; 0: none")
   end subroutine bind_case

   subroutine add_grid_keys(self, input)
      class(schema_t), intent(inout) :: self
      type(case_t), intent(inout), target :: input

      associate (g => input%grid)
         call self%integers("grid", "points", g%points, "[17, 4097]", &
                            "nodes per side: odd, points - 1 halved must end even at 32 or less")
         call self%reals("grid", "x_inlet", g%x_inlet, "a", "[-1e4, -1.05]", "inlet boundary X; default by M and L")
         call self%reals("grid", "x_outlet", g%x_outlet, "a", "[1.05, 1e4]", "outlet boundary X; default by M and L")
         call self%reals("grid", "y_extent", g%y_extent, "a", "[1.05, 1e4]", &
                         "side boundaries Y = -y_extent and y_extent; default by M and L")
         call self%words("grid", "border", g%border, "flooded|zero", &
                         "pressure of a flooded contact, or P = 0; default by M: the former below 500")
         call self%reals("grid", "target_error", g%target_error, "-", "0 or [1e-5, 0.1]", &
                         "relative error of H_c wanted; 0: solve on points as given")
         call self%integers("grid", "max_points", g%max_points, "[17, 8193]", &
                            "most nodes per side that target_error may choose")
      end associate
   end subroutine add_grid_keys

   !> One of the two surfaces, by the name of its group
   subroutine add_surface_keys(self, group, s)
      class(schema_t), intent(inout) :: self
      character(len=*), intent(in) :: group
      type(surface_case_t), intent(inout), target :: s

      call self%words(group, "kind", s%kind, "smooth|harmonic|map|fractal|dent|bump|ridge|groove", &
                      "the moving roughness; the last four pass once")
      call self%reals(group, "amplitude", s%amplitude, "a^2/R", "[0, 1]", &
                      "amplitude A_i of a wave, height or depth of a feature; no default")
      call self%reals(group, "amplitude_over_film", s%amplitude_over_film, "-", "[0, 10]", &
                      "the same as a share of the smooth central film, extrapolated to fine grids")
      call self%reals(group, "wavelength", s%wavelength, "a", "[0.01, 100]", &
                      "harmonic wavelength")
      call self%reals(group, "wavelength_x", s%wavelength_x, "a", "[0.01, 100]", &
                      "wavelength along X; default wavelength")
      call self%reals(group, "wavelength_y", s%wavelength_y, "a", "[0.01, 1e6]", &
                      "wavelength along Y; default wavelength")
      call self%reals(group, "velocity_ratio", s%velocity_ratio, "-", "[0, 2]", &
                      "velocity of the rough surface over the mean one; default 1 + SRR/2 on body 1, 1 - SRR/2 on body 2")
      call self%reals(group, "x_start", s%x_start, "a", "[-1e5, 1e4]", &
                      "where the roughness begins at time 0, at rest its origin; default x_inlet")
      call self%add_feature_keys(group, s)
      call self%texts(group, "file", s%file, kind_path, "height map of kind 'map': .npy, text, instrument file")
      call self%add_map_keys(group, s)
      call self%reals(group, "shortest_wavelength", s%shortest_wavelength, "m", "[0, 1]", &
                      "waves of a map or fractal surface shorter than this are cut; 0: none")
      call self%reals(group, "longest_wavelength", s%longest_wavelength, "m", "[0, 1]", &
                      "waves of a map or fractal surface longer than this are cut; 0: none")
      call self%words(group, "filter", s%filter, "sharp|gaussian", "how the spectrum is cut")
      call self%reals(group, "rms_height", s%rms_height, "m", "[0, 1e-4]", &
                      "rms height of a fractal surface, before its spectrum is cut")
      call self%reals(group, "hurst", s%hurst, "-", "[0, 1]", "Hurst exponent")
      call self%reals(group, "rolloff_wavenumber", s%rolloff_wavenumber, "rad/m", &
                      "[0, 1e11]", "the spectrum is flat below it; 0: no roll-off")
      call self%integers(group, "pixels", s%pixels, "[4, 8192]", &
                         "pixels per side of a fractal surface")
      call self%integers(group, "seed", s%seed, "[0, 2147483647]", "seed of the random phases")
      call self%words(group, "modulus", s%modulus, "deterministic|gaussian", &
                      "modulus of the Fourier components")
   end subroutine add_surface_keys

   subroutine add_time_keys(self, input)
      class(schema_t), intent(inout) :: self
      type(case_t), intent(inout), target :: input

      associate (t => input%time, s => input%solver)
         call self%words("time", "scheme", t%scheme, "narrow|paper", &
                         "wedge and squeeze: along the characteristic, or each by itself")
         call self%reals("time", "tolerance", t%tolerance, "-", "[1e-8, 0.5]", &
                         "stop when the period mean of mu_r/mu_s changes less, relatively")
         call self%integers("time", "max_periods", t%max_periods, "[0, 100000]", &
                            "most periods, of two surfaces those of the slower one; 0: 36")
         call self%logicals("time", "skip_start", t%skip_start, &
                            "solve nothing before the roughness comes near the contact")
         call self%logicals("time", "estimate_error", t%estimate_error, &
                            "run on the next coarser grid too, for the grid error of mu_ratio")
         call self%integers("time", "steps", t%steps, "[0, 10000000]", &
                            "exactly so many steps; 0: until the friction is known")
         call self%words("solver", "deflection", s%deflection, "mlmi|fft|direct", &
                         "evaluation of the elastic deflection")
         call self%words("solver", "coarsening", s%coarsening, "auto|classical|alcouffe", &
                         "transfers in time steps: bilinear, or by the conductance (Galerkin)")
         call self%words("solver", "symmetry", s%symmetry, "auto|full", &
                         "auto: half the domain where the scene is symmetric in Y")
         call self%words("solver", "cycle", s%cycle, "auto|W|V|F", "multigrid cycle, "// &
                    "all of a kind; auto: F and a light second one for a smooth contact, V for time steps")
         call self%reals("solver", "accuracy", s%accuracy, "-", "[1e-6, 1]", &
                         "algebraic error wanted as a share of the discretisation error")
         call self%integers("solver", "max_cycles", s%max_cycles, "[1, 10000]", "most cycles per level; ten times as many in "// &
                            "a time step that needs damped changes")
         call self%integers("solver", "threads", s%threads, "[1, 256]", &
                            "OpenMP threads; the result does not depend on it")
      end associate
   end subroutine add_time_keys

   subroutine add_psd_keys(self, input)
      class(schema_t), intent(inout) :: self
      type(case_t), intent(inout), target :: input

      associate (p => input%psd)
         call self%words("psd", "reduction", p%reduction, "response|amplitude", &
                         "what is left of a wave: complex response, or the real ratio of the paper")
         call self%words("psd", "smooth", p%smooth, "solved|hertz", &
                         "smooth contact: solved, or semi-ellipse and uniform film as in the paper")
         call self%reals("psd", "film_thickness", p%film_thickness, "m", "[0, 1e-3]", &
                         "central film; 0: solved, or with smooth = 'hertz' from the Nijenbanning-Venner-Moes formula")
         call self%words("psd", "wavelength_convention", p%wavelength_convention, &
                         "components|wavevector|pattern", "what the wavelength of a component is, for reduction = 'amplitude'")
         call self%words("psd", "stiffness", p%stiffness, "exact|paper", "stiffness of the half-space")
         call self%words("psd", "viscosity_law", p%viscosity_law, "roelands|barus|", &
                         "viscosity under pressure; default as in &lubricant")
         call self%logicals("psd", "load_balance", p%load_balance, "rebalance the pressure to carry the load")
         call self%integers("psd", "positions", p%positions, "[0, 4096]", &
                            "positions of the surface over one passage; 0: automatic")
      end associate
   end subroutine add_psd_keys

   !> A key behind the others
   subroutine add(self, key)
      class(schema_t), intent(inout) :: self
      type(key_t), intent(in) :: key

      self%keys = [self%keys, key]
   end subroutine add

   subroutine reals(self, group, name, value, unit, allowed, meaning)
      class(schema_t), intent(inout) :: self
      character(len=*), intent(in) :: group, name, unit, allowed, meaning
      real(dp), intent(inout), target :: value

      call self%add(key_t(group=group, name=name, kind=kind_real, unit=unit, &
                          allowed=allowed, meaning=meaning, real_value=value))
   end subroutine reals

   subroutine integers(self, group, name, value, allowed, meaning)
      class(schema_t), intent(inout) :: self
      character(len=*), intent(in) :: group, name, allowed, meaning
      integer, intent(inout), target :: value

      call self%add(key_t(group=group, name=name, kind=kind_integer, unit="-", &
                          allowed=allowed, meaning=meaning, integer_value=value))
   end subroutine integers

   subroutine logicals(self, group, name, value, meaning)
      class(schema_t), intent(inout) :: self
      character(len=*), intent(in) :: group, name, meaning
      logical, intent(inout), target :: value

      call self%add(key_t(group=group, name=name, kind=kind_logical, unit="-", &
                          allowed=".true.|.false.", meaning=meaning, logical_value=value))
   end subroutine logicals

   subroutine words(self, group, name, value, allowed, meaning)
      class(schema_t), intent(inout) :: self
      character(len=*), intent(in) :: group, name, allowed, meaning
      character(len=word_length), intent(inout), target :: value

      call self%add(key_t(group=group, name=name, kind=kind_word, unit="-", &
                          allowed=allowed, meaning=meaning, word_value=value))
   end subroutine words

   subroutine texts(self, group, name, value, kind, meaning)
      class(schema_t), intent(inout) :: self
      character(len=*), intent(in) :: group, name, meaning
      integer, intent(in) :: kind
      character(len=path_length), intent(inout), target :: value

      call self%add(key_t(group=group, name=name, kind=kind, unit="-", &
                          allowed="", meaning=meaning, path_value=value))
   end subroutine texts

   !> Position of a key in the table; 0 when there is no such key
   pure integer function find(self, group, name)
      class(schema_t), intent(in) :: self
      character(len=*), intent(in) :: group, name

      do find = 1, size(self%keys)
         if (self%keys(find)%group == group .and. self%keys(find)%name == name) return
      end do
      find = 0
   end function find

   !> Whether the input gave a key
   pure logical function given(self, group, name)
      class(schema_t), intent(in) :: self
      character(len=*), intent(in) :: group, name

      given = self%keys(self%find(group, name))%given
   end function given

   !> Names of all groups, in order
   pure function group_names(self) result(names)
      class(schema_t), intent(in) :: self
      character(len=name_length), allocatable :: names(:)
      integer :: k

      names = [self%keys(1)%group]
      do k = 2, size(self%keys)
         if (self%keys(k)%group /= names(size(names))) names = [names, self%keys(k)%group]
      end do
   end function group_names

   !> Names of the keys of a group, in order
   pure function names_of(self, group) result(names)
      class(schema_t), intent(in) :: self
      character(len=*), intent(in) :: group
      character(len=name_length), allocatable :: names(:)
      integer :: k

      names = pack(self%keys%name, [(self%keys(k)%group == group, k=1, size(self%keys))])
   end function names_of
end module ehl_schema

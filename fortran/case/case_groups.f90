! SPDX-License-Identifier: BSD-3-Clause
!> The namelist groups of a case: every key, read into its place and written from there by the intrinsic read and write
module ehl_case_groups
   use ehl_case, only: bodies_case_t, case_t, contact_case_t, grid_case_t, lubricant_case_t, output_case_t, path_length, &
                       psd_case_t, solver_case_t, surface_case_t, time_case_t, word_length
   use ehl_kinds, only: dp
   use ehl_namelist_pieces, only: name_length
   use ehl_text, only: lower_case, to_text
   implicit none (type, external)
   private
   public :: group_names, read_group, write_group

   character(len=name_length), parameter :: group_names(*) = [character(len=name_length) :: "contact", "bodies", "lubricant", &
      "grid", "surface", "second_surface", "time", "solver", "psd", "output"]
   !> Most keys of a group, and its beginning and end
   integer, parameter :: most_lines = 80

contains

   !> Read the text of a group, `&group ... /`; stat is not 0 where the runtime refuses it
   subroutine read_group(group, text, input, stat)
      character(len=*), intent(in) :: group, text
      type(case_t), intent(inout) :: input
      integer, intent(out) :: stat
      character(len=1) :: lines(0)

      call pass_group(group, input, text, lines, stat)
   end subroutine read_group

   !> Keys and values of a group, in order; '' is the value of a list
   subroutine write_group(group, input, keys, values)
      character(len=*), intent(in) :: group
      type(case_t), intent(inout) :: input
      character(len=name_length), allocatable, intent(out) :: keys(:)
      character(len=path_length + 2), allocatable, intent(out) :: values(:)
      character(len=path_length + name_length), allocatable :: lines(:)
      integer :: stat, k, equals

      allocate (lines(most_lines))
      lines = ""
      call pass_group(group, input, "", lines, stat)
      lines = pack(lines, index(lines, "=") > 0)
      allocate (keys(size(lines)), values(size(lines)))
      do k = 1, size(lines)
         equals = index(lines(k), "=")
         keys(k) = lower_case(adjustl(lines(k)(:equals - 1)))
         values(k) = plain(adjustl(lines(k)(equals + 1:)))
      end do
   end subroutine write_group

   !> A value as the intrinsic write gives it, in its shortest form
   function plain(written) result(text)
      character(len=*), intent(in) :: written
      character(len=:), allocatable :: text
      real(dp) :: number

      text = written(:len_trim(written) - 1)
      if (index(text, "'") == 1) then
         text = "'"//trim(text(2:len_trim(text) - 1))//"'"
      else if (text == "T" .or. text == "F") then
         text = to_text(text == "T")
      else if (index(text, ".") > 0) then
         read (text, *) number
         text = to_text(number)
      end if
   end function plain

   !> A group by its name: read where there is a text of it, else written
   subroutine pass_group(group, input, text, lines, stat)
      character(len=*), intent(in) :: group, text
      type(case_t), intent(inout) :: input
      character(len=*), intent(inout) :: lines(:)
      integer, intent(out) :: stat

      select case (group)
      case ("contact")
         call contact_group(input%contact, text, lines, stat)
      case ("bodies")
         call bodies_group(input%bodies, text, lines, stat)
      case ("lubricant")
         call lubricant_group(input%lubricant, text, lines, stat)
      case ("grid")
         call grid_group(input%grid, text, lines, stat)
      case ("surface")
         call surface_group(input%surface, text, lines, stat)
      case ("second_surface")
         call surface_group(input%second_surface, text, lines, stat)
      case ("time")
         call time_group(input%time, text, lines, stat)
      case ("solver")
         call solver_group(input%solver, text, lines, stat)
      case ("psd")
         call psd_group(input%psd, text, lines, stat)
      case default
         call output_group(input%output, text, lines, stat)
      end select
   end subroutine pass_group

   !> &contact
   subroutine contact_group(v, text, lines, stat)
      type(contact_case_t), intent(inout), target :: v
      character(len=*), intent(in) :: text
      character(len=*), intent(inout) :: lines(:)
      integer, intent(out) :: stat
      real(dp), pointer :: moes_m, moes_l, radius_ratio, load, mean_velocity, radius, radius_x, radius_y, reduced_modulus, &
         hardness, angle, slide_to_roll, thermal_conductivity, thermal_diffusivity, thermal_conductivity_2, &
         thermal_diffusivity_2
      integer, pointer :: rough_surface
      namelist /contact/ moes_m, moes_l, radius_ratio, load, mean_velocity, radius, radius_x, radius_y, reduced_modulus, &
         hardness, angle, slide_to_roll, rough_surface, thermal_conductivity, thermal_diffusivity, thermal_conductivity_2, &
         thermal_diffusivity_2

      moes_m => v%moes_m; moes_l => v%moes_l; radius_ratio => v%radius_ratio; load => v%load
      mean_velocity => v%mean_velocity; radius => v%radius; radius_x => v%radius_x; radius_y => v%radius_y
      reduced_modulus => v%reduced_modulus; hardness => v%hardness; angle => v%angle; slide_to_roll => v%slide_to_roll
      rough_surface => v%rough_surface; thermal_conductivity => v%thermal_conductivity
      thermal_diffusivity => v%thermal_diffusivity; thermal_conductivity_2 => v%thermal_conductivity_2
      thermal_diffusivity_2 => v%thermal_diffusivity_2
      if (len(text) == 0) then
         write (lines, nml=contact, iostat=stat, delim="apostrophe")
      else
         read (text, nml=contact, iostat=stat)
      end if
   end subroutine contact_group

   !> &bodies
   subroutine bodies_group(v, text, lines, stat)
      type(bodies_case_t), intent(inout), target :: v
      character(len=*), intent(in) :: text
      character(len=*), intent(inout) :: lines(:)
      integer, intent(out) :: stat
      real(dp), pointer :: radius_x1, radius_y1, radius_x2, radius_y2, modulus_1, modulus_2, poisson_1, poisson_2
      namelist /bodies/ radius_x1, radius_y1, radius_x2, radius_y2, modulus_1, modulus_2, poisson_1, poisson_2

      radius_x1 => v%radius_x1; radius_y1 => v%radius_y1; radius_x2 => v%radius_x2; radius_y2 => v%radius_y2
      modulus_1 => v%modulus_1; modulus_2 => v%modulus_2; poisson_1 => v%poisson_1; poisson_2 => v%poisson_2
      if (len(text) == 0) then
         write (lines, nml=bodies, iostat=stat, delim="apostrophe")
      else
         read (text, nml=bodies, iostat=stat)
      end if
   end subroutine bodies_group

   !> &lubricant
   subroutine lubricant_group(v, text, lines, stat)
      type(lubricant_case_t), intent(inout), target :: v
      character(len=*), intent(in) :: text
      character(len=*), intent(inout) :: lines(:)
      integer, intent(out) :: stat
      real(dp), pointer :: viscosity, pressure_viscosity, roelands_z, roelands_p0, vogel_viscosity, vogel_b, vogel_c, &
         dicke_a1, dicke_a2, dicke_b1, dicke_b2, yasutomi_tg0, yasutomi_a1, yasutomi_a2, yasutomi_b1, yasutomi_b2, &
         yasutomi_c1, yasutomi_c2, yasutomi_viscosity, doolittle_viscosity, doolittle_temperature, doolittle_b, doolittle_r0, &
         doolittle_expansion, murnaghan_modulus, murnaghan_rate, murnaghan_softening, tait_modulus, tait_rate, tait_softening, &
         tait_expansion, tait_temperature, range_temperature_min, range_temperature_max, range_pressure_max, eyring_stress, &
         limiting_stress, limiting_coefficient, carreau_stress, carreau_exponent, boundary_film, boundary_friction, &
         temperature, kinematic_viscosity_40, kinematic_viscosity_100, density_15, thermal_expansion, temperature_viscosity, &
         thermal_conductivity
      logical, pointer :: thermal_reduction
      character(len=word_length), pointer :: name, alpha_origin, viscosity_law, inlet_law, density_law, shear_law, &
         flow, thermal_friction
      character(len=path_length) :: table
      real(dp), allocatable, dimension(:) :: table_temperature, table_pressure, table_viscosity
      namelist /lubricant/ name, table, alpha_origin, viscosity, pressure_viscosity, viscosity_law, inlet_law, &
         roelands_z, roelands_p0, &
         vogel_viscosity, vogel_b, vogel_c, dicke_a1, dicke_a2, dicke_b1, dicke_b2, yasutomi_tg0, yasutomi_a1, yasutomi_a2, &
         yasutomi_b1, yasutomi_b2, yasutomi_c1, yasutomi_c2, yasutomi_viscosity, doolittle_viscosity, doolittle_temperature, &
         doolittle_b, doolittle_r0, doolittle_expansion, density_law, murnaghan_modulus, murnaghan_rate, murnaghan_softening, &
         tait_modulus, tait_rate, tait_softening, tait_expansion, tait_temperature, range_temperature_min, &
         range_temperature_max, range_pressure_max, shear_law, flow, eyring_stress, limiting_stress, limiting_coefficient, &
         carreau_stress, carreau_exponent, boundary_film, boundary_friction, temperature, kinematic_viscosity_40, &
         kinematic_viscosity_100, density_15, thermal_expansion, thermal_reduction, temperature_viscosity, &
         thermal_conductivity, thermal_friction, table_temperature, table_pressure, table_viscosity

      name => v%name; table = v%table%text(); alpha_origin => v%alpha_origin; viscosity => v%viscosity
      pressure_viscosity => v%pressure_viscosity; viscosity_law => v%viscosity_law; inlet_law => v%inlet_law
      roelands_z => v%roelands_z; roelands_p0 => v%roelands_p0; vogel_viscosity => v%vogel_viscosity
      vogel_b => v%vogel_b; vogel_c => v%vogel_c
      dicke_a1 => v%dicke_a1; dicke_a2 => v%dicke_a2; dicke_b1 => v%dicke_b1; dicke_b2 => v%dicke_b2
      yasutomi_tg0 => v%yasutomi_tg0; yasutomi_a1 => v%yasutomi_a1; yasutomi_a2 => v%yasutomi_a2
      yasutomi_b1 => v%yasutomi_b1; yasutomi_b2 => v%yasutomi_b2; yasutomi_c1 => v%yasutomi_c1; yasutomi_c2 => v%yasutomi_c2
      yasutomi_viscosity => v%yasutomi_viscosity; doolittle_viscosity => v%doolittle_viscosity
      doolittle_temperature => v%doolittle_temperature; doolittle_b => v%doolittle_b; doolittle_r0 => v%doolittle_r0
      doolittle_expansion => v%doolittle_expansion; density_law => v%density_law; murnaghan_modulus => v%murnaghan_modulus
      murnaghan_rate => v%murnaghan_rate; murnaghan_softening => v%murnaghan_softening; tait_modulus => v%tait_modulus
      tait_rate => v%tait_rate; tait_softening => v%tait_softening; tait_expansion => v%tait_expansion
      tait_temperature => v%tait_temperature; range_temperature_min => v%range_temperature_min
      range_temperature_max => v%range_temperature_max; range_pressure_max => v%range_pressure_max; shear_law => v%shear_law
      flow => v%flow; eyring_stress => v%eyring_stress; limiting_stress => v%limiting_stress
      limiting_coefficient => v%limiting_coefficient; carreau_stress => v%carreau_stress
      carreau_exponent => v%carreau_exponent; boundary_film => v%boundary_film; boundary_friction => v%boundary_friction
      temperature => v%temperature; kinematic_viscosity_40 => v%kinematic_viscosity_40
      kinematic_viscosity_100 => v%kinematic_viscosity_100; density_15 => v%density_15
      thermal_expansion => v%thermal_expansion; thermal_reduction => v%thermal_reduction
      temperature_viscosity => v%temperature_viscosity; thermal_conductivity => v%thermal_conductivity
      thermal_friction => v%thermal_friction
      ! as many numbers as a text of this length can hold
      associate (most => len(text)/2)
         allocate (table_temperature(most), table_pressure(most), table_viscosity(most), source=huge(1.0_dp))
      end associate
      if (len(text) == 0) then
         write (lines, nml=lubricant, iostat=stat, delim="apostrophe")
      else
         read (text, nml=lubricant, iostat=stat)
         v%table_temperature = pack(table_temperature, table_temperature < huge(1.0_dp))
         v%table_pressure = pack(table_pressure, table_pressure < huge(1.0_dp))
         v%table_viscosity = pack(table_viscosity, table_viscosity < huge(1.0_dp))
      end if
      call v%table%set(trim(table))
   end subroutine lubricant_group

   !> &grid
   subroutine grid_group(v, text, lines, stat)
      type(grid_case_t), intent(inout), target :: v
      character(len=*), intent(in) :: text
      character(len=*), intent(inout) :: lines(:)
      integer, intent(out) :: stat
      real(dp), pointer :: x_inlet, x_outlet, y_extent, target_error
      integer, pointer :: points, points_y, max_points
      character(len=word_length), pointer :: border
      namelist /grid/ points, points_y, x_inlet, x_outlet, y_extent, border, target_error, max_points

      points => v%points; points_y => v%points_y; x_inlet => v%x_inlet; x_outlet => v%x_outlet; y_extent => v%y_extent
      border => v%border; target_error => v%target_error; max_points => v%max_points
      if (len(text) == 0) then
         write (lines, nml=grid, iostat=stat, delim="apostrophe")
      else
         read (text, nml=grid, iostat=stat)
      end if
   end subroutine grid_group

   !> &surface or &second_surface, as &surface
   subroutine surface_group(v, text, lines, stat)
      type(surface_case_t), intent(inout), target :: v
      character(len=*), intent(in) :: text
      character(len=*), intent(inout) :: lines(:)
      integer, intent(out) :: stat
      real(dp), pointer :: amplitude, amplitude_over_film, wavelength, wavelength_x, wavelength_y, velocity_ratio, x_start, &
         height_m, width, length, width_m, length_m, angle, y_start, length_x, length_y, crop_x_min, crop_x_max, crop_y_min, &
         crop_y_max, outliers, rotate, track, tile_x, tile_y, shortest_wavelength, longest_wavelength, rms_height, ra, rq, &
         lay_ratio, hurst, rolloff_wavenumber
      integer, pointer :: sign, pixels, seed
      logical, pointer :: tile_mirrored
      character(len=word_length), pointer :: kind, height_unit, lateral_unit, profile, align_lines, fill, detrend, edges, &
         filter, finish, modulus
      character(len=path_length) :: file, channel
      namelist /surface/ kind, amplitude, amplitude_over_film, wavelength, wavelength_x, wavelength_y, velocity_ratio, &
         x_start, height_m, width, length, width_m, length_m, angle, y_start, file, channel, length_x, length_y, height_unit, &
         lateral_unit, profile, crop_x_min, crop_x_max, crop_y_min, crop_y_max, sign, outliers, align_lines, fill, detrend, &
         rotate, edges, track, tile_x, tile_y, tile_mirrored, shortest_wavelength, longest_wavelength, filter, rms_height, ra, &
         rq, finish, lay_ratio, hurst, rolloff_wavenumber, pixels, seed, modulus

      kind => v%kind; amplitude => v%amplitude; amplitude_over_film => v%amplitude_over_film; wavelength => v%wavelength
      wavelength_x => v%wavelength_x; wavelength_y => v%wavelength_y; velocity_ratio => v%velocity_ratio
      x_start => v%x_start; height_m => v%height_m; width => v%width; length => v%length; width_m => v%width_m
      length_m => v%length_m; angle => v%angle; y_start => v%y_start; file = v%file%text(); channel = v%channel%text()
      length_x => v%length_x; length_y => v%length_y; height_unit => v%height_unit; lateral_unit => v%lateral_unit
      profile => v%profile; crop_x_min => v%crop_x_min; crop_x_max => v%crop_x_max; crop_y_min => v%crop_y_min
      crop_y_max => v%crop_y_max; sign => v%sign; outliers => v%outliers; align_lines => v%align_lines; fill => v%fill
      detrend => v%detrend; rotate => v%rotate; edges => v%edges; track => v%track; tile_x => v%tile_x; tile_y => v%tile_y
      tile_mirrored => v%tile_mirrored; shortest_wavelength => v%shortest_wavelength
      longest_wavelength => v%longest_wavelength; filter => v%filter; rms_height => v%rms_height; ra => v%ra; rq => v%rq
      finish => v%finish; lay_ratio => v%lay_ratio; hurst => v%hurst; rolloff_wavenumber => v%rolloff_wavenumber
      pixels => v%pixels; seed => v%seed; modulus => v%modulus
      if (len(text) == 0) then
         write (lines, nml=surface, iostat=stat, delim="apostrophe")
      else
         read (text, nml=surface, iostat=stat)
      end if
      call v%file%set(trim(file))
      call v%channel%set(trim(channel))
   end subroutine surface_group

   !> &time
   subroutine time_group(v, text, lines, stat)
      type(time_case_t), intent(inout), target :: v
      character(len=*), intent(in) :: text
      character(len=*), intent(inout) :: lines(:)
      integer, intent(out) :: stat
      real(dp), pointer :: tolerance
      integer, pointer :: max_periods, steps
      logical, pointer :: skip_start, estimate_error
      character(len=word_length), pointer :: scheme, start
      namelist /time/ scheme, tolerance, max_periods, start, skip_start, estimate_error, steps

      scheme => v%scheme; tolerance => v%tolerance; max_periods => v%max_periods; start => v%start
      skip_start => v%skip_start; estimate_error => v%estimate_error; steps => v%steps
      if (len(text) == 0) then
         write (lines, nml=time, iostat=stat, delim="apostrophe")
      else
         read (text, nml=time, iostat=stat)
      end if
   end subroutine time_group

   !> &solver
   subroutine solver_group(v, text, lines, stat)
      type(solver_case_t), intent(inout), target :: v
      character(len=*), intent(in) :: text
      character(len=*), intent(inout) :: lines(:)
      integer, intent(out) :: stat
      real(dp), pointer :: accuracy
      integer, pointer :: max_cycles, threads
      character(len=word_length), pointer :: deflection, coarsening, symmetry, cycle
      namelist /solver/ deflection, coarsening, symmetry, cycle, accuracy, max_cycles, threads

      deflection => v%deflection; coarsening => v%coarsening; symmetry => v%symmetry; cycle => v%cycle
      accuracy => v%accuracy; max_cycles => v%max_cycles; threads => v%threads
      if (len(text) == 0) then
         write (lines, nml=solver, iostat=stat, delim="apostrophe")
      else
         read (text, nml=solver, iostat=stat)
      end if
   end subroutine solver_group

   !> &psd
   subroutine psd_group(v, text, lines, stat)
      type(psd_case_t), intent(inout), target :: v
      character(len=*), intent(in) :: text
      character(len=*), intent(inout) :: lines(:)
      integer, intent(out) :: stat
      real(dp), pointer :: film_thickness, film_limit
      integer, pointer :: positions
      logical, pointer :: load_balance
      character(len=word_length), pointer :: reduction, smooth, wavelength_convention, stiffness, viscosity_law
      namelist /psd/ reduction, smooth, film_thickness, film_limit, wavelength_convention, stiffness, viscosity_law, &
         load_balance, positions

      reduction => v%reduction; smooth => v%smooth; film_thickness => v%film_thickness; film_limit => v%film_limit
      wavelength_convention => v%wavelength_convention; stiffness => v%stiffness; viscosity_law => v%viscosity_law
      load_balance => v%load_balance; positions => v%positions
      if (len(text) == 0) then
         write (lines, nml=psd, iostat=stat, delim="apostrophe")
      else
         read (text, nml=psd, iostat=stat)
      end if
   end subroutine psd_group

   !> &output
   subroutine output_group(v, text, lines, stat)
      type(output_case_t), intent(inout), target :: v
      character(len=*), intent(in) :: text
      character(len=*), intent(inout) :: lines(:)
      integer, intent(out) :: stat
      real(dp), pointer :: frame_interval, checkpoint_interval
      logical, pointer :: fields
      namelist /output/ fields, frame_interval, checkpoint_interval

      fields => v%fields; frame_interval => v%frame_interval; checkpoint_interval => v%checkpoint_interval
      if (len(text) == 0) then
         write (lines, nml=output, iostat=stat, delim="apostrophe")
      else
         read (text, nml=output, iostat=stat)
      end if
   end subroutine output_group
end module ehl_case_groups

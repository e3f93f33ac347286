! SPDX-License-Identifier: BSD-3-Clause
!> The two largest namelist groups; see ehl_case_groups
module ehl_large_groups
   use ehl_case, only: lubricant_case_t, path_length, surface_case_t, word_length
   use ehl_kinds, only: dp
   implicit none (type, external)
   private
   public :: line_length, lubricant_group, surface_group

   !> Length of a written key with its value
   integer, parameter :: line_length = path_length + 64

contains

   !> Read &lubricant from a text, or write its lines if the text is empty
   subroutine lubricant_group(v, text, lines, accepted)
      type(lubricant_case_t), intent(inout), target :: v
      character(len=*), intent(in) :: text
      character(len=line_length), intent(inout) :: lines(:)
      logical, intent(out) :: accepted
      integer :: stat
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
      character(len=path_length), pointer :: table
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

      name => v%name; table => v%table; alpha_origin => v%alpha_origin; viscosity => v%viscosity
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
      ! maximum number of values in a text of this length
      associate (n => len(text)/2)
         allocate (table_temperature(n), table_pressure(n), table_viscosity(n), source=huge(1.0_dp))
      end associate
      if (len(text) == 0) then
         write (lines, nml=lubricant, iostat=stat, delim="apostrophe")
      else
         read (text, nml=lubricant, iostat=stat)
         v%table_temperature = pack(table_temperature, table_temperature < huge(1.0_dp))
         v%table_pressure = pack(table_pressure, table_pressure < huge(1.0_dp))
         v%table_viscosity = pack(table_viscosity, table_viscosity < huge(1.0_dp))
      end if
      accepted = stat == 0
   end subroutine lubricant_group

   !> Likewise &surface, or &second_surface with the name &surface
   subroutine surface_group(v, text, lines, accepted)
      type(surface_case_t), intent(inout), target :: v
      character(len=*), intent(in) :: text
      character(len=line_length), intent(inout) :: lines(:)
      logical, intent(out) :: accepted
      integer :: stat
      real(dp), pointer :: amplitude, amplitude_over_film, wavelength, wavelength_x, wavelength_y, velocity_ratio, x_start, &
         height_m, width, length, width_m, length_m, angle, y_start, spacing_y, length_x, length_y, crop_x_min, crop_x_max, &
         crop_y_min, crop_y_max, outliers, rotate, track, tile_x, tile_y, shortest_wavelength, longest_wavelength, &
         rms_height, ra, rq, lay_ratio, hurst, rolloff_wavenumber
      integer, pointer :: sign, pixels, seed
      logical, pointer :: tile_mirrored
      character(len=word_length), pointer :: kind, height_unit, lateral_unit, profile, align_lines, fill, detrend, edges, &
         filter, finish, modulus
      character(len=path_length), pointer :: file, channel
      namelist /surface/ kind, amplitude, amplitude_over_film, wavelength, wavelength_x, wavelength_y, velocity_ratio, &
         x_start, height_m, width, length, width_m, length_m, angle, y_start, spacing_y, file, channel, length_x, length_y, &
         height_unit, lateral_unit, profile, crop_x_min, crop_x_max, crop_y_min, crop_y_max, sign, outliers, align_lines, fill, &
         detrend, rotate, edges, track, tile_x, tile_y, tile_mirrored, shortest_wavelength, longest_wavelength, filter, &
         rms_height, ra, rq, finish, lay_ratio, hurst, rolloff_wavenumber, pixels, seed, modulus

      kind => v%kind; amplitude => v%amplitude; amplitude_over_film => v%amplitude_over_film; wavelength => v%wavelength
      wavelength_x => v%wavelength_x; wavelength_y => v%wavelength_y; velocity_ratio => v%velocity_ratio
      x_start => v%x_start; height_m => v%height_m; width => v%width; length => v%length; width_m => v%width_m
      length_m => v%length_m; angle => v%angle; y_start => v%y_start; spacing_y => v%spacing_y; file => v%file
      channel => v%channel; length_x => v%length_x; length_y => v%length_y; height_unit => v%height_unit
      lateral_unit => v%lateral_unit; profile => v%profile; crop_x_min => v%crop_x_min; crop_x_max => v%crop_x_max
      crop_y_min => v%crop_y_min; crop_y_max => v%crop_y_max; sign => v%sign; outliers => v%outliers; align_lines => v%align_lines
      fill => v%fill; detrend => v%detrend; rotate => v%rotate; edges => v%edges; track => v%track; tile_x => v%tile_x
      tile_y => v%tile_y; tile_mirrored => v%tile_mirrored; shortest_wavelength => v%shortest_wavelength
      longest_wavelength => v%longest_wavelength; filter => v%filter; rms_height => v%rms_height; ra => v%ra; rq => v%rq
      finish => v%finish; lay_ratio => v%lay_ratio; hurst => v%hurst; rolloff_wavenumber => v%rolloff_wavenumber
      pixels => v%pixels; seed => v%seed; modulus => v%modulus
      if (len(text) == 0) then
         write (lines, nml=surface, iostat=stat, delim="apostrophe")
      else
         read (text, nml=surface, iostat=stat)
      end if
      accepted = stat == 0
   end subroutine surface_group
end module ehl_large_groups

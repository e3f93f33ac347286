! SPDX-License-Identifier: BSD-3-Clause
!> The namelist groups of a case, read and written by the intrinsic namelist statements
module ehl_case_groups
   use ehl_case, only: bodies_case_t, case_t, contact_case_t, duty_case_t, grid_case_t, inlet_case_t, output_case_t, &
                       path_length, psd_case_t, &
                       solver_case_t, time_case_t, word_length
   use ehl_large_groups, only: line_length, lubricant_group, surface_group
   use ehl_kinds, only: dp
   use ehl_namelist_pieces, only: name_length
   use ehl_text, only: lower_case, to_text
   implicit none (type, external)
   private
   public :: group_names, read_group, write_group

   character(len=name_length), parameter :: group_names(*) = [character(len=name_length) :: "contact", "bodies", "lubricant", &
      "inlet", "grid", "surface", "second_surface", "time", "duty", "solver", "psd", "output"]
   !> Maximum number of lines of a group
   integer, parameter :: max_lines = 80

contains

   !> Read the text of a group, `&group ... /`; `accepted` is false if the runtime refuses it
   subroutine read_group(group, text, input, accepted)
      character(len=*), intent(in) :: group, text
      type(case_t), intent(inout) :: input
      logical, intent(out) :: accepted
      character(len=line_length) :: lines(0)

      call pass_group(group, input, text, lines, accepted)
   end subroutine read_group

   !> Keys and values of a group, in order; the value of a list is ''
   subroutine write_group(group, input, keys, values)
      character(len=*), intent(in) :: group
      type(case_t), intent(inout) :: input
      character(len=name_length), allocatable, intent(out) :: keys(:)
      character(len=path_length + 2), allocatable, intent(out) :: values(:)
      character(len=line_length), allocatable :: lines(:)
      logical :: accepted
      integer :: k, equals

      allocate (lines(max_lines))
      lines = ""
      call pass_group(group, input, "", lines, accepted)
      lines = pack(lines, index(lines, "=") > 0)
      allocate (keys(size(lines)), values(size(lines)))
      do k = 1, size(lines)
         equals = index(lines(k), "=")
         keys(k) = lower_case(adjustl(lines(k)(:equals - 1)))
         values(k) = plain(adjustl(lines(k)(equals + 1:)))
      end do
   end subroutine write_group

   !> Shortest form of a value from the intrinsic write
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

   !> Read a group if its text is not empty, otherwise write it
   subroutine pass_group(group, input, text, lines, accepted)
      character(len=*), intent(in) :: group, text
      type(case_t), intent(inout) :: input
      character(len=line_length), intent(inout) :: lines(:)
      logical, intent(out) :: accepted

      select case (group)
      case ("contact")
         call contact_group(input%contact, text, lines, accepted)
      case ("bodies")
         call bodies_group(input%bodies, text, lines, accepted)
      case ("lubricant")
         call lubricant_group(input%lubricant, text, lines, accepted)
      case ("inlet")
         call inlet_group(input%inlet, text, lines, accepted)
      case ("grid")
         call grid_group(input%grid, text, lines, accepted)
      case ("surface")
         call surface_group(input%surface, text, lines, accepted)
      case ("second_surface")
         call surface_group(input%second_surface, text, lines, accepted)
      case ("time")
         call time_group(input%time, text, lines, accepted)
      case ("duty")
         call duty_group(input%duty, text, lines, accepted)
      case ("solver")
         call solver_group(input%solver, text, lines, accepted)
      case ("psd")
         call psd_group(input%psd, text, lines, accepted)
      case default
         call output_group(input%output, text, lines, accepted)
      end select
   end subroutine pass_group

   !> &contact
   subroutine contact_group(v, text, lines, accepted)
      type(contact_case_t), intent(inout), target :: v
      character(len=*), intent(in) :: text
      character(len=line_length), intent(inout) :: lines(:)
      logical, intent(out) :: accepted
      integer :: stat
      character(len=word_length), pointer :: shape
      character(len=len(v%profiles%kind)), pointer :: profile, profile_2
      character(len=path_length), pointer :: profile_file, profile_file_2
      real(dp), allocatable, dimension(:) :: profile_y, profile_drop, profile_y_2, profile_drop_2
      real(dp), pointer :: moes_m, moes_l, moes_m_line, moes_l_line, radius_ratio, load, load_per_length, mean_velocity, radius, &
         radius_x, radius_y, reduced_modulus, &
         hardness, angle, slide_to_roll, thermal_conductivity, thermal_diffusivity, thermal_conductivity_2, &
         thermal_diffusivity_2, length, misalignment, crown_radius, log_amplitude, chamfer_length, chamfer_drop, crown_radius_2, &
         log_amplitude_2, chamfer_length_2, chamfer_drop_2
      integer, pointer :: rough_surface
      namelist /contact/ shape, moes_m, moes_l, moes_m_line, moes_l_line, radius_ratio, load, load_per_length, mean_velocity, &
         radius, radius_x, radius_y, reduced_modulus, &
         hardness, angle, slide_to_roll, rough_surface, thermal_conductivity, thermal_diffusivity, thermal_conductivity_2, &
         thermal_diffusivity_2, length, profile, crown_radius, log_amplitude, chamfer_length, chamfer_drop, profile_file, &
         misalignment, profile_2, crown_radius_2, log_amplitude_2, chamfer_length_2, chamfer_drop_2, profile_file_2, &
         profile_y, profile_drop, profile_y_2, profile_drop_2

      shape => v%shape; moes_m_line => v%moes_m_line; moes_l_line => v%moes_l_line; load_per_length => v%load_per_length
      moes_m => v%moes_m; moes_l => v%moes_l; radius_ratio => v%radius_ratio; load => v%load
      mean_velocity => v%mean_velocity; radius => v%radius; radius_x => v%radius_x; radius_y => v%radius_y
      reduced_modulus => v%reduced_modulus; hardness => v%hardness; angle => v%angle; slide_to_roll => v%slide_to_roll
      rough_surface => v%rough_surface; thermal_conductivity => v%thermal_conductivity
      thermal_diffusivity => v%thermal_diffusivity; thermal_conductivity_2 => v%thermal_conductivity_2
      thermal_diffusivity_2 => v%thermal_diffusivity_2
      length => v%length; misalignment => v%misalignment
      profile => v%profiles(1)%kind; profile_2 => v%profiles(2)%kind
      profile_file => v%profile_files(1); profile_file_2 => v%profile_files(2)
      crown_radius => v%profiles(1)%crown_radius; crown_radius_2 => v%profiles(2)%crown_radius
      log_amplitude => v%profiles(1)%log_amplitude; log_amplitude_2 => v%profiles(2)%log_amplitude
      chamfer_length => v%profiles(1)%chamfer_length; chamfer_length_2 => v%profiles(2)%chamfer_length
      chamfer_drop => v%profiles(1)%chamfer_drop; chamfer_drop_2 => v%profiles(2)%chamfer_drop
      ! maximum number of values in a text of this length
      allocate (profile_y(len(text)/2), profile_drop(len(text)/2), profile_y_2(len(text)/2), profile_drop_2(len(text)/2), &
                source=huge(1.0_dp))
      if (len(text) == 0) then
         write (lines, nml=contact, iostat=stat, delim="apostrophe")
      else
         read (text, nml=contact, iostat=stat)
         v%profiles(1)%y = pack(profile_y, profile_y < huge(1.0_dp))
         v%profiles(1)%table = pack(profile_drop, profile_drop < huge(1.0_dp))
         v%profiles(2)%y = pack(profile_y_2, profile_y_2 < huge(1.0_dp))
         v%profiles(2)%table = pack(profile_drop_2, profile_drop_2 < huge(1.0_dp))
      end if
      accepted = stat == 0
   end subroutine contact_group

   !> &bodies
   subroutine bodies_group(v, text, lines, accepted)
      type(bodies_case_t), intent(inout), target :: v
      character(len=*), intent(in) :: text
      character(len=line_length), intent(inout) :: lines(:)
      logical, intent(out) :: accepted
      integer :: stat
      real(dp), pointer :: radius_x1, radius_y1, radius_x2, radius_y2, modulus_1, modulus_2, poisson_1, poisson_2
      namelist /bodies/ radius_x1, radius_y1, radius_x2, radius_y2, modulus_1, modulus_2, poisson_1, poisson_2

      radius_x1 => v%radius_x1; radius_y1 => v%radius_y1; radius_x2 => v%radius_x2; radius_y2 => v%radius_y2
      modulus_1 => v%modulus_1; modulus_2 => v%modulus_2; poisson_1 => v%poisson_1; poisson_2 => v%poisson_2
      if (len(text) == 0) then
         write (lines, nml=bodies, iostat=stat, delim="apostrophe")
      else
         read (text, nml=bodies, iostat=stat)
      end if
      accepted = stat == 0
   end subroutine bodies_group

   !> &inlet
   subroutine inlet_group(v, text, lines, accepted)
      type(inlet_case_t), intent(inout), target :: v
      character(len=*), intent(in) :: text
      character(len=line_length), intent(inout) :: lines(:)
      logical, intent(out) :: accepted
      integer :: stat
      real(dp), pointer :: position, position_hertz, film, film_hertz, replenishment
      integer, pointer :: passages
      namelist /inlet/ position, position_hertz, film, film_hertz, passages, replenishment

      position => v%position; position_hertz => v%position_hertz; film => v%film; film_hertz => v%film_hertz
      passages => v%passages; replenishment => v%replenishment
      if (len(text) == 0) then
         write (lines, nml=inlet, iostat=stat, delim="apostrophe")
      else
         read (text, nml=inlet, iostat=stat)
      end if
      accepted = stat == 0
   end subroutine inlet_group

   !> &grid
   subroutine grid_group(v, text, lines, accepted)
      type(grid_case_t), intent(inout), target :: v
      character(len=*), intent(in) :: text
      character(len=line_length), intent(inout) :: lines(:)
      logical, intent(out) :: accepted
      integer :: stat
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
      accepted = stat == 0
   end subroutine grid_group

   !> &time
   subroutine time_group(v, text, lines, accepted)
      type(time_case_t), intent(inout), target :: v
      character(len=*), intent(in) :: text
      character(len=line_length), intent(inout) :: lines(:)
      logical, intent(out) :: accepted
      integer :: stat
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
      accepted = stat == 0
   end subroutine time_group

   !> &duty
   subroutine duty_group(v, text, lines, accepted)
      type(duty_case_t), intent(inout), target :: v
      character(len=*), intent(in) :: text
      character(len=line_length), intent(inout) :: lines(:)
      logical, intent(out) :: accepted
      integer :: stat
      real(dp), pointer :: time_step, target_error
      integer, pointer :: periods
      logical, pointer :: periodic
      character(len=word_length), pointer :: interpolation
      character(len=path_length), pointer :: file
      real(dp), allocatable, dimension(:) :: time, load, u1, u2, mean_velocity, slide_to_roll, radius_x, radius_y, viscosity, &
                                             inlet_film
      namelist /duty/ file, interpolation, periodic, periods, time_step, target_error, time, load, u1, u2, mean_velocity, &
         slide_to_roll, radius_x, radius_y, viscosity, inlet_film

      file => v%file; interpolation => v%interpolation; periodic => v%periodic; periods => v%periods
      time_step => v%time_step; target_error => v%target_error
      ! maximum number of values in a text of this length
      associate (n => len(text)/2)
         allocate (time(n), load(n), u1(n), u2(n), mean_velocity(n), slide_to_roll(n), radius_x(n), &
                   radius_y(n), viscosity(n), inlet_film(n), source=huge(1.0_dp))
      end associate
      if (len(text) == 0) then
         write (lines, nml=duty, iostat=stat, delim="apostrophe")
      else
         read (text, nml=duty, iostat=stat)
         v%time = pack(time, time < huge(1.0_dp))
         v%load = pack(load, load < huge(1.0_dp))
         v%u1 = pack(u1, u1 < huge(1.0_dp))
         v%u2 = pack(u2, u2 < huge(1.0_dp))
         v%mean_velocity = pack(mean_velocity, mean_velocity < huge(1.0_dp))
         v%slide_to_roll = pack(slide_to_roll, slide_to_roll < huge(1.0_dp))
         v%radius_x = pack(radius_x, radius_x < huge(1.0_dp))
         v%radius_y = pack(radius_y, radius_y < huge(1.0_dp))
         v%viscosity = pack(viscosity, viscosity < huge(1.0_dp))
         v%inlet_film = pack(inlet_film, inlet_film < huge(1.0_dp))
      end if
      accepted = stat == 0
   end subroutine duty_group

   !> &solver
   subroutine solver_group(v, text, lines, accepted)
      type(solver_case_t), intent(inout), target :: v
      character(len=*), intent(in) :: text
      character(len=line_length), intent(inout) :: lines(:)
      logical, intent(out) :: accepted
      integer :: stat
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
      accepted = stat == 0
   end subroutine solver_group

   !> &psd
   subroutine psd_group(v, text, lines, accepted)
      type(psd_case_t), intent(inout), target :: v
      character(len=*), intent(in) :: text
      character(len=line_length), intent(inout) :: lines(:)
      logical, intent(out) :: accepted
      integer :: stat
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
      accepted = stat == 0
   end subroutine psd_group

   !> &output
   subroutine output_group(v, text, lines, accepted)
      type(output_case_t), intent(inout), target :: v
      character(len=*), intent(in) :: text
      character(len=line_length), intent(inout) :: lines(:)
      logical, intent(out) :: accepted
      integer :: stat
      real(dp), pointer :: frame_interval, checkpoint_interval
      logical, pointer :: fields
      namelist /output/ fields, frame_interval, checkpoint_interval

      fields => v%fields; frame_interval => v%frame_interval; checkpoint_interval => v%checkpoint_interval
      if (len(text) == 0) then
         write (lines, nml=output, iostat=stat, delim="apostrophe")
      else
         read (text, nml=output, iostat=stat)
      end if
      accepted = stat == 0
   end subroutine output_group
end module ehl_case_groups

! SPDX-License-Identifier: BSD-3-Clause
!> Writer of a complete case as namelist text, and of the list of keys with their defaults
module ehl_write_case
   use ehl_case, only: case_t, path_length
   use ehl_case_defaults, only: is_starved
   use ehl_case_groups, only: group_names, write_group
   use ehl_case_ranges, only: range_of
   use ehl_case_source, only: case_source_t
   use ehl_kinds, only: dp
   use ehl_namelist_pieces, only: mark_default, mark_derived, name_length
   use ehl_text, only: newline, to_text
   implicit none (type, external)
   private
   public :: defaults_text, write_case

contains

   !> Write a complete case as namelist text. Of keys that exclude each other only the valid one is written; with a source, values
   !> that were not given are marked, including those derived by pyehl.
   subroutine write_case(input, text, source)
      type(case_t), intent(in) :: input
      character(len=:), allocatable, intent(out) :: text
      type(case_source_t), intent(in), optional :: source
      type(case_t) :: case, default_case
      character(len=name_length), allocatable :: keys(:)
      character(len=path_length + 2), allocatable :: values(:), defaults(:)
      character(len=:), allocatable :: line
      integer :: k, n, piece
      logical :: marked

      case = input
      text = ""
      do n = 1, size(group_names)
         call write_group(trim(group_names(n)), case, keys, values)
         call write_group(trim(group_names(n)), default_case, keys, defaults)
         if (group_names(n) == "bodies" .and. .not. input%bodies%given) cycle
         if (group_names(n) == "inlet" .and. .not. is_starved(input)) cycle
         if (group_names(n) == "duty" .and. .not. input%duty%active()) cycle
         text = text//"&"//trim(group_names(n))//newline
         do k = 1, size(keys)
            if (.not. applies(trim(group_names(n))//"."//trim(keys(k)), input)) cycle
            line = "   "//trim(keys(k))//" = "//trim(values(k))
            if (values(k) == "") then
               call list_text(keys(k), input, line)
               if (line == "") cycle
            end if
            if (present(source)) then
               piece = source%find(trim(group_names(n))//"."//trim(keys(k)))
               marked = piece == 0
               if (piece > 0) marked = source%pieces(piece)%marked
               if (marked) line = line//" "//merge(mark_default, mark_derived, values(k) == defaults(k) .and. values(k) /= "")
            end if
            text = text//line//newline
         end do
         text = text//"/"//newline
      end do
   end subroutine write_case

   !> Line of a key of the viscosity table, the profile or the duty; '' without numbers
   pure subroutine list_text(key, input, line)
      character(len=*), intent(in) :: key
      type(case_t), intent(in) :: input
      character(len=:), allocatable, intent(out) :: line
      real(dp), allocatable :: numbers(:)
      integer :: k

      line = ""
      if (index(key, "profile_") == 1) then
         associate (one => input%contact%profiles(merge(2, 1, index(key, "_2") > 0)))
            if (.not. (allocated(one%y) .and. allocated(one%table))) return
            numbers = one%y
            if (index(key, "drop") > 0) numbers = one%table
         end associate
      else if (index(key, "table_") == 0) then
         numbers = input%duty%list(trim(key))
      else
         if (.not. allocated(input%lubricant%table_viscosity)) return
         associate (l => input%lubricant)
            numbers = l%table_viscosity
            if (key == "table_temperature") numbers = l%table_temperature
            if (key == "table_pressure") numbers = l%table_pressure
         end associate
      end if
      if (size(numbers) == 0) return
      line = "   "//trim(key)//" = "//to_text(numbers(1))
      do k = 2, size(numbers)
         line = line//", "//to_text(numbers(k))
      end do
   end subroutine list_text

   !> Whether a key applies to the case
   pure logical function applies(name, input)
      character(len=*), intent(in) :: name
      type(case_t), intent(in) :: input

      applies = .true.
      associate (c => input%contact)
         select case (name)
         case ("contact.moes_m", "contact.moes_l", "contact.radius_ratio")
            applies = .not. (c%si .or. c%is_cylinder())
         case ("contact.moes_m_line", "contact.moes_l_line")
            applies = c%is_line() .and. .not. c%si
         case ("contact.load")
            applies = c%si .and. .not. c%is_line()
         case ("contact.load_per_length")
            applies = c%si .and. c%is_line()
         case ("contact.shape")
            applies = c%is_cylinder()
         case ("contact.angle")
            applies = .not. c%is_cylinder()
         case ("grid.points_y")
            applies = .not. c%is_line()
         case ("grid.y_extent")
            applies = .not. c%is_cylinder()
         case ("contact.length", "contact.profile", "contact.profile_2", "contact.misalignment")
            applies = c%is_roller()
         case ("contact.crown_radius", "contact.crown_radius_2")
            applies = c%is_roller() .and. of_body() == "crown"
         case ("contact.log_amplitude", "contact.log_amplitude_2")
            applies = c%is_roller() .and. of_body() == "logarithmic"
         case ("contact.chamfer_length", "contact.chamfer_drop", "contact.chamfer_length_2", "contact.chamfer_drop_2")
            applies = c%is_roller() .and. of_body() == "chamfer"
         case ("contact.profile_file", "contact.profile_y", "contact.profile_drop", "contact.profile_file_2", &
               "contact.profile_y_2", "contact.profile_drop_2")
            applies = c%is_roller() .and. of_body() == "file"
         case ("contact.mean_velocity", "contact.reduced_modulus")
            applies = c%si
         case ("contact.radius")
            applies = c%si .and. c%round
         case ("contact.radius_x", "contact.radius_y")
            applies = c%si .and. .not. c%round
         case ("surface.amplitude", "surface.amplitude_over_film")
            applies = input%surface%amplitude_given .eqv. index(name, "film") == 0
         case ("second_surface.amplitude", "second_surface.amplitude_over_film")
            applies = input%second_surface%amplitude_given .eqv. index(name, "film") == 0
         case default
            continue
         end select
      end associate

   contains

      !> Kind of profile of the body to which the key belongs
      pure function of_body() result(kind)
         character(len=len(input%contact%profiles%kind)) :: kind
         kind = input%contact%profiles(merge(2, 1, index(name, "_2") > 0))%kind
      end function of_body
   end function applies

   !> All keys with default and range, one per line, separated by tabs
   subroutine defaults_text(text)
      character(len=:), allocatable, intent(out) :: text
      type(case_t) :: default_case
      character(len=name_length), allocatable :: keys(:)
      character(len=path_length + 2), allocatable :: values(:)
      character(len=1), parameter :: tab = achar(9)
      integer :: k, n

      text = ""
      do n = 1, size(group_names)
         call write_group(trim(group_names(n)), default_case, keys, values)
         do k = 1, size(keys)
            text = text//trim(group_names(n))//"."//trim(keys(k))//tab//trim(values(k))//tab// &
                   range_of(trim(group_names(n)), trim(keys(k)))//newline
         end do
      end do
   end subroutine defaults_text
end module ehl_write_case

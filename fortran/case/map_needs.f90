! SPDX-License-Identifier: BSD-3-Clause
!> What a height map needs before the solver can read it by itself: pyehl reads files of instruments
!> and prepares maps
module ehl_map_needs
   use ehl_case, only: surface_case_t
   use ehl_kinds, only: dp
   implicit none (type, external)
   private
   public :: map_needs

   !> First characters of numbers, nan and inf among them, and separators
   character(len=*), parameter :: number_begins = "0123456789+-.nNiI,;"
   !> Lines of a text that may be its header
   integer, parameter :: header_lines = 100
   !> Labels of sizes and units in the header of a text that a program of an instrument has written, in each
   !> language of Gwyddion; its lines run along x, those of a text map along y
   character(len=*), parameter :: labels(*) = [character(len=40) :: &
      "width", "šířka", "Šířka", "breite", "anchura", "largeur", "larghezza", "幅", "폭", "largura", "Ширина", &
      "value units", "jednotky hodnot", "einheiten", "unités", "unità valore", "値の単位", "값 단위", &
      "unidades de valor", "Единицы измерения", "lateral units", "x-unit", "y-unit", "z-unit", "x-length", &
      "x-pixels", "pixel size", "file format", "unit x", "scale x"]
   !> The colon of Japanese exports
   character(len=*), parameter :: wide_colon = "："

contains

   !> Why pyehl has to prepare a map, for a message; empty when the solver can read it
   function map_needs(s) result(why)
      type(surface_case_t), intent(in) :: s
      character(len=:), allocatable :: why
      real(dp) :: moved

      why = ""
      if (s%kind /= "map") then
         if (abs(s%track) > 0.0_dp) why = "surface.track"
         return
      end if
      moved = abs(s%crop_x_min) + abs(s%crop_x_max) + abs(s%crop_y_min) + abs(s%crop_y_max)
      if (s%detrend /= "auto" .and. s%detrend /= "none") then
         why = "surface.detrend = '"//trim(s%detrend)//"'"
      else if (s%edges /= "auto" .and. s%edges /= "periodic") then
         why = "surface.edges = '"//trim(s%edges)//"'"
      else if (moved > 0.0_dp) then
         why = "surface.crop_x_min, crop_x_max, crop_y_min or crop_y_max"
      else if (s%outliers > 0.0_dp) then
         why = "surface.outliers"
      else if (abs(s%rotate) > 0.0_dp) then
         why = "surface.rotate"
      else if (s%sign /= 1) then
         why = "surface.sign"
      else if (abs(s%track) > 0.0_dp) then
         why = "surface.track"
      else if (.not. is_array(trim(s%file))) then
         why = "it is a file of an instrument"
      end if
   end function map_needs

   !> Whether a file is .npy or plain text, and not an instrument's
   logical function is_array(path)
      character(len=*), intent(in) :: path
      character(len=:), allocatable :: suffix
      integer :: dot

      dot = index(path, ".", back=.true.)
      suffix = ""
      if (dot > index(path, "/", back=.true.)) suffix = lower(path(dot:))
      select case (suffix)
      case (".npy")
         is_array = .true.
      case (".txt", ".csv", ".dat", ".asc", "")
         is_array = is_plain_text(path)
      case default
         is_array = .false.
      end select
   end function is_array

   !> Whether a file is text that begins with numbers, without the header of a program of an instrument. A
   !> file that cannot be opened counts as text: reading it tells why.
   logical function is_plain_text(path)
      character(len=*), intent(in) :: path
      character(len=256) :: line
      character(len=:), allocatable :: data
      integer :: lun, stat, k
      logical :: begun

      is_plain_text = .true.
      begun = .false.
      open (newunit=lun, file=path, status="old", action="read", iostat=stat)
      if (stat /= 0) return
      do k = 1, header_lines
         read (lun, "(a)", iostat=stat) line
         if (stat /= 0) exit
         data = trim(adjustl(line(:scan(line//"#", "#") - 1)))
         if (.not. begun .and. len(data) > 0) then
            begun = .true.
            is_plain_text = scan(data(1:1), number_begins//achar(9)//achar(13)) > 0
         end if
         if (scan(line, achar(0)//achar(1)//achar(2)//achar(3)) > 0 .or. names_size(lower(line))) then
            is_plain_text = .false.
            exit
         end if
      end do
      close (lun)
   end function is_plain_text

   !> Whether a line has one of the labels before ':' or '='
   pure logical function names_size(line)
      character(len=*), intent(in) :: line
      character(len=:), allocatable :: behind
      integer :: k, at

      names_size = index(line, "wyko ascii") == 1
      do k = 1, size(labels)
         at = index(line, trim(labels(k)))
         if (at == 0) cycle
         behind = trim(adjustl(line(at + len_trim(labels(k)):)))
         if (len(behind) == 0) cycle
         names_size = names_size .or. scan(behind(1:1), ":=") > 0 .or. index(behind, wide_colon) == 1
      end do
   end function names_size

   !> Small letters
   pure function lower(text) result(small)
      character(len=*), intent(in) :: text
      character(len=len(text)) :: small
      integer :: k, code

      small = text
      do k = 1, len(text)
         code = iachar(text(k:k))
         if (code >= iachar("A") .and. code <= iachar("Z")) small(k:k) = achar(code + 32)
      end do
   end function lower
end module ehl_map_needs

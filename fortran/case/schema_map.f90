! SPDX-License-Identifier: BSD-3-Clause
!> The keys of a height map
submodule (ehl_schema) ehl_schema_map
   implicit none (type, external)

contains

   module subroutine add_map_keys(self, group, s)
      class(schema_t), intent(inout) :: self
      character(len=*), intent(in) :: group
      type(surface_case_t), intent(inout), target :: s

      call self%texts(group, "channel", s%channel, kind_text, &
                      "channel of an instrument file: name, or number from 1")
      call self%reals(group, "length_x", s%length_x, "m", "0 or [1e-9, 1]", &
                      "size of the map along X; 0: that of the file; fractal: 8.29e-4")
      call self%reals(group, "length_y", s%length_y, "m", "0 or [1e-9, 1]", &
                      "size of the map along Y; 0: that of the file; fractal: 8.29e-4")
      call self%reals(group, "crop_x_min", s%crop_x_min, "m", "[0, 1]", "the map begins there along X")
      call self%reals(group, "crop_x_max", s%crop_x_max, "m", "[0, 1]", "the map ends there; 0: at its end")
      call self%reals(group, "crop_y_min", s%crop_y_min, "m", "[0, 1]", "the map begins there along Y")
      call self%reals(group, "crop_y_max", s%crop_y_max, "m", "[0, 1]", "the map ends there; 0: at its end")
      call self%integers(group, "sign", s%sign, "[-1, 1]", "-1: valleys of the map are positive")
      call self%reals(group, "outliers", s%outliers, "-", "0 or [3, 1e6]", &
                      "points so many standard deviations off are spikes and removed; 0: none")
      call self%words(group, "fill", s%fill, "harmonic|none", "missing points: interpolated, or refused")
      call self%words(group, "detrend", s%detrend, "auto|none|centre|tilt|curvature", &
                      "form taken off; auto: tilt for instrument files, none for arrays")
      call self%reals(group, "rotate", s%rotate, "deg", "[-360, 360]", "turn the map counter-clockwise")
      call self%words(group, "edges", s%edges, "auto|mirror|window|periodic", &
                      "auto: mirror for instrument files, periodic for arrays")
      call self%reals(group, "track", s%track, "m", "[-1, 1]", &
                      "line of a map or fractal surface that passes the centre, across the motion")
      call self%reals(group, "tile_x", s%tile_x, "m", "0 or [1e-9, 10]", &
                      "size of the tile that pyehl has made of the map; not for input")
      call self%reals(group, "tile_y", s%tile_y, "m", "0 or [1e-9, 10]", &
                      "size of the tile that pyehl has made of the map; not for input")
      call self%logicals(group, "tile_mirrored", s%tile_mirrored, "that tile has mirror images; not for input")
   end subroutine add_map_keys
end submodule ehl_schema_map

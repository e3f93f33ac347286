! SPDX-License-Identifier: BSD-3-Clause
!> The keys of a height map
submodule (ehl_schema) ehl_schema_map
   implicit none (type, external)

contains

   module subroutine add_map_keys(self, s)
      class(schema_t), intent(inout) :: self
      type(surface_case_t), intent(inout), target :: s

      call self%texts("surface", "channel", s%channel, kind_text, &
                      "channel of an instrument file: name, or number from 1")
      call self%reals("surface", "length_x", s%length_x, "m", "0 or [1e-9, 1]", &
                      "size of the map along X; 0: that of the file; fractal: 8.29e-4")
      call self%reals("surface", "length_y", s%length_y, "m", "0 or [1e-9, 1]", &
                      "size of the map along Y; 0: that of the file; fractal: 8.29e-4")
      call self%reals("surface", "crop_x_min", s%crop_x_min, "m", "[0, 1]", "the map begins there along X")
      call self%reals("surface", "crop_x_max", s%crop_x_max, "m", "[0, 1]", "the map ends there; 0: at its end")
      call self%reals("surface", "crop_y_min", s%crop_y_min, "m", "[0, 1]", "the map begins there along Y")
      call self%reals("surface", "crop_y_max", s%crop_y_max, "m", "[0, 1]", "the map ends there; 0: at its end")
      call self%integers("surface", "sign", s%sign, "[-1, 1]", "-1: valleys of the map are positive")
      call self%reals("surface", "outliers", s%outliers, "-", "0 or [3, 1e6]", &
                      "points so many standard deviations off are spikes and removed; 0: none")
      call self%words("surface", "fill", s%fill, "harmonic|none", "missing points: interpolated, or refused")
      call self%words("surface", "detrend", s%detrend, "auto|none|centre|tilt|curvature", &
                      "form taken off; auto: tilt for instrument files, none for arrays")
      call self%reals("surface", "rotate", s%rotate, "deg", "[-360, 360]", "turn the map counter-clockwise")
      call self%words("surface", "edges", s%edges, "auto|mirror|window|periodic", &
                      "auto: mirror for instrument files, periodic for arrays")
      call self%reals("surface", "track", s%track, "m", "[-1, 1]", &
                      "line of a map or fractal surface that passes the centre, across the motion")
      call self%reals("surface", "tile_x", s%tile_x, "m", "0 or [1e-9, 10]", &
                      "size of the tile that pyehl has made of the map; not for input")
      call self%reals("surface", "tile_y", s%tile_y, "m", "0 or [1e-9, 10]", &
                      "size of the tile that pyehl has made of the map; not for input")
      call self%logicals("surface", "tile_mirrored", s%tile_mirrored, "that tile has mirror images; not for input")
   end subroutine add_map_keys
end submodule ehl_schema_map

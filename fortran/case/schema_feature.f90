! SPDX-License-Identifier: BSD-3-Clause
!> The keys of a single feature
submodule (ehl_schema) ehl_schema_feature
   implicit none (type, external)

contains

   module subroutine add_feature_keys(self, group, s)
      class(schema_t), intent(inout) :: self
      character(len=*), intent(in) :: group
      type(surface_case_t), intent(inout), target :: s

      call self%reals(group, "height_m", s%height_m, "m", "0 or [1e-12, 1e-4]", &
                      "height or depth of a single feature; 0: amplitude or amplitude_over_film")
      call self%reals(group, "width", s%width, "a", "[0.01, 100]", &
                      "width of a single feature, across its line")
      call self%reals(group, "length", s%length, "a", "0 or [0.01, 100]", &
                      "its length; 0: that of a dent or bump its width, of a ridge or groove endless")
      call self%reals(group, "width_m", s%width_m, "m", "0 or [1e-9, 0.1]", &
                      "width of a single feature in metres; 0: width")
      call self%reals(group, "length_m", s%length_m, "m", "0 or [1e-9, 0.1]", &
                      "length of a single feature in metres; 0: length")
      call self%reals(group, "angle", s%angle, "deg", "[-360, 360]", &
                      "turn a single feature counter-clockwise; 0: it lies across the motion")
      call self%reals(group, "y_start", s%y_start, "a", "[-20, 20]", &
                      "position of a single feature across the motion")
   end subroutine add_feature_keys
end submodule ehl_schema_feature

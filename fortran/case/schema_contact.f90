! SPDX-License-Identifier: BSD-3-Clause
!> The keys of contact and lubricant
submodule (ehl_schema) ehl_schema_contact
   implicit none (type, external)

contains

   module subroutine add_contact_keys(self, input)
      class(schema_t), intent(inout) :: self
      type(case_t), intent(inout), target :: input

      associate (c => input%contact)
         call self%reals("contact", "moes_m", c%moes_m, "-", "(0, 1e5]", "Moes load parameter M")
         call self%reals("contact", "moes_l", c%moes_l, "-", "[0, 100]", "Moes material parameter L")
         call self%reals("contact", "radius_ratio", c%radius_ratio, "-", "[0.004, 250]", &
                         "R_x/R_y of an elliptical contact, whose M and L are by R_x; 1: round")
         call self%reals("contact", "load", c%load, "N", "(0, 1e5]", "load")
         call self%reals("contact", "mean_velocity", c%mean_velocity, "m/s", "(0, 200]", &
                         "mean velocity of the two surfaces")
         call self%reals("contact", "radius", c%radius, "m", "[1e-5, 10]", "reduced radius of a round contact")
         call self%reals("contact", "radius_x", c%radius_x, "m", "0 or [1e-5, 1000]", &
                         "reduced radius in the plane of the motion; 0: radius")
         call self%reals("contact", "radius_y", c%radius_y, "m", "0 or [1e-5, 1000]", &
                         "reduced radius across the motion; both or none")
         call self%reals("contact", "reduced_modulus", c%reduced_modulus, "Pa", "[1e8, 2e12]", &
                         "E' with 2/E' = sum of (1 - nu^2)/E over the bodies")
         call self%reals("contact", "angle", c%angle, "deg", "[-90, 90]", &
                         "an elliptical contact is turned counter-clockwise against the motion")
         call self%reals("contact", "slide_to_roll", c%slide_to_roll, "-", "[-2, 2]", &
                         "slide-to-roll ratio (u1 - u2)/u; follows from a given surface.velocity_ratio")
         call self%integers("contact", "rough_surface", c%rough_surface, "[1, 2]", "which surface is the rough one")
         call self%reals("contact", "thermal_conductivity", c%thermal_conductivity, "W/(m K)", "[0.1, 500]", &
                         "thermal conductivity of the solids, for the flash temperature")
         call self%reals("contact", "thermal_diffusivity", c%thermal_diffusivity, "m^2/s", "[1e-8, 1e-3]", &
                         "thermal diffusivity of the solids, for the flash temperature")
      end associate
      associate (b => input%bodies)
         call self%reals("bodies", "radius_x1", b%radius_x1, "m", "[-1e3, 1e3]", &
                         "radius of body 1 in the plane of the motion; negative: concave, 0: flat")
         call self%reals("bodies", "radius_y1", b%radius_y1, "m", "[-1e3, 1e3]", "radius of body 1 across the motion")
         call self%reals("bodies", "radius_x2", b%radius_x2, "m", "[-1e3, 1e3]", &
                         "radius of body 2 in the plane of the motion")
         call self%reals("bodies", "radius_y2", b%radius_y2, "m", "[-1e3, 1e3]", "radius of body 2 across the motion")
         call self%reals("bodies", "modulus_1", b%modulus_1, "Pa", "[1e5, 2e12]", "Young's modulus of body 1")
         call self%reals("bodies", "modulus_2", b%modulus_2, "Pa", "[1e5, 2e12]", "Young's modulus of body 2")
         call self%reals("bodies", "poisson_1", b%poisson_1, "-", "[-0.5, 0.5]", "Poisson's ratio of body 1")
         call self%reals("bodies", "poisson_2", b%poisson_2, "-", "[-0.5, 0.5]", "Poisson's ratio of body 2")
      end associate
   end subroutine add_contact_keys

   module subroutine add_lubricant_keys(self, input)
      class(schema_t), intent(inout) :: self
      type(case_t), intent(inout), target :: input

      associate (l => input%lubricant)
         call self%reals("lubricant", "viscosity", l%viscosity, "Pa s", "[1e-4, 10]", &
                         "viscosity at ambient pressure")
         call self%reals("lubricant", "pressure_viscosity", l%pressure_viscosity, "1/Pa", &
                         "[1e-10, 1e-7]", "pressure-viscosity coefficient")
         call self%words("lubricant", "viscosity_law", l%viscosity_law, "roelands|barus", &
                         "viscosity under pressure")
         call self%reals("lubricant", "roelands_z", l%roelands_z, "-", "[0.05, 2]", &
                         "Roelands exponent; default alpha p0/(ln eta0 + 9.67)")
         call self%reals("lubricant", "roelands_p0", l%roelands_p0, "Pa", "[1e7, 1e10]", &
                         "Roelands reference pressure")
         call self%words("lubricant", "density_law", l%density_law, &
                         "dowson-higginson|incompressible", "density under pressure")
         call self%words("lubricant", "shear_law", l%shear_law, "newtonian|eyring|limiting|carreau", &
                         "shear stress in the contact, for friction alone")
         call self%reals("lubricant", "eyring_stress", l%eyring_stress, "Pa", "[1e4, 1e9]", "Eyring stress")
         call self%reals("lubricant", "limiting_stress", l%limiting_stress, "Pa", "0 or [1e5, 1e10]", &
                         "limiting shear stress; 0: limiting_coefficient times pressure")
         call self%reals("lubricant", "limiting_coefficient", l%limiting_coefficient, "-", "[1e-4, 1]", &
                         "limiting shear stress over pressure")
         call self%reals("lubricant", "carreau_stress", l%carreau_stress, "Pa", "0 or [1e2, 1e10]", &
                         "stress G of Carreau at which thinning begins; no default")
         call self%reals("lubricant", "carreau_exponent", l%carreau_exponent, "-", "0 or [0.05, 1]", &
                         "power-law exponent n of Carreau; no default")
         call self%reals("lubricant", "temperature", l%temperature, "degC", "[-60, 250]", &
                         "temperature of the inlet; needs the kinematic viscosities")
         call self%reals("lubricant", "kinematic_viscosity_40", l%kinematic_viscosity_40, "mm^2/s", "0 or [1, 1e5]", &
                         "at 40 degC, as on data sheets; viscosity then follows. 0: not known")
         call self%reals("lubricant", "kinematic_viscosity_100", l%kinematic_viscosity_100, "mm^2/s", &
                         "0 or [0.5, 1e4]", "at 100 degC; both or none")
         call self%reals("lubricant", "density_15", l%density_15, "kg/m^3", "[500, 2000]", "density at 15 degC")
         call self%reals("lubricant", "thermal_expansion", l%thermal_expansion, "1/K", "[0, 2e-3]", &
                         "relative fall of the density with temperature")
         call self%logicals("lubricant", "thermal_reduction", l%thermal_reduction, &
                            "shear heating of the inlet thins the film (Gupta et al. 1992)")
         call self%reals("lubricant", "temperature_viscosity", l%temperature_viscosity, "1/K", "0 or [1e-3, 0.3]", &
                         "-(d eta/dT)/eta; default from the kinematic viscosities, 0: not known")
         call self%reals("lubricant", "thermal_conductivity", l%thermal_conductivity, "W/(m K)", "[0.01, 2]", &
                         "thermal conductivity of the oil, for thermal_reduction")
      end associate
   end subroutine add_lubricant_keys
end submodule ehl_schema_contact

! SPDX-License-Identifier: BSD-3-Clause
!> Keys of &lubricant with the constants of an oil: its laws of viscosity and density, and where they were measured
module ehl_law_keys
   use ehl_case, only: lubricant_case_t
   use ehl_schema, only: schema_t
   implicit none (type, external)
   private
   public :: add_law_keys

contains

   !> The keys, in the group that is set
   subroutine add_law_keys(self, l)
      type(schema_t), intent(inout) :: self
      type(lubricant_case_t), intent(inout), target :: l

      call self%reals("vogel_viscosity", l%vogel_viscosity, "Pa s", "0 or [1e-9, 1]", &
                      "K of eta = K exp(B/(theta + C)), for dicke")
      call self%reals("vogel_b", l%vogel_b, "K", "[0, 1e4]", "B of it")
      call self%reals("vogel_c", l%vogel_c, "degC", "[-100, 300]", "C of it")
      call self%reals("dicke_a1", l%dicke_a1, "Pa", "[-1e10, 1e10]", &
                      "a1 of ln(eta/eta0) = p/(a1 + a2 theta + (b1 + b2 theta) p), theta in degC")
      call self%reals("dicke_a2", l%dicke_a2, "Pa/K", "[-1e8, 1e8]", "a2 of it")
      call self%reals("dicke_b1", l%dicke_b1, "-", "[-1, 1]", "b1 of it")
      call self%reals("dicke_b2", l%dicke_b2, "1/K", "[-0.01, 0.01]", "b2 of it")
      call self%reals("yasutomi_tg0", l%yasutomi_tg0, "degC", "[-200, 100]", &
                      "glass temperature at ambient pressure, of the improved Yasutomi correlation")
      call self%reals("yasutomi_a1", l%yasutomi_a1, "K", "[0, 1e4]", "A1 of it")
      call self%reals("yasutomi_a2", l%yasutomi_a2, "1/Pa", "[0, 1e-7]", "A2 of it")
      call self%reals("yasutomi_b1", l%yasutomi_b1, "1/Pa", "[0, 1e-6]", "b1 of it")
      call self%reals("yasutomi_b2", l%yasutomi_b2, "-", "[-2, 0]", "b2 of it")
      call self%reals("yasutomi_c1", l%yasutomi_c1, "-", "0 or [1, 100]", "C1 of it")
      call self%reals("yasutomi_c2", l%yasutomi_c2, "K", "0 or [1, 500]", "C2 of it")
      call self%reals("yasutomi_viscosity", l%yasutomi_viscosity, "Pa s", "[1e3, 1e15]", "viscosity of the glass")
      call self%reals("doolittle_viscosity", l%doolittle_viscosity, "Pa s", "0 or [1e-6, 1e3]", &
                      "viscosity eta_R at doolittle_temperature and p = 0, of Doolittle's law; it needs tait_...")
      call self%reals("doolittle_temperature", l%doolittle_temperature, "degC", "[-100, 300]", "T_R of it")
      call self%reals("doolittle_b", l%doolittle_b, "-", "0 or [0.1, 50]", "B of it")
      call self%reals("doolittle_r0", l%doolittle_r0, "-", "0 or [0.1, 0.99]", &
                      "R0 of it: occupied volume at T_R over the whole one")
      call self%reals("doolittle_expansion", l%doolittle_expansion, "1/K", "[-0.01, 0.01]", &
                      "thermal expansion epsilon of the occupied volume")
      call self%words("density_law", l%density_law, "dowson-higginson|incompressible|murnaghan|tait", "density under pressure")
      call self%reals("murnaghan_modulus", l%murnaghan_modulus, "Pa", "0 or [1e8, 1e12]", &
                      "K00 of the bulk modulus K0 = K00 exp(-beta_K T), T in K")
      call self%reals("murnaghan_rate", l%murnaghan_rate, "-", "0 or [1, 50]", "K0', its rate with pressure")
      call self%reals("murnaghan_softening", l%murnaghan_softening, "1/K", "[0, 0.1]", "beta_K of it")
      call self%reals("tait_modulus", l%tait_modulus, "Pa", "0 or [1e8, 1e12]", &
                      "K00 of the bulk modulus K0 = K00 exp(-beta_K T), T in K, of Tait's law")
      call self%reals("tait_rate", l%tait_rate, "-", "0 or [1, 50]", "K0', its rate with pressure")
      call self%reals("tait_softening", l%tait_softening, "1/K", "[0, 0.1]", "fall beta_K of K0 with temperature")
      call self%reals("tait_expansion", l%tait_expansion, "1/K", "[0, 5e-3]", &
                      "expansion a_V of the volume at tait_temperature; thermal_expansion is not used")
      call self%reals("tait_temperature", l%tait_temperature, "degC", "[-100, 300]", "T_R of it")
      call self%reals("range_temperature_min", l%range_temperature_min, "degC", "[-100, 500]", &
                      "the constants of the law were measured from there on; both 0: not known")
      call self%reals("range_temperature_max", l%range_temperature_max, "degC", "[-100, 500]", "and up to there")
      call self%reals("range_pressure_max", l%range_pressure_max, "Pa", "0 or [1e5, 1e11]", &
                      "and up to this pressure; 0: not known")
   end subroutine add_law_keys
end module ehl_law_keys

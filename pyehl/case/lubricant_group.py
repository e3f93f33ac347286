# SPDX-License-Identifier: BSD-3-Clause
"""The group ``&lubricant`` of a case, key by key."""

from dataclasses import dataclass

from pyehl.case.key import numbers, path, real, truth, word
from pyehl.case.oils import OILS


@dataclass(slots=True)
class Lubricant:
    """``&lubricant``: viscosity and density under pressure, shear stress, temperature."""

    name: str = word(
        "",
        "fva3|n100|pao100|",
        "an oil with known constants ('pyehl lubricants'); keys given in addition take precedence",
    )
    table: str = path("measured viscosities over pressure and temperature: CSV")
    viscosity: float = real(0.04, "Pa s", "[1e-4, 10]", "viscosity at ambient pressure")
    pressure_viscosity: float = real(
        2.2e-8,
        "1/Pa",
        "0 or [1e-10, 1e-7]",
        "pressure-viscosity coefficient; 0: the viscosity does not change with pressure",
    )
    viscosity_law: str = word(
        "roelands",
        "roelands|barus|dicke|yasutomi|doolittle|table",
        "viscosity under pressure; default: the law of name or table",
    )
    roelands_z: float = real(
        0.0,
        "-",
        "[0, 1e4]",
        "Roelands exponent, 1e-3 to 2 with Roelands' law; default alpha p0/(ln eta0 + 9.67)",
    )
    roelands_p0: float = real(1.96e8, "Pa", "[1e7, 1e10]", "Roelands reference pressure")
    vogel_viscosity: float = real(
        0.0,
        "Pa s",
        "0 or [1e-9, 1]",
        "K of Vogel's law eta = K exp(B/(theta + C)), with Dicke's law",
    )
    vogel_b: float = real(0.0, "K", "[0, 1e4]", "B of Vogel's law")
    vogel_c: float = real(0.0, "degC", "[-100, 300]", "C of Vogel's law")
    dicke_a1: float = real(
        0.0,
        "Pa",
        "[-1e10, 1e10]",
        "a1 of ln(eta/eta0) = p/(a1 + a2 theta + (b1 + b2 theta) p), theta in degC",
    )
    dicke_a2: float = real(0.0, "Pa/K", "[-1e8, 1e8]", "a2 of Dicke's law")
    dicke_b1: float = real(0.0, "-", "[-1, 1]", "b1 of Dicke's law")
    dicke_b2: float = real(0.0, "1/K", "[-0.01, 0.01]", "b2 of Dicke's law")
    yasutomi_tg0: float = real(
        0.0,
        "degC",
        "[-200, 100]",
        "glass temperature at ambient pressure, of the improved Yasutomi correlation",
    )
    yasutomi_a1: float = real(0.0, "K", "[0, 1e4]", "A1 of Yasutomi's law")
    yasutomi_a2: float = real(0.0, "1/Pa", "[0, 1e-7]", "A2 of Yasutomi's law")
    yasutomi_b1: float = real(0.0, "1/Pa", "[0, 1e-6]", "b1 of Yasutomi's law")
    yasutomi_b2: float = real(0.0, "-", "[-2, 0]", "b2 of Yasutomi's law")
    yasutomi_c1: float = real(0.0, "-", "0 or [1, 100]", "C1 of Yasutomi's law")
    yasutomi_c2: float = real(0.0, "K", "0 or [1, 500]", "C2 of Yasutomi's law")
    yasutomi_viscosity: float = real(
        1e12, "Pa s", "[1e3, 1e15]", "viscosity at the glass temperature"
    )
    doolittle_viscosity: float = real(
        0.0,
        "Pa s",
        "0 or [1e-6, 1e3]",
        "viscosity eta_R at doolittle_temperature and p = 0; Doolittle's law needs tait_...",
    )
    doolittle_temperature: float = real(0.0, "degC", "[-100, 300]", "T_R of Doolittle's law")
    doolittle_b: float = real(0.0, "-", "0 or [0.1, 50]", "B of Doolittle's law")
    doolittle_r0: float = real(
        0.0, "-", "0 or [0.1, 0.99]", "R0 of Doolittle's law: occupied over total volume at T_R"
    )
    doolittle_expansion: float = real(
        0.0, "1/K", "[-0.01, 0.01]", "thermal expansion epsilon of the occupied volume"
    )
    density_law: str = word(
        "dowson-higginson",
        "dowson-higginson|incompressible|murnaghan|tait",
        "density under pressure; default tait with Doolittle's law",
    )
    murnaghan_modulus: float = real(
        0.0, "Pa", "0 or [1e8, 1e12]", "K00 of the bulk modulus K0 = K00 exp(-beta_K T), T in K"
    )
    murnaghan_rate: float = real(
        0.0, "-", "0 or [1, 50]", "K0', derivative of K0 with respect to pressure"
    )
    murnaghan_softening: float = real(0.0, "1/K", "[0, 0.1]", "beta_K of Murnaghan's law")
    tait_modulus: float = real(
        0.0,
        "Pa",
        "0 or [1e8, 1e12]",
        "K00 of the bulk modulus K0 = K00 exp(-beta_K T), T in K, of Tait's law",
    )
    tait_rate: float = real(
        0.0, "-", "0 or [1, 50]", "K0', derivative of K0 with respect to pressure"
    )
    tait_softening: float = real(0.0, "1/K", "[0, 0.1]", "decrease beta_K of K0 with temperature")
    tait_expansion: float = real(
        0.0,
        "1/K",
        "[0, 5e-3]",
        "expansion a_V of the volume at tait_temperature; thermal_expansion is not used",
    )
    tait_temperature: float = real(0.0, "degC", "[-100, 300]", "T_R of Tait's law")
    range_temperature_min: float = real(
        0.0,
        "degC",
        "[-100, 500]",
        "lowest temperature of the measurements of the constants; both 0: not known",
    )
    range_temperature_max: float = real(
        0.0, "degC", "[-100, 500]", "highest temperature of these measurements"
    )
    range_pressure_max: float = real(
        0.0, "Pa", "0 or [1e5, 1e11]", "highest pressure of these measurements; 0: not known"
    )
    shear_law: str = word(
        "newtonian", "newtonian|eyring|limiting|carreau", "shear stress in the contact"
    )
    flow: str = word(
        "consistent",
        "consistent|newtonian",
        "whether eyring and carreau apply to flow and friction, or to the friction only",
    )
    eyring_stress: float = real(5000000.0, "Pa", "[1e4, 1e9]", "Eyring stress")
    limiting_stress: float = real(
        0.0,
        "Pa",
        "0 or [1e5, 1e10]",
        "limiting shear stress; 0: limiting_coefficient times pressure",
    )
    limiting_coefficient: float = real(
        0.06, "-", "[1e-4, 1]", "limiting shear stress over pressure"
    )
    carreau_stress: float = real(
        0.0,
        "Pa",
        "0 or [1e2, 1e10]",
        "stress of Carreau's law at which thinning begins; no default",
    )
    carreau_exponent: float = real(
        0.0, "-", "0 or [0.05, 1]", "power-law exponent n of Carreau; no default"
    )
    boundary_film: float = real(
        0.0,
        "m",
        "0 or [1e-11, 1e-5]",
        "boundary film at ambient pressure; 0: none, and no solid contact",
    )
    boundary_friction: float = real(
        0.0,
        "-",
        "0 or [1e-3, 2]",
        "friction coefficient of solid contact at the boundary film; 0: not known",
    )
    temperature: float = real(
        40.0,
        "degC",
        "[-60, 250]",
        "temperature of the inlet; needs a viscosity that depends on temperature",
    )
    kinematic_viscosity_40: float = real(
        0.0,
        "mm^2/s",
        "0 or [1, 1e5]",
        "kinematic viscosity at 40 degC from the data sheet; viscosity follows. 0: not known",
    )
    kinematic_viscosity_100: float = real(
        0.0,
        "mm^2/s",
        "0 or [0.5, 1e4]",
        "kinematic viscosity at 100 degC; required with that at 40 degC",
    )
    density_15: float = real(870.0, "kg/m^3", "[500, 2000]", "density at 15 degC")
    thermal_expansion: float = real(
        0.00065, "1/K", "[0, 2e-3]", "relative decrease of the density with temperature"
    )
    thermal_reduction: bool = truth(
        False, "shear heating of the inlet reduces the film (Gupta et al. 1992)"
    )
    temperature_viscosity: float = real(
        0.0,
        "1/K",
        "0 or [1e-3, 0.3]",
        "-(d eta/dT)/eta; default from the kinematic viscosities or the law of the oil, 0: not "
        "known",
    )
    thermal_conductivity: float = real(
        0.14, "W/(m K)", "[0.01, 2]", "thermal conductivity of the oil, for frictional heating"
    )
    thermal_friction: str = word(
        "auto",
        "auto|always|never",
        "frictional heating in the coefficient of friction; auto: where it matters and "
        "temperature_viscosity is known",
    )
    alpha_origin: str = word(
        "given",
        "given|estimated|default",
        "source of pressure_viscosity; not for input",
    )
    inlet_law: str = word(
        "",
        "dicke|yasutomi|doolittle|table|",
        "law that gave viscosity and pressure_viscosity, if not viscosity_law; not for input",
    )
    table_temperature: tuple[float, ...] = numbers("degC", "content of table; not for input")
    table_pressure: tuple[float, ...] = numbers("Pa", "content of table; not for input")
    table_viscosity: tuple[float, ...] = numbers("Pa s", "content of table; not for input")

    @property
    def own_law(self) -> str:
        """Law of viscosity and alpha of the inlet: of the table, oil or key; '' for none."""
        if self.table or self.table_pressure:
            return "table"
        if self.name:
            return OILS[self.name].viscosity_law
        simple = self.viscosity_law in ("roelands", "barus")
        return self.inlet_law if simple else self.viscosity_law

    def uses_law(self, law: str) -> bool:
        """Whether a law gives the viscosity of the inlet, or how it increases with pressure."""
        return law in (self.own_law, self.viscosity_law)

    @property
    def knows_temperature(self) -> bool:
        """Whether a law of viscosity or density depends on temperature."""
        return self.own_law != "" or self.density_law in ("murnaghan", "tait")

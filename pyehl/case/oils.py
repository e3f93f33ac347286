# SPDX-License-Identifier: BSD-3-Clause
"""Oils by name: constants as their sources print them, in the units of the keys of &lubricant."""

from dataclasses import dataclass

# K that a constant for theta in K is shifted by
KELVIN = 273.15


@dataclass(frozen=True, slots=True)
class Constant:
    """A constant of an oil: key of ``&lubricant``, value in its unit, place in the source."""

    key: str
    value: float
    place: str


@dataclass(frozen=True, slots=True)
class OilConstants:
    """What is known of an oil: ``lubricant.name`` of a case."""

    name: str
    viscosity_law: str
    title: str
    source: str
    range: str  # of the measurements behind the constants, in words
    constants: tuple[Constant, ...]


WINGERTSZAHN = "Wingertszahn, Koch, Maccioni, Concli & Sauer 2023, Lubricants 11, 369"
ARANA = "Arana, Larranaga & Ulacia 2019, Proc. IMechE J 233, 303, after measurements of Mann 1995"
NO_RANGE = (
    "the source does not state the range of the measurements; it applies them at 42 and 50 degC"
)
MANN_RANGE = (
    "the source names states from 25 to 60 degC and up to 510 MPa, and does not give the whole "
    "range"
)
MANN_LIMITS = (
    Constant("range_temperature_min", 25.0, "states named in the text"),
    Constant("range_temperature_max", 60.0, "states named in the text"),
    Constant("range_pressure_max", 5.1e8, "states named in the text"),
)

OILS = {
    oil.name: oil
    for oil in (
        OilConstants(
            "fva3",
            "dicke",
            "FVA reference oil 3, mineral, ISO VG 100",
            WINGERTSZAHN,
            NO_RANGE,
            (
                Constant("vogel_viscosity", 0.062e-3, "Table A1, K"),
                Constant("vogel_b", 1021.7, "Table A1, B"),
                Constant("vogel_c", 101.5517, "Table A1, C"),
                Constant("dicke_a1", 327.7918e5, "Table A1"),
                Constant("dicke_a2", 2.9862e5, "Table A1"),
                Constant("dicke_b1", 4.419e-3, "Table A1"),
                Constant("dicke_b2", 3.0115e-4, "Table A1"),
                Constant("density_15", 887.6, "Table A1"),
                Constant("thermal_expansion", 6.0e-4 / 0.8876, "Table A1, 6e-4 g/(ml K)"),
                Constant("thermal_conductivity", 0.134, "Table A1"),
            ),
        ),
        OilConstants(
            "n100",
            "dicke",
            "N100 of Mann, naphthenic mineral base oil, ISO VG 100",
            ARANA,
            MANN_RANGE,
            (
                Constant("kinematic_viscosity_40", 97.9, "Table 2"),
                Constant("kinematic_viscosity_100", 8.61, "Table 2"),
                Constant("density_15", 900.0, "Table 2, at 15.6 degC"),
                Constant("dicke_a1", -7.23e7 + 3.48e5 * KELVIN, "Table 3, a1 + a2 273.15 K"),
                Constant("dicke_a2", 3.48e5, "Table 3"),
                Constant("dicke_b1", 5.00e-3 - 1.83e-5 * KELVIN, "Table 3, b1 + b2 273.15 K"),
                Constant("dicke_b2", -1.83e-5, "Table 3"),
                Constant("limiting_coefficient", 0.053, "Table 2, after Hoglund 1999"),
                *MANN_LIMITS,
            ),
        ),
        OilConstants(
            "pao100",
            "dicke",
            "PAO100 of Mann, polyalphaolefin base oil, ISO VG 100",
            ARANA,
            MANN_RANGE,
            (
                Constant("kinematic_viscosity_40", 94.1, "Table 2"),
                Constant("kinematic_viscosity_100", 14.0, "Table 2"),
                Constant("density_15", 840.0, "Table 2, at 15.6 degC"),
                Constant("dicke_a1", -5.73e7 + 3.90e5 * KELVIN, "Table 3, a1 + a2 273.15 K"),
                Constant("dicke_a2", 3.90e5, "Table 3"),
                Constant("dicke_b1", -39.5e-3 + 23.54e-5 * KELVIN, "Table 3, b1 + b2 273.15 K"),
                Constant("dicke_b2", 23.54e-5, "Table 3"),
                Constant("limiting_coefficient", 0.035, "Table 2, after Hoglund 1999"),
                *MANN_LIMITS,
            ),
        ),
    )
}

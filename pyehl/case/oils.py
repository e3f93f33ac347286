# SPDX-License-Identifier: BSD-3-Clause
"""Oils by name: constants as their sources print them, in the units of the keys of &lubricant.

A file of measured viscosities is comma-separated: a line of names, then a line for each state. The
names pressure_Pa, temperature_degC and viscosity_Pa_s are in any order among others. Lines that
are blank or begin with '#' are skipped.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import groupby, pairwise
from typing import NamedTuple, NoReturn

from pyehl.case.key import NUMBER, to_text
from pyehl.case.source import Source, read_text
from pyehl.errors import InputError

# Temperature of 0 degC [K], for constants with theta in K
KELVIN = 273.15


@dataclass(frozen=True, slots=True)
class Constant:
    """A constant of an oil: key of ``&lubricant``, value in its unit, place in the source."""

    key: str
    value: float
    place: str


@dataclass(frozen=True, slots=True)
class OilConstants:
    """Constants of an oil: ``lubricant.name`` of a case."""

    name: str
    viscosity_law: str
    title: str
    source: str
    range: str  # range of the measurements of the constants, as text
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

# Accepted range of each column
COLUMNS = {
    "pressure_Pa": (0.0, 1e11),
    "temperature_degC": (-100.0, 500.0),
    "viscosity_Pa_s": (1e-6, 1e15),
}
# Maximum pressure [Pa] that counts as ambient: it changes the viscosity by about 2 %
AMBIENT = 1e6
HEADER = "a line with the names pressure_Pa, temperature_degC and viscosity_Pa_s"


class State(NamedTuple):
    """A measured state, and the position of its line."""

    temperature: float
    pressure: float
    viscosity: float
    first: int
    end: int


def read_table(path: str) -> list[State]:
    """Read the states of a file by temperature, then pressure; an error names its line."""
    text = read_text(path, f"a file of measured viscosities, {HEADER}")
    source = Source(path, text.replace("\r", " ") + "\n")
    states = sorted(_states(source), key=lambda state: state[:2])
    if not states:
        raise InputError(
            f"{path}: error: no measured viscosity\nexpected: {HEADER}, and a line for each state "
            "after it"
        )
    for _, group in groupby(states, key=lambda state: state.temperature):
        _check(source, list(group))
    return states


def _states(source: Source) -> Iterator[State]:
    """Read all lines after the names."""
    places: list[int] = []
    first = 0
    for line in source.text.removesuffix("\n").split("\n"):
        end = first + len(line)
        if line.strip(" \t") and not line.lstrip(" ").startswith("#"):
            if places:
                p, temperature, viscosity = (
                    _value(source, first, line, place, column)
                    for place, column in zip(places, COLUMNS, strict=True)
                )
                yield State(temperature, p, viscosity, first, end)
            else:
                cells = [cell.strip(" ").lower() for cell in line.split(",")]
                for column in COLUMNS:
                    if column.lower() not in cells:
                        source.refuse(first, end, f"no column {column}", HEADER)
                    places.append(cells.index(column.lower()))
        first = end + 1


def _value(source: Source, first: int, line: str, place: int, column: str) -> float:
    """Read one number of a line."""
    cells = line.split(",")
    cell = cells[place].strip(" ") if place < len(cells) else ""
    low, high = COLUMNS[column]
    if NUMBER.fullmatch(cell):
        value = float(cell.lower().replace("d", "e"))
        if low <= value <= high:
            return value
    last = first + len(line) - 1
    start = min(last, first + sum(len(c) + 1 for c in cells[:place]))
    end = start + len(cells[place]) if place < len(cells) else start + 1
    expected = f"a number in [{to_text(low)}, {to_text(high)}]"
    source.refuse(start, max(end, start + 1), f"{column} = '{cell}'", expected)


def _check(source: Source, states: list[State]) -> None:
    """Refuse an isotherm without an ambient and a higher pressure, or that does not increase."""

    def refuse(state: State, what: str, expected: str) -> NoReturn:
        source.refuse(state.first, state.end, what, expected)

    first = states[0]
    temperature = f"{to_text(first.temperature)} degC"
    if len(states) == 1:
        what = f"a single pressure at {temperature}"
        refuse(first, what, "two pressures or more at each temperature")
    if first.pressure > AMBIENT:
        what = f"the lowest pressure at {temperature}"
        expected = (
            f"a viscosity at ambient pressure, {to_text(AMBIENT)} Pa or less, at each temperature"
        )
        refuse(first, what, expected)
    for before, state in pairwise(states):
        if state.pressure <= before.pressure:
            refuse(state, "the same state as before", "each pressure once at each temperature")
        if state.viscosity <= before.viscosity:
            what = (
                f"the viscosity does not increase from {to_text(before.pressure)} Pa, where it is "
                f"{to_text(before.viscosity)} Pa s"
            )
            refuse(state, what, "a viscosity that increases with pressure at each temperature")

# SPDX-License-Identifier: BSD-3-Clause
"""A file of measured viscosities: comma-separated, a line of names, then a line for each state.

The names pressure_Pa, temperature_degC and viscosity_Pa_s are in any order among others. Lines that
are blank or begin with '#' are skipped.
"""

from collections.abc import Iterator
from itertools import groupby, pairwise
from typing import NamedTuple, NoReturn

from pyehl.case.file import read_text
from pyehl.case.key import NUMBER
from pyehl.case.number import to_text
from pyehl.case.source import Source
from pyehl.errors import InputError

# What is accepted in each column
COLUMNS = {
    "pressure_Pa": (0.0, 1e11),
    "temperature_degC": (-100.0, 500.0),
    "viscosity_Pa_s": (1e-6, 1e15),
}
# Highest pressure [Pa] that is as good as none: it changes the viscosity by some 2 %
AMBIENT = 1e6
HEADER = "a line with the names pressure_Pa, temperature_degC and viscosity_Pa_s"


class State(NamedTuple):
    """A measured state, and the line that has it."""

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
            "behind it"
        )
    for _, group in groupby(states, key=lambda state: state.temperature):
        _check(source, list(group))
    return states


def _states(source: Source) -> Iterator[State]:
    """Read all lines behind the names."""
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
    """Refuse an isotherm without two pressures, the first ambient, or that does not rise."""

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
                f"the viscosity does not rise from {to_text(before.pressure)} Pa, where it is "
                f"{to_text(before.viscosity)} Pa s"
            )
            refuse(state, what, "a viscosity that rises with pressure at each temperature")

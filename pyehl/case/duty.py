# SPDX-License-Identifier: BSD-3-Clause
"""The duty of a contact, quantities over time from a file, and the domain that it needs.

A file is comma-separated: a line of names with units, then a line for each time. Lines that are
blank or begin with '#' are skipped.
"""

import math
import os
import re
from collections.abc import Iterator, Mapping, Sequence
from itertools import pairwise

from pyehl.case import physics
from pyehl.case.groups import DUTY_LISTS, Duty
from pyehl.case.key import to_text
from pyehl.case.names import did_you_mean
from pyehl.case.settings import GROUPS, Draft, Settings
from pyehl.case.source import Source, read_text
from pyehl.case.writer import group_text
from pyehl.errors import InputError

MIN_TIMES = 2
MIN_LOAD = 1e-3
"""Minimum load over that of the case."""
SAME = 1e-9
"""Relative difference below which the ends of a period, or of a domain, are equal."""
Table = dict[str, tuple[float, ...]]

SECONDS = {"s": 1.0, "ms": 1e-3, "us": 1e-6}
SPEEDS = {"m/s": 1.0, "mm/s": 1e-3}
METRES = {"m": 1.0, "mm": 1e-3, "um": 1e-6}
UNITS = {
    "time": SECONDS,
    "load": {"N": 1.0, "kN": 1e3, "N/m": 1.0, "N/mm": 1e3, "kN/m": 1e3},
    "u1": SPEEDS,
    "u2": SPEEDS,
    "mean_velocity": SPEEDS,
    "slide_to_roll": {"-": 1.0, "%": 1e-2},
    "radius_x": METRES,
    "radius_y": METRES,
    "viscosity": {"Pa s": 1.0, "mPa s": 1e-3},
    "inlet_film": METRES | {"nm": 1e-9},
    "temperature": {"degC": 1.0},
}
"""Units of each column, with factors to SI units."""
HEADER = (
    "a line of names with units, as 'time [s], load [N], mean_velocity [m/s]', of "
    f"{', '.join(UNITS)}"
)
NAME = re.compile(r"(\w+?)\s*(?:\[([^\]]*)\])?")


def complete(draft: Draft) -> None:
    """Read the values of a file, unless it is missing and the resolved case has them."""
    duty = draft.settings.duty
    if not duty.file:
        return
    duty.file = draft.absolute("duty.file", duty.file)
    if name := draft.first_given(f"duty.{key}" for key in DUTY_LISTS):
        if os.path.exists(duty.file):
            draft.contradict(name, "duty.file", "one of the two")
        return
    if not os.path.isfile(duty.file):
        draft.refuse("duty.file", f"there is no file {duty.file}", f"a table over time, {HEADER}")
    table = read_duty(duty.file, is_line=draft.settings.contact.is_line)
    if "temperature" in table:
        table["viscosity"] = _viscosities(draft, table)
    for key in DUTY_LISTS:
        if key in table:
            setattr(duty, key, table[key])


def _viscosities(draft: Draft, table: Table) -> tuple[float, ...]:
    """Viscosity at the inlet [Pa s] at the temperatures of a table, by the law of the oil."""
    oil = draft.settings.lubricant
    sheet = oil.kinematic_viscosity_40, oil.kinematic_viscosity_100
    if "viscosity" in table:
        draft.refuse("duty.file", "columns 'temperature' and 'viscosity'", "one of the two")
    if not (oil.own_law or all(sheet)):
        expected = "an oil by name, table or data sheet, or a column 'viscosity [Pa s]'"
        draft.refuse("duty.file", "a column 'temperature', and one viscosity of the oil", expected)
    result = []
    for at in table["temperature"]:
        if oil.own_law:
            text = group_text(
                draft.settings, "lubricant", {"viscosity_law": oil.own_law, "temperature": at}
            )
            viscosity = physics.inlet(text)[0]
        else:
            viscosity = physics.sheet(at, sheet, oil.density_15, oil.thermal_expansion)[0]
        if not math.isfinite(viscosity):
            expected = "temperatures at which the oil is liquid"
            draft.refuse("duty.file", f"no viscosity of the oil at {to_text(at)} degC", expected)
        result.append(viscosity)
    return tuple(result)


def check(draft: Draft) -> None:
    """Refuse a duty that cannot be solved."""
    duty = draft.settings.duty
    lists = {key: getattr(duty, key) for key in DUTY_LISTS if getattr(duty, key)}
    if lists:
        for key, what, expected in (*_times(draft, lists), *_values(draft, lists)):
            draft.refuse("duty.file" if duty.file else f"duty.{key}", what, expected)
        _check_beside(draft)
    elif name := draft.first_given(key.name for key in GROUPS["duty"] if key.kind != "path"):
        draft.refuse(name, f"{name} without a table", "duty.file, or values at duty.time")


def _times(draft: Draft, lists: Table) -> Iterator[tuple[str, str, str]]:
    """Yield the errors in the times: key, error, what was expected."""
    duty, contact = draft.settings.duty, draft.settings.contact
    for key, values in lists.items():
        if len(values) != len(duty.time):
            what = f"{len(values)} values of duty.{key} at {len(duty.time)} times"
            yield key, what, "a value at each of duty.time"
    if len(duty.time) < MIN_TIMES:
        yield "time", "a single time", "two or more"
    if late := [b for a, b in pairwise(duty.time) if b <= a]:
        what = f"times that do not increase to {to_text(late[0])} s"
        yield "time", what, "times that increase"
    if len(lists) == 1:
        yield "time", "times alone", f"one of {', '.join(DUTY_LISTS[1:])}"
    if not contact.si:
        expected = "contact.load, mean_velocity, radius and reduced_modulus: a duty is in SI units"
        yield "time", "a duty with a contact given by Moes numbers", expected
    if duty.periodic:
        for key, values in lists.items():
            if key != "time" and abs(values[-1] - values[0]) > SAME * max(map(abs, values)):
                what = f"{key} ends at {to_text(values[-1])} and begins at {to_text(values[0])}"
                yield key, what, "a period that ends where it begins, or periodic = .false."


def _values(draft: Draft, lists: Table) -> Iterator[tuple[str, str, str]]:
    """Yield the errors in the values: key, error, what was expected."""
    duty, contact = draft.settings.duty, draft.settings.contact
    if bool(duty.u1) != bool(duty.u2):
        expected = "both, or duty.mean_velocity and duty.slide_to_roll"
        yield "u1" if duty.u1 else "u2", "one of duty.u1 and duty.u2", expected
    if duty.u1 and (duty.mean_velocity or duty.slide_to_roll):
        what = "duty.u1 together with duty.mean_velocity or duty.slide_to_roll"
        yield "u1", what, "either u1 and u2, or mean_velocity and slide_to_roll"
    minimum = MIN_LOAD * (contact.load_per_length if contact.is_line else contact.load)
    if duty.load and min(duty.load) < minimum:
        expected = f"at least {to_text(minimum)}, {MIN_LOAD} of that of the case"
        yield "load", f"a load of {to_text(min(duty.load))}{_where(duty, duty.load)}", expected
    for key in ("radius_x", "radius_y", "viscosity", "inlet_film"):
        if min(lists.get(key, (1.0,))) <= 0.0:
            what = f"duty.{key} of {to_text(min(lists[key]))}{_where(duty, lists[key])}"
            yield key, what, "positive numbers"
    if duty.inlet_film:
        if not max(draft.settings.inlet.film, draft.settings.inlet.film_hertz) > 0.0:
            what = "duty.inlet_film without inlet.film"
            yield "inlet_film", what, "inlet.film, the layer of the case"
        boundary = draft.settings.lubricant.boundary_film
        if min(duty.inlet_film) < boundary:
            what = (
                f"duty.inlet_film of {to_text(min(duty.inlet_film))} m below the boundary film of "
                f"{to_text(boundary)} m{_where(duty, duty.inlet_film)}"
            )
            yield "inlet_film", what, "layers above lubricant.boundary_film"
    if contact.is_cylinder and duty.radius_y:
        yield "radius_y", f"duty.radius_y of a {contact.shape}", "duty.radius_x alone"
    if contact.angle != 0.0 and (duty.radius_x or duty.radius_y):
        key = "radius_x" if duty.radius_x else "radius_y"
        yield key, "radii that change in a rotated contact", "contact.angle = 0.0"


def _where(duty: Duty, values: Sequence[float]) -> str:
    """Locate the minimum of values: its time, and its line if there is a file."""
    row = min(range(len(values)), key=values.__getitem__)
    if row >= len(duty.time):
        return ""
    where = f" at {to_text(duty.time[row])} s"
    if os.path.isfile(duty.file):
        source = Source(duty.file, read_text(duty.file, HEADER).replace("\r", " ") + "\n")
        first = list(source.rows())[1 + row][0]
        where += f", line {source.line(first)} of {duty.file}"
    return where


def _check_beside(draft: Draft) -> None:
    """Refuse keys of other groups that contradict the duty."""
    grid = draft.settings.grid
    if draft.is_given("grid", "border") and grid.border == "flooded":
        expected = "'zero': the pressure at a flooded border contains no squeeze term"
        draft.refuse("grid.border", "grid.border = 'flooded' with a duty", expected)
    if grid.target_error > 0.0:
        expected = "grid.points; duty.target_error is that of the time steps"
        draft.refuse("grid.target_error", "grid.target_error with a duty", expected)
    if name := draft.first_given(key.name for key in GROUPS["time"]):
        expected = (
            "none of &time: the table sets the duration, duty.time_step and duty.target_error the "
            "time steps"
        )
        draft.refuse(name, f"{name} with a duty", expected)


def check_domain(draft: Draft) -> None:
    """Refuse a domain without an inlet on both sides if the motion reverses."""
    grid = draft.settings.grid
    if reverses(draft.settings) and abs(grid.x_inlet + grid.x_outlet) > SAME * grid.x_outlet:
        what = (
            f"a domain from {to_text(grid.x_inlet)} to {to_text(grid.x_outlet)} a, and the mean "
            "velocity changes sign"
        )
        name = "grid.x_outlet" if draft.is_given("grid", "x_outlet") else "grid.x_inlet"
        draft.refuse(name, what, "an inlet on both sides: x_outlet = -x_inlet")


def refuse_duty(settings: Mapping[str, object]) -> None:
    """Refuse a resolved case with a duty where a steady contact is required."""
    if settings.get("duty"):
        raise InputError(
            "duty.time: a steady contact is required here, and the case has a duty\n"
            "expected: a case without &duty, or 'pyehl run'"
        )


def widening(settings: Settings) -> tuple[float, float]:
    """Give the maximum half lengths of the dry contact along X and Y over those of the case."""
    duty, contact = settings.duty, settings.contact
    load = contact.load_per_length if contact.is_line else contact.load
    loads = duty.load or (load,) * len(duty.time)
    radii = duty.radius_x or (contact.radius_x,) * len(duty.time)
    if not duty.time or len(loads) != len(radii):
        return 1.0, 1.0
    if not duty.radius_y or contact.is_cylinder:
        largest = max(w * r for w, r in zip(loads, radii, strict=True)) / (load * contact.radius_x)
        both = float(max(1.0, largest) ** (1.0 / 2.0 if contact.is_cylinder else 1.0 / 3.0))
        return both, both
    if len(duty.radius_y) != len(loads) or not contact.si:
        return 1.0, 1.0
    if min(*loads, *radii, *duty.radius_y) <= 0.0:
        return 1.0, 1.0
    at_first = physics.half_lengths(settings, load, contact.radius_x, contact.radius_y)
    along, across = zip(
        *(
            physics.half_lengths(settings, *values)
            for values in zip(loads, radii, duty.radius_y, strict=True)
        ),
        strict=True,
    )
    return max(1.0, max(along) / at_first[0]), max(1.0, max(across) / at_first[1])


def reverses(settings: Settings) -> bool:
    """Whether the mean velocity is ever negative."""
    duty = settings.duty
    sums = [a + b for a, b in zip(duty.u1, duty.u2, strict=False)]
    return min([*duty.mean_velocity, *sums, 0.0]) < 0.0


def read_duty(path: str, *, is_line: bool) -> Table:
    """Read a file by columns, in SI units, temperatures in degC; an error names its line."""
    text = read_text(path, f"a table over time, {HEADER}")
    source = Source(path, text.replace("\r", " ") + "\n")
    lines = source.rows()
    columns: list[tuple[str, float]] = []
    values: list[list[float]] = []
    for first, line in lines:
        if not columns:
            columns = _header(source, first, line, is_line=is_line)
            values = [[] for _ in columns]
            continue
        cells = line.split(",")
        if len(cells) != len(columns):
            what = f"{len(cells)} cells under {len(columns)} names"
            source.refuse(first, first + len(line), what, "a number for each name")
        for (name, factor), cell, column in zip(columns, cells, values, strict=True):
            column.append(source.number(first, line, name, cell) * factor)
        if len(values[0]) > 1:
            _check_time(
                source, first, line, dict(zip((n for n, _ in columns), values, strict=True))
            )
    if not values or len(values[0]) < 2:
        source.refuse(0, 1, "fewer than two times", f"{HEADER}, then a line for each time")
    return {name: tuple(column) for (name, _), column in zip(columns, values, strict=True)}


def _check_time(source: Source, first: int, line: str, values: dict[str, list[float]]) -> None:
    before, now = values["time"][-2:]
    if now <= before:
        what = f"time {now!r} s after {before!r} s"
        source.refuse(first, first + len(line), what, "times that increase")


def _header(source: Source, first: int, line: str, *, is_line: bool) -> list[tuple[str, float]]:
    """Names of the columns, and factors to SI units."""
    columns: list[tuple[str, float]] = []

    def refuse(what: str, expected: str) -> None:
        source.refuse(first, first + len(line), what, expected)

    for cell in line.split(","):
        name, unit = cell.strip(), ""
        if match := NAME.fullmatch(name):
            name, unit = match[1], (match[2] or "").strip()
        if name not in UNITS:
            # as 'time_s', 'u1_m_per_s'
            name, unit = _split(name)
        if name not in UNITS:
            hint = did_you_mean(name, UNITS)
            refuse(f"unknown column '{cell.strip()}'", f"one of {', '.join(UNITS)}{hint}")
        units = UNITS[name]
        if name == "load":
            units = {u: f for u, f in units.items() if ("/" in u) == is_line}
        if not unit and "-" in units:
            unit = "-"
        if unit not in units:
            what = (
                f"column '{cell.strip()}' without a unit"
                if not unit
                else f"unit '{unit}' of {name}"
            )
            refuse(what, f"'{name} [unit]' with one of {', '.join(units)}")
        if name in (known for known, _ in columns):
            refuse(f"two columns '{name}'", "every column once")
        columns.append((name, units[unit]))
    if "time" not in (name for name, _ in columns):
        refuse("no column 'time'", HEADER)
    return columns


def _split(cell: str) -> tuple[str, str]:
    """Name and unit of a cell as 'load_kN'."""
    for name, units in UNITS.items():
        for unit in units:
            if cell == f"{name}_{unit.replace('/', '_per_').replace(' ', '_')}":
                return name, unit
    return cell, ""

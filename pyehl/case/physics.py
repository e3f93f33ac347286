# SPDX-License-Identifier: BSD-3-Clause
"""Functions of the solver that complete a case."""

import math
from collections.abc import Sequence
from dataclasses import replace
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from pyehl.case.settings import KEYS, Settings
from pyehl.errors import check
from pyehl.extension import cases, lubricants
from pyehl.types import Array

BORDERS = ("", "zero", "flooded")
"""In the order of their numbers in the extension; '' is to be derived."""
PROFILES = KEYS["contact.profile"].choices
Contact = tuple[float | tuple[float, ...], ...]


class Point(NamedTuple):
    """Hertz pressure [Pa] and radius [m], Moes numbers, half lengths of the contact [a]."""

    pressure: float
    length: float
    moes_m: float
    moes_l: float
    round_m: float
    reach_x: float
    reach_y: float


class Domain(NamedTuple):
    """Border, ends of the domain [a], nodes along X and Y."""

    border: str
    x_inlet: float
    x_outlet: float
    y_extent: float
    points: int
    points_y: int


def _contact(settings: Settings) -> Contact:
    """Give the arguments of the extension that define the contact."""
    c, oil = settings.contact, settings.lubricant
    load, moes_m, moes_l = c.load, c.moes_m, c.moes_l
    if c.is_line:
        load, moes_m, moes_l = c.load_per_length, c.moes_m_line, c.moes_l_line
    roller: tuple[float, ...] = (0.0,)
    if c.is_roller:
        roller = (c.length, c.misalignment)
        for kind, *numbers, places, drops in (c.of_body(1), c.of_body(2)):
            size = float(len(places))
            roller = (*roller, 1.0 + PROFILES.index(kind), *numbers, size, *places, *drops)
    return (
        *(2 if c.is_roller else int(c.is_line), roller, c.si, c.radius_ratio, c.angle),
        *(load, c.mean_velocity, c.radius_x),
        *(c.reduced_modulus, oil.viscosity, oil.pressure_viscosity, moes_m, moes_l),
    )


def point(settings: Settings) -> Point:
    """Operating point of a case, without shear heating of the inlet."""
    return _point(_contact(settings))


@lru_cache(maxsize=256)
def _point(values: Contact) -> Point:
    *numbers, reach, _ = cases.operating(*values)
    return Point(*numbers, *reach.tolist())


def half_lengths(
    settings: Settings, load: float, radius_x: float, radius_y: float
) -> tuple[float, float]:
    """Half lengths of the dry contact along X and Y [m] at another load and other radii."""
    other = replace(
        settings.contact, load=load, radius_x=radius_x, radius_ratio=radius_x / radius_y
    )
    result = point(replace(settings, contact=other))
    return result.length * result.reach_x, result.length * result.reach_y


def grid_defaults(
    settings: Settings,
    border: str,
    ends: Sequence[float | None],
    points: int,
    points_y: int,
    widening: tuple[float, float] = (1.0, 1.0),
    reverses: bool = False,
) -> Domain:
    """Border, domain and nodes that a contact needs; '', None and 0 are to be derived.

    A duty enlarges the contact up to `widening` times along X and Y; if the motion `reverses`, the
    domain is symmetric.

    Smooth surfaces have twice as many nodes along X if the film would otherwise be inaccurate. A
    wide contact that is steady and flooded, without a boundary film, has a shorter domain and fewer
    nodes if the film remains accurate.
    """
    smooth = settings.surface.kind == settings.second_surface.kind == "smooth"
    oil = settings.lubricant
    thins = oil.shear_law != "newtonian" and oil.flow == "consistent"
    kind = smooth, thins
    starved = settings.inlet.is_starved
    may_reduce = not (settings.duty.time or starved or oil.boundary_film > 0.0)
    moving = widening, reverses, may_reduce
    return _grid(_contact(settings), border, tuple(ends), points, points_y, kind, moving)


@lru_cache(maxsize=256)
def _grid(
    values: Contact,
    border: str,
    ends: tuple[float | None, ...],
    points: int,
    points_y: int,
    kind: tuple[bool, bool],
    moving: tuple[tuple[float, float], bool, bool],
) -> Domain:
    given = [math.nan if end is None else end for end in ends]
    number = BORDERS.index(border)
    result, domain, nx, ny = cases.grid_defaults(
        *values, number, *kind, given, points, points_y, *moving
    )
    x_inlet, x_outlet, y_extent = domain.tolist()
    return Domain(BORDERS[result], x_inlet, x_outlet, y_extent, nx, ny)


def sheet(
    temperature: float, viscosities: Sequence[float], density: float, expansion: float
) -> tuple[float, float]:
    """Viscosity [Pa s] and -(d eta/dT)/eta [1/K] of an oil by its data sheet."""
    viscosity, slope = cases.sheet(temperature, viscosities, density, expansion)
    return viscosity, slope


def inlet(group: str) -> tuple[float, float, float]:
    """Viscosity [Pa s], alpha [1/Pa] and -(d eta/dT)/eta [1/K] by the law of a lubricant.

    `group` is ``&lubricant``. The viscosity is not finite if the law has none.
    """
    viscosity, alpha, slope, status, _, message = cases.inlet(group.encode())
    check(status, message)
    return viscosity, alpha, slope


def under_pressure(group: str, pressure: Array) -> tuple[Array, Array]:
    """ln(eta/eta0) and rho/rho0 of a lubricant at pressures [Pa]."""
    viscosity, density = np.empty(pressure.size), np.empty(pressure.size)
    check(
        *lubricants.properties(
            group.encode(), pressure, np.zeros(pressure.size), viscosity, density
        )
    )
    return viscosity, density

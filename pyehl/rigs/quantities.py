# SPDX-License-Identifier: BSD-3-Clause
"""Quantities in the columns of a rig file: their names and units."""

from __future__ import annotations

import re
from dataclasses import dataclass

import numpy as np

from pyehl.types import Array

ZERO_CELSIUS = 273.15


@dataclass(frozen=True, slots=True)
class Quantity:
    """A measured quantity: its name in tables of results, its unit, its names in rig files."""

    name: str
    unit: str
    known_as: tuple[str, ...]


SPEED = Quantity(
    "contact.mean_velocity",
    "m/s",
    ("rolling speed", "entrainment speed", "entrainment velocity", "mean speed", "mean velocity",
     "speed", "u"),
)  # fmt: skip
SLIP = Quantity(
    "contact.slide_to_roll",
    "-",
    ("srr", "slide roll ratio", "slide to roll ratio", "slip"),
)
LOAD = Quantity("contact.load", "N", ("ball load", "load", "normal load"))
TEMPERATURE = Quantity(
    "lubricant.temperature",
    "degC",
    ("lube temp", "lube rtd temp", "lubricant temperature", "oil temperature", "temperature"),
)
FILM = Quantity(
    "h_c_m",
    "m",
    ("average film", "central film", "film thickness", "central film thickness", "film"),
)
MINIMUM_FILM = Quantity("h_min_m", "m", ("minimum film", "minimum film thickness"))
FRICTION = Quantity(
    "mu",
    "-",
    ("traction coeff", "traction coefficient", "friction coefficient", "coefficient of friction",
     "cof", "mu"),
)  # fmt: skip
FILM_ERROR = Quantity("h_c_error_m", "m", ("standard deviation", "film error"))
ERROR = Quantity("error", "-", ("error", "mu error", "friction error"))
CONDITIONS = (SPEED, SLIP, LOAD, TEMPERATURE)
MEASURED = (FILM, MINIMUM_FILM, FRICTION)
ERRORS = {FILM: FILM_ERROR, FRICTION: ERROR}
QUANTITIES = (*CONDITIONS, *MEASURED, FILM_ERROR, ERROR)

# Factor to the unit of a quantity, by that unit
FACTORS = {
    "m/s": {"m/s": 1.0, "mm/s": 1e-3, "cm/s": 1e-2},
    "N": {"N": 1.0, "mN": 1e-3, "kN": 1e3},
    "m": {"m": 1.0, "mm": 1e-3, "um": 1e-6, "nm": 1e-9},
    "-": {"-": 1.0, "": 1.0, "%": 1e-2},
    "degC": {"degC": 1.0, "C": 1.0, "K": 1.0},
}


def label_of(cell: str) -> tuple[str, str]:
    """Split a column name into words and the unit in brackets: 'srr', '%'."""
    match = re.fullmatch(r"\s*(.*?)\s*[(\[]\s*([^()\[\]]*?)\s*[)\]]\s*", cell)
    words, unit = (match[1], match[2]) if match else (cell, "")
    words = re.sub(r"[\s_\-–]+", " ", words).strip().casefold()
    return words, unit.replace("µ", "u").replace("μ", "u").replace("°", "deg").strip()


def quantity_of(cell: str) -> Quantity | None:
    """Return the quantity of a column name; None if it is unknown."""
    words, _ = label_of(cell)
    for quantity in QUANTITIES:
        # names of tables of results have no brackets and imply SI units
        if cell.strip() == quantity.name or words in quantity.known_as:
            return quantity
    return None


def in_si(quantity: Quantity, cell: str, values: Array) -> Array:
    """Convert values of a column to the unit of its quantity.

    ValueError with the known units for an unknown one.
    """
    unit = quantity.unit if cell.strip() == quantity.name else label_of(cell)[1]
    factors = FACTORS[quantity.unit]
    if unit not in factors:
        known = ", ".join(name for name in factors if name)
        raise ValueError(f"expected: a unit in brackets after the name, one of {known}")
    return np.asarray(values * factors[unit] - (ZERO_CELSIUS if unit == "K" else 0.0))

# SPDX-License-Identifier: BSD-3-Clause
"""The pairs of rough surfaces of cases.csv and their operating points."""

from __future__ import annotations

import csv
from pathlib import Path
from typing import Any

import numpy as np

import pyehl
from pyehl.surfaces import Topography, filtered, fractal
from pyehl.theory.operating import OperatingPoint

HERE = Path(__file__).resolve().parent
TEXTS = ("name", "first", "second")
GROUPS = {"first": "surface", "second": "second_surface"}


def rows() -> list[dict[str, Any]]:
    """Read the rows of cases.csv; numbers as numbers."""
    lines = [x for x in (HERE / "cases.csv").read_text().splitlines() if not x.startswith("#")]
    return [
        {key: value if key in TEXTS else float(value) for key, value in row.items()}
        for row in csv.DictReader(lines)
    ]


def case(row: dict[str, Any], points: int = 513) -> pyehl.Case:
    """Make the case of a row; surfaces in memory stand in for fractals and maps."""
    contact = pyehl.Case.from_text(
        f"""&contact
   load = {row["load"]!r}
   mean_velocity = {row["mean_velocity"]!r}
   slide_to_roll = {row["slide_to_roll"]!r}
/
&grid
   points = {points}
   x_inlet = -2.5  x_outlet = 1.5  y_extent = 2.0
/
"""
    )
    a = OperatingPoint.from_settings(contact.resolve()).hertz_radius
    keys = {}
    for side, group in GROUPS.items():
        length = length_over_a(row, side)
        if row[side] == "wave":
            keys |= {
                f"{group}.kind": "harmonic",
                f"{group}.wavelength": length,
                f"{group}.amplitude": row[f"{side}_height"],
            }
        else:
            keys |= {
                f"{group}.kind": "fractal",
                f"{group}.pixels": int(row[f"{side}_pixels"]),
                f"{group}.length_x": length * a,
                f"{group}.length_y": length * a,
            }
    return contact.with_options(keys)


def length_over_a(row: dict[str, Any], side: str) -> float:
    """Length of a tile [a]: a whole number of each passes in the common period."""
    slip = 0.5 * row["slide_to_roll"]
    velocity = 1.0 + slip if side == "first" else 1.0 - slip
    return float(velocity * row["period"] / row[f"{side}_tiles"])


def tile(row: dict[str, Any], side: str) -> Topography | None:
    """Surface of a row in memory: fractal, or worn, without short waves; None for a wave.

    The rms height is that before the changes [a^2/R]. A worn surface has its peaks above 0.4 of the
    rms height removed by a smooth curve.
    """
    if row[side] == "wave":
        return None
    operating = OperatingPoint.from_settings(case(row).resolve())
    a = operating.hertz_radius
    length = length_over_a(row, side) * a
    made = fractal(
        int(row[f"{side}_pixels"]),
        length,
        length,
        rms_height=row[f"{side}_height"] * operating.film_scale,
        hurst=row["hurst"],
        rolloff_wavenumber=0.0,
        seed=int(row[f"{side}_seed"]),
    )
    if row[side] == "worn":
        sigma = made.rms_height
        heights = made.heights / sigma
        worn = -0.25 * np.logaddexp(-(heights - 0.4) / 0.25, 0.0)
        made = Topography((worn - worn.mean()) * sigma, made.size, "worn")
    return filtered(made, row["shortest"] * a)


def surfaces(row: dict[str, Any]) -> dict[str, Topography]:
    """Give the surfaces of a row that are in memory, by group."""
    made = {group: tile(row, side) for side, group in GROUPS.items()}
    return {group: heights for group, heights in made.items() if heights is not None}

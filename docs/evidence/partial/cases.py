# SPDX-License-Identifier: BSD-3-Clause
"""The rough contacts with a boundary film of cases.csv."""

from __future__ import annotations

import csv
from pathlib import Path
from typing import Any

import pyehl
from pyehl.theory.operating import OperatingPoint

HERE = Path(__file__).resolve().parent
TEXTS = ("name", "law")


def rows() -> list[dict[str, Any]]:
    """Read the rows of cases.csv; numbers as numbers."""
    lines = (HERE / "cases.csv").read_text(encoding="utf-8").splitlines()
    return [
        {key: value if key in TEXTS else float(value) for key, value in row.items()}
        for row in csv.DictReader(lines)
    ]


def case(row: dict[str, Any]) -> pyehl.Case:
    """Make the case of a row: a fractal tile of length a with waves of eight nodes and longer."""
    points = int(row["points"])
    text = (
        f"&contact load = {row['load']!r} mean_velocity = {row['mean_velocity']!r} "
        f"radius = {row['radius']!r} reduced_modulus = 2.26e11 "
        f"slide_to_roll = {row['slide_to_roll']!r} /\n"
        f"&lubricant viscosity = {row['viscosity']!r} pressure_viscosity = 2.2e-8 {law(row)} "
        f"boundary_film = {row['boundary_film']!r} boundary_friction = 0.1 /\n"
        f"&grid points = {points} x_inlet = -2.5 x_outlet = 1.5 y_extent = 2.0 /\n"
    )
    a = OperatingPoint.from_settings(pyehl.Case.from_text(text).resolve()).hertz_radius
    shortest = 8.0 * 4.0 / (points - 1) * a
    return pyehl.Case.from_text(
        f"{text}&surface kind = 'fractal' rms_height = {row['rms_height']!r} "
        f"hurst = {row['hurst']!r} seed = {int(row['seed'])} length_x = {a!r} length_y = {a!r} "
        f"pixels = 128 shortest_wavelength = {shortest!r} /\n"
    )


def law(row: dict[str, Any]) -> str:
    """Keys of the shear law of a row."""
    if row["law"] == "eyring":
        return f"shear_law = 'eyring' eyring_stress = {row['stress']!r}"
    return f"shear_law = 'carreau' carreau_stress = {row['stress']!r} carreau_exponent = 0.6"

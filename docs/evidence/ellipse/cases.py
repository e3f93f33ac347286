# SPDX-License-Identifier: BSD-3-Clause
"""The surfaces and elliptical contacts of cases.csv."""

from __future__ import annotations

import csv
import math
from pathlib import Path
from typing import Any

from scipy.optimize import brentq

import pyehl
from pyehl.surfaces import Topography, filtered, fractal
from pyehl.theory.ellipse import ellipse
from pyehl.theory.operating import OperatingPoint

HERE = Path(__file__).resolve().parent
INLET, OUTLET = -2.5, 1.5


def read(name: str) -> list[dict[str, Any]]:
    """Read the rows of a table; numbers as numbers, '' as None."""
    lines = [x for x in (HERE / name).read_text().splitlines() if not x.startswith("#")]
    return [
        {k: v if k in ("name", "status") else (float(v) if v else None) for k, v in row.items()}
        for row in csv.DictReader(lines)
    ]


def case(row: dict[str, Any], points: int = 0) -> pyehl.Case:
    """Make the case of a row; its surface stands in for the fractal of the namelist.

    `points` along X in place of those of the row, on cells of the same shape.
    """
    along, across = int(row["points"]), int(row["points_y"])
    if points:
        along, across = points, (across - 1) * (points - 1) // (along - 1) + 1
    point = OperatingPoint.from_moes(row["moes_m"], row["moes_l"], radius_ratio=row["radius_ratio"])
    return pyehl.Case(
        contact={
            "load": point.load,
            "mean_velocity": point.mean_velocity,
            "reduced_modulus": point.reduced_modulus,
            "radius_x": point.radius,
            "radius_y": point.radius / row["radius_ratio"],
        },
        surface={
            "kind": "fractal",
            "length_x": row["length_x"] * point.hertz_radius,
            "length_y": row["length_y"] * point.hertz_radius,
            "velocity_ratio": row["velocity_ratio"],
        },
        grid={
            "points": along,
            "points_y": across,
            "x_inlet": INLET,
            "x_outlet": OUTLET,
            "y_extent": row["y_extent"],
        },
    )


def surface(row: dict[str, Any]) -> Topography:
    """Make the surface of a row: fractal, waves shorter than `shortest_wavelength` cut off."""
    point = OperatingPoint.from_settings(case(row).resolve())
    a = point.hertz_radius
    rolloff = row["rolloff_wavelength"]
    tile = fractal(
        (int(row["pixels_x"]), int(row["pixels_y"])),
        row["length_x"] * a,
        row["length_y"] * a,
        rms_height=row["rms_height"] * point.film_scale,
        hurst=row["hurst"],
        rolloff_wavenumber=2.0 * math.pi / (rolloff * a) if rolloff else 0.0,
        seed=int(row["seed"]),
    )
    shortest = row["shortest_wavelength"]
    return filtered(tile, shortest_wavelength=shortest * a) if shortest else tile


def radius_ratio(ellipticity: float) -> float:
    """R_x/R_y of a contact with an ellipticity, the other semi-axis over a."""

    def miss(log_ratio: float) -> float:
        return math.log(ellipse(math.exp(log_ratio)).ellipticity / ellipticity)

    return math.exp(brentq(miss, -6.0, 6.0, xtol=1e-14))


def case_of_circle(kappa: float, moes_m: float, moes_l: float, ratio: float) -> pyehl.Case:
    """Make the case of a contact with the dry inlet of the circle of M and L."""
    shape = ellipse(radius_ratio(kappa))
    return pyehl.Case(
        contact={
            "moes_m": moes_m * kappa / shape.kernel_ratio**1.25,
            "moes_l": moes_l / shape.kernel_ratio**0.25,
            "radius_ratio": shape.radius_ratio,
        },
        surface={"kind": "fractal", "velocity_ratio": ratio},
    )

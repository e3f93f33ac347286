# SPDX-License-Identifier: BSD-3-Clause
"""The surfaces and operating points of cases.csv."""

from __future__ import annotations

import csv
from pathlib import Path
from typing import Any

import numpy as np
import scipy.fft

import pyehl
from pyehl.surfaces import Topography, fractal, wavenumbers

HERE = Path(__file__).resolve().parent


def rows() -> list[dict[str, Any]]:
    """Read the rows of cases.csv; numbers as numbers, '' as None."""
    lines = [x for x in (HERE / "cases.csv").read_text().splitlines() if not x.startswith("#")]
    return [
        {k: v if k in ("name", "status") else (float(v) if v else None) for k, v in row.items()}
        for row in csv.DictReader(lines)
    ]


def surface(row: dict[str, Any]) -> Topography:
    """Make the surface of a row: fractal, waves shorter than `shortest_wavelength` cut off."""
    tile = fractal(
        int(row["pixels"]),
        row["length"],
        row["length"],
        rms_height=row["rms_height"],
        hurst=row["hurst"],
        rolloff_wavenumber=row["rolloff_wavenumber"],
        seed=int(row["seed"]),
    )
    if not row["shortest_wavelength"]:
        return tile
    qx, qy = wavenumbers(tile)
    keep = np.hypot(qx, qy) * row["shortest_wavelength"] <= 2.0 * np.pi * (1.0 + 1e-9)
    heights = scipy.fft.irfft2(scipy.fft.rfft2(tile.heights) * keep, s=tile.shape)
    return Topography(np.asarray(heights), tile.size)


def case(row: dict[str, Any]) -> pyehl.Case:
    """Make the case of a row; its surface stands in for the fractal of the namelist."""
    return pyehl.Case.from_text(
        f"""&contact
   load = {row["load"]!r}
   mean_velocity = {row["mean_velocity"]!r}
/
&surface
   kind = 'fractal'
   length_x = {row["length"]!r}
   length_y = {row["length"]!r}
   pixels = {int(row["pixels"])}
   velocity_ratio = {row["velocity_ratio"]!r}
/
&grid
   points = {int(row["points"])}
   x_inlet = -2.5  x_outlet = 1.5  y_extent = 2.0
/
"""
    )

# SPDX-License-Identifier: BSD-3-Clause
"""A slow roller compared with dry contact of the same gap by ContactMechanics, over its speed.

``python docs/evidence/rollers/dry.py`` writes dry.csv in about two minutes; needs
ContactMechanics (pyehl[test]).
"""

import csv
import math
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import xarray as xr
from ContactMechanics import FreeFFTElasticHalfSpace
from ContactMechanics.Systems import NonSmoothContactSystem
from numpy.typing import NDArray
from SurfaceTopography import Topography

import pyehl
from pyehl.results import settings_of
from pyehl.theory.line_contact import scaling_contact

TABLE = Path(__file__).resolve().parent / "dry.csv"
ROLLER = {
    "shape": "roller",
    "load": 4000.0,
    "length": 0.01,
    "radius": 0.01,
    "profile": "logarithmic",
    "log_amplitude": 7e-6,
}
# Speeds [m/s] by nodes along X
SPEEDS = {257: (0.4, 0.2, 0.1, 0.07, 0.05), 513: (0.2, 0.1, 0.07)}


def solved(points: int, speed: float, misalignment: float = 0.0) -> xr.Dataset:
    """Solve the roller at a speed."""
    contact = ROLLER | {"mean_velocity": speed, "misalignment": misalignment}
    return pyehl.solve(pyehl.Case(contact=contact, grid={"points": points}))


def dry_pressure(ds: xr.Dataset) -> NDArray[np.float64]:
    """Pressure [Pa] of the dry contact on the nodes of a result, by ContactMechanics."""
    c = settings_of(ds)["contact"]
    x, y = ds.x_m.values, ds.y_m.values
    inner = np.abs(x) < 2.0 * scaling_contact(settings_of(ds)).hertz_radius
    gap = x[inner, None] ** 2 / (2.0 * c["radius"]) + (
        -c["log_amplitude"] * np.log(1.0 - np.minimum(0.998, np.abs(y) / y[-1]) ** 2)
        + c["misalignment"] * y
    )
    # beyond the ends of the roller
    gap[:, [0, -1]] = 1e-3
    nodes = gap.shape
    step = x[1] - x[0], y[1] - y[0]
    sizes = nodes[0] * step[0], nodes[1] * step[1]
    half_space = FreeFFTElasticHalfSpace(nodes, 0.5 * c["reduced_modulus"], sizes)
    system = NonSmoothContactSystem(half_space, Topography(-gap, sizes))
    result = system.minimize_proxy(external_force=c["load"], pentol=1e-9)
    if not result.success:
        raise RuntimeError(f"no dry contact: {result.message}")
    pressure = np.zeros((x.size, y.size))
    pressure[inner] = np.asarray(result.jac).reshape(nodes) / math.prod(step)
    return pressure


def rms(ds: xr.Dataset, dry: NDArray[np.float64]) -> float:
    """Rms difference of the pressures over the nodes in dry contact, over the maximum pressure."""
    difference = (ds.p_Pa.values - dry)[dry > 0.0]
    return float(np.sqrt(np.mean(difference**2)) / dry.max())


def runs() -> Iterator[dict[str, float]]:
    """Compare the pressures at each speed."""
    for points, speeds in SPEEDS.items():
        dry = None
        for speed in speeds:
            ds = solved(points, speed)
            # the nodes are the same at all speeds
            dry = dry_pressure(ds) if dry is None else dry
            yield {
                "points": points,
                "mean_velocity": speed,
                "moes_m_line": float(ds.moes_m_line),
                "rms": rms(ds, dry),
            }


def read() -> list[dict[str, float]]:
    """Give the rows of dry.csv."""
    with TABLE.open(encoding="utf-8") as file:
        return [{name: float(value) for name, value in row.items()} for row in csv.DictReader(file)]


def table() -> list[str]:
    """Make the table of dry.csv."""
    lines = ["| nodes along X | speed | M of the line | rms difference |", "|---|---|---|---|"]
    lines += [
        f"| {row['points']:.0f} | {row['mean_velocity']:g} m/s | {row['moes_m_line']:.0f} "
        f"| {100.0 * row['rms']:.2f} % |"
        for row in read()
    ]
    return lines


def main() -> None:
    """Write dry.csv."""
    rows = list(runs())
    with TABLE.open("w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, list(rows[0]))
        writer.writeheader()
        writer.writerows(rows)


if __name__ == "__main__":
    main()

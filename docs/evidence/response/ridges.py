# SPDX-License-Identifier: BSD-3-Clause
"""Rewrite ``ridges.csv``: ridges along the motion by steady solutions, two minutes.

python docs/evidence/response/ridges.py ridges.csv
"""

from __future__ import annotations

import csv
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from make import MIDDLE, parts_of, runs, settings_of
from numpy.typing import NDArray

from pyehl.errors import EhlError
from pyehl.measured_response.superposition import REACH, transient_case
from pyehl.solver import Solver, solver_on_heights
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.operating import OperatingPoint
from pyehl.theory.transport import stiffness, zone_on

POINTS = 513
WAVELENGTHS = (2.0, 1.6, 1.0, 0.8, 0.5, 0.25, 0.125)
# Operating points (M, L) in addition to those of the waves
BETWEEN = {(300.0, 15.0), (700.0, 6.0), (900.0, 10.0)}


# Amplitude over wavelength [a/R]: small enough for the response to be linear
AMPLITUDE = 3e-4
# Algebraic error of both films, whose difference is measured, over the grid error. A value five
# times as large changes T by 0.01, twenty times by up to 0.09
ACCURACY = 1e-3
# Pixels per wavelength; the solver interpolates a map by its Fourier series
PIXELS = 32


def ridges(
    settings: Mapping[str, Mapping[str, Any]], wavelengths: Sequence[float], *, points: int
) -> dict[str, NDArray[np.float64]]:
    """Solve the contact of a resolved case with ridges of each wavelength [a].

    Returns positions x within REACH (n,) [a]; film and pressure of the smooth contact there;
    response T and stiffness (m, n); grid spacing. EhlError if a contact has no solution.
    """
    solver = {"accuracy": ACCURACY}
    smooth = transient_case(settings, points=points, tile=1.0, velocity_ratio=0.0, solver=solver)
    smooth = smooth.with_options("surface.kind=smooth", "time.steps=0")
    scale = OperatingPoint.from_settings(smooth.resolve()).film_scale
    place = np.arange(PIXELS) / PIXELS
    # symmetric to the last bit
    line = AMPLITUDE * np.cos(2.0 * np.pi * np.minimum(place, 1.0 - place))
    solved = []
    for wavelength in (0.0, *wavelengths):
        if wavelength:
            heights = np.tile(wavelength * scale * line, (8, 1))
            case = transient_case(
                settings, points=points, tile=wavelength, velocity_ratio=0.0, solver=solver
            )
            run = solver_on_heights(case, {"surface": heights})
        else:
            run = Solver(smooth)
        with run:
            if not run.run():
                raise EhlError(f"ridges: no solution: {run.summary['status']}")
            x, y = run.axes()
            solved.append((run.field("H"), run.field("P")))
    near, middle = np.abs(x) <= REACH + 0.5 * (x[1] - x[0]), int(np.argmin(np.abs(y)))
    height = AMPLITUDE * np.asarray(wavelengths)[:, np.newaxis]
    film, pressure = (np.stack([pair[i][near, middle] for pair in solved]) for i in (0, 1))
    return {
        "x": x[near],
        "film": film[0],
        "pressure": pressure[0],
        "response": (film[0] - film[1:]) / height,
        "stiffness": (pressure[1:] - pressure[0]) / height,
        "spacing": x[1] - x[0],
    }


def main(path: Path) -> None:
    """Solve all contacts and write the table."""
    with path.open("w", newline="", encoding="utf-8") as stream:
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow("moes_m moes_l points ky T driven free pressure_ratio".split())
        for m, ell in sorted(BETWEEN | {run[:2] for run in runs()}):
            settings = settings_of(m, ell)
            result = ridges(settings, WAVELENGTHS, points=POINTS)
            centre = int(np.argmin(np.abs(result["x"])))
            ky = 2.0 * np.pi / np.array(WAVELENGTHS)
            operating = OperatingPoint.from_settings(settings)
            lubricant = Lubricant.from_settings(settings)
            pressure = np.maximum(result["pressure"], 0.0)
            zone = zone_on(result["x"], pressure, result["film"], operating, lubricant)
            parts = parts_of(zone, 0.0 * ky, ky, (m, ell), 1.0, float(result["spacing"]))
            t = result["response"][:, centre]
            ratio = result["stiffness"][:, centre] / (stiffness(ky) * (1.0 - t))
            for row in zip(ky, t, *(part.real for part in parts[MIDDLE]), ratio, strict=True):
                k, *values, last = row
                writer.writerow(
                    [
                        *(f"{m:g}", f"{ell:g}", POINTS, f"{k:.6g}", f"{values[0]:.3f}"),
                        *(f"{v:.5f}" for v in values[1:]),
                        f"{last:.3f}",
                    ]
                )


if __name__ == "__main__":
    main(Path(sys.argv[1]))

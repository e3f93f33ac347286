# SPDX-License-Identifier: BSD-3-Clause
"""Fit ``edge_gain`` of :mod:`pyehl.theory.response` to measured pressures; print the residuals.

    python docs/evidence/response/gain.py

The waves of ``waves.csv`` are those that the edge of the disc does not affect (below 0.45 a), at
X = 0, on 513 x 513 nodes, with M >= 200: at M = 100 the pressure is too small to measure.
"""

from __future__ import annotations

import csv
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import least_squares

from pyehl.theory.film import central_film
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.operating import OperatingPoint
from pyehl.theory.response import GAIN, edge_gain

HERE = Path(__file__).resolve().parent
POINTS, LOWEST_M, LONGEST = 513, 200.0, 0.45
Array = NDArray[np.float64]


def read() -> Array:
    """M, L, kx, ky, H_c and the measured gain, (waves, 6)."""
    films: dict[tuple[float, float], float] = {}
    result = []
    with (HERE / "waves.csv").open(newline="", encoding="utf-8") as stream:
        for row in csv.DictReader(stream):
            moes = float(row["moes_m"]), float(row["moes_l"])
            kx, ky = float(row["kx"]), float(row["ky"])
            short = np.hypot(kx, ky) * LONGEST > 2.0 * np.pi
            if row["points"] != str(POINTS) or float(row["x"]) or moes[0] < LOWEST_M or not short:
                continue
            if moes not in films:
                point = OperatingPoint.from_moes(*moes)
                films[moes] = central_film(point, Lubricant()) / point.film_scale
            # a pressure that is constant over the cells of the grid has a smaller deflection
            half = 2.0 / (POINTS - 1.0) / np.pi
            cells = np.sinc(half * kx) * np.sinc(half * ky)
            result.append((*moes, kx, ky, films[moes], float(row["pressure_ratio"]) * cells))
    return np.array(result)


def residual(waves: Array, constants: Array | tuple[float, ...]) -> Array:
    """Gain with `constants` less the measured one, (waves,)."""
    _, _, kx, ky, film, measured = waves.T
    return np.asarray(edge_gain(kx, ky, film, constants) - measured)


def fit(waves: Array) -> Array:
    """Least squares from the shipped constants."""
    return np.asarray(least_squares(lambda constants: residual(waves, constants), GAIN).x)


def main() -> None:
    """Print the constants and their residuals at every operating point."""
    waves = read()
    print("shipped", GAIN, "fitted", fit(waves).round(3))
    residuals = residual(waves, GAIN)
    for m, ell in sorted({(m, ell) for m, ell in waves[:, :2]}):
        here = residuals[(waves[:, 0] == m) & (waves[:, 1] == ell)]
        values = np.sqrt(np.mean(here**2)), np.abs(here).max()
        print(f"({m:g}, {ell:g}): rms {values[0]:.4f}, largest {values[1]:.4f}")
    print(f"{residuals.size} waves: rms {np.sqrt(np.mean(residuals**2)):.4f}")


if __name__ == "__main__":
    main()

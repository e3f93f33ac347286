# SPDX-License-Identifier: BSD-3-Clause
"""Compare the inlet transfer off the centre line of ellipses with off_centre.csv.

    python docs/evidence/ellipse/off_centre.py [--measure FILE.csv]

The table has modulus and lag [deg] of G exp(-i k (U - 1) (1 - y^2)^(1/2)), G as in pyehl/theory/
response.py, of waves with crests across the motion at (M, L) = (500, 10) of the circle with the
same dry inlet, U = 1.02, on 257 nodes along X, at four distances y [semi-axis] from the centre
line. The response is not fitted to it. It was measured with version 0.1.0; --measure repeats the
measurement in less than a minute.
"""

from __future__ import annotations

import csv
import sys
from pathlib import Path

import numpy as np
from response import smooth_zone

from cases import HERE, case_of_circle
from pyehl.measured_response.measurement import TIERS, tier_waves
from pyehl.measured_response.superposition import (
    FRONT,
    WaveSet,
    linear_surface,
    step_counts,
    transient_case,
)
from pyehl.solver import solver_on_heights
from pyehl.theory.operating import OperatingPoint
from pyehl.theory.response import inlet_fit
from pyehl.theory.transport import transport

RATIO = 1.02
LINES = (0.0, 0.25, 0.5, 0.625)
# Numbers of wavelengths along the tile of the waves in the table
ALONG = (3, 4, 5, 6, 7, 8, 10, 11, 13, 15, 18, 20)


def measure(kappa: float) -> list[list[str]]:
    """Rows of the table for an ellipticity."""
    points, waves = TIERS[0].points, tier_waves(TIERS[0])
    waves = WaveSet(waves.tile, waves.along, 0 * waves.across, waves.phase)
    settings = case_of_circle(kappa, 500.0, 10.0, RATIO).resolve()
    case = transient_case(settings, points=points, tile=waves.tile, velocity_ratio=RATIO, solver={})
    heights, amplitude = linear_surface(waves)
    period, total = step_counts(points, waves.tile, RATIO)
    scale = OperatingPoint.from_settings(settings).film_scale
    with solver_on_heights(case, {"surface": heights * scale}) as run:
        while not run.done and float(run.summary.get("steps") or 0) < 1:
            run.advance()
        x, y = run.axes()
        middle = int(np.argmin(np.abs(x)))
        lines = [int(np.argmin(np.abs(y - kappa * line))) for line in LINES]
        times, films = [], []
        for step in range(1, total + 1):
            run.advance()
            if step > total - period:
                times.append(float(run.summary["T"]))
                films.append(run.field("H")[middle, lines])
    angle = np.outer(times, waves.kx * RATIO)
    basis = np.hstack([np.ones((len(times), 1)), np.cos(angle), np.sin(angle)])
    fitted, m = np.linalg.pinv(basis) @ np.array(films), waves.kx.size
    roughness = amplitude * np.exp(1j * (waves.kx * (x[middle] - FRONT) + waves.phase))
    t = -(fitted[1 : m + 1] + 1j * fitted[m + 1 :]) / roughness[:, np.newaxis]
    zone, still = smooth_zone(settings, points), 0.0 * waves.kx
    driven, free = transport(zone, waves.kx, still, RATIO, np.zeros(1), float(x[1] - x[0]))[0]
    made = (t - driven[:, np.newaxis]) / free[:, np.newaxis]
    rows = []
    for j in np.flatnonzero(np.isin(waves.along, ALONG)):
        k = waves.kx[j]
        for line, g in zip(y[lines] / kappa, made[j], strict=True):
            turned = g * np.exp(-1j * k * (RATIO - 1.0) * np.sqrt(1.0 - line**2))
            lag = np.degrees(np.angle(turned))
            rows.append([f"{v:.5g}" for v in (kappa, k, line, abs(turned), lag)])
    return rows


def main() -> None:
    """Print the deviation of G over its value on the centre line, by ellipticity and line."""
    path = HERE / "off_centre.csv"
    if "--measure" in sys.argv:
        path = Path(sys.argv[-1])
        table = [row for kappa in (0.4, 0.6, 1.0, 2.0, 4.0) for row in measure(kappa)]
        with path.open("w", newline="", encoding="utf-8") as stream:
            heads = ["ellipticity", "kx", "y", "modulus", "lag"]
            csv.writer(stream, lineterminator="\n").writerows([heads, *table])
    with path.open(encoding="utf-8") as stream:
        rows = [{k: float(v) for k, v in row.items()} for row in csv.DictReader(stream)]
    for kappa in sorted({row["ellipticity"] for row in rows}):
        settings = case_of_circle(kappa, 500.0, 10.0, RATIO).resolve()
        moes = OperatingPoint.from_settings(settings).equivalent_moes
        part = [row for row in rows if row["ellipticity"] == kappa]
        middles = {row["kx"]: row for row in part if row["y"] == 0.0}
        off: dict[float, list[complex]] = {}
        for row in (row for row in part if row["y"] > 0.0):
            k, middle = row["kx"], middles[row["kx"]]
            turn = np.exp(1j * np.radians(middle["lag"] - row["lag"]))
            there, here = (
                complex(inlet_fit(k, 0.0, moes, RATIO, y, kappa)) for y in (row["y"], 0.0)
            )
            measured = row["modulus"] / middle["modulus"] * turn
            off.setdefault(row["y"], []).append(there / here - measured)
        for y, values in off.items():
            rms = np.sqrt(np.mean(np.square(np.abs(values))))
            print(f"ellipticity {kappa:g}, y = {y:.3g}: rms {rms:.3f}")


if __name__ == "__main__":
    main()

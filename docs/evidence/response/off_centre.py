# SPDX-License-Identifier: BSD-3-Clause
"""Flattening by the inlet off the centre line: ``off_centre.csv`` compared with the response.

    python docs/evidence/response/off_centre.py [--measure]

``--measure`` repeats the measurement, in several minutes. The change of T from its measured value
on Y = 0 is compared with the response, which is not fitted to it. Waves with crests across the
motion on 257 x 257 nodes; T on lines off the centre line, at X = 0.
"""

from __future__ import annotations

import csv
import sys

import numpy as np
from make import HERE, MIDDLE, parts_of, settings_of, smooth_zone
from numpy.typing import NDArray

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

POINTS, RATIO, FILLING = 257, 1.01, 5.3
LINES = (0.0, 0.25, 0.5, 0.625)
RUNS = ((1000.0, 10.0), (500.0, 5.0), (200.0, 10.0))
ALONG = np.array([3, 4, 5, 6, 7, 8, 9, 11, 13, 16])
COLUMNS = "moes_m moes_l kx y T_re T_im".split()


def measure(moes_m: float, moes_l: float) -> list[list[str]]:
    """Rows of one operating point."""
    settings = settings_of(moes_m, moes_l)
    operating = OperatingPoint.from_settings(settings)
    phase = np.random.default_rng(5).uniform(0.0, 2.0 * np.pi, ALONG.size)
    waves = WaveSet(4.0, ALONG, 0 * ALONG, phase)
    case = transient_case(settings, points=POINTS, tile=4.0, velocity_ratio=RATIO, solver={})
    heights, amplitude = linear_surface(waves)
    period, total = step_counts(POINTS, waves.tile, RATIO, FILLING)
    with solver_on_heights(case, {"surface": heights * operating.film_scale}) as run:
        while not run.done and float(run.summary.get("steps") or 0) < 1:
            run.advance()
        x, y = run.axes()
        middle = int(np.argmin(np.abs(x)))
        lines = [int(np.argmin(np.abs(y - line))) for line in LINES]
        times, films = [], []
        for step in range(1, total + 1):
            run.advance()
            if step > total - period:
                times.append(float(run.summary["T"]))
                films.append(run.field("H")[middle, lines])
    angle = np.outer(times, waves.kx * RATIO)
    basis = np.hstack([np.ones((len(times), 1)), np.cos(angle), np.sin(angle)])
    fitted = np.linalg.pinv(basis) @ np.array(films)
    m = ALONG.size
    wave = fitted[1 : m + 1] + 1j * fitted[m + 1 :]
    roughness = amplitude * np.exp(1j * (waves.kx * (x[middle] - FRONT) + waves.phase))
    t = -wave / roughness[:, np.newaxis]
    rows = []
    for j in range(m):
        for k, line in enumerate(LINES):
            heads = [f"{moes_m:g}", f"{moes_l:g}", f"{waves.kx[j]:.6g}", f"{line:g}"]
            rows.append([*heads, f"{t[j, k].real:.5f}", f"{t[j, k].imag:.5f}"])
    return rows


def residuals(table: NDArray[np.float64]) -> NDArray[np.float64]:
    """Deviations of T off the centre line by the model of the oblique inlet (n,)."""
    result = np.empty(len(table))
    for m, ell in RUNS:
        here = np.flatnonzero((table[:, 0] == m) & (table[:, 1] == ell))
        zone, kx = smooth_zone(m, ell, POINTS), table[here, 2]
        driven, free = parts_of(zone, kx, 0.0 * kx, (m, ell), RATIO, 4.0 / (POINTS - 1.0))[MIDDLE]
        t = table[here, 4] + 1j * table[here, 5]
        line = [inlet_fit(k, 0.0, (m, ell), RATIO, y) for k, y in table[here, 2:4]]
        middle = [inlet_fit(k, 0.0, (m, ell), RATIO) for k in kx]
        # off the centre line the inlet edge is further along the motion
        further = np.sqrt(1.0 - np.square(table[here, 3])) - 1.0
        change = np.array(line) / np.array(middle) * np.exp(1j * kx * (RATIO - 1.0) * further)
        centre = np.repeat(((t - driven) / free)[table[here, 3] == 0.0], len(LINES))
        result[here] = np.abs(driven + free * centre * change - t)
    return result


def main(arguments: list[str]) -> None:
    """Measure if requested, compare, print."""
    path = HERE / "off_centre.csv"
    if "--measure" in arguments:
        rows = []
        for m, ell in RUNS:
            print(f"M {m:g} L {ell:g}", flush=True)
            rows += measure(m, ell)
            with path.open("w", newline="", encoding="utf-8") as stream:
                csv.writer(stream, lineterminator="\n").writerows([COLUMNS, *rows])
    table = np.loadtxt(path, delimiter=",", skiprows=1)
    residual = residuals(table)
    for m, ell in RUNS:
        point = (table[:, 0] == m) & (table[:, 1] == ell)
        for line in LINES[1:]:
            here = residual[point & (table[:, 3] == line)]
            rms = np.sqrt(np.mean(here**2))
            print(f"({m:g}, {ell:g}) at Y = {line:g}: rms residual of T {rms:.4f}")


if __name__ == "__main__":
    main(sys.argv[1:])

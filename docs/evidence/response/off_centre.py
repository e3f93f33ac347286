# SPDX-License-Identifier: BSD-3-Clause
"""How much more the inlet flattens off the centre line: ``off_centre.csv`` and the constant of it.

    python docs/evidence/response/off_centre.py [--measure]

With ``--measure`` the waves are measured anew, some minutes; without, the constant is fitted to the
table and printed with what it leaves. Waves with crests across the motion on 257 x 257 nodes; T on
lines beside the centre line, at X = 0. ln|z| grows by OBLIQUE Y^2 over its value on Y = 0.
"""

from __future__ import annotations

import csv
import sys

import numpy as np
from make import HERE, MIDDLE, parts_of, settings_of
from numpy.typing import NDArray
from parts import smooth_zone
from scipy.optimize import minimize_scalar

from pyehl.measured_response.superposition import (
    FRONT,
    WaveSet,
    linear_surface,
    step_counts,
    transient_case,
)
from pyehl.solver import Solver
from pyehl.theory.operating import OperatingPoint

POINTS, RATIO, FILLING = 257, 1.01, 5.3
LINES = (0.0, 0.25, 0.5, 0.625)
RUNS = ((1000.0, 10.0), (500.0, 5.0), (200.0, 10.0))
ALONG = np.array([3, 4, 5, 6, 7, 8, 9, 11, 13, 16])
COLUMNS = "moes_m moes_l kx y T_re T_im".split()
Complex = NDArray[np.complex128]


def measure(moes_m: float, moes_l: float) -> list[list[str]]:
    """Rows of one operating point."""
    settings = settings_of(moes_m, moes_l)
    operating = OperatingPoint.from_settings(settings)
    phase = np.random.default_rng(5).uniform(0.0, 2.0 * np.pi, ALONG.size)
    waves = WaveSet(4.0, ALONG, 0 * ALONG, phase)
    case = transient_case(settings, points=POINTS, tile=4.0, velocity_ratio=RATIO, solver={})
    heights, amplitude = linear_surface(waves)
    period, total = step_counts(POINTS, waves.tile, RATIO, FILLING)
    with Solver.open(case, heights * operating.film_scale) as run:
        while not run.done and float(run.summary().get("steps") or 0) < 1:
            run.advance()
        x, y = run.axes()
        middle = int(np.argmin(np.abs(x)))
        lines = [int(np.argmin(np.abs(y - line))) for line in LINES]
        times, films = [], []
        for step in range(1, total + 1):
            run.advance()
            if step > total - period:
                times.append(float(run.summary()["T"]))
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


def centre_parts(table: NDArray[np.float64]) -> tuple[Complex, Complex]:
    """Driven part of T on Y = 0, and the free part but for what is fitted of it."""
    driven, free = np.empty(len(table), complex), np.empty(len(table), complex)
    for m, ell in RUNS:
        here = np.flatnonzero((table[:, 0] == m) & (table[:, 1] == ell))
        zone, kx, spacing = smooth_zone(m, ell, POINTS), table[here, 2], 4.0 / (POINTS - 1.0)
        parts = parts_of(zone, kx, 0.0 * kx, (m, ell), RATIO, spacing)
        driven[here], free[here] = parts[MIDDLE]
    return driven, free


def fitted(table: NDArray[np.float64]) -> tuple[float, NDArray[np.float64], NDArray[np.float64]]:
    """Constant, and |T| of it less |T| measured off the centre line, with the Y of each."""
    kx, y = table[:, 2], table[:, 3]
    t, (driven, free) = table[:, 4] + 1j * table[:, 5], centre_parts(table)
    slip = kx * (RATIO - 1.0)
    # the inlet of a strip off the centre line lies further along the motion
    g = (t - driven) / (free * np.exp(1j * slip * (np.sqrt(1.0 - y * y) - 1.0)))
    z = 1.0 / g - 1.0
    centre = np.repeat(z[y == 0.0], len(LINES))
    off = y > 0.0

    def left(constant: float) -> Complex:
        model = 1.0 / (1.0 + centre * np.exp(constant * y * y))
        return np.asarray((free * (model - g))[off])

    found = minimize_scalar(lambda c: float(np.sum(np.abs(left(c)) ** 2)), bounds=(0.0, 3.0))
    return float(found.x), np.abs(left(float(found.x))), y[off]


def main(arguments: list[str]) -> None:
    """Measure if asked, fit, print."""
    path = HERE / "off_centre.csv"
    if "--measure" in arguments:
        rows = []
        for m, ell in RUNS:
            print(f"M {m:g} L {ell:g}", flush=True)
            rows += measure(m, ell)
            with path.open("w", newline="", encoding="utf-8") as stream:
                csv.writer(stream, lineterminator="\n").writerows([COLUMNS, *rows])
    table = np.loadtxt(path, delimiter=",", skiprows=1)
    for m, ell in RUNS:
        here = table[(table[:, 0] == m) & (table[:, 1] == ell)]
        print(f"({m:g}, {ell:g}): {fitted(here)[0]:.3f}")
    constant, residual, y = fitted(table)
    print(f"all: {constant:.3f}, T left")
    for line in LINES[1:]:
        print(f"  at Y = {line:g}: rms {np.sqrt(np.mean(residual[y == line] ** 2)):.4f}")


if __name__ == "__main__":
    main(sys.argv[1:])

# SPDX-License-Identifier: BSD-3-Clause
"""Rewrite ``waves.csv``: the response of the contact to waves, measured with the solver.

    python docs/evidence/response/make.py waves.csv [M L U]

All runs of the plan take several hours on two cores; with M, L, U only those of one operating point
are made. Each run is a tile of 4 a with up to 34 waves of small amplitude; on 1025 x 1025 nodes a
tile of a/2 with the shortest waves.
"""

from __future__ import annotations

import csv
import math
import sys
from collections.abc import Iterator
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pyehl.case import Case
from pyehl.measured_response.measurement import TIERS, tier_waves
from pyehl.measured_response.superposition import FILLING, Superposition, WaveSet, superpose
from pyehl.solver import Solver
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.operating import OperatingPoint
from pyehl.theory.response import inlet_base
from pyehl.theory.transport import Zone, stiffness, transport, zone_on

Array, Complex = NDArray[np.float64], NDArray[np.complex128]
HERE = Path(__file__).parent
STATIONS = np.array([-0.5, 0.0, 0.5])
# Index of X = 0
MIDDLE = 1
COLUMNS = (
    "moes_m moes_l velocity_ratio points kx ky x T_re T_im driven_re driven_im free_re free_im "
    "pressure_ratio"
).split()
TILE = 4.0
# Runs (M, L, U, points, variant) whose record began at SETTLED [a], later than FILLING
SETTLED = 5.3
LATER = {
    (200.0, 10.0, 0.9, 257, 1),
    (200.0, 10.0, 1.01, 257, 1),
    (200.0, 10.0, 1.1, 257, 1),
    (500.0, 5.0, 1.2, 257, 1),
    (500.0, 15.0, 1.01, 257, 1),
    *((300.0, 12.0, ratio, 257, 1) for ratio in (0.8, 0.9, 1.0, 1.01, 1.1, 1.2)),
    *((100.0, 3.0, ratio, 257, 1) for ratio in (0.9, 1.0, 1.01, 1.05, 1.1)),
    *((100.0, 3.0, ratio, 513, 1) for ratio in (0.8, 1.2)),
    *(
        (*point, ratio, 257, 1)
        for point in ((100.0, 5.0), (150.0, 3.0), (150.0, 5.0), (200.0, 5.0))
        for ratio in (0.9, 1.01, 1.1)
    ),
}
# Wavelengths per tile along the motion, those with at least eight nodes each
ALONG = (*range(1, 17), 18, 19, 20, 22, 24, 26, 28, 30, 32, 35, 38, 41, 44, 48, 52, 56, 60, 64)
# Angles of consecutive waves [deg]; variants 0 and 1 start at different ones
ANGLES = (
    *(85, 0, 45, 26, 0, 63, 45, 0, 30, 56, 0, 45, 70, 18, 0, 45, 60),
    *(0, 35, 50, 0, 70, 22, 45, 0, 60, 0, 40, 0, 65, 45, 0, 30, 0),
)
# Angles of variants 2 and 3
STEEP = (
    *(85, 80, 70, 76, 84, 66, 73, 87, 62, 79, 83, 68, 75, 86, 64, 81, 71),
    *(77, 88, 60, 82, 74, 69, 85, 65, 78, 72, 84, 67, 80, 63, 76, 82, 70),
)


def waves_of(points: int, variant: int) -> WaveSet:
    """Waves of a run on a grid of points x points nodes, on the finest those of the last tier."""
    if points == TIERS[-1].points:
        return tier_waves(TIERS[-1])
    last = (points - 1) // 8
    along = [n for n in ALONG if n <= last]
    across = []
    for i, n in enumerate(along):
        if variant < 2:
            angle = ANGLES[(i + 2 * variant) % len(ANGLES)]
        else:
            angle = STEEP[(i + 5 * (variant - 2)) % len(STEEP)]
        m = round(n * math.tan(math.radians(angle)))
        if n == 1 and variant < 2:
            m = (12, 0)[variant]
        across.append(min(m, last))
    phase = np.random.default_rng(5).uniform(0.0, 2.0 * np.pi, len(along))
    return WaveSet(TILE, np.array(along), np.array(across), phase)


def settings_of(moes_m: float, moes_l: float) -> dict[str, dict[str, Any]]:
    """Resolve the case of an operating point."""
    return Case.from_text(f"&contact moes_m = {moes_m!r} moes_l = {moes_l!r} /\n").resolve()


@lru_cache
def smooth_zone(moes_m: float, moes_l: float, points: int) -> Zone:
    """Centre line of the smooth contact on a grid."""
    settings = settings_of(moes_m, moes_l)
    operating, lubricant = OperatingPoint.from_settings(settings), Lubricant.from_settings(settings)
    x, pressure, film = smooth_line(moes_m, moes_l, points)
    return zone_on(x, np.maximum(pressure, 0.0), film, operating, lubricant)


def smooth_line(moes_m: float, moes_l: float, points: int) -> tuple[Array, ...]:
    """X, P and H of a smooth contact on Y = 0."""
    text = f"&contact moes_m = {moes_m!r} moes_l = {moes_l!r} /\n"
    options = ["surface.kind=smooth", f"grid.points={points}", "solver.accuracy=0.02"]
    with Solver(Case.from_text(text, options)) as solver:
        if not solver.run():
            raise SystemExit(f"{moes_m:g}, {moes_l:g} on {points}: {solver.summary['status']}")
        x, y = solver.axes()
        middle = int(np.argmin(np.abs(y)))
        return x, solver.field("P")[:, middle], solver.field("H")[:, middle]


def parts_of(
    zone: Zone, kx: Array, ky: Array, moes: tuple[float, float], ratio: float, spacing: float
) -> list[tuple[Complex, Complex]]:
    """Driven part of T at the STATIONS, and the free part without its fitted factor."""
    base = inlet_base(zone, kx, ky, moes, ratio, spacing)
    result = []
    for x, (driven, free) in zip(
        STATIONS, transport(zone, kx, ky, ratio, STATIONS, spacing), strict=True
    ):
        result.append((driven, free * base * np.exp(1j * kx * (ratio - 1.0) * (x + 1.0))))
    return result


def rows(
    waves: WaveSet, result: Superposition, moes_m: float, moes_l: float, ratio: float
) -> Iterator[list[str]]:
    """Rows of the table: T, and its parts by the transport equation."""
    kx, ky = waves.kx, waves.ky
    points = round(TILE / result.spacing) + 1
    zone = smooth_zone(moes_m, moes_l, points)
    parts = parts_of(zone, kx, ky, (moes_m, moes_l), ratio, result.spacing)
    for j in range(kx.size):
        for x, (driven, free) in zip(STATIONS, parts, strict=True):
            i = int(np.argmin(np.abs(result.x - x)))
            t = result.response[j, i]
            ratio_p = abs(result.stiffness[j, i] / (stiffness(waves.q[j]) * (1.0 - t)))
            values = [v for c in (t, driven[j], free[j]) for v in (c.real, c.imag)]
            yield [
                *(f"{v:g}" for v in (moes_m, moes_l, ratio, points)),
                *(f"{v:.6g}" for v in (kx[j], ky[j], x)),
                *(f"{v:.5f}".replace("-0.00000", "0") for v in values),
                f"{ratio_p:.4f}",
            ]


def runs() -> Iterator[tuple[float, float, float, int, int]]:
    """M, L, U, points and variant of the runs of the table."""
    with (HERE / "waves.csv").open(newline="", encoding="utf-8") as stream:
        table = list(csv.DictReader(stream))
    there: dict[tuple[str, ...], set[tuple[str, str]]] = {}
    for row in table:
        key = tuple(row[c] for c in COLUMNS[:4])
        there.setdefault(key, set()).add((row["kx"], row["ky"]))
    for key, known in there.items():
        moes_m, moes_l, ratio, points = *map(float, key[:3]), int(key[3])
        for variant in range(1 if points == TIERS[-1].points else 4):
            waves = waves_of(points, variant)
            pairs = zip(waves.kx, waves.ky, strict=True)
            if {(f"{kx:.6g}", f"{ky:.6g}") for kx, ky in pairs} <= known:
                yield moes_m, moes_l, ratio, points, variant


def main(arguments: list[str]) -> None:
    """Make all rows of ``waves.csv``, or those of one operating point."""
    chosen = tuple(float(v) for v in arguments[1:])
    plan = [run for run in runs() if chosen in ((), run[:3])]
    with Path(arguments[0]).open("w", newline="", encoding="utf-8") as stream:
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow(COLUMNS)
        for m, ell, u, n, variant in plan:
            print(f"M {m:g} L {ell:g} U {u:g}: {n} x {n} nodes, waves {variant}", flush=True)
            waves = waves_of(n, variant)
            filling = SETTLED if (m, ell, u, n, variant) in LATER else FILLING
            result = superpose(
                settings_of(m, ell), waves, points=n, velocity_ratio=u, filling=filling
            )
            writer.writerows(rows(waves, result, m, ell, u))


if __name__ == "__main__":
    main(sys.argv[1:])

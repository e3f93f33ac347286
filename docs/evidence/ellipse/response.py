# SPDX-License-Identifier: BSD-3-Clause
"""Measure small waves on elliptical contacts: rows of response.csv, a few minutes each.

    python docs/evidence/ellipse/response.py ELLIPTICITY M L U     measures and adds waves
    python docs/evidence/ellipse/response.py                       repeats the predictions

M and L are those of the circular contact with the same dry inlet (`equivalent_moes`). A row is a
wave, on 257 nodes along X, at X = Y = 0: measured T; T by the response of the circle with the same
inlet and film, with the same dry inlet, of Biboulet & Houpert 2010, and with M and L by R_x;
pressure over roughness, measured and by the first model.
"""

from __future__ import annotations

import csv
import itertools
import sys
from collections.abc import Sequence
from typing import Any

import numpy as np
from centre import at_centre
from numpy.typing import NDArray

from cases import HERE, case_of_circle
from pyehl.contact.smooth import solve_contact
from pyehl.handle import SolverHandle
from pyehl.measured_response.measurement import TIERS, tier_waves
from pyehl.measured_response.superposition import Superposition, WaveSet, superpose, transient_case
from pyehl.theory.line_contact import circle_with_same_inlet
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.operating import OperatingPoint
from pyehl.theory.response import inlet_transfer
from pyehl.theory.transport import Zone, transport, zone_on

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
# Length of the domain of a measurement [a]
WIDTH = 4.0
MODELS = ("circle", "dry", "houpert", "by_rx")
COLUMNS = (
    "ellipticity moes_m moes_l velocity_ratio kx ky T_re T_im "
    + " ".join(f"{name}_{part}" for name in MODELS for part in ("re", "im"))
    + " pressure circle_pressure"
).split()
NODES = 14
LONGEST = 3.0


def smooth_zone(settings: dict[str, dict[str, Any]], points: int) -> Zone:
    """Solve the smooth contact on the grid of the measurement."""
    case = transient_case(settings, points=points, tile=4.0, velocity_ratio=1.0, solver={})
    with SolverHandle(case.with_options("surface.kind=smooth").text) as solver:
        solver.run()
        (x, y), pressure, film = solver.axes(), solver.field("P"), solver.field("H")
    middle = int(np.argmin(np.abs(y)))
    point, oil = OperatingPoint.from_settings(settings), Lubricant.from_settings(settings)
    return zone_on(x, np.maximum(pressure[:, middle], 0.0), film[:, middle], point, oil)


def predicted(
    conditions: Sequence[float], kx: Array, ky: Array, points: int
) -> tuple[list[Complex], Array]:
    """T of waves on a grid by all models, and pressure over roughness by the first model."""
    settings = case_of_circle(*conditions).resolve()
    ratio, spacing = conditions[3], WIDTH / (points - 1)
    point, oil = OperatingPoint.from_settings(settings), Lubricant.from_settings(settings)
    shape = point.ellipse
    zone = smooth_zone(settings, points)
    driven, free = transport(zone, kx, ky, ratio, np.zeros(1), spacing)[0]
    turned = free * np.exp(1j * kx * (ratio - 1.0))
    same = circle_with_same_inlet(point, oil, solve_contact(settings).central_film)
    houpert = (
        point.moes_m * shape.kernel_ratio**-0.25 / shape.ellipticity,
        point.moes_l * shape.kernel_ratio**0.75,
    )
    amplitudes = [
        driven + turned * inlet_transfer(zone, kx, ky, moes, ratio)
        for moes in (same, point.equivalent_moes, houpert, (point.moes_m, point.moes_l))
    ]
    cell = np.sinc(kx * spacing / (2.0 * np.pi)) * np.sinc(ky * spacing / (2.0 * np.pi))
    _, pressure = at_centre(zone, same, (kx, ky, ratio), shape, edge=False, spacing=spacing)
    return amplitudes, np.abs(pressure) / cell


def lines(conditions: list[float], waves: WaveSet, result: Superposition) -> list[list[str]]:
    """Make the rows of a measurement."""
    amplitudes, pressure = predicted(conditions, waves.kx, waves.ky, TIERS[0].points)
    middle = int(np.argmin(np.abs(result.x)))
    table = []
    for k in np.argsort(waves.q):
        length = 2.0 * np.pi / waves.q[k]
        if length < NODES * result.spacing * 0.9 or 2.0 * np.pi / waves.kx[k] > LONGEST:
            continue
        values = [*conditions, waves.kx[k], waves.ky[k]]
        for one in (result.response[k, middle], *(wave[k] for wave in amplitudes)):
            values += [one.real, one.imag]
        values += [abs(result.stiffness[k, middle]), pressure[k]]
        table.append([f"{v:.5g}" for v in values])
    return table


def again() -> list[list[str]]:
    """Rows of the table with present predictions."""
    with (HERE / "response.csv").open(encoding="utf-8", newline="") as stream:
        rows = list(csv.reader(stream))[1:]
    table = []
    for key, group in itertools.groupby(rows, key=lambda row: row[:4]):
        part = list(group)
        kx, ky = (np.array([float(row[i]) for row in part]) for i in (4, 5))
        amplitudes, pressure = predicted([float(v) for v in key], kx, ky, TIERS[0].points)
        for k, row in enumerate(part):
            waves = [f"{v:.5g}" for t in amplitudes for v in (t[k].real, t[k].imag)]
            table.append([*row[:8], *waves, row[-2], f"{pressure[k]:.5g}"])
    return table


def main() -> None:
    """Measure waves and add them to the table, or repeat its predictions."""
    path = HERE / "response.csv"
    if len(sys.argv) == 1:
        table = again()
        with path.open("w", newline="", encoding="utf-8") as stream:
            csv.writer(stream, lineterminator="\n").writerows([COLUMNS, *table])
        return
    conditions = [float(word) for word in sys.argv[1:5]]
    waves = tier_waves(TIERS[0])
    settings = case_of_circle(*conditions).resolve()
    result = superpose(settings, waves, points=TIERS[0].points, velocity_ratio=conditions[3])
    fresh = [] if path.exists() else [COLUMNS]
    with path.open("a", newline="", encoding="utf-8") as stream:
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerows(fresh + lines(conditions, waves, result))


if __name__ == "__main__":
    main()

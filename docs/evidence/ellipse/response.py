# SPDX-License-Identifier: BSD-3-Clause
"""Measure small waves on elliptical contacts: lines of response.csv, a minute or some each.

python docs/evidence/ellipse/response.py ELLIPTICITY M L U

M and L are those of the circular contact with the same dry inlet (`equivalent_moes`). A line is a
wave, on 257 nodes along X, at X = Y = 0: T as measured; by the
response of the circle with the same inlet and film, that with the same dry inlet, that of Biboulet
& Houpert 2010, and that of M and L by R_x; the pressure over roughness measured, and by the first.
"""

from __future__ import annotations

import csv
import sys
from typing import Any

import numpy as np

from cases import HERE, case_of_circle
from pyehl.handle import SolverHandle
from pyehl.measured_response.superposition import Superposition, WaveSet, superpose, transient_case
from pyehl.measured_response.tiers import TIERS, tier_waves
from pyehl.prediction.smooth import solve_contact, zone_on
from pyehl.theory.film import circle_with_same_inlet
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.operating import OperatingPoint
from pyehl.theory.response import edge_gain, inlet_transfer
from pyehl.theory.transport import Zone, transport, wave_pressure

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


def lines(conditions: list[float], waves: WaveSet, found: Superposition) -> list[list[str]]:
    """Give the lines of a measurement."""
    ratio = conditions[3]
    settings = case_of_circle(*conditions).resolve()
    point, oil = OperatingPoint.from_settings(settings), Lubricant.from_settings(settings)
    shape = point.ellipse
    zone = smooth_zone(settings, TIERS[0].points)
    kx, ky = waves.kx, waves.ky
    driven, free = transport(zone, kx, ky, ratio, np.zeros(1), found.spacing)[0]
    turned = free * np.exp(1j * kx * (ratio - 1.0))
    same = circle_with_same_inlet(point, oil, solve_contact(settings).central_film)
    houpert = (
        point.moes_m * shape.kernel_ratio**-0.25 / shape.ellipticity,
        point.moes_l * shape.kernel_ratio**0.75,
    )
    carried = [
        turned * inlet_transfer(zone, kx, ky, moes, ratio)
        for moes in (same, point.equivalent_moes, houpert, (point.moes_m, point.moes_l))
    ]
    cell = np.sinc(kx * found.spacing / (2.0 * np.pi)) * np.sinc(ky * found.spacing / (2.0 * np.pi))
    film = zone.stiffness * found.central_film
    gain = zone.stiffness * edge_gain(kx, ky, film, ellipticity=shape.ellipticity) / cell
    pressure = gain * wave_pressure(kx, ky, ratio, driven, carried[0])
    middle = int(np.argmin(np.abs(found.x)))
    table = []
    for k in np.argsort(waves.q):
        length = 2.0 * np.pi / waves.q[k]
        if length < NODES * found.spacing * 0.9 or 2.0 * np.pi / kx[k] > LONGEST:
            continue
        values = [*conditions, kx[k], ky[k]]
        for one in (found.response[k, middle], *(driven[k] + wave[k] for wave in carried)):
            values += [one.real, one.imag]
        values += [abs(found.stiffness[k, middle]), abs(pressure[k])]
        table.append([f"{v:.5g}" for v in values])
    return table


def main() -> None:
    """Measure, and add the waves to the table."""
    conditions = [float(word) for word in sys.argv[1:5]]
    waves = tier_waves(TIERS[0])
    settings = case_of_circle(*conditions).resolve()
    found = superpose(settings, waves, points=TIERS[0].points, velocity_ratio=conditions[3])
    path = HERE / "response.csv"
    fresh = [] if path.exists() else [COLUMNS]
    with path.open("a", newline="", encoding="utf-8") as stream:
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerows(fresh + lines(conditions, waves, found))


if __name__ == "__main__":
    main()

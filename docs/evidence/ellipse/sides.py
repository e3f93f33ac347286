# SPDX-License-Identifier: BSD-3-Clause
"""Rewrite sides.csv: pressure of ridges along the motion off the centre line, one minute.

    python docs/evidence/ellipse/sides.py

At each crest and valley of a small ridge on X = 0: T, and the pressure over that of the half-space
for this T, by steady solutions on 257 nodes along X and by the prediction.
"""

from __future__ import annotations

import csv
import sys
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from cases import HERE, case_of_circle
from pyehl.contact.smooth import circle_of, solve_contact, zone_of
from pyehl.measured_response.superposition import transient_case
from pyehl.prediction.response import AXIS
from pyehl.solver import solver_on_heights
from pyehl.theory.ellipse_edge import EllipseEdge
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.operating import OperatingPoint
from pyehl.theory.response import inlet_transfer
from pyehl.theory.transport import LINES, harmonics, line_pressure, stiffness, transport

sys.path.insert(0, str(HERE.parent / "response"))
from ridges import ACCURACY, AMPLITUDE, PIXELS

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
POINTS = 257
# Ellipticity, M and L of the circle with the same dry inlet, wavelengths [a]
CONTACTS = (
    (0.4, 800.0, 9.0, (0.4, 0.2)),
    (0.5, 300.0, 12.0, (0.5, 0.25)),
    (0.6, 600.0, 7.0, (0.6, 0.3)),
    (1.0, 500.0, 10.0, (0.5, 0.25)),
    (2.0, 500.0, 10.0, (1.0, 0.5)),
)
# Maximum distance of the lines [semi-axis]: near the edge the pressure is too small to measure
REACH = 0.8
COLUMNS = "ellipticity moes_m moes_l wavelength y T gain predicted_T predicted_gain".split()


def fields(
    settings: Mapping[str, Mapping[str, Any]], tile: float, heights: Array | None
) -> list[Array]:
    """Y, H and P on X = 0 of a contact with heights on a tile [a]; None: smooth."""
    case = transient_case(
        settings, points=POINTS, tile=tile, velocity_ratio=0.0, solver={"accuracy": ACCURACY}
    )
    if heights is None:
        case = case.with_options("surface.kind=smooth", "time.steps=0")
    with solver_on_heights(case, {"surface": heights}) as run:
        if not run.run():
            raise SystemExit(f"no solution: {run.summary['status']}")
        x, y = run.axes()
        middle = int(np.argmin(np.abs(x)))
        return [y, run.field("H")[middle], run.field("P")[middle]]


def predicted(settings: Mapping[str, Mapping[str, Any]], wavelength: float) -> tuple[Array, Array]:
    """T of a ridge, and its pressure over that of the half-space, on LINES."""
    point, oil = OperatingPoint.from_settings(settings), Lubricant.from_settings(settings)
    smooth = solve_contact(settings)
    zone, moes = zone_of(smooth, point, oil), circle_of(smooth, point, oil)
    ky = np.array([2.0 * np.pi / wavelength])
    kx, across = 0.0 * ky, 0.0 * LINES
    ((driven, free),) = transport(zone, kx, ky, 1.0, np.zeros(1))
    inlet = inlet_transfer(zone, kx, ky, moes, 1.0, LINES)
    t, beside = driven + free * inlet, free * (inlet - inlet[AXIS])
    given = stiffness(ky) * (1.0 - t[AXIS]) - line_pressure(beside, kx, ky, 1.0, zone.ellipticity)
    edge = EllipseEdge(point.ellipse)
    functions = edge.functions(across, LINES).T

    def of_edge(q: Array, flattened: Complex) -> Complex:
        long = 1e-9 < abs(q[0]) < edge.largest
        return functions @ edge.correction(kx, q) * flattened if long else np.zeros_like(given)

    given += of_edge(ky, 1.0 - t[AXIS]) / zone.stiffness
    for k, part in zip(*harmonics(beside), strict=True):
        given -= of_edge(ky + k / zone.ellipticity, part) / zone.stiffness
    return t.real[:, 0], (given / (stiffness(ky) * (1.0 - t))).real[:, 0]


def main() -> None:
    """Solve all ridges."""
    place = np.arange(PIXELS) / PIXELS
    # symmetric to the last bit
    line = AMPLITUDE * np.cos(2.0 * np.pi * np.minimum(place, 1.0 - place))
    lines = [COLUMNS]
    for *contact, wavelengths in CONTACTS:
        settings = case_of_circle(*contact, 1.0).resolve()
        point = OperatingPoint.from_settings(settings)

        y, film, pressure = fields(settings, 1.0, None)
        for wavelength in wavelengths:
            heights = np.tile(wavelength * point.film_scale * line, (8, 1))
            _, h, p = fields(settings, wavelength, heights)
            height = AMPLITUDE * wavelength
            k = float(stiffness(2.0 * np.pi / wavelength)) / point.ellipse.kernel_ratio
            estimate = predicted(settings, wavelength)
            sign, at = 1.0, 0.0
            while at <= REACH * contact[0]:
                j = int(np.argmin(np.abs(y - at)))
                t = sign * (film[j] - h[j]) / height
                gain = sign * (p[j] - pressure[j]) / height / k / (1.0 - t)
                there = (np.interp(at / contact[0], LINES, values) for values in estimate)
                values = (*contact, wavelength, at / contact[0], t, gain, *there)
                lines.append([f"{v:.4g}" for v in values])
                print(*lines[-1], flush=True)
                sign, at = -sign, at + 0.5 * wavelength
    with (HERE / "sides.csv").open("w", newline="", encoding="utf-8") as stream:
        csv.writer(stream, lineterminator="\n").writerows(lines)


if __name__ == "__main__":
    main()

# SPDX-License-Identifier: BSD-3-Clause
"""Measure small waves on elliptical contacts: rows of response.csv, some minutes each.

python docs/evidence/ellipse/response.py ELLIPTICITY M L U

M and L are those of the circular contact with the same inlet. Waves on 257 nodes along X; a line
has T at X = Y = 0 as measured, by the response of that circle, and by two other choices of M and L:
those of Biboulet & Houpert 2010, and M and L by R_x; and the pressure over that of the half-space.
"""

from __future__ import annotations

import csv
import sys

import numpy as np

from cases import HERE, radius_ratio
from pyehl.case import Case
from pyehl.measured_response.superposition import superpose
from pyehl.measured_response.tiers import TIERS, tier_waves
from pyehl.prediction.smooth import zone_on
from pyehl.theory.ellipse import ellipse
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.operating import OperatingPoint
from pyehl.theory.response import edge_gain, inlet_transfer
from pyehl.theory.transport import stiffness, transport

COLUMNS = (
    "ellipticity moes_m moes_l velocity_ratio wavelength direction T_re T_im circle_re circle_im "
    "houpert_re houpert_im by_rx_re by_rx_im pressure_ratio edge_gain"
).split()
NODES = 14


def main() -> None:
    """Measure, and add the waves to the table."""
    kappa, moes_m, moes_l, ratio = map(float, sys.argv[1:5])
    shape = ellipse(radius_ratio(kappa))
    kernel = shape.kernel_ratio
    case = Case(
        contact={
            "moes_m": moes_m * kappa / kernel**1.25,
            "moes_l": moes_l / kernel**0.25,
            "radius_ratio": shape.radius_ratio,
        },
        surface={"kind": "fractal", "velocity_ratio": ratio},
    )
    settings = case.resolve()
    point, oil = OperatingPoint.from_settings(settings), Lubricant.from_settings(settings)
    waves = tier_waves(TIERS[0])
    found = superpose(settings, waves, points=TIERS[0].points, velocity_ratio=ratio)
    zone = zone_on(found.x, np.maximum(found.pressure, 0.0), found.film, point, oil)
    middle = int(np.argmin(np.abs(found.x)))
    t = found.response[:, middle]
    kx, ky = waves.kx, waves.ky
    driven, free = transport(zone, kx, ky, ratio, np.zeros(1), found.spacing)[0]
    slip = np.exp(1j * kx * (ratio - 1.0))
    models = [
        driven + free * slip * inlet_transfer(zone, kx, ky, numbers, ratio)
        for numbers in (
            point.equivalent_moes,
            (point.moes_m * kernel**-0.25 / kappa, point.moes_l * kernel**0.75),
            (point.moes_m, point.moes_l),
        )
    ]
    cell = np.sinc(kx * found.spacing / (2.0 * np.pi)) * np.sinc(ky * found.spacing / (2.0 * np.pi))
    half_space = zone.stiffness * stiffness(waves.q) / cell * (1.0 - t)
    gain = edge_gain(kx, ky, zone.stiffness * found.central_film)
    lines = []
    for k in np.argsort(waves.q):
        wavelength = 2.0 * np.pi / waves.q[k]
        if wavelength < NODES * found.spacing * (1.0 - 1e-9) or kx[k] < 2.0 * np.pi / 3.0:
            continue
        values = [kappa, moes_m, moes_l, ratio, wavelength, np.degrees(np.arctan2(ky[k], kx[k]))]
        for one in (t, *models):
            values += [one[k].real, one[k].imag]
        values += [abs(found.stiffness[k, middle] / half_space[k]), gain[k]]
        lines.append([f"{v:.5g}" for v in values])
    path = HERE / "response.csv"
    fresh = not path.exists()
    with path.open("a", newline="", encoding="utf-8") as stream:
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerows([COLUMNS, *lines] if fresh else lines)


if __name__ == "__main__":
    main()

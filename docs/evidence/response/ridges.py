# SPDX-License-Identifier: BSD-3-Clause
"""Make ``ridges.csv`` anew: ridges along the motion by steady solutions, two minutes.

python docs/evidence/response/ridges.py ridges.csv
"""

from __future__ import annotations

import csv
import sys
from pathlib import Path

import numpy as np
from make import STATIONS, parts_of, settings_of

from pyehl.prediction.smooth import zone_on
from pyehl.studies.ridges import ridges
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.operating import OperatingPoint
from pyehl.theory.transport import stiffness

POINTS = 513
WAVELENGTHS = (2.0, 1.6, 1.0, 0.8, 0.5, 0.25, 0.125)
# Operating points (M, L): those of the waves, and some between them
POINTS_OF_RIDGES = tuple(
    (float(m), float(ell))
    for m, ells in {
        100: (3, 5, 8, 10, 20),
        150: (3, 5, 20),
        200: (5, 10),
        300: (12, 15, 18, 20),
        350: (12,),
        500: (5, 10, 15),
        700: (6, 7),
        900: (10,),
        1000: (3, 5, 10, 15, 20),
        1500: (4, 12),
        2000: (5, 10, 15),
        2500: (12,),
        3000: (3, 5, 10, 20),
    }.items()
    for ell in ells
)


def main(path: Path) -> None:
    """Solve all contacts and write the table."""
    with path.open("w", newline="", encoding="utf-8") as stream:
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow("moes_m moes_l points ky T driven free pressure_ratio".split())
        for m, ell in POINTS_OF_RIDGES:
            settings = settings_of(m, ell)
            found = ridges(settings, WAVELENGTHS, points=POINTS)
            centre = int(np.argmin(np.abs(found["x"])))
            ky = 2.0 * np.pi / np.array(WAVELENGTHS)
            operating = OperatingPoint.from_settings(settings)
            lubricant = Lubricant.from_settings(settings)
            pressure = np.maximum(found["pressure"], 0.0)
            zone = zone_on(found["x"], pressure, found["film"], operating, lubricant)
            parts = parts_of(zone, 0.0 * ky, ky, (m, ell), 1.0, float(found["spacing"]))
            there = parts[int(np.argmin(np.abs(STATIONS)))]
            t = found["response"][:, centre].real
            ratio = found["stiffness"][:, centre].real / (stiffness(ky) * (1.0 - t))
            for row in zip(ky, t, *(part.real for part in there), ratio, strict=True):
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

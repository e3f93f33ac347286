# SPDX-License-Identifier: BSD-3-Clause
"""Make ``ridges.csv`` anew: ridges along the motion by steady solutions, two minutes.

python docs/evidence/response/ridges.py ridges.csv
"""

from __future__ import annotations

import csv
import sys
from pathlib import Path

import numpy as np
from make import MIDDLE, parts_of, runs, settings_of

from pyehl.prediction.smooth import zone_on
from pyehl.studies.ridges import ridges
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.operating import OperatingPoint
from pyehl.theory.transport import stiffness

POINTS = 513
WAVELENGTHS = (2.0, 1.6, 1.0, 0.8, 0.5, 0.25, 0.125)
# Operating points (M, L) besides those of the waves
BETWEEN = {(300.0, 15.0), (700.0, 6.0), (900.0, 10.0)}


def main(path: Path) -> None:
    """Solve all contacts and write the table."""
    with path.open("w", newline="", encoding="utf-8") as stream:
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow("moes_m moes_l points ky T driven free pressure_ratio".split())
        for m, ell in sorted(BETWEEN | {run[:2] for run in runs()}):
            settings = settings_of(m, ell)
            found = ridges(settings, WAVELENGTHS, points=POINTS)
            centre = int(np.argmin(np.abs(found["x"])))
            ky = 2.0 * np.pi / np.array(WAVELENGTHS)
            operating = OperatingPoint.from_settings(settings)
            lubricant = Lubricant.from_settings(settings)
            pressure = np.maximum(found["pressure"], 0.0)
            zone = zone_on(found["x"], pressure, found["film"], operating, lubricant)
            parts = parts_of(zone, 0.0 * ky, ky, (m, ell), 1.0, float(found["spacing"]))
            t = found["response"][:, centre].real
            ratio = found["stiffness"][:, centre].real / (stiffness(ky) * (1.0 - t))
            for row in zip(ky, t, *(part.real for part in parts[MIDDLE]), ratio, strict=True):
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

# SPDX-License-Identifier: BSD-3-Clause
"""Make ``ridges.csv`` anew: ridges along the motion by steady solutions, a minute.

python docs/evidence/response/ridges.py ridges.csv
"""

from __future__ import annotations

import csv
import sys
from pathlib import Path

import numpy as np
from make import settings_of

from pyehl.prediction.smooth import zone_on
from pyehl.studies.ridges import ridges
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.operating import OperatingPoint
from pyehl.theory.transport import stiffness, transport

POINTS = 257
LONG = (4.0, 2.0, 1.6, 1.0)
# Wavelengths [a] at (M, L)
RUNS = {
    (200.0, 10.0): LONG,
    **{point: (*LONG, 0.8, 0.5, 0.25) for point in ((500.0, 5.0), (1000.0, 10.0), (2000.0, 15.0))},
}


def main(path: Path) -> None:
    """Solve all contacts and write the table."""
    with path.open("w", newline="", encoding="utf-8") as stream:
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow("moes_m moes_l points ky T driven free pressure_ratio".split())
        for (m, ell), wavelengths in RUNS.items():
            settings = settings_of(m, ell)
            found = ridges(settings, wavelengths, points=POINTS)
            centre = int(np.argmin(np.abs(found["x"])))
            ky = 2.0 * np.pi / np.array(wavelengths)
            operating = OperatingPoint.from_settings(settings)
            lubricant = Lubricant.from_settings(settings)
            pressure = np.maximum(found["pressure"], 0.0)
            zone = zone_on(found["x"], pressure, found["film"], operating, lubricant)
            parts = transport(zone, 0.0 * ky, ky, 1.0, np.array([0.0]), float(found["spacing"]))
            t = found["response"][:, centre].real
            ratio = found["stiffness"][:, centre].real / (stiffness(ky) * (1.0 - t))
            for row in zip(ky, t, *(part.real for part in parts[0]), ratio, strict=True):
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

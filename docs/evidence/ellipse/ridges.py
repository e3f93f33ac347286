# SPDX-License-Identifier: BSD-3-Clause
"""Static ridges along the motion on ellipses, at X = Y = 0, and their prediction: ridges.csv.

python docs/evidence/ellipse/ridges.py

Film and pressure by docs/evidence/response/ridges.py, on 129 nodes along X; M and L are those of
the circular contact with the same dry inlet.
"""

from __future__ import annotations

import csv
import sys

import numpy as np
from centre import at_centre

from cases import HERE, case_of_circle
from pyehl.contact.smooth import circle_of, solve_contact, zone_of
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.operating import OperatingPoint

POINTS = 129
WAVELENGTHS = (1.0, 0.5, 1.0 / 3.0, 0.25)
CONTACTS = (
    (0.4, 500.0, 10.0),
    (0.5, 300.0, 12.0),
    (0.6, 250.0, 8.0),
    (1.0, 500.0, 10.0),
    (2.0, 500.0, 10.0),
)
COLUMNS = "ellipticity moes_m moes_l wavelength T predicted_T pressure predicted_pressure".split()


def main() -> None:
    """Solve and predict all ridges."""
    sys.path.insert(0, str(HERE.parent / "response"))
    from ridges import ridges  # noqa: PLC0415 (the one of that folder)

    lines = [COLUMNS]
    ky = 2.0 * np.pi / np.array(WAVELENGTHS)
    for contact in CONTACTS:
        settings = case_of_circle(*contact, 1.0).resolve()
        point, oil = OperatingPoint.from_settings(settings), Lubricant.from_settings(settings)
        result = ridges(settings, WAVELENGTHS, points=POINTS)
        middle = int(np.argmin(np.abs(result["x"])))
        smooth = solve_contact(settings)
        zone = zone_of(smooth, point, oil)
        moes = circle_of(smooth, point, oil)
        t, pressure = at_centre(zone, moes, (0.0 * ky, ky, 1.0), point.ellipse, edge=True)
        response, stiffness = (result[name][:, middle] for name in ("response", "stiffness"))
        columns = response, t.real, stiffness, pressure.real
        for values in zip(WAVELENGTHS, *columns, strict=True):
            lines.append([f"{v:.4g}" for v in (*contact, *values)])
            print(*lines[-1], flush=True)
    with (HERE / "ridges.csv").open("w", newline="", encoding="utf-8") as stream:
        csv.writer(stream, lineterminator="\n").writerows(lines)


if __name__ == "__main__":
    main()

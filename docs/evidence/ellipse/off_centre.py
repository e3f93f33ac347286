# SPDX-License-Identifier: BSD-3-Clause
"""Compare how the inlet transfer falls off the centre line of ellipses with off_centre.csv.

python docs/evidence/ellipse/off_centre.py

The table has modulus and phase of G exp(-i k (U - 1) (1 - y^2)^(1/2)), G as in pyehl/theory/
response.py, of waves with crests across the motion at (M, L) = (500, 10) of the circle with the
same dry inlet, U = 1.02, on 257 nodes along X, at four distances y [semi-axis] from the centre
line. Nothing of the response is fitted to it. It was measured with version 0.1.0; no script makes
it anew.
"""

from __future__ import annotations

import csv

import numpy as np

from cases import HERE, case_of_circle
from pyehl.theory.operating import OperatingPoint
from pyehl.theory.response import inlet_fit

RATIO = 1.02


def main() -> None:
    """Print the deviation of G over its value on the centre line, by ellipticity and line."""
    with (HERE / "off_centre.csv").open(encoding="utf-8") as stream:
        rows = [{k: float(v) for k, v in row.items()} for row in csv.DictReader(stream)]
    for kappa in sorted({row["ellipticity"] for row in rows}):
        settings = case_of_circle(kappa, 500.0, 10.0, RATIO).resolve()
        moes = OperatingPoint.from_settings(settings).equivalent_moes
        part = [row for row in rows if row["ellipticity"] == kappa]
        middles = {row["kx"]: row for row in part if row["y"] == 0.0}
        off: dict[float, list[complex]] = {}
        for row in (row for row in part if row["y"] > 0.0):
            k, middle = row["kx"], middles[row["kx"]]
            turn = np.exp(1j * np.radians(middle["lag"] - row["lag"]))
            there, here = (
                complex(inlet_fit(k, 0.0, moes, RATIO, y, kappa)) for y in (row["y"], 0.0)
            )
            measured = row["modulus"] / middle["modulus"] * turn
            off.setdefault(row["y"], []).append(there / here - measured)
        for y, values in off.items():
            rms = np.sqrt(np.mean(np.square(np.abs(values))))
            print(f"ellipticity {kappa:g}, y = {y:.3g}: rms {rms:.3f}")


if __name__ == "__main__":
    main()

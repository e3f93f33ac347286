# SPDX-License-Identifier: BSD-3-Clause
"""Fit how the inlet transfer falls off the centre line of ellipses to off_centre.csv.

python docs/evidence/ellipse/off_centre.py

The table has modulus and phase of G exp(-i k (U - 1) (1 - y^2)^(1/2)), G as in pyehl/theory/
response.py, of waves with crests across the motion at (M, L) = (500, 10) of the circle with the
same dry inlet, U = 1.02, on 257 nodes along X, at four distances y [semi-axis] from the centre
line. ln |z| grows as c y^2: c by ellipticity is printed, beside the constants `OBLIQUE`.
"""

from __future__ import annotations

import csv

import numpy as np
from scipy.optimize import least_squares

from cases import HERE, case_of_circle
from pyehl.theory.operating import OperatingPoint
from pyehl.theory.response import OBLIQUE, inlet_fit

ROUND = 1.27


def main() -> None:
    """Find c of every wave, and the power law through the means."""
    with (HERE / "off_centre.csv").open(encoding="utf-8") as stream:
        rows = [{k: float(v) for k, v in row.items()} for row in csv.DictReader(stream)]
    kappas = sorted({row["ellipticity"] for row in rows})
    growths = []
    for kappa in kappas:
        settings = case_of_circle(kappa, 500.0, 10.0, 1.02).resolve()
        moes = OperatingPoint.from_settings(settings).equivalent_moes
        found = []
        part = [row for row in rows if row["ellipticity"] == kappa]
        for middle in (row for row in part if row["y"] == 0.0):
            z = 1.0 / complex(inlet_fit(middle["kx"], 0.0, moes, 1.02)) - 1.0
            for row in part:
                if row["kx"] == middle["kx"] and row["y"] > 0.0:
                    turn = np.exp(1j * np.radians(middle["lag"] - row["lag"]))
                    there = middle["modulus"] / row["modulus"] * turn * (1.0 + z) - 1.0
                    found.append(np.log(abs(there / z)) / row["y"] ** 2)
        growths.append(float(np.median(found)))
        print(f"ellipticity {kappa:g}: c = {growths[-1]:.2f}")
    places = np.array(kappas)
    fit = least_squares(
        lambda p: ROUND + p[0] * (places ** p[1] - 1.0) - np.array(growths), [2.0, -1.0]
    )
    print(f"{ROUND} + f (kappa^p - 1): f, p = {fit.x[0]:.2f}, {fit.x[1]:.2f}, used {OBLIQUE}")


if __name__ == "__main__":
    main()

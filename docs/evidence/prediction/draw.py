# SPDX-License-Identifier: BSD-3-Clause
"""Draw the cases n01 to n14 and predict them: python docs/evidence/prediction/draw.py.

Writes committed.csv: random operating points and surfaces, with the prediction made before their
simulation. Waves below a/16 are cut off, so that 513 x 513 nodes resolve all.
"""

from __future__ import annotations

import csv
from typing import Any

import numpy as np

from cases import HERE, case, surface
from pyehl.contact.smooth import solve_contact
from pyehl.prediction.friction import run
from pyehl.prediction.model import Model, ModelOptions, model_error
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.operating import OperatingPoint

SEED, CASES = 20261, 14
MODULUS, RADIUS, VISCOSITY, ALPHA = 2.26e11, 0.018, 0.04, 2.2e-8
COLUMNS = (
    "name moes_m moes_l load mean_velocity velocity_ratio length pixels rms_height hurst "
    "rolloff_wavenumber shortest_wavelength seed prediction model_error"
).split()


def predicted(row: dict[str, Any]) -> float:
    """mu_r/mu_s of a row by the response."""
    settings = case(row).resolve()
    operating, oil = OperatingPoint.from_settings(settings), Lubricant.from_settings(settings)
    contact = solve_contact(settings)
    of = contact, operating, oil, ModelOptions(), row["velocity_ratio"]
    return float(run(Model.of_one(surface(row), *of), 0, brief=True).friction.mu_ratio)


def drawn(number: int, random: np.random.Generator) -> dict[str, Any]:
    """Draw a case, with the rms height that a prediction near a random ratio needs."""
    moes_m = float(120.0 * (2500.0 / 120.0) ** random.random())
    moes_l = float(random.uniform(4.0, 16.0))
    speed = (moes_l / (ALPHA * MODULUS)) ** 4 / 2.0
    load = moes_m * (2.0 * speed) ** 0.75 * MODULUS * RADIUS**2
    hertz = (1.5 * load * RADIUS / MODULUS) ** (1.0 / 3.0)
    goal = float(1.05 * (2.4 / 1.05) ** random.random())
    film = 1.7 * moes_m ** (-1.0 / 9.0) * moes_l**0.75 * (2.0 * speed) ** 0.5 * RADIUS
    row = {
        "name": f"n{number:02d}",
        "moes_m": moes_m,
        "moes_l": moes_l,
        "load": load,
        "mean_velocity": speed * MODULUS * RADIUS / VISCOSITY,
        "velocity_ratio": float(random.uniform(0.85, 1.15)),
        "length": hertz * float(random.uniform(1.0, 2.0)),
        "pixels": 256,
        "rms_height": 0.1 * film,
        "hurst": float(random.uniform(0.6, 1.0)),
        "rolloff_wavenumber": 0.0,
        "shortest_wavelength": hertz / 16.0,
        "seed": 100 + number,
        "points": 513.0,
    }
    for _ in range(6):
        ratio = predicted(row)
        # the increase is of second order in the height
        row["rms_height"] *= min(2.0, max(0.5, ((goal - 1.0) / max(ratio - 1.0, 0.01)) ** 0.4))
    return {k: float(f"{v:.6g}") if isinstance(v, float) else v for k, v in row.items()}


def main() -> None:
    """Draw, predict, write."""
    random = np.random.default_rng(SEED)
    with (HERE / "committed.csv").open("w", encoding="utf-8", newline="") as stream:
        writer = csv.DictWriter(stream, COLUMNS, extrasaction="ignore", lineterminator="\n")
        writer.writeheader()
        for number in range(1, CASES + 1):
            row = drawn(number, random)
            row["prediction"] = round(predicted(row), 5)
            row["model_error"] = round(model_error(row["prediction"]), 5)
            writer.writerow(row)
            print(row["name"], row["prediction"], flush=True)


if __name__ == "__main__":
    main()

# SPDX-License-Identifier: BSD-3-Clause
"""Draw the cases r01 to r10 of cases.csv: python docs/evidence/ellipse/draw.py.

Ellipticity, operating point and surface are drawn at random; the rms height is adjusted so that the
prediction is near a random ratio. All waves are longer than a/16, so that the grid resolves them.
"""

from __future__ import annotations

import csv
from typing import Any

import numpy as np
from compare import prediction

from cases import HERE, radius_ratio
from pyehl.theory.ellipse import ellipse

SEED, CASES = 20263, 10


def drawn(number: int, random: np.random.Generator) -> dict[str, Any]:
    """Draw a case, with M and L of the circle with the same dry inlet, and cells of 1/128 a."""
    kappa = float(0.4 * 10.0 ** random.random())
    ratio = radius_ratio(kappa)
    kernel = ellipse(ratio).kernel_ratio
    moes_m = float(150.0 * 10.0 ** random.random())
    moes_l = float(random.uniform(6.0, 15.0))
    extent = round(max(1.5, kappa + 1.0) * 4.0) / 4.0
    goal = float(1.05 * (2.3 / 1.05) ** random.random())
    row = {
        "name": f"r{number:02d}",
        "radius_ratio": ratio,
        "ellipticity": kappa,
        "moes_m": moes_m * kappa / kernel**1.25,
        "moes_l": moes_l / kernel**0.25,
        "velocity_ratio": float(random.uniform(0.9, 1.1)),
        "length_x": 1.0,
        "length_y": float(random.choice([1.0, 1.5])),
        "pixels_x": 96,
        "pixels_y": 0,
        "rms_height": 3e-3,
        "hurst": float(random.uniform(0.6, 1.0)),
        "rolloff_wavelength": 0.0,
        "shortest_wavelength": float(random.choice([0.0625, 0.125])),
        "seed": 400 + number,
        "points": 513,
        "points_y": round(2.0 * extent * 128.0) + 1,
        "y_extent": extent,
    }
    row["pixels_y"] = round(96 * row["length_y"])
    for _ in range(8):
        result = prediction(row)
        # the increase is of second order in the height
        row["rms_height"] *= min(2.0, max(0.5, ((goal - 1.0) / max(result - 1.0, 0.01)) ** 0.4))
    return {k: float(f"{v:.5g}") if isinstance(v, float) else v for k, v in row.items()}


def main() -> None:
    """Draw and add to the table."""
    random = np.random.default_rng(SEED)
    with (HERE / "cases.csv").open("a", newline="", encoding="utf-8") as stream:
        for number in range(1, CASES + 1):
            row = drawn(number, random)
            csv.writer(stream, lineterminator="\n").writerow(
                f"{v:g}" if isinstance(v, float) else v for v in row.values()
            )
            print(*row.values(), flush=True)


if __name__ == "__main__":
    main()

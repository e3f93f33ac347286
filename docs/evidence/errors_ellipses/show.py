# SPDX-License-Identifier: BSD-3-Clause
"""Evaluation of the tables of this folder."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE.parent))


Row = dict[str, Any]


def cells(rows: list[Row], point: tuple[float, float]) -> dict[float, tuple[float, float]]:
    """Nodes and error of H_c on 129 nodes along the motion, by the shape of the cells.

    The limit is that of the finest cells of all, by Richardson.
    """
    here = [r for r in rows if (r["kappa"], r["moes_m"]) == point and r["H_c"]]
    sides = 2.0 * max(1.0, point[0])
    films = {(r["points"], r["points_y"]): r["H_c"] for r in here}
    pairs = [n for n in sorted(films) if (0.5 * (n[0] + 1), 0.5 * (n[1] + 1)) in films]
    if not pairs:
        return {}
    fine, coarse = films[pairs[-1]], films[0.5 * (pairs[-1][0] + 1), 0.5 * (pairs[-1][1] + 1)]
    limit = (4.0 * fine - coarse) / 3.0
    return {
        sides / (r["points_y"] - 1) * 64.0: (
            r["points"] * r["points_y"],
            abs(r["H_c"] / limit - 1.0),
        )
        for r in here
        if r["points"] == 129
    }


def over_estimate(rows: list[Row], ratio: float) -> tuple[list[float], list[float]]:
    """Give true errors of H_c and H_min over the a-priori ones (fortran/contact/grid_error.f90).

    For narrow contacts on cells of a `ratio` of the lengths across and along the motion.
    """
    result: tuple[list[float], list[float]] = [], []
    narrow = [row for row in rows if row["kappa"] < 1.0 and row["ratio"] == ratio]
    for row in narrow:
        finer = [
            other
            for other in narrow
            if (other["kappa"], other["moes_m"]) == (row["kappa"], row["moes_m"])
            and other["points"] == 2 * row["points"] - 1
            and other["points_y"] == 2 * row["points_y"] - 1
        ]
        if not finer or "converged" not in row["status"] or not finer[0]["H_c"]:
            continue
        square = row["kappa"] ** 2
        rough = 0.16 * row["moes_m"] * (4.0 / (row["points"] - 1)) ** 2
        stated = (1.0 + 0.05 * (1.0 / square - 1.0), 2.0 * max(1.0, 0.3 / square))
        for name, factor, ratios in zip(("H_c", "H_min"), stated, result, strict=True):
            limit = (4.0 * finer[0][name] - row[name]) / 3.0
            ratios.append(abs(row[name] / limit - 1.0) / (rough * factor))
    return result

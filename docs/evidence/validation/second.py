# SPDX-License-Identifier: BSD-3-Clause
"""Films of ellipses by the second solver, the C program, and pyehl on the same cells.

python docs/evidence/validation/second.py CELLS KAPPA ...    appends to second.csv: cells of a/CELLS
"""

from __future__ import annotations

import csv
import sys
from pathlib import Path

import numpy as np

import pyehl

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[2]
TABLE = HERE / "second.csv"
ROWS = ROOT / "tests" / "cases" / "smooth_ellipses.csv"
COLUMNS = ("moes_m", "moes_l", "kappa", "y_extent", "cells", "quantity", "second", "ours", "c")


def ours(row: dict[str, str], cells: int) -> dict[str, float]:
    """Solve a row to a small algebraic error, on domain and cells of the second solver."""
    side = float(row["y_extent"])
    changes = {
        "contact.moes_m": float(row["moes_m"]),
        "contact.moes_l": float(row["moes_l"]),
        "contact.radius_ratio": float(row["radius_ratio"]),
        "lubricant.roelands_z": 0.6684,
        "grid.x_inlet": -2.5,
        "grid.x_outlet": 1.5,
        "grid.y_extent": side,
        "grid.points": 4 * cells + 1,
        "grid.points_y": round(2 * side * cells) + 1,
        "grid.border": "zero",
        "solver.deflection": "fft",
        "solver.accuracy": 1e-4,
    }
    result = pyehl.solve(pyehl.Case(), changes)
    return {name: float(result[name]) for name in ("H_c", "H_min")}


def main() -> None:
    """Solve the rows of the C program with a mesh of a/32, on cells of a/CELLS."""
    sys.path.insert(0, str(ROOT / "tests" / "cases"))
    from second_solver import SecondSolver  # noqa: PLC0415 (a file of the tests)

    with ROWS.open(encoding="utf-8", newline="") as stream:
        table = list(csv.DictReader(line for line in stream if line[0] != "#"))
    with TABLE.open("a", encoding="utf-8", newline="") as stream:
        writer = csv.DictWriter(stream, COLUMNS, extrasaction="ignore", lineterminator="\n")
        if not stream.tell():
            writer.writeheader()
        cells, wanted = int(sys.argv[1]), sys.argv[2:]
        for row in table:
            if row["cells"] == "32" and row["kappa"] in wanted:
                point = float(row["moes_m"]), float(row["moes_l"])
                shape = {"kappa": float(row["kappa"]), "side": float(row["y_extent"])}
                second = SecondSolver(*point, 4 * cells + 1, **shape)
                p, _, film = second.smooth()
                result = ours(row, cells)
                films = film[np.argmin(second.x**2 + second.y**2)], film[p > 0.0].min()
                for name, value in zip(("H_c", "H_min"), films, strict=True):
                    given = row[name] if cells == 32 else ""
                    made = {"quantity": name, "second": f"{value:.6g}", "c": given}
                    made |= {"ours": f"{result[name]:.6g}", "cells": str(cells)}
                    writer.writerow(row | made)
                    stream.flush()


if __name__ == "__main__":
    main()

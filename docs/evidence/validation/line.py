# SPDX-License-Identifier: BSD-3-Clause
"""Films of the line M = 100, L = 10 on -4 <= X <= 1.5, by pyehl and by tests/cases/line_newton.py.

python docs/evidence/validation/line.py writes line.csv.
"""

import csv
import sys
from pathlib import Path

import pyehl

HERE = Path(__file__).resolve().parent
TABLE = HERE / "line.csv"
DOMAIN = (-4.0, 1.5)
NODES = (257, 513, 1025, 2049, 4097)
INTERVALS = (110, 220, 440, 256, 512, 1024, 2048)


def ours(nodes: int) -> tuple[float, float]:
    """Solve to a small algebraic error, with P = 0 at both ends."""
    changes = {
        "contact.shape": "line",
        "contact.moes_m_line": 100,
        "contact.moes_l_line": 10,
        "lubricant.roelands_z": 0.68,
        "grid.points": nodes,
        "grid.x_inlet": DOMAIN[0],
        "grid.x_outlet": DOMAIN[1],
        "grid.border": "zero",
        "solver.accuracy": 0.01,
    }
    result = pyehl.solve(pyehl.Case(), changes)
    return float(result.H_c), float(result.H_min)


def main() -> None:
    """Solve on all meshes."""
    sys.path.insert(0, str(HERE.parents[2] / "tests" / "cases"))
    import line_newton  # noqa: PLC0415 (a file of the tests)

    with TABLE.open("w", encoding="utf-8", newline="") as stream:
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow(("solver", "intervals", "H_c", "H_min"))
        runs = [("pyehl", n - 1, ours(n)) for n in NODES]
        runs += [
            ("newton", n, line_newton.solve(100.0, 10.0, n, 0.0135, DOMAIN)) for n in INTERVALS
        ]
        for solver, intervals, films in runs:
            writer.writerow((solver, intervals, *(f"{film:.7f}" for film in films)))


if __name__ == "__main__":
    main()

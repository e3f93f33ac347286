# SPDX-License-Identifier: BSD-3-Clause
"""Simulate the rows of cases.csv that simulated.csv does not have, up to several minutes each.

python docs/evidence/partial/make.py [NAME ...]
"""

from __future__ import annotations

import csv
import sys

from cases import HERE, case, rows
from pyehl.solver import Solver

COLUMNS = (
    "contact_load_share",
    "contact_load_share_error_grid",
    "contact_area_share",
    "mass_defect",
    "mu",
    "mu_smooth",
    "mu_ratio_error",
    "h_min_rough_m",
    "moes_m",
    "moes_l",
    "h_c_m",
    "wall_seconds",
)


def main() -> None:
    """Simulate and add to the file row by row."""
    output, names = HERE / "simulated.csv", sys.argv[1:]
    done: set[str] = set()
    if output.is_file():
        with output.open(encoding="utf-8") as stream:
            done = {row["name"] for row in csv.DictReader(stream)}
    for row in rows():
        if row["name"] in done or (names and row["name"] not in names):
            continue
        with Solver(case(row)) as solver:
            solver.run()
            summary = solver.summary
        new = not output.is_file()
        with output.open("a", newline="", encoding="utf-8") as stream:
            writer = csv.writer(stream, lineterminator="\n")
            if new:
                writer.writerow(["name", "status", *COLUMNS])
            values = [summary.get(name) for name in COLUMNS]
            written = ["" if v is None else f"{v:.6g}" for v in values]
            writer.writerow([row["name"], summary["status"], *written])
        print(row["name"], summary["status"], *written, flush=True)


if __name__ == "__main__":
    main()

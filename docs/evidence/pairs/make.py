# SPDX-License-Identifier: BSD-3-Clause
"""Simulate rows of cases.csv, a few minutes each on one core, and add them to simulated.csv.

python docs/evidence/pairs/make.py [NAME ...] [--points N] [--output FILE]

Without names: all rows that the file does not have.
"""

from __future__ import annotations

import argparse
import csv
from pathlib import Path

from cases import HERE, case, rows, surfaces
from pyehl.solver import Solver

COLUMNS = (
    "mu_ratio",
    "mu_ratio_error_grid",
    "mu_ratio_error_stop",
    "mu_ratio_error_window",
    "mu_ratio_error_left_out",
    "T_period",
    "T_mismatch",
    "surface_rms_m",
    "H_min_rough",
)


def main() -> None:
    """Simulate and add to the file row by row."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("names", nargs="*")
    parser.add_argument("--points", type=int, default=513, help="nodes along the motion")
    parser.add_argument("--output", type=Path, default=HERE / "simulated.csv")
    arguments = parser.parse_args()
    done: set[str] = set()
    if arguments.output.is_file():
        with arguments.output.open(encoding="utf-8") as stream:
            done = {row["name"] for row in csv.DictReader(stream)}
    for row in rows():
        if row["name"] in done or (arguments.names and row["name"] not in arguments.names):
            continue
        with Solver(case(row, arguments.points), **surfaces(row)) as solver:
            solver.run()
            summary = solver.summary
        new = not arguments.output.is_file()
        with arguments.output.open("a", newline="", encoding="utf-8") as stream:
            writer = csv.writer(stream, lineterminator="\n")
            if new:
                writer.writerow(["name", "points", "status", *COLUMNS])
            values = [summary.get(name) for name in COLUMNS]
            written = ["" if v is None else f"{v:.6g}" for v in values]
            writer.writerow([row["name"], arguments.points, summary["status"], *written])
        print(row["name"], summary["status"], summary["mu_ratio"], flush=True)


if __name__ == "__main__":
    main()

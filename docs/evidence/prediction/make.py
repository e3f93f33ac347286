# SPDX-License-Identifier: BSD-3-Clause
"""Simulate rows of cases.csv again, two to five minutes each on one core.

python docs/evidence/prediction/make.py NAME ... [--points N]
"""

from __future__ import annotations

import argparse

from cases import case, rows, surface
from pyehl.solver import solver_on_heights


def main() -> None:
    """Simulate, and print the results beside those of the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("names", nargs="+")
    parser.add_argument("--points", type=int, help="nodes per side in place of those of the table")
    arguments = parser.parse_args()
    for row in rows():
        if row["name"] not in arguments.names:
            continue
        row["points"] = arguments.points or row["points"]
        with solver_on_heights(case(row), {"surface": surface(row).heights}) as solver:
            solver.run()
            summary = solver.summary
        print(
            row["name"],
            summary["status"],
            summary["mu_ratio"],
            # without the error from omitted waves, as in the table
            summary["mu_ratio_error_grid"],
            summary["mu_ratio_error_stop"],
            "table, 513 x 513 nodes:",
            row["mu_ratio"],
            row["mu_ratio_error"],
            flush=True,
        )


if __name__ == "__main__":
    main()

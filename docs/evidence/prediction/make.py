# SPDX-License-Identifier: BSD-3-Clause
"""Simulate rows of cases.csv anew, two to five minutes each on one core.

python docs/evidence/prediction/make.py NAME ...
"""

from __future__ import annotations

import sys

from cases import case, rows, surface
from pyehl.solver import Solver


def main(names: list[str]) -> None:
    """Simulate and print beside what stands in the table."""
    for row in rows():
        if row["name"] in names:
            with Solver.open(case(row), surface(row).heights) as solver:
                solver.run()
                summary = solver.summary()
            print(
                row["name"],
                summary["status"],
                summary["mu_ratio"],
                summary["mu_ratio_error"],
                "table:",
                row["mu_ratio"],
                row["mu_ratio_error"],
                flush=True,
            )


if __name__ == "__main__":
    main(sys.argv[1:])

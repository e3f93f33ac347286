# SPDX-License-Identifier: BSD-3-Clause
"""Simulate the cases that simulated.csv does not have, several minutes each on one core.

python docs/evidence/ellipse/make.py [--points N] [NAME ...]

Results with another number of nodes along X, `--points`, go to coarse.csv, or to fine.csv if it is
larger than that of cases.csv.
"""

from __future__ import annotations

import argparse
import csv

from cases import HERE, case, read, surface
from pyehl.solver import solver_on_heights

COLUMNS = ("name status mu_ratio mu_ratio_error_grid mu_ratio_error_stop H_c steps").split()


def main() -> None:
    """Simulate, one line of the table after the other."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("names", nargs="*")
    parser.add_argument("--points", type=int, default=0)
    arguments = parser.parse_args()
    for row in read("cases.csv"):
        other = "fine.csv" if arguments.points > row["points"] else "coarse.csv"
        path = HERE / (other if arguments.points else "simulated.csv")
        if not path.exists():
            path.write_text(",".join(COLUMNS) + "\n", encoding="utf-8")
        done = {line["name"] for line in read(path.name)}
        if row["name"] in done or (arguments.names and row["name"] not in arguments.names):
            continue
        heights = {"surface": surface(row).heights}
        with solver_on_heights(case(row, arguments.points), heights) as solver:
            solver.run()
            summary = solver.summary | {"name": row["name"]}
        values = [summary.get(name) for name in COLUMNS]
        with path.open("a", newline="", encoding="utf-8") as stream:
            csv.writer(stream, lineterminator="\n").writerow(
                [f"{v:.6g}" if isinstance(v, float) else v for v in values]
            )
        print(*values, flush=True)


if __name__ == "__main__":
    main()

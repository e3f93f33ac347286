# SPDX-License-Identifier: BSD-3-Clause
"""Stress below predicted rough contacts beside that below simulated ones: table.csv.

    python docs/evidence/subsurface/compare.py NAME ... [--points N]    simulates and adds rows
    python docs/evidence/subsurface/compare.py                          prints the table

NAME is a row of docs/evidence/thinning/rough.py. The frames of the last period are compared with
the positions of the prediction, without friction. About a minute each on 257 x 257 nodes.
"""

from __future__ import annotations

import argparse
import csv
import sys
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "thinning"))

import rough  # noqa: E402

import pyehl  # noqa: E402

# Depth of the near-surface layer over that of the largest smooth shear, and frames of a period
NEAR, FRAMES = 0.25, 24
COLUMNS = (
    "name points near_simulated near_predicted near_smooth largest_simulated largest_predicted "
    "largest_smooth depth_simulated depth_predicted"
).split()


def near(data: xr.Dataset, name: str) -> float:
    """Largest value [p_h] of a profile within the near-surface layer."""
    depth = NEAR * float(data.principal_shear_max_smooth_depth)
    return float(np.interp(np.linspace(0.0, depth, 200), data.Z, data[name]).max())


def row_of(name: str, points: int) -> dict[str, Any]:
    """Simulate and predict."""
    plan = rough.PLAN[name]
    period = plan.length / plan.velocity_ratio
    case = rough.case_of(plan, points).with_options(f"output.frame_interval={period / FRAMES!r}")
    solved = pyehl.solve(case, check=False)
    last = solved.isel(T=np.flatnonzero(solved.T > float(solved.T[-1]) - period))
    simulated = pyehl.stress(last, friction="none")
    predicted = pyehl.stress(pyehl.predict(case), friction="none")
    return {
        "name": name,
        "points": points,
        "near_simulated": near(simulated, "principal_shear"),
        "near_predicted": near(predicted, "principal_shear"),
        "near_smooth": near(simulated, "principal_shear_smooth"),
        "largest_simulated": float(simulated.principal_shear_max),
        "largest_predicted": float(predicted.principal_shear_max),
        "largest_smooth": float(simulated.principal_shear_max_smooth),
        "depth_simulated": float(simulated.principal_shear_max_depth),
        "depth_predicted": float(predicted.principal_shear_max_depth),
    }


def rows() -> list[dict[str, str]]:
    """Read the table."""
    path = HERE / "table.csv"
    if not path.is_file():
        return []
    with path.open(newline="", encoding="utf-8") as stream:
        return list(csv.DictReader(stream))


def main() -> None:
    """Add rows, or print them."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("names", nargs="*", choices=[[], *rough.PLAN], metavar="NAME")
    parser.add_argument("--points", type=int, default=257)
    args = parser.parse_args()
    for name in args.names:
        new = {k: v if k == "name" else f"{v:.5g}" for k, v in row_of(name, args.points).items()}
        kept = [r for r in rows() if (r["name"], r["points"]) != (name, new["points"])]
        with (HERE / "table.csv").open("w", newline="", encoding="utf-8") as stream:
            writer = csv.DictWriter(stream, COLUMNS, lineterminator="\n")
            writer.writeheader()
            writer.writerows([*kept, new])
    for row in rows():
        ratio = float(row["near_predicted"]) / float(row["near_simulated"])
        print(*(row[c] for c in COLUMNS), f"near predicted/simulated {ratio:.3f}")


if __name__ == "__main__":
    main()

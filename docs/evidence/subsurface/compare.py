# SPDX-License-Identifier: BSD-3-Clause
"""Stress below predicted and below simulated rough contacts: table.csv.

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
from pyehl.theory.operating import OperatingPoint  # noqa: E402

# Frames of a period, depth of the near-surface layer and depths of the profiles [a]
FRAMES, NEAR = 24, 0.12
DEPTHS = (0.012, 0.02, 0.035, 0.06, 0.09, 0.12, 0.36, 0.43, 0.5, 0.6)
COLUMNS = (
    "name points near_simulated near_predicted near_error near_smooth inner_simulated "
    "inner_predicted inner_error inner_smooth largest_simulated largest_predicted largest_smooth "
    "depth_simulated depth_predicted"
).split()


def solved(name: str, points: int) -> xr.Dataset:
    """Simulate, and return the frames of the last period."""
    plan = rough.PLAN[name]
    period = plan.length / plan.velocity_ratio
    case = rough.case_of(plan, points).with_options(f"output.frame_interval={period / FRAMES!r}")
    result = pyehl.solve(case, check=False)
    return result.isel(T=np.flatnonzero(result.T > float(result.T[-1]) - period))


def row_of(name: str, last: xr.Dataset) -> dict[str, Any]:
    """Predict, and compare the stress with that below the frames of a simulation."""
    points = last.sizes["X"]
    case = rough.case_of(rough.PLAN[name], points)
    a = OperatingPoint.from_settings(case.resolve()).hertz_radius
    depths = [a * z for z in DEPTHS]
    simulated, predicted = (
        pyehl.stress(result, friction="none", near=NEAR * a, depths=depths)
        for result in (last, pyehl.predict(case))
    )
    row = {"name": name, "points": points}
    for layer, value in (("near", "near_surface_shear"), ("inner", "near_surface_shear_inner")):
        row |= {
            f"{layer}_simulated": float(simulated[value]),
            f"{layer}_predicted": float(predicted[value]),
            f"{layer}_error": float(predicted[f"{value}_error"]),
            f"{layer}_smooth": float(simulated[f"{value}_smooth"]),
        }
    for word, value in (("largest", "principal_shear_max"), ("depth", "principal_shear_max_depth")):
        row |= {
            f"{word}_simulated": float(simulated[value]),
            f"{word}_predicted": float(predicted[value]),
        }
    return row | {"largest_smooth": float(simulated.principal_shear_max_smooth)}


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
        result = row_of(name, solved(name, args.points))
        new = {k: v if k == "name" else f"{v:.5g}" for k, v in result.items()}
        kept = [r for r in rows() if (r["name"], r["points"]) != (name, new["points"])]
        with (HERE / "table.csv").open("w", newline="", encoding="utf-8") as stream:
            writer = csv.DictWriter(stream, COLUMNS, lineterminator="\n")
            writer.writeheader()
            writer.writerows([*kept, new])
    for row in rows():
        value = {k: float(v) for k, v in row.items() if k != "name"}
        cells = [row["name"], f"{value['near_smooth']:.4f}"]
        for layer in ("near", "inner"):
            simulated, predicted = (value[f"{layer}_{of}"] for of in ("simulated", "predicted"))
            cells += [f"{simulated:.4f}", f"{predicted:.4f}"]
            cells += [f"{predicted / simulated - 1.0:+.1%}"]
            cells += [f"{value[f'{layer}_error'] / predicted:.1%}"]
        largest = value["largest_predicted"] / value["largest_simulated"] - 1.0
        print(f"| {' | '.join([*cells, f'{largest:+.2%}'])} |".replace("%", " %"))


if __name__ == "__main__":
    main()

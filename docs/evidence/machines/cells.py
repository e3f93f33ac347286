# SPDX-License-Identifier: BSD-3-Clause
"""Make the tables of long and short cells, or print those of the documents.

Long cells are twice as long across the motion as short ones.

python docs/evidence/machines/cells.py cells       cells.csv
python docs/evidence/machines/cells.py straight    straight.csv
python docs/evidence/machines/cells.py show
"""

from __future__ import annotations

import math
import sys
from pathlib import Path
from statistics import median

import pyehl

sys.path.insert(0, str(Path(__file__).resolve().parent))
sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "benchmarks"))
from machine_tables import read, run, write
from machines import SETTINGS, draw, timed

# As `blunt_spike` in fortran/case/case_grid.f90: alpha p_h up to L = 10 and above; alpha p_h and L
# up to which the default cells are long, and L below which they are long at any alpha p_h
SHARP, MEDIUM_SHARP, MEDIUM, LOW = (21.0, 19.0), 35.0, 9.0, 7.0
# As `straight_edge` there; contacts of `straight.csv`: seeds, count, and smallest M by R_x
STRAIGHT, SEEDS, COUNT, LARGE = 22.0, range(30, 266), 60, 8e4
# Smallest number of nodes along the motion of the contacts of `cells.csv`
MIN_POINTS = 513
CELLS = (
    *("seed", "number", "law", "ellipticity", "moes_l", "alpha_p_h", "points", "points_y"),
    *("total_cycles", "seconds", "long_status", "long_total_cycles", "long_seconds"),
)
STRAIGHT_CELLS = (
    *("seed", "number", "law", "ellipticity", "moes_m", "moes_l", "alpha_p_h", "points"),
    *("points_y", "status", "total_cycles", "seconds", "H_c", "H_min"),
    *("long_points_y", "long_status", "long_total_cycles", "long_seconds"),
    *("long_H_c", "long_H_min", "long_H_c_error", "long_H_min_error"),
)


def measure_cells() -> None:
    """Solve wide contacts of contacts.csv with a sharp spike on short cells and on long ones."""
    rows = []
    for row in read():
        contact = draw(row["number"] + 1, row["seed"])[row["number"]]
        alpha_p_h = contact.values["lubricant.pressure_viscosity"] * contact.pressure
        sharp, few = alpha_p_h > SHARP[row["moes_l"] > 10.0], row["points"] < MIN_POINTS
        if row["ellipticity"] < 5.0 or row["moes_l"] > 15.0 or not sharp or few:
            continue
        medium = alpha_p_h < MEDIUM_SHARP or row["ellipticity"] > STRAIGHT
        is_long = row["moes_l"] < LOW or (row["moes_l"] < MEDIUM and medium)
        # so that half the rows can be coarsened as often
        unit = (row["points"] - 1) // 4
        across = unit * round((row["points_y"] - 1) * (2 if is_long else 1) / unit)
        keys = dict(contact.values) | SETTINGS | {"grid.points": row["points"]}
        short = timed(keys | {"grid.points_y": across + 1})
        long = timed(keys | {"grid.points_y": across // 2 + 1})
        result = row | {name: short[name] for name in ("points_y", "total_cycles", "seconds")}
        result |= {f"long_{name}": long[name] for name in ("status", "total_cycles", "seconds")}
        rows.append(result | {"alpha_p_h": alpha_p_h})
    write("cells.csv", CELLS, rows)


def cells() -> list[str]:
    """Make the table of times on long cells over those on short ones, by L."""
    lines = [
        "| L | α p_h | contacts | no solution on long cells | faster on long cells | median ratio "
        "of times, long over short cells |",
        "|---|---|---|---|---|---|",
    ]
    groups = [
        *((0.0, LOW, 0.0, math.inf), (LOW, MEDIUM, 0.0, MEDIUM_SHARP)),
        *((LOW, MEDIUM, MEDIUM_SHARP, math.inf), (MEDIUM, 15.0, 0.0, math.inf)),
    ]
    for low, high, least, most in groups:
        mine = [
            row
            for row in read("cells.csv")
            if low <= row["moes_l"] < high and least <= row["alpha_p_h"] < most
        ]
        good = [row for row in mine if row["long_status"] == "converged"]
        ratios = [row["long_seconds"] / row["seconds"] for row in good]
        faster = sum(ratio < 1.0 for ratio in ratios)
        lines.append(
            f"| {low:g} to {high:g} | {_between(least, most)} | {len(mine)} "
            f"| {len(mine) - len(good)} | {faster} | {median(ratios):.2f} |"
        )
    return lines


def _between(least: float, most: float) -> str:
    """Name an interval of alpha p_h above the limits of SHARP."""
    if most < math.inf:
        return f"up to {most:g}"
    return f"above {least:g}" if least > 0.0 else "any"


def measure_straight() -> None:
    """Solve very wide contacts of large M with L from 7 to 9 on long (default) and short cells."""
    rows = []
    for seed in SEEDS:
        for number, contact in enumerate(draw(COUNT, seed)):
            alpha_p_h = contact.values["lubricant.pressure_viscosity"] * contact.pressure
            if not (contact.ellipticity or 0.0) > STRAIGHT or not alpha_p_h > MEDIUM_SHARP:
                continue
            keys = dict(contact.values) | SETTINGS
            with pyehl.Solver(pyehl.Case.from_text("", keys)) as solver:
                point = solver.summary
            if not LOW < point["moes_l"] < MEDIUM or not point["moes_m"] > LARGE:
                continue
            long = timed(keys)
            short = timed(keys | {"grid.points_y": 2 * long["points_y"] - 1})
            row = {
                "seed": seed,
                "number": number,
                "law": contact.values.get("lubricant.shear_law", "newtonian"),
            }
            row |= {"ellipticity": contact.ellipticity, "alpha_p_h": alpha_p_h}
            rows.append(short | row | {f"long_{name}": long[name] for name in long})
            print(seed, number, rows[-1]["seconds"], rows[-1]["long_seconds"], flush=True)
    write("straight.csv", STRAIGHT_CELLS, rows)


def straight() -> list[str]:
    """Make the table of times on long cells over those on short ones, in very wide contacts."""
    lines = [
        "| contacts | without solution: short, long cells | faster on long cells | ratio of times: "
        "median, largest | largest change of h_c, h_min |",
        "|---|---|---|---|---|",
    ]
    mine = read("straight.csv")
    good = [row for row in mine if row["long_status"] == "converged" == row["status"]]
    ratios = [row["long_seconds"] / row["seconds"] for row in good]
    changes = [
        max(abs(row[f"long_{name}"] / row[name] - 1.0) for row in good) for name in ("H_c", "H_min")
    ]
    missing = [sum(row[name] != "converged" for row in mine) for name in ("status", "long_status")]
    lines.append(
        f"| {len(mine)} | {missing[0]}, {missing[1]} | {sum(ratio < 1.0 for ratio in ratios)} "
        f"| {median(ratios):.2f}, {max(ratios):.1f} "
        f"| {', '.join(f'{100.0 * change:.2f} %' for change in changes)} |"
    )
    return lines


MEASURE = {"cells": measure_cells, "straight": measure_straight}
TABLES = cells, straight


if __name__ == "__main__":
    run(sys.argv[1], MEASURE, TABLES)

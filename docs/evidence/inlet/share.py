# SPDX-License-Identifier: BSD-3-Clause
"""Load shares at the end of a run against those of strict solutions on the same grid.

    python docs/evidence/inlet/share.py run SEED    adds what is missing of a seed to share.csv
    python docs/evidence/inlet/share.py show        prints the table of README.md

Ten seconds a contact of one core.
"""

from __future__ import annotations

import csv
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

import pyehl
from pyehl.schema import summary_of

TABLE = Path(__file__).parent / "share.csv"
# Contacts of a seed: the factor 80 was chosen with 5501, the factor 5 with 47470
SEEDS = {5501: 40, 47470: 40, 8128: 40, 31415: 40}
CHOSEN = (5501, 47470)
GRIDS = (129, 257, 513)
STRICT = {"solver.accuracy": 1e-3, "solver.max_cycles": 100}
RESULTS = ("contact_load_share", "contact_load_share_error", "contact_load_share_error_stop")
ENDS = ("status", "cycles", "residual", "layer_supply", *RESULTS)
Row = dict[str, Any]


def contacts(seed: int) -> Iterator[tuple[Row, Row]]:
    """Keys of contacts that may touch, and what they are, without end."""
    rng = np.random.default_rng(seed)
    radius, modulus, alpha, viscosity = 0.0095, 2.26e11, 2e-8, 0.03
    while True:
        moes_l, moes_m = 10.0 ** rng.uniform(0.2, 1.2), 10.0 ** rng.uniform(2.0, 3.4)
        ratio = 1.0 if rng.random() < 0.6 else 10.0 ** rng.uniform(-0.2, 0.4)
        layer = rng.uniform(0.4, 1.1)
        speed = (moes_l / (alpha * modulus)) ** 4
        load = moes_m * speed**0.75
        # Hamrock and Dowson's formula of the central film, which the layer refers to
        film = 2.66 * radius * (speed / 2.0) ** 0.67 * (alpha * modulus) ** 0.53 * load**-0.067
        velocity = speed / 2.0 * modulus * radius / viscosity
        if load * modulus * radius**2 > 1e5 or velocity > 200.0:
            continue
        keys = {
            "contact.load": load * modulus * radius**2,
            "contact.mean_velocity": velocity,
            "contact.radius_x": radius,
            "contact.radius_y": radius * ratio,
            "contact.reduced_modulus": modulus,
            "contact.slide_to_roll": 0.5,
            "lubricant.viscosity": viscosity,
            "lubricant.pressure_viscosity": alpha,
            "lubricant.shear_law": "eyring",
            "lubricant.boundary_film": layer * film,
            "lubricant.boundary_friction": 0.1,
        }
        what = {"moes_m": moes_m, "moes_l": moes_l, "radius_ratio": ratio, "layer_over_film": layer}
        yield keys, what


def run(seed: int) -> None:
    """Add what is missing of a seed."""
    there = {(int(r["seed"]), int(r["contact"]), int(r["points"])) for r in read()}
    for number, (keys, what) in zip(range(SEEDS[seed]), contacts(seed), strict=False):
        for points in GRIDS:
            if (seed, number, points) in there:
                continue
            found, best = (solved(keys | {"grid.points": points} | more) for more in ({}, STRICT))
            row: Row = {"seed": seed, "contact": number, **what, "points": points}
            row |= {name: found.get(name) for name in ENDS}
            row |= {f"strict_{name}": best.get(name) for name in ENDS[:-2]}
            append(row)


def solved(keys: Row) -> Row:
    """Summary of a contact."""
    return summary_of(pyehl.solve(pyehl.Case.from_text("", keys), check=False))


def append(row: Row) -> None:
    """Add a line to the table."""
    new = not TABLE.is_file()
    with TABLE.open("a", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        if new:
            writer.writerow(row)
        writer.writerow(
            [f"{v:.6g}" if isinstance(v, float) else "" if v is None else v for v in row.values()]
        )


def read() -> list[Row]:
    """Rows of the table."""
    if not TABLE.is_file():
        return []
    with TABLE.open(newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def compared() -> list[Row]:
    """Rows of contacts that touch and have an error, whose strict solution has converged."""
    return [
        row
        for row in read()
        if row["status"] == row["strict_status"] == "converged"
        and row["contact_load_share_error"]
        and float(row["contact_load_share"]) > 0.0
    ]


def lines() -> list[str]:
    """Give the table of README.md."""
    heads = "results", "covered by the error of the end", "by the whole error"
    heads = *heads, "largest difference", "of it over the error of the grid", "cycles"
    found = ["| seeds | " + " | ".join(heads) + " |", "|---" * (len(heads) + 1) + "|"]
    for chosen in (True, False):
        rows = [r for r in compared() if (int(r["seed"]) in CHOSEN) == chosen]
        seeds = sorted({int(r["seed"]) for r in rows})
        values = np.array(
            [[float(r[name]) for name in (*RESULTS, "strict_contact_load_share")] for r in rows]
        )
        off = np.abs(values[:, 0] - values[:, 3])
        cycles, strict = (sum(int(r[name]) for r in rows) for name in ("cycles", "strict_cycles"))
        cells = f"{len(rows)}", f"{np.sum(off <= values[:, 2])}", f"{np.sum(off <= values[:, 1])}"
        worst = np.max(off / (values[:, 1] - values[:, 2]))
        cells = *cells, f"{off.max():.3f}", f"{worst:.2f}", f"{cycles} ({strict} strict)"
        name = ", ".join(map(str, seeds)) + (" (chosen with them)" if chosen else " (blind)")
        found.append("| " + " | ".join((name, *cells)) + " |")
    return found


if __name__ == "__main__":
    if sys.argv[1:2] == ["run"] and len(sys.argv) == 3:
        run(int(sys.argv[2]))
    elif sys.argv[1:] == ["show"]:
        print("\n".join(lines()))
    else:
        sys.exit(__doc__)

# SPDX-License-Identifier: BSD-3-Clause
"""Load shares of a boundary film on ever finer grids.

    python docs/evidence/contact/make.py run [POINTS ...]    adds what is missing to shares.csv
    python docs/evidence/contact/make.py show                prints the tables of README.md

Seconds to minutes a run of one core up to 513 x 513 nodes, a quarter of an hour on 1025 x 1025.
"""

from __future__ import annotations

import csv
import sys
from pathlib import Path
from typing import Any

import pyehl

HERE = Path(__file__).parent
# Steel, a mineral oil of 0.04 Pa s, waves of half a Hertz radius that slide
CASE = """
&contact
   radius = 0.018 reduced_modulus = 2.26e11 mean_velocity = 0.1 slide_to_roll = 1.0
/
&surface
   kind = 'harmonic' wavelength = 0.5
/
&grid
   x_inlet = -2.5 x_outlet = 1.5 y_extent = 2.0
/
&lubricant
   shear_law = 'eyring' boundary_friction = 0.1
/
"""
# Load [N], amplitude [a^2/R], Eyring stress [Pa], layers [m], nodes a side
HEAVY = (600.0, 0.02, 5e6, (1e-8, 2e-8, 4e-8, 8e-8), (65, 129, 257, 513))
LIGHT = (100.0, 0.03, 5e6, (1e-8, 2e-8, 4e-8, 8e-8), (65, 129, 257, 513, 1025))
THIN = (100.0, 0.03, 1e6, (1e-8, 2e-8, 4e-8), (65, 129, 257, 513))
KEYS = ("load", "amplitude", "eyring_stress", "boundary_film", "points")
NAMES = (
    "status contact_load_share contact_load_share_error contact_area_share layer_supply mu"
).split()

Row = dict[str, Any]


def runs() -> list[Row]:
    """List the keys of all runs; the finest grids take the thickest layer of the light contact."""
    rows = [
        dict(zip(KEYS, (load, height, stress, layer, points), strict=True))
        for load, height, stress, layers, grids in (HEAVY, LIGHT, THIN)
        for layer in layers
        for points in grids
    ]
    light = LIGHT[0]
    return [
        r for r in rows if r["load"] != light or r["points"] <= 257 or r["boundary_film"] > 3e-8
    ]


def read() -> list[Row]:
    """Read shares.csv; nothing where there is none."""
    path = HERE / "shares.csv"
    if not path.exists():
        return []
    with path.open(encoding="utf-8", newline="") as stream:
        return list(csv.DictReader(stream))


def simulated(run: Row) -> Row:
    """Simulate one run."""
    changes = {
        "contact.load": run["load"],
        "surface.amplitude": run["amplitude"],
        "lubricant.eyring_stress": run["eyring_stress"],
        "lubricant.boundary_film": run["boundary_film"],
        "grid.points": run["points"],
    }
    with pyehl.Solver(pyehl.Case.from_text(CASE, changes)) as solver:
        solver.run()
        summary = solver.summary()
    return run | {name: summary[name] for name in NAMES}


def add(grids: list[int]) -> None:
    """Simulate what is missing, on some grids or on all."""
    rows = read()
    known = {tuple(float(row[key]) for key in KEYS) for row in rows}
    for run in sorted(runs(), key=lambda r: r["points"]):
        done = tuple(float(run[key]) for key in KEYS) in known
        if done or (grids and run["points"] not in grids):
            continue
        rows.append(simulated(run))
        print(*rows[-1].values(), flush=True)
        with (HERE / "shares.csv").open("w", encoding="utf-8", newline="") as stream:
            table = csv.DictWriter(stream, [*KEYS, *NAMES], lineterminator="\n")
            table.writeheader()
            table.writerows(rows)


def cell(row: Row | None) -> str:
    """Give a load share and its error, or the status of a run without."""
    if row is None:
        return ""
    if not row["contact_load_share"]:
        return str(row["status"])
    share, error = (row[name] for name in ("contact_load_share", "contact_load_share_error"))
    text = f"{float(share):.2g}" if float(share) else "0"
    return text + (f" ± {float(error):.1g}" if error and float(error) else "")


def lines(load: float, stress: float) -> list[str]:
    """Make the table of one contact."""
    rows = {tuple(float(row[key]) for key in KEYS): row for row in read()}
    mine = [run for run in runs() if (run["load"], run["eyring_stress"]) == (load, stress)]
    grids = sorted({run["points"] for run in mine})
    text = ["| layer | " + " | ".join(map(str, grids)) + " |", "|---" * (len(grids) + 1) + "|"]
    for layer in sorted({run["boundary_film"] for run in mine}):
        height = mine[0]["amplitude"]
        cells = [cell(rows.get((load, height, stress, layer, float(points)))) for points in grids]
        text.append(f"| {1e9 * layer:.0f} nm | " + " | ".join(cells) + " |")
    return text


def main() -> None:
    """Do what the first argument says."""
    if sys.argv[1:2] == ["run"]:
        add([int(points) for points in sys.argv[2:]])
    elif sys.argv[1:] == ["show"]:
        for load, _, stress, *_ in (HEAVY, LIGHT, THIN):
            print(f"{load:.0f} N, {stress / 1e6:.0f} MPa", *lines(load, stress), "", sep="\n")
    else:
        sys.exit(__doc__)


if __name__ == "__main__":
    main()

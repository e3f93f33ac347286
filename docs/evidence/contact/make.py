# SPDX-License-Identifier: BSD-3-Clause
"""Load shares of a boundary film under grid refinement.

    python docs/evidence/contact/make.py run [POINTS ...]    adds missing rows to shares.csv
    python docs/evidence/contact/make.py show                prints the tables of README.md

A run takes seconds to minutes on one core up to 513 x 513 nodes, 15 minutes on 1025 x 1025.
"""

from __future__ import annotations

import csv
import sys
from pathlib import Path
from typing import Any

import pyehl

HERE = Path(__file__).parent
# Steel, a mineral oil of 0.04 Pa s at 0.1 m/s
CASE = """
&contact
   radius = 0.018 reduced_modulus = 2.26e11 mean_velocity = 0.1
/
&grid
   x_inlet = -2.5 x_outlet = 1.5 y_extent = 2.0
/
&lubricant
   boundary_friction = 0.1
/
"""
Row = dict[str, Any]
# Sliding waves with a wavelength of half a Hertz radius
WAVES = {"surface.kind": "harmonic", "surface.wavelength": 0.5, "contact.slide_to_roll": 1.0}


def _waves(load: float, height: float, **law: float | str) -> Row:
    """Give the changes for waves of a height [a^2/R] at a load [N], with keys of the lubricant."""
    changes: Row = {
        "contact.load": load,
        "surface.amplitude": height,
        "lubricant.shear_law": "eyring",
    }
    return WAVES | changes | {f"lubricant.{key}": value for key, value in law.items()}


# Changes of the case, boundary films [m], nodes per side; films up to THICK are not on fine grids
THICK = 3e-8
CONTACTS: dict[str, tuple[Row, tuple[float, ...], tuple[int, ...]]] = {
    "heavy": (
        _waves(600.0, 0.02, eyring_stress=5e6),
        (1e-8, 2e-8, 4e-8, 8e-8),
        (65, 129, 257),
    ),
    "light": (
        _waves(100.0, 0.03, eyring_stress=5e6),
        (1e-8, 2e-8, 4e-8, 8e-8),
        (65, 129, 257, 513, 1025),
    ),
    "thin": (_waves(100.0, 0.03, eyring_stress=1e6), (1e-8, 2e-8, 4e-8), (65, 129, 257, 513)),
    "carreau": (
        _waves(100.0, 0.03, shear_law="carreau", carreau_stress=5e6, carreau_exponent=0.6),
        (4e-8, 8e-8),
        (129, 257, 513),
    ),
    # a fractal tile as long as the Hertz radius, whose shortest wave has 16 nodes on 257 x 257
    "fractal": (
        {
            "contact.load": 100.0,
            "contact.slide_to_roll": 0.2,
            "lubricant.shear_law": "eyring",
            "lubricant.eyring_stress": 5e6,
            "surface.kind": "fractal",
            "surface.rms_height": 4e-8,
            "surface.seed": 3,
            "surface.length_x": 2.286e-4,
            "surface.length_y": 2.286e-4,
            "surface.pixels": 128,
            "surface.shortest_wavelength": 2.286e-4 / 4.0,
        },
        (4e-8, 8e-8),
        (129, 257, 513, 1025),
    ),
}
KEYS = ("contact", "boundary_film", "points")
NAMES = (
    "status contact_load_share contact_load_share_error_grid contact_area_share mass_defect mu"
).split()


def runs() -> list[Row]:
    """List the keys of all runs."""
    return [
        {"contact": name, "boundary_film": layer, "points": points}
        for name, (_, layers, grids) in CONTACTS.items()
        for layer in layers
        for points in grids
        if points <= 257 or layer > THICK
    ]


def read() -> list[Row]:
    """Read shares.csv; empty if it is missing."""
    path = HERE / "shares.csv"
    if not path.exists():
        return []
    with path.open(encoding="utf-8", newline="") as stream:
        return list(csv.DictReader(stream))


def key_of(row: Row) -> tuple[str, float, int]:
    """Give the key of a run."""
    return row["contact"], float(row["boundary_film"]), int(row["points"])


def simulated(run: Row) -> Row:
    """Simulate one run."""
    changes = CONTACTS[run["contact"]][0] | {
        "lubricant.boundary_film": run["boundary_film"],
        "grid.points": run["points"],
    }
    with pyehl.Solver(pyehl.Case.from_text(CASE, changes)) as solver:
        solver.run()
        summary = solver.summary
    return run | {name: summary[name] for name in NAMES}


def add(grids: list[int]) -> None:
    """Simulate missing runs, on some grids or on all."""
    rows = read()
    known = {key_of(row) for row in rows}
    for run in sorted(runs(), key=lambda r: r["points"]):
        if key_of(run) in known or (grids and run["points"] not in grids):
            continue
        rows.append(simulated(run))
        print(*rows[-1].values(), flush=True)
        with (HERE / "shares.csv").open("w", encoding="utf-8", newline="") as stream:
            table = csv.DictWriter(stream, [*KEYS, *NAMES], lineterminator="\n")
            table.writeheader()
            table.writerows(rows)


def cell(row: Row | None) -> str:
    """Format a load share and its error, or the status of a run without one."""
    if row is None:
        return ""
    if not row["contact_load_share"]:
        return str(row["status"])
    share, error = (row[name] for name in ("contact_load_share", "contact_load_share_error_grid"))
    text = f"{float(share):.2g}" if float(share) else "0"
    return text + (f" ± {float(error):.1g}" if error and float(error) else "")


def lines(name: str) -> list[str]:
    """Make the table of one contact."""
    rows = {key_of(row): row for row in read()}
    _, layers, grids = CONTACTS[name]
    heads = "| boundary film | " + " | ".join(map(str, grids)) + " |"
    text = [heads, "|---" * (len(grids) + 1) + "|"]
    for layer in layers:
        cells = [cell(rows.get((name, layer, points))) for points in grids]
        text.append(f"| {1e9 * layer:.0f} nm | " + " | ".join(cells) + " |")
    return text


def main() -> None:
    """Run the command of the first argument."""
    if sys.argv[1:2] == ["run"]:
        add([int(points) for points in sys.argv[2:]])
    elif sys.argv[1:] == ["show"]:
        for name in CONTACTS:
            print(name, *lines(name), "", sep="\n")
    else:
        sys.exit(__doc__)


if __name__ == "__main__":
    main()

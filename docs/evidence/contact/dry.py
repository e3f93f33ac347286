# SPDX-License-Identifier: BSD-3-Clause
"""Rough balls at rest under a slow smooth body, compared with dry contact by ContactMechanics.

    python docs/evidence/contact/dry.py run      adds missing rows to dry.csv
    python docs/evidence/contact/dry.py show     prints the table of README.md

A run takes seconds on 129 x 129 nodes and ten on 257 x 257; needs ContactMechanics (pyehl[test]).
"""

from __future__ import annotations

import csv
import sys
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import numpy as np
from ContactMechanics import FreeFFTElasticHalfSpace
from ContactMechanics.Optimization import constrained_conjugate_gradients
from numpy.typing import NDArray

import pyehl

Array = NDArray[np.float64]
Row = dict[str, Any]
TABLE = Path(__file__).parent / "dry.csv"
# 2/E' = sum of (1 - nu^2)/E [Pa]
REDUCED_MODULUS = 2.26e11
CASE = f"""
&contact
   radius = 0.018 reduced_modulus = {REDUCED_MODULUS} load = 100.0
   mean_velocity = 0.002 slide_to_roll = -2.0
/
&grid
   x_inlet = -2.5 x_outlet = 1.5 y_extent = 2.0
/
&lubricant
   boundary_film = 2e-8
/
"""
WAVE = {"surface.kind": "harmonic", "surface.amplitude": 0.02}
# Waves along one axis only
RIDGES = WAVE | {"surface.amplitude": 0.3, "surface.wavelength": 1.0}
# A tile as large as the domain, whose shortest wave is half the Hertz radius
TILE = {
    "surface.kind": "fractal",
    "surface.rms_height": 4e-7,
    "surface.length_x": 9.144e-4,
    "surface.length_y": 9.144e-4,
    "surface.pixels": 128,
    "surface.shortest_wavelength": 1.143e-4,
}
SURFACES: dict[str, Row] = {
    "flattened waves": WAVE | {"contact.load": 600.0, "contact.mean_velocity": 0.005},
    "ridges along the motion": RIDGES | {"surface.wavelength_x": 100.0},
    "ridges across the motion": RIDGES | {"surface.wavelength_y": 1e6},
    "islands": RIDGES,
} | {f"tile {seed}": TILE | {"surface.seed": seed} for seed in range(1, 13)}
SURFACES |= {
    "tile 8, 8 mm/s": SURFACES["tile 8"] | {"contact.mean_velocity": 0.008},
    "tile 8, 0.5 mm/s": SURFACES["tile 8"] | {"contact.mean_velocity": 0.0005},
    "tile 8, boundary film of 5 nm": SURFACES["tile 8"] | {"lubricant.boundary_film": 5e-9},
}
GRIDS = (129, 257)
KEYS = ("surface", "points")
NAMES = (
    "status contact_area_share contact_load_share mass_defect dry_area_share rms P_max_off".split()
)


def dry_pressure(
    summary: Mapping[str, Any],
    field: Callable[[str], Array],
    limit: float | None = None,
    modulus: float = REDUCED_MODULUS,
) -> Array:
    """Pressure [p_h] of the bodies of a result in dry contact, on its nodes.

    `limit`: hardness [p_h] of bodies that are elastic and perfectly plastic.
    """
    x, y = field("X"), field("Y")
    gap = (x[:, None] ** 2 + summary.get("radius_ratio", 1.0) * y[None] ** 2) / 2.0 - field("RR")
    cell = np.array([x[1] - x[0], y[1] - y[0]])
    size = cell * gap.shape
    # E* over p_h a / film scale
    stiffness = 0.5 * modulus / summary["hertz_pressure_Pa"]
    stiffness *= summary["film_scale_m"] / summary["hertz_radius_m"]
    result = constrained_conjugate_gradients(
        FreeFFTElasticHalfSpace(gap.shape, stiffness, size),
        -gap,
        hardness=None if limit is None else limit * cell.prod(),
        external_force=2.0 * np.pi / 3.0 * summary.get("ellipticity", 1.0),
        pentol=1e-8 * gap.max(),
        thermotol=1e-8,
        maxiter=2000,
    )
    if not result.success:
        msg = "the dry contact is not solved"
        raise RuntimeError(msg)
    return np.asarray(result.jac) / cell.prod()


def dry_area(summary: Mapping[str, Any], pressure: Array) -> float:
    """Area of the nodes under pressure over that of the Hertz ellipse."""
    cell = summary["x_mesh"] * summary.get("y_mesh", summary["x_mesh"])
    return float((pressure > 0.0).sum() * cell / (np.pi * summary.get("ellipticity", 1.0)))


def simulated(surface: str, points: int) -> Row:
    """Solve one contact, and compare it if it has a solution."""
    changes = SURFACES[surface] | {"grid.points": points}
    with pyehl.Solver(pyehl.Case.from_text(CASE, changes)) as solver:
        solver.run()
        summary = solver.summary
        fields = {name: solver.field(name) for name in ("P", "RR")}
        fields |= dict(zip("XY", solver.axes(), strict=True))
    row = {"surface": surface, "points": points, "status": summary["status"]}
    if summary["status"] != "converged":
        return row
    dry, pressure = dry_pressure(summary, fields.__getitem__), fields["P"]
    return row | {
        **{name: summary[name] for name in NAMES[1:4]},
        "dry_area_share": dry_area(summary, dry),
        "rms": np.sqrt(np.mean((pressure - dry)[dry > 0.0] ** 2)),
        "P_max_off": pressure.max() / dry.max() - 1.0,
    }


def read() -> list[Row]:
    """Read dry.csv; empty if it is missing."""
    if not TABLE.exists():
        return []
    with TABLE.open(encoding="utf-8", newline="") as stream:
        return [
            row | {"points": int(row["points"])} | {k: float(row[k] or "nan") for k in NAMES[1:]}
            for row in csv.DictReader(stream)
        ]


def area_off(row: Row) -> float:
    """Give the deviation of the area from that of the dry contact."""
    return float(row["contact_area_share"] / row["dry_area_share"] - 1.0)


def lines() -> list[str]:
    """Make the table of README.md."""
    rows = {(row["surface"], row["points"]): row for row in read()}
    text = [
        "| surface | dry area | area, 129 | 257 | pressure, 129 | 257 |",
        "|---|---|---|---|---|---|",
    ]
    for surface in SURFACES:
        both = [rows[surface, points] for points in GRIDS]
        share = both[0]["dry_area_share"]
        cells = ["" if np.isnan(share) else f"{share:.2f}"]
        for what in (area_off, lambda row: row["rms"]):
            cells += [
                f"{100.0 * what(row):.1f} %" if row["status"] == "converged" else row["status"]
                for row in both
            ]
        text.append(f"| {surface} | " + " | ".join(cells).replace("-", "−") + " |")
    return text


def main() -> None:
    """Run the command of the first argument."""
    if sys.argv[1:] == ["run"]:
        rows = read()
        known = {(row["surface"], row["points"]) for row in rows}
        for points in GRIDS:
            for surface in SURFACES:
                if (surface, points) in known:
                    continue
                rows.append(simulated(surface, points))
                print(*rows[-1].values(), flush=True)
                with TABLE.open("w", encoding="utf-8", newline="") as stream:
                    table = csv.DictWriter(stream, [*KEYS, *NAMES], lineterminator="\n")
                    table.writeheader()
                    table.writerows(rows)
    elif sys.argv[1:] == ["show"]:
        print(*lines(), sep="\n")
    else:
        sys.exit(__doc__)


if __name__ == "__main__":
    main()

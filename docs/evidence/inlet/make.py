# SPDX-License-Identifier: BSD-3-Clause
"""Random smooth bodies in contact under grid refinement: coverage of their stated errors.

    python docs/evidence/inlet/make.py run [CONTACTS]    adds missing rows to table.csv
    python docs/evidence/inlet/make.py show              prints the tables of README.md

A contact takes half a minute on one core, mostly on the finest grid.
"""

from __future__ import annotations

import csv
import sys
from collections.abc import Iterator
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np

import pyehl
from pyehl.schema import summary_of
from pyehl.theory.film import central_film
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.operating import OperatingPoint

HERE = Path(__file__).parent
TABLE = HERE / "table.csv"
SEED, CONTACTS = 47, 29
GRIDS = (65, 129, 257, 513, 1025)
FINEST = GRIDS[-1]
# Factor of the program (fortran/steady/inlet.f90)
FACTOR = 1.3
# Maximum (h/H^(2/3))^2, h = 4 a/1024: the finest grid must resolve the inlet
RESOLVED = 0.02
QUANTITIES = {"h_c_m": "h_c_error_m", "h_min_m": "h_min_error_m"} | {
    "contact_load_share": "contact_load_share_error"
}
COLUMNS = ("contact", "moes_m", "moes_l", "ellipticity", "layer_over_film", "missed", "points")
RESULTS = ("status", *(name for pair in QUANTITIES.items() for name in pair), "mu", "mass_defect")
Row = dict[str, Any]


def contacts() -> Iterator[tuple[Row, Row]]:
    """Yield keys of random contacts that may touch, and their parameters, without end."""
    rng = np.random.default_rng(SEED)
    while True:
        keys: Row = {
            "contact.load": 10.0 ** rng.uniform(0.7, 2.8),
            "contact.mean_velocity": 10.0 ** rng.uniform(-2.5, 0.3),
            "contact.slide_to_roll": rng.uniform(0.05, 1.0),
            "lubricant.viscosity": 10.0 ** rng.uniform(-2.2, -1.0),
            "lubricant.pressure_viscosity": rng.uniform(1e-8, 2.4e-8),
            "lubricant.shear_law": "eyring",
            "lubricant.boundary_friction": 0.1,
            "lubricant.boundary_film": 1e-9,
        }
        radius, circle = rng.uniform(5e-3, 20e-3), rng.random() < 0.6
        wide, layer = 10.0 ** rng.uniform(-0.3, 0.5), 10.0 ** rng.uniform(-0.4, 0.3)
        shape = {"radius": radius} if circle else {"radius_x": radius, "radius_y": radius * wide}
        keys |= {f"contact.{name}": value for name, value in shape.items()}
        try:
            settings = pyehl.Case.from_text("", keys).resolve()
        except pyehl.InputError:
            continue
        operating = OperatingPoint.from_settings(settings)
        lubricant = Lubricant.from_settings(settings)
        film = central_film(operating, lubricant)
        missed = (4.0 / (FINEST - 1)) ** 2 * (film / operating.film_scale) ** (-4.0 / 3.0)
        # a boundary film is given at ambient pressure
        thickness = layer * film * float(lubricant.density_ratio(operating.hertz_pressure))
        if not (RESOLVED / 30.0 < missed < RESOLVED and 1e-9 < thickness < 1e-6):
            continue
        keys["lubricant.boundary_film"] = thickness
        what = {
            "moes_m": operating.moes_m,
            "moes_l": operating.moes_l,
            "ellipticity": operating.ellipse.ellipticity,
            "layer_over_film": layer,
        }
        yield keys, what


def run(count: int) -> None:
    """Add missing rows of the first `count` contacts."""
    there = {(int(row["contact"]), int(row["points"])) for row in read()}
    for number, (keys, what) in zip(range(count), contacts(), strict=False):
        for points in GRIDS:
            if (number, points) in there:
                continue
            # the edge of the solid contact converges slowly if the film is near the boundary film
            more = {"grid.points": points, "solver.max_cycles": 100}
            case = pyehl.Case.from_text("", keys | more)
            result = summary_of(pyehl.solve(case, check=False))
            film = what["layer_over_film"], result["boundary_film"]
            mesh = result["x_mesh"]
            missed = FACTOR * mesh**2 * (film[1] / film[0] / density(case)) ** (-4.0 / 3.0)
            row = {"contact": number, **what, "missed": missed, "points": points}
            row |= {name: result.get(name) for name in RESULTS}
            append(row)


def density(case: pyehl.Case) -> float:
    """Density under the Hertz pressure over that at ambient pressure."""
    settings = case.resolve()
    pressure = OperatingPoint.from_settings(settings).hertz_pressure
    return float(Lubricant.from_settings(settings).density_ratio(pressure))


def append(row: Row) -> None:
    """Add a line to the table."""
    new = not TABLE.is_file()
    with TABLE.open("a", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        if new:
            writer.writerow([*COLUMNS, *RESULTS])
        values = (row[name] for name in (*COLUMNS, *RESULTS))
        writer.writerow(
            [f"{v:.6g}" if isinstance(v, float) else "" if v is None else v for v in values]
        )


def read() -> list[dict[str, str]]:
    """Rows of the table."""
    if not TABLE.is_file():
        return []
    with TABLE.open(newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def covered(rows: list[dict[str, str]], name: str) -> dict[int, tuple[int, int, int]]:
    """Count by grid the stated errors, those that cover the true error, and missing ones.

    The reference is the finest grid; contacts without a result on it are not counted.
    """
    best = {
        row["contact"]: float(row[name])
        for row in rows
        if int(row["points"]) == FINEST and row[name]
    }
    result = {}
    for points in GRIDS[:-1]:
        those = [r for r in rows if int(r["points"]) == points and r["contact"] in best]
        stated = [r for r in those if r[name] and r[QUANTITIES[name]]]
        good = [
            r
            for r in stated
            if abs(float(r[name]) - best[r["contact"]]) <= float(r[QUANTITIES[name]])
        ]
        result[points] = len(stated), len(good), len(those) - len(stated)
    return result


def by_two_grids(rows: list[dict[str, str]]) -> tuple[int, int]:
    """How many true errors of central films a third of the change from the coarser grid covers."""
    films = {(r["contact"], int(r["points"])): float(r["h_c_m"] or "nan") for r in rows}
    stated = good = 0
    for coarse, points in pairwise(GRIDS[:-1]):
        for name in {contact for contact, _ in films}:
            before, film, best = (films.get((name, n), np.nan) for n in (coarse, points, FINEST))
            if np.isfinite(before + film + best):
                stated += 1
                good += abs(film - best) <= abs(film - before) / 3.0
    return good, stated


def lines() -> list[str]:
    """Make the table of README.md."""
    rows = read()
    names = {"h_c_m": "h_c", "h_min_m": "h_min", "contact_load_share": "load share"}
    found_lines = [
        "| error of | " + " | ".join(f"{n}" for n in GRIDS[:-1]) + " | all |",
        "|---" * (len(GRIDS) + 1) + "|",
    ]
    for name, said in names.items():
        result = covered(rows, name)
        cells = [
            f"{good} of {stated}" + (f", {none} none" if none else "")
            for stated, good, none in result.values()
        ]
        stated, good = (sum(part[k] for part in result.values()) for k in (0, 1))
        cells.append(f"{good} of {stated} = {100.0 * good / stated:.0f} %")
        found_lines.append(f"| {said} | " + " | ".join(cells) + " |")
    return found_lines


def show() -> None:
    """Print the table of README.md, and the coverage of errors by two grids alone."""
    print("\n".join(lines()))
    good, stated = by_two_grids(read())
    print(f"by two grids alone: {good} of {stated}")


if __name__ == "__main__":
    if sys.argv[1:2] == ["run"]:
        run(int(sys.argv[2]) if len(sys.argv) > 2 else CONTACTS)
    elif sys.argv[1:] == ["show"]:
        show()
    else:
        sys.exit(__doc__)

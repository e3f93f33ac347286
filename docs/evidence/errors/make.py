"""Compare stated with true errors: smooth and rough contacts at random operating points.

    python docs/evidence/errors/make.py smooth     # smooth.csv, a minute
    python docs/evidence/errors/make.py rough      # rough.csv, forty minutes

Operating points and surfaces are drawn from a seed that was not used to choose any estimate.
"""

from __future__ import annotations

import csv
import math
import sys
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np

import pyehl

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE.parent))

from tables import numbers_of  # noqa: E402

SEED = 20261
SMOOTH, ROUGH = 80, 60
# Nodes per side of the largest doubled domain
FINEST = 1025
QUANTITIES = ("H_c", "H_min", "P_max", "F")
ROUGH_NAMES = (
    *("moes_m", "moes_l", "kind", "wavelength", "width"),
    *("amplitude_over_film", "velocity_ratio"),
)
Row = dict[str, Any]


def run(options: dict[str, Any]) -> Row:
    """Solve a case and return its summary."""
    with pyehl.Solver(pyehl.Case.from_text("", options)) as solver:
        solver.run()
        return solver.summary


def grids_of(moes_m: float, width: float) -> list[int]:
    """Three grids, of which the coarsest is fine enough for a solution at this load."""
    for points in (65, 129, 257, 513):
        # with thick films the inlet is as long as the film is thick
        if moes_m < 10.0 or 0.16 * moes_m * (width / (points - 1)) ** 2 <= 0.4:
            return [points, 2 * points - 1, 4 * points - 3]
    return []


def domain_of(point: Row) -> Row:
    """Give the default domain of an operating point."""
    return pyehl.Case.from_text("", point).resolve()["grid"]


def smooth_rows(point: Row) -> list[Row]:
    """Solve a smooth contact on three grids, also on the doubled domain, nearly flooded."""
    grid = domain_of(point)
    grids = grids_of(point["contact.moes_m"], grid["x_outlet"] - grid["x_inlet"])
    doubled = {f"grid.{key}": 2.0 * grid[key] for key in ("x_inlet", "x_outlet", "y_extent")}
    rows = []
    for points in grids:
        result = run(point | {"grid.points": points})
        wide = dict.fromkeys(("status", *QUANTITIES))
        if 2 * points - 1 <= FINEST:
            wide = run(point | doubled | {"grid.points": 2 * points - 1})
        row = {"moes_m": point["contact.moes_m"], "moes_l": point["contact.moes_l"]}
        row |= {"x_inlet": grid["x_inlet"], "points": points}
        row |= {"status": result["status"], "status_doubled": wide["status"]}
        for name in QUANTITIES:
            row |= {name: result[name], f"{name}_error": result[f"{name}_error"]}
            row |= {f"{name}_doubled": wide[name]}
        for name in ("H_c", "H_min"):
            row |= {f"{name}_error_domain": result[f"{name}_error_domain"]}
        rows.append(row)
    # the limit of fine grids on the doubled domain, order 2
    for name in QUANTITIES:
        solved = [row for row in rows if row["status_doubled"]]
        middle, fine = [None, None, *(row[f"{name}_doubled"] for row in solved)][-2:]
        known = middle is not None and fine is not None
        for row in rows:
            row[f"{name}_limit"] = (4.0 * fine - middle) / 3.0 if known else None
    return rows


def smooth_points() -> Iterator[Row]:
    """Draw operating points: M from 0.1 to 5000, evenly in its logarithm, L from 0 to 25."""
    generator = np.random.default_rng(SEED)
    for _ in range(SMOOTH):
        moes_m = math.exp(generator.uniform(math.log(0.1), math.log(5000.0)))
        moes_l = generator.uniform(0.0, 25.0) * (generator.random() > 0.1)
        yield {"contact.moes_m": float(f"{moes_m:.4g}"), "contact.moes_l": float(f"{moes_l:.3g}")}


def rough_cases() -> Iterator[Row]:
    """Draw waves and features: M from 20 to 640, L from 2 to 20, height over film 0.1 to 0.75."""
    generator = np.random.default_rng(SEED + 4)
    for _ in range(ROUGH):
        moes_m = math.exp(generator.uniform(math.log(20.0), math.log(640.0)))
        case = {"contact.moes_m": float(f"{moes_m:.4g}")}
        case["contact.moes_l"] = float(f"{generator.uniform(2.0, 20.0):.3g}")
        case["surface.kind"] = str(generator.choice(["harmonic", "harmonic", "dent", "ridge"]))
        size = float(f"{math.exp(generator.uniform(math.log(0.5), math.log(1.5))):.3g}")
        if case["surface.kind"] == "harmonic":
            case["surface.wavelength"] = size
        else:
            case["surface.width"] = size
        case["surface.amplitude_over_film"] = float(f"{generator.uniform(0.1, 0.75):.3g}")
        case["surface.velocity_ratio"] = float(generator.choice([0.9, 1.0, 1.01, 1.1, 1.2]))
        yield case


def rough_rows(case: Row) -> list[Row]:
    """Run a rough contact on three grids with default settings, and on a finer one."""
    grid = domain_of({k: v for k, v in case.items() if k.startswith("contact.")})
    first = grids_of(case["contact.moes_m"], grid["x_outlet"] - grid["x_inlet"])[0]
    # the finest of the three grids, and one of half its mesh size, give the limit
    grids = [intervals * (first - 1) + 1 for intervals in (2, 3, 4)]
    rows = []
    for points in [*grids, 2 * grids[-1] - 1]:
        reference = {"time.estimate_error": False} if points not in grids else {}
        result = run(case | {"grid.points": points} | reference)
        row = {key.partition(".")[2]: value for key, value in case.items()}
        row = {name: row.get(name) for name in ROUGH_NAMES} | {"points": points}
        row |= {name: result.get(name) for name in ("status", "mu_ratio", "mu_ratio_error")}
        row["mu_ratio_error_stop"] = result.get("mu_ratio_error_stop")
        rows.append(row)
    middle, fine = (row["mu_ratio"] for row in rows[-2:])
    known = middle is not None and fine is not None
    for row in rows:
        row["mu_ratio_limit"] = (4.0 * fine - middle) / 3.0 if known else None
    return rows


def numbers(name: str) -> list[Row]:
    """Read a table of this folder."""
    return numbers_of(HERE / f"{name}.csv")


def main() -> None:
    """Make a table with two workers."""
    what = sys.argv[1]
    todo = list(smooth_points() if what == "smooth" else rough_cases())
    make = smooth_rows if what == "smooth" else rough_rows
    rows: list[Row] = []
    with ProcessPoolExecutor(2) as pool:
        for number, result in enumerate(pool.map(make, todo), 1):
            rows += result
            print(f"{number} of {len(todo)}", file=sys.stderr)
    with (HERE / f"{what}.csv").open("w", newline="", encoding="utf-8") as stream:
        writer = csv.DictWriter(stream, rows[0], lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


if __name__ == "__main__":
    main()

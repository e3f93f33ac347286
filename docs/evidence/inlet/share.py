# SPDX-License-Identifier: BSD-3-Clause
"""Load shares at the end of a run against those of strict solutions on the same grid.

python docs/evidence/inlet/share.py run       solves the contacts of share.csv again
python docs/evidence/inlet/share.py strict    repeats the strict solutions (hours)
python docs/evidence/inlet/share.py show      prints the table of README.md
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
STRICT = {"solver.accuracy": 0.002, "solver.max_cycles": 200}
RESULTS = {
    "status": "status",
    "cycles": "cycles",
    "residual": "residual",
    "share": "contact_load_share",
    "error": "contact_load_share_error",
    "error_stop": "contact_load_share_error_stop",
    "supply": "mass_defect",
}
Row = dict[str, Any]


def contacts(seed: int) -> Iterator[Row]:
    """Yield keys of random contacts that may touch, without end."""
    rng = np.random.default_rng(seed)
    radius, modulus, alpha, viscosity = 0.0095, 2.26e11, 2e-8, 0.03
    while True:
        moes_l, moes_m = 10.0 ** rng.uniform(0.2, 1.2), 10.0 ** rng.uniform(2.0, 3.4)
        ratio = 1.0 if rng.random() < 0.6 else 10.0 ** rng.uniform(-0.2, 0.4)
        layer = rng.uniform(0.4, 1.1)
        speed = (moes_l / (alpha * modulus)) ** 4
        load = moes_m * speed**0.75 * modulus * radius**2
        # the boundary film refers to a film by formula
        film = 2.66 * radius * (speed / 2.0) ** 0.67 * (alpha * modulus) ** 0.53
        film *= (moes_m * speed**0.75) ** -0.067
        velocity = speed / 2.0 * modulus * radius / viscosity
        if load > 1e5 or velocity > 200.0:
            continue
        yield {
            "contact.load": f"{load:.6g}",
            "contact.mean_velocity": f"{velocity:.6g}",
            "contact.radius_x": radius,
            "contact.radius_y": f"{radius * ratio:.6g}",
            "contact.reduced_modulus": modulus,
            "contact.slide_to_roll": 0.5,
            "lubricant.viscosity": viscosity,
            "lubricant.pressure_viscosity": alpha,
            "lubricant.shear_law": "eyring",
            "lubricant.eyring_stress": 5e6,
            "lubricant.boundary_film": f"{layer * film:.6g}",
            "lubricant.boundary_friction": 0.1,
        }


def run(*, strict: bool) -> None:
    """Solve every contact of the table, and write it after each."""
    rows = read()
    keys = {
        (seed, number): of_contact
        for seed in {int(row["seed"]) for row in rows}
        for number, of_contact in zip(range(40), contacts(seed), strict=False)
    }
    for row in rows:
        case = keys[int(row["seed"]), int(row["contact"])] | {"grid.points": row["points"]}
        result = summary_of(
            pyehl.solve(pyehl.Case.from_text("", case | (STRICT if strict else {})), check=False)
        )
        names = [n for n in RESULTS if not strict or f"strict_{n}" in row]
        for name in names:
            value = result.get(RESULTS[name])
            text = f"{value:.6g}" if isinstance(value, float) else "" if value is None else value
            row[f"strict_{name}" if strict else name] = text
        with TABLE.open("w", newline="", encoding="utf-8") as file:
            writer = csv.DictWriter(file, rows[0], lineterminator="\n")
            writer.writeheader()
            writer.writerows(rows)


def read() -> list[Row]:
    """Rows of the table."""
    with TABLE.open(newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def is_compared(row: Row, which: str) -> bool:
    """Whether a load share, before or now, has an error and a strict solution."""
    return row["strict_status"] == "converged" == row[f"{which}status"] and bool(
        row[f"{which}error"]
    )


def lines() -> list[str]:
    """Make the table of README.md."""
    heads = (
        "seed",
        "criterion",
        "results",
        "covered",
        "largest difference",
        "differences above half the grid error",
        "cycles",
    )
    result = ["| " + " | ".join(heads) + " |", "|---" * len(heads) + "|"]
    for seed in sorted({int(row["seed"]) for row in read()}):
        solved = [row for row in read() if int(row["seed"]) == seed and row["status"]]
        for which, name in (("before_", "changes of a cycle"), ("", "changes and residual")):
            rows = [row for row in solved if is_compared(row, which)]
            names = f"{which}share", f"{which}error", "strict_share", "error", "error_stop"
            values = np.array([[float(row[n] or "nan") for n in names] for row in rows])
            off = np.abs(values[:, 0] - values[:, 2])
            cycles = sum(int(row[f"{which}cycles"]) for row in solved)
            cells = f"{seed}", name, f"{len(rows)}", f"{np.sum(off <= values[:, 1])}"
            far = off > 0.5 * (values[:, 3] - values[:, 4])
            cells = *cells, f"{off.max():.3f}", f"{far.sum()}", f"{cycles}"
            result.append("| " + " | ".join(cells) + " |")
    return result


if __name__ == "__main__":
    if sys.argv[1:] in (["run"], ["strict"]):
        run(strict=sys.argv[1] == "strict")
    elif sys.argv[1:] == ["show"]:
        print("\n".join(lines()))
    else:
        sys.exit(__doc__)

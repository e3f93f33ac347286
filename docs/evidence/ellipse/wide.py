# SPDX-License-Identifier: BSD-3-Clause
"""Rough wide contacts: drawn and predicted, then fully simulated on square cells.

    python docs/evidence/ellipse/wide.py predict     writes wide_predicted.csv
    python docs/evidence/ellipse/wide.py simulate    adds missing rows to wide_simulated.csv
    python docs/evidence/ellipse/wide.py compare     prints both

M and L are those of the circle with the same dry inlet. Waves shorter than eight nodes are cut off.
A simulation takes one to four minutes on one core.
"""

from __future__ import annotations

import csv
import sys
from pathlib import Path
from typing import Any

import numpy as np

import pyehl
from cases import case_of_circle
from pyehl.prediction.model import model_error
from pyehl.solver import Solver
from pyehl.theory.film import central_film
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.operating import OperatingPoint

HERE = Path(__file__).resolve().parent
PREDICTED, SIMULATED = HERE / "wide_predicted.csv", HERE / "wide_simulated.csv"
SEED = 20267
POINTS = 193
"""Nodes along X, on 4 a."""
# lay: correlation length along the motion over that across it
LAYS = {"across": 0.125, "isotropic": 1.0, "along": 8.0}
# lay, shear law and ellipticity of each case
PLAN = (
    *(("isotropic", "newtonian", 5.0), ("across", "newtonian", 6.0)),
    *(("along", "newtonian", 7.0), ("isotropic", "eyring", 8.0)),
    *(("across", "eyring", 10.0), ("along", "eyring", 6.0)),
    *(("isotropic", "newtonian", 10.0), ("across", "newtonian", 12.0)),
)
RESULTS = ("status", "mu_ratio", "mu_ratio_error_grid", "mu_ratio_error_stop", "steps")

Row = dict[str, Any]


def drawn(number: int) -> Row:
    """Draw a case, with the rms height that a prediction near a random ratio needs."""
    random = np.random.default_rng((SEED, number))
    lay, law, kappa = PLAN[number]
    row = {
        "name": f"w{number + 1:02d}",
        "ellipticity": kappa,
        "moes_m": float(150.0 * 5.0 ** random.random()),
        "moes_l": float(random.uniform(6.0, 14.0)),
        "lay": lay,
        "law": law,
        "eyring_stress": float(random.uniform(5e6, 1e7)) if law == "eyring" else 0.0,
        "velocity_ratio": float(random.uniform(0.92, 1.08)),
        "length_y": float(random.choice([1.0, 1.5])),
        "hurst": float(random.uniform(0.7, 0.9)),
        "seed": 700 + number,
        "rms_over_film": 0.15,
    }
    goal = float(1.1 * (2.2 / 1.1) ** random.random())
    row = {k: float(f"{v:.4g}") if isinstance(v, float) else v for k, v in row.items()}
    if law == "newtonian":
        for _ in range(2):
            result = pyehl.predict(case_of(row)).mu_ratio
            # the increase is of second order in the height
            factor = min(2.0, max(0.5, ((goal - 1.0) / max(result - 1.0, 0.01)) ** 0.45))
            row["rms_over_film"] = float(f"{row['rms_over_film'] * factor:.3g}")
    return row


def case_of(row: Row) -> pyehl.Case:
    """Make the case of a row, in SI units."""
    circle = case_of_circle(row["ellipticity"], row["moes_m"], row["moes_l"], row["velocity_ratio"])
    keys = circle.resolve()["contact"]
    point = OperatingPoint.from_moes(
        keys["moes_m"], keys["moes_l"], radius_ratio=keys["radius_ratio"]
    )
    a, kappa = point.hertz_radius, row["ellipticity"]
    extent = 1.15 * kappa + 0.1
    oil: Row = {"shear_law": row["law"]}
    if row["law"] == "eyring":
        oil["eyring_stress"] = row["eyring_stress"]
    film = central_film(point, Lubricant.from_settings(circle.resolve()))
    rows = 16 * round(2.0 * extent * (POINTS - 1) / 4.0 / 16.0)
    return pyehl.Case(
        contact={
            "load": point.load,
            "mean_velocity": point.mean_velocity,
            "reduced_modulus": point.reduced_modulus,
            "radius_x": point.radius,
            "radius_y": point.radius / keys["radius_ratio"],
        },
        lubricant=oil,
        surface={
            "kind": "fractal",
            "rms_height": row["rms_over_film"] * film,
            "length_x": a,
            "length_y": row["length_y"] * a,
            "pixels": 64,
            "lay_ratio": LAYS[row["lay"]],
            "hurst": row["hurst"],
            "seed": row["seed"],
            "velocity_ratio": row["velocity_ratio"],
            "shortest_wavelength": 8.0 * 4.0 * a / (POINTS - 1),
        },
        grid={
            "points": POINTS,
            "points_y": rows + 1,
            "x_inlet": -2.5,
            "x_outlet": 1.5,
            "y_extent": rows * 2.0 / (POINTS - 1),
        },
        time={"tolerance": 2e-3},
        solver={"threads": 1},
    )


def predicted(row: Row) -> Row:
    """Predict a row, with the stated error of the model."""
    summary = pyehl.predict(case_of(row)).summary
    ratio = summary["mu_ratio"]
    error = model_error(ratio, thins=row["law"] != "newtonian", ellipticity=row["ellipticity"])
    outside = " ".join(summary["outside_range"])
    return {"prediction": ratio, "model_error": error, "outside_range": outside}


def simulated(row: Row) -> Row:
    """Simulate a row."""
    with Solver(case_of(row)) as run:
        run.run()
        return {name: run.summary.get(name) for name in RESULTS}


def read(path: Path) -> dict[str, Row]:
    """Read a table by names; numbers as numbers."""
    if not path.exists():
        return {}
    words = {"lay", "law", "status", "outside_range"}
    result = {}
    with path.open(encoding="utf-8", newline="") as stream:
        for row in csv.DictReader(stream):
            name = row.pop("name")
            values = {k: v if k in words else float(v) if v else None for k, v in row.items()}
            result[name] = values | ({"seed": int(row["seed"])} if "seed" in row else {})
    return result


def write(path: Path, rows: dict[str, Row]) -> None:
    """Write a table."""
    with path.open("w", encoding="utf-8", newline="") as stream:
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow(["name", *next(iter(rows.values()))])
        for name, row in rows.items():
            values = [f"{v:.6g}" if isinstance(v, float) else v for v in row.values()]
            writer.writerow([name, *values])


def compare() -> list[Row]:
    """Compare predictions with simulations: deviation, and whether the error covers it."""
    result = []
    predictions = read(PREDICTED)
    for name, run in read(SIMULATED).items():
        if run["status"] != "converged":
            continue
        row = predictions[name] | run | {"name": name}
        off = row["prediction"] - row["mu_ratio"]
        row |= {"deviation": off / row["mu_ratio"], "covered": abs(off) <= row["model_error"]}
        result.append(row)
    return result


def main(what: str, *names: str) -> None:
    """Predict, simulate (all or the named cases) or compare."""
    if what == "predict":
        rows = read(PREDICTED)
        for number in range(len(rows), len(PLAN)):
            row = drawn(number)
            name = row.pop("name")
            rows[name] = row | predicted(row)
            write(PREDICTED, rows)
            print(name, rows[name], flush=True)
    elif what == "simulate":
        for name, row in read(PREDICTED).items():
            if name not in read(SIMULATED) and name in (names or [name]):
                result = simulated(row)
                # another process may have added rows meanwhile
                rows = read(SIMULATED) | {name: result}
                write(SIMULATED, dict(sorted(rows.items())))
                print(name, rows[name], flush=True)
    else:
        for row in compare():
            print(
                f"{row['name']} {row['lay']:9s} {row['law']:9s} kappa {row['ellipticity']:4g} "
                f"{row['prediction']:.4f} / {row['mu_ratio']:.4f} ({row['deviation']:+.2%}), "
                f"stated {row['model_error']:.4f}, grid {row['mu_ratio_error_grid']}, "
                f"{'covered' if row['covered'] else 'not covered'}"
            )


if __name__ == "__main__":
    main(*sys.argv[1:])

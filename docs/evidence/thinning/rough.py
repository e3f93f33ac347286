# SPDX-License-Identifier: BSD-3-Clause
"""Rough surfaces in shear-thinning lubricants: predicted, then simulated.

    python docs/evidence/thinning/rough.py predict      writes predicted.csv
    python docs/evidence/thinning/rough.py commit       adds new cases to committed.csv
    python docs/evidence/thinning/rough.py simulate     adds missing rows to simulated.csv
    python docs/evidence/thinning/rough.py fine         adds missing rows to fine.csv
    python docs/evidence/thinning/rough.py compare [committed.csv [fine.csv]]      prints both

A simulation is on 257 x 257 nodes and takes one to three minutes on one core; those of fine.csv are
on 513 x 513 and take five. Waves shorter than eight nodes of the coarser grid are cut off.
"""

from __future__ import annotations

import csv
import math
import sys
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

import pyehl
from pyehl.contact.sheared import INNER, NEAR
from pyehl.solver import Solver
from pyehl.theory.operating import OperatingPoint

HERE = Path(__file__).parent
POINTS, FINE = 257, 513
TABLE1 = "load = 600 mean_velocity = 0.84 radius = 0.018 reduced_modulus = 2.26e11"
BALL = "load = 300 mean_velocity = 0.5 radius = 0.0127 reduced_modulus = 1.24e11"
THICK = "viscosity = 0.5 pressure_viscosity = 1.8e-8"
EYRING = "shear_law = 'eyring' eyring_stress ="
CARREAU = "shear_law = 'carreau' carreau_stress ="


@dataclass(frozen=True, slots=True)
class Row:
    """A contact with a lubricant and a fractal surface."""

    contact: str
    lubricant: str
    velocity_ratio: float
    rms: float  # [m]
    hurst: float = 0.8
    seed: int = 1
    length: float = 1.0  # of the tile [a]


def by_moes(moes_m: float, moes_l: float) -> str:
    """Keys of a contact with M and L, the reference radius, modulus and lubricant."""
    o = OperatingPoint.from_moes(moes_m, moes_l)
    return (
        f"load = {o.load!r} mean_velocity = {o.mean_velocity!r} radius = {o.radius!r} "
        f"reduced_modulus = {o.reduced_modulus!r}"
    )


QUANTITIES = {
    "mu_ratio": "mu_ratio_model_error",
    "p_rise_rms_Pa": "p_rise_rms_error_Pa",
    "p_rise_max_Pa": "p_rise_max_error_Pa",
    "h_min_rough_m": "h_min_rough_error_m",
    "rms_deformed_m": "rms_deformed_error_m",
}
"""Compared quantities, and their stated errors."""

PLAN: dict[str, Row] = {
    "e1": Row(TABLE1, f"{EYRING} 5e6", 1.01, 5e-8, 0.8, 11),
    "e2": Row(TABLE1, f"{EYRING} 5e6", 1.1, 5e-8, 0.7, 12),
    "e3": Row(TABLE1, f"{CARREAU} 5e6 carreau_exponent = 0.5", 1.01, 4e-8, 0.8, 13),
    "e4": Row(TABLE1, f"{EYRING} 2e7", 1.005, 5e-8, 0.9, 14, 1.5),
    "e5": Row(by_moes(300.0, 12.0), f"{EYRING} 5e6", 1.05, 6e-8, 0.8, 15),
    "e6": Row(by_moes(300.0, 12.0), f"{CARREAU} 3e6 carreau_exponent = 0.7", 0.95, 5e-8, 0.8, 16),
    "e7": Row(by_moes(500.0, 8.0), f"{EYRING} 8e6", 1.2, 4e-8, 0.6, 17),
    "e8": Row(by_moes(500.0, 8.0), f"{CARREAU} 1e7 carreau_exponent = 0.4", 0.9, 4e-8, 0.8, 18),
    "e9": Row(by_moes(200.0, 10.0), f"{EYRING} 1e7", 1.01, 6e-8, 1.0, 19),
    "e10": Row(by_moes(200.0, 6.0), f"{EYRING} 3e6", 0.85, 2e-8, 0.8, 20),
    "e11": Row(by_moes(2000.0, 12.0), f"{EYRING} 8e6", 1.02, 3e-8, 0.8, 21),
    "e12": Row(
        by_moes(1500.0, 6.0), f"{CARREAU} 8e6 carreau_exponent = 0.5", 1.05, 1.5e-8, 0.8, 22
    ),
    "e13": Row(BALL, f"{THICK} {CARREAU} 1e5 carreau_exponent = 0.8", 1.05, 5e-8, 0.8, 23),
    "e14": Row(BALL, f"{THICK} {CARREAU} 3e6 carreau_exponent = 0.7", 1.005, 6e-8, 0.8, 24),
    "e15": Row(BALL, f"{THICK} {EYRING} 4e6", 0.98, 8e-8, 0.8, 25, 0.75),
    "e16": Row(by_moes(800.0, 15.0), f"{EYRING} 6e6", 1.15, 6e-8, 0.8, 26),
    "e17": Row(by_moes(1000.0, 5.0), f"{EYRING} 5e6", 1.01, 1.5e-8, 0.8, 27),
    "e18": Row(by_moes(600.0, 10.0), f"{EYRING} 1e7", 0.97, 5e-8, 0.7, 28, 1.25),
    # simulated later: not used to develop the prediction
    "f1": Row(TABLE1, f"{EYRING} 1e7", 1.02, 5e-8, 0.8, 41),
    "f2": Row(by_moes(400.0, 9.0), f"{EYRING} 5e6", 1.03, 5e-8, 0.7, 42, 1.25),
    "f3": Row(by_moes(700.0, 12.0), f"{CARREAU} 5e6 carreau_exponent = 0.6", 0.98, 5e-8, 0.8, 43),
    "f4": Row(by_moes(250.0, 8.0), f"{EYRING} 8e6", 1.05, 4e-8, 0.9, 44),
    "f5": Row(by_moes(1200.0, 9.0), f"{EYRING} 6e6", 0.95, 2.5e-8, 0.8, 45, 0.75),
    "f6": Row(
        by_moes(500.0, 14.0), f"{CARREAU} 1e7 carreau_exponent = 0.5", 1.1, 7e-8, 0.8, 46, 1.5
    ),
    "f7": Row(BALL, f"{THICK} {EYRING} 5e6", 1.01, 8e-8, 0.8, 47),
    "f8": Row(by_moes(900.0, 7.0), f"{EYRING} 5e6", 0.9, 2e-8, 0.7, 48),
    # predicted with the present response before their simulation
    "g1": Row(by_moes(1000.0, 11.0), f"{EYRING} 6e6", 1.03, 5e-8, 0.8, 61),
    "g2": Row(by_moes(300.0, 9.0), f"{EYRING} 5e6", 0.96, 3.5e-8, 0.8, 62, 1.25),
    "g3": Row(by_moes(600.0, 13.0), f"{CARREAU} 5e6 carreau_exponent = 0.5", 1.02, 6e-8, 0.8, 63),
    "g4": Row(by_moes(220.0, 11.0), f"{EYRING} 1e7", 1.08, 5e-8, 0.9, 64),
    "g5": Row(by_moes(1400.0, 8.0), f"{EYRING} 5e6", 1.01, 2e-8, 0.7, 65, 0.75),
    "g6": Row(
        by_moes(450.0, 7.0), f"{CARREAU} 8e6 carreau_exponent = 0.6", 0.92, 2e-8, 0.8, 66, 1.5
    ),
    "g7": Row(BALL, f"{THICK} {EYRING} 6e6", 1.05, 7e-8, 0.8, 67),
    "g8": Row(by_moes(800.0, 9.0), f"{EYRING} 8e6", 1.0, 4e-8, 0.8, 68),
    "g9": Row(TABLE1, f"{EYRING} 5e6", 0.9, 4.5e-8, 0.7, 69, 1.25),
    "g10": Row(by_moes(1800.0, 14.0), f"{EYRING} 1e7", 1.04, 6e-8, 0.8, 70),
    # drawn at random, predicted before their simulation
    "h1": Row(
        by_moes(847.0, 13.6),
        f"{CARREAU} 1.1e+07 carreau_exponent = 0.72",
        1.03,
        1.83e-07,
        0.9,
        81,
        1.0,
    ),
    "h2": Row(by_moes(684.0, 6.6), f"{EYRING} 9.9e+06", 0.96, 2.61e-08, 0.7, 82, 1.25),
    "h3": Row(by_moes(245.0, 7.6), f"{EYRING} 7.5e+06", 1.02, 2.61e-08, 0.8, 83, 1.5),
    "h4": Row(
        by_moes(420.0, 9.6),
        f"{CARREAU} 6.1e+06 carreau_exponent = 0.57",
        1.05,
        7.58e-08,
        0.8,
        84,
        1.0,
    ),
    "h5": Row(by_moes(279.0, 9.6), f"{EYRING} 6.0e+06", 0.89, 4.96e-08, 0.7, 85, 1.5),
    "h6": Row(by_moes(877.0, 9.6), f"{EYRING} 5.7e+06", 1.01, 5.69e-08, 0.8, 86, 1.25),
    "h7": Row(by_moes(607.0, 7.8), f"{EYRING} 9.0e+06", 1.03, 3.67e-08, 0.9, 87, 1.0),
    "h8": Row(by_moes(1350.0, 7.8), f"{EYRING} 1.1e+07", 0.99, 3.94e-08, 0.9, 88, 1.25),
    # slide-to-roll ratios up to 1
    "i1": Row(TABLE1, f"{EYRING} 5e6", 1.5, 5e-8, 0.8, 61),
    "i2": Row(by_moes(500.0, 8.0), f"{CARREAU} 1e6 carreau_exponent = 0.6", 0.5, 3e-8, 0.8, 62),
    "i3": Row(by_moes(300.0, 12.0), f"{EYRING} 8e6", 0.65, 6e-8, 0.7, 63),
    "i4": Row(by_moes(700.0, 9.0), f"{CARREAU} 1e7 carreau_exponent = 0.7", 1.35, 5e-8, 0.9, 64),
    "i5": Row(BALL, f"{THICK} {CARREAU} 3e6 carreau_exponent = 0.7", 1.4, 5e-8, 0.8, 65),
    "i6": Row(by_moes(1500.0, 7.0), f"{EYRING} 1e7", 0.6, 2e-8, 0.8, 66),
}


def case_of(row: Row, points: int = POINTS) -> pyehl.Case:
    """Make the case of a row."""
    text = (
        f"&contact {row.contact} /\n&lubricant {row.lubricant} /\n"
        f"&grid points = {points} x_inlet = -2.5 x_outlet = 1.5 y_extent = 2.0 /\n"
    )
    a = OperatingPoint.from_settings(pyehl.Case.from_text(text).resolve()).hertz_radius
    side = row.length * a
    return pyehl.Case.from_text(
        f"{text}&surface kind = 'fractal' rms_height = {row.rms!r} hurst = {row.hurst} "
        f"seed = {row.seed} length_x = {side!r} length_y = {side!r} pixels = 128 "
        f"velocity_ratio = {row.velocity_ratio} shortest_wavelength = {a / 8.0!r} /\n"
    )


def predicted(row: Row) -> dict[str, Any]:
    """Predict a row."""
    summary = pyehl.predict(case_of(row)).summary
    names = "status", *QUANTITIES, *QUANTITIES.values()
    return {name: summary[name] for name in names}


def simulated(row: Row, points: int) -> dict[str, Any]:
    """Simulate a row; pressure and film over the last period."""
    case = case_of(row, points)
    records: list[tuple[float, ...]] = []
    with Solver(case) as run:
        while not run.done:
            run.advance()
            summary = run.summary
            if not summary.get("steps"):
                continue
            if not records:
                x, y = run.axes()
                radius = np.hypot(x[:, np.newaxis], y[np.newaxis, :])
                smooth, whole = run.field("P_smooth"), run.field("H_smooth")
            rise, film = run.field("P") - smooth, run.field("H")
            records.append(
                (
                    float(summary["T"]),
                    float(np.square(rise[radius < NEAR]).mean()),
                    float(rise[radius < INNER].max()),
                    float(film[radius < 1.0].min()),
                    float(np.square((film - whole)[radius < NEAR]).mean()),
                )
            )
        summary = run.summary
    o = OperatingPoint.from_settings(case.resolve())
    table = np.array(records)
    last = table[table[:, 0] > table[-1, 0] - float(summary["T_period"])]
    return {
        "status": summary["status"],
        "mu_ratio": summary["mu_ratio"],
        "mu_ratio_error_grid": summary["mu_ratio_error_grid"],
        "p_rise_rms_Pa": math.sqrt(float(last[:, 1].mean())) * o.hertz_pressure,
        "p_rise_max_Pa": float(last[:, 2].max()) * o.hertz_pressure,
        "h_min_rough_m": float(last[:, 3].min()) * o.film_scale,
        "rms_deformed_m": math.sqrt(float(last[:, 4].mean())) * o.film_scale,
        # of the smooth contact
        "h_min_m": summary["H_min"] * o.film_scale,
        "h_min_extrapolated_m": (summary["H_min_extrapolated"] or math.nan) * o.film_scale,
    }


def write(path: Path, rows: dict[str, dict[str, Any]]) -> None:
    """Write rows by their names."""
    names = list(dict.fromkeys(k for row in rows.values() for k in row))
    with path.open("w", newline="", encoding="utf-8") as stream:
        writer = csv.DictWriter(stream, ["name", *names], lineterminator="\n")
        writer.writeheader()
        for name, row in rows.items():
            values = {k: f"{v:.6g}" if isinstance(v, float) else v for k, v in row.items()}
            writer.writerow({"name": name, **values})


def read(path: Path) -> dict[str, dict[str, Any]]:
    """Read what `write` wrote."""
    if not path.exists():
        return {}
    with path.open(newline="", encoding="utf-8") as stream:
        return {row.pop("name"): row for row in csv.DictReader(stream)}


def compare(predictions: dict[str, dict[str, Any]], simulations: dict[str, dict[str, Any]]) -> None:
    """Print predictions, simulations, and how many deviations the stated errors cover.

    The minimum film is compared with that of a grid without error: the grid error of the smooth
    contact on the grid of the simulations is added to the simulated one.
    """
    covered: dict[str, list[bool]] = {name: [] for name in QUANTITIES}
    relative: dict[str, list[float]] = {name: [] for name in QUANTITIES}
    for row, result in simulations.items():
        if row not in predictions:
            continue
        said = predictions[row]
        print(f"{row:12s} {said['status']} / {result['status']}", end="")
        if result["status"] != "converged" or said["status"] != "predicted":
            print()
            continue
        for name, error in QUANTITIES.items():
            if not said.get(error) or not result[name]:
                continue
            p, s = float(said[name]), float(result[name])
            if name == "h_min_rough_m":
                s += float(result["h_min_extrapolated_m"]) - float(result["h_min_m"])
            covered[name].append(abs(p - s) <= float(said[error]))
            relative[name].append(p / s - 1.0)
            stated = error_of(said, error, p)
            print(f"  {name} {p:.5g} / {s:.5g} ({p / s - 1.0:+.2%}, error {stated})", end="")
        print()
    for name, values in relative.items():
        if not values:
            continue
        spread = np.array(values)
        print(
            f"{name:16s} rms {np.sqrt(np.mean(spread**2)):.2%}, largest "
            f"{np.abs(spread).max():.2%}, {np.count_nonzero(np.abs(spread) <= 0.05)} within 5 %, "
            f"{np.count_nonzero(np.abs(spread) <= 0.005)} within 0.5 %, stated error covers "
            f"{sum(covered[name])} of {spread.size}"
        )


def error_of(said: dict[str, Any], name: str, value: float) -> str:
    """Format a stated error, relative to the value."""
    return f"{float(said[name]) / value:.2%}" if said[name] else "unknown"


def add(path: Path, names: Iterable[str], points: int) -> None:
    """Simulate the missing rows of a table."""
    result = read(path)
    for name in names:
        if name not in result:
            print(name, flush=True)
            result[name] = simulated(PLAN[name], points)
            write(path, result)


def main(arguments: list[str]) -> None:
    """Predict, simulate or compare."""
    what = arguments[0]
    if what == "predict":
        write(HERE / "predicted.csv", {name: predicted(row) for name, row in PLAN.items()})
    elif what == "commit":
        result = read(HERE / "committed.csv")
        known = result | read(HERE / "simulated.csv")
        new = {name: predicted(row) for name, row in PLAN.items() if name not in known}
        write(HERE / "committed.csv", result | new)
    elif what == "simulate":
        add(HERE / "simulated.csv", PLAN, POINTS)
    elif what == "fine":
        add(HERE / "fine.csv", [name for name in PLAN if name[0] in "ghi"], FINE)
    elif what == "compare":
        tables = [*arguments[1:], *("predicted.csv", "simulated.csv")[len(arguments) - 1 :]]
        compare(*(read(HERE / table) for table in tables))


if __name__ == "__main__":
    main(sys.argv[1:])

# SPDX-License-Identifier: BSD-3-Clause
"""Rough surfaces in lubricants that thin: predicted, then simulated.

    python docs/evidence/thinning/rough.py predict      writes predicted.csv
    python docs/evidence/thinning/rough.py simulate     adds what is missing to simulated.csv
    python docs/evidence/thinning/rough.py compare      prints both

A simulation is on 257 x 257 nodes and takes one to three minutes on one core. Waves shorter than
eight nodes of that grid are cut off. Pressures are those within 0.8 a of the centre.
"""

from __future__ import annotations

import csv
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

import pyehl
from pyehl.solver import Solver
from pyehl.theory.operating import OperatingPoint

HERE = Path(__file__).parent
POINTS = 257
RADII = (0.5, 0.8, 1.0)
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


PLAN: dict[str, Row] = {
    "dev1": Row(TABLE1, f"{EYRING} 5e6", 1.01, 5e-8),
    "dev2": Row(BALL, f"{THICK} {CARREAU} 1e5 carreau_exponent = 0.8", 1.05, 8e-8, 0.8, 2),
    "dev3": Row(by_moes(500.0, 8.0), f"{CARREAU} 1e6 carreau_exponent = 0.6", 1.1, 1e-7, 0.8, 3),
    "dev4": Row(by_moes(300.0, 12.0), f"{EYRING} 2e7", 0.95, 1.5e-7, 0.8, 4),
}


def case_of(row: Row) -> pyehl.Case:
    """Make the case of a row."""
    text = (
        f"&contact {row.contact} /\n&lubricant {row.lubricant} /\n"
        f"&grid points = {POINTS} x_inlet = -2.5 x_outlet = 1.5 y_extent = 2.0 /\n"
    )
    a = OperatingPoint.from_settings(pyehl.Case.from_text(text).resolve()).hertz_radius
    side = row.length * a
    return pyehl.Case.from_text(
        f"{text}&surface kind = 'fractal' rms_height = {row.rms!r} hurst = {row.hurst} "
        f"seed = {row.seed} length_x = {side!r} length_y = {side!r} pixels = 128 "
        f"velocity_ratio = {row.velocity_ratio} shortest_wavelength = {a / 8.0!r} /\n"
    )


PREDICTED = {
    "mu_ratio": "mu_ratio",
    "mu_ratio_error": "mu_ratio_model_error",
    "rms_pressure": "rms_pressure_Pa",
    "h_min": "h_min_rough_m",
    "rms_deformed": "rms_deformed_m",
    "mu_smooth": "mu_smooth",
}


def predicted(row: Row) -> dict[str, Any]:
    """Predict a row."""
    summary = pyehl.predict(case_of(row)).summary
    return {"status": summary["status"], **{k: summary[v] for k, v in PREDICTED.items()}}


def simulated(row: Row) -> dict[str, Any]:
    """Simulate a row; rms and greatest rise of the pressure, least film over the last period."""
    with Solver.open(case_of(row)) as run:
        step = run.advance
        records: list[tuple[float, ...]] = []
        while not run.done:
            step()
            s = run.summary()
            if not s.get("steps"):
                continue
            if not records:
                x, y = run.axes()
                smooth = run.field("P_smooth")
                radius = np.hypot(x[:, np.newaxis], y[np.newaxis, :])
                parts = [(radius < r) & (smooth > 0.0) for r in RADII]
            pressure, film = run.field("P"), run.field("H")
            rise = pressure - smooth
            records.append(
                (
                    float(s["T"]),
                    *(float(np.square(rise[p]).mean()) for p in parts),
                    *(float(rise[p].max()) for p in parts),
                    float(film[parts[-1]].min()),
                    float(pressure.max()),
                )
            )
        summary = run.summary()
    table = np.array(records)
    o = OperatingPoint.from_settings(case_of(row).resolve())
    last = table[table[:, 0] > table[-1, 0] - float(summary["T_period"])]
    n = len(RADII)
    rms = np.sqrt(last[:, 1 : 1 + n].mean(axis=0)) * o.hertz_pressure
    rise = last[:, 1 + n : 1 + 2 * n].max(axis=0) * o.hertz_pressure
    return {
        "status": summary["status"],
        "mu_ratio": summary["mu_ratio"],
        "mu_ratio_error_grid": summary["mu_ratio_error_grid"],
        "mu_smooth": summary["mu_smooth"],
        **{f"rms_pressure_{r:g}": v for r, v in zip(RADII, rms, strict=True)},
        **{f"rise_{r:g}": v for r, v in zip(RADII, rise, strict=True)},
        "h_min": last[:, -2].min() * o.film_scale,
        "p_max_mean": last[:, -1].mean() * o.hertz_pressure,
        # of the smooth contact
        **{
            f"smooth_{name}{end}": (summary[f"{name}{end}"] or np.nan) * o.film_scale
            for name in ("H_c", "H_min")
            for end in ("", "_extrapolated")
        },
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


def main(arguments: list[str]) -> None:
    """Predict, simulate or compare."""
    what = arguments[0]
    where = Path(arguments[1]) if len(arguments) > 1 else HERE
    if what == "predict":
        write(where / "predicted.csv", {name: predicted(row) for name, row in PLAN.items()})
    elif what == "simulate":
        found = read(where / "simulated.csv")
        for name, row in PLAN.items():
            if name not in found:
                print(name, flush=True)
                found[name] = simulated(row)
                write(where / "simulated.csv", found)


if __name__ == "__main__":
    main(sys.argv[1:])

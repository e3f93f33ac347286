# SPDX-License-Identifier: BSD-3-Clause
"""Rough strips of line contacts: predicted, then simulated.

    python docs/evidence/prediction_lines/strips.py commit      adds new cases to committed.csv
    python docs/evidence/prediction_lines/strips.py simulate [NAME ...]     adds to simulated.csv
    python docs/evidence/prediction_lines/strips.py compare     prints both

The strips have 257 nodes along the motion, h = b/64, a single row has 1025. Waves shorter than
eight nodes of the strips are cut off. A simulation takes one to three minutes on one core.
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
from pyehl.surfaces import Topography, fractal
from pyehl.theory.line_contact import LineContact, contact_of, formula_film
from pyehl.theory.lubricant import Lubricant

HERE = Path(__file__).parent
DOMAIN = "x_inlet = -2.5 x_outlet = 1.5"
SHORTEST = 8.0
"""b over the shortest wave of a fractal surface."""
EYRING = "shear_law = 'eyring' eyring_stress ="
CARREAU = "shear_law = 'carreau' carreau_exponent = 0.6 carreau_stress ="
PIXELS = 64


@dataclass(frozen=True, slots=True)
class Row:
    """A line contact with a surface: one wave of wavelengths (x, y) [b], 0: none, or a fractal."""

    moes_m: float
    moes_l: float
    velocity_ratio: float
    rms: float  # over the central film by formula
    wave: tuple[float, float] | None = None
    seed: int = 0
    second: float = 0.0  # rms of a second fractal surface over the film
    law: str = ""


PLAN: dict[str, Row] = {
    "across1": Row(20.0, 10.0, 1.02, 0.18, (0.5, 0.0)),
    "across2": Row(50.0, 8.0, 1.01, 0.20, (0.25, 0.0)),
    "oblique1": Row(30.0, 12.0, 0.97, 0.15, (0.5, 1.0)),
    "oblique2": Row(80.0, 7.0, 1.01, 0.22, (1.0, 0.5)),
    "along": Row(40.0, 10.0, 1.0, 0.25, (0.0, 0.5)),
    "f1": Row(20.0, 10.0, 1.01, 0.25, seed=11),
    "f2": Row(40.0, 8.0, 0.98, 0.22, seed=12),
    "f3": Row(60.0, 12.0, 1.02, 0.2, seed=13),
    "f4": Row(25.0, 5.0, 1.0, 0.4, seed=14),
    "f5": Row(100.0, 10.0, 1.01, 0.2, seed=15),
    "two": Row(30.0, 9.0, 1.02, 0.2, seed=16, second=0.15),
    "e1": Row(20.0, 10.0, 1.05, 0.3, seed=21, law=f"{EYRING} 5e6"),
    "e2": Row(50.0, 12.0, 0.95, 0.3, seed=22, law=f"{EYRING} 1e7"),
    "e3": Row(80.0, 7.0, 1.01, 0.3, seed=23, law=f"{EYRING} 5e6"),
    "e4": Row(30.0, 6.0, 1.1, 0.3, seed=24, law=f"{EYRING} 8e6"),
    "e5": Row(60.0, 9.0, 1.02, 0.3, seed=25, law=f"{CARREAU} 6e6"),
    "e6": Row(25.0, 14.0, 0.98, 0.3, (0.5, 1.0), law=f"{EYRING} 5e6"),
}
DRAWN = 20261128, 8
"""Seed and number of random strips, added after the simulation of the plan above."""


def drawn(seed: int, count: int) -> dict[str, Row]:
    """Draw strips: waves, isotropic surfaces and pairs of them, under every law."""
    rng = np.random.default_rng(seed)
    result = {}
    for number in range(count):
        moes_m = float(np.exp(rng.uniform(np.log(20.0), np.log(100.0))))
        law = str(rng.choice(["", f"{EYRING} 5e6", f"{EYRING} 1e7", f"{CARREAU} 6e6"]))
        waves = [float(length) for length in rng.choice([0.25, 0.5, 1.0, 2.0], 2)]
        kind = str(rng.choice(["wave", "fractal", "fractal", "two"]))
        rms = rng.uniform(0.1, 0.35)
        result[f"d{number + 1}"] = Row(
            round(moes_m, 1),
            round(float(rng.uniform(5.0, 14.0)), 1),
            round(float(rng.uniform(0.95, 1.05)), 3),
            round(float(rms), 3),
            (waves[0], waves[1]) if kind == "wave" else None,
            seed=int(rng.integers(100, 1000)),
            second=round(float(rng.uniform(0.1, 0.2)), 3) if kind == "two" else 0.0,
            law=law,
        )
    return result


PLAN |= drawn(*DRAWN)


def case_of(row: Row) -> tuple[pyehl.Case, list[Topography]]:
    """Make the case of a row, and its surfaces."""
    line = LineContact.from_moes(row.moes_m, row.moes_l)
    varies = row.wave is None or row.wave[1] > 0.0
    width = f"wavelength = 1.0 wavelength_y = {1.0 if varies else 1e6}"
    kinds = f"&surface kind = 'harmonic' amplitude = 1e-3 {width} "
    kinds += f"velocity_ratio = {row.velocity_ratio} /\n"
    if row.second:
        kinds += "&second_surface kind = 'harmonic' amplitude = 1e-3 /\n"
    case = pyehl.Case.from_text(
        f"&contact shape = 'line' load_per_length = {line.load_per_length!r} "
        f"radius = {line.radius!r} mean_velocity = {line.mean_velocity!r} /\n"
        f"&lubricant {row.law} /\n&grid points = {257 if varies else 1025} {DOMAIN} /\n{kinds}"
    )
    settings = case.resolve()
    film = formula_film(contact_of(settings), Lubricant.from_settings(settings))
    b = line.half_width
    if row.wave is not None and not varies:
        # rms is amplitude/sqrt(2)
        amplitude = row.rms * np.sqrt(2.0) * film / line.film_scale
        return case.with_options(
            {"surface.amplitude": float(f"{amplitude:.6g}"), "surface.wavelength_x": row.wave[0]}
        ), []
    rms = [part * film for part in (row.rms, row.second) if part]
    if row.wave is not None:
        return case, [_wave(row.wave, rms[0] * np.sqrt(2.0), b)]
    return case, [_fractal(row.seed + 100 * k, size, b) for k, size in enumerate(rms)]


def _wave(wave: tuple[float, float], amplitude: float, b: float) -> Topography:
    """Make a wave; its tile has the length b in a direction without variation."""
    size = [length or 1.0 for length in wave]
    phase = [2.0 * np.pi * bool(length) * np.arange(PIXELS) / PIXELS for length in wave]
    heights = amplitude * np.cos(phase[0][:, np.newaxis] + phase[1])
    return Topography(heights, (size[0] * b, size[1] * b), "a wave")


def _fractal(seed: int, rms: float, b: float) -> Topography:
    """Make a tile of b x b without its short waves, with an rms height [m]."""
    from pyehl.surfaces import filtered  # noqa: PLC0415

    tile = filtered(fractal(PIXELS, b, b, rms_height=rms, hurst=0.8, seed=seed), b / SHORTEST)
    return Topography(tile.heights * (rms / tile.rms_height), tile.size, f"fractal, seed {seed}")


NAMES = ("status", "mu_ratio", "mu_ratio_model_error", "p_rise_rms_Pa", "h_min_rough_m", "h_min_m")


def predicted(row: Row) -> dict[str, Any]:
    """Predict a row."""
    case, tiles = case_of(row)
    given = dict(zip(("surface", "second_surface"), tiles, strict=False))
    summary = pyehl.predict(case, **given).summary
    return {name: summary[name] for name in (*NAMES, "h_min_rough_error_m", "outside_range")}


def simulated(row: Row) -> dict[str, Any]:
    """Simulate a row."""
    case, tiles = case_of(row)
    with Solver(case, **dict(zip(("surface", "second_surface"), tiles, strict=False))) as run:
        run.run()
        s = run.summary
    names = ("status", "mu_ratio", "mu_ratio_error", "mu_ratio_error_grid", "H_min", "T_period")
    return {name: s.get(name) for name in names} | {"moes_m": row.moes_m, "moes_l": row.moes_l}


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
    what, *names = arguments
    if what == "commit":
        result = read(HERE / "committed.csv")
        known = result | read(HERE / "simulated.csv")
        new = {name: predicted(row) for name, row in PLAN.items() if name not in known}
        write(HERE / "committed.csv", result | new)
    elif what == "simulate":
        for name in names or PLAN:
            if name not in read(HERE / "simulated.csv"):
                row = simulated(PLAN[name])
                # another process may have added rows meanwhile
                write(HERE / "simulated.csv", read(HERE / "simulated.csv") | {name: row})
    elif what == "compare":
        stated, result = read(HERE / "committed.csv"), read(HERE / "simulated.csv")
        for name in PLAN:
            if name in stated and name in result:
                p, s = (float(rows[name]["mu_ratio"] or "nan") for rows in (stated, result))
                error = float(stated[name]["mu_ratio_model_error"] or "nan")
                grid = float(result[name]["mu_ratio_error_grid"] or "nan")
                held = "covered" if abs(p - s) <= error else "not covered"
                print(
                    f"{name:10s} {p:.4f} / {s:.4f} +- {grid:.4f}: {p / s - 1.0:+.2%}, "
                    f"stated {error / p:.2%}, {held}"
                )


if __name__ == "__main__":
    main(sys.argv[1:])

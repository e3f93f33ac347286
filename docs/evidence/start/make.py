# SPDX-License-Identifier: BSD-3-Clause
"""Problems from front and prediction: python make.py problems.csv [POINTS [PROBLEM ...]].

Each problem is run with time.start = 'front' and with 'prediction', on POINTS nodes per side.
Finished rows are appended; existing ones stay. Without POINTS the script prints the table of
README.md.
"""

from __future__ import annotations

import csv
import sys
import tempfile
from pathlib import Path
from typing import Any

import numpy as np

import pyehl

COLUMNS = (
    "problem",
    "points",
    "start",
    "mu_ratio_front",
    "mu_ratio",
    "error_stop_front",
    "error_stop",
    "error_grid",
    "steps_front",
    "steps",
)

POINT = {"contact.moes_m": 1000.0, "contact.moes_l": 10.0}
FRACTAL = {"surface.kind": "fractal"}


def wave(amplitude: float, along: float, across: float, ratio: float) -> dict[str, Any]:
    """Options of a wave."""
    return POINT | {
        "surface.kind": "harmonic",
        "surface.amplitude": amplitude,
        "surface.wavelength_x": along,
        "surface.wavelength_y": across,
        "surface.velocity_ratio": ratio,
    }


WIDE = {"contact.radius_ratio": 0.35177}


def pair(slide_to_roll: float, other: float) -> dict[str, Any]:
    """Options of two waves, the second with the wavelength `other` [a]."""
    keys = POINT | {"surface.kind": "harmonic", "surface.amplitude": 4e-3}
    second = {"kind": "harmonic", "amplitude": 3e-3, "wavelength": other}
    keys |= {f"second_surface.{key}": value for key, value in second.items()}
    return keys | {"contact.slide_to_roll": slide_to_roll}


def problems(folder: Path) -> dict[str, dict[str, Any]]:
    """Options by name; a map is written into a folder."""
    heights = 2e-8 * np.random.default_rng(1).standard_normal((32, 32))
    np.save(folder / "map.npy", heights)
    size = {"surface.length_x": 8.29e-4, "surface.length_y": 8.29e-4}
    return {
        "wave 0.5 a, U 1.01": wave(4e-3, 0.5, 0.5, 1.01),
        "wave 0.5 a, U 1.1": wave(4e-3, 0.5, 0.5, 1.1),
        "wave 0.5 a x 1 a, U 0.8": wave(4e-3, 0.5, 1.0, 0.8),
        "wave 2 a, U 1.05": wave(4e-3, 2.0, 2.0, 1.05),
        "wave 0.25 a, U 1.01": wave(3e-3, 0.25, 0.25, 1.01),
        "wave 0.5 a, scheme of the paper": wave(4e-3, 0.5, 0.5, 1.01) | {"time.scheme": "paper"},
        "wave 0.5 a, M = 200": wave(2e-2, 0.5, 0.5, 1.05) | {"contact.moes_m": 200.0},
        "wave 0.5 a, two threads, whole domain": wave(4e-3, 0.5, 0.5, 1.05)
        | {"solver.threads": 2, "solver.symmetry": "full"},
        "fractal of Table 1": FRACTAL,
        "fractal, seed 2, U 1.05": FRACTAL | {"surface.seed": 2, "surface.velocity_ratio": 1.05},
        "fractal, seed 3, scheme of the paper": FRACTAL
        | {"surface.seed": 3, "time.scheme": "paper"},
        "map of 32 x 32 pixels": {"surface.kind": "map", "surface.file": folder / "map.npy"} | size,
        "wave 0.5 a, kappa 2": wave(5e-3, 0.5, 0.5, 1.01) | WIDE,
        "fractal, kappa 2, 600 N": FRACTAL
        | {"contact.radius_x": 0.012, "contact.radius_y": 0.0341},
        "waves 0.5 a and 0.25 a, together": pair(0.0, 0.25),
        "waves 0.5 a and 1 a, slide-to-roll ratio 0.25, kappa 2": pair(0.25, 1.0) | WIDE,
    }


def row_of(name: str, points: int, options: dict[str, Any]) -> dict[str, Any]:
    """Run a problem with both starts."""
    result = []
    for start in ("front", "prediction"):
        case = pyehl.Case.from_text("", options | {"grid.points": points, "time.start": start})
        with pyehl.Solver(case) as solver:
            solver.run()
            result.append(solver.summary)
    front, other = result
    return {
        "problem": name,
        "points": points,
        "start": other["start"],
        "mu_ratio_front": front["mu_ratio"],
        "mu_ratio": other["mu_ratio"],
        "error_stop_front": front["mu_ratio_error_stop"],
        "error_stop": other["mu_ratio_error_stop"],
        "error_grid": front["mu_ratio_error_grid"],
        "steps_front": front["steps"],
        "steps": other["steps"],
    }


def rows_of(table: Path) -> list[dict[str, Any]]:
    """Rows of the table, numbers as numbers."""
    if not table.is_file():
        return []
    with table.open(newline="", encoding="utf-8") as file:
        words = ("problem", "start")
        return [
            {name: value if name in words else float(value or "nan") for name, value in row.items()}
            for row in csv.DictReader(file)
        ]


def line_of(row: dict[str, Any]) -> str:
    """Line of the table in README.md."""
    return (
        f"| {row['problem']} | {row['points']:.0f} | {row['mu_ratio_front']:.5f} | "
        f"{row['mu_ratio']:.5f} | {row['mu_ratio'] - row['mu_ratio_front']:+.1e} | "
        f"{row['error_stop']:.1e} | {row['error_grid']:.1e} | {row['steps_front']:.0f} | "
        f"{row['steps']:.0f} | {row['steps'] / row['steps_front']:.2f} |"
    )


def main(table: Path, points: int, wanted: list[str]) -> None:
    """Append missing rows."""
    done = {(row["problem"], int(row["points"])) for row in rows_of(table)}
    with tempfile.TemporaryDirectory() as folder, table.open("a", newline="") as file:
        writer = csv.DictWriter(file, COLUMNS)
        if not done:
            writer.writeheader()
        for name, options in problems(Path(folder)).items():
            if (name, points) in done or (wanted and name not in wanted):
                continue
            writer.writerow(row_of(name, points, options))
            file.flush()


if __name__ == "__main__":
    if len(sys.argv) > 2:
        main(Path(sys.argv[1]), int(sys.argv[2]), sys.argv[3:])
    else:
        print("\n".join(map(line_of, rows_of(Path(sys.argv[1])))))

# SPDX-License-Identifier: BSD-3-Clause
"""Make the table of the algebraic error of mu_r/mu_s: python make.py table.csv [CASE ...].

Each case is run with the default settings, and again with the same number of steps to a fortieth of
the algebraic error (solver.accuracy = 0.0025). The grid error is 4/3 of the difference to the run
on the next finer grid. Finished rows are appended; existing ones stay.
"""

from __future__ import annotations

import csv
import json
import resource
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

COLUMNS = (
    "case",
    "points",
    "steps",
    "cycles_per_step",
    "mu_ratio",
    "strict",
    "finer",
    "algebraic_error",
    "grid_error",
    "share",
    "cpu_seconds",
    "cpu_seconds_strict",
)


def wave(m: float, moes_l: float, length: float, amplitude: float, ratio: float = 1.01) -> str:
    """Write the case of a wave, with an absolute amplitude, the same on all grids."""
    return (
        f"&contact moes_m = {m} moes_l = {moes_l} /\n"
        f"&surface kind = 'harmonic' amplitude = {amplitude} wavelength = {length} "
        f"velocity_ratio = {ratio} /\n"
    )


BALL = "&contact load = 30.0 mean_velocity = 0.5 radius = 0.0127 reduced_modulus = 1.24e11 /\n"
# Name: nodes per side, case
CASES = {
    "(1000, 10), wave of Fig. 2": (257, wave(1000.0, 10.0, 0.5, 9.734e-3)),
    "(1000, 10), wave 0.5 a, 0.1 H_c": (257, wave(1000.0, 10.0, 0.5, 2.46e-3)),
    "(2000, 5), wave 0.5 a, 1.0 H_c": (257, wave(2000.0, 5.0, 0.5, 8.8e-3)),
    "(500, 10), wave 0.25 a, 0.5 H_c": (257, wave(500.0, 10.0, 0.25, 2.05e-2)),
    "(500, 5), wave 0.25 a, 0.67 H_c": (257, wave(500.0, 5.0, 0.25, 1.87e-2)),
    "(500, 5), wave 0.5 a, 0.67 H_c": (129, wave(500.0, 5.0, 0.5, 1.87e-2)),
    "(2000, 15), wave 0.5 a, 0.67 H_c": (257, wave(2000.0, 15.0, 0.5, 1.2e-2)),
    "(200, 10), wave 1 a, 0.4 H_c": (129, wave(200.0, 10.0, 1.0, 3.25e-2)),
    "(1000, 10), wave 0.25 a, 0.3 H_c, U_rat 1.1": (129, wave(1000.0, 10.0, 0.25, 7.4e-3, 1.1)),
    "fractal surface of Table 1": (129, "&surface kind = 'fractal' /\n"),
    "fractal, without waves shorter than a/8": (
        129,
        "&surface kind = 'fractal' shortest_wavelength = 5.2e-5 /\n",
    ),
    "fractal, seed 2": (129, "&surface kind = 'fractal' seed = 2 /\n"),
    "Carreau 0.1 MPa, n = 0.8, wave 0.5 a": (
        129,
        f"{BALL}&lubricant viscosity = 0.5 pressure_viscosity = 1.8e-8 shear_law = 'carreau' "
        "carreau_stress = 1e5 carreau_exponent = 0.8 /\n"
        "&surface kind = 'harmonic' amplitude = 0.06 wavelength = 0.5 velocity_ratio = 1.05 /\n",
    ),
    "Eyring 4 MPa, wave 0.5 a": (
        129,
        f"{BALL}&lubricant viscosity = 0.5 pressure_viscosity = 1.8e-8 shear_law = 'eyring' "
        "eyring_stress = 4e6 /\n"
        "&surface kind = 'harmonic' amplitude = 0.06 wavelength = 0.5 velocity_ratio = 1.1 /\n",
    ),
    "Table 1, Eyring 5 MPa, fractal, without waves shorter than a/8": (
        129,
        "&lubricant shear_law = 'eyring' eyring_stress = 5e6 /\n"
        "&surface kind = 'fractal' shortest_wavelength = 5.2e-5 /\n",
    ),
    "Table 1, Carreau 5 MPa, n = 0.5, fractal, without waves shorter than a/8": (
        129,
        "&lubricant shear_law = 'carreau' carreau_stress = 5e6 carreau_exponent = 0.5 /\n"
        "&surface kind = 'fractal' shortest_wavelength = 5.2e-5 velocity_ratio = 1.1 /\n",
    ),
}


def run(text: str, points: int, *options: str) -> tuple[dict[str, Any], float]:
    """Summary and CPU seconds of a run by the program ``ehl`` on the PATH."""
    settings = (
        f"grid.points={points}",
        "time.estimate_error=.false.",
        "solver.threads=1",
        *options,
    )
    words = [word for option in settings for word in ("--set", option)]
    began = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    with tempfile.TemporaryDirectory() as folder:
        Path(folder, "case.nml").write_text(text)
        words = ["ehl", "case.nml", "-o", "out", "--quiet", *words]
        subprocess.run(words, cwd=folder, check=False)
        summary = json.loads(Path(folder, "out", "summary.json").read_text())
    # after a given number of steps the mean may not have settled
    assert summary["status"] in ("converged", "not settled"), summary["status"]
    return summary, resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - began


def row(name: str) -> dict[str, Any]:
    """Make a row of the table."""
    points, text = CASES[name]
    done, seconds = run(text, points)
    steps = f"time.steps={done['steps']}"
    strict, seconds_strict = run(text, points, steps, "solver.accuracy=0.0025")
    finer, _ = run(text, 2 * points - 1)
    # the mean over the last period, settled or not
    mean = strict.get("last_mu_ratio_mean", strict["mu_ratio"])
    algebraic = abs(done["mu_ratio"] - mean)
    grid = 4.0 / 3.0 * abs(finer["mu_ratio"] - done["mu_ratio"])
    return {
        "case": name,
        "points": points,
        "steps": done["steps"],
        "cycles_per_step": f"{done['cycles_per_step']:.2f}",
        "mu_ratio": f"{done['mu_ratio']:.6f}",
        "strict": f"{mean:.6f}",
        "finer": f"{finer['mu_ratio']:.6f}",
        "algebraic_error": f"{algebraic:.1e}",
        "grid_error": f"{grid:.1e}",
        "share": f"{algebraic / grid:.4f}",
        "cpu_seconds": f"{seconds:.1f}",
        "cpu_seconds_strict": f"{seconds_strict:.1f}",
    }


def main() -> None:
    """Append missing rows."""
    table = Path(sys.argv[1])
    there = [line["case"] for line in csv.DictReader(table.open())] if table.exists() else []
    for name in sys.argv[2:] or CASES:
        if name in there:
            continue
        line = row(name)
        new = not table.exists()
        with table.open("a", newline="") as file:
            writer = csv.DictWriter(file, COLUMNS, lineterminator="\n")
            if new:
                writer.writeheader()
            writer.writerow(line)
        print(line, flush=True)


if __name__ == "__main__":
    main()

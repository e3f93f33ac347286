# SPDX-License-Identifier: BSD-3-Clause
"""Algebraic error of the mean mu_r/mu_s beside its grid error: python make.py table.csv [CASE ...]

Each case is run with the default settings, and once more with the same number of steps to a fortieth
of the algebraic error (solver.accuracy = 0.0025). The grid error is 4/3 of the difference to the run
on the next finer grid. Rows are appended as they are done; those that are there are left alone.
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

POINTS = 257
COLUMNS = (
    "case", "points", "steps", "cycles_per_step", "mu_ratio", "strict", "finer", "algebraic_error", "grid_error", "share",
    "cpu_seconds", "cpu_seconds_strict",
)  # fmt: skip


def wave(m: float, moes_l: float, length: float, amplitude: float, ratio: float = 1.01) -> str:
    """A wave, its amplitude absolute so that it is the same on all grids."""
    return (
        f"&contact moes_m = {m} moes_l = {moes_l} /\n"
        f"&surface kind = 'harmonic' amplitude = {amplitude} wavelength = {length} velocity_ratio = {ratio} /\n"
    )


CASES = {
    "(1000, 10), wave of Fig. 2": wave(1000.0, 10.0, 0.5, 9.734e-3),
    "(1000, 10), wave 0.5 a, 0.1 H_c": wave(1000.0, 10.0, 0.5, 2.46e-3),
    "(2000, 5), wave 0.5 a, 1.0 H_c": wave(2000.0, 5.0, 0.5, 8.8e-3),
    "(500, 10), wave 0.25 a, 0.5 H_c": wave(500.0, 10.0, 0.25, 2.05e-2),
    "(500, 5), wave 0.25 a, 0.67 H_c": wave(500.0, 5.0, 0.25, 1.87e-2),
    "(2000, 15), wave 0.25 a, 0.67 H_c": wave(2000.0, 15.0, 0.25, 1.2e-2),
    "(200, 10), wave 1 a, 0.4 H_c": wave(200.0, 10.0, 1.0, 3.25e-2),
    "(1000, 10), wave 0.25 a, 0.3 H_c, U_rat 1.1": wave(1000.0, 10.0, 0.25, 7.4e-3, 1.1),
    "fractal surface of Table 1": "&surface kind = 'fractal' /\n",
    "fractal, waves below a/8 cut": "&surface kind = 'fractal' shortest_wavelength = 5.2e-5 /\n",
    "fractal, seed 2": "&surface kind = 'fractal' seed = 2 /\n",
}


def run(text: str, points: int, *options: str) -> tuple[dict[str, Any], float]:
    """Summary and CPU seconds of a run by the program ``ehl`` on the PATH."""
    settings = (f"grid.points={points}", "time.estimate_error=.false.", "solver.threads=1", *options)
    words = [word for option in settings for word in ("--set", option)]
    began = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    with tempfile.TemporaryDirectory() as folder:
        Path(folder, "case.nml").write_text(text)
        subprocess.run(["ehl", "case.nml", "-o", "out", "--quiet", *words], cwd=folder, check=True)
        summary = json.loads(Path(folder, "out", "summary.json").read_text())
    return summary, resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - began


def row(name: str) -> dict[str, Any]:
    """One line of the table."""
    done, seconds = run(CASES[name], POINTS)
    steps = f"time.steps={done['steps']}"
    strict, seconds_strict = run(CASES[name], POINTS, steps, "solver.accuracy=0.0025")
    finer, _ = run(CASES[name], 2 * POINTS - 1)
    algebraic = abs(done["mu_ratio"] - strict["mu_ratio"])
    grid = 4.0 / 3.0 * abs(finer["mu_ratio"] - done["mu_ratio"])
    values = (
        name, POINTS, done["steps"], f"{done['cycles_per_step']:.2f}", f"{done['mu_ratio']:.6f}",
        f"{strict['mu_ratio']:.6f}", f"{finer['mu_ratio']:.6f}", f"{algebraic:.1e}", f"{grid:.1e}",
        f"{algebraic / grid:.4f}", f"{seconds:.1f}", f"{seconds_strict:.1f}",
    )  # fmt: skip
    return dict(zip(COLUMNS, values, strict=True))


def main() -> None:
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

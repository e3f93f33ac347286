# SPDX-License-Identifier: BSD-3-Clause
"""Try remedies on random rollers without a solution.

python docs/evidence/rollers/remedies.py SEED NUMBER REMEDY    appends a row to remedies.csv
"""

import csv
import resource
import sys
from itertools import islice
from pathlib import Path
from typing import Any

import pyehl

HERE = Path(__file__).resolve().parent
LIMIT = 90
"""Maximum processor time of a run [s]; the row of a run that is stopped is added by hand."""


def changed(keys: dict[str, Any], remedy: str) -> dict[str, Any]:
    """Apply a remedy: deeper, logarithmic, half (the misalignment), or a grid: 257x1537."""
    result = dict(keys)
    if remedy == "deeper":
        factors = {"log_amplitude": 2.0, "chamfer_drop": 2.0, "crown_radius": 0.5}
        for key, factor in factors.items():
            if f"contact.{key}" in keys:
                result[f"contact.{key}"] *= factor
    elif remedy == "logarithmic":  # twice the amplitude of ISO/TS 16281
        for key in ("crown_radius", "chamfer_length", "chamfer_drop"):
            result.pop(f"contact.{key}", None)
        amplitude = 1.4e-3 * keys["contact.radius"]
        result |= {"contact.profile": "logarithmic", "contact.log_amplitude": amplitude}
    elif remedy == "half":
        result["contact.misalignment"] *= 0.5
    else:
        points, rows = map(int, remedy.split("x"))
        result |= {"grid.points": points, "grid.points_y": rows}
    return result


def main() -> None:
    """Solve a roller with a remedy."""
    sys.path.insert(0, str(HERE.parents[2] / "benchmarks"))
    from rollers import rollers  # noqa: PLC0415 (a file of the benchmarks)

    seed, number, remedy = int(sys.argv[1]), int(sys.argv[2]), sys.argv[3]
    keys = next(islice(rollers(seed, number + 1), number, None))
    case = {"grid.points": 257, "solver.threads": 1} | changed(keys, remedy)
    resource.setrlimit(resource.RLIMIT_CPU, (LIMIT, LIMIT))
    result = pyehl.solve(pyehl.Case(), case, check=False)
    status = result.attrs["status"]
    cycles = int(result.total_cycles) if status == "converged" else ""
    with (HERE / "remedies.csv").open("a", encoding="utf-8", newline="") as stream:
        row = seed, number, keys["contact.profile"], remedy, status, cycles
        csv.writer(stream, lineterminator="\n").writerow(row)


if __name__ == "__main__":
    main()
